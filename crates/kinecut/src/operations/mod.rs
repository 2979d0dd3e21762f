//! Operations of a job, one folder a kind: its table in the job file, its check, its plan and moves, the shape it wants, its proof
//! on the simulated stock, its section of the report and its part of `plan.json`. One list, `kinds!` in this file, names them;
//! nothing above does.
//!
//! A kind is three types: the table (`kind::Table`), the checked operation (`kind::Checked`) and its plan (`kind::Plan`).

#[macro_use]
mod list;

pub(crate) mod band;
pub mod bore;
mod called_tool;
pub mod chamfer;
pub mod contour;
mod core_hole;
pub mod deburr;
pub mod drill;
pub mod edge;
pub mod face;
pub(crate) mod kind;
pub(crate) mod known;
mod lines;
mod made_mouth;
mod made_plane;
pub mod measured;
mod milling;
mod named;
pub mod outlines;
pub mod path;
mod pen;
pub mod places;
pub mod pocket;
pub mod pocket_ellipse;
mod posted;
mod round_hole;
pub(crate) mod setting;
pub mod slot;
pub mod slot_outline;
mod slowed;
mod table;
pub mod tap;
mod thread_depth;
pub mod thread_mill;
mod uncut;
pub mod wall;
pub(crate) mod wanted;

pub use called_tool::CalledTool;
pub(crate) use called_tool::plain_name;
pub(crate) use kind::{Attempt, CuttingKeys, FeedKeys, Found, Judged, Probes, Shown, Tally, WearRegister};
pub(crate) use made_mouth::{MadeMouth, PlacedMouth};
pub(crate) use made_plane::{MadePlane, PlacedPlane};
pub use milling::{JobPlane, Milling};
pub(crate) use milling::{feed_of, milling, milling_of, spindle, tool_of, whole_revolutions};
pub(crate) use pen::Pen;
pub use posted::PostedPlan;
pub(crate) use round_hole::{HoleFloor, MadeHole, RoundHole};
pub(crate) use setting::{Around, Setting, StockOutline};
pub use setting::{Clamping, Drilled};
pub use table::{FeedsName, OrientationName, PlaneTable};

kinds! {
    /// Milling of a bore.
    Bore "bore" (bore::BoreTable, bore::BoreOperation, bore::PlannedBore),
    /// Milling of an elliptic pocket.
    PocketEllipse "pocket-ellipse"
        (pocket_ellipse::EllipseTable, pocket_ellipse::EllipseOperation, pocket_ellipse::PlannedEllipse),
    /// Milling of a pocket with any outline and islands, at a bounded engagement.
    Pocket "pocket" (pocket::PocketTable, pocket::PocketOperation, pocket::PlannedPocket),
    /// Milling of a slot: a line or an arc of a width.
    Slot "slot" (slot::SlotTable, slot::SlotOperation, slot::PlannedSlot),
    /// Milling along the edges of an outline.
    Contour "contour" (contour::ContourTable, contour::ContourOperation, contour::PlannedContour),
    /// Chamfering of the upper edge of an outline.
    Chamfer "chamfer" (chamfer::ChamferTable, chamfer::ChamferOperation, chamfer::PlannedChamfer),
    /// Breaking of edges where face milling has left a burr, or of whole outlines.
    Deburr "deburr" (deburr::DeburrTable, deburr::DeburrOperation, deburr::PlannedDeburr),
    /// Drilling, centring, countersinking, reaming: what a tool does along its axis.
    Drill "drill" (drill::DrillTable, drill::DrillOperation, drill::PlannedDrilling),
    /// Threads by a tap.
    Tap "tap" (tap::TapTable, tap::TapOperation, tap::PlannedTapping),
    /// Threads by a thread mill, in holes or on bosses.
    ThreadMill "thread-mill" (thread_mill::ThreadMillTable, thread_mill::ThreadMillOperation, thread_mill::PlannedThreadMilling),
    /// Milling of a plane face.
    Face "face" (face::FacingTable, face::FaceOperation, face::PlannedFace),
    /// A tool path that comes from elsewhere, with directions of the tool.
    Path "path" (path::PathTable, path::PathOperation, path::PlannedPath),
}
