//! Numbers of a bore operation, and their check.
//!
//! Lengths mm, feeds mm/s, angles rad. Points are relative to the bore's centre. Keys of findings are those of the
//! job file's `bore` operation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::clearing::Clearing;
use crate::base::{Code, Finding, Result};
use crate::geom::LensOrder;

/// Direction of the path at the wall, for a right-handed cutter (M3).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Sense {
    /// Counter-clockwise inside a bore.
    #[default]
    Climb,
    /// Clockwise.
    Conventional,
}

/// The cutter as the planner needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutterData {
    /// Diameter [mm].
    pub diameter: f64,
    /// Whether it cuts at its centre, so that it may plunge.
    pub centre_cutting: bool,
    /// Steepest way down it can follow [rad]; `None`: not known.
    pub max_ramp_angle: Option<f64>,
    /// Length of the cutting edges [mm].
    pub flute_length: f64,
}

/// Roughing of a bore.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strategy {
    /// Level by level, each cleared in its plane from the centre or a circle to the wall.
    Clear(Clearing),
    /// Level by level, down along a spiral to the wall and back in its plane: no plunge, the cutter is never
    /// lifted.
    Ramp(LensOrder),
    /// One helix along the wall with a level foot, for bores below twice the cutter's diameter: no core is left.
    Helix {
        /// Largest descent of a turn [mm].
        pitch: f64,
    },
    /// The same for a through bore of any size: the core falls out as a slug.
    Outline {
        /// Largest descent of a turn [mm].
        pitch: f64,
    },
}

impl Strategy {
    /// Name in job files.
    pub fn name(self) -> &'static str {
        match self {
            Strategy::Clear(clearing) => clearing.name(),
            Strategy::Ramp(_) => "ramping",
            Strategy::Helix { .. } => "helix",
            Strategy::Outline { .. } => "outline-helix",
        }
    }
}

/// Start of roughing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RoughStart {
    /// In the centre.
    Centre,
    /// In a point, relative to the centre [mm].
    Point([f64; 2]),
    /// In the centre of a hole drilled before, at least as deep as the bore.
    PreDrilled {
        /// Its diameter [mm].
        diameter: f64,
    },
}

/// Method by which the cutter comes down to a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// The best that this cutter may do: the first possible of the entry table ([`super::entry_table::ways`]).
    Automatic,
    /// Straight down into the material.
    Plunge,
    /// Down a helix about the bore's centre, with a flat turn at its foot.
    Helix {
        /// Radius of the path [mm]; below the cutter's radius, so that no core is left.
        radius: f64,
        /// Largest descent of a turn [mm].
        pitch: f64,
    },
    /// Straight down in the hole drilled before.
    PreDrilled,
}

/// Roughing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rough {
    /// Largest radial step (the paper's H_max) [mm].
    pub stepover: f64,
    /// Largest engagement angle of the cutter [rad], for the strategy that keeps one.
    pub engagement: Option<f64>,
    /// Material left on the wall for finishing [mm].
    pub allowance: f64,
    /// Feed [mm/s].
    pub feed: f64,
    /// Feed of plunges and helices [mm/s].
    pub plunge_feed: f64,
    /// Largest depth of a level [mm]; `None`: as deep as the flutes are long.
    pub stepdown: Option<f64>,
}

impl Rough {
    /// Roughing in radial steps of `stepover` [mm] at `feed` [mm/s], down at a quarter of it, no allowance, levels as deep
    /// as the flutes.
    pub fn new(stepover: f64, feed: f64) -> Rough {
        Rough { stepover, engagement: None, allowance: 0.0, feed, plunge_feed: feed / 4.0, stepdown: None }
    }
}

/// Start of the lead-in, or end of the lead-out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LeadEnd {
    /// Half a turn from the wall, or more where that would not be clear of it; for the lead-out the mirror image of
    /// the lead-in.
    #[default]
    Usual,
    /// In a point, relative to the centre [mm].
    Point([f64; 2]),
    /// At a distance from the centre [mm].
    Radius(f64),
    /// So long a way from the wall [mm].
    Length(f64),
}

/// A finishing pass under the control's cutter compensation, so that the bore's size is set at the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wear {
    /// Radius register (D) of the control; see [`crate::nc::Control::wear_register`].
    pub register: u32,
    /// Largest absolute value that the register may carry [mm]; positive values make the bore smaller, by twice as
    /// much.
    pub largest: f64,
}

/// Finishing of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    /// Turns of the lead-in's involute, counted from the bore's centre: more are flatter and longer.
    pub turns: u32,
    /// Contact of the lead-in with the wall: G2, G4 or G6.
    pub lead: LensOrder,
    /// Feed [mm/s].
    pub feed: f64,
    /// Whether the feed is that of the cutting edge's envelope at the wall: the centre, on its smaller circle, goes
    /// slower.
    pub feed_at_wall: bool,
    /// Start of the lead-in.
    pub start: LeadEnd,
    /// End of the lead-out.
    pub end: LeadEnd,
    /// Further full circles at the wall that take off what the cutter's deflection left.
    pub spring_passes: u32,
    /// Compensation by a wear register.
    pub wear: Option<Wear>,
    /// Largest depth of a level [mm]; `None`: the whole depth at once if the flutes allow.
    pub stepdown: Option<f64>,
}

impl Finish {
    /// Finishing at a feed [mm/s], with a lead-in of two turns, no spring pass, no compensation.
    pub fn new(feed: f64) -> Finish {
        Finish {
            turns: 2,
            lead: LensOrder::Zero,
            feed,
            feed_at_wall: false,
            start: LeadEnd::Usual,
            end: LeadEnd::Usual,
            spring_passes: 0,
            wear: None,
            stepdown: None,
        }
    }
}

/// A bore to be milled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoreSpec {
    /// Centre, in the frame of the setup [mm].
    pub centre: [f64; 2],
    /// Height of the face into which it is milled [mm].
    pub top: f64,
    /// Depth [mm].
    pub depth: f64,
    /// `Some`: a through bore, cut so much deeper than `depth` [mm]; `None`: a blind one.
    pub breakthrough: Option<f64>,
    /// Diameter at the top face [mm].
    pub diameter: f64,
    /// Diameter at the depth, for a conical bore [mm]: it narrows downwards.
    pub bottom_diameter: Option<f64>,
    /// Stock to leave on wall and floor when all is done [mm].
    pub stock_to_leave: [f64; 2],
    /// The cutter.
    pub cutter: CutterData,
    /// Direction.
    pub sense: Sense,
    /// Strategy of roughing.
    pub strategy: Strategy,
    /// Start of roughing.
    pub start: RoughStart,
    /// Method by which the cutter comes down.
    pub entry: Entry,
    /// Roughing, if any.
    pub rough: Option<Rough>,
    /// Finishing, if any.
    pub finish: Option<Finish>,
    /// Height of the plane on which rapids between bores are safe [mm].
    pub retract_z: f64,
    /// Height down to which the approach to the top face is rapid [mm]; as far above every lower level rapids end too.
    pub approach_z: f64,
    /// Resolution of a control with involutes [mm]: base radii become multiples of it. `None`: exact.
    pub resolution: Option<f64>,
}

impl BoreSpec {
    /// A blind bore about the origin, its face at height 0, with a safe plane 50 mm above it: to be completed by
    /// roughing or finishing.
    pub fn new(diameter: f64, depth: f64, cutter: CutterData) -> BoreSpec {
        BoreSpec {
            centre: [0.0, 0.0],
            top: 0.0,
            depth,
            breakthrough: None,
            diameter,
            bottom_diameter: None,
            stock_to_leave: [0.0, 0.0],
            cutter,
            sense: Sense::Climb,
            strategy: Strategy::Clear(Clearing::Involute),
            start: RoughStart::Centre,
            entry: Entry::Automatic,
            rough: None,
            finish: None,
            retract_z: 50.0,
            approach_z: 2.0,
            resolution: None,
        }
    }

    /// Radius of the cutter [mm].
    pub fn cutter_radius(&self) -> f64 {
        0.5 * self.cutter.diameter
    }

    /// Distance above material at which a rapid ends [mm].
    pub fn clearance(&self) -> f64 {
        self.approach_z - self.top
    }

    /// Depth to which the tip goes [mm].
    pub fn full_depth(&self) -> f64 {
        match self.breakthrough {
            Some(beyond) => self.depth + beyond,
            None => self.depth - self.stock_to_leave[1],
        }
    }

    /// Radius of the wanted wall at a height, stock to leave taken off [mm]; below the depth as at it.
    pub fn wall_radius(&self, height: f64) -> f64 {
        let bottom = self.bottom_diameter.unwrap_or(self.diameter);
        let share = ((self.top - height) / self.depth).clamp(0.0, 1.0);
        0.5 * (self.diameter + (bottom - self.diameter) * share) - self.stock_to_leave[0]
    }

    /// Radius of the roughing path at the wall of a level with its floor at a height [mm].
    ///
    /// # Errors
    /// `KC0401` when the cutter does not fit.
    pub fn rough_radius(&self, rough: &Rough, floor: f64) -> Result<f64> {
        path_radius(2.0 * self.wall_radius(floor), self.cutter.diameter, rough.allowance)
    }

    /// Radius of the finishing path in a level with its floor at a height [mm].
    ///
    /// # Errors
    /// `KC0401` when the cutter does not fit.
    pub fn finish_radius(&self, floor: f64) -> Result<f64> {
        path_radius(2.0 * self.wall_radius(floor), self.cutter.diameter, 0.0)
    }

    /// Height of the deepest floor [mm].
    pub fn floor(&self) -> f64 {
        self.top - self.full_depth()
    }
}

/// Radius of the circle on which the cutter centre runs at the wall [mm], equation (14).
///
/// # Errors
/// `KC0401` when it is not positive: cutter and allowance fill the bore.
pub fn path_radius(bore_diameter: f64, cutter_diameter: f64, allowance: f64) -> Result<f64> {
    let radius = 0.5 * (bore_diameter - cutter_diameter) - allowance;
    if radius > 0.0 && radius.is_finite() {
        return Ok(radius);
    }
    Err(Finding::error(Code::CUTTER_TOO_LARGE, "the cutter does not fit into the bore")
        .value_mm(cutter_diameter)
        .bound_mm(bore_diameter - 2.0 * allowance)
        .help("use a cutter smaller than the bore diameter minus twice the allowance")
        .into())
}
