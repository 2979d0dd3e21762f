//! Threads: their profiles, and the diameters that follow.
//!
//! Sources: ISO 68-1 (60 degrees, H = P / (2 tan 30)), BS 84 (Whitworth, 55 degrees, a sixth of H rounded off at both ends),
//! ASME B1.20.1 (NPT, 60 degrees, height 0.8 P, 1 in 16 on the diameter).

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::tool::Hand;

/// Side of the thread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ThreadSide {
    /// In a hole.
    #[default]
    Inside,
    /// On a boss.
    Outside,
}

/// Profile of a thread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ThreadForm {
    /// ISO metric and UN: 60 degrees.
    #[default]
    Metric,
    /// Whitworth, G and R: 55 degrees.
    Whitworth,
    /// NPT: 60 degrees, sharper.
    Npt,
}

/// A thread [mm].
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::threading::{Thread, ThreadForm};
/// let m8 = Thread::new(ThreadForm::Metric, 8.0, 1.25);
/// assert!((m8.pitch_diameter() - 7.188101183952089).abs() < 1e-9);
/// assert!((m8.minor_diameter() - 6.646835306586815).abs() < 1e-9);
/// assert!((m8.root_diameter() - 6.466413347465057).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thread {
    /// Profile.
    pub form: ThreadForm,
    /// Major diameter; of a taper thread at its mouth.
    pub diameter: f64,
    /// Pitch: the way of one turn.
    pub pitch: f64,
    /// Hand.
    pub hand: Hand,
    /// Change of the diameter over a length along the axis; 0 for a cylindrical thread. A hole is widest at its mouth, a boss
    /// narrowest.
    pub taper: f64,
}

impl ThreadForm {
    /// Angle between a flank and a plane across the axis [rad].
    pub fn half_angle(self) -> f64 {
        match self {
            ThreadForm::Metric | ThreadForm::Npt => 30.0_f64.to_radians(),
            ThreadForm::Whitworth => 27.5_f64.to_radians(),
        }
    }

    /// Heights from the major diameter down to the pitch line, to the minor diameter of a hole and to the root of a bolt, in
    /// pitches.
    fn heights(self) -> [f64; 3] {
        let sharp = 0.5 / self.half_angle().tan();
        match self {
            // An eighth of H is off at the crest, a quarter in the nut, a sixth at the root.
            ThreadForm::Metric => [3.0 / 8.0, 5.0 / 8.0, 17.0 / 24.0].map(|share| share * sharp),
            ThreadForm::Whitworth => [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0].map(|share| share * sharp),
            ThreadForm::Npt => [0.4, 0.8, 0.8],
        }
    }
}

impl Thread {
    /// A cylindrical right-hand thread.
    pub fn new(form: ThreadForm, diameter: f64, pitch: f64) -> Thread {
        Thread { form, diameter, pitch, hand: Hand::Right, taper: 0.0 }
    }

    /// Pitch diameter D2 [mm]; of a taper thread at its mouth, as all diameters.
    pub fn pitch_diameter(&self) -> f64 {
        self.diameter - 2.0 * self.form.heights()[0] * self.pitch
    }

    /// Minor diameter D1, that of the core hole [mm].
    pub fn minor_diameter(&self) -> f64 {
        self.diameter - 2.0 * self.form.heights()[1] * self.pitch
    }

    /// Root diameter d3 of a thread on a boss [mm].
    pub fn root_diameter(&self) -> f64 {
        self.diameter - 2.0 * self.form.heights()[2] * self.pitch
    }

    /// Depth of the groove that is cut [mm].
    pub fn height(&self, side: ThreadSide) -> f64 {
        match side {
            ThreadSide::Inside => self.form.heights()[1] * self.pitch,
            ThreadSide::Outside => self.form.heights()[2] * self.pitch,
        }
    }

    /// Height from the bottom of the groove, where the tool's crests run, up to the pitch line [mm].
    pub fn crest_height(&self, side: ThreadSide) -> f64 {
        let [pitch_line, _, root] = self.form.heights();
        match side {
            ThreadSide::Inside => pitch_line * self.pitch,
            ThreadSide::Outside => (root - pitch_line) * self.pitch,
        }
    }

    /// Change of the radius from the mouth down to a depth [mm].
    pub fn widening(&self, side: ThreadSide, depth: f64) -> f64 {
        let change = 0.5 * self.taper * depth;
        match side {
            ThreadSide::Inside => -change,
            ThreadSide::Outside => change,
        }
    }

    /// Change of the radius in a turn [mm].
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::threading::{Thread, ThreadForm};
    /// let npt = Thread { taper: 1.0 / 16.0, ..Thread::new(ThreadForm::Npt, 21.223, 25.4 / 14.0) };
    /// assert!((npt.radius_per_turn() - 0.05669642857142857).abs() < 1e-12);
    /// assert!((npt.taper_angle().to_degrees() - 1.7899106082460694).abs() < 1e-9);
    /// ```
    pub fn radius_per_turn(&self) -> f64 {
        0.5 * self.taper * self.pitch
    }

    /// Angle between the axis and a line along the crests [rad].
    pub fn taper_angle(&self) -> f64 {
        (0.5 * self.taper).atan()
    }

    /// Name: "M8x1.25", "20 x 1.5 Whitworth"; with its taper and hand.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::threading::{Thread, ThreadForm};
    /// let npt = Thread { taper: 1.0 / 16.0, ..Thread::new(ThreadForm::Npt, 21.223, 1.8143) };
    /// assert_eq!(npt.name(), "21.223 x 1.8143 NPT taper 1 in 16");
    /// ```
    pub fn name(&self) -> String {
        let [d, p] = [self.diameter, self.pitch].map(|v| (v * 1e4).round() / 1e4);
        let size = match self.form {
            ThreadForm::Metric => format!("M{d}x{p}"),
            ThreadForm::Whitworth => format!("{d} x {p} Whitworth"),
            ThreadForm::Npt => format!("{d} x {p} NPT"),
        };
        let taper =
            if self.taper > 0.0 { format!(" taper 1 in {}", shown(1.0 / self.taper)) } else { String::new() };
        size + &taper + if self.hand == Hand::Left { " left-hand" } else { "" }
    }
}

/// A number with the digits that it needs, at most three decimals.
pub(super) fn shown(value: f64) -> String {
    format!("{}", (value * 1e3).round() / 1e3 + 0.0)
}
