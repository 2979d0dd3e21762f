//! The chart of the point's share in material over the way or over the program's time, with the feed next to it.

use serde::Serialize;

use super::DrilledHole;
use super::share_grid::Share;
use crate::drilling::Zone;
use crate::page::{Chart, Follows, fixed};

/// Places at which the share is computed in each zone.
const PLACES: u32 = 60;
/// Shortest way before the material that is shown, as a share of what follows.
const NOTHING: f64 = 1e-9;

/// Share of the cutting disc in material with the reference point at a Z [mm].
///
/// ```
/// use kinecut::drilling::*;
/// use kinecut::operations::drill::{DrilledHole, share_in_material};
/// use kinecut::tool::DrillPoint;
/// let flat = |height| BoundarySurface::Plane { height, slope: 0.0 };
/// let spec = DrillSpec { length: 50.0, ..DrillSpec::new(20.0, DrillPoint::SinglePlane { angle: 2.0 }, flat(0.0), flat(-50.0)) };
/// let plan = plan_drill(&spec).unwrap();
/// let hole = DrilledHole::new("plate", &spec, &plan);
/// let half = plan.lengths.point / 2.0;
/// assert!((share_in_material(&hole, -half) - 0.25).abs() < 0.01);
/// assert!((share_in_material(&hole, -30.0) - 1.0).abs() < 1e-9);
/// ```
pub fn share_in_material(hole: &DrilledHole, z: f64) -> f64 {
    Share::of(hole.spec, hole.plan).at(z)
}

/// The load of the drill along its way, as far as it is known without forces: the share of the point in material.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LoadCurve {
    /// Whether the share is computed everywhere; false: only where surfaces begin and end, straight in between.
    pub complete: bool,
    /// The way at feed from the start [mm], never falling.
    pub way: Vec<f64>,
    /// The share of the cutting disc in material at each place of the way, from 0 to 1; where it is not complete, straight
    /// between the places that are known, which can be off by a fifth of the disc.
    pub share: Vec<f64>,
}

impl LoadCurve {
    /// The curve of a hole; its numbers are rounded to four decimals.
    pub fn of(hole: &DrilledHole) -> LoadCurve {
        let share = Share::of(hole.spec, hole.plan);
        let start = hole.plan.zones.first().map_or(0.0, |z| z.from);
        let rounded = |v: f64| (v * 1e4).round() / 1e4 + 0.0;
        let [mut way, mut part] = [Vec::new(), Vec::new()];
        for z in hole.plan.zones.iter().filter(|z| z.length() > 0.0).flat_map(places) {
            way.push(rounded(start - z));
            part.push(rounded(share.at(z)));
        }
        LoadCurve { complete: share.is_complete(), way, share: part }
    }
}

/// Evenly spread Z of a zone, from its start to its end [mm].
fn places(zone: &Zone) -> impl Iterator<Item = f64> + use<> {
    let (from, length) = (zone.from, zone.length());
    (0..=PLACES).map(move |i| from - length * f64::from(i) / f64::from(PLACES))
}

/// The chart; x is the program's time where the start is known, otherwise the way at feed.
pub(super) fn chart(hole: &DrilledHole) -> Chart {
    let plan = hole.plan;
    let along = Along { zones: &plan.zones, spindle: plan.spindle, by_time: hole.starts_at.is_some() };
    let x =
        if along.by_time { ("time from the start of the hole", "s") } else { ("way from the start", "mm") };
    let mut chart = Chart::new("Share of the point in material, and feed", x, ("share", ""));
    let zs = plan.zones.iter().flat_map(places);
    let share = Share::of(hole.spec, plan);
    let computed = zs.map(|z| [along.x(z), share.at(z)]).collect();
    let name = if share.is_complete() {
        "in material, computed"
    } else {
        "in material, computed where surfaces begin and end"
    };
    chart = chart.series(name, computed);
    if !hole.simulated.is_empty() {
        let simulated = hole.simulated.iter().map(|p| [along.x(p[0]), p[1]]).collect();
        chart = chart.series("in material, simulated", simulated);
    }
    let most = plan.zones.iter().map(|z| z.feed).fold(0.0, |a: f64, b| if b > a { b } else { a });
    if most > 0.0 {
        let feed = |z: &Zone| [[along.x(z.from), z.feed / most], [along.x(z.to), z.feed / most]];
        let name = format!("feed, as a share of {} mm/rev", fixed(most, 3));
        chart = chart.series(name, plan.zones.iter().flat_map(feed).collect());
    }
    for zone in plan.zones.iter().skip(1).filter(|z| z.length() > NOTHING) {
        chart = chart.mark(along.x(zone.from), format!("{} Z {}", zone.stage.word(), fixed(zone.from, 3)));
    }
    match hole.starts_at {
        Some(start) => chart.follows(Follows::Time, start),
        None => chart,
    }
}

struct Along<'a> {
    zones: &'a [Zone],
    spindle: f64,
    by_time: bool,
}

impl Along<'_> {
    /// Way or time from the start of the hole to a Z; before the start and after the end as if it went on.
    fn x(&self, z: f64) -> f64 {
        let Some((first, last)) = self.zones.first().zip(self.zones.last()) else { return 0.0 };
        if !self.by_time {
            return first.from - z;
        }
        let time = |zone: &Zone, length: f64| length / zone.feed * std::f64::consts::TAU / self.spindle;
        let mut sum = 0.0;
        for zone in self.zones {
            if z >= zone.to {
                return sum + time(zone, zone.from - z);
            }
            sum += time(zone, zone.length());
        }
        sum + time(last, last.to - z)
    }
}
