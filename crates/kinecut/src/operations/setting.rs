//! Surroundings of an operation when it is checked, planned and posted: the clamping, the raw stock, the machine and the control.

use std::borrow::Cow;

use glam::DVec3;

use super::edge::FaceEdges;
use super::{MadeHole, Milling, OperationTable, OrientationName, PlacedMouth, PlacedPlane};
use crate::base::{Loader, Progress};
use crate::geom::{Aabb, Rigid, Solid};
use crate::machine::Machine;
use crate::motion::AxisLimit;
use crate::nc::{Control, PostSettings};
use crate::program::{Setup, WorkOffset};
use crate::stock::cut::CutAxis;
use crate::tool::Tool;

/// The part as it is clamped, and the height at which the tool travels over it.
#[derive(Clone, Debug)]
pub struct Clamping {
    /// As the program knows it.
    pub setup: Setup,
    /// Its work offset.
    pub offset: WorkOffset,
    /// Height above the work zero between operations [mm].
    pub safe_height: f64,
    /// Height of the table above the work zero [mm], if it is known.
    pub table: Option<f64>,
    /// Depth to which a tool may go below the stock besides the length of its point [mm].
    pub breakthrough: f64,
}

impl Clamping {
    /// Height above the work zero that is assumed for a retracted tool where the machine position is not known [mm].
    pub(crate) fn retract_height(&self) -> f64 {
        /// Distance above the safe height [mm].
        const RETRACTED_ABOVE_SAFE: f64 = 100.0;
        self.safe_height + RETRACTED_ABOVE_SAFE
    }

    /// The work offset in the table frame.
    pub fn work(&self) -> Rigid {
        self.setup.work_offsets.get(&self.offset).copied().unwrap_or(Rigid::IDENTITY)
    }

    /// Maps part coordinates into those of the work offset.
    pub fn to_work(&self) -> Rigid {
        self.work().inverse().after(&self.setup.part_on_table)
    }

    /// Maps part coordinates into those of an operation: of its tilted plane, or of the work offset.
    pub fn to_operation(&self, milling: &Milling) -> Rigid {
        self.at(milling).to_work()
    }

    /// The clamping as an operation sees it: with its tilted plane in the place of the work offset.
    pub fn at(&self, milling: &Milling) -> Cow<'_, Clamping> {
        let Some(plane) = milling.plane else { return Cow::Borrowed(self) };
        let mut clamping = self.clone();
        for work in clamping.setup.work_offsets.values_mut() {
            *work = work.after(&plane.motion);
        }
        clamping.safe_height = plane.safe_height;
        Cow::Owned(clamping)
    }
}

/// Surroundings of a table when it is checked.
#[derive(Clone, Copy)]
pub(crate) struct Around<'a> {
    /// The tools of the job.
    pub(crate) tools: &'a [Tool],
    /// The raw stock as the setup sees it.
    pub(crate) stock: &'a StockOutline<'a>,
    /// The machine, if there is one.
    pub(crate) machine: Option<&'a Machine>,
    /// The form in which the program says the directions of its tool.
    pub(crate) orientation: OrientationName,
    /// The control.
    pub(crate) control: Control,
    /// Reads the files that the table names.
    pub(crate) loader: &'a dyn Loader,
    /// The tables of the operations before it in its setup.
    pub(crate) before: &'a [OperationTable],
}

/// Surroundings of an operation when it is planned.
#[derive(Clone, Copy)]
pub(crate) struct Setting<'a> {
    /// Number of the operation over all setups.
    pub(crate) number: u32,
    /// The clamping as the operation sees it.
    pub(crate) clamping: &'a Clamping,
    /// Number of the other operations of its setup.
    pub(crate) others: usize,
    /// The raw stock [part coordinates].
    pub(crate) stock: &'a Solid,
    /// Holes that it already has.
    pub(crate) drilled: &'a [Drilled],
    /// Holes that operations before it leave.
    pub(crate) made: &'a [MadeHole],
    /// Planes that operations before it leave.
    pub(crate) faced: &'a [PlacedPlane],
    /// Recesses at the mouths of holes that operations before it leave.
    pub(crate) mouths: &'a [PlacedMouth],
    /// The face that was milled last before it in its setup.
    pub(crate) milled: Option<&'a FaceEdges>,
    /// The machine, if there is one.
    pub(crate) machine: Option<&'a Machine>,
    /// The form in which the program says the directions of its tool.
    pub(crate) orientation: OrientationName,
    /// Settings of the writer.
    pub(crate) post: &'a PostSettings,
    /// Limits that a feed may ask of each linear axis; `None` where feeds are written as they are.
    pub(crate) feed_limit: Option<AxisLimit>,
    /// Whether other ways than the one asked for are planned too, each with its price.
    pub(crate) compare: bool,
    /// Told of progress, and asked whether the plan is still wanted.
    pub(crate) progress: &'a dyn Progress,
}

impl Setting<'_> {
    /// The box of the raw stock in the coordinates of an operation.
    pub(crate) fn around(&self, milling: &Milling) -> Aabb {
        let to_operation = self.clamping.to_operation(milling);
        let far = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (min, max) = corners(&self.stock.bounds(), &to_operation)
            .into_iter()
            .fold(far, |(min, max), c| (min.min(c), max.max(c)));
        Aabb { min, max }
    }

    /// Whether a cut down to a height goes through the raw stock.
    pub(crate) fn is_through(&self, milling: &Milling, bottom: f64) -> bool {
        bottom <= self.around(milling).min.z + 1e-6
    }

    /// Least step of the control's coordinates [mm].
    pub(crate) fn resolution(&self) -> f64 {
        let last = self.post.units.mm() * self.post.control.resolution(self.post.decimals);
        self.post.resolution.unwrap_or(last)
    }
}

/// Height above the stock at which the tool travels, if the job does not say it [mm].
pub(crate) const ABOVE_STOCK: f64 = 50.0;

/// The corners of a box under a motion.
pub(crate) fn corners(bounds: &Aabb, motion: &Rigid) -> [DVec3; 8] {
    std::array::from_fn(|i| {
        let pick = |bit: usize, lo: f64, hi: f64| if i & bit == 0 { lo } else { hi };
        motion.point(DVec3::new(
            pick(1, bounds.min.x, bounds.max.x),
            pick(2, bounds.min.y, bounds.max.y),
            pick(4, bounds.min.z, bounds.max.z),
        ))
    })
}

/// The raw stock as a setup sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StockOutline<'a> {
    /// The stock [part coordinates].
    pub(crate) stock: &'a Solid,
    /// Holes that it has.
    pub(crate) drilled: &'a [Drilled],
    /// Maps part coordinates to the work offset.
    pub(crate) to_work: Rigid,
}

/// A round hole along Z that the raw stock already has [part coordinates].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drilled {
    /// Centre of the lower end.
    pub base: DVec3,
    /// Diameter [mm].
    pub diameter: f64,
    /// Height [mm].
    pub height: f64,
}

/// Whether the stock can be cut where the tool stands along this direction [part coordinates].
pub(crate) fn is_along_axis(direction: DVec3) -> bool {
    CutAxis::of(direction).is_some()
}
