//! Tools of the programs of a job past clamps and fixtures.

use glam::DVec3;

use super::super::check::{Job, Uncertainty};
use super::noun::noun;
use super::{AS_NEAR, AT_ONCE, LOOK, changed_before, hundredths, is_worse, may_meet};
use crate::base::{Code, Finding, Location, Progress, Result};
use crate::contact::{Body, Meeting, MovingTool, ToolPart, Watched, meetings};
use crate::geom::{Rigid, Solid};
use crate::program::Setup;
use crate::sweep::ToolMotion;
use crate::tool::Tool;
use crate::trace::{Segment, SegmentPace, Trace};

/// Contacts and near passes of the segments of a setup's program; none where it has no fixtures.
pub(in crate::job) fn contacts(
    job: &Job,
    setup: &Setup,
    trace: &Trace,
    progress: &dyn Progress,
) -> Result<Vec<Meeting>> {
    if setup.fixtures.is_empty() {
        return Ok(Vec::new());
    }
    let tools = job.tools.iter().map(moving).collect::<Result<Vec<_>>>()?;
    let to_part = setup.part_on_table.inverse();
    let off = job.uncertainty.map_or(0.0, |off| off.of_tool());
    let bodies = setup.fixtures.iter().map(|fixture| {
        Body::new(
            fixture.name.clone(),
            &fixture.solid,
            to_part.after(&fixture.place),
            fixture.near.max(LOOK).max(off),
        )
        .map(|body| body.off_by(off))
    });
    let bodies = bodies.collect::<Result<Vec<_>>>()?;
    let watched = |segment: &Segment| {
        let tool = job.tools.iter().position(|tool| Some(tool.number) == segment.tool).ok_or_else(|| {
            Finding::error(Code::NC_STATE, "the program moves before a tool is called")
                .help("call a tool first")
        })?;
        Ok(Watched { motion: ToolMotion::of_segment(segment)?, tool: tool as u32 })
    };
    let mut all = Vec::new();
    for (i, segments) in trace.segments.chunks(AT_ONCE).enumerate() {
        let moves = segments.iter().map(watched).collect::<Result<Vec<_>>>()?;
        let found = meetings(&tools, &bodies, &moves, to_part.vector(DVec3::Z), progress)?;
        let before = (i * AT_ONCE) as u32;
        all.extend(found.into_iter().map(|m| Meeting { watched: before + m.watched, ..m }));
    }
    Ok(all)
}

/// A tool with its shank and its holder.
pub(in crate::job) fn moving(tool: &Tool) -> Result<MovingTool> {
    let cutting = tool.cutting_profile()?;
    let shank = tool.shank_profile()?;
    let holder = tool.holder_profiles()?;
    let cutter = std::iter::once((ToolPart::Cutter, &cutting, 0.0));
    let shank = shank.iter().map(|(profile, z)| (ToolPart::Shank, profile, *z));
    let holder = holder.iter().map(|(profile, z)| (ToolPart::Holder, profile, *z));
    Ok(MovingTool::new(cutter.chain(shank).chain(holder)))
}

/// Findings of the meetings: contacts by block and body, near passes by tool, part and body, each at the nearest block.
pub(in crate::job) fn findings(
    (setup, off): (&Setup, Option<Uncertainty>),
    trace: &Trace,
    meetings: &[Meeting],
    place: impl Fn(u32) -> Option<Location>,
) -> Vec<Finding> {
    let told = |m: &Meeting, way: f64| (m.contact, way, m.distance);
    // Item, body, and the one that lasts longest or is nearest.
    let mut contacts: Vec<(u32, &Meeting, f64)> = Vec::new();
    let mut near: Vec<&Meeting> = Vec::new();
    // A tool that touches a body as soon as it is in the spindle.
    let mut changed: Vec<(u32, &Meeting)> = Vec::new();
    for meeting in meetings {
        let segment = &trace.segments[meeting.watched as usize];
        let Some(contact) = &meeting.contact else {
            let tool = |m: &Meeting| (trace.segments[m.watched as usize].tool, m.part, m.body);
            match near.iter_mut().find(|m| tool(m) == tool(meeting)) {
                // The first of those that are as near.
                Some(known) if meeting.distance < known.distance - AS_NEAR => *known = meeting,
                Some(_) => {}
                None => near.push(meeting),
            }
            continue;
        };
        if let Some(item) =
            changed_before(trace, meeting.watched).filter(|_| contact.certain && contact.from == 0.0)
            && !changed.iter().any(|(known, m)| (*known, m.body) == (item, meeting.body))
        {
            changed.push((item, meeting));
        }
        let way = segment.curve.length() * (contact.to - contact.from);
        // Meetings are in the order of the moves: those of one block are the last.
        let of_block = contacts.iter().rev().take_while(|(item, ..)| *item == segment.item).count();
        let from = contacts.len() - of_block;
        let same = contacts[from..].iter().position(|(_, m, _)| m.body == meeting.body).map(|i| from + i);
        match same {
            // The first of those that are as long.
            Some(i) if is_worse(told(meeting, way), told(contacts[i].1, contacts[i].2)) => {
                contacts[i] = (segment.item, meeting, way);
            }
            Some(_) => {}
            None => contacts.push((segment.item, meeting, way)),
        }
    }
    let hit = contacts.into_iter().map(|(item, meeting, way)| {
        let segment = &trace.segments[meeting.watched as usize];
        let alone = if segment.alternative { " when the axes run one by one" } else { "" };
        let rapid = if segment.motion == SegmentPace::Rapid { " at rapid" } else { "" };
        let message = format!("the {} meets {}{rapid}{alone}", noun(meeting.part), name(setup, meeting));
        let finding = match meeting.contact.filter(|contact| !contact.certain) {
            Some(_) => may_meet(Code::FIXTURE_MET, &message, meeting.distance, off),
            None => Finding::error(Code::FIXTURE_MET, message),
        };
        let finding = finding.point(meeting.place.to_array());
        // Both in hundredths: the lift is not less than what clears.
        let certain = meeting.contact.is_some_and(|contact| contact.certain);
        let finding = match certain && way > 0.0 {
            true => finding.value(hundredths(way), "mm of the move"),
            false => finding,
        };
        let clears = meeting.contact.as_ref().and_then(|c| c.clears_by);
        let higher = clears.map(|lift| format!("{:.2} mm higher", hundredths(lift + 0.005)));
        let help = match (segment.motion, higher) {
            (SegmentPace::Rapid, Some(higher)) => format!("run it {higher}, or move the body"),
            (SegmentPace::Rapid, None) => "run it higher, or move the body".to_owned(),
            (SegmentPace::Feed(_), Some(higher)) => {
                format!("keep the path away from the body, or move the body; it clears {higher}")
            }
            (SegmentPace::Feed(_), None) => "keep the path away from the body, or move the body".to_owned(),
        };
        (item, finding.help(help))
    });
    let warned = |meeting: &&Meeting| meeting.distance < setup.fixtures[meeting.body as usize].near;
    let passed = near.into_iter().filter(warned).map(|meeting| {
        let message = format!("the {} passes {}", noun(meeting.part), name(setup, meeting));
        let bound = setup.fixtures[meeting.body as usize].near;
        let finding = Finding::warning(Code::FIXTURE_NEAR, message)
            .point(meeting.place.to_array())
            .value(meeting.distance, "mm apart")
            .bound(bound, "mm, `near`")
            .help("its offset may be off by no more than that");
        (trace.segments[meeting.watched as usize].item, finding)
    });
    let changed = changed.into_iter().map(|(item, meeting)| {
        let what =
            format!("the {} meets {} as it comes into the spindle", noun(meeting.part), name(setup, meeting));
        let finding = Finding::error(Code::FIXTURE_MET, what).point(meeting.place.to_array());
        (item, finding.help("retract before the tool is changed, or move the body"))
    });
    let mut all: Vec<(u32, Finding)> = changed.chain(hit).chain(passed).collect();
    all.sort_by_key(|(item, _)| *item);
    all.into_iter()
        .map(|(item, mut finding)| {
            finding.place = place(item);
            finding
        })
        .collect()
}

/// Depth to which a body and the stock may be in the same place [mm]: rounding of drawn sizes.
const SHARED: f64 = 0.1;

/// Fixtures that reach into the raw stock of the first setup; one that has holes may stand on pins.
pub(in crate::job) fn in_stock(job: &Job) -> Result<Vec<Finding>> {
    let Some(setup) = job.setups.first().map(|own| &own.setup).filter(|_| job.drilled.is_empty()) else {
        return Ok(Vec::new());
    };
    let to_part = setup.part_on_table.inverse();
    let mut found = Vec::new();
    for fixture in &setup.fixtures {
        // One of the two is taken smaller by what does not count.
        let (stock, body) = match (smaller(&job.stock), smaller(&fixture.solid)) {
            (Some(stock), _) => (stock, (*fixture.solid).clone()),
            (None, Some(body)) => (job.stock.clone(), body),
            (None, None) => continue,
        };
        let stock = Body::new("stock", &stock, Rigid::IDENTITY, 0.0)?;
        let body = Body::new(fixture.name.clone(), &body, to_part.after(&fixture.place), 0.0)?;
        if body.touches(&stock) {
            let what = format!("`{}` reaches into the raw stock", fixture.name);
            let help = "correct its `at` or its size, or the stock";
            found.push(Finding::warning(Code::FIXTURE_IN_STOCK, what).bound_mm(SHARED).help(help));
        }
    }
    Ok(found)
}

/// A solid smaller on all sides; none of a mesh, and of what would vanish.
fn smaller(solid: &Solid) -> Option<Solid> {
    match solid {
        Solid::Box(bounds) => {
            let inner = bounds.grown(-SHARED);
            (!inner.is_empty()).then_some(Solid::Box(inner))
        }
        Solid::Cylinder { base, radius, height } => {
            let (base, radius, height) = (*base + DVec3::Z * SHARED, radius - SHARED, height - 2.0 * SHARED);
            (radius > 0.0 && height > 0.0).then_some(Solid::Cylinder { base, radius, height })
        }
        Solid::Mesh(_) => None,
    }
}

fn name(setup: &Setup, meeting: &Meeting) -> String {
    format!("`{}`", setup.fixtures[meeting.body as usize].name)
}
