//! Contacts of the machine's bodies with the raw stock, looked at again with the stock as it is at that moment.
//!
//! The stock only becomes less: a body that keeps away from it keeps away from then on, and one that meets it in the end has met it
//! all along. So a contact with the raw stock is an error if the body meets the stock that the setup leaves, or the stock right
//! behind the block, or that before it as the block begins; it is none if the body keeps away from the stock right before the block, or before an earlier one. Where neither
//! is sure, the contact stays a doubt.

use std::collections::BTreeMap;

use super::super::check::Job;
use super::super::closer::Story;
use super::super::raw::{drill, raw_stock, take_out};
use super::super::replay::{Part, parts};
use super::machine::{BodyKind, ComparedBody, MachineContacts, moving_tools, placed_bodies};
use crate::base::{Progress, Result};
use crate::contact::{Body, Contact, LinkBody, MachineMeeting, MachineMove, MachineParts, Party};
use crate::geom::{Mesh, Solid};
use crate::stock::TriDexel;
use crate::stock::cut::{CutOptions, cut};
use crate::stock::surface::{SurfaceOptions, surface};

/// Most lines of the stock that is looked at: its surface takes a hundred thousand triangles.
const MOST_LINES: u64 = 30_000;
/// Triangles of a surface for each line of its stock: ground that is rough all over has 2.2, parts with flat faces less than one.
const TRIANGLES: u64 = 4;
/// Times that the stock of a setup is looked at between its moves, and most contacts that are compared in them.
const MOST_LOOKS: usize = 12;
const MOST_COMPARED: usize = 40_000;
/// Most contacts of a setup that are settled, the first of them; more than these are a program that has to be changed anyway.
const MOST: usize = 20_000;
/// Distance that the stock keeps from what is said not to meet it [steps].
const ROOM: f64 = 1.5;
/// A step is made so much coarser at a time.
const COARSER: f64 = 1.1;

/// The stock by which contacts with the raw stock were settled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StockThen {
    /// Distance between its lines [mm].
    pub step: f64,
    /// Contacts with the raw stock that are none with the stock at that moment.
    pub cleared: usize,
}

impl StockThen {
    /// Distance that the stock keeps at least where it is said not to be met [mm].
    pub fn room(&self) -> f64 {
        ROOM * self.step
    }
}

/// Settles the contacts of all setups with the raw stock, as far as that can be.
pub(in crate::job) fn settle(
    story: &Story<'_>,
    contacts: &mut [Option<MachineContacts>],
    progress: &dyn Progress,
) -> Result<()> {
    // The stock at a moment is not known where tools and zeros may be off.
    if story.job.uncertainty.is_some() {
        return Ok(());
    }
    let mut setups: Vec<Setup<'_>> = Vec::new();
    for (i, contacts) in contacts.iter_mut().enumerate() {
        if let Some(contacts) = contacts.as_mut().filter(|c| c.meets_stock()) {
            setups.extend(Setup::new(story, i, contacts)?);
        }
    }
    if setups.is_empty() {
        return Ok(());
    }
    let step = step(story.job);
    let count: u64 = story.moves.iter().map(|list| list.moves().len() as u64).sum();
    progress.stage("stock at contacts of the machine", 2 * count);
    // What a setup leaves is there at each of its blocks.
    let mut replay = Replay::new(story, step)?;
    for setup in &mut setups {
        replay.to(setup.index, usize::MAX, progress)?;
        let left = |_, found: Found| if found.is_sure() { Answer::Met } else { Answer::Open };
        setup.meet(&replay.surface(progress)?, left, (step, progress))?;
    }
    let open = |setups: &[Setup<'_>]| setups.iter().any(|s| s.first_open().is_some());
    if open(&setups) {
        let mut replay = Replay::new(story, step)?;
        for setup in &mut setups {
            let mut compared = 0;
            for _ in 0..MOST_LOOKS {
                let Some(first) = setup.first_open().filter(|_| compared < MOST_COMPARED) else { break };
                compared += setup.own.iter().filter(|(_, answer)| *answer == Answer::Open).count();
                replay.to(setup.index, first as usize, progress)?;
                let before = |watched, found| match found {
                    Found::Away => Answer::Clear,
                    // As the block begins the stock is as it was before.
                    Found::FromStart if watched == first => Answer::Met,
                    _ => Answer::Open,
                };
                setup.meet(&replay.surface(progress)?, before, (step, progress))?;
                // The same one may be open no longer.
                if setup.first_open() == Some(first) {
                    replay.to(setup.index, first as usize + 1, progress)?;
                    let behind = |watched, found| match found {
                        _ if found.is_sure() && watched == first => Answer::Met,
                        Found::Away if watched > first => Answer::Clear,
                        _ => Answer::Open,
                    };
                    setup.meet(&replay.surface(progress)?, behind, (step, progress))?;
                    setup.leave(first);
                }
            }
        }
    }
    setups.into_iter().for_each(|setup| setup.note(step));
    Ok(())
}

/// A step at which the stock has not too many lines, the job's own if that does.
fn step(job: &Job) -> f64 {
    let mut step = job.step;
    while TriDexel::lines(job.stock.bounds(), step) > MOST_LINES {
        step *= COARSER;
    }
    step
}

/// Memory of that stock, of its surface, and of a body of that [bytes].
pub(super) fn memory(job: &Job) -> u64 {
    let (bounds, step) = (job.stock.bounds(), step(job));
    let triangles = TRIANGLES * TriDexel::lines(bounds, step);
    TriDexel::memory(bounds, step)
        .saturating_add(TriDexel::surface_memory(bounds, step))
        .saturating_add(Body::memory_of_mesh(triangles as usize))
}

/// An answer about a contact with the raw stock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Answer {
    /// Not known yet.
    Open,
    /// The stock is there at that moment.
    Met,
    /// It is not.
    Clear,
    /// It may be: looked at, and neither.
    Doubt,
}

/// A comparison with one stock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Found {
    /// The body meets it as the move begins.
    FromStart,
    /// The body meets it later.
    Surely,
    /// The body comes nearer than is sure to be none.
    Near,
    /// The body keeps away.
    Away,
}

impl Found {
    fn is_sure(self) -> bool {
        matches!(self, Found::FromStart | Found::Surely)
    }
}

/// The contacts of a setup with the raw stock.
struct Setup<'a> {
    story: &'a Story<'a>,
    index: usize,
    contacts: &'a mut MachineContacts,
    /// The bodies that meet the raw stock, with their numbers, and the raw stock.
    moving: Vec<(u32, LinkBody)>,
    raw: LinkBody,
    /// The contacts, with their answers and the meeting with the stock at that moment.
    own: Vec<(MachineMeeting, Answer)>,
}

impl<'a> Setup<'a> {
    fn new(
        story: &'a Story<'a>,
        index: usize,
        contacts: &'a mut MachineContacts,
    ) -> Result<Option<Setup<'a>>> {
        let own: Vec<_> = (contacts.met.meetings.iter())
            .filter(|m| m.contact.is_some() && contacts.is_with_stock(m))
            .take(MOST)
            .map(|m| (m.clone(), Answer::Open))
            .collect();
        let is_own = |body: &u32| own.iter().any(|(m, _)| m.moving == Party::Body(*body));
        let (Some(machine), false) = (&story.job.machine, own.is_empty()) else { return Ok(None) };
        let (mut bodies, _) = placed_bodies(story.job, machine, &story.job.setups[index].setup)?;
        let Some(raw) = bodies.pop() else { return Ok(None) };
        let moving = (0..).zip(bodies).filter(|(body, _)| is_own(body)).collect();
        Ok(Some(Setup { story, index, contacts, moving, raw, own }))
    }

    /// The first move whose contact is not settled.
    fn first_open(&self) -> Option<u32> {
        self.own.iter().filter(|(_, a)| *a == Answer::Open).map(|(m, _)| m.watched).min()
    }

    /// The contacts of a move that has been looked at stay doubts where they are open.
    fn leave(&mut self, watched: u32) {
        for (m, answer) in &mut self.own {
            if m.watched == watched && *answer == Answer::Open {
                *answer = Answer::Doubt;
            }
        }
    }

    /// Compares all that is open with a stock; a function answers by the move and what was found.
    fn meet(
        &mut self,
        stock: &Mesh,
        answer: impl Fn(u32, Found) -> Answer,
        (step, progress): (f64, &dyn Progress),
    ) -> Result<()> {
        let open: Vec<usize> = (0..self.own.len()).filter(|i| self.own[*i].1 == Answer::Open).collect();
        if open.is_empty() {
            return Ok(());
        }
        let job = self.story.job;
        let setup = &job.setups[self.index].setup;
        let trace = self.story.traces[self.index];
        let Some(machine) = &job.machine else { return Ok(()) };
        if stock.triangles.is_empty() {
            for i in open {
                let (known, of) = &mut self.own[i];
                *of = answer(known.watched, Found::Away);
            }
            return Ok(());
        }
        let place = machine.work.after(&setup.part_on_table);
        let body = Body::new(self.raw.body.name.clone(), &Solid::Mesh(stock.clone()), place, 0.0)?;
        let stock = LinkBody { body: body.off_by(ROOM * step), ..self.raw.clone() };
        let bodies: Vec<LinkBody> = self.moving.iter().map(|(_, body)| body.clone()).chain([stock]).collect();
        let standing = self.moving.len() as u32;
        let (tools, index) = moving_tools(job)?;
        let Some(parts) = MachineParts::new(machine, setup.part_on_table, bodies, tools) else {
            return Ok(());
        };
        let mut watched: Vec<u32> = open.iter().map(|i| self.own[*i].0.watched).collect();
        watched.dedup();
        let tool = |number: u32| {
            let segment = &trace.segments[number as usize];
            let at = job.tools.iter().position(|tool| Some(tool.number) == segment.tool)?;
            index[at].map(|(tool, _)| MachineMove { segment, tool })
        };
        let moves: Vec<MachineMove<'_>> = watched.iter().filter_map(|number| tool(*number)).collect();
        if moves.len() < watched.len() {
            return Ok(());
        }
        let met = parts.meetings(&moves, &[], progress)?;
        let mut again: BTreeMap<(u32, u32), &MachineMeeting> = BTreeMap::new();
        for m in met.meetings.iter().filter(|m| m.standing == standing && m.contact.is_some()) {
            if let Party::Body(body) = m.moving {
                again.insert((watched[m.watched as usize], self.moving[body as usize].0), m);
            }
        }
        for i in open {
            let (known, of) = &mut self.own[i];
            let Party::Body(moving) = known.moving else { continue };
            let again = again.get(&(known.watched, moving)).copied();
            let found = match again {
                Some(again) if again.is_certain() => {
                    let begins = again.contact.is_some_and(|contact| contact.from == 0.0);
                    if begins { Found::FromStart } else { Found::Surely }
                }
                Some(_) => Found::Near,
                None => Found::Away,
            };
            *of = answer(known.watched, found);
            if let (Answer::Met, Some(again)) = (*of, again) {
                // What clears the raw stock clears this one.
                let clears_by = known.contact.and_then(|contact| contact.clears_by);
                let contact = again.contact.map(|contact| Contact { clears_by, ..contact });
                let place = again.place;
                *known = MachineMeeting { place, distance: again.distance, contact, ..known.clone() };
            }
        }
        Ok(())
    }

    /// Takes the answers into the contacts.
    fn note(self, step: f64) {
        let Setup { contacts, own, .. } = self;
        let cleared = own.iter().filter(|(_, answer)| *answer == Answer::Clear).count();
        let then = contacts.bodies.len() as u32;
        let mut answers = own.into_iter();
        let mut kept = Vec::with_capacity(contacts.met.meetings.len());
        for meeting in std::mem::take(&mut contacts.met.meetings) {
            let open = meeting.contact.is_some() && contacts.is_with_stock(&meeting);
            match if open { answers.next() } else { None } {
                Some((_, Answer::Clear)) => {}
                Some((again, Answer::Met)) => kept.push(MachineMeeting { standing: then, ..again }),
                _ => kept.push(meeting),
            }
        }
        contacts.met.meetings = kept;
        contacts.bodies.push(ComparedBody {
            name: "the stock".to_owned(),
            near: 0.0,
            kind: BodyKind::StockThen,
        });
        contacts.stock_then = Some(StockThen { step, cleared });
    }
}

/// A job's programs once more, up to a move.
struct Replay<'a> {
    story: &'a Story<'a>,
    parts: Vec<Part<'a>>,
    /// The part that comes next, and the moves of it that are done.
    at: (usize, usize),
    /// Moves of the setup of that part before it.
    before: usize,
    stock: TriDexel,
}

impl<'a> Replay<'a> {
    fn new(story: &'a Story<'a>, step: f64) -> Result<Replay<'a>> {
        let mut stock = raw_stock(&story.job.stock, step)?;
        drill(&mut stock, story.job)?;
        Ok(Replay { story, parts: parts(story), at: (0, 0), before: 0, stock })
    }

    /// All before a move of a setup is cut, no less than it is.
    fn to(&mut self, setup: usize, index: usize, progress: &dyn Progress) -> Result<()> {
        while let Some(part) = self.parts.get(self.at.0) {
            match part {
                Part::Moves(of, _) if *of > setup => return Ok(()),
                Part::Moves(of, moves) => {
                    let wanted = if *of < setup { moves.len() } else { index.saturating_sub(self.before) };
                    let to = wanted.min(moves.len()).max(self.at.1);
                    let some = &moves[self.at.1..to];
                    cut(&mut self.stock, self.story.bodies, some, &CutOptions::default(), progress)?;
                    self.at.1 = to;
                    if to < moves.len() {
                        return Ok(());
                    }
                    let next_setup =
                        matches!(self.parts.get(self.at.0 + 1), Some(Part::Moves(next, _)) if next != of);
                    self.before = if next_setup { 0 } else { self.before + moves.len() };
                }
                Part::Core(core, number) => take_out(&mut self.stock, core, *number)?,
            }
            self.at = (self.at.0 + 1, 0);
        }
        Ok(())
    }

    fn surface(&self, progress: &dyn Progress) -> Result<Mesh> {
        surface(&self.stock, &SurfaceOptions::default(), progress)
    }
}
