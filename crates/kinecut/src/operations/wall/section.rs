//! The section of a milled bore: measured size, plan view, curvature and engagement along the path, joints, records.

use glam::DVec2;

use super::paper;
use crate::geom::{Curve, CurveKind, InvoluteRecord, PlaneCurve, joint};
use crate::holes::engagement::{EngagementSample, engagement, engagement_formula};
use crate::holes::{BorePlan, Entry, EntryMethod};
use crate::operations::measured::BoreMeasure;
use crate::operations::{Milling, PostedPlan, Shown};
use crate::page::{
    Block, Cell, Chart, Fact, Follows, Row, Section, Table, duration, fixed, length, micrometres,
};
use crate::program::Role;
use crate::trace::{Segment, SegmentPace};

/// Places along the path at which the load is shown.
const SAMPLES: usize = 1200;

/// A milled wall as its section shows it.
pub(crate) struct ShownWall<'a> {
    /// Tool, speed, coolant, tolerance.
    pub(crate) milling: &'a Milling,
    /// Centre in the plane of the work offset [mm].
    pub(crate) at: [f64; 2],
    /// The plan of a bore.
    pub(crate) plan: Option<&'a BorePlan>,
    /// The way down that the job wants.
    pub(crate) entry: Option<Entry>,
    /// Step between turns that run parallel about the centre [mm].
    pub(crate) step: Option<f64>,
    /// Radius that roughing leaves of a round wall [mm].
    pub(crate) roughed: Option<f64>,
    /// Whether the wall is a cylinder.
    pub(crate) is_round: bool,
}

/// The sections of walls, and the corrected tables of the paper after them.
pub(crate) fn sections(mut sections: Vec<Section>) -> Vec<Section> {
    // The paper's own inputs are right by construction; a failure would be a defect of the planner.
    if !sections.is_empty() {
        sections.extend(paper::section().ok());
    }
    sections
}

impl ShownWall<'_> {
    /// The section.
    pub(crate) fn section(&self, of: &Shown<'_>) -> Section {
        let milling = self.milling;
        let radius = milling.tool.cutter.diameter(milling.tool.flute_length) / 2.0;
        let mut section = Section::new(of.title());
        let cuts = Cuts::of(&of.posted, of.number, of.first_line);
        section.blocks.push(Block::Facts(facts(milling, &cuts, of.walls.first().copied())));
        if let Some(table) = self.plan.and_then(entries) {
            section.blocks.push(table.into());
        }
        let centre = DVec2::from_array(self.at);
        for pass in cuts.passes() {
            let records: Vec<PlaneCurve> =
                pass.curves.iter().filter_map(|c| plane_curve(c, centre)).collect();
            if records.len() != pass.curves.len() || !self.is_measured(pass.role) {
                continue;
            }
            let hole = self.hole(pass.role, radius);
            let Ok(samples) = engagement(&records, radius, hole, SAMPLES) else { continue };
            // The closed formula knows parallel turns about the centre only.
            let step = self.step.filter(|_| pass.role == Role::Rough);
            section.blocks.extend(charts(&pass, &samples, radius, step));
        }
        section.blocks.push(joints(&cuts).into());
        section.blocks.push(records_table(&cuts, centre).into());
        section
    }

    /// Radius that is already open when a pass begins: the drilled hole, or for finishing the roughed bore.
    fn hole(&self, role: Role, cutter_radius: f64) -> Option<f64> {
        let helix = self.plan.filter(|p| p.ways.iter().any(|w| w.chosen && w.way == EntryMethod::Helix));
        match (role, self.roughed, self.entry, helix.and_then(|p| p.rough.as_ref())) {
            (Role::Finish, Some(radius), ..) => Some(radius),
            (_, _, Some(Entry::PreDrilled { diameter }), _) => Some(diameter / 2.0),
            // The full turn at the foot of a helix opens a circle before the spiral starts.
            (_, _, Some(Entry::Helix { radius, .. }), _) => Some(radius + cutter_radius),
            (_, _, None, Some(rough)) => Some(rough.inner_radius + cutter_radius),
            _ => None,
        }
    }

    /// Whether the cutter's engagement can be measured in a pass: what roughing left of an ellipse or a cone is no circle.
    fn is_measured(&self, role: Role) -> bool {
        role != Role::Finish || self.is_round
    }
}

/// The entry table: which ways down this cutter may take, what each leaves, and which is taken.
fn entries(plan: &BorePlan) -> Option<Table> {
    if plan.ways.is_empty() {
        return None;
    }
    let mut table = Table::new("Ways down, the best first", "Way; Possible; Core left [mm]; Why");
    for row in &plan.ways {
        let possible = match (row.chosen, row.possible) {
            (true, _) => "taken",
            (_, true) => "yes",
            _ => "no",
        };
        table.rows.push(Row::new(vec![
            Cell::new(row.way.title().to_owned()),
            Cell::new(possible.to_owned()),
            Cell::new(fixed(row.core, 3)),
            Cell::new(row.reason.clone()),
        ]));
    }
    Some(table)
}

/// The cutting moves of one operation, as planned: exact curves, each with its line in the program.
struct Cuts {
    moves: Vec<Cut>,
}

struct Cut {
    curve: Curve,
    role: Role,
    /// Line of the program, from 0.
    line: Option<u32>,
    /// Length of the program's path before it [mm].
    before: f64,
    time: f64,
    follows_last: bool,
}

/// Consecutive moves of one role family at one height.
struct Pass {
    role: Role,
    height: f64,
    curves: Vec<Curve>,
    before: f64,
}

impl Cuts {
    fn of(posted: &PostedPlan<'_>, number: u32, first_line: u32) -> Cuts {
        let mut moves: Vec<Cut> = Vec::new();
        let mut before = 0.0;
        let mut last_index = usize::MAX;
        let planned: Vec<&Segment> = posted.plan_trace.segments.iter().filter(|s| !s.alternative).collect();
        for (index, segment) in planned.iter().enumerate() {
            let origin = posted.planned.origin(segment.item as usize);
            let cutting = segment.motion != SegmentPace::Rapid && origin.operation == Some(number);
            if cutting {
                let line = posted.line_of_planned(segment.item);
                moves.push(Cut {
                    curve: segment.curve.clone(),
                    role: origin.role,
                    line: line.map(|l| l + first_line),
                    before,
                    time: segment.duration.unwrap_or(0.0),
                    follows_last: last_index.checked_add(1) == Some(index),
                });
                last_index = index;
            }
            before += segment.curve.length();
        }
        Cuts { moves }
    }

    /// The first roughing pass and the first finishing pass that lie in one plane: deeper levels repeat them.
    fn passes(&self) -> Vec<Pass> {
        let mut passes: Vec<Pass> = Vec::new();
        let mut run: Option<Pass> = None;
        for cut in &self.moves {
            let flat = (cut.curve.start().z - cut.curve.end().z).abs() < 1e-9;
            let family = if cut.role == Role::Finish { Role::Finish } else { Role::Rough };
            if !flat || cut.role == Role::Link {
                passes.extend(run.take());
                continue;
            }
            match &mut run {
                Some(pass) if cut.follows_last && (pass.height - cut.curve.start().z).abs() < 1e-9 => {
                    if cut.role == Role::Finish {
                        pass.role = Role::Finish;
                    }
                    pass.curves.push(cut.curve.clone());
                }
                _ => {
                    passes.extend(run.take());
                    let (height, curves) = (cut.curve.start().z, vec![cut.curve.clone()]);
                    run = Some(Pass { role: family, height, curves, before: cut.before });
                }
            }
        }
        passes.extend(run);
        let mut first = Vec::new();
        for role in [Role::Rough, Role::Finish] {
            if let Some(at) = passes.iter().position(|p| p.role == role) {
                first.push(passes.swap_remove(at));
            }
        }
        first
    }
}

/// A planar curve as a record about the bore's centre.
fn plane_curve(curve: &Curve, centre: DVec2) -> Option<PlaneCurve> {
    match curve.kind() {
        CurveKind::Spiral { spiral, frame, .. } => {
            Some(spiral.shifted(frame.point(glam::DVec3::ZERO).truncate() - centre).into())
        }
        _ => record(curve, centre).map(PlaneCurve::from),
    }
}

/// A line, arc or involute as a record about the bore's centre.
fn record(curve: &Curve, centre: DVec2) -> Option<InvoluteRecord> {
    let start = curve.at(0.0);
    let angle = start.d1.y.atan2(start.d1.x);
    let at = (start.p.truncate() - centre).to_array();
    match curve.kind() {
        CurveKind::Line(line) => {
            InvoluteRecord::new(line.length(), at, angle, f64::INFINITY, f64::INFINITY).ok()
        }
        CurveKind::Arc(arc) => {
            let turn = arc.sweep * arc.axis.z;
            let radius = arc.radius() * turn.signum();
            InvoluteRecord::new(arc.length(), at, angle, radius, radius).ok()
        }
        CurveKind::Involute { record, frame, .. } => {
            Some(record.shifted(frame.point(glam::DVec3::ZERO).truncate() - centre))
        }
        CurveKind::Spiral { .. } | CurveKind::Bezier { .. } => None,
    }
}

fn facts(milling: &Milling, cuts: &Cuts, measure: Option<&BoreMeasure>) -> Vec<Fact> {
    let mut facts = Vec::new();
    if let Some(m) = measure.filter(|m| m.ends > 0) {
        if let (Some(radius), Some(wanted)) = (m.radius(), m.wanted_radius) {
            let text = format!("{} \u{2026} {} mm", fixed(2.0 * radius[0], 4), fixed(2.0 * radius[1], 4));
            let note = format!(
                "wanted {} \u{b1} {} mm, {} line ends",
                2.0 * wanted,
                2.0 * milling.tolerance,
                m.ends
            );
            facts.push(Fact::new("Diameter measured", text).note(note));
        } else if m.wall[0].is_finite() {
            let text = format!("{} \u{2026} {}", micrometres(m.wall[0]), micrometres(m.wall[1]));
            let note = format!("tolerance {} mm, {} line ends", milling.tolerance, m.ends);
            facts.push(Fact::new("Wall inside wanted", text).note(note));
        }
        if let Some(floor) = m.floor.filter(|f| f[0].is_finite()) {
            let text = format!("{} \u{2026} {}", micrometres(floor[0]), micrometres(floor[1]));
            facts.push(Fact::new("Floor above wanted", text));
        }
    }
    for (role, label) in
        [(Role::Rough, "Roughing"), (Role::Finish, "Finishing"), (Role::Lead, "Leads and entry")]
    {
        let (path, time) = cuts
            .moves
            .iter()
            .filter(|c| c.role == role)
            .fold((0.0, 0.0), |(l, t), c| (l + c.curve.length(), t + c.time));
        if path > 0.0 {
            facts.push(Fact::new(label, duration(time)).note(length(path)));
        }
    }
    facts
}

fn charts(pass: &Pass, samples: &[EngagementSample], cutter_radius: f64, step: Option<f64>) -> Vec<Block> {
    let name = if pass.role == Role::Finish { "Finishing" } else { "Roughing, first level" };
    let joints: Vec<f64> = pass
        .curves
        .iter()
        .scan(0.0, |s, c| {
            *s += c.length();
            Some(*s)
        })
        .collect();
    let marked = |mut chart: Chart| {
        if joints.len() <= 8 {
            for s in &joints[..joints.len() - 1] {
                chart = chart.mark(*s, "");
            }
        }
        chart.follows(Follows::Length, pass.before)
    };
    let x = ("path", "mm");
    let curvature = samples.iter().map(|e| [e.s, e.curvature.abs()]).filter(|p| p[1].is_finite()).collect();
    let load = samples.iter().map(|e| [e.s, e.angle.to_degrees()]).collect();
    let mut engaged = Chart::new(&format!("{name}: engagement"), x, ("angle", "\u{b0}"))
        .series("measured on the path", load);
    if let Some(step) = step {
        let formula = samples
            .iter()
            .filter_map(|e| {
                let at = 1.0 / e.curvature.abs();
                // The formula is for a wall parallel at one step: from the second turn on.
                (at > 2.0 * step).then(|| [e.s, engagement_formula(at, cutter_radius, step).to_degrees()])
            })
            .collect();
        engaged = engaged.series("formula, parallel turns", formula);
    }
    let curved =
        Chart::new(&format!("{name}: curvature"), x, ("curvature", "1/mm")).series("curvature", curvature);
    vec![marked(curved).into(), marked(engaged).into()]
}

fn joints(cuts: &Cuts) -> Table {
    let columns = "Joint; Contact; Break of direction [\u{b0}]; Step of curvature [1/mm]; Step of its slope [1/mm\u{b2}]";
    let mut table = Table::new("Joints of the path", columns)
        .note("G1: same direction; G2: same curvature, so no step of acceleration; G3 and above: no step of jerk either.")
        .note("Measured on the exact curves of the plan.");
    for pair in cuts.moves.windows(2) {
        let [a, b] = pair else { continue };
        if !b.follows_last {
            continue;
        }
        let j = joint(&a.curve, &b.curve);
        let contact = j.contact.name();
        let number = |v: f64| if v.is_finite() { format!("{v:.3e}") } else { "\u{221e}".to_owned() };
        let mut row = Row::new(vec![
            Cell::new(format!("{} \u{2192} {}", word(a), word(b))),
            Cell::new(contact),
            Cell::new(number(j.angle.to_degrees())),
            Cell::new(number(j.curvature)),
            Cell::new(number(j.slope)),
        ]);
        row.block = b.line;
        table.rows.push(row);
    }
    table
}

fn word(cut: &Cut) -> String {
    let shape = match cut.curve.kind() {
        CurveKind::Line(_) => "line",
        CurveKind::Arc(arc) if arc.rise != 0.0 => "helix",
        CurveKind::Arc(arc) if arc.sweep.abs() > std::f64::consts::TAU - 1e-6 => "circle",
        CurveKind::Arc(_) => "arc",
        CurveKind::Involute { record, .. } if record.base_radius() == 0.0 => "circle",
        CurveKind::Involute { .. } => "involute",
        CurveKind::Spiral { .. } => "spiral",
        CurveKind::Bezier { .. } => "cubic",
    };
    let role = match cut.role {
        Role::Lead => "lead",
        Role::Rough => "rough",
        Role::Finish => "finish",
        Role::Link => "link",
    };
    format!("{role} {shape}")
}

fn records_table(cuts: &Cuts, centre: DVec2) -> Table {
    let mut table = Table::new(
        "The path in records: length, start from the bore\u{2019}s centre, tangent angle, radii of curvature",
        "Path; Z [mm]; L [mm]; x\u{2080} [mm]; y\u{2080} [mm]; \u{3b8}\u{2080} [rad]; \
             R\u{2099} [mm]; R\u{2096} [mm]",
    );
    for cut in &cuts.moves {
        let flat = (cut.curve.start().z - cut.curve.end().z).abs() < 1e-9;
        let Some(record) = record(&cut.curve, centre).filter(|r| flat && !r.is_line()) else { continue };
        let mut cells = vec![Cell::new(word(cut)), Cell::new(fixed(cut.curve.start().z, 3))];
        cells.extend(paper::six(&record).map(|v| Cell::new(fixed(if v.abs() < 5e-13 { 0.0 } else { v }, 6))));
        let mut row = Row::new(cells);
        row.block = cut.line;
        table.rows.push(row);
    }
    table
}
