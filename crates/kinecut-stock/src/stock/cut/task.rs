//! Work of a tile: pieces with their tools, and its lines.

use std::f64::consts::SQRT_2;

use glam::{DVec2, DVec3};

use super::axis::ToolFrame;
use super::body::RevolvedParts;
use super::effect::Looked;
use super::hollow::{Hollow, standing};
use super::piece::MovePiece;
use super::{CutOptions, Spared, ToolBody};
use crate::stock::tile::TILE_EDGE;
use crate::stock::tri_dexel::{Grid, LINE_OFFSET};
use crate::stock::{CutId, EndPoint, Lattice, PackedNormal, fixed};

/// A tool made ready.
#[derive(Clone, Debug)]
pub(super) struct Tool {
    pub(super) cutting: RevolvedParts,
    /// The edge, when it leaves something within the cutting part.
    pub(super) hollow: Option<Hollow>,
    /// The cutting part made smaller by the clearance.
    pub(super) contact: RevolvedParts,
    /// Shank and holder made smaller by the clearance.
    pub(super) shank: RevolvedParts,
    pub(super) holder: RevolvedParts,
    /// Contact, shank and holder made wider, where edges of material may lie between the lines; see `edge.rs`.
    pub(super) edges: Option<[RevolvedParts; 3]>,
    /// The same bodies made larger on all faces, for a tool that leans; and by how much [mm].
    pub(super) grown: Option<([RevolvedParts; 3], f64)>,
    /// Largest radius of all.
    pub(super) radius: f64,
}

impl Tool {
    pub(super) fn new(body: &ToolBody, spared: Spared, options: &CutOptions, step: f64) -> Tool {
        let stack = |list: &[(crate::geom::Profile, f64)]| {
            RevolvedParts::new(list.iter().map(|(profile, z)| (profile, *z))).shrunk(options.clearance)
        };
        let mut cutting = RevolvedParts::new([(&body.cutting, 0.0)]).sparing(spared);
        let (shank, holder) = (stack(&body.shank), stack(&body.holder));
        let contact = cutting.shrunk(options.clearance);
        let mut hollow = body.edge.as_ref().and_then(|edge| Hollow::new(edge, body.cutting.top()));
        if let Some(edge) = hollow.filter(|_| spared != Spared::NOTHING) {
            // Only above its highest place it takes its whole width: no more than that is sure.
            cutting =
                RevolvedParts::new(edge.above_all().iter().map(|(profile, z)| (profile, *z))).sparing(spared);
            hollow = None;
        }
        let all = [&cutting, &shank, &holder];
        Tool {
            radius: all.iter().map(|b| b.radius).fold(0.0, f64::max),
            grown: beside(step).map(|by| ([&contact, &shank, &holder].map(|b| b.shrunk(-by)), by)),
            edges: beside(step).map(|by| [&contact, &shank, &holder].map(|b| b.widened(by))),
            cutting,
            hollow,
            contact,
            shank,
            holder,
        }
    }
}

impl Tool {
    /// The body that is looked at for contacts, made smaller by the clearance.
    pub(super) fn looked_at(&self, looked: Looked) -> &RevolvedParts {
        match looked {
            Looked::Cutting => &self.contact,
            Looked::Shank => &self.shank,
            Looked::Holder => &self.holder,
        }
    }
}

/// A piece of a move with its tool.
#[derive(Clone, Copy, Debug)]
pub(super) struct Task<'a> {
    pub(super) piece: MovePiece,
    /// Index of the move.
    pub(super) index: u32,
    pub(super) cut: CutId,
    pub(super) removes: bool,
    /// The lines across the tool axis are looked at for what the cutting part meets.
    pub(super) watch: bool,
    /// Cutting part and shank are known to meet nothing; see `followed.rs`.
    pub(super) free: bool,
    pub(super) frame: ToolFrame,
    pub(super) tool: &'a Tool,
    /// See [`CutOptions::clearance`].
    pub(super) clearance: f64,
    /// Distance of the lines [mm].
    pub(super) step: f64,
    /// Box of the path across the tool axis.
    pub(super) plan_box: (DVec2, DVec2),
}

impl Task<'_> {
    /// Heights of the tip: least and greatest.
    pub(super) fn tip_range(&self) -> (f64, f64) {
        let [a, b] = self.piece.w;
        (a.min(b), a.max(b))
    }

    /// The hollow edge that the task cuts with and its place across the axis [mm]; `None` when it cuts with the filled
    /// body.
    pub(super) fn hollow(&self) -> Option<(&Hollow, DVec2)> {
        self.tool.hollow.as_ref().zip(standing(&self.piece.plan))
    }

    /// An end point of a normal given in the tool frame.
    pub(super) fn end(&self, at: i32, normal: DVec3, class: u8) -> EndPoint {
        EndPoint { at, normal: PackedNormal::new(self.frame.stock(normal), class), cut: self.cut }
    }

    /// Heights of the tool frame as end coordinates along the stock's axis, in order.
    pub(super) fn along(&self, lo: f64, hi: f64) -> (i32, i32) {
        if self.frame.sign > 0.0 { (fixed(lo), fixed(hi)) } else { (fixed(-hi), fixed(-lo)) }
    }
}

/// Places of the lines of a tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct TileLines {
    /// Number of lines along both directions.
    pub(super) size: [usize; 2],
    /// Their coordinates along the two other axes.
    pub(super) at: [[f64; TILE_EDGE as usize]; 2],
}

impl TileLines {
    pub(super) fn new(grid: &Grid, lattice: &Lattice, tile: usize) -> TileLines {
        let (first, size) = grid.tile_lines(tile);
        let (a, b) = grid.axis.others();
        let mut at = [[0.0; TILE_EDGE as usize]; 2];
        for (k, axis) in [a, b].into_iter().enumerate() {
            for (i, x) in at[k].iter_mut().enumerate() {
                *x = lattice.coordinate(axis, first[k] + i as u32) + LINE_OFFSET;
            }
        }
        TileLines { size: size.map(|n| n as usize), at }
    }
}

/// An overlap up to this width may be missed without a word [mm].
pub(super) const LEAST: f64 = 0.05;

/// Largest distance of the nearest line in the material from its edge: the diagonal of four lines, at a corner [mm];
/// `None` when it is too small to be worth a look.
pub(super) fn beside(step: f64) -> Option<f64> {
    (SQRT_2 * step > LEAST).then_some(SQRT_2 * step)
}

/// Fraction of the move at which the cutting part, less the clearance, reaches a point of the tool frame.
pub(super) fn reached(task: &Task, point: DVec3) -> f64 {
    /// A point at the very border of what is swept must not be lost to rounding [mm].
    const BORDER: f64 = 1e-4;
    let body = &task.tool.contact;
    let [from, to] = task.piece.fractions;
    let windows = task.piece.plan.windows(point.truncate(), body.radius + BORDER);
    let in_plan = windows.iter().next().map_or(0.0, |w| w.0);
    // A falling tool must also have come down to the material.
    let rise = task.piece.rise();
    let down = if rise < 0.0 { (point.z - body.bottom - task.piece.w[0]) / rise } else { 0.0 };
    from + (to - from) * in_plan.max(down.clamp(0.0, 1.0))
}
