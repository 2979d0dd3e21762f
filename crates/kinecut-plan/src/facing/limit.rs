//! The limit of infinitely many teeth: bad stretches of straight and circular edges under one straight pass, in
//! closed form.
//!
//! A point of the edge at height `y` is met by the front of the cutter at the polar angle theta, sin theta = (y - c)/R;
//! its exit angle is theta - nu, nu the outward normal's direction. A bad interval of exit angles therefore cuts a
//! straight edge along two lines parallel to the feed, and a circular one at the roots of A sin phi + B cos phi = C.
//! Kryzhanivskyi and Kryzhanivska 2011 hold that no closed form exists.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::level::{direction, level, meetings};
use super::{BadPart, FaceCase, Placement};
use crate::geom::{OutlineEdge, Turn};
use crate::num::angle::wrap;

/// The half of the cutter that meets the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sweep {
    /// The half ahead of the centre: it removes the stock.
    Front,
    /// The half behind the centre: it cuts again where the spindle is not tilted.
    Back,
}

/// A stretch of an edge where the exit is bad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BadStretch {
    /// Share of the edge's length where it begins.
    pub from: f64,
    /// Share of the edge's length where it ends.
    pub to: f64,
    /// Weight of a millimetre for its exit angle, without the edge's own weight.
    pub weight: f64,
}

/// Lengths and angles below this, per size, are zero: rounding of coordinates.
const ZERO: f64 = 1e-12;

/// The weighted length of bad exits of one straight pass [mm], in the limit of infinitely many teeth.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::{BadSet, FaceCase, Placement, bad_length};
/// use kinecut::geom::Outline;
/// // A plate of 100 x 60 fed lengthwise, cutter centred.
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
/// let case = FaceCase::new(plate, 50.0, BadSet::below(90f64.to_radians())?)?;
/// let bad = bad_length(&case, Placement { angle: 0.0, offset: 30.0 });
/// assert!((bad - 130.0).abs() < 1e-9);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn bad_length(case: &FaceCase, placement: Placement) -> f64 {
    let edges = case.outline.edges().iter().zip(&case.weights);
    edges
        .map(|(edge, weight)| {
            let mut sum = 0.0;
            bad_stretches(edge, case, placement, Sweep::Front, 0.0, |b| sum += (b.to - b.from) * b.weight);
            sum * edge.length() * weight
        })
        .sum()
}

/// The length with a bad exit in the front or in the back pass, each stretch counted once with its worse weight [mm].
pub fn either_bad_length(case: &FaceCase, placement: Placement) -> f64 {
    let mut total = 0.0;
    let mut both: [Vec<BadStretch>; 2] = Default::default();
    for (edge, weight) in case.outline.edges().iter().zip(&case.weights) {
        for (own, sweep) in both.iter_mut().zip([Sweep::Front, Sweep::Back]) {
            own.clear();
            bad_stretches(edge, case, placement, sweep, 0.0, |b| own.push(b));
        }
        let mut cuts: Vec<f64> = both.iter().flatten().flat_map(|b| [b.from, b.to]).collect();
        cuts.sort_by(f64::total_cmp);
        for w in cuts.windows(2) {
            let middle = 0.5 * (w[0] + w[1]);
            let here = |own: &Vec<BadStretch>| -> f64 {
                own.iter().filter(|b| b.from < middle && middle < b.to).map(|b| b.weight).sum()
            };
            let [front, back] = [here(&both[0]), here(&both[1])];
            total += if front > back { front } else { back } * (w[1] - w[0]) * edge.length() * weight;
        }
    }
    total
}

/// Calls `found` with each stretch of an edge of `case.outline` where one straight pass leaves a bad exit, in no
/// particular order. Where bad intervals of unlike weights touch, stretches lie over each other, and their weights add
/// up. `rho`: feed per radian over the cutter's radius, 0 for the
/// circle.
pub fn bad_stretches(
    edge: &OutlineEdge,
    case: &FaceCase,
    placement: Placement,
    sweep: Sweep,
    rho: f64,
    mut found: impl FnMut(BadStretch),
) {
    for part in case.bad.layers() {
        stretches_in(edge, case.radius, placement, *part, sweep, rho, &mut found);
    }
}

/// The stretches of an edge with exit angles in one interval.
pub(super) fn stretches_in(
    edge: &OutlineEdge,
    radius: f64,
    placement: Placement,
    part: BadPart,
    sweep: Sweep,
    rho: f64,
    found: &mut impl FnMut(BadStretch),
) {
    match &edge.turn {
        None => straight(edge, radius, placement, part, sweep, rho, found),
        Some(turn) => circular(turn, radius, placement, part, sweep, rho, found),
    }
}

fn straight(
    edge: &OutlineEdge,
    radius: f64,
    placement: Placement,
    part: BadPart,
    sweep: Sweep,
    rho: f64,
    found: &mut impl FnMut(BadStretch),
) {
    let (sin, cos) = placement.angle.sin_cos();
    let height = |p: glam::DVec2| sin * p.x + cos * p.y;
    let (ya, yb) = (height(edge.start), height(edge.end));
    let length = edge.length();
    let beta = wrap(edge.heading(0.0) + placement.angle);
    let (first, last) = match sweep {
        Sweep::Front => (-PI, 0.0),
        Sweep::Back => (0.0, PI),
    };
    for turn in [-TAU, 0.0, TAU] {
        let (lo, hi) = (beta + part.from + turn, beta + part.to + turn);
        let (lo, hi) = (if lo > first { lo } else { first }, if hi < last { hi } else { last });
        if !(hi > lo + 1e-3 * ZERO) {
            continue;
        }
        let (e1, e2) = (level(lo, rho), level(hi, rho));
        let (low, high) = if e1 < e2 { (e1, e2) } else { (e2, e1) };
        let (low, high) = (placement.offset + radius * low, placement.offset + radius * high);
        let rise = yb - ya;
        if rise.abs() <= ZERO * length {
            let y = 0.5 * (ya + yb);
            let near = ZERO * if radius > length { radius } else { length };
            if low + near < y && y < high - near {
                found(BadStretch { from: 0.0, to: 1.0, weight: part.weight });
            }
            continue;
        }
        let (s, t) = ((low - ya) / rise, (high - ya) / rise);
        let (s, t) = if s < t { (s, t) } else { (t, s) };
        let (from, to) = (if s > 0.0 { s } else { 0.0 }, if t < 1.0 { t } else { 1.0 });
        if to > from {
            found(BadStretch { from, to, weight: part.weight });
        }
    }
}

fn circular(
    turn: &Turn,
    radius: f64,
    placement: Placement,
    part: BadPart,
    sweep: Sweep,
    rho: f64,
    found: &mut impl FnMut(BadStretch),
) {
    let (sin, cos) = placement.angle.sin_cos();
    // Height of the arc's centre over the centre line, and the polar angle of its first point in the machine frame.
    let rise = sin * turn.centre.x + cos * turn.centre.y - placement.offset;
    let from = turn.from + placement.angle;
    let to_normal = if turn.convex() { 0.0 } else { PI };
    let side = if turn.convex() { 1.0 } else { -1.0 };
    let span = turn.sweep.abs();
    // Break points as angles gone from the first point.
    let mut breaks = Breaks { few: [0.0; BREAKS], count: 0, many: Vec::new() };
    breaks.add(0.0);
    breaks.add(span);
    let mut at = |phi: f64| {
        let gone = if turn.sweep > 0.0 { phi - from } else { from - phi };
        let gone = gone.rem_euclid(TAU);
        if gone < span {
            breaks.add(gone);
        }
    };
    for psi in [part.from, part.to] {
        if rho > 0.0 {
            // The velocity has the direction heading + psi.
            let heading = FRAC_PI_2.copysign(turn.sweep);
            meetings(rise / radius, turn.radius / radius, rho, heading + psi, &mut at);
            continue;
        }
        // R sin(phi + to_normal + psi) = rise + radius_arc sin(phi)
        let (a, b) = (side * radius * psi.cos() - turn.radius, side * radius * psi.sin());
        let size = a.hypot(b);
        if size > 0.0 && rise.abs() <= size {
            let (base, w) = (b.atan2(a), (rise / size).asin());
            at(w - base);
            at(PI - w - base);
        }
    }
    for edge in [radius, -radius] {
        let s = (edge - rise) / turn.radius;
        if s.abs() < 1.0 {
            at(s.asin());
            at(PI - s.asin());
        }
    }
    let breaks = breaks.sorted();
    for w in breaks.windows(2).filter(|w| w[1] - w[0] > ZERO) {
        let phi = from + 0.5 * (w[0] + w[1]) * turn.sweep.signum();
        let eta = (rise + turn.radius * phi.sin()) / radius;
        if !(eta.abs() < 1.0) {
            continue;
        }
        let heading = phi + to_normal - FRAC_PI_2;
        if inside(direction(eta, rho, sweep == Sweep::Front) - heading, part) {
            found(BadStretch { from: w[0] / span, to: w[1] / span, weight: part.weight });
        }
    }
}

/// Exit angle at the share of an edge of the outline under the front of a circle, in (-pi, pi] [rad]; places beyond
/// the cutter are taken at its side.
pub(super) fn exit_angle(edge: &OutlineEdge, share: f64, radius: f64, placement: Placement) -> f64 {
    let (sin, cos) = placement.angle.sin_cos();
    let point = edge.at(share);
    let eta = (sin * point.x + cos * point.y - placement.offset) / radius;
    wrap(direction(eta, 0.0, true) - edge.heading(share) - placement.angle)
}

/// Most breaks of an arc under a circle: its ends, two for each end of the interval, two for each side of the cutter.
const BREAKS: usize = 10;

/// Break points of an arc; trochoids may have more than circles.
struct Breaks {
    few: [f64; BREAKS],
    count: usize,
    many: Vec<f64>,
}

impl Breaks {
    fn add(&mut self, gone: f64) {
        if self.count < BREAKS {
            self.few[self.count] = gone;
        } else {
            if self.many.is_empty() {
                self.many.extend_from_slice(&self.few);
            }
            self.many.push(gone);
        }
        self.count += 1;
    }

    fn sorted(&mut self) -> &[f64] {
        let breaks = if self.many.is_empty() { &mut self.few[..self.count] } else { &mut self.many[..] };
        breaks.sort_by(f64::total_cmp);
        breaks
    }
}

/// True if an exit angle lies in the interval, whole turns aside.
fn inside(psi: f64, part: BadPart) -> bool {
    // Bad intervals lie within -pi/2 .. 3 pi/2: a guard is less than a quarter turn.
    let psi = wrap(psi - FRAC_PI_2) + FRAC_PI_2;
    part.from < psi && psi < part.to
}
