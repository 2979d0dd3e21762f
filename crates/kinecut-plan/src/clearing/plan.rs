//! The plan of a pocket: levels, entries, passes, links, and the moves along them.

use std::f64::consts::PI;

use glam::DVec2;

use super::earlier::LeftStock;
use super::entry::Entering;
use super::level::{Cleared, Clearer, Element};
use super::moves::run;
use super::region::CentreRegion;
use super::spec::PocketSpec;
use super::swept::Clearing;
use crate::base::bounded::{MAX_LENGTH, bounded, length, positive};
use crate::base::{Code, CountBound, Finding, Result, Severity};
use crate::geom::{Outline, OutlineEdge};
use crate::holes::PlannedMove;
use crate::holes::levels::levels;
use crate::holes::route::Route;

/// Stock that passes leave beside the wall for the lap along it, beyond that asked for [mm].
pub const WALL_STOCK: f64 = 0.02;
/// Radius of the helix where none is given, in radii of the cutter.
pub(super) const HELIX: f64 = 0.8;
/// Least radius of the helix, in radii of the cutter.
pub(super) const LEAST_HELIX: f64 = 0.3;
/// Distance of arcs from the way that was walked: at most, and in radii of the cutter [mm].
const TOLERANCE: (f64, f64) = (0.01, 0.001);
/// Engagement that is kept for the difference between the arcs and the way that was walked [rad].
pub(super) const FIT: f64 = 0.004;
/// Range of the engagement [deg].
pub(super) const ENGAGEMENT: [f64; 2] = [5.0, 120.0];
/// Steepest helix [deg].
const STEEPEST: f64 = 45.0;
/// Least width of the region of the cutter's centre, how far a place may lie from where it is wider, and the step between looks,
/// all in radii of the cutter.
const NARROW: f64 = 0.06;
const NECK: f64 = 0.3;
const STEPS: f64 = 0.1;
/// Area that may be left at one place, in squares of the cutter's radius: that of a corner.
const LEFT: f64 = 0.15;
/// Area at one place that the lap along the wall must not meet, in squares of the cutter's radius.
const SLOTTED: f64 = 0.5;

pub(super) const CELLS: CountBound = CountBound {
    what: "cells of the pocket",
    most: 2e7,
    bytes: 32,
    code: Code::PLAN_VALUE,
    help: "use a larger cutter, or part the pocket",
};

/// A planned pocket.
#[derive(Clone, Debug, PartialEq)]
pub struct PocketPlan {
    /// Moves of the cutter's tip centre, in coordinates of the work offset.
    pub moves: Vec<PlannedMove>,
    /// Heights of the levels, the lowest last [mm].
    pub levels: Vec<f64>,
    /// The figures of a level.
    pub figures: PocketFigures,
    /// Advice and warnings.
    pub findings: Vec<Finding>,
}

/// Figures of one level of a pocket.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PocketFigures {
    /// Number of passes.
    pub passes: usize,
    /// Number of ways down into the stock: helices, ramps and plunges.
    pub entries: usize,
    /// Number of ramps among them.
    pub ramps: usize,
    /// Number of plunges among them.
    pub plunges: usize,
    /// Engagement of these ways seen from above: half of the cutter's circle; 0 without any [rad].
    pub entry: f64,
    /// Number of ways over the part, beside the first.
    pub retracts: usize,
    /// Length of the passes [mm].
    pub cutting: f64,
    /// Length of the links through what is cleared [mm].
    pub links: f64,
    /// Length that no path can be shorter than which climbs along what it leaves and holds the engagement [mm].
    pub bound: f64,
    /// Area that the cutter reaches [mm2].
    pub area: f64,
    /// Largest engagement of a pass [rad].
    pub largest: f64,
    /// Area that the passes leave at corners and between walls, for the lap along the wall [mm2].
    pub left: f64,
    /// Places that an earlier cutter has left, where only those are cleared.
    pub rest: Option<RestFigures>,
}

/// Places that an earlier cutter has left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RestFigures {
    /// Number of places that passes clear.
    pub places: usize,
    /// Number of places with so little that the lap along the wall takes it: less than 10 degrees of the cutter's circle everywhere.
    pub to_lap: usize,
}

/// Plans the clearing of a pocket, without its wall.
///
/// # Errors
/// `KC0401` where the cutter does not fit, `KC0403` where it cannot enter, `KC0404` for numbers out of range; those of
/// offsets. Keys are those of the table of the operation.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::clearing::{PocketSpec, plan_pocket};
/// use kinecut::geom::Outline;
/// use kinecut::holes::CutterData;
/// let corners = [dvec2(0.0, 0.0), dvec2(60.0, 0.0), dvec2(60.0, 40.0), dvec2(0.0, 40.0)];
/// let cutter = CutterData { diameter: 10.0, centre_cutting: true, max_ramp_angle: None, flute_length: 22.0 };
/// let plan = plan_pocket(&PocketSpec::new(Outline::polygon(&corners)?, 6.0, cutter, 10.0))?;
/// assert!(plan.figures.largest.to_degrees() < 60.1);
/// assert!(plan.figures.cutting < 1.25 * plan.figures.bound);
/// assert!(plan.moves.windows(2).all(|w| (w[1].curve.start() - w[0].curve.end()).length() < 1e-9));
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn plan_pocket(spec: &PocketSpec) -> Result<PocketPlan> {
    check(spec, ENGAGEMENT)?;
    let a = spec.radius();
    let inset = a + spec.allowance + WALL_STOCK;
    // Conventional is climb in the mirror.
    let mirrored = !spec.keeps_right();
    let face = if mirrored { spec.outline.mirrored() } else { spec.outline.clone() };
    let stock = spec.stock.as_ref().map(|s| if mirrored { s.mirrored() } else { s.clone() });
    let Some(region) = CentreRegion::new(&face, inset)? else { return Err(too_large(spec, &face)) };
    CELLS.check(Clearing::cells(region.bounds(), a))?;
    let region = region.with_far(a);
    wide_enough(spec, &face, &region, inset)?;
    let mut clearing = Clearing::new(region.bounds(), a);
    if let Some(stock) = &stock {
        clearing = clearing.with_stock(stock);
    }
    let flip = |p: DVec2| if mirrored { DVec2::new(p.x, -p.y) } else { p };
    let holes: Vec<(DVec2, f64)> = spec.holes.iter().map(|(p, r)| (flip(*p), *r)).collect();
    let rest = match &spec.rest {
        None => None,
        Some(cutter) => {
            let left = LeftStock::new(&face, cutter, (&region, a), &clearing)?;
            for stock in &left.stock {
                clearing = clearing.with_stock(stock);
            }
            Some(left)
        }
    };
    for (p, radius) in holes.iter().filter(|(_, radius)| *radius >= a) {
        clearing.sweep(*p, *p, *radius);
    }
    let depth = spec.depth + spec.breakthrough;
    let floors = levels(spec.top, depth, spec.stepdown.unwrap_or(spec.cutter.flute_length), |_| Ok(a))?;
    let (most, share) = TOLERANCE;
    let mut clearer = Clearer {
        region: &region,
        clearing: &mut clearing,
        radius: a,
        holes: &holes,
        wanted: spec.engagement - FIT,
        entering: Entering::of(spec, &floors),
        is_rest: spec.rest.is_some(),
        tolerance: most.min(share * a),
    };
    let is_whole = stock.is_none() && holes.is_empty() && rest.is_none();
    let nothing_left = rest.as_ref().is_some_and(|left| left.places == 0);
    let stock_area = match is_whole {
        true => f64::INFINITY,
        false if nothing_left => 0.0,
        false => clearer.stock_area(),
    };
    let mut cleared = if nothing_left { Cleared::default() } else { clearer.run() };
    if mirrored {
        cleared.mirror();
    }
    if let Some(part) = cleared.no_way_in {
        return Err(part.error(spec, inset));
    }
    let mut route = Route::new(spec.retract_z, spec.approach_z);
    for level in &floors {
        route.level = level.index;
        run(spec, &cleared, &mut route, [level.above, level.floor])?;
    }
    route.retract();
    let area = region.reached(a);
    let uncut = stock_area.min(area);
    let rest = rest.map(|left| RestFigures { places: left.places, to_lap: left.to_lap });
    let figures = PocketFigures { rest, ..figures(spec, [area, uncut], &cleared) };
    let mut findings: Vec<Finding> = parts(&region).into_iter().collect();
    findings.extend(rest.filter(|rest| rest.places == 0).map(nothing_to_clear));
    findings.extend(
        rest.filter(|rest| rest.places > 0 && figures.passes == 0).map(|_| only_by_lap(figures.left)),
    );
    findings.extend(cleared.standing.map(standing));
    if let Some((area, at)) = cleared.largest_left
        && area > LEFT * a * a
    {
        let finding = left(area, at);
        if area > SLOTTED * a * a {
            return Err(finding.into());
        }
        findings.push(Finding { severity: Severity::Warning, ..finding });
    }
    Ok(PocketPlan { moves: route.moves, levels: floors.iter().map(|l| l.floor).collect(), figures, findings })
}

/// Numbers in their ranges; `engagement`: least and largest [deg].
pub(super) fn check(spec: &PocketSpec, engagement: [f64; 2]) -> Result<()> {
    positive("tool", spec.cutter.diameter, MAX_LENGTH, "mm")?;
    positive("depth", spec.depth, MAX_LENGTH, "mm")?;
    length("breakthrough", spec.breakthrough, 0.0, MAX_LENGTH)?;
    length("allowance", spec.allowance, 0.0, MAX_LENGTH)?;
    length("lift", spec.lift, 0.0, MAX_LENGTH)?;
    for (key, feed) in [("feed", spec.feed), ("plunge_feed", spec.plunge_feed), ("link_feed", spec.link_feed)]
    {
        positive(key, feed, 1e6, "mm/s")?;
    }
    bounded("engagement", spec.engagement.to_degrees(), engagement[0], engagement[1], "deg")?;
    let steepest = spec.cutter.max_ramp_angle.map_or(STEEPEST, |most| most.to_degrees().min(STEEPEST));
    let ramp = spec.ramp.to_degrees();
    if !(ramp > 0.0 && ramp <= steepest + 1e-9) {
        let what = "the helix or ramp is steeper than the cutter can follow, or level";
        return Err(Finding::error(Code::PLAN_VALUE, what)
            .value(ramp, "deg")
            .bound(steepest, "deg")
            .help("write a smaller angle, above 0")
            .key("entry.helix")
            .into());
    }
    if let Some(step) = spec.stepdown {
        positive("stepdown", step, spec.cutter.flute_length + 1e-6, "mm")?;
    }
    if let Some(radius) = spec.helix_radius {
        positive("entry.radius", radius, spec.radius(), "mm")?;
    }
    Ok(())
}

/// A place in words; no zero has a sign.
pub(super) fn place(at: DVec2) -> String {
    let [x, y] = [at.x, at.y].map(|v| (v * 1e3).round() / 1e3 + 0.0);
    format!("({x:.3}, {y:.3})")
}

/// The cutter does not fit anywhere.
fn too_large(spec: &PocketSpec, face: &Outline) -> crate::base::Error {
    // The widest place is where the last offset vanishes.
    let (mut low, mut high) = (0.0, spec.radius() + spec.allowance + WALL_STOCK);
    let mut at = face.edges()[0].start;
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        match CentreRegion::new(face, middle) {
            Ok(Some(region)) => {
                low = middle;
                at = region.loops[0].edges[0].start;
            }
            _ => high = middle,
        }
    }
    let at = if spec.keeps_right() { at } else { DVec2::new(at.x, -at.y) };
    let widest = 2.0 * (low - spec.allowance - WALL_STOCK).max(0.0);
    let what = format!(
        "the cutter does not fit: the widest place of the pocket is {:.3} mm, at {}",
        2.0 * low,
        place(at)
    );
    Finding::error(Code::CUTTER_TOO_LARGE, what)
        .value_mm(spec.cutter.diameter)
        .bound_mm(widest)
        .point([at.x, at.y, 0.0])
        .help(format!("take a cutter of {:.1} mm (0.7 of the width) or less", 1.4 * low))
        .key("tool")
        .into()
}

/// Whether the region of the cutter's centre is everywhere so wide that passes go on in it.
fn wide_enough(spec: &PocketSpec, face: &Outline, region: &CentreRegion, inset: f64) -> Result<()> {
    let a = spec.radius();
    let smaller = CentreRegion::new(face, inset + 0.5 * NARROW * a)?;
    let step = STEPS * a;
    for edge in region.loops.iter().flat_map(|l| &l.edges) {
        let count = (edge.length() / step).ceil().max(1.0) as usize;
        for k in 0..count {
            let p = edge.at(k as f64 / count as f64);
            let far = smaller.as_ref().map_or(f64::INFINITY, |s| s.nearest_inside(p).distance(p));
            if far <= NECK * a {
                continue;
            }
            let p = if spec.keeps_right() { p } else { DVec2::new(p.x, -p.y) };
            let what = format!(
                "the pocket is hardly wider than the cutter at {}: no pass goes on there within the engagement",
                place(p)
            );
            return Err(Finding::error(Code::POCKET_LEFT, what)
                .value_mm(spec.cutter.diameter)
                .bound_mm(spec.cutter.diameter - NARROW * a)
                .point([p.x, p.y, 0.0])
                .help("take a smaller cutter")
                .key("tool")
                .into());
        }
    }
    Ok(())
}

/// Whether every helix of a slot finds room.
pub(super) fn entries(spec: &PocketSpec, cleared: &Cleared) -> Result<()> {
    let least = LEAST_HELIX * spec.radius();
    for element in &cleared.elements {
        let Element::Helix { middle, radius, .. } = element else { continue };
        if *radius >= least * (1.0 - 1e-9) || spec.cutter.centre_cutting && *radius > 1e-3 {
            continue;
        }
        let what = format!("no way in at {}: the helix has no room", place(*middle));
        return Err(Finding::error(Code::ENTRY_IMPOSSIBLE, what)
            .value_mm(*radius)
            .bound_mm(least)
            .point([middle.x, middle.y, 0.0])
            .help("take a smaller cutter, or one that cuts at its centre")
            .key("tool")
            .into());
    }
    Ok(())
}

/// The figures; `area`, `uncut`: areas that the cutter reaches, and that of the stock in it [mm2].
pub(super) fn figures(spec: &PocketSpec, [area, uncut]: [f64; 2], cleared: &Cleared) -> PocketFigures {
    let a = spec.radius();
    let mut f = PocketFigures { left: cleared.left, area, ..PocketFigures::default() };
    let mut entered = 0.0;
    for element in &cleared.elements {
        match element {
            Element::Helix { radius, .. } => {
                f.entries += 1;
                f.entry = PI;
                entered += PI * (radius + a) * (radius + a);
            }
            Element::RampIn(edges) | Element::PlungeIn(_, edges) => {
                let plunges = usize::from(matches!(element, Element::PlungeIn(..)));
                f.entries += 1;
                f.plunges += plunges;
                f.ramps += 1 - plunges;
                f.entry = PI;
                entered += PI * a * a + 2.0 * a * edges.iter().map(OutlineEdge::length).sum::<f64>();
            }
            Element::Down(_) => f.retracts += 1,
            Element::Link(edges) | Element::Back(edges) => {
                f.links += edges.iter().map(OutlineEdge::length).sum::<f64>();
            }
            Element::Ramp(edges) => {
                f.entries += 1;
                f.ramps += 1;
                f.entry = PI;
                f.passes += 1;
                f.cutting += edges.iter().map(OutlineEdge::length).sum::<f64>();
                f.largest = PI;
            }
            Element::Pass(pass) => {
                f.passes += 1;
                f.cutting += pass.edges.iter().map(OutlineEdge::length).sum::<f64>();
                f.largest = f.largest.max(pass.largest);
            }
        }
    }
    f.bound = (uncut - entered).max(0.0) / (a * (1.0 - spec.engagement.cos()));
    f
}

/// A note where the pocket has parts between which the cutter does not pass.
fn parts(region: &CentreRegion) -> Option<Finding> {
    let count = region.loops.iter().filter(|l| l.around.is_some()).count();
    let what = format!("the pocket has {count} parts for this cutter: each is entered by itself");
    let help = "a smaller cutter may pass between them";
    (count > 1).then(|| Finding::note(Code::POCKET_PARTS, what).help(help).key("tool"))
}

/// A note where an earlier cutter has left nothing to passes.
fn nothing_to_clear(rest: RestFigures) -> Finding {
    let what = match rest.to_lap {
        0 => "the cutter before has left nothing to this one".to_owned(),
        n => format!(
            "the cutter before has left nothing to passes of this one: the lap along the wall takes what is at {n} places"
        ),
    };
    Finding::note(Code::POCKET_REST, what)
        .help("leave the operation out, or take a smaller cutter")
        .key("rest")
}

/// A warning where no pass begins at what an earlier cutter has left: it lies along all of the wall, thinner than passes are begun at.
fn only_by_lap(area: f64) -> Finding {
    let what = format!(
        "{area:.1} mm2 along the wall that the cutter before has left are left to the lap: no pass begins there, and the lap cuts them at the engagement that comes"
    );
    Finding::warning(Code::POCKET_LEFT, what)
        .help("give `finish`, or leave less stock on the wall before")
        .key("rest")
}

/// A warning about stock that stands between passes and is not swept.
fn standing(at: DVec2) -> Finding {
    let what =
        format!("stock stands between passes at {}: no way goes over it within the engagement", place(at));
    Finding::warning(Code::POCKET_LEFT, what)
        .point([at.x, at.y, 0.0])
        .help("allow a larger engagement, or take another cutter")
        .key("engagement")
}

/// A finding about stock that passes leave to the lap along the wall.
fn left(area: f64, at: DVec2) -> Finding {
    let what = format!(
        "{area:.1} mm2 at {} are left to the lap along the wall: no pass reaches them within the engagement",
        place(at)
    );
    Finding::error(Code::POCKET_LEFT, what)
        .point([at.x, at.y, 0.0])
        .help("allow a larger engagement, or take a smaller cutter")
        .key("engagement")
}
