//! Part, path and program as the 3-D view and the list read them: a small JSON head and packed streams of integers, so that a
//! million triangles and lines fit into a few megabytes of page.
//!
//! Numbers are counted in steps and written as columns of differences, see [`numbers`]; each stream is deflated and written
//! in base64. The reader is `viewer/src/decode.ts`.

mod bodies;
mod listing;
mod numbers;
mod part;
mod path;
mod playback;

use rayon::prelude::*;
use serde::Serialize;

use super::{PartView, PathRole, ProgramView, Report, thin};
use bodies::{FixtureHead, MachineHead};
use numbers::{Numbers, packed, steps};
use part::PartHead;
use path::PathHead;
use playback::PlaybackHead;

/// Most triangles shown; more would make a browser without a graphics card slow.
const TRIANGLES: usize = 300_000;
/// Coordinates are rounded to this share of the part's size (1 µm on a metre), below what a screen shows.
const POSITION_STEPS: f64 = (1u32 << 20) as f64;
/// Longest program whose text stands in the page as text [lines], and is printed: some ten pages in two columns.
const TEXT_LINES: usize = 1500;

/// Times [s] and lengths [mm] of lines are counted in this step.
const LINE_STEP: f64 = 1e-4;

/// Streams by element id, not yet packed.
type Streams = Vec<(&'static str, Vec<u8>)>;

/// Part, path and program of a report, packed for a viewer.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Sizes of all parts as JSON, not yet escaped for a page.
    pub head: String,
    /// Streams by name: integers, deflated without head, in base64.
    pub streams: Vec<(&'static str, String)>,
    /// Cell [mm] to which the mesh was thinned for the screen.
    pub thinned: Option<f64>,
}

#[derive(Serialize)]
struct Head<'a> {
    part: Option<PartHead>,
    playback: Option<PlaybackHead>,
    fixtures: Vec<FixtureHead<'a>>,
    machine: Option<MachineHead<'a>>,
    path: PathHead,
    tools: Vec<ToolHead>,
    roles: [&'static str; PathRole::ALL.len()],
    lines: usize,
    line_step: f64,
    /// Of programs whose text is packed: file, first line and the line after the last.
    listing: Vec<(std::borrow::Cow<'a, str>, usize, usize)>,
}

#[derive(Serialize)]
struct ToolHead {
    number: u32,
    outline: Vec<[f32; 2]>,
    flutes: f64,
}

/// Whether the text of a program is packed: one that is long, for which text would be most of the page.
pub(super) fn packs_text(program: &ProgramView) -> bool {
    program.lines.len() > TEXT_LINES
}

/// Packs what a viewer needs of a report.
///
/// ```
/// use kinecut::job::Judgement;
/// use kinecut::job::report::{PathPiece, PathRole, Report, ReportVerdict, scene};
/// let mut report = Report::new("t", ReportVerdict::new(Judgement::Safe, ""));
/// report.path.push(PathPiece::new(0, PathRole::Rapid, vec![[0.0; 3], [10.0, 0.0, 0.0]]));
/// let scene = scene(&report);
/// assert!(scene.head.contains("\"pieces\":1") && scene.streams.iter().any(|s| s.0 == "kc-path"));
/// ```
pub fn scene(report: &Report) -> Scene {
    let ((thinned, part, mut streams), (path, others)) =
        rayon::join(|| shown_part(report), || path_and_program(report));
    streams.extend(others);
    let fixtures = bodies::fixtures(&report.fixtures, &mut streams);
    let machine = report.machine.as_ref().map(|machine| bodies::machine(machine, &mut streams));
    let playback = report.playback.as_ref().map(|played| playback::stream(played, &mut streams));
    let program = report.program.as_ref();
    let listed = program.filter(|p| packs_text(p)).map(ProgramView::programs).unwrap_or_default();
    let listing = listed.into_iter().map(|(file, from, to)| (crate::page::visible(file), from, to)).collect();
    let tools = report
        .tools
        .iter()
        .map(|t| ToolHead { number: t.number, outline: finite(t.drawn_outline()), flutes: t.flute_length })
        .collect();
    let lines = program.map_or(0, |p| p.lines.len());
    let head = Head {
        part,
        playback,
        fixtures,
        machine,
        path,
        tools,
        roles: PathRole::ALL.map(PathRole::word),
        lines,
        line_step: LINE_STEP,
        listing,
    };
    // Plain numbers and strings always serialise; an empty head makes the viewer say that there is nothing to show.
    let head = serde_json::to_string(&head).unwrap_or_default();
    Scene { head, streams: streams.par_iter().map(|(id, bytes)| (*id, packed(bytes))).collect(), thinned }
}

/// Corners [mm] and triangles of one body, as those of fixtures are packed.
pub(crate) fn packed_body(body: &super::BodyView) -> String {
    packed(&bodies::numbers(std::iter::once(body)).0)
}

fn shown_part(report: &Report) -> (Option<f64>, Option<PartHead>, Streams) {
    let Some(part) = &report.part else { return Default::default() };
    let mut streams = Streams::default();
    let thin = thin::thinned(part, TRIANGLES);
    let head = part::streams(thin.as_ref().map_or(part, |t| &t.0), &mut streams);
    (thin.map(|t| t.1), Some(head), streams)
}

fn path_and_program(report: &Report) -> (PathHead, Streams) {
    let path = || {
        let mut streams = Streams::default();
        (
            path::stream(&report.path, report.machine.as_ref().map_or(0, |m| m.joints.len()), &mut streams),
            streams,
        )
    };
    let program = || {
        let mut streams = Streams::default();
        if let Some(program) = &report.program {
            streams.push(("kc-times", of_lines(&program.time)));
            streams.push(("kc-lengths", of_lines(&program.length)));
            if packs_text(program) {
                listing::streams(&program.lines, &mut streams);
            }
        }
        streams
    };
    let ((path, mut streams), others) = rayon::join(path, program);
    streams.extend(others);
    (path, streams)
}

fn finite(outline: Vec<[f32; 2]>) -> Vec<[f32; 2]> {
    outline.into_iter().filter(|p| p.iter().all(|v| v.is_finite())).collect()
}

/// Numbers that are not negative, in steps of [`LINE_STEP`], with their count before them; what is not finite counts as 0. Their sums
/// are rounded, so that a hundred thousand of them add up.
fn of_lines(values: &[f32]) -> Vec<u8> {
    let (mut sum, mut before) = (0.0, 0);
    let ends = values.iter().map(|&v| {
        sum += if v.is_finite() { f64::from(v).max(0.0) } else { 0.0 };
        let end = steps(sum, LINE_STEP);
        end - std::mem::replace(&mut before, end)
    });
    let column: Vec<i64> = ends.collect();
    let mut stream = Numbers::default();
    stream.unsigned(values.len() as u64);
    stream.column(&column);
    stream.0
}

#[cfg(test)]
mod tests {
    use super::numbers::tests::{Reader, unpacked};
    use super::*;
    use crate::job::report::ReportVerdict;

    pub(super) fn report() -> Report {
        Report::new("t", ReportVerdict::new(crate::job::Judgement::Safe, ""))
    }

    pub(super) fn stream(scene: &Scene, id: &str) -> Vec<u8> {
        unpacked(&scene.streams.iter().find(|s| s.0 == id).unwrap().1)
    }

    #[test]
    fn times_of_lines_come_back_and_add_up() {
        let mut report = report();
        let time = [vec![0.5, f32::NAN, -1.0, 1e-4], vec![0.006_94; 10_000]].concat();
        report.program = Some(ProgramView { time, ..ProgramView::default() });
        let mut times = Reader::of(stream(&scene(&report), "kc-times"));
        let count = times.unsigned() as usize;
        let times = times.column(count);
        assert_eq!(times[..4], [5000, 0, 0, 1]);
        assert!(times[4..].iter().all(|t| *t == 69 || *t == 70));
        assert!((times.iter().sum::<i128>() - 699_001).abs() <= 1);
    }

    #[test]
    fn only_a_long_program_is_packed() {
        let mut report = report();
        let mut head = |lines: usize| {
            let lines = vec!["G1 X1".to_owned(); lines];
            report.program =
                Some(ProgramView { file: "a\u{1b}.nc".to_owned(), lines, ..ProgramView::default() });
            let scene = scene(&report);
            let head: serde_json::Value = serde_json::from_str(&scene.head).unwrap();
            assert_eq!(scene.streams.iter().any(|s| s.0 == "kc-numbers"), !head["listing"][0].is_null());
            head["listing"].clone()
        };
        assert_eq!(head(TEXT_LINES), serde_json::json!([]));
        assert_eq!(head(TEXT_LINES + 1), serde_json::json!([["a␛.nc", 0, TEXT_LINES + 1]]));
    }
}
