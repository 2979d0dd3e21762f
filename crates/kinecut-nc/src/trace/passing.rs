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
    use super::*;

    #[test]
    fn a_segment_stays_small() {
        // A million of them are kept where a time law is found.
        assert!(size_of::<Segment>() <= 168, "{} bytes", size_of::<Segment>());
    }
}
