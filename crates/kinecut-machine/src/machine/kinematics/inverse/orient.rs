//! Rotary positions that bring the tool into a direction.
//!
//! Two axes: `exp(a1 t1) exp(a2 t2) x = y` with the tool axis `x` at home and the wanted direction `y`. With `eta` the
//! angle between the axes, `zeta` from `a2` to `x` and `tau` from `a1` to `y`,
//!
//! `sin^2(psi / 2) = sin((tau + eta - zeta) / 2) sin((tau - eta + zeta) / 2) / (sin eta sin zeta)`,
//! `cos^2(psi / 2) = sin((eta + zeta - tau) / 2) sin((eta + zeta + tau) / 2) / (sin eta sin zeta)`,
//!
//! and `t2` turns `x` about `a2` into the half-plane of `a1`, plus and minus `psi`. Nothing cancels near the pole, where
//! the quadratic of the textbooks (Paden and Kahan) loses half of the digits.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::super::Screw;
use super::free::Free;
use super::pair::{Pair, across, angle, turn_from_to, within_turn};
use crate::base::{Code, Error, Finding, Result};
use crate::num::angle::wrap;

/// A direction this far outside of the range still counts as reached [rad]: rounding of directions given with 12 digits.
pub(in super::super) const SLACK: f64 = 1e-10;
/// Sine of the tilt below which the tool is parallel to the first axis: its azimuth would be made of rounding.
const SINGULAR: f64 = 1e-10;
/// Two branches this near to each other [rad] are one.
const SAME: f64 = 1e-12;

/// Positions of the free rotary axes.
#[derive(Clone, Copy)]
pub(in super::super) struct Branch {
    /// Places among the free axes.
    places: [usize; 2],
    angles: [f64; 2],
    turns: [DMat3; 2],
    pub(in super::super) singular: bool,
    /// Index of the one of the two that is not determined, 0 or 1; of no meaning unless `singular`.
    open: usize,
}

impl Branch {
    /// Position of the free axis `k` [rad]; zero for a translation.
    pub(in super::super) fn angle_of(&self, k: usize) -> f64 {
        self.places.iter().position(|&place| place == k).map_or(0.0, |i| self.angles[i])
    }

    /// Rotations of the first and the second rotary axis; the identity for an axis that is not there.
    pub(in super::super) fn turns(&self) -> &[DMat3; 2] {
        &self.turns
    }

    /// Place among the free axes of the rotation that the direction leaves open.
    pub(in super::super) fn open(&self) -> Option<usize> {
        self.singular.then_some(self.places[self.open])
    }

    /// A chain with one rotary axis, at `angle`.
    pub(in super::super) fn single(place: usize, screw: &Screw, angle: f64, singular: bool) -> Branch {
        Branch {
            places: [place, usize::MAX],
            angles: [angle, 0.0],
            turns: [screw.turn(angle), DMat3::IDENTITY],
            singular,
            open: 0,
        }
    }
}

/// One or two branches.
pub(in super::super) struct Branches {
    list: [Branch; 2],
    len: usize,
}

impl Branches {
    fn one(branch: Branch) -> Branches {
        Branches { list: [branch; 2], len: 1 }
    }
}

impl<'a> IntoIterator for &'a Branches {
    type Item = &'a Branch;
    type IntoIter = std::slice::Iter<'a, Branch>;

    fn into_iter(self) -> Self::IntoIter {
        self.list[..self.len].iter()
    }
}

/// All branches for the direction `wanted` (unit, machine frame).
#[inline]
pub(in super::super) fn branches(
    free: &Free,
    wanted: DVec3,
    given: &[f64],
    allowance: f64,
) -> Result<Branches> {
    let x = free.tool.rotation.z_axis;
    let screws = free.screws();
    let slack = SLACK + allowance.max(0.0);
    match *free.rotaries() {
        [] => {
            within(angle(x, wanted), [0.0, 0.0], slack)?;
            let none = Branch {
                places: [usize::MAX; 2],
                angles: [0.0; 2],
                turns: [DMat3::IDENTITY; 2],
                singular: false,
                open: 0,
            };
            Ok(Branches::one(none))
        }
        [i] => {
            let (t, singular) = one(&screws[i], x, wanted, free.given(i, given), slack)?;
            Ok(Branches::one(Branch::single(i, &screws[i], t, singular)))
        }
        [i, j, ..] => {
            let given = [free.given(i, given), free.given(j, given)];
            let screws = [&screws[i], &screws[j]];
            match free.pair {
                Some(pair) => two([i, j], screws, pair, x, wanted, given, slack),
                None => {
                    let pair = Pair::new(screws[0], screws[1], x);
                    two([i, j], screws, &pair, x, wanted, given, slack)
                }
            }
        }
    }
}

/// Angle of a direction outside of what the free rotary axes reach, whatever their travel [rad]; zero inside.
pub(in super::super) fn outside(free: &Free, wanted: DVec3) -> f64 {
    let x = free.tool.rotation.z_axis;
    let screws = free.screws();
    let (tilt, range) = match *free.rotaries() {
        [] => (angle(x, wanted), [0.0, 0.0]),
        [i] => {
            let tilt = angle(screws[i].direction, x);
            (angle(screws[i].direction, wanted), [tilt, tilt])
        }
        [i, j, ..] => {
            let [a1, a2] = [i, j].map(|k| screws[k].direction);
            (angle(a1, wanted), tilt_range(angle(a1, a2), angle(a2, x)))
        }
    };
    let beyond = beyond(tilt, range);
    if beyond <= SLACK { 0.0 } else { beyond }
}

/// The rotation that takes `x` to `y`, and whether any does.
fn one(screw: &Screw, x: DVec3, y: DVec3, given: f64, slack: f64) -> Result<(f64, bool)> {
    let a = screw.direction;
    let tilt = angle(a, x);
    within(angle(a, y), [tilt, tilt], slack)?;
    let (x, y) = (across(a, x), across(a, y));
    if x.length() < SINGULAR || y.length() < SINGULAR {
        return Ok((wrap(given), true));
    }
    Ok((turn_from_to(a, x, y), false))
}

#[inline]
fn two(
    places: [usize; 2],
    screws: [&Screw; 2],
    pair: &Pair,
    x: DVec3,
    y: DVec3,
    given: [f64; 2],
    slack: f64,
) -> Result<Branches> {
    let a1 = screws[0].direction;
    if pair.degenerate {
        // The second axis cannot change the tilt: it keeps its position.
        let t2 = wrap(given[1]);
        let turn = screws[1].turn(t2);
        let (t1, _) = one(screws[0], turn * x, y, given[0], slack)?;
        let turns = [screws[0].turn(t1), turn];
        return Ok(Branches::one(Branch { places, angles: [t1, t2], turns, singular: true, open: 1 }));
    }
    // Sine and cosine of half of tau are half of the sides of the rhombus of two unit vectors.
    let (sin, cos) = (0.5 * (y - a1).length(), 0.5 * (y + a1).length());
    // sin(u + v) sin(u - v) = sin^2 u - sin^2 v = cos^2 v - cos^2 u: the smaller ones keep their digits.
    let by_sines = |of: [f64; 2]| (sin - of[0]) * (sin + of[0]);
    let by_cosines = |of: [f64; 2]| (of[1] - cos) * (of[1] + cos);
    let (sin_squared, cos_squared) = if sin < cos {
        (by_sines(pair.half_difference), -by_sines(pair.half_sum))
    } else {
        (by_cosines(pair.half_difference), -by_cosines(pair.half_sum))
    };
    if sin_squared < 0.0 || cos_squared < 0.0 {
        within(angle(a1, y), tilt_range(pair.eta, pair.zeta), slack)?;
    }
    if 2.0 * sin * cos < SINGULAR {
        let t2 = wrap(if sin_squared < cos_squared { pair.base } else { pair.base + PI });
        let t1 = wrap(given[0]);
        let turns = [screws[0].turn(t1), screws[1].turn(t2)];
        return Ok(Branches::one(Branch { places, angles: [t1, t2], turns, singular: true, open: 0 }));
    }
    let (sin_squared, cos_squared) = (above_zero(sin_squared), above_zero(cos_squared));
    let psi = 2.0 * sin_squared.sqrt().atan2(cos_squared.sqrt());
    let whole = sin_squared + cos_squared;
    let (sin_psi, cos_psi) =
        (2.0 * (sin_squared * cos_squared).sqrt() / whole, (cos_squared - sin_squared) / whole);
    let wanted = across(a1, y);
    let [base_sin, base_cos] = pair.base_sin_cos;
    let branch = |sense: f64| {
        let second = screws[1].turn_by(
            base_sin * cos_psi + sense * base_cos * sin_psi,
            base_cos * cos_psi - sense * base_sin * sin_psi,
        );
        let reached = second * x;
        let (sin, cos) = (a1.dot(reached.cross(wanted)), across(a1, reached).dot(wanted));
        let length = (sin * sin + cos * cos).sqrt();
        // Not both vanish, since neither direction of the tool is along the axis; if they do by rounding, no turn is
        // needed.
        let (sin, cos) = if length > 0.0 { (sin / length, cos / length) } else { (0.0, 1.0) };
        Branch {
            places,
            angles: [within_turn(sin.atan2(cos)), within_turn(pair.base + sense * psi)],
            turns: [screws[0].turn_by(sin, cos), second],
            singular: false,
            open: 0,
        }
    };
    if 2.0 * psi.min(PI - psi) < SAME {
        return Ok(Branches::one(branch(1.0)));
    }
    Ok(Branches { list: [branch(1.0), branch(-1.0)], len: 2 })
}

/// Angles from the first axis that the tool takes [rad], for the angle `eta` between the axes and `zeta` from the second
/// one to the tool.
pub(in super::super) fn tilt_range(eta: f64, zeta: f64) -> [f64; 2] {
    [(eta - zeta).abs(), PI - (PI - eta - zeta).abs()]
}

fn beyond(tilt: f64, [least, most]: [f64; 2]) -> f64 {
    if tilt < least { least - tilt } else { tilt - most }
}

fn within(tilt: f64, [least, most]: [f64; 2], slack: f64) -> Result<()> {
    let beyond = beyond(tilt, [least, most]);
    if beyond <= slack { Ok(()) } else { Err(unreachable(tilt, [least, most], beyond)) }
}

fn unreachable(tilt: f64, [least, most]: [f64; 2], beyond: f64) -> Error {
    let [tilt, least, most, beyond] = [tilt, least, most, beyond].map(f64::to_degrees);
    let range = if most - least > SLACK {
        format!("only {least:.6} to {most:.6}")
    } else {
        format!("only {least:.6}")
    };
    let message = format!(
        "the direction of the tool lies {beyond:.6} degrees outside of what the rotary axes reach: it is tilted by \
         {tilt:.6} degrees from the first of them (from the tool without any), which can be {range}"
    );
    Finding::error(Code::DIRECTION_UNREACHABLE, message)
        .value(tilt, "degrees")
        .bound(if tilt < least { least } else { most }, "degrees")
        .help("tilt the workpiece, or take a machine whose axes reach the direction")
        .into()
}

/// Zero for a negative number, which rounding and an allowance bring about.
fn above_zero(x: f64) -> f64 {
    if x > 0.0 { x } else { 0.0 }
}
