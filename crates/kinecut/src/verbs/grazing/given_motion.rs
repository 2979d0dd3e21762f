//! A motion at one moment with what is known of it.

use serde::Serialize;

use crate::geom::Rigid;
use crate::machine::Twist;
use crate::tool::Contour;

/// Source of a motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MotionSource {
    /// Given as a twist.
    Twist,
    /// From a pose and its rate.
    Pose(#[serde(serialize_with = "super::json::pose")] Rigid),
    /// A moment of a program.
    #[serde(untagged)]
    Moment {
        /// The block.
        block: String,
        /// Line, from 1.
        line: u32,
        /// Part of the way.
        part: f64,
        /// Tool to part; X of the tool is where the feed goes.
        #[serde(serialize_with = "super::json::pose")]
        pose: Rigid,
        /// Name of the program.
        program: String,
    },
}

/// A motion, and the tool where the program names it.
pub(crate) struct GivenMotion {
    pub(crate) twist: Twist,
    pub(crate) source: MotionSource,
    pub(crate) tool: Option<(String, Contour)>,
}
