//! An elliptic pocket of the job file in the planner's words.

use super::EllipseOperation;
use crate::holes::{BoreSpec, EllipseSpec, Finish, RoughStart};
use crate::operations::Setting;
use crate::operations::wall::{CLEARANCE, cutter, drilled, entry, order, per_second, rough};

/// The pocket operation in the planner's words.
pub(super) fn spec(setting: &Setting<'_>, pocket: &EllipseOperation) -> EllipseSpec {
    let t = &pocket.table;
    let rough = rough(&t.rough);
    EllipseSpec {
        half_axes: t.half_axes,
        turned: t.angle.to_radians(),
        order: order(t.contact),
        bore: BoreSpec {
            centre: t.at,
            top: t.top,
            breakthrough: (t.breakthrough > 0.0).then_some(t.breakthrough),
            stock_to_leave: [t.stock_to_leave, t.stock_to_leave_floor],
            sense: t.direction,
            start: drilled(&t.entry)
                .map_or(RoughStart::Centre, |diameter| RoughStart::PreDrilled { diameter }),
            entry: entry(&t.entry),
            rough: Some(rough),
            finish: t.finish.as_ref().map(|f| Finish {
                spring_passes: f.spring_passes,
                stepdown: f.stepdown,
                ..Finish::new(per_second(f.feed))
            }),
            retract_z: setting.clamping.safe_height,
            approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, setting.clamping.safe_height),
            ..BoreSpec::new(2.0 * t.half_axes[0].min(t.half_axes[1]), t.depth, cutter(&pocket.milling.tool))
        },
    }
}
