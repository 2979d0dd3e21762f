//! Which directions the tool's axis reaches within the ranges of the rotary axes.
//!
//! Counted on a Fibonacci sphere. Two rotary axes: the closed form of the half angle, both solutions; with more, the first
//! ones stand at steps of their range. Half spheres and tilts are about the spindle at home.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use super::Sizes;
use crate::machine::Word;

/// Directions that are tried.
const DIRECTIONS: usize = 2000;
/// Positions of each rotary axis before the last two.
const STEPS: u32 = 12;
/// How far outside of its range an angle may be: rounding [rad].
const ROUNDING: f64 = 1e-9;

/// Which directions the tool's axis reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Share of all directions.
    pub cover: f64,
    /// Share of the directions of the half sphere about the direction at home.
    pub upper_cover: f64,
    /// All directions within this angle of that at home are reached [rad]; to the spacing of the directions tried, about
    /// 2.5 degrees.
    pub tilt: f64,
}

/// Which directions a word reaches with the ranges given; nothing but the direction at home counts as no cover.
pub fn reach(word: &Word, sizes: &Sizes) -> Reach {
    let axes: Vec<Axis> = word
        .0
        .iter()
        .filter(|m| m.is_rotation())
        .map(|&m| Axis { direction: sizes.direction(m), limit: sizes.limit(m) })
        .collect();
    let x = sizes.spindle();
    let to_spindle = DQuat::from_rotation_arc(DVec3::Z, x);
    let (mut all, mut upper, mut least_missed) = (0, 0, PI);
    for i in 0..DIRECTIONS {
        let z = 1.0 - (2 * i + 1) as f64 / DIRECTIONS as f64;
        let turn = i as f64 * PI * (3.0 - 5.0f64.sqrt());
        let r = (1.0 - z * z).sqrt();
        let wanted = to_spindle * DVec3::new(r * turn.cos(), r * turn.sin(), z);
        if reached(&axes, x, wanted) {
            all += 1;
            upper += usize::from(z > 0.0);
        } else {
            least_missed = f64::min(least_missed, z.acos());
        }
    }
    Reach {
        cover: all as f64 / DIRECTIONS as f64,
        upper_cover: upper as f64 / (DIRECTIONS / 2) as f64,
        tilt: if least_missed < z_angle(1) { 0.0 } else { least_missed },
    }
}

/// Angle of a direction tried to Z [rad].
fn z_angle(i: usize) -> f64 {
    (1.0 - (2 * i + 1) as f64 / DIRECTIONS as f64).acos()
}

/// A rotary axis at home.
#[derive(Clone, Copy)]
struct Axis {
    direction: DVec3,
    limit: Option<[f64; 2]>,
}

impl Axis {
    /// Whether an angle, or one by whole turns more or less, is in the range.
    fn allows(&self, angle: f64) -> bool {
        self.limit.is_none_or(|[low, high]| {
            let turns = ((low - ROUNDING - angle) / TAU).ceil();
            angle + turns * TAU <= high + ROUNDING
        })
    }
}

fn reached(axes: &[Axis], x: DVec3, wanted: DVec3) -> bool {
    match axes {
        [] | [_] => false,
        [first, second] => two(first, second, x, wanted),
        [first, rest @ ..] => {
            let [low, high] = first.limit.unwrap_or([-PI, PI]);
            (0..=STEPS).any(|i| {
                let q = low + (high - low) * f64::from(i) / f64::from(STEPS);
                reached(rest, x, turned(wanted, first.direction, -q))
            })
        }
    }
}

/// `exp(a1 t1) exp(a2 t2) x = wanted`, in the form of the half angle.
fn two(first: &Axis, second: &Axis, x: DVec3, wanted: DVec3) -> bool {
    let (a1, a2) = (first.direction, second.direction);
    let (eta, zeta, tau) = (angle(a1, a2), angle(a2, x), angle(a1, wanted));
    let scale = eta.sin() * zeta.sin();
    // The two axes are one, or the last one is the spindle's: a curve at most.
    if scale.abs() < ROUNDING {
        return false;
    }
    let h = (0.5 * (tau + eta - zeta)).sin() * (0.5 * (tau - eta + zeta)).sin() / scale;
    if !(-ROUNDING..=1.0 + ROUNDING).contains(&h) {
        return false;
    }
    let psi = 2.0 * h.clamp(0.0, 1.0).sqrt().asin();
    let middle = around(a2, x, a1);
    [psi, -psi].into_iter().any(|p| {
        let t2 = middle + p;
        let t1 = around(a1, turned(x, a2, t2), wanted);
        second.allows(t2) && first.allows(t1)
    })
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// Angle that turns `from` about an axis into the half plane of `to`.
fn around(axis: DVec3, from: DVec3, to: DVec3) -> f64 {
    let [f, t] = [from, to].map(|v| v - axis * axis.dot(v));
    axis.dot(f.cross(t)).atan2(f.dot(t))
}

fn turned(v: DVec3, axis: DVec3, angle: f64) -> DVec3 {
    let (sin, cos) = angle.sin_cos();
    v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos))
}
