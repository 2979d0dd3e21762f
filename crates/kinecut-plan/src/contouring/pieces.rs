//! Open pieces of the loops of an outline: where the cutter's path runs beside them, and the cut along it with a lead at each end.

use std::f64::consts::FRAC_PI_2;

use glam::DVec2;

use super::lead::Lead;
use super::plan::{LEAST_LEAD, PlannedLoop, Planner};
use super::room::{nearer, reaching};
use super::stretches::{LoopStretches, loop_length};
use super::track::Track;
use super::travel::Stretch;
use crate::base::{Code, Finding, Result};
use crate::geom::{NearestEdge, Outline, OutlineEdge};
use crate::holes::{ToolpathPace, ToolpathRole};

/// A piece of a loop of an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlinePiece {
    /// Index of the loop.
    pub of_loop: usize,
    /// From and to along the loop in its direction, from its first point; the second lies beyond the first, by the length of the
    /// loop at most, and may lie beyond its end [mm].
    pub along: [f64; 2],
}

/// A cut without a break along pieces of the outline.
#[derive(Clone, Debug, PartialEq)]
pub struct CutPiece {
    /// Index of the first of its moves: the way there.
    pub first_move: usize,
    /// The stretches of the outline beside which the path runs, in its direction: those of one piece, or of several that meet. Where
    /// a lead finds no room the path goes on beyond them.
    pub beside: Vec<OutlinePiece>,
    /// Whether the path is all of its loop.
    pub closed: bool,
}

/// A stretch of a track beside pieces that meet.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    /// From and to along the track [mm].
    pub(super) along: [f64; 2],
    /// The stretches of the outline beside it; fewer than the pieces where the path does not come to them, before inside corners.
    pub(super) beside: Vec<OutlinePiece>,
}

/// Gap between stretches that is rounding [mm].
const ROUNDING: f64 = 1e-7;
/// Shorter runs are left out [mm].
const LEAST_RUN: f64 = 1e-3;
/// Steps by which an end is moved farther along where its lead finds no room, and their number.
const FARTHER: (f64, u32) = (0.5, 24);

/// The stretch of a loop beside which an edge of a track runs, from its start to its end, or the corner about which it runs.
#[derive(Clone, Copy, Debug)]
struct Beside {
    of_loop: usize,
    /// Places along the loop [mm]; the same where it runs about a corner.
    at: [f64; 2],
}

/// The runs of a track beside pieces, along it.
pub(super) fn runs(
    track: &Track,
    outline: &Outline,
    near: &NearestEdge,
    pieces: &[OutlinePiece],
) -> Vec<Run> {
    let mut found: Vec<Run> = Vec::new();
    for (i, edge) in track.edges().iter().enumerate() {
        let Some(Beside { of_loop, at: [u0, u1] }) = beside(edge, outline, near) else { continue };
        let stretch = track.stretch(i);
        let place = |u: f64| stretch[0] + (u - u0) / (u1 - u0) * (stretch[1] - stretch[0]);
        let whole = loop_length(outline, of_loop);
        let [low, high] = if u0 < u1 { [u0, u1] } else { [u1, u0] };
        for of in pieces.iter().filter(|p| p.of_loop == of_loop) {
            for turn in -2..=1 {
                let [from, to] = of.along.map(|u| u + f64::from(turn) * whole);
                if high - low <= ROUNDING {
                    // A piece that is all of the loop goes about the corner between its ends too.
                    if from < low && low < to || turn == 0 && to - from >= whole - ROUNDING {
                        found.push(Run { along: stretch, beside: Vec::new() });
                    }
                    continue;
                }
                let (a, b) = (if from > low { from } else { low }, if to < high { to } else { high });
                if b - a > ROUNDING {
                    let [x, y] = [place(a), place(b)];
                    let along = if x < y { [x, y] } else { [y, x] };
                    found.push(Run { along, beside: vec![OutlinePiece { of_loop, along: [a, b] }] });
                }
            }
        }
    }
    found.sort_by(|a, b| a.along[0].total_cmp(&b.along[0]));
    let mut joined: Vec<Run> = Vec::new();
    for run in found {
        match joined.last_mut().filter(|last| run.along[0] - last.along[1] <= ROUNDING) {
            Some(last) => {
                if run.along[1] > last.along[1] {
                    last.along[1] = run.along[1];
                }
                last.beside.extend(run.beside);
            }
            None => joined.push(run),
        }
    }
    // The last one may go on at the beginning.
    if let [first, .., last] = &mut joined[..]
        && first.along[0] <= ROUNDING
        && last.along[1] >= track.length() - ROUNDING
    {
        last.along[1] = track.length() + first.along[1];
        last.beside.append(&mut first.beside);
        joined.remove(0);
    }
    // A run that only goes about a corner whose edges it does not reach cuts nothing of them.
    joined.retain(|r| r.along[1] - r.along[0] > LEAST_RUN && !r.beside.is_empty());
    joined
}

/// The stretch of a loop beside which an edge of an offset of the outline runs.
fn beside(edge: &OutlineEdge, outline: &Outline, near: &NearestEdge) -> Option<Beside> {
    let nearest = near.at(edge.at(0.5), f64::INFINITY)?;
    let of_loop = outline.loops().iter().position(|l| l.edges.contains(&nearest.edge))?;
    let source = &outline.edges()[nearest.edge];
    let before = outline.loops()[of_loop].edges.start..nearest.edge;
    let begin: f64 = outline.edges()[before].iter().map(OutlineEdge::length).sum();
    let middle = begin + nearest.share * source.length();
    let ratio = match (source.turn, edge.turn) {
        (None, None) => 1.0,
        (Some(of), Some(t)) if of.centre.distance(t.centre) <= 10.0 * near.rounding() => of.radius / t.radius,
        // About a corner.
        _ => 0.0,
    };
    let along = (edge.heading(0.5) - source.heading(nearest.share)).cos().signum();
    let half = 0.5 * edge.length() * ratio * along;
    Some(Beside { of_loop, at: [middle - half, middle + half] })
}

/// An open stretch of a track with the leads at its ends.
pub(super) struct Open {
    pub(super) along: [f64; 2],
    pub(super) on: Lead,
    pub(super) off: Lead,
}

impl Planner<'_> {
    /// Cuts along pieces, each time the nearest one; `heights` from the top down. Returns whether there was any.
    pub(super) fn pieces(
        &mut self,
        tracks: &[(Track, bool)],
        pieces: &[OutlinePiece],
        wall: f64,
        heights: &[f64],
    ) -> Result<bool> {
        let mut left: Vec<(usize, Run)> = Vec::new();
        for (i, (track, _)) in tracks.iter().enumerate() {
            let runs = runs(track, &self.spec.outline, self.near, pieces);
            left.extend(runs.into_iter().map(|run| (i, run)));
        }
        let any = !left.is_empty();
        let mut farthest: Option<(f64, DVec2)> = None;
        let mut here = DVec2::ZERO;
        while !left.is_empty() {
            let start = |(i, run): &(usize, Run)| tracks[*i].0.at(run.along[0]).0.distance(here);
            let next = (0..left.len()).min_by(|&a, &b| start(&left[a]).total_cmp(&start(&left[b])));
            let (i, run) = left.remove(next.unwrap_or(0));
            let (track, outer) = &tracks[i];
            let first_move = self.travel.route.moves.len();
            let open = match run.along[1] - run.along[0] < track.length() - ROUNDING {
                true => Some(self.ends(track, run.along, wall)?),
                false => None,
            };
            // Along the outline as far beyond the run as the path or a lead comes to cut.
            let mut beyond = 0.0;
            if let Some(open) = &open {
                for (end, cut) in run.along.into_iter().zip(open.along) {
                    let farther = (cut - end).abs();
                    if farther > farthest.map_or(ROUNDING, |(most, _)| most) {
                        farthest = Some((farther, track.at(cut).0));
                    }
                    beyond = if farther > beyond { farther } else { beyond };
                }
                let lead = |l: &Lead| l.radius + l.line;
                let (on, off) = (lead(&open.on), lead(&open.off));
                beyond += if on > off { on } else { off };
            }
            let open = open.filter(|o| o.along[1] - o.along[0] < track.length());
            let closed = open.is_none();
            here = match open {
                Some(open) => self.open(track, *outer, &open, heights)?,
                None => {
                    let start = self.beginning(track, wall)?;
                    self.rough(track, *outer, (start, Vec::new()), heights)?
                }
            };
            self.spares_edges(pieces, &run, beyond);
            if let Some(last) = self.loops.last_mut() {
                last.piece = Some(CutPiece { first_move, beside: run.beside, closed });
            }
        }
        if let Some((farther, at)) = farthest {
            let what = format!(
                "edges beyond the ends of pieces are cut too: up to {:.1} mm, where no lead finds room nearer",
                (10.0 * farther).ceil() / 10.0
            );
            self.sharp_edge(Code::LEAD_ROOM, &what, at);
        }
        Ok(any)
    }

    /// A warning where the last loop of the path also cuts an edge that belongs to no piece, farther from the ends of its run than a
    /// lead reaches, which is `beyond` along the outline [mm].
    fn spares_edges(&mut self, pieces: &[OutlinePiece], run: &Run, beyond: f64) {
        let (Some(room), Some(last)) = (self.spec.room, self.loops.last()) else { return };
        let outline = &self.spec.outline;
        let wider = |of: &OutlinePiece| {
            let [from, to] = of.along;
            OutlinePiece { along: [from - beyond - room, to + beyond + room], ..*of }
        };
        let own: Vec<OutlinePiece> = pieces.iter().copied().chain(run.beside.iter().map(wider)).collect();
        let others = LoopStretches::new(outline, &own).edges_off(outline);
        if others.is_empty() {
            return;
        }
        let near = NearestEdge::new(&others);
        let Some(at) = last.edges.iter().find_map(|e| nearer(e, &near, room)) else { return };
        let what =
            format!("the cutter also cuts an edge that is not chosen, beside ({:.3}, {:.3})", at.x, at.y);
        self.sharp_edge(Code::CUTTER_TOO_LARGE, &what, at);
    }

    /// Warns of an edge that is cut though it was not chosen.
    fn sharp_edge(&mut self, code: Code, what: &str, at: DVec2) {
        // Only one that the job gives is not made smaller where it finds no room.
        let (help, key) = match code == Code::LEAD_ROOM && self.spec.lead_radius.is_some() {
            true => (
                "if that edge must stay sharp, give a smaller lead_radius or take a smaller cutter",
                "lead_radius",
            ),
            false => ("if that edge must stay sharp, take a smaller cutter", "tool"),
        };
        self.findings.push(Finding::warning(code, what).point([at.x, at.y, 0.0]).help(help).key(key));
    }

    /// The leads at the ends of a run: where there is no room for one, the run goes a little farther.
    pub(super) fn ends(&self, track: &Track, [from, to]: [f64; 2], wall: f64) -> Result<Open> {
        let [on, off] = [(from, false), (to, true)].map(|(s, leaving)| self.end(track, s, leaving, wall));
        match (on, off) {
            (Some((from, on)), Some((to, off))) => Ok(Open { along: [from, to], on, off }),
            (on, _) => {
                let (p, _) = track.at(if on.is_some() { to } else { from });
                let what = "no lead finds room at the end of a piece of the contour";
                let key = if self.spec.lead_radius.is_some() { "lead_radius" } else { "tool" };
                Err(Finding::error(Code::LEAD_ROOM, what)
                    .value_mm(self.usual_lead())
                    .bound_mm(LEAST_LEAD * self.spec.radius())
                    .point([p.x, p.y, 0.0])
                    .help("give a smaller lead_radius, take a smaller cutter, or leave the loop out: loops = \"outer\"")
                    .key(key)
                    .into())
            }
        }
    }

    /// The place of an end of a run, and its lead.
    fn end(&self, track: &Track, s: f64, leaving: bool, wall: f64) -> Option<(f64, Lead)> {
        let spec = self.spec;
        let left = spec.keeps_right();
        let (step, most) = FARTHER;
        for shift in 0..=most {
            let farther = f64::from(shift) * step;
            let at = if leaving { s + farther } else { s - farther };
            let (p, along) = track.at(at);
            let way = |lead: &Lead| match leaving {
                true => lead.off(p, along, left),
                false => lead.on(p, along, left).iter().rev().map(OutlineEdge::reversed).collect(),
            };
            let mut radius = self.usual_lead();
            loop {
                let lead = Lead { radius, angle: FRAC_PI_2, line: 0.0 };
                let found = match spec.room {
                    Some(room) => reaching(lead, |lead| vec![way(lead)], self.near, (wall, room)),
                    None => Some(lead),
                };
                if let Some(lead) = found.filter(|lead| self.is_open(&way(lead), wall)) {
                    return Some((at, lead));
                }
                if spec.lead_radius.is_some() || radius <= LEAST_LEAD * spec.radius() {
                    break;
                }
                radius = (0.5 * radius).max(LEAST_LEAD * spec.radius());
            }
        }
        None
    }

    /// Cuts along an open stretch, level after level.
    fn open(&mut self, track: &Track, outer: bool, open: &Open, heights: &[f64]) -> Result<DVec2> {
        let spec = self.spec;
        let [from, to] = open.along;
        let left = spec.keeps_right();
        let ((p, along), (q, ahead)) = (track.at(from), track.at(to));
        let (on, off) = (open.on.on(p, along, left), open.off.off(q, ahead, left));
        self.travel.route.finishing = false;
        let edges = track.part(from, to);
        self.loops.push(PlannedLoop {
            edges,
            outer,
            finishing: false,
            farther: 0.0,
            tabs: Vec::new(),
            piece: None,
        });
        for (k, floor) in heights[1..].iter().enumerate() {
            self.travel.route.level = k as u32;
            self.travel.route.over(on.first().map_or(p, |e| e.start));
            let down = ToolpathPace::Feed(spec.plunge_feed);
            self.travel.route.vertically(ToolpathRole::Entry, down, *floor);
            self.travel.route.edges(ToolpathRole::LeadIn, spec.feed, &on)?;
            let lap = Stretch { along: [from, to], heights: [*floor; 2], feed: spec.feed };
            self.travel.follow(ToolpathRole::Circle, track, &[], lap)?;
            self.travel.route.edges(ToolpathRole::LeadOut, spec.feed, &off)?;
        }
        Ok(q)
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;
    use crate::geom::offset;

    fn tracks(outline: &Outline, distance: f64) -> Vec<Track> {
        offset(outline, -distance).unwrap().loops.iter().map(|l| Track::new(l.edges.clone())).collect()
    }

    #[test]
    fn runs_lie_beside_their_pieces() {
        let corners =
            [dvec2(0.0, 0.0), dvec2(60.0, 0.0), dvec2(60.0, 15.0), dvec2(20.0, 15.0), dvec2(20.0, 40.0)];
        let mut edges: Vec<OutlineEdge> =
            (0..5).map(|i| OutlineEdge::line(corners[i], corners[(i + 1) % 5])).collect();
        edges[0] = OutlineEdge::bulge(corners[0], corners[1], 0.2);
        let hole = OutlineEdge::arc(dvec2(40.0, 7.0), 4.0, 0.7, std::f64::consts::TAU);
        let outline = Outline::new(vec![edges, vec![hole]], vec![]).unwrap();
        let near = NearestEdge::new(outline.edges());
        for of_loop in 0..2 {
            let whole = loop_length(&outline, of_loop);
            for k in 0..60 {
                let from = whole * f64::from(k) / 60.0;
                let to = from + 0.05 * whole + 0.3 * whole * f64::from(k % 7) / 7.0;
                let piece = OutlinePiece { of_loop, along: [from, to] };
                let mut beside = 0.0;
                for track in tracks(&outline, 0.4) {
                    for run in runs(&track, &outline, &near, &[piece]) {
                        beside += run.beside.iter().map(|b| b.along[1] - b.along[0]).sum::<f64>();
                        // Points of the run lie beside the piece, by their nearest place.
                        for i in 0..=40 {
                            let s = run.along[0] + (run.along[1] - run.along[0]) * f64::from(i) / 40.0;
                            let n = near.at(track.at(s).0, 1.0).unwrap();
                            let first = outline.loops()[of_loop].edges.start;
                            let begin: f64 =
                                outline.edges()[first..n.edge].iter().map(OutlineEdge::length).sum();
                            let u = begin + n.share * outline.edges()[n.edge].length();
                            let off = (u - from).rem_euclid(whole);
                            assert!(off < to - from + 1e-6 || off > whole - 1e-6, "{k} {u} {from} {to}");
                        }
                    }
                }
                // All of it but what lies before the inside corner.
                let missing = (to - from) - beside;
                assert!((-1e-6..0.8 + 1e-6).contains(&missing), "{of_loop} {k}: {missing}");
                assert!(of_loop == 0 || missing.abs() < 1e-6);
            }
        }
    }
}
