//! SetupPlan faces as the report shows them.

use glam::DVec2;

use super::plan::options;
use super::show::{Dot, MilledFace, Simulated, Timed, face_section};
use super::{PlannedFace, SimulatedFace};
use crate::operations::Shown;
use crate::operations::measured::FaceMeasure;
use crate::page::{Fact, Section, fixed, micrometres};
use crate::program::Role;
use crate::trace::SegmentPace;

/// Speed of links where no machine is given [mm/s].
const USUAL_RAPID: f64 = 500.0;

/// A planned face under a title, the one of this number on its page.
pub(crate) fn view<'a>(title: &'a str, number: usize, face: &'a PlannedFace) -> MilledFace<'a> {
    let operation = &face.of;
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
        options: options(operation, face.plan.left_hand),
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

/// The sections of a job's milled faces.
pub(super) fn sections(all: &[(&PlannedFace, &Shown<'_>)]) -> Vec<Section> {
    let one = |(number, (face, of)): (usize, &(&PlannedFace, &Shown<'_>))| {
        let title = of.title();
        let shown = MilledFace { rapid: of.rapid.unwrap_or(USUAL_RAPID), ..view(&title, number, face) };
        let measured = face.simulated.as_ref();
        let simulated = measured.map(|m| simulated(of, face, m));
        let facts = measured.map(facts).into_iter().flatten().chain(of.plane.map(flatness)).collect();
        face_section(&shown, simulated.as_ref(), facts)
    };
    all.iter().enumerate().map(one).collect()
}

/// Measures of the simulated walls.
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
fn simulated(of: &Shown<'_>, planned: &PlannedFace, face: &SimulatedFace) -> Simulated {
    let flip = |p: DVec2| if planned.plan.left_hand { DVec2::new(p.x, -p.y) } else { p };
    let dots = face.exits.iter().map(|e| Dot {
        at: flip(DVec2::from_array(e.at)),
        angle: e.angle,
        planned: e.planned,
    });
    let (chains, from) = posted(of, planned, flip);
    Simulated { dots: dots.collect(), chains, program: [from, of.time[1]] }
}

/// The way of the cutter's centre at the finished plane in the plan's frame, its times from its begin, and when in the
/// program that is.
fn posted(of: &Shown<'_>, planned: &PlannedFace, flip: impl Fn(DVec2) -> DVec2) -> (Timed, f64) {
    /// Arcs become chords this near to them [mm].
    const CHORD: f64 = 0.02;
    let mut time = of.time[0];
    let to_work = of.posted.to_work();
    let (mut chains, mut open) = (Timed::new(), false);
    for segment in of.posted.trace.segments.iter().filter(|s| !s.alternative) {
        let long = segment.duration.unwrap_or(0.0);
        let own = of.posted.planned_item(segment.item).is_some_and(|p| {
            let origin = of.posted.planned.origin(p as usize);
            origin.operation == Some(planned.operation) && origin.role == Role::Finish
        });
        if own && matches!(segment.motion, SegmentPace::Feed(_)) {
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
