//! Contacts of all that a machine moves: its own bodies, what stands on its table, the tool.
//!
//! A body on one link moves in the coordinates of another link by the joints between the two, whatever the rest of the machine
//! does. Along a segment of a program each joint has its positions, with bounds on speed and acceleration; from them follows
//! a bound on the distance of a body from the hull of its places, and the search goes on as for tools past standing bodies.

mod axes;
mod meeting;
mod motion;
mod way;

pub use meeting::{LinkBody, MachineMeeting, MachineMove, MachineParts, Met, Party, ToolInSpindle};
