//! The points of a tool path: from a file of cutter locations, or from the job.

use glam::DVec3;

use super::path_point::{PathPoint, PointPace};
use super::{PathTable, apt};
use crate::base::bounded::{MAX_LENGTH, length};
use crate::base::{Code, FileKind, Finding, Loader, Result, Sources};

/// The points of a path, with their file's errors in place.
pub(super) fn points(t: &PathTable, loader: &dyn Loader) -> Result<Vec<PathPoint>> {
    let points = match (&t.file, t.points.is_empty()) {
        (Some(name), true) => {
            let mut sources = Sources::default();
            let text = loader.read_text_as(name, FileKind::Program).map_err(|e| e.under("file"))?;
            let id = sources.add(name, text);
            apt::read(&sources, id)?
        }
        (None, false) => t.points.iter().enumerate().map(|(i, p)| point(i, p)).collect::<Result<_>>()?,
        (Some(_), false) => {
            return Err(Finding::error(Code::JOB_VALUE, "a path has points or a file, not both")
                .key("file")
                .into());
        }
        (None, true) => Vec::new(),
    };
    if points.is_empty() {
        return Err(Finding::error(Code::JOB_VALUE, "the path has no points")
            .help("give `points` or a `file` of cutter locations")
            .key(if t.file.is_some() { "file" } else { "points" })
            .into());
    }
    Ok(points)
}

fn point(index: usize, values: &[f64]) -> Result<PathPoint> {
    let key = format!("points[{index}]");
    let bad = |what: &str| Finding::error(Code::JOB_VALUE, what.to_owned()).key(key.clone());
    if values.len() != 3 && values.len() != 6 {
        return Err(bad("a point has three numbers, or six with a direction")
            .value(values.len() as f64, "numbers")
            .into());
    }
    for v in values {
        length(&key, *v, -MAX_LENGTH, MAX_LENGTH)?;
    }
    let axis = match values.get(3..6) {
        Some(v) => {
            let axis = DVec3::from_slice(v).try_normalize();
            Some(axis.ok_or_else(|| bad("the direction of the tool has no length"))?)
        }
        None => None,
    };
    Ok(PathPoint { tip: DVec3::from_slice(values), axis, pace: PointPace::OfOperation })
}
