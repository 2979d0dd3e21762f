//! Setups and their tilted planes, checked: the orientation of the part, its place on the machine, the height at which
//! the tool travels.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};

use super::super::cutting::{TakenData, within_limit};
use super::super::file::SetupTable;
use super::{JobSetup, program};
use crate::base::bounded::{MAX_LENGTH, length};
use crate::base::{Code, Finding, Loader, Result};
use crate::geom::{Aabb, Rigid, Solid};
use crate::machine::Machine;
use crate::nc::Control;
use crate::operations::setting::{ABOVE_STOCK, corners};
use crate::operations::{Around, Clamping, Drilled, JobPlane, OrientationName, PlaneTable, StockOutline};
use crate::program::{Setup, WorkOffset};
use crate::tool::Tool;

pub(super) fn setup(
    index: usize,
    t: &SetupTable,
    cutting: &mut [TakenData],
    tools: &[Tool],
    (stock, drilled): (&Solid, &[Drilled]),
    (machine, post): (Option<&Machine>, (OrientationName, Control)),
    loader: &dyn Loader,
) -> Result<JobSetup> {
    let offset = work_offset(&t.offset, "offset")?;
    let point = |key: &str, p: [f64; 3]| -> Result<DVec3> {
        for (i, v) in p.into_iter().enumerate() {
            length(&format!("{key}[{i}]"), v, -MAX_LENGTH, MAX_LENGTH)?;
        }
        Ok(DVec3::from_array(p))
    };
    let zero = point("zero", t.zero.unwrap_or([0.0; 3]))?;
    let rotation = match &t.orient {
        None => DMat3::IDENTITY,
        Some(o) => rotation(o.x, o.z).map_err(|e| e.under("orient"))?,
    };
    let part_in_work = Rigid { rotation, translation: -(rotation * zero) };
    let position = t.position.map(|p| point("position", p)).transpose()?;
    let work_on_table = Rigid::from_translation(position.unwrap_or(DVec3::ZERO));
    let bounds = stock.bounds();
    let top = top_of(&bounds, &part_in_work);
    let safe_height = match t.safe_height {
        None => top + ABOVE_STOCK,
        Some(h) => {
            let h = length("safe_height", h, -MAX_LENGTH, MAX_LENGTH)?;
            if h <= top {
                return Err(Finding::error(Code::JOB_VALUE, "the safe height must lie above the stock")
                    .value_mm(h)
                    .bound_mm(top)
                    .key("safe_height")
                    .into());
            }
            h
        }
    };
    let outline = StockOutline { stock, drilled, to_work: part_in_work };
    let around =
        Around { tools, stock: &outline, machine, orientation: post.0, control: post.1, loader, before: &[] };
    let complete = |table: &PlaneTable| plane(table, &part_in_work, &bounds, machine);
    let operations = t.operations.iter().enumerate().map(|(i, operation)| {
        let around = Around { before: &t.operations[..i], ..around };
        let taken = cutting.iter_mut().find(|taken| taken.operation == (index, i));
        within_limit(operation, &|table| table.check(&around, complete), machine, taken)
            .map_err(|e| e.under(&format!("operation[{i}]")))
    });
    let mut work_offsets = BTreeMap::from([(offset, work_on_table)]);
    for (name, zero) in &t.offsets {
        let key = format!("offsets.{name}");
        let zero = point(&key, *zero)?;
        let moved = Rigid::from_translation(part_in_work.point(zero));
        if work_offsets.insert(work_offset(name, &key)?, work_on_table.after(&moved)).is_some() {
            return Err(Finding::error(Code::JOB_VALUE, format!("{name} is said twice")).key(key).into());
        }
    }
    let operations = operations.collect::<Result<Vec<_>>>()?;
    let program = match (&t.program, operations.is_empty()) {
        (Some(program), true) => {
            Some(program::program(program, tools, post.1, loader).map_err(|e| e.under("program"))?)
        }
        (None, false) => None,
        (None, true) => {
            return Err(Finding::error(Code::JOB_SHAPE, "a setup needs operations or a program")
                .help("add [[setup.operation]], or program = { file = \"O1234.nc\" }")
                .into());
        }
        (Some(_), false) => {
            return Err(Finding::error(Code::JOB_SHAPE, "a setup has operations or a program, not both")
                .help("give the program a setup of its own")
                .key("program")
                .into());
        }
    };
    let clamping = Clamping {
        setup: Setup {
            name: format!("setup {}", index + 1),
            part_on_table: work_on_table.after(&part_in_work),
            work_offsets,
            located: position.is_some(),
            stock: (index == 0).then(|| stock.clone()),
            fixtures: Vec::new(),
        },
        offset,
        safe_height,
        table: t.table.map(|h| length("table", h, -MAX_LENGTH, MAX_LENGTH)).transpose()?,
        breakthrough: length("breakthrough", t.breakthrough.unwrap_or(BREAKTHROUGH), 0.0, MAX_LENGTH)?,
    };
    Ok(JobSetup { clamping, operations, program })
}

fn work_offset(name: &str, key: &str) -> Result<WorkOffset> {
    WorkOffset::parse(name).ok_or_else(|| {
        Finding::error(Code::JOB_VALUE, format!("`{}` is no work offset", name.escape_default()))
            .help("write \"G54\" to \"G59\", \"G59.1\" to \"G59.3\", \"G505\" to \"G599\" or \"G54.1 P1\" to \"G54.1 P300\"")
            .key(key)
            .into()
    })
}

/// Height of the highest corner of a box under a motion [mm].
fn top_of(bounds: &Aabb, motion: &Rigid) -> f64 {
    Aabb::of_points(corners(bounds, motion)).max.z
}

/// Depth to which a tool may go below the stock besides the length of its point, if nothing says it [mm]: more than a
/// through hole or an outline needs, less than the parallels that a part mostly stands on are high.
const BREAKTHROUGH: f64 = 3.0;

fn plane(t: &PlaneTable, part_in_work: &Rigid, stock: &Aabb, machine: Option<&Machine>) -> Result<JobPlane> {
    if machine.is_none_or(|m| !m.is_multi_axis()) {
        return Err(Finding::error(Code::JOB_REFERENCE, "a tilted plane needs a machine with rotary axes")
            .help("give the job such a machine, or turn the part with `orient` in a setup of its own")
            .into());
    }
    for (i, v) in t.origin.into_iter().enumerate() {
        length(&format!("origin[{i}]"), v, -MAX_LENGTH, MAX_LENGTH)?;
    }
    let part_to_plane = rotation(t.x, t.z)?;
    let origin = DVec3::from_array(t.origin);
    let to_plane = Rigid { rotation: part_to_plane, translation: -(part_to_plane * origin) };
    Ok(JobPlane {
        motion: part_in_work.after(&to_plane.inverse()),
        branch: t.branch,
        safe_height: top_of(stock, &to_plane).max(0.0) + ABOVE_STOCK,
    })
}

pub(super) fn rotation(x: [f64; 3], z: [f64; 3]) -> Result<DMat3> {
    let unit = |key: &str, v: [f64; 3]| {
        DVec3::from_array(v)
            .try_normalize()
            .ok_or_else(|| Finding::error(Code::JOB_VALUE, "this is no direction").key(key))
    };
    let (x, z) = (unit("x", x)?, unit("z", z)?);
    // A thousandth of a degree: more is a slip, less is rounding.
    if x.dot(z).abs() > 1.7e-5 {
        return Err(Finding::error(Code::JOB_VALUE, "the directions of X and Z are not at right angles")
            .value(x.angle_between(z).to_degrees(), "deg")
            .bound(90.0, "deg")
            .key("x")
            .into());
    }
    let y = z.cross(x);
    let y = y / y.length();
    // Rows are the work axes in part coordinates: the matrix takes part coordinates to work coordinates.
    Ok(DMat3::from_cols(y.cross(z), y, z).transpose())
}
