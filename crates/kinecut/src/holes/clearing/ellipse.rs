//! The spiral that grows from a circle into an ellipse: `q = inner + W(th)/(2 pi N) (Q(th) - inner)`, and the lap at
//! the wall.
//!
//! Neighbouring turns lie `(Q - inner)/N` apart along their common normal, so N follows from the largest Q. The wall
//! is met with the contact of the weight W; at the circle likewise.

use std::f64::consts::TAU;

use crate::base::{Code, Finding, Result};
use crate::geom::{LensOrder, PlaneCurve, Spiral, Support};
use crate::holes::spiral::{from_centre, turns};

/// The disc inside an ellipse that is to be cleared; half axes along X and Y, about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticDisc {
    /// Half axes of the wall [mm].
    pub half_axes: [f64; 2],
    /// Radius of the cutter [mm].
    pub cutter: f64,
    /// Material left on the wall [mm].
    pub allowance: f64,
    /// Radius of the circle from which the cutter's centre starts [mm]; zero: it starts in the centre.
    pub inner: f64,
    /// Largest normal step [mm].
    pub step: f64,
    /// Order of the contact with circle and wall.
    pub order: LensOrder,
}

/// A cleared elliptic disc.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearedEllipse {
    /// From the centre or the circle to the wall, counter-clockwise, each curve starting where the last one ended.
    pub curves: Vec<PlaneCurve>,
    /// Radius of the circle from which the spiral grows [mm].
    pub inner: f64,
    /// The lap at the wall.
    pub lap: PlaneCurve,
    /// The way from the wall back inside: the mirror image of the spiral's last half turn.
    pub back: PlaneCurve,
    /// Turns of the spiral.
    pub turns: u32,
    /// Largest normal step [mm].
    pub step: f64,
}

impl EllipticDisc {
    fn offset(&self) -> f64 {
        self.cutter + self.allowance
    }

    /// Half axes of the path's hull: of the parallel at the wall [mm].
    fn reach(&self) -> [f64; 2] {
        self.half_axes.map(|h| h - self.offset())
    }

    /// The path.
    ///
    /// ```
    /// use kinecut::geom::LensOrder;
    /// use kinecut::holes::clearing::EllipticDisc;
    /// let disc = EllipticDisc {
    ///     half_axes: [60.0, 40.0], cutter: 8.0, allowance: 0.5, inner: 5.0, step: 4.0, order: LensOrder::One,
    /// };
    /// let path = disc.path().unwrap();
    /// assert_eq!(path.turns, 12); // (60 - 8.5 - 5) / 4, rounded up
    /// ```
    ///
    /// # Errors
    /// `KC0401` when the cutter does not fit, or not into the ends of the long axis (with the place); `KC0404` for
    /// numbers that give no path.
    pub fn path(&self) -> Result<ClearedEllipse> {
        self.check()?;
        let [a, b] = self.reach();
        let (long, short) = if a > b { (a, b) } else { (b, a) };
        let mut curves = Vec::new();
        let mut inner = self.inner;
        if inner == 0.0 {
            // A first turn to a small circle: straight from the centre the radius of curvature would begin at zero.
            inner = self.step.min(0.5 * short);
            curves.push(from_centre(inner, 1, 0.0)?.into());
        }
        let n = turns(long - inner, self.step)?;
        let law = self.law(inner, n);
        let whole = TAU * f64::from(n);
        self.check_radius(&law, whole)?;
        let spiral = Spiral::new(law.into(), 0.0, whole)?;
        let lap = Support::Ellipse { half_axes: self.half_axes, offset: self.offset() };
        let back = spiral.between(whole - 0.5 * TAU, whole).mirrored().reversed();
        curves.push(spiral.into());
        Ok(ClearedEllipse {
            curves,
            inner,
            lap: Spiral::new(lap.into(), 0.0, TAU)?.into(),
            back: back.into(),
            turns: n,
            step: (long - inner) / f64::from(n),
        })
    }

    /// The last `part` turns [rad] of a spiral of a few turns to the wall: a lead-in.
    ///
    /// # Errors
    /// As [`EllipticDisc::path`].
    pub fn lead(&self, turns: u32, part: f64) -> Result<PlaneCurve> {
        self.check()?;
        let [a, b] = self.reach();
        let law = self.law(0.5 * if a > b { b } else { a }, turns);
        let whole = TAU * f64::from(turns);
        self.check_radius(&law, whole)?;
        Ok(Spiral::new(law.into(), whole - part, whole)?.into())
    }

    fn law(&self, inner: f64, n: u32) -> Support {
        let (half_axes, offset, order) = (self.half_axes, self.offset(), self.order);
        Support::Morph { inner, half_axes, offset, turns: f64::from(n), order }
    }

    fn check(&self) -> Result<()> {
        for (key, value) in
            [("half_axes", self.half_axes[0]), ("half_axes", self.half_axes[1]), ("step", self.step)]
        {
            if !(value > 0.0 && value.is_finite()) {
                let what = format!("`{key}` must be positive");
                return Err(Finding::error(Code::PLAN_VALUE, what)
                    .value_mm(value)
                    .bound_mm(0.0)
                    .key(key)
                    .into());
            }
        }
        let [a, b] = self.half_axes;
        let (long, short) = if a > b { (a, b) } else { (b, a) };
        if short <= self.offset() {
            return Err(Finding::error(Code::CUTTER_TOO_LARGE, "the cutter does not fit into the pocket")
                .value_mm(2.0 * self.cutter)
                .bound_mm(2.0 * (short - self.allowance))
                .cure("use a cutter smaller than the short axis minus twice the allowance")
                .key("half_axes")
                .into());
        }
        let least = short * short / long;
        if least <= self.offset() {
            let end = if a > b { [a, 0.0] } else { [0.0, b] };
            return Err(Finding::error(
                Code::CUTTER_TOO_LARGE,
                format!(
                    "the cutter does not fit into the ends of the long axis, at X{} Y{} from the centre and \
                     opposite: the radius of curvature there is too small",
                    end[0], end[1]
                ),
            )
            .value_mm(least)
            .bound_mm(self.offset())
            .cure(format!("use a cutter of a diameter below {:.3} mm", 2.0 * (least - self.allowance)))
            .key("half_axes")
            .into());
        }
        if !(self.inner >= 0.0 && self.inner < short - self.offset()) {
            return Err(Finding::error(
                Code::PLAN_VALUE,
                "the circle from which the spiral starts must lie inside the path at the wall",
            )
            .value_mm(self.inner)
            .bound_mm(short - self.offset())
            .cure("enter on a smaller circle")
            .key("entry.radius")
            .into());
        }
        Ok(())
    }

    /// The radius of curvature must stay positive all along.
    fn check_radius(&self, law: &Support, whole: f64) -> Result<()> {
        /// Looks in a turn: the radius of curvature is a sum of harmonics up to about the tenth.
        const LOOKS: f64 = 128.0;
        let count = (whole / TAU * LOOKS).ceil();
        for i in 0..=count as u64 {
            let theta = whole * (i as f64 / count);
            let radius = law.radius(theta);
            if !(radius > 0.0) {
                let p = crate::geom::Law::from(*law).series::<1>(theta).map(|c| c.value());
                return Err(Finding::error(
                    Code::PLAN_VALUE,
                    format!(
                        "the ellipse is too slender: the spiral would turn back on itself at X{:.3} Y{:.3}",
                        p[0], p[1]
                    ),
                )
                .value_mm(radius)
                .bound_mm(0.0)
                .cure("use smaller steps, or a larger circle of entry")
                .key("half_axes")
                .into());
            }
        }
        Ok(())
    }
}
