//! Reach of the direction of the tool: range of tilt, singular directions, a given direction, cover of the sphere.

use std::f64::consts::PI;

use glam::DVec3;

use super::Kinematics;
use super::inverse::{self, angle, tilt_range};
use super::limits::Travels;
use crate::base::Result;

/// Reach of a direction of the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionReach {
    /// Angle of the direction outside of the range of tilt, whatever the travel [rad]; zero inside.
    pub outside: f64,
    /// The joint that lacks travel, and how much [rad], for the solution that lacks least; `None` when one fits.
    pub lacking: Option<(usize, f64)>,
}

impl DirectionReach {
    /// True if the direction is reached.
    pub fn reached(&self) -> bool {
        self.outside == 0.0 && self.lacking.is_none()
    }
}

/// Shares of directions that are reached, on directions spread evenly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientationCover {
    /// Share of all directions.
    pub sphere: f64,
    /// Share of those on the side of the tool at home.
    pub half_sphere: f64,
    /// Number of directions.
    pub count: usize,
}

impl Kinematics {
    /// Least and greatest angle between the tool and the first of the last two free rotary axes [rad], whatever their
    /// travel; with one rotary axis both are the same; none without.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use glam::DVec3;
    /// use kinecut::machine::{CoordinateCode, Machine};
    /// let mut machine =
    ///     Machine::new(CoordinateCode::parse("012367").unwrap(), [None; 3], Default::default()).unwrap();
    /// machine.joints[4].direction = DVec3::new(0.0, 0.5f64.sqrt(), 0.5f64.sqrt()); // a nutating head of 45 degrees
    /// let [least, most] = machine.kinematics(0.0).tilt_range(&[]).unwrap();
    /// assert!(least.abs() < 1e-15 && (most.to_degrees() - 90.0).abs() < 1e-13);
    /// ```
    pub fn tilt_range(&self, locked: &[bool]) -> Option<[f64; 2]> {
        let rotary = |i: &usize| self.screws[*i].rotary && !locked.get(*i).copied().unwrap_or(false);
        let mut last = (0..self.count).rev().filter(rotary).map(|i| self.screws[i].direction);
        let second = last.next()?;
        let tool = self.tool.rotation.z_axis;
        let zeta = angle(second, tool);
        Some(match last.next() {
            None => [zeta, zeta],
            Some(first) => tilt_range(angle(first, second), zeta),
        })
    }

    /// The directions of the tool, in workpiece coordinates, at which the first free rotary axis is not determined: those
    /// along it, where they can be reached. `given` holds the positions of the locked axes.
    ///
    /// # Errors
    /// `KC1113` for more than two free rotary axes.
    pub fn singular_directions(&self, given: &[f64], locked: &[bool]) -> Result<Vec<DVec3>> {
        let free = inverse::free_chain(self, given, locked)?;
        let [first, second] = *free.rotaries() else { return Ok(Vec::new()) };
        let [a1, a2] = [first, second].map(|k| free.screws()[k].direction);
        let [least, most] = tilt_range(angle(a1, a2), angle(a2, free.tool.rotation.z_axis));
        let ends = [(a1, least), (-a1, PI - most)];
        let reached = ends.into_iter().filter(|(_, beyond)| *beyond <= inverse::SLACK);
        Ok(reached.map(|(direction, _)| self.to_work.vector(direction)).collect())
    }

    /// Reach of a direction of the tool (any length, workpiece coordinates) inside the travel of the rotary axes. An
    /// axis that the direction leaves open may be anywhere in its travel.
    ///
    /// # Errors
    /// `KC1113` for more than two free rotary axes; `KC1114` for a direction without length.
    pub fn direction_reach(
        &self,
        axis: DVec3,
        travels: &Travels,
        given: &[f64],
        locked: &[bool],
    ) -> Result<DirectionReach> {
        let free = inverse::free_chain(self, given, locked)?;
        let wanted = inverse::checked(DVec3::ZERO, axis, given)?;
        let wanted = self.to_work.rotation.transpose() * wanted;
        // All directions are within half a turn: the nearest one that is reached is taken for those outside.
        let branches = inverse::branches(&free, wanted, given, PI)?;
        let outside = inverse::outside(&free, wanted);
        let lacking = (&branches).into_iter().map(|branch| {
            let lack = free.rotaries().iter().filter_map(|&k| {
                let (joint, angle) = (free.place[k], branch.angle_of(k));
                let lack = if branch.open() == Some(k) { 0.0 } else { shortest_lack(travels, joint, angle) };
                (lack > 0.0).then_some((joint, lack))
            });
            lack.max_by(|a, b| a.1.total_cmp(&b.1))
        });
        let least = |a: &Option<(usize, f64)>| a.map_or(0.0, |(_, by)| by);
        let lacking = lacking.min_by(|a, b| least(a).total_cmp(&least(b))).flatten();
        Ok(DirectionReach { outside, lacking })
    }

    /// The share of `count` directions, spread evenly over the sphere (Fibonacci), that are reached inside the travel of
    /// the rotary axes.
    ///
    /// # Errors
    /// As [`Kinematics::direction_reach`].
    pub fn orientation_cover(
        &self,
        travels: &Travels,
        given: &[f64],
        locked: &[bool],
        count: usize,
    ) -> Result<OrientationCover> {
        let home = self.forward(&[]).rotation.z_axis;
        let (mut reached, mut above, mut reached_above) = (0usize, 0usize, 0usize);
        for direction in sphere_directions(count) {
            let inside = self.direction_reach(direction, travels, given, locked)?.reached();
            let side = direction.dot(home) > 0.0;
            reached += usize::from(inside);
            above += usize::from(side);
            reached_above += usize::from(inside && side);
        }
        let share = |part: usize, whole: usize| if whole == 0 { 0.0 } else { part as f64 / whole as f64 };
        Ok(OrientationCover {
            sphere: share(reached, count),
            half_sphere: share(reached_above, above),
            count,
        })
    }
}

/// Directions that share the sphere evenly (Fibonacci lattice), from +Z to -Z.
pub fn sphere_directions(count: usize) -> impl Iterator<Item = DVec3> {
    let golden_turn = PI * (1.0 + 5f64.sqrt());
    (0..count).map(move |i| {
        let k = i as f64 + 0.5;
        let z = 1.0 - 2.0 * k / count as f64;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = (golden_turn * k).sin_cos();
        DVec3::new(radius * cos, radius * sin, z)
    })
}

/// Angle of the nearest whole turn of an angle outside of the travel of a joint [rad]; zero inside.
fn shortest_lack(travels: &Travels, joint: usize, angle: f64) -> f64 {
    if !travels.turns(joint, angle).is_empty() {
        return 0.0;
    }
    let Some([least, most]) = travels.0.get(joint).copied().flatten() else { return 0.0 };
    let turn = std::f64::consts::TAU;
    // No turn fits: the nearest ones below and above miss.
    let below = angle + ((least - angle) / turn).floor() * turn;
    let above = angle + ((most - angle) / turn).ceil() * turn;
    (least - below).min(above - most)
}
