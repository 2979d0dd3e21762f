//! The page of a run: one HTML file without network, and its sections for a terminal.
//!
//! The report knows nothing of planners: an operation brings its own section of text, tables, charts and plans
//! ([`Section`](crate::page::Section)), the job brings verdict, part, path, program and findings as plain data ([`Report`]).
//! Pictures are SVG, so the page works on paper and without JavaScript; the 3-D view and the one cursor through program,
//! path, plan and charts come from a script committed in `page/assets` (sources in `viewer/`).
//!
//! ```
//! use kinecut::job::report::{Report, ReportVerdict};
//! let report = Report::new("Bore 200 mm", ReportVerdict::new(kinecut::job::Judgement::Safe, "nothing was found"));
//! let page = kinecut::job::report::html(&report);
//! assert!(page.starts_with("<!DOCTYPE html>") && page.contains("SAFE"));
//! ```

mod before_run;
mod cutting;
mod design;
mod deviation;
mod encode;
mod engagement;
mod facts;
mod findings;
mod fixtures;
mod machine;
mod model;
mod of_draft;
mod of_job;
mod page;
mod path;
mod programs;
mod sections;
mod text;
mod thin;
mod tools;
mod workspace;

pub use deviation::{BAND_EDGES, Band, bands, extremes};
pub(crate) use encode::packed_body;
pub use encode::{Scene, scene};
pub use model::{
    BodyView, FixtureView, JointView, MachineSetup, MachineView, PartView, ProgramPart, ProgramView, Report,
    ReportVerdict, ToolView,
};
pub use of_draft::of_draft;
pub use of_job::{of_job, of_job_in_words};
pub use page::html;
pub use path::{EngagedRun, PathPiece, PathRole};
pub use sections::{ShownSection, facts, shown_sections};
pub use text::sections;
