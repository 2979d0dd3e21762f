//! Clamps and fixtures, checked: bodies in the coordinates of the work offset.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::super::file::{ClampTable, FixtureTable, StockTable, ViseTable};
use super::body::MOST_NEAR;
use super::stock;
use crate::base::bounded::{MAX_LENGTH, length, positive, text};
use crate::base::{Code, Finding, Loader, Result};
use crate::geom::{Aabb, Rigid, Solid};
use crate::machine::Body;
use crate::program::Fixture;

/// Height of the bed of a vise, if nothing says it [mm].
const BED: f64 = 40.0;

/// A fixture with the setups in which it is there.
pub(super) struct Placed {
    setups: Option<Vec<u32>>,
    bodies: Vec<Fixture>,
}

impl Placed {
    /// Its bodies in a setup, counted from 0, whose work offset lies there on the table.
    pub(super) fn in_setup(&self, index: usize, work_on_table: &Rigid) -> Vec<Fixture> {
        let there = self.setups.as_ref().is_none_or(|all| all.iter().any(|s| *s as usize == index + 1));
        let bodies = self.bodies.iter().filter(|_| there);
        bodies.map(|body| Fixture { place: work_on_table.after(&body.place), ..body.clone() }).collect()
    }
}

/// The fixtures of a job with this many setups.
pub(super) fn fixtures(tables: &[FixtureTable], setups: usize, loader: &dyn Loader) -> Result<Vec<Placed>> {
    let one = |(i, table): (usize, &FixtureTable)| {
        let said = |t: &&FixtureTable| t.name == table.name;
        if tables[..i].iter().find(said).is_some() {
            return Err(Finding::error(Code::JOB_VALUE, format!("`{}` is said twice", shown(&table.name)))
                .help("give each fixture a name of its own")
                .key(format!("fixture[{i}].name"))
                .into());
        }
        fixture(table, setups, loader).map_err(|e| e.under(&format!("fixture[{i}]")))
    };
    tables.iter().enumerate().map(one).collect()
}

fn shown(name: &str) -> String {
    name.escape_default().to_string()
}

fn fixture(t: &FixtureTable, setups: usize, loader: &dyn Loader) -> Result<Placed> {
    text("name", &t.name)?;
    if t.name.trim().is_empty() {
        return Err(Finding::error(Code::JOB_VALUE, "a fixture has an empty name")
            .help("name it as findings shall say it: name = \"left clamp\"")
            .key("name")
            .into());
    }
    for (i, number) in t.setups.iter().flatten().enumerate() {
        if *number == 0 || *number as usize > setups {
            return Err(Finding::error(Code::JOB_REFERENCE, "there is no setup of this number")
                .value(f64::from(*number), "")
                .bound(setups as f64, "setups")
                .help("count the setups from 1, or leave `setups` out: then it is there in all of them")
                .key(format!("setups[{i}]"))
                .into());
        }
    }
    let mut at = DVec3::ZERO;
    for (i, value) in t.at.iter().flatten().enumerate() {
        at[i] = length(&format!("at[{i}]"), *value, -MAX_LENGTH, MAX_LENGTH)?;
    }
    let turn = length("turn", t.turn.unwrap_or(0.0), -360.0, 360.0)?;
    let place = Rigid { rotation: DMat3::from_rotation_z(turn.to_radians()), translation: at };
    let near = length("near", t.near.unwrap_or(Body::NEAR), 0.0, MOST_NEAR)?;
    let bodies = forms(t, loader)?;
    let body = |(name, solid): (&str, Solid)| {
        let name = if name.is_empty() { t.name.clone() } else { format!("{} ({name})", t.name) };
        Fixture { name, solid: Arc::new(solid), place, near }
    };
    Ok(Placed { setups: t.setups.clone(), bodies: bodies.into_iter().map(body).collect() })
}

/// The solids of a fixture, each with its name within it.
fn forms(t: &FixtureTable, loader: &dyn Loader) -> Result<Vec<(&'static str, Solid)>> {
    let given =
        [t.block.is_some(), t.cylinder.is_some(), t.mesh.is_some(), t.vise.is_some(), t.clamp.is_some()];
    let one = |table: StockTable| Ok(vec![("", stock(&table, loader)?)]);
    match (given.into_iter().filter(|g| *g).count(), t) {
        (1, FixtureTable { block: Some(block), .. }) => one(StockTable::Box(block.clone())),
        (1, FixtureTable { cylinder: Some(cylinder), .. }) => one(StockTable::Cylinder(cylinder.clone())),
        (1, FixtureTable { mesh: Some(mesh), .. }) => one(StockTable::Mesh(mesh.clone())),
        (1, FixtureTable { vise: Some(table), .. }) => vise(table).map_err(|e| e.under("vise")),
        (1, FixtureTable { clamp: Some(table), .. }) => clamp(table).map_err(|e| e.under("clamp")),
        (count, _) => {
            let what = if count == 0 { "a fixture has no form" } else { "a fixture has more than one form" };
            Err(Finding::error(Code::JOB_SHAPE, what)
                .help("give it one of `box`, `cylinder`, `mesh`, `vise` and `clamp`")
                .into())
        }
    }
}

fn vise(t: &ViseTable) -> Result<Vec<(&'static str, Solid)>> {
    let x = positive("jaw_width", t.jaw_width, MAX_LENGTH, "mm")? / 2.0;
    let inner = positive("opening", t.opening, MAX_LENGTH, "mm")? / 2.0;
    let height = positive("jaw_height", t.jaw_height, MAX_LENGTH, "mm")?;
    let outer = inner + positive("jaw_thickness", t.jaw_thickness, MAX_LENGTH, "mm")?;
    let top = -length("parallels", t.parallels.unwrap_or(0.0), 0.0, MAX_LENGTH)?;
    let below = top - positive("bed", t.bed.unwrap_or(BED), MAX_LENGTH, "mm")?;
    let block = |min: [f64; 3], max: [f64; 3]| Solid::Box(Aabb { min: min.into(), max: max.into() });
    Ok(vec![
        ("jaw at Y+", block([-x, inner, below], [x, outer, height])),
        ("jaw at Y-", block([-x, -outer, below], [x, -inner, height])),
        ("bed", block([-x, -inner, below], [x, inner, top])),
    ])
}

fn clamp(t: &ClampTable) -> Result<Vec<(&'static str, Solid)>> {
    let long = positive("length", t.length, MAX_LENGTH, "mm")?;
    let y = positive("width", t.width, MAX_LENGTH, "mm")? / 2.0;
    let thick = positive("thickness", t.thickness, MAX_LENGTH, "mm")?;
    let at = length("bolt_at", t.bolt_at.unwrap_or(long / 2.0), 0.0, long)?;
    let diameter = positive("bolt_diameter", t.bolt_diameter.unwrap_or(y), MAX_LENGTH, "mm")?;
    let height = positive("bolt_height", t.bolt_height.unwrap_or(thick), MAX_LENGTH, "mm")?;
    let strap = Aabb { min: DVec3::new(0.0, -y, 0.0), max: DVec3::new(long, y, thick) };
    let base = DVec3::new(at, 0.0, thick);
    Ok(vec![("strap", Solid::Box(strap)), ("bolt", Solid::Cylinder { base, radius: diameter / 2.0, height })])
}
