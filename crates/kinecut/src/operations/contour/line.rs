//! The open lines of a contour, made longer where the cutter comes in and goes out.

use glam::DVec2;

use super::ContourOperation;
use crate::base::{Code, Error, Finding, Result};
use crate::contouring::ContourSide;
use crate::geom::{Aabb, Outline, OutlineEdge};

/// Way beyond the cutter's radius by which a line goes on where the job does not say it [mm].
const BEYOND: f64 = 1.0;
/// Distance of the ends of a line that is a loop [mm].
const JOINED: f64 = 1e-6;
/// Distance from the stock beyond the cutter's radius at which it comes straight down [mm].
const CLEAR: f64 = 0.1;

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
            // A loop has no ends.
            let is_loop = start.distance(end) <= JOINED;
            let by = [start, end].map(|p| if is_loop { 0.0 } else { t.extend.unwrap_or_else(|| usual(p)) });
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
        let joined = match t.side {
            ContourSide::On => Outline::of_drawn(lines, Vec::new()),
            _ => Outline::of_lines(lines, Vec::new()),
        };
        let outline = joined.map_err(|Error(finding)| {
            let at = finding.point.unwrap_or_default();
            let what =
                format!("the line runs into itself at ({:.3}, {:.3}) where it is made longer", at[0], at[1]);
            let bad = Finding::error(Code::PLAN_VALUE, what).point(at);
            Error::from(bad.help("let it go on less: extend = 0").key("extend"))
        })?;
        Ok(LongerLines { outline, extended, clear_ends })
    }
}
