//! Claims proven by a run, each with the bound below which something can have been missed.

use super::super::check::Job;
use super::super::contacts::machine::{BodyKind, MachineContacts};
use super::super::missed::may_clip;
use super::super::setup_outcome::SetupOutcome;
use super::super::shape::Deviation;
use super::super::simulate::Simulation;
use super::super::uncertain;
use super::Proof;
use crate::base::at_most;
use crate::geom::CurveKind;
use crate::stock::certify::GAP;
use crate::trace::{Segment, SegmentPace, travel_findings};

/// Claims proven of the programs.
pub(in crate::job) fn proven(
    job: &Job,
    setups: &[SetupOutcome],
    simulation: &Simulation,
    deviation: &Deviation,
) -> Vec<Proof> {
    let mut proven = Vec::new();
    let mut add = |claim: String, bound: String| proven.push(Proof { claim, bound });
    let step = job.step;
    for (i, s) in setups.iter().enumerate() {
        let file = &s.file;
        match &s.external {
            Some(external) => add(external.claim(file), external.bound(s)),
            None => add(
                format!(
                    "`{file}`, read back as the control reads it, lies {} \u{b5}m from the exact curves of the plan{directions}",
                    at_most(s.read_back.largest * 1e3, 2),
                    directions = match s.read_back.largest_angle {
                        0.0 => String::new(),
                        angle => format!(
                            ", its tool within {:.4} degrees of the plan's directions",
                            angle.to_degrees()
                        ),
                    }
                ),
                format!("{} points on {} moves", s.read_back.points, s.read_back.moves),
            ),
        }
        let effects = &simulation.effects[i];
        let segments = &s.trace.segments;
        let clear = |test: &dyn Fn(usize) -> bool| (0..segments.len()).all(test);
        let none_met = |k: usize| effects[k].first_contact.is_none() && may_clip(&effects[k]).is_none();
        let swept = format!(
            "motion swept, not sampled; overlaps narrower than {:.2} mm at an edge of the stock can be missed, and spikes thinner than {} mm; paths followed, {} \u{b5}m off",
            simulation.missed.width,
            simulation.missed.step,
            at_most(simulation.path_error * 1e3, 2)
        );
        if clear(&|k| segments[k].motion != SegmentPace::Rapid || none_met(k)) {
            let dog_legs = segments.iter().any(|s| s.alternative);
            let ways = if dog_legs { "straight or axis by axis" } else { "on the straight lines they run" };
            add(format!("no rapid move of `{file}` meets stock, {ways}"), swept.clone());
        }
        if clear(&|k| effects[k].shank().is_none() && may_clip(&effects[k]).is_none()) {
            add(format!("no shank meets stock in `{file}`"), swept.clone());
        }
        let held = |k: usize| {
            segments[k].tool.is_some_and(|t| job.tools.iter().any(|x| x.number == t && x.holder.is_some()))
        };
        if (0..segments.len()).any(held)
            && clear(&|k| effects[k].holder().is_none() && may_clip(&effects[k]).is_none())
        {
            add(format!("no given holder meets stock in `{file}`"), swept.clone());
        }
        if clear(&|k| segments[k].spindle_on || segments[k].motion == SegmentPace::Rapid || none_met(k)) {
            add(format!("`{file}` never cuts with the spindle off"), swept);
        }
        let also = job.uncertainty.map_or(String::new(), |off| format!(", also with {}", off.words()));
        if let Some(off) = &simulation.uncertain
            && uncertain::is_clear(&s.trace, &off.effects[i], &job.tools)
        {
            let turning: Vec<String> = off.turning.iter().map(ToString::to_string).collect();
            let turning = match &turning[..] {
                [] => String::new(),
                all => format!(
                    "; what {} cut with their axes turning taken as cut where the program has it",
                    all.join(", ")
                ),
            };
            add(
                format!(
                    "no rapid move, no tool with its spindle off, no shank and no given holder of `{file}` meets stock{also}"
                ),
                format!(
                    "stock as large as any of these leaves it, cut by the motion swept; overlaps narrower than {:.2} mm at an edge of the stock can be missed{turning}",
                    std::f64::consts::SQRT_2 * job.step
                ),
            );
        }
        let fixtures = &job.setups[i].setup.fixtures;
        if !fixtures.is_empty() && simulation.meetings[i].iter().all(|m| m.contact.is_none()) {
            let bodies = match &fixtures[..] {
                [one] => format!("`{}`", one.name),
                all => format!("the {} bodies of the fixtures", all.len()),
            };
            let curved = |s: &&Segment| {
                !matches!(s.curve.kind(), CurveKind::Line(_) | CurveKind::Arc(_) | CurveKind::Involute { .. })
            };
            let curves = match segments.iter().filter(curved).count() {
                0 => String::new(),
                n => format!("; {n} moves along spirals and cubics with a sampled bound on their curvature"),
            };
            let holders = if (0..segments.len()).any(held) { ", shank or given holder" } else { " or shank" };
            add(
                format!("no tool{holders} meets {bodies} in `{file}`{also}"),
                format!(
                    "motion swept, not sampled, {ways}; contacts within 0.01 mm count{curves}",
                    ways = if segments.iter().any(|s| s.alternative) {
                        "rapids straight and axis by axis"
                    } else {
                        "rapids straight"
                    },
                ),
            );
        }
        if let Some(contacts) = simulation.machine[i].as_ref().filter(|c| c.compared > 0 && c.is_clear()) {
            let (claim, bound) = machine_clear(contacts, file, segments.iter().any(|s| s.alternative));
            add(format!("{claim}{also}"), bound);
        }
        if let Some(machine) = &job.machine
            && machine.joints.iter().any(|a| a.travel.is_some())
            && travel_findings(&s.trace, &s.program, machine).is_empty()
        {
            let how = if s.program.setups.iter().all(|s| s.located) {
                "axis positions"
            } else {
                "span of the motion only"
            };
            add(format!("`{file}` stays within the travel of the axes"), format!("{how}, within 2 \u{b5}m"));
        }
    }
    if let Some(certificate) = simulation.certificate.filter(|c| c.strayed == 0 && c.moves > 0) {
        let taken = match certificate.taken {
            0 => String::new(),
            count => {
                let um = at_most(certificate.deepest * 1e3, 1);
                format!(", after {count} stretches of lines, {um} \u{b5}m deep, were taken out")
            }
        };
        add(
            format!(
                "certified on all lines of the stock model, {step} mm between them: tools reach {} \u{b5}m into the material left{taken}, and ends of lines lie {} \u{b5}m off the tool that cut them",
                at_most(certificate.gap * 1e3, 2),
                at_most(GAP * 1e3, 2)
            ),
            format!(
                "branch and bound: {} moves, {} ends, {} boxes",
                certificate.moves, certificate.ends, certificate.boxes
            ),
        );
    }
    for claim in &deviation.proven {
        add(claim.clone(), format!("exact along the lines of the stock model, {step} mm between them"));
    }
    proven
}

/// The claim that bodies of the machine meet nothing, with its bound.
fn machine_clear(contacts: &MachineContacts, file: &str, dog_legs: bool) -> (String, String) {
    let count = |is: &dyn Fn(&BodyKind) -> bool| contacts.bodies.iter().filter(|b| is(&b.kind)).count();
    let fixtures = count(&|kind| matches!(kind, BodyKind::Fixture(_)));
    let stock = if contacts.stock_then.is_some() { "the stock" } else { "the raw stock" };
    let others = if fixtures > 0 { format!("tools, fixtures, {stock}") } else { format!("tools, {stock}") };
    let claim = match count(&|kind| matches!(kind, BodyKind::Machine(_))) {
        1 => format!("the body of the machine meets nothing in `{file}`: {others}"),
        n => format!("the {n} bodies of the machine meet nothing in `{file}`: {others}, one another"),
    };
    let whole = match contacts.is_whole() {
        true => String::new(),
        false => format!("; {} moves compared, not all", contacts.compared),
    };
    let sampled = match contacts.met.sampled.len() {
        0 => String::new(),
        n => format!("; {n} moves with sampled bounds on the way of their axes"),
    };
    let then = contacts.stock_then.map_or(String::new(), |then| {
        format!(
            "; where bodies come to the raw stock, the stock at that moment is {:.2} mm away or more, by lines {:.2} mm apart: thinner spikes can be missed",
            then.room(),
            then.step
        )
    });
    let ways = if dog_legs { "rapids straight and axis by axis" } else { "rapids straight" };
    let bound = format!(
        "motion of the axes swept, not sampled, {ways}; contacts within 0.01 mm count; bodies on neighbouring links not compared with each other{whole}{sampled}{then}"
    );
    (claim, bound)
}
