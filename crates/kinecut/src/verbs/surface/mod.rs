//! Surfaces and how they are made, in the units of the shop: the generating lines as read, the function of the surface
//! written out, every redistribution of its motions between machine and tool.

mod mesh;
mod on_machine;
mod on_machine_rows;
mod on_machine_text;
pub(crate) mod page;
mod read;
mod sheet;
mod sketches;
mod split;
mod split_row;
mod text;

pub use mesh::{FaceRow, MeshSheet, mesh_sheet};
pub use on_machine::{OnMachineWants, on_machine};
pub use on_machine_rows::{
    AlternativeRow, AxisEffectRow, BudgetRow, CoverageRow, EnvelopedRow, MadeRow, NearestRow, OnMachine,
    ResidualRow,
};
pub(crate) use on_machine_text::{NEARNESS, NOT_VERIFIED};
pub use page::surface_html;
pub use read::{load_surface, set_parameter, surface};
pub use sheet::{EnvelopeRow, MethodProcesses, SurfaceSheet, surface_sheet};
pub use sketches::{split_sketches, surface_drawing};
pub use split::{
    MotionRole, SketchMotion, SketchTool, SplitSketch, split_drawing, split_figure, split_sheet,
};
pub use split_row::{LinkRow, SetupRow, SplitRow};
