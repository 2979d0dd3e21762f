//! The plan of a contour: tracks, levels, leads, tabs, and the moves along them.

use std::f64::consts::FRAC_PI_2;

use glam::DVec2;

use super::check::{check, out_of_range};
use super::corner_feed::{CornerFeed, SlowedFeed};
use super::corners::{UncutCorner, remark, uncut};
use super::lead::Lead;
use super::line::plan_lines;
use super::onto_wall::onto_wall;
use super::pieces::CutPiece;
use super::room::{nearer, reaching};
use super::rough::Beginning;
use super::spec::{ContourFinish, ContourLoops, ContourSide, ContourSpec, Tabs};
use super::tabs::{PlacedTab, lifted, placed};
use super::track::Track;
use super::travel::{Stretch, Travel};
use super::wear::fits;
use crate::base::{Code, Finding, Result};
use crate::geom::{NearestEdge, OffsetLoop, OutlineEdge, offset};
use crate::holes::levels::levels;
use crate::holes::{PlannedMove, ToolpathPace, ToolpathRole};

/// Height over the material at which a ramp begins [mm].
pub(super) const RAMP_ABOVE: f64 = 0.5;
/// Room of a lead beyond the wall that is rounding [mm].
const ROUNDING: f64 = 1e-6;
/// Least radius of a lead, in radii of the cutter.
pub(super) const LEAST_LEAD: f64 = 0.2;
/// The same where no place has room for that, and least radius of such an arc [mm].
const TIGHT_LEAD: f64 = 0.02;
const LEAST_ARC: f64 = 0.005;

/// A planned contour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContourPlan {
    /// Moves of the cutter's tip centre, in coordinates of the work offset.
    pub moves: Vec<PlannedMove>,
    /// The loops in the order of cutting, roughing first.
    pub loops: Vec<PlannedLoop>,
    /// Heights of the levels of roughing, the lowest last [mm].
    pub levels: Vec<f64>,
    /// Corners that the cutter does not reach.
    pub uncut: Vec<UncutCorner>,
    /// Stretches of the finish with a reduced feed; `None`: it is not reduced.
    pub slowed: Option<SlowedFeed>,
    /// Advice and warnings.
    pub findings: Vec<Finding>,
}

/// A loop of the path.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedLoop {
    /// Path of the cutter's centre, from its start.
    pub edges: Vec<OutlineEdge>,
    /// Whether it encloses the face, or a hole of it.
    pub outer: bool,
    /// Whether it belongs to finishing.
    pub finishing: bool,
    /// Distance from the loop beside the wall of a loop that roughs farther away; 0 of all others [mm].
    pub farther: f64,
    /// Tabs on it.
    pub tabs: Vec<PlacedTab>,
    /// The piece of the outline that it cuts; `None`: all of its loop.
    pub piece: Option<CutPiece>,
}

impl PlannedLoop {
    /// Length [mm].
    pub fn length(&self) -> f64 {
        self.edges.iter().map(OutlineEdge::length).sum()
    }
}

/// Plans a contour.
///
/// # Errors
/// `KC0103` for numbers that are none or not above zero, `KC0401` where the cutter does not fit, `KC0403` where it cannot come
/// down, `KC0404` for numbers out of range and for a wear under which a part of the path vanishes, `KC0407` where no lead finds
/// room; those of offsets. Keys are those of the table of the operation.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::contouring::{ContourSpec, plan_contour};
/// use kinecut::geom::Outline;
/// use kinecut::holes::CutterData;
/// let corners = [dvec2(0.0, 0.0), dvec2(60.0, 0.0), dvec2(60.0, 40.0), dvec2(0.0, 40.0)];
/// let cutter = CutterData { diameter: 10.0, centre_cutting: true, max_ramp_angle: None, flute_length: 22.0 };
/// let spec = ContourSpec::new(Outline::polygon(&corners)?, 6.0, cutter, 10.0);
/// let plan = plan_contour(&spec)?;
/// // The outline, and an arc of 5 mm about each corner.
/// let length = 200.0 + 10.0 * std::f64::consts::PI;
/// assert!((plan.loops[0].length() - length).abs() < 1e-9);
/// assert!(plan.moves.windows(2).all(|w| (w[1].curve.start() - w[0].curve.end()).length() < 1e-9));
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn plan_contour(spec: &ContourSpec) -> Result<ContourPlan> {
    if spec.outline.is_of_lines() {
        return plan_lines(spec);
    }
    check(spec)?;
    let a = spec.radius();
    let wall = match spec.side {
        ContourSide::On => 0.0,
        _ => a + spec.stock_to_leave,
    };
    let allowance = spec.finish.map_or(0.0, |f| f.allowance);
    let step = spec.stepdown.unwrap_or(spec.cutter.flute_length);
    let depth = spec.depth + spec.breakthrough;
    let floors = levels(spec.top, depth, step, |_| Ok(a))?;
    let near = NearestEdge::new(spec.outline.edges());
    let mut planner = Planner::new(spec, &near);
    let rough = planner.tracks(wall + allowance)?;
    let mut heights = vec![spec.top];
    heights.extend(floors.iter().map(|l| l.floor));
    let mut at = None;
    let roughed = !(spec.cleared && spec.finish.is_some()) && spec.pieces.is_none();
    if let Some(pieces) = &spec.pieces
        && planner.pieces(&rough, pieces, wall + allowance, &heights)?
    {
        at = Some(DVec2::ZERO);
    }
    if roughed {
        at = planner.rough_all(&rough, wall + allowance, &heights)?;
    }
    let mut corners = Vec::new();
    let last = match spec.finish {
        Some(finish) => {
            let fine = planner.tracks(wall)?;
            if let Some(wear) = finish.wear {
                let edges = |wear: f64| {
                    let paths = planner.paths(wall + wear)?;
                    Ok(paths.into_iter().map(|l| l.edges).collect::<Vec<_>>())
                };
                fits(&edges(0.0)?, edges, wear.largest, (a, wall))?;
            }
            for (track, outer) in planner.ordered(&fine) {
                at = Some(planner.finish(track, outer, &rough, wall, &finish)?);
            }
            fine
        }
        None => rough,
    };
    if spec.side != ContourSide::On {
        let source = (spec.outline.edges(), spec.outline.loops());
        for (track, _) in &last {
            corners.extend(uncut(track, spec.keeps_right(), source, &near, wall));
        }
        if spec.pieces.is_some() {
            corners.retain(|c| planner.runs_by(c.at));
        }
    }
    if at.is_some() {
        planner.travel.route.retract();
    }
    Ok(planner.done(&heights, corners))
}

/// A plan in the making.
pub(super) struct Planner<'a> {
    pub(super) spec: &'a ContourSpec,
    pub(super) near: &'a NearestEdge,
    pub(super) travel: Travel<'a>,
    pub(super) findings: Vec<Finding>,
    pub(super) loops: Vec<PlannedLoop>,
    slowed: Option<SlowedFeed>,
}

impl<'a> Planner<'a> {
    /// Without a move.
    pub(super) fn new(spec: &'a ContourSpec, near: &'a NearestEdge) -> Planner<'a> {
        Planner {
            spec,
            near,
            travel: Travel::new(spec),
            findings: Vec::new(),
            loops: Vec::new(),
            slowed: None,
        }
    }
}

impl Planner<'_> {
    /// The plan as it has been made; `heights` from the top down, `uncut`: the corners that stay.
    pub(super) fn done(self, heights: &[f64], uncut: Vec<UncutCorner>) -> ContourPlan {
        let mut findings = self.findings;
        findings.extend(remark(&uncut, self.spec.radius()));
        let levels = heights[1..].to_vec();
        let (moves, loops, slowed) = (self.travel.route.moves, self.loops, self.slowed);
        ContourPlan { moves, loops, levels, uncut, slowed, findings }
    }

    /// Whether loops of a kind are cut.
    pub(super) fn is_wanted(&self, outer: bool) -> bool {
        match self.spec.loops {
            ContourLoops::All => true,
            ContourLoops::Outer => outer,
            ContourLoops::Inner => !outer,
        }
    }

    /// Paths of the cutter's centre at a distance from the outline.
    pub(super) fn paths(&self, distance: f64) -> Result<Vec<OffsetLoop>> {
        let shrinks = if self.spec.side == ContourSide::Inside { distance } else { -distance };
        let mut loops = offset(&self.spec.outline, shrinks)?.loops;
        loops.retain(|l| l.collapsed || self.is_wanted(l.area() > 0.0));
        Ok(loops)
    }

    /// The tracks at a distance from the outline, as they are travelled, each with whether it is an outer one.
    pub(super) fn tracks(&self, distance: f64) -> Result<Vec<(Track, bool)>> {
        let loops = self.paths(distance)?;
        self.covered(&loops)?;
        self.spares_others(&loops)?;
        Ok(self.tracks_of(&loops))
    }

    /// Paths as they are travelled, each with whether it is an outer one.
    pub(super) fn tracks_of(&self, loops: &[OffsetLoop]) -> Vec<(Track, bool)> {
        let spec = self.spec;
        // Material of the face lies on the right of an offset's loops; inside of it, that is not the material kept.
        let keeps_right = spec.side != ContourSide::Inside;
        let tracks = loops.iter().map(|l| {
            let track = Track::new(l.edges.clone());
            let track = if keeps_right == spec.keeps_right() { track } else { track.reversed() };
            (track, l.area() > 0.0)
        });
        tracks.collect()
    }

    /// No path comes too near to a loop of the outline that is not cut.
    fn spares_others(&self, loops: &[OffsetLoop]) -> Result<()> {
        let (Some(room), outline) = (self.spec.room, &self.spec.outline) else { return Ok(()) };
        let others = outline.loops().iter().filter(|l| !self.is_wanted(l.outer));
        let others: Vec<OutlineEdge> =
            others.flat_map(|l| outline.edges()[l.edges.clone()].iter().copied()).collect();
        if others.is_empty() {
            return Ok(());
        }
        let near = NearestEdge::new(&others);
        let Some(at) = loops.iter().flat_map(|l| &l.edges).find_map(|e| nearer(e, &near, room)) else {
            return Ok(());
        };
        let what = format!("the cutter also cuts the edge of another loop at ({:.3}, {:.3})", at.x, at.y);
        Err(Finding::error(Code::CUTTER_TOO_LARGE, what)
            .value_mm(near.at(at, room).map_or(room, |n| n.distance.abs()))
            .bound_mm(room)
            .point([at.x, at.y, 0.0])
            .help("cut that loop too: loops = \"all\"")
            .key("loops")
            .into())
    }

    /// Tracks in the order of cutting: those of holes first, each time the nearest one.
    pub(super) fn ordered<'t>(&self, tracks: &'t [(Track, bool)]) -> Vec<(&'t Track, bool)> {
        let mut left: Vec<&(Track, bool)> = tracks.iter().collect();
        let mut at = DVec2::ZERO;
        let mut order = Vec::with_capacity(left.len());
        while !left.is_empty() {
            let inner = left.iter().any(|(_, outer)| !outer);
            let far = |t: &&(Track, bool)| t.0.at(t.0.nearest(at)).0.distance(at);
            let next = (0..left.len())
                .filter(|&i| left[i].1 != inner)
                .min_by(|&a, &b| far(&left[a]).total_cmp(&far(&left[b])));
            let Some(next) = next else { break };
            let (track, outer) = left.remove(next);
            at = track.at(track.nearest(at)).0;
            order.push((track, *outer));
        }
        order
    }

    /// Whether the cutter's centre may be at a point with the wall at least so far away [mm].
    fn is_free(&self, p: DVec2, wall: f64) -> bool {
        let signed = self.near.at(p, wall).map(|n| n.distance);
        match (self.spec.side, signed) {
            (ContourSide::On, _) => true,
            (ContourSide::Left | ContourSide::Right, near) => near.is_none_or(|d| d >= wall - ROUNDING),
            (ContourSide::Outside, None) => !self.spec.outline.contains(p),
            (ContourSide::Inside, None) => self.spec.outline.contains(p),
            (ContourSide::Outside, Some(d)) => d >= wall - ROUNDING,
            (ContourSide::Inside, Some(d)) => -d >= wall - ROUNDING,
        }
    }

    /// Whether the cutter's centre may be all along a way.
    pub(super) fn is_open(&self, way: &[OutlineEdge], wall: f64) -> bool {
        way.iter().all(|e| (0..=8).all(|i| self.is_free(e.at(f64::from(i) / 8.0), wall)))
    }

    /// Radius of a lead where there is room [mm].
    pub(super) fn usual_lead(&self) -> f64 {
        self.spec.usual_lead()
    }

    /// Whether the path runs through a point.
    pub(super) fn runs_by(&self, p: DVec2) -> bool {
        self.loops.iter().flat_map(|l| &l.edges).any(|e| e.nearest(p).1 <= ROUNDING)
    }

    /// The place at which a loop begins, and a lead for which there is room; `free`: whether its free end is usable.
    pub(super) fn begin(
        &self,
        track: &Track,
        wall: f64,
        lead: impl Fn(f64, DVec2, DVec2) -> Lead,
        free: impl Fn(DVec2) -> bool,
        may: impl Fn(f64) -> bool,
    ) -> Result<Beginning> {
        let spec = self.spec;
        let a = spec.radius();
        let usual = self.usual_lead();
        let left = spec.keeps_right();
        let fits = |at: f64, radius: f64| {
            let (p, along) = track.at(at);
            // It is left a little beyond its beginning.
            let (q, on_from_there) = track.at(at + self.overlap());
            let lead = lead(radius, p, along);
            let lead = match spec.room {
                Some(room) => {
                    let back = |lead: &Lead| {
                        lead.on(p, along, left).iter().rev().map(OutlineEdge::reversed).collect()
                    };
                    let ways = |lead: &Lead| vec![back(lead), lead.off(q, on_from_there, left)];
                    reaching(lead, ways, self.near, (wall, room))?
                }
                None => lead,
            };
            let (on, off) = (lead.on(p, along, left), lead.off(q, on_from_there, left));
            let is_open = self.is_open(&on, wall) && self.is_open(&off, wall);
            (is_open && free(on[0].start)).then_some(Beginning { at, lead, wall })
        };
        if spec.side == ContourSide::On {
            // What is beside the line stays.
            let at = self.beginnings(track).first().copied().unwrap_or(0.0);
            return Ok(Beginning { at, lead: Lead::NONE, wall });
        }
        let places: Vec<f64> = self.beginnings(track).into_iter().filter(|place| may(*place)).collect();
        // First everywhere down to the usual least; in a hole hardly wider than the cutter there is room for less alone.
        let (mut from, mut tried) = (usual, usual);
        for least in [LEAST_LEAD * a, (TIGHT_LEAD * a).max(LEAST_ARC)] {
            for place in &places {
                let mut radius = from;
                loop {
                    tried = radius;
                    if let Some(found) = fits(*place, radius) {
                        return Ok(found);
                    }
                    // A radius that is given is kept.
                    if spec.lead_radius.is_some() || radius <= least {
                        break;
                    }
                    radius = (0.5 * radius).max(least);
                }
            }
            if spec.lead_radius.is_some() {
                break;
            }
            from = 0.5 * least;
        }
        let (p, _) = track.at(places.first().copied().unwrap_or(0.0));
        let what = format!(
            "no lead finds room beside the contour at ({:.3}, {:.3}): the smallest that was tried has a radius of {} mm",
            p.x,
            p.y,
            (tried * 1e4).round() / 1e4
        );
        let (key, help) = match spec.lead_radius.is_some() {
            true => ("lead_radius", "give a smaller lead_radius, or leave it out"),
            false if spec.onto_wall.is_some() => (
                "finish.compensation",
                "an entry on to the contour itself is as long as the cutter's radius asks for: write compensation = \"wear\", give another start, or take a smaller cutter",
            ),
            false => ("start", "give another start, or take a smaller cutter"),
        };
        Err(Finding::error(Code::LEAD_ROOM, what).point([p.x, p.y, 0.0]).help(help).key(key).into())
    }

    /// A lead whose free end lies so far from a wall [mm] and so much farther: where roughing has run.
    pub(super) fn beside(&self, lead: Lead, (p, along): (DVec2, DVec2), wall: f64, farther: f64) -> Lead {
        /// Lengths of line that are tried where a quarter turn does not reach, and by how much each is longer, in `farther`.
        const LONGER: (u32, f64) = (32, 0.125);
        let is_far = |lead: Lead| {
            let free = lead.on(p, along, self.spec.keeps_right())[0].start;
            self.near.at(free, wall + farther - ROUNDING).is_none()
        };
        // A quarter turn and the line reach as far aside as they are long together, but beside an inside arc.
        let line = if lead.radius + lead.line < farther { farther - lead.radius } else { lead.line };
        let longer = (0..LONGER.0).map(|i| line + f64::from(i) * LONGER.1 * farther);
        let reaches = |line: &f64| is_far(Lead { line: *line, angle: FRAC_PI_2, ..lead });
        let lead = Lead { line: longer.into_iter().find(reaches).unwrap_or(line), ..lead };
        // Beside a curved wall the angle is another than beside a straight one.
        let (mut low, mut high) = (0.0, FRAC_PI_2);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if is_far(Lead { angle: middle, ..lead }) {
                high = middle;
            } else {
                low = middle;
            }
        }
        Lead { angle: high, ..lead }
    }

    /// Places at which a loop may begin, the best first: the one asked for, or middles of edges, lines first, the longest
    /// first.
    fn beginnings(&self, track: &Track) -> Vec<f64> {
        if let Some(start) = self.spec.start {
            return vec![track.nearest(start)];
        }
        let left = self.spec.keeps_right();
        let mut edges: Vec<usize> = (0..track.edges().len()).collect();
        let rank = |i: usize| {
            let edge = &track.edges()[i];
            // Inside arcs last.
            let kind = match edge.turn {
                None => 0,
                Some(t) if (t.sweep > 0.0) == left => 2,
                Some(_) => 1,
            };
            let middle = edge.at(0.5);
            // Rounded, so that equal edges of a turned drawing stay equal.
            let coarse = |v: f64| (v * 1e6).round();
            (kind, -coarse(edge.length()), coarse(middle.y), coarse(middle.x))
        };
        edges.sort_by(|&x, &y| {
            let ((k, l, y0, x0), (m, n, y1, x1)) = (rank(x), rank(y));
            k.cmp(&m).then(l.total_cmp(&n)).then(y0.total_cmp(&y1)).then(x0.total_cmp(&x1))
        });
        edges
            .into_iter()
            .map(|i| {
                let [from, to] = track.stretch(i);
                0.5 * (from + to)
            })
            .collect()
    }

    /// Tabs of a loop that is roughed; places that are given belong to the nearest of all tracks.
    pub(super) fn tabs(&mut self, track: &Track, start: f64, all: &[(Track, bool)]) -> Vec<PlacedTab> {
        let Some(tabs) = &self.spec.tabs else { return Vec::new() };
        let far = |t: &Track, p: DVec2| t.at(t.nearest(p)).0.distance(p);
        let is_own = |p: &DVec2| all.iter().all(|(t, _)| far(track, *p) <= far(t, *p));
        let given = !tabs.places.is_empty();
        let own = Tabs { places: tabs.places.iter().copied().filter(is_own).collect(), ..tabs.clone() };
        if given && own.places.is_empty() {
            return Vec::new();
        }
        let found = placed(track, &own, start, self.spec.cutter.diameter);
        let wanted = if given { own.places.len() } else { own.count as usize };
        if found.len() < wanted {
            let (at, _) = track.at(start);
            let message = format!(
                "tabs: {wanted} wanted, {} fit on the loop that begins at ({:.3}, {:.3}): corners, small arcs and the leads are in the way",
                found.len(),
                at.x,
                at.y
            );
            let help = "take fewer or narrower tabs, or give their places: tabs = { places = [[x, y], ..] }";
            self.findings.push(Finding::warning(Code::TABS, message).help(help).key("tabs"));
        }
        self.together(track, start, &found);
        found
    }

    /// A warning where tabs of a loop run into one another.
    fn together(&mut self, track: &Track, start: f64, tabs: &[PlacedTab]) {
        let spec = self.spec;
        let slopes = spec.slopes(spec.tab_top() - spec.bottom(), false);
        let whole = track.length();
        let apart = lifted(tabs, whole, slopes, [start, start + whole]);
        // Of those that are apart each turn has as many.
        let count = apart.iter().filter(|[from, _]| (start..start + whole).contains(from)).count();
        if count < tabs.len() {
            let (at, _) = track.at(start);
            let left = match count {
                0 => "hold all of it".to_owned(),
                1 => "are 1".to_owned(),
                _ => format!("are {count}"),
            };
            let message = format!(
                "tabs: {} on the loop that begins at ({:.3}, {:.3}) run into one another and {left}: the cutter needs {:.1} mm beside each to come up and down",
                tabs.len(),
                at.x,
                at.y,
                slopes[0] + slopes[1]
            );
            let help = "take fewer or lower tabs, a steeper ramp, or a cutter that cuts at its centre";
            self.findings.push(Finding::warning(Code::TABS, message).help(help).key("tabs"));
        }
    }

    /// The tabs that roughing has left beside a track that is finished.
    fn left_tabs(&self, track: &Track, allowance: f64) -> Vec<PlacedTab> {
        let mut found = Vec::new();
        for one in self.loops.iter().filter(|l| !l.finishing && l.farther == 0.0) {
            for tab in &one.tabs {
                let s = track.nearest(tab.at);
                if track.at(s).0.distance(tab.at) <= 2.0 * allowance {
                    let half = 0.5 * tab.lifted();
                    found.push(PlacedTab { at: track.at(s).0, along: [s - half, s + half] });
                }
            }
        }
        found
    }

    pub(super) fn keep(&mut self, track: &Track, outer: bool, start: f64, tabs: &[PlacedTab]) {
        let edges = track.part(start, start + track.length());
        let finishing = self.travel.route.finishing;
        self.loops.push(PlannedLoop {
            edges,
            outer,
            finishing,
            farther: 0.0,
            tabs: tabs.to_vec(),
            piece: None,
        });
    }

    pub(super) fn overlap(&self) -> f64 {
        let usual = 0.5 * self.spec.radius();
        self.spec.overlap.unwrap_or(if usual < 2.0 { usual } else { 2.0 })
    }

    /// Finishes a loop; `rough`: the tracks that roughing has run.
    pub(super) fn finish(
        &mut self,
        track: &Track,
        outer: bool,
        rough: &[(Track, bool)],
        wall: f64,
        finish: &ContourFinish,
    ) -> Result<DVec2> {
        let spec = self.spec;
        let wear = finish.wear.map_or(0.0, |w| w.largest);
        let line = spec.switching();
        let tabs = match &spec.tabs {
            Some(t) if t.finish => self.left_tabs(track, finish.allowance),
            _ => Vec::new(),
        };
        // Off the tabs, and the ways up and down beside them, by a diameter.
        let [up, down] = spec.slopes(spec.tab_top() - spec.bottom(), finish.wear.is_some());
        let clear = |s: f64| {
            let beside = spec.cutter.diameter;
            tabs.iter().all(|tab| {
                let gone = (s - (tab.along[0] - up - beside)).rem_euclid(track.length());
                gone > tab.lifted() + up + down + 2.0 * beside
            })
        };
        let open =
            |p: DVec2| rough.iter().any(|(t, _)| t.at(t.nearest(p)).0.distance(p) <= 0.1 * finish.allowance);
        let start = self.begin(
            track,
            wall,
            |radius, p, along| {
                self.beside(Lead { radius, angle: 0.0, line }, (p, along), wall, finish.allowance)
            },
            open,
            clear,
        )?;
        if finish.wear.is_some() && start.lead.radius <= wear + 0.01 {
            let what = "the lead-in is too tight for this wear correction";
            let help = "allow a smaller wear_largest, or a larger lead_radius";
            return Err(out_of_range(
                "finish.wear_largest",
                what,
                wear,
                start.lead.radius - 0.01,
                "mm",
                help,
            ));
        }
        self.travel.route.finishing = true;
        self.keep(track, outer, start.at, &tabs);
        let depth = spec.depth + spec.breakthrough;
        let step = finish.stepdown.unwrap_or(spec.cutter.flute_length);
        let floors = levels(spec.top, depth, step, |_| Ok(0.0))?;
        let left = spec.keeps_right();
        let (p, along) = track.at(start.at);
        let on = self.entered(start.lead.on(p, along, left));
        let laps = f64::from(finish.spring_passes + 1);
        self.slow_down(track, rough.iter().map(|(t, _)| t), finish)?;
        if let Some(slower) = &mut self.travel.slower {
            slower.until = start.at + track.length();
        }
        let mut last = p;
        for level in &floors {
            self.travel.route.level = level.index;
            self.travel.route.over(on.first().map_or(p, |e| e.start));
            // Roughing has opened the way down.
            self.travel.route.vertically(ToolpathRole::Entry, ToolpathPace::Feed(finish.feed), level.floor);
            self.travel.route.comp = finish.wear.is_some();
            let first = self.travel.route.moves.len();
            self.travel.route.edges(ToolpathRole::LeadIn, finish.feed, &on)?;
            let end = start.at + laps * track.length() + self.overlap();
            let lap = Stretch { along: [start.at, end], heights: [level.floor; 2], feed: finish.feed };
            self.travel.follow(ToolpathRole::Finish, track, &tabs, lap)?;
            let (p, along) = track.at(end);
            let off = start.lead.off(p, along, left);
            self.travel.route.edges(ToolpathRole::LeadOut, finish.feed, &off[..1])?;
            self.travel.route.comp = false;
            self.travel.route.edges(ToolpathRole::LeadOut, finish.feed, &off[1..])?;
            self.onto_wall(first)?;
            last = p;
        }
        self.travel.slower = None;
        Ok(last)
    }

    /// Lets the feed of a finish along a track be reduced in corners, if it is to be; `rough`: the tracks that roughing has run.
    pub(super) fn slow_down<'t>(
        &mut self,
        track: &Track,
        rough: impl Iterator<Item = &'t Track>,
        finish: &ContourFinish,
    ) -> Result<()> {
        self.travel.slower = None;
        if finish.corner_feed {
            let slowed = self.slowed.unwrap_or(SlowedFeed::NONE);
            let found = CornerFeed::of(track, rough, finish, self.spec.radius())?;
            self.slowed = Some(slowed.and(found.as_ref().map_or(SlowedFeed::AHEAD, |(_, more)| *more)));
            self.travel.slower = found.map(|(feed, _)| feed);
        }
        Ok(())
    }

    /// A way on with its straight way behind the entry as an edge of its own.
    pub(super) fn entered(&self, mut on: Vec<OutlineEdge>) -> Vec<OutlineEdge> {
        let behind = self.spec.onto_wall.map_or(0.0, |[_, on]| on * self.spec.radius());
        if let Some(line) = on.first().copied().filter(|e| behind > 0.0 && e.turn.is_none()) {
            let at = line.at(1.0 - behind / line.length());
            on[0] = OutlineEdge::line(at, line.end);
            on.insert(0, OutlineEdge::line(line.start, at));
        }
        on
    }

    /// The moves from an index on as those of the wall, where the register holds the cutter's radius.
    pub(super) fn onto_wall(&mut self, first: usize) -> Result<()> {
        if self.spec.onto_wall.is_none() {
            return Ok(());
        }
        let radius = self.spec.radius();
        let mut moves = self.travel.route.moves.split_off(first);
        onto_wall(&mut moves, if self.spec.keeps_right() { radius } else { -radius })?;
        self.travel.route.moves.append(&mut moves);
        Ok(())
    }
}
