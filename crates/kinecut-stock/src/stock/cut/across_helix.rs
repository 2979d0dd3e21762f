//! The foot of a tool part on a helix against a line across the tool axis.
//!
//! The ends x(t) -+ q(t) of the chord are sampled in steps of at most two degrees; every extreme of a sample is
//! refined in its bracket by golden section down to a bracket width, and so is a chord that may appear between
//! two samples. With two degrees a step no contact is missed that is wider than a few nanometres.
//!
//! Source: the measurements in spec "sweep", 6 (ii): sampling and refining at two degrees misses nothing and is
//! exact to 5e-7 mm.

use glam::DVec2;

use super::across::{CoveredSpan, Mark};
use super::body::ConvexPart;
use super::piece::MovePiece;
use super::plan::ArcPlan;
use crate::num::minimum::golden;

/// Largest turn between samples [rad].
const STEP: f64 = 0.035;

/// Golden sections of a step: 0.618^34 of 2 x 2 degrees on a radius of 1 m is 6 um, and an extreme is flat.
const SECTIONS: u32 = 34;

/// A chord of the line.
#[derive(Clone, Copy)]
struct Chord {
    t: f64,
    centre: DVec2,
    /// Square of half its length; negative when the disc does not reach the line.
    square: f64,
}

impl Chord {
    /// Coordinate of an end towards a side; where the disc does not reach the line a value below all others that
    /// rises towards the contact.
    fn end(&self, side: f64) -> f64 {
        if self.square >= 0.0 { side * self.centre.x + self.square.sqrt() } else { self.square - 1e12 }
    }
}

/// The spans of the line at `y`, `w` that the foot covers over a run of fractions.
pub(super) fn foot_on_arc(
    part: &ConvexPart,
    arc: &ArcPlan,
    piece: &MovePiece,
    run: (f64, f64),
    y: f64,
    w: f64,
    mut each: impl FnMut(CoveredSpan),
) {
    let chord = |t: f64| {
        let centre = arc.centre + DVec2::from_angle(arc.angle + arc.sweep * t) * arc.radius;
        let (rho, d) = (part.radius((w - piece.tip(t)).clamp(part.z0, part.top)), y - centre.y);
        Chord { t, centre, square: (rho - d) * (rho + d) }
    };
    let n = ((run.1 - run.0) * arc.sweep.abs() / STEP).ceil().clamp(2.0, 1e4) as u32;
    let node = |i: u32| if i == n { run.1 } else { run.0 + (run.1 - run.0) * f64::from(i) / f64::from(n) };
    let mut open: Option<[Chord; 2]> = None;
    let mut close = |ends: [Chord; 2]| {
        let mark = |c: Chord, side: f64| {
            let half = c.square.clamp(0.0, f64::INFINITY).sqrt();
            let e = DVec2::new(side * half, y - c.centre.y).try_normalize().unwrap_or(DVec2::X * side);
            let way = DVec2::from_angle(arc.angle + arc.sweep * c.t).perp() * arc.sweep;
            Mark { x: c.centre.x + side * half, e, t: c.t, left: way.perp_dot(e) > 0.0 }
        };
        each(CoveredSpan { lo: mark(ends[0], -1.0), hi: mark(ends[1], 1.0) });
    };
    let widen = |open: &mut Option<[Chord; 2]>, c: Chord| {
        let [lo, hi] = open.get_or_insert([c, c]);
        if c.end(-1.0) > lo.end(-1.0) {
            *lo = c;
        }
        if c.end(1.0) > hi.end(1.0) {
            *hi = c;
        }
    };
    let (mut before, mut here) = (None, chord(node(0)));
    for i in 0..=n {
        let after = (i < n).then(|| chord(node(i + 1)));
        let (l, r) = (before.unwrap_or(here), after.unwrap_or(here));
        if here.square >= 0.0 {
            widen(&mut open, here);
            for side in [-1.0, 1.0] {
                if here.end(side) >= l.end(side) && here.end(side) >= r.end(side) {
                    widen(&mut open, greatest(chord, l.t, r.t, |c| c.end(side)));
                }
            }
        } else {
            if let Some(ends) = open.take() {
                close(ends);
            }
            // A chord may live between the neighbours of this sample only.
            if here.square >= l.square && here.square >= r.square {
                let best = greatest(chord, l.t, r.t, |c| c.square);
                if best.square > 0.0 {
                    close([-1.0, 1.0].map(|side| greatest(chord, l.t, r.t, |c| c.end(side))));
                }
            }
        }
        (before, here) = (Some(here), r);
    }
    if let Some(ends) = open {
        close(ends);
    }
}

/// The chord of the greatest value between two fractions.
fn greatest(chord: impl Fn(f64) -> Chord, a: f64, b: f64, value: impl Fn(&Chord) -> f64) -> Chord {
    golden([a, b], SECTIONS, chord, |c| -value(c))
}
