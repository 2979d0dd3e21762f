//! A planned bore: its table in the planner's words, its moves with the stop for a loose core, its wall, its section of the report.

use std::sync::Arc;

use glam::DVec3;

use super::{BoreOperation, BoreTable};
use crate::base::{Code, Finding, Result};
use crate::geom::{Outline, OutlineEdge, Rigid};
use crate::holes::{BorePlan, BoreSpec, CutterData, Sense, Strategy, plan_bore};
use crate::operations::kind::{self, Attempt, Checked as _, Nothing};
use crate::operations::measured::TakenOut;
use crate::operations::wall::{CLEARANCE, FinishTable, ShownWall, sections, write_moves};
use crate::operations::wanted::{Wall, WantedWall};
use crate::operations::{MadePlane, Pen, Setting, Shown, WearRegister};
use crate::page::Section;
use crate::program::Comp;
use crate::tool::Cutter;

/// A planned bore.
#[derive(Clone, Debug)]
pub struct PlannedBore {
    /// The operation.
    pub of: Arc<BoreOperation>,
    /// The plan.
    pub plan: BorePlan,
    /// The wear register of the finish.
    wear: Option<WearRegister>,
    /// The core that a person takes out at the program stop.
    taken_out: Vec<TakenOut>,
}

/// Plans a bore; one into which the cutter does not go for its stock to leave is left out.
pub(super) fn planned(of: &Arc<BoreOperation>, setting: &Setting<'_>) -> Result<Attempt<PlannedBore>> {
    let spec = spec(setting, of)?;
    if let Some(reason) = nothing_to_mill(&spec, &of.name()) {
        return Ok(Attempt::LeftOut(Box::new(reason)));
    }
    if let Some(finish) = &of.table.finish {
        finish
            .wear_keys()
            .check(setting, of.milling.tool.number, spec.finish.and_then(|f| f.wear))
            .map_err(|e| e.under("finish"))?;
    }
    let plan = plan_bore(&spec).map_err(|mut e| {
        if e.code() == Code::CUTTER_TOO_LARGE {
            // Of bore, cutter and allowance the bore is where a person looks first.
            e.0.key = Some("diameter".to_owned());
        }
        e
    })?;
    let value = of.table.finish.as_ref().and_then(|f| f.wear_value).unwrap_or(0.0);
    let wear =
        spec.finish.and_then(|f| f.wear).map(|w| WearRegister { number: w.register, value, radius: 0.0 });
    Ok(Attempt::SetupPlan(PlannedBore { of: Arc::clone(of), plan, wear, taken_out: Vec::new() }, Vec::new()))
}

/// The bore operation in the planner's words.
///
/// # Errors
/// `KC0103` for keys that exclude each other.
pub(crate) fn spec(setting: &Setting<'_>, bore: &BoreOperation) -> Result<BoreSpec> {
    let t: &BoreTable = &bore.table;
    Ok(BoreSpec {
        centre: t.at,
        top: t.top,
        depth: t.depth,
        diameter: t.diameter,
        cutter: CutterData::of(&bore.milling.tool),
        breakthrough: (t.breakthrough > 0.0).then_some(t.breakthrough),
        bottom_diameter: t.bottom_diameter,
        stock_to_leave: [t.stock_to_leave, t.stock_to_leave_floor],
        sense: t.direction,
        strategy: t.strategy,
        entry: t.entry,
        rough: t.rough,
        finish: t.finish.as_ref().map(FinishTable::finish).transpose().map_err(|e| e.under("finish"))?,
        retract_z: setting.clamping.safe_height,
        approach_z: (t.top + CLEARANCE).clamp(f64::NEG_INFINITY, setting.clamping.safe_height),
        resolution: (setting.post.control.has_involute()
            && setting.post.involute_native
            && setting.post.arcs)
            .then(|| setting.resolution()),
    })
}

/// A warning when the stock to leave, and nothing else, keeps the cutter out of the bore.
fn nothing_to_mill(spec: &BoreSpec, name: &str) -> Option<Finding> {
    let (left, cutter) = (spec.wall_radius(spec.floor()), spec.cutter_radius());
    let fits_without = left + spec.stock_to_leave[0] > cutter;
    (spec.stock_to_leave[0] > 0.0 && left <= cutter && fits_without).then(|| {
        let most = left + spec.stock_to_leave[0] - cutter;
        Finding::warning(
            Code::NOTHING_TO_MILL,
            format!("{name}: with the stock to leave it is not larger than the cutter; left out"),
        )
        .value_mm(spec.stock_to_leave[0])
        .bound_mm(most)
        .help(format!("leave less than {most:.3} mm, or use a smaller cutter"))
    })
}

impl kind::Plan for PlannedBore {
    type Json = Nothing;

    fn wear(&self) -> Option<WearRegister> {
        self.wear
    }

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        let (t, milling) = (&self.of.table, &self.of.milling);
        if let Some(wear) = self.wear {
            pen.text(pen.setting.post.control.wear_note(milling.tool.number, wear.number));
            pen.text("0 AS PLANNED, POSITIVE MAKES THE BORE SMALLER");
        }
        // The wall is on the outside of a path that runs round inside: to the right when it runs counter-clockwise.
        let comp = self.wear.map(|w| match t.direction {
            Sense::Conventional => Comp::Right(w.number),
            Sense::Climb => Comp::Left(w.number),
        });
        let Some(slug) = self.plan.slug else {
            write_moves(pen, &self.plan.moves, milling.coolant, comp);
            return Ok(());
        };
        let (before, after) = self.plan.moves.split_at(slug.before);
        write_moves(pen, before, milling.coolant, comp);
        pen.stop_for("TAKE OUT THE SLUG");
        let plane = milling.plane.map_or(Rigid::IDENTITY, |p| p.motion);
        self.taken_out.push(TakenOut {
            centre: plane.point(DVec3::new(t.at[0], t.at[1], t.top)),
            out: plane.vector(DVec3::Z),
            diameter: slug.diameter,
            depth: t.depth + t.breakthrough,
        });
        write_moves(pen, after, milling.coolant, comp);
        Ok(())
    }

    fn remarks(&self) -> &[Finding] {
        &self.plan.findings
    }

    fn breakthrough(&self) -> f64 {
        self.of.table.breakthrough
    }

    fn taken_out(&self) -> &[TakenOut] {
        &self.taken_out
    }

    fn walls(&self) -> Vec<WantedWall> {
        let (t, tool) = (&self.of.table, &self.of.milling.tool);
        let allowance = t.rough.as_ref().map_or(0.0, |r| r.allowance);
        let finish = t.finish.as_ref();
        let unfinished = if finish.is_some() { 0.0 } else { allowance };
        // A wear register moves the wall: positive values make the bore smaller.
        let wear = finish.filter(|f| f.wear_offset.is_some()).and_then(|f| f.wear_value);
        let leave = t.stock_to_leave + unfinished + wear.unwrap_or(0.0);
        let radii = [t.diameter, t.bottom_diameter.unwrap_or(t.diameter)].map(|d| d / 2.0 - leave);
        let bottom = t.top - t.depth;
        let through = t.breakthrough > 0.0;
        let cutter = tool.cutter.diameter(tool.flute_length);
        let outline = t.strategy == Strategy::OutlineHelix;
        let wall = WantedWall {
            centre: t.at.into(),
            wall: Wall::Round { radii, heights: [t.top, bottom] },
            top: t.top,
            floor: (!through).then_some(bottom + t.stock_to_leave_floor),
            bottom: if through { bottom } else { bottom + t.stock_to_leave_floor },
            slug: if outline { t.diameter / 2.0 - t.stock_to_leave - allowance - cutter } else { 0.0 },
        };
        wall.fits(cutter).into_iter().collect()
    }

    fn made_plane(&self) -> Option<MadePlane> {
        let cutter = &self.of.milling.tool.cutter;
        let (radius, corner) = match *cutter {
            Cutter::EndMill { diameter } => (0.5 * diameter, 0.0),
            Cutter::BullNose { diameter, corner_radius } => (0.5 * diameter, corner_radius),
            _ => return None,
        };
        let wall = self.walls().into_iter().next().filter(|wall| wall.slug <= 0.0)?;
        let (Some(floor), Wall::Round { radii, .. }) = (wall.floor, &wall.wall) else { return None };
        let circle = OutlineEdge::arc(wall.centre, radii[1], 0.0, std::f64::consts::TAU);
        let outline = Outline::new(vec![vec![circle]], Vec::new()).ok()?;
        Some(MadePlane::floor(outline, floor, [radius, corner, 0.0]))
    }

    fn sections(all: &[(&PlannedBore, &Shown<'_>)]) -> Vec<Section> {
        let one = |(bore, of): &(&PlannedBore, &Shown<'_>)| {
            let t = &bore.of.table;
            let shown = ShownWall {
                milling: &bore.of.milling,
                at: t.at,
                plan: Some(&bore.plan),
                entry: t.entry,
                step: t.rough.as_ref().and_then(|r| r.stepover),
                roughed: t.rough.as_ref().map(|r| t.diameter / 2.0 - t.stock_to_leave - r.allowance),
                is_round: t.bottom_diameter.is_none(),
            };
            shown.section(of)
        };
        sections(all.iter().map(one).collect())
    }
}
