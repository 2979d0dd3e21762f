//! Amounts that the moves of a run remove, in order, on some of the lines.
//!
//! Of the lines along the tool axis one in the middle of each square of n lines is taken, n up to 16. The squares are no wider than a
//! quarter of the radius of the run's thinnest tool, but for a long tool that leans, whose spans pass [`MOST_LINES`] of them in the mean at
//! most; where the lines of the stock are no closer, all are taken. Each counts for the lines of its square. Of a span, poses are taken that
//! are a quarter of the radius apart or less, and not the first where the span before ends there. An amount found so is measured, not bounded.
//! Neighbours are asked about together first, with one tangent plane for all of them.

use std::ops::Range;

use glam::{DVec2, DVec3};
use pulp::Arch;
use rayon::prelude::*;

use super::super::super::body::RevolvedParts;
use super::super::super::effect::{Effect, Effects};
use super::super::super::task::TileLines;
use super::super::chord::LineFrom;
use super::super::task::SpanTask;
use super::about::about;
use super::bundle::Shape;
use super::lanes::{LANES, WAY, Ways, put};
use super::near::{Beside, SweptPart};
use super::shadow::{Shadow, bins, plan};
use crate::base::Progress;
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, CutId, DexelGrid, TriDexel, fixed, unfixed};

/// Lines, and poses, to a radius of the tool.
const LINES: f64 = 4.0;

/// Lines that a span passes in the mean, beyond which they are farther apart: a long tool that leans passes many.
const MOST_LINES: f64 = 128.0;

/// Cosine of the angle to lines below which they are not those to measure a tool on: 53 degrees.
const FLAT: f64 = 0.6;

/// Most stretches between poses of a span.
const MOST_POSES: usize = 16;

/// A line on which is measured.
struct Sample {
    /// Its point at the coordinate 0.
    start: DVec3,
    /// Lines that it counts for.
    lines: i64,
    /// Its material [fixed steps].
    material: Vec<(i32, i32)>,
    /// The last move that cut it, and the material that it met there so far [fixed steps].
    met: (CutId, i64),
}

/// Lines next to one another on which is measured.
struct Group {
    samples: Vec<Sample>,
    /// The place in their middle, as seen along them, and the distance of the farthest of them [mm].
    middle: DVec2,
    half: f64,
    /// Coordinates between which all their material lies [fixed steps]; the wrong way round when there is none.
    hull: (i32, i32),
}

/// A span that passes lines next to one another.
struct Passing<'a> {
    task: &'a SpanTask<'a>,
    parts: &'a [SweptPart<'a>],
    shadow: &'a Shadow,
    /// The span before ends where it begins.
    goes_on: bool,
    /// The lines are those that the span is measured on.
    is_main: bool,
    /// Its place among the spans that are taken together.
    lane: usize,
    /// Its planes beside the lines.
    planes: Range<usize>,
}

/// Room for the spans that pass a group, and for the stretches of a line.
struct Room<'a> {
    arch: Arch,
    /// The only part of all spans that are taken together, if that is one, and the ways of it.
    alike: Option<Shape>,
    ways: Ways,
    passing: Vec<Passing<'a>>,
    planes: Vec<Beside>,
    chords: Vec<(i32, i32)>,
    covered: Vec<(i32, i32)>,
    contact: Vec<(i32, i32)>,
}

/// By span, the index of the axis along which it is measured: the one that most tools are nearest to, but for a tool that leans from it by
/// more than [`FLAT`] the one that it is nearest to itself.
pub(super) fn measured_along(tasks: &[SpanTask]) -> Vec<usize> {
    let axes = tasks.iter().map(|t| t.poses.poses[1].axis.abs());
    let usual = Axis::nearest(axes.clone().sum()).index();
    axes.map(|axis| if axis[usual] > FLAT { usual } else { Axis::nearest(axis).index() }).collect()
}

/// Tells what moves remove, on lines along the axes that their spans are measured along.
pub(super) fn account(
    stock: &TriDexel,
    (tasks, main): (&[SpanTask], &[usize]),
    swept: &[SweptPart],
    progress: &dyn Progress,
    mut each: impl FnMut(&Effect),
) {
    let lattice = *stock.lattice();
    let radius = tasks.iter().map(|t| t.tool.cutting.radius).fold(f64::INFINITY, f64::min);
    let mut rest = swept;
    let own = |task: &SpanTask| {
        let own;
        (own, rest) = rest.split_at(task.tool.cutting.parts.len());
        own
    };
    let parts: Vec<&[SweptPart]> = tasks.iter().map(own).collect();
    let goes_on: Vec<bool> = (0..tasks.len()).map(|i| i > 0 && tasks[i].goes_on(&tasks[i - 1])).collect();
    for grid in &stock.grids {
        let along = grid.axis.index();
        if !main.contains(&along) {
            continue;
        }
        let lines: Vec<TileLines> =
            (0..grid.tiles.len()).map(|t| TileLines::new(grid, &lattice, t)).collect();
        let shadows: Vec<Shadow> = tasks.iter().map(|t| Shadow::new(t, along, stock.bounds())).collect();
        let area = shadows.iter().map(Shadow::area).sum::<f64>() / shadows.len() as f64;
        let apart = (radius / LINES).max((area / MOST_LINES).sqrt()) / lattice.step;
        let apart = apart.clamp(1.0, f64::from(TILE_EDGE)) as u32;
        let bins = bins(grid, &lines, &shadows);
        let work =
            bins.par_iter().zip(&lines).enumerate().with_max_len(4).filter(|(_, (bin, _))| !bin.is_empty());
        let done: Vec<Effects> = work
            .map(|(tile, (bin, lines))| {
                let (mut effects, mut room) = (Effects::default(), Room::new());
                let mut groups = groups(grid, tile, lines, apart);
                for some in bin.chunks(LANES) {
                    if groups.is_empty() || progress.cancelled() {
                        break;
                    }
                    room.take(some.iter().map(|i| parts[*i as usize]));
                    for group in &mut groups {
                        room.passing.clear();
                        let all = some.iter().map(|i| *i as usize).enumerate();
                        let near = all.filter(|(_, i)| shadows[*i].is_near(group.middle, group.half));
                        let passing = |(lane, i): (usize, usize)| Passing {
                            task: &tasks[i],
                            parts: parts[i],
                            shadow: &shadows[i],
                            goes_on: goes_on[i],
                            is_main: main[i] == along,
                            lane,
                            planes: 0..0,
                        };
                        room.passing.extend(near.map(passing));
                        group.pass(along, &mut effects, &mut room);
                    }
                }
                effects
            })
            .collect();
        done.iter().flat_map(Effects::iter).for_each(&mut each);
    }
}

/// The lines of a tile on which is measured: those in the middle of squares of `apart` lines.
fn groups(grid: &Grid, tile: usize, lines: &TileLines, apart: u32) -> Vec<Group> {
    let (first, size) = grid.tile_lines(tile);
    let along = grid.axis.index();
    // Index in the tile, and lines across.
    let places: [Vec<(u32, u32)>; 2] = [0, 1].map(|k| {
        let (from, end) = (first[k], first[k] + size[k]);
        let squares = (from / apart..=end / apart).map(|n| (n * apart, grid.counts[k].min((n + 1) * apart)));
        let middles = squares.filter(|(a, b)| a < b).map(|(a, b)| ((a + b) / 2, b - a));
        middles.filter(|(i, _)| (from..end).contains(i)).map(|(i, n)| (i - from, n)).collect()
    });
    let mut groups = Vec::new();
    for rows in places[1].chunks(2) {
        for columns in places[0].chunks(2) {
            let mut samples = Vec::with_capacity(4);
            for (b, height) in rows {
                for (a, width) in columns {
                    let mut start = DVec3::ZERO;
                    // The two other axes in cyclic order, see `Axis::others`.
                    start[(along + 1) % 3] = lines.at[0][*a as usize];
                    start[(along + 2) % 3] = lines.at[1][*b as usize];
                    let line = grid.tiles[tile].line((b * TILE_EDGE + a) as usize);
                    let material = line.iter().map(|i| (i.lo.at, i.hi.at)).collect();
                    let lines = i64::from(width * height);
                    samples.push(Sample { start, lines, material, met: (0, 0) });
                }
            }
            let ends = [0, samples.len() - 1].map(|i| plan(samples[i].start, along));
            let (middle, half) = ((ends[0] + ends[1]) * 0.5, 0.5 * ends[0].distance(ends[1]));
            let mut group = Group { samples, middle, half, hull: (0, 0) };
            group.look();
            groups.push(group);
        }
    }
    groups
}

impl Group {
    /// Sets the hull of the material.
    fn look(&mut self) {
        let ends = self.samples.iter().flat_map(|s| &s.material);
        self.hull = ends.fold((i32::MAX, i32::MIN), |hull, of| (hull.0.min(of.0), hull.1.max(of.1)));
    }

    /// Takes spans past the lines, in their order, and tells what they do there if the lines are those that they are measured on.
    fn pass(&mut self, along: usize, effects: &mut Effects, room: &mut Room) {
        let hull = self.hull;
        let bounds = |p: &Passing| [p.task.bounds.min[along], p.task.bounds.max[along]].map(fixed);
        let heights = [hull.0, hull.1].map(unfixed);
        room.passing.retain(|p| {
            let [low, high] = bounds(p);
            low < hull.1 && hull.0 < high && !p.shadow.passes_by(self.middle, self.half, heights)
        });
        let Some(first) = room.passing.first() else { return };
        // A place at the material where the tool comes from.
        let from_above = first.task.poses.poses[1].axis[along] > 0.0;
        let mut anchor = DVec3::ZERO;
        anchor[along] = unfixed(if from_above { hull.1 } else { hull.0 });
        (anchor[(along + 1) % 3], anchor[(along + 2) % 3]) = (self.middle.x, self.middle.y);
        room.look(anchor, self.half);
        let passing = std::mem::take(&mut room.passing);
        for one in &passing {
            // Of the planes all goes on to hold when there is less material.
            let mut changed = false;
            for sample in &mut self.samples {
                if sample.is_reached(&room.planes[one.planes.clone()], anchor, along)
                    && one.shadow.is_near(plan(sample.start, along), 0.0)
                {
                    changed |= sample.pass(one, along, effects, room);
                }
            }
            if changed {
                self.look();
            }
        }
        room.passing = passing;
    }
}

impl<'a> Room<'a> {
    fn new() -> Room<'a> {
        Room {
            arch: Arch::default(),
            alike: None,
            ways: [[0.0; LANES]; WAY],
            passing: Vec::new(),
            planes: Vec::new(),
            chords: Vec::new(),
            covered: Vec::new(),
            contact: Vec::new(),
        }
    }

    /// Takes the parts of spans together, [`LANES`] of them or fewer.
    fn take(&mut self, spans: impl Iterator<Item = &'a [SweptPart<'a>]> + Clone) {
        let part = spans.clone().next().and_then(|parts| parts.first()).map(|first| first.part);
        let is_alike = |parts: &[SweptPart]| {
            parts.len() == 1 && part.is_some_and(|part| std::ptr::eq(parts[0].part, part))
        };
        self.alike = part.and_then(Shape::of).filter(|_| spans.clone().all(is_alike));
        if self.alike.is_some() {
            spans.enumerate().for_each(|(lane, parts)| put(&mut self.ways, lane, &parts[0]));
        }
    }

    /// Sets the planes of the spans about a place.
    fn look(&mut self, place: DVec3, radius: f64) {
        self.planes.clear();
        for one in &mut self.passing {
            let from = self.planes.len();
            one.planes = from..from + one.parts.len();
            self.planes.extend(one.parts.iter().map(|_| Beside::default()));
        }
        match self.alike {
            Some(shape) => {
                let about = about(self.arch, shape, &self.ways, place.to_array(), radius);
                let planes = self.planes.iter_mut().zip(&self.passing);
                planes.for_each(|(plane, one)| *plane = Beside::of(&about, one.lane));
            }
            None => {
                let parts = self.passing.iter().flat_map(|one| one.parts);
                self.planes
                    .iter_mut()
                    .zip(parts)
                    .for_each(|(plane, part)| *plane = part.beside(place, radius));
            }
        }
    }
}

impl Sample {
    /// True unless planes about a place say that nothing of the material is reached.
    fn is_reached(&self, planes: &[Beside], anchor: DVec3, along: usize) -> bool {
        let (Some(first), Some(last)) = (self.material.first(), self.material.last()) else { return false };
        let mut off = self.start - anchor;
        off[along] = 0.0;
        let [low, high] = [first.0, last.1].map(|at| unfixed(at) - anchor[along]);
        planes.iter().any(|plane| {
            let at_plane = plane.normal.dot(off) - plane.reach;
            // What the plane leaves is convex along the line: nothing if neither end is in it.
            [low, high].iter().any(|s| at_plane + plane.normal[along] * s <= plane.widens * s.abs())
        })
    }

    /// Takes a span past the line; tells what it does there if that is asked for. True if that changed it.
    fn pass(&mut self, passing: &Passing, along: usize, effects: &mut Effects, room: &mut Room) -> bool {
        let Room { chords, covered, contact, .. } = room;
        let task = passing.task;
        cover(&task.tool.cutting, passing, (self.start, along), chords, covered);
        let removed: i64 = covered.iter().map(|c| length(&self.material, *c)).sum();
        if removed == 0 {
            return false;
        }
        if passing.is_main {
            cover(&task.tool.contact, passing, (self.start, along), chords, contact);
            let met: i64 = contact.iter().map(|c| length(&self.material, *c)).sum();
            let effect = effects.of(task.index);
            effect.removed += removed * self.lines;
            if met > 0 {
                if self.met.0 != task.cut {
                    self.met = (task.cut, 0);
                }
                self.met.1 += met;
                effect.deepest = effect.deepest.max(self.met.1);
                let t = task.poses.span.fraction(0.0);
                if effect.first.is_none_or(|(old, _)| t < old) {
                    let top = contact.iter().map(|c| c.1.min(self.material[self.material.len() - 1].1)).max();
                    let mut point = self.start;
                    point[along] = unfixed(top.unwrap_or(0));
                    effect.first = Some((t, point.to_array()));
                }
            }
        }
        for (lo, hi) in covered {
            subtract(&mut self.material, *lo, *hi);
        }
        true
    }
}

/// The stretches of a line that a body covers in a span, without those between; sorted, and apart from each other [fixed steps].
fn cover(
    body: &RevolvedParts,
    passing: &Passing,
    (start, along): (DVec3, usize),
    chords: &mut Vec<(i32, i32)>,
    covered: &mut Vec<(i32, i32)>,
) {
    let poses = &passing.task.poses;
    let wanted = 2.0 * LINES * poses.span.stray(body.radius) / body.radius;
    let count = (wanted.ceil() as usize).clamp(1, MOST_POSES);
    chords.clear();
    for i in usize::from(passing.goes_on)..=count {
        let pose = match (i, count) {
            (0, _) => poses.poses[0],
            (1, 2) => poses.poses[1],
            _ if i == count => poses.poses[2],
            _ => poses.span.at(i as f64 / count as f64 - 0.5),
        };
        let from = LineFrom::new(start, along, &pose);
        let of = |part| from.chord(part).map(|chord| (fixed(chord.lo), fixed(chord.hi)));
        chords.extend(body.parts.iter().filter_map(of));
    }
    chords.sort_unstable();
    covered.clear();
    for (lo, hi) in chords {
        match covered.last_mut() {
            Some(last) if *lo <= last.1 => last.1 = last.1.max(*hi),
            _ => covered.push((*lo, *hi)),
        }
    }
}

/// Length of material between two coordinates.
fn length(material: &[(i32, i32)], (lo, hi): (i32, i32)) -> i64 {
    material.iter().map(|(from, to)| (i64::from(*to.min(&hi)) - i64::from(*from.max(&lo))).max(0)).sum()
}

/// Takes a stretch out of material.
fn subtract(material: &mut Vec<(i32, i32)>, lo: i32, hi: i32) {
    let mut i = 0;
    while i < material.len() {
        let (from, to) = material[i];
        if to <= lo || hi <= from {
            i += 1;
            continue;
        }
        material.remove(i);
        if from < lo {
            material.insert(i, (from, lo));
            i += 1;
        }
        if hi < to {
            material.insert(i, (hi, to));
            i += 1;
        }
    }
}
