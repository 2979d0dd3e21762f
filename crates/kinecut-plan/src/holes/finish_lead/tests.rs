//! Leads by their radius of curvature and by the place where they touch the wall, in whole plans.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec2;
use proptest::prelude::*;

use crate::base::{Code, Finding};
use crate::geom::{ContactOrder, LensOrder};
use crate::holes::{
    BorePlan, BoreSpec, CutterData, Entry, Finish, LeadEnd, PassFigures, PlannedMove, Rough, Sense, Strategy,
    ToolpathRole, plan_bore,
};
use crate::num::angle::wrap;

/// The paper's finishing: wall path of 80 mm, 1 mm of allowance, two turns.
fn paper(finish: Finish) -> BoreSpec {
    let cutter =
        CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: None, flute_length: 45.0 };
    BoreSpec {
        entry: Some(Entry::Plunge),
        rough: Some(Rough { allowance: 1.0, ..Rough::new(4.0, 100.0) }),
        finish: Some(finish),
        ..BoreSpec::new(200.0, 30.0, cutter)
    }
}

fn finish() -> Finish {
    Finish::new(50.0)
}

fn finished(spec: &BoreSpec) -> PassFigures {
    plan_bore(spec).unwrap().finish.unwrap()
}

fn refused(finish: Finish) -> Finding {
    plan_bore(&paper(finish)).unwrap_err().0.as_ref().clone()
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9 * b.abs().max(1.0), "{a} {b}");
}

/// First and last move of a role.
fn ends(plan: &BorePlan, role: ToolpathRole) -> [&PlannedMove; 2] {
    let moves: Vec<_> = plan.moves.iter().filter(|m| m.role == role).collect();
    [moves[0], moves[moves.len() - 1]]
}

/// A place relative to the bore's centre.
fn about(spec: &BoreSpec, p: glam::DVec3) -> DVec2 {
    p.truncate() - DVec2::from_array(spec.centre)
}

#[test]
fn the_papers_leads_follow_from_their_radius_of_curvature() {
    let involute = finished(&paper(Finish { start: LeadEnd::CurvatureRadius(57.5810791850552), ..finish() }));
    near(involute.roll, 9.04481476767708);
    near(involute.length, 242.249726898481);
    near(involute.curves[0].start().length(), 3200f64.sqrt());
    let lens = Finish { start: LeadEnd::CurvatureRadius(59.8301313925462), lead: LensOrder::One, ..finish() };
    let lens = finished(&paper(lens));
    near(lens.roll, 9.0799901497769);
    near(lens.length, 240.583995420465);
    near(lens.curves[0].start().length(), 3200f64.sqrt());
}

#[test]
fn the_papers_lead_in_follows_from_its_place_on_the_wall() {
    // Table 3: T0 = (-40, 40), the wall at (64.913, -46.758); psi = 0.946567321657524.
    let touch_angle = Some(0.946567321657524 - FRAC_PI_2);
    for start in [LeadEnd::Radius(3200f64.sqrt()), LeadEnd::CurvatureRadius(57.5810791850552)] {
        let found = finished(&paper(Finish { start, touch_angle, ..finish() }));
        near(found.psi, 0.946567321657524);
        near(wrap(found.start_angle - 9.99138208933461) + 1.0, 1.0);
        let [from, to] = [found.curves[0].start(), found.curves[1].start()];
        assert!((from - DVec2::new(-40.0, 40.0)).length() < 1e-9, "{from}");
        assert!((to - DVec2::new(64.9131188336368, -46.7577480562328)).length() < 1e-9, "{to}");
    }
}

#[test]
fn a_radius_of_curvature_that_is_none_is_refused_with_key_value_and_bound() {
    for (key, lead) in [
        ("finish.start_curvature_radius", |r| Finish { start: LeadEnd::CurvatureRadius(r), ..finish() }),
        ("finish.end_curvature_radius", |r| Finish { end: LeadEnd::CurvatureRadius(r), ..finish() }),
    ] as [(&str, fn(f64) -> Finish); 2]
    {
        for bad in [0.0, -57.0, f64::NAN, f64::INFINITY] {
            let f = refused(lead(bad));
            assert_eq!((f.code, f.key.as_deref()), (Code::PLAN_VALUE, Some(key)), "{f}");
            assert!(f.message.contains("must be positive") && !f.help.is_empty(), "{f}");
        }
        for order in [LensOrder::Zero, LensOrder::One, LensOrder::Two] {
            for bad in [80.0, 81.5] {
                let f = refused(Finish { lead: order, ..lead(bad) });
                assert_eq!((f.code, f.key.as_deref()), (Code::PLAN_VALUE, Some(key)), "{f}");
                let [value, bound] = [&f.value, &f.bound].map(|v| v.as_ref().unwrap().value);
                assert_eq!((value, bound), (bad, 80.0), "{f}");
                assert!(f.help.contains("less than 80"), "{f}");
            }
            // The place is in the stock: the bound is the radius at which it is just in the open.
            let f = refused(Finish { lead: order, ..lead(79.9) });
            assert_eq!((f.code, f.key.as_deref()), (Code::PLAN_VALUE, Some(key)), "{f}");
            let most = f.bound.unwrap().value;
            assert!(most > 60.0 && most < 79.9, "{most}");
            plan_bore(&paper(Finish { lead: order, ..lead(most - 1e-6) })).unwrap();
            plan_bore(&paper(Finish { lead: order, ..lead(most + 1e-6) })).unwrap_err();
        }
    }
}

#[test]
fn a_point_off_the_centre_and_a_place_on_the_wall_contradict_each_other() {
    let point = LeadEnd::Point([-40.0, 40.0]);
    let f = refused(Finish { start: point, touch_angle: Some(0.5), ..finish() });
    assert_eq!((f.code, f.key.as_deref()), (Code::PLAN_VALUE, Some("finish.touch_angle")), "{f}");
    assert!(f.message.contains("`touch_angle` and `start`"), "{f}");
    near(f.value.unwrap().value, 0.5f64.to_degrees());
    // Where the paper's lead-in touches the wall.
    let there = (0.946567321657524 - FRAC_PI_2).to_degrees();
    near(f.bound.unwrap().value, there);
    assert!(f.help.contains(&format!("{there:.3}")), "{}", f.help);
    let f = refused(Finish { end: point, end_touch_angle: Some(0.5), ..finish() });
    assert_eq!(f.key.as_deref(), Some("finish.end_touch_angle"), "{f}");
    assert!(f.message.contains("`end_touch_angle` and `end`"), "{f}");
    let mut spec = paper(finish());
    spec.rough = spec.rough.map(|r| Rough { start: Some([3.0, 0.0]), touch_angle: Some(0.5), ..r });
    let e = plan_bore(&spec).unwrap_err();
    assert_eq!((e.code(), e.0.key.as_deref()), (Code::PLAN_VALUE, Some("rough.touch_angle")), "{e}");
    // The centre leaves the direction free.
    let centre = LeadEnd::Point([0.0, 0.0]);
    let free = Finish { start: centre, end: centre, touch_angle: Some(0.5), ..finish() };
    let plan = plan_bore(&paper(free)).unwrap();
    near(ends(&plan, ToolpathRole::LeadIn)[1].curve.end().truncate().to_angle(), 0.5);
    let finishing = plan.moves.iter().rfind(|m| m.role == ToolpathRole::LeadOut).unwrap();
    near(finishing.curve.start().truncate().to_angle(), 0.5);
}

#[test]
fn directions_that_are_none_are_refused() {
    for bad in [f64::NAN, f64::INFINITY, 6.4, -6.4] {
        let f = refused(Finish { touch_angle: Some(bad), ..finish() });
        assert_eq!((f.code, f.key.as_deref()), (Code::PLAN_VALUE, Some("finish.touch_angle")), "{f}");
        assert!(f.bound.as_ref().unwrap().value == 360.0 && !f.help.is_empty(), "{f}");
        let f = refused(Finish { end_touch_angle: Some(bad), ..finish() });
        assert_eq!(f.key.as_deref(), Some("finish.end_touch_angle"), "{f}");
        let mut spec = paper(finish());
        spec.rough = spec.rough.map(|r| Rough { touch_angle: Some(bad), ..r });
        assert_eq!(plan_bore(&spec).unwrap_err().0.key.as_deref(), Some("rough.touch_angle"));
    }
    plan_bore(&paper(Finish { touch_angle: Some(360f64.to_radians()), ..finish() })).unwrap();
}

#[test]
fn every_strategy_touches_the_wall_in_the_wanted_direction() {
    use Strategy::{
        Annular, Archimedean, Arcs2, Arcs4, ConstantEngagement, Involute, Lens1, Lens2, OutlineHelix,
        Ramping, Rings, RingsTangent, Trochoidal,
    };
    let all = [
        Involute,
        Annular,
        Lens1,
        Lens2,
        ConstantEngagement,
        Arcs2,
        Arcs4,
        Archimedean,
        Rings,
        RingsTangent,
        Trochoidal,
        Ramping,
        OutlineHelix,
    ];
    for strategy in all {
        for (sense, resolution) in [(Sense::Climb, None), (Sense::Conventional, Some(1e-3))] {
            for wanted in [0.0, 2.0, -3.0] {
                let spec = paper(finish());
                let engagement = Some(60f64.to_radians());
                let rough =
                    spec.rough.map(|r| Rough { touch_angle: Some(wanted), engagement, allowance: 0.5, ..r });
                let entry = Some(Entry::Helix { radius: 10.0, pitch: 2.0 });
                let breakthrough = Some(0.5);
                let spec = BoreSpec {
                    strategy,
                    sense,
                    resolution,
                    rough,
                    entry,
                    breakthrough,
                    centre: [3.0, -7.0],
                    finish: None,
                    ..spec
                };
                let plan = plan_bore(&spec).unwrap();
                let circles: Vec<_> = plan.moves.iter().filter(|m| m.role == ToolpathRole::Circle).collect();
                for m in &circles {
                    let found = about(&spec, m.curve.start()).to_angle();
                    assert!(wrap(found - wanted).abs() < 1e-9, "{strategy:?} {sense:?} {found} {wanted}");
                }
                let widest =
                    circles.iter().map(|m| about(&spec, m.curve.start()).length()).fold(0.0, f64::max);
                near(widest, 79.5);
                for joint in plan.joints() {
                    assert!(joint.gap < 1e-9, "{strategy:?} {joint:?}");
                }
            }
        }
    }
}

#[test]
fn an_elliptic_pocket_has_its_place_on_the_wall() {
    let spec = paper(finish());
    let rough = spec.rough.map(|r| Rough { touch_angle: Some(1.0), ..r });
    let bore = BoreSpec { rough, ..spec };
    let pocket =
        crate::holes::EllipseSpec { half_axes: [140.0, 100.0], turned: 0.0, order: LensOrder::One, bore };
    let e = crate::holes::plan_ellipse(&pocket).unwrap_err();
    assert_eq!((e.code(), e.0.key.as_deref()), (Code::PLAN_VALUE, Some("rough.touch_angle")), "{e}");
}

/// Curvature radius of the free end, and direction, tangent and distance at the wall, of a lead in a plan.
fn assert_lead(spec: &BoreSpec, m: [&PlannedMove; 2], curvature: f64, direction: f64, out: bool) {
    let [first, last] = m;
    let (free, wall) = if out {
        (last.curve.at(last.curve.length()), first.curve.at(0.0))
    } else {
        (first.curve.at(0.0), last.curve.at(last.curve.length()))
    };
    let radius = 0.5 * (spec.diameter - spec.cutter.diameter);
    let found = 1.0 / free.d2.length();
    assert!((found / curvature - 1.0).abs() < 1e-6, "{found} {curvature} {spec:?}");
    let p = about(spec, wall.p);
    assert!((p - radius * DVec2::from_angle(direction)).length() < 1e-9 * radius, "{p} {direction} {spec:?}");
    let sign = if spec.sense == Sense::Climb { 1.0 } else { -1.0 };
    let tangent = sign * DVec2::from_angle(direction).perp();
    assert!((wall.d1.truncate() - tangent).length() < 1e-9, "{wall:?} {spec:?}");
}

proptest! {
    #![proptest_config(kinecut_cases::property(256))]
    #[test]
    fn a_lead_has_its_radius_of_curvature_and_touches_the_wall_where_it_is_wanted(
        radius in 2.0..200.0f64, turns in 1u32..6, order in 0usize..3, shares in [0.02..0.95f64, 0.02..0.95],
        directions in [-6.2..6.2f64, -6.2..6.2], cw: bool, fine in 0usize..3,
    ) {
        let lead = [LensOrder::Zero, LensOrder::One, LensOrder::Two][order];
        let [start, end] = shares.map(|share| LeadEnd::CurvatureRadius(share * radius));
        let [touch_angle, end_touch_angle] = directions.map(Some);
        let finish = Finish { turns, lead, start, end, touch_angle, end_touch_angle, ..finish() };
        let diameter = 2.0 * radius + 40.0;
        let spec = BoreSpec {
            centre: [17.0, -250.5],
            diameter,
            sense: if cw { Sense::Conventional } else { Sense::Climb },
            resolution: [None, Some(1e-3), Some(1e-4)][fine],
            rough: Some(Rough { allowance: 0.02 * radius, ..Rough::new(0.2 * radius.min(40.0), 100.0) }),
            finish: Some(finish),
            ..paper(finish)
        };
        let plan = match plan_bore(&spec) {
            Ok(plan) => plan,
            Err(e) => {
                // Only where it would start in the stock.
                prop_assert_eq!(e.code(), Code::PLAN_VALUE, "{}", e);
                let [value, bound] = [&e.0.value, &e.0.bound].map(|v| v.as_ref().unwrap().value);
                prop_assert!(value > bound && bound < radius, "{e}");
                return Ok(());
            }
        };
        let begin = plan.moves.iter().position(|m| m.role == ToolpathRole::LeadIn).unwrap();
        let finishing = BorePlan { moves: plan.moves[begin..].to_vec(), ..plan.clone() };
        let [start, end] = shares.map(|share| share * radius);
        assert_lead(&spec, ends(&finishing, ToolpathRole::LeadIn), start, directions[0], false);
        assert_lead(&spec, ends(&finishing, ToolpathRole::LeadOut), end, directions[1], true);
        let contact = [ContactOrder::G2, ContactOrder::G3, ContactOrder::G3][order];
        let cut = finishing.moves.iter().filter(|m| m.role != ToolpathRole::Retract).count();
        for joint in &finishing.joints()[..cut - 1] {
            prop_assert!(joint.contact >= ContactOrder::G2 && joint.gap < 1e-9 * radius.max(1.0), "{joint:?}");
        }
        let at_wall = finishing.moves.iter().position(|m| m.role == ToolpathRole::Finish).unwrap();
        prop_assert!(finishing.joints()[at_wall - 1].contact >= contact, "{:?}", finishing.joints());
        // From the lead-in on round, and on to where the lead-out leaves.
        let swept: f64 = finishing.moves.iter().filter(|m| m.role == ToolpathRole::Finish).map(|m| m.curve.length()).sum();
        let between = (if cw { directions[0] - directions[1] } else { directions[1] - directions[0] }).rem_euclid(TAU);
        prop_assert!(((swept / radius - TAU) - between).abs() < 1e-6 || between > TAU - 1e-6, "{swept} {between}");
    }

    #[test]
    fn a_conventional_lead_is_the_mirror_image_of_a_climb_lead(
        share in 0.1..0.8f64, direction in -3.0..3.0f64, form in 0usize..4, order in 0usize..3,
    ) {
        let start = [
            LeadEnd::Usual,
            LeadEnd::Radius(80.0 * share),
            LeadEnd::Length(100.0 + 300.0 * share),
            LeadEnd::CurvatureRadius(80.0 * share),
        ][form];
        let lead = [LensOrder::Zero, LensOrder::One, LensOrder::Two][order];
        let at = |touch: f64, out: f64, sense| BoreSpec {
            sense,
            ..paper(Finish { start, lead, touch_angle: Some(touch), end_touch_angle: Some(out), ..finish() })
        };
        let climb = plan_bore(&at(direction, 0.5, Sense::Climb)).unwrap();
        let other = plan_bore(&at(PI - direction, PI - 0.5, Sense::Conventional)).unwrap();
        prop_assert_eq!(climb.moves.len(), other.moves.len());
        for (a, b) in climb.moves.iter().zip(&other.moves) {
            for u in [0.0, 0.37, 1.0] {
                let (p, q) = (a.curve.at(a.curve.length() * u).p, b.curve.at(b.curve.length() * u).p);
                prop_assert!((p - glam::DVec3::new(-q.x, q.y, q.z)).length() < 1e-9, "{p} {q}");
            }
        }
    }
}
