//! Planner of pockets and slots: a face with islands, or a line of a width, is cleared at a bounded engagement.
//!
//! The engagement is the angle of the cutter's circle that cuts. It is known exactly at every place from what has been
//! swept before ([`Clearing`]), and the path turns so that it stays at the wanted value: along the first pass outwards from a
//! helix, then along passes that begin where the wall leaves what is cleared, until nothing is left. Between them the cutter
//! goes through what is cleared, on tangent arcs where one finds room. Where the helix has no room the cutter goes down along the
//! line in the middle of the walls, to and fro, or straight down. A slot that is hardly wider than the cutter is cleared by
//! loops of a trochoid.
//!
//! # Signs
//! Inside of the planner the stock lies on the right of the travel, which is climb for a clockwise spindle; conventional
//! passes are made in the mirror. Angles of an engagement are counted from the right normal of the travel, counter-clockwise.

mod centre_line;
mod earlier;
mod entry;
mod far;
mod level;
mod link;
mod medial;
mod moves;
mod plan;
mod region;
mod rest;
mod slot;
mod spec;
mod starts;
mod swept;
mod trochoid;
mod walk;

pub use centre_line::CentreLine;
pub use plan::{PocketFigures, PocketPlan, RestFigures, WALL_STOCK, plan_pocket};
pub use slot::{AS_WIDE, SlotSpec, plan_slot};
pub use spec::{EarlierCutter, PocketEntry, PocketSpec};
pub use swept::{Clearing, Engagement};
pub use trochoid::Trochoid;
