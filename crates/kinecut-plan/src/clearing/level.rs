//! The clearing of one level: passes one after the other until nothing is left.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use super::entry::{Entering, NoWayIn, WayIn};
use super::link::{Pose, ways};
use super::region::CentreRegion;
use super::rest::Rest;
use super::starts::Starts;
use super::swept::{Clearing, Scratch};
use super::walk::{Walker, Way, step_of};
use crate::geom::{Outline, OutlineEdge, arcs_near};

/// Circle on which stock is looked for, in radii of the cutter: what the chords of a way leave at a wall is no stock.
const TOUCH: f64 = 0.995;
/// Stretch of the circle that is rounding [rad].
const ROUNDING: f64 = 1e-3;
/// Length between two looks along a link, in radii of the cutter.
const LINK_STEP: f64 = 0.05;
/// Radii of the arcs of links that are tried, in radii of the cutter.
const LINK_RADII: [f64; 2] = [0.5, 0.25];
/// Least room around the cutter in a hole by which it goes down [mm].
const HOLE_ROOM: f64 = 0.5;
/// Rings about a point on which a pass may begin, and those that are tried first, a tenth of a radius apart.
const RINGS: u32 = 12;
const FRONT_RINGS: u32 = 5;
/// Share of the cutter's radius that the chords of a way may leave at a wall.
const WALL: f64 = 0.02;
/// Most looks for slivers: each is followed by ways over them.
const SLIVER_LOOKS: usize = 4;
/// Distance between the middle of the cutter and a sliver at the end of the way over it, in radii of the cutter.
const OVER: f64 = 0.4;
/// Distance between looks for a free place in a part, in radii of the cutter.
const FREE_STEP: f64 = 0.25;
/// Area that may be left at one place [mm2].
const LEFT: f64 = 0.25;
/// Share of the area that may be left in all.
const LEFT_SHARE: f64 = 1e-4;

/// A part of the way that clears a level.
#[derive(Clone, Debug)]
pub(super) enum Element {
    /// Down on a helix, from above: its middle, radius [mm], and the polar angle at which it begins and ends [rad].
    Helix { middle: DVec2, radius: f64, from: f64 },
    /// Down from above to a cleared place.
    Down(DVec2),
    /// Through what is cleared.
    Link(Vec<OutlineEdge>),
    /// Through what is cleared, on the floor.
    Back(Vec<OutlineEdge>),
    /// Down along a way, to and fro, with all of the cutter in the stock, and once along it on the floor.
    Ramp(Vec<OutlineEdge>),
    /// The same as an entry: the last way along the floor runs from the first edge to the last.
    RampIn(Vec<OutlineEdge>),
    /// Straight down into the stock, and once along a way on the floor, which may have no edges.
    PlungeIn(DVec2, Vec<OutlineEdge>),
    /// A pass.
    Pass(Pass),
}

/// A pass.
#[derive(Clone, Debug)]
pub(super) struct Pass {
    pub(super) edges: Vec<OutlineEdge>,
    /// Largest engagement at a point [rad].
    pub(super) largest: f64,
}

/// The ways that clear a level.
#[derive(Clone, Debug, Default)]
pub(super) struct Cleared {
    pub(super) elements: Vec<Element>,
    /// Area that is left [mm2].
    pub(super) left: f64,
    /// The largest place that is left: its area [mm2], and a point of it.
    pub(super) largest_left: Option<(f64, DVec2)>,
    /// A point of stock between passes, beyond the reach of the lap along the wall, over which no way goes.
    pub(super) standing: Option<DVec2>,
    /// A part that cannot be entered: nothing after it is cleared.
    pub(super) no_way_in: Option<NoWayIn>,
}

impl Cleared {
    /// Measures what is left of the area that `reached` has.
    pub(super) fn measure(&mut self, clearing: &Clearing, reached: impl Fn(DVec2) -> bool) {
        self.left_at(&clearing.remains(reached), clearing.cell_width());
    }

    /// Keeps the area and the largest place of points that are left, the middles of cells of a width [mm].
    fn left_at(&mut self, points: &[DVec2], width: f64) {
        self.left = points.len() as f64 * width * width;
        self.largest_left = largest(points, width);
    }

    /// With `y` and `-y` exchanged.
    pub(super) fn mirror(&mut self) {
        let flip = |p: DVec2| DVec2::new(p.x, -p.y);
        let flipped = |edges: &mut Vec<OutlineEdge>| {
            for edge in edges {
                *edge = edge.mirrored().reversed();
            }
        };
        self.largest_left = self.largest_left.map(|(area, p)| (area, flip(p)));
        self.standing = self.standing.map(flip);
        self.no_way_in = self.no_way_in.map(|part| NoWayIn { at: flip(part.at), ..part });
        for element in &mut self.elements {
            match element {
                Element::Helix { middle, from, .. } => (*middle, *from) = (flip(*middle), -*from),
                Element::Down(at) => *at = flip(*at),
                Element::Link(edges)
                | Element::Back(edges)
                | Element::Ramp(edges)
                | Element::RampIn(edges) => flipped(edges),
                Element::PlungeIn(at, edges) => {
                    *at = flip(*at);
                    flipped(edges);
                }
                Element::Pass(pass) => flipped(&mut pass.edges),
            }
        }
    }
}

/// A region that is being cleared.
pub(super) struct Clearer<'a> {
    pub(super) region: &'a CentreRegion,
    pub(super) clearing: &'a mut Clearing,
    /// Radius of the cutter [mm].
    pub(super) radius: f64,
    /// Engagement that is kept [rad].
    pub(super) wanted: f64,
    /// Round holes that are open already, swept before: centre and radius [mm].
    pub(super) holes: &'a [(DVec2, f64)],
    /// The ways by which the cutter may enter.
    pub(super) entering: Entering,
    /// Whether most of the region may be free already, off its wall too.
    pub(super) is_rest: bool,
    /// Distance of the lines and arcs from the way that was walked [mm].
    pub(super) tolerance: f64,
}

impl Clearer<'_> {
    fn touches(&self, at: DVec2, heading: f64, work: &mut Scratch) -> bool {
        let radius = TOUCH * self.radius;
        if self.clearing.is_in_untouched(at, heading, radius) {
            return true;
        }
        let mut uncut = |heading: f64| self.clearing.engaged(at, heading, radius, work).largest;
        uncut(heading) > ROUNDING || uncut(heading + PI) > ROUNDING
    }

    /// Area of the stock that the cutter reaches, by the middles of cells [mm2].
    pub(super) fn stock_area(&self) -> f64 {
        let width = self.clearing.cell_width();
        self.clearing.remains(|p| self.region.room_within(p, self.radius) > -self.radius).len() as f64
            * width
            * width
    }

    /// Clears all that the cutter reaches.
    pub(super) fn run(&mut self) -> Cleared {
        let mut cleared = Cleared::default();
        let mut starts = Starts::new(&self.region.loops, self.radius);
        let [low, high] = self.region.bounds();
        let box_area = (high.x - low.x + 2.0 * self.radius) * (high.y - low.y + 2.0 * self.radius);
        // Steps of all passes: so many that a pocket is cleared many times over.
        let step = step_of(self.radius);
        let mut most = (20.0 * box_area / (step * self.radius * (1.0 - self.wanted.cos()))).max(1e4) as usize;
        let mut here: Option<Pose> = None;
        let mut work = Scratch::default();
        let region = self.region;
        for (one, around) in
            region.loops.iter().enumerate().filter_map(|(i, l)| Some((i, l.around.as_ref()?)))
        {
            // An open side, or a place that is free already, needs no entry.
            if starts.of(one).iter().any(|p| !self.touches(p.at, p.heading, &mut work))
                || self.is_rest && self.has_free_place(around, &mut work)
            {
                continue;
            }
            if let Some((start, begin)) = self.drilled(around) {
                cleared.elements.push(Element::Down(start));
                cleared.elements.push(Element::Link(vec![OutlineEdge::line(start, begin.at)]));
                let way = self.walk(begin, &mut most, &mut work);
                here = self.keep(&way, &mut cleared).or(Some(begin));
                continue;
            }
            let way = match self.entering.way_in(around, |p| region.holds(p), self.tolerance) {
                Ok(way) => way,
                Err(part) => {
                    cleared.no_way_in = Some(part);
                    return cleared;
                }
            };
            self.enter(way, &mut cleared, &mut here, &mut most, &mut work);
        }
        starts.update(None, |p| self.touches(p.at, p.heading, &mut work));
        let mut rest = None;
        loop {
            // Passes begin where the wall leaves what is cleared, the nearest first.
            let next = starts.nearest(here.map(|here| here.at));
            let (start, of) = match next {
                Some(i) => (starts.place(i), None),
                None => match self.elsewhere(&mut rest, here.map_or(DVec2::ZERO, |h| h.at)) {
                    Some((place, of)) => (place, Some(of)),
                    None => break,
                },
            };
            if most == 0 {
                break;
            }
            // Before the pass, as the link runs through what is cleared by then.
            let link = here.and_then(|here| self.link(here, start, &mut work));
            let down = if link.is_some() { None } else { Some(self.way_in(start, &mut work)) };
            let way = self.walk(start, &mut most, &mut work);
            if way.cutting < 2.0 * step {
                next.into_iter().for_each(|i| starts.give_up(i));
                if let (Some(rest), Some(of)) = (&mut rest, of) {
                    rest.cut_nothing(of, self.radius);
                }
            }
            if way.cutting > 0.0 {
                match (link, down) {
                    (Some(edges), _) => cleared.elements.push(Element::Link(edges)),
                    (None, Some((at, edges))) => {
                        cleared.elements.push(Element::Down(at));
                        if !edges.is_empty() {
                            cleared.elements.push(Element::Link(edges));
                        }
                    }
                    _ => {}
                }
                let clearing = &*self.clearing;
                rest.iter_mut().for_each(|rest: &mut Rest| rest.passed(&way.points, clearing));
                starts.update(Some(&way.points), |p| self.touches(p.at, p.heading, &mut work));
                here = self.keep(&way, &mut cleared).or(here);
            }
        }
        match most {
            // The steps were used up.
            0 => cleared.standing = self.standing().first().copied(),
            _ => self.sweep_slivers(&mut cleared, here, &mut work),
        }
        let mut rest = rest.unwrap_or_else(|| Rest::new(self.clearing, |p| self.is_reached(p)));
        rest.update(self.clearing);
        cleared.left_at(&rest.points(), self.clearing.cell_width());
        // In all, up to the wall.
        let border = (WALL - 1.0) * self.radius;
        let up_to_wall = self.clearing.remains(|p| self.region.room_within(p, self.radius) > border);
        cleared.left = up_to_wall.len() as f64 * self.clearing.cell_width().powi(2);
        cleared
    }

    /// Whether the cutter finds a place in a part at which it does not cut.
    fn has_free_place(&self, of: &Outline, work: &mut Scratch) -> bool {
        let [low, high] = of.bounds();
        let step = FREE_STEP * self.radius;
        let count = |length: f64| (length / step).ceil() as usize;
        let at = |i: usize, j: usize| low + step * DVec2::new(i as f64, j as f64);
        let mut places =
            (0..=count(high.x - low.x)).flat_map(|i| (0..=count(high.y - low.y)).map(move |j| at(i, j)));
        places.any(|p| self.region.holds(p) && of.contains(p) && !self.touches(p, 0.0, work))
    }

    /// Goes down into a part, and along the first pass there.
    fn enter(
        &mut self,
        way: WayIn,
        cleared: &mut Cleared,
        here: &mut Option<Pose>,
        most: &mut usize,
        work: &mut Scratch,
    ) {
        for edge in way.edges() {
            let count =
                edge.turn.map_or(1.0, |_| (edge.length() / (LINK_STEP * self.radius)).ceil().max(1.0));
            let at = |k: usize| edge.at(k as f64 / count);
            for k in 0..count as usize {
                self.clearing.sweep(at(k), at(k + 1), self.radius);
            }
        }
        let mut start = way.pass_begins();
        match way {
            WayIn::Helix { middle, radius } => {
                let from = 0.0;
                self.clearing.sweep(middle, middle, radius + self.radius);
                let at = middle + radius * DVec2::from_angle(from);
                start = Some(Pose { at, heading: from + FRAC_PI_2 });
                cleared.elements.push(Element::Helix { middle, radius, from });
            }
            WayIn::Ramp(edges) => cleared.elements.push(Element::RampIn(edges)),
            WayIn::Plunge(at, edges) => {
                self.clearing.sweep(at, at, self.radius);
                cleared.elements.push(Element::PlungeIn(at, edges));
                start = start.or(Some(Pose { at, heading: 0.0 }));
            }
        }
        let Some(start) = start else { return };
        let way = self.walk(start, most, work);
        *here = self.keep(&way, cleared).or(Some(start));
    }

    /// Sweeps what stands between passes, too little for a pass of its own: straight over it. What lies so near to the wall that
    /// the lap along it takes it stays.
    fn sweep_slivers(&mut self, cleared: &mut Cleared, mut here: Option<Pose>, work: &mut Scratch) {
        for _ in 0..SLIVER_LOOKS {
            let mut slivers = self.standing();
            cleared.standing = slivers.first().copied();
            let mut swept = false;
            while let Some(i) = nearest(&slivers, here.map_or(DVec2::ZERO, |here| here.at)) {
                let p = slivers.swap_remove(i);
                if self.clearing.is_clear(p) {
                    continue;
                }
                let Some((start, end, largest)) = self.over(p, work) else { continue };
                match here.and_then(|here| self.link(here, start, work)) {
                    Some(edges) => cleared.elements.push(Element::Link(edges)),
                    None => cleared.elements.push(Element::Down(start.at)),
                }
                self.clearing.sweep(start.at, end, self.radius);
                let edges = vec![OutlineEdge::line(start.at, end)];
                cleared.elements.push(Element::Pass(Pass { edges, largest }));
                here = Some(Pose { at: end, heading: start.heading });
                swept = true;
            }
            if !swept {
                return;
            }
        }
        cleared.standing = self.standing().first().copied();
    }

    /// Points of stock that no pass has swept, and that the lap along the wall does not reach.
    fn standing(&self) -> Vec<DVec2> {
        self.clearing.slivers(|p| self.region.room_within(p, self.radius) >= self.radius)
    }

    /// A straight way over a point within the wanted engagement, from where nothing is cut: its beginning, its end, and the
    /// largest engagement [rad].
    fn over(&self, p: DVec2, work: &mut Scratch) -> Option<(Pose, DVec2, f64)> {
        self.free_places(p, RINGS).find_map(|(at, out)| {
            if self.touches(at, out, work) {
                return None;
            }
            let heading = out + PI;
            let along = DVec2::from_angle(heading);
            let length = at.distance(p) - OVER * self.radius;
            let count = (length / (LINK_STEP * self.radius)).ceil();
            let mut largest = 0.0_f64;
            let fits = (1..=count as usize).all(|k| {
                let at = at + k as f64 / count * length * along;
                let engaged = self.clearing.engaged(at, heading, self.radius, work).total;
                largest = largest.max(engaged);
                self.region.holds(at) && engaged <= self.wanted
            });
            fits.then_some((Pose { at, heading }, at + length * along, largest))
        })
    }

    /// Places of the region on rings about a point, the nearest ring first, each with its direction from the point [rad]: there the
    /// cutter just does not touch the point.
    fn free_places(&self, p: DVec2, rings: u32) -> impl Iterator<Item = (DVec2, f64)> + '_ {
        const PLACES: u32 = 48;
        let places = (0..rings).flat_map(|ring| (0..PLACES).map(move |k| (ring, k)));
        places.filter_map(move |(ring, k)| {
            let far = self.radius * (1.0 + 0.1 * f64::from(ring) + 1e-3);
            let out = f64::from(k) * TAU / f64::from(PLACES);
            let at = p + far * DVec2::from_angle(out);
            self.region.holds(at).then_some((at, out))
        })
    }

    /// The hole in a part of the region, if there is one, in which the cutter goes down with room around it: its centre, and
    /// where the first pass begins.
    fn drilled(&self, of: &Outline) -> Option<(DVec2, Pose)> {
        let inside = |p: DVec2| self.region.holds(p) && of.contains(p);
        let wide = self.holes.iter().filter(|(p, r)| *r >= self.radius + HOLE_ROOM && inside(*p));
        let (middle, radius) = wide.max_by(|a, b| a.1.total_cmp(&b.1))?;
        // So far out that the cutter does not cut yet.
        let out = (radius - self.radius).min(self.region.room(*middle));
        Some((*middle, Pose { at: *middle + out * DVec2::X, heading: FRAC_PI_2 }))
    }

    /// Adds a way as lines and arcs; the pose at its end.
    fn keep(&self, way: &Way, cleared: &mut Cleared) -> Option<Pose> {
        let edges = arcs_near(&way.points, self.tolerance);
        let last = edges.last()?;
        let end = Pose { at: last.end, heading: last.heading(1.0) };
        cleared.elements.push(Element::Pass(Pass { edges, largest: way.largest }));
        Some(end)
    }

    /// The way between two poses through what is cleared, where one is found.
    fn link(&self, from: Pose, to: Pose, work: &mut Scratch) -> Option<Vec<OutlineEdge>> {
        let mut clear = |edge: &OutlineEdge| {
            let count = (edge.length() / (LINK_STEP * self.radius)).ceil().max(1.0);
            (0..=count as usize).all(|k| {
                let share = k as f64 / count;
                let at = edge.at(share);
                self.region.holds(at)
                    && self.clearing.engaged(at, edge.heading(share), TOUCH * self.radius, work).total
                        <= ROUNDING
            })
        };
        LINK_RADII
            .into_iter()
            .flat_map(|radius| ways(from, to, radius * self.radius))
            .chain([vec![OutlineEdge::line(from.at, to.at)]])
            .find(|way| way.iter().all(&mut clear))
    }

    /// A cleared place beside the beginning of a pass, and the way from there, tangent to the pass.
    fn way_in(&self, start: Pose, work: &mut Scratch) -> (DVec2, Vec<OutlineEdge>) {
        for radius in LINK_RADII {
            for turn in [FRAC_PI_2, 0.5 * FRAC_PI_2] {
                // From the left: it turns right into the pass.
                let radius = radius * self.radius;
                let right = start.heading - FRAC_PI_2;
                let centre = start.at - radius * DVec2::from_angle(right + PI);
                let arc = OutlineEdge::arc(centre, radius, right + PI + turn, -turn);
                let arc = OutlineEdge { end: start.at, ..arc };
                let free = (0..=8).all(|k| {
                    let share = f64::from(k) / 8.0;
                    let (at, heading) = (arc.at(share), arc.heading(share));
                    self.region.holds(at) && !self.touches(at, heading, work)
                });
                if free {
                    return (arc.start, vec![arc]);
                }
            }
        }
        (start.at, Vec::new())
    }

    fn walk(&mut self, start: Pose, most: &mut usize, work: &mut Scratch) -> Way {
        let mut walker = Walker {
            region: self.region,
            clearing: self.clearing,
            radius: self.radius,
            wanted: self.wanted,
            work,
        };
        let way = walker.pass(start.at, start.heading, *most);
        *most = most.saturating_sub(way.points.len());
        way
    }

    /// Whether the cutter reaches a point, by more than a cell.
    fn is_reached(&self, p: DVec2) -> bool {
        self.region.room_within(p, self.radius) > self.clearing.cell_width() - self.radius
    }

    /// A place to begin at where stock is left that no way along the wall leads to.
    fn elsewhere(&self, rest: &mut Option<Rest>, here: DVec2) -> Option<(Pose, DVec2)> {
        let rest = rest.get_or_insert_with(|| Rest::new(self.clearing, |p| self.is_reached(p)));
        let width = self.clearing.cell_width();
        let [low, high] = self.region.bounds();
        let all = (high.x - low.x) * (high.y - low.y);
        let may_be_left = LEFT.max(LEFT_SHARE * all);
        if rest.most() as f64 * width * width <= 4.0 * may_be_left {
            rest.update(self.clearing);
            if rest.most() as f64 * width * width <= may_be_left {
                return None;
            }
        }
        let mut work = Scratch::default();
        // Points beside what is cleared first, as the others lie behind them.
        let is_front = |p: DVec2| {
            let beside = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y];
            beside.iter().any(|side| self.clearing.is_clear(p + width * side))
        };
        let place = (here, self.radius);
        let found = rest.begin(self.clearing, place, false, |p| {
            is_front(p).then(|| self.start_at(p, FRONT_RINGS, &mut work))
        });
        found.or_else(|| rest.begin(self.clearing, place, true, |p| Some(self.start_at(p, RINGS, &mut work))))
    }

    /// A place from which the cutter touches a point with nothing cut yet, the point on its right.
    fn start_at(&self, p: DVec2, rings: u32, work: &mut Scratch) -> Option<Pose> {
        let (at, out) = self.free_places(p, rings).find(|(at, out)| !self.touches(*at, *out, work))?;
        // The heading is a quarter turn before the way from the point.
        Some(Pose { at, heading: out - FRAC_PI_2 })
    }
}

/// The largest place of points a cell apart: its area [mm2], and its first point.
fn largest(points: &[DVec2], width: f64) -> Option<(f64, DVec2)> {
    let origin = *points.first()?;
    let cell = |p: DVec2| ((p - origin) / width).to_array().map(|x| x.round() as i64);
    let mut left: BTreeMap<[i64; 2], DVec2> = points.iter().map(|p| (cell(*p), *p)).collect();
    let mut best: Option<(usize, DVec2)> = None;
    while let Some((first, at)) = left.pop_first() {
        let (mut place, mut next) = (vec![first], 0);
        while let Some(&[x, y]) = place.get(next) {
            next += 1;
            let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
            place.extend(around.filter(|cell| left.remove(cell).is_some()).collect::<Vec<_>>());
        }
        if best.is_none_or(|(count, _)| place.len() > count) {
            best = Some((place.len(), at));
        }
    }
    best.map(|(count, at)| (count as f64 * width * width, at))
}

/// The index of the point that is nearest to another.
fn nearest(points: &[DVec2], to: DVec2) -> Option<usize> {
    let far = |i: &usize| points[*i].distance_squared(to);
    (0..points.len()).min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// The box around points, larger by a margin [mm].
pub(super) fn box_of(points: &[DVec2], margin: f64) -> [DVec2; 2] {
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    let [low, high] = points.iter().fold(start, |[low, high], p| [low.min(*p), high.max(*p)]);
    [low - margin, high + margin]
}
