//! Planned breaks of edges as the report shows them: facts, burrs, and a plan view.

use super::PlannedEdge;
use super::show;
use crate::contouring::EdgeBreak;
use crate::geom::OutlineEdge;
use crate::operations::Shown;
use crate::operations::measured::BoreMeasure;
use crate::page::{
    Block, Circle, Colour, Dash, Fact, Ink, Plan, PlanLine, Section, Width, fixed, micrometres, trimmed,
};

/// A deviation that is shown as none [mm].
const SMALL: f64 = 1e-4;
/// Arcs are drawn as chords of this angle [rad].
const CHORD: f64 = 0.05;

/// The section of an operation.
pub(crate) fn section(plan: &PlannedEdge, of: &Shown<'_>) -> Section {
    let mut section = Section::new(of.title());
    section.blocks.push(Block::Facts(facts(plan, &of.walls)));
    section.blocks.extend(show::blocks(plan));
    section.with(view(plan))
}

fn facts(plan: &PlannedEdge, walls: &[&BoreMeasure]) -> Vec<Fact> {
    let (spec, of) = (&plan.spec, &plan.of);
    let cut = &of.cut;
    let mm = |length: f64| format!("{} mm", trimmed(length, 3));
    let webs = plan.webs().in_words();
    let mut facts = Vec::new();
    let measured: Vec<&BoreMeasure> = walls.iter().copied().filter(|m| m.wall[0] <= m.wall[1]).collect();
    let worst = measured.iter().map(|m| m.worst()).max_by(f64::total_cmp);
    facts.push(match worst {
        Some(worst) => {
            let off = if worst < SMALL {
                "under 0.1 \u{b5}m off".to_owned()
            } else {
                format!("up to {} off", micrometres(worst))
            };
            let ends: usize = measured.iter().map(|m| m.ends).sum();
            let ends = match walls.len() - measured.len() {
                0 => format!("at {ends} line ends of the simulated part"),
                not => format!("at {ends} line ends; {not} of {} pieces not measured", walls.len()),
            };
            let note = if webs.is_empty() { ends } else { format!("{ends}; not compared: {webs}") };
            Fact::new("Width", format!("{}, {off}", mm(cut.width()))).note(note)
        }
        None => Fact::new("Width", mm(cut.width())).note("not measured: no line of the stock ends there"),
    });
    facts.push(
        Fact::new("Depth", mm(cut.depth())).note(format!("the tip runs at Z {}", trimmed(spec.bottom(), 3))),
    );
    let from = if spec.stock_to_leave > 0.0 {
        format!("of the axis from the wall, which lies {} before the outline", mm(spec.stock_to_leave))
    } else {
        "of the axis from the wall".to_owned()
    };
    facts.push(Fact::new("Offset", mm(cut.offset())).note(from));
    facts.push(Fact::new("Radius at the edge", mm(cut.top_radius())).note("for the cutting speed"));
    facts.push(match cut {
        EdgeBreak::Chamfer(chamfer) => {
            Fact::new("Tip clearance", mm(chamfer.tip_clearance)).note("below the chamfer")
        }
        EdgeBreak::Ball(ball) => {
            let hollow = micrometres(ball.hollow());
            Fact::new("Hollow by", hollow).note("in its middle, below a straight chamfer: a ball cuts it")
        }
    });
    let per_minute = |feed: f64| format!("{} mm/min", trimmed(feed * 60.0, 1));
    let down = format!("{} down", per_minute(spec.plunge_feed));
    facts.push(Fact::new("Feed", per_minute(spec.feed)).note(down));
    if !webs.is_empty() {
        let thick = plan.plan.uncut.iter().filter_map(|c| c.thickness).max_by(f64::total_cmp);
        let mut fact = Fact::new("Keeps a web", webs);
        if let Some(thick) = thick {
            fact = fact.note(format!("up to {} mm thick", fixed(thick, 3)));
        }
        facts.push(fact);
    }
    for note in &of.notes {
        facts.push(Fact::new("Drawing", note.clone()));
    }
    facts
}

/// Points along edges.
fn points(edges: &[OutlineEdge]) -> Vec<[f64; 2]> {
    let mut all = Vec::new();
    for edge in edges {
        let count = edge.turn.map_or(1, |t| (t.sweep.abs() / CHORD).ceil().max(1.0) as u32);
        let from = u32::from(!all.is_empty());
        all.extend((from..=count).map(|i| edge.at(f64::from(i) / f64::from(count)).to_array()));
    }
    all
}

fn view(plan: &PlannedEdge) -> Plan {
    let mut view = Plan::new("Outline and path of the cutter\u{2019}s tip");
    let outline = &plan.of.outline;
    for one in outline.loops() {
        let line = points(&outline.edges()[one.edges.clone()]);
        view.lines.push(PlanLine::new(Ink::line(Colour::Ink, Width::Middle), "outline", line));
    }
    for one in &plan.plan.loops {
        let ink = Ink::Line(Colour::Path(4), Width::Thin, Dash::Full);
        view.lines.push(PlanLine::new(ink, "tip", points(&one.edges)));
        if let Some(first) = one.edges.first() {
            view.points.push((first.start.to_array(), "start".to_owned()));
        }
    }
    view.circles.extend(plan.plan.uncut.iter().map(|c| Circle {
        centre: c.at.to_array(),
        radius: plan.of.cut.top_radius(),
        text: "web".to_owned(),
        ..Circle::default()
    }));
    view
}
