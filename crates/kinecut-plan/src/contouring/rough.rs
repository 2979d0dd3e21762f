//! Roughing of a contour: loops beside one another, each level by level, over its tabs.

use std::f64::consts::FRAC_PI_2;

use glam::DVec2;

use super::lead::Lead;
use super::plan::{Planner, RAMP_ABOVE};
use super::tabs::PlacedTab;
use super::track::Track;
use super::travel::Stretch;
use crate::base::Result;
use crate::holes::{ToolpathPace, ToolpathRole};

/// Way that stays between a tab and a place at which a loop is left, in radii of the cutter.
const TAB_ROOM: f64 = 4.0;
/// Distance that is rounding [mm].
const ROUNDING: f64 = 1e-6;

/// A beginning of a loop: the place along it, and the lead.
#[derive(Clone, Debug)]
pub(super) struct Beginning {
    pub(super) at: f64,
    pub(super) lead: Lead,
    /// Distance of the loop from the wall [mm].
    pub(super) wall: f64,
}

impl Planner<'_> {
    /// Roughs all loops, those farther from the wall before `rough`, which are those beside it; `wall`: distance of these from the
    /// wall [mm]. Returns the place at which the last one ends.
    pub(super) fn rough_all(
        &mut self,
        rough: &[(Track, bool)],
        wall: f64,
        heights: &[f64],
    ) -> Result<Option<DVec2>> {
        // Tabs belong to the loops beside the wall, and go through all loops beside them.
        let mut begun = Vec::with_capacity(rough.len());
        for (track, _) in rough {
            let start = self.beginning(track, wall)?;
            let tabs = self.tabs(track, start.at, rough);
            begun.push((start, tabs));
        }
        let mut at = None;
        for farther in self.spec.farther().filter(|f| *f > 0.0) {
            let tracks = self.tracks_of(&self.paths(wall + farther)?);
            for (track, outer) in self.ordered(&tracks) {
                let start = self.beginning(track, wall + farther)?;
                let tabs = through(track, &begun, farther);
                at = Some(self.rough(track, outer, (start, tabs), heights)?);
                if let Some(last) = self.loops.last_mut() {
                    last.farther = farther;
                }
            }
        }
        for (track, outer) in self.ordered(rough) {
            let own = rough.iter().position(|(t, _)| std::ptr::eq(t, track));
            let Some(begun) = own.and_then(|i| begun.get(i)).cloned() else { continue };
            at = Some(self.rough(track, outer, begun, heights)?);
        }
        Ok(at)
    }

    /// The place at which roughing of a loop begins.
    pub(super) fn beginning(&self, track: &Track, wall: f64) -> Result<Beginning> {
        let lead = |radius, _, _| Lead { radius, angle: FRAC_PI_2, line: 0.0 };
        self.begin(track, wall, lead, |_| true, |_| true)
    }

    /// Roughs a loop level by level, `heights` from the top down.
    pub(super) fn rough(
        &mut self,
        track: &Track,
        outer: bool,
        (start, tabs): (Beginning, Vec<PlacedTab>),
        heights: &[f64],
    ) -> Result<DVec2> {
        let spec = self.spec;
        self.travel.route.finishing = false;
        self.keep(track, outer, start.at, &tabs);
        let left = spec.keeps_right();
        let (p, along) = track.at(start.at);
        let on = start.lead.on(p, along, left);
        let role = ToolpathRole::Circle;
        let feed = spec.feed;
        let mut s = start.at;
        for (k, pair) in heights.windows(2).enumerate() {
            let (above, floor) = (pair[0], pair[1]);
            self.travel.route.level = k as u32;
            let whole = track.length();
            if let Some(angle) = spec.ramp {
                let mut from = above;
                if k == 0 {
                    from = (above + RAMP_ABOVE).min(spec.approach_z);
                    self.travel.route.over(on.first().map_or(p, |e| e.start));
                    self.travel.route.vertically(
                        ToolpathRole::Entry,
                        ToolpathPace::Feed(spec.plunge_feed),
                        from,
                    );
                    self.travel.route.edges(ToolpathRole::LeadIn, feed, &on)?;
                }
                let end = s + (from - floor) / angle.tan();
                let ramp = Stretch { along: [s, end], heights: [from, floor], feed };
                self.travel.follow(ToolpathRole::Entry, track, &tabs, ramp)?;
                let lap = Stretch { along: [end, end + whole], heights: [floor, floor], feed };
                self.travel.follow(role, track, &tabs, lap)?;
                s = end + whole;
            } else {
                self.travel.route.over(on.first().map_or(p, |e| e.start));
                if above < spec.approach_z {
                    // What a level above has cut is open; the first one feeds down from over the material.
                    let open = match k {
                        _ if spec.cleared => (floor + RAMP_ABOVE).min(spec.approach_z),
                        0 => spec.approach_z,
                        _ => (above + RAMP_ABOVE).min(spec.approach_z),
                    };
                    self.travel.route.vertically(ToolpathRole::Entry, ToolpathPace::Feed(feed), open);
                }
                self.travel.route.vertically(
                    ToolpathRole::Entry,
                    ToolpathPace::Feed(spec.plunge_feed),
                    floor,
                );
                self.travel.route.edges(ToolpathRole::LeadIn, feed, &on)?;
                let end = start.at + whole + self.overlap();
                let lap = Stretch { along: [start.at, end], heights: [floor, floor], feed };
                self.travel.follow(role, track, &tabs, lap)?;
                s = end;
                if k + 2 < heights.len() {
                    let (p, along) = track.at(s);
                    let off = start.lead.off(p, along, left);
                    self.travel.route.edges(ToolpathRole::LeadOut, feed, &off)?;
                }
            }
        }
        if let Some(floor) = heights.last().filter(|_| spec.ramp.is_some()) {
            let end = self.leaving(track, &start, &tabs, s);
            let rest = Stretch { along: [s, end], heights: [*floor, *floor], feed };
            self.travel.follow(role, track, &tabs, rest)?;
            s = end;
        }
        let (p, along) = track.at(s);
        let off = start.lead.off(p, along, left);
        self.travel.route.edges(ToolpathRole::LeadOut, feed, &off)?;
        Ok(p)
    }

    /// The place at which a loop is left whose last lap ends at `s`, a little beyond it: there, or at its beginning, for which there
    /// is room.
    fn leaving(&self, track: &Track, start: &Beginning, tabs: &[PlacedTab], s: f64) -> f64 {
        let here = s + self.overlap();
        if self.is_left_at(track, start, tabs, here) {
            return here;
        }
        let end = start.at + self.overlap();
        end + ((s - end) / track.length()).ceil() * track.length()
    }

    /// Whether a loop may be left at a place other than its beginning: no place is asked for, no tab is near, and there is room.
    fn is_left_at(&self, track: &Track, start: &Beginning, tabs: &[PlacedTab], at: f64) -> bool {
        let (spec, whole) = (self.spec, track.length());
        // A cutter that is wider above its tip needs a way that was looked for.
        if spec.start.is_some() || spec.room.is_some() {
            return false;
        }
        let height = (spec.tab_top() - spec.bottom()).max(0.0);
        let slopes = spec.slopes(height, false).into_iter().fold(0.0, f64::max);
        let near = |tab: &PlacedTab| {
            let ahead = (0.5 * (tab.along[0] + tab.along[1]) - at).rem_euclid(whole);
            ahead.min(whole - ahead) < 0.5 * tab.lifted() + slopes + TAB_ROOM * spec.radius()
        };
        let (p, along) = track.at(at);
        !tabs.iter().any(near) && self.is_open(&start.lead.off(p, along, spec.keeps_right()), start.wall)
    }
}

/// The tabs of loops beside the wall on a loop that lies so much farther from it [mm].
fn through(track: &Track, begun: &[(Beginning, Vec<PlacedTab>)], farther: f64) -> Vec<PlacedTab> {
    let own = begun.iter().flat_map(|(_, tabs)| tabs).filter_map(|tab| {
        let s = track.nearest(tab.at);
        let (at, half) = (track.at(s).0, 0.5 * tab.lifted());
        let is_beside = at.distance(tab.at) <= farther + ROUNDING;
        is_beside.then_some(PlacedTab { at, along: [s - half, s + half] })
    });
    let mut tabs: Vec<PlacedTab> = own.collect();
    tabs.sort_by(|a, b| a.along[0].total_cmp(&b.along[0]));
    tabs
}
