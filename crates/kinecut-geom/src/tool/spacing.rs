//! Places of the teeth of a cutter: uneven pitch and run-out.

use std::f64::consts::TAU;

use crate::base::{Code, Finding, Result};

/// Places of the teeth about the axis. Empty lists: evenly spaced, without run-out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToothSpacing {
    /// Angle of each tooth about the axis, ascending, from the first [rad].
    pub angles: Vec<f64>,
    /// Run-out of each tooth: distance beyond the nominal radius [mm].
    pub runout: Vec<f64>,
}

impl ToothSpacing {
    /// Angle [rad] and radial deviation [mm] of each of `teeth` teeth.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::ToothSpacing;
    /// let even: Vec<_> = ToothSpacing::default().places(4).collect();
    /// assert_eq!(even[1], (std::f64::consts::FRAC_PI_2, 0.0));
    /// ```
    pub fn places(&self, teeth: u32) -> impl Iterator<Item = (f64, f64)> + '_ {
        (0..teeth as usize).map(move |k| {
            let even = TAU * k as f64 / f64::from(teeth);
            (self.angles.get(k).copied().unwrap_or(even), self.runout.get(k).copied().unwrap_or(0.0))
        })
    }

    /// Greatest thickness of the chips of all teeth at a way into the material for each turn of the tool [mm]: a tooth takes what the
    /// way is since the one before it, and by how much more than that one it reaches out.
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::ToothSpacing;
    /// assert_eq!(ToothSpacing::default().thickest_chip(4, 0.4), 0.1);
    /// // The third tooth comes a third of a turn after the second, and 0.01 mm farther out.
    /// let angles = [0.0, 120.0, 240.0].map(f64::to_radians).to_vec();
    /// let uneven = ToothSpacing { angles, runout: vec![0.0, 0.0, 0.01] };
    /// assert!((uneven.thickest_chip(3, 0.3) - 0.11).abs() < 1e-12);
    /// ```
    pub fn thickest_chip(&self, teeth: u32, way: f64) -> f64 {
        let places: Vec<(f64, f64)> = self.places(teeth).collect();
        let last = places.last().copied().map(|(angle, out)| (angle - TAU, out));
        let before = last.into_iter().chain(places.iter().copied());
        let chip =
            |((from, before), (to, out)): ((f64, f64), &(f64, f64))| way * (to - from) / TAU + out - before;
        before.zip(&places).map(chip).fold(0.0, f64::max)
    }

    /// Checks the lists against the number of teeth and the radius of the cutter [mm].
    ///
    /// # Errors
    /// `KC0701` for lists of another length, angles that do not ascend within a turn, run-out beyond a tenth of the
    /// radius.
    pub fn check(&self, teeth: u32, radius: f64) -> Result<()> {
        let count = |key: &str, n: usize| {
            if n == 0 || n == teeth as usize {
                return Ok(());
            }
            Err(Finding::error(Code::TOOL_VALUE, "each tooth has one place")
                .value(n as f64, "places")
                .bound(f64::from(teeth), "teeth")
                .key(key))
        };
        count("tooth_angles", self.angles.len())?;
        count("runout", self.runout.len())?;
        let ascend = self.angles.windows(2).all(|w| w[0] < w[1]);
        let within = self.angles.iter().all(|a| (0.0..TAU).contains(a));
        if !(ascend && within) {
            return Err(Finding::error(
                Code::TOOL_VALUE,
                "the angles of the teeth must ascend from 0 to below 360 degrees",
            )
            .key("tooth_angles")
            .into());
        }
        // More is no run-out but another tool.
        let most = 0.1 * radius;
        for &r in &self.runout {
            if !(r.abs() <= most) {
                return Err(Finding::error(Code::TOOL_VALUE, "the run-out of a tooth is out of range")
                    .value_mm(r)
                    .bound_mm(most)
                    .key("runout")
                    .into());
            }
        }
        Ok(())
    }
}
