//! A planned bore or pocket that does not lie in the stock: around all of its wall there must be material.
//!
//! From places on the wanted wall rays run outwards, across the tool: a ray that meets no material of the raw stock looks out of
//! a side. A bore that was cast or drilled before has material around it all the same.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::Simulated;
use super::work::Work;
use crate::base::{Code, Finding};
use crate::geom::{Aabb, Solid};
use crate::operations::Operation;
use crate::operations::wanted::PlannedOutline;
use crate::stock::{Axis, DexelGrid, TriDexel};

/// Rays around the wall.
const RAYS: u32 = 72;
/// First place of a ray beyond the wall, and what it steps by: from 0.05 mm by a tenth more each time.
const FIRST: f64 = 0.05;
const GROWTH: f64 = 1.1;

pub(super) fn outline(simulated: &Simulated<'_>) -> Vec<Finding> {
    let mut raw: Option<Raw<'_>> = None;
    let mut found = Vec::new();
    for work in simulated.works {
        let Some(wall) = work.operation.and_then(Operation::outline) else { continue };
        let raw = raw.get_or_insert_with(|| Raw::new(&simulated.job.stock));
        if let Some(finding) = one(simulated, work, &wall, raw) {
            let first = work.feeds().next().or(work.done.first());
            found.extend(first.map(|d| simulated.at(work.setup, d.segment.item, finding)));
        }
    }
    found
}

fn one(simulated: &Simulated<'_>, work: &Work<'_>, wall: &PlannedOutline, raw: &Raw<'_>) -> Option<Finding> {
    let to_part = simulated.job.setups[work.setup].to_operation(work.operation?.milling()).inverse();
    let reach = raw.bounds.size().length() + wall.half_axes[0] + wall.half_axes[1];
    let held = |turn: f64| {
        let along = DVec2::new(wall.half_axes[0] * turn.cos(), wall.half_axes[1] * turn.sin());
        // The normal of the ellipse.
        let out = DVec2::new(along.x / wall.half_axes[0].powi(2), along.y / wall.half_axes[1].powi(2));
        let axes = DVec2::from_angle(wall.angle);
        let (start, out) = (wall.centre + axes.rotate(along), axes.rotate(out / out.length()));
        [0.15, 0.5, 0.85].into_iter().any(|share| {
            let z = wall.top - share * wall.depth;
            let mut distance = FIRST;
            while distance < reach {
                let p = start + out * distance;
                if raw.holds(to_part.point(DVec3::new(p.x, p.y, z))) {
                    return true;
                }
                distance *= GROWTH;
            }
            false
        })
    };
    let open = (0..RAYS).filter(|i| !held(TAU * f64::from(*i) / f64::from(RAYS))).count() as u32;
    let help = "correct its place or the stock; a pocket that is to be open is milled with a path of its own";
    let share = 100.0 * f64::from(open) / f64::from(RAYS);
    if 2 * open > RAYS {
        let message = format!("{} lies beside the stock", work.name);
        let finding = Finding::error(Code::BESIDE_STOCK, message).value(share.round(), "% of its wall");
        return Some(finding.help("correct its place or the stock"));
    }
    (open > 0).then(|| {
        let message = format!("{} breaks out of a side of the stock", work.name);
        Finding::doubt(Code::BESIDE_STOCK, message).value(share.round(), "% of its wall").help(help)
    })
}

/// The raw stock as a body that points are in or not.
struct Raw<'a> {
    solid: &'a Solid,
    bounds: Aabb,
    /// Of a mesh.
    lines: Option<TriDexel>,
}

impl Raw<'_> {
    fn new(solid: &Solid) -> Raw<'_> {
        /// Lines along the longest edge of a mesh's box.
        const LINES: f64 = 300.0;
        let bounds = solid.bounds();
        let lines = match solid {
            Solid::Mesh(mesh) => TriDexel::from_mesh(mesh, bounds.size().max_element() / LINES).ok(),
            _ => None,
        };
        Raw { solid, bounds, lines }
    }

    fn holds(&self, p: DVec3) -> bool {
        let inside = p.cmpge(self.bounds.min).all() && p.cmple(self.bounds.max).all();
        if !inside {
            return false;
        }
        match (self.solid, &self.lines) {
            (Solid::Cylinder { base, radius, .. }, _) => (p - *base).truncate().length() <= *radius,
            (Solid::Mesh(_), Some(lines)) => {
                let lattice = lines.lattice();
                let index = |axis: Axis| {
                    let i = (p[axis.index()] - lattice.origin[axis.index()]) / lattice.step;
                    i.round().clamp(0.0, f64::from(lattice.counts[axis.index()] - 1)) as u32
                };
                let at = crate::stock::fixed(p.z);
                let line = lines.line(Axis::Z, index(Axis::X), index(Axis::Y));
                line.iter().any(|i| i.lo.at <= at && at <= i.hi.at)
            }
            _ => true,
        }
    }
}
