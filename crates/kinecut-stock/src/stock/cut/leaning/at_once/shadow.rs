//! Spans seen along lines: which tiles of lines, and which places, the edges of each may reach.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::super::super::task::TileLines;
use super::super::task::SpanTask;
use crate::geom::Aabb;
use crate::stock::tile::Tile;
use crate::stock::tri_dexel::Grid;
use crate::stock::unfixed;

/// All that the edges of a span may sweep of the stock, seen along its lines: what is near a straight way.
pub(super) struct Shadow {
    from: DVec2,
    to: DVec2,
    reach: f64,
    /// A direction square to the axis of the tool, in one plane with that and the lines, across them and along them; and the place of the
    /// axis in it [mm].
    aside: (DVec2, f64),
    place: f64,
}

impl Shadow {
    pub(super) fn new(task: &SpanTask, along: usize, stock: Aabb) -> Shadow {
        let (pose, body) = (&task.poses.poses[1], &task.tool.cutting);
        let stray = task.poses.span.stray(body.top.max(-body.bottom).hypot(body.radius));
        let reach = body.radius + stray;
        // Places of the tool's axis, which go no farther than needed out of the stock.
        let (rise, tip) = (pose.axis[along], pose.tip[along]);
        let [a, b] = [stock.min[along] - reach, stock.max[along] + reach].map(|s| (s - tip) / rise);
        let (low, high) = if rise.abs() > 1e-9 { (a.min(b), a.max(b)) } else { (f64::MIN, f64::MAX) };
        let ends = [body.bottom, body.top].map(|z| plan(pose.tip + pose.axis * z.min(high).max(low), along));
        let mut line = DVec3::ZERO;
        line[along] = 1.0;
        // No direction where the tool stands along the lines.
        let square = (line - pose.axis * rise).normalize_or_zero();
        let (aside, place) = ((plan(square, along), square[along]), square.dot(pose.tip));
        Shadow { from: ends[0], to: ends[1], reach, aside, place }
    }

    /// True if a place is no farther away than `by` [mm].
    pub(super) fn is_near(&self, place: DVec2, by: f64) -> bool {
        let (way, off) = (self.to - self.from, place - self.from);
        let length = way.length_squared();
        let t = if length > 0.0 { (off.dot(way) / length).clamp(0.0, 1.0) } else { 0.0 };
        let far = self.reach + by;
        (off - way * t).length_squared() <= far * far
    }
}

impl Shadow {
    /// Its area [mm2].
    pub(super) fn area(&self) -> f64 {
        self.reach * (2.0 * self.from.distance(self.to) + PI * self.reach)
    }

    /// True if what lies no farther from a place than `by`, between two coordinates along the lines, is above the tool or below it [mm].
    pub(super) fn passes_by(&self, place: DVec2, by: f64, [low, high]: [f64; 2]) -> bool {
        let (across, along) = self.aside;
        let middle = across.dot(place) + along * (0.5 * (low + high)) - self.place;
        let wide = across.length() * by + along.abs() * (0.5 * (high - low));
        middle.abs() > self.reach + wide
    }
}

/// A point seen along lines: the coordinates along the two other axes in cyclic order, see [`Axis::others`].
pub(super) fn plan(point: DVec3, along: usize) -> DVec2 {
    DVec2::new(point[(along + 1) % 3], point[(along + 2) % 3])
}

/// For each tile of lines the shadows that may reach its material, in order.
pub(super) fn bins(grid: &Grid, lines: &[TileLines], shadows: &[Shadow]) -> Vec<Vec<u32>> {
    let ends = |tile: &TileLines| [0, 1].map(|k| [tile.at[k][0], tile.at[k][tile.size[k] - 1]]);
    let [columns, rows] = grid.tiles_across().map(|n| n as usize);
    let column_ends: Vec<[f64; 2]> = (0..columns).map(|i| ends(&lines[i])[0]).collect();
    let row_ends: Vec<[f64; 2]> = (0..rows).map(|j| ends(&lines[j * columns])[1]).collect();
    // The tiles that overlap a stretch.
    let range = |of: &[[f64; 2]], min: f64, max: f64| {
        let first = of.partition_point(|e| e[1] < min);
        first..first.max(of.partition_point(|e| e[0] <= max))
    };
    let hull = |(tile, lines): (&Tile, &TileLines)| {
        let [width, height] = lines.size.map(|n| n as u32);
        tile.hull(width, height).map(|(low, high)| [low, high].map(unfixed))
    };
    let hulls: Vec<Option<[f64; 2]>> = grid.tiles.iter().zip(lines).map(hull).collect();
    let mut bins = vec![Vec::new(); lines.len()];
    for (i, shadow) in shadows.iter().enumerate() {
        let min = shadow.from.min(shadow.to) - shadow.reach;
        let max = shadow.from.max(shadow.to) + shadow.reach;
        for row in range(&row_ends, min.y, max.y) {
            for column in range(&column_ends, min.x, max.x) {
                let [[a, b], [c, d]] = [column_ends[column], row_ends[row]];
                let (middle, half) =
                    (DVec2::new(0.5 * (a + b), 0.5 * (c + d)), DVec2::new(b - a, d - c) * 0.5);
                let tile = row * columns + column;
                let Some(hull) = hulls[tile] else { continue };
                let half = half.length();
                if shadow.is_near(middle, half) && !shadow.passes_by(middle, half, hull) {
                    bins[tile].push(i as u32);
                }
            }
        }
    }
    bins
}
