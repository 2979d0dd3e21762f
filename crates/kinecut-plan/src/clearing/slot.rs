//! The plan of a slot: loops of a trochoid, or passes as wide as the cutter.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;

use super::centre_line::CentreLine;
use super::level::{Cleared, Element, Pass};
use super::link::{Pose, ways};
use super::moves::run;
use super::plan::{CELLS, ENGAGEMENT, FIT, HELIX, PocketPlan, WALL_STOCK, check, entries, figures, place};
use super::region::CentreRegion;
use super::spec::PocketSpec;
use super::swept::{Clearing, Scratch};
use super::trochoid::Trochoid;
use crate::base::{Code, CountBound, Finding, Result};
use crate::geom::{Outline, OutlineEdge};
use crate::holes::CutterData;
use crate::holes::levels::levels;
use crate::holes::route::Route;
use crate::num::angle::wrap_positive;

/// Difference of the width from the cutter's diameter that is nothing [mm].
pub const AS_WIDE: f64 = 0.01;
/// Least radius of a loop, in radii of the cutter: on smaller ones a cutter hardly leaves its place.
const LEAST_LOOP: f64 = 0.05;
/// Radius of the arcs on which a loop goes back, in radii of the loop.
const BACK: f64 = 0.5;
/// Chords by which loops are looked at [rad].
const LOOK: f64 = 0.05;
/// Least room around the cutter in a hole by which it goes down [mm].
const HOLE_ROOM: f64 = 0.5;

const LOOPS: CountBound = CountBound { what: "loops along the slot", most: 2e4, bytes: 2000, ..CELLS };

/// A slot: a line of a width, with round ends.
#[derive(Clone, Debug, PartialEq)]
pub struct SlotSpec {
    /// Its centre line, between the centres of its ends, in coordinates of the work offset.
    pub line: CentreLine,
    /// Its width [mm].
    pub width: f64,
    /// Cutter, heights, feeds, engagement; the outline is that of the slot. An engagement of a half turn allows passes as wide
    /// as the cutter.
    pub pocket: PocketSpec,
}

impl SlotSpec {
    /// A slot of a depth [mm] with usual values at a feed [mm/s].
    ///
    /// # Errors
    /// Those of [`CentreLine::outline`].
    pub fn new(line: CentreLine, width: f64, depth: f64, cutter: CutterData, feed: f64) -> Result<SlotSpec> {
        let pocket = PocketSpec::new(line.outline(width)?, depth, cutter, feed);
        Ok(SlotSpec { line, width, pocket })
    }

    /// Width that is roughed [mm].
    fn rough_width(&self) -> f64 {
        self.width - 2.0 * self.pocket.allowance
    }

    /// Radius of the loops of the cutter's centre; `None` where the slot is hardly wider than the cutter [mm].
    pub fn around(&self) -> Option<f64> {
        let around = 0.5 * self.rough_width() - WALL_STOCK - self.pocket.radius();
        (around > LEAST_LOOP * self.pocket.radius()).then_some(around)
    }
}

/// Plans the clearing of a slot.
///
/// The cutter goes in loops of a trochoid where there is room beside it: their largest engagement is the wanted one, the front
/// of a loop cuts, and the way back is shorter and faster. Without room, passes go along the line with all of the cutter in the
/// stock. Both begin at an open end or at a hole, where there is one.
///
/// # Errors
/// `KC0401` where the cutter is too wide, `KC0403` where it cannot enter, `KC0404` for numbers out of range, among them an
/// engagement below 180 degrees for a slot as wide as the cutter. Keys are those of the table of the operation.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::clearing::{CentreLine, SlotSpec, plan_slot};
/// use kinecut::holes::CutterData;
/// let cutter = CutterData { diameter: 10.0, centre_cutting: true, max_ramp_angle: None, flute_length: 22.0 };
/// let line = CentreLine::line(dvec2(-30.0, 0.0), dvec2(30.0, 0.0))?;
/// let plan = plan_slot(&SlotSpec::new(line, 13.0, 6.0, cutter, 10.0)?)?;
/// assert!(plan.figures.largest.to_degrees() < 60.5);
/// assert!(plan.figures.largest.to_degrees() > 58.0);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn plan_slot(spec: &SlotSpec) -> Result<PocketPlan> {
    let pocket = &spec.pocket;
    let a = pocket.radius();
    let around = spec.around();
    fits(spec)?;
    if around.is_none() && pocket.engagement < PI - 1e-6 {
        return Err(as_wide(spec).into());
    }
    check(pocket, if around.is_some() { ENGAGEMENT } else { [180.0, 180.0] })?;
    // Conventional is climb in the mirror.
    let mirrored = !pocket.keeps_right();
    let flip = |p: DVec2| if mirrored { DVec2::new(p.x, -p.y) } else { p };
    let turned = |outline: &Outline| if mirrored { outline.mirrored() } else { outline.clone() };
    let stock = pocket.stock.as_ref().map(turned);
    let holes: Vec<(DVec2, f64)> = pocket.holes.iter().map(|(p, r)| (flip(*p), *r)).collect();
    let around_now = around.unwrap_or(0.0);
    let free = Free { stock: stock.as_ref(), holes: &holes };
    let line = if mirrored { spec.line.mirrored() } else { spec.line.clone() };
    let line = free.freer_end_first(line, a, around_now + a);
    let face = turned(&pocket.outline);
    let bounds = face.bounds();
    CELLS.check(Clearing::cells(bounds, a))?;
    let mut clearing = Clearing::new(bounds, a);
    if let Some(stock) = &stock {
        clearing = clearing.with_stock(stock);
    }
    for (p, radius) in holes.iter().filter(|(_, radius)| *radius >= a) {
        clearing.sweep(*p, *p, *radius);
    }
    let region = CentreRegion::new(&face, a + pocket.allowance + WALL_STOCK)?.map(|r| r.with_far(a));
    let reached = |p: DVec2, less: f64| region.as_ref().is_some_and(|r| r.room_within(p, a) > less - a);
    let width = clearing.cell_width();
    let stock_area = clearing.remains(|p| reached(p, 0.0)).len() as f64 * width * width;
    let mut cleared = match around {
        Some(around) => {
            let loops = Trochoid { cutter: a, around };
            let mut looper = Looper::new(spec, &line, loops, &mut clearing);
            looper.enter(&free)?;
            looper.run()?;
            looper.cleared
        }
        None => as_wide_as_cutter(spec, &line, &free)?,
    };
    if around.is_some() {
        cleared.measure(&clearing, |p| reached(p, width));
    }
    if mirrored {
        cleared.mirror();
    }
    entries(pocket, &cleared)?;
    let depth = pocket.depth + pocket.breakthrough;
    let floors = levels(pocket.top, depth, pocket.stepdown.unwrap_or(pocket.cutter.flute_length), |_| Ok(a))?;
    let mut route = Route::new(pocket.retract_z, pocket.approach_z);
    for level in &floors {
        route.level = level.index;
        run(pocket, &cleared, &mut route, [level.above, level.floor])?;
    }
    route.retract();
    let area = match &region {
        Some(region) => region.reached(a),
        None => spec.line.outline(pocket.cutter.diameter)?.area(),
    };
    let is_whole = stock.is_none() && holes.is_empty() || region.is_none();
    let figures = figures(pocket, [area, if is_whole { area } else { stock_area.min(area) }], &cleared);
    let deepest = floors.iter().map(|l| l.above - l.floor).fold(0.0, f64::max);
    let findings = deep(spec, deepest).filter(|_| around.is_none()).into_iter().collect();
    let levels = floors.iter().map(|l| l.floor).collect();
    Ok(PocketPlan { moves: route.moves, levels, figures, findings })
}

/// Whether the cutter is not wider than what is roughed.
fn fits(spec: &SlotSpec) -> Result<()> {
    let (width, diameter) = (spec.rough_width(), spec.pocket.cutter.diameter);
    if width >= diameter - AS_WIDE {
        return Ok(());
    }
    let what = "the cutter is wider than the slot";
    let finding = Finding::error(Code::CUTTER_TOO_LARGE, what).value_mm(diameter).bound_mm(width);
    let help = match spec.pocket.allowance > 0.0 {
        true => "take a smaller cutter, or leave less stock on the walls",
        false => "take a smaller cutter",
    };
    Err(finding.help(help).key("tool").into())
}

/// An error where there is no room for loops, and passes with all of the cutter in the stock are not allowed.
fn as_wide(spec: &SlotSpec) -> Finding {
    let diameter = spec.pocket.cutter.diameter;
    let what = format!(
        "a slot of {:.3} mm leaves no room for loops to a cutter of {:.3} mm: it cuts with 180 degrees over {:.1} mm",
        spec.width,
        diameter,
        spec.line.length()
    );
    Finding::error(Code::PLAN_VALUE, what)
        .value(180.0, "deg")
        .bound(spec.pocket.engagement.to_degrees(), "deg")
        .help(format!("write engagement = 180, or take a cutter of {:.1} mm or less", 0.85 * spec.width))
        .key("engagement")
}

/// A warning where levels are deep for a cutter that is wholly in the stock.
fn deep(spec: &SlotSpec, depth: f64) -> Option<Finding> {
    let diameter = spec.pocket.cutter.diameter;
    (depth > diameter + 1e-9).then(|| {
        Finding::warning(
            Code::FULL_WIDTH,
            "levels are deeper than the cutter is wide, and all of its width cuts",
        )
        .value_mm(depth)
        .bound_mm(diameter)
        .help(format!(
            "usual is half the diameter in steel, the diameter in aluminium: stepdown = {}",
            0.5 * diameter
        ))
        .key("stepdown")
    })
}

/// Passes with all of the cutter in the stock.
fn as_wide_as_cutter(spec: &SlotSpec, line: &CentreLine, free: &Free<'_>) -> Result<Cleared> {
    let pocket = &spec.pocket;
    let a = pocket.radius();
    let start = line.pose(0.0).at;
    let edges = line.edges().to_vec();
    let mut cleared = Cleared::default();
    if free.hole(start, a).is_some() {
        cleared.elements.push(Element::Down(start));
        cleared.elements.push(Element::Pass(Pass { edges, largest: PI }));
        return Ok(cleared);
    }
    if !pocket.cutter.centre_cutting && line.length() < pocket.cutter.diameter {
        let what = format!("no way in at {}: the ramp is shorter than the cutter is wide", place(start));
        return Err(Finding::error(Code::ENTRY_IMPOSSIBLE, what)
            .value_mm(line.length())
            .bound_mm(pocket.cutter.diameter)
            .help("take a cutter that cuts at its centre, or drill a hole at an end of the slot")
            .key("tool")
            .into());
    }
    cleared.elements.push(Element::Ramp(edges));
    Ok(cleared)
}

/// Places without stock before the slot is cut.
struct Free<'a> {
    stock: Option<&'a Outline>,
    holes: &'a [(DVec2, f64)],
}

impl Free<'_> {
    /// Radius of the free circle around a point, 0 in the stock [mm].
    fn around(&self, at: DVec2) -> f64 {
        let outside = self
            .stock
            .filter(|s| !s.contains(at))
            .map_or(0.0, |stock| stock.edges().iter().map(|e| e.nearest(at).1).fold(f64::INFINITY, f64::min));
        self.holes.iter().map(|(p, radius)| radius - p.distance(at)).fold(outside, f64::max)
    }

    /// Radius of the free circle around a point, where a cutter of a radius [mm] goes down in it without touching.
    fn hole(&self, at: DVec2, radius: f64) -> Option<f64> {
        let room = self.around(at);
        (room >= radius + HOLE_ROOM).then_some(room)
    }

    /// A line, turned so that it begins at the end with more room; `reach`: that of the loops [mm].
    fn freer_end_first(&self, line: CentreLine, radius: f64, reach: f64) -> CentreLine {
        let [start, end] = [0.0, line.length()].map(|along| line.pose(along).at);
        let value = |at: DVec2| match self.around(at) {
            room if room >= reach => 2,
            _ if self.hole(at, radius).is_some() => 1,
            _ => 0,
        };
        if value(end) > value(start) { line.reversed() } else { line }
    }
}

/// Loops along a line.
struct Looper<'a> {
    spec: &'a SlotSpec,
    line: &'a CentreLine,
    loops: Trochoid,
    clearing: &'a mut Clearing,
    work: Scratch,
    here: Option<Pose>,
    cleared: Cleared,
}

impl<'a> Looper<'a> {
    fn new(
        spec: &'a SlotSpec,
        line: &'a CentreLine,
        loops: Trochoid,
        clearing: &'a mut Clearing,
    ) -> Looper<'a> {
        let (work, cleared) = (Scratch::default(), Cleared::default());
        Looper { spec, line, loops, clearing, work, here: None, cleared }
    }

    fn wanted(&self) -> f64 {
        self.spec.pocket.engagement - FIT
    }

    /// The place at which a loop begins: on the right of the line.
    fn beginning(&self, of: Pose) -> Pose {
        Pose { at: of.at + self.loops.around * DVec2::from_angle(of.heading - FRAC_PI_2), ..of }
    }

    /// Comes down at the start of the line, and clears the circle of a loop there.
    fn enter(&mut self, free: &Free<'_>) -> Result<()> {
        let (a, around) = (self.loops.cutter, self.loops.around);
        let start = self.line.pose(0.0);
        let beginning = self.beginning(start);
        let right = DVec2::from_angle(start.heading - FRAC_PI_2);
        if free.around(start.at) >= around + a {
            self.cleared.elements.push(Element::Down(beginning.at));
            self.here = Some(beginning);
            return Ok(());
        }
        let mut cleared = match free.hole(start.at, a) {
            Some(room) => {
                self.cleared.elements.push(Element::Down(start.at));
                let out = (room - a).min(around);
                self.cleared
                    .elements
                    .push(Element::Back(vec![OutlineEdge::line(start.at, start.at + out * right)]));
                out
            }
            None => {
                let radius = self.spec.pocket.helix_radius.unwrap_or(HELIX * a).min(around);
                self.clearing.sweep(start.at, start.at, radius + a);
                let from = start.heading - FRAC_PI_2;
                self.cleared.elements.push(Element::Helix { middle: start.at, radius, from });
                radius
            }
        };
        // Rings about the same centre, each reached on a half circle and gone around once.
        let mut angle = start.heading - FRAC_PI_2;
        let mut edges = Vec::new();
        let mut count = 0.0;
        while cleared < around - 1e-9 {
            let next = self.loops.ring(cleared + a, self.wanted()).min(around);
            count += 1.0;
            LOOPS.check(if next > cleared { count } else { f64::INFINITY })?;
            let out = DVec2::from_angle(angle);
            let middle = start.at + 0.5 * (cleared - next) * out;
            edges.push(OutlineEdge::arc(middle, 0.5 * (cleared + next), angle, PI));
            angle += PI;
            edges.push(OutlineEdge::arc(start.at, next, angle, PI));
            edges.push(OutlineEdge::arc(start.at, next, angle + PI, PI));
            cleared = next;
        }
        if (DVec2::from_angle(angle) - right).length() > 1.0 {
            edges.push(OutlineEdge::arc(start.at, around, angle, PI));
        }
        self.pass(edges, 0.0);
        self.here = Some(beginning);
        Ok(())
    }

    /// Loops up to the end of the line.
    fn run(&mut self) -> Result<()> {
        let length = self.line.length();
        let pitch = self.loops.pitch(self.wanted());
        let count = (length / pitch - 1e-9).ceil().max(1.0);
        LOOPS.check(count)?;
        // All of the circle around the first centre is free by now.
        let around = self.loops.around;
        let mut last = self.line.pose(0.0).at;
        for k in 1..=count as usize {
            let centre = self.line.pose(length * k as f64 / count);
            let ahead = (centre.at - last).to_angle();
            // The first loop goes on from the circle around the start; the others leave what the one before has cleared.
            let from = match k {
                1 => centre.heading - FRAC_PI_2,
                _ => ahead + self.loops.leaves(centre.at.distance(last)),
            };
            let sweep = wrap_positive(centre.heading + FRAC_PI_2 - from);
            let front = OutlineEdge::arc(centre.at, around, from, sweep);
            let start = Pose { at: front.start, heading: from + FRAC_PI_2 };
            if k == 1 {
                let edges = self.here.map(|here| OutlineEdge::line(here.at, start.at));
                self.pass(edges.into_iter().chain([front]).collect(), 0.0);
            } else {
                let back = self.go_back(start);
                self.pass(vec![front], back);
            }
            self.here = Some(Pose { at: front.end, heading: centre.heading + PI });
            last = centre.at;
        }
        Ok(())
    }

    /// The way from the end of a loop to the beginning of the next; the engagement on it [rad].
    fn go_back(&mut self, to: Pose) -> f64 {
        let Some(here) = self.here.filter(|here| here.at.distance(to.at) > 1e-9) else { return 0.0 };
        let arcs = ways(here, to, BACK * self.loops.around).into_iter().next();
        let edges = arcs.unwrap_or_else(|| vec![OutlineEdge::line(here.at, to.at)]);
        let largest = self.look(&edges);
        self.cleared.elements.push(Element::Back(edges));
        largest
    }

    /// Along edges that cut, after a way with an engagement [rad].
    fn pass(&mut self, edges: Vec<OutlineEdge>, before: f64) {
        if edges.is_empty() {
            return;
        }
        let largest = self.look(&edges).max(before);
        self.cleared.elements.push(Element::Pass(Pass { edges, largest }));
    }

    /// Sweeps along edges; the largest engagement on the way [rad].
    fn look(&mut self, edges: &[OutlineEdge]) -> f64 {
        let a = self.loops.cutter;
        let mut largest = 0.0_f64;
        for edge in edges {
            let turn = edge.turn.map_or(0.0, |t| t.sweep.abs());
            let count = (turn / LOOK).ceil().max((edge.length() / (LOOK * a)).ceil()).max(1.0);
            let mut last = edge.start;
            for k in 1..=count as usize {
                let share = k as f64 / count;
                let at = edge.at(share);
                let engaged = self.clearing.engaged(at, edge.heading(share), a, &mut self.work).total;
                largest = largest.max(engaged);
                self.clearing.sweep(last, at, a);
                last = at;
            }
        }
        largest
    }
}
