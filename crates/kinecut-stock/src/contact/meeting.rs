//! All moves past all bodies.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::body::{Piece, StandingBody};
use super::gap::Convex;
use super::search::{Moment, Search, moment};
use super::tool::{Between, MovingTool, Placed, Round, ToolPart};
use crate::base::{Code, Finding, Progress, Result};
use crate::geom::Aabb;
use crate::sweep::ToolMotion;

/// Distance [mm] up to which bodies touch: with the travel of a stretch no part is reported that stays 0.01 mm away.
const TOUCH: f64 = 0.005;
/// Distance [mm] of a tool from the hull of its places in a stretch that the boxes of the bodies are asked with.
const ROOM: f64 = 0.5;
/// Most stretches of a move for that.
const MOST_STRETCHES: f64 = 4096.0;
/// Accuracy of the lift that clears a body [mm].
const LIFT: f64 = 0.01;
/// Most contacts whose lift is sought.
const MOST_LIFTS: usize = 1000;
/// Moves of a task.
const TASK: usize = 256;

/// A move that is watched.
#[derive(Clone, Debug)]
pub struct Watched {
    /// The motion of the tool.
    pub motion: ToolMotion,
    /// Index of the tool.
    pub tool: u32,
}

/// A part of a tool that meets a body in a move, or comes nearer than the body allows.
#[derive(Clone, Debug, PartialEq)]
pub struct Meeting {
    /// Index of the move.
    pub watched: u32,
    /// Index of the body.
    pub body: u32,
    /// The part of the tool.
    pub part: ToolPart,
    /// A place of the body that is met first, or is nearest [mm].
    pub place: DVec3,
    /// Least distance [mm]; zero in a contact.
    pub distance: f64,
    /// The contact, if it is one.
    pub contact: Option<Contact>,
}

/// A contact over a part of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Part of the move, from 0 to 1, at which it begins.
    pub from: f64,
    /// Part of the move at which it ends for the last time.
    pub to: f64,
    /// Lift of the whole move along `up` with which the tool clears the body [mm]; sought for the first thousand moves that meet one.
    pub clears_by: Option<f64>,
}

/// All meetings of tools with bodies, in the order of the moves, bodies and parts; bodies and motions are in the same
/// coordinates, and `up` is the direction in which a tool clears what it meets.
///
/// # Errors
/// `KC0009` when cancelled.
pub fn meetings(
    tools: &[MovingTool],
    bodies: &[StandingBody],
    moves: &[Watched],
    up: DVec3,
    progress: &dyn Progress,
) -> Result<Vec<Meeting>> {
    progress.stage("contacts", moves.len() as u64);
    let all = bodies.iter().fold(Aabb::EMPTY, |sum, body| sum.union(body.bounds.grown(body.near)));
    let task = |(n, moves): (usize, &[Watched])| {
        if progress.cancelled() {
            return Vec::new();
        }
        let mut found = Vec::new();
        let mut stretches = Stretches::default();
        for (i, watched) in moves.iter().enumerate() {
            let tool = &tools[watched.tool as usize];
            stretches.set(&watched.motion, tool, DVec3::ZERO);
            let one = OneMove { watched, tool, bodies, up };
            one.meetings((n * TASK + i) as u32, &stretches, all, &mut found);
        }
        progress.advance(moves.len() as u64);
        found
    };
    let tasks: Vec<_> = moves.chunks(TASK).enumerate().collect();
    let found: Vec<Vec<Meeting>> = tasks.into_par_iter().map(task).collect();
    if progress.cancelled() {
        return Err(Finding::error(Code::CANCELLED, "the search for contacts was cancelled").into());
    }
    let mut found: Vec<Meeting> = found.into_iter().flatten().collect();
    let mut met: Vec<(u32, u32)> =
        found.iter().filter(|m| m.contact.is_some()).map(|m| (m.watched, m.body)).collect();
    met.dedup();
    met.truncate(MOST_LIFTS);
    let lift = |(index, body): &(u32, u32)| {
        let watched = &moves[*index as usize];
        let one = OneMove { watched, tool: &tools[watched.tool as usize], bodies, up };
        one.clearing(&bodies[*body as usize])
    };
    let lifts: Vec<f64> = met.par_iter().map(lift).collect();
    for meeting in &mut found {
        if let (Some(contact), Ok(at)) =
            (&mut meeting.contact, met.binary_search(&(meeting.watched, meeting.body)))
        {
            contact.clears_by = Some(lifts[at]);
        }
    }
    Ok(found)
}

/// A move with what it may meet.
struct OneMove<'a> {
    watched: &'a Watched,
    tool: &'a MovingTool,
    bodies: &'a [StandingBody],
    up: DVec3,
}

/// A stretch of a move.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    ends: [Moment; 2],
    /// Distance of the tool from the hull of its places at the ends [mm].
    room: f64,
    /// A box that holds the whole tool in it.
    bounds: Aabb,
}

/// Stretches of a move in each of which the tool keeps near the hull of its places, with boxes of its parts.
#[derive(Debug, Default)]
struct Stretches {
    all: Vec<Stretch>,
    /// Of each part in each stretch, stretch by stretch.
    boxes: Vec<Aabb>,
}

impl Stretches {
    /// Those of a move whose tool is lifted.
    fn set(&mut self, motion: &ToolMotion, tool: &MovingTool, lift: DVec3) {
        self.all.clear();
        self.boxes.clear();
        let error = motion.chord_error(0.0, 1.0, tool.reach);
        let count = (error / ROOM).sqrt().ceil().clamp(1.0, MOST_STRETCHES) as u32;
        let mut from = moment(motion, lift, 0.0);
        for i in 1..=count {
            let to = moment(motion, lift, f64::from(i) / f64::from(count));
            let room = if count == 1 { error } else { motion.chord_error(from.t, to.t, tool.reach) };
            let ends = [from, to];
            let first = self.boxes.len();
            self.boxes.extend(tool.rounds.iter().map(|round| round_box(round, &ends, room)));
            let bounds = self.boxes[first..].iter().fold(Aabb::EMPTY, |sum, b| sum.union(*b));
            self.all.push(Stretch { ends, room, bounds });
            from = to;
        }
    }

    /// Stretches with the box of one of the tool's parts, of how many.
    fn of_round(&self, round: usize, rounds: usize) -> impl Iterator<Item = (&Stretch, Aabb)> {
        self.all.iter().enumerate().map(move |(i, stretch)| (stretch, self.boxes[i * rounds + round]))
    }
}

impl OneMove<'_> {
    fn meetings(&self, index: u32, stretches: &Stretches, all: Aabb, found: &mut Vec<Meeting>) {
        if !stretches.all.iter().any(|s| s.bounds.meets(all)) {
            return;
        }
        for (b, body) in self.bodies.iter().enumerate() {
            let region = body.bounds.grown(body.near + TOUCH);
            if !stretches.boxes.iter().any(|bounds| bounds.meets(region)) {
                continue;
            }
            let first = found.len();
            for (part, (from, to, place)) in self.contacts(body, stretches, DVec3::ZERO) {
                let contact = Some(Contact { from, to, clears_by: None });
                found.push(Meeting { watched: index, body: b as u32, part, place, distance: 0.0, contact });
            }
            if body.near > 0.0 {
                let met: Vec<ToolPart> = found[first..].iter().map(|m| m.part).collect();
                for (part, (distance, place)) in self.near(body, stretches, &met) {
                    let contact = None;
                    found.push(Meeting { watched: index, body: b as u32, part, place, distance, contact });
                }
            }
        }
    }

    /// For each part that meets a body the times of its first and last contact, and the place of the first.
    fn contacts(
        &self,
        body: &StandingBody,
        stretches: &Stretches,
        lift: DVec3,
    ) -> BTreeMap<ToolPart, (f64, f64, DVec3)> {
        let mut met: BTreeMap<ToolPart, (f64, f64, DVec3)> = BTreeMap::new();
        let rounds = &self.tool.rounds;
        let ends = [stretches.all[0].ends[0], stretches.all[stretches.all.len() - 1].ends[1]];
        for (r, round) in rounds.iter().enumerate() {
            // Within a body of triangles, away from all of them.
            let [begin, end] = ends.map(|end| end.pose.point(DVec3::Z * round.lowest()));
            let within = [begin, end].map(|p| body.has_inside(p));
            if within != [false; 2] {
                let known = met.get(&round.part);
                let from = if within[0] { 0.0 } else { known.map_or(1.0, |k| k.0) };
                let to = if within[1] { 1.0 } else { known.map_or(0.0, |k| k.1) };
                met.insert(round.part, (from, to, if within[0] { begin } else { end }));
            }
            for (stretch, bounds) in stretches.of_round(r, rounds.len()) {
                let [start, end] = stretch.ends;
                body.pieces_in(bounds.grown(TOUCH), |piece| {
                    let search = self.search(round, piece, lift);
                    let known = met.get(&round.part).copied();
                    // Only what is sooner than the first, and later than the last.
                    if known.is_none_or(|(from, ..)| start.t < from)
                        && let Some((t, place)) = search.touch([start, end], TOUCH, false)
                        && known.is_none_or(|(from, ..)| t < from)
                    {
                        let to = known.map_or(t, |(_, to, _)| to);
                        met.insert(round.part, (t, to, place));
                    }
                    if let Some((from, to, place)) = met.get(&round.part).copied()
                        && end.t > to
                        && let Some((t, _)) = search.touch([start, end], TOUCH, true)
                        && t > to
                    {
                        met.insert(round.part, (from, t, place));
                    }
                    false
                });
            }
        }
        met
    }

    /// For each part that comes nearer than a body allows, and is not among those that meet it, the least distance and its place.
    fn near(
        &self,
        body: &StandingBody,
        stretches: &Stretches,
        met: &[ToolPart],
    ) -> BTreeMap<ToolPart, (f64, DVec3)> {
        let mut nearest: BTreeMap<ToolPart, (f64, DVec3)> = BTreeMap::new();
        let rounds = &self.tool.rounds;
        for (r, round) in rounds.iter().enumerate().filter(|(_, round)| !met.contains(&round.part)) {
            for (stretch, bounds) in stretches.of_round(r, rounds.len()) {
                body.pieces_in(bounds.grown(body.near), |piece| {
                    let best = nearest.get(&round.part).map_or(body.near, |n| n.0);
                    let search = self.search(round, piece, DVec3::ZERO);
                    if let Some(found) = search.nearest(stretch.ends, best) {
                        nearest.insert(round.part, found);
                    }
                    false
                });
            }
        }
        nearest
    }

    /// The lift with which the whole tool clears a body [mm].
    fn clearing(&self, body: &StandingBody) -> f64 {
        let mut stretches = Stretches::default();
        stretches.set(&self.watched.motion, self.tool, DVec3::ZERO);
        let low = |stretch: &Stretch, round: &Round| {
            between(round, &stretch.ends).farthest(-self.up).dot(self.up) - stretch.room
        };
        let of_stretch = |stretch| self.tool.rounds.iter().map(move |round| low(stretch, round));
        let lowest = stretches.all.iter().flat_map(of_stretch).fold(f64::INFINITY, f64::min);
        let corner = DVec3::select(self.up.cmpge(DVec3::ZERO), body.bounds.max, body.bounds.min);
        // Above all of the body it clears; in between it is sought where it begins to.
        let (mut meets, mut clears) = (0.0, (corner.dot(self.up) - lowest + 2.0 * LIFT).max(LIFT));
        let mut lifted = Stretches::default();
        while clears - meets > LIFT {
            let lift = 0.5 * (meets + clears);
            lifted.set(&self.watched.motion, self.tool, self.up * lift);
            match self.contacts(body, &lifted, self.up * lift).is_empty() {
                true => clears = lift,
                false => meets = lift,
            }
        }
        clears
    }

    fn search<'a>(&'a self, round: &'a Round, piece: &'a Piece, lift: DVec3) -> Search<'a> {
        Search { motion: &self.watched.motion, round, reach: self.tool.reach, piece, lift }
    }
}

fn between<'a>(round: &'a Round, ends: &[Moment; 2]) -> Between<'a> {
    Between(ends.map(|end| Placed { round, pose: end.pose }))
}

/// A box that holds a part in a stretch.
fn round_box(round: &Round, [from, to]: &[Moment; 2], room: f64) -> Aabb {
    let begin = round.bounds(&from.pose);
    let end = match from.pose.rotation == to.pose.rotation {
        true => {
            let by = to.pose.translation - from.pose.translation;
            Aabb { min: begin.min + by, max: begin.max + by }
        }
        false => round.bounds(&to.pose),
    };
    begin.union(end).grown(room)
}
