//! Error budget of a machine by the variational method (Reshetov and Portman).
//!
//! Each link of the chain has a small error of its own: three shifts and three turns in its frame, `E_i`. They move the
//! point of the tool by `dr0 = sum_i A_{0,i} E_i A_{i,l} r_l`. Projected on the normal of the surface this is the error of
//! form; for independent errors the squares add, for known bounds the amounts.

use glam::DVec3;

use crate::geom::Rigid;
use crate::machine::{Joint, Machine};

/// Small errors of a link: in the frame of the machine at home, carried along with the joints up to and with the link,
/// about the reference point of its joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinkError {
    /// Shifts along X, Y, Z [mm].
    pub shift: DVec3,
    /// Turns about X, Y, Z [rad].
    pub turn: DVec3,
}

/// Effect of the errors of all links at one pose.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorBudget {
    /// Shift of the point of the tool by the errors of each link, in the order of the code [mm].
    pub shifts: Vec<DVec3>,
    /// The same along the normal of the surface [mm].
    pub normal: Vec<f64>,
}

impl ErrorBudget {
    /// Shift of the point by the given errors together [mm].
    pub fn total(&self) -> DVec3 {
        self.shifts.iter().sum()
    }

    /// Error of form by the given errors together [mm].
    pub fn form(&self) -> f64 {
        self.normal.iter().sum()
    }
}

/// Effect of errors of unit size at one pose: the gain of each link's six errors into the normal.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorGain {
    /// For each link: normal shift per mm of shift along X, Y, Z, and per rad of turn about X, Y, Z [mm/rad].
    pub gains: Vec<[f64; 6]>,
}

impl ErrorGain {
    /// Error of form for independent errors: root of the sum of squares [mm]. Of each link come the sizes of its errors.
    pub fn independent(&self, sizes: &[LinkError]) -> f64 {
        self.terms(sizes).map(|t| t * t).sum::<f64>().sqrt()
    }

    /// Greatest error of form for errors within their sizes [mm].
    pub fn worst(&self, sizes: &[LinkError]) -> f64 {
        self.terms(sizes).map(f64::abs).sum()
    }

    fn terms<'a>(&'a self, sizes: &'a [LinkError]) -> impl Iterator<Item = f64> + 'a {
        self.gains.iter().zip(sizes).flat_map(|(gain, size)| {
            let (s, t) = (size.shift, size.turn);
            let six = [s.x, s.y, s.z, t.x, t.y, t.z];
            (0..6).map(move |k| gain[k] * six[k])
        })
    }
}

/// The frames in the work after each joint at positions `q`, and the reference point of each joint in its frame at home.
fn frames(machine: &Machine, q: &[f64]) -> Vec<(Rigid, DVec3)> {
    let mut before = machine.work.inverse();
    let mut list = Vec::with_capacity(machine.joints.len());
    for (i, joint) in machine.joints.iter().enumerate() {
        before = before.after(&motion(joint, q.get(i).copied().unwrap_or(0.0)));
        list.push((before, joint.point));
    }
    list
}

/// Motion of a joint in the frame of the machine at home.
fn motion(joint: &Joint, value: f64) -> Rigid {
    let value = value * joint.sense;
    if joint.motion.is_rotation() {
        let rotation = glam::DMat3::from_axis_angle(joint.direction, value);
        Rigid { rotation, translation: joint.point - rotation * joint.point }
    } else {
        Rigid::from_translation(joint.direction * value)
    }
}

/// Error that errors of the links cause at a point of the tool at positions `q` [mm or rad]; missing errors count as
/// zero.
///
/// `point` is in workpiece coordinates [mm], `normal` the unit normal of the surface there.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use glam::DVec3;
/// use kinecut::machine::generation::{error_budget, LinkError};
/// use kinecut::machine::{CoordinateCode, Machine};
/// // A lathe whose headstock axis leans by 0.1 mrad about Y: at 200 mm from it the radius is off by 20 um.
/// let lathe = Machine::of_code(CoordinateCode::parse("6031").unwrap());
/// let lean = LinkError { turn: DVec3::Y * 1e-4, ..Default::default() };
/// let budget = error_budget(&lathe, &[0.0; 3], DVec3::new(30.0, 0.0, 200.0), DVec3::X, &[lean]);
/// assert!((budget.form() - 0.02).abs() < 1e-12);
/// ```
pub fn error_budget(
    machine: &Machine,
    q: &[f64],
    point: DVec3,
    normal: DVec3,
    errors: &[LinkError],
) -> ErrorBudget {
    let shifts: Vec<DVec3> = frames(machine, q)
        .iter()
        .enumerate()
        .map(|(i, (frame, reference))| {
            let error = errors.get(i).copied().unwrap_or_default();
            let arm = frame.inverse().point(point) - *reference;
            frame.vector(error.shift + error.turn.cross(arm))
        })
        .collect();
    let normal = shifts.iter().map(|s| s.dot(normal)).collect();
    ErrorBudget { shifts, normal }
}

/// Gain of the errors of each link along the normal of the surface at a point; arguments as in [`error_budget`].
pub fn error_gain(machine: &Machine, q: &[f64], point: DVec3, normal: DVec3) -> ErrorGain {
    let gain = |(frame, reference): (Rigid, DVec3)| {
        let back = frame.inverse();
        let (n, arm) = (back.vector(normal), back.point(point) - reference);
        // n . (e x arm) = e . (arm x n)
        let turn = arm.cross(n);
        [n.x, n.y, n.z, turn.x, turn.y, turn.z]
    };
    ErrorGain { gains: frames(machine, q).into_iter().map(gain).collect() }
}
