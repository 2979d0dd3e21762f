//! The programs of a job as its report shows them: text, times and path.

use super::model::{ProgramPart, ProgramView};
use super::{PathPiece, PathRole, machine};
use crate::job::SetupOutcome;
use crate::job::check::Job;
use crate::program::Role;
use crate::trace::{Segment, SegmentPace};

/// Largest distance of the drawn path from the true one [mm].
const DRAWN_CHORD: f64 = 0.02;

/// The programs of all setups, one after the other.
pub(super) struct Programs {
    /// Their text, with the time and the length of each line.
    pub(super) view: ProgramView,
    /// The first line of each.
    pub(super) first_lines: Vec<u32>,
    /// For each line the time at which it begins [s], and last the time of all.
    pub(super) begins: Vec<f64>,
    /// The path; empty unless it is for a page.
    pub(super) path: Vec<PathPiece>,
}

impl Programs {
    /// Those of a job; without a `page` lines have no text, and there is no path. `more` completes the piece of path of a setup's
    /// segment, whose index comes with it.
    pub(super) fn of(
        job: &Job,
        setups: &[SetupOutcome],
        page: bool,
        mut more: impl FnMut(usize, usize, &Segment, &mut PathPiece),
    ) -> Programs {
        let mut controls: Vec<&str> = setups.iter().map(|s| s.control(job).name()).collect();
        controls.dedup();
        let mut view = ProgramView { control: controls.join(", "), ..ProgramView::default() };
        let mut first_lines = Vec::with_capacity(setups.len());
        let mut all = Vec::new();
        for (number, setup) in setups.iter().enumerate() {
            let offset = view.lines.len() as u32;
            first_lines.push(offset);
            if setups.len() > 1 {
                view.parts.push(ProgramPart { file: setup.file.clone(), first: offset });
            }
            let shown = |line: &str| if page { line.to_owned() } else { String::new() };
            view.lines.extend(setup.posted.text.lines().map(shown));
            view.time.resize(view.lines.len(), 0.0);
            view.length.resize(view.lines.len(), 0.0);
            times(setup, offset, &mut view);
            if page {
                path(job, (setup, offset), &mut all, &mut |index, segment, piece| {
                    more(number, index, segment, piece);
                });
            }
        }
        view.file = setups.iter().map(|s| s.file.as_str()).collect::<Vec<_>>().join(", ");
        Programs { begins: sums(&view.time), view, first_lines, path: all }
    }

    /// Number of lines.
    pub(super) fn lines(&self) -> u32 {
        self.view.lines.len() as u32
    }
}

/// For each line the time at which it begins [s], and last the time of all.
fn sums(times: &[f32]) -> Vec<f64> {
    let mut sum = 0.0;
    let ends = times.iter().map(|t| {
        sum += f64::from(*t);
        sum
    });
    std::iter::once(0.0).chain(ends).collect()
}

/// The segments of a setup's program with the line of the report, counted from `offset`, that each belongs to, and the time
/// of each [s].
fn on_lines(setup: &SetupOutcome, offset: u32) -> impl Iterator<Item = (u32, usize, &Segment, f64)> {
    let all = setup.trace.segments.iter().zip(setup.segment_times()).enumerate();
    all.filter(|(_, (s, _))| !s.alternative).filter_map(move |(index, (segment, time))| {
        let line = setup.lines.get(segment.item as usize).copied().flatten()?;
        Some((line + offset, index, segment, time))
    })
}

fn times(setup: &SetupOutcome, offset: u32, view: &mut ProgramView) {
    for (block, _, segment, time) in on_lines(setup, offset) {
        view.time[block as usize] += time as f32;
        view.length[block as usize] += segment.curve.length() as f32;
    }
}

/// The path of a setup's program.
fn path(
    job: &Job,
    (setup, offset): (&SetupOutcome, u32),
    path: &mut Vec<PathPiece>,
    more: &mut impl FnMut(usize, &Segment, &mut PathPiece),
) {
    for (block, index, segment, _) in on_lines(setup, offset) {
        let planned = setup.planned_item(segment.item).map(|i| setup.planned.program.origin(i as usize).role);
        let role = match (segment.motion, planned.unwrap_or_default()) {
            (SegmentPace::Rapid, _) => PathRole::Rapid,
            (_, Role::Lead) => PathRole::Lead,
            (_, Role::Rough) => PathRole::Rough,
            (_, Role::Finish) => PathRole::Finish,
            // Of a program that others wrote it is not known what a feed move is for.
            (_, Role::Link) if setup.external.is_some() => PathRole::Feed,
            (_, Role::Link) => PathRole::Link,
        };
        let points = segment.curve.polyline(DRAWN_CHORD).iter().map(|p| p.as_vec3().to_array()).collect();
        let mut piece = PathPiece::new(block, role, points);
        piece.tool = job.tools.iter().position(|t| Some(t.number) == segment.tool).unwrap_or(0) as u32;
        piece.axis = segment.axis.as_vec3().to_array();
        more(index, segment, &mut piece);
        if let Some(machine) = job.machine.as_ref().filter(|machine| !machine.bodies.is_empty()) {
            piece.joints = machine::joints(machine, segment, &piece.points);
        }
        path.push(piece);
    }
}
