//! A piece against a strip of tiles across the tool axis.
//!
//! On a level path a row (same y, all heights) is crossed once for each radius of the section: the side of a cutter
//! cuts all lines of a row at the price of one. A row remembers a stretch that it knows to be void over a run of
//! heights; a crossing that stays in it is done without a look at the lines.

use glam::{DVec3, Vec2Swizzles};

use super::across::{CoveredSpan, Mark, spans};
use super::across_slope::{Cut, slope_spans, surface};
use super::body::{ConvexPart, RevolvedParts};
use super::edge::from_beside;
use super::effect::{Effects, Looked, reaches};
use super::face::{Station, SweptFace};
use super::strip::{Strip, View};
use super::strip_hollow;
use super::strip_look::look;
use super::task::Task;
use crate::stock::{Axis, EndPoint, fixed};

/// The section of a tool part at a layer of a level path.
#[derive(Clone, Copy)]
struct Section<'a> {
    part: usize,
    of: &'a ConvexPart,
    /// Height above the tip.
    z: f64,
}

impl Strip<'_> {
    /// Takes a task past the lines, which run along `axis`: what it meets is noted, then or before it is cut by the rule
    /// at the head of `tile_axial.rs`.
    pub(super) fn pass(&mut self, axis: Axis, task: &Task, effects: &mut Effects) {
        let view = Strip::view(axis, task);
        if self.rows_within(&view, task.tool.radius).is_empty() {
            return;
        }
        let before = task.piece.rise() > 0.0;
        if before {
            self.look_above(&view, effects);
        }
        if task.watch {
            from_beside(self, &view, &task.tool.contact, Looked::Cutting, effects);
        }
        let rows = self.rows_within(&view, task.tool.cutting.radius);
        if let Some((hollow, centre)) = task.hollow() {
            let centre = if view.mirrored { centre.yx() } else { centre };
            strip_hollow::pass_rows(self, &view, hollow, centre, rows, effects);
        } else {
            if task.watch {
                look(self, &view, &task.tool.contact, Looked::Cutting, effects);
            }
            if task.removes {
                self.cut(&view, rows, (0, self.heights.len()));
            }
        }
        if !before {
            self.look_above(&view, effects);
        }
        for (body, looked) in [(&task.tool.shank, Looked::Shank), (&task.tool.holder, Looked::Holder)] {
            from_beside(self, &view, body, looked, effects);
        }
    }

    /// A task seen along lines that run along `axis`.
    pub(super) fn view<'a>(axis: Axis, task: &'a Task<'a>) -> View<'a> {
        let mirrored = axis == task.frame.axes[1];
        let (min, max) = task.plan_box;
        let (mut x, mut y) = ((min.x, max.x), (min.y, max.y));
        let mut plan = task.piece.plan;
        if mirrored {
            (x, y, plan) = (y, x, plan.mirrored());
        }
        View { task, plan, mirrored, x, y }
    }

    /// Cuts rows of lines in some layers; what is met is not noted.
    pub(super) fn cut(&mut self, view: &View, rows: std::ops::Range<usize>, within: (usize, usize)) {
        if view.is_level() {
            self.cut_level(view, rows, within);
        } else {
            self.cut_sloping(view, rows, within);
        }
    }

    /// Notes what shank and holder meet.
    fn look_above(&mut self, view: &View, effects: &mut Effects) {
        let tool = view.task.tool;
        for (body, looked) in [(&tool.shank, Looked::Shank), (&tool.holder, Looked::Holder)] {
            look(self, view, body, looked, effects);
        }
    }

    fn cut_level(&mut self, view: &View, rows: std::ops::Range<usize>, within: (usize, usize)) {
        let task = view.task;
        let body: &RevolvedParts = &task.tool.cutting;
        let (low, high) = task.tip_range();
        // A tool that moves along its axis shows its widest section: that of its lowest position. From the height at
        // which its widest part is a cylinder all sections are equal.
        let Some((part, widest)) = body.parts.iter().enumerate().max_by(|a, b| a.1.r1.total_cmp(&b.1.r1))
        else {
            return;
        };
        let clip = |layers: (usize, usize)| (layers.0.max(within.0), layers.1.min(within.1));
        let side = clip(self.layers(task, low + widest.z1, high + body.top));
        let foot = clip(self.layers(task, low + body.bottom, (low + widest.z1).min(high + body.top)));
        for row in rows {
            if side.0 < side.1 {
                self.cut_level_row(view, row, side, Section { part, of: widest, z: widest.z1 });
            }
            for layer in foot.0..foot.1 {
                let z = self.heights[layer] * task.frame.sign - low;
                if let Some((part, of)) = body.widest(z) {
                    self.cut_level_row(view, row, (layer, layer + 1), Section { part, of, z });
                }
            }
        }
    }

    /// A row over layers of equal section.
    fn cut_level_row(&mut self, view: &View, row: usize, layers: (usize, usize), section: Section) {
        let (radius, y) = (section.of.radius(section.z), self.rows[row]);
        let Some((from, to)) = view.outer(radius, y) else { return };
        if self.voids[Looked::Cutting as usize][row].holds(fixed(from), fixed(to), layers) {
            return;
        }
        if layers.1 - layers.0 == 1 {
            let (tile, line) = self.place(row, layers.0);
            if !reaches(self.tiles[tile].line(line), fixed(from), fixed(to)) {
                return;
            }
        }
        for span in spans(&view.plan, radius, y).as_slice() {
            let (lo, hi) = (fixed(span.lo.x), fixed(span.hi.x));
            if self.voids[Looked::Cutting as usize][row].holds(lo, hi, layers) {
                continue;
            }
            let mut ends = None;
            for layer in layers.0..layers.1 {
                let (tile, line) = self.place(row, layer);
                if reaches(self.tiles[tile].line(line), lo, hi) {
                    let [lower, upper] =
                        *ends.get_or_insert_with(|| level_ends(view, &section, span, lo, hi));
                    self.tiles[tile].subtract(line, lower, upper);
                }
            }
            if lo < hi {
                self.voids[Looked::Cutting as usize][row].widen(lo, hi, layers);
            }
        }
    }

    fn cut_sloping(&mut self, view: &View, rows: std::ops::Range<usize>, within: (usize, usize)) {
        let task = view.task;
        let piece = &task.piece;
        let body: &RevolvedParts = &task.tool.cutting;
        let (low, high) = task.tip_range();
        let (first, last) = self.layers(task, low + body.bottom, high + body.top);
        for layer in first.max(within.0)..last.min(within.1) {
            let w = self.heights[layer] * task.frame.sign;
            for (i, part) in body.parts.iter().enumerate().filter(|(_, p)| w - low >= p.z0) {
                let most = part.radius(w - low);
                for row in rows.clone() {
                    let y = self.rows[row];
                    let Some((from, to)) = view.outer(most, y) else { continue };
                    let (tile, line) = self.place(row, layer);
                    if !reaches(self.tiles[tile].line(line), fixed(from), fixed(to)) {
                        continue;
                    }
                    slope_spans(part, piece, &view.plan, y, w, |found| {
                        let (lo, hi) = (fixed(found.span.lo.x), fixed(found.span.hi.x));
                        if !reaches(self.tiles[tile].line(line), lo, hi) {
                            return;
                        }
                        let end = |at: i32, mark: &Mark, cut: Cut| {
                            let (n, face) = surface(part, piece, &view.plan, w, mark, cut);
                            view.end(at, n, face, i)
                        };
                        let ends = [end(lo, &found.span.lo, found.lo), end(hi, &found.span.hi, found.hi)];
                        self.tiles[tile].subtract(line, ends[0], ends[1]);
                    });
                }
            }
        }
    }
}

/// The end points of a span on layers of equal section.
fn level_ends(view: &View, section: &Section, span: &CoveredSpan, lo: i32, hi: i32) -> [EndPoint; 2] {
    let (nx, nz) = section.of.side_normal(section.z);
    let end = |at: i32, mark: &Mark| {
        let between = mark.t > 0.0 && mark.t < 1.0;
        let station = if between { Station::Between } else { view.task.piece.station(mark.t) };
        let face = SweptFace::side(section.z < section.of.z1, station, mark.left);
        view.end(at, DVec3::new(-nx * mark.e.x, -nx * mark.e.y, -nz), face, section.part)
    };
    [end(lo, &span.lo), end(hi, &span.hi)]
}
