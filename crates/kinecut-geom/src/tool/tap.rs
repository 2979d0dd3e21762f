//! Taps: tools that make an internal thread of the ISO profile (60 degrees) along their axis.
//!
//! Source of the profile: ISO 68-1, with H = P sqrt(3) / 2 the height of the sharp triangle: the minor diameter is D - 10/8 H, the
//! pitch diameter D - 6/8 H. The tolerance of the minor diameter in class 6H is ISO 965-1: 230 P^0.7 um from a pitch of 1 mm on,
//! 433 P - 190 P^1.22 um below. Core holes: D - P for taps that cut (ISO 2306), D - 0.5 P to D - 0.42 P for taps that form.
//! Leads: DIN 2197.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::{Code, Finding, Result};

/// Diameter by which a core hole may be smaller or larger than its bounds [mm]: the rounding of drills in stock.
const ROUNDING: f64 = 0.01;

/// A tap [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tap {
    /// Nominal (major) diameter of the thread.
    pub diameter: f64,
    /// Pitch: the way of one revolution.
    pub pitch: f64,
    /// Length of the lead, in pitches: the part at its end that leaves no full thread.
    pub lead: f64,
    /// Length of the point below the lead.
    pub tip: f64,
    /// Whether it forms the thread without chips.
    pub forming: bool,
}

/// Form of a tap's lead (DIN 2197).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum ChamferForm {
    /// 6 to 8 pitches, for short through holes.
    A,
    /// 3.5 to 5.5 pitches, with a spiral point: chips go ahead, for through holes.
    B,
    /// 2 to 3 pitches: blind holes.
    #[default]
    C,
    /// 3.5 to 5 pitches.
    D,
    /// 1.5 to 2 pitches: blind holes with little room.
    E,
    /// 1 to 1.5 pitches: blind holes with very little room.
    F,
}

impl ChamferForm {
    /// The longest lead that the form allows, in pitches: with it the thread is full in any case.
    pub fn longest(self) -> f64 {
        match self {
            ChamferForm::A => 8.0,
            ChamferForm::B => 5.5,
            ChamferForm::C => 3.0,
            ChamferForm::D => 5.0,
            ChamferForm::E => 2.0,
            ChamferForm::F => 1.5,
        }
    }
}

impl Tap {
    /// Name of its thread: "M8x1.25".
    pub fn name(&self) -> String {
        format!("M{}x{}", self.diameter, self.pitch)
    }

    /// Height of the sharp triangle of the profile [mm].
    fn height(&self) -> f64 {
        0.5 * 3f64.sqrt() * self.pitch
    }

    /// Minor diameter D1 of the thread [mm].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::Tap;
    /// let m8 = Tap { diameter: 8.0, pitch: 1.25, lead: 2.0, tip: 0.0, forming: false };
    /// assert!((m8.minor_diameter() - 6.646835306586815).abs() < 1e-9);
    /// ```
    pub fn minor_diameter(&self) -> f64 {
        self.diameter - 1.25 * self.height()
    }

    /// Pitch diameter D2 of the thread [mm].
    pub fn pitch_diameter(&self) -> f64 {
        self.diameter - 0.75 * self.height()
    }

    /// Usual diameter of the core hole [mm].
    pub fn core_diameter(&self) -> f64 {
        self.diameter - if self.forming { 0.5 * self.pitch } else { self.pitch }
    }

    /// Least and largest diameter of the core hole [mm]: of a tap that cuts from the minor diameter up to its limit in class 6H.
    pub fn core_bounds(&self) -> [f64; 2] {
        let p = self.pitch;
        if self.forming {
            return [self.diameter - 0.5 * p, self.diameter - 0.42 * p];
        }
        let tolerance = if p >= 1.0 { 230.0 * p.powf(0.7) } else { 433.0 * p - 190.0 * p.powf(1.22) };
        [self.minor_diameter(), self.minor_diameter() + tolerance * 1e-3]
    }

    /// The bound that a core hole of a diameter [mm] breaks by more than the rounding of drills.
    pub fn core_misfit(&self, core: f64) -> Option<f64> {
        let [least, most] = self.core_bounds();
        if core < least - ROUNDING {
            return Some(least);
        }
        (core > most + ROUNDING).then_some(most)
    }

    /// Height of the thread that a core hole of a diameter [mm] leaves, as a share of that of the ISO profile.
    pub fn thread_share(&self, core: f64) -> f64 {
        (self.diameter - core) / (1.25 * self.height())
    }

    /// Way from the last full thread to the lowest point of the tap [mm].
    pub fn below_thread(&self) -> f64 {
        self.lead * self.pitch + self.tip
    }

    /// Checks that the numbers make a tap.
    ///
    /// # Errors
    /// `KC0701` with the key of the wrong one.
    pub fn check(&self) -> Result<()> {
        let most = self.diameter / 1.5;
        for (key, value, least, most, unit) in [
            ("diameter", self.diameter, f64::MIN_POSITIVE, 1000.0, "mm"),
            ("pitch", self.pitch, f64::MIN_POSITIVE, most, "mm"),
            ("lead", self.lead, f64::MIN_POSITIVE, 20.0, "pitches"),
            ("tip_length", self.tip, 0.0, 2.0 * self.diameter, "mm"),
        ] {
            if !(value >= least && value <= most) {
                let finding = Finding::error(Code::TOOL_VALUE, format!("the {key} of a tap is out of range"));
                let bound = if value < least { least.floor() } else { most };
                let from = if least > 0.0 { "above 0, at most" } else { "from 0 to" };
                let help = format!("write a number {from} {most:.3} {unit}");
                return Err(finding.value(value, unit).bound(bound, unit).help(help).key(key).into());
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn core_and_flank_diameters_are_those_of_the_profile() {
        // D, P; D2, D1; core holes of taps that cut and that form; share of the thread at the first.
        let cases = [
            ([6.0, 1.0], [5.350480947161671, 4.917468245269452], [5.0, 5.5], 0.9237604307034013),
            ([8.0, 1.25], [7.188101183952089, 6.646835306586815], [6.75, 7.375], 0.9237604307034013),
            ([12.0, 1.75], [10.863341657532924, 10.105569429221541], [10.25, 11.125], 0.9237604307034013),
            ([16.0, 2.0], [14.700961894323342, 13.834936490538905], [14.0, 15.0], 0.9237604307034013),
            ([3.0, 0.5], [2.6752404735808355, 2.458734122634726], [2.5, 2.75], 0.9237604307034013),
            ([4.0, 0.7], [3.54533666301317, 3.2422277716886163], [3.3, 3.65], 0.9237604307034013),
        ];
        for ([diameter, pitch], [flank, minor], [cut, form], share) in cases {
            let tap = Tap { diameter, pitch, lead: 2.0, tip: 0.0, forming: false };
            let forming = Tap { forming: true, ..tap };
            for (found, wanted) in [
                (tap.pitch_diameter(), flank),
                (tap.minor_diameter(), minor),
                (tap.core_diameter(), cut),
                (forming.core_diameter(), form),
                (tap.thread_share(cut), share),
            ] {
                assert!((found - wanted).abs() < 1e-9, "M{diameter}: {found} {wanted}");
            }
            for tap in [tap, forming] {
                assert_eq!(tap.core_misfit(tap.core_diameter()), None, "M{diameter}");
            }
        }
        // ISO 965-1, class 6H: M8 6.912, M3 2.599, each rounded to 5 um there.
        let most = |diameter: f64, pitch: f64| {
            Tap { diameter, pitch, lead: 2.0, tip: 0.0, forming: false }.core_bounds()[1]
        };
        assert!((most(8.0, 1.25) - 6.912).abs() < 6e-3 && (most(3.0, 0.5) - 2.599).abs() < 6e-3);
        let m8 = Tap { diameter: 8.0, pitch: 1.25, lead: 2.0, tip: 0.0, forming: false };
        assert_eq!(m8.core_misfit(6.4), Some(m8.minor_diameter()));
        assert_eq!(m8.core_misfit(7.0), Some(m8.core_bounds()[1]));
    }
}
