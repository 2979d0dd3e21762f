//! A piece against a tile of lines across the tool axis.
//!
//! On a level path a row of the tile (same y, all heights) is crossed once for each radius of the section: a
//! cylinder cuts sixteen lines at the price of one.

use glam::DVec3;

use super::across::{Mark, Spans, spans};
use super::across_slope::{Cut, slope_spans, surface};
use super::body::Body;
use super::effect::met;
use super::face::{Face, Station};
use super::plan::Plan;
use super::task::{Task, TileLines};
use crate::stock::tile::{TILE_EDGE, Tile};
use crate::stock::{Axis, EndPoint, fixed};

/// A piece seen along the lines of a grid: x along the lines, y across, w up along the tool.
struct View<'a> {
    task: &'a Task<'a>,
    plan: Plan,
    /// Whether x, y are v, u of the tool frame instead of u, v.
    mirrored: bool,
    /// Direction of the tile along which the height changes: 0 or 1.
    up: usize,
}

impl View<'_> {
    /// The normal given along x, y, w as an end point.
    fn end(&self, at: i32, n: DVec3, class: u8) -> EndPoint {
        self.task.end(at, if self.mirrored { DVec3::new(n.y, n.x, n.z) } else { n }, class)
    }

    /// Seen mirrored, left is right.
    fn face(&self, face: Face) -> Face {
        match (self.mirrored, face) {
            (true, Face::WallLeft) => Face::WallRight,
            (true, Face::WallRight) => Face::WallLeft,
            (true, Face::FootLeft) => Face::FootRight,
            (true, Face::FootRight) => Face::FootLeft,
            (_, face) => face,
        }
    }

    /// Line of the tile in a row at a layer.
    fn line(&self, row: usize, layer: usize) -> usize {
        let edge = TILE_EDGE as usize;
        if self.up == 1 { layer * edge + row } else { row * edge + layer }
    }
}

/// Cuts a tile of lines along `axis`; true when it was changed.
pub(super) fn cut_across(tile: &mut Tile, lines: &TileLines, axis: Axis, task: &Task) -> bool {
    if !task.removes {
        return false;
    }
    let mirrored = axis == task.frame.axes[1];
    let plan = if mirrored { task.piece.plan.mirrored() } else { task.piece.plan };
    let up = if axis.others().0 == task.frame.axes[2] { 0 } else { 1 };
    let view = View { task, plan, mirrored, up };
    let (min, max) = task.plan_box;
    let (y_min, y_max) = if mirrored { (min.x, max.x) } else { (min.y, max.y) };
    let radius = task.tool.cutting.radius;
    let rows = lines.at[1 - up];
    let level = task.piece.rise() == 0.0 || matches!(plan, Plan::Dot(_));
    let mut layers = [Section::default(); TILE_EDGE as usize];
    let layers = &mut layers[..lines.size[up]];
    for (layer, w) in layers.iter_mut().zip(lines.at[up]) {
        *layer = Section::of(task, w * task.frame.sign, level);
    }
    if layers.iter().all(|s| s.radius <= 0.0) {
        return false;
    }
    let mut changed = false;
    for (row, &y) in rows[..lines.size[1 - up]].iter().enumerate() {
        if y < y_min - radius || y > y_max + radius {
            continue;
        }
        changed |= if level {
            level_row(tile, &view, layers, row, y)
        } else {
            slope_row(tile, &view, layers, row, y)
        };
    }
    changed
}

/// The section of the tool at a layer; on a slope only whether there is one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Section {
    /// Height of the line.
    w: f64,
    /// 0 where the tool does not come.
    radius: f64,
    /// Normal of the side: outwards, up.
    side: (f64, f64),
    part: usize,
    /// Whether it is the foot.
    foot: bool,
}

impl Section {
    fn of(task: &Task, w: f64, level: bool) -> Section {
        let body: &Body = &task.tool.cutting;
        let (low, high) = task.tip_range();
        let none = Section { w, ..Section::default() };
        if w - low < body.bottom || w - high >= body.top {
            return none;
        }
        if !level {
            return Section { radius: body.radius, ..none };
        }
        // A tool that moves along its axis shows its widest section: that of its lowest position; above its top
        // there, that of its full radius.
        let z = w - low;
        let found = if z < body.top {
            body.widest(z)
        } else {
            body.parts.iter().enumerate().max_by(|a, b| a.1.r1.total_cmp(&b.1.r1))
        };
        let Some((part, p)) = found else { return none };
        Section { w, radius: p.radius(z), side: p.side_normal(z), part, foot: z < p.z1 }
    }

    fn same(&self, other: &Section) -> bool {
        self.radius == other.radius
            && self.side == other.side
            && self.part == other.part
            && self.foot == other.foot
    }
}

/// A row of a level piece.
fn level_row(tile: &mut Tile, view: &View, layers: &[Section], row: usize, y: f64) -> bool {
    let mut changed = false;
    let mut crossed: Option<(&Section, Spans)> = None;
    for (layer, section) in layers.iter().enumerate().filter(|(_, s)| s.radius > 0.0) {
        let l = view.line(row, layer);
        if tile.line(l).is_empty() {
            continue;
        }
        let found = match &crossed {
            Some((old, found)) if old.same(section) => found,
            _ => &crossed.insert((section, spans(&view.plan, section.radius, y))).1,
        };
        for span in found.as_slice() {
            let (lo, hi) = (fixed(span.lo.x), fixed(span.hi.x));
            if met(tile.line(l), lo, hi).0 == 0 {
                continue;
            }
            let end = |at: i32, mark: &Mark| {
                let (nx, nz) = section.side;
                let n = DVec3::new(-nx * mark.e.x, -nx * mark.e.y, -nz);
                let station = if mark.t > 0.0 && mark.t < 1.0 {
                    Station::Between
                } else {
                    view.task.piece.station(mark.t)
                };
                let face = view.face(Face::side(section.foot, station, mark.left));
                view.end(at, n, face.class(section.part))
            };
            tile.subtract(l, end(lo, &span.lo), end(hi, &span.hi));
            changed = true;
        }
    }
    changed
}

/// A row of a sloping piece.
fn slope_row(tile: &mut Tile, view: &View, layers: &[Section], row: usize, y: f64) -> bool {
    let mut changed = false;
    let piece = &view.task.piece;
    for (layer, section) in layers.iter().enumerate().filter(|(_, s)| s.radius > 0.0) {
        let l = view.line(row, layer);
        if tile.line(l).is_empty() {
            continue;
        }
        for (i, part) in view.task.tool.cutting.parts.iter().enumerate() {
            slope_spans(part, piece, &view.plan, y, section.w, |found| {
                let (lo, hi) = (fixed(found.span.lo.x), fixed(found.span.hi.x));
                if met(tile.line(l), lo, hi).0 == 0 {
                    return;
                }
                let end = |at: i32, mark: &Mark, cut: Cut| {
                    let (n, face) = surface(part, piece, &view.plan, section.w, mark, cut);
                    view.end(at, n, view.face(face).class(i))
                };
                tile.subtract(l, end(lo, &found.span.lo, found.lo), end(hi, &found.span.hi, found.hi));
                changed = true;
            });
        }
    }
    changed
}
