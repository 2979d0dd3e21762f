//! A planned drilling: its moves, its proof, its part of report and plan.

use std::sync::Arc;

use serde::Serialize;

use super::moves::write_holes;
use super::prove::claim;
use super::section::sections;
use super::{DrillOperation, HoleJson, PlannedHole, hole_json};
use crate::base::{Finding, Result};
use crate::drilling::{BoundarySurface, DrillMethod, End, Mouth, Side};
use crate::geom::{EdgeProfile, EdgeSegment};
use crate::nc::Control;
use crate::operations::measured::{Loose, Proof};
use crate::operations::wanted::{Wall, WantedWall};
use crate::operations::{
    Found, HoleFloor, Judged, MadeMouth, Pen, PostedPlan, Probes, RoundHole, Shown, Tally, kind,
};
use crate::page::Section;
use crate::tool::DrillPoint;

/// A planned drilling.
#[derive(Clone, Debug)]
pub struct PlannedDrilling {
    /// The operation.
    pub of: Arc<DrillOperation>,
    /// The holes that can be drilled.
    pub holes: Vec<PlannedHole>,
}

/// Zones and coordinates of drilled holes; Z from the height `zero` in the work offset.
#[derive(Debug, Serialize)]
pub(crate) struct DrillingJson {
    operation: u32,
    holes: Vec<HoleJson>,
}

impl kind::Plan for PlannedDrilling {
    type Json = DrillingJson;

    const LIST: &'static str = "drillings";

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        if pen.setting.post.control == Control::LinuxCnc {
            pen.text("G95 NEEDS THE SPINDLE SPEED FED BACK (spindle.0.speed-in)");
        }
        write_holes(pen, &self.of, &mut self.holes)
    }

    /// The way that the drilling runs on after its exit: the job says it, or the rule of its kind of tool.
    fn breakthrough(&self) -> f64 {
        let over = |h: &PlannedHole| h.plan.exit.map(|exit| exit.last - h.plan.travel.end);
        self.holes.iter().filter_map(over).fold(0.0, f64::max)
    }

    /// The core of an annular drill falls out when it has broken through.
    fn falling(&self, posted: &PostedPlan<'_>) -> Vec<Loose> {
        let to_part = posted.to_part(&self.of.milling);
        let core = |hole: &PlannedHole| {
            let annular = matches!(hole.spec.point, DrillPoint::Annular { .. });
            let item =
                posted.item_after_planned(hole.next_item).filter(|_| annular && hole.plan.exit.is_some())?;
            let [x, y] = hole.at;
            Some(Loose {
                item,
                centre: to_part.point(glam::DVec3::new(x, y, hole.plan.travel.start + hole.zero)),
                out: to_part.vector(glam::DVec3::Z),
                diameter: 2.0 * hole.plan.edge.inner_radius(),
                depth: hole.plan.travel.start - hole.plan.travel.end,
            })
        };
        self.holes.iter().filter_map(core).collect()
    }

    fn walls(&self) -> Vec<WantedWall> {
        self.holes.iter().filter_map(PlannedHole::wall).collect()
    }

    fn holes(&self) -> Vec<RoundHole> {
        self.holes.iter().filter_map(PlannedHole::as_hole).collect()
    }

    fn mouths(&self) -> Vec<MadeMouth> {
        self.holes.iter().filter_map(PlannedHole::as_mouth).collect()
    }

    fn probes(&self, posted: &PostedPlan<'_>, most: usize) -> Probes {
        Probes { points: self.probes_of(posted, most), walls: None }
    }

    fn judge(&mut self, _name: &str, posted: &PostedPlan<'_>, found: &Found<'_>) -> Judged {
        self.judged(posted, found)
    }

    fn sum_up(tallies: &[Tally], step: f64) -> (Option<Proof>, Option<String>) {
        let unmeasured: usize = tallies.iter().map(|t| t.unmeasured).sum();
        let left = || format!("feed zones of {unmeasured} further holes: not measured in the stock");
        (claim(tallies, step), (unmeasured > 0).then(left))
    }

    fn sections(all: &[(&PlannedDrilling, &Shown<'_>)]) -> Vec<Section> {
        sections(all)
    }

    fn json(&self, shown: &Shown<'_>) -> Option<DrillingJson> {
        let holes = self.holes.iter().map(|hole| hole_json(hole, false, false)).collect();
        Some(DrillingJson { operation: shown.number, holes })
    }
}

impl PlannedHole {
    /// The wall, where it is whole all round; `None` for recesses, and where it nowhere is.
    fn wall(&self) -> Option<WantedWall> {
        /// Least height of a wall that can be measured [mm].
        const LEAST: f64 = 2e-3;
        /// Radii nearer than this are equal [mm].
        const SAME: f64 = 1e-6;
        if matches!(
            self.spec.method,
            DrillMethod::Centring | DrillMethod::Countersinking | DrillMethod::Counterboring
        ) {
            return None;
        }
        let radius = self.plan.edge.outer_radius();
        // Height of the corner, where the edge meets the wall, above the tip.
        let corner = self.plan.edge.segments().last()?.height(radius);
        let above = self.zero + corner;
        // In a recess at its mouth the wall begins where that has its radius.
        // In a hole as wide as itself it goes on.
        let wider = |m: &&Mouth| m.edge.outer_radius() > radius + SAME;
        let recess = self.spec.mouth.as_ref().filter(wider);
        let mouth = recess.and_then(|m| Some(m.height + m.edge.height(radius)? + self.zero));
        let top = mouth.unwrap_or_else(|| match self.spec.entry {
            BoundarySurface::Plane { height, slope: 0.0 } if self.spec.mouth.is_some() => height + self.zero,
            _ => self.plan.entry.last + above,
        });
        // In a blind hole a nub may be higher than the corner.
        let floor = self.zero + self.plan.edge.extent()[1];
        let bottom = self.plan.exit.map_or(self.plan.travel.end + floor, |e| e.first + above);
        // A core stays where nothing cuts; a nose runs in a hole that was there, so the core below it is left.
        let slug = match &self.spec.point {
            DrillPoint::Cone { .. } => 0.0,
            point => point.edge(self.spec.diameter).map_or(0.0, |e| e.inner_radius()),
        };
        (top > bottom + LEAST).then_some(WantedWall {
            centre: self.at.into(),
            wall: Wall::Round { radii: [radius; 2], heights: [top, bottom] },
            top,
            floor: None,
            bottom,
            slug,
        })
    }
}

impl PlannedHole {
    /// The hole that it leaves: one that goes through has its diameter down to where the drill turns back.
    fn as_hole(&self) -> Option<RoundHole> {
        if self.spec.method == DrillMethod::Counterboring {
            return self.seat();
        }
        let hole = RoundHole::of_wall(&self.wall()?)?;
        let lowest = self.plan.travel.end + self.zero + self.plan.edge.extent()[1];
        let through = self.plan.exit.is_some();
        // The drill alone has made the floor, where all of its edge has gone in.
        let (edge, tip) = (self.plan.edge, self.plan.travel.end);
        let whole = !through && edge.inner_radius() == 0.0 && self.is_all_in();
        let floor = whole.then_some(HoleFloor { tip: tip + self.zero, edge });
        Some(RoundHole { bottom: lowest, through, floor, ..hole })
    }
}

impl PlannedHole {
    /// The recess that it leaves at the mouth of a hole that follows, cut to a diameter in a level face.
    fn as_mouth(&self) -> Option<MadeMouth> {
        let level = matches!(self.spec.entry, BoundarySurface::Plane { slope: 0.0, .. });
        // Of a recess that was there nothing is left where all of the edge has gone in.
        let whole = level && matches!(self.spec.end, End::Reached(_)) && self.is_all_in();
        let edge = closed(&self.plan.edge).filter(|_| whole)?;
        let tip = self.plan.travel.end + self.zero;
        Some(MadeMouth { tip: glam::DVec3::new(self.at[0], self.at[1], tip), edge })
    }

    /// Whether all of the edge is in material at its end, so that it alone has made what is there.
    fn is_all_in(&self) -> bool {
        let mut entries = self.plan.passages.iter().filter(|p| p.side == Side::Entry);
        entries.all(|p| p.transient.last >= self.plan.travel.end)
    }

    /// The recess that a counterbore leaves about a hole, in a level face.
    fn seat(&self) -> Option<RoundHole> {
        let BoundarySurface::Plane { height, slope: 0.0 } = self.spec.entry else { return None };
        let edge = closed(&self.plan.edge).filter(|edge| edge.extent() == [0.0; 2])?;
        let bottom = self.plan.travel.end + self.zero;
        Some(RoundHole {
            centre: self.at.into(),
            diameter: 2.0 * edge.outer_radius(),
            top: height + self.zero,
            bottom,
            through: self.plan.exit.is_some(),
            floor: Some(HoleFloor { tip: bottom, edge }),
        })
    }
}

/// An edge with the part that ran in a hole, or did not cut, as a level piece: nothing is left of the material there.
fn closed(edge: &EdgeProfile) -> Option<EdgeProfile> {
    let inner = edge.inner_radius();
    if inner == 0.0 {
        return Some(*edge);
    }
    let height = edge.height(inner)?;
    let level = EdgeSegment::Line { r: [0.0, inner], z: [height; 2] };
    let mut segments = vec![level];
    segments.extend_from_slice(edge.segments());
    EdgeProfile::new(&segments).ok()
}

/// The findings of holes that were left out come with the plan.
pub(super) fn planned(
    of: &Arc<DrillOperation>,
    (holes, found): (Vec<PlannedHole>, Vec<Finding>),
) -> kind::Attempt<PlannedDrilling> {
    kind::Attempt::SetupPlan(PlannedDrilling { of: Arc::clone(of), holes }, found)
}
