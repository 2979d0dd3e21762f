//! Place of a face in a picture: turned under the feed, mirrored back for an M4 spindle, to scale.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use glam::DVec2;

use crate::geom::OutlineEdge;
use crate::page::px;

/// From the plan's frame to a picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PictureFrame {
    turn: DVec2,
    flip: bool,
    scale: f64,
    zero: [f64; 2],
}

/// The box around what is drawn, in the turned frame as the part lies [mm].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    pub(crate) min: DVec2,
    pub(crate) max: DVec2,
}

impl Window {
    pub(crate) const EMPTY: Window =
        Window { min: DVec2::splat(f64::INFINITY), max: DVec2::splat(f64::NEG_INFINITY) };

    /// Grown to hold a point.
    pub(crate) fn grow(&mut self, p: DVec2) {
        if p.is_finite() {
            self.min = self.min.min(p);
            self.max = self.max.max(p);
        }
    }

    /// Grown to hold the edges, in a frame of any scale.
    pub(crate) fn grow_edges(&mut self, edges: &[OutlineEdge], turned: &PictureFrame) {
        let turn = turned.turn;
        for edge in edges {
            let [x0, x1] = edge.extent(DVec2::new(turn.x, -turn.y));
            let [y0, y1] = edge.extent(DVec2::new(turn.y, turn.x));
            let (y0, y1) = if turned.flip { (-y1, -y0) } else { (y0, y1) };
            self.grow(DVec2::new(x0, y0));
            self.grow(DVec2::new(x1, y1));
        }
    }

    pub(crate) fn size(&self) -> DVec2 {
        self.max - self.min
    }
}

impl PictureFrame {
    /// Of a part turned by `angle` [rad], both as the plan has it; `flip`: for an M4 spindle.
    pub(crate) fn turned(angle: f64, flip: bool) -> PictureFrame {
        PictureFrame { turn: DVec2::from_angle(angle), flip, scale: 1.0, zero: [0.0, 0.0] }
    }

    /// The same so that a window fits a box of the picture, corner and size [px]; the height that it takes there [px].
    pub(crate) fn fitted(self, window: &Window, corner: [f64; 2], size: [f64; 2]) -> (PictureFrame, f64) {
        let span = window.size().max(DVec2::splat(1e-9));
        let scale = (size[0] / span.x).min(size[1] / span.y);
        let aside = 0.5 * (size[0] - scale * span.x);
        let zero = [corner[0] + aside - scale * window.min.x, corner[1] + scale * window.max.y];
        (PictureFrame { scale, zero, ..self }, scale * span.y)
    }

    /// A point of the plan in the turned frame as the part lies [mm].
    pub(crate) fn lies(&self, p: DVec2) -> DVec2 {
        let q = self.turn.rotate(p);
        if self.flip { DVec2::new(q.x, -q.y) } else { q }
    }

    /// A point of the plan's turned frame in the picture [px].
    pub(crate) fn of_turned(&self, q: DVec2) -> [f64; 2] {
        self.px(if self.flip { DVec2::new(q.x, -q.y) } else { q })
    }

    /// Whether what turns counter-clockwise in the plan turns clockwise in the picture.
    pub(crate) fn flipped(&self) -> bool {
        self.flip
    }

    /// A point of the turned frame as the part lies [mm], in the picture [px].
    pub(crate) fn px(&self, q: DVec2) -> [f64; 2] {
        [self.zero[0] + self.scale * q.x, self.zero[1] - self.scale * q.y]
    }

    /// A point of the plan in the picture [px].
    pub(crate) fn at(&self, p: DVec2) -> [f64; 2] {
        self.px(self.lies(p))
    }

    /// A direction of the plan in the picture.
    pub(crate) fn along(&self, v: DVec2) -> DVec2 {
        let q = self.lies(v);
        DVec2::new(q.x, -q.y)
    }

    /// Pixels of a millimetre.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }
}

/// The part of an edge from share to share as the data of an SVG path that begins with a move.
pub(crate) fn edge_path(frame: &PictureFrame, edge: &OutlineEdge, from: f64, to: f64) -> String {
    let mut d = String::new();
    let point = |s: f64| {
        let [x, y] = frame.at(edge.at(s));
        format!("{} {}", px(x), px(y))
    };
    d.push('M');
    d.push_str(&point(from));
    edge_on(&mut d, frame, edge, from, to);
    d
}

/// The rest of an edge after its first point.
pub(crate) fn edge_on(d: &mut String, frame: &PictureFrame, edge: &OutlineEdge, from: f64, to: f64) {
    /// An arc of an SVG path must not be half a turn: its side would be open.
    const LARGEST: f64 = TAU / 3.0;
    let point = |s: f64| {
        let [x, y] = frame.at(edge.at(s));
        format!("{} {}", px(x), px(y))
    };
    match edge.turn {
        None => {
            d.push('L');
            d.push_str(&point(to));
        }
        Some(t) => {
            let sweep = t.sweep * (to - from);
            let pieces = (sweep.abs() / LARGEST).ceil().max(1.0);
            let radius = px(t.radius * frame.scale);
            // Up is up: counter-clockwise stays so unless the part is mirrored.
            let flag = u8::from((sweep > 0.0) == frame.flip);
            for k in 1..=pieces as u32 {
                let s = from + (to - from) * f64::from(k) / pieces;
                // Writing to a String cannot fail.
                let _ = write!(d, "A{radius} {radius} 0 0 {flag} {}", point(s));
            }
        }
    }
}
