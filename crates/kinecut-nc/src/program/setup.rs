//! A setup: the place of the part on the machine.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::WorkOffset;
use crate::geom::{Rigid, Solid};

/// Index of a setup in a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SetupId(pub u32);

/// One clamping of the part.
///
/// The *table* frame has the directions of the linear axes. When the position on the machine is known it is the
/// machine's frame: axis positions at which a tool of no length has its gauge point there.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Name in words ("setup 1").
    pub name: String,
    /// Maps part coordinates into the table frame.
    pub part_on_table: Rigid,
    /// Maps the coordinates of each work offset into the table frame.
    pub work_offsets: BTreeMap<WorkOffset, Rigid>,
    /// True if the table frame is the machine's frame; otherwise axis positions are known only as differences.
    pub located: bool,
    /// The raw stock [part coordinates]; `None` continues with what the setup before has left.
    pub stock: Option<Solid>,
    /// Bodies that no tool may touch: clamps, a vise.
    pub fixtures: Vec<Fixture>,
}

/// A body that holds the part, or stands beside it.
#[derive(Clone, Debug)]
pub struct Fixture {
    /// Name in words.
    pub name: String,
    /// Its form, in coordinates of its own.
    pub solid: Arc<Solid>,
    /// Maps those into the table frame.
    pub place: Rigid,
    /// Least distance that tools keep from it [mm]; zero asks for none.
    pub near: f64,
}
