//! A contour in the planner's words.

use std::f64::consts::PI;

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::OutlinePiece;
use crate::geom::Outline;
use crate::holes::{CutterData, FeedAt, Sense, Wear};

/// Angle at which the ends of tabs rise, where they do [rad].
const RISE: f64 = PI / 6.0;

/// Side of the outline on which the cutter runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContourSide {
    /// Outside: the face stays, its holes are cut from within.
    #[default]
    Outside,
    /// Inside: what is around the face stays, and so do its islands.
    Inside,
    /// With the cutter's centre on the outline: an engraving, or a path that was offset elsewhere.
    On,
    /// Beside open lines, on the left of their direction.
    Left,
    /// Beside open lines, on the right of their direction.
    Right,
}

/// Loops of the outline that are cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContourLoops {
    /// All.
    #[default]
    All,
    /// Those around the face.
    Outer,
    /// Those of its holes.
    Inner,
}

/// Form of tabs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TabShape {
    /// Upright ends.
    #[default]
    Flat,
    /// Ends that rise at 30 degrees, beside the width.
    Ramp,
}

/// Tabs that hold the part.
#[derive(Clone, Debug, PartialEq)]
pub struct Tabs {
    /// Number for each loop; ignored where places are given.
    pub count: u32,
    /// Width of what remains, at its thinnest [mm].
    pub width: f64,
    /// Height over the bottom of the cut [mm].
    pub height: f64,
    /// Form.
    pub shape: TabShape,
    /// Whether finishing leaves them too.
    pub finish: bool,
    /// Places near which they are wanted [mm].
    pub places: Vec<DVec2>,
}

/// Finishing of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourFinish {
    /// Stock that roughing leaves for it on the wall [mm]; 0, of a cleared contour, where leads may come from anywhere.
    pub allowance: f64,
    /// Feed [mm/s].
    pub feed: f64,
    /// Largest depth of a level [mm]; `None`: the length of the flutes.
    pub stepdown: Option<f64>,
    /// Further laps without infeed.
    pub spring_passes: u32,
    /// Wear register of the control.
    pub wear: Option<Wear>,
    /// Whether the feed is reduced where the chip would be thicker than along a straight wall: down to 0.3 of it.
    pub corner_feed: bool,
}

/// Length of the line of a lead on which the control switches its compensation, in largest wears.
const SWITCH: f64 = 1.1;

/// A contour to be milled [mm, mm/s, rad].
#[derive(Clone, Debug, PartialEq)]
pub struct ContourSpec {
    /// The outline, in coordinates of the work offset; for a contour on the left or right, or on lines, [`Outline::of_lines`].
    pub outline: Outline,
    /// Side on which the cutter runs.
    pub side: ContourSide,
    /// Loops that are cut.
    pub loops: ContourLoops,
    /// The cutter.
    pub cutter: CutterData,
    /// Whether the spindle turns counter-clockwise: climb and conventional change sides.
    pub left_hand: bool,
    /// Climb or conventional.
    pub sense: Sense,
    /// Height of the material's upper face.
    pub top: f64,
    /// Depth below it.
    pub depth: f64,
    /// Depth that the cutter goes below `depth`, for a cut that goes through.
    pub breakthrough: f64,
    /// Stock to leave on the wall when all is done.
    pub stock_to_leave: f64,
    /// Largest depth of a level; `None`: the length of the flutes.
    pub stepdown: Option<f64>,
    /// Loops of roughing: their number, and the distance from one to the next; the farthest from the wall comes first. `None`: one.
    pub loops_beside: Option<(u32, f64)>,
    /// Feed along the contour.
    pub feed: f64,
    /// Place for which the feeds are meant.
    pub feed_at: FeedAt,
    /// Feed straight down and along ramps.
    pub plunge_feed: f64,
    /// Angle of the ramp along the contour; `None`: straight down.
    pub ramp: Option<f64>,
    /// Whether all beside the wall has been cleared down to the lowest level: the cutter comes straight down, and what a finish
    /// leaves needs no roughing.
    pub cleared: bool,
    /// Finishing.
    pub finish: Option<ContourFinish>,
    /// Least length of the entry, and of the straight way on behind it, in radii of the cutter, for moves under compensation that are
    /// those of the wall itself: the register holds the cutter's radius. `None`: moves of the cutter's centre.
    pub onto_wall: Option<[f64; 2]>,
    /// Pieces of the loops along which it is cut; `None`: along whole loops. A contour in pieces has no ramp, no finish and no tabs.
    pub pieces: Option<Vec<OutlinePiece>>,
    /// Distance from all edges at which the cutter comes down and goes up, and below which it comes only towards the contour: for
    /// one that is wider above its tip; `None`: that of the path.
    pub room: Option<f64>,
    /// Whether open lines begin and end outside of the material: the cutter comes straight down there.
    pub clear_ends: bool,
    /// Lengths by which each open line goes on before its begin and beyond its end; none of other contours.
    pub extended: Vec<[f64; 2]>,
    /// Radius of the lead arcs; `None`: half the cutter's radius, 1 mm at least.
    pub lead_radius: Option<f64>,
    /// A point near which the contour begins.
    pub start: Option<DVec2>,
    /// Way beyond the start that is cut twice; `None`: a quarter of the cutter's diameter, 2 mm at most.
    pub overlap: Option<f64>,
    /// Tabs.
    pub tabs: Option<Tabs>,
    /// Height of the moves between loops.
    pub retract_z: f64,
    /// Height at which rapids down end.
    pub approach_z: f64,
}

impl ContourSpec {
    /// Radius of the cutter [mm].
    pub fn radius(&self) -> f64 {
        0.5 * self.cutter.diameter
    }

    /// Distances of the loops of roughing from the nearest of them, the farthest first [mm].
    pub(super) fn farther(&self) -> impl Iterator<Item = f64> {
        let (count, step) = self.loops_beside.unwrap_or((1, 0.0));
        (0..count).rev().map(move |k| f64::from(k) * step)
    }

    /// Radius of a lead where there is room [mm].
    pub fn usual_lead(&self) -> f64 {
        let a = self.radius();
        self.lead_radius.unwrap_or(if a > 2.0 { 0.5 * a } else { 1.0 })
    }

    /// Length of the straight way on which the control switches its compensation [mm]; 0 without one.
    pub(super) fn switching(&self) -> f64 {
        let Some(wear) = self.finish.and_then(|f| f.wear) else { return 0.0 };
        let line = SWITCH * wear.largest + 0.1;
        let least = self.onto_wall.map_or(0.0, |[entry, on]| (entry + on) * self.radius());
        line + least
    }

    /// Lengths by which an open line goes on where the travel along it begins, and where it ends [mm].
    pub(super) fn extended(&self, line: usize) -> [f64; 2] {
        let [begin, end] = self.extended.get(line).copied().unwrap_or([0.0; 2]);
        let along = match self.side {
            ContourSide::Right => !self.keeps_right(),
            _ => self.keeps_right(),
        };
        if along { [begin, end] } else { [end, begin] }
    }

    /// Height of the lowest level [mm].
    pub fn bottom(&self) -> f64 {
        self.top - self.depth - self.breakthrough
    }

    /// Height at which tabs end; as low as nothing without tabs [mm].
    pub(super) fn tab_top(&self) -> f64 {
        self.tabs.as_ref().map_or(f64::NEG_INFINITY, |t| self.top - self.depth + t.height)
    }

    /// Ways along the path on which the cutter rises to a tab of a height [mm] and comes down from it [mm]: beside the stretch on
    /// which it is lifted, so that the tab is nowhere thinner than its width. `compensated`: under compensation of the control,
    /// where no move goes straight up or down.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// # use glam::dvec2;
    /// # use kinecut::{contouring::ContourSpec, geom::Outline, holes::CutterData};
    /// # let triangle = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(60.0, 0.0), dvec2(0.0, 40.0)])?;
    /// # let cutter = CutterData { diameter: 10.0, centre_cutting: true, max_ramp_angle: None, flute_length: 22.0 };
    /// let upright = ContourSpec::new(triangle, 6.0, cutter, 10.0);
    /// assert_eq!(upright.slopes(1.5, false), [0.0, 0.0]);
    /// // At 30 degrees.
    /// assert!((upright.slopes(1.5, true)[0] - 1.5 * 3f64.sqrt()).abs() < 1e-12);
    /// # Ok::<(), kinecut::base::Error>(())
    /// ```
    pub fn slopes(&self, height: f64, compensated: bool) -> [f64; 2] {
        let sloped = compensated || self.tabs.as_ref().is_some_and(|t| t.shape == TabShape::Ramp);
        let rise = if sloped { height / RISE.tan() } else { 0.0 };
        // Straight down goes only a cutter that cuts at its centre.
        let ramp = if self.cutter.centre_cutting { None } else { self.ramp };
        let fall = ramp.map_or(0.0, |angle| height / angle.tan());
        [rise, if fall > rise { fall } else { rise }]
    }

    /// Whether the material that is kept lies on the right of the travel.
    pub fn keeps_right(&self) -> bool {
        (self.sense == Sense::Climb) != self.left_hand
    }
}

impl ContourSpec {
    /// A contour outside of an outline with usual values, at a feed [mm/s]: a ramp of 3 degrees, nothing left, no tabs.
    pub fn new(outline: Outline, depth: f64, cutter: CutterData, feed: f64) -> ContourSpec {
        ContourSpec {
            outline,
            side: ContourSide::Outside,
            loops: ContourLoops::All,
            cutter,
            left_hand: false,
            sense: Sense::Climb,
            top: 0.0,
            depth,
            breakthrough: 0.0,
            stock_to_leave: 0.0,
            stepdown: None,
            loops_beside: None,
            feed,
            feed_at: FeedAt::Centre,
            plunge_feed: 0.5 * feed,
            ramp: Some(3.0_f64.to_radians()),
            cleared: false,
            finish: None,
            onto_wall: None,
            pieces: None,
            room: None,
            clear_ends: false,
            extended: Vec::new(),
            lead_radius: None,
            start: None,
            overlap: None,
            tabs: None,
            retract_z: 20.0,
            approach_z: 2.0,
        }
    }
}
