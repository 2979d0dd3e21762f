//! The bad length over all placements as JSON.

use std::f64::consts::TAU;

use glam::DVec2;
use serde::Serialize;

use crate::facing::Placement;
use crate::facing::optimum::ObjectiveMap;
use crate::operations::face::PlannedFace;

/// The map, column by column as the turn grows. Its numbers are rounded to a thousandth of a mm: it is a picture, the
/// value of a placement comes from a plan of that placement.
#[derive(Debug, Serialize)]
pub(super) struct MapJson {
    /// Least and greatest offset of the cutter's centre line that is allowed at each turn, from the middle of the turned
    /// part's width [mm]; null where none is.
    beside: Vec<Option<[f64; 2]>>,
    /// Number of offsets at each turn, evenly from the least to the greatest.
    rows: usize,
    /// The turns of the part [degrees].
    turns: Vec<f64>,
    /// Bad length with the guard [mm] at each turn, from the least offset on; null where the placement is not allowed, or
    /// for a whole turn.
    values: Vec<Option<Vec<Option<f64>>>>,
}

/// To a thousandth [mm].
fn rounded(v: f64) -> f64 {
    // A sum with zero has no minus of its own.
    (v * 1e3).round() / 1e3 + 0.0
}

impl MapJson {
    pub(super) fn of(face: &PlannedFace, map: &ObjectiveMap) -> MapJson {
        let mirrored = face.plan.left_hand;
        let mut json = MapJson {
            beside: Vec::with_capacity(map.columns),
            rows: map.rows,
            turns: Vec::with_capacity(map.columns),
            values: Vec::with_capacity(map.columns),
        };
        for n in 0..map.columns {
            json.turns.push(360.0 * n as f64 / map.columns as f64);
            // Under M4 the part turns the other way.
            let i = if mirrored { (map.columns - n) % map.columns } else { n };
            let angle = TAU * i as f64 / map.columns as f64;
            let [low, high] = map.offsets[i];
            if low > high {
                json.beside.push(None);
                json.values.push(None);
                continue;
            }
            let [a, b] = face.plan.guarded.outline.extent(DVec2::new(angle.sin(), angle.cos()));
            let seen = |offset: f64| {
                let beside = Placement { angle, offset: offset - 0.5 * (a + b) };
                rounded(if mirrored { beside.mirrored() } else { beside }.offset)
            };
            let mut values: Vec<Option<f64>> =
                map.values[i * map.rows..(i + 1) * map.rows].iter().map(|v| v.map(rounded)).collect();
            let mut range = [seen(low), seen(high)];
            if mirrored {
                values.reverse();
                range.reverse();
            }
            json.beside.push(Some(range));
            json.values.push(Some(values));
        }
        json
    }
}
