//! The moves of a contour, made one after the other: along a track at heights, over tabs, up and down.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::feed::centre_feed;
use super::spec::{ContourSpec, TabShape};
use super::tabs::PlacedTab;
use super::track::Track;
use crate::base::Result;
use crate::geom::{Arc, Curve, Line, OutlineEdge};
use crate::holes::{FeedAt, PlannedMove, ToolpathPace, ToolpathRole};

/// Angle at which the ends of tabs rise, where they do [rad].
const RISE: f64 = PI / 6.0;
/// Moves shorter than this are dropped [mm].
const NOTHING: f64 = 1e-9;

/// The moves so far.
pub(super) struct Travel<'a> {
    spec: &'a ContourSpec,
    pub(super) moves: Vec<PlannedMove>,
    here: Option<DVec3>,
    pub(super) level: u32,
    pub(super) finishing: bool,
    pub(super) comp: bool,
}

/// A stretch along a track while the height changes evenly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// From and to, along the track [mm].
    pub(super) along: [f64; 2],
    /// Heights there [mm].
    pub(super) heights: [f64; 2],
    /// Feed at level height [mm/s].
    pub(super) feed: f64,
}

impl<'a> Travel<'a> {
    pub(super) fn new(spec: &'a ContourSpec) -> Travel<'a> {
        Travel { spec, moves: Vec::new(), here: None, level: 0, finishing: false, comp: false }
    }

    fn add(&mut self, role: ToolpathRole, pace: ToolpathPace, curve: Curve) {
        let (level, finishing, comp) = (self.level, self.finishing, self.comp);
        self.moves.push(PlannedMove { role, curve, pace, level, finishing, comp });
    }

    /// Straight to a place; the first call only says where the moves begin.
    pub(super) fn to(&mut self, role: ToolpathRole, pace: ToolpathPace, end: DVec3) {
        if let Some(start) = self.here
            && start.distance(end) > NOTHING
        {
            self.add(role, pace, Line { start, end }.into());
        }
        self.here = Some(end);
    }

    /// Straight up or down.
    pub(super) fn vertically(&mut self, role: ToolpathRole, pace: ToolpathPace, z: f64) {
        if let Some(here) = self.here {
            self.to(role, pace, DVec3::new(here.x, here.y, z));
        }
    }

    /// Up, over to a place, and down to the height at which feeds begin.
    pub(super) fn over(&mut self, at: DVec2) {
        let spec = self.spec;
        self.vertically(ToolpathRole::Retract, ToolpathPace::Rapid, spec.retract_z);
        self.to(ToolpathRole::Link, ToolpathPace::Rapid, at.extend(spec.retract_z));
        self.vertically(ToolpathRole::Approach, ToolpathPace::Rapid, spec.approach_z);
    }

    /// Height of the tip [mm].
    pub(super) fn height(&self) -> f64 {
        self.here.map_or(f64::INFINITY, |here| here.z)
    }

    /// Along edges at the present height.
    ///
    /// # Errors
    /// Those of arcs.
    pub(super) fn edges(&mut self, role: ToolpathRole, feed: f64, edges: &[OutlineEdge]) -> Result<()> {
        let z = self.height();
        edges.iter().try_for_each(|edge| self.edge(role, ToolpathPace::Feed(feed), edge, [z, z]))
    }

    fn edge(
        &mut self,
        role: ToolpathRole,
        pace: ToolpathPace,
        edge: &OutlineEdge,
        [from, to]: [f64; 2],
    ) -> Result<()> {
        // From where the last move has ended: rounding of places along a track must not leave a gap.
        let start = self.here.map_or(edge.start, DVec3::truncate).extend(from);
        let curve = match edge.turn {
            None => Line { start, end: edge.end.extend(to) }.into(),
            Some(t) => Arc::new(start, t.centre.extend(from), DVec3::Z, t.sweep, to - from)?.into(),
        };
        self.add(role, pace, curve);
        self.here = Some(edge.end.extend(to));
        Ok(())
    }

    /// Along a track, lifted over its tabs.
    ///
    /// # Errors
    /// Those of arcs.
    pub(super) fn follow(
        &mut self,
        role: ToolpathRole,
        track: &Track,
        tabs: &[PlacedTab],
        way: Stretch,
    ) -> Result<()> {
        let points = self.heights(track, tabs, &way);
        for pair in points.windows(2) {
            let ([from, z0], [to, z1]) = (pair[0], pair[1]);
            let down = z1 < z0 - NOTHING;
            let feed = if down { self.spec.plunge_feed } else { way.feed };
            if to - from <= NOTHING {
                self.vertically(role, ToolpathPace::Feed(feed), z1);
                continue;
            }
            let mut gone = from;
            for edge in track.part(from, to) {
                let end = gone + edge.length();
                let z = [gone, end].map(|s| z0 + (z1 - z0) * ((s - from) / (to - from)).clamp(0.0, 1.0));
                let feed = if down { feed } else { self.feed_of(&edge, feed) };
                self.edge(role, ToolpathPace::Feed(feed), &edge, z)?;
                gone = end;
            }
        }
        Ok(())
    }

    /// The feed of the centre on an edge of the path.
    fn feed_of(&self, edge: &OutlineEdge, feed: f64) -> f64 {
        let (FeedAt::Wall, Some(t)) = (self.spec.feed_at, edge.turn) else { return feed };
        let a = self.spec.radius();
        // Turning away from the kept material is an inside arc.
        let inside = (t.sweep > 0.0) == self.spec.keeps_right();
        let wall = if inside { t.radius + a } else { (t.radius - a).max(0.0) };
        centre_feed(feed, wall, a, inside)
    }

    /// Heights along a stretch: at each place that of the stretch or of a tab, whichever is higher.
    fn heights(&self, track: &Track, tabs: &[PlacedTab], way: &Stretch) -> Vec<[f64; 2]> {
        let ([from, to], [z0, z1]) = (way.along, way.heights);
        let base = |s: f64| if to > from { z0 + (z1 - z0) * (s - from) / (to - from) } else { z1 };
        let whole = track.length();
        let mut points = vec![[from, z0]];
        let lowest = if z0 < z1 { z0 } else { z1 };
        let mut knots: Vec<Vec<[f64; 2]>> = Vec::new();
        if self.spec.tab_top() > lowest {
            for tab in tabs {
                let first = ((from - tab.along[1]) / whole).floor() as i64;
                let last = ((to - tab.along[0]) / whole).ceil() as i64;
                knots.extend((first..=last).map(|turn| self.knots(tab, turn as f64 * whole, lowest)));
            }
            knots.sort_by(|a, b| a[0][0].total_cmp(&b[0][0]));
        }
        for one in &knots {
            for pair in one.windows(2) {
                let ([sa, za], [sb, zb]) = (pair[0], pair[1]);
                if sb < from || sa > to {
                    continue;
                }
                let lift = |s: f64| if sb > sa { za + (zb - za) * (s - sa) / (sb - sa) } else { zb };
                let (a, b) = (sa.max(from), sb.min(to));
                let (la, lb) = if sb > sa { (lift(a), lift(b)) } else { (za, zb) };
                let (over_a, over_b) = (la - base(a), lb - base(b));
                points.push([a, la.max(base(a))]);
                if sb > sa && over_a * over_b < 0.0 {
                    let s = a + (b - a) * over_a / (over_a - over_b);
                    points.push([s, base(s)]);
                }
                points.push([b, lb.max(base(b))]);
            }
        }
        let raised = knots.iter().any(|one| one[0][0] < to && one[one.len() - 1][0] > to);
        if !raised {
            points.push([to, z1]);
        }
        if knots.iter().any(|one| one[0][0] < from && one[one.len() - 1][0] > from) {
            // The stretch begins on a tab: the tool is up already.
            points.remove(0);
        }
        points.dedup_by(|b, a| (a[0] - b[0]).abs() <= NOTHING && (a[1] - b[1]).abs() <= NOTHING);
        points
    }

    /// The upper side of a tab along the track, from the left of it to its right; far below everything beside it.
    fn knots(&self, tab: &PlacedTab, turn: f64, lowest: f64) -> Vec<[f64; 2]> {
        let spec = self.spec;
        let [from, to] = tab.along.map(|s| s + turn);
        let top = spec.tab_top();
        let deep = top - lowest;
        let sloped = self.comp || spec.tabs.as_ref().is_some_and(|t| t.shape == TabShape::Ramp);
        let rise = RISE.tan();
        let (from_top, top) = match sloped {
            true => {
                let peak = (0.5 * (to - from) * rise).min(deep);
                (peak / rise, lowest + peak)
            }
            false => (0.0, top),
        };
        let mut knots = vec![[from, lowest], [from + from_top, top]];
        // Down again: straight only for a cutter that cuts at its centre.
        let down = match (sloped, spec.cutter.centre_cutting, spec.ramp) {
            (true, true, _) => [to - from_top, to],
            (false, true, _) | (_, false, None) => [to, to],
            (_, false, Some(angle)) => [to - from_top, to - from_top + (top - lowest) / angle.tan()],
        };
        knots.push([down[0], top]);
        knots.push([down[1], lowest]);
        knots
    }
}
