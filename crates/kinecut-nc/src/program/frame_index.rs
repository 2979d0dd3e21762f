//! Frames of a program found by value, so that many of them cost no search through all.

use std::collections::HashMap;

use glam::{DMat3, DVec3};

use super::{Frame, RotarySolution};
use crate::geom::Rigid;

/// A frame as bits: equal for equal frames.
type Key = ([u64; 3], [u64; 12]);

/// Index of each frame in the list of a program; the first of equal ones.
#[derive(Clone, Debug, Default)]
pub(super) struct FrameIndex {
    of: HashMap<Key, u32>,
    /// Frames of the list that were looked at.
    known: usize,
}

impl FrameIndex {
    /// The place of a frame in the list, to which it is added when it is not there.
    pub(super) fn place(&mut self, frames: &mut Vec<Frame>, frame: Frame) -> u32 {
        if self.known > frames.len() {
            // Another list: it was replaced by a shorter one.
            *self = FrameIndex::default();
        }
        for (i, known) in frames.iter().enumerate().skip(self.known) {
            self.of.entry(key(known)).or_insert(i as u32);
        }
        self.known = frames.len();
        let found = self.of.get(&key(&frame)).copied();
        // Of a list that was replaced by a longer one an entry may be stale.
        if let Some(i) = found.filter(|&i| frames.get(i as usize) == Some(&frame)) {
            return i;
        }
        let i = frames.len() as u32;
        frames.push(frame);
        self.of.insert(key(&frame), i);
        self.known += 1;
        i
    }
}

fn key(frame: &Frame) -> Key {
    let still = Rigid::IDENTITY;
    let (head, motion) = match frame {
        Frame::Machine => ([0, 0, 0], &still),
        Frame::Work(offset) => ([1, u64::from(offset.tenths()), 0], &still),
        Frame::Shift { parent, motion } => ([2, u64::from(parent.0), 0], motion),
        Frame::Tilted { parent, motion, branch } => {
            let branch = match branch {
                RotarySolution::Free => 0,
                RotarySolution::Positive => 1,
                RotarySolution::Negative => 2,
            };
            ([3, u64::from(parent.0), branch], motion)
        }
    };
    // Adding zero makes one of the two zeros.
    let bits = |v: DVec3| v.to_array().map(|v| (v + 0.0).to_bits());
    let DMat3 { x_axis, y_axis, z_axis } = motion.rotation;
    let [x, y, z, t] = [x_axis, y_axis, z_axis, motion.translation].map(bits);
    let mut all = [0; 12];
    for (to, from) in all.iter_mut().zip([x, y, z, t].concat()) {
        *to = from;
    }
    (head, all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{FrameId, WorkOffset};

    #[test]
    fn a_frame_is_found_again_also_in_a_list_that_was_replaced() {
        let shift = |x: f64| Frame::Shift {
            parent: FrameId(0),
            motion: Rigid::from_translation(DVec3::new(x, -0.0, 0.0)),
        };
        let mut index = FrameIndex::default();
        let mut frames = Vec::new();
        assert_eq!(index.place(&mut frames, Frame::Work(WorkOffset::G54)), 0);
        let begin = std::time::Instant::now();
        for x in 0..50_000u32 {
            assert_eq!(index.place(&mut frames, shift(f64::from(x))), x + 1);
        }
        assert_eq!(index.place(&mut frames, shift(7.0)), 8);
        // Searching through all takes minutes.
        assert!(begin.elapsed().as_secs() < 20);
        let mut other = vec![Frame::Machine, shift(3.0)];
        assert_eq!(index.place(&mut other, shift(3.0)), 1);
        assert_eq!(index.place(&mut other, shift(4.0)), 2);
        let mut longer = vec![shift(9.0), shift(4.0), shift(3.0), shift(2.0)];
        assert_eq!(index.place(&mut longer, shift(5.0)), 4);
        assert_eq!(index.place(&mut longer, shift(5.0)), 4);
    }
}
