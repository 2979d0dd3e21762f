//! The modal state that items run under.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{FrameId, SetupId};
use crate::tool::Hand;

/// Index of a state in a program; items of equal state share it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StateId(pub u32);

/// Speed of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// As fast as the machine goes; `linear`: on a straight line, otherwise each axis for itself.
    Rapid {
        /// True if the axes keep to the straight line.
        linear: bool,
    },
    /// Path speed [mm/s].
    PerMinute(f64),
    /// Path per spindle revolution [mm].
    PerRevolution(f64),
    /// The move takes this long [s] (`G93`).
    Duration(f64),
}

impl Speed {
    /// The same kind of speed, `factor` times as fast; a rapid stays what it is.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::program::Speed;
    /// assert_eq!(Speed::PerRevolution(0.2).times(0.5), Speed::PerRevolution(0.1));
    /// assert_eq!(Speed::Duration(3.0).times(0.5), Speed::Duration(6.0));
    /// ```
    pub fn times(self, factor: f64) -> Speed {
        match self {
            Speed::Rapid { .. } => self,
            Speed::PerMinute(feed) => Speed::PerMinute(feed * factor),
            Speed::PerRevolution(feed) => Speed::PerRevolution(feed * factor),
            Speed::Duration(seconds) => Speed::Duration(seconds / factor),
        }
    }

    /// The speed of a part of a move, by its part of the length: a time is shared, all else holds for each part.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::program::Speed;
    /// assert_eq!(Speed::Duration(3.0).of_part(0.5), Speed::Duration(1.5));
    /// assert_eq!(Speed::PerMinute(3.0).of_part(0.5), Speed::PerMinute(3.0));
    /// ```
    pub fn of_part(self, part: f64) -> Speed {
        match self {
            Speed::Duration(seconds) => Speed::Duration(seconds * part),
            other => other,
        }
    }
}

/// Spindle: turning sense seen from the spindle, and speed [rad/s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spindle {
    /// Standing still.
    Off,
    /// `M3`.
    Clockwise(f64),
    /// `M4`.
    CounterClockwise(f64),
}

impl Spindle {
    /// Turning at a rate [rad/s] for a tool of a hand.
    pub fn turning(hand: Hand, rate: f64) -> Spindle {
        match hand {
            Hand::Right => Spindle::Clockwise(rate),
            Hand::Left => Spindle::CounterClockwise(rate),
        }
    }

    /// Its speed [rad/s], negative counter-clockwise; 0 when it is off.
    pub fn signed_rate(self) -> f64 {
        match self {
            Spindle::Off => 0.0,
            Spindle::Clockwise(rate) => rate,
            Spindle::CounterClockwise(rate) => -rate,
        }
    }

    /// Its speed [rad/s]; 0 when it is off.
    pub fn rate(self) -> f64 {
        match self {
            Spindle::Off => 0.0,
            Spindle::Clockwise(rate) | Spindle::CounterClockwise(rate) => rate,
        }
    }
}

/// Transition of the control from one move to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Blend {
    /// A stop at the end of each block.
    Stop,
    /// The path exactly, with a stop only where it turns or its curvature changes at once.
    Exact,
    /// Continuous path, the control's own corner rounding.
    Continuous,
    /// Continuous path within a tolerance.
    Tolerance {
        /// Largest distance from the path at its corners [mm].
        path: f64,
        /// Distance within which the control makes one line of several before that [mm] (`Q` of LinuxCNC's `G64`); zero where
        /// it does not.
        merge: f64,
        /// Largest deviation of rotary axes [rad].
        angle: f64,
    },
}

impl Blend {
    /// A continuous path within a distance [mm], on which no lines are merged.
    pub fn within(path: f64) -> Blend {
        Blend::Tolerance { path, merge: 0.0, angle: 0.0 }
    }

    /// Largest distance from the programmed path [mm]; none where the control rounds as it likes. What the merging of lines
    /// and the rounding of corners take may add up.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::program::Blend;
    /// assert_eq!(Blend::Tolerance { path: 0.25, merge: 0.5, angle: 0.0 }.bound(), Some(0.75));
    /// assert_eq!((Blend::Stop.bound(), Blend::Continuous.bound()), (Some(0.0), None));
    /// ```
    pub fn bound(self) -> Option<f64> {
        match self {
            Blend::Stop | Blend::Exact => Some(0.0),
            Blend::Continuous => None,
            Blend::Tolerance { path, merge, .. } => Some(path + merge),
        }
    }
}

/// Cutter compensation by the control; the path is then the programmed contour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comp {
    /// The path is that of the tool centre.
    Off,
    /// Tool left of the contour, radius from this register.
    Left(u32),
    /// Tool right of the contour, radius from this register.
    Right(u32),
}

/// Control of the tool centre point while rotary axes turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tcp {
    /// None: programmed coordinates are positions of the linear axes.
    #[default]
    Off,
    /// The tip stays on the programmed path, which is fixed to the work; rotary axes go straight from angle to angle
    /// (`G43.4`, `M128`, `TRAORI` with `ORIAXES`).
    Axes,
    /// The tip stays on the programmed path, the tool axis turns in the plane of its two directions (`TRAORI` with
    /// `ORIVECT`).
    Vector,
}

/// Coolant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Coolant {
    /// Off (`M9`).
    Off,
    /// Mist (`M7`).
    Mist,
    /// Flood (`M8`).
    #[default]
    Flood,
    /// Mist and flood (`M7` and `M8`).
    Both,
}

/// The modal state of an item.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Setup.
    pub setup: SetupId,
    /// Frame of the points.
    pub frame: FrameId,
    /// Speed of a move.
    pub speed: Speed,
    /// Spindle.
    pub spindle: Spindle,
    /// Passage between moves.
    pub blend: Blend,
    /// Control of the tool centre point while rotary axes turn.
    pub tcp: Tcp,
    /// Cutter compensation.
    pub comp: Comp,
    /// Coolant.
    pub coolant: Coolant,
}

impl State {
    /// The state at the start of a program: all off, rapid, exact stop.
    pub fn start(setup: SetupId, frame: FrameId) -> State {
        State {
            setup,
            frame,
            speed: Speed::Rapid { linear: false },
            spindle: Spindle::Off,
            blend: Blend::Stop,
            tcp: Tcp::Off,
            comp: Comp::Off,
            coolant: Coolant::Off,
        }
    }
}
