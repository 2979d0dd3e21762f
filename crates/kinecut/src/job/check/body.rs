//! Bodies of a machine, checked: the link that carries each, its form, its mesh.

use glam::DVec3;

use super::axes::{MAX_REACH, axis_names, axis_of, direction, point};

use crate::base::bounded::{length, positive, text};
use crate::base::{Code, Finding, Loader, Result};
use crate::geom::{Aabb, Rigid, Solid, load_mesh};
use crate::job::file::{BodyCylinderTable, BodyTable, BoxTable};
use crate::machine::{Body, Link, Machine};

/// Most bodies of a machine: far more than links, and few enough to compare each with each.
const MOST_BODIES: usize = 1000;

/// Greatest distance that others can be asked to keep from a body [mm].
pub(super) const MOST_NEAR: f64 = 100.0;

/// The bodies of a machine whose axes are known; their errors have the key within the machine.
pub(super) fn bodies(tables: &[BodyTable], machine: &Machine, loader: &dyn Loader) -> Result<Vec<Body>> {
    if tables.len() > MOST_BODIES {
        return Err(Finding::error(Code::MACHINE_BODY, "a machine has too many bodies")
            .value(tables.len() as f64, "bodies")
            .bound(MOST_BODIES as f64, "bodies")
            .help("put several of a link into one mesh")
            .key("body")
            .into());
    }
    let one =
        |(i, t): (usize, &BodyTable)| body(t, machine, loader).map_err(|e| e.under(&format!("body[{i}]")));
    tables.iter().enumerate().map(one).collect()
}

fn body(t: &BodyTable, machine: &Machine, loader: &dyn Loader) -> Result<Body> {
    let link = link(&t.link, machine)?;
    let name = t.name.as_deref().map(|name| text("name", name)).transpose()?.unwrap_or_default();
    let body = match (&t.cuboid, &t.cylinder, &t.mesh) {
        (Some(b), None, None) => Body::cuboid(link, cuboid(b).map_err(|e| e.under("box"))?),
        (None, Some(c), None) => cylinder(link, c).map_err(|e| e.under("cylinder"))?,
        (None, None, Some(file)) => {
            let mesh = load_mesh(file, loader).map_err(|e| e.under("mesh"))?;
            Body { file: Some(file.clone()), ..Body::of(link, Solid::Mesh(mesh), Rigid::IDENTITY) }
        }
        (None, None, None) => {
            return Err(Finding::error(Code::MACHINE_BODY, "a body has no form")
                .help("add box = { min, max }, cylinder = { base, diameter, height } or mesh = \"file.stl\"")
                .key("link")
                .into());
        }
        _ => {
            return Err(Finding::error(Code::MACHINE_BODY, "a body has more than one form")
                .help("write a table [[body]] for each form; several may have one link")
                .key(if t.mesh.is_some() { "mesh" } else { "cylinder" })
                .into());
        }
    };
    let near = length("near", t.near.unwrap_or(Body::NEAR), 0.0, MOST_NEAR)?;
    Ok(Body { name, near, ..body })
}

/// The link that a word names.
fn link(word: &str, machine: &Machine) -> Result<Link> {
    match word {
        "bed" => Ok(Link::Bed),
        "work" => Ok(machine.work_link()),
        "spindle" => Ok(machine.tool_link()),
        axis => axis_of(machine, axis).map(Link::Axis).ok_or_else(|| {
            Finding::error(Code::MACHINE_BODY, format!("the machine {} has no link `{axis}`", machine.code))
                .help(format!(
                    "write bed, work, spindle, or the axis that carries it: {}",
                    axis_names(machine)
                ))
                .key("link")
                .into()
        }),
    }
}

fn cuboid(b: &BoxTable) -> Result<Aabb> {
    let bounds = Aabb { min: point(b.min, "min")?, max: point(b.max, "max")? };
    for i in 0..3 {
        if b.max[i] <= b.min[i] {
            return Err(Finding::error(
                Code::MACHINE_BODY,
                "the greatest corner of a box must exceed the least",
            )
            .value_mm(b.max[i])
            .bound_mm(b.min[i])
            .help("write the least corner as min, the greatest as max")
            .key(format!("max[{i}]"))
            .into());
        }
    }
    Ok(bounds)
}

fn cylinder(link: Link, c: &BodyCylinderTable) -> Result<Body> {
    let base = point(c.base, "base")?;
    let axis = c.axis.map_or(Ok(DVec3::Z), |axis| direction(axis, "axis"))?;
    let diameter = positive("diameter", c.diameter, MAX_REACH, "mm")?;
    let height = positive("height", c.height, MAX_REACH, "mm")?;
    Ok(Body::cylinder(link, base, axis, 0.5 * diameter, height))
}
