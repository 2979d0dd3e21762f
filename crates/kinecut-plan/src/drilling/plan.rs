//! A hole from what is to be drilled to zones, coordinates, times and warnings.

use std::f64::consts::TAU;

use super::advice::{Advice, GIVEN, INDEXABLE_PRE_HOLE, OUR_DEFAULT, advice};
use super::ceiling::joined;
use super::lengths::Frames;
use super::{
    BoundarySurface, Coordinates, Cover, DrillSpec, DrillWay, End, Feeds, Lengths, LipBalance, Mouth,
    Passage, PreHole, Side, SpindleSpeed, Transient, Travel, Zone, ZoneStage, lip_balance, transient, zones,
};
use crate::base::{Code, Finding, Result};
use crate::geom::EdgeProfile;
use crate::tool::DrillPoint;

/// A planned hole; Z in the frame of the entry, mm, s.
#[derive(Clone, Debug, PartialEq)]
pub struct DrillPlan {
    /// The part of the edge that cuts.
    pub edge: EdgeProfile,
    /// Surfaces that the hole passes.
    pub passages: Vec<Passage>,
    /// Entry of the whole edge.
    pub entry: Transient,
    /// Exit of the whole edge; `None` for a blind hole.
    pub exit: Option<Transient>,
    /// Start and end of the travel at feed.
    pub travel: Travel,
    /// Stretches of one feed, top down.
    pub zones: Vec<Zone>,
    /// The paper's lengths.
    pub lengths: Lengths,
    /// The paper's coordinates.
    pub coordinates: Coordinates,
    /// Speed of the spindle [rad/s].
    pub spindle: f64,
    /// Feeds.
    pub feeds: Feeds,
    /// Sources of the feeds of entry, steady cutting and exit.
    pub feed_sources: [&'static str; 3],
    /// Load of the lips while entering.
    pub balance: LipBalance,
    /// Time at feed [s].
    pub time: f64,
    /// Time of the same way at one feed that is safe throughout [s].
    pub constant_time: f64,
    /// Warnings and notes for the user.
    pub findings: Vec<Finding>,
}

impl DrillPlan {
    /// Time of all zones of a stage [s].
    pub fn time_of(&self, stage: ZoneStage) -> f64 {
        self.zones.iter().filter(|z| z.stage == stage).map(|z| z.time(self.spindle)).sum()
    }
}

/// Heights and radii nearer than this are equal [mm].
const LEVEL: f64 = 1e-9;
/// The same where the surface is a mesh [mm].
const MESH_LEVEL: f64 = 1e-4;

/// Plans a hole.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::drilling::*;
/// use kinecut::tool::DrillPoint;
/// // Figure 7 of Belyakov and Seleznev 2023: through a plate face into a shaft, 50 mm between the frames.
/// let point = DrillPoint::DoubleGround { angle: 118f64.to_radians(), second: 70f64.to_radians() };
/// let entry = BoundarySurface::Plane { height: 0.0, slope: 0.0 };
/// let exit = BoundarySurface::Valley { radius: 100.0, offset: 0.0, height: -50.0 };
/// let spec = DrillSpec { length: 50.0, ..DrillSpec::new(20.0, point, entry, exit) };
/// let plan = plan_drill(&spec).unwrap();
/// assert!((plan.coordinates.end - -159.906656).abs() < 1e-6); // the paper stops 0.501 mm above
/// ```
///
/// # Errors
/// `KC0701` for an invalid drill point, `KC0901` and `KC0902` for a case that contradicts itself.
pub fn plan_drill(spec: &DrillSpec) -> Result<DrillPlan> {
    if let Some(ceiling) = &spec.ceiling {
        ceiling.check()?;
    }
    spec.method.check(&spec.point, spec.diameter, spec.pre_hole.as_ref().map(|h| h.diameter))?;
    let edge = spec.cutting_edge()?;
    let mut body = PassedBody::of(spec, edge)?;
    // A surface may lie higher or lower than drawn.
    let widen = |t: &mut Transient| {
        t.first += spec.tolerance;
        t.last -= spec.tolerance;
    };
    body.passages.iter_mut().for_each(|p| widen(&mut p.transient));
    widen(&mut body.entry);
    body.above += spec.tolerance;
    body.exit.iter_mut().for_each(widen);
    let banded = body.banded;
    let mut plan = plan_along(spec, body)?;
    if banded {
        // The part of the edge that is in the material cuts all round.
        for zone in plan.zones.iter_mut().filter(|z| z.stage == ZoneStage::Partial) {
            zone.feed = plan.feeds.steady;
        }
        plan.time = plan.zones.iter().map(|z| z.time(plan.spindle)).sum();
    }
    plan.findings = findings(spec, &plan);
    Ok(plan)
}

/// Surfaces that a hole passes, from the spec's surfaces or from passages found in a body.
struct PassedBody {
    edge: EdgeProfile,
    passages: Vec<Passage>,
    entry: Transient,
    /// Its first contact without a recess at its mouth: that may be missing, so that no rapid move relies on it.
    above: f64,
    exit: Option<Transient>,
    /// Each diameter of a stepped tool has passages of its own.
    banded: bool,
}

impl PassedBody {
    fn of(spec: &DrillSpec, edge: EdgeProfile) -> Result<PassedBody> {
        let simple = spec.passages.is_none()
            && spec.bores.is_empty()
            && spec.pre_hole.as_ref().is_none_or(PreHole::leaves_annulus);
        if !simple {
            in_body(spec)?;
            let mut passages = match &spec.passages {
                Some(found) => found.clone(),
                None => DrillWay {
                    entry: spec.entry,
                    exit: spec.end.exit().copied(),
                    exit_turn: spec.exit_turn,
                    bores: spec.bores.clone(),
                    pre_hole: spec.pre_hole.clone(),
                }
                .passages(&edge)?,
            };
            let above = whole(&passages, Side::Entry).map_or(f64::NEG_INFINITY, |t| t.first);
            if let Some((mouth, face)) = spec.level_mouth() {
                let inner =
                    spec.pre_hole.as_ref().filter(|h| h.is_concentric()).map_or(0.0, |h| 0.5 * h.diameter);
                mouth.lower(&mut passages, &edge, inner, face).map_err(|e| e.under("entry"))?;
            }
            let beside = || Finding::error(Code::DRILL_MISSES, "the drill meets nothing");
            // The bottom of a hole below the end is not met.
            let end = spec.blind_end(&edge).unwrap_or(f64::NEG_INFINITY);
            let met: Vec<Passage> = passages.iter().filter(|p| p.transient.first > end).copied().collect();
            let entry =
                whole(&met, Side::Entry).or_else(|| whole(&passages, Side::Entry)).ok_or_else(beside)?;
            let exit = if spec.end.exit().is_some() { whole(&passages, Side::Exit) } else { None };
            return Ok(PassedBody { edge, passages, entry, above, exit, banded: false });
        }
        let entry = spec.goes_in(&edge).map_err(|e| e.under("entry"))?;
        let above = match spec.mouth {
            Some(_) => transient(&edge, &spec.entry, Cover::Whole).map_err(|e| e.under("entry"))?.first,
            None => entry.first,
        };
        let exits = spec.comes_out(&edge, 1.0).map_err(|e| e.under("exit"))?;
        let exit = joined(&exits);
        let mut passages = Vec::with_capacity(2);
        let banded = spec.point.is_stepped();
        if banded {
            bands(spec, &edge, &mut passages)?;
        } else {
            passages.push(Passage { transient: entry, side: Side::Entry, share: 1.0 });
            passages.extend(exits);
        }
        Ok(PassedBody { edge, passages, entry, above, exit, banded })
    }
}

/// Refuses what would have to be put into a body whose passages are given.
fn in_body(spec: &DrillSpec) -> Result<()> {
    if spec.ceiling.is_some() {
        let what = "a hole from the other side is followed in plain faces only";
        let finding = Finding::error(Code::DRILL_CASE, what).key("ceiling");
        return Err(finding
            .help("plan without cross bores, a body's mesh, and a hole beside the axis or blind")
            .into());
    }
    let key = match &spec.pre_hole {
        _ if spec.passages.is_none() => return Ok(()),
        _ if !spec.bores.is_empty() => "cross_bore",
        Some(hole) if !hole.leaves_annulus() => "pre_hole",
        _ => return Ok(()),
    };
    let what =
        "cross bores, and holes that are there beside the axis or blind, must be in the mesh of the body";
    let finding = Finding::error(Code::DRILL_CASE, what).key(key);
    Err(finding.help("give a mesh that has them, or give `entry` and `exit` instead of the body").into())
}

/// The passages by which the whole edge goes in first, or comes out last, as one.
fn whole(passages: &[Passage], side: Side) -> Option<Transient> {
    /// Shares add up to all of the edge but for rounding.
    const ALL: f64 = 1.0 - 1e-6;
    let mut own: Vec<&Passage> = passages.iter().filter(|p| p.side == side).collect();
    own.sort_by(|a, b| match side {
        Side::Entry => b.transient.first.total_cmp(&a.transient.first),
        Side::Exit => a.transient.last.total_cmp(&b.transient.last),
    });
    let mut joined = own.first()?.transient;
    let mut share = 0.0;
    for passage in own {
        if share >= ALL {
            break;
        }
        share += passage.share;
        let t = passage.transient;
        if t.first > joined.first {
            (joined.first, joined.first_radius) = (t.first, t.first_radius);
        }
        if t.last < joined.last {
            (joined.last, joined.last_radius) = (t.last, t.last_radius);
        }
    }
    Some(joined)
}

impl DrillSpec {
    /// Z at which the travel ends in a blind hole by its depth or its tip [mm].
    fn blind_end(&self, edge: &EdgeProfile) -> Option<f64> {
        match self.end {
            End::FullDiameter(depth) => Some(-depth - edge.extent()[1]),
            End::Tip(z) => Some(z),
            End::Reached(_) | End::Through { .. } => None,
        }
    }

    /// The recess in the face that it enters, and the height of that, where it is level [mm].
    fn level_mouth(&self) -> Option<(&Mouth, f64)> {
        match self.entry {
            BoundarySurface::Plane { height, slope: 0.0 } => Some((self.mouth.as_ref()?, height)),
            _ => None,
        }
    }

    /// The transient of an edge at the entry.
    fn goes_in(&self, edge: &EdgeProfile) -> Result<Transient> {
        match self.level_mouth() {
            Some((mouth, face)) => mouth.transient(edge, face),
            None => transient(edge, &self.entry, Cover::Whole),
        }
    }

    /// The exits of an edge that is a share of the whole one: into the floor of a hole from the other side, and out of the exit;
    /// none of a blind hole.
    fn comes_out(&self, edge: &EdgeProfile, share: f64) -> Result<Vec<Passage>> {
        let Some(exit) = self.end.exit() else { return Ok(Vec::new()) };
        let mut exits = match &self.ceiling {
            Some(ceiling) => ceiling.exits(edge, exit)?,
            None => {
                let transient = transient(edge, exit, Cover::Whole)?;
                vec![Passage { transient, side: Side::Exit, share: 1.0 }]
            }
        };
        exits.iter_mut().for_each(|e| e.share *= share);
        Ok(exits)
    }

    /// The part of the tool's edge that cuts: without what runs in a through hole about the same axis, and up to the
    /// diameter that is reached. Passages found in a body must be those of this edge.
    ///
    /// # Errors
    /// `KC0701` for an invalid drill point, `KC0901` when nothing of it cuts.
    pub fn cutting_edge(&self) -> Result<EdgeProfile> {
        let edge = self.point.edge(self.diameter).map_err(|e| e.under("tool"))?;
        // Other holes that are there are looked at on the way.
        let annulus = self.pre_hole.as_ref().filter(|h| h.leaves_annulus());
        let inner = annulus.map_or(0.0, |h| h.diameter / 2.0);
        let outer = match self.end {
            End::Reached(diameter) => {
                let bound = self.diameter;
                if !(diameter > 0.0 && diameter <= bound && diameter / 2.0 > inner) {
                    return Err(Finding::error(
                        Code::DRILL_CASE,
                        "the diameter to reach must lie between the hole that is there and the tool",
                    )
                    .value_mm(diameter)
                    .bound_mm(if diameter > bound { bound } else { 2.0 * inner })
                    .key("reach_diameter")
                    .into());
                }
                diameter / 2.0
            }
            _ => self.diameter / 2.0,
        };
        edge.clipped(inner, outer).ok_or_else(|| {
            Finding::error(
                Code::DRILL_CASE,
                "nothing of the tool cuts: the hole that is there is as wide as its edge",
            )
            .value_mm(2.0 * inner)
            .bound_mm(2.0 * edge.outer_radius())
            .key("pre_hole.diameter")
            .into()
        })
    }
}

/// The passages of each diameter of a stepped tool.
fn bands(spec: &DrillSpec, edge: &EdgeProfile, passages: &mut Vec<Passage>) -> Result<()> {
    let area = |e: &EdgeProfile| e.outer_radius().powi(2) - e.inner_radius().powi(2);
    let whole = area(edge);
    for band in spec.point.bands(spec.diameter)? {
        let Some(band) = band.clipped(edge.inner_radius(), edge.outer_radius()) else { continue };
        let share = area(&band) / whole;
        passages.push(Passage { transient: spec.goes_in(&band)?, side: Side::Entry, share });
        passages.extend(spec.comes_out(&band, share)?);
    }
    Ok(())
}

fn plan_along(spec: &DrillSpec, body: PassedBody) -> Result<DrillPlan> {
    let PassedBody { edge, passages, entry, above, exit, .. } = body;
    for (key, value) in [("approach", spec.approach), ("tolerance", spec.tolerance)] {
        not_negative(key, value)?;
    }
    if !spec.length.is_finite() {
        return Err(case("length", "the distance of the frames is not finite", spec.length, 0.0, "mm"));
    }
    let start = if above > entry.first { above } else { entry.first } + spec.approach;
    let end = match (spec.end, exit) {
        (End::Through { overrun, .. }, Some(exit)) => {
            not_negative("overrun", overrun)?;
            exit.last - overrun
        }
        (End::FullDiameter(_) | End::Tip(_), _) => spec.blind_end(&edge).unwrap_or(entry.last),
        (End::Reached(_), _) | (End::Through { .. }, None) => entry.last,
    };
    if let Some(exit) = exit
        && !(exit.first <= entry.first && exit.last <= entry.last)
    {
        return Err(Finding::error(Code::DRILL_CASE, "the exit lies above the entry")
            .value_mm(exit.first)
            .bound_mm(entry.first)
            .help("give the distance of the two frames (`length`), or correct the surfaces")
            .key("length")
            .into());
    }
    if !(end < entry.first) {
        return Err(case("depth", "the hole ends above the surface", end, entry.first, "mm"));
    }
    let spindle = spindle(spec, &edge)?;
    let (feeds, feed_sources) = feeds(spec)?;
    let travel = Travel { start, end };
    let mut found = Vec::with_capacity(4);
    zones(&passages, travel, &feeds, &mut found);
    let extent = edge.extent();
    let frames = Frames { point: extent[1] - extent[0], entry, exit, start, end, length: spec.length };
    let time = found.iter().map(|z| z.time(spindle)).sum();
    Ok(DrillPlan {
        edge,
        passages,
        entry,
        exit,
        travel,
        zones: found,
        lengths: frames.lengths(),
        coordinates: frames.coordinates(),
        spindle,
        feeds,
        feed_sources,
        balance: lip_balance(&edge, &spec.entry),
        time,
        constant_time: (start - end) / feeds.least() * TAU / spindle,
        findings: Vec::new(),
    })
}

/// The speed of the spindle; a cutting speed holds at the largest diameter that cuts.
fn spindle(spec: &DrillSpec, edge: &EdgeProfile) -> Result<f64> {
    let (key, value, rate) = match spec.turning {
        SpindleSpeed::CuttingSpeed(v) => ("cutting_speed", v, v / edge.outer_radius()),
        SpindleSpeed::Spindle(rate) => ("speed", rate, rate),
    };
    if value.is_finite() && value > 0.0 && rate.is_finite() && rate > 0.0 {
        return Ok(rate);
    }
    let what = format!("the {} must be positive", key.replace('_', " "));
    Err(case(key, &what, value, 0.0, if key == "speed" { "rad/s" } else { "mm/s" }))
}

/// The feeds given, the others recommended, each with its source.
fn feeds(spec: &DrillSpec) -> Result<(Feeds, [&'static str; 3])> {
    let steady = positive_feed("steady", spec.feed.steady)?;
    let recommended = |side: Side, surface: &BoundarySurface| advice(&spec.point, side, surface, false);
    let pick = |key: &str, given: Option<f64>, advised: Option<Advice>| -> Result<(f64, &'static str)> {
        Ok(match (given, advised) {
            (Some(feed), _) => (positive_feed(key, feed)?, GIVEN),
            (None, Some(a)) => (tidy(steady * a.share), a.source),
            (None, None) => (steady, OUR_DEFAULT),
        })
    };
    let entry = pick("entry", spec.feed.entry, Some(recommended(Side::Entry, &spec.entry)))?;
    let crossed = (!spec.bores.is_empty()).then_some(&spec.entry);
    let out = spec.end.exit().map(|s| advice(&spec.point, Side::Exit, s, crossed.is_some()));
    let out = out.or(crossed.map(|s| advice(&spec.point, Side::Exit, s, true)));
    let exit = pick("exit", spec.feed.exit, out)?;
    Ok((Feeds { entry: entry.0, steady, exit: exit.0 }, [entry.1, GIVEN, exit.1]))
}

/// A recommended feed, rounded to three digits.
fn tidy(feed: f64) -> f64 {
    let unit = 10f64.powf(feed.log10().floor() - 2.0);
    let rounded = (feed / unit).round() * unit;
    // The decimal number nearest to it, without the rounding of the unit.
    let decimals = 1e6;
    let decimal = (rounded * decimals).round() / decimals;
    if decimal > 0.0 { decimal } else { feed }
}

fn positive_feed(key: &str, feed: f64) -> Result<f64> {
    if feed.is_finite() && feed > 0.0 {
        return Ok(feed);
    }
    let key = format!("feed_per_rev.{key}");
    Err(case(&key, "a feed per revolution must be positive", feed, 0.0, "mm/rev"))
}

fn not_negative(key: &str, value: f64) -> Result<()> {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    Err(case(key, &format!("the {key} must not be negative"), value, 0.0, "mm"))
}

fn case(key: &str, what: &str, value: f64, bound: f64, unit: &str) -> crate::base::Error {
    Finding::error(Code::DRILL_CASE, what).value(value, unit).bound(bound, unit).key(key).into()
}

/// A finding when another place of the edge than its lowest touches first.
fn corner_first(spec: &DrillSpec, plan: &DrillPlan) -> Option<Finding> {
    let edge = &plan.edge;
    let [low, high] = edge.extent();
    let flat = high - low < LEVEL;
    // The outermost of the lowest places; of a flat edge, which is lowest everywhere, the innermost.
    let ends = edge.segments().iter().flat_map(|s| s.range().map(|r| (r, s.height(r))));
    let lowest = ends.filter(|(_, z)| z - low < LEVEL).map(|(r, _)| r);
    let tip =
        if flat { edge.inner_radius() } else { lowest.fold(0.0, |a: f64, r| if r > a { r } else { a }) };
    let ahead = plan.entry.first - spec.tolerance - (spec.entry.greatest(tip) - low);
    // Vertices of a mesh have 32 bits, and its stand-in plane is exact on the axis only.
    let least = if spec.passages.is_some() { MESH_LEVEL } else { LEVEL };
    if spec.pre_hole.is_some() || ahead <= least || plan.entry.first_radius <= tip + least {
        return None;
    }
    let what =
        format!("the corner at radius {:.3} mm touches first by {ahead:.3} mm", plan.entry.first_radius);
    let severe = !flat && !spec.guided;
    let finding = if severe {
        Finding::error(Code::CORNER_FIRST, what)
    } else {
        Finding::warning(Code::CORNER_FIRST, what)
    };
    Some(finding.help("spot-face or mill a flat, or guide the drill (guided = true)"))
}

fn findings(spec: &DrillSpec, plan: &DrillPlan) -> Vec<Finding> {
    let mut found = Vec::new();
    if let Some(finding) = corner_first(spec, plan) {
        found.push(finding);
    }
    let entry = advice(&spec.point, Side::Entry, &spec.entry, false);
    if entry.discouraged {
        let what = format!("an indexable drill is not recommended for a hollow face ({})", entry.source);
        found.push(Finding::warning(Code::DRILL_ADVICE, what).help("mill a flat, or use a solid drill"));
    }
    if let (DrillPoint::Flat, Some(hole)) = (&spec.point, spec.pre_hole.as_ref().map(|h| h.diameter))
        && hole > INDEXABLE_PRE_HOLE * spec.diameter
        && spec.method == super::DrillMethod::Drilling
    {
        let what = "an indexable drill is not guided in a hole above a quarter of its diameter";
        let finding = Finding::warning(Code::DRILL_ADVICE, what).value_mm(hole);
        found.push(finding.bound_mm(INDEXABLE_PRE_HOLE * spec.diameter).help("use a core drill, or bore it"));
    }
    if matches!(spec.point, DrillPoint::Annular { .. }) && plan.exit.is_some() {
        let what = "the core of an annular drill comes loose when it breaks through";
        let core = Finding::warning(Code::SLUG, what).value_mm(2.0 * plan.edge.inner_radius());
        found.push(core.help("catch it, or hold it from below"));
    }
    for zone in
        plan.zones.iter().filter(|z| matches!(z.stage, ZoneStage::Entry | ZoneStage::Exit | ZoneStage::Mixed))
    {
        if zone.revolutions() < 1.0 {
            let what = format!(
                "the {} lasts less than one revolution: its own feed has no effect",
                zone.stage.word()
            );
            found.push(Finding::note(Code::DRILL_ADVICE, what).value(zone.revolutions(), "rev"));
        }
    }
    if plan.lengths.steady < 0.0 {
        let what = "the drill breaks through before all of its point is in: no steady cutting";
        found.push(Finding::note(Code::DRILL_ADVICE, what).value_mm(plan.lengths.steady));
    }
    found
}
