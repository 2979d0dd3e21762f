//! NC text of all controls: written, read, read back.

mod compensation;
mod controls;
mod cubic;
mod drill_cycles;
mod drill_read;
mod drill_series;
mod fixtures;
mod inverse_time;
mod klartext;
mod klartext_multi_axis;
mod messages;
mod multi_axis;
mod path_mode;
mod read;
mod round_trip;
mod tap;
mod tool_change;
mod turned;
