//! The open line of a contour: read, and made longer where the cutter comes in and goes out.

use glam::DVec2;

use super::{ContourOperation, ContourTable};
use crate::base::bounded::{MAX_LENGTH, length};
use crate::base::{Code, Error, Finding, Loader, Result};
use crate::contouring::ContourSide;
use crate::geom::{Aabb, Outline, OutlineEdge, OutlineRead, PointEntry};
use crate::operations::outlines::outline_keys;

/// Way beyond the cutter's radius by which a line goes on where the job does not say it [mm].
const BEYOND: f64 = 1.0;
/// Distance from the stock beyond the cutter's radius at which it comes straight down [mm].
const CLEAR: f64 = 0.1;

impl ContourTable {
    /// Whether its side is that of an open line.
    pub(super) fn is_beside_line(&self) -> bool {
        matches!(self.side, ContourSide::Left | ContourSide::Right)
    }

    /// The outline or the open lines, in coordinates of the work offset.
    ///
    /// # Errors
    /// One finding with the key of the first wrong value; those of the drawing's reader.
    pub(super) fn read(&self, loader: &dyn Loader) -> Result<OutlineRead> {
        let keys = outline_keys!(self);
        let Some(points) = &self.polyline else {
            let is_drawing = self.outline.is_some();
            let closed = if self.is_beside_line() { None } else { Some(keys.read(loader)) };
            return match closed {
                // A line that is open is cut on it as well.
                Some(Err(e)) if self.side == ContourSide::On && e.code() == Code::OUTLINE_OPEN => {
                    keys.read_lines(loader).map_err(|_| e)
                }
                Some(Err(Error(finding))) if finding.code == Code::OUTLINE_OPEN && is_drawing => {
                    let help = format!(
                        "{}; for an open line write side = \"left\", \"right\" or \"on\"",
                        finding.help
                    );
                    Err(finding.help(help).into())
                }
                Some(read) => read,
                None if is_drawing => keys.read_lines(loader),
                None => {
                    let what = "a contour on the left or right runs along an open line";
                    let help = "give the line as polyline = [[0, 0], [60, 0]] or as a drawing; for a closed outline write side = \"outside\" or \"inside\"";
                    Err(Finding::error(Code::JOB_SHAPE, what).help(help).key("side").into())
                }
            };
        };
        if !keys.is_empty() {
            let finding = Finding::error(Code::JOB_SHAPE, "the contour has a `polyline` and another outline");
            return Err(finding.help("give one of them").key("polyline").into());
        }
        if !self.is_beside_line() && self.side != ContourSide::On {
            let finding = Finding::error(Code::JOB_SHAPE, "a polyline has no outside and no inside");
            let help = "write side = \"left\", \"right\" (of its direction) or \"on\"; for a closed outline give `polygon`";
            return Err(finding.help(help).key("side").into());
        }
        let outline = polyline(points).map_err(|e| e.under("polyline"))?;
        let weights = vec![1.0; outline.edges().len()];
        Ok(OutlineRead { outline, weights, notes: Vec::new() })
    }
}

/// A line through points.
fn polyline(points: &[PointEntry]) -> Result<Outline> {
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
    Outline::of_lines(vec![edges], Vec::new())
}

/// The lines of a contour as the cutter goes along them.
pub(super) struct LongerLines {
    /// The lines with the ways before their begins and beyond their ends.
    pub(super) outline: Outline,
    /// The lengths of these ways [mm].
    pub(super) extended: Vec<[f64; 2]>,
    /// Whether the cutter is clear of the stock where it begins and ends.
    pub(super) clear_ends: bool,
}

impl ContourOperation {
    /// The lines made longer, in a stock of this box.
    ///
    /// # Errors
    /// `KC0404` with the key `extend` where a line that is longer runs into itself or another one.
    pub(super) fn longer_lines(&self, stock: &Aabb, lead: f64) -> Result<LongerLines> {
        let (t, radius) = (&self.table, self.radius());
        let outside = |p: DVec2| {
            let [low, high] = [stock.min.truncate(), stock.max.truncate()];
            (low - p).max(p - high).max(DVec2::ZERO).length()
        };
        let ways = |line: &[OutlineEdge]| -> [(DVec2, DVec2); 2] {
            let (first, last) = (&line[0], &line[line.len() - 1]);
            let back = -DVec2::from_angle(first.heading(0.0));
            [(first.start, back), (last.end, DVec2::from_angle(last.heading(1.0)))]
        };
        let usual = |p: DVec2| match t.side {
            ContourSide::On => 0.0,
            _ if outside(p) > radius + BEYOND => 0.0,
            _ => radius + BEYOND - outside(p),
        };
        let (mut lines, mut extended, mut clear_ends) = (Vec::new(), Vec::new(), true);
        for line in self.outline.lines() {
            let [(start, back), (end, ahead)] = ways(line);
            let by = [start, end].map(|p| t.extend.unwrap_or_else(|| usual(p)));
            let mut edges = line.to_vec();
            let (begin, beyond) = (start + by[0] * back, end + by[1] * ahead);
            if by[0] > 0.0 {
                edges.insert(0, OutlineEdge::line(begin, start));
            }
            if by[1] > 0.0 {
                edges.push(OutlineEdge::line(end, beyond));
            }
            let aside = match t.side {
                ContourSide::On => 0.0,
                ContourSide::Right => -radius,
                _ => radius,
            };
            for (p, along, out) in [(begin, -back, back), (beyond, ahead, ahead)] {
                // The cutter's centre, and where its lead begins or ends.
                let centre = p + aside * along.perp();
                let free = centre + lead * (aside.signum() * along.perp() + out);
                clear_ends &= [centre, free].iter().all(|c| outside(*c) >= radius + CLEAR);
            }
            lines.push(edges);
            extended.push(by);
        }
        let outline = Outline::of_lines(lines, Vec::new()).map_err(|Error(finding)| {
            let at = finding.point.unwrap_or_default();
            let what =
                format!("the line runs into itself at ({:.3}, {:.3}) where it is made longer", at[0], at[1]);
            let bad = Finding::error(Code::PLAN_VALUE, what).point(at);
            Error::from(bad.help("let it go on less: extend = 0").key("extend"))
        })?;
        Ok(LongerLines { outline, extended, clear_ends })
    }
}
