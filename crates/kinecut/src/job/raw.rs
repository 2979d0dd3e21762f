//! The raw stock, and changes of it by hand: holes that are there before the job, and cores that a person takes out.

use super::check::Job;
use crate::base::{Code, Finding, Result, Silent};
use crate::geom::{Line, Profile, Solid};
use crate::operations::measured::Loose;
use crate::stock::cut::{CutAxis, CutList, CutMove, CutOptions, Spared, ToolBody, cut_list};
use crate::stock::{DexelGrid, TriDexel};

/// Takes the holes that the raw stock already has out of it: the first cuts of the body.
pub(super) fn drill(stock: &mut TriDexel, job: &Job) -> Result<()> {
    drill_sparing(stock, job, Spared::NOTHING)
}

/// The same of holes that may be narrower, and shorter where they end within the stock: a stock that is larger is drilled through all the same.
pub(super) fn drill_sparing(stock: &mut TriDexel, job: &Job, spared: Spared) -> Result<()> {
    for (i, hole) in job.drilled.iter().enumerate() {
        let (whole, beyond) = (job.stock.bounds(), 3.0 * spared.around);
        let (mut low, mut high) = (hole.base.z, hole.base.z + hole.height);
        low -= if low <= whole.min.z { beyond } else { 0.0 };
        high += if high >= whole.max.z { beyond } else { 0.0 };
        let body = ToolBody::new(Profile::cylinder(hole.diameter, high - low)?);
        let down = Line { start: hole.base.with_z(high), end: hole.base.with_z(low) };
        plunge(stock, body, CutMove::new(down, CutAxis::PlusZ, 0), i as u32, spared)?;
    }
    Ok(())
}

/// One cut by hand.
fn plunge(stock: &mut TriDexel, body: ToolBody, one: CutMove, first_cut: u32, spared: Spared) -> Result<()> {
    let options = CutOptions { first_cut, ..CutOptions::default() };
    let step = stock.lattice().step;
    let list = CutList::sparing(&[body], &[spared], vec![one], &options, step)?;
    cut_list(stock, &list, 0..1, &Silent).map(|_| ())
}

/// The raw stock with lines at a distance [mm].
pub(super) fn raw_stock(stock: &Solid, step: f64) -> Result<TriDexel> {
    match stock {
        Solid::Box(bounds) => TriDexel::from_box(*bounds, step),
        Solid::Cylinder { base, radius, height } => TriDexel::from_cylinder(*base, *radius, *height, step),
        Solid::Mesh(mesh) => TriDexel::from_mesh(mesh, step),
    }
}

/// Takes a loose core out.
pub(super) fn take_out(stock: &mut TriDexel, core: &Loose, first_cut: u32) -> Result<()> {
    take_out_sparing(stock, core, first_cut, Spared::NOTHING)
}

/// The same of one that may be elsewhere.
pub(super) fn take_out_sparing(
    stock: &mut TriDexel,
    core: &Loose,
    first_cut: u32,
    spared: Spared,
) -> Result<()> {
    /// The core stands in a slot as wide as the cutter: a little more than its diameter is all of it [mm].
    const ROUND: f64 = 0.05;
    let axis = CutAxis::of(core.out).ok_or_else(off_axis)?;
    let body = ToolBody::new(Profile::cylinder(core.diameter + ROUND, core.depth)?);
    let down = Line { start: core.centre, end: core.centre - core.out * core.depth };
    plunge(stock, body, CutMove::new(down, axis, 0), first_cut, spared)
}

/// The error of a tool axis that the stock cannot be cut along.
pub(super) fn off_axis() -> Finding {
    Finding::error(Code::MACHINE_AXIS, "the tool axis does not run along an axis of the part")
        .help("turn the part in steps of 90 degrees, or give the stock in a turned frame")
}
