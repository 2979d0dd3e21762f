//! Places of a drawing's parts on the paper: scale, breaks, lanes of dimension lines, the column of words.

use super::lanes::{Placed, place};
use super::{Along, Angle, Callout, Dimension, Drawing, words};
use crate::page::draw::spread;

/// Least width of the paper, and that on a phone [px].
pub(crate) const WIDTHS: [f64; 2] = [380.0, 296.0];
/// Greatest height of what is drawn [px].
const TALLEST: f64 = 540.0;
/// Room at the edges [px].
pub(crate) const MARGIN: f64 = 5.0;
/// Distance of two lanes [px].
const LANE: f64 = 17.0;
/// Room between drawing and the first lane [px].
const FIRST_LANE: f64 = 9.0;
/// Gap of a break [px].
pub(crate) const BREAK: f64 = 16.0;
/// Height of a line of words [px].
pub(crate) const LINE: f64 = 14.0;
/// Room between the drawing and the column of words, for the leaders [px].
const LEADER: f64 = 18.0;
/// Least width for what is drawn [px].
const NARROWEST: f64 = 125.0;
/// Distance of a dimension line from the line that it measures [px].
const BESIDE: f64 = 9.0;

/// A stretch of y that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Band {
    /// Lowest and highest y [mm].
    pub(crate) y: [f64; 2],
    /// Upper end [px].
    pub(crate) top: f64,
    /// Height [px].
    pub(crate) height: f64,
}

/// Words in the column.
pub(crate) struct Words<'a> {
    /// Start of the leader [px].
    pub(crate) at: [f64; 2],
    /// Whether that is a point to see.
    pub(crate) point: bool,
    /// The lines.
    pub(crate) lines: Vec<&'a str>,
    /// Middle in the column [px].
    pub(crate) middle: f64,
}

/// The paper.
pub(crate) struct Layout<'a> {
    /// Width of the paper [px].
    pub(crate) width: f64,
    /// px per mm.
    pub(crate) scale: f64,
    /// Left and right end of what is drawn [px].
    pub(crate) x: [f64; 2],
    /// x at the left end [mm].
    x0: f64,
    /// The bands, top down.
    pub(crate) bands: Vec<Band>,
    /// Upright dimension lines with their lanes.
    pub(crate) left: Vec<(&'a Dimension, Placed)>,
    /// Level ones above.
    pub(crate) above: Vec<(&'a Dimension, Placed)>,
    /// And below.
    pub(crate) below: Vec<(&'a Dimension, Placed)>,
    /// Those along lines: the ends of the dimension line [px].
    pub(crate) along: Vec<(&'a Dimension, [[f64; 2]; 2])>,
    /// Words in the column, top down.
    pub(crate) column: Vec<Words<'a>>,
    /// Upper and lower end of everything [px].
    pub(crate) extent: [f64; 2],
}

impl<'a> Layout<'a> {
    /// The layout for a width [px]; `None` when there is nothing to draw.
    pub(crate) fn new(drawing: &'a Drawing, width: f64) -> Option<Layout<'a>> {
        let [low, high] = drawing.window;
        let (wide, tall) = (high[0] - low[0], high[1] - low[1]);
        if !(wide.is_finite() && tall.is_finite() && wide > 0.0 && tall > 0.0) {
            return None;
        }
        let left_spans: Vec<&Dimension> = drawing.spans.iter().filter(|s| s.along == Along::Left).collect();
        let spare = words_width(drawing);
        let mut lanes = usize::from(!left_spans.is_empty());
        // Each round needs more lanes than the one before, and never more than there are dimension lines.
        loop {
            let left = MARGIN + if lanes > 0 { FIRST_LANE + LANE * lanes as f64 - 2.0 } else { 0.0 };
            let right = (width - MARGIN - spare).max(left + NARROWEST);
            let (bands, scale) = bands(drawing, right - left);
            let x0 = (low[0] + high[0] - (right - left) / scale) / 2.0;
            let mut layout = Layout {
                width: right + spare + MARGIN,
                scale,
                x: [left, right],
                x0,
                bands,
                left: Vec::new(),
                above: Vec::new(),
                below: Vec::new(),
                along: Vec::new(),
                column: Vec::new(),
                extent: [0.0; 2],
            };
            layout.extent[1] = layout.bottom();
            layout.left = layout.upright(&left_spans);
            let needed = layout.left.iter().map(|(_, p)| p.lane + 1).max().unwrap_or(0);
            if needed > lanes && lanes < left_spans.len() {
                lanes = needed;
                continue;
            }
            layout.level(drawing);
            layout.fill_column(drawing);
            return Some(layout);
        }
    }

    /// x [px].
    pub(crate) fn px(&self, x: f64) -> f64 {
        self.x[0] + (x - self.x0) * self.scale
    }

    /// y [px]; a place in a break is put in its gap.
    pub(crate) fn py(&self, y: f64) -> f64 {
        for (i, band) in self.bands.iter().enumerate() {
            if y >= band.y[0] {
                let at = band.py(y, self.scale);
                return if i > 0 && at < band.top { band.top - BREAK / 2.0 } else { at };
            }
        }
        self.bands.last().map_or(0.0, |b| b.py(y, self.scale))
    }

    /// Lower end of what is drawn [px].
    pub(crate) fn bottom(&self) -> f64 {
        self.bands.last().map_or(0.0, |b| b.top + b.height)
    }

    /// Height of the paper [px].
    pub(crate) fn height(&self) -> f64 {
        self.extent[1] - self.extent[0] + 2.0 * MARGIN
    }

    /// x of an upright lane [px].
    pub(crate) fn lane_x(&self, lane: usize) -> f64 {
        self.x[0] - FIRST_LANE - LANE * lane as f64
    }

    /// y of a level lane above or below [px].
    pub(crate) fn lane_y(&self, along: Along, lane: usize) -> f64 {
        let out = FIRST_LANE + 4.0 + LANE * lane as f64;
        if along == Along::Above { -out } else { self.bottom() + out + 4.0 }
    }

    /// Left end of the column of words [px].
    pub(crate) fn column_x(&self) -> f64 {
        self.x[1] + LEADER
    }

    fn upright(&mut self, spans: &[&'a Dimension]) -> Vec<(&'a Dimension, Placed)> {
        let wanted: Vec<_> =
            spans.iter().map(|s| ([self.py(s.from[1]), self.py(s.to[1])], words::width(&s.text))).collect();
        let placed = place(&wanted, 0.0, self.bottom());
        for (p, (_, width)) in placed.iter().zip(&wanted) {
            self.grow(p.middle - width / 2.0, p.middle + width / 2.0);
            self.grow(p.from, p.to);
        }
        spans.iter().copied().zip(placed).collect()
    }

    fn level(&mut self, drawing: &'a Drawing) {
        for along in [Along::Above, Along::Below] {
            let spans: Vec<&Dimension> = drawing.spans.iter().filter(|s| s.along == along).collect();
            let wanted: Vec<_> = spans
                .iter()
                .map(|s| ([self.px(s.from[0]), self.px(s.to[0])], words::width(&s.text)))
                .collect();
            let placed = place(&wanted, self.x[0], self.width);
            for p in &placed {
                let y = self.lane_y(along, p.lane);
                self.grow(y - LINE - 2.0, y + 4.0);
            }
            let placed = spans.into_iter().zip(placed).collect();
            if along == Along::Above { self.above = placed } else { self.below = placed }
        }
        for span in drawing.spans.iter().filter(|s| s.along == Along::Line) {
            let ends = [span.from, span.to].map(|p| [self.px(p[0]), self.py(p[1])]);
            let (dx, dy) = (ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
            let length = dx.hypot(dy);
            if length > 0.0 {
                // To the right of the way from the first end to the second.
                let out = [-dy / length * BESIDE, dx / length * BESIDE];
                self.along.push((span, ends.map(|p| [p[0] + out[0], p[1] + out[1]])));
            }
        }
    }

    fn fill_column(&mut self, drawing: &'a Drawing) {
        let mut column_words: Vec<Words> = Vec::new();
        let mut add = |at: [f64; 2], point: bool, lines: Vec<&'a str>| {
            if at.iter().all(|v| v.is_finite()) {
                column_words.push(Words { at, point, lines, middle: 0.0 });
            }
        };
        for c in &drawing.callouts {
            let at = [self.px(c.at[0]), self.py(c.at[1])];
            add(at, c.point, c.lines.iter().map(String::as_str).collect());
        }
        for a in &drawing.angles {
            add(self.arc_end(a), false, vec![&a.text]);
        }
        for (span, [a, b]) in &self.along {
            add([(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0], false, vec![&span.text]);
        }
        column_words.sort_by(|a, b| a.at[1].total_cmp(&b.at[1]));
        let height = |w: &Words| LINE * w.lines.len() as f64 + 5.0;
        let wanted: Vec<_> = column_words.iter().map(|w| (w.at[1], height(w))).collect();
        for (w, middle) in column_words.iter_mut().zip(spread(&wanted)) {
            w.middle = middle;
        }
        for w in &column_words {
            self.grow(w.middle - height(w) / 2.0, w.middle + height(w) / 2.0);
        }
        self.column = column_words;
    }

    /// The point of an angle's arc farthest to the right [px].
    fn arc_end(&self, a: &Angle) -> [f64; 2] {
        // The direction nearest to straight right.
        let turn = std::f64::consts::TAU;
        let right = (a.from / turn).ceil() * turn;
        let to = if right <= a.to {
            right
        } else if a.from.cos() > a.to.cos() {
            a.from
        } else {
            a.to
        };
        [self.px(a.at[0] + a.radius * to.cos()), self.py(a.at[1] + a.radius * to.sin())]
    }

    fn grow(&mut self, top: f64, bottom: f64) {
        self.extent = [self.extent[0].min(top), self.extent[1].max(bottom)];
    }
}

impl Band {
    /// y [px]; beyond the band it runs on.
    pub(crate) fn py(&self, y: f64, scale: f64) -> f64 {
        self.top + (self.y[1] - y) * scale
    }
}

/// Width of the column with its leaders [px].
fn words_width(drawing: &Drawing) -> f64 {
    let lines = drawing.callouts.iter().flat_map(|c: &Callout| &c.lines);
    let angles = drawing.angles.iter().map(|a| &a.text);
    let along = drawing.spans.iter().filter(|s| s.along == Along::Line).map(|s| &s.text);
    let widest = lines.chain(angles).chain(along).map(|t| words::width(t)).fold(0.0, f64::max);
    if widest > 0.0 { widest + LEADER } else { 0.0 }
}

/// The stretches that are drawn, and the scale.
fn bands(drawing: &Drawing, wide: f64) -> (Vec<Band>, f64) {
    let [low, high] = drawing.window;
    let mut edges = vec![high[1]];
    let mut breaks: Vec<[f64; 2]> = drawing.breaks.clone();
    breaks.sort_by(|a, b| b[1].total_cmp(&a[1]));
    for [from, to] in breaks {
        // Breaks follow one another from the top and leave something to see.
        if to < edges[edges.len() - 1] && from > low[1] && from < to {
            edges.extend([to, from]);
        }
    }
    edges.push(low[1]);
    let shown: f64 = edges.chunks_exact(2).map(|e| e[0] - e[1]).sum();
    let gaps = BREAK * (edges.len() / 2 - 1) as f64;
    let scale = (wide / (high[0] - low[0])).min((TALLEST - gaps) / shown);
    let mut top = 0.0;
    let mut bands = Vec::new();
    for e in edges.chunks_exact(2) {
        let height = (e[0] - e[1]) * scale;
        bands.push(Band { y: [e[1], e[0]], top, height });
        top += height + BREAK;
    }
    (bands, scale)
}
