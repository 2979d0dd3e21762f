//! The moves of a contour, made one after the other: along a track at heights, over tabs, up and down.

use super::corner_feed::CornerFeed;
use super::feed::centre_feed;
use super::spec::ContourSpec;
use super::tabs::{PlacedTab, lifted};
use super::track::Track;
use crate::base::Result;
use crate::geom::OutlineEdge;
use crate::holes::route::Route;
use crate::holes::{FeedAt, ToolpathPace, ToolpathRole};

/// Lengths and heights below this are rounding [mm].
const NOTHING: f64 = 1e-9;

/// The moves so far.
pub(super) struct Travel<'a> {
    spec: &'a ContourSpec,
    pub(super) route: Route,
    /// The feed in corners of the track that is followed, where it is reduced.
    pub(super) slower: Option<CornerFeed>,
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
        Travel { spec, route: Route::new(spec.retract_z, spec.approach_z), slower: None }
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
        let points = self.heights(track.length(), tabs, &way);
        if let Some([_, z]) = points.first() {
            // Where a tab has an upright end, the stretch before may have ended at its foot.
            self.route.vertically(role, ToolpathPace::Feed(way.feed), *z);
        }
        for pair in points.windows(2) {
            let ([from, z0], [to, z1]) = (pair[0], pair[1]);
            let down = z1 < z0 - NOTHING;
            let feed = if down { self.spec.plunge_feed } else { way.feed };
            if to - from <= NOTHING {
                self.route.vertically(role, ToolpathPace::Feed(feed), z1);
                continue;
            }
            let mut gone = from;
            for edge in track.part(from, to) {
                let (begin, length) = (gone, edge.length());
                let end = begin + length;
                let height = |s: f64| z0 + (z1 - z0) * ((s - from) / (to - from)).clamp(0.0, 1.0);
                let parts = self.slower.as_ref().map(|s| s.along([begin, end])).unwrap_or_default();
                let whole = [(end, parts.first().map_or(1.0, |(_, share)| *share))];
                for &(last, share) in if parts.len() > 1 { &parts[..] } else { &whole } {
                    let part = match parts.len() > 1 {
                        true => edge.part((gone - begin) / length, (last - begin) / length),
                        false => edge,
                    };
                    let usual = if down { feed } else { self.feed_of(&edge, feed) };
                    let feed = if share < 1.0 && !down { usual.min(share * feed) } else { usual };
                    let z = [gone, last].map(height);
                    self.route.edge(role, ToolpathPace::Feed(feed), &part, z)?;
                    gone = last;
                }
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

    /// Heights along a stretch: at each place that of the stretch or of the lift over tabs, whichever is higher. `whole`:
    /// length of the track [mm].
    fn heights(&self, whole: f64, tabs: &[PlacedTab], way: &Stretch) -> Vec<[f64; 2]> {
        let ([from, to], [z0, z1]) = (way.along, way.heights);
        if to - from <= NOTHING {
            return Vec::new();
        }
        let base = |s: f64| z0 + (z1 - z0) * ((s - from) / (to - from)).clamp(0.0, 1.0);
        let mut points = vec![[from, z0]];
        let lift = self.lift(whole, tabs, way.along);
        for pair in lift.windows(2) {
            let ([a, lift_a], [b, lift_b]) = (pair[0], pair[1]);
            let (over_a, over_b) = (lift_a - base(a), lift_b - base(b));
            if over_a >= -NOTHING {
                points.push([a, lift_a]);
            }
            if over_a.abs() > NOTHING && over_b.abs() > NOTHING && over_a * over_b < 0.0 {
                let s = a + (b - a) * over_a / (over_a - over_b);
                points.push([s, base(s)]);
            }
            if over_b >= -NOTHING {
                points.push([b, lift_b]);
            }
        }
        if lift.first().is_some_and(|[_, z]| *z > z0) {
            // It begins on a tab.
            points.remove(0);
        }
        if lift.last().is_none_or(|[_, z]| *z <= z1) {
            points.push([to, z1]);
        }
        points.dedup_by(|b, a| (a[0] - b[0]).abs() <= NOTHING && (a[1] - b[1]).abs() <= NOTHING);
        points
    }

    /// The lift over tabs along a stretch, as places along it with heights, from its beginning to its end; the bottom of the cut
    /// beside tabs.
    fn lift(&self, whole: f64, tabs: &[PlacedTab], [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
        let spec = self.spec;
        let (top, bottom) = (spec.tab_top(), spec.bottom());
        let slopes = spec.slopes(top - bottom, self.route.comp);
        let mut knots = vec![[f64::NEG_INFINITY, bottom]];
        for [begin, end] in lifted(tabs, whole, slopes, [from, to]) {
            let [up, down] = slopes;
            knots.extend([[begin - up, bottom], [begin, top], [end, top], [end + down, bottom]]);
        }
        knots.push([f64::INFINITY, bottom]);
        let mut line: Vec<[f64; 2]> = Vec::new();
        for pair in knots.windows(2) {
            let ([a, z_a], [b, z_b]) = (pair[0], pair[1]);
            // An upright end at the very beginning lies before the stretch, one at its end beyond.
            if b <= from || a >= to {
                continue;
            }
            let at = |s: f64| if z_a == z_b { z_a } else { z_a + (z_b - z_a) * (s - a) / (b - a) };
            line.push(if a < from { [from, at(from)] } else { [a, z_a] });
            line.push(if b > to { [to, at(to)] } else { [b, z_b] });
        }
        line
    }
}
