//! The plan of an elliptic pocket: level by level down a helix (or into a pre-drilled hole), out along the spiral that
//! grows into the ellipse, once round the wall; then finishing laps with a lead-in that is the end of such a spiral.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::clearing::{EllipsePocket, ellipse};
use super::entry;
use super::figures::Opening;
use super::finish::descend;
use super::rough::enter;
use super::spec::{BoreSpec, Entry, Finish, Rough, Sense, no_stepover};
use super::spiral::from_centre;
use super::toolpath::{PlannedMove, Toolpath, ToolpathPace, ToolpathRole};
use crate::base::{Code, Finding, Result};
use crate::geom::{LensOrder, PlaneCurve, Spiral, Support, ellipse_distance};

/// Turns of the spiral whose end is the lead-in of finishing: its last turns are nearly parallel to the wall.
const LEAD_TURNS: u32 = 3;
/// Distance inside of the stock at which a lead-in begins, in allowances: clear of it by one more.
const CLEAR: f64 = 2.0;

/// An elliptic pocket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseSpec {
    /// Half axes of the wall [mm].
    pub half_axes: [f64; 2],
    /// Direction of the first half axis from X [rad].
    pub turned: f64,
    /// Order of the contact with the wall.
    pub order: LensOrder,
    /// Everything else, as of the bore with the short axis as its diameter.
    pub bore: BoreSpec,
}

/// A planned pocket.
#[derive(Clone, Debug, PartialEq)]
pub struct EllipsePlan {
    /// The moves in order, from the safe plane above the first entry back to the safe plane.
    pub moves: Vec<PlannedMove>,
    /// Turns of the roughing spiral.
    pub turns: f64,
    /// Its largest normal step, measured [mm].
    pub step: f64,
    /// Its largest engagement from the second turn on, measured [rad].
    pub engagement: f64,
}

/// Plans an elliptic pocket.
///
/// # Errors
/// `KC0401` when the cutter does not fit (saying where), `KC0403` for an impossible entry, `KC0404` for values out of
/// range; each with value, bound, key and help.
pub fn plan_ellipse(spec: &EllipseSpec) -> Result<EllipsePlan> {
    let bore = &spec.bore;
    let Some(rough) = &bore.rough else {
        return Err(Finding::error(Code::PLAN_VALUE, "an elliptic pocket needs roughing")
            .help("add `rough`")
            .key("rough")
            .into());
    };
    if !spec.turned.is_finite() {
        return Err(Finding::error(Code::PLAN_VALUE, "`angle` must be finite").key("angle").into());
    }
    // Along the long axis; a shape check first, which says where the cutter does not fit.
    let lying = EllipseSpec {
        half_axes: if spec.half_axes[0] < spec.half_axes[1] {
            [spec.half_axes[1], spec.half_axes[0]]
        } else {
            spec.half_axes
        },
        turned: if spec.half_axes[0] < spec.half_axes[1] { spec.turned + FRAC_PI_2 } else { spec.turned },
        ..*spec
    };
    let step = rough
        .stepover
        .ok_or_else(|| no_stepover("an elliptic pocket", bore.cutter.diameter).under("rough"))?;
    if let Some(wanted) = rough.touch_angle {
        return Err(Finding::error(
            Code::PLAN_VALUE,
            "the path of an elliptic pocket touches its wall on the short axis",
        )
        .value(wanted.to_degrees(), "deg")
        .help("leave out `touch_angle`")
        .key("rough.touch_angle")
        .into());
    }
    pocket(spec, rough.allowance, 0.0, step).check().map_err(|e| e.under("half_axes"))?;
    bore.check()?;
    let spec = &lying;
    let mut toolpath = Toolpath::new(bore);
    // A clockwise plan is made mirrored: so is the pocket.
    let turned = if bore.sense == Sense::Climb { spec.turned } else { -spec.turned };
    let figures = plan_rough(&mut toolpath, spec, rough, step, turned)?;
    if let Some(finish) = &bore.finish {
        plan_finish(&mut toolpath, spec, (rough.allowance, step), finish, turned)
            .map_err(|e| e.under("finish"))?;
    }
    toolpath.vertically(ToolpathRole::Retract, ToolpathPace::Rapid, bore.retract_z);
    Ok(EllipsePlan { moves: toolpath.moves, ..figures })
}

fn pocket(spec: &EllipseSpec, allowance: f64, inner: f64, step: f64) -> EllipsePocket {
    EllipsePocket {
        half_axes: spec.half_axes,
        cutter: spec.bore.cutter_radius(),
        allowance: allowance + spec.bore.stock_to_leave[0],
        inner,
        step,
        order: spec.order,
    }
}

fn plan_rough(
    toolpath: &mut Toolpath,
    spec: &EllipseSpec,
    rough: &Rough,
    step: f64,
    turned: f64,
) -> Result<EllipsePlan> {
    let bore = &spec.bore;
    let wall = bore.rough_radius(rough, bore.floor()).map_err(|e| e.under("rough"))?;
    let entry = entry::chosen(bore, rough, wall);
    entry::check(bore, rough, entry, wall)?;
    let inner = match (entry, rough.start) {
        (Entry::Helix { radius, .. }, _) => radius,
        (Entry::PreDrilled { diameter }, _) => 0.5 * diameter - bore.cutter_radius(),
        (Entry::Plunge, None) => 0.0,
        (Entry::Plunge, Some(_)) => {
            return Err(Finding::error(Code::PLAN_VALUE, "an elliptic pocket is roughed from its centre")
                .help("leave out `rough.start`")
                .key("rough.start")
                .into());
        }
    };
    let path = ellipse(&pocket(spec, rough.allowance, inner, step))?;
    let mut curves: Vec<PlaneCurve> = path.curves.iter().map(|c| c.rotated(turned)).collect();
    if let Entry::PreDrilled { .. } = entry {
        // From the centre of the hole to its wall, in the air.
        curves.insert(0, from_centre(inner, 1, turned)?.into());
    }
    let back = match path.curves.last() {
        Some(PlaneCurve::Spiral(spiral)) => {
            let [_, end] = spiral.parameters();
            PlaneCurve::from(spiral.between(end - PI, end).mirrored().reversed()).rotated(turned)
        }
        _ => return Err(Finding::error(Code::PLAN_VALUE, "an elliptic pocket has no spiral").into()),
    };
    let opening = Opening::on_circle(curves, inner, path.turns, path.step, turned);
    let lap = path.closing.rotated(turned);
    let levels = bore.levels(rough.stepdown, rough.allowance).map_err(|e| e.under("rough"))?;
    for level in &levels {
        toolpath.level = level.index;
        enter(toolpath, bore, rough, entry, &opening, level)?;
        for curve in &opening.curves {
            toolpath.along(ToolpathRole::Rough, rough.feed, curve);
        }
        toolpath.along(ToolpathRole::Circle, rough.feed, &lap);
        toolpath.along(ToolpathRole::LeadOut, rough.feed, &back);
    }
    Ok(EllipsePlan { moves: Vec::new(), turns: path.turns, step: path.step, engagement: path.engagement })
}

fn plan_finish(
    toolpath: &mut Toolpath,
    spec: &EllipseSpec,
    (allowance, step): (f64, f64),
    finish: &Finish,
    turned: f64,
) -> Result<()> {
    let bore = &spec.bore;
    let wall = pocket(spec, 0.0, 0.0, step);
    let (half_axes, offset) = (wall.half_axes, wall.cutter + wall.allowance);
    let lap = PlaneCurve::from(Spiral::new(Support::Ellipse { half_axes, offset }.into(), 0.0, TAU)?);
    let lap = lap.rotated(turned);
    let lead = lead(&wall, allowance)?;
    let way_out = lead.mirrored().reversed().rotated(turned);
    let way_in = lead.rotated(turned);
    let levels = bore.levels(finish.stepdown, 0.0)?;
    toolpath.finishing = true;
    for level in &levels {
        toolpath.level = level.index;
        descend(toolpath, bore, finish, level, way_in.start());
        toolpath.along(ToolpathRole::LeadIn, finish.feed, &way_in);
        for _ in 0..=finish.spring_passes {
            toolpath.along(ToolpathRole::Finish, finish.feed, &lap);
        }
        toolpath.along(ToolpathRole::LeadOut, finish.feed, &way_out);
    }
    Ok(())
}

/// The shortest end of a spiral, in half turns, that starts clear of the stock and does not turn back on itself.
fn lead(wall: &EllipsePocket, allowance: f64) -> Result<PlaneCurve> {
    /// Looks in a half turn: the weights have harmonics up to the fourth.
    const LOOKS: u32 = 48;
    let (half_axes, offset) = (wall.half_axes, wall.cutter + wall.allowance);
    let inner = 0.5 * (half_axes[1] - offset);
    let law = Support::Morph { inner, half_axes, offset, turns: f64::from(LEAD_TURNS), order: wall.order };
    let end = TAU * f64::from(LEAD_TURNS);
    let mut best: f64 = 0.0;
    for halves in 1..=2 * LEAD_TURNS {
        let start = end - PI * f64::from(halves);
        let turns_back = (0..=LOOKS).any(|i| law.radius(start + PI * f64::from(i) / f64::from(LOOKS)) <= 0.0);
        if turns_back {
            break;
        }
        let lead = Spiral::new(law.into(), start, end)?;
        let room = ellipse_distance(half_axes, lead.start()) - offset;
        best = best.max(room);
        if room >= CLEAR * allowance {
            return Ok(lead.into());
        }
    }
    Err(Finding::error(Code::PLAN_VALUE, "the allowance leaves no room for a lead-in")
        .value_mm(allowance)
        .bound_mm(best / CLEAR)
        .help("use a smaller allowance")
        .key("rough.allowance")
        .into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{ContactOrder, joint};
    use crate::holes::CutterData;

    fn pocket(sense: Sense) -> EllipseSpec {
        let cutter =
            CutterData { diameter: 16.0, centre_cutting: true, max_ramp_angle: None, flute_length: 30.0 };
        EllipseSpec {
            half_axes: [60.0, 40.0],
            turned: 0.5,
            order: LensOrder::One,
            bore: BoreSpec {
                sense,
                rough: Some(Rough { allowance: 0.5, ..Rough::new(4.0, 30.0) }),
                finish: Some(Finish { spring_passes: 1, ..Finish::new(20.0) }),
                ..BoreSpec::new(80.0, 40.0, cutter)
            },
        }
    }

    #[test]
    fn a_pocket_chains_smoothly_and_stays_inside_its_wall() {
        for sense in [Sense::Climb, Sense::Conventional] {
            let spec = pocket(sense);
            let plan = plan_ellipse(&spec).unwrap();
            let (mut nearest, mut laps) = (f64::INFINITY, 0);
            for pair in plan.moves.windows(2) {
                let [a, b] = pair else { unreachable!() };
                let j = joint(&a.curve, &b.curve);
                assert!(j.gap < 1e-9, "{} between {:?} and {:?}\n{a:?}\n{b:?}", j.gap, a.role, b.role);
                let cutting = |m: &PlannedMove| {
                    !matches!(
                        m.role,
                        ToolpathRole::Approach
                            | ToolpathRole::Link
                            | ToolpathRole::Retract
                            | ToolpathRole::Entry
                    )
                };
                if cutting(a) && cutting(b) {
                    assert!(j.contact >= ContactOrder::G4, "{j:?} {:?} {:?}", a.role, b.role);
                }
                laps += usize::from(b.role == ToolpathRole::Finish);
                for i in 0..40 {
                    if !cutting(b) {
                        break;
                    }
                    let p = b.curve.at(b.curve.length() * f64::from(i) / 40.0).p.truncate();
                    let turned = glam::DVec2::from_angle(-spec.turned).rotate(p);
                    let distance = ellipse_distance(spec.half_axes, turned);
                    nearest = nearest.min(distance);
                }
            }
            // The cutter's radius, and no less.
            assert!((nearest - 8.0).abs() < 1e-9, "{nearest}");
            // Two laps on each of two levels.
            assert_eq!(laps, 4);
        }
    }

    #[test]
    fn what_does_not_fit_is_refused_with_its_place() {
        let mut spec = pocket(Sense::Climb);
        spec.bore.cutter.diameter = 54.0;
        let e = plan_ellipse(&spec).unwrap_err();
        assert_eq!(e.code(), Code::CUTTER_TOO_LARGE);
        // b^2/a = 26.667 at the ends of the long axis.
        assert_eq!(e.0.point, Some([60.0, 0.0, 0.0]), "{e}");
        spec.bore.cutter.diameter = 90.0;
        assert_eq!(plan_ellipse(&spec).unwrap_err().code(), Code::CUTTER_TOO_LARGE);
        spec = pocket(Sense::Climb);
        spec.bore.rough = None;
        assert_eq!(plan_ellipse(&spec).unwrap_err().code(), Code::PLAN_VALUE);
    }
}
