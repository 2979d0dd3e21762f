//! Walls that the operations of a job want, in part coordinates.

use std::f64::consts::TAU;
use std::ops::Deref;

use glam::{DVec2, DVec3};

use super::super::check::Job;
use super::super::setup_outcome::SetupOutcome;
use crate::geom::{Aabb, Rigid};
use crate::operations::Operation;
use crate::operations::wanted::WantedWall;

/// A wanted wall of an operation of the job.
pub(super) struct Wanted<'a> {
    pub(super) operation: &'a Operation,
    /// Number of the operation over all setups.
    pub(super) number: u32,
    /// Maps part coordinates to the work offset or plane of the operation.
    pub(super) to_work: Rigid,
    shape: WantedWall,
}

impl Deref for Wanted<'_> {
    type Target = WantedWall;

    fn deref(&self) -> &WantedWall {
        &self.shape
    }
}

/// The walls that the planned operations of a job want, in their order.
pub(super) fn wanted<'a>(job: &'a Job, setups: &[SetupOutcome]) -> Vec<Wanted<'a>> {
    let mut list = Vec::new();
    for (setup, done) in job.setups.iter().zip(setups) {
        for planned in &done.planned.operations {
            let Some(operation) = job.operation(planned.number) else { continue };
            let to_work = setup.to_operation(operation.milling());
            let number = planned.number;
            let walls = planned.plan.walls().into_iter();
            list.extend(walls.map(|shape| Wanted { operation, number, to_work, shape }));
        }
    }
    list
}

impl Wanted<'_> {
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
