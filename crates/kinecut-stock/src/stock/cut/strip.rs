//! A strip of tiles across the tool axis: the lines of sixteen rows at all heights, and a task seen along them.

use glam::DVec3;

use super::effect::Looked;
use super::face::SweptFace;
use super::plan::Plan;
use super::task::Task;
use crate::stock::tile::{TILE_EDGE, Tile};
use crate::stock::{EndPoint, Interval};

const EDGE: usize = TILE_EDGE as usize;

/// The tiles of one grid that share sixteen rows.
pub(super) struct Strip<'a> {
    /// In order of height in the stock.
    pub(super) tiles: Vec<&'a mut Tile>,
    /// Direction of the grid along which the height changes: 0 or 1.
    up: usize,
    /// Coordinates of the rows, and of all heights, in the stock.
    pub(super) rows: Vec<f64>,
    pub(super) heights: &'a [f64],
    /// By the part that went through: the cutting part, the shank, the holder.
    pub(super) voids: [[Void; EDGE]; 3],
}

/// A stretch of a row without material over a run of layers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Void {
    from: i32,
    to: i32,
    layers: (usize, usize),
}

impl Void {
    pub(super) fn holds(&self, lo: i32, hi: i32, layers: (usize, usize)) -> bool {
        self.layers.0 <= layers.0 && layers.1 <= self.layers.1 && self.from <= lo && hi <= self.to
    }

    /// Takes in a stretch that was cut, or was found to be void.
    pub(super) fn widen(&mut self, lo: i32, hi: i32, layers: (usize, usize)) {
        if self.layers == layers && lo <= self.to && self.from <= hi {
            (self.from, self.to) = (self.from.min(lo), self.to.max(hi));
        } else if layers.1 - layers.0 >= self.layers.1 - self.layers.0 {
            *self = Void { from: lo, to: hi, layers };
        }
    }
}

/// A task seen along the lines of a strip: x along the lines, y across, w up along the tool.
pub(super) struct View<'a> {
    pub(super) task: &'a Task<'a>,
    pub(super) plan: Plan,
    /// x, y are v, u of the tool frame instead of u, v.
    pub(super) mirrored: bool,
    /// Least and greatest x of the path.
    pub(super) x: (f64, f64),
    pub(super) y: (f64, f64),
}

impl View<'_> {
    /// The normal given along x, y, w as an end point.
    pub(super) fn end(&self, at: i32, n: DVec3, face: SweptFace, part: usize) -> EndPoint {
        // Seen mirrored, left is right.
        let face = match (self.mirrored, face) {
            (true, SweptFace::WallLeft) => SweptFace::WallRight,
            (true, SweptFace::WallRight) => SweptFace::WallLeft,
            (true, SweptFace::FootLeft) => SweptFace::FootRight,
            (true, SweptFace::FootRight) => SweptFace::FootLeft,
            (_, face) => face,
        };
        let n = if self.mirrored { DVec3::new(n.y, n.x, n.z) } else { n };
        self.task.end(at, n, face.class(part))
    }

    /// A point of a line in the tool frame: `x` along the line, which is at `y` and a height of the stock [mm].
    pub(super) fn local(&self, x: f64, [y, height]: [f64; 2]) -> DVec3 {
        let w = height * self.task.frame.sign;
        if self.mirrored { DVec3::new(y, x, w) } else { DVec3::new(x, y, w) }
    }

    /// True if all sections stay at their heights, or widen downwards only.
    pub(super) fn is_level(&self) -> bool {
        self.task.piece.rise() == 0.0 || matches!(self.plan, Plan::Dot(_))
    }

    /// The stretch of a row that discs of a radius on the path may reach.
    pub(super) fn outer(&self, radius: f64, y: f64) -> Option<(f64, f64)> {
        let beside = (self.y.0 - y).max(y - self.y.1).max(0.0);
        let half = ((radius - beside) * (radius + beside)).sqrt();
        (half >= 0.0).then_some((self.x.0 - half, self.x.1 + half))
    }
}

impl<'a> Strip<'a> {
    pub(super) fn new(tiles: Vec<&'a mut Tile>, up: usize, rows: &[f64], heights: &'a [f64]) -> Strip<'a> {
        Strip { tiles, up, rows: rows.to_vec(), heights, voids: [[Void::default(); EDGE]; 3] }
    }

    /// Tile and line of a row at a layer.
    pub(super) fn place(&self, row: usize, layer: usize) -> (usize, usize) {
        let within = layer % EDGE;
        (layer / EDGE, if self.up == 1 { within * EDGE + row } else { row * EDGE + within })
    }

    /// The material of the line of a row at a layer.
    pub(super) fn line(&self, row: usize, layer: usize) -> &[Interval] {
        let (tile, line) = self.place(row, layer);
        self.tiles[tile].line(line)
    }

    /// Coordinate of a row in the stock.
    pub(super) fn row(&self, row: usize) -> f64 {
        self.rows[row]
    }

    /// Height of a layer in the stock.
    pub(super) fn height(&self, layer: usize) -> f64 {
        self.heights[layer]
    }

    /// The voids of a row that a body left or found.
    pub(super) fn void(&mut self, looked: Looked, row: usize) -> &mut Void {
        &mut self.voids[looked as usize][row]
    }

    /// The rows that a body of some radius may reach.
    pub(super) fn rows_within(&self, view: &View, radius: f64) -> std::ops::Range<usize> {
        let first = self.rows.partition_point(|row| *row < view.y.0 - radius);
        let last = self.rows.partition_point(|row| *row <= view.y.1 + radius);
        first..last.max(first)
    }

    /// The layers whose heights in the tool frame are in `[low, high)`.
    pub(super) fn layers(&self, task: &Task, low: f64, high: f64) -> (usize, usize) {
        let of = |w: f64| {
            if task.frame.sign > 0.0 {
                self.heights.partition_point(|h| *h < w)
            } else {
                // Heights fall in the tool frame: -h >= w.
                self.heights.partition_point(|h| -*h >= w)
            }
        };
        let (a, b) = (of(low), of(high));
        (a.min(b), a.max(b))
    }
}
