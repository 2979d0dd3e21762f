//! Moves made ready for cutting: checked, with their tools.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use glam::DVec3;

use super::body::{RevolvedParts, bounds};
use super::run::check;
use super::task::Tool;
use super::{CutAxis, CutMove, CutOptions, Spared, Stance, ToolBody};
use crate::base::Result;
use crate::geom::{Aabb, CurveKind};
use crate::stock::CutId;

/// Moves and the tools that make them, for stocks with one step. A stock keeps those that have not cut all of its lines yet.
#[derive(Debug)]
pub struct CutList {
    pub(super) moves: Vec<CutMove>,
    pub(super) tools: Vec<Tool>,
    pub(super) options: CutOptions,
    /// Distance of the lines that the tools are ready for [mm].
    pub(super) step: f64,
    /// Boxes of the paths of [`BLOCK`] moves each, grown by their tools' radii, and of as many of these.
    blocks: OnceLock<[Vec<Aabb>; 2]>,
}

/// Moves that share a box, and boxes that share one.
const BLOCK: usize = 64;

/// The boxes of [`BLOCK`] boxes each.
fn unions(boxes: &[Aabb]) -> Vec<Aabb> {
    boxes.chunks(BLOCK).map(|some| some.iter().copied().fold(Aabb::EMPTY, Aabb::union)).collect()
}

impl CutList {
    /// Moves of tools in the order in which they are made; `step`: distance of the lines of the stock that they will cut [mm].
    ///
    /// # Errors
    /// `KC0801` for a move whose path is not finite or too far out, or that names no tool, and for options out of range.
    pub fn new(
        bodies: &[ToolBody],
        moves: Vec<CutMove>,
        options: &CutOptions,
        step: f64,
    ) -> Result<Arc<CutList>> {
        CutList::sparing(bodies, &[], moves, options, step)
    }

    /// The same of tools that leave something along the faces of what they take: what is spared of each, in the order of the bodies; of those
    /// behind the end of the list nothing is.
    ///
    /// # Errors
    /// As those of [`CutList::new`].
    pub fn sparing(
        bodies: &[ToolBody],
        spared: &[Spared],
        moves: Vec<CutMove>,
        options: &CutOptions,
        step: f64,
    ) -> Result<Arc<CutList>> {
        check(bodies, &moves, options)?;
        let of = |i: usize| spared.get(i).copied().unwrap_or(Spared::NOTHING);
        let tools = bodies.iter().enumerate().map(|(i, b)| Tool::new(b, of(i), options, step)).collect();
        Ok(Arc::new(CutList { moves, tools, options: *options, step, blocks: OnceLock::new() }))
    }

    /// The moves.
    pub fn moves(&self) -> &[CutMove] {
        &self.moves
    }

    /// A box that holds all that the cutting part, the shank and the holder of a move's tool sweep [mm].
    pub fn swept(&self, index: usize) -> Aabb {
        let tool = &self.tools[self.moves[index].body as usize];
        self.swept_by(index, [0.0, 1.0], &[&tool.cutting, &tool.shank, &tool.holder])
    }

    /// Boxes that together hold all that a move removes: one where it does not reach out of a box, else some along its path.
    pub(super) fn taken(&self, index: usize, inside: Aabb) -> impl Iterator<Item = Aabb> + '_ {
        /// Most boxes along a path.
        const MOST: f64 = 32.0;
        let body = &self.tools[self.moves[index].body as usize].cutting;
        let all = self.swept_by(index, [0.0, 1.0], &[body]);
        let is_inside = |k: usize| inside.min[k] < all.min[k] && all.max[k] < inside.max[k];
        let whole = is_inside(0) && is_inside(1);
        let parts = (self.moves[index].curve.length() / (0.5 * body.radius)).ceil().clamp(1.0, MOST);
        let parts = if whole { 1 } else { parts as u32 };
        let at = move |i: u32| f64::from(i) / f64::from(parts);
        (0..parts).map(move |i| self.swept_by(index, [at(i), at(i + 1)], &[body]))
    }

    /// A box that holds all that bodies sweep between two fractions of a move.
    fn swept_by(&self, index: usize, [from, to]: [f64; 2], bodies: &[&RevolvedParts]) -> Aabb {
        let one = &self.moves[index];
        let margin = self.options.path_tolerance + self.options.clearance;
        let Stance::Leaning(motion) = &one.stance else {
            let axis = one.stance.axis().map_or(DVec3::Z, CutAxis::vector);
            let path = match one.curve.kind() {
                CurveKind::Line(line) => Aabb::of_points([from, to].map(|t| line.start.lerp(line.end, t))),
                _ => one.curve.bounds(),
            };
            return bounds(path.min, axis, bodies).union(bounds(path.max, axis, bodies)).grown(margin);
        };
        // No point of the tool leaves the straight line between its places at both ends by more than the error of that chord.
        let reach = |body: &&RevolvedParts| body.radius.hypot(body.top.max(-body.bottom));
        let reach = bodies.iter().map(reach).fold(0.0, f64::max);
        let [first, last] = [from, to].map(|t| {
            let pose = motion.pose(t);
            bounds(pose.translation, pose.rotation.z_axis, bodies)
        });
        first.union(last).grown(motion.chord_error(from, to, reach) + margin)
    }

    /// The moves of a range whose paths, grown by their tools' radii, meet some box for which `meets` holds: it has to hold for any box
    /// around it, too.
    pub(super) fn near<'a>(
        &'a self,
        range: Range<usize>,
        meets: impl Fn(Aabb) -> bool + Copy + 'a,
    ) -> impl DoubleEndedIterator<Item = usize> + 'a {
        let around = |i: usize| {
            let one = &self.moves[i];
            one.curve.bounds().grown(self.tools[one.body as usize].radius)
        };
        let [blocks, piles] = self.blocks.get_or_init(|| {
            let moves: Vec<Aabb> = (0..self.moves.len()).map(around).collect();
            let blocks = unions(&moves);
            let piles = unions(&blocks);
            [blocks, piles]
        });
        // Those of a block that lie within a range, counted in what the block holds.
        let within =
            |n: usize, range: &Range<usize>| range.start.max(n * BLOCK)..range.end.min((n + 1) * BLOCK);
        let of_moves = range.start / BLOCK..range.end.div_ceil(BLOCK);
        let of_blocks = of_moves.start / BLOCK..of_moves.end.div_ceil(BLOCK);
        of_blocks
            .filter(move |pile| meets(piles[*pile]))
            .flat_map(move |pile| within(pile, &of_moves))
            .filter(move |block| meets(blocks[*block]))
            .flat_map(move |block| within(block, &range))
            .filter(move |i| meets(around(*i)))
    }

    /// The number that the cut of a move carries.
    pub(super) fn cut(&self, index: usize) -> CutId {
        self.options.first_cut.wrapping_add(index as u32).wrapping_add(1)
    }

    /// The stretches of a range of moves that are made along one axis, or lean.
    pub(super) fn stretches(&self, range: Range<usize>) -> impl Iterator<Item = Range<usize>> + '_ {
        let mut end = range.start;
        let alike = self.moves[range].chunk_by(|a, b| a.stance.axis() == b.stance.axis());
        alike.map(move |stretch| {
            let start = end;
            end += stretch.len();
            start..end
        })
    }
}
