//! The boundary of what a tool sweeps in a move: its envelope without what lies inside.
//!
//! The envelope is closed and winds once around a place for each time that the tool comes over it and leaves it again, so that lines
//! through it have material where it winds at all. Where two of its walls run along each other inside of what is swept, facets leave slivers around
//! which it does not wind: an end of a line beside a gap that lies deep in the tool at some moment ([`SweptDepth`]) is moved on, by its depth at a
//! time, until it does not, or the gap is gone. The surface is that of these lines.

use glam::DVec3;
use rayon::prelude::*;

use super::surface::{SurfaceOptions, surface};
use super::tile::TILE_EDGE;
use super::tri_dexel::{Grid, LINE_OFFSET};
use super::{Axis, DexelGrid, EndPoint, Interval, Lattice, PackedNormal, TriDexel, fixed, unfixed};
use crate::base::{Code, CountBound, Finding, Progress, Result};
use crate::geom::{Aabb, Mesh};
use crate::sweep::{ProfileChain, SweptDepth, ToolMotion};
use crate::tool::Contour;

/// Lines in the box of what is swept where no distance is wanted.
const LINES: f64 = 4e5;
/// Most lines.
const MOST_LINES: CountBound = CountBound {
    what: "lines through a swept volume",
    most: 2e7,
    bytes: 60,
    code: Code::SWEEP_TOO_FINE,
    help: "take a larger step",
};
/// The radius of a tool in the greatest tolerance that its round faces are given: facets within take less than a thousandth of a volume.
const PARTS: f64 = 400.0;
/// Parts of the tolerance: of the envelope that lines meet, of the depth that an end may have, of facets away from the ends.
const POSES: f64 = 0.1;
const DEEP: f64 = 0.25;
const FACETS: f64 = 0.4;
/// Most vertices that are looked at in the end.
const LOOKED_AT: usize = 20_000;
/// Most times that an end is moved on.
const MOST_MOVES: u32 = 200;

/// A trimmed envelope.
#[derive(Clone, Debug, PartialEq)]
pub struct TrimmedEnvelope {
    /// Closed, oriented outwards, and nowhere inside of what is swept [workpiece coordinates, mm].
    pub mesh: Mesh,
    /// Distance of the lines that it was made from: what is thinner may be missing [mm].
    pub step: f64,
    /// Volume on these lines [mm3].
    pub volume: f64,
    /// Vertices that were looked at against the moving tool: all, or as many as are looked at.
    pub looked_at: usize,
    /// Number of these that lie deeper in what is swept than the tolerance.
    pub deeper: usize,
    /// Greatest depth of these in what is swept [mm].
    pub deepest: f64,
}

/// The boundary of what a tool sweeps in a move, within a tolerance [mm], from lines at a distance of `step` [mm], by default that of about
/// 400 000 lines.
///
/// ```
/// # use kinecut_stock as kinecut;
/// use glam::DVec3;
/// use kinecut::base::Silent;
/// use kinecut::geom::Arc;
/// use kinecut::stock::trimmed_envelope;
/// use kinecut::sweep::{ProfileChain, ToolMotion};
/// use kinecut::tool::{Contour, ContourElement, DOWN, ElementRole, UP};
/// let ball = Contour::new(vec![ContourElement::arc([0.0, 5.0], 5.0, DOWN, UP, ElementRole::Cutting)]).unwrap();
/// // Twice around on a circle of 20 mm: a torus, once; the envelope has it twice.
/// let circle = Arc::new(DVec3::X * 20.0, DVec3::ZERO, DVec3::Z, 4.0 * std::f64::consts::PI, 0.0).unwrap();
/// let motion = ToolMotion::fixed(circle.into(), DVec3::Z).unwrap();
/// let trimmed = trimmed_envelope((&ball, &motion), 0.02, Some(0.25), &Silent).unwrap();
/// trimmed.mesh.check_closed().unwrap();
/// let exact = 2.0 * std::f64::consts::PI.powi(2) * 20.0 * 25.0;
/// assert!((trimmed.mesh.volume() / exact - 1.0).abs() < 0.001);
/// let all = ProfileChain::new(&ball).envelope(&motion, 0.02, &Silent).unwrap();
/// assert!((all.mesh.volume() / exact - 2.0).abs() < 0.1);
/// ```
///
/// # Errors
/// Those of [`ProfileChain::envelope`] at `tolerance`; at `step` `KC1205` for one that makes too many lines, or is not positive; `KC0009` when
/// cancelled.
pub fn trimmed_envelope(
    (contour, motion): (&Contour, &ToolMotion),
    tolerance: f64,
    step: Option<f64>,
    progress: &dyn Progress,
) -> Result<TrimmedEnvelope> {
    // Facets lie inside of round faces: the volume, too, shall hardly feel it.
    let fine = tolerance.min(contour.largest_radius() / PARTS);
    let envelope = ProfileChain::new(contour).envelope(motion, POSES * fine, progress);
    let envelope = envelope.map_err(|e| match e.code() {
        Code::SWEEP_TOLERANCE | Code::SWEEP_TOO_FINE => e.under("tolerance"),
        _ => e,
    })?;
    let step = step.unwrap_or_else(|| usual_step(envelope.mesh.bounds()));
    trim(&envelope.mesh, &SweptDepth::new(contour, motion), (tolerance, fine, step), progress)
}

/// Trims the mesh of an envelope with lines; `fine` [mm] is the tolerance of the faces.
fn trim(
    envelope: &Mesh,
    depth: &SweptDepth<'_>,
    (tolerance, fine, step): (f64, f64, f64),
    progress: &dyn Progress,
) -> Result<TrimmedEnvelope> {
    let bounds = envelope.bounds().grown(step);
    MOST_LINES.check(TriDexel::lines(bounds, step) as f64).map_err(|e| e.under("step"))?;
    let mut lines = TriDexel::of_mesh(envelope, bounds, step)?;
    let lattice = *lines.lattice();
    for grid in &mut lines.grids {
        close_gaps(grid, &lattice, (depth, DEEP * fine), progress);
    }
    if progress.cancelled() {
        return Err(Finding::error(Code::CANCELLED, "the trimming of a swept volume was cancelled").into());
    }
    let options = SurfaceOptions { tolerance: Some(FACETS * fine), memory: None };
    let mesh = surface(&lines, &options, progress)?;
    let every = mesh.vertices.len().div_ceil(LOOKED_AT).max(1);
    let some: Vec<DVec3> = mesh.vertices.iter().step_by(every).copied().collect();
    let depths: Vec<f64> = some.par_iter().map(|p| depth.of(*p).depth).collect();
    Ok(TrimmedEnvelope {
        mesh,
        step,
        volume: lines.volume(),
        looked_at: depths.len(),
        deeper: depths.iter().filter(|depth| **depth > tolerance).count(),
        deepest: depths.iter().copied().fold(0.0, f64::max),
    })
}

/// Moves the ends of a grid's gaps that lie deeper than allowed [mm].
fn close_gaps(
    grid: &mut Grid,
    lattice: &Lattice,
    (depth, allowed): (&SweptDepth<'_>, f64),
    progress: &dyn Progress,
) {
    let shape = grid.without_lines();
    let axis = grid.axis;
    let (a, b) = axis.others();
    grid.tiles.par_iter_mut().enumerate().for_each(|(t, tile)| {
        let (first, size) = shape.tile_lines(t);
        for (j, i) in (0..size[1]).flat_map(|j| (0..size[0]).map(move |i| (j, i))) {
            let line = (j * TILE_EDGE + i) as usize;
            if tile.line(line).len() < 2 || progress.cancelled() {
                continue;
            }
            let mut p = DVec3::ZERO;
            p[a.index()] = lattice.coordinate(a, first[0] + i) + LINE_OFFSET;
            p[b.index()] = lattice.coordinate(b, first[1] + j) + LINE_OFFSET;
            let closed = closed(tile.line(line), (p, axis), depth, allowed);
            tile.set(line, &closed);
        }
    });
}

/// A line whose gaps do not begin or end deeper than allowed.
fn closed(
    line: &[Interval],
    (p, axis): (DVec3, Axis),
    depth: &SweptDepth<'_>,
    allowed: f64,
) -> Vec<Interval> {
    let mut all: Vec<Interval> = vec![line[0]];
    for next in &line[1..] {
        let last = all.len() - 1;
        let (low, high) = (all[last].hi, next.lo);
        let low = moved(low, high.at, 1.0, (p, axis), depth, allowed);
        let high = moved(high, low.at, -1.0, (p, axis), depth, allowed);
        if low.at < high.at {
            all[last].hi = low;
            all.push(Interval { lo: high, hi: next.hi });
        } else {
            all[last].hi = next.hi;
        }
    }
    all
}

/// An end of a gap, moved on towards its other end while it lies deeper than allowed.
fn moved(
    mut end: EndPoint,
    until: i32,
    sense: f64,
    (mut p, axis): (DVec3, Axis),
    depth: &SweptDepth<'_>,
    allowed: f64,
) -> EndPoint {
    for _ in 0..MOST_MOVES {
        p[axis.index()] = unfixed(end.at);
        let here = depth.of(p);
        if here.depth <= allowed {
            break;
        }
        let at = fixed(p[axis.index()] + sense * here.depth);
        let over = if sense > 0.0 { at >= until } else { at <= until };
        if over {
            return EndPoint { at: until, ..end };
        }
        end = EndPoint { at, normal: PackedNormal::new(here.normal, 0), ..end };
    }
    end
}

/// The step at which a box has as many lines as are wanted by default, of two digits [mm].
fn usual_step(bounds: Aabb) -> f64 {
    let s = bounds.size();
    let step = ((s.x * s.y + s.y * s.z + s.z * s.x) / LINES).sqrt();
    let digit = 10f64.powf(step.log10().floor() - 1.0);
    (step / digit).ceil() * digit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::Silent;
    use crate::geom::Arc;
    use crate::tool::{ContourElement, ElementRole};

    #[test]
    fn slivers_between_walls_that_run_along_each_other_are_closed() {
        // A flat mill on an upright arc, its axis upright: walls run along each other inside of what is swept.
        let flat = Contour::new(vec![
            ContourElement::line([0.0, 0.0], [5.0, 0.0], ElementRole::Cutting),
            ContourElement::line([5.0, 0.0], [5.0, 30.0], ElementRole::Cutting),
            ContourElement::line([5.0, 30.0], [0.0, 30.0], ElementRole::Shank),
        ])
        .unwrap();
        let arc = Arc::new(DVec3::ZERO, DVec3::new(0.0, 0.0, 15.0), DVec3::Y, -1.6, 0.0).unwrap();
        let motion = ToolMotion::fixed(arc.into(), DVec3::Z).unwrap();
        // Coarse facets have slivers that the lines see.
        let coarse = ProfileChain::new(&flat).envelope(&motion, 0.025, &Silent).unwrap();
        let depth = SweptDepth::new(&flat, &motion);
        let trimmed = trim(&coarse.mesh, &depth, (0.05, 0.05, 0.1), &Silent).unwrap();
        assert!(trimmed.looked_at > 2000 && trimmed.deeper == 0, "{} {}", trimmed.deeper, trimmed.deepest);
        let bounds = coarse.mesh.bounds().grown(0.1);
        let gaps = |lines: &TriDexel| {
            let of = |axis: Axis| {
                let (a, b) = axis.others();
                let counts = lines.lattice().counts;
                let line = |i: u32, j: u32| lines.line(axis, i, j).len().saturating_sub(1);
                (0..counts[b.index()])
                    .map(|j| (0..counts[a.index()]).map(|i| line(i, j)).sum::<usize>())
                    .sum::<usize>()
            };
            Axis::ALL.map(of).iter().sum::<usize>()
        };
        let mut lines = TriDexel::of_mesh(&coarse.mesh, bounds, 0.1).unwrap();
        let before = gaps(&lines);
        let lattice = *lines.lattice();
        for grid in &mut lines.grids {
            close_gaps(grid, &lattice, (&depth, 0.0125), &Silent);
        }
        let after = gaps(&lines);
        assert!(before > 1000 && after < before / 2, "{before} {after}");
    }
}
