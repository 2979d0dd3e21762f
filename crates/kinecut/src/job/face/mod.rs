//! Milling of faces in a job: planned, made into moves, proven on the simulated stock; `kinecut face`.

mod above;
mod flat;
mod moves;
mod plan;
mod prove;
mod sheet;
mod sheet_json;
mod top;

pub(super) use above::stock_above;
pub(super) use flat::measure_face;
pub(super) use moves::{Over, push_face};
pub(super) use plan::plan_face;
pub(super) use prove::{face_probes, judge_face, simulated_face};
pub(super) use sheet_json::FaceJson;
pub(super) use top::{StockOutline, top_outline};

pub(crate) use plan::options as face_options;
pub(crate) use prove::to_work as face_to_work;

pub use flat::FaceMeasure;
pub use plan::PlannedFace;
pub use prove::{FaceProbe, SimulatedExit, SimulatedFace};
pub use sheet::{FaceSheet, PaperBaseline, SheetWants, plan_face_sheet};
