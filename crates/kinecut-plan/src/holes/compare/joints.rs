//! Steps of motion at each joint of a chain at constant feed.
//!
//! A break of direction `b` is a step of velocity `2 F sin(b/2)`, a step of curvature one of acceleration `F^2 dk`, a
//! step of the third derivative one of jerk `F^3 |dp'''|`. Below the first derivative that steps, the next ones have an
//! impulse, and a step of theirs says nothing.

use serde::Serialize;

use super::chain::Chain;
use crate::geom::{ContactOrder, CurveJoint, joint};

/// Steps at a joint at constant feed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Steps {
    /// Velocity [mm/s].
    pub velocity: f64,
    /// Acceleration [mm/s^2]; none: an impulse, for the velocity steps.
    pub acceleration: Option<f64>,
    /// Jerk [mm/s^3]; none: an impulse, for velocity or acceleration steps.
    pub jerk: Option<f64>,
}

/// A joint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct JointStep {
    /// Arc length from the start of the path [mm].
    pub s: f64,
    /// Distance from the hole's centre [mm].
    pub radius: f64,
    /// Order of contact, by derivatives to the seventh: "G0" to "G6", "smooth", "apart".
    pub contact: &'static str,
    /// Angle between the tangents [rad].
    pub kink: f64,
    /// Steps at the feed.
    pub steps: Steps,
    #[serde(skip)]
    pub(super) order: ContactOrder,
}

impl JointStep {
    pub(super) fn new(joint: &CurveJoint, s: f64, radius: f64, feed: f64) -> JointStep {
        let order = joint.contact;
        let known = |v: f64| v.is_finite().then_some(v);
        let kinked = order <= ContactOrder::G0;
        let steps = Steps {
            velocity: if kinked { 2.0 * feed * (0.5 * joint.angle).sin() } else { 0.0 },
            acceleration: match order {
                ContactOrder::Apart | ContactOrder::G0 => None,
                ContactOrder::G1 => known(feed * feed * joint.curvature),
                _ => Some(0.0),
            },
            jerk: match order {
                ContactOrder::Apart | ContactOrder::G0 | ContactOrder::G1 => None,
                ContactOrder::G2 => known(feed.powi(3) * joint.slope),
                _ => Some(0.0),
            },
        };
        let kink = if kinked { joint.angle } else { 0.0 };
        JointStep { s, radius, contact: order.name(), kink, steps, order }
    }

    /// Order of severity: the lowest contact first, then the larger step in the lowest derivative that steps.
    fn hardness(&self) -> (std::cmp::Reverse<ContactOrder>, f64) {
        let first = match self.order {
            ContactOrder::Apart | ContactOrder::G0 => self.steps.velocity,
            ContactOrder::G1 => self.steps.acceleration.unwrap_or(f64::INFINITY),
            _ => self.steps.jerk.unwrap_or(f64::INFINITY),
        };
        (std::cmp::Reverse(self.order), first)
    }
}

/// All joints of a chain at a feed [mm/s].
pub(super) fn joints(chain: &Chain, feed: f64) -> Vec<JointStep> {
    let curves = chain.in_space();
    curves
        .windows(2)
        .zip(&chain.starts[1..])
        .map(|(pair, s)| {
            JointStep::new(&joint(&pair[0], &pair[1]), *s, pair[1].start().truncate().length(), feed)
        })
        .collect()
}

/// So many of the hardest joints, in their order along the path.
pub(super) fn hardest(mut joints: Vec<JointStep>, most: usize) -> Vec<JointStep> {
    joints.sort_by(|a, b| {
        let (a, b) = (a.hardness(), b.hardness());
        b.0.cmp(&a.0).then(b.1.total_cmp(&a.1))
    });
    joints.truncate(most);
    joints.sort_by(|a, b| a.s.total_cmp(&b.s));
    joints
}

/// The hardest joint.
pub(super) fn worst(joints: &[JointStep]) -> Option<JointStep> {
    joints.iter().copied().max_by(|a, b| {
        let (a, b) = (a.hardness(), b.hardness());
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    })
}
