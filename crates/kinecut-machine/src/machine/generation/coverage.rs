//! Coverage: the share of the wanted surface that a generated one reaches, and the largest place that it does not.

use std::collections::VecDeque;

use glam::DVec3;
use rayon::prelude::*;
use serde::ser::SerializeMap as _;
use serde::{Serialize, Serializer};

use super::SurfaceMap;
use crate::base::{Code, Finding, Progress, Result};

/// The reached part of a wanted surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Coverage {
    /// Share of the area that is reached, from 0 to 1.
    pub share: f64,
    /// Area of the wanted surface [mm^2].
    #[serde(rename = "area_mm2")]
    pub area: f64,
    /// The largest patch that is not reached.
    #[serde(flatten, serialize_with = "area_and_point")]
    pub largest_gap: Option<Gap>,
}

/// Area and deepest point of a patch.
fn area_and_point<S: Serializer>(gap: &Option<Gap>, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(2))?;
    map.serialize_entry("gap_mm2", &gap.map(|gap| gap.area))?;
    map.serialize_entry("gap_at", &gap.map(|gap| gap.point.to_array()))?;
    map.end()
}

/// A patch that is not reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Area [mm^2].
    pub area: f64,
    /// Its deepest point: the one farthest from what is reached [mm].
    pub point: DVec3,
    /// Distance of that point from the reached part [mm].
    pub distance: f64,
}

/// Samples the wanted surface in the middles of `cells` cells of `domain`; a cell is reached where `reach` (distance of
/// a point from what was generated [mm]) is at most `tolerance` [mm]. Cells that touch by a side are one patch; with
/// `closed` the ends of a range are one line too.
///
/// # Errors
/// `KC1131` for a domain that is empty or a tolerance below zero; `KC0009` when cancelled.
pub fn coverage<S: SurfaceMap + ?Sized>(
    wanted: &S,
    domain: [[f64; 2]; 2],
    cells: [usize; 2],
    closed: [bool; 2],
    reach: impl Fn(DVec3) -> f64 + Sync,
    tolerance: f64,
    progress: &dyn Progress,
) -> Result<Coverage> {
    let [nu, nv] = cells;
    if !(domain[0][1] > domain[0][0] && domain[1][1] > domain[1][0] && nu > 0 && nv > 0 && tolerance >= 0.0) {
        return Err(Finding::error(
            Code::GENERATION_INPUT,
            "the range or the tolerance of a coverage is empty",
        )
        .value(tolerance, "mm")
        .bound(0.0, "mm")
        .help("give ranges whose end is above their start, a cell or more and a tolerance")
        .into());
    }
    let corner = |i: usize, j: usize| {
        let along = |k: usize, i: usize, n: usize| {
            domain[k][0] + (domain[k][1] - domain[k][0]) * i as f64 / (2 * n) as f64
        };
        wanted.point(along(0, i, nu), along(1, j, nv))
    };
    let sample = |i: usize, j: usize| {
        let (a, b) = (corner(2 * i, 2 * j), corner(2 * i + 2, 2 * j + 2));
        let (c, d) = (corner(2 * i + 2, 2 * j), corner(2 * i, 2 * j + 2));
        let middle = corner(2 * i + 1, 2 * j + 1);
        ((b - a).cross(d - c).length() / 2.0, middle, reach(middle))
    };
    let samples: Vec<Option<(f64, DVec3, f64)>> = (0..nu * nv)
        .into_par_iter()
        .map(|n| (!progress.cancelled()).then(|| sample(n / nv, n % nv)))
        .collect();
    let Some(samples) = samples.into_iter().collect::<Option<Vec<_>>>() else {
        return Err(Finding::error(Code::CANCELLED, "the comparison was cancelled").into());
    };
    let area: f64 = samples.iter().map(|s| s.0).sum();
    // A distance that is not a number is not reached.
    let open: Vec<bool> = samples.iter().map(|s| !(s.2 <= tolerance)).collect();
    let missing: f64 = samples.iter().zip(&open).filter(|(_, open)| **open).map(|(s, _)| s.0).sum();
    let mut largest: Option<Gap> = None;
    let mut seen = vec![false; nu * nv];
    for start in 0..nu * nv {
        if seen[start] || !open[start] {
            continue;
        }
        seen[start] = true;
        let mut gap = Gap { area: 0.0, point: samples[start].1, distance: 0.0 };
        let mut queue = VecDeque::from([start]);
        while let Some(n) = queue.pop_front() {
            let (area, point, distance) = samples[n];
            gap.area += area;
            if distance > gap.distance {
                (gap.point, gap.distance) = (point, distance);
            }
            for next in neighbours(n, [nu, nv], closed) {
                if open[next] && !seen[next] {
                    seen[next] = true;
                    queue.push_back(next);
                }
            }
        }
        if largest.is_none_or(|l| gap.area > l.area) {
            largest = Some(gap);
        }
    }
    let share = if area > 0.0 { ((area - missing) / area).clamp(0.0, 1.0) } else { 0.0 };
    Ok(Coverage { share, area, largest_gap: largest })
}

/// The cells that touch cell `n` by a side.
fn neighbours(n: usize, [nu, nv]: [usize; 2], closed: [bool; 2]) -> impl Iterator<Item = usize> {
    let (i, j) = (n / nv, n % nv);
    let step = |x: usize, by: isize, n: usize, closed: bool| {
        let to = x as isize + by;
        if closed {
            Some(to.rem_euclid(n as isize) as usize)
        } else {
            (0..n as isize).contains(&to).then_some(to as usize)
        }
    };
    let along_u = [-1, 1].map(|by| step(i, by, nu, closed[0]).map(|i| i * nv + j));
    let along_v = [-1, 1].map(|by| step(j, by, nv, closed[1]).map(|j| i * nv + j));
    along_u.into_iter().chain(along_v).flatten()
}
