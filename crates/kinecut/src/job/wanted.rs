//! The cut part against the wanted bores: measured at the ends of the stock's lines, where the stock is exact.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::PlannedHole;
use super::check::{Design, FaceOperation, Job, Operation};
use super::face::{FaceMeasure, measure_face};
use super::file::{BoreStrategy, RoughTable};
use super::outcome::{SetupOutcome, block_of_cut};
use super::simulate::{Simulation, is_along_axis};
use super::wall::Wall;
use crate::base::{Code, Finding, Result};
use crate::geom::{Aabb, Mesh, MeshDistance, Rigid};
use crate::stock::{
    Axis, Bore, CutId, Design as _, DexelGrid, EndPoint, Lattice, deviation_at_vertices, unfixed,
};
use crate::tool::DrillPoint;

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
    /// One for each milled face.
    pub faces: Vec<FaceMeasure>,
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
    /// Wanted radius at the bottom [mm], of a round wall: without the allowance, if the operation does not finish.
    pub wanted_radius: Option<f64>,
    /// Least and greatest distance of the wall found inside of the wanted one [mm]: positive where stock is left.
    pub wall: [f64; 2],
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

impl BoreMeasure {
    /// Least and greatest radius found [mm], of a round wall that was measured; of a conical one as at the bottom.
    pub fn radius(&self) -> Option<[f64; 2]> {
        let wanted = self.wanted_radius.filter(|_| self.wall[0].is_finite())?;
        Some([wanted - self.wall[1], wanted - self.wall[0]])
    }
}

impl Worst {
    pub(super) fn note(&mut self, depth: f64, point: DVec3, cut: CutId) {
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

/// A wanted bore or pocket in the frame of its work offset.
struct Wanted<'a> {
    operation: &'a Operation,
    number: u32,
    /// Maps part coordinates to the work offset.
    to_work: Rigid,
    centre: DVec2,
    wall: Wall,
    top: f64,
    /// Height of the floor; `None` when it goes through.
    floor: Option<f64>,
    /// Lowest height at which the wall is wanted.
    bottom: f64,
    /// Radius of a core that is meant to fall out [mm]: what stands of it is not looked at.
    slug: f64,
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
    let wanted = wanted(job, setups);
    for bore in &wanted {
        answer.tolerance = answer.tolerance.min(bore.operation.milling().tolerance);
        let operation_of = |cut: CutId| {
            let (setup, item) = block_of_cut(setups, simulation, cut)?;
            let planned = setups[setup].planned_item(item)?;
            setups[setup].planned.program.origin(planned as usize).operation
        };
        // What another operation wants to be cut there is no gouge of this one.
        let elsewhere = |cut: CutId, p: DVec3| {
            let other = operation_of(cut).filter(|&number| number != bore.number);
            other.is_some_and(|number| wanted.iter().any(|w| w.number == number && w.holds(p)))
        };
        let measure = measure(bore, &simulation.stock, operation_of, elsewhere);
        judge(bore, &measure, &mut answer);
        answer.bores.push(measure);
    }
    answer.proven = proven(&wanted, &answer.bores);
    faces(job, setups, simulation, &mut answer);
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
    let surfaces =
        wanted.iter().take(MOST_COLOURED).filter_map(|w| Some(w.surface()?.map(|s| (s, w.region()))));
    let surfaces = surfaces.collect::<Result<Vec<_>>>()?;
    answer.at_vertices = at_vertices(&surfaces, distance.as_ref(), part);
    Ok(answer)
}

fn wanted<'a>(job: &'a Job, setups: &[SetupOutcome]) -> Vec<Wanted<'a>> {
    let drillings: Vec<_> = setups.iter().flat_map(|s| &s.planned.drillings).collect();
    let mut list = Vec::new();
    let mut number = 0;
    for setup in &job.setups {
        for operation in &setup.operations {
            let to_work = setup.to_operation(operation);
            if !is_along_axis(to_work.inverse().vector(DVec3::Z)) {
                number += 1;
                continue;
            }
            if let Operation::Drill(_) = operation {
                let holes = drillings.iter().filter(|d| d.operation == number).flat_map(|d| &d.holes);
                list.extend(holes.filter_map(|hole| Wanted::drilled(operation, number, to_work, hole)));
            }
            let wanted = Wanted::of(operation, number, to_work);
            number += 1;
            // What the planner left out is not wanted either.
            let milling = operation.milling();
            let cutter = milling.tool.cutter.diameter(milling.tool.flute_length) / 2.0;
            list.extend(wanted.filter(|w| w.wall.radius(w.bottom) > cutter));
        }
    }
    list
}

impl Wanted<'_> {
    /// The wall of a milling operation.
    fn of(operation: &Operation, number: u32, to_work: Rigid) -> Option<Wanted<'_>> {
        let left = |finished: bool, rough: Option<&RoughTable>| {
            if finished { 0.0 } else { rough.map_or(0.0, |r| r.allowance) }
        };
        match operation {
            Operation::Bore(bore) => {
                let t = &bore.table;
                let finish = t.finish.as_ref();
                // A wear register moves the wall: positive values make the bore smaller.
                let wear = finish.filter(|f| f.wear_offset.is_some()).and_then(|f| f.wear_value);
                let leave = t.leave + left(finish.is_some(), t.rough.as_ref()) + wear.unwrap_or(0.0);
                let radii = [t.diameter, t.bottom_diameter.unwrap_or(t.diameter)].map(|d| d / 2.0 - leave);
                let bottom = t.top - t.depth;
                let through = t.breakthrough > 0.0;
                let allowance = t.rough.as_ref().map_or(0.0, |r| r.allowance);
                let cutter = bore.milling.tool.cutter.diameter(bore.milling.tool.flute_length);
                let outline = t.strategy == BoreStrategy::OutlineHelix;
                Some(Wanted {
                    operation,
                    number,
                    to_work,
                    centre: DVec2::from_array(t.at),
                    wall: Wall::Round { radii, heights: [t.top, bottom] },
                    top: t.top,
                    floor: (!through).then_some(bottom + t.leave_floor),
                    bottom: if through { bottom } else { bottom + t.leave_floor },
                    slug: if outline { t.diameter / 2.0 - t.leave - allowance - cutter } else { 0.0 },
                })
            }
            Operation::Ellipse(pocket) => {
                let t = &pocket.table;
                let bottom = t.top - t.depth;
                let leave = t.leave + left(t.finish.is_some(), Some(&t.rough));
                let through = t.breakthrough > 0.0;
                Some(Wanted {
                    operation,
                    number,
                    to_work,
                    centre: DVec2::from_array(t.at),
                    wall: Wall::Ellipse { half_axes: t.half_axes, turned: t.angle.to_radians(), leave },
                    top: t.top,
                    floor: (!through).then_some(bottom + t.leave_floor),
                    bottom: if through { bottom } else { bottom + t.leave_floor },
                    slug: 0.0,
                })
            }
            Operation::Drill(_) | Operation::Face(_) | Operation::Path(_) => None,
        }
    }

    /// The wall of a drilled hole, where it is whole all round; `None` for recesses, and where it nowhere is.
    fn drilled<'a>(
        operation: &'a Operation,
        number: u32,
        to_work: Rigid,
        hole: &PlannedHole,
    ) -> Option<Wanted<'a>> {
        use crate::drilling::Method;
        if matches!(hole.spec.method, Method::Centring | Method::Countersinking | Method::Counterboring) {
            return None;
        }
        let radius = hole.plan.edge.outer_radius();
        // The corner, where the edge meets the wall, stands this high above the tip.
        let corner = hole.plan.edge.segments().last()?.height(radius);
        let above = hole.zero + corner;
        let top = hole.plan.entry.last + above;
        // In a blind hole a nub may stand higher than the corner.
        let floor = hole.zero + hole.plan.edge.extent()[1];
        let bottom = hole.plan.exit.map_or(hole.plan.travel.end + floor, |e| e.first + above);
        // Where nothing cuts a core stays; a nose runs in a hole that was there, so what stands under it is left.
        let core = match hole.spec.point {
            DrillPoint::Cone { .. } => 0.0,
            point => point.edge(hole.spec.diameter).map_or(0.0, |e| e.inner_radius()),
        };
        (top > bottom + 2.0 * EDGE).then_some(Wanted {
            operation,
            number,
            to_work,
            centre: DVec2::from_array(hole.at),
            wall: Wall::Round { radii: [radius; 2], heights: [top, bottom] },
            top,
            floor: None,
            bottom,
            slug: core,
        })
    }

    /// Whether a point of the stock [part coordinates] lies in what the operation cuts, its tolerance included.
    fn holds(&self, p: DVec3) -> bool {
        let q = self.to_work.point(p);
        let tolerance = self.operation.milling().tolerance;
        // A point of a drill ends below its full diameter.
        let lowest = self.floor.unwrap_or(self.bottom - self.wall.radius(self.top));
        q.z > lowest - tolerance && self.wall.inside(q.truncate() - self.centre, q.z) > -tolerance
    }

    /// The region that can belong to the operation [part coordinates].
    fn region(&self) -> Aabb {
        let size = 2.0 * self.wall.radius(self.top);
        let to_part = self.to_work.inverse();
        let corners = (0..8).map(|i| {
            let sign = |bit: i32| if i & bit == 0 { -size } else { size };
            let z = if i & 4 == 0 { self.bottom } else { self.top };
            let over = if i & 4 == 0 { -size } else { size };
            to_part.point((self.centre + DVec2::new(sign(1), sign(2))).extend(z + over))
        });
        Aabb::of_points(corners)
    }
}

/// Ends this near to rim and floor belong to both faces and are measured on neither [mm].
const EDGE: f64 = 1e-3;

fn measure(
    bore: &Wanted<'_>,
    stock: &impl DexelGrid,
    operation_of: impl Fn(CutId) -> Option<u32>,
    elsewhere: impl Fn(CutId, DVec3) -> bool,
) -> BoreMeasure {
    let mut m = BoreMeasure {
        operation: bore.number,
        wanted_radius: matches!(bore.wall, Wall::Round { .. }).then(|| bore.wall.radius(bore.bottom)),
        wall: [f64::INFINITY, f64::NEG_INFINITY],
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
    let region = bore.region();
    for axis in Axis::ALL {
        let (u, v) = axis.others();
        for b in indices(lattice, v, &region) {
            for a in indices(lattice, u, &region) {
                for interval in stock.line(axis, a, b) {
                    for end in [interval.lo, interval.hi] {
                        let mut p = DVec3::ZERO;
                        p[axis.index()] = unfixed(end.at);
                        p[u.index()] = lattice.coordinate(u, a);
                        p[v.index()] = lattice.coordinate(v, b);
                        note(bore, &mut m, p, end, (&mut own, &elsewhere));
                    }
                }
            }
        }
    }
    m
}

/// The indices of the lattice along an axis that lie in a region.
fn indices(lattice: &Lattice, axis: Axis, region: &Aabb) -> std::ops::Range<u32> {
    let (at, count) = (axis.index(), lattice.counts[axis.index()]);
    // Casts keep in range by themselves.
    let index = |x: f64| (x - lattice.origin[at]) / lattice.step;
    let from = index(region.min[at]).floor() as u32;
    let to = (index(region.max[at]).ceil() as u32).saturating_add(1).min(count);
    from.min(to)..to
}

fn note(
    bore: &Wanted<'_>,
    m: &mut BoreMeasure,
    p: DVec3,
    end: EndPoint,
    (own, elsewhere): (&mut impl FnMut(CutId) -> bool, &impl Fn(CutId, DVec3) -> bool),
) {
    let q = bore.to_work.point(p);
    let off = q.truncate() - bore.centre;
    let radial = off.length();
    // Nothing beyond twice the size can belong to the bore.
    let size = bore.wall.radius(bore.top);
    if radial > 2.0 * size || q.z > bore.top + size {
        return;
    }
    if bore.slug > 0.0 && radial < bore.slug + EDGE {
        return;
    }
    let normal = bore.to_work.vector(end.normal.normal());
    let depth = bore.wall.inside(off, q.z);
    let inside = depth > 0.0;
    let over_floor = bore.floor.is_some_and(|z| bore.wall.inside(off, z) > -EDGE);
    if let (Some(floor), Some(range)) = (bore.floor, &mut m.floor)
        && normal.z > FACES_UP
        && q.z < bore.top - EDGE
        && over_floor
        && (inside || own(end.cut))
    {
        let above = q.z - floor;
        if above < -EDGE && elsewhere(end.cut, p) {
            return;
        }
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
            m.left.note(depth, p, end.cut);
        }
        return;
    }
    if inside || own(end.cut) && normal.truncate().dot(off) < 0.0 {
        m.wall = [m.wall[0].min(depth), m.wall[1].max(depth)];
        m.ends += 1;
        m.left.note(depth, p, end.cut);
        m.gouge.note(-depth, p, end.cut);
    }
}

/// Cosine above which a face counts as floor or ceiling, not as wall.
const FACES_UP: f64 = 0.7;

fn judge(bore: &Wanted<'_>, m: &BoreMeasure, answer: &mut Deviation) {
    let tolerance = bore.operation.milling().tolerance;
    let name = bore.operation.name();
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
}

/// What was proven of the walls of each operation, all its holes together; of one with a wall out of tolerance, nothing.
fn proven(wanted: &[Wanted<'_>], measures: &[BoreMeasure]) -> Vec<String> {
    let mut claims = Vec::new();
    let pairs: Vec<_> = wanted.iter().zip(measures).collect();
    for group in pairs.chunk_by(|a, b| a.0.number == b.0.number) {
        let operation = group[0].0.operation;
        let deviation = |m: &BoreMeasure| m.gouge.depth.max(m.left.depth);
        let worst = group.iter().map(|(_, m)| deviation(m)).fold(0.0, f64::max);
        let ends: usize = group.iter().map(|(_, m)| m.ends).sum();
        if worst <= operation.milling().tolerance && ends > 0 {
            claims.push(format!(
                "{}: wall and floor lie within {:.1} \u{b5}m of the wanted surface at {ends} line ends",
                operation.name(),
                worst * 1e3
            ));
        }
    }
    claims
}

/// Measures the milled faces.
fn faces(job: &Job, setups: &[SetupOutcome], simulation: &Simulation, answer: &mut Deviation) {
    for done in setups {
        for face in &done.planned.faces {
            let mut all = job.setups.iter().flat_map(|s| &s.operations);
            let Some(Operation::Face(operation)) = all.nth(face.operation as usize) else { continue };
            let Some(setup) = done.planned.program.setups.first() else { continue };
            let work = setup.work_offsets.values().next().copied().unwrap_or(Rigid::IDENTITY);
            let own = |cut: CutId| {
                let planned = block_of_cut(setups, simulation, cut)
                    .and_then(|(s, item)| Some((s, setups[s].planned_item(item)?)));
                planned.is_some_and(|(s, p)| {
                    setups[s].planned.program.origin(p as usize).operation == Some(face.operation)
                })
            };
            let to_work = work.inverse().after(&setup.part_on_table);
            let m = measure_face(operation, face, to_work, &simulation.stock, own);
            answer.tolerance = answer.tolerance.min(operation.milling.tolerance);
            judge_face_height(operation, &m, answer);
            answer.faces.push(m);
        }
    }
}

fn judge_face_height(operation: &FaceOperation, m: &FaceMeasure, answer: &mut Deviation) {
    let tolerance = operation.milling.tolerance;
    let sides = [
        (Code::WALL_GOUGED, "the face is cut too deep", &m.gouge, "correct `top`"),
        (
            Code::STOCK_LEFT,
            "stock is left on the face",
            &m.left,
            "correct the outline, or mill in more passes",
        ),
    ];
    for (code, what, worst, cure) in sides {
        if worst.depth > tolerance {
            let f = Finding::error(code, format!("{}: {what}", operation.name()))
                .value_mm((worst.depth * 1e5).round() / 1e5)
                .bound_mm(tolerance)
                .point(worst.point.to_array())
                .cure(cure);
            answer.findings.push((f, worst.cut));
        }
    }
    let worst = m.gouge.depth.max(m.left.depth);
    if worst <= tolerance && m.ends > 0 {
        answer.proven.push(format!(
            "{}: the face lies within {:.1} \u{b5}m of its plane at {} line ends",
            operation.name(),
            worst * 1e3,
            m.ends
        ));
    }
}

/// Faces farther from a bore than this are other faces, not gouges of its own [mm].
const REACH: f64 = 0.5;

impl Wanted<'_> {
    /// A cylindrical bore as a wanted surface, in part coordinates.
    fn surface(&self) -> Option<Result<Bore>> {
        if !self.wall.is_cylinder() {
            return None;
        }
        let to_part = self.to_work.inverse();
        // The mouths of a drilled hole lie in surfaces that fall away from the rim: they are faces of their own.
        let mouth = if matches!(self.operation, Operation::Drill(_)) { 2.0 * REACH } else { 0.0 };
        let top = self.top - mouth;
        let bottom = self.floor.unwrap_or(self.bottom + mouth);
        if top <= bottom {
            return None;
        }
        let rim = to_part.point(self.centre.extend(top));
        let depth = top - bottom;
        let radius = self.wall.radius(self.bottom);
        Some(Bore::new(rim, to_part.vector(DVec3::Z), radius, depth, self.floor.is_some(), REACH))
    }
}

/// Most walls whose deviation is shown in colour; every one is measured.
const MOST_COLOURED: usize = 2000;

/// Deviation shown at the vertices: of the design, where there is one, else of the bore a vertex belongs to.
fn at_vertices(surfaces: &[(Bore, Aabb)], design: Option<&MeshDistance>, part: &Mesh) -> Vec<f32> {
    if let Some(design) = design {
        return deviation_at_vertices(part, design);
    }
    let within = |b: &Aabb, p: DVec3| p.cmpge(b.min).all() && p.cmple(b.max).all();
    let one = |&p: &DVec3| {
        let near = surfaces.iter().filter(|(_, region)| within(region, p));
        near.map(|(s, _)| s.signed_distance(p) as f32).find(|d| !d.is_nan()).unwrap_or(f32::NAN)
    };
    part.vertices.par_iter().map(one).collect()
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
