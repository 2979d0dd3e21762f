//! Counts, way, time and range of a motion, summed over its segments as they come.

use crate::geom::{Aabb, Rigid};
use crate::trace::{Segment, SegmentPace};

/// Sums over segments; mm, s.
#[derive(Clone, Debug)]
pub(crate) struct MotionSums {
    /// Maps part coordinates into those of the range.
    to_range: Rigid,
    /// Moves at feed, and rapids.
    pub(crate) feed_moves: usize,
    pub(crate) rapid_moves: usize,
    /// Way at feed.
    pub(crate) feed_length: f64,
    /// Time at the programmed speeds, and whether all segments have one.
    pub(crate) time: f64,
    pub(crate) is_timed: bool,
    /// Range of the tip at feed.
    pub(crate) range: Option<Aabb>,
}

impl MotionSums {
    /// Of nothing; `to_range` maps part coordinates into those of the range.
    pub(crate) fn new(to_range: Rigid) -> MotionSums {
        MotionSums {
            to_range,
            feed_moves: 0,
            rapid_moves: 0,
            feed_length: 0.0,
            // As a sum of no numbers.
            time: -0.0,
            is_timed: true,
            range: None,
        }
    }

    /// Adds the next segments.
    pub(crate) fn add(&mut self, segments: &[Segment]) {
        for segment in segments {
            let feed = segment.motion != SegmentPace::Rapid;
            if feed {
                let own = segment.curve.moved(&self.to_range).bounds();
                self.range = Some(match &self.range {
                    None => own,
                    Some(all) => Aabb { min: all.min.min(own.min), max: all.max.max(own.max) },
                });
            }
            if segment.alternative {
                continue;
            }
            match segment.duration {
                Some(seconds) => self.time += seconds,
                None => self.is_timed = false,
            }
            if feed {
                self.feed_moves += 1;
                self.feed_length += segment.curve.length();
            } else {
                self.rapid_moves += 1;
            }
        }
    }
}
