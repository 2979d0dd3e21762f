//! A plane curve of a planner: an involute record (which includes circles and lines) or a spiral.

use glam::DVec2;

use super::{Arc, Curve, InvoluteRecord, Line, PlanarJet, Rise, Spiral};
use crate::num::taylor::Taylor;

/// A plane curve with exact derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlaneCurve {
    /// A circle involute, a circle, an arc or a line.
    Record(InvoluteRecord),
    /// Any other spiral.
    Spiral(Spiral),
}

impl From<InvoluteRecord> for PlaneCurve {
    fn from(record: InvoluteRecord) -> PlaneCurve {
        PlaneCurve::Record(record)
    }
}

impl From<Spiral> for PlaneCurve {
    fn from(spiral: Spiral) -> PlaneCurve {
        PlaneCurve::Spiral(spiral)
    }
}

impl PlaneCurve {
    /// Arc length [mm].
    pub fn length(&self) -> f64 {
        match self {
            PlaneCurve::Record(record) => record.length(),
            PlaneCurve::Spiral(spiral) => spiral.length(),
        }
    }

    /// Point and derivatives at arc length `s` [mm].
    pub fn at(&self, s: f64) -> PlanarJet {
        match self {
            PlaneCurve::Record(record) => record.at(s),
            PlaneCurve::Spiral(spiral) => spiral.at(s),
        }
    }

    /// The point as a series by arc length, at arc length `s` [mm].
    pub fn series<const N: usize>(&self, s: f64) -> [Taylor<N>; 2] {
        match self {
            PlaneCurve::Record(record) => record.series(s),
            PlaneCurve::Spiral(spiral) => spiral.arc_series(spiral.parameter(s)),
        }
    }

    /// `count + 1` points with their arc lengths, evenly in the curve's own parameter (arc length of a record): the
    /// cheap way to walk along it.
    pub fn walk(&self, count: usize) -> Vec<(f64, PlanarJet)> {
        let count = count.max(1);
        let share = |i: usize| i as f64 / count as f64;
        match self {
            PlaneCurve::Record(record) => (0..=count)
                .map(|i| (record.length() * share(i), record.at(record.length() * share(i))))
                .collect(),
            PlaneCurve::Spiral(spiral) => {
                let [from, to] = spiral.parameters();
                let mut s = 0.0;
                let mut before = from;
                (0..=count)
                    .map(|i| {
                        let u = if i == count { to } else { from + (to - from) * share(i) };
                        s += spiral.law().length(before, u).abs();
                        before = u;
                        (s, spiral.at_parameter(u))
                    })
                    .collect()
            }
        }
    }

    /// First point [mm].
    pub fn start(&self) -> DVec2 {
        match self {
            PlaneCurve::Record(record) => record.start(),
            PlaneCurve::Spiral(spiral) => spiral.start(),
        }
    }

    /// Last point [mm].
    pub fn end(&self) -> DVec2 {
        match self {
            PlaneCurve::Record(record) => record.end(),
            PlaneCurve::Spiral(spiral) => spiral.end(),
        }
    }

    /// The same points the other way.
    #[must_use]
    pub fn reversed(&self) -> PlaneCurve {
        match self {
            PlaneCurve::Record(record) => record.reversed().into(),
            PlaneCurve::Spiral(spiral) => spiral.reversed().into(),
        }
    }

    /// The reflection x -> -x; it swaps the senses.
    #[must_use]
    pub fn mirrored(&self) -> PlaneCurve {
        match self {
            PlaneCurve::Record(record) => record.mirrored().into(),
            PlaneCurve::Spiral(spiral) => spiral.mirrored().into(),
        }
    }

    /// Turned about the origin [rad].
    #[must_use]
    pub fn rotated(&self, angle: f64) -> PlaneCurve {
        match self {
            PlaneCurve::Record(record) => record.rotated(angle).into(),
            PlaneCurve::Spiral(spiral) => spiral.rotated(angle).into(),
        }
    }

    /// Moved by a translation [mm].
    #[must_use]
    pub fn shifted(&self, by: DVec2) -> PlaneCurve {
        match self {
            PlaneCurve::Record(record) => record.shifted(by).into(),
            PlaneCurve::Spiral(spiral) => spiral.shifted(by).into(),
        }
    }

    /// The part between arc lengths `a <= b` [mm].
    #[must_use]
    pub fn part(&self, a: f64, b: f64) -> PlaneCurve {
        match self {
            PlaneCurve::Record(record) => record.split(b).0.split(a).1.into(),
            PlaneCurve::Spiral(spiral) => spiral.between(spiral.parameter(a), spiral.parameter(b)).into(),
        }
    }

    /// Total angle turned, always positive [rad]; the change of the tangent angle from start to end.
    pub fn turn(&self) -> f64 {
        match self {
            PlaneCurve::Record(record) => record.turn(record.length()).abs(),
            PlaneCurve::Spiral(spiral) => {
                let [from, to] = spiral.parameters();
                (spiral.angle(to) - spiral.angle(from)).abs()
            }
        }
    }

    /// The curve in space, beginning at height `z` and rising by `rise` [mm]; records of lines and circles become
    /// [`Line`] and [`Arc`].
    pub fn at_height(&self, z: f64, rise: f64) -> Curve {
        match self {
            PlaneCurve::Record(record) if record.is_line() => {
                Line { start: record.start().extend(z), end: record.end().extend(z + rise) }.into()
            }
            PlaneCurve::Record(record) if record.start_radius() == record.end_radius() => Arc {
                start: record.start().extend(z),
                centre: record.base_centre().extend(z),
                axis: glam::DVec3::Z,
                sweep: record.turn(record.length()),
                rise,
            }
            .into(),
            PlaneCurve::Record(record) => Curve::involute(*record, z, rise),
            PlaneCurve::Spiral(spiral) => Curve::spiral(*spiral, z, Rise::even(rise)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_and_lines_become_such_in_space() {
        let circle: PlaneCurve = InvoluteRecord::new(7.0, [3.0, 0.0], 1.0, -2.0, -2.0).unwrap().into();
        let line: PlaneCurve =
            InvoluteRecord::new(7.0, [3.0, 0.0], 1.0, f64::INFINITY, f64::INFINITY).unwrap().into();
        for curve in [circle, line] {
            let space = curve.at_height(2.0, 0.0);
            for (s, jet) in curve.walk(7) {
                let p = space.at(s);
                assert!((p.p - jet.p.extend(2.0)).length() < 1e-14);
                assert!((p.d2.truncate() - jet.d2).length() < 1e-14);
            }
            assert!((curve.mirrored().mirrored().end() - curve.end()).length() < 1e-14);
        }
        assert!((circle.turn() - 3.5).abs() < 1e-15);
    }
}
