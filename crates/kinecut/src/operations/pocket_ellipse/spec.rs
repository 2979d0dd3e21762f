//! An elliptic pocket of the job file in the planner's words.

use super::EllipseOperation;
use crate::holes::{BoreSpec, EllipseSpec, Finish, Rough};
use crate::operations::Setting;
use crate::operations::wall::{CLEARANCE, cutter};

/// The pocket operation in the planner's words.
pub(super) fn spec(setting: &Setting<'_>, pocket: &EllipseOperation) -> EllipseSpec {
    let t = &pocket.table;
    EllipseSpec {
        half_axes: t.half_axes,
        turned: t.angle.to_radians(),
        order: t.contact.order(),
        bore: BoreSpec {
            centre: t.at,
            top: t.top,
            breakthrough: (t.breakthrough > 0.0).then_some(t.breakthrough),
            stock_to_leave: [t.stock_to_leave, t.stock_to_leave_floor],
            sense: t.direction,
            entry: t.entry,
            // Always from the centre.
            rough: Some(Rough { start: None, ..t.rough }),
            finish: t.finish.as_ref().map(|f| Finish {
                spring_passes: f.spring_passes,
                stepdown: f.stepdown,
                ..Finish::new(f.feed)
            }),
            retract_z: setting.clamping.safe_height,
            approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, setting.clamping.safe_height),
            ..BoreSpec::new(2.0 * t.half_axes[0].min(t.half_axes[1]), t.depth, cutter(&pocket.milling.tool))
        },
    }
}
