//! The path: lines, roles, tools, axes and numbers of points of its pieces, then its points, column by column.

use serde::Serialize;

use super::numbers::{Numbers, steps};
use super::{POSITION_STEPS, Streams};
use crate::job::report::{PathPiece, PathRole};
use crate::page::simplify;

/// The path is shown with this error as a share of its size.
const PATH_ERROR: f64 = 1.0 / 40_000.0;
/// Axes are rounded to this share of their length: 1.5 µm at 200 mm.
const AXIS_STEPS: f64 = (1u32 << 17) as f64;
/// The way is rounded to this part of it.
const DONE: f64 = 1.0 / (1u32 << 20) as f64;
/// Positions of axes are rounded to this [mm or rad].
const JOINT: f64 = 1e-5;
/// Ends of runs are rounded to this part of their piece.
const RUN: f64 = 1.0 / 4096.0;

#[derive(Serialize)]
pub(super) struct PathHead {
    pieces: usize,
    points: usize,
    step: f64,
    axes: usize,
    axis_step: f64,
    done_step: f64,
    runs: usize,
    run_step: f64,
    joint_step: f64,
}

/// Columns of the pieces and of their points.
#[derive(Default)]
struct Columns {
    line: Vec<i64>,
    role: Vec<i64>,
    tool: Vec<i64>,
    axis: Vec<i64>,
    /// Twice the number of points that come with the piece, one more where it begins at the end of the piece before.
    count: Vec<i64>,
    points: [Vec<i64>; 3],
    axes: [Vec<i64>; 3],
    /// Part of the way that is done at the end of each piece, in steps of [`DONE`].
    done: Vec<i64>,
    /// Number of runs of engagement in each piece; their ends in steps of [`RUN`], arcs [degrees], and one more than the greatest thickness of a
    /// chip [µm], 0 where it is not known.
    runs: Vec<i64>,
    run_end: Vec<i64>,
    arc: Vec<i64>,
    chip: Vec<i64>,
    /// By joint: its position at each point, in steps of [`JOINT`].
    joints: Vec<Vec<i64>>,
}

/// The path; with `joints` positions of axes at each point.
pub(super) fn stream(path: &[PathPiece], joints: usize, streams: &mut Streams) -> PathHead {
    let extent = extent(path);
    let step = extent / POSITION_STEPS;
    let columns = columns(path, joints, extent * PATH_ERROR, step);
    let mut stream = Numbers::default();
    let pieces = [&columns.line, &columns.role, &columns.tool, &columns.axis, &columns.count];
    let all = pieces.into_iter().chain(&columns.points).chain(&columns.axes).chain([
        &columns.done,
        &columns.runs,
        &columns.run_end,
        &columns.arc,
        &columns.chip,
    ]);
    all.chain(&columns.joints).for_each(|column| stream.column(column));
    streams.push(("kc-path", stream.0));
    PathHead {
        pieces: columns.line.len(),
        points: columns.points[0].len(),
        step,
        axes: columns.axes[0].len(),
        axis_step: 1.0 / AXIS_STEPS,
        done_step: DONE,
        runs: columns.arc.len(),
        run_step: RUN,
        joint_step: JOINT,
    }
}

fn columns(path: &[PathPiece], joints: usize, error: f64, step: f64) -> Columns {
    let mut columns = Columns { joints: vec![Vec::new(); joints], ..Columns::default() };
    let (mut last, mut last_axis) = (None, None);
    let mut points: Vec<[f64; 3]> = Vec::new();
    for piece in path {
        points.clear();
        points.extend(piece.points.iter().filter(is_finite).map(|p| p.map(f64::from)));
        if points.is_empty() {
            continue;
        }
        columns.line.push(i64::from(piece.block));
        columns.role.push(PathRole::ALL.iter().position(|r| *r == piece.role).unwrap_or(0) as i64);
        columns.tool.push(i64::from(piece.tool));
        let axis = if is_finite(&&piece.axis) { piece.axis } else { [0.0, 0.0, 1.0] };
        if last_axis != Some(axis) {
            last_axis = Some(axis);
            for k in 0..3 {
                columns.axes[k].push(steps(f64::from(axis[k]), 1.0 / AXIS_STEPS));
            }
        }
        columns.axis.push(columns.axes[0].len() as i64 - 1);
        columns.done.push(steps(f64::from(piece.done), DONE));
        columns.runs.push(piece.engaged.len() as i64);
        for run in &piece.engaged {
            columns.run_end.push(steps(f64::from(run.to), RUN));
            columns.arc.push(steps(f64::from(run.arc), 1.0));
            columns.chip.push(run.chip.map_or(0, |mm| 1 + steps(f64::from(mm), 1e-3)));
        }
        let kept = simplify::kept(&points, error);
        let at = |i: usize| points[i].map(|v| steps(v, step));
        let joined = last == Some(at(kept[0]));
        columns.count.push(2 * (kept.len() as i64 - i64::from(joined)) + i64::from(joined));
        for &i in &kept[usize::from(joined)..] {
            let point = at(i);
            (0..3).for_each(|k| columns.points[k].push(point[k]));
            // Of a path with positions of axes all points are finite.
            for (k, column) in columns.joints.iter_mut().enumerate() {
                let position = piece.joints.get(i * joints + k).copied().unwrap_or(0.0);
                column.push(steps(f64::from(position), JOINT));
            }
            last = Some(point);
        }
    }
    columns
}

fn is_finite(point: &&[f32; 3]) -> bool {
    point.iter().all(|v| v.is_finite())
}

/// Greatest difference of two coordinates [mm]; 1 for a path without extent.
fn extent(path: &[PathPiece]) -> f64 {
    let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
    for &v in path.iter().flat_map(|p| &p.points).filter(is_finite).flatten() {
        (lo, hi) = (lo.min(f64::from(v)), hi.max(f64::from(v)));
    }
    let extent = hi - lo;
    if extent.is_finite() && extent > 0.0 { extent } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::super::numbers::tests::Reader;
    use super::super::tests::{report, stream};
    use super::*;
    use crate::job::report::{EngagedRun, JointView, MachineView};

    #[test]
    fn a_path_comes_back_with_lines_roles_and_axes() {
        let mut report = report();
        let tilted = |block, from: f32| {
            let points = vec![[99.0, 0.0, from], [99.0, 0.0, from + 0.25], [99.0, f32::NAN, 1.0]];
            let mut piece = PathPiece::new(block, PathRole::Finish, points);
            (piece.axis, piece.tool) = ([0.6, 0.0, 0.8], 4);
            piece
        };
        let run = |to, arc, chip| EngagedRun { to, arc, chip };
        let straight = (0..100).map(|i| [i as f32, 0.0, 0.0]).collect();
        report.path = vec![
            PathPiece::new(9, PathRole::Rapid, straight),
            PathPiece::new(1, PathRole::Link, Vec::new()),
            PathPiece { done: 0.5, ..tilted(3, 0.0) },
            PathPiece {
                done: 1.0,
                engaged: vec![run(0.25, 0.0, None), run(1.0, 93.4, Some(0.04))],
                ..tilted(7, 5.0)
            },
        ];
        let scene = super::super::scene(&report);
        let head: serde_json::Value = serde_json::from_str(&scene.head).unwrap();
        let head = &head["path"];
        let number = |key: &str| head[key].as_u64().unwrap() as usize;
        assert_eq!((number("pieces"), number("points"), number("axes")), (3, 5, 2));
        let mut read = Reader::of(stream(&scene, "kc-path"));
        let role = |r| PathRole::ALL.iter().position(|x| *x == r).unwrap() as i128;
        assert_eq!(read.column(3), [9, 3, 7]);
        assert_eq!(read.column(3), [role(PathRole::Rapid), role(PathRole::Finish), role(PathRole::Finish)]);
        assert_eq!(read.column(3), [0, 4, 4]);
        assert_eq!(read.column(3), [0, 1, 1]);
        assert_eq!(
            read.column(3),
            [4, 3, 4],
            "a straight line needs two points, what goes on from it one more"
        );
        let step = head["step"].as_f64().unwrap();
        for want in [[0.0, 99.0, 99.0, 99.0, 99.0], [0.0; 5], [0.0, 0.0, 0.25, 5.0, 5.25]] {
            for (n, want) in read.column(5).into_iter().zip(want) {
                assert!((n as f64 * step - want).abs() <= step);
            }
        }
        let axis_step = head["axis_step"].as_f64().unwrap();
        for want in [[0.0, 0.6], [0.0, 0.0], [1.0, 0.8]] {
            for (n, want) in read.column(2).into_iter().zip(want) {
                assert!((n as f64 * axis_step - want).abs() <= axis_step);
            }
        }
        assert_eq!(read.column(3), [0, 1 << 19, 1 << 20]);
        assert_eq!(read.column(3), [0, 0, 2]);
        assert_eq!(read.column(2), [1024, 4096]);
        assert_eq!(read.column(2), [0, 93]);
        assert_eq!(read.column(2), [0, 41]);
        assert!(read.is_done());
    }

    #[test]
    fn positions_of_the_axes_come_with_the_points_that_are_kept() {
        let mut report = report();
        report.machine =
            Some(MachineView { joints: vec![JointView::default(); 2], ..MachineView::default() });
        let piece = |block, from: f32| {
            let points = [0.0, 1.0, 2.0].map(|x| [from + x, 0.0, 0.0]).to_vec();
            let joints = points.iter().flat_map(|p| [10.0 - p[0], 0.125]).collect();
            PathPiece { joints, ..PathPiece::new(block, PathRole::Feed, points) }
        };
        report.path = vec![piece(1, 0.0), piece(2, 2.0)];
        let scene = super::super::scene(&report);
        let head: serde_json::Value = serde_json::from_str(&scene.head).unwrap();
        assert_eq!(head["path"]["points"], 3, "the second piece goes on from the first");
        let mut read = Reader::of(stream(&scene, "kc-path"));
        // Lines, roles, tools, axes, counts; x, y, z; one axis; done, runs, and none of them.
        (0..5).for_each(|_| drop(read.column(2)));
        (0..3).for_each(|_| drop(read.column(3)));
        (0..3).for_each(|_| drop(read.column(1)));
        (0..2).for_each(|_| drop(read.column(2)));
        (0..3).for_each(|_| drop(read.column(0)));
        assert_eq!(read.column(3), [1_000_000, 800_000, 600_000]);
        assert_eq!(read.column(3), [12_500; 3]);
        assert!(read.is_done());
    }
}
