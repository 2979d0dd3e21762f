//! Traces of programs so long that their segments are looked at once and not kept.

use super::follow::{Follow, TraceOptions, followed};
use super::{Segment, Trace};
use crate::base::Result;
use crate::program::Program;

/// Takes segments as they come.
pub type Taker<'t> = dyn FnMut(&[Segment]) + 't;

/// Segments that are handed over together: few enough to stay in a cache.
pub(super) const TOGETHER: usize = 256;

/// As [`trace`](super::trace), of a program so long that its segments are not to be kept: they are handed over in their
/// order, some at a time, and the trace has none.
///
/// # Errors
/// Those of [`trace`](super::trace); what was handed over before is not the whole then.
pub fn trace_passing(program: &Program, options: &TraceOptions<'_>, each: &mut Taker<'_>) -> Result<Trace> {
    followed(program, options, Some(each))
}

impl Follow<'_> {
    /// Hands over the segments so far, but for the last that a rest of the tool or the next segment may look back to.
    pub(super) fn pass_on(&mut self, each: &mut Taker<'_>) {
        let segments = &mut self.trace.segments;
        let kept = segments.iter().rposition(|s| !s.alternative).unwrap_or(0);
        each(&segments[..kept]);
        segments.drain(..kept);
        self.passed += kept;
    }
}

#[cfg(test)]
mod tests {
    use super::super::{CompStart, RegisterState, trace};
    use super::*;
    use crate::base::Sources;
    use crate::geom::Rigid;
    use crate::nc::{Control, read};
    use crate::program::{Setup, WorkOffset};

    fn setup() -> Setup {
        Setup {
            name: "setup 1".to_owned(),
            part_on_table: Rigid::from_translation(glam::DVec3::new(1.0, 2.0, 3.0)),
            work_offsets: [(WorkOffset::G54, Rigid::IDENTITY)].into(),
            located: false,
            stock: None,
            fixtures: Vec::new(),
        }
    }

    #[test]
    fn what_is_handed_over_is_what_is_kept() {
        // Rapids with their other ways, waits, a contour under compensation longer than what is handed over together.
        let mut text = "G21 G17 G90 G94 G54 G64\nG0 X0 Y0 Z5\nG1 Z-1 F300\n".to_owned();
        let zigzag = |i: u32| format!("X{} Y{}.5\n", i, i % 13 * 7);
        text.extend((0..700).map(zigzag));
        text.extend((0..40).map(|i| format!("G0 X{} Y{} Z{}\nG4 P0.5\n", i % 3, i % 5, i % 2)));
        text += "G0 X0 Y0\nG1 G41 D1 X10 Y0\nG4 P1\n";
        text.extend((1..400).map(|i| format!("G1 X{}\n", 10 + i)));
        text += "G4 P2\nG1 G40 Y-9\nG4 P3\nM2\n";
        let read = read(&mut Sources::default(), "a.ngc", &text, Control::LinuxCnc, &[setup()]).unwrap();
        let options = TraceOptions {
            machine: None,
            tools: &[],
            retract_height: 0.0,
            radii: &[(1, 2.0)],
            operator: RegisterState::default(),
            comp_start: CompStart::default(),
            chord: 1e-3,
        };
        let kept = trace(&read.program, &options).unwrap();
        let (mut segments, mut most) = (Vec::new(), 0);
        let passed = trace_passing(&read.program, &options, &mut |some: &[Segment]| {
            segments.extend_from_slice(some);
            most = most.max(some.len());
        })
        .unwrap();
        assert_eq!(segments, kept.segments);
        assert!(segments.len() > 1100 && most < 2 * TOGETHER + 400 && passed.segments.is_empty());
        assert_eq!(passed.stands, kept.stands);
        assert_eq!((passed.assumed, passed.dwells), (kept.assumed, kept.dwells));
        assert_eq!(passed.untraced, kept.untraced);
    }

    #[test]
    fn a_segment_stays_small() {
        // A million of them are kept where a time law is found.
        assert!(size_of::<Segment>() <= 168, "{} bytes", size_of::<Segment>());
    }
}
