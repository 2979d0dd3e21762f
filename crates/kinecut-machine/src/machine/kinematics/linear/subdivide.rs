//! Points on a straight move of the tool that keep the deviation below a tolerance.
//!
//! The number of equal parts follows from the bound (the deviation falls with the square of the length); each part is
//! checked inside and halved where it still deviates too much.

use super::super::Kinematics;
use super::super::inverse::Solution;
use super::{LinearDeviation, Straight, proportional};
use crate::base::{Code, Error, Finding, Result};
use crate::machine::{JointValues, MOST_JOINTS};
use crate::num::angle::wrap;

/// Motion of the tool's direction between the ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// On the great circle through both directions, at constant rate.
    GreatCircle,
    /// As it comes when the rotary axes move in proportion.
    Axes,
}

/// Tolerances and settings of the division of a straight move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearOptions {
    /// Greatest distance of the tip from the line [mm].
    pub tolerance: f64,
    /// Greatest angle of the tool to its direction on the great circle [rad]; of no effect for [`Orientation::Axes`].
    pub axis_tolerance: f64,
    /// True if the control keeps the tip on the line by itself (tool centre point control).
    pub tcp: bool,
    /// Motion of the direction.
    pub orientation: Orientation,
    /// Joints that do not turn between the ends on their own: they move in proportion.
    pub locked: [bool; MOST_JOINTS],
    /// Most parts.
    pub most_parts: usize,
}

impl LinearOptions {
    /// For a control that interpolates the axes: great circle, one tenth of a degree, at most a million parts.
    pub fn new(tolerance: f64) -> LinearOptions {
        LinearOptions {
            tolerance,
            axis_tolerance: 0.1f64.to_radians(),
            tcp: false,
            orientation: Orientation::GreatCircle,
            locked: [false; MOST_JOINTS],
            most_parts: 1_000_000,
        }
    }
}

/// A straight move of the tool as proportional moves of the axes.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearMove {
    /// Shares of the move at which its parts end; the last is 1.
    pub shares: Vec<f64>,
    /// Joint positions there [mm or rad].
    pub values: Vec<JointValues>,
    /// Greatest deviation found inside the parts.
    pub deviation: LinearDeviation,
}

/// Shares of a part at which it is checked: the deviation of a short part is a parabola with its top in the middle; at
/// a change of sign of the curvature the quarters have it.
const CHECKED: [f64; 3] = [0.25, 0.5, 0.75];
/// A part this short is not halved further: at a pole the rotary axes turn within no length.
const SHORTEST: f64 = 1e-7;

/// A point of the move.
#[derive(Clone, Copy)]
struct Point {
    share: f64,
    q: JointValues,
}

impl Kinematics {
    /// Divides the straight move of the tool between two sets of joint positions so that proportional moves of the axes
    /// keep to it.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::Machine;
    /// use kinecut::machine::kinematics::LinearOptions;
    /// let chain = Machine::preset("trt_xyzac").unwrap().kinematics(0.0);
    /// let (from, to) = ([0.2, -0.5, 10.0, 20.0, -30.0], [0.9, -0.1, 30.0, -10.0, -20.0]);
    /// let parts = chain.linear_move(&from, &to, &LinearOptions::new(0.005)).unwrap();
    /// assert!(parts.deviation.from_line <= 0.005);
    /// assert!((20..100).contains(&parts.values.len())); // 3.4 mm undivided
    /// ```
    ///
    /// # Errors
    /// Those of [`Kinematics::inverse`] between the ends; `KC1118` where the rotary axes turn within no length: the tool
    /// passes along the first rotary axis, or the ends are different solutions; `KC1119` for more than the most parts or a
    /// tolerance that is not positive; `KC1114` for positions that are not finite.
    pub fn linear_move(&self, from: &[f64], to: &[f64], options: &LinearOptions) -> Result<LinearMove> {
        check(from, to, options)?;
        let straight = Straight::between(self, from, to);
        let mut first = JointValues::zero(self.count);
        let mut last = first;
        for (slots, values) in [(&mut first, from), (&mut last, to)] {
            for (slot, value) in slots.iter_mut().zip(values) {
                *slot = *value;
            }
        }
        let bound = if options.tcp { 0.0 } else { self.linear_bound(&first, &last) };
        let parts = (bound / options.tolerance).sqrt().ceil();
        if parts > options.most_parts as f64 {
            return Err(too_many(options));
        }
        let parts = (parts as usize).max(1);
        let mut division = Division {
            chain: self,
            straight: &straight,
            ends: [first, last],
            options,
            found: LinearMove {
                shares: Vec::with_capacity(parts),
                values: Vec::with_capacity(parts),
                deviation: LinearDeviation::default(),
            },
        };
        let mut before = Point { share: 0.0, q: first };
        for part in 1..=parts {
            let share = part as f64 / parts as f64;
            let q = if part == parts { last } else { division.solve(share, &before.q)? };
            let here = Point { share, q };
            division.divide(before, here)?;
            before = here;
        }
        Ok(division.found)
    }
}

struct Division<'a> {
    chain: &'a Kinematics,
    straight: &'a Straight,
    ends: [JointValues; 2],
    options: &'a LinearOptions,
    found: LinearMove,
}

impl Division<'_> {
    /// Joint positions at a share of the move, near to positions expected there.
    fn solve(&self, share: f64, expected: &JointValues) -> Result<JointValues> {
        let tip = self.straight.tip(share);
        let mut given = *expected;
        let moved = proportional(&self.ends[0], &self.ends[1], share);
        let mut locked = self.options.locked;
        let mut axis = self.straight.axis(share);
        for (i, screw) in self.chain.screws[..self.chain.count].iter().enumerate() {
            locked[i] |= screw.rotary && self.options.orientation == Orientation::Axes;
            if locked[i] {
                given[i] = moved[i];
            }
        }
        if self.options.orientation == Orientation::Axes {
            axis = Some(self.chain.forward(&given).rotation.z_axis);
        }
        let axis =
            axis.ok_or_else(|| self.turns_at_once(share, "the directions of its ends are opposite"))?;
        let solutions = self.chain.inverse_locked(tip, axis, &given, &locked)?;
        let turned = solutions.iter().map(|solution| self.turned(solution, expected));
        let nearest = turned.min_by(|a, b| a.1.total_cmp(&b.1));
        Ok(nearest.map_or(*expected, |(q, _)| q))
    }

    /// A solution with its rotary axes at the turn nearest to positions expected, and how far they are from there.
    fn turned(&self, solution: &Solution, expected: &JointValues) -> (JointValues, f64) {
        let mut q = solution.values;
        let mut apart: f64 = 0.0;
        for (i, screw) in self.chain.screws[..self.chain.count].iter().enumerate() {
            if screw.rotary {
                let step = wrap(q[i] - expected[i]);
                q[i] = expected[i] + step;
                apart += step.abs();
            }
        }
        (q, apart)
    }

    /// Adds the points from `from` (not included) to `to` (included), halving as long as a part deviates.
    fn divide(&mut self, from: Point, to: Point) -> Result<()> {
        let mut from = from;
        let mut ahead = vec![to];
        while let Some(&to) = ahead.last() {
            let deviation = self.deviation(&from, &to);
            let tip_good = self.options.tcp || deviation.from_line <= self.options.tolerance;
            let axis_good = self.options.orientation == Orientation::Axes
                || deviation.axis_in_step <= self.options.axis_tolerance;
            if tip_good && axis_good {
                self.found.deviation = self.found.deviation.worst(deviation);
                self.found.shares.push(to.share);
                self.found.values.push(to.q);
                if self.found.values.len() > self.options.most_parts {
                    return Err(too_many(self.options));
                }
                from = to;
                ahead.pop();
                continue;
            }
            if to.share - from.share < SHORTEST {
                return Err(self.turns_at_once(
                    to.share,
                    "the tool passes along the first of them, or changes its solution",
                ));
            }
            let share = 0.5 * (from.share + to.share);
            let expected = proportional(&from.q, &to.q, 0.5);
            let q = self.solve(share, &expected)?;
            ahead.push(Point { share, q });
        }
        Ok(())
    }

    fn deviation(&self, from: &Point, to: &Point) -> LinearDeviation {
        let deviations = CHECKED.iter().map(|&part| {
            let at = self.chain.forward(&proportional(&from.q, &to.q, part));
            let share = from.share + (to.share - from.share) * part;
            self.straight.deviation(at.translation, at.rotation.z_axis, share)
        });
        deviations.fold(LinearDeviation::default(), LinearDeviation::worst)
    }

    fn turns_at_once(&self, share: f64, why: &str) -> Error {
        let message =
            format!("the rotary axes turn at once at {:.4} % of a straight move: {why}", 100.0 * share);
        Finding::error(Code::TURNS_AT_ONCE, message)
            .point(self.straight.tip(share).to_array())
            .help("hold or turn the axis beforehand with the tool retracted, or incline the tool otherwise")
            .into()
    }
}

fn check(from: &[f64], to: &[f64], options: &LinearOptions) -> Result<()> {
    if let Some(bad) = from.iter().chain(to).find(|value| !value.is_finite()) {
        return Err(Finding::error(Code::POSE_NOT_USABLE, "an axis position is not finite")
            .value(*bad, "")
            .into());
    }
    if !(options.tolerance > 0.0 && options.axis_tolerance > 0.0) {
        return Err(Finding::error(Code::TOO_MANY_PARTS, "the tolerance of a straight move is positive")
            .value_mm(options.tolerance)
            .bound_mm(0.0)
            .into());
    }
    Ok(())
}

fn too_many(options: &LinearOptions) -> Error {
    Finding::error(Code::TOO_MANY_PARTS, "a straight move would need more parts than allowed")
        .bound(options.most_parts as f64, "parts")
        .help("use a larger tolerance, or a control that keeps the tip on the line itself")
        .into()
}
