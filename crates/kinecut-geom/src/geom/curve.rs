//! Curves in space, parametrised by arc length, with derivatives to the third.

use std::sync::{Arc as Shared, OnceLock};

use glam::{DVec2, DVec3};

use super::spiral::{Places, by_arc_length};
use super::{Aabb, Arc, CubicSpan, InvoluteRecord, Jet, Line, PlanarJet, Rigid, Rise, Spiral};
use crate::num::quadrature::gauss;
use crate::num::root::bracketed_newton;
use crate::num::taylor::Taylor;

/// The exact curve of a move. Nothing turns it into chords before a writer or the simulator does.
///
/// Programs are mostly lines, a million and more: these are kept as they are, what is larger is shared by its copies.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    kind: Kept,
    length: f64,
}

/// A kind as it is kept.
#[derive(Clone, Debug, PartialEq)]
enum Kept {
    Line(Line),
    Other(Shared<Other>),
}

/// A curve that is no line.
#[derive(Clone, Debug)]
struct Other {
    kind: CurveKind,
    /// Places along a spiral that was looked at.
    places: OnceLock<Places>,
}

impl PartialEq for Other {
    fn eq(&self, other: &Other) -> bool {
        self.kind == other.kind
    }
}

/// The kind of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurveKind {
    /// A straight line.
    Line(Line),
    /// A circular arc or helix about any axis.
    Arc(Arc),
    /// A circle involute in a plane parallel to `frame`'s XY plane, with a constant rise along `frame`'s Z.
    Involute {
        /// The planar curve.
        record: InvoluteRecord,
        /// Plane: maps the record's plane (x, y, 0) into space.
        frame: Rigid,
        /// Total rise along the plane's normal [mm], in proportion to planar arc length.
        rise: f64,
    },
    /// A spiral in a plane parallel to `frame`'s XY plane, rising along `frame`'s Z.
    Spiral {
        /// The planar curve.
        spiral: Spiral,
        /// Plane: maps the spiral's plane (x, y, 0) into space.
        frame: Rigid,
        /// Rise along the plane's normal, by planar arc length.
        rise: Rise,
    },
    /// A cubic Bezier curve in the XY plane of `frame`.
    Bezier {
        /// The planar curve.
        span: CubicSpan,
        /// Plane: maps the curve's plane (x, y, 0) into space.
        frame: Rigid,
    },
}

/// The length of a spiral in space, up to a planar arc length [mm].
fn length_in_space(spiral: &Spiral, rise: &Rise, planar: f64) -> f64 {
    let whole = spiral.length();
    if let Some(rise) = rise.is_even() {
        return planar * (1.0f64).hypot(rise / whole);
    }
    /// Four panels of 16 points over the polynomial slopes of a rise: exact to rounding up to slopes of 45 degrees.
    const PANELS: f64 = 4.0;
    gauss(0.0, planar, whole / PANELS, |s| 1f64.hypot(rise.series::<2>(s / whole).derivative(1) / whole))
}

/// A planar jet in space.
fn lifted(j: &PlanarJet, frame: &Rigid, z: f64) -> Jet {
    let lift = |v: DVec2| frame.vector(v.extend(0.0));
    Jet { p: frame.point(j.p.extend(z)), d1: lift(j.d1), d2: lift(j.d2), d3: lift(j.d3) }
}

/// A planar jet in space at an arc length `s` [mm] in space, where the curve rises by `slope` and advances by `c` in its plane
/// for each length in space: each derivative is scaled by its power.
fn risen(j: &PlanarJet, frame: &Rigid, c: f64, slope: f64, s: f64) -> Jet {
    let lift = |v: DVec2, z: f64| frame.vector(v.extend(z));
    Jet {
        p: frame.point(j.p.extend(s * slope)),
        d1: lift(j.d1 * c, slope),
        d2: lift(j.d2 * (c * c), 0.0),
        d3: lift(j.d3 * (c * c * c), 0.0),
    }
}

/// The planar arc length of a spiral at a length in space [mm].
fn planar_length(spiral: &Spiral, rise: &Rise, s: f64, length: f64) -> f64 {
    let whole = spiral.length();
    if rise.is_even().is_some() || s <= 0.0 || s >= length {
        return whole * (s / length);
    }
    let f = |planar: f64| {
        let slope = rise.series::<2>(planar / whole).derivative(1) / whole;
        (length_in_space(spiral, rise, planar) - s, 1f64.hypot(slope))
    };
    /// Newton on a nearly linear function.
    const STEPS: u32 = 40;
    bracketed_newton(f, whole * (s / length), 0.0, whole, STEPS).0
}

/// Point of a spiral in space as a series by arc length, at a planar length and its parameter, in the coordinates of its
/// plane.
fn spiral_series<const N: usize>(spiral: &Spiral, rise: &Rise, planar: f64, u: f64) -> [Taylor<N>; 3] {
    let [x, y] = spiral.arc_series::<N>(u);
    let whole = spiral.length();
    let mut fraction = Taylor::<N>::constant(planar / whole);
    if N > 1 {
        fraction.0[1] = 1.0 / whole;
    }
    let z = rise.series::<N>(planar / whole).compose(&fraction);
    by_arc_length([x, y, z], 1.0)
}

impl From<Line> for Curve {
    #[inline]
    fn from(line: Line) -> Curve {
        Curve { kind: Kept::Line(line), length: line.length() }
    }
}

impl From<Arc> for Curve {
    fn from(arc: Arc) -> Curve {
        Curve::of(CurveKind::Arc(arc), arc.length())
    }
}

impl Curve {
    /// A circle involute at height `z`, in a plane parallel to XY.
    pub fn involute(record: InvoluteRecord, z: f64, rise: f64) -> Curve {
        Curve::involute_in(record, Rigid::from_translation(DVec3::new(0.0, 0.0, z)), rise)
    }

    /// A circle involute in the XY plane of `frame`.
    pub fn involute_in(record: InvoluteRecord, frame: Rigid, rise: f64) -> Curve {
        Curve::of(CurveKind::Involute { record, frame, rise }, record.length().hypot(rise))
    }

    /// A spiral at height `z` at its start, in a plane parallel to XY.
    pub fn spiral(spiral: Spiral, z: f64, rise: Rise) -> Curve {
        Curve::spiral_in(spiral, Rigid::from_translation(DVec3::new(0.0, 0.0, z)), rise)
    }

    /// A spiral in the XY plane of `frame`.
    pub fn spiral_in(spiral: Spiral, frame: Rigid, rise: Rise) -> Curve {
        let length = length_in_space(&spiral, &rise, spiral.length());
        Curve::of(CurveKind::Spiral { spiral, frame, rise }, length)
    }

    /// A cubic Bezier curve at height `z`, in a plane parallel to XY.
    pub fn cubic(span: CubicSpan, z: f64) -> Curve {
        let frame = Rigid::from_translation(DVec3::new(0.0, 0.0, z));
        Curve::of(CurveKind::Bezier { span, frame }, span.length())
    }

    fn of(kind: CurveKind, length: f64) -> Curve {
        let kind = match kind {
            CurveKind::Line(line) => Kept::Line(line),
            other => Kept::Other(Shared::new(Other { kind: other, places: OnceLock::new() })),
        };
        Curve { kind, length }
    }

    /// The kind, with its numbers.
    #[inline]
    pub fn kind(&self) -> CurveKind {
        match &self.kind {
            Kept::Line(line) => CurveKind::Line(*line),
            Kept::Other(other) => other.kind,
        }
    }

    /// Parameter of a spiral at a planar arc length [mm].
    fn parameter(&self, spiral: &Spiral, planar: f64) -> f64 {
        match &self.kind {
            Kept::Other(other) => other.places.get_or_init(|| Places::of(spiral)).parameter(spiral, planar),
            Kept::Line(_) => spiral.parameter(planar),
        }
    }

    /// Arc length [mm].
    #[inline]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// A bound on the second derivative by `t` [mm] of the place at `t` times the length, for `t` between two of 0 to 1. Strict, but
    /// for spirals and cubics, whose curvature is sampled.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use glam::DVec3;
    /// use kinecut::geom::{Arc, Curve};
    /// let quarter = std::f64::consts::FRAC_PI_2;
    /// let arc = Curve::from(Arc::new(DVec3::X * 8.0, DVec3::ZERO, DVec3::Z, quarter, 0.0).unwrap());
    /// assert!((arc.most_bend(0.0, 1.0) - 8.0 * quarter * quarter).abs() < 1e-12); // r angle^2
    /// ```
    pub fn most_bend(&self, from: f64, to: f64) -> f64 {
        /// Places at which a curvature is taken.
        const SAMPLES: usize = 32;
        /// Factor by which a sampled one is enlarged.
        const RESERVE: f64 = 1.5;
        let length = self.length();
        let at = |t: f64| self.at(t * length).d2.length();
        let curvature = match self.kind() {
            CurveKind::Line(_) => 0.0,
            CurveKind::Arc(_) => at(0.0),
            // Its radius grows steadily.
            CurveKind::Involute { .. } => at(from).max(at(to)),
            _ => {
                let sample = |i: usize| at(from + (to - from) * i as f64 / SAMPLES as f64);
                RESERVE * (0..=SAMPLES).map(sample).filter(|k| k.is_finite()).fold(0.0, f64::max)
            }
        };
        curvature * length * length
    }

    /// True if [`Curve::most_bend`] rests on samples.
    pub fn is_bend_sampled(&self) -> bool {
        !matches!(self.kind(), CurveKind::Line(_) | CurveKind::Arc(_) | CurveKind::Involute { .. })
    }

    /// Point and derivatives at arc length `s` [mm] in `[0, length]`. A curve of no length has zero derivatives.
    pub fn at(&self, s: f64) -> Jet {
        match &self.kind() {
            CurveKind::Line(line) => line.at(s),
            CurveKind::Arc(arc) => arc.at(s),
            CurveKind::Involute { record, frame, rise } => {
                let length = self.length;
                let [c, slope] =
                    if length > 0.0 { [record.length() / length, rise / length] } else { [0.0; 2] };
                risen(&record.at(s * c), frame, c, slope, s)
            }
            CurveKind::Spiral { spiral, frame, rise } => {
                let planar = planar_length(spiral, rise, s, self.length);
                let u = self.parameter(spiral, planar);
                if let Some(rise) = rise.is_even() {
                    let [c, slope] = [spiral.length(), rise].map(|way| way / self.length);
                    return risen(&spiral.at_parameter(u), frame, c, slope, s);
                }
                let [x, y, z] = spiral_series::<4>(spiral, rise, planar, u);
                let order = |k: usize| DVec3::new(x.derivative(k), y.derivative(k), z.derivative(k));
                if !order(2).is_finite() {
                    // A cusp.
                    return lifted(&spiral.at_parameter(u), frame, rise.at(planar / spiral.length()));
                }
                let lift = |k: usize| frame.vector(order(k));
                Jet { p: frame.point(order(0)), d1: lift(1), d2: lift(2), d3: lift(3) }
            }
            CurveKind::Bezier { span, frame } => lifted(&span.at(s), frame, 0.0),
        }
    }

    /// Point and the derivatives by arc length up to order `N - 1` at arc length `s` [mm, 1, 1/mm, ..]: as exact as
    /// [`Curve::at`], to any order. Not numbers at a cusp, but for the point.
    pub fn derivatives<const N: usize>(&self, s: f64) -> [DVec3; N] {
        let zero = Taylor::<N>::constant(0.0);
        let (series, frame) = match &self.kind() {
            CurveKind::Line(line) => {
                let jet = line.at(s);
                let along = jet.d1.to_array().map(|d| {
                    let mut c = zero;
                    if N > 1 {
                        c.0[1] = d;
                    }
                    c
                });
                (along, Rigid::from_translation(jet.p))
            }
            CurveKind::Arc(arc) => (arc.series(s), Rigid::IDENTITY),
            CurveKind::Involute { record, frame, rise } => {
                let c = if self.length > 0.0 { record.length() / self.length } else { 0.0 };
                let slope = if self.length > 0.0 { rise / self.length } else { 0.0 };
                let mut step = Taylor::<N>::constant(s * c);
                let mut z = Taylor::<N>::constant(s * slope);
                if N > 1 {
                    step.0[1] = c;
                    z.0[1] = slope;
                }
                let [x, y] = record.series::<N>(s * c);
                ([x.compose(&step), y.compose(&step), z], *frame)
            }
            CurveKind::Spiral { spiral, frame, rise } => {
                let planar = planar_length(spiral, rise, s, self.length);
                (spiral_series(spiral, rise, planar, self.parameter(spiral, planar)), *frame)
            }
            CurveKind::Bezier { span, frame } => {
                let [x, y] = span.arc_series(span.parameter(s));
                ([x, y, zero], *frame)
            }
        };
        let mut order = 0;
        [(); N].map(|()| {
            let [x, y, z] = series.map(|c| c.derivative(order));
            let v = DVec3::new(x, y, z);
            order += 1;
            if order == 1 { frame.point(v) } else { frame.vector(v) }
        })
    }

    /// First point.
    pub fn start(&self) -> DVec3 {
        self.at(0.0).p
    }

    /// Last point.
    pub fn end(&self) -> DVec3 {
        match &self.kind() {
            CurveKind::Line(line) => line.end,
            _ => self.at(self.length).p,
        }
    }

    /// The same points the other way.
    #[must_use]
    pub fn reversed(&self) -> Curve {
        match &self.kind() {
            CurveKind::Line(line) => Line { start: line.end, end: line.start }.into(),
            CurveKind::Arc(arc) => arc.reversed().into(),
            CurveKind::Involute { record, frame, rise } => {
                let lifted = Rigid { translation: frame.point(DVec3::new(0.0, 0.0, *rise)), ..*frame };
                Curve::involute_in(record.reversed(), lifted, -rise)
            }
            CurveKind::Spiral { spiral, frame, rise } => {
                let lifted = Rigid { translation: frame.point(DVec3::new(0.0, 0.0, rise.total())), ..*frame };
                let (spiral, rise) = (spiral.reversed(), rise.reversed());
                Curve::of(CurveKind::Spiral { spiral, frame: lifted, rise }, self.length)
            }
            CurveKind::Bezier { span, frame } => {
                Curve::of(CurveKind::Bezier { span: span.reversed(), frame: *frame }, self.length)
            }
        }
    }

    /// The part between arc lengths `a <= b` [mm].
    #[must_use]
    pub fn part(&self, a: f64, b: f64) -> Curve {
        match &self.kind() {
            CurveKind::Line(line) => Line { start: line.at(a).p, end: line.at(b).p }.into(),
            CurveKind::Arc(arc) => arc.part(a, b).into(),
            CurveKind::Involute { record, frame, rise } => {
                let (u, v) = (a / self.length, b / self.length);
                let lifted = Rigid { translation: frame.point(DVec3::new(0.0, 0.0, rise * u)), ..*frame };
                let part = record.split(v * record.length()).0.split(u * record.length()).1;
                Curve::involute_in(part, lifted, rise * (v - u))
            }
            CurveKind::Spiral { spiral, frame, rise } => {
                let planar = [a, b].map(|s| planar_length(spiral, rise, s, self.length));
                let [u, v] = planar.map(|s| s / spiral.length());
                let lifted = Rigid { translation: frame.point(DVec3::new(0.0, 0.0, rise.at(u))), ..*frame };
                let part = spiral.between(spiral.parameter(planar[0]), spiral.parameter(planar[1]));
                Curve::spiral_in(part, lifted, rise.part(u, v))
            }
            CurveKind::Bezier { span, frame } => {
                let part = span.between(span.parameter(a), span.parameter(b));
                Curve::of(CurveKind::Bezier { span: part, frame: *frame }, part.length())
            }
        }
    }

    /// The curve moved by a rigid motion.
    #[must_use]
    pub fn moved(&self, motion: &Rigid) -> Curve {
        match &self.kind() {
            CurveKind::Line(line) => {
                Line { start: motion.point(line.start), end: motion.point(line.end) }.into()
            }
            CurveKind::Arc(arc) => arc.moved(motion).into(),
            CurveKind::Involute { record, frame, rise } => {
                Curve::involute_in(*record, motion.after(frame), *rise)
            }
            CurveKind::Spiral { spiral, frame, rise } => {
                let frame = motion.after(frame);
                Curve::of(CurveKind::Spiral { spiral: *spiral, frame, rise: *rise }, self.length)
            }
            CurveKind::Bezier { span, frame } => {
                Curve::of(CurveKind::Bezier { span: *span, frame: motion.after(frame) }, self.length)
            }
        }
    }

    /// Points of a polyline that leaves the curve by at most `chord` [mm], both ends included.
    pub fn polyline(&self, chord: f64) -> Vec<DVec3> {
        let turn = match &self.kind() {
            CurveKind::Line(_) => return vec![self.start(), self.end()],
            CurveKind::Spiral { spiral, frame, rise } => {
                return spiral_polyline(spiral, rise, chord).into_iter().map(|p| frame.point(p)).collect();
            }
            CurveKind::Bezier { span, frame } => {
                return span.polyline(chord).into_iter().map(|p| frame.point(p.extend(0.0))).collect();
            }
            CurveKind::Arc(arc) => arc.sweep.abs(),
            CurveKind::Involute { record, .. } => record.turn(self.length).abs(),
        };
        // Equal steps in tangent angle of at most 30 degrees; sagitta rho (1 - cos(step/2)) with the largest rho.
        let rho = match &self.kind() {
            CurveKind::Arc(arc) => arc.radius(),
            CurveKind::Involute { record, .. } => record.start_radius().abs().max(record.end_radius().abs()),
            CurveKind::Line(_) | CurveKind::Spiral { .. } | CurveKind::Bezier { .. } => 0.0,
        };
        let step = (8.0 * chord / rho.max(chord)).sqrt().min(std::f64::consts::FRAC_PI_6);
        let n = (turn / step).ceil().max(1.0) as usize;
        (0..=n)
            .map(|i| match (&self.kind(), i) {
                (_, 0) => self.start(),
                (_, i) if i == n => self.end(),
                (CurveKind::Involute { record, .. }, i) => {
                    let s = record.length_at_turn(turn * i as f64 / n as f64);
                    self.at(s * self.length / record.length()).p
                }
                _ => self.at(self.length * i as f64 / n as f64).p,
            })
            .collect()
    }

    /// A box that holds the curve: exact for lines, up to 2 um too large on a side otherwise.
    pub fn bounds(&self) -> Aabb {
        match &self.kind() {
            CurveKind::Line(line) => Aabb::of_points([line.start, line.end]),
            _ => {
                // A chord tolerance of 1 um: fine enough for travel limits, cheap enough for long spirals.
                const CHORD: f64 = 1e-3;
                Aabb::of_points(self.polyline(CHORD)).grown(CHORD)
            }
        }
    }
}

/// As [`Curve::polyline`], in the coordinates of the spiral's plane: steps by the curvature at their start, halved
/// until the exact middle lies within the chord.
fn spiral_polyline(spiral: &Spiral, rise: &Rise, chord: f64) -> Vec<DVec3> {
    let [from, to] = spiral.parameters();
    let mut s = 0.0;
    let mut u = from;
    let place = |u: f64, s: f64| spiral.point(u).extend(rise.at(s / spiral.length()));
    let mut points = vec![place(from, 0.0)];
    /// Largest step of the parameter [rad], and the least share of the whole: below it the tolerance is no longer met.
    const MOST: f64 = std::f64::consts::FRAC_PI_6;
    const LEAST: f64 = 1e-9;
    let width = to - from;
    let mut step = MOST.copysign(width);
    while u != to {
        step = (2.0 * step).clamp(-MOST, MOST);
        let last = points[points.len() - 1];
        loop {
            let next = if (to - u - step) * width <= 0.0 { to } else { u + step };
            // Stretch by stretch: from the start each would cost as much as the whole way.
            let after = |v: f64| s + spiral.law().length(u, v).abs();
            let reached = if next == to { spiral.length() } else { after(next) };
            let middle = u + 0.5 * (next - u);
            let (end, between) = (place(next, reached), place(middle, after(middle)));
            let along = (end - last).normalize_or_zero();
            let off = between - last;
            // A fifth of reserve: the largest distance of a curve is not exactly in the middle.
            if (off - along * off.dot(along)).length() <= 0.8 * chord || step.abs() <= LEAST * width.abs() {
                points.push(end);
                (u, s) = (next, reached);
                break;
            }
            step *= 0.5;
        }
    }
    points
}
