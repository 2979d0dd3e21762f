//! Planned pockets as the report shows them: facts and a plan view.

use std::f64::consts::PI;

use glam::DVec2;

use super::PlannedPocket;
use crate::geom::OutlineEdge;
use crate::holes::{PlannedMove, ToolpathRole};
use crate::operations::measured::BoreMeasure;
use crate::operations::{Shown, slowed, uncut};
use crate::page::{Block, Colour, Dash, Fact, Ink, Plan, PlanLine, Section, Width, fixed, trimmed};

/// Arcs are drawn as chords of this angle [rad].
const CHORD: f64 = 0.1;

/// The section of an operation.
pub(crate) fn section(plan: &PlannedPocket, of: &Shown<'_>) -> Section {
    let mut section = Section::new(of.title());
    section.blocks.push(Block::Facts(facts(plan, of.walls.first().copied())));
    section.with(view(plan))
}

fn facts(plan: &PlannedPocket, wall: Option<&BoreMeasure>) -> Vec<Fact> {
    let (spec, f) = (&plan.spec, &plan.clearing.figures);
    let mut facts = vec![measured(plan, wall)];
    let per_minute = |feed: f64| format!("{} mm/min", trimmed(feed * 60.0, 1));
    let levels = plan.clearing.levels.len();
    let lowest = plan.clearing.levels.last().copied().unwrap_or(spec.top);
    facts.push(
        Fact::new("Levels", format!("{levels}")).note(format!("the lowest at Z {}", trimmed(lowest, 3))),
    );
    facts.push(
        Fact::new("Engagement", format!("at most {}\u{b0} as planned", fixed(f.largest.to_degrees(), 1)))
            .note(format!(
                "wanted {}\u{b0}; of the passes, not of the way down and the lap along the wall",
                trimmed(spec.engagement.to_degrees(), 1)
            )),
    );
    let share = |length: f64| format!("{} mm", trimmed(length, 0));
    let [title, one, more] = match plan.of.slot.is_some() && f.largest < PI {
        true => ["Loops", "loop", "loops"],
        false => ["Passes", "pass", "passes"],
    };
    let ratio = if f.bound > 0.0 { fixed(f.cutting / f.bound, 2) } else { "\u{2013}".to_owned() };
    facts.push(
        Fact::new(title, uncut::count(f.passes, one, more)).note(format!(
            "{} on each level, {ratio} of the least length at this engagement",
            share(f.cutting)
        )),
    );
    facts.push(Fact::new("Links", share(f.links)).note(format!(
        "at {}; {} over the part",
        per_minute(spec.link_feed),
        f.retracts
    )));
    facts.push(way_down(plan));
    facts.extend(rest(plan));
    facts.push(Fact::new("Feed", per_minute(spec.feed)).note("of the cutter\u{2019}s centre in passes"));
    if f.left > 0.0 {
        facts.push(
            Fact::new("Left to the lap", format!("{} mm\u{b2}", fixed(f.left, 2)))
                .note("beside the wall, beyond its stock of 0.02 mm; cut at the engagement that comes"),
        );
    }
    if let Some((slowed, finish)) = plan.wall.slowed.as_ref().zip(plan.lap.finish) {
        facts.push(slowed::fact(slowed, finish.feed));
    }
    facts.extend(uncut::facts(&plan.wall.uncut, plan.lap.radius()));
    for note in &plan.of.notes {
        facts.push(Fact::new("Drawing", note.clone()));
    }
    facts
}

/// The way down, with its engagement, which is no matter of the passes.
fn way_down(plan: &PlannedPocket) -> Fact {
    let (spec, f) = (&plan.spec, &plan.clearing.figures);
    let feed = format!("{} mm/min", trimmed(spec.plunge_feed * 60.0, 1));
    if f.entries == 0 {
        let free = if spec.rest.is_some() { "through what is cleared" } else { "by an open side or a hole" };
        return Fact::new("Way down", free).note(feed);
    }
    let angle = trimmed(spec.ramp.to_degrees(), 2);
    let helices = f.entries - f.ramps - f.plunges;
    let mut ways = Vec::new();
    for (n, one, more) in [(helices, "helix", "helices"), (f.ramps, "ramp", "ramps")] {
        if n > 0 {
            ways.push(format!("{} of {angle}\u{b0}", uncut::count(n, one, more)));
        }
    }
    if f.plunges > 0 {
        ways.push(format!("{} straight down", uncut::count(f.plunges, "way", "ways")));
    }
    let engaged = trimmed(f.entry.to_degrees(), 1);
    Fact::new("Way down", ways.join(", ")).note(format!("{feed}; engagement {engaged}\u{b0} seen from above"))
}

/// The places that an earlier cutter has left, if only those are cleared.
fn rest(plan: &PlannedPocket) -> Option<Fact> {
    let (earlier, rest) = plan.spec.rest.zip(plan.clearing.figures.rest)?;
    let places = uncut::count(rest.places, "place", "places");
    let note = match rest.to_lap {
        0 => String::new(),
        n => format!("; {} with less than 10\u{b0} left to the lap", uncut::count(n, "place", "places")),
    };
    let cutter = format!("that a cutter of {} mm has left{note}", trimmed(2.0 * earlier.radius, 3));
    Some(Fact::new("Rest", places).note(cutter))
}

fn measured(plan: &PlannedPocket, wall: Option<&BoreMeasure>) -> Fact {
    let Some((m, value)) = wall.and_then(|m| Some((m, m.stock_on_wall()?))) else {
        return Fact::new("Wall", "not measured").note("no line of the stock ends there");
    };
    let ends = format!("at {} line ends of the simulated part", m.ends);
    let note = plan.not_looked_at().map_or(ends.clone(), |what| format!("{ends}; not compared: {what}"));
    Fact::new("Wall", value).note(note)
}

/// Points along an edge, its first one left out where `joined`.
fn points(edge: &OutlineEdge, joined: bool, all: &mut Vec<[f64; 2]>) {
    let count = edge.turn.map_or(1, |t| (t.sweep.abs() / CHORD).ceil().max(1.0) as u32);
    all.extend((u32::from(joined)..=count).map(|i| edge.at(f64::from(i) / f64::from(count)).to_array()));
}

/// Lines of moves of one level and kind, each as long as they join.
fn lines(moves: &[PlannedMove], is_wanted: impl Fn(&PlannedMove) -> bool) -> Vec<Vec<[f64; 2]>> {
    let mut all: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut end: Option<DVec2> = None;
    for m in moves {
        let (from, to) = (m.curve.start().truncate(), m.curve.end().truncate());
        let length = m.curve.length();
        let turn = m.curve.at(0.0).d1.truncate().angle_to(m.curve.at(0.5 * length).d1.truncate());
        let is_level = from.distance(to) > 1e-6 || turn.abs() > 1e-6;
        if !is_wanted(m) || !is_level {
            end = None;
            continue;
        }
        let joined = end.is_some_and(|end| end.distance(from) < 1e-6);
        if !joined {
            all.push(Vec::new());
        }
        let Some(line) = all.last_mut() else { continue };
        let count = (2.0 * turn.abs() / CHORD).ceil().max(1.0) as u32;
        line.extend((u32::from(joined)..=count).map(|i| {
            let p = m.curve.at(length * f64::from(i) / f64::from(count)).p;
            [p.x, p.y]
        }));
        end = Some(to);
    }
    all
}

fn view(plan: &PlannedPocket) -> Plan {
    let mut view = Plan::new("Outline and path of the cutter\u{2019}s centre on a level");
    let outline = &plan.of.outline;
    let first = |m: &PlannedMove| m.level == 0;
    let moves = &plan.clearing.moves;
    for line in lines(moves, |m| first(m) && m.role == ToolpathRole::Link) {
        view.lines.push(PlanLine::new(Ink::Line(Colour::Path(2), Width::Thin, Dash::Dots), "link", line));
    }
    for line in lines(moves, |m| first(m) && m.role == ToolpathRole::Rough) {
        view.lines.push(PlanLine::new(Ink::Line(Colour::Path(4), Width::Thin, Dash::Full), "pass", line));
    }
    for line in lines(moves, |m| first(m) && m.role == ToolpathRole::Entry) {
        view.lines.push(PlanLine::new(Ink::Line(Colour::Path(1), Width::Thin, Dash::Full), "way down", line));
    }
    for one in &plan.wall.loops {
        let mut line = Vec::new();
        one.edges.iter().for_each(|e| points(e, !line.is_empty(), &mut line));
        let word = if one.finishing { "finish" } else { "lap along the wall" };
        view.lines.push(PlanLine::new(Ink::Line(Colour::Path(5), Width::Bold, Dash::Full), word, line));
    }
    for one in outline.loops() {
        let mut line = Vec::new();
        outline.edges()[one.edges.clone()].iter().for_each(|e| points(e, !line.is_empty(), &mut line));
        view.lines.push(PlanLine::new(Ink::line(Colour::Ink, Width::Middle), "outline", line));
    }
    view
}
