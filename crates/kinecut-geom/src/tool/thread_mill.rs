//! Thread mills: teeth of the form of a thread in one or more rows, on a neck.

use std::f64::consts::FRAC_PI_4;

use crate::base::{Code, Error, Finding, Result};

/// Most rows of teeth along the axis.
const MOST_ROWS: u32 = 9999;
/// Length that is rounding [mm].
const ROUNDING: f64 = 1e-9;

/// The teeth of a thread mill, and its neck [mm, rad].
///
/// The middle of the lowest row lies half a pitch above the tip, each further one a pitch higher. As a body the tool is the
/// cylinder of its crests: the grooves between the rows are no part of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThreadMill {
    /// Diameter at the crests of the teeth.
    pub diameter: f64,
    /// Pitch of the thread for which they are made.
    pub pitch: f64,
    /// Rows of teeth along the axis.
    pub rows: u32,
    /// Angle between a flank and a plane across the axis.
    pub half_angle: f64,
    /// The neck between teeth and shank.
    pub neck: Option<Neck>,
}

/// A neck between the cutting part and the shank [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neck {
    /// Diameter.
    pub diameter: f64,
    /// Height above the tip at which it ends.
    pub top: f64,
}

impl ThreadMill {
    /// Height of the rows together [mm].
    ///
    /// ```
    /// # use kinecut_geom as kinecut;
    /// use kinecut::tool::ThreadMill;
    /// let mill = ThreadMill { diameter: 6.0, pitch: 1.25, rows: 12, half_angle: 30f64.to_radians(), neck: None };
    /// assert_eq!(mill.height(), 15.0);
    /// ```
    pub fn height(&self) -> f64 {
        f64::from(self.rows) * self.pitch
    }

    /// Checks that the numbers make a thread mill.
    ///
    /// # Errors
    /// `KC0701` with the key of the wrong one.
    pub fn check(&self) -> Result<()> {
        let positive = |v: f64| v.is_finite() && v > 0.0;
        if !positive(self.diameter) {
            return Err(refused(
                "diameter",
                "the diameter must be positive",
                [self.diameter, 0.0],
                "write the diameter at the crests of the teeth",
            ));
        }
        if !(positive(self.pitch) && self.pitch < self.diameter) {
            let bound = if positive(self.pitch) { self.diameter } else { 0.0 };
            let what = "the pitch must lie between 0 and the diameter of the thread mill";
            return Err(refused(
                "pitch",
                what,
                [self.pitch, bound],
                "write the pitch of the thread that the tool is made for",
            ));
        }
        if !(1..=MOST_ROWS).contains(&self.rows) {
            let finding = Finding::error(Code::TOOL_VALUE, "the number of rows of teeth is out of range");
            let bound = if self.rows == 0 { 1 } else { MOST_ROWS };
            let finding = finding.value(f64::from(self.rows), "").bound(f64::from(bound), "");
            return Err(finding
                .help("write the rows along the axis, 1 for a single-row tool")
                .key("rows")
                .into());
        }
        if !(self.half_angle > 0.0 && self.half_angle <= FRAC_PI_4) {
            let what = "the half angle of a thread lies above 0 and at most at 45 degrees";
            let finding = Finding::error(Code::TOOL_VALUE, what).value(self.half_angle.to_degrees(), "deg");
            return Err(finding
                .bound(45.0, "deg")
                .help("write half of the angle between the flanks: 30 for metric and NPT, 27.5 for Whitworth")
                .key("half_angle")
                .into());
        }
        if let Some(Neck { diameter, .. }) = self.neck
            && !(positive(diameter) && diameter <= self.diameter)
        {
            let what = "the neck is not wider than the crests of the teeth";
            return Err(refused(
                "neck_diameter",
                what,
                [diameter, self.diameter],
                "write the diameter of the thin part above the teeth, or leave the neck out",
            ));
        }
        Ok(())
    }

    /// Checks it against the lengths of its tool [mm] and the diameter of its shank.
    pub(super) fn check_lengths(&self, flute_length: f64, stickout: f64, shank: f64) -> Result<()> {
        if flute_length < self.height() - ROUNDING {
            let what = "the cutting part is shorter than its rows of teeth";
            return Err(refused(
                "flute_length",
                what,
                [flute_length, self.height()],
                "write at least rows times pitch, or fewer rows",
            ));
        }
        let Some(neck) = self.neck else { return Ok(()) };
        if !(neck.top >= flute_length && neck.top <= stickout) {
            let bound = if neck.top >= flute_length { stickout } else { flute_length };
            let what = "the neck ends between the cutting part and the holder";
            return Err(refused(
                "neck_length",
                what,
                [neck.top, bound],
                "write its end as a height above the tip, from the flute length up to the stickout",
            ));
        }
        if shank < neck.diameter - ROUNDING {
            return Err(refused(
                "neck_diameter",
                "the neck is not wider than the shank",
                [neck.diameter, shank],
                "correct neck_diameter or shank_diameter",
            ));
        }
        Ok(())
    }
}

fn refused(key: &str, what: &str, [value, bound]: [f64; 2], help: &str) -> Error {
    Finding::error(Code::TOOL_VALUE, what).value_mm(value).bound_mm(bound).help(help).key(key).into()
}
