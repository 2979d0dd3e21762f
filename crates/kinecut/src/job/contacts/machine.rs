//! All that the machine moves: its bodies past one another, past tools, fixtures and the raw stock.

use super::super::check::{Job, Uncertainty};
use super::fixtures::moving;
use super::noun::noun;
use super::stock_at::StockThen;
use super::{AS_NEAR, AT_ONCE, LOOK, changed_before, hundredths, is_worse, may_meet};
use crate::base::{Code, Finding, Location, Progress, Result};
use crate::contact::{
    Body, LinkBody, MachineMeeting, MachineMove, MachineParts, Met, Party, ToolInSpindle, ToolPart,
};
use crate::geom::Rigid;
use crate::machine::Machine;
use crate::program::Setup;
use crate::tool::ToolNumber;
use crate::trace::{Segment, SegmentPace, Trace};

/// Bodies of a machine along the program of a setup.
#[derive(Clone, Debug, Default)]
pub struct MachineContacts {
    /// Reason for which nothing was compared.
    pub not_compared: Option<&'static str>,
    /// The bodies: those of the machine, fixtures, the raw stock.
    pub bodies: Vec<ComparedBody>,
    /// Contacts and near passes; moves that were not compared as the positions of the axes are not known.
    pub met: Met,
    /// Pairs of bodies that touch where the program begins.
    pub touching: Vec<[u32; 2]>,
    /// Item at which it begins.
    pub begins: u32,
    /// Tools without a gauge length: in their moves nothing was compared.
    pub without_length: Vec<ToolNumber>,
    /// Moves that were compared.
    pub compared: usize,
    /// The stock by which contacts with the raw stock were settled; none where there were none, or where it is not known.
    pub stock_then: Option<StockThen>,
}

/// A body that was compared.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedBody {
    /// As a finding names it.
    pub name: String,
    /// Least distance that others are to keep [mm].
    pub near: f64,
    /// Machine, fixture or stock.
    pub kind: BodyKind,
}

/// Origin of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyKind {
    /// A body of the machine: its index there.
    Machine(usize),
    /// A fixture of the setup: its index there.
    Fixture(usize),
    /// The stock as it was before the first cut.
    Stock,
    /// The stock as it is at the moment of a contact.
    StockThen,
}

/// Name of a body of a machine in words.
pub(crate) fn body_name(machine: &Machine, index: usize) -> String {
    match &machine.bodies[index].name[..] {
        "" => format!("body {}", index + 1),
        name => name.to_owned(),
    }
}

/// Contacts and near passes along a setup's program; nothing where the machine has no bodies.
pub(in crate::job) fn contacts(
    job: &Job,
    setup: &Setup,
    trace: &Trace,
    progress: &dyn Progress,
) -> Result<Option<MachineContacts>> {
    let Some(machine) = job.machine.as_ref().filter(|m| !m.bodies.is_empty()) else { return Ok(None) };
    let mut contacts = MachineContacts::default();
    if !setup.located {
        contacts.not_compared =
            Some("where the part lies on the machine is not given (`position` of the setup)");
        return Ok(Some(contacts));
    }
    let (bodies, compared) = placed_bodies(job, machine, setup)?;
    contacts.bodies = compared;
    let (tools, index) = moving_tools(job)?;
    let Some(parts) = MachineParts::new(machine, setup.part_on_table, bodies, tools) else {
        contacts.not_compared =
            Some("its axes are not three linear and some rotary ones with the letters X Y Z A B C");
        return Ok(Some(contacts));
    };
    let tool = |segment: &Segment| {
        let at = job.tools.iter().position(|tool| Some(tool.number) == segment.tool)?;
        index[at].map(|(tool, _)| tool)
    };
    // Moves with the number of their segment.
    let mut watched: Vec<(u32, MachineMove<'_>)> = Vec::new();
    for (number, segment) in (0..).zip(&trace.segments) {
        match tool(segment) {
            Some(tool) => watched.push((number, MachineMove { segment, tool })),
            None => {
                let number = segment.tool.filter(|number| !contacts.without_length.contains(number));
                contacts.without_length.extend(number);
            }
        }
    }
    let begin = watched.iter().find_map(|(_, one)| Some((one.segment.item, parts.touching(one)?)));
    if let Some((item, touching)) = begin {
        (contacts.begins, contacts.touching) = (item, touching);
    }
    for some in watched.chunks(AT_ONCE) {
        let moves: Vec<MachineMove<'_>> = some.iter().map(|(_, one)| *one).collect();
        let met = parts.meetings(&moves, &contacts.touching, progress)?;
        let number = |i: u32| some[i as usize].0;
        let meetings = met.meetings.into_iter().map(|m| MachineMeeting { watched: number(m.watched), ..m });
        contacts.met.meetings.extend(meetings);
        contacts.met.lost.extend(met.lost.into_iter().map(number));
        contacts.met.sampled.extend(met.sampled.into_iter().map(number));
    }
    contacts.compared = watched.len() - contacts.met.lost.len();
    Ok(Some(contacts))
}

/// The tools that have a length, and for each tool its index among them with its length [mm].
#[expect(clippy::type_complexity, reason = "two lists that go together, taken apart at once")]
pub(super) fn moving_tools(job: &Job) -> Result<(Vec<ToolInSpindle>, Vec<Option<(u32, f64)>>)> {
    let (mut tools, mut index) = (Vec::new(), Vec::new());
    for tool in &job.tools {
        index.push(tool.gauge_length.map(|length| (tools.len() as u32, length)));
        if let Some(length) = tool.gauge_length {
            tools.push(ToolInSpindle { tool: moving(tool)?, length });
        }
    }
    Ok((tools, index))
}

/// The bodies of a machine in a setup, in the machine's coordinates with all axes at zero; the raw stock is the last.
pub(super) fn placed_bodies(
    job: &Job,
    machine: &Machine,
    setup: &Setup,
) -> Result<(Vec<LinkBody>, Vec<ComparedBody>)> {
    let (mut bodies, mut compared) = (Vec::new(), Vec::new());
    let off = job.uncertainty.unwrap_or_default();
    let tool_off = off.of_tool();
    for (i, body) in machine.bodies.iter().enumerate() {
        let name = body_name(machine, i);
        let solid = Body::new(name.clone(), &body.solid, body.place, body.near.max(LOOK).max(tool_off))
            .map(|body| body.off_by(tool_off))
            .map_err(|e| e.under(&format!("machine.body[{i}].mesh")))?;
        bodies.push(LinkBody { link: body.link, body: solid, of_machine: true });
        compared.push(ComparedBody { name, near: body.near, kind: BodyKind::Machine(i) });
    }
    let link = machine.work_link();
    for (i, fixture) in setup.fixtures.iter().enumerate() {
        let place = machine.work.after(&fixture.place);
        let near = fixture.near.max(LOOK).max(tool_off);
        let body = Body::new(fixture.name.clone(), &fixture.solid, place, near)?.off_by(tool_off);
        bodies.push(LinkBody { link, body, of_machine: false });
        let (name, near) = (fixture.name.clone(), fixture.near);
        compared.push(ComparedBody { name, near, kind: BodyKind::Fixture(i) });
    }
    let place: Rigid = machine.work.after(&setup.part_on_table);
    let body = Body::new("the stock", &job.stock, place, 0.0)?.off_by(off.of_raw());
    bodies.push(LinkBody { link, body, of_machine: false });
    compared.push(ComparedBody { name: "the stock".to_owned(), near: 0.0, kind: BodyKind::Stock });
    Ok((bodies, compared))
}

impl MachineContacts {
    /// A body as a sentence names it.
    fn named(&self, body: u32) -> String {
        let body = &self.bodies[body as usize];
        match body.kind {
            BodyKind::Machine(_) => format!("`{}` of the machine", body.name),
            BodyKind::Fixture(_) => format!("`{}`", body.name),
            BodyKind::Stock | BodyKind::StockThen => body.name.clone(),
        }
    }

    /// One of two that meet, as a sentence names it.
    pub(in crate::job) fn party(&self, party: Party) -> String {
        match party {
            Party::Tool(part) => format!("the {}", noun(part)),
            Party::Body(body) => self.named(body),
        }
    }

    /// Whether all bodies were compared in all moves.
    pub(in crate::job) fn is_whole(&self) -> bool {
        self.is_for_all_moves() && self.touching.is_empty()
    }

    /// Whether bodies were compared in all moves.
    pub(in crate::job) fn is_for_all_moves(&self) -> bool {
        self.not_compared.is_none() && self.met.lost.is_empty() && self.without_length.is_empty()
    }

    /// Whether nothing touches in the moves, nor where the program begins.
    pub(in crate::job) fn is_clear(&self) -> bool {
        self.touching.is_empty() && self.met.meetings.iter().all(|m| m.contact.is_none())
    }

    /// Least distance that two are to keep [mm].
    fn near(&self, meeting: &MachineMeeting) -> f64 {
        let own = match meeting.moving {
            Party::Body(i) => self.bodies[i as usize].near,
            Party::Tool(_) => 0.0,
        };
        own.max(self.bodies[meeting.standing as usize].near)
    }

    /// Whether a meeting is with the raw stock.
    pub(super) fn is_with_stock(&self, meeting: &MachineMeeting) -> bool {
        self.bodies[meeting.standing as usize].kind == BodyKind::Stock
    }

    /// Whether something meets the raw stock.
    pub(in crate::job) fn meets_stock(&self) -> bool {
        self.met.meetings.iter().any(|m| m.contact.is_some() && self.is_with_stock(m))
    }
}

/// Findings: pairs that touch where the program begins, contacts by block and pair, near passes by pair, each at the nearest block.
pub(in crate::job) fn findings(
    contacts: &MachineContacts,
    off: Option<Uncertainty>,
    trace: &Trace,
    place: impl Fn(u32) -> Option<Location>,
) -> Vec<Finding> {
    let pair = |m: &MachineMeeting| (m.moving, m.standing);
    let told = |m: &MachineMeeting, way: f64| (m.contact, way, m.distance);
    // Item, and the meeting that lasts longest or is nearest.
    let mut met: Vec<(u32, &MachineMeeting, f64)> = Vec::new();
    let mut near: Vec<&MachineMeeting> = Vec::new();
    // A tool that touches a body as soon as it is in the spindle.
    let mut changed: Vec<(u32, &MachineMeeting, ToolPart)> = Vec::new();
    for meeting in &contacts.met.meetings {
        let segment = &trace.segments[meeting.watched as usize];
        let Some(contact) = &meeting.contact else {
            let tool = |m: &MachineMeeting| match m.moving {
                Party::Tool(_) => trace.segments[m.watched as usize].tool,
                Party::Body(_) => None,
            };
            match near.iter_mut().find(|m| (pair(m), tool(m)) == (pair(meeting), tool(meeting))) {
                Some(known) if meeting.distance < known.distance - AS_NEAR => *known = meeting,
                Some(_) => {}
                None => near.push(meeting),
            }
            continue;
        };
        if let (Some(item), Party::Tool(part)) = (changed_before(trace, meeting.watched), meeting.moving)
            && contact.certain
            && contact.from == 0.0
            && !changed.iter().any(|(known, m, _)| (*known, pair(m)) == (item, pair(meeting)))
        {
            changed.push((item, meeting, part));
        }
        let way = segment.curve.length() * (contact.to - contact.from);
        // Meetings are in the order of the moves: those of one block are the last.
        let of_block = met.iter().rev().take_while(|(item, ..)| *item == segment.item).count();
        let from = met.len() - of_block;
        match met[from..].iter_mut().find(|(_, m, _)| pair(m) == pair(meeting)) {
            Some(known) if is_worse(told(meeting, way), told(known.1, known.2)) => {
                *known = (segment.item, meeting, way);
            }
            Some(_) => {}
            None => met.push((segment.item, meeting, way)),
        }
    }
    let touching = contacts.touching.iter().map(|[standing, moving]| {
        let (one, other) = (contacts.named(*moving), contacts.named(*standing));
        let finding =
            Finding::error(Code::BODIES_OVERLAP, format!("{one} touches {other} where the program begins"))
                .help("correct the form or the place of one of them, or put both on one link");
        (contacts.begins, finding)
    });
    let met = met.into_iter().map(|(item, meeting, way)| {
        let segment = &trace.segments[meeting.watched as usize];
        (item, contact((contacts, off), meeting, segment, way))
    });
    let warned = |meeting: &&MachineMeeting| meeting.distance < contacts.near(meeting);
    let passed = near.into_iter().filter(warned).map(|meeting| {
        let (one, other) = (contacts.party(meeting.moving), contacts.named(meeting.standing));
        let finding = Finding::warning(Code::MACHINE_NEAR, format!("{one} passes {other}"))
            .point(meeting.place.to_array())
            .value(meeting.distance, "mm apart")
            .bound(contacts.near(meeting), "mm, `near`")
            .help("an offset or a length may be off by no more than that");
        (trace.segments[meeting.watched as usize].item, finding)
    });
    let changed = changed.into_iter().map(|(item, meeting, part)| {
        let other = contacts.named(meeting.standing);
        let what = format!("the {} meets {other} as it comes into the spindle", noun(part));
        let finding = Finding::error(Code::MACHINE_MET, what).point(meeting.place.to_array());
        (item, finding.help("retract before the tool is changed"))
    });
    let mut all: Vec<(u32, Finding)> = touching.chain(changed).chain(met).chain(passed).collect();
    all.sort_by_key(|(item, _)| *item);
    let placed = |(item, finding): (u32, Finding)| Finding { place: place(item), ..finding };
    all.into_iter().map(placed).collect()
}

/// The finding of a contact.
fn contact(
    (contacts, off): (&MachineContacts, Option<Uncertainty>),
    meeting: &MachineMeeting,
    segment: &Segment,
    way: f64,
) -> Finding {
    let alone = if segment.alternative { " when the axes run one by one" } else { "" };
    let rapid = if segment.motion == SegmentPace::Rapid { " at rapid" } else { "" };
    let (one, other) = (contacts.party(meeting.moving), contacts.named(meeting.standing));
    let higher = meeting.contact.as_ref().and_then(|c| c.clears_by);
    let higher = higher.map(|lift| format!("; {:.2} mm higher it clears", hundredths(lift + 0.005)));
    let higher = higher.unwrap_or_default();
    let certain = meeting.contact.is_some_and(|contact| contact.certain);
    let finding = match contacts.is_with_stock(meeting) {
        true => {
            let what = format!("{one} comes where the stock was before the first cut{rapid}{alone}");
            let finding = match certain {
                true => Finding::doubt(Code::MACHINE_MET, what),
                false => may_meet(Code::MACHINE_MET, &what, meeting.distance, off),
            };
            finding.help(format!("make sure that it has been cut away there, or use a longer tool{higher}"))
        }
        false => {
            let what = format!("{one} meets {other}{rapid}{alone}");
            let finding = match certain {
                true => Finding::error(Code::MACHINE_MET, what),
                false => may_meet(Code::MACHINE_MET, &what, meeting.distance, off),
            };
            finding.help(format!(
                "use a longer tool, place the part elsewhere, or let the move go another way{higher}"
            ))
        }
    };
    let finding = finding.point(meeting.place.to_array());
    if certain && way > 0.0 { finding.value(hundredths(way), "mm of the move") } else { finding }
}
