//! Positions of all axes along a segment, with their derivatives.
//!
//! Everything is a power series about the place that is asked for, to the third order. The chain is taken at its rotary
//! positions there, with the linear axes at zero: each joint is then a screw in the table frame, and its step by `d` moves a
//! point by `1 + d X + d^2 X^2 / 2 + d^3 X^3 / 6`, without an angle function ([`moved`]). Steps of the rotary axes are
//! straight, or follow order by order from the direction of the tool; those of the linear axes solve one system of three
//! for each order.
//! Source: Murray, Li and Sastry 1994, A Mathematical Introduction to Robotic Manipulation, section 3.2 (products of
//! exponentials).

use glam::{DMat3, DVec3};

use super::chain::Chain;
use super::segment::{AxisJet, Segment};
use super::turning::{AxisTurning, TurningLaw, plane_rate};
use crate::geom::Rigid;
use crate::machine::Twist;
use crate::machine::kinematics::Jacobian;

/// Length of a tip's curve below which it has none [mm]: rounding of doubles at a hundred metres, and far below a
/// resolution.
const NO_LENGTH: f64 = 1e-9;
/// Volume of three unit directions, two of them rates of the tool axis, below which these are parallel: the inverse
/// kinematics leaves an axis where it is by the same bound.
const SINGULAR: f64 = 1e-10;

/// A point or vector as a power series: the coefficients of orders 0 to 3.
type Series = [DVec3; 4];

/// Steps of the axes A, B, C from where they are, as power series: the coefficients of orders 1 to 3 [rad].
type Steps = [[f64; 3]; 3];

/// Positions of all axes along one segment.
///
/// The parameter is the arc length of the tip's curve [mm], or where that has no length (under 1e-9 mm) an angle [rad],
/// of which the axes take as much as the rotary one that turns most.
#[derive(Clone, Debug)]
pub struct AxisPath<'a> {
    segment: &'a Segment,
    /// Turning of the tool with its machine, if it turns.
    turning: Option<(&'a AxisTurning, &'a Chain)>,
    /// From part coordinates into the table frame.
    to_table: Rigid,
    length: f64,
}

impl Segment {
    /// The positions of all axes along the segment; `None` where the tool turns and its machine is not known.
    pub fn axis_path(&self) -> Option<AxisPath<'_>> {
        let (turning, to_table) = match &self.turning {
            None => (None, Rigid::IDENTITY),
            Some(turning) => (Some((&**turning, turning.chain.as_ref()?)), turning.to_part.inverse()),
        };
        let way = self.curve.length();
        let most = |[from, to]: [[f64; 3]; 2]| (0..3).fold(0.0, |most, i| (to[i] - from[i]).abs().max(most));
        let length = match turning.map(|(turning, _)| &turning.law) {
            Some(TurningLaw::Vector { rotary, .. }) => {
                let ends = (*rotary)?;
                if way < NO_LENGTH { most(ends) } else { way }
            }
            Some(TurningLaw::Rotary { from, to, .. }) if way < NO_LENGTH => most([*from, *to]),
            _ => way,
        };
        Some(AxisPath { segment: self, turning, to_table, length })
    }
}

impl AxisPath<'_> {
    /// Length of the parameter [mm]; of a segment whose tip stands, the largest turn of a rotary axis between its ends
    /// [rad].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Positions of X Y Z A B C [mm, rad] and their derivatives by the parameter, at `s` from 0 to the length.
    ///
    /// Not numbers where [`Segment::joints`] has none: the axes do not reach the direction there, or the linear axes are not
    /// independent. Under tool vectors the derivatives of rotary axes grow without bound towards a position in which two
    /// of them cannot turn the tool into all directions (the tool along the first of them); in it, the axis that has
    /// no say stands still, the other one goes as far with the tool as it can, and the positions may jump from there.
    pub fn at(&self, s: f64) -> [AxisJet; 6] {
        let Some((turning, chain)) = self.turning else {
            let [x, y, z] = self.segment.axes(s);
            let [a, b, c] = self.segment.rotary().map(|q| AxisJet { q, d1: 0.0, d2: 0.0, d3: 0.0 });
            return [x, y, z, a, b, c];
        };
        let (t, rate) = if self.length > 0.0 { (s / self.length, 1.0 / self.length) } else { (0.0, 0.0) };
        let found = match &turning.law {
            TurningLaw::Rotary { from, to, linear } => {
                let steps = [0, 1, 2].map(|i| [(to[i] - from[i]) * rate, 0.0, 0.0]);
                let linear = linear
                    .map(|[start, end]| [start.lerp(end, t), (end - start) * rate, DVec3::ZERO, DVec3::ZERO]);
                turning.rotary(chain, t).map(|rotary| {
                    let linear = linear.unwrap_or_else(|| {
                        linear_axes(chain, &jacobian(chain, rotary), &steps, &self.tip(t, rate))
                    });
                    (linear, rotary, steps)
                })
            }
            TurningLaw::Vector { from, to, .. } => turning.rotary(chain, t).map(|rotary| {
                let jacobian = jacobian(chain, rotary);
                let turn = plane_rate(*from, *to) * rate;
                let steps = steps_for(chain, &jacobian, turn);
                (linear_axes(chain, &jacobian, &steps, &self.tip(t, rate)), rotary, steps)
            }),
        };
        let Some((linear, rotary, steps)) = found else {
            return [AxisJet { q: f64::NAN, d1: f64::NAN, d2: f64::NAN, d3: f64::NAN }; 6];
        };
        let jet = |[q, c1, c2, c3]: [f64; 4]| AxisJet { q, d1: c1, d2: 2.0 * c2, d3: 6.0 * c3 };
        let [x, y, z] = [0, 1, 2].map(|i| jet(linear.map(|c| c[i])));
        let [a, b, c] = [0, 1, 2].map(|i| jet([rotary[i], steps[i][0], steps[i][1], steps[i][2]]));
        [x, y, z, a, b, c]
    }

    /// The tip [table frame] at a part `t` of the segment, which grows by `rate`.
    fn tip(&self, t: f64, rate: f64) -> Series {
        let way = self.segment.curve.length();
        let jet = self.segment.curve.at(t * way);
        let by = way * rate;
        let along =
            |d: DVec3, factor: f64| if by > 0.0 { self.to_table.vector(d) * factor } else { DVec3::ZERO };
        [
            self.to_table.point(jet.p),
            along(jet.d1, by),
            along(jet.d2, by * by / 2.0),
            along(jet.d3, by * by * by / 6.0),
        ]
    }
}

/// The screws of the chain at these rotary positions, the linear axes at zero.
fn jacobian(chain: &Chain, rotary: [f64; 3]) -> Jacobian {
    chain.kinematics().jacobian(&chain.joints(DVec3::ZERO, rotary))
}

/// Positions of X, Y, Z that keep the tip to its way while the rotary axes make these steps.
fn linear_axes(chain: &Chain, jacobian: &Jacobian, steps: &Steps, tip: &Series) -> Series {
    let mut zero = constant(jacobian.frame.translation);
    let mut directions = [constant(DVec3::ZERO); 3];
    for (place, twist) in jacobian.twists().iter().enumerate().rev() {
        match chain.axis_at(place) {
            Some(axis @ 0..3) => directions[axis] = constant(twist.shift),
            Some(axis) if steps[axis - 3] != [0.0; 3] => {
                let step = &steps[axis - 3];
                zero = moved(&zero, twist, step);
                directions = directions.map(|direction| turned(&direction, twist.turn, step));
            }
            _ => {}
        }
    }
    // The directions times the positions are what is left of the tip's way, order by order.
    let [x, y, z] = directions;
    let matrix = |n: usize| DMat3::from_cols(x[n], y[n], z[n]);
    let back = Chain::independent(matrix(0)).unwrap_or(DMat3::NAN);
    let mut linear = constant(DVec3::ZERO);
    for n in 0..4 {
        let known: DVec3 = (1..=n).map(|k| matrix(k) * linear[n - k]).sum();
        linear[n] = back * (tip[n] - zero[n] - known);
    }
    linear
}

/// Steps of the rotary axes that turn the tool axis at this rate [rad per unit].
fn steps_for(chain: &Chain, jacobian: &Jacobian, turn: DVec3) -> Steps {
    let mut steps: Steps = [[0.0; 3]; 3];
    // Two at most: the inverse kinematics has no other chains.
    let mut rotaries = [(0, DVec3::ZERO); 2];
    let mut count = 0;
    for (place, twist) in jacobian.twists().iter().enumerate() {
        if let (Some(axis @ 3..6), Some(slot)) = (chain.axis_at(place), rotaries.get_mut(count)) {
            *slot = (axis - 3, twist.turn);
            count += 1;
        }
    }
    let axis = jacobian.frame.rotation.z_axis;
    let mut wanted = constant(axis);
    for n in 1..4 {
        wanted[n] = turn.cross(wanted[n - 1]) / n as f64;
    }
    let rates = rotaries.map(|(_, turn)| turn.cross(axis));
    for n in 1..4 {
        // What the lower orders do; the coefficient that is still zero comes in by its rate alone.
        let mut reached = constant(axis);
        for (i, turn) in rotaries[..count].iter().rev() {
            reached = turned(&reached, *turn, &steps[*i]);
        }
        let found = combination(rates, axis, wanted[n] - reached[n]);
        for ((i, _), coefficient) in rotaries[..count].iter().zip(found) {
            steps[*i][n - 1] = coefficient;
        }
    }
    steps
}

/// The factors of two vectors across `axis` that add up to a third one; where they are parallel that of the longer one alone.
fn combination([u, v]: [DVec3; 2], axis: DVec3, sum: DVec3) -> [f64; 2] {
    let volume = axis.dot(u.cross(v));
    if volume.abs() > SINGULAR {
        return [axis.dot(sum.cross(v)) / volume, axis.dot(u.cross(sum)) / volume];
    }
    let alone = |u: DVec3| if u.length() > SINGULAR { u.dot(sum) / u.length_squared() } else { 0.0 };
    if u.length_squared() >= v.length_squared() { [alone(u), 0.0] } else { [0.0, alone(v)] }
}

fn constant(c: DVec3) -> Series {
    [c, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO]
}

/// A vector turned by a step about an axis.
fn turned(v: &Series, turn: DVec3, step: &[f64; 3]) -> Series {
    moved(v, &Twist { turn, shift: DVec3::ZERO }, step)
}

/// A point moved by a step of a screw.
fn moved(p: &Series, twist: &Twist, step: &[f64; 3]) -> Series {
    let [d1, d2, d3] = *step;
    let rate = |c: DVec3| twist.turn.cross(c);
    let first = [twist.velocity(p[0]), rate(p[1]), rate(p[2])];
    let second = [rate(first[0]), rate(first[1])];
    let third = rate(second[0]);
    // The step, half its square and a sixth of its cube, each times the rate of its order.
    let half = 0.5 * d1 * d1;
    [
        p[0],
        p[1] + first[0] * d1,
        p[2] + first[1] * d1 + first[0] * d2 + second[0] * half,
        p[3] + first[2] * d1
            + first[1] * d2
            + first[0] * d3
            + second[1] * half
            + second[0] * (d1 * d2)
            + third * (half * d1 / 3.0),
    ]
}
