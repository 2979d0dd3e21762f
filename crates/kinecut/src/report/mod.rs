//! What a person looks at after a run: one HTML file without network, and a short text for the terminal.
//!
//! The report knows nothing of planners: a planner brings its own [`Section`] of text, tables, charts and plans,
//! the job brings verdict, part, path, program and findings as plain data ([`Report`]). Pictures are SVG made
//! here, so the page works on paper and without JavaScript; the 3-D view and the one cursor through program,
//! path, plan and charts come from a script committed in `assets/` (sources in `viewer/`).
//!
//! ```
//! use kinecut::report::{Report, Verdict};
//! let report = Report::new("Bore 200 mm", Verdict::new(kinecut::job::Judgement::Safe, "nothing was found"));
//! let page = kinecut::report::html(&report);
//! assert!(page.starts_with("<!DOCTYPE html>") && page.contains("SAFE"));
//! ```

mod blocks;
mod bore;
mod chart;
mod compare;
mod compare_page;
mod compare_text;
mod deviation;
mod drawing;
mod drill;
mod drilled;
mod encode;
mod envelope;
mod face;
mod faced;
mod facts;
mod findings;
mod grazing;
mod layout;
mod layouts_page;
mod model;
mod of_job;
mod page;
mod paper;
mod picture;
mod plan;
mod section;
mod serde_gap;
mod shown;
mod simplify;
mod split;
mod surface;
mod surface_page;
mod text;
mod thin;
mod ticks;
mod units;
mod verb_page;
mod workspace;

pub use compare_page::compare_html;
pub use compare_text::{compare_text, hole_text};
pub use deviation::{BAND_EDGES, Band, bands, extremes};
pub use drawing::{Along, Angle, Callout, Drawing, Look, Span, Stroke};
pub use drill::{
    DrilledHole, RefusedHole, drill_html, drill_list, drill_section, drill_sections, drill_table, drill_text,
    point_drawing, refused_text, section_drawings, share_in_material,
};
pub use drilled::{sheet_text, sheets_html};
pub use envelope::{envelope_html, envelope_svg, envelope_text};
pub use faced::{face_text, faces_html};
pub use grazing::{
    gallery_html, gallery_json, gallery_svgs, gallery_text, grazing_html, grazing_svg, grazing_text,
};
pub use layout::{
    layout_drawing, layout_figure, layout_scheme, layout_sheet, layout_style, machine_drawing,
    machine_drawing_at,
};
pub use layouts_page::layouts_html;
pub use model::{Fact, PartView, PathPiece, PathRole, ProgramPart, ProgramView, Report, ToolView, Verdict};
pub use of_job::of_job;
pub use page::html;
pub use picture::{Anchor, Ink, Motion, Picture, Shape};
pub use section::{
    Align, Block, Cell, Chart, Circle, CircleKind, Column, Follows, Label, Level, Mark, Plan, PlanLine, Row,
    Section, Series, Table,
};
pub use shown::{inline_json, terminal, visible};
pub use split::{
    MotionRole, SketchMotion, SketchTool, SplitSketch, split_drawing, split_figure, split_sheet,
};
pub use surface::{split_sketches, surface_drawing};
pub use surface_page::surface_html;
pub use text::text;
pub use units::{area_share, duration, fixed, length, micrometres};
