//! The clearing of one level: passes one after the other until nothing is left.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;

use super::link::{Pose, ways};
use super::region::{CentreRegion, WallLoop};
use super::swept::{Clearing, Scratch};
use super::walk::{Walker, Way, step_of};
use crate::geom::{Outline, OutlineEdge, arcs_near};

/// Places along the wall at which passes may begin, in radii of the cutter.
const ALONG_WALL: f64 = 0.1;
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
}

impl Cleared {
    /// Measures what is left of the area that `reached` has; its points, a cell apart.
    pub(super) fn measure(&mut self, clearing: &Clearing, reached: impl Fn(DVec2) -> bool) -> Vec<DVec2> {
        let width = clearing.cell_width();
        let rest = clearing.remains(reached);
        self.left = rest.len() as f64 * width * width;
        self.largest_left = largest(&rest, width);
        rest
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
        for element in &mut self.elements {
            match element {
                Element::Helix { middle, from, .. } => (*middle, *from) = (flip(*middle), -*from),
                Element::Down(at) => *at = flip(*at),
                Element::Link(edges) | Element::Back(edges) | Element::Ramp(edges) => flipped(edges),
                Element::Pass(pass) => flipped(&mut pass.edges),
            }
        }
    }
}

/// A stretch of a loop along the wall that is not cleared.
#[derive(Clone, Debug)]
struct Uncleared {
    of: usize,
    /// First and last place, by index along the loop; the first is cleared, unless all of the loop is not.
    from: usize,
    to: usize,
    whole: bool,
}

/// Places along a loop, each with the direction of travel.
fn places(of: &WallLoop, step: f64) -> Vec<Pose> {
    let mut found = Vec::new();
    for edge in &of.edges {
        let count = (edge.length() / step).ceil().max(1.0);
        for k in 0..count as usize {
            let share = k as f64 / count;
            found.push(Pose { at: edge.at(share), heading: edge.heading(share) });
        }
    }
    found
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
    /// Radius of the helix that enters [mm].
    pub(super) helix: f64,
    /// Distance of the lines and arcs from the way that was walked [mm].
    pub(super) tolerance: f64,
}

impl Clearer<'_> {
    fn touches(&self, at: DVec2, heading: f64, work: &mut Scratch) -> bool {
        let radius = TOUCH * self.radius;
        let mut uncut = |heading: f64| self.clearing.engaged(at, heading, radius, work).largest;
        uncut(heading) > ROUNDING || uncut(heading + PI) > ROUNDING
    }

    /// Area of the stock that the cutter reaches, by the middles of cells [mm2].
    pub(super) fn stock_area(&self) -> f64 {
        let width = self.clearing.cell_width();
        self.clearing.remains(|p| self.region.room(p) > -self.radius).len() as f64 * width * width
    }

    /// Clears all that the cutter reaches.
    pub(super) fn run(&mut self) -> Cleared {
        let mut cleared = Cleared::default();
        let step = ALONG_WALL * self.radius;
        let along: Vec<Vec<Pose>> = self.region.loops.iter().map(|l| places(l, step)).collect();
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
            if along[one].iter().any(|p| !self.touches(p.at, p.heading, &mut work)) {
                continue;
            }
            if let Some((start, way)) = self.drilled(around) {
                cleared.elements.push(Element::Down(start));
                cleared.elements.push(Element::Link(vec![OutlineEdge::line(start, way.at)]));
                let way = self.walk(way, &mut most);
                here = self.keep(&way, &mut cleared).or(here);
                continue;
            }
            let (middle, room) = region.widest(around);
            let radius = self.helix.min(room);
            let from = 0.0;
            self.clearing.sweep(middle, middle, radius + self.radius);
            cleared.elements.push(Element::Helix { middle, radius, from });
            let start = Pose { at: middle + radius * DVec2::from_angle(from), heading: from + FRAC_PI_2 };
            let way = self.walk(start, &mut most);
            here = self.keep(&way, &mut cleared).or(here);
        }
        let mut open = Vec::new();
        for (of, places) in along.iter().enumerate() {
            let touched: Vec<bool> =
                places.iter().map(|p| self.touches(p.at, p.heading, &mut work)).collect();
            open.extend(stretches(of, &touched));
        }
        let mut dead: Vec<DVec2> = Vec::new();
        // Points that a pass has been begun for already.
        let mut hopeless: Vec<DVec2> = Vec::new();
        loop {
            // Passes begin where the wall leaves what is cleared, the nearest first.
            for stretch in &mut open {
                self.shrink(stretch, &along[stretch.of], &mut work);
            }
            open.retain(|s| s.from < s.to);
            let far = |p: &Pose| here.map_or(p.at, |here| p.at - here.at).length();
            let next = open
                .iter()
                .filter(|s| !s.whole)
                .map(|s| along[s.of][s.from % along[s.of].len()])
                .filter(|p| !dead.contains(&p.at))
                .min_by(|a, b| far(a).total_cmp(&far(b)));
            let start = match next {
                Some(place) => place,
                None => match self.elsewhere(&hopeless, here.map_or(DVec2::ZERO, |h| h.at), &mut cleared) {
                    Some((place, of)) => {
                        hopeless.push(of);
                        place
                    }
                    None => break,
                },
            };
            if most == 0 {
                cleared.measure(self.clearing, |p| self.is_reached(p));
                break;
            }
            // Before the pass, as the link runs through what is cleared by then.
            let link = here.and_then(|here| self.link(here, start, &mut work));
            let down = if link.is_some() { None } else { Some(self.way_in(start, &mut work)) };
            let way = self.walk(start, &mut most);
            if way.cutting < 2.0 * step {
                dead.push(start.at);
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
                here = self.keep(&way, &mut cleared).or(here);
            }
        }
        cleared
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

    fn walk(&mut self, start: Pose, most: &mut usize) -> Way {
        let mut walker = Walker {
            region: self.region,
            clearing: self.clearing,
            radius: self.radius,
            wanted: self.wanted,
            work: Scratch::default(),
        };
        let way = walker.pass(start.at, start.heading, *most);
        *most = most.saturating_sub(way.points.len());
        way
    }

    /// Moves the ends of a stretch along the wall past all that has been cleared.
    fn shrink(&self, stretch: &mut Uncleared, places: &[Pose], work: &mut Scratch) {
        let mut touches = |i: usize| {
            let place = places[i % places.len()];
            self.touches(place.at, place.heading, work)
        };
        if stretch.whole {
            // A loop that nothing has reached: looked at here and there.
            if let Some(first) = (0..places.len()).step_by(4).find(|&i| !touches(i)) {
                *stretch = Uncleared { from: first, to: first + places.len(), whole: false, ..*stretch };
            } else {
                return;
            }
        }
        while stretch.from < stretch.to && !touches(stretch.from + 1) {
            stretch.from += 1;
        }
        while stretch.to > stretch.from && !touches(stretch.to) {
            stretch.to -= 1;
        }
    }

    /// Whether the cutter reaches a point, by more than a cell.
    fn is_reached(&self, p: DVec2) -> bool {
        self.region.room(p) > self.clearing.cell_width() - self.radius
    }

    /// A place to begin at where stock is left that no way along the wall leads to.
    fn elsewhere(&self, hopeless: &[DVec2], here: DVec2, cleared: &mut Cleared) -> Option<(Pose, DVec2)> {
        let rest = cleared.measure(self.clearing, |p| self.is_reached(p));
        let left = cleared.left;
        let [low, high] = self.region.bounds();
        let all = (high.x - low.x) * (high.y - low.y);
        if left <= LEFT.max(LEFT_SHARE * all) {
            return None;
        }
        let mut work = Scratch::default();
        let mut rest = rest;
        rest.sort_by(|a, b| a.distance(here).total_cmp(&b.distance(here)));
        let near = 0.1 * self.radius;
        for p in rest.into_iter().filter(|p| hopeless.iter().all(|h| h.distance(*p) > near)) {
            // A point from which the cutter touches this one with nothing cut yet.
            for ring in 0..12 {
                let far = self.radius * (1.0 + 0.1 * f64::from(ring) + 1e-3);
                for k in 0..48 {
                    let out = f64::from(k) * TAU / 48.0;
                    let at = p + far * DVec2::from_angle(out);
                    if !self.region.holds(at) || self.touches(at, out, &mut work) {
                        continue;
                    }
                    // The point on the right: the heading is a quarter turn before the way from it.
                    return Some((Pose { at, heading: out - FRAC_PI_2 }, p));
                }
            }
        }
        None
    }
}

/// The largest place of points a cell apart: its area [mm2], and its first point.
fn largest(points: &[DVec2], width: f64) -> Option<(f64, DVec2)> {
    let mut left: Vec<DVec2> = points.to_vec();
    let mut best: Option<(usize, DVec2)> = None;
    while let Some(first) = left.pop() {
        let (mut place, mut next) = (vec![first], 0);
        while next < place.len() {
            let at = place[next];
            next += 1;
            left.retain(|p| {
                let is_near = p.distance(at) < 1.5 * width;
                if is_near {
                    place.push(*p);
                }
                !is_near
            });
        }
        if best.is_none_or(|(count, _)| place.len() > count) {
            best = Some((place.len(), first));
        }
    }
    best.map(|(count, at)| (count as f64 * width * width, at))
}

/// The uncleared stretches of a loop.
fn stretches(of: usize, touched: &[bool]) -> Vec<Uncleared> {
    let count = touched.len();
    let Some(first) = touched.iter().position(|t| !t) else {
        return vec![Uncleared { of, from: 0, to: count, whole: true }];
    };
    let mut found: Vec<Uncleared> = Vec::new();
    let mut from = None;
    for i in first..=first + count {
        match (touched[i % count], from) {
            (true, None) => from = Some(i - 1),
            (false, Some(begin)) => {
                found.push(Uncleared { of, from: begin, to: i, whole: false });
                from = None;
            }
            _ => {}
        }
    }
    found
}
