//! Ways in which controls run along a path.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Limits that a control keeps along a path, and its way of passing the joint of two moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolator {
    /// Velocity, acceleration and jerk of each axis are held; joints of moves are smoothed within the tolerance.
    JerkLimited,
    /// Velocity and acceleration of each axis are held, the jerk is not limited; corners as the tolerance allows.
    Trapezoid,
    /// As jerk-limited, with a stop at the end of every block.
    ExactStop,
    /// As Grbl: at a joint v^2 = a d sin(h/2) / (1 - sin(h/2)), with the acceleration a, the junction deviation d, and the
    /// angle h that the two moves enclose (half a turn where they go straight on).
    JunctionDeviation,
    /// As LinuxCNC's trajectory planner as it comes, without S-curves: arcs in corners, and no limit of jerk.
    #[serde(rename = "linuxcnc")]
    LinuxCnc,
}
