//! The stock over time, to be looked at: for each piece of its surface the moments at which it comes and goes.
//!
//! The moves are cut in order on a lattice of their own; each lattice point keeps the tick ([`Clock`]) in which it is taken, each line
//! the pieces that go in one tick. A square of surface lies between two neighbouring points that go in different ticks: it is there from
//! the one to the other. Its corners are in the middle of what the lines tell of the places where they cross the surface while it is
//! there, so that flat faces are flat and round ones round.
//!
//! **Error.** At each tick the surface is within a step of that of the stock, except for what is thinner than a step, and near the tool:
//! there material may go a tick early or late, and between ticks that follow one another closely the surface is that of
//! the longest of them. It is for the eye: nothing is proven with it.

mod clock;
mod pieces;
mod surface;

use rayon::prelude::*;

pub use self::clock::Clock;
use self::pieces::{Piece, TilePieces};
pub use self::surface::{PlayedFace, PlayedSurface, REMAINS};
use super::list::CutList;
use super::noted::{Noted, bounds_of, cut_noted, move_of, noted};
use super::task::TileLines;
use super::way::{ToolWay, WaySpan};
use super::{CutMove, CutOptions, ToolBody};
use crate::base::{Progress, Result};
use crate::geom::Aabb;
use crate::stock::tile::TakenStretch;
use crate::stock::tri_dexel::Grid;
use crate::stock::{Axis, DexelGrid, Lattice, TriDexel, fixed, unfixed};

/// Moves that are made ready at once.
const AT_ONCE: usize = 2048;
/// Thickness below which a piece of a line goes with the one beside it, as a part of a step.
const THIN: f64 = 0.125;
/// Part of a stretch of the way up to which a moment is looked for: stretches are about as long as ticks.
const SHORT: f64 = 0.25;

/// A stock whose material goes over time.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use kinecut::base::Silent;
/// use kinecut::geom::{Aabb, Line, Profile};
/// use kinecut::stock::TriDexel;
/// use kinecut::stock::cut::{Clock, CutAxis, CutMove, Playback, REMAINS, ToolBody};
/// let plate = Aabb { min: [0.0, 0.0, -10.0].into(), max: [40.0, 20.0, 0.0].into() };
/// let mut stock = TriDexel::from_box(plate, 0.5).unwrap();
/// let tool = ToolBody::new(Profile::cylinder(8.0, 20.0).unwrap());
/// let slot = Line { start: [-10.0, 10.0, -3.0].into(), end: [50.0, 10.0, -3.0].into() };
/// let mut playback = Playback::new(&stock, Clock::new([60.0], 1.0));
/// playback.cut(&mut stock, &[tool], &[CutMove::new(slot, CutAxis::PlusZ, 0)], &Silent).unwrap();
/// let surface = playback.surface(&stock, 100_000);
/// // In the middle of the way the slot is 24 mm long.
/// let now = surface.ticks / 2;
/// let deep = |face: &&kinecut::stock::cut::PlayedFace| {
///     (face.from..face.to).contains(&now) && face.corners.iter().all(|c| (surface.vertices[*c as usize][2] + 3.0).abs() < 1e-3)
/// };
/// let far = surface.faces.iter().filter(deep).flat_map(|face| face.corners).map(|c| surface.vertices[c as usize][0]);
/// assert!((far.fold(0.0, f32::max) - 24.0).abs() < 1.0);
/// assert!(surface.faces.iter().any(|face| face.to == REMAINS));
/// ```
#[derive(Clone, Debug)]
pub struct Playback {
    lattice: Lattice,
    clock: Clock,
    /// The tick in which each point of the lattice goes, Z fastest, then Y; 0 of those that have not gone.
    nodes: Vec<u16>,
    /// By grid and tile.
    pieces: [Vec<TilePieces>; 3],
    /// Number of the next move.
    next: usize,
}

impl Playback {
    /// Of a stock as it is now. The clock counts the moves that come, all together.
    pub fn new(stock: &TriDexel, clock: Clock) -> Playback {
        let lattice = *stock.lattice();
        let nodes = vec![0; lattice.counts.iter().map(|n| *n as usize).product()];
        let pieces = [0, 1, 2].map(|k| vec![TilePieces::default(); stock.grids[k].tiles.len()]);
        Playback { lattice, clock, nodes, pieces, next: 0 }
    }

    /// Memory for a stock in a box, beside that of the stock itself [bytes], about.
    pub fn memory(bounds: Aabb, step: f64) -> u64 {
        /// Bytes of a point, its lines, and the faces about it while the surface is made.
        const OF_POINT: f64 = 100.0;
        // With the border.
        let size = bounds.size() / step + 2.0;
        (size.x * size.y * size.z * OF_POINT) as u64
    }

    /// The clock.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Takes what the next moves sweep out of the stock. Shanks and holders are left out, and moves that remove nothing.
    ///
    /// # Errors
    /// As [`cut`](super::cut()).
    pub fn cut(
        &mut self,
        stock: &mut TriDexel,
        bodies: &[ToolBody],
        moves: &[CutMove],
        progress: &dyn Progress,
    ) -> Result<()> {
        let step = self.lattice.step;
        let bare = |body: &ToolBody| ToolBody { shank: vec![], holder: vec![], ..body.clone() };
        let bodies: Vec<ToolBody> = bodies.iter().map(bare).collect();
        stock.settle(progress);
        progress.stage("playback", moves.len() as u64);
        for some in moves.chunks(AT_ONCE) {
            let own = some.iter().map(|one| CutMove { watch: false, ..one.clone() }).collect();
            let list = CutList::new(&bodies, own, &CutOptions::default(), step)?;
            let taken = cut_noted(stock, &list, progress)?;
            self.note(stock, &list, &taken)?;
            self.next += some.len();
            progress.advance(some.len() as u64);
        }
        Ok(())
    }

    /// Takes something out of the stock by hand, before the next move.
    ///
    /// # Errors
    /// Those of the change.
    pub fn take_out(
        &mut self,
        stock: &mut TriDexel,
        change: impl FnOnce(&mut TriDexel) -> Result<()>,
    ) -> Result<()> {
        stock.settle(&crate::base::Silent);
        let taken = noted(stock, |stock| {
            change(stock)?;
            stock.settle(&crate::base::Silent);
            Ok(())
        })?;
        let tick = self.clock.tick(self.next, 0.0);
        let when = |_: &TakenStretch| When { first: tick, last: tick, way: None, is_upright: true };
        self.note_all(stock, &taken, &when);
        Ok(())
    }

    /// The surface of a stock that nothing was taken from but here, in at most so many faces: where they are more, in longer ticks.
    pub fn surface(self, stock: &TriDexel, most: usize) -> PlayedSurface {
        surface::surface(self, stock, most)
    }

    /// Notes what moves have taken.
    fn note(&mut self, stock: &TriDexel, list: &CutList, taken: &Noted) -> Result<()> {
        let (clock, next, count) = (self.clock.clone(), self.next, list.moves.len());
        let range = |i: usize| [clock.tick(next + i, 0.0), clock.tick(next + i, 1.0)];
        let mut asks = vec![false; count];
        for stretch in taken.iter().flatten().flatten() {
            let i = move_of(stretch.cut);
            asks[i] = range(i)[0] < range(i)[1];
        }
        let ways = (0..count).into_par_iter();
        let ways: Vec<Option<ToolWay<'_>>> =
            ways.map(|i| asks[i].then(|| ToolWay::of_move(list, i)).transpose()).collect::<Result<_>>()?;
        let when = |stretch: &TakenStretch| {
            let i = move_of(stretch.cut);
            let [first, last] = range(i);
            let is_upright = list.moves[i].stance.axis().is_some_and(|axis| axis.vector().z != 0.0);
            When { first, last, way: ways[i].as_ref().map(|way| (way, next + i)), is_upright }
        };
        self.note_all(stock, taken, &when);
        Ok(())
    }

    /// Notes what was taken: first along Z, which gives each point its tick.
    fn note_all<'a>(
        &mut self,
        stock: &TriDexel,
        taken: &Noted,
        when: &(impl Fn(&TakenStretch) -> When<'a> + Sync),
    ) {
        let thin = fixed(THIN * self.lattice.step);
        for k in [2, 1, 0] {
            let grid = &stock.grids[k];
            let here = &*self;
            let of_tile = |(t, own): (usize, &Vec<TakenStretch>)| {
                let lines = TileLines::new(grid, &here.lattice, t);
                TileNotes::of(here, grid, t, &lines, own, when)
            };
            let all: Vec<TileNotes> = taken[k].par_iter().enumerate().map(of_tile).collect();
            for (tile, notes) in self.pieces[k].iter_mut().zip(all) {
                tile.add(notes.pieces, thin);
                for (node, tick) in notes.nodes {
                    self.nodes[node as usize] = tick;
                }
            }
        }
    }

    /// Index of a point of the lattice.
    fn node(&self, at: [u32; 3]) -> usize {
        let [_, y, z] = self.lattice.counts.map(|n| n as usize);
        (at[0] as usize * y + at[1] as usize) * z + at[2] as usize
    }
}

/// The ticks in which a move takes material, and its way with its number where they are several.
struct When<'a> {
    first: u16,
    last: u16,
    way: Option<(&'a ToolWay<'a>, usize)>,
    /// The tool stands along Z.
    is_upright: bool,
}

/// Pieces of the lines of a tile and points on them that were taken, with their ticks.
#[derive(Default)]
struct TileNotes {
    pieces: Vec<Piece>,
    nodes: Vec<(u32, u16)>,
}

impl TileNotes {
    fn of<'a>(
        playback: &Playback,
        grid: &Grid,
        tile: usize,
        lines: &TileLines,
        taken: &[TakenStretch],
        when: &impl Fn(&TakenStretch) -> When<'a>,
    ) -> TileNotes {
        let mut notes = TileNotes::default();
        let (first, _) = grid.tile_lines(tile);
        for own in taken.chunk_by(|a, b| a.cut == b.cut) {
            let when = when(&own[0]);
            let near = when.way.map_or(Vec::new(), |(way, _)| way.near(bounds_of(grid, lines, own)));
            for stretch in own {
                let [low, _] = stretch.points(grid.axis, lines);
                let [row, column] = stretch.place().map(|n| n as u32);
                let line = StretchTicks {
                    playback,
                    grid,
                    line: [first[0] + column, first[1] + row],
                    when: &when,
                    near: &near,
                    low,
                };
                line.note(stretch, &mut notes);
            }
        }
        notes
    }
}

/// The ticks of a stretch of a line.
struct StretchTicks<'a> {
    playback: &'a Playback,
    grid: &'a Grid,
    /// Indices of the line along the two other axes.
    line: [u32; 2],
    when: &'a When<'a>,
    /// Stretches of the way that may reach it.
    near: &'a [WaySpan],
    /// Its lower end.
    low: glam::DVec3,
}

impl StretchTicks<'_> {
    fn note(&self, stretch: &TakenStretch, notes: &mut TileNotes) {
        let (lattice, axis) = (&self.playback.lattice, self.grid.axis);
        let at = |k: u32| fixed(lattice.coordinate(axis, k));
        let count = lattice.counts[axis.index()];
        // Points of the lattice on the stretch.
        let about = (unfixed(stretch.ends[0]) - lattice.origin[axis.index()]) / lattice.step;
        let mut k = (about.max(0.0) as u32).saturating_sub(1);
        while k < count && at(k) < stretch.ends[0] {
            k += 1;
        }
        let mut piece = Piece { ends: stretch.ends, line: stretch.line, tick: 0 };
        // A tool that stands along the line mostly comes to all of the stretch at once: where it does to both ends and to the middle, it is
        // not asked further. One that is widest between these may come there earlier, by the way of its radius at most.
        let alike = (axis == Axis::Z && self.when.is_upright).then(|| {
            let [low, high] = [at(k).min(stretch.ends[1]), stretch.ends[1] - 1];
            let first = self.asked(low);
            let same = |place: i32| self.asked(place) == first;
            (same(high) && same(low + (high - low) / 2)).then_some(first)
        });
        while k < count && at(k) < stretch.ends[1] {
            let node = self.node(k);
            let tick = alike.flatten().unwrap_or_else(|| self.tick_of(node, at(k)));
            if axis.index() == 2 {
                notes.nodes.push((node as u32, tick));
            }
            if piece.tick != 0 && piece.tick != tick {
                let border = at(k) - (at(k) - at(k - 1)) / 2;
                notes.pieces.push(Piece { ends: [piece.ends[0], border], ..piece });
                piece.ends[0] = border;
            }
            piece.tick = tick;
            k += 1;
        }
        if piece.tick == 0 {
            piece.tick = self.asked(stretch.ends[0] + (stretch.ends[1] - stretch.ends[0]) / 2);
        }
        notes.pieces.push(piece);
    }

    fn node(&self, k: u32) -> usize {
        let (a, b) = self.grid.axis.others();
        let mut at = [0; 3];
        (at[self.grid.axis.index()], at[a.index()], at[b.index()]) = (k, self.line[0], self.line[1]);
        self.playback.node(at)
    }

    /// The tick of a point of the lattice: lines along Z ask when the tool comes there, the others know by them.
    fn tick_of(&self, node: usize, at: i32) -> u16 {
        match self.grid.axis.index() {
            2 => self.asked(at),
            _ => self.playback.nodes[node].clamp(self.when.first, self.when.last),
        }
    }

    /// The tick in which the tool comes to a place of the line.
    fn asked(&self, at: i32) -> u16 {
        let Some((way, number)) = self.when.way else { return self.when.first };
        let mut point = self.low;
        point[self.grid.axis.index()] = unfixed(at);
        let coming = way.coming(self.near.iter().filter(|span| span.may_hold(point)), point, SHORT);
        coming.map_or(self.when.first, |coming| self.playback.clock.tick(number, coming.at))
    }
}

impl CutList {
    /// Length of the way of a move [mm]; 0 for one that removes nothing. Of a tool that turns it is that of its point that goes farthest,
    /// about.
    ///
    /// # Errors
    /// `KC1203` for a move that is not finite.
    pub fn way(&self, index: usize) -> Result<f64> {
        let one = &self.moves[index];
        Ok(match one.stance.axis() {
            _ if !one.removes => 0.0,
            Some(_) => one.curve.length(),
            None => ToolWay::of_move(self, index)?.length(),
        })
    }
}
