//! Planned faces as the report takes them: of a job's outcome, and of the sheet of `kinecut face`.

use glam::DVec2;

use super::face::{Dot, MilledFace, Simulated, Timed, face_page, face_section, face_words};
use crate::job::{
    FaceMeasure, FaceOperation, FaceSheet, Operation, Outcome, PlannedFace, SetupOutcome, SimulatedFace,
    face_options, face_to_work,
};
use crate::page::{Fact, Section, fixed, micrometres};
use crate::program::Role;
use crate::trace::Motion;

/// Speed of links where no machine is given [mm/s].
const USUAL_RAPID: f64 = 500.0;

fn view<'a>(
    title: &'a str,
    number: usize,
    operation: &'a FaceOperation,
    face: &'a PlannedFace,
) -> MilledFace<'a> {
    let mut above = operation.table.top + operation.table.depth;
    let depths = operation.levels.iter().map(|&level| {
        let depth = above - level;
        above = level;
        depth
    });
    MilledFace {
        title,
        id: format!("face-{}", number + 1),
        rule: &operation.rule,
        notes: &operation.notes,
        plan: &face.plan,
        options: face_options(operation, face.plan.left_hand),
        guard: operation.guard,
        teeth: &face.teeth,
        feed: operation.feed,
        feed_per_revolution: face.feed_per_revolution,
        rapid: USUAL_RAPID,
        depths: depths.collect(),
        part_turned: face.part_turned,
        coordinates_turned: face.coordinates_turned,
        findings: &[],
        events: &[],
        survey: &[],
        from_drawn: None,
        descents: &[],
        map: None,
    }
}

fn of_sheet(sheet: &FaceSheet, number: usize) -> MilledFace<'_> {
    let face = MilledFace {
        findings: &sheet.findings,
        events: &sheet.events,
        ..view(&sheet.title, number, &sheet.operation, &sheet.face)
    };
    match &sheet.paper {
        Some(p) => MilledFace {
            survey: &p.survey,
            from_drawn: p.from_drawn.as_ref(),
            descents: &p.descents,
            map: Some(&p.map),
            ..face
        },
        None => face,
    }
}

/// The sheet of a face as text; `paper`: with what the paper's program does, if the sheet has it.
pub fn face_text(sheet: &FaceSheet, paper: bool) -> String {
    face_words(&of_sheet(sheet, 0), paper)
}

/// The sheets of faces as one HTML file without any reference to a network.
pub fn faces_html(sheets: &[&FaceSheet]) -> String {
    let faces: Vec<MilledFace<'_>> = sheets.iter().enumerate().map(|(i, s)| of_sheet(s, i)).collect();
    face_page(&faces)
}

/// The sections of a job's milled faces.
pub(super) fn sections(outcome: &Outcome) -> Vec<Section> {
    let operations: Vec<&Operation> = outcome.job.setups.iter().flat_map(|s| &s.operations).collect();
    let mut sections = Vec::new();
    for (setup, done) in outcome.setups.iter().enumerate() {
        for planned in &done.planned.faces {
            let Some(Operation::Face(operation)) = operations.get(planned.operation as usize) else {
                continue;
            };
            let name = operation.name();
            let title = name[..1].to_uppercase() + &name[1..];
            let rapid = outcome.job.machine.as_ref().and_then(|m| m.dynamics.rapid).unwrap_or(USUAL_RAPID);
            let face = MilledFace { rapid, ..view(&title, sections.len(), operation, planned) };
            let measured = outcome.faces.iter().find(|f| f.operation == planned.operation);
            let simulated = measured.map(|m| simulated(outcome, setup, planned, m));
            let flat = outcome.deviation.faces.iter().find(|f| f.operation == planned.operation);
            let facts = measured.map(facts).into_iter().flatten().chain(flat.map(flatness)).collect();
            let _ = done;
            sections.push(face_section(&face, simulated.as_ref(), facts));
        }
    }
    sections
}

/// What was measured on the simulated walls.
fn facts(face: &SimulatedFace) -> Vec<Fact> {
    let differing = if face.differing > 0.0 {
        format!("{} mm of edge differ from the plan", fixed(face.differing, 2))
    } else {
        format!("angles as planned to {}\u{b0}", fixed(face.largest.to_degrees(), 2))
    };
    vec![
        Fact::new("Bad length, simulated", format!("{} mm", fixed(face.bad, 2)))
            .note(format!("on {} mm of the stock\u{2019}s walls; {differing}", fixed(face.matched, 1))),
    ]
}

fn flatness(face: &FaceMeasure) -> Fact {
    let [low, high] = face.height;
    if !(low <= high) {
        return Fact::new("Flatness", "not measured");
    }
    let range = format!("{} to {}", micrometres(low), micrometres(high));
    Fact::new("Height over the plane", range).note(format!("at {} line ends", face.ends))
}

/// Exits and way as the text has them.
fn simulated(outcome: &Outcome, setup: usize, planned: &PlannedFace, face: &SimulatedFace) -> Simulated {
    let flip = |p: DVec2| if planned.plan.left_hand { DVec2::new(p.x, -p.y) } else { p };
    let dots = face.exits.iter().map(|e| Dot {
        at: flip(DVec2::from_array(e.at)),
        angle: e.angle,
        planned: e.planned,
    });
    let total = outcome.setups.iter().map(|s| s.trace.duration().0).sum();
    let (chains, from) = posted(outcome, setup, planned, flip);
    Simulated { dots: dots.collect(), chains, program: [from, total] }
}

/// The way of the cutter's centre at the finished plane in the plan's frame, its times from its begin, and when in the
/// program that is.
fn posted(
    outcome: &Outcome,
    setup: usize,
    planned: &PlannedFace,
    flip: impl Fn(DVec2) -> DVec2,
) -> (Timed, f64) {
    /// Arcs become chords this near to them [mm].
    const CHORD: f64 = 0.02;
    let mut time: f64 = outcome.setups[..setup].iter().map(|s| s.trace.duration().0).sum();
    let done: &SetupOutcome = &outcome.setups[setup];
    let to_work = face_to_work(&outcome.job, done, setup);
    let (mut chains, mut open) = (Timed::new(), false);
    for segment in done.trace.segments.iter().filter(|s| !s.alternative) {
        let long = segment.duration.unwrap_or(0.0);
        let own = done.planned_item(segment.item).is_some_and(|p| {
            let origin = done.planned.program.origin(p as usize);
            origin.operation == Some(planned.operation) && origin.role == Role::Finish
        });
        if own && matches!(segment.motion, Motion::Feed(_)) {
            let points = segment.curve.polyline(CHORD);
            let last = points.len().saturating_sub(1).max(1) as f64;
            let place = |(i, p): (usize, &glam::DVec3)| {
                let at = flip(planned.in_outline(to_work.point(*p).truncate()));
                (at, time + long * i as f64 / last)
            };
            let points = points.iter().enumerate().map(place);
            match chains.last_mut().filter(|_| open) {
                Some(chain) => chain.extend(points),
                None => chains.push(points.collect()),
            }
            open = true;
        } else {
            open = false;
        }
        time += long;
    }
    let from = chains.first().and_then(|c| c.first()).map_or(0.0, |p| p.1);
    for point in chains.iter_mut().flatten() {
        point.1 -= from;
    }
    (chains, from)
}
