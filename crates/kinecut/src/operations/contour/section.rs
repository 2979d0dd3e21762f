//! Planned contours as the report shows them: facts, a plan view, the loops.

use super::PlannedContour;
use crate::contouring::ContourSide;
use crate::geom::OutlineEdge;
use crate::operations::measured::BoreMeasure;
use crate::operations::{Shown, slowed, uncut};
use crate::page::{
    Cell, Circle, Colour, Column, Dash, Fact, Ink, Plan, PlanLine, Row, Section, Table, Width, fixed, trimmed,
};

/// Most loops that the table lists.
const LISTED: usize = 100;
/// Arcs are drawn as chords of this angle [rad].
const CHORD: f64 = 0.05;

/// The section of an operation.
pub(super) fn section(plan: &PlannedContour, of: &Shown<'_>) -> Section {
    let mut section = Section::new(of.title());
    section.blocks.push(crate::page::Block::Facts(facts(plan, of.walls.first().copied())));
    section.with(view(plan)).with(table(plan))
}

fn facts(plan: &PlannedContour, wall: Option<&BoreMeasure>) -> Vec<Fact> {
    let (spec, of) = (&plan.spec, &plan.of);
    let mut facts = Vec::new();
    if let Some((m, value)) = wall.and_then(|m| Some((m, m.stock_on_wall()?))) {
        let ends = format!("at {} line ends of the simulated part", m.ends);
        let note = plan.not_looked_at().map_or(ends.clone(), |what| format!("{ends}; not compared: {what}"));
        facts.push(Fact::new("Wall", value).note(note));
    } else {
        let why = if spec.side == ContourSide::On {
            "a contour on the line has no wall"
        } else {
            "no line of the stock ends there"
        };
        facts.push(Fact::new("Wall", "not measured").note(why));
    }
    let levels = plan.plan.levels.len();
    let lowest = plan.plan.levels.last().copied().unwrap_or(spec.top);
    facts.push(
        Fact::new("Levels", format!("{levels}")).note(format!("the lowest at Z {}", trimmed(lowest, 3))),
    );
    let down = match spec.ramp {
        Some(angle) => format!("ramp of {}\u{b0} along the contour", trimmed(angle.to_degrees(), 2)),
        None if plan.of.outline.is_of_lines() && spec.clear_ends => {
            "straight down beside the stock".to_owned()
        }
        None => "straight down beside the contour".to_owned(),
    };
    let per_minute = |feed: f64| format!("{} mm/min", trimmed(feed * 60.0, 1));
    facts.push(Fact::new("Way down", down).note(per_minute(spec.plunge_feed)));
    facts.push(Fact::new("Feed", per_minute(spec.feed)).note(match spec.feed_at {
        crate::holes::FeedAt::Wall => "at the wall",
        crate::holes::FeedAt::Centre => "of the cutter\u{2019}s centre",
    }));
    if let Some((slowed, finish)) = plan.plan.slowed.as_ref().zip(spec.finish) {
        facts.push(slowed::fact(slowed, finish.feed));
    }
    facts.extend(uncut::facts(&plan.plan.uncut, plan.spec.radius()));
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

fn view(plan: &PlannedContour) -> Plan {
    let mut view = Plan::new("Outline and path of the cutter\u{2019}s centre");
    let outline = &plan.of.outline;
    for one in outline.loops() {
        let line = points(&outline.edges()[one.edges.clone()]);
        view.lines.push(PlanLine::new(Ink::line(Colour::Ink, Width::Middle), "outline", line));
    }
    for one in &plan.plan.loops {
        let (ink, word) = match one.finishing {
            true => (Ink::Line(Colour::Path(5), Width::Bold, Dash::Full), "finish"),
            false => (Ink::Line(Colour::Path(4), Width::Thin, Dash::Full), "rough"),
        };
        view.lines.push(PlanLine::new(ink, word, points(&one.edges)));
        let radius = plan.spec.radius();
        view.circles.extend(one.tabs.iter().map(|t| Circle {
            centre: t.at.to_array(),
            radius,
            text: "tab".to_owned(),
            ..Circle::default()
        }));
        let is_last = one.finishing || plan.spec.finish.is_none();
        if let Some(first) = one.edges.first().filter(|_| is_last) {
            view.points.push((first.start.to_array(), "start".to_owned()));
        }
    }
    view
}

fn table(plan: &PlannedContour) -> Table {
    let is_lines = plan.of.outline.is_of_lines();
    let mut table = Table {
        caption: format!("{}s in the order of cutting", if is_lines { "Path" } else { "Loop" }),
        columns: vec![
            Column::text(if is_lines { "Path" } else { "Loop" }),
            Column::text("Start"),
            Column::number("Length", "mm"),
            Column::number("Tabs", ""),
        ],
        ..Table::default()
    };
    for one in plan.plan.loops.iter().take(LISTED) {
        let which = match one.outer {
            _ if is_lines => "",
            true => ", outer",
            false => ", inner",
        };
        let what = if one.finishing { "finishing" } else { "roughing" };
        let start = one.edges.first().map(|e| uncut::place(e.start)).unwrap_or_default();
        table.rows.push(Row::new(vec![
            Cell::new(format!("{what}{which}")),
            Cell::new(start),
            Cell::new(fixed(one.length(), 2)),
            Cell::new(format!("{}", one.tabs.len())),
        ]));
    }
    let more = plan.plan.loops.len().saturating_sub(LISTED);
    if more > 0 {
        table.notes.push(format!("{more} more are in plan.json."));
    }
    table
}
