//! The words of an involute block on controls that have one: from a record to the block, and back from the
//! rounded words to an exact record.
//!
//! SINUMERIK `INVCW|INVCCW X Y I J CR=` and FANUC `G02.2|G03.2 X Y I J R` give the end point, the centre of the
//! base circle relative to the start, and the base radius. In polar coordinates about that centre a point at
//! distance `d` has the roll angle `phi = sqrt(d^2/r^2 - 1)` and the angle `phi - atan(phi)` from the start of
//! the involute on its base circle.
//!
//! The words are rounded, so the involute through the start misses the end. [`InvoluteRecord::through`] mends
//! that with the base radius, which changes the curve less than the rounding did: both ends are then exact.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec2;

use super::InvoluteRecord;
use crate::base::{Code, Finding, Result};
use crate::num::angle::wrap_positive;
use crate::num::root::bracketed_newton;

/// The contents of an involute block, without its number format.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InvoluteBlock {
    /// Counter-clockwise.
    pub ccw: bool,
    /// End point [mm].
    pub end: DVec2,
    /// Centre of the base circle minus the start point [mm] (words I, J).
    pub centre: DVec2,
    /// Radius of the base circle [mm] (word CR or R).
    pub base_radius: f64,
    /// Angle between the rays from the base centre to start and end [rad], whole turns included; positive away
    /// from the base circle (word AR).
    pub opening: f64,
    /// The path leads away from the base circle.
    pub away: bool,
    /// Turns of the tangent.
    pub turns: f64,
    /// Roll angle of the end nearer to the base circle [rad]; zero on the base circle. A control needs it well
    /// above zero: rounding would put the point inside.
    pub least_roll: f64,
}

/// `atan b - atan a` for `b >= a >= 0`, without cancellation.
fn atan_difference(a: f64, b: f64) -> f64 {
    ((b - a) / a.mul_add(b, 1.0)).atan()
}

/// Newton's steps in [`InvoluteRecord::through`]: quadratic from a start that is right to rounding; the rest is
/// bisection for hints that are far off.
const RADIUS_ITERATIONS: u32 = 80;

impl InvoluteRecord {
    /// The block that describes it, or `None` for a line, a circle or a record of no length.
    pub fn block(&self) -> Option<InvoluteBlock> {
        let r = self.base_radius().abs();
        if r == 0.0 || !r.is_finite() {
            return None;
        }
        let (rolls, rolle) = (self.start_radius().abs() / r, self.end_radius().abs() / r);
        let turned = self.turn(self.length()).abs();
        let opening = turned - atan_difference(rolls.min(rolle), rolls.max(rolle));
        let away = rolle > rolls;
        Some(InvoluteBlock {
            ccw: self.sense() > 0.0,
            end: self.end(),
            centre: self.base_centre() - self.start(),
            base_radius: r,
            opening: if away { opening } else { -opening },
            away,
            turns: turned / TAU,
            least_roll: rolls.min(rolle),
        })
    }

    /// The involute about `base_centre` through both points, counter-clockwise or not, whose base radius is the
    /// nearest to `base_radius` [mm], and the mismatch [mm]: the distance between the two involutes of exactly
    /// `base_radius` through start and end, which is what a control compares with its tolerance.
    ///
    /// Whether it leads away from the base circle follows from the distances; the number of whole turns from
    /// `base_radius`. Two points at equal distance give the circle about the base centre.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::geom::InvoluteRecord;
    /// // The paper's lead-in as a SINUMERIK block with eight decimals.
    /// let start = [-40.0, 40.0];
    /// let centre = [-40.0 + 36.27913663, 40.0 - 45.16562187];
    /// let (record, mismatch) =
    ///     InvoluteRecord::through(start, [64.91311883, -46.75774806], centre, 6.36619772, true).unwrap();
    /// assert!((record.length() - 242.249726898481).abs() < 1e-6 && mismatch < 1e-7);
    /// assert!((record.end().x - 64.91311883).abs() < 1e-12);
    /// ```
    ///
    /// # Errors
    /// `KC0203` when an end lies inside the base circle, a number is not usable, or no involute about this
    /// centre leads from one point to the other.
    pub fn through(
        start: [f64; 2],
        end: [f64; 2],
        base_centre: [f64; 2],
        base_radius: f64,
        ccw: bool,
    ) -> Result<(InvoluteRecord, f64)> {
        let (s, e) = (DVec2::from_array(start), DVec2::from_array(end));
        let centre = DVec2::from_array(base_centre);
        if !(s.is_finite()
            && e.is_finite()
            && centre.is_finite()
            && base_radius.is_finite()
            && base_radius > 0.0)
        {
            return Err(misfit("an involute needs finite points and a positive base radius")
                .value_mm(base_radius)
                .into());
        }
        let (from, to) = (s - centre, e - centre);
        let (ds, de) = (from.length(), to.length());
        for (d, which) in [(ds, "start"), (de, "end")] {
            if d < base_radius {
                return Err(misfit(&format!("the {which} of an involute lies inside its base circle"))
                    .value_mm(d)
                    .bound_mm(base_radius)
                    .help("start an involute at least one turn away from its base circle, or post it as arcs")
                    .into());
            }
        }
        let sign = if ccw { 1.0 } else { -1.0 };
        // Not `angle_to`: it goes through an arc cosine and loses half its digits about pi.
        let between = wrap_positive(sign * (to.to_angle() - from.to_angle()));
        let curve = Opening { near: ds.min(de), far: ds.max(de), step: (e - s).dot(from + to).abs() };
        let hinted = curve.angle(base_radius);
        let goal = between + TAU * ((hinted - between) / TAU).round();
        let mismatch = base_radius * (hinted - goal).abs();
        if ds == de {
            // The opening of the hinted involute is zero: the nearest goal may be a whole turn off.
            let goal = if goal > 0.0 { goal } else { between };
            return around(s, from, goal, ds, sign).map(|record| (record, mismatch));
        }
        if goal < curve.angle(curve.near) {
            return Err(misfit("no involute about this base centre leads from the start to the end")
                .value_mm(mismatch)
                .help("check I, J and the base radius; a start on the base circle cannot be rounded")
                .into());
        }
        // At the lower bound the opening exceeds the goal: phi grows at least as fast as d/r, atan by at most pi/2.
        let least = (curve.far - curve.near) / (goal + FRAC_PI_2);
        let (r, _) = bracketed_newton(
            |r| (goal - curve.angle(r), curve.slope(r)),
            base_radius,
            least.clamp(0.0, curve.near),
            curve.near,
            RADIUS_ITERATIONS,
        );
        let away = de > ds;
        let signed = if away { r } else { -r };
        let radius = |d: f64| sign * ((d - r) * (d + r)).clamp(0.0, f64::INFINITY).sqrt();
        let (rn, rk) = (radius(ds), radius(de));
        // p - C = exp(i theta) (r - i rho)
        let angle = from.to_angle() + rn.atan2(signed);
        let record = InvoluteRecord::new(0.5 * curve.step / r, start, angle, rn, rk)?;
        Ok((record, mismatch))
    }
}

/// The opening angle between two distances from the base centre, as a function of the base radius.
struct Opening {
    near: f64,
    far: f64,
    /// Difference of the squared distances, free of cancellation.
    step: f64,
}

impl Opening {
    fn rolls(&self, r: f64) -> (f64, f64, f64) {
        let roll = |d: f64| ((d - r) * (d + r)).clamp(0.0, f64::INFINITY).sqrt() / r;
        let (a, b) = (roll(self.near), roll(self.far));
        (a, b, self.step / (r * r * (a + b)))
    }

    fn angle(&self, r: f64) -> f64 {
        let (a, b, difference) = self.rolls(r);
        difference - (difference / a.mul_add(b, 1.0)).atan()
    }

    /// Derivative of minus the angle: `(phi_far - phi_near) / r`.
    fn slope(&self, r: f64) -> f64 {
        self.rolls(r).2 / r
    }
}

/// The circle about the base centre, which is what an involute between equal distances is.
fn around(start: DVec2, from: DVec2, sweep: f64, radius: f64, sign: f64) -> Result<InvoluteRecord> {
    if sweep <= 0.0 {
        return Err(misfit("the start and the end of an involute are the same point").value_mm(0.0).into());
    }
    let angle = from.to_angle() + sign * FRAC_PI_2;
    InvoluteRecord::new(radius * sweep, start.to_array(), angle, sign * radius, sign * radius)
}

fn misfit(message: &str) -> Finding {
    Finding::error(Code::NC_ARC, message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Distance of a point from a densely sampled curve, by chords.
    fn distance(record: &InvoluteRecord, p: DVec2) -> f64 {
        let n = 4000;
        let points: Vec<DVec2> =
            (0..=n).map(|i| record.at(record.length() * f64::from(i) / f64::from(n)).p).collect();
        points.windows(2).fold(f64::INFINITY, |least, w| {
            let d = w[1] - w[0];
            let t = ((p - w[0]).dot(d) / d.length_squared()).clamp(0.0, 1.0);
            least.min((w[0] + d * t - p).length())
        })
    }

    #[test]
    fn the_manual_example_is_an_involute_of_more_than_a_turn() {
        let (record, mismatch) =
            InvoluteRecord::through([10.0, 0.0], [32.77, 32.77], [0.0, 0.0], 5.0, true).unwrap();
        let block = record.block().unwrap();
        assert!((block.opening.to_degrees() - 405.0).abs() < 1e-9, "{block:?}");
        assert!((mismatch - 0.0074).abs() < 5e-5, "{mismatch}");
        assert!((record.end() - DVec2::new(32.77, 32.77)).length() < 1e-11);
    }

    #[test]
    fn points_inside_the_base_circle_are_refused_with_the_numbers() {
        let e = InvoluteRecord::through([0.5, 0.0], [3.0, 3.0], [0.0, 0.0], 1.0, true).unwrap_err();
        assert_eq!((e.code(), e.0.value.unwrap().value, e.0.bound.unwrap().value), (Code::NC_ARC, 0.5, 1.0));
        for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
            assert_eq!(
                InvoluteRecord::through([2.0, 0.0], [3.0, 3.0], [0.0, 0.0], bad, true).unwrap_err().code(),
                Code::NC_ARC
            );
        }
        let same = InvoluteRecord::through([2.0, 0.0], [2.0, 0.0], [0.0, 0.0], 1.0, true).unwrap_err();
        assert_eq!(same.code(), Code::NC_ARC);
    }

    #[test]
    fn equal_distances_give_the_circle() {
        let (record, _) = InvoluteRecord::through([3.0, 0.0], [0.0, 3.0], [0.0, 0.0], 1e-3, false).unwrap();
        assert_eq!(record.base_radius(), 0.0);
        assert!((record.end() - DVec2::new(0.0, 3.0)).length() < 1e-12);
        assert!(record.at(0.1).p.y < 0.0);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn a_block_of_exact_words_gives_the_record_back(
            r in 0.05..8.0f64, a in 0.3..60.0f64, turned in 0.05..70.0f64,
            angle in -10.0..10.0f64, cw: bool, inward: bool, x in -50.0..50.0f64,
        ) {
            let b = a + turned;
            let plain = InvoluteRecord::new(0.5 * r * (b - a) * (b + a), [x, 7.0], angle, r * a, r * b).unwrap();
            let record = if cw { plain.mirrored() } else { plain };
            let record = if inward { record.reversed() } else { record };
            let block = record.block().unwrap();
            prop_assert_eq!(block.away, !inward);
            prop_assert_eq!(block.ccw, record.sense() > 0.0);
            prop_assert!((block.turns * TAU - turned).abs() < 1e-9);
            let s = record.start();
            let (found, mismatch) = InvoluteRecord::through(
                s.to_array(), block.end.to_array(), (s + block.centre).to_array(), block.base_radius, block.ccw,
            ).unwrap();
            prop_assert!(mismatch < 1e-9 * r * b);
            prop_assert!((found.length() / record.length() - 1.0).abs() < 1e-8, "{found:?} {record:?}");
            for u in [0.0, 0.3, 0.7, 1.0] {
                let gap = (found.at(found.length() * u).p - record.at(record.length() * u).p).length();
                prop_assert!(gap < 1e-8 * r * b, "{gap} {found:?} {record:?}");
            }
        }

        #[test]
        fn rounded_words_give_both_ends_and_a_curve_within_the_rounding(
            r in 0.3..8.0f64, a in 6.3..60.0f64, turned in 1.0..40.0f64,
            angle in -10.0..10.0f64, cw: bool, inward: bool, decimals in 3i32..5,
        ) {
            let u = 10f64.powi(-decimals);
            let round = |v: f64| (v / u).round() * u;
            // The base radius is a multiple of the resolution, as the planner makes it.
            let r = round(r);
            let b = a + turned;
            let plain = InvoluteRecord::new(0.5 * r * (b - a) * (b + a), [1.0, 2.0], angle, r * a, r * b).unwrap();
            let record = if cw { plain.mirrored() } else { plain };
            let record = if inward { record.reversed() } else { record };
            let block = record.block().unwrap();
            let s = DVec2::new(round(record.start().x), round(record.start().y));
            let e = DVec2::new(round(block.end.x), round(block.end.y));
            let c = DVec2::new(round(block.centre.x), round(block.centre.y));
            let (found, mismatch) =
                InvoluteRecord::through(s.to_array(), e.to_array(), (s + c).to_array(), r, block.ccw).unwrap();
            prop_assert_eq!(found.start(), s);
            prop_assert!((found.end() - e).length() < 1e-10, "{}", (found.end() - e).length());
            // Start, centre and end are each off by at most u/sqrt 2.
            prop_assert!(mismatch < 3.0 * u, "{mismatch}");
            for k in 0..=8 {
                let p = found.at(found.length() * f64::from(k) / 8.0).p;
                let chord = (record.length() / 4000.0).powi(2) / (8.0 * r * a);
                prop_assert!(distance(&record, p) < 3.0 * u + chord, "{} {u}", distance(&record, p));
            }
        }
    }
}
