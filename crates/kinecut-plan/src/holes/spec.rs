//! Numbers of a bore operation, in the words of the job file.
//!
//! Lengths mm, feeds mm/s, angles rad; in a file feeds are mm/min and angles degrees. Points are in the frame of the setup.
//! Keys of findings are those of the job file's `bore` operation.

use std::f64::consts::{FRAC_PI_2, PI};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::strategy::Strategy;
use crate::base::unit::{Deg, MmPerMin};
use crate::base::{Code, Finding, Result};
use crate::geom::LensOrder;
use crate::num::angle::wrap;
use crate::tool::Tool;

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

impl CutterData {
    /// The cutter of a tool.
    pub fn of(tool: &Tool) -> CutterData {
        CutterData {
            diameter: tool.cutter.diameter(tool.flute_length),
            flute_length: tool.flute_length,
            centre_cutting: tool.centre_cutting,
            max_ramp_angle: tool.max_ramp_angle,
        }
    }
}

/// Way of the cutter down to depth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Entry {
    /// Straight down; needs a cutter that cuts at its centre.
    Plunge,
    /// Down a helix.
    Helix {
        /// Radius of the tool centre's helix; below the cutter's radius no core is left.
        #[schemars(example = 4)]
        radius: f64,
        /// Depth of one turn.
        #[schemars(example = 1)]
        pitch: f64,
    },
    /// Into a hole that is there.
    PreDrilled {
        /// Diameter of the hole about the bore's centre.
        #[schemars(example = 20)]
        diameter: f64,
    },
}

/// Roughing of a bore [mm, mm/s, rad]; in a file feeds are mm/min and angles degrees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rough {
    /// Largest distance of neighbouring turns; `constant-engagement` may leave it to the engagement, and the helices have
    /// no turns side by side.
    #[serde(default, alias = "step")]
    pub stepover: Option<f64>,
    /// Largest engagement angle of the cutter, for `constant-engagement`; degrees in a file.
    #[serde(default, with = "Deg::<Option<f64>>")]
    pub engagement: Option<f64>,
    /// Largest descent of a turn, for `helix` and `outline-helix`; default: as steep as the cutter is known to follow.
    #[serde(default)]
    pub pitch: Option<f64>,
    /// Allowance left on the wall for finishing; default 0.
    #[serde(default)]
    pub allowance: f64,
    /// Feed; mm/min in a file.
    #[serde(with = "MmPerMin")]
    #[schemars(example = 600)]
    pub feed: f64,
    /// Feed of plunge and helix, mm/min in a file; default: a quarter of the feed.
    #[serde(default, with = "MmPerMin::<Option<f64>>")]
    pub plunge_feed: Option<f64>,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default, alias = "axial_step")]
    pub stepdown: Option<f64>,
    /// Point at which the spiral starts instead of the centre, in coordinates of the work offset.
    #[serde(default)]
    pub start: Option<[f64; 2]>,
    /// Direction from the bore's centre in which the path touches the wall, counter-clockwise from X, degrees in a file;
    /// default -90, below the centre for climb and conventional. Not with a `start` off the centre, which fixes it.
    #[serde(default, with = "Deg::<Option<f64>>")]
    pub touch_angle: Option<f64>,
}

impl Rough {
    /// Roughing in radial steps of `stepover` [mm] at `feed` [mm/s], down at a quarter of it, no allowance, levels as deep
    /// as the flutes.
    pub fn new(stepover: f64, feed: f64) -> Rough {
        Rough { stepover: Some(stepover), ..Rough::at(feed) }
    }

    /// Roughing for `constant-engagement` whose steps the engagement angle [rad] alone limits, at `feed` [mm/s]; the
    /// rest as of [`Rough::new`].
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::holes::*;
    /// let cutter = CutterData { diameter: 40.0, centre_cutting: false, max_ramp_angle: None, flute_length: 45.0 };
    /// let spec = BoreSpec {
    ///     strategy: Strategy::ConstantEngagement,
    ///     entry: Some(Entry::Helix { radius: 10.0, pitch: 2.0 }),
    ///     rough: Some(Rough { allowance: 1.0, ..Rough::by_engagement(60f64.to_radians(), 100.0) }),
    ///     ..BoreSpec::new(200.0, 30.0, cutter)
    /// };
    /// // From 10 mm to 79 mm; steps of 3.95 mm would take 18.
    /// assert_eq!(plan_bore(&spec).unwrap().rough.unwrap().turns, 11.0);
    /// ```
    pub fn by_engagement(engagement: f64, feed: f64) -> Rough {
        Rough { engagement: Some(engagement), ..Rough::at(feed) }
    }

    /// Roughing at a feed [mm/s], without a limit of its steps.
    fn at(feed: f64) -> Rough {
        Rough {
            stepover: None,
            engagement: None,
            pitch: None,
            allowance: 0.0,
            feed,
            plunge_feed: None,
            stepdown: None,
            start: None,
            touch_angle: None,
        }
    }

    /// Feed of plunges and helices [mm/s].
    pub fn plunge_feed(&self) -> f64 {
        self.plunge_feed.unwrap_or(self.feed / 4.0)
    }
}

/// The error of a roughing without a step where it needs one; `most` is the largest [mm].
pub(super) fn no_stepover(what: &str, most: f64) -> Finding {
    Finding::error(Code::PLAN_VALUE, format!("{what} needs `stepover`"))
        .bound_mm(most)
        .help(format!("write stepover = .., up to the cutter's diameter of {most} mm"))
        .key("stepover")
}

/// Start of the lead-in, or end of the lead-out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LeadEnd {
    /// Half a turn from the wall, or more where that would not be clear of it; for the lead-out the mirror image of
    /// the lead-in.
    #[default]
    Usual,
    /// In a point, in the frame of the setup [mm].
    Point([f64; 2]),
    /// At a distance from the centre [mm].
    Radius(f64),
    /// So long a way from the wall [mm].
    Length(f64),
    /// Where the lead's radius of curvature is this [mm]: the paper's Rn of a lead-in, Rk of a lead-out. At the wall it
    /// is the radius of the path there.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::holes::*;
    /// let cutter =
    ///     CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: None, flute_length: 45.0 };
    /// let spec = BoreSpec {
    ///     rough: Some(Rough { allowance: 1.0, ..Rough::new(4.0, 100.0) }),
    ///     finish: Some(Finish {
    ///         start: LeadEnd::CurvatureRadius(57.5810791850552),
    ///         ..Finish::new(50.0)
    ///     }),
    ///     ..BoreSpec::new(200.0, 30.0, cutter)
    /// };
    /// // That of the paper's lead-in from (-40, 40).
    /// let finish = plan_bore(&spec).unwrap().finish.unwrap();
    /// assert!((finish.length - 242.249726898481).abs() < 1e-9);
    /// assert!((finish.roll - 9.04481476767708).abs() < 1e-12);
    /// ```
    CurvatureRadius(f64),
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

/// Place for which a feed is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FeedAt {
    /// At the cutter's centre.
    #[default]
    Centre,
    /// At the wall, where the edge's envelope runs on the larger circle.
    Wall,
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
    /// Place at which the feed is meant: where it is the wall, the centre, on its smaller circle, goes slower.
    pub feed_at: FeedAt,
    /// Start of the lead-in.
    pub start: LeadEnd,
    /// End of the lead-out.
    pub end: LeadEnd,
    /// Direction from the bore's centre in which the lead-in touches the wall, counter-clockwise from X of the setup
    /// [rad]; `None`: below the centre, or as the start wants it. A start in a point off the centre leaves no choice: through
    /// it there is one lead-in only.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::holes::*;
    /// let cutter =
    ///     CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: None, flute_length: 45.0 };
    /// let spec = BoreSpec {
    ///     rough: Some(Rough { allowance: 1.0, ..Rough::new(4.0, 100.0) }),
    ///     finish: Some(Finish { touch_angle: Some(30f64.to_radians()), ..Finish::new(50.0) }),
    ///     ..BoreSpec::new(200.0, 30.0, cutter)
    /// };
    /// // The circle at the wall starts there.
    /// let circle = plan_bore(&spec).unwrap().finish.unwrap().curves[1];
    /// assert!((circle.start().to_angle().to_degrees() - 30.0).abs() < 1e-12);
    /// ```
    pub touch_angle: Option<f64>,
    /// The same for the lead-out: the direction in which it leaves the wall [rad]; `None`: where the lead-in touches it.
    pub end_touch_angle: Option<f64>,
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
            feed_at: FeedAt::Centre,
            start: LeadEnd::Usual,
            end: LeadEnd::Usual,
            touch_angle: None,
            end_touch_angle: None,
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
    /// The way down; `None`: the best that this cutter may do, the first possible of the entry table
    /// ([`super::entry::ways`]).
    pub entry: Option<Entry>,
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
            strategy: Strategy::Involute,
            entry: None,
            rough: None,
            finish: None,
            retract_z: 50.0,
            approach_z: 2.0,
            resolution: None,
        }
    }

    /// Diameter of the hole that is there before [mm], if there is one.
    pub fn drilled(&self) -> Option<f64> {
        if let Some(Entry::PreDrilled { diameter }) = self.entry { Some(diameter) } else { None }
    }

    /// Largest distance of neighbouring turns of roughing [mm]: that given, or the cutter's diameter, which no step of
    /// constant engagement reaches.
    ///
    /// # Errors
    /// `KC0404` when none is given and nothing else limits the steps of the strategy.
    pub fn stepover(&self, rough: &Rough) -> Result<f64> {
        if let Some(given) = rough.stepover {
            return Ok(given);
        }
        if self.strategy == Strategy::ConstantEngagement && rough.engagement.is_some() {
            return Ok(self.cutter.diameter);
        }
        Err(no_stepover(&format!("the strategy `{}`", self.strategy.name()), self.cutter.diameter)
            .help(format!(
                "write stepover = .., up to the cutter's diameter of {} mm, or use `constant-engagement` with `engagement`",
                self.cutter.diameter
            ))
            .into())
    }

    /// A point of the setup relative to the bore's centre, for a counter-clockwise path [mm].
    pub(super) fn about_centre(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [x, y] = [x - self.centre[0], y - self.centre[1]];
        if self.sense == Sense::Climb { [x, y] } else { [-x, y] }
    }

    /// Tangent angle of the counter-clockwise path at the point of the wall that lies in a direction of the setup from the
    /// centre, counted from X [rad].
    pub(super) fn tangent_angle(&self, direction: f64) -> f64 {
        let polar = if self.sense == Sense::Climb { direction } else { PI - direction };
        wrap(polar + FRAC_PI_2)
    }

    /// Tangent angle at which roughing about the centre touches the wall [rad].
    pub(super) fn rough_psi(&self, rough: &Rough) -> f64 {
        rough.touch_angle.map_or(0.0, |wanted| self.tangent_angle(wanted))
    }

    /// The direction in which the wall has a tangent angle: the inverse of [`BoreSpec::tangent_angle`] [rad].
    pub(super) fn direction(&self, tangent_angle: f64) -> f64 {
        let polar = tangent_angle - FRAC_PI_2;
        wrap(if self.sense == Sense::Climb { polar } else { PI - polar })
    }

    /// The error of a wanted direction `key` [rad] beside a point `point` off the centre, through which the path touches
    /// the wall at another tangent angle [rad].
    pub(super) fn no_free_direction(&self, [key, point]: [&str; 2], wanted: f64, found: f64) -> Finding {
        let found = self.direction(found).to_degrees();
        Finding::error(
            Code::PLAN_VALUE,
            format!("`{key}` and `{point}` contradict each other: a point off the centre fixes where the wall is touched"),
        )
        .value(wanted.to_degrees(), "deg")
        .bound(found, "deg")
        .help(format!("leave out one of them; with the point alone the wall is touched at {found:.3} degrees"))
        .key(key)
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

    /// Height of the deepest floor [mm].
    pub fn floor(&self) -> f64 {
        self.top - self.full_depth()
    }
}
