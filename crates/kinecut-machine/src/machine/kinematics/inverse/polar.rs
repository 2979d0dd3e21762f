//! Inverse kinematics of polar machines: two translations and one rotation bring the tip to a point, the direction of the
//! tool follows (turning centre with X, Z and C).
//!
//! The tip can be reached when it lies in the plane of the two translations: `n(t) . (p - s(t)) = 0`, with `n` the normal
//! of the plane and `s` the tip with the translations at zero. For any order of the three joints this is
//! `A cos t + B sin t = C`.

use glam::DVec3;

use super::super::{Kinematics, Screw};
use super::free::Free;
use super::orient::Branch;
use super::{Solution, Solutions, checked, missed, place};
use crate::base::{Code, Finding, Result};
use crate::num::angle::wrap;

/// Distance from the axis [mm] below which the rotation is free: rounding of coordinates of some metres.
const ON_AXIS: f64 = 1e-12;
/// Two angles this near to each other [rad] are one.
const SAME: f64 = 1e-12;
/// Distance beyond its circle [mm] at which a tip still counts as on it: rounding of coordinates of some metres.
const TOUCH: f64 = 1e-12;

impl Kinematics {
    /// All joint positions of a machine with two translations and one rotation for a tip [mm] in workpiece coordinates.
    /// On the axis the rotation keeps its position of `given`.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use glam::DVec3;
    /// use kinecut::machine::{Elementary, Joint, Kinematics};
    /// use kinecut::geom::Rigid;
    /// let joints = [Elementary::C, Elementary::Z, Elementary::X].map(Joint::standard);
    /// let lathe = Kinematics::new(&joints, Rigid::IDENTITY, Rigid::IDENTITY);
    /// let found = lathe.inverse_polar(DVec3::new(0.0, 20.0, 5.0), &[]).unwrap();
    /// assert_eq!(found.len(), 2); // X 20 C 90, and X -20 C -90
    /// assert!(found.iter().any(|s| (s.values[2] - 20.0).abs() < 1e-12));
    /// ```
    ///
    /// # Errors
    /// `KC1112` when no position of the rotation brings the plane of the translations to the tip; `KC1113` when the chain
    /// is not of two translations and one rotation; `KC1114` for a number that is not finite.
    pub fn inverse_polar(&self, tip: DVec3, given: &[f64]) -> Result<Solutions> {
        self.inverse_polar_locked(tip, given, &[])
    }

    /// As [`Kinematics::inverse_polar`], with the axes whose `locked` is true held at their position of `given`.
    ///
    /// # Errors
    /// As [`Kinematics::inverse_polar`].
    pub fn inverse_polar_locked(&self, tip: DVec3, given: &[f64], locked: &[bool]) -> Result<Solutions> {
        checked(tip, DVec3::Z, given)?;
        let free = Free::new(self, given, locked)?;
        let (&[k], 3) = (free.rotaries(), free.screws().len()) else {
            return Err(Finding::error(
                Code::NO_CLOSED_FORM,
                "a point alone determines the axes of a chain of two translations and one rotation",
            )
            .value(free.screws().len() as f64, "free axes")
            .bound(3.0, "free axes, one of them rotary")
            .help("hold the other axes at given positions")
            .into());
        };
        let tip = self.to_machine(tip);
        let screws = free.screws();
        let [constant, cos, sin] = plane_condition(screws, k, free.tool.translation, tip);
        let radius = cos.hypot(sin);
        let mut angles = [wrap(free.given(k, given)), 0.0];
        let mut count = 1;
        let singular = radius < ON_AXIS;
        if singular {
            if constant.abs() > TOUCH {
                return Err(missed(constant.abs()));
            }
        } else {
            let middle = sin.atan2(cos);
            if constant.abs() > radius + TOUCH {
                return Err(missed(constant.abs() - radius));
            }
            let ratio = -constant / radius;
            // Both sides of the circle; the half-angle keeps its digits where they meet.
            let spread = 2.0 * above_zero(1.0 - ratio).sqrt().atan2(above_zero(1.0 + ratio).sqrt());
            angles = [wrap(middle + spread), wrap(middle - spread)];
            count = if wrap(2.0 * spread).abs() < SAME { 1 } else { 2 };
        }
        let mut solutions = Solutions::none();
        let mut miss = f64::INFINITY;
        for &angle in &angles[..count] {
            let branch = Branch::single(k, &screws[k], angle, singular);
            match place::translations(&free, &branch, tip, given) {
                Ok(placed) => {
                    let mut values = free.start;
                    for (i, screw) in screws.iter().enumerate() {
                        values[free.place[i]] = if screw.rotary { angle } else { placed.values[i] };
                    }
                    solutions.push(Solution { values, singular: singular || placed.dependent });
                }
                Err(distance) => miss = miss.min(distance),
            }
        }
        if solutions.is_empty() { Err(missed(miss)) } else { Ok(solutions) }
    }
}

/// Constant, cosine and sine part of the distance of the tip from the plane of the translations [mm], by the place `k` of
/// the rotation.
fn plane_condition(screws: &[Screw], k: usize, home: DVec3, tip: DVec3) -> [f64; 3] {
    let (axis, centre) = (screws[k].direction, screws[k].point);
    let mut shifts = screws.iter().filter(|screw| !screw.rotary).map(|screw| screw.direction);
    let (d1, d2) = (shifts.next().unwrap_or(DVec3::ZERO), shifts.next().unwrap_or(DVec3::ZERO));
    let (w, v) = (tip - centre, home - centre);
    let normal = d1.cross(d2).normalize_or_zero();
    match k {
        // n . (R(-t) w - v)
        0 => {
            let [constant, cos, sin] = turned(axis, normal, w);
            [constant - normal.dot(v), cos, -sin]
        }
        // (d1 x R d2) . w - d1 . R (d2 x v)
        1 => {
            let [a0, a1, a2] = turned(axis, w.cross(d1), d2);
            let [b0, b1, b2] = turned(axis, d1, d2.cross(v));
            [a0 - b0, a1 - b1, a2 - b2]
        }
        // n . (w - R v)
        _ => {
            let [constant, cos, sin] = turned(axis, normal, v);
            [normal.dot(w) - constant, -cos, -sin]
        }
    }
}

/// Constant, cosine and sine part of `g . R(t) x` for the rotation about `axis`.
fn turned(axis: DVec3, g: DVec3, x: DVec3) -> [f64; 3] {
    let constant = g.dot(axis) * axis.dot(x);
    [constant, g.dot(x) - constant, g.dot(axis.cross(x))]
}

fn above_zero(x: f64) -> f64 {
    if x > 0.0 { x } else { 0.0 }
}
