//! Building blocks of pages: sections of text, tables, facts, charts, plans, pictures and drawings; numbers as a person
//! reads them; the page of a verb. Nothing here knows of cutting.

pub(crate) mod blocks;
pub(crate) mod chart;
pub(crate) mod draw;
pub(crate) mod drawing;
mod fact;
pub(crate) mod inches;
pub(crate) mod picture;
pub(crate) mod plan;
mod section;
pub(crate) mod serde_gap;
pub(crate) mod shown;
pub(crate) mod simplify;
mod style;
mod table;
mod text;
mod units;
pub(crate) mod verb_page;

pub use draw::{Colour, Dash, Ink, Tint, Width};
pub use drawing::{Along, Angle, Callout, Dimension, Drawing, Look, Stroke};
pub use fact::Fact;
pub use picture::{Anchor, Lettering, Picture, PictureMotion, Shape};
pub use section::{Block, Chart, Circle, Follows, Label, LevelLine, Plan, PlanLine, Section, Series};
pub use shown::{inline_json, terminal, visible};
pub(crate) use style::{policy_of, style};
pub use table::{Align, Cell, Column, Mark, Row, Table};
pub use text::{WIDTH, text};
pub use units::{area_share, duration, fixed, length, micrometres};
pub(crate) use units::{heading, px, trimmed};
