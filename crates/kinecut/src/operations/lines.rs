//! Outlines and open lines beside which an operation works, read by the side of its cutter.

use glam::DVec2;

use super::outlines::OutlineKeys;
use crate::base::bounded::{MAX_LENGTH, length};
use crate::base::{Code, Error, Finding, Loader, Result};
use crate::contouring::ContourSide;
use crate::geom::{Outline, OutlineEdge, OutlineRead, OutlineReads, PointEntry};

/// Whether a side is one of an open line.
pub(crate) fn is_beside_line(side: ContourSide) -> bool {
    matches!(side, ContourSide::Left | ContourSide::Right)
}

impl OutlineKeys<'_> {
    /// The outline or the open lines beside which a cutter runs on a side, in coordinates of the work offset.
    ///
    /// # Errors
    /// One finding with the key of the first wrong value; those of the drawing's reader.
    pub(crate) fn read_beside(self, side: ContourSide, loader: &dyn Loader) -> Result<OutlineRead> {
        let Some(points) = self.polyline else {
            let is_drawing = self.drawing.is_some();
            let closed = if is_beside_line(side) { None } else { Some(self.read(loader)) };
            let no_face = |e: &Error| matches!(e.code(), Code::OUTLINE_OPEN | Code::OUTLINE_CROSSES);
            return match closed {
                // What is no face is cut on its lines as well: open ones, and those that branch or cross.
                Some(Err(e)) if side == ContourSide::On && is_drawing && no_face(&e) => {
                    self.read_lines(OutlineReads::Drawn, loader).map_err(|_| e)
                }
                Some(Err(Error(finding))) if finding.code == Code::OUTLINE_OPEN && is_drawing => {
                    let help = format!(
                        "{}; for an open line write side = \"left\" or \"right\" of its direction; a contour may also run on it: side = \"on\"",
                        finding.help
                    );
                    Err(finding.help(help).into())
                }
                Some(read) => read,
                None if is_drawing => self.read_lines(OutlineReads::Lines, loader),
                None => {
                    let what = "the left and the right side are those of an open line";
                    let help = "give the line as polyline = [[0, 0], [60, 0]] or as a drawing; for a closed outline write side = \"outside\" or \"inside\"";
                    Err(Finding::error(Code::JOB_SHAPE, what).help(help).key("side").into())
                }
            };
        };
        if !(OutlineKeys { polyline: None, ..self }).is_empty() {
            let finding = Finding::error(Code::JOB_SHAPE, "there is a `polyline` and another outline");
            return Err(finding.help("give one of them").key("polyline").into());
        }
        if !is_beside_line(side) && side != ContourSide::On {
            let finding = Finding::error(Code::JOB_SHAPE, "a polyline has no outside and no inside");
            let help = "write side = \"left\" or \"right\" of its direction, or \"on\" for a contour on it; for a closed outline give `polygon`";
            return Err(finding.help(help).key("side").into());
        }
        let outline = polyline(points, side == ContourSide::On).map_err(|e| e.under("polyline"))?;
        let weights = vec![1.0; outline.edges().len()];
        Ok(OutlineRead { outline, weights, notes: Vec::new(), edge: None })
    }
}

/// A line through points; `on`: for a cutter that runs on it, it may cross itself.
fn polyline(points: &[PointEntry], on: bool) -> Result<Outline> {
    let mut vertices = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        let (at, bulge) = match point {
            PointEntry::Numbers(numbers) => match numbers[..] {
                [x, y] => ([x, y], 0.0),
                [x, y, bulge] => ([x, y], bulge),
                _ => {
                    let what = "a point is two coordinates, or three numbers with the bulge";
                    let finding =
                        Finding::error(Code::JOB_VALUE, what).value(numbers.len() as f64, "numbers");
                    return Err(finding.help("write [x, y] or [x, y, bulge]").key(format!("[{i}]")).into());
                }
            },
            PointEntry::Table(t) => ([t.x, t.y], t.bulge),
        };
        for v in at {
            length(&format!("[{i}]"), v, -MAX_LENGTH, MAX_LENGTH)?;
        }
        vertices.push((DVec2::from_array(at), bulge));
    }
    if vertices.len() < 2 {
        let finding = Finding::error(Code::JOB_VALUE, "a polyline has two points at least");
        let finding = finding.value(vertices.len() as f64, "points").bound(2.0, "points");
        return Err(finding.help("for example polyline = [[0, 0], [60, 0]]").into());
    }
    let edges = vertices.windows(2).map(|w| OutlineEdge::bulge(w[0].0, w[1].0, w[0].1)).collect();
    if on { Outline::of_drawn(vec![edges], Vec::new()) } else { Outline::of_lines(vec![edges], Vec::new()) }
}
