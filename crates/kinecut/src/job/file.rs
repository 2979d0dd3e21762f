//! The job file, format 1, as written: mm, mm/min, degrees, rev/min. Checked values are made from it in
//! [`super::check`].
//!
//! The doc comments here are the manual: they reach editors through `kinecut schema job`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A kinecut job: stock, tools, machine and operations; lengths in mm, feeds in mm/min, angles in degrees, speeds
/// in rev/min.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JobFile {
    /// Version of this file's form: 1.
    pub format: u32,
    /// What the job is called in program and report.
    #[serde(default)]
    pub title: Option<String>,
    /// The wanted part, to compare the cut part with.
    #[serde(default)]
    pub design: Option<DesignTable>,
    /// The raw stock, in part coordinates.
    pub stock: StockTable,
    /// Holes that the raw stock already has.
    #[serde(default, rename = "drilled")]
    pub drilled: Vec<DrilledTable>,
    /// The control and how to write for it.
    pub post: PostTable,
    /// How fine to simulate.
    #[serde(default)]
    pub simulate: SimulateTable,
    /// The machine: a table, or the name of a file that holds one.
    #[serde(default)]
    pub machine: Option<MachineEntry>,
    /// Tool holders, named by tools.
    #[serde(default, rename = "holder")]
    pub holders: Vec<HolderTable>,
    /// The tools.
    #[serde(rename = "tool")]
    pub tools: Vec<ToolTable>,
    /// The clampings of the part, in order.
    #[serde(rename = "setup")]
    pub setups: Vec<SetupTable>,
}

/// The wanted part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DesignTable {
    /// STL file, in part coordinates.
    pub mesh: String,
    /// Largest allowed distance between cut and wanted surface.
    pub tolerance: f64,
}

/// The raw stock.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum StockTable {
    /// A block.
    Box(BoxTable),
    /// A round bar standing along Z.
    Cylinder(CylinderTable),
    /// A closed STL mesh.
    Mesh(String),
}

/// A block between two corners.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxTable {
    /// Least corner.
    pub min: [f64; 3],
    /// Greatest corner.
    pub max: [f64; 3],
}

/// A round bar standing along Z.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CylinderTable {
    /// Centre of the lower face.
    pub base: [f64; 3],
    /// Diameter.
    pub diameter: f64,
    /// Height.
    pub height: f64,
}

/// A round hole that the raw stock already has, along Z of the part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DrilledTable {
    /// Centre.
    pub at: [f64; 2],
    /// Diameter.
    pub diameter: f64,
    /// Height of the hole's upper end.
    pub top: f64,
    /// Height of the hole's flat lower end.
    pub bottom: f64,
}

/// The control and how to write for it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PostTable {
    /// The control: "sinumerik-840d", "fanuc", "linuxcnc", "grbl" or "heidenhain".
    pub control: String,
    /// Decimals of coordinates, 3 to 6; default: as usual on the control (FANUC 3, others 4).
    #[serde(default)]
    pub decimals: Option<u8>,
    /// Least step of coordinates where it is coarser than the last decimal: 0.005; all coordinates are multiples of it.
    #[serde(default)]
    pub resolution: Option<f64>,
    /// Whether involutes are written as the control's own where it has them; default true.
    #[serde(default)]
    pub involute: Option<bool>,
    /// Whether arcs and helices are written as such; false: straight lines only. Default true.
    #[serde(default)]
    pub arcs: Option<bool>,
    /// Largest distance of such lines from the path; default 0.005.
    #[serde(default)]
    pub chord_tolerance: Option<f64>,
    /// Whether blocks are numbered; default: as usual on the control.
    #[serde(default)]
    pub block_numbers: Option<bool>,
    /// Largest distance between an involute and the arcs that stand for it where the control has no involute or
    /// cannot start one; default 0.0005.
    #[serde(default)]
    pub arc_tolerance: Option<f64>,
    /// Whether spirals and involutes are written as cubics (`G5`, LinuxCNC only); default false.
    #[serde(default)]
    pub cubic: Option<bool>,
    /// Name of the program, and of its file; default: the name of the job file.
    #[serde(default)]
    pub program: Option<String>,
    /// Number of the program where the control has numbers (FANUC's O word); default 1.
    #[serde(default)]
    pub program_number: Option<u32>,
    /// File with the template of the blocks at the start, instead of the built-in ones.
    #[serde(default)]
    pub start: Option<String>,
    /// File with the template of the blocks at the end.
    #[serde(default)]
    pub end: Option<String>,
}

/// How fine to simulate.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SimulateTable {
    /// Distance of the lines of the stock model; default: such that the stock has about 2 million lines.
    #[serde(default)]
    pub step: Option<f64>,
    /// Largest memory of the stock model in MB; default 2000.
    #[serde(default)]
    pub memory: Option<f64>,
}

/// A machine, or the name of a file with one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum MachineEntry {
    /// Name of a TOML file that holds a machine table.
    File(String),
    /// The machine itself.
    Table(MachineTable),
}

/// A machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MachineTable {
    /// Name.
    #[serde(default)]
    pub name: Option<String>,
    /// Coordinate code, workpiece to tool: 1 2 3 = X Y Z, 4 5 6 = A B C, 0 = bed.
    pub code: String,
    /// Travel of the axes.
    #[serde(default)]
    pub travel: TravelTable,
    /// What the axes can do.
    #[serde(default)]
    pub dynamics: DynamicsTable,
}

/// Least and greatest position of each axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TravelTable {
    /// X.
    #[serde(default, rename = "X")]
    pub x: Option<[f64; 2]>,
    /// Y.
    #[serde(default, rename = "Y")]
    pub y: Option<[f64; 2]>,
    /// Z.
    #[serde(default, rename = "Z")]
    pub z: Option<[f64; 2]>,
}

/// What the axes can do.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DynamicsTable {
    /// Rapid speed of each axis, mm/min.
    #[serde(default)]
    pub rapid: Option<f64>,
    /// Acceleration, m/s2.
    #[serde(default)]
    pub acceleration: Option<f64>,
    /// Jerk, m/s3.
    #[serde(default)]
    pub jerk: Option<f64>,
}

/// A tool holder: segments from its face upwards.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HolderTable {
    /// Name by which tools call it.
    pub name: String,
    /// Segments, from the face upwards.
    pub segments: Vec<HolderSegmentTable>,
}

/// A segment of a holder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HolderSegmentTable {
    /// Height.
    pub height: f64,
    /// Diameter at the lower end.
    pub lower_diameter: f64,
    /// Diameter at the upper end; default: as below.
    #[serde(default)]
    pub upper_diameter: Option<f64>,
}

/// Kinds of tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ToolType {
    /// Flat end mill.
    EndMill,
    /// Ball-nose end mill.
    BallNose,
    /// End mill with a corner radius.
    BullNose,
    /// Conical cutter.
    Tapered,
    /// Twist drill.
    Drill,
}

/// A tool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToolTable {
    /// Number on the control.
    pub number: u32,
    /// What a person calls it.
    #[serde(default)]
    pub name: Option<String>,
    /// Kind.
    #[serde(rename = "type")]
    pub kind: ToolType,
    /// Diameter (of a tapered cutter: of its flat tip, 0 for a sharp one).
    pub diameter: f64,
    /// Corner radius of a bull-nose end mill.
    #[serde(default)]
    pub corner_radius: Option<f64>,
    /// Angle between axis and edge of a tapered cutter, degrees.
    #[serde(default)]
    pub half_angle: Option<f64>,
    /// Full point angle of a drill, degrees; default 118.
    #[serde(default)]
    pub point_angle: Option<f64>,
    /// Height of the cutting part above the tip.
    pub flute_length: f64,
    /// Number of teeth; default 2.
    #[serde(default)]
    pub teeth: Option<u32>,
    /// Height of the holder's face above the tip; default: the flute length.
    #[serde(default)]
    pub stickout: Option<f64>,
    /// Diameter of the shank; default: that of the cutter.
    #[serde(default)]
    pub shank_diameter: Option<f64>,
    /// Name of the holder.
    #[serde(default)]
    pub holder: Option<String>,
    /// Length from the spindle's gauge point to the tip.
    #[serde(default)]
    pub gauge_length: Option<f64>,
    /// Whether it cuts at its centre and may plunge; default: true for a drill, ball-nose and for end mills up to
    /// 20 mm, false for larger ones, which mostly carry indexable inserts.
    #[serde(default)]
    pub centre_cutting: Option<bool>,
    /// Steepest ramp it may follow, degrees.
    #[serde(default)]
    pub max_ramp_angle: Option<f64>,
}

/// A clamping of the part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetupTable {
    /// Work offset: "G54".
    pub offset: String,
    /// The work zero, in part coordinates; default: the part's zero.
    #[serde(default)]
    pub zero: Option<[f64; 3]>,
    /// How the part is turned: the directions of the work offset's X and Z, in part coordinates.
    #[serde(default)]
    pub orient: Option<OrientTable>,
    /// Machine position of the work zero (of the spindle's gauge point without tool). Without it travel limits can
    /// only be compared with the span of the motion.
    #[serde(default)]
    pub position: Option<[f64; 3]>,
    /// Height above the work zero to which the tool is lifted between operations; default: 50 above the stock.
    #[serde(default)]
    pub safe_height: Option<f64>,
    /// The operations, in order.
    #[serde(default, rename = "operation")]
    pub operations: Vec<OperationTable>,
}

/// How the part is turned.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OrientTable {
    /// Direction of the work offset's X in part coordinates.
    pub x: [f64; 3],
    /// Direction of the work offset's Z (towards the spindle) in part coordinates.
    pub z: [f64; 3],
}

/// An operation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "type", rename_all = "kebab-case")]
pub enum OperationTable {
    /// Milling of a bore.
    Bore(BoreTable),
    /// Milling of an elliptic pocket.
    PocketEllipse(EllipseTable),
}

/// Milling of an elliptic pocket: a spiral that grows from a circle into the ellipse.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EllipseTable {
    /// Number of the tool.
    pub tool: u32,
    /// Centre, in coordinates of the work offset.
    pub at: [f64; 2],
    /// Height of the upper rim, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Half axes of the finished pocket.
    pub half_axes: [f64; 2],
    /// Direction of the first half axis from X, degrees; default 0.
    #[serde(default)]
    pub angle: f64,
    /// Depth below the rim.
    pub depth: f64,
    /// How far the tool goes below the depth, for a pocket that goes through; default 0.
    #[serde(default)]
    pub breakthrough: f64,
    /// Stock to leave on the wall when all is done; default 0.
    #[serde(default)]
    pub leave: f64,
    /// Stock to leave on the floor; default 0.
    #[serde(default)]
    pub leave_floor: f64,
    /// Largest allowed deviation of wall and floor; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// Contact of the spiral with the wall; default G4.
    #[serde(default = "fourth")]
    pub contact: ContactName,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Direction,
    /// How the cutter gets to depth; default: a helix that leaves no core.
    #[serde(default)]
    pub entry: Option<EntryTable>,
    /// Spindle speed, rev/min.
    pub speed: f64,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: CoolantName,
    /// Roughing.
    pub rough: RoughTable,
    /// Finishing; left out, the allowance stays.
    #[serde(default)]
    pub finish: Option<EllipseFinishTable>,
}

fn fourth() -> ContactName {
    ContactName::G4
}

/// Finishing of an elliptic pocket.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EllipseFinishTable {
    /// Feed, mm/min.
    pub feed: f64,
    /// Further laps at the wall without infeed; default 0.
    #[serde(default)]
    pub spring_passes: u32,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default)]
    pub axial_step: Option<f64>,
}

/// Milling of a bore.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoreTable {
    /// Number of the tool.
    pub tool: u32,
    /// Centre, in coordinates of the work offset.
    pub at: [f64; 2],
    /// Height of the upper rim, in coordinates of the work offset; default 0.
    #[serde(default)]
    pub top: f64,
    /// Diameter of the finished bore; of a conical one at its rim.
    pub diameter: f64,
    /// Diameter at the depth, for a bore that narrows downwards; it is milled in steps, level by level.
    #[serde(default)]
    pub bottom_diameter: Option<f64>,
    /// Stock to leave on the wall when all is done; default 0.
    #[serde(default)]
    pub leave: f64,
    /// Stock to leave on the floor of a blind bore; default 0.
    #[serde(default)]
    pub leave_floor: f64,
    /// Depth below the rim.
    pub depth: f64,
    /// How far the tool goes below the depth, for a bore that goes through; default 0.
    #[serde(default)]
    pub breakthrough: f64,
    /// Largest allowed deviation of the bore's radius and floor; default 0.02.
    #[serde(default)]
    pub tolerance: Option<f64>,
    /// How the cutter moves.
    pub strategy: BoreStrategy,
    /// Climb or conventional milling; default climb.
    #[serde(default)]
    pub direction: Direction,
    /// How the cutter gets to depth; default: a helix that leaves no core.
    #[serde(default)]
    pub entry: Option<EntryTable>,
    /// Spindle speed, rev/min.
    pub speed: f64,
    /// Coolant; default flood.
    #[serde(default)]
    pub coolant: CoolantName,
    /// Roughing; left out, only the wall is finished.
    #[serde(default)]
    pub rough: Option<RoughTable>,
    /// Finishing; left out, the allowance stays.
    #[serde(default)]
    pub finish: Option<FinishTable>,
}

/// How the cutter moves in a bore.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BoreStrategy {
    /// Circle involutes: smooth in velocity and acceleration, a small step of jerk at the wall. After a helix or in a
    /// pre-drilled hole from that circle, else from the centre.
    Involute,
    /// Circle involutes between two circles: as `involute`, but never from the centre.
    Annular,
    /// Lens involutes of order 1: the same length, smooth to the second derivative of jerk (contact G4).
    #[serde(rename = "lens-1")]
    Lens1,
    /// Lens involutes of order 2: contact G6.
    #[serde(rename = "lens-2")]
    Lens2,
    /// Spiral that keeps the engagement angle `rough.engagement`, with `rough.step` as a cap; contact G4.
    ConstantEngagement,
    /// Semicircles about two poles: a step of acceleration in every joint.
    #[serde(rename = "arcs-2")]
    Arcs2,
    /// Quarter circles about four poles.
    #[serde(rename = "arcs-4")]
    Arcs4,
    /// Archimedean spiral: meets the wall with a kink.
    Archimedean,
    /// Concentric rings joined by radial lines: the machine stops at each corner.
    Rings,
    /// Concentric rings joined by tangent arcs.
    RingsTangent,
    /// Trochoidal loops along a ring.
    Trochoidal,
    /// Down along a spiral to the wall and back in its plane, level by level: no plunge.
    Ramping,
    /// One helix at the wall with a level foot, for bores smaller than two cutter diameters.
    Helix,
    /// One helix at the wall of a through bore of any size: the core falls out.
    OutlineHelix,
}

/// Climb or conventional milling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Climb: counter-clockwise in a bore.
    #[default]
    Climb,
    /// Conventional: clockwise in a bore.
    Conventional,
}

/// How the cutter gets to depth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum EntryTable {
    /// Straight down; needs a cutter that cuts at its centre.
    Plunge,
    /// Down a helix.
    Helix(HelixTable),
    /// Into a hole that is there.
    PreDrilled(PreDrilledTable),
}

/// A helix into the material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HelixTable {
    /// Radius of the tool centre's helix; below the cutter's radius no core is left.
    pub radius: f64,
    /// Depth of one turn.
    pub pitch: f64,
}

/// A hole that is there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PreDrilledTable {
    /// Diameter of the hole about the bore's centre.
    pub diameter: f64,
}

/// Coolant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CoolantName {
    /// None.
    Off,
    /// Mist.
    Mist,
    /// Flood.
    #[default]
    Flood,
}

/// Roughing of a bore.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoughTable {
    /// Largest distance of neighbouring turns.
    pub step: f64,
    /// Largest engagement angle of the cutter, degrees, for `constant-engagement`.
    #[serde(default)]
    pub engagement: Option<f64>,
    /// Largest descent of a turn, for `helix` and `outline-helix`; default: as steep as the cutter is known to follow.
    #[serde(default)]
    pub pitch: Option<f64>,
    /// Allowance left on the wall for finishing; default 0.
    #[serde(default)]
    pub allowance: f64,
    /// Feed, mm/min.
    pub feed: f64,
    /// Feed of plunge and helix, mm/min; default: a quarter of the feed.
    #[serde(default)]
    pub plunge_feed: Option<f64>,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default)]
    pub axial_step: Option<f64>,
    /// Point at which the spiral starts instead of the centre, in coordinates of the work offset.
    #[serde(default)]
    pub start: Option<[f64; 2]>,
}

/// Finishing of a bore.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FinishTable {
    /// Turns that the lead-in's involute would have from the centre; default 2.
    #[serde(default)]
    pub turns: Option<u32>,
    /// Contact of the lead-in with the wall; default G2, with the shortest sliver.
    #[serde(default)]
    pub contact: ContactName,
    /// Feed, mm/min.
    pub feed: f64,
    /// Whether the feed is that of the cutter's centre or that of its edge at the wall; default centre.
    #[serde(default)]
    pub feed_at: FeedAt,
    /// Point at which the lead-in starts, in coordinates of the work offset; default: half a turn before the wall.
    #[serde(default)]
    pub start: Option<[f64; 2]>,
    /// Distance from the bore's centre at which the lead-in starts.
    #[serde(default)]
    pub start_radius: Option<f64>,
    /// Length of the lead-in.
    #[serde(default)]
    pub start_length: Option<f64>,
    /// Point at which the lead-out ends, in coordinates of the work offset; default: the mirror image of the lead-in's.
    #[serde(default)]
    pub end: Option<[f64; 2]>,
    /// Distance from the bore's centre at which the lead-out ends.
    #[serde(default)]
    pub end_radius: Option<f64>,
    /// Length of the lead-out.
    #[serde(default)]
    pub end_length: Option<f64>,
    /// Further circles at the wall without infeed; default 0.
    #[serde(default)]
    pub spring_passes: u32,
    /// Register of the control by whose value the wall is moved at the machine: "D2".
    #[serde(default)]
    pub wear_offset: Option<String>,
    /// Largest value, of either sign, that the register may get; default 0.1.
    #[serde(default)]
    pub wear_largest: Option<f64>,
    /// Value of the register with which the program is simulated; default 0.
    #[serde(default)]
    pub wear_value: Option<f64>,
    /// Largest depth of a level; default: the length of the flutes.
    #[serde(default)]
    pub axial_step: Option<f64>,
}

/// Contact of a lead with the wall: how many derivatives agree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContactName {
    /// Curvature: a circle involute.
    #[default]
    G2,
    /// To the fourth derivative: a lens involute of order 1.
    G4,
    /// To the sixth: order 2.
    G6,
}

/// Where a feed is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FeedAt {
    /// At the cutter's centre.
    #[default]
    Centre,
    /// At the wall, where the edge's envelope runs on the larger circle.
    Wall,
}

/// The JSON Schema of the job file.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(JobFile).to_value()
}
