//! The way of the cutter's centre with its times, and when it first meets a point.

use glam::DVec2;

use super::MilledFace;
use crate::facing::MillingWay;
use crate::geom::OutlineEdge;

/// Chains of the cutter's centre in feed: places in the plan's frame [mm] and times [s].
pub(crate) type Timed = Vec<Vec<(DVec2, f64)>>;

/// Largest turn of a chord of an arc [rad]: a tenth of a pixel on a page.
const TURN: f64 = 0.03;

/// The way at feed and rapid from time 0.
pub(super) fn timed(face: &MilledFace<'_>, way: &MillingWay) -> Timed {
    let mut time = 0.0;
    let mut last: Option<DVec2> = None;
    let mut all = Vec::new();
    for chain in &way.path.chains {
        let Some(first) = chain.first() else { continue };
        if let Some(last) = last {
            time += last.distance(first.start) / face.rapid;
        }
        let mut points = vec![(first.start, time)];
        for piece in chain {
            let steps = chords(piece);
            for k in 1..=steps {
                let s = f64::from(k) / f64::from(steps);
                points.push((piece.at(s), time + s * piece.length() / face.feed));
            }
            time += piece.length() / face.feed;
            last = Some(piece.end);
        }
        all.push(points);
    }
    all
}

fn chords(piece: &OutlineEdge) -> u32 {
    piece.turn.map_or(1, |t| (t.sweep.abs() / TURN).ceil().max(1.0) as u32)
}

/// When the cutter first covers a point of the plan; none if it never does.
pub(crate) fn first_met(chains: &Timed, point: DVec2, radius: f64) -> Option<f64> {
    for chain in chains {
        let (start, time) = *chain.first()?;
        if start.distance(point) < radius {
            return Some(time);
        }
        for w in chain.windows(2) {
            let ((a, ta), (b, tb)) = (w[0], w[1]);
            let (way, to) = (b - a, a - point);
            // |to + s way| = radius, the lesser s.
            let (p, q) = (way.length_squared(), way.dot(to));
            let square = q * q - p * (to.length_squared() - radius * radius);
            if !(p > 0.0 && square >= 0.0) {
                continue;
            }
            let s = (-q - square.sqrt()) / p;
            if (0.0..=1.0).contains(&s) {
                return Some(ta + s * (tb - ta));
            }
        }
    }
    None
}
