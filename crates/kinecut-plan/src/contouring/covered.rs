//! Whether every loop of an outline that is to be cut has a path.

use glam::DVec2;

use super::ContourSide;
use super::plan::Planner;
use crate::base::{Code, Finding, Result};
use crate::geom::OffsetLoop;

/// Halvings in the search for the largest cutter that fits: to less than half a percent.
const HALVES: usize = 8;

impl Planner<'_> {
    /// Every loop of the outline that is to be cut has a path.
    pub(super) fn covered(&self, loops: &[OffsetLoop]) -> Result<()> {
        let outline = &self.spec.outline;
        let fits = |what: String, at: DVec2, widest: Option<f64>| {
            let finding = Finding::error(Code::CUTTER_TOO_LARGE, what).value_mm(self.spec.cutter.diameter);
            let finding = widest.map_or(finding.clone(), |widest| finding.bound_mm(widest));
            Err(finding
                .point([at.x, at.y, 0.0])
                .help("take a smaller cutter, or leave the loop out: loops = \"outer\", or by layer")
                .key("tool")
                .into())
        };
        if let Some(line) = loops.iter().find(|l| l.collapsed) {
            let at = line.edges[0].start;
            let what = format!("the cutter is as wide as the contour at ({:.3}, {:.3})", at.x, at.y);
            return fits(what, at, None);
        }
        let found = self.with_path(loops);
        let has_piece =
            |l: usize| self.spec.pieces.as_ref().is_none_or(|all| all.iter().any(|p| p.of_loop == l));
        let lacks = |l: &usize| {
            let one = &outline.loops()[*l];
            // Islands of an inside contour may lie in one another's way, and have one path.
            let needed = self.is_wanted(one.outer) && (one.outer || self.spec.side != ContourSide::Inside);
            needed && !found[*l] && has_piece(*l)
        };
        let lacking: Vec<usize> = (0..found.len()).filter(lacks).collect();
        let Some(&first) = lacking.first() else { return Ok(()) };
        let at = outline.edges()[outline.loops()[first].edges.start].start;
        let more = match lacking.len() - 1 {
            0 => String::new(),
            1 => ", nor along another loop".to_owned(),
            more => format!(", nor along {more} other loops"),
        };
        let what = format!("the cutter does not go along the contour at ({:.3}, {:.3}){more}", at.x, at.y);
        // The largest cutter that does, along all of them.
        let (mut low, mut high) = (0.0, self.spec.radius());
        for _ in 0..HALVES {
            let middle = 0.5 * (low + high);
            let has_all = |loops: Vec<OffsetLoop>| {
                let found = self.with_path(&loops);
                lacking.iter().all(|l| found[*l])
            };
            match self.paths(middle + self.spec.stock_to_leave).is_ok_and(has_all) {
                true => low = middle,
                false => high = middle,
            }
        }
        fits(what, at, Some((2e3 * low).floor() / 1e3))
    }

    /// For each loop of the outline, whether a path runs along it.
    fn with_path(&self, loops: &[OffsetLoop]) -> Vec<bool> {
        let outline = &self.spec.outline;
        let mut found = vec![false; outline.loops().len()];
        for edge in loops.iter().filter(|l| !l.collapsed).flat_map(|l| &l.edges) {
            let nearest = self.near.at(edge.at(0.5), f64::INFINITY);
            let own = nearest.and_then(|n| outline.loops().iter().position(|l| l.edges.contains(&n.edge)));
            if let Some(own) = own {
                found[own] = true;
            }
        }
        found
    }
}
