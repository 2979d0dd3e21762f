//! The load of a tool along the program: power and torque of what it takes from the simulated stock, after Kienzle.

use std::f64::consts::{PI, TAU};

use super::super::setup_outcome::SetupOutcome;
use super::course::{arcs, rates};
use super::give::{BESIDE, RADIAL, give};
use crate::cutting::{CuttingForce, CuttingLoad, Material};
use crate::job::Outcome;
use crate::stock::cut::{EngagedStretch, MoveEngagement};
use crate::tool::{Cutter, Tool};
use crate::trace::Segment;

/// Share of the engaged way on which a contact may be wider than a quarter of the circle: what the lines of the stock leave
/// to chance.
const WIDER: f64 = 0.02;

/// Deflection of a tool's tip, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Deflection {
    /// The greatest [mm].
    Of(f64),
    /// Not known: the tool cuts with more than a quarter of its circle, which presses it to several sides.
    Wider,
    /// Not known, or nothing is cut.
    Unknown,
}

impl Deflection {
    /// The greater one; not known where one is of a wider cut.
    pub(crate) fn join(self, other: Deflection) -> Deflection {
        match (self, other) {
            (Deflection::Wider, _) | (_, Deflection::Wider) => Deflection::Wider,
            (Deflection::Of(a), Deflection::Of(b)) => Deflection::Of(a.max(b)),
            (Deflection::Unknown, known) | (known, Deflection::Unknown) => known,
        }
    }

    /// The greatest, where it is known [mm].
    pub(crate) fn known(self) -> Option<f64> {
        if let Deflection::Of(most) = self { Some(most) } else { None }
    }
}

/// Stretches of an edge along which its contact is summed up.
const PARTS: u32 = 32;

/// A tool in a segment at feed, with the force of the material.
pub(crate) struct Loads<'a> {
    tool: &'a Tool,
    force: CuttingForce,
    /// Speed of the spindle (rad/s).
    speed: f64,
    /// Time of the segment at the programmed feed [s].
    time: f64,
    /// Lengths of its way across the axis of the tool and along it [mm].
    way: [f64; 2],
}

/// The force of the material of a job, where it is known.
pub(crate) fn force_of(material: Option<&str>) -> Option<CuttingForce> {
    material.and_then(Material::of).and_then(|known| known.force)
}

impl Loads<'_> {
    /// Of a segment; `None` where material, spindle or feed is not known, and of taps.
    pub(crate) fn of<'a>(outcome: &'a Outcome, done: &SetupOutcome, segment: &Segment) -> Option<Loads<'a>> {
        Loads::with(&outcome.job.tools, force_of(outcome.job.material.as_deref())?, done, segment)
    }

    /// The same with a force.
    pub(crate) fn with<'a>(
        tools: &'a [Tool],
        force: CuttingForce,
        done: &SetupOutcome,
        segment: &Segment,
    ) -> Option<Loads<'a>> {
        let tool = tools.iter().find(|t| Some(t.number) == segment.tool)?;
        let speed = done.program.state(segment.item as usize).spindle.rate();
        let time = segment.duration.filter(|t| *t > 0.0)?;
        let along = (segment.curve.end() - segment.curve.start()).dot(segment.axis).abs();
        let across = (segment.curve.length().powi(2) - along * along).max(0.0).sqrt();
        // The stock does not have the thread that a tap cuts: nothing is measured of it.
        let is_tap = matches!(tool.cutter, Cutter::Tap(_));
        (speed > 0.0 && !is_tap).then_some(Loads { tool, force, speed, time, way: [across, along] })
    }

    /// On a stretch; `rate`: volume by fraction of the segment [mm3], a mean over stretches beside it.
    pub(crate) fn on(&self, stretch: &EngagedStretch, rate: f64) -> CuttingLoad {
        if !(rate > 0.0) {
            return CuttingLoad::default();
        }
        let rate = rate.min(self.most(stretch));
        let power = self.force.at(self.chip(stretch, rate)) * rate / self.time / 1000.0;
        let torque = power / self.speed;
        let arc = stretch.arc.max(self.arc(stretch, rate));
        CuttingLoad { power, torque, force: self.across(stretch.depth, arc, torque) }
    }

    /// The arc of contact beside a wall [rad] by what is taken, where the lines are too far apart to show it.
    fn arc(&self, stretch: &EngagedStretch, rate: f64) -> f64 {
        let width = rate / (stretch.depth * self.way[0]);
        let cosine = 1.0 - width / radius(&self.tool.cutter, stretch.depth);
        if cosine.is_finite() { cosine.clamp(-1.0, 1.0).acos() } else { 0.0 }
    }

    /// The force across the axis of a mill while teeth cut (N), by the mean torque (N m); nothing of a drill.
    fn across(&self, depth: f64, arc: f64, torque: f64) -> f64 {
        let radius = radius(&self.tool.cutter, depth);
        if matches!(self.tool.cutter, Cutter::Drill { .. }) || !(radius > 0.0 && arc > 0.0) {
            return 0.0;
        }
        // Where one tooth leaves before the next one enters, all of the work is done in a part of the time.
        let cutting = f64::from(self.tool.teeth.max(1)) * arc / TAU;
        torque * 1000.0 / radius / cutting.min(1.0)
    }

    /// Greatest deflection of the tool's tip in a segment [mm], away from the wall beside which it cuts with a quarter of its circle at
    /// the most; none where it has no cut, and where the give of the tool is not known.
    pub(crate) fn deflection(&self, moved: &MoveEngagement) -> Deflection {
        let engaged: f64 = moved.stretches.iter().map(|s| s.to - s.from).sum();
        let all = || moved.stretches.iter().zip(rates(moved)).zip(arcs(moved));
        let wider: f64 = all().filter(|(_, arc)| *arc > BESIDE).map(|((s, _), _)| s.to - s.from).sum();
        if wider > WIDER * engaged {
            return Deflection::Wider;
        }
        let Some(give) = give(self.tool) else { return Deflection::Unknown };
        let beside = all().filter(|(_, arc)| *arc <= BESIDE);
        let forces =
            beside.map(|((stretch, rate), arc)| self.on(&EngagedStretch { arc, ..*stretch }, rate).force);
        forces.reduce(f64::max).map_or(Deflection::Unknown, |force| Deflection::Of(RADIAL * give * force))
    }

    /// The most that can be taken where the contact is as deep and as wide as it is [mm3 by fraction of the segment]: how many lines
    /// of the stock cross a short move is left to chance.
    fn most(&self, stretch: &EngagedStretch) -> f64 {
        let radius = 0.5 * self.tool.cutter.diameter(self.tool.flute_length);
        let [across, along] = self.way;
        across * stretch.width * stretch.depth + PI * radius * radius * along
    }

    /// The greatest power and the greatest torque in a segment.
    pub(crate) fn greatest(&self, moved: &MoveEngagement) -> CuttingLoad {
        let all = moved.stretches.iter().zip(rates(moved)).map(|(stretch, rate)| self.on(stretch, rate));
        all.fold(CuttingLoad::default(), |a, b| CuttingLoad {
            power: a.power.max(b.power),
            torque: a.torque.max(b.torque),
            force: a.force.max(b.force),
        })
    }

    /// Mean thickness of the chip [mm]: the volume of a tooth's cut over the area on which it cuts, and never more than the thickest
    /// one.
    fn chip(&self, stretch: &EngagedStretch, rate: f64) -> f64 {
        let turns = self.speed * self.time / TAU;
        let teeth = f64::from(self.tool.teeth.max(1));
        let thickest = stretch.advance / turns / teeth;
        // The lips of a drill cut with one thickness.
        if thickest > 0.0 && matches!(self.tool.cutter, Cutter::Drill { .. }) {
            return thickest;
        }
        let area = stretch.arc * edge(&self.tool.cutter, stretch.depth);
        let mean = rate / (turns * teeth * area);
        match (thickest > 0.0, mean.is_finite() && mean > 0.0) {
            (true, true) => mean.min(thickest),
            (true, false) => thickest,
            (false, true) => mean,
            // A cut of which nothing is known but its volume: that of a thin chip.
            (false, false) => THIN,
        }
    }
}

/// Thickness of a chip of which nothing is known [mm].
const THIN: f64 = 0.01;

/// The sum of an edge's pieces up to a height [mm] over its end, each by its distance from the axis [mm2].
fn edge(cutter: &Cutter, height: f64) -> f64 {
    let mut sum = 0.0;
    let mut before = (0.0, radius(cutter, 0.0));
    for i in 1..=PARTS {
        // Dense where the end is round.
        let share = f64::from(i) / f64::from(PARTS);
        let z = height * share * share;
        let r = radius(cutter, z);
        sum += (z - before.0).hypot(r - before.1) * 0.5 * (r + before.1);
        before = (z, r);
    }
    sum
}

/// Distance of the edge from the axis at a height over the end [mm].
fn radius(cutter: &Cutter, z: f64) -> f64 {
    let round = |corner: f64| {
        let z = z.min(corner);
        (z * (2.0 * corner - z)).sqrt()
    };
    match *cutter {
        Cutter::BallNose { diameter } => round(0.5 * diameter),
        Cutter::BullNose { diameter, corner_radius } => 0.5 * diameter - corner_radius + round(corner_radius),
        Cutter::Tapered { tip_diameter, half_angle } => 0.5 * tip_diameter + z * half_angle.tan(),
        Cutter::EndMill { diameter } | Cutter::Drill { diameter, .. } => 0.5 * diameter,
        Cutter::Tap(ref tap) => 0.5 * tap.diameter,
        Cutter::ThreadMill(ref mill) => 0.5 * mill.diameter,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::cutting::MillingCut;
    use crate::job::file::{ToolTable, tool};

    fn end_mill(diameter: f64, teeth: u32) -> Tool {
        let table = ToolTable { diameter, flute_length: 30.0, teeth: Some(teeth), ..ToolTable::bare(1) };
        tool(&table, &BTreeMap::new()).unwrap()
    }

    #[test]
    fn a_side_cut_has_the_load_of_the_formula() {
        let force = CuttingForce { kc11: 2110.0, mc: 0.17 };
        let speed = 4000.0 * TAU / 60.0;
        for width in [0.5, 1.0, 3.0, 5.0, 8.0, 10.0] {
            let cut = MillingCut { diameter: 10.0, teeth: 4, speed, feed: 1600.0 / 60.0, depth: 7.0, width };
            let (tool, time) = (end_mill(10.0, 4), 30.0 / cut.feed);
            let loads = Loads { tool: &tool, force, speed, time, way: [30.0, 0.0] };
            let chip = cut.chip();
            let stretch = EngagedStretch {
                from: 0.0,
                to: 1.0,
                removed: cut.rate() * time,
                arc: chip.engagement,
                depth: cut.depth,
                width,
                advance: 30.0 * chip.engagement.min(0.25 * TAU).sin(),
            };
            let (found, wanted) = (loads.on(&stretch, stretch.removed), cut.load(&force));
            assert!((found.power / wanted.power - 1.0).abs() < 1e-9, "{width}: {found:?} {wanted:?}");
            assert!((found.torque / wanted.torque - 1.0).abs() < 1e-9);
            // One tooth of four cuts at a time within a quarter of a turn.
            let share = 4.0 * chip.engagement / TAU;
            let force = wanted.force / if share < 1.0 { share } else { 1.0 };
            assert!((found.force / force - 1.0).abs() < 1e-9, "{width}: {found:?} {wanted:?}");
            // Three times as many lines as there should be take no more.
            assert_eq!(loads.on(&stretch, 3.0 * stretch.removed), found);
        }
    }

    #[test]
    fn a_block_that_also_cuts_wider_has_no_deflection() {
        let tool = end_mill(10.0, 4);
        let force = CuttingForce { kc11: 2110.0, mc: 0.17 };
        let loads = Loads { tool: &tool, force, speed: 400.0, time: 1.0, way: [30.0, 0.0] };
        let stretch = |i: u32, arc: f64| {
            let [from, to] = [i, i + 1].map(|k| f64::from(k) / 60.0);
            EngagedStretch { from, to, removed: 1.0, arc, depth: 5.0, width: 1.0, advance: 20.0 }
        };
        let moved = |arcs: &dyn Fn(u32) -> f64| MoveEngagement {
            stretches: (0..60).map(|i| stretch(i, arcs(i))).collect(),
            spread: 0.0,
        };
        let beside = loads.deflection(&moved(&|_| 0.5));
        assert!(beside.known().unwrap() > 0.0);
        // A corner at the end of the way.
        let mixed = loads.deflection(&moved(&|i| if i < 50 { 0.5 } else { 2.1 }));
        assert_eq!(mixed, Deflection::Wider);
        assert_eq!((beside.join(mixed).known(), mixed.join(beside).known()), (None, None));
        let idle = loads.deflection(&MoveEngagement { stretches: Vec::new(), spread: 0.0 });
        assert_eq!((idle, idle.join(beside), beside.join(idle)), (Deflection::Unknown, beside, beside));
    }

    #[test]
    fn an_edge_is_as_long_as_its_form() {
        // Area of a zone of a sphere over a full turn: 2 pi r h.
        for h in [0.2, 1.0, 3.0, 5.0] {
            let zone = TAU * edge(&Cutter::BallNose { diameter: 10.0 }, h);
            assert!((zone / (TAU * 5.0 * h) - 1.0).abs() < 2e-3, "{h}: {zone}");
        }
        let cone = Cutter::Tapered { tip_diameter: 0.0, half_angle: TAU / 8.0 };
        assert!((edge(&cone, 4.0) - 8.0 * 2f64.sqrt()).abs() < 1e-9);
        assert!((edge(&Cutter::EndMill { diameter: 8.0 }, 5.0) - 20.0).abs() < 1e-9);
    }
}
