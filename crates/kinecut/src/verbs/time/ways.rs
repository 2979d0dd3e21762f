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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::{Result, Silent};
    use crate::job::{GivenFile, ProgramWants, given_alone};
    use crate::machine::{CoordinateCode, Dynamics, Machine};
    use crate::verbs::time::time_of_program;

    #[test]
    fn the_way_is_the_distance_that_the_axes_have_gone() -> Result<()> {
        let dynamics = Dynamics { rapid: Some(500.0), acceleration: Some(5000.0), jerk: Some(50_000.0) };
        let machine = Machine::new(CoordinateCode::parse("2103").unwrap(), [None; 3], dynamics).unwrap();
        let wants = ProgramWants { machine: Some(machine), ..ProgramWants::default() };
        let bytes =
            b"G21 G90 G94 G61.1 G54\nT1 M6\nG43\nG0 X0 Y0 Z5\nG1 Z-1 F3000\nX30\nG4 P0.1\nY40\nG0 Z5\nM2\n";
        let given = given_alone(GivenFile { name: "slot.ngc", bytes }, &wants, false).unwrap();
        let timed = time_of_program(&given, &Silent)?;
        let mut ways = Ways::new(&timed.programs[0].0);
        assert!((ways.total() - (6.0 + 30.0 + 40.0 + 6.0)).abs() < 1e-9, "{}", ways.total());
        let (mut before, mut gone, mut last) = (None, 0.0, 0.0);
        timed.in_order(1e-3, "test", &Silent, &mut |one| {
            let at = [0, 1, 2].map(|a| one.sample.axes[a].position);
            // All moves are along one axis: steps add up to the way but for the corners between two samples.
            gone += before.map_or(0.0, |from: [f64; 3]| (0..3).map(|a| (at[a] - from[a]).abs()).sum::<f64>());
            before = Some(at);
            last = ways.at(one.sample);
            assert!((last - gone).abs() < 0.01, "{last} {gone} {:?}", one.sample);
            Ok(())
        })?;
        assert!((last - ways.total()).abs() < 1e-9, "{last}");
        Ok(())
    }
}
