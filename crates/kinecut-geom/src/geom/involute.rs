//! The six-number record of a circle involute, a circle or a line in the plane.
//!
//! Source: Sorokin, But, Kombarov 2013, equation (12), corrected: the fourth number is the *tangent* angle at
//! the start, not the roll angle. Every formula is free of cancellation when the base radius tends to zero
//! (circle), and holds for both senses.
//!
//! Notation: `t = (cos th, sin th)` tangent, `n` its left normal, `rho` signed radius of curvature
//! (positive turns left), `r = d rho / d theta` signed base radius, `D` turned angle.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::base::{Code, Finding, Result};
use crate::num::series::{one_minus_cos, sin_minus_v_cos, v_sin_minus_one_minus_cos};
use crate::num::taylor::Taylor;

/// A point of a planar curve and its derivatives by arc length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarJet {
    /// Position [mm].
    pub p: DVec2,
    /// Unit tangent.
    pub d1: DVec2,
    /// Curvature vector [1/mm].
    pub d2: DVec2,
    /// Third derivative [1/mm^2].
    pub d3: DVec2,
    /// Tangent angle [rad], continuous along the curve.
    pub angle: f64,
    /// Signed curvature [1/mm]; infinite at a cusp.
    pub curvature: f64,
    /// Derivative of the signed curvature by arc length [1/mm^2]; not a number at a cusp.
    pub curvature_slope: f64,
}

/// A circle involute (or circle, or line) as six numbers.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::geom::InvoluteRecord;
/// // The paper's roughing spiral: bore 200 mm, cutter 40 mm, allowance 1 mm, 20 turns.
/// let spiral = InvoluteRecord::new(4963.71639267187, [0.0, 0.0], 0.0, 0.0, 79.0).unwrap();
/// assert!((spiral.base_radius() - 0.628662025212987).abs() < 1e-13);
/// let end = spiral.at(spiral.length()).p;
/// assert!((end.x - 0.0).abs() < 1e-10 && (end.y + 79.0).abs() < 1e-10);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InvoluteRecord {
    length: f64,
    start: DVec2,
    angle: f64,
    start_radius: f64,
    end_radius: f64,
}

/// The point of the circle of `radius` about the origin at which the counter-clockwise tangent angle is `psi` [rad]:
/// `(R sin psi, -R cos psi)`, polar angle `psi - pi/2`.
pub fn on_circle(radius: f64, psi: f64) -> DVec2 {
    let (sin, cos) = psi.sin_cos();
    DVec2::new(radius * sin, -radius * cos)
}

impl InvoluteRecord {
    /// A checked record: length [mm], start point [mm], tangent angle at the start [rad], signed radii of curvature at
    /// start and end [mm] (both not negative: counter-clockwise; both not positive: clockwise; both infinite: a line;
    /// equal: a circle). A zero radius is a cusp and is allowed at an end only.
    ///
    /// # Errors
    /// `KC0801` for a negative length, radii of opposite sign, one straight end, or numbers that are not finite.
    pub fn new(
        length: f64,
        start: [f64; 2],
        angle: f64,
        start_radius: f64,
        end_radius: f64,
    ) -> Result<InvoluteRecord> {
        let fail = |what: &str, value: f64| Err(Finding::error(Code::GEOMETRY, what).value_mm(value).into());
        if !(length.is_finite() && length >= 0.0) {
            return fail("an involute record needs a length that is not negative", length);
        }
        if !(start[0].is_finite() && start[1].is_finite() && angle.is_finite()) {
            return fail("an involute record has a start that is not finite", start[0] + start[1] + angle);
        }
        if start_radius.is_nan() || end_radius.is_nan() {
            return fail("an involute record has a radius that is not a number", f64::NAN);
        }
        if start_radius.is_infinite() != end_radius.is_infinite() {
            return fail("an involute record has one straight end", start_radius);
        }
        if start_radius.is_finite() && (start_radius * end_radius < 0.0) {
            return fail("the radii of an involute record have opposite signs", end_radius);
        }
        if start_radius == 0.0 && end_radius == 0.0 && length > 0.0 {
            return fail("an involute record has two zero radii", length);
        }
        Ok(InvoluteRecord { length, start: DVec2::from_array(start), angle, start_radius, end_radius })
    }

    /// The full counter-clockwise circle about the origin that starts at tangent angle `psi` [rad].
    ///
    /// # Errors
    /// `KC0801` when the radius is not positive and finite.
    pub fn circle(radius: f64, psi: f64) -> Result<InvoluteRecord> {
        InvoluteRecord::new(TAU * radius, on_circle(radius, psi).to_array(), psi, radius, radius)
    }

    /// Arc length [mm].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Start point [mm].
    pub fn start(&self) -> DVec2 {
        self.start
    }

    /// Tangent angle at the start [rad].
    pub fn start_angle(&self) -> f64 {
        self.angle
    }

    /// Signed radius of curvature at the start [mm].
    pub fn start_radius(&self) -> f64 {
        self.start_radius
    }

    /// Signed radius of curvature at the end [mm].
    pub fn end_radius(&self) -> f64 {
        self.end_radius
    }

    /// True for a straight line.
    pub fn is_line(&self) -> bool {
        self.start_radius.is_infinite()
    }

    /// +1 counter-clockwise, -1 clockwise (a line counts as counter-clockwise).
    pub fn sense(&self) -> f64 {
        if self.start_radius + self.end_radius < 0.0 { -1.0 } else { 1.0 }
    }

    /// Signed base radius `d rho / d theta` [mm]: positive when the absolute radius grows along a
    /// counter-clockwise record; zero for a circle or a line. Its absolute value is the radius of the base circle.
    pub fn base_radius(&self) -> f64 {
        if self.is_line() || self.length == 0.0 {
            return 0.0;
        }
        (self.end_radius - self.start_radius) * (self.end_radius + self.start_radius) / (2.0 * self.length)
    }

    /// Signed radius of curvature at arc length `s` [mm].
    pub fn radius(&self, s: f64) -> f64 {
        if self.is_line() {
            return self.start_radius;
        }
        // Counted from the nearer end: at a cusp the square is a small difference, and its root a large error.
        let r = self.base_radius();
        let squared = if s > 0.5 * self.length {
            self.end_radius * self.end_radius - 2.0 * r * (self.length - s)
        } else {
            self.start_radius * self.start_radius + 2.0 * r * s
        };
        self.sense() * squared.clamp(0.0, f64::INFINITY).sqrt()
    }

    /// Signed angle turned up to arc length `s` [rad].
    pub fn turn(&self, s: f64) -> f64 {
        if self.is_line() {
            return 0.0;
        }
        let sum = self.radius(s) + self.start_radius;
        if sum == 0.0 { 0.0 } else { 2.0 * s / sum }
    }

    /// Arc length at which the absolute turned angle is `turn` [mm]: the inverse of [`InvoluteRecord::turn`].
    pub fn length_at_turn(&self, turn: f64) -> f64 {
        let d = self.sense() * turn.abs();
        (self.start_radius * d + 0.5 * self.base_radius() * d * d).clamp(0.0, self.length)
    }

    /// Point and derivatives at arc length `s` [mm] in `[0, length]`. At a cusp the curvature is infinite and
    /// the higher derivatives are not numbers.
    pub fn at(&self, s: f64) -> PlanarJet {
        let (sin0, cos0) = self.angle.sin_cos();
        if self.is_line() {
            let d1 = DVec2::new(cos0, sin0);
            return PlanarJet {
                p: self.start + d1 * s,
                d1,
                d2: DVec2::ZERO,
                d3: DVec2::ZERO,
                angle: self.angle,
                curvature: 0.0,
                curvature_slope: 0.0,
            };
        }
        let turn = self.turn(s);
        let r = self.base_radius();
        let rho = self.radius(s);
        let along = self.start_radius * turn.sin() + r * v_sin_minus_one_minus_cos(turn);
        let left = self.start_radius * one_minus_cos(turn) + r * sin_minus_v_cos(turn);
        let angle = self.angle + turn;
        let (sin, cos) = angle.sin_cos();
        let (t, n) = (DVec2::new(cos, sin), DVec2::new(-sin, cos));
        let k = 1.0 / rho;
        let slope = -r * k * k * k;
        PlanarJet {
            p: self.start + DVec2::new(cos0 * along - sin0 * left, sin0 * along + cos0 * left),
            d1: t,
            d2: n * k,
            d3: n * slope - t * (k * k),
            angle,
            curvature: k,
            curvature_slope: slope,
        }
    }

    /// The point as a series by arc length, at arc length `s` [mm]. Not a number at a cusp, but for the point.
    pub fn series<const N: usize>(&self, s: f64) -> [Taylor<N>; 2] {
        let jet = self.at(s);
        let mut curvature = Taylor::<N>::constant(jet.curvature);
        if self.base_radius() != 0.0 {
            // rho^2 grows by 2 r with the arc length.
            let mut squared = Taylor::<N>::constant(self.radius(s).powi(2));
            if N > 1 {
                squared.0[1] = 2.0 * self.base_radius();
            }
            curvature = squared.sqrt().recip().scaled(self.sense());
        }
        let (sin, cos) = curvature.integrated(jet.angle).sin_cos();
        [cos.integrated(jet.p.x), sin.integrated(jet.p.y)]
    }

    /// Last point [mm].
    pub fn end(&self) -> DVec2 {
        self.at(self.length).p
    }

    /// Centre of the base circle [mm]; for a circle its centre; meaningless for a line.
    pub fn base_centre(&self) -> DVec2 {
        let (sin, cos) = self.angle.sin_cos();
        self.start - DVec2::new(cos, sin) * self.base_radius() + DVec2::new(-sin, cos) * self.start_radius
    }

    /// The same points the other way.
    #[must_use]
    pub fn reversed(&self) -> InvoluteRecord {
        let end = self.at(self.length);
        InvoluteRecord {
            length: self.length,
            start: end.p,
            angle: end.angle + std::f64::consts::PI,
            start_radius: -self.end_radius,
            end_radius: -self.start_radius,
        }
    }

    /// The reflection x -> -x; it swaps the senses.
    #[must_use]
    pub fn mirrored(&self) -> InvoluteRecord {
        InvoluteRecord {
            length: self.length,
            start: DVec2::new(-self.start.x, self.start.y),
            angle: std::f64::consts::PI - self.angle,
            start_radius: -self.start_radius,
            end_radius: -self.end_radius,
        }
    }

    /// The record moved by a translation [mm].
    #[must_use]
    pub fn shifted(&self, by: DVec2) -> InvoluteRecord {
        InvoluteRecord { start: self.start + by, ..*self }
    }

    /// The record turned about the origin [rad].
    #[must_use]
    pub fn rotated(&self, angle: f64) -> InvoluteRecord {
        InvoluteRecord {
            start: DVec2::from_angle(angle).rotate(self.start),
            angle: self.angle + angle,
            ..*self
        }
    }

    /// The parallel curve at signed distance `d` to the left of travel [mm]: again an involute, of the same base
    /// circle.
    ///
    /// # Errors
    /// `KC0801` when a radius would change its sign: the offset curve has a cusp inside.
    pub fn offset(&self, d: f64) -> Result<InvoluteRecord> {
        let (sin, cos) = self.angle.sin_cos();
        let start = self.start + DVec2::new(-sin, cos) * d;
        let (rn, rk) = (self.start_radius - d, self.end_radius - d);
        let crosses = |old: f64, new: f64| {
            old.is_finite() && (old * new < 0.0 || old == 0.0 && new * self.sense() < 0.0)
        };
        if crosses(self.start_radius, rn) || crosses(self.end_radius, rk) {
            return Err(Finding::error(Code::GEOMETRY, "the offset of an involute passes its cusp")
                .value_mm(d)
                .bound_mm(if self.start_radius.abs() < self.end_radius.abs() {
                    self.start_radius
                } else {
                    self.end_radius
                })
                .help("use a smaller offset")
                .into());
        }
        InvoluteRecord::new(self.length - d * self.turn(self.length), start.to_array(), self.angle, rn, rk)
    }

    /// The record cut at arc length `s` [mm] into two.
    pub fn split(&self, s: f64) -> (InvoluteRecord, InvoluteRecord) {
        let s = s.clamp(0.0, self.length);
        let (middle, radius) = (self.at(s), self.radius(s));
        (
            InvoluteRecord { length: s, end_radius: radius, ..*self },
            InvoluteRecord {
                length: self.length - s,
                start: middle.p,
                angle: middle.angle,
                start_radius: radius,
                end_radius: self.end_radius,
            },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn near(a: &InvoluteRecord, b: &InvoluteRecord) -> bool {
        let size = a.start_radius.abs() + a.end_radius.abs() + a.start.length();
        let angle = crate::num::angle::wrap(a.angle - b.angle).abs();
        (a.length - b.length).abs() < 1e-12 * (1.0 + a.length)
            && (a.start - b.start).length() < 1e-12 * size
            && angle < 1e-12
            && (a.start_radius - b.start_radius).abs() < 1e-12 * size
            && (a.end_radius - b.end_radius).abs() < 1e-12 * size
    }

    fn any_record() -> impl Strategy<Value = InvoluteRecord> {
        let span = (0.0..30.0f64, 0.05..30.0f64, 0.01..6.0f64);
        (span, -9.0..9.0f64, -40.0..40.0f64, any::<bool>(), any::<bool>(), any::<bool>()).prop_map(
            |((a, turned, r), angle, x, cw, inward, cusp)| {
                let a = if cusp { 0.0 } else { a };
                let b = a + turned;
                let plain = InvoluteRecord::new(0.5 * r * (b - a) * (b + a), [x, 3.0], angle, r * a, r * b)
                    .expect("radii of one sign");
                let plain = if cw { plain.mirrored() } else { plain };
                if inward { plain.reversed() } else { plain }
            },
        )
    }

    #[test]
    fn the_end_of_a_record_into_its_cusp_keeps_its_angle() {
        let out = InvoluteRecord::new(0.5 * 8.0 * 55.0 * 55.0, [4.0, -3.0], 0.0, 0.0, 8.0 * 55.0).unwrap();
        let back = out.reversed();
        assert!((back.turn(back.length()) - -55.0).abs() < 1e-12);
        assert!((back.end() - out.start()).length() < 1e-11);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn twice_reversed_or_mirrored_is_the_same(record in any_record()) {
            prop_assert!(near(&record.reversed().reversed(), &record), "{record:?}");
            prop_assert!(near(&record.mirrored().mirrored(), &record));
            for u in [0.0, 0.2, 0.9, 1.0] {
                let s = record.length * u;
                let (p, m) = (record.at(s), record.mirrored().at(s));
                prop_assert!((m.p - DVec2::new(-p.p.x, p.p.y)).length() < 1e-11);
                let back = record.reversed().at(record.length - s);
                prop_assert!((back.p - p.p).length() < 1e-11 * (1.0 + record.length), "{record:?}");
            }
        }

        #[test]
        fn the_parts_of_a_split_are_the_whole(record in any_record(), u in 0.0..1.0f64, v in 0.0..1.0f64) {
            let (a, b) = record.split(u * record.length);
            prop_assert!((a.length + b.length - record.length).abs() < 1e-12 * record.length);
            let s = v * record.length;
            let p = if s < a.length { a.at(s) } else { b.at(s - a.length) };
            let size = record.start_radius.abs() + record.end_radius.abs() + 50.0;
            prop_assert!((p.p - record.at(s).p).length() < 1e-11 * size, "{record:?}");
            // A short part carries its base radius with the error of its radii divided by its length.
            let short = a.length.min(b.length);
            prop_assert!(short < 1e-3 * record.length || (a.base_radius() - b.base_radius()).abs() < 1e-8 * record.base_radius().abs());
        }

        #[test]
        fn an_offset_keeps_the_base_circle(record in any_record(), share in -2.0..0.95f64) {
            let least = record.start_radius.abs().min(record.end_radius.abs());
            let d = record.sense() * share * least;
            let moved = record.offset(d).unwrap();
            prop_assert!((moved.base_radius() / record.base_radius() - 1.0).abs() < 1e-9);
            prop_assert!((moved.base_centre() - record.base_centre()).length() < 1e-9);
            // Each point lies d to the left of one of the record's.
            for u in [0.0, 0.4, 1.0] {
                let turn = record.turn(record.length).abs() * u;
                let (p, q) = (record.at(record.length_at_turn(turn)), moved.at(moved.length_at_turn(turn)));
                prop_assert!((q.p - p.p - p.d1.perp() * d).length() < 1e-9, "{} {}", q.p, p.p);
            }
        }
    }

    #[test]
    fn an_offset_past_the_cusp_is_refused() {
        let record = InvoluteRecord::new(15.0, [0.0, 0.0], 0.0, 1.0, 2.0).unwrap();
        assert_eq!(record.offset(1.5).unwrap_err().code(), Code::GEOMETRY);
        assert!(record.offset(-1.5).is_ok());
    }
}
