//! What a bore operation is: the numbers of a plan, and their check.
//!
//! Lengths mm, feeds mm/s, angles rad. Points are relative to the bore's centre. Keys of findings are those of the
//! job file's `bore` operation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::clearing::Clearing;
use super::spiral::path_radius;
use crate::base::{Bound, Code, Error, Finding, Result};
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

/// What the planner needs to know of the cutter.
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

/// How a bore is roughed.
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

/// Where roughing begins.
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

/// How the cutter comes down to a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Entry {
    /// The best that this cutter may do: the first possible of the entry table (`entry::ways`).
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

/// Where the lead-in begins, or the lead-out ends.
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
    /// How it is roughed.
    pub strategy: Strategy,
    /// Where roughing begins.
    pub start: RoughStart,
    /// How the cutter comes down.
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

    /// Checks each number on its own, and that the cutter fits; what concerns the entry is checked by
    /// [`super::entry::check`].
    ///
    /// # Errors
    /// `KC0404` with the key of the wrong number, `KC0401` when the cutter does not fit.
    pub fn check(&self) -> Result<()> {
        for (key, value) in
            [("at", self.centre[0]), ("at", self.centre[1]), ("top", self.top), ("retract", self.retract_z)]
        {
            if !value.is_finite() {
                return Err(out_of_range(key, "must be a finite number", value, 0.0));
            }
        }
        positive("depth", self.depth)?;
        positive("diameter", self.diameter)?;
        if let Some(bottom) = self.bottom_diameter {
            positive("bottom_diameter", bottom)?;
            if bottom > self.diameter {
                return Err(out_of_range(
                    "bottom_diameter",
                    "must not exceed the diameter at the top: the cutter cannot reach behind the rim",
                    bottom,
                    self.diameter,
                ));
            }
        }
        not_negative("stock_to_leave", self.stock_to_leave[0])?;
        not_negative("stock_to_leave_floor", self.stock_to_leave[1])?;
        if self.stock_to_leave[1] >= self.depth {
            return Err(out_of_range(
                "stock_to_leave_floor",
                "must be less than the depth",
                self.stock_to_leave[1],
                self.depth,
            ));
        }
        self.check_strategy()?;
        positive("tool.diameter", self.cutter.diameter)?;
        positive("tool.flute_length", self.cutter.flute_length)?;
        if let Some(b) = self.breakthrough {
            not_negative("breakthrough", b)?;
        }
        if let Some(angle) = self.cutter.max_ramp_angle {
            positive("tool.max_ramp_angle", angle)?;
        }
        if let Some(u) = self.resolution {
            positive("resolution", u)?;
        }
        if !(self.approach_z > self.top && self.approach_z.is_finite()) {
            let help = format!("write more than {}", self.top);
            return Err(refused("approach", "must lie above the top face", self.approach_z, self.top, help));
        }
        if self.retract_z < self.approach_z {
            return Err(out_of_range(
                "retract",
                "must not lie below the approach height",
                self.retract_z,
                self.approach_z,
            ));
        }
        if let Some(rough) = &self.rough {
            self.check_rough(rough).map_err(|e| e.under("rough"))?;
        }
        if let Some(finish) = &self.finish {
            self.check_finish(finish).map_err(|e| e.under("finish"))?;
        }
        if self.rough.is_none() && self.finish.is_none() {
            return Err(Finding::error(Code::PLAN_VALUE, "a bore needs roughing or finishing")
                .help("add `rough` or `finish`")
                .into());
        }
        self.finish_radius(self.floor()).map(|_| ())
    }

    fn check_strategy(&self) -> Result<()> {
        if let Strategy::Helix { pitch } | Strategy::Outline { pitch } = self.strategy {
            positive("pitch", pitch)?;
        }
        if matches!(self.strategy, Strategy::Outline { .. }) && self.breakthrough.is_none() {
            return Err(Finding::error(
                Code::PLAN_VALUE,
                "a helix along the outline alone needs a bore that goes through: in a blind one the core stays",
            )
            .help("give `breakthrough`, or clear the bore by another strategy")
            .key("strategy")
            .into());
        }
        let one_radius =
            matches!(self.strategy, Strategy::Helix { .. } | Strategy::Outline { .. } | Strategy::Ramp(_));
        if one_radius && self.bottom_diameter.is_some_and(|d| d != self.diameter) {
            return Err(Finding::error(
                Code::PLAN_VALUE,
                format!("the strategy `{}` cannot follow a conical wall", self.strategy.name()),
            )
            .help("clear a conical bore level by level: `involute`, `lens-1`, `constant-engagement`, ..")
            .key("strategy")
            .into());
        }
        Ok(())
    }

    fn check_rough(&self, rough: &Rough) -> Result<()> {
        positive("stepover", rough.stepover)?;
        not_negative("allowance", rough.allowance)?;
        positive("feed", rough.feed)?;
        positive("plunge_feed", rough.plunge_feed)?;
        if rough.stepover > self.cutter.diameter {
            return Err(out_of_range(
                "stepover",
                "must not exceed the cutter diameter: it would leave ridges",
                rough.stepover,
                self.cutter.diameter,
            ));
        }
        if let Some(angle) = rough.engagement
            && !(angle > 0.0 && angle < std::f64::consts::PI)
        {
            let rule = "must lie between 0 and 180 degrees";
            return Err(Finding::error(Code::PLAN_VALUE, format!("`engagement` {rule}"))
                .value(angle.to_degrees(), "deg")
                .bound(180.0, "deg")
                .key("engagement")
                .into());
        }
        self.axial(rough.stepdown)?;
        self.rough_radius(rough, self.floor()).map(|_| ())
    }

    fn check_finish(&self, finish: &Finish) -> Result<()> {
        if finish.turns == 0 {
            return Err(out_of_range("turns", "must be at least one", 0.0, 1.0));
        }
        LEAD_TURNS.check(f64::from(finish.turns)).map_err(|e| e.under("turns"))?;
        positive("feed", finish.feed)?;
        for (key, end) in [("start", finish.start), ("end", finish.end)] {
            match end {
                LeadEnd::Point([x, y]) if !(x.is_finite() && y.is_finite()) => {
                    return Err(out_of_range(key, "must be finite", x + y, 0.0));
                }
                LeadEnd::Radius(r) => not_negative(&format!("{key}_radius"), r)?,
                LeadEnd::Length(l) => positive(&format!("{key}_length"), l)?,
                LeadEnd::Usual | LeadEnd::Point(_) => {}
            }
        }
        /// More spring passes than that are a slip of the pen.
        const MOST_SPRING: u32 = 20;
        if finish.spring_passes > MOST_SPRING {
            let (value, bound) = (f64::from(finish.spring_passes), f64::from(MOST_SPRING));
            return Err(Finding::error(Code::PLAN_VALUE, "`spring_passes` are too many")
                .value(value, "")
                .bound(bound, "")
                .help("write 0 to 3: more cut nothing")
                .key("spring_passes")
                .into());
        }
        if let Some(wear) = finish.wear {
            positive("wear_largest", wear.largest)?;
            if wear.register == 0 {
                return Err(out_of_range("wear_offset", "needs a register from 1 on", 0.0, 1.0));
            }
        }
        self.axial(finish.stepdown)
    }

    fn axial(&self, step: Option<f64>) -> Result<()> {
        let Some(step) = step else { return Ok(()) };
        positive("stepdown", step)?;
        if step > self.cutter.flute_length {
            return Err(out_of_range(
                "stepdown",
                "must not exceed the flute length",
                step,
                self.cutter.flute_length,
            ));
        }
        Ok(())
    }
}

/// Turns of a lead-in, of which each only lets it begin nearer to the centre.
const LEAD_TURNS: Bound = Bound {
    what: "turns of a lead-in",
    most: 10_000.0,
    bytes: 1000,
    code: Code::PLAN_VALUE,
    help: "write 1 to 5: more only make the way longer",
};

fn out_of_range(key: &str, rule: &str, value: f64, bound: f64) -> Error {
    let help = match value {
        v if !v.is_finite() => "write a number".to_owned(),
        v if v >= bound => format!("write less than {bound}"),
        _ => format!("write {bound} or more"),
    };
    refused(key, rule, value, bound, help)
}

fn refused(key: &str, rule: &str, value: f64, bound: f64, help: impl Into<String>) -> Error {
    Finding::error(Code::PLAN_VALUE, format!("`{key}` {rule}"))
        .value_mm(value)
        .bound_mm(bound)
        .help(help)
        .key(key)
        .into()
}

fn positive(key: &str, value: f64) -> Result<()> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(refused(key, "must be positive", value, 0.0, "write a number above 0"))
    }
}

fn not_negative(key: &str, value: f64) -> Result<()> {
    if value >= 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(refused(key, "must not be negative", value, 0.0, "write 0 or more"))
    }
}
