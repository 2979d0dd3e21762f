//! A bore of the job file in the planner's words.

use super::{BoreOperation, BoreTable};
use crate::base::{Code, Error, Finding, Result};
use crate::holes::{BoreSpec, Finish, LeadEnd, Wear};
use crate::operations::Setting;
use crate::operations::wall::{CLEARANCE, FinishTable, cutter};

/// A warning when the stock to leave, and nothing else, keeps the cutter out of the bore.
pub(super) fn nothing_to_mill(spec: &BoreSpec, name: &str) -> Option<Finding> {
    let (left, cutter) = (spec.wall_radius(spec.floor()), spec.cutter_radius());
    let fits_without = left + spec.stock_to_leave[0] > cutter;
    (spec.stock_to_leave[0] > 0.0 && left <= cutter && fits_without).then(|| {
        let most = left + spec.stock_to_leave[0] - cutter;
        Finding::warning(
            Code::NOTHING_TO_MILL,
            format!("{name}: with the stock to leave it is not larger than the cutter; left out"),
        )
        .value_mm(spec.stock_to_leave[0])
        .bound_mm(most)
        .help(format!("leave less than {most:.3} mm, or use a smaller cutter"))
    })
}

/// Checks that the control offers a wear register, and the value to simulate with.
pub(super) fn check_wear(setting: &Setting<'_>, bore: &BoreOperation, spec: &BoreSpec) -> Result<()> {
    let Some(f) = &bore.table.finish else { return Ok(()) };
    let Some(wear) = spec.finish.and_then(|f| f.wear) else {
        if f.wear_value.is_some() || f.wear_largest.is_some() {
            return Err(Finding::error(Code::JOB_SHAPE, "a value of the wear register needs the register")
                .help("add wear_offset = \"D2\"")
                .key("wear_value")
                .into());
        }
        return Ok(());
    };
    let value = f.wear_value.unwrap_or(0.0);
    if !(value.abs() <= wear.largest) {
        return Err(Finding::error(Code::JOB_VALUE, "the wear exceeds what the pass is planned for")
            .value_mm(value)
            .bound_mm(wear.largest)
            .help("raise `wear_largest`, or finish with another cutter")
            .key("wear_value")
            .into());
    }
    let (control, tool) = (setting.post.control, bore.milling.tool.number);
    if !control.has_compensation() {
        return Err(Finding::error(
            Code::POST_CONTROL,
            format!("{} has no cutter compensation", control.title()),
        )
        .help("leave out `wear_offset`")
        .key("wear_offset")
        .into());
    }
    if wear.register == control.length_register(tool) {
        return Err(Finding::error(
            Code::JOB_VALUE,
            format!("the register D{} is that of {tool} itself and may hold its whole radius", wear.register),
        )
        .help(format!("use a register of its own that holds the wear only: D{}", control.wear_register(tool)))
        .key("wear_offset")
        .into());
    }
    Ok(())
}

/// The bore operation in the planner's words.
///
/// # Errors
/// `KC0103` for keys that exclude each other.
pub(crate) fn spec(setting: &Setting<'_>, bore: &BoreOperation) -> Result<BoreSpec> {
    let t: &BoreTable = &bore.table;
    Ok(BoreSpec {
        centre: t.at,
        top: t.top,
        breakthrough: (t.breakthrough > 0.0).then_some(t.breakthrough),
        bottom_diameter: t.bottom_diameter,
        stock_to_leave: [t.stock_to_leave, t.stock_to_leave_floor],
        sense: t.direction,
        strategy: t.strategy,
        entry: t.entry,
        rough: t.rough,
        finish: t.finish.as_ref().map(finish).transpose().map_err(|e| e.under("finish"))?,
        retract_z: setting.clamping.safe_height,
        approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, setting.clamping.safe_height),
        resolution: (setting.post.control.has_involute()
            && setting.post.involute_native
            && setting.post.arcs)
            .then(|| setting.resolution()),
        ..BoreSpec::new(t.diameter, t.depth, cutter(&bore.milling.tool))
    })
}

fn finish(f: &FinishTable) -> Result<Finish> {
    let end = |key: &str, point: Option<[f64; 2]>, radius: Option<f64>, length: Option<f64>| match (
        point, radius, length,
    ) {
        (None, None, None) => Ok(LeadEnd::Usual),
        (Some(p), None, None) => Ok(LeadEnd::Point(p)),
        (None, Some(r), None) => Ok(LeadEnd::Radius(r)),
        (None, None, Some(l)) => Ok(LeadEnd::Length(l)),
        _ => Err(Error::from(
            Finding::error(
                Code::JOB_SHAPE,
                format!("`{key}`, `{key}_radius` and `{key}_length` exclude each other"),
            )
            .help("give one of them, or none")
            .key(key),
        )),
    };
    let wear = f.wear_offset.as_deref().map(|name| {
        let number = name.strip_prefix(['D', 'd']).and_then(|n| n.parse().ok());
        let register = number.filter(|n| (1..=MOST_REGISTER).contains(n)).ok_or_else(|| {
            Finding::error(Code::JOB_VALUE, format!("`{}` is no wear register", name.escape_default()))
                .help("write the letter D and a number, such as \"D2\"")
                .key("wear_offset")
        })?;
        Ok::<_, Error>(Wear { register, largest: f.wear_largest.unwrap_or(USUAL_WEAR) })
    });
    Ok(Finish {
        turns: f.turns.unwrap_or(2),
        lead: f.contact.order(),
        feed_at: f.feed_at,
        start: end("start", f.start, f.start_radius, f.start_length)?,
        end: end("end", f.end, f.end_radius, f.end_length)?,
        spring_passes: f.spring_passes,
        wear: wear.transpose()?,
        stepdown: f.stepdown,
        ..Finish::new(f.feed)
    })
}

/// Largest wear that a register may get when the job says nothing [mm].
const USUAL_WEAR: f64 = 0.1;

/// Largest register that a control has.
const MOST_REGISTER: u32 = 999;
