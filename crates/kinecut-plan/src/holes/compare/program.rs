//! A path as a program.

use std::collections::BTreeMap;

use crate::geom::{Curve, Line, Rigid};
use crate::program::{Blend, Frame, Move, Origin, Program, Setup, SetupId, Speed, State, WorkOffset};

/// The curves as moves at a feed [mm/s], after a rapid to their start; and the index of the first of them.
pub(super) fn program(curves: &[Curve], feed: f64, blend: Blend) -> (Program, u32) {
    at_feeds(curves.iter().map(|curve| (curve, feed)), blend)
}

/// The same with a feed for each curve.
pub(super) fn at_feeds<'a>(
    curves: impl Iterator<Item = (&'a Curve, f64)> + Clone,
    blend: Blend,
) -> (Program, u32) {
    let mut program = Program::new(vec![Setup {
        name: "hole".to_owned(),
        part_on_table: Rigid::IDENTITY,
        work_offsets: BTreeMap::from([(WorkOffset::G54, Rigid::IDENTITY)]),
        located: true,
        stock: None,
        fixtures: Vec::new(),
    }]);
    let frame = program.add_frame(Frame::Work(WorkOffset::G54));
    let mut state = State::start(SetupId(0), frame);
    state.speed = Speed::Rapid { linear: true };
    let start = curves.clone().next().map_or(glam::DVec3::ZERO, |(curve, _)| curve.start());
    program.push_move(Move::along(&Line { start, end: start }.into()), &state, Origin::default());
    let first = program.items.len() as u32;
    state.blend = blend;
    for (curve, feed) in curves {
        state.speed = Speed::PerMinute(feed);
        program.push_move(Move::along(curve), &state, Origin::default());
    }
    (program, first)
}
