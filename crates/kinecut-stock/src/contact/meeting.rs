//! All moves past all bodies.

use glam::DVec3;
use rayon::prelude::*;

use super::body::Body;
use super::clearance::Clearances;
use super::motion::{Moment, Motion};
use super::nearest_of::NearestOf;
use super::pair::{Pair, TOUCH, Touch, clearing, may_meet};
use super::search::Nearest;
use super::tool::{MovingTool, ToolPart};
use crate::base::{Code, Finding, Progress, Result};
use crate::geom::Aabb;
use crate::sweep::ToolMotion;

/// Most contacts whose lift is sought.
pub(super) const MOST_LIFTS: usize = 1000;
/// Moves of a task.
pub(super) const TASK: usize = 256;

/// A move that is watched.
#[derive(Clone, Debug)]
pub struct Watched {
    /// The motion of the tool.
    pub motion: ToolMotion,
    /// Index of the tool.
    pub tool: u32,
}

impl Watched {
    /// Memory of one [bytes].
    pub const BYTES: u64 = size_of::<Watched>() as u64;
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
    /// Least distance [mm]; zero in a contact that is certain.
    pub distance: f64,
    /// The contact, if it is one.
    pub contact: Option<Contact>,
}

impl Meeting {
    /// Whether it is a contact of bodies where they are said to be.
    pub fn is_certain(&self) -> bool {
        self.contact.is_some_and(|contact| contact.certain)
    }
}

/// A contact over a part of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The bodies meet where they are said to be; else they pass nearer than one of them may be off ([`Body::off`]).
    pub certain: bool,
    /// Part of the move, from 0 to 1, at which it begins.
    pub from: f64,
    /// Part of the move at which it ends for the last time.
    pub to: f64,
    /// Lift of the whole move along `up` with which the tool clears the body [mm]; sought for the first thousand moves that meet one.
    pub clears_by: Option<f64>,
}

/// All contacts of tools with bodies, in the order of the moves, bodies and parts, then the nearest pass of each tool, body and part in
/// moves without a contact of them. Bodies and motions are in the same coordinates, and `up` is the direction in which a tool clears what
/// it meets.
///
/// # Errors
/// `KC0009` when cancelled.
pub fn meetings(
    tools: &[MovingTool],
    bodies: &[Body],
    moves: &[Watched],
    up: DVec3,
    progress: &dyn Progress,
) -> Result<Vec<Meeting>> {
    progress.stage("contacts", moves.len() as u64);
    let all =
        bodies.iter().fold(Aabb::EMPTY, |sum, body| sum.union(body.bounds.grown(body.near.max(body.off))));
    let task = |(n, moves): (usize, &[Watched])| {
        let mut found = Vec::new();
        let mut kept = Kept { near: NearestOf::new(), clear: Clearances::new() };
        if progress.cancelled() {
            return (found, kept.near);
        }
        for (i, watched) in moves.iter().enumerate() {
            let tool = &tools[watched.tool as usize];
            one_move((n * TASK + i) as u32, watched, tool, (bodies, all), (&mut found, &mut kept));
        }
        progress.advance(moves.len() as u64);
        (found, kept.near)
    };
    let tasks: Vec<_> = moves.chunks(TASK).enumerate().collect();
    let parts: Vec<_> = tasks.into_par_iter().map(task).collect();
    cancelled(progress)?;
    let (mut found, mut near) = (Vec::new(), NearestOf::new());
    for (contacts, passes) in parts {
        found.extend(contacts);
        near.join(passes);
    }
    let mut met: Vec<(u32, u32)> = found.iter().map(|m: &Meeting| (m.watched, m.body)).collect();
    met.dedup();
    met.truncate(MOST_LIFTS);
    let lift = |(index, body): &(u32, u32)| {
        let watched = &moves[*index as usize];
        let tool = &tools[watched.tool as usize];
        clearing(&watched.motion, tool.bodies(), &bodies[*body as usize], up)
    };
    let lifts: Vec<f64> = met.par_iter().map(lift).collect();
    for meeting in &mut found {
        if let (Some(contact), Ok(at)) =
            (&mut meeting.contact, met.binary_search(&(meeting.watched, meeting.body)))
        {
            contact.clears_by = Some(lifts[at]);
        }
    }
    found.extend(near.into_passes());
    Ok(found)
}

/// Distance up to which bodies are looked for that may be `off`; none where all is where it is said to be [mm].
pub(super) fn reach(off: f64) -> f64 {
    if off > 0.0 { off + TOUCH } else { 0.0 }
}

/// The contact of a pair, one of which may be `off` [mm]: a certain one, or else one that may be; with its distance and place.
pub(super) fn contact<M: Motion>(
    pair: &Pair<'_, M>,
    ends: &[Moment; 2],
    off: f64,
) -> Option<(Contact, Nearest)> {
    let of = |touch: Touch, certain| Contact { certain, from: touch.from, to: touch.to, clears_by: None };
    if let Some(touch) = pair.touch(ends, 0.0) {
        return Some((of(touch, true), Nearest { t: touch.from, distance: 0.0, place: touch.place }));
    }
    let touch = if off > 0.0 { pair.touch(ends, off) } else { None }?;
    // No nearer than it was found to be, and none where the search for a distance ends just above.
    let nearest = pair.nearest(ends, reach(off) + TOUCH);
    let nearest = nearest.unwrap_or(Nearest { t: touch.from, distance: off, place: touch.place });
    Some((of(touch, false), nearest))
}

/// The error of a search that was cancelled.
pub(super) fn cancelled(progress: &dyn Progress) -> Result<()> {
    match progress.cancelled() {
        true => Err(Finding::error(Code::CANCELLED, "the search for contacts was cancelled").into()),
        false => Ok(()),
    }
}

/// A tool, a body and a part of the tool.
type Two = (u32, u32, ToolPart);

/// Distances that serve later moves.
struct Kept {
    near: NearestOf<Two, Meeting>,
    clear: Clearances<Two>,
}

/// Contacts and passes of the parts of a tool with bodies in one move; `all` holds all bodies.
fn one_move(
    watched: u32,
    Watched { motion, tool: number }: &Watched,
    tool: &MovingTool,
    (bodies, all): (&[Body], Aabb),
    (found, Kept { near, clear }): (&mut Vec<Meeting>, &mut Kept),
) {
    let ends = [0.0, 1.0].map(|t| Moment::of(motion, t));
    let near_all = |(_, part): &&(ToolPart, Body)| may_meet(motion, part, &ends, all, TOUCH);
    let parts: Vec<&(ToolPart, Body)> = tool.parts.iter().filter(near_all).collect();
    if parts.is_empty() {
        return;
    }
    let mut cleared = Vec::new();
    for (body, standing) in (0..).zip(bodies) {
        let first = found.len();
        cleared.clear();
        for (part, moving) in &parts {
            let pair = Pair { motion, moving, standing };
            let two = (*number, body, *part);
            let open = near.open(two, standing.near).max(reach(standing.off));
            let near_it = may_meet(motion, moving, &ends, standing.bounds, open.max(TOUCH));
            if !near_it || clear.clear(two, &pair, &ends, open) {
                cleared.push(*part);
                continue;
            }
            if let Some((contact, Nearest { distance, place, .. })) = contact(&pair, &ends, standing.off) {
                let (part, contact) = (*part, Some(contact));
                found.push(Meeting { watched, body, part, place, distance, contact });
            }
        }
        for (part, moving) in &parts {
            let part = *part;
            let open = near.open((*number, body, part), standing.near);
            if open <= 0.0 || cleared.contains(&part) || found[first..].iter().any(|m| m.part == part) {
                continue;
            }
            let pair = Pair { motion, moving, standing };
            if let Some(Nearest { distance, place, .. }) = pair.nearest(&ends, open) {
                let pass = Meeting { watched, body, part, place, distance, contact: None };
                near.note((*number, body, part), distance, pass);
            }
        }
    }
}
