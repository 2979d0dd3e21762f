//! The cut part against the wanted bores: measured at the ends of the stock's lines, where the stock is exact.

use glam::{DVec2, DVec3};

use super::check::{BoreOperation, Design, Job, Operation};
use super::outcome::{SetupOutcome, block_of_cut};
use super::simulate::Simulation;
use crate::base::{Code, Finding, Result};
use crate::geom::{Mesh, MeshDistance, Rigid};
use crate::stock::{Axis, Bore, CutId, DexelGrid, EndPoint, deviation_at_vertices, unfixed};

/// The cut part against the wanted one.
#[derive(Clone, Debug, Default)]
pub struct Deviation {
    /// Deviation at each vertex of the part's mesh [mm]: positive where stock is left, negative where the wanted
    /// surface is gouged, NaN where nothing is wanted.
    pub at_vertices: Vec<f32>,
    /// The tightest tolerance of the operations [mm].
    pub tolerance: f64,
    /// One for each bore, in the order of the operations.
    pub bores: Vec<BoreMeasure>,
    /// Findings, each with the cut that made it.
    pub findings: Vec<(Finding, CutId)>,
    /// What was proven.
    pub proven: Vec<String>,
}

/// What was measured of one bore.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoreMeasure {
    /// Number of the operation over all setups.
    pub operation: u32,
    /// Wanted radius [mm]: with the allowance, if the operation does not finish.
    pub wanted_radius: f64,
    /// Least and greatest radius found [mm].
    pub radius: [f64; 2],
    /// Least and greatest height of the floor above the wanted one [mm]; `None` for a bore that goes through.
    pub floor: Option<[f64; 2]>,
    /// Number of line ends measured.
    pub ends: usize,
    /// Worst stock left [mm], where, and by which cut.
    pub left: Worst,
    /// Worst gouge [mm], where, and by which cut.
    pub gouge: Worst,
}

/// The worst of many deviations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// Deviation [mm], not negative.
    pub depth: f64,
    /// Where [part coordinates].
    pub point: DVec3,
    /// The cut.
    pub cut: CutId,
}

impl Worst {
    fn note(&mut self, depth: f64, point: DVec3, cut: CutId) {
        if depth > self.depth {
            *self = Worst { depth, point, cut };
        }
    }
}

impl Deviation {
    /// The largest deviation of all bores [mm], with its sign: positive stock left, negative gouged.
    pub fn largest(&self) -> f64 {
        let each = self.bores.iter().flat_map(|b| [b.left.depth, -b.gouge.depth]);
        each.fold(0.0, |a, d| if d.abs() > f64::abs(a) { d } else { a })
    }
}

/// A wanted bore in the frame of its work offset.
struct Wanted<'a> {
    operation: &'a BoreOperation,
    number: u32,
    /// Maps part coordinates to the work offset.
    to_work: Rigid,
    centre: DVec2,
    radius: f64,
    top: f64,
    /// Height of the floor; `None` when the bore goes through.
    floor: Option<f64>,
    /// Lowest height at which the wall is wanted.
    bottom: f64,
}

/// Compares the cut stock, and the vertices of its surface, with the bores that the job wants and with its design.
///
/// # Errors
/// `KC0602` when the design mesh does not close.
pub fn deviation(
    job: &Job,
    setups: &[SetupOutcome],
    simulation: &Simulation,
    part: &Mesh,
) -> Result<Deviation> {
    let mut answer = Deviation { tolerance: f64::INFINITY, ..Deviation::default() };
    let wanted = wanted(job);
    for bore in &wanted {
        answer.tolerance = answer.tolerance.min(bore.operation.tolerance);
        let operation_of = |cut: CutId| {
            let (setup, item) = block_of_cut(setups, simulation, cut)?;
            let planned = setups[setup].planned_item(item)?;
            setups[setup].planned.program.origin(planned as usize).operation
        };
        let measure = measure(bore, &simulation.stock, operation_of);
        judge(bore, &measure, &mut answer);
        answer.bores.push(measure);
    }
    let distance = match &job.design {
        None => None,
        Some(design) => {
            let distance = MeshDistance::new(&design.mesh)?;
            answer.tolerance = answer.tolerance.min(design.tolerance);
            judge_design(design, &distance, &simulation.stock, &mut answer);
            Some(distance)
        }
    };
    if answer.tolerance.is_infinite() {
        answer.tolerance = 0.0;
    }
    let surfaces = wanted.iter().map(Wanted::surface).collect::<Result<Vec<_>>>()?;
    answer.at_vertices = at_vertices(&surfaces, distance.as_ref(), part);
    Ok(answer)
}

fn wanted(job: &Job) -> Vec<Wanted<'_>> {
    let mut list = Vec::new();
    let mut number = 0;
    for setup in &job.setups {
        let work = setup.setup.work_offsets.get(&setup.offset).copied().unwrap_or(Rigid::IDENTITY);
        let to_work = work.inverse().after(&setup.setup.part_on_table);
        for operation in &setup.operations {
            let Operation::Bore(bore) = operation;
            let t = &bore.table;
            let allowance =
                if t.finish.is_some() { 0.0 } else { t.rough.as_ref().map_or(0.0, |r| r.allowance) };
            let through = t.breakthrough > 0.0;
            list.push(Wanted {
                operation: bore,
                number,
                to_work,
                centre: DVec2::from_array(t.at),
                radius: t.diameter / 2.0 - allowance,
                top: t.top,
                floor: (!through).then_some(t.top - t.depth),
                bottom: t.top - t.depth,
            });
            number += 1;
        }
    }
    list
}

/// Ends this near to rim and floor belong to both faces and are measured on neither [mm].
const EDGE: f64 = 1e-3;

fn measure(
    bore: &Wanted<'_>,
    stock: &impl DexelGrid,
    operation_of: impl Fn(CutId) -> Option<u32>,
) -> BoreMeasure {
    let mut m = BoreMeasure {
        operation: bore.number,
        wanted_radius: bore.radius,
        radius: [f64::INFINITY, f64::NEG_INFINITY],
        floor: bore.floor.map(|_| [f64::INFINITY, f64::NEG_INFINITY]),
        ends: 0,
        left: Worst::default(),
        gouge: Worst::default(),
    };
    // Cuts come in runs: the operation of the last one is remembered.
    let mut last: (CutId, bool) = (0, false);
    let mut own = |cut: CutId| {
        if cut != last.0 {
            last = (cut, operation_of(cut) == Some(bore.number));
        }
        cut != 0 && last.1
    };
    let lattice = stock.lattice();
    for axis in Axis::ALL {
        let (u, v) = axis.others();
        for b in 0..lattice.counts[v.index()] {
            for a in 0..lattice.counts[u.index()] {
                for interval in stock.line(axis, a, b) {
                    for end in [interval.lo, interval.hi] {
                        let mut p = DVec3::ZERO;
                        p[axis.index()] = unfixed(end.at);
                        p[u.index()] = lattice.coordinate(u, a);
                        p[v.index()] = lattice.coordinate(v, b);
                        note(bore, &mut m, p, end, &mut own);
                    }
                }
            }
        }
    }
    m
}

fn note(
    bore: &Wanted<'_>,
    m: &mut BoreMeasure,
    p: DVec3,
    end: EndPoint,
    own: &mut impl FnMut(CutId) -> bool,
) {
    let q = bore.to_work.point(p);
    let off = q.truncate() - bore.centre;
    let radial = off.length();
    // Nothing beyond twice the radius can belong to the bore.
    if radial > 2.0 * bore.radius || q.z > bore.top + bore.radius {
        return;
    }
    let normal = bore.to_work.vector(end.normal.normal());
    let inside = radial < bore.radius;
    if let (Some(floor), Some(range)) = (bore.floor, &mut m.floor)
        && normal.z > FACES_UP
        && q.z < bore.top - EDGE
        && (inside || own(end.cut) && radial < bore.radius + EDGE)
    {
        let above = q.z - floor;
        *range = [range[0].min(above), range[1].max(above)];
        m.ends += 1;
        m.left.note(above, p, end.cut);
        m.gouge.note(-above, p, end.cut);
        return;
    }
    let between = q.z < bore.top - EDGE && q.z > bore.bottom + EDGE;
    if !between || normal.z.abs() > FACES_UP {
        // Material above the floor inside the bore is stock left, whatever its face looks like.
        if between && inside {
            m.left.note(bore.radius - radial, p, end.cut);
        }
        return;
    }
    if inside || own(end.cut) && normal.truncate().dot(off) < 0.0 {
        m.radius = [m.radius[0].min(radial), m.radius[1].max(radial)];
        m.ends += 1;
        m.left.note(bore.radius - radial, p, end.cut);
        m.gouge.note(radial - bore.radius, p, end.cut);
    }
}

/// Cosine above which a face counts as floor or ceiling, not as wall.
const FACES_UP: f64 = 0.7;

fn judge(bore: &Wanted<'_>, m: &BoreMeasure, answer: &mut Deviation) {
    let tolerance = bore.operation.tolerance;
    let name = format!("bore {} at X{} Y{}", bore.operation.table.diameter, bore.centre.x, bore.centre.y);
    let mut finding = |code: Code, what: &str, worst: &Worst, cure: &str| {
        let f = Finding::error(code, format!("{name}: {what}"))
            .value_mm((worst.depth * 1e5).round() / 1e5)
            .bound_mm(tolerance)
            .point(worst.point.to_array())
            .cure(cure);
        answer.findings.push((f, worst.cut));
    };
    if m.gouge.depth > tolerance {
        finding(
            Code::WALL_GOUGED,
            "the wanted surface is gouged",
            &m.gouge,
            "correct diameter, depth or tool",
        );
    }
    if m.left.depth > tolerance {
        finding(Code::STOCK_LEFT, "stock is left", &m.left, "finish the wall, go deeper, or allow more");
    }
    if m.gouge.depth <= tolerance && m.left.depth <= tolerance && m.ends > 0 {
        answer.proven.push(format!(
            "{name}: wall and floor lie within {:.1} \u{b5}m of the wanted surface at {} line ends",
            m.gouge.depth.max(m.left.depth) * 1e3,
            m.ends
        ));
    }
}

/// Faces farther from a bore than this are other faces, not gouges of its own [mm].
const REACH: f64 = 0.5;

impl Wanted<'_> {
    /// The bore as a wanted surface, in part coordinates.
    fn surface(&self) -> Result<Bore> {
        let to_part = self.to_work.inverse();
        let rim = to_part.point(self.centre.extend(self.top));
        let depth = self.top - self.bottom;
        Bore::new(rim, to_part.vector(DVec3::Z), self.radius, depth, self.floor.is_some(), REACH)
    }
}

/// Deviation shown at the vertices: of the design, where there is one, else of the bore a vertex belongs to.
fn at_vertices(surfaces: &[Bore], design: Option<&MeshDistance>, part: &Mesh) -> Vec<f32> {
    if let Some(design) = design {
        return deviation_at_vertices(part, design);
    }
    let mut all = vec![f32::NAN; part.vertices.len()];
    for surface in surfaces {
        for (at, d) in all.iter_mut().zip(deviation_at_vertices(part, surface)) {
            if at.is_nan() {
                *at = d;
            }
        }
    }
    all
}

/// The whole part against the design mesh.
fn judge_design(design: &Design, distance: &MeshDistance, stock: &impl DexelGrid, answer: &mut Deviation) {
    let summary = crate::stock::deviation(stock, distance, None);
    let sides = [
        (Code::WALL_GOUGED, "the part is cut into the design", summary.gouge),
        (Code::STOCK_LEFT, "stock is left on the design", summary.left),
    ];
    for (code, what, worst) in sides {
        if worst.depth > design.tolerance {
            let f = Finding::error(code, what)
                .value_mm((worst.depth * 1e5).round() / 1e5)
                .bound_mm(design.tolerance)
                .point(worst.point.to_array())
                .cure("add the operations that are missing, or correct those that cut too deep");
            answer.findings.push((f, worst.cut));
        }
    }
    if summary.gouge.depth <= design.tolerance && summary.left.depth <= design.tolerance {
        answer.proven.push(format!(
            "the part lies within {:.1} \u{b5}m of the design mesh at {} line ends",
            summary.gouge.depth.max(summary.left.depth) * 1e3,
            summary.ends
        ));
    }
}
