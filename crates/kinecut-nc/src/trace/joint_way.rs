//! Positions of the axes along a segment, with bounds on their speed and acceleration between two moments.
//!
//! Where rotary axes go straight and the tip keeps to its curve, each rotary axis moves a point by no more than its turn times the
//! distance: from the tip inwards to the linear axes this bounds what they have to do. Along tool vectors, and on chains with a rotary
//! axis between two linear ones, bounds are derivatives at some places, enlarged, and checked against the positions between them.

use std::cell::Cell;

use glam::{DMat3, DVec3};

use super::axis_path::AxisPath;
use super::segment::{AxisJet, Segment};
use super::turning::Carried;
use crate::geom::{CurveKind, Rigid};
use crate::machine::kinematics::Jacobian;
use crate::machine::{JointValues, Kinematics};

/// Places of a stretch at which derivatives are taken whose bounds are not known in closed form.
const SAMPLES: u32 = 8;
/// Places of a way between whose ends the directions of the tool are not known to be within reach.
const PLACES: u32 = 64;
/// Difference of positions and speeds that is rounding [mm, rad].
const ROUNDING: f64 = 1e-7;
/// Factor by which they are enlarged.
const RESERVE: f64 = 1.5;
/// Part of the greatest acceleration that may be unexplained between two places.
const UNEXPLAINED: f64 = 0.1;
/// Volume of the box of three unit directions below which they count as flat.
const FLAT: f64 = 1e-9;

/// Bounds on speed and acceleration of the axes X Y Z A B C [mm or rad, by `t`].
pub type AxisRates = [(f64, f64); 6];

/// The way of the axes X Y Z A B C along a segment, over `t` from 0 to 1.
///
/// ```
/// # use kinecut_nc as kinecut;
/// use glam::DVec3;
/// use kinecut::geom::Rigid;
/// use kinecut::machine::{CoordinateCode, Machine};
/// use kinecut::program::{Frame, Move, Origin, Path, Program, Setup, SetupId, Speed, State, Target, ToolAxis, WorkOffset};
/// use kinecut::trace::{CompStart, JointWay, RegisterState, TraceOptions, trace};
/// // The table of this machine moves in X and Y, its head in Z; the tip runs 100 mm along X.
/// let code = CoordinateCode::parse("2103").unwrap();
/// let machine = Machine::new(code, [None; 3], Default::default()).unwrap();
/// let setup = Setup {
///     name: "setup 1".to_owned(),
///     part_on_table: Rigid::IDENTITY,
///     work_offsets: [(WorkOffset::G54, Rigid::IDENTITY)].into(),
///     located: true,
///     stock: None,
///     fixtures: Vec::new(),
/// };
/// let mut program = Program::new(vec![setup]);
/// let frame = program.add_frame(Frame::Work(WorkOffset::G54));
/// let mut state = State::start(SetupId(0), frame);
/// state.speed = Speed::Rapid { linear: true };
/// for x in [0.0, 100.0] {
///     let end = Target::Tip { point: DVec3::new(x, 0.0, 30.0), axis: ToolAxis::Fixed };
///     program.push_move(Move { end, path: Path::Line }, &state, Origin::default());
/// }
/// let options = TraceOptions {
///     machine: Some(&machine),
///     tools: &[],
///     retract_height: 250.0,
///     operator: RegisterState::default(),
///     radii: &[],
///     comp_start: CompStart::AtNext,
///     chord: 0.5,
/// };
/// let trace = trace(&program, &options).unwrap();
/// let segment = trace.segments.last().unwrap();
/// let way = JointWay::new(segment).unwrap();
/// assert_eq!(way.at(0.25)[0], 25.0);
/// // X goes at one speed, the other axes stand.
/// assert_eq!(way.rates(0.0, 1.0)[..2], [(100.0, 0.0), (0.0, 0.0)]);
/// ```
#[derive(Clone, Debug)]
pub struct JointWay<'a> {
    segment: &'a Segment,
    law: Law<'a>,
    /// A position was asked for that is not known.
    lost: Cell<bool>,
}

#[derive(Clone, Debug)]
enum Law<'a> {
    /// The rotary axes stand; the tip is mapped into positions of the linear ones.
    Still { rotary: [f64; 3], matrix: DMat3, shift: DVec3 },
    /// All axes go straight.
    Straight { from: [f64; 6], to: [f64; 6] },
    /// The rotary axes go straight, the tip keeps to its curve.
    Tip(Box<TipLaw>),
    /// Derivatives are known at single places only.
    Sampled(Box<AxisPath<'a>>),
}

/// Rotary joints that go straight about linear ones.
#[derive(Clone, Debug)]
struct TipLaw {
    chain: Kinematics,
    from: JointValues,
    to: JointValues,
    to_table: Rigid,
    /// The axis of each joint, counted X Y Z A B C.
    axes: Vec<usize>,
    /// The first linear joint.
    first: usize,
}

impl<'a> JointWay<'a> {
    /// The way along a segment; `None` where the positions of the axes are not known.
    pub fn new(segment: &'a Segment) -> Option<JointWay<'a>> {
        let Some(turning) = &segment.turning else {
            let (matrix, shift) = segment.start_axes.to_linear;
            return Some(JointWay::still(segment, matrix, shift));
        };
        let law = match turning.carried() {
            Carried::Joints { .. } => Law::Straight { from: segment.joints(0.0)?, to: segment.joints(1.0)? },
            Carried::TipAndJoints { chain, from, to, to_part } => {
                let own = turning.chain.as_ref()?;
                let axes: Option<Vec<usize>> = (0..from.len()).map(|joint| own.axis_at(joint)).collect();
                match axes.zip(linear_block(&chain)) {
                    Some((axes, first)) => {
                        let to_table = to_part.inverse();
                        Law::Tip(Box::new(TipLaw { chain, from, to, to_table, axes, first }))
                    }
                    None => Law::Sampled(Box::new(segment.axis_path()?)),
                }
            }
            Carried::Plane => Law::Sampled(Box::new(segment.axis_path()?)),
        };
        let way = JointWay { segment, law, lost: Cell::new(false) };
        // A direction on the way may lie outside of what the axes reach.
        let places = if way.is_by_samples() { PLACES } else { 1 };
        let known = |k: u32| way.at(f64::from(k) / f64::from(places)).iter().all(|q| q.is_finite());
        (0..=places).all(known).then_some(way)
    }

    /// The way along a segment on which the tool does not turn, with a map of the tip into positions of X Y Z.
    pub fn still(segment: &'a Segment, matrix: DMat3, shift: DVec3) -> JointWay<'a> {
        let law = Law::Still { rotary: segment.rotary(), matrix, shift };
        JointWay { segment, law, lost: Cell::new(false) }
    }

    /// Positions [mm, rad]; not numbers where they are not known ([`JointWay::is_lost`]).
    pub fn at(&self, t: f64) -> [f64; 6] {
        match &self.law {
            Law::Still { rotary, matrix, shift } => {
                let [x, y, z] =
                    (*matrix * self.segment.curve.at(t * self.segment.curve.length()).p + *shift).to_array();
                [x, y, z, rotary[0], rotary[1], rotary[2]]
            }
            Law::Straight { from, to } => std::array::from_fn(|i| from[i] + (to[i] - from[i]) * t),
            Law::Tip(_) | Law::Sampled(_) => {
                let known = self.segment.joints(t).filter(|q| q.iter().all(|q| q.is_finite()));
                known.unwrap_or_else(|| {
                    self.lost.set(true);
                    [f64::NAN; 6]
                })
            }
        }
    }

    /// True once a position was asked for that is not known: a direction of the tool lies outside of what the axes reach. Nothing that
    /// was found along the way counts for all of it.
    pub fn is_lost(&self) -> bool {
        self.lost.get()
    }

    /// True while no rotary axis moves.
    pub fn is_still(&self) -> bool {
        matches!(self.law, Law::Still { .. })
    }

    /// True if bounds rest on derivatives at single places: of the axes, or of the curvature of a spiral or a cubic.
    pub fn is_sampled(&self) -> bool {
        match &self.law {
            Law::Still { .. } | Law::Tip(_) => self.segment.curve.is_bend_sampled(),
            Law::Straight { .. } => false,
            Law::Sampled(_) => true,
        }
    }

    fn is_by_samples(&self) -> bool {
        matches!(self.law, Law::Sampled(_))
    }

    /// Bounds on speed and acceleration between two moments; infinite where there is none, as next to a pole where rotary axes
    /// swing round: the stretch has to be shorter.
    pub fn rates(&self, from: f64, to: f64) -> AxisRates {
        let mut rates = [(0.0, 0.0); 6];
        let curve = &self.segment.curve;
        match &self.law {
            Law::Still { .. } if matches!(curve.kind(), CurveKind::Line(_)) => {
                straight(&mut rates, self.at(0.0), self.at(1.0));
            }
            Law::Still { matrix, .. } => {
                let rows = matrix.transpose();
                let (speed, acceleration) = (curve.length(), curve.most_bend(from, to));
                for (rate, row) in rates.iter_mut().zip([rows.x_axis, rows.y_axis, rows.z_axis]) {
                    *rate = (row.length() * speed, row.length() * acceleration);
                }
            }
            Law::Straight { from, to } => straight(&mut rates, *from, *to),
            Law::Tip(law) => self.tip_rates(law, from, to, &mut rates),
            Law::Sampled(path) => return self.sampled_rates(path, from, to),
        }
        rates
    }

    /// Bounds where rotary joints go straight and the tip keeps to its curve.
    fn tip_rates(&self, law: &TipLaw, from: f64, to: f64, rates: &mut AxisRates) {
        let TipLaw { chain, from: q0, to: q1, to_table, axes, first } = law;
        let curve = &self.segment.curve;
        let turn = |joint: usize| (q1[joint] - q0[joint]).abs();
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let tip = to_table.point(curve.at(middle * curve.length()).p);
        let mut q = *q0;
        q.iter_mut().zip(q1.iter()).for_each(|(q, end)| *q += (end - *q) * middle);
        let jacobian = chain.jacobian(&q);
        let twists = jacobian.twists();
        // The tip, seen from the link that carries the linear axes: the joints before them are where they are, whatever these do.
        let mut seen = Carry {
            room: curve.length() * half,
            speed: curve.length(),
            acceleration: curve.most_bend(from, to),
        };
        for joint in 0..*first {
            seen.turn(turn(joint), twists[joint].velocity(tip).length(), half);
        }
        // The tool, seen from the link that they carry: in this chain the linear axes are at zero.
        let mut tool = Carry::default();
        let own = jacobian.frame.translation;
        for joint in (first + 3..axes.len()).rev() {
            tool.turn(turn(joint), twists[joint].velocity(own).length(), half);
        }
        let shares = shares(&jacobian, *first);
        for (joint, axis) in axes.iter().enumerate() {
            rates[*axis] = match joint.checked_sub(*first).filter(|i| *i < 3) {
                Some(i) => (
                    shares[i] * (seen.speed + tool.speed),
                    shares[i] * (seen.acceleration + tool.acceleration),
                ),
                None => (turn(joint), 0.0),
            };
        }
    }

    /// Bounds from derivatives at some places, enlarged. Where the derivatives at two places do not explain what is between them there
    /// is no bound: the axes do something that the places do not show.
    fn sampled_rates(&self, path: &AxisPath<'_>, from: f64, to: f64) -> AxisRates {
        let length = path.length();
        let step = (to - from) / f64::from(SAMPLES);
        let jets: [_; SAMPLES as usize + 1] =
            std::array::from_fn(|k| path.at((from + step * k as f64) * length));
        if jets.iter().flatten().any(|jet| !jet.q.is_finite()) {
            self.lost.set(true);
        }
        let mut rates = [(0.0f64, 0.0f64); 6];
        for place in &jets {
            for (rate, jet) in rates.iter_mut().zip(place) {
                // A maximum passes over what is not a number.
                *rate = (rate.0.max((jet.d1 * length).abs()), rate.1.max((jet.d2 * length * length).abs()));
            }
        }
        let explained = |before: &AxisJet, now: &AxisJet, bend: f64| {
            let [v0, v1] = [before.d1, now.d1].map(|d| d * length);
            let [a0, a1] = [before.d2, now.d2].map(|d| d * length * length);
            let place = now.q - before.q - 0.5 * step * (v0 + v1) + step * step * (a1 - a0) / 12.0;
            let speed = v1 - v0 - 0.5 * step * (a0 + a1);
            place.abs() <= UNEXPLAINED * step * step * bend + ROUNDING
                && speed.abs() <= UNEXPLAINED * step * bend + ROUNDING
        };
        let fits = |pair: &[[AxisJet; 6]]| (0..6).all(|i| explained(&pair[0][i], &pair[1][i], rates[i].1));
        match jets.windows(2).all(fits) {
            true => rates.map(|(rate, bend)| (RESERVE * rate, RESERVE * bend)),
            false => [(f64::INFINITY, f64::INFINITY); 6],
        }
    }
}

/// Rates of axes that go straight.
fn straight(rates: &mut AxisRates, from: [f64; 6], to: [f64; 6]) {
    for (i, rate) in rates.iter_mut().enumerate() {
        *rate = ((to[i] - from[i]).abs(), 0.0);
    }
}

/// The first of three independent linear joints that follow one another; `None` if the chain has others.
fn linear_block(chain: &Kinematics) -> Option<usize> {
    let jacobian = chain.jacobian(&[]);
    let is_linear = |i: usize| jacobian.twists()[i].turn == DVec3::ZERO;
    let first = (0..chain.joints()).find(|i| is_linear(*i))?;
    let count = (0..chain.joints()).filter(|i| is_linear(*i)).count();
    let block = count == 3 && first + 3 <= chain.joints() && (first..first + 3).all(is_linear);
    (block && directions(&jacobian, first).determinant().abs() > FLAT).then_some(first)
}

fn directions(jacobian: &Jacobian, first: usize) -> DMat3 {
    let shift = |i: usize| jacobian.twists()[first + i].shift;
    DMat3::from_cols(shift(0), shift(1), shift(2))
}

/// Most by which each of three linear joints moves while the point that they carry goes 1 mm.
fn shares(jacobian: &Jacobian, first: usize) -> [f64; 3] {
    let rows = directions(jacobian, first).inverse().transpose();
    [rows.x_axis, rows.y_axis, rows.z_axis].map(DVec3::length)
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
