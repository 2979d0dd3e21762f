//! A job: from its file over plan, post, reading back and simulation to the verdict.

pub(crate) mod check;
mod closer;
pub mod contour;
mod drill;
mod face;
pub mod file;
pub(crate) mod foreign;
pub mod hole;
pub(crate) mod items;
mod known;
mod look;
pub mod machine;
mod names;
mod outcome;
mod output;
mod parts;
mod path;
mod plan;
mod plan_json;
mod prove;
pub(crate) mod read;
pub(crate) mod read_back;
pub(crate) mod run;
mod safe_height;
mod shape;
mod simulate;
mod tilt;
mod unknown_stock;
mod verdict;

pub use check::{
    BoreOperation, Design, DrillOperation, Drilled, EllipseOperation, FaceOperation, HolePlace, Job,
    JobPlane, JobProgram, JobSetup, MAX_LENGTH, Milling, Operation, PathOperation, check,
};
pub use drill::{DrillSheet, DrilledHoles, PlannedHole, ProbedHole, plan_drill_sheet};
pub use face::{
    FaceMeasure, FaceProbe, FaceSheet, PaperBaseline, PlannedFace, SheetWants, SimulatedExit, SimulatedFace,
    plan_face_sheet,
};
pub(crate) use face::{face_options, face_to_work};
pub use foreign::{
    Foreign, GivenFile, GivenJob, ProgramWants, Unfollowed, control_of, control_of_name, given_alone,
    given_with_job, simulate_given,
};
pub use items::Items;
pub use look::{Descent, Looks, StandContact};
pub use outcome::{Outcome, SetupOutcome};
pub use output::Outputs;
pub use parts::parts;
pub use plan::{Planned, TakenOut, plan};
pub use plan_json::plan_json;
pub use read::JobText;
pub use read_back::{ReadBack, compare};
pub use run::run;
pub(crate) use run::still_wanted;
pub use shape::{BoreMeasure, Deviation, Largest, Worst, deviation};
pub use simulate::{Loose, Missed, Probe, Simulation, simulate};
pub use verdict::{
    Heading, Judgement, Proof, Subject, Unchecked, UncheckedItem, Verdict, VerdictCheck, sha256, verify,
};

/// A value as JSON text, keys in the order of its type, with a line end.
pub fn json_text(value: &impl serde::Serialize) -> String {
    // Serialisation of plain data to a string fails only for maps with keys that are no strings; there are none.
    let text = serde_json::to_string_pretty(value);
    debug_assert!(text.is_ok(), "{:?}", text.err());
    let mut text = text.unwrap_or_default();
    text.push('\n');
    text
}
