//! A job: from its file over plan, post, reading back and simulation to the verdict.

mod bins;
mod budget;
pub(crate) mod check;
mod closer;
mod contacts;
pub mod contour;
mod cutting;
mod draft;
pub(crate) mod engagement;
pub(crate) mod external;
pub(crate) mod facets;
pub(crate) mod feeds;
pub mod file;
pub(crate) mod following;
mod forms;
pub(crate) mod held_feed;
mod holes;
mod inches;
pub mod inspect;
pub(crate) mod items;
mod lacking;
pub mod library;
mod look;
pub mod machine;
mod measure;
mod missed;
mod names;
mod outcome;
mod output;
mod part_surface;
mod parts;
pub(crate) mod places;
pub(crate) mod plan;
mod plan_json;
mod playback;
mod posted;
mod prove;
mod raw;
pub(crate) mod read;
pub(crate) mod read_back;
mod renamed;
mod replay;
pub mod report;
pub(crate) mod run;
pub(crate) mod setup_outcome;
mod shape;
mod simulate;
mod subject;
mod tilt;
pub(crate) mod time_terms;
mod uncertain;
pub(crate) mod unknown;
mod verdict;
mod wants;
mod wrong_table;
mod wrong_type;
mod wrong_value;

pub use budget::Budget;
pub use check::{
    Design, Job, JobProgram, JobSetup, Region, Subprogram, Uncertainty, check, program_text, subprograms,
};
pub use cutting::{DataOrigin, SpeedLimit, TakenData, TakenNumber};
pub use draft::Draft;
pub use engagement::{Engagement, engagement_json};
pub use external::{
    Carried, CarriedStock, CarriedTool, ExternalProgram, GivenFile, GivenJob, GivenStock, ProgramWants,
    Unfollowed, carried, control_of, control_of_name, given_alone, given_with_job, is_tool_table,
};
pub(crate) use external::{TableTools, all_in_words, micrometres, toml_of};
pub use inspect::{InspectWants, Inspection, SectionPlane};
pub use items::TextItems;
pub use look::{Looks, StandContact, SteepDescent};
pub use measure::Measured;
pub use missed::Missed;
pub use outcome::Outcome;
pub use output::Outputs;
pub(crate) use output::StreamedFile;
pub use part_surface::PartSurface;
pub use parts::parts;
pub use plan::{PlannedOperation, SetupPlan, plan};
pub use plan_json::{draft_json, plan_json};
pub use playback::PlayedStock;
pub(crate) use posted::posted;
pub use read::JobText;
pub use read_back::{ReadBack, compare};
pub(crate) use run::still_wanted;
pub use run::{RunWants, run, run_with, simulate_given};
pub use setup_outcome::SetupOutcome;
pub use shape::{Deviation, Largest, RegionMeasure, RestReach, SizeReach, ToolReach, deviation};
pub use simulate::{Simulation, simulate};
pub use subject::{Subject, sha256};
pub use uncertain::UncertainStock;
pub use verdict::{
    Heading, Judgement, Proof, ToEnsure, Unchecked, UncheckedItem, Verdict, VerdictCheck, verify,
};
pub use wants::{DesignWants, StockWants};

/// A value as JSON text, keys in the order of its type, with a line end.
pub fn json_text(value: &impl serde::Serialize) -> String {
    // Serialisation of plain data to a string fails only for maps with keys that are no strings; there are none.
    let text = serde_json::to_string_pretty(value);
    debug_assert!(text.is_ok(), "{:?}", text.err());
    let mut text = text.unwrap_or_default();
    text.push('\n');
    text
}
