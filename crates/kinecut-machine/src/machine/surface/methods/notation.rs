//! Motions of a process in one line: `v(B1)s(P2P3)`.
//!
//! B is a rotation (an arc), P a translation, numbered in order; linked motions share one pair of brackets; v is the
//! cutting motion, s a feed.

use crate::machine::Elementary;

/// Motions that move linked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// True for the cutting motion, false for a feed.
    pub cutting: bool,
    /// The motions, in the order of the chain.
    pub motions: Vec<Elementary>,
}

/// The motions of a process in one line; empty for none.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::{Elementary, surface::{Group, notation}};
/// let turning = [
///     Group { cutting: true, motions: vec![Elementary::C] },
///     Group { cutting: false, motions: vec![Elementary::X, Elementary::Z] },
/// ];
/// assert_eq!(notation(&turning), "v(B1)s(P2P3)");
/// ```
pub fn notation(groups: &[Group]) -> String {
    let mut text = String::new();
    let mut number = 0;
    for group in groups {
        text.push(if group.cutting { 'v' } else { 's' });
        text.push('(');
        for motion in &group.motions {
            number += 1;
            text += &format!("{}{number}", if motion.is_rotation() { 'B' } else { 'P' });
        }
        text.push(')');
    }
    text
}
