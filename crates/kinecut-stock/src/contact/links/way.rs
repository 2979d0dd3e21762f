//! Positions of the joints of a machine along a segment, with bounds on their speed and acceleration.

use glam::{DMat3, DVec3};

use super::axes::Axes;
use crate::geom::{CurveKind, Rigid};
use crate::machine::{JointValues, Kinematics, MOST_JOINTS};
use crate::sweep::{curve_acceleration, is_sampled};
use crate::trace::{AxisPath, Carried, Segment};

/// Places of a stretch at which derivatives are taken whose bounds are not known in closed form.
const SAMPLES: u32 = 8;
/// Difference of positions and speeds that is rounding [mm, rad].
const ROUNDING: f64 = 1e-7;
/// Factor by which they are enlarged.
const RESERVE: f64 = 1.5;

/// Bounds on the speed and the acceleration of each joint [mm or rad, by `t`].
pub(super) type Rates = [(f64, f64); MOST_JOINTS];

/// The way of all joints along a segment, over `t` from 0 to 1.
#[derive(Clone, Debug)]
pub(super) struct Way<'a> {
    segment: &'a Segment,
    axes: &'a Axes,
    law: Law<'a>,
}

#[derive(Clone, Debug)]
enum Law<'a> {
    /// The rotary joints stand; the tip is mapped into positions of the linear ones.
    Still { rotary: JointValues, matrix: DMat3, shift: DVec3 },
    /// All joints go straight.
    Straight { from: JointValues, to: JointValues },
    /// The rotary joints go straight, the tip keeps to its curve; `block`: the joints that are linear.
    Tip { chain: Box<Kinematics>, from: JointValues, to: JointValues, to_table: Rigid, block: [usize; 2] },
    /// Derivatives are known at single places only.
    Sampled(Box<AxisPath<'a>>),
}

impl<'a> Way<'a> {
    /// The way along a segment with a tool whose chain is given; `None` where the positions of the joints are not known.
    pub(super) fn new(
        segment: &'a Segment,
        axes: &'a Axes,
        chain: &Kinematics,
        part_on_table: &Rigid,
    ) -> Option<Way<'a>> {
        let sampled = || segment.axis_path().map(|path| Law::Sampled(Box::new(path)));
        let law = match segment.turning.as_ref().map(|turning| turning.carried()) {
            None => {
                let [a, b, c] = segment.rotary();
                let rotary = axes.in_order([0.0, 0.0, 0.0, a, b, c]);
                let (matrix, shift) = axes.to_linear(chain, &rotary)?;
                let shift = matrix * part_on_table.translation + shift;
                Law::Still { rotary, matrix: matrix * part_on_table.rotation, shift }
            }
            Some(Carried::Joints { from, to, .. }) => Law::Straight { from, to },
            Some(Carried::TipAndJoints { chain, from, to, to_part }) => match &axes.block {
                Some(block) => Law::Tip {
                    chain: Box::new(chain),
                    from,
                    to,
                    to_table: to_part.inverse(),
                    block: [block.start, block.end],
                },
                None => sampled()?,
            },
            Some(Carried::Plane) => sampled()?,
        };
        let way = Way { segment, axes, law };
        // A direction on the way may lie outside of what the joints reach.
        let places = if matches!(way.law, Law::Sampled(_)) { SAMPLES } else { 1 };
        let known = |k: u32| way.at(f64::from(k) / f64::from(places)).iter().all(|q| q.is_finite());
        (0..=places).all(known).then_some(way)
    }

    /// Positions of the joints in the order of the code [mm, rad].
    pub(super) fn at(&self, t: f64) -> JointValues {
        match &self.law {
            Law::Still { rotary, matrix, shift } => {
                let tip = self.segment.curve.at(t * self.segment.curve.length()).p;
                self.axes.with_linear(rotary, *matrix * tip + *shift)
            }
            Law::Straight { from, to } => between(from, to, t),
            Law::Tip { .. } | Law::Sampled(_) => match self.segment.joints(t) {
                Some(positions) => self.axes.in_order(positions),
                None => JointValues::new(&[f64::NAN; MOST_JOINTS][..self.axes.count()]),
            },
        }
    }

    /// True while no rotary joint moves.
    pub(super) fn is_still(&self) -> bool {
        matches!(self.law, Law::Still { .. })
    }

    /// True if bounds rest on derivatives at single places.
    pub(super) fn is_sampled(&self) -> bool {
        match &self.law {
            Law::Still { .. } | Law::Tip { .. } => is_sampled(&self.segment.curve),
            Law::Straight { .. } => false,
            Law::Sampled(_) => true,
        }
    }

    /// Bounds on speed and acceleration of the joints between two moments.
    pub(super) fn rates(&self, from: f64, to: f64) -> Rates {
        let mut rates = [(0.0, 0.0); MOST_JOINTS];
        let curve = &self.segment.curve;
        // Bounds of the linear joints from those of the point that they carry.
        let mut linear = |speed: f64, acceleration: f64| {
            for (joint, rate) in rates.iter_mut().enumerate().take(self.axes.count()) {
                if let Some(i) = self.axes.linear_at(joint) {
                    *rate = (self.axes.share[i] * speed, self.axes.share[i] * acceleration);
                }
            }
        };
        match &self.law {
            Law::Still { .. } if matches!(curve.kind(), CurveKind::Line(_)) => {
                let [q0, q1] = [self.at(0.0), self.at(1.0)];
                for (rate, (a, b)) in rates.iter_mut().zip(q0.iter().zip(q1.iter())) {
                    *rate = ((b - a).abs(), 0.0);
                }
            }
            Law::Still { matrix, .. } => {
                let rows = matrix.transpose();
                let rows = [rows.x_axis, rows.y_axis, rows.z_axis].map(DVec3::length);
                let (speed, acceleration) = (curve.length(), curve_acceleration(curve, from, to));
                for (joint, rate) in rates.iter_mut().enumerate().take(self.axes.count()) {
                    if let Some(i) = self.axes.linear_at(joint) {
                        *rate = (rows[i] * speed, rows[i] * acceleration);
                    }
                }
            }
            Law::Straight { from: q0, to: q1 } => {
                for (rate, (a, b)) in rates.iter_mut().zip(q0.iter().zip(q1.iter())) {
                    *rate = ((b - a).abs(), 0.0);
                }
            }
            Law::Tip { chain, from: q0, to: q1, to_table, block } => {
                let turn = |joint: usize| (q1[joint] - q0[joint]).abs();
                let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
                let tip = to_table.point(curve.at(middle * curve.length()).p);
                let twists = chain.jacobian(&between(q0, q1, middle));
                let arm = |joint: usize| {
                    // The linear joints are left out of the chain: the tip is where they have brought it.
                    twists.twists()[joint].velocity(tip).length()
                };
                // The tip, seen from the link that carries the linear joints, and the tool, seen from the link that they carry.
                let mut seen = Carry {
                    room: curve.length() * half,
                    speed: curve.length(),
                    acceleration: curve_acceleration(curve, from, to),
                };
                (0..block[0]).for_each(|joint| seen.turn(turn(joint), arm(joint), half));
                let mut tool = Carry::default();
                let own = twists.frame.translation;
                for joint in (block[1]..self.axes.count()).rev() {
                    tool.turn(turn(joint), twists.twists()[joint].velocity(own).length(), half);
                }
                linear(seen.speed + tool.speed, seen.acceleration + tool.acceleration);
                for joint in (0..block[0]).chain(block[1]..self.axes.count()) {
                    rates[joint] = (turn(joint), 0.0);
                }
            }
            Law::Sampled(path) => return self.sampled(path, from, to),
        }
        rates
    }
}

impl Way<'_> {
    /// Bounds from derivatives at some places, enlarged. Where positions and speeds between the places do not fit them, as next to a
    /// pole where rotary joints swing round, there is no bound: the stretch has to be shorter.
    fn sampled(&self, path: &AxisPath<'_>, from: f64, to: f64) -> Rates {
        let length = path.length();
        let step = (to - from) / f64::from(SAMPLES);
        let mut rates = [(0.0, 0.0); MOST_JOINTS];
        let mut places = Vec::with_capacity(SAMPLES as usize + 1);
        for k in 0..=SAMPLES {
            let jets = path.at((from + step * f64::from(k)) * length);
            let place = [
                self.axes.in_order(jets.map(|jet| jet.q)),
                self.axes.in_order(jets.map(|jet| jet.d1 * length)),
            ];
            let bends = self.axes.in_order(jets.map(|jet| jet.d2 * length * length));
            for (rate, (speed, bend)) in rates.iter_mut().zip(place[1].iter().zip(bends.iter())) {
                let most =
                    |a: f64, b: f64| if b.is_finite() { a.max(RESERVE * b.abs()) } else { f64::INFINITY };
                *rate = (most(rate.0, *speed), most(rate.1, *bend));
            }
            places.push(place);
        }
        for (joint, rate) in rates.iter_mut().enumerate().take(self.axes.count()) {
            let fits = |pair: &[[JointValues; 2]]| {
                let [q0, q1] = [pair[0][0][joint], pair[1][0][joint]];
                let [v0, v1] = [pair[0][1][joint], pair[1][1][joint]];
                (v1 - v0).abs() <= step * rate.1 + ROUNDING
                    && (q1 - q0 - step * v0).abs() <= 0.5 * step * step * rate.1 + ROUNDING
            };
            if !places.windows(2).all(fits) {
                *rate = (f64::INFINITY, f64::INFINITY);
            }
        }
        rates
    }
}

/// Bounds on the motion of a point that joints carry one after the other.
#[derive(Clone, Copy, Debug, Default)]
struct Carry {
    /// Distance from where it is in the middle [mm].
    room: f64,
    speed: f64,
    acceleration: f64,
}

impl Carry {
    /// Carried by a rotary joint of this rate, from whose axis it is `arm` away in the middle [mm].
    fn turn(&mut self, rate: f64, arm: f64, half: f64) {
        let arm = arm + self.room;
        self.acceleration += 2.0 * rate * self.speed + rate * rate * arm;
        self.speed += rate * arm;
        self.room += rate * arm * half;
    }
}

/// Positions at a part `t` of a straight way.
fn between(from: &JointValues, to: &JointValues, t: f64) -> JointValues {
    let mut q = *from;
    for (q, b) in q.iter_mut().zip(to.iter()) {
        *q += (b - *q) * t;
    }
    q
}
