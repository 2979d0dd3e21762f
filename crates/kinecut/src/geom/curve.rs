//! Curves in space, parametrised by arc length, with derivatives to the third.

use glam::{DVec2, DVec3};

use super::{Aabb, Arc, InvoluteRecord, Line, Rigid};

/// A point of a curve and its derivatives by arc length [mm, 1, 1/mm, 1/mm^2].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// Position [mm].
    pub p: DVec3,
    /// Unit tangent.
    pub d1: DVec3,
    /// Second derivative: curvature vector [1/mm].
    pub d2: DVec3,
    /// Third derivative [1/mm^2].
    pub d3: DVec3,
}

impl Jet {
    /// Curvature [1/mm], never negative.
    pub fn curvature(&self) -> f64 {
        self.d2.length()
    }
}

/// The exact curve of a move. Nothing turns it into chords before a writer or the simulator does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    kind: CurveKind,
    length: f64,
}

/// What kind of curve it is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
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
}

impl From<Line> for Curve {
    fn from(line: Line) -> Curve {
        Curve { kind: CurveKind::Line(line), length: line.length() }
    }
}

impl From<Arc> for Curve {
    fn from(arc: Arc) -> Curve {
        Curve { kind: CurveKind::Arc(arc), length: arc.length() }
    }
}

impl Curve {
    /// A circle involute at height `z`, in a plane parallel to XY.
    pub fn involute(record: InvoluteRecord, z: f64, rise: f64) -> Curve {
        Curve::involute_in(record, Rigid::from_translation(DVec3::new(0.0, 0.0, z)), rise)
    }

    /// A circle involute in the XY plane of `frame`.
    pub fn involute_in(record: InvoluteRecord, frame: Rigid, rise: f64) -> Curve {
        Curve { kind: CurveKind::Involute { record, frame, rise }, length: record.length().hypot(rise) }
    }

    /// The kind, with its numbers.
    pub fn kind(&self) -> &CurveKind {
        &self.kind
    }

    /// Arc length [mm].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Point and derivatives at arc length `s` [mm] in `[0, length]`. A curve of no length has zero derivatives.
    pub fn at(&self, s: f64) -> Jet {
        match &self.kind {
            CurveKind::Line(line) => line.at(s),
            CurveKind::Arc(arc) => arc.at(s),
            CurveKind::Involute { record, frame, rise } => {
                let planar = record.length();
                // ds_planar/ds is constant, so each derivative is scaled by its power.
                let c = if self.length > 0.0 { planar / self.length } else { 0.0 };
                let j = record.at(s * c);
                let lift = |v: DVec2, z: f64| frame.vector(DVec3::new(v.x, v.y, z));
                let slope = if self.length > 0.0 { rise / self.length } else { 0.0 };
                Jet {
                    p: frame.point(DVec3::new(j.p.x, j.p.y, s * slope)),
                    d1: lift(j.d1 * c, slope),
                    d2: lift(j.d2 * (c * c), 0.0),
                    d3: lift(j.d3 * (c * c * c), 0.0),
                }
            }
        }
    }

    /// First point.
    pub fn start(&self) -> DVec3 {
        self.at(0.0).p
    }

    /// Last point.
    pub fn end(&self) -> DVec3 {
        match &self.kind {
            CurveKind::Line(line) => line.end,
            _ => self.at(self.length).p,
        }
    }

    /// The same points the other way.
    #[must_use]
    pub fn reversed(&self) -> Curve {
        match &self.kind {
            CurveKind::Line(line) => Line { start: line.end, end: line.start }.into(),
            CurveKind::Arc(arc) => arc.reversed().into(),
            CurveKind::Involute { record, frame, rise } => {
                let lifted = Rigid { translation: frame.point(DVec3::new(0.0, 0.0, *rise)), ..*frame };
                Curve::involute_in(record.reversed(), lifted, -rise)
            }
        }
    }

    /// The part between arc lengths `a <= b` [mm].
    #[must_use]
    pub fn part(&self, a: f64, b: f64) -> Curve {
        match &self.kind {
            CurveKind::Line(line) => Line { start: line.at(a).p, end: line.at(b).p }.into(),
            CurveKind::Arc(arc) => arc.part(a, b).into(),
            CurveKind::Involute { record, frame, rise } => {
                let (u, v) = (a / self.length, b / self.length);
                let lifted = Rigid { translation: frame.point(DVec3::new(0.0, 0.0, rise * u)), ..*frame };
                let part = record.split(v * record.length()).0.split(u * record.length()).1;
                Curve::involute_in(part, lifted, rise * (v - u))
            }
        }
    }

    /// The curve moved by a rigid motion.
    #[must_use]
    pub fn moved(&self, motion: &Rigid) -> Curve {
        match &self.kind {
            CurveKind::Line(line) => {
                Line { start: motion.point(line.start), end: motion.point(line.end) }.into()
            }
            CurveKind::Arc(arc) => arc.moved(motion).into(),
            CurveKind::Involute { record, frame, rise } => {
                Curve::involute_in(*record, motion.after(frame), *rise)
            }
        }
    }

    /// Points of a polyline that leaves the curve by at most `chord` [mm], both ends included.
    pub fn polyline(&self, chord: f64) -> Vec<DVec3> {
        let turn = match &self.kind {
            CurveKind::Line(_) => return vec![self.start(), self.end()],
            CurveKind::Arc(arc) => arc.sweep.abs(),
            CurveKind::Involute { record, .. } => record.turn(self.length).abs(),
        };
        // Equal steps in tangent angle of at most 30 degrees; sagitta rho (1 - cos(step/2)) with the largest rho.
        let rho = match &self.kind {
            CurveKind::Arc(arc) => arc.radius(),
            CurveKind::Involute { record, .. } => record.start_radius().abs().max(record.end_radius().abs()),
            CurveKind::Line(_) => 0.0,
        };
        let step = (8.0 * chord / rho.max(chord)).sqrt().min(std::f64::consts::FRAC_PI_6);
        let n = (turn / step).ceil().max(1.0) as usize;
        (0..=n)
            .map(|i| match (&self.kind, i) {
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
        match &self.kind {
            CurveKind::Line(line) => Aabb::of_points([line.start, line.end]),
            _ => {
                // A chord tolerance of 1 um: fine enough for travel limits, cheap enough for long spirals.
                const CHORD: f64 = 1e-3;
                Aabb::of_points(self.polyline(CHORD)).grown(CHORD)
            }
        }
    }
}
