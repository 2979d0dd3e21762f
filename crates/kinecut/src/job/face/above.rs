//! Whether the raw stock stands higher over a face than the operation reckons with.

use super::super::check::{Job, Operation};
use crate::base::{Code, Finding};
use crate::geom::{Aabb, Rigid};

/// A warning when the first operation of a job mills a face over which the raw stock stands higher than `depth` says: its
/// first level would be deeper than planned. Where other operations come first the stock is not known here.
pub(in crate::job) fn stock_above(job: &Job) -> Option<Finding> {
    /// Rounding of a height [mm].
    const ROUNDING: f64 = 1e-6;
    let setup = job.setups.first()?;
    let Operation::Face(face) = setup.operations.first()? else { return None };
    let work = setup.setup.work_offsets.get(&setup.offset).copied().unwrap_or(Rigid::IDENTITY);
    let to_work = work.inverse().after(&setup.setup.part_on_table);
    let bounds = job.stock.bounds();
    let corners = (0..8).map(|i| {
        let pick = |bit: i32, low: f64, high: f64| if i & bit == 0 { low } else { high };
        to_work.point(glam::DVec3::new(
            pick(1, bounds.min.x, bounds.max.x),
            pick(2, bounds.min.y, bounds.max.y),
            pick(4, bounds.min.z, bounds.max.z),
        ))
    });
    let height = Aabb::of_points(corners).max.z - face.table.top;
    (height > face.table.depth + ROUNDING).then(|| {
        Finding::warning(
            Code::FACE_ADVICE,
            format!("{}: the stock stands higher over the finished plane than `depth` says", face.name()),
        )
        .value_mm(height)
        .bound_mm(face.table.depth)
        .cure(format!("set depth = {height}, with axial_step if that is too much at once"))
        .key("setup[0].operation[0].depth")
    })
}
