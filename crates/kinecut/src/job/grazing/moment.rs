//! A moment of a move of a job's program: the program on the job's machine is followed, and the pose of the tool with its
//! derivative by arc length and the speed make the twist.

use std::path::Path;

use glam::{DMat3, DVec3};

use super::motion::{MotionSource, Moving};
use crate::base::{Code, Finding, Loader, Result, Silent, Sources};
use crate::geom::Rigid;
use crate::job::file::MomentTable;
use crate::job::{JobText, check, plan, run};
use crate::machine::Twist;
use crate::nc;
use crate::sweep::twist_of;
use crate::tool::Contour;
use crate::trace::{Motion, Segment, trace};

/// Speed of a move whose own is not known [mm/s]: the curve does not depend on it.
const UNKNOWN_SPEED: f64 = 1.0;

pub(super) fn moment(table: &MomentTable, with_tool: bool, loader: &dyn Loader) -> Result<Moving> {
    let part = table.part.unwrap_or(0.5);
    if !(0.0..=1.0).contains(&part) {
        return Err(Finding::error(Code::JOB_VALUE, "the part of the way is not within the move")
            .value(part, "")
            .bound(1.0, "")
            .key("part")
            .into());
    }
    let text = loader.read_text(&table.job).map_err(|e| e.under("job"))?;
    let mut sources = Sources::default();
    let id = sources.add(&table.job, text);
    let folder = Folder { of: Path::new(&table.job).parent().unwrap_or(Path::new("")), loader };
    let job_text = JobText::read(&mut sources, id, &folder)?;
    let locate = |e| job_text.locate(&sources, e);
    let job = check(&job_text.file, "GRAZING", &folder).map_err(locate)?;
    let planned = plan(&job, &Silent).map_err(locate)?;
    let number = table.setup.unwrap_or(1);
    let Some(planned) = planned.into_iter().nth((number as usize).wrapping_sub(1)) else {
        return Err(Finding::error(Code::GRAZING_MOTION, "the job has no such set-up")
            .value(f64::from(number), "")
            .bound(job.setups.len() as f64, "")
            .key("setup")
            .into());
    };
    let (name, text) = match &table.program {
        Some(name) => (name.clone(), loader.read_text(name).map_err(|e| e.under("program"))?),
        None => {
            let mut post = job.post.clone();
            post.header = vec![job.title.clone()];
            let name = format!("{}.{}", post.program_name, post.control.extension());
            (name, nc::write(&planned.program, &job.tools, &post)?.text)
        }
    };
    let mut sources = Sources::default();
    let program = nc::read(&mut sources, &name, &text, job.post.control, &planned.program.setups)?.program;
    let options = run::trace_options(&job, &planned);
    let followed = trace(&program, &options)?;
    let line_of = |s: &Segment| program.origin(s.item as usize).span.map(|span| sources.line(span));
    let on_line: Vec<&Segment> =
        followed.segments.iter().filter(|s| !s.alternative && line_of(s) == Some(table.line)).collect();
    let block = || text.lines().nth((table.line as usize).wrapping_sub(1)).unwrap_or("").trim().to_owned();
    if on_line.is_empty() {
        let nearest = followed.segments.iter().filter_map(line_of).min_by_key(|l| l.abs_diff(table.line));
        let cure = nearest.map_or("the program moves nothing".to_owned(), |l| {
            format!("the nearest line that moves the tool is {l}")
        });
        let what = format!("line {} of {name} moves no tool: {}", table.line, block());
        return Err(Finding::error(Code::GRAZING_MOTION, what).key("line").cure(cure).into());
    }
    let (segment, t) = place(&on_line, part);
    let (pose, twist) = twist(segment, t)?;
    let tool = match (with_tool, segment.tool.and_then(|n| job.tools.iter().find(|tool| tool.number == n))) {
        (true, Some(tool)) => Some((format!("T{}", tool.number.0), Contour::of_tool(tool)?)),
        _ => None,
    };
    let source = MotionSource::Moment { program: name, line: table.line, block: block(), part, pose };
    Ok(Moving { twist, source, tool })
}

/// The segment of a part of the way over several, and the part of its own way.
fn place<'a>(segments: &[&'a Segment], part: f64) -> (&'a Segment, f64) {
    let lengths: Vec<f64> = segments.iter().map(|s| s.curve.length()).collect();
    let all: f64 = lengths.iter().sum();
    let mut left = part * all;
    for (segment, length) in segments.iter().zip(&lengths) {
        if left <= *length && *length > 0.0 {
            return (segment, left / length);
        }
        left -= length;
    }
    // Turning on the spot, or the end but for rounding.
    let last = segments[segments.len() - 1];
    (last, if all > 0.0 { 1.0 } else { part })
}

/// The pose of the tool (X where the tip goes, seen across the axis) and its twist [mm/s, rad/s].
fn twist(segment: &Segment, t: f64) -> Result<(Rigid, Twist)> {
    let length = segment.curve.length();
    let pose = segment.pose(t * length);
    let (axis, velocity, turning) = if length > 0.0 {
        let speed = match (segment.motion, segment.duration) {
            (Motion::Feed(feed), None) => feed,
            (_, Some(duration)) if duration > 0.0 => length / duration,
            _ => UNKNOWN_SPEED,
        };
        (pose.axis, pose.tip.d1 * speed, pose.turning * speed)
    } else {
        let (axis, rate) =
            segment.turning.as_ref().map_or((segment.axis, DVec3::ZERO), |turning| turning.axis(t));
        let time = segment.duration.filter(|d| *d > 0.0).unwrap_or(1.0);
        (axis, DVec3::ZERO, rate / time)
    };
    let ahead = velocity - axis * velocity.dot(axis);
    let helper = if axis.x.abs() < 0.9 { DVec3::X } else { DVec3::Y };
    let x = ahead
        .try_normalize()
        .or_else(|| turning.cross(axis).try_normalize())
        .or_else(|| (helper - axis * helper.dot(axis)).try_normalize())
        .unwrap_or(DVec3::X);
    let rotation = DMat3::from_cols(x, axis.cross(x), axis);
    let rate = DMat3::from_cols(
        turning.cross(rotation.x_axis),
        turning.cross(rotation.y_axis),
        turning.cross(rotation.z_axis),
    );
    let pose = Rigid { rotation, translation: pose.tip.p };
    Ok((pose, twist_of(&pose, rate, velocity)?))
}

/// Files as the job names them: from its own folder.
struct Folder<'a> {
    of: &'a Path,
    loader: &'a dyn Loader,
}

impl Loader for Folder<'_> {
    fn read(&self, name: &str) -> Result<Vec<u8>> {
        self.loader.read(&self.of.join(name).to_string_lossy())
    }
}
