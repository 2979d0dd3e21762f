//! NC programs as text: writers and readers for the controls kinecut knows.
//!
//! [`write`](fn@write) turns a program into the text of a control, [`read`](fn@read) turns such a text into a program
//! with the same exact curves; writing and reading are inverse within the number format. What a control calls
//! things is data ([`SINUMERIK 840D`](Control::Sinumerik840d), [`LinuxCNC`](Control::LinuxCnc): one folder each);
//! what the words do is shared. [`HEIDENHAIN`](Control::Heidenhain) klartext has a grammar of its own: its blocks
//! are written and read beside, over the same rounding and the same arcs.
//!
//! Two rules hold throughout: nothing that could move an axis is skipped in silence, and no number drifts (every
//! block is rounded from the exact curve, increments are taken from the rounded start).

mod arc_fit;
mod arc_spiral;
mod axis_map;
mod comment;
mod control;
mod corner_fit;
mod detect;
mod dialect;
mod dialects;
mod fanuc;
mod grbl;
mod grblhal;
mod grid;
mod haas;
mod heidenhain;
mod kept;
mod linuxcnc;
mod modes;
mod multi_axis;
mod native;
mod own_cycle;
mod read;
mod run;
mod scan;
mod settings;
mod sinumerik;
mod tilt;
mod tolerated;
mod turn;
mod write;

pub use control::Control;
pub use detect::{Detected, detect};
pub use kept::Kept;
pub use linuxcnc::parameters::{Parameters, parameters};
pub use linuxcnc::tool_table::{TableTool, tool_table};
pub use read::{NumberInput, ReadSettings, Reading, called, read, read_source};
pub use settings::{PostNotes, PostSettings, Posted, Units};
pub use write::write;
