//! The cut part against what is wanted: one comparison, at the ends of the stock's lines, where the stock is exact.
//!
//! Each end is compared with the operations' walls, floors and faces, and with the design; findings, claims, the numbers of
//! the report and the colours of the part are all taken from that. Several operations want one union of cuts: what another
//! one cuts away is not looked for.

mod claim;
mod design;
mod flat;
mod judge;
mod measure;
mod rest;
mod wanted;

use glam::DVec3;
use rayon::prelude::*;

use super::check::Job;
use super::setup_outcome::{SetupOutcome, block_of_cut};
use super::simulate::Simulation;
use crate::base::{Finding, Result};
use crate::geom::{Aabb, Mesh, Rigid};
use crate::holes::CutterData;
use crate::operations::measured::{BoreMeasure, FaceMeasure};
use crate::stock::{Axis, CutId, DexelGrid, EndMap, Interval, Lattice, TriDexel, unfixed};

pub use self::design::RegionMeasure;
pub use self::rest::{RestReach, SizeReach, ToolReach};

use self::claim::{Claim, Cuts};
use self::flat::measure_face;
use self::wanted::{Wanted, wanted};
use super::bins::Bins;

/// The cut part against the wanted one.
#[derive(Clone, Debug, Default)]
pub struct Deviation {
    /// Deviation at each vertex of the part's mesh: positive where stock is left, negative where the wanted surface is
    /// gouged, NaN where nothing is wanted. In mm, or in tolerances of each surface if they are not all the same
    /// ([`Deviation::relative`]). Of the ends of lines around a vertex the worst counts.
    pub at_vertices: Vec<f32>,
    /// The tolerance of the compared surfaces [mm]; 1 if they have several ([`Deviation::relative`]), 0 if there are none.
    pub tolerance: f64,
    /// Whether the colours show tolerances, because not all surfaces have the same one.
    pub relative: bool,
    /// The largest deviation in terms of its tolerance; none when nothing was compared.
    pub largest: Option<Largest>,
    /// One for each bore, in the order of the operations.
    pub bores: Vec<BoreMeasure>,
    /// One for each milled face.
    pub faces: Vec<FaceMeasure>,
    /// Measures of the design: of the surface outside of all regions, then of each region; none without a design.
    pub regions: Vec<RegionMeasure>,
    /// Tools that come to the places at which too much stock is left on the design; none where there are none.
    pub reach: Option<RestReach>,
    /// Findings, each with the cut that made it, 0 where nothing cut, and the number of the operation that wanted the surface;
    /// without one it is the design's.
    pub findings: Vec<(Finding, CutId, Option<u32>)>,
    /// Doubts about what could not be measured, each with the number of its operation.
    pub unmeasured: Vec<(Finding, u32)>,
    /// Claims proven.
    pub proven: Vec<String>,
}

/// The largest deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Largest {
    /// Deviation [mm]: positive stock left, negative gouged.
    pub deviation: f64,
    /// Tolerance of its surface [mm].
    pub tolerance: f64,
}

/// Result of comparing an end of a line: its deviation and the tolerance of that surface [mm].
#[derive(Clone, Copy, Debug)]
struct Compared {
    deviation: f32,
    tolerance: f32,
}

impl Compared {
    const NOT: Compared = Compared { deviation: f32::NAN, tolerance: f32::NAN };

    /// The deviation in tolerances.
    fn ratio(self) -> f32 {
        self.deviation / self.tolerance
    }

    /// The worse; of equal ones the first.
    fn or(self, other: Compared) -> Compared {
        let worse = self.deviation.is_nan() || other.ratio().abs() > self.ratio().abs();
        if worse && !other.deviation.is_nan() { other } else { self }
    }
}

/// Whether there is anything that the cut stock is compared with.
pub(super) fn compares(job: &Job, setups: &[SetupOutcome]) -> bool {
    let any_plane = || setups.iter().flat_map(|s| &s.planned.operations).any(|o| o.plan.plane().is_some());
    job.design.is_some() || !wanted(job, setups).is_empty() || any_plane()
}

/// Compares the cut stock with what the operations want and with the design, and gives the vertices of its surface what the
/// ends of lines around them have.
///
/// # Errors
/// `KC0602` when the design mesh does not close; `KC0105` when there are too many ends.
pub fn deviation(
    job: &Job,
    setups: &[SetupOutcome],
    simulation: &Simulation,
    part: &Mesh,
) -> Result<Deviation> {
    let mut answer = Deviation::default();
    let wanted = wanted(job, setups);
    if !compares(job, setups) {
        return Ok(answer);
    }
    let stock = &simulation.stock;
    let operation_of = |cut: CutId| {
        let (setup, item) = block_of_cut(setups, simulation, cut)?;
        let planned = setups[setup].planned_item(item)?;
        setups[setup].planned.program.origin(planned as usize).operation
    };
    let mut claims = EndMap::new(stock, Claim::NONE)?;
    let aimless = aimless(job, setups);
    for (of, bore) in wanted.iter().enumerate() {
        let made =
            Made { bore, wanted: &wanted, aimless: &aimless, operation_of: &operation_of, last: (0, false) };
        claim_ends(bore, of as u32, stock, made, &mut claims);
    }
    let measures = measures(&wanted, stock, &claims);
    let mut tolerances: Vec<f64> = wanted.iter().map(|w| w.operation.milling().tolerance).collect();
    for (m, &tolerance) in measures.iter().zip(&tolerances) {
        answer.note_largest(m.ends, m.left.depth, m.gouge.depth, tolerance);
    }
    judge::bores(&wanted, &measures, &mut answer);
    answer.bores = measures;
    faces(job, setups, stock, &operation_of, &mut claims, &mut tolerances, &mut answer);
    let mut compared = EndMap::new(stock, Compared::NOT)?;
    compared.replace_from(&claims, |claim| Compared {
        deviation: claim.deviation,
        tolerance: tolerances.get(claim.of as usize).map_or(f32::NAN, |t| *t as f32),
    });
    drop(claims);
    if let Some(design) = &job.design {
        let from_design = design::ends(design, stock)?;
        compared.merge_from(&from_design, |old, end| old.or(end.compared(design)));
        answer.reach = rest::reach((job, design), setups, stock, &from_design)?;
        let advice = answer.reach.as_ref().map(RestReach::advice);
        for m in design::measures(design, stock, &from_design) {
            answer.note_largest(m.ends, m.left.depth, 0.0, m.rest_limit);
            answer.note_largest(m.ends, 0.0, m.gouge.depth, m.gouge_limit);
            judge::design(&m, !design.regions.is_empty(), advice.as_deref(), &mut answer);
            if m.ends > 0 {
                tolerances.extend([m.gouge_limit, m.rest_limit]);
            }
            answer.regions.push(m);
        }
    }
    let first = tolerances.first().copied().unwrap_or(0.0);
    answer.relative = tolerances.iter().any(|t| *t != first);
    answer.tolerance = if answer.relative { 1.0 } else { first };
    let relative = answer.relative;
    let colour = |&p: &DVec3| {
        let mut worst = Compared::NOT;
        compared.in_cell(stock, p, |c| worst = worst.or(c));
        if relative { worst.ratio() } else { worst.deviation }
    };
    answer.at_vertices = part.vertices.par_iter().map(colour).collect();
    Ok(answer)
}

impl Deviation {
    /// Takes deviations to both sides into the largest one, if any end was compared.
    fn note_largest(&mut self, ends: usize, left: f64, gouge: f64, tolerance: f64) {
        if ends == 0 && left == 0.0 {
            return;
        }
        for deviation in [left, -gouge] {
            let worse =
                self.largest.is_none_or(|l| deviation.abs() * l.tolerance > l.deviation.abs() * tolerance);
            if worse {
                self.largest = Some(Largest { deviation, tolerance });
            }
        }
    }
}

/// The operations that cut along lines as they are given, by their numbers, with the diameters of their cutters [mm].
fn aimless(job: &Job, setups: &[SetupOutcome]) -> Vec<(u32, f64)> {
    let planned = setups.iter().flat_map(|s| &s.planned.operations);
    let diameter = |number: u32| {
        let milling = job.operation(number)?.milling();
        Some((number, CutterData::of(&milling.tool).diameter))
    };
    planned.filter(|p| p.plan.wants_nothing()).filter_map(|p| diameter(p.number)).collect()
}

/// The cuts of the simulation as one wanted wall sees them.
struct Made<'a, F: Fn(CutId) -> Option<u32>> {
    bore: &'a Wanted<'a>,
    wanted: &'a [Wanted<'a>],
    aimless: &'a [(u32, f64)],
    operation_of: &'a F,
    /// Cuts come in runs: the operation of the last one is remembered.
    last: (CutId, bool),
}

impl<F: Fn(CutId) -> Option<u32>> Cuts for Made<'_, F> {
    fn own(&mut self, cut: CutId) -> bool {
        if cut != self.last.0 {
            self.last = (cut, (self.operation_of)(cut) == Some(self.bore.number));
        }
        cut != 0 && self.last.1
    }

    fn elsewhere(&self, cut: CutId, p: DVec3) -> bool {
        // A place that another operation is to cut is no gouge of this one.
        let other = (self.operation_of)(cut).filter(|&number| number != self.bore.number);
        other.is_some_and(|number| self.wanted.iter().any(|w| w.number == number && w.holds(p)))
    }

    fn unwanted(&self, cut: CutId) -> Option<f64> {
        if self.aimless.is_empty() {
            return None;
        }
        let number = (self.operation_of)(cut)?;
        self.aimless.iter().find(|(aimless, _)| *aimless == number).map(|(_, diameter)| *diameter)
    }
}

/// Gives the ends in the region of a bore their claim.
fn claim_ends(bore: &Wanted<'_>, of: u32, stock: &TriDexel, mut cuts: impl Cuts, claims: &mut EndMap<Claim>) {
    let lattice = stock.lattice();
    let region = bore.region();
    let up = bore.to_work.inverse().vector(DVec3::Z);
    for axis in Axis::ALL {
        let (u, v) = axis.others();
        // Along the tool ends count at any depth; across it those beyond the region are not looked at one by one.
        let along = up[axis.index()].abs() > 0.5;
        let [from, to] = match along {
            true => [f64::NEG_INFINITY, f64::INFINITY],
            false => [region.min[axis.index()] - lattice.step, region.max[axis.index()] + lattice.step],
        };
        for b in indices(lattice, v, &region) {
            for a in indices(lattice, u, &region) {
                let mut p = DVec3::ZERO;
                p[u.index()] = lattice.coordinate(u, a);
                p[v.index()] = lattice.coordinate(v, b);
                let line = stock.line(axis, a, b);
                let first = line.partition_point(|i| unfixed(i.hi.at) < from);
                let count = line[first..].partition_point(|i| unfixed(i.lo.at) <= to);
                let ends = (first..first + count)
                    .flat_map(|i| [(line[i].lo, before(line, i)), (line[i].hi, after(line, i))]);
                for ((end, free), kept) in ends.zip(&mut claims.line_mut(axis, a, b)[2 * first..]) {
                    p[axis.index()] = unfixed(end.at);
                    let square = free * end.normal.normal()[axis.index()].abs();
                    if let Some(claim) = bore.claim(of, (p, end, square), &mut cuts) {
                        *kept = kept.or(claim);
                    }
                }
            }
        }
    }
}

/// Length of a line that is empty before an interval [mm].
fn before(line: &[Interval], i: usize) -> f64 {
    if i == 0 { f64::INFINITY } else { unfixed(line[i].lo.at) - unfixed(line[i - 1].hi.at) }
}

/// The same after it.
fn after(line: &[Interval], i: usize) -> f64 {
    line.get(i + 1).map_or(f64::INFINITY, |next| unfixed(next.lo.at) - unfixed(line[i].hi.at))
}

/// Measures of each bore.
fn measures(wanted: &[Wanted<'_>], stock: &TriDexel, claims: &EndMap<Claim>) -> Vec<BoreMeasure> {
    let mut measures: Vec<BoreMeasure> = wanted.iter().map(BoreMeasure::of).collect();
    claims.visit(stock, |p, end, claim| {
        if let Some(m) = measures.get_mut(claim.of as usize).filter(|_| !claim.deviation.is_nan()) {
            m.note(claim, p, end.cut);
        }
    });
    if measures.iter().all(|m| m.ends > 0) {
        return measures;
    }
    let all = wanted.iter().fold(Aabb::EMPTY, |all, w| all.union(w.region()));
    let boxes: Vec<Aabb> = wanted.iter().map(|w| w.cut_within(all)).collect();
    let bins = Bins::of(&boxes);
    for (i, m) in measures.iter_mut().enumerate().filter(|(_, m)| m.ends == 0) {
        let gone = |p: DVec3| {
            // More than the resolution inside of what another one cuts: on a common wall both are measured or none.
            bins.near(p).iter().any(|&j| j as usize != i && wanted[j as usize].inside(p) > claim::EDGE)
        };
        m.replaced = wanted[i].samples().all(gone);
    }
    measures
}

/// The indices of the lattice along an axis that lie in a region.
fn indices(lattice: &Lattice, axis: Axis, region: &Aabb) -> std::ops::Range<u32> {
    lattice.between(axis, [region.min[axis.index()], region.max[axis.index()]])
}

/// Measures the milled faces; their ends get claims, their tolerances are added to those of the bores.
fn faces(
    job: &Job,
    setups: &[SetupOutcome],
    stock: &TriDexel,
    operation_of: &(impl Fn(CutId) -> Option<u32> + Sync),
    claims: &mut EndMap<Claim>,
    tolerances: &mut Vec<f64>,
    answer: &mut Deviation,
) {
    for done in setups {
        for planned in &done.planned.operations {
            let number = planned.number;
            let (Some(plane), Some(operation)) = (planned.plan.plane(), job.operation(number)) else {
                continue;
            };
            let Some(setup) = done.planned.program.setups.first() else { continue };
            let work = setup.work_offsets.values().next().copied().unwrap_or(Rigid::IDENTITY);
            let own = |cut: CutId| operation_of(cut) == Some(number);
            let to_work = work.inverse().after(&setup.part_on_table);
            let of = tolerances.len() as u32;
            let m = measure_face(&plane, number, to_work, stock, own, |axis, a, b, end, above| {
                let claim = Claim { of, side: claim::Side::Floor, deviation: above as f32 };
                let kept = &mut claims.line_mut(axis, a, b)[end];
                *kept = kept.or(claim);
            });
            let tolerance = operation.milling().tolerance;
            tolerances.push(tolerance);
            answer.note_largest(m.ends, m.left.depth, m.gouge.depth, tolerance);
            judge::face(operation, &m, answer);
            answer.faces.push(m);
        }
    }
}
