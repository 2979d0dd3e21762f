//! What the operations of a job want cut: bores, pockets and the walls of drilled holes.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::super::PlannedHole;
use super::super::check::{Job, Operation};
use super::super::file::{BoreStrategy, RoughTable};
use super::super::outcome::SetupOutcome;
use super::super::simulate::is_along_axis;
use super::claim::EDGE;
use super::wall::Wall;
use crate::geom::{Aabb, Rigid};
use crate::tool::DrillPoint;

/// A wanted bore or pocket in the frame of its work offset.
pub(super) struct Wanted<'a> {
    pub(super) operation: &'a Operation,
    /// Number of the operation over all setups.
    pub(super) number: u32,
    /// Maps part coordinates to the work offset.
    pub(super) to_work: Rigid,
    /// Centre in the plane of the work offset.
    pub(super) centre: DVec2,
    pub(super) wall: Wall,
    /// Height of its rim.
    pub(super) top: f64,
    /// Height of the floor; `None` when it goes through.
    pub(super) floor: Option<f64>,
    /// Lowest height at which the wall is wanted.
    pub(super) bottom: f64,
    /// Radius of a core that is meant to fall out [mm]: what stands of it is not looked at.
    pub(super) slug: f64,
}

/// What the milling and drilling operations of a job want, hole by hole, in their order.
pub(super) fn wanted<'a>(job: &'a Job, setups: &[SetupOutcome]) -> Vec<Wanted<'a>> {
    let drillings: Vec<_> = setups.iter().flat_map(|s| &s.planned.drillings).collect();
    let mut list = Vec::new();
    let mut number = 0;
    for setup in &job.setups {
        for operation in &setup.operations {
            let to_work = setup.to_operation(operation);
            if !is_along_axis(to_work.inverse().vector(DVec3::Z)) {
                number += 1;
                continue;
            }
            if let Operation::Drill(_) = operation {
                let holes = drillings.iter().filter(|d| d.operation == number).flat_map(|d| &d.holes);
                list.extend(holes.filter_map(|hole| Wanted::drilled(operation, number, to_work, hole)));
            }
            let wanted = Wanted::of(operation, number, to_work);
            number += 1;
            // What the planner left out is not wanted either.
            let milling = operation.milling();
            let cutter = milling.tool.cutter.diameter(milling.tool.flute_length) / 2.0;
            list.extend(wanted.filter(|w| w.wall.radius(w.bottom) > cutter));
        }
    }
    list
}

impl Wanted<'_> {
    /// The wall of a milling operation.
    fn of(operation: &Operation, number: u32, to_work: Rigid) -> Option<Wanted<'_>> {
        let left = |finished: bool, rough: Option<&RoughTable>| {
            if finished { 0.0 } else { rough.map_or(0.0, |r| r.allowance) }
        };
        match operation {
            Operation::Bore(bore) => {
                let t = &bore.table;
                let finish = t.finish.as_ref();
                // A wear register moves the wall: positive values make the bore smaller.
                let wear = finish.filter(|f| f.wear_offset.is_some()).and_then(|f| f.wear_value);
                let leave = t.leave + left(finish.is_some(), t.rough.as_ref()) + wear.unwrap_or(0.0);
                let radii = [t.diameter, t.bottom_diameter.unwrap_or(t.diameter)].map(|d| d / 2.0 - leave);
                let bottom = t.top - t.depth;
                let through = t.breakthrough > 0.0;
                let allowance = t.rough.as_ref().map_or(0.0, |r| r.allowance);
                let cutter = bore.milling.tool.cutter.diameter(bore.milling.tool.flute_length);
                let outline = t.strategy == BoreStrategy::OutlineHelix;
                Some(Wanted {
                    operation,
                    number,
                    to_work,
                    centre: DVec2::from_array(t.at),
                    wall: Wall::Round { radii, heights: [t.top, bottom] },
                    top: t.top,
                    floor: (!through).then_some(bottom + t.leave_floor),
                    bottom: if through { bottom } else { bottom + t.leave_floor },
                    slug: if outline { t.diameter / 2.0 - t.leave - allowance - cutter } else { 0.0 },
                })
            }
            Operation::Ellipse(pocket) => {
                let t = &pocket.table;
                let bottom = t.top - t.depth;
                let leave = t.leave + left(t.finish.is_some(), Some(&t.rough));
                let through = t.breakthrough > 0.0;
                Some(Wanted {
                    operation,
                    number,
                    to_work,
                    centre: DVec2::from_array(t.at),
                    wall: Wall::Ellipse { half_axes: t.half_axes, turned: t.angle.to_radians(), leave },
                    top: t.top,
                    floor: (!through).then_some(bottom + t.leave_floor),
                    bottom: if through { bottom } else { bottom + t.leave_floor },
                    slug: 0.0,
                })
            }
            Operation::Drill(_) | Operation::Face(_) | Operation::Path(_) => None,
        }
    }

    /// The wall of a drilled hole, where it is whole all round; `None` for recesses, and where it nowhere is.
    fn drilled<'a>(
        operation: &'a Operation,
        number: u32,
        to_work: Rigid,
        hole: &PlannedHole,
    ) -> Option<Wanted<'a>> {
        use crate::drilling::Method;
        if matches!(hole.spec.method, Method::Centring | Method::Countersinking | Method::Counterboring) {
            return None;
        }
        let radius = hole.plan.edge.outer_radius();
        // The corner, where the edge meets the wall, stands this high above the tip.
        let corner = hole.plan.edge.segments().last()?.height(radius);
        let above = hole.zero + corner;
        let top = hole.plan.entry.last + above;
        // In a blind hole a nub may stand higher than the corner.
        let floor = hole.zero + hole.plan.edge.extent()[1];
        let bottom = hole.plan.exit.map_or(hole.plan.travel.end + floor, |e| e.first + above);
        // Where nothing cuts a core stays; a nose runs in a hole that was there, so what stands under it is left.
        let core = match hole.spec.point {
            DrillPoint::Cone { .. } => 0.0,
            point => point.edge(hole.spec.diameter).map_or(0.0, |e| e.inner_radius()),
        };
        (top > bottom + 2.0 * EDGE).then_some(Wanted {
            operation,
            number,
            to_work,
            centre: DVec2::from_array(hole.at),
            wall: Wall::Round { radii: [radius; 2], heights: [top, bottom] },
            top,
            floor: None,
            bottom,
            slug: core,
        })
    }

    /// Whether a point of the stock [part coordinates] lies in what the operation cuts, its tolerance included.
    pub(super) fn holds(&self, p: DVec3) -> bool {
        let q = self.to_work.point(p);
        let tolerance = self.operation.milling().tolerance;
        // A point of a drill ends below its full diameter.
        let lowest = self.floor.unwrap_or(self.bottom - self.wall.radius(self.top));
        q.z > lowest - tolerance && self.wall.inside(q.truncate() - self.centre, q.z) > -tolerance
    }

    /// Least distance of a point inside what the operation wants cut from its wall and floor [part coordinates, mm]; not
    /// positive outside.
    pub(super) fn inside(&self, p: DVec3) -> f64 {
        let q = self.to_work.point(p);
        let over = q.z - self.floor.unwrap_or(self.bottom);
        let wall = self.wall.inside(q.truncate() - self.centre, q.z);
        if wall < over { wall } else { over }
    }

    /// Points spread over the wanted wall [part coordinates].
    pub(super) fn samples(&self) -> impl Iterator<Item = DVec3> + '_ {
        const AROUND: u32 = 16;
        const HEIGHTS: u32 = 5;
        let to_part = self.to_work.inverse();
        (0..AROUND * HEIGHTS).map(move |i| {
            let angle = TAU * f64::from(i % AROUND) / f64::from(AROUND);
            let share = (f64::from(i / AROUND) + 0.5) / f64::from(HEIGHTS);
            let z = self.bottom + (self.top - self.bottom) * share;
            let at = self.centre + self.wall.point(angle, z);
            to_part.point(at.extend(z))
        })
    }

    /// The part of a box in which [`inside`](Self::inside) may be positive [part coordinates]: from the floor up.
    pub(super) fn cut_within(&self, all: Aabb) -> Aabb {
        let size = [self.top, self.bottom].map(|z| self.wall.radius(z)).into_iter().fold(0.0, f64::max);
        let to_part = self.to_work.inverse();
        let low = self.floor.unwrap_or(self.bottom);
        // As high as the box reaches, seen along the tool.
        let high = low + all.size().length() + all.min.distance(to_part.point(self.centre.extend(low)));
        let corners = (0..8).map(|i| {
            let sign = |bit: i32| if i & bit == 0 { -size } else { size };
            let z = if i & 4 == 0 { low } else { high };
            to_part.point((self.centre + DVec2::new(sign(1), sign(2))).extend(z))
        });
        let cut = Aabb::of_points(corners);
        Aabb { min: cut.min.max(all.min), max: cut.max.min(all.max) }
    }

    /// The region that can belong to the operation [part coordinates].
    pub(super) fn region(&self) -> Aabb {
        let size = 2.0 * self.wall.radius(self.top);
        let to_part = self.to_work.inverse();
        let corners = (0..8).map(|i| {
            let sign = |bit: i32| if i & bit == 0 { -size } else { size };
            let z = if i & 4 == 0 { self.bottom } else { self.top };
            let over = if i & 4 == 0 { -size } else { size };
            to_part.point((self.centre + DVec2::new(sign(1), sign(2))).extend(z + over))
        });
        Aabb::of_points(corners)
    }
}
