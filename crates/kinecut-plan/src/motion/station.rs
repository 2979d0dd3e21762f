//! Places along a curve for a time law, with three derivatives by arc length.

use glam::DVec3;

use crate::geom::{Curve, CurveKind, PlaneCurve};

/// A place on a curve; derivatives by arc length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Arc length from the start of the curve [mm].
    pub s: f64,
    /// Position [mm].
    pub point: DVec3,
    /// Unit tangent.
    pub tangent: DVec3,
    /// Curvature vector [1/mm]; infinite at a cusp.
    pub curvature: DVec3,
    /// Third derivative [1/mm^2]; not a number at a cusp.
    pub third: DVec3,
}

/// A curve that can be walked along.
pub trait PathByLength: Sync {
    /// Arc length [mm].
    fn length(&self) -> f64;

    /// Places from the start to the end, both included, at most `turn` [rad] of heading apart.
    fn stations(&self, turn: f64) -> Vec<Station>;
}

/// Heading that every curve counts as having on top of its own [rad]: lines and short arcs, too, have ramps of speed
/// inside, which are refined with the rest.
const OWN_TURN: f64 = 0.8;
/// Most parts of a curve: beyond it the heading step is absurdly small.
const MOST: f64 = 2_000_000.0;

fn parts(turned: f64, turn: f64) -> usize {
    // In range by the clamp.
    ((turned + OWN_TURN) / turn).ceil().clamp(1.0, MOST) as usize
}

impl PathByLength for PlaneCurve {
    fn length(&self) -> f64 {
        PlaneCurve::length(self)
    }

    fn stations(&self, turn: f64) -> Vec<Station> {
        let whole = self.turn();
        let count = parts(whole, turn);
        let places = match self {
            // Evenly in heading: about a cusp arc length says nothing.
            PlaneCurve::Record(record) if !record.is_line() => (0..=count)
                .map(|i| {
                    let s = if i == count {
                        record.length()
                    } else {
                        record.length_at_turn(whole * i as f64 / count as f64)
                    };
                    (s, record.at(s))
                })
                .collect(),
            _ => self.walk(count),
        };
        places
            .into_iter()
            .map(|(s, jet)| Station {
                s,
                point: jet.p.extend(0.0),
                tangent: jet.d1.extend(0.0),
                curvature: jet.d2.extend(0.0),
                third: jet.d3.extend(0.0),
            })
            .collect()
    }
}

impl PathByLength for Curve {
    fn length(&self) -> f64 {
        Curve::length(self)
    }

    fn stations(&self, turn: f64) -> Vec<Station> {
        let station = |s: f64| {
            let jet = self.at(s);
            Station { s, point: jet.p, tangent: jet.d1, curvature: jet.d2, third: jet.d3 }
        };
        places(self, turn).into_iter().map(station).collect()
    }
}

/// Arc lengths from the start to the end of a curve, both included, at most `turn` [rad] of heading apart [mm].
pub(super) fn places(curve: &Curve, turn: f64) -> Vec<f64> {
    let mut places: Vec<f64> = match curve.kind() {
        CurveKind::Involute { record, .. } if !record.is_line() => {
            let whole = record.turn(record.length()).abs();
            let count = parts(whole, turn);
            let stretch = curve.length() / record.length();
            (0..=count).map(|i| record.length_at_turn(whole * i as f64 / count as f64) * stretch).collect()
        }
        CurveKind::Spiral { spiral, .. } => {
            // Evenly in the spiral's own parameter, in proportion to the length in the plane: near enough for
            // places that need not be even.
            let [from, to] = spiral.parameters();
            let count = parts(PlaneCurve::from(spiral).turn(), turn);
            let stretch = curve.length() / spiral.length();
            let (mut s, mut before) = (0.0, from);
            (0..=count)
                .map(|i| {
                    let u = from + (to - from) * i as f64 / count as f64;
                    s += spiral.law().length(before, u).abs();
                    before = u;
                    s * stretch
                })
                .collect()
        }
        CurveKind::Arc(arc) => even(curve.length(), parts(arc.sweep.abs(), turn)),
        CurveKind::Bezier { span, .. } => even(curve.length(), parts(span.turn(), turn)),
        _ => even(curve.length(), parts(0.0, turn)),
    };
    if let Some(last) = places.last_mut() {
        *last = curve.length();
    }
    places
}

fn even(length: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| length * i as f64 / count as f64).collect()
}
