//! A joint of two moves that the control smooths.

/// A joint that the control smooths: there the tool leaves the programmed path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothedJoint {
    /// Index of the program item that begins there.
    pub item: u32,
    /// Distance from the programmed path [mm]: the largest at the joint and at quarters of its smoothing, of linear axes.
    pub off: f64,
    /// Angle by which the linear axes turn there [rad].
    pub corner: f64,
}

/// Joints that are listed.
const LISTED: usize = 10;

impl SmoothedJoint {
    /// Those of a list that are farthest off the path, up to ten, the farthest first; the earlier one where two are as far.
    pub(super) fn farthest(mut joints: Vec<SmoothedJoint>) -> Vec<SmoothedJoint> {
        joints.sort_by(|a, b| b.off.total_cmp(&a.off).then(a.item.cmp(&b.item)));
        joints.truncate(LISTED);
        joints
    }
}
