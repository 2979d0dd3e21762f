//! Way of the tip from the start of a program.

use super::moving::MovingProgram;
use crate::motion::MotionSample;

/// Way of the tip at the samples of a program: the moves before, and the integral of the feed within one.
pub(super) struct Ways {
    /// Way before each segment, and at the end [mm].
    before: Vec<f64>,
    /// Time, feed and way of the sample before [s, mm/s, mm], with its segment.
    last: Option<(u32, [f64; 3])>,
}

impl Ways {
    pub(super) fn new(program: &MovingProgram) -> Ways {
        let mut way = 0.0;
        let mut before = vec![way];
        for segment in &program.trace.segments {
            if !segment.alternative {
                way += segment.curve.length();
            }
            before.push(way);
        }
        Ways { before, last: None }
    }

    /// Way of all moves [mm].
    pub(super) fn total(&self) -> f64 {
        self.before.last().copied().unwrap_or(0.0)
    }

    /// Way at the next sample [mm].
    pub(super) fn at(&mut self, sample: &MotionSample) -> f64 {
        let Some(segment) = sample.segment else {
            return self.last.map_or(0.0, |(segment, _)| self.before[segment as usize + 1]);
        };
        let [start, end] = [0, 1].map(|i| self.before[segment as usize + i]);
        let way = match self.last {
            Some((of, [time, feed, way])) if of == segment => {
                way + 0.5 * (feed + sample.feed) * (sample.time - time)
            }
            _ => start,
        };
        let way = way.clamp(start, end);
        self.last = Some((segment, [sample.time, sample.feed, way]));
        way
    }
}
