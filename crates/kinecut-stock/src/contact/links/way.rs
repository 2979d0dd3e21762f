//! Positions of the joints of a machine along a segment, in the order of its code.

use super::axes::Axes;
use crate::geom::Rigid;
use crate::machine::{JointValues, Kinematics, MOST_JOINTS};
use crate::trace::{JointWay, Segment};

/// Bounds on the speed and the acceleration of each joint [mm or rad, by `t`].
pub(super) type Rates = [(f64, f64); MOST_JOINTS];

/// The way of all joints along a segment, over `t` from 0 to 1.
#[derive(Clone, Debug)]
pub(super) struct Way<'a> {
    axes: &'a Axes,
    way: JointWay<'a>,
}

impl<'a> Way<'a> {
    /// The way along a segment with a tool whose chain is given; `None` where the positions of the joints are not known.
    pub(super) fn new(
        segment: &'a Segment,
        axes: &'a Axes,
        chain: &Kinematics,
        part_on_table: &Rigid,
    ) -> Option<Way<'a>> {
        let way = match segment.turning {
            None => {
                let [a, b, c] = segment.rotary();
                let (matrix, shift) = axes.to_linear(chain, &axes.in_order([0.0, 0.0, 0.0, a, b, c]))?;
                let shift = matrix * part_on_table.translation + shift;
                JointWay::still(segment, matrix * part_on_table.rotation, shift)
            }
            Some(_) => JointWay::new(segment)?,
        };
        Some(Way { axes, way })
    }

    /// Positions of the joints [mm, rad].
    pub(super) fn at(&self, t: f64) -> JointValues {
        self.axes.in_order(self.way.at(t))
    }

    /// True while no rotary joint moves.
    pub(super) fn is_still(&self) -> bool {
        self.way.is_still()
    }

    /// True if bounds rest on derivatives at single places.
    pub(super) fn is_sampled(&self) -> bool {
        self.way.is_sampled()
    }

    /// True once a position was asked for that is not known.
    pub(super) fn is_lost(&self) -> bool {
        self.way.is_lost()
    }

    /// Bounds on speed and acceleration of the joints between two moments.
    pub(super) fn rates(&self, from: f64, to: f64) -> Rates {
        let mut rates = [(0.0, 0.0); MOST_JOINTS];
        let by_axis = self.way.rates(from, to);
        for (rate, axis) in rates.iter_mut().zip(self.axes.order()) {
            *rate = by_axis[*axis];
        }
        rates
    }
}
