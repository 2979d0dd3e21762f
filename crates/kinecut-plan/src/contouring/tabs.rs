//! Places of tabs: evenly along the path, on straight pieces or wide arcs, away from corners and from the leads.

use glam::DVec2;

use super::spec::Tabs;
use super::track::Track;

/// A tab of a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedTab {
    /// Its middle on the path of the cutter's centre [mm].
    pub at: DVec2,
    /// The stretch on which the cutter is lifted, along the path [mm].
    pub(super) along: [f64; 2],
}

impl PlacedTab {
    /// Length on which the cutter is lifted [mm].
    pub fn lifted(&self) -> f64 {
        self.along[1] - self.along[0]
    }
}

/// Stretches on which the cutter is lifted over tabs near a stretch along a track of a length [mm], in their order. Tabs that run
/// into one another, with the ways up and down beside them, are one: between them the cutter would have to go back.
pub(super) fn lifted(
    tabs: &[PlacedTab],
    whole: f64,
    [up, down]: [f64; 2],
    [from, to]: [f64; 2],
) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = Vec::new();
    for tab in tabs {
        // A turn more at both ends: what lies beyond may run into what is near.
        let first = ((from - down - tab.along[1]) / whole).floor() as i64 - 1;
        let last = ((to + up - tab.along[0]) / whole).ceil() as i64 + 1;
        all.extend((first..=last).map(|turn| tab.along.map(|s| s + turn as f64 * whole)));
    }
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    all.dedup_by(|next, one| {
        let is_one = next[0] - up <= one[1] + down;
        if is_one && next[1] > one[1] {
            one[1] = next[1];
        }
        is_one
    });
    all
}

/// The tabs on a track that begins at `start`, in their order from there, each within one turn from it; fewer than
/// wanted where they do not fit.
pub(super) fn placed(track: &Track, tabs: &Tabs, start: f64, diameter: f64) -> Vec<PlacedTab> {
    let (lifted, whole) = (tabs.width + diameter, track.length());
    let wanted: Vec<f64> = if tabs.places.is_empty() {
        let step = whole / f64::from(tabs.count);
        (0..tabs.count).map(|i| start + (f64::from(i) + 0.5) * step).collect()
    } else {
        let mut all: Vec<f64> =
            tabs.places.iter().map(|p| start + (track.nearest(*p) - start).rem_euclid(whole)).collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let stretches = allowed(track, start, lifted, diameter);
    let mut found: Vec<f64> = Vec::new();
    for place in wanted {
        let least = found.last().map_or(f64::NEG_INFINITY, |last| last + lifted);
        let fits = stretches.iter().filter_map(|[from, to]| {
            let from = if *from > least { *from } else { least };
            (from <= *to).then(|| place.clamp(from, *to))
        });
        if let Some(best) = fits.min_by(|a, b| (a - place).abs().total_cmp(&(b - place).abs())) {
            found.push(best);
        }
    }
    let tab = |s: f64| PlacedTab { at: track.at(s).0, along: [s - 0.5 * lifted, s + 0.5 * lifted] };
    found.into_iter().map(tab).collect()
}

/// Stretches on which the middle of a tab may lie, within one turn from the start.
fn allowed(track: &Track, start: f64, lifted: f64, diameter: f64) -> Vec<[f64; 2]> {
    let whole = track.length();
    let keep = 2.0 * diameter + 0.5 * lifted;
    let (low, high) = (start + keep, start + whole - keep);
    let mut all = Vec::new();
    for turn in 0..2 {
        for (i, edge) in track.edges().iter().enumerate() {
            if edge.turn.is_some_and(|t| t.radius < 2.0 * diameter) {
                continue;
            }
            let [from, to] = track.stretch(i).map(|s| s + f64::from(turn) * whole);
            let (from, to) = ((from + 0.5 * lifted).max(low), (to - 0.5 * lifted).min(high));
            if from <= to {
                all.push([from, to]);
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::super::spec::TabShape;
    use super::*;
    use crate::geom::Outline;

    #[test]
    fn tabs_are_spread_and_stay_off_corners_and_start() {
        let corners = [dvec2(0.0, 0.0), dvec2(0.0, 90.0), dvec2(150.0, 90.0), dvec2(150.0, 0.0)];
        let track = Track::new(Outline::polygon(&corners).expect("a rectangle").edges().to_vec());
        let tabs = |count| Tabs {
            count,
            width: 6.0,
            height: 1.5,
            shape: TabShape::Flat,
            finish: true,
            places: vec![],
        };
        let start = 90.0 + 75.0;
        let four = placed(&track, &tabs(4), start, 10.0);
        assert_eq!(four.len(), 4);
        for tab in &four {
            assert!((tab.lifted() - 16.0).abs() < 1e-12);
            for corner in corners {
                assert!(tab.at.distance(corner) >= 8.0 - 1e-9, "{tab:?}");
            }
            assert!(tab.at.distance(track.at(start).0) >= 28.0 - 1e-9);
        }
        // Not more than fit: 480 mm, each 16 wide.
        let many = placed(&track, &tabs(60), start, 10.0);
        assert!(many.len() < 28 && many.len() > 18, "{}", many.len());
        assert!(many.windows(2).all(|w| w[1].along[0] >= w[0].along[1] - 1e-9));
        let near = Tabs { places: vec![dvec2(150.0, 40.0)], ..tabs(9) };
        let one = placed(&track, &near, start, 10.0);
        assert!(one.len() == 1 && one[0].at.distance(dvec2(150.0, 40.0)) < 1e-9);
    }
}
