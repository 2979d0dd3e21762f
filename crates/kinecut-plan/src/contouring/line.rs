//! Contours along open lines: beside them on their left or right, or on them, from one end to the other.

use std::f64::consts::FRAC_PI_2;

use glam::DVec2;

use super::OutlinePiece;
use super::check::{check, out_of_range};
use super::corners::uncut;
use super::lead::Lead;
use super::pieces::{CutPiece, Open, Run, runs};
use super::plan::{ContourPlan, Planner, RAMP_ABOVE};
use super::spec::{ContourFinish, ContourSide, ContourSpec};
use super::stretches::loop_length;
use super::track::Track;
use super::travel::Stretch;
use super::wear::fits;
use crate::base::{Code, Finding, Result};
use crate::geom::{NearestEdge, OutlineEdge};
use crate::holes::levels::levels;
use crate::holes::{ToolpathPace, ToolpathRole};

/// Plans a contour along the open lines of an outline.
///
/// # Errors
/// As `plan_contour`.
pub(super) fn plan_lines(spec: &ContourSpec) -> Result<ContourPlan> {
    check(spec)?;
    let a = spec.radius();
    let wall = if spec.side == ContourSide::On { 0.0 } else { a + spec.stock_to_leave };
    let allowance = spec.finish.map_or(0.0, |f| f.allowance);
    let depth = spec.depth + spec.breakthrough;
    let floors = levels(spec.top, depth, spec.stepdown.unwrap_or(spec.cutter.flute_length), |_| Ok(a))?;
    let mut heights = vec![spec.top];
    heights.extend(floors.iter().map(|l| l.floor));
    let near = NearestEdge::of(&spec.outline);
    let mut planner = Planner::new(spec, &near);
    let rough = planner.sides(wall + allowance)?;
    for farther in spec.farther() {
        let beside = if farther > 0.0 { Some(planner.sides(wall + allowance + farther)?) } else { None };
        for one in planner.in_order(beside.as_deref().unwrap_or(&rough)) {
            match one.is_closed() {
                true => planner.rough_around(one, (wall + allowance, farther), &heights)?,
                false => planner.rough_line(one, (wall + allowance, farther), &heights)?,
            }
        }
    }
    let last = match &spec.finish {
        Some(finish) => {
            let fine = planner.sides(wall)?;
            if let Some(wear) = finish.wear {
                let farther = |wear: f64| Ok(edges_of(&planner.sides(wall + wear)?));
                fits(&edges_of(&fine), farther, wear.largest, (a, wall))?;
            }
            for one in planner.in_order(&fine) {
                match one.is_closed() {
                    true => planner.finish_around(one, &rough, wall, finish)?,
                    false => planner.finish_line(one, &rough, wall, finish)?,
                }
            }
            fine
        }
        None => rough,
    };
    let mut corners = Vec::new();
    if spec.side != ContourSide::On {
        let source = (spec.outline.edges(), spec.outline.loops());
        let mut tracks: Vec<&Track> = Vec::new();
        for side in &last {
            if !tracks.contains(&&side.track) {
                tracks.push(&side.track);
            }
        }
        for track in tracks {
            corners.extend(uncut(track, spec.keeps_right(), source, &near, wall));
        }
        corners.retain(|c| planner.runs_by(c.at));
    }
    planner.travel.route.retract();
    Ok(planner.done(&heights, corners))
}

/// Place along a line that is rounding [mm].
const ROUNDING: f64 = 1e-6;

/// A side of a line: the path along it, as a part of the closed path around it.
#[derive(Clone, Debug)]
struct Side {
    track: Track,
    run: Run,
}

impl Side {
    fn edges(&self) -> Vec<OutlineEdge> {
        let [from, to] = self.run.along;
        self.track.part(from, to)
    }

    /// Whether it is all of its path: the room behind a neck that is narrower than the cutter.
    fn is_closed(&self) -> bool {
        self.run.along[1] - self.run.along[0] >= self.track.length() - ROUNDING
    }
}

fn edges_of(sides: &[Side]) -> Vec<Vec<OutlineEdge>> {
    sides.iter().map(Side::edges).collect()
}

impl Planner<'_> {
    /// The paths along the wanted sides of the lines, at a distance from them [mm], as they are travelled.
    ///
    /// # Errors
    /// `KC0401` where a line has no path beside it; those of offsets.
    fn sides(&self, distance: f64) -> Result<Vec<Side>> {
        let (spec, outline) = (self.spec, &self.spec.outline);
        if spec.side == ContourSide::On {
            // The path is the line; the way back along it is not gone.
            let on = outline.lines().enumerate().map(|(of_loop, line)| {
                let edges = match spec.keeps_right() {
                    true => line.to_vec(),
                    false => line.iter().rev().map(OutlineEdge::reversed).collect(),
                };
                let back = edges.iter().rev().map(OutlineEdge::reversed);
                let track = Track::new(edges.iter().copied().chain(back).collect());
                let along = [0.0, 0.5 * track.length()];
                Side { track, run: Run { along, beside: vec![OutlinePiece { of_loop, along }] } }
            });
            return Ok(on.collect());
        }
        let wanted: Vec<OutlinePiece> = (0..outline.loops().len()).map(|l| self.half(l)).collect();
        let mut sides = Vec::new();
        for (track, _) in self.tracks(distance)? {
            let found = runs(&track, outline, self.near, &wanted);
            sides.extend(found.into_iter().map(|run| Side { track: track.clone(), run }));
        }
        let lacks = |of: &&OutlinePiece| {
            sides.iter().all(|s| s.run.beside.iter().all(|beside| beside.of_loop != of.of_loop))
        };
        let Some(lacking) = wanted.iter().find(lacks) else { return Ok(sides) };
        let at = outline.edges()[outline.loops()[lacking.of_loop].edges.start].start;
        let what = format!("the cutter does not go along the line at ({:.3}, {:.3})", at.x, at.y);
        Err(Finding::error(Code::CUTTER_TOO_LARGE, what)
            .value_mm(spec.cutter.diameter)
            .point([at.x, at.y, 0.0])
            .help("take a smaller cutter, or leave the line out by its layer")
            .key("tool")
            .into())
    }

    /// The wanted side of a line as a piece of the way along it and back.
    fn half(&self, of_loop: usize) -> OutlinePiece {
        let length = 0.5 * loop_length(&self.spec.outline, of_loop);
        let along = match self.spec.side {
            ContourSide::Left => [0.0, length],
            _ => [length, 2.0 * length],
        };
        OutlinePiece { of_loop, along }
    }

    /// Lengths by which a line goes on before the begin of a side and beyond its end, where these are ends of the line [mm].
    fn extended(&self, side: &Side) -> [f64; 2] {
        let (Some(first), Some(last)) = (side.run.beside.first(), side.run.beside.last()) else {
            return [0.0; 2];
        };
        let whole = self.half(first.of_loop).along;
        let [before, beyond] = self.spec.extended(first.of_loop);
        // The travel has the material that stays on its right, as the way along a line and back has.
        let (begin, end) = match self.spec.keeps_right() {
            true => (first.along[0] - whole[0], whole[1] - last.along[1]),
            false => (whole[1] - first.along[1], last.along[0] - whole[0]),
        };
        let of = |gap: f64, length: f64| if gap.abs() <= ROUNDING { length } else { 0.0 };
        [of(begin, before), of(end, beyond)]
    }

    /// Sides in the order of cutting: each time the one whose beginning is nearest.
    fn in_order<'s>(&self, sides: &'s [Side]) -> Vec<&'s Side> {
        let mut left: Vec<&Side> = sides.iter().collect();
        let mut here = DVec2::ZERO;
        let mut order = Vec::with_capacity(left.len());
        while !left.is_empty() {
            let start = |s: &Side| s.track.at(s.run.along[0]).0.distance(here);
            let next = (0..left.len()).min_by(|&a, &b| start(left[a]).total_cmp(&start(left[b])));
            let side = left.remove(next.unwrap_or(0));
            here = side.track.at(side.run.along[1]).0;
            order.push(side);
        }
        order
    }

    /// The stretch of a side with leads at its ends; none on the line, beside which all stays.
    fn leads(&self, side: &Side, wall: f64) -> Result<Open> {
        if self.spec.side == ContourSide::On {
            return Ok(Open { along: side.run.along, on: Lead::NONE, off: Lead::NONE });
        }
        self.ends(&side.track, side.run.along, wall)
    }

    fn keep_line(&mut self, side: &Side, along: [f64; 2], farther: f64) {
        let first_move = self.travel.route.moves.len();
        let piece = CutPiece { first_move, beside: side.run.beside.clone(), closed: false };
        let finishing = self.travel.route.finishing;
        let edges = side.track.part(along[0], along[1]);
        self.loops.push(super::PlannedLoop {
            edges,
            outer: true,
            finishing,
            farther,
            tabs: Vec::new(),
            piece: Some(piece),
        });
    }

    /// Roughs a side, so much farther from the wall than the path beside it [mm], level after level, straight down at its beginning or to and fro along a ramp.
    fn rough_line(&mut self, side: &Side, (wall, farther): (f64, f64), heights: &[f64]) -> Result<()> {
        let (spec, track) = (self.spec, &side.track);
        let open = self.leads(side, wall + farther)?;
        let [from, to] = open.along;
        let left = spec.keeps_right();
        let ((p, along), (q, ahead)) = (track.at(from), track.at(to));
        let (on, off) = (open.on.on(p, along, left), open.off.off(q, ahead, left));
        self.travel.route.finishing = false;
        self.keep_line(side, open.along, farther);
        for (k, pair) in heights.windows(2).enumerate() {
            let (above, floor) = (pair[0], pair[1]);
            self.travel.route.level = k as u32;
            let down = ToolpathPace::Feed(spec.plunge_feed);
            match spec.ramp {
                Some(angle) => {
                    let begin = (above + RAMP_ABOVE).min(spec.approach_z);
                    self.travel.route.over(p);
                    self.travel.route.vertically(ToolpathRole::Entry, down, begin);
                    self.zigzag(track, [from, to], [begin, floor], angle)?;
                }
                None => {
                    self.travel.route.over(on.first().map_or(p, |e| e.start));
                    self.travel.route.vertically(ToolpathRole::Entry, down, floor);
                    self.travel.route.edges(ToolpathRole::LeadIn, spec.feed, &on)?;
                }
            }
            let lap = Stretch { along: [from, to], heights: [floor; 2], feed: spec.feed };
            self.travel.follow(ToolpathRole::Circle, track, &[], lap)?;
            self.travel.route.edges(ToolpathRole::LeadOut, spec.feed, &off)?;
        }
        Ok(())
    }

    /// The last loop as the closed path beside a line.
    fn kept_around(&mut self, side: &Side, first_move: usize, farther: f64) {
        if let Some(last) = self.loops.last_mut() {
            last.farther = farther;
            last.piece = Some(CutPiece { first_move, beside: side.run.beside.clone(), closed: true });
        }
    }

    /// Roughs the room behind a neck as a loop.
    fn rough_around(&mut self, side: &Side, (wall, farther): (f64, f64), heights: &[f64]) -> Result<()> {
        let (spec, first_move) = (self.spec, self.travel.route.moves.len());
        let start = self.beginning(&side.track, wall + farther)?;
        if spec.ramp.is_none() && !spec.cutter.centre_cutting {
            let (p, _) = side.track.at(start.at);
            let what = "the cutter does not cut at its centre, and the room behind a neck is closed";
            let finding = Finding::error(Code::ENTRY_IMPOSSIBLE, what).point([p.x, p.y, 0.0]);
            return Err(finding
                .help("let it come down along a ramp: entry = { ramp = 3 }")
                .key("entry")
                .into());
        }
        self.rough(&side.track, true, (start, Vec::new()), heights)?;
        self.kept_around(side, first_move, farther);
        Ok(())
    }

    /// Finishes the room behind a neck as a loop; `rough`: the sides that roughing has run along.
    fn finish_around(
        &mut self,
        side: &Side,
        rough: &[Side],
        wall: f64,
        finish: &ContourFinish,
    ) -> Result<()> {
        let first_move = self.travel.route.moves.len();
        let rough: Vec<(Track, bool)> =
            rough.iter().filter(|s| s.is_closed()).map(|s| (s.track.clone(), true)).collect();
        self.finish(&side.track, true, &rough, wall, finish)?;
        self.kept_around(side, first_move, 0.0);
        Ok(())
    }

    /// Down at an angle from the beginning of a stretch, to and fro, as few times as its length allows, and back to the beginning.
    fn zigzag(
        &mut self,
        track: &Track,
        [from, to]: [f64; 2],
        [begin, floor]: [f64; 2],
        angle: f64,
    ) -> Result<()> {
        let length = (begin - floor) / angle.tan();
        let legs = 2.0 * (0.5 * length / (to - from)).ceil().max(1.0);
        let (leg, fall) = (length / legs, (begin - floor) / legs);
        let (back, whole) = (track.reversed(), track.length());
        for i in 0..legs as u32 {
            let z = begin - f64::from(i) * fall;
            let lower = if f64::from(i + 1) < legs { z - fall } else { floor };
            let way = |along| Stretch { along, heights: [z, lower], feed: self.spec.feed };
            if i % 2 == 0 {
                let way = way([from, from + leg]);
                self.travel.follow(ToolpathRole::Entry, track, &[], way)?;
            } else {
                let way = way([whole - from - leg, whole - from]);
                self.travel.follow(ToolpathRole::Entry, &back, &[], way)?;
            }
        }
        Ok(())
    }

    /// Finishes a side; `rough`: those that roughing has run along.
    fn finish_line(&mut self, side: &Side, rough: &[Side], wall: f64, finish: &ContourFinish) -> Result<()> {
        let (spec, track) = (self.spec, &side.track);
        let wear = finish.wear.map_or(0.0, |w| w.largest);
        let line = spec.switching();
        let radius = self.usual_lead();
        if finish.wear.is_some() && radius <= wear + 0.01 {
            let what = "the lead-in is too tight for this wear correction";
            let help = "allow a smaller wear_largest, or a larger lead_radius";
            return Err(out_of_range("finish.wear_largest", what, wear, radius - 0.01, "mm", help));
        }
        let left = spec.keeps_right();
        let lead = |s: f64| {
            let lead = Lead { radius, angle: FRAC_PI_2, line };
            self.beside(lead, track.at(s), wall, finish.allowance)
        };
        // Roughing goes farther along than the wall is wanted: the leads begin and end where it has cut, if that is far enough.
        let [from, to] = side.run.along;
        let [ahead, behind] = self.extended(side);
        let length = |lead: &Lead| lead.radius * lead.angle.sin() + lead.line * lead.angle.cos();
        let (first, last) = (lead(from), lead(to));
        let shorter = |length: f64, room: f64| if length < room { length } else { 0.0 };
        let along = [from + shorter(length(&first), ahead), to - shorter(length(&last), behind)];
        let ((p, heading), (q, on_from_there)) = (track.at(along[0]), track.at(along[1]));
        let (on, off) = (lead(along[0]).on(p, heading, left), lead(along[1]).off(q, on_from_there, left));
        for way in [&on, &off] {
            if !self.is_open(way, wall) {
                let at = way[0].at(0.5);
                let what = "no lead finds room at the end of the line";
                let help = "give a smaller lead_radius, or take a smaller cutter";
                let finding = Finding::error(Code::LEAD_ROOM, what).point([at.x, at.y, 0.0]);
                return Err(finding.help(help).key("lead_radius").into());
            }
        }
        let on = self.entered(on);
        let start = on.first().map_or(p, |e| e.start);
        let is_cut = rough.iter().flat_map(Side::edges).any(|e| e.nearest(start).1 <= 0.1 * finish.allowance);
        if !(is_cut || spec.clear_ends || spec.cutter.centre_cutting) {
            let what =
                "the cutter does not cut at its centre, and roughing has not cut where finishing comes down";
            let help =
                format!("let the line go on: extend = {:.1}", length(&first).max(length(&last)).ceil());
            let finding = Finding::error(Code::ENTRY_IMPOSSIBLE, what).point([start.x, start.y, 0.0]);
            return Err(finding.help(help).key("extend").into());
        }
        self.travel.route.finishing = true;
        self.keep_line(side, along, 0.0);
        let step = finish.stepdown.unwrap_or(spec.cutter.flute_length);
        self.slow_down(track, rough.iter().map(|s| &s.track), finish)?;
        for level in &levels(spec.top, spec.depth + spec.breakthrough, step, |_| Ok(0.0))? {
            self.travel.route.level = level.index;
            for time in 0..=finish.spring_passes {
                if let Some(slower) = &mut self.travel.slower {
                    slower.until = if time == 0 { f64::INFINITY } else { f64::NEG_INFINITY };
                }
                self.travel.route.over(start);
                let down = if is_cut { finish.feed } else { spec.plunge_feed };
                self.travel.route.vertically(ToolpathRole::Entry, ToolpathPace::Feed(down), level.floor);
                self.travel.route.comp = finish.wear.is_some();
                let first = self.travel.route.moves.len();
                self.travel.route.edges(ToolpathRole::LeadIn, finish.feed, &on)?;
                let lap = Stretch { along, heights: [level.floor; 2], feed: finish.feed };
                self.travel.follow(ToolpathRole::Finish, track, &[], lap)?;
                self.travel.route.edges(ToolpathRole::LeadOut, finish.feed, &off[..1])?;
                self.travel.route.comp = false;
                self.travel.route.edges(ToolpathRole::LeadOut, finish.feed, &off[1..])?;
                self.onto_wall(first)?;
            }
        }
        self.travel.slower = None;
        Ok(())
    }
}
