//! Whole plans: the paper's example, the chain of moves, safety of rapids, what is swept, what is refused.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use proptest::prelude::*;

use super::{Strategy, *};
use crate::base::Code;
use crate::geom::{ContactOrder, CurveKind, InvoluteRecord, joint};

/// The paper's bore: D = 200, d = 40, H = 4, allowance 1, T0 = (-40, 40), two turns.
fn paper() -> BoreSpec {
    let cutter =
        CutterData { diameter: 40.0, centre_cutting: true, max_ramp_angle: Some(0.1), flute_length: 45.0 };
    BoreSpec {
        entry: Some(Entry::Plunge),
        rough: Some(Rough { allowance: 1.0, plunge_feed: Some(5.0), ..Rough::new(4.0, 100.0) }),
        finish: Some(Finish { start: LeadEnd::Point([-40.0, 40.0]), ..Finish::new(50.0) }),
        ..BoreSpec::new(200.0, 30.0, cutter)
    }
}

fn with_rough(spec: BoreSpec, change: impl Fn(&mut Rough)) -> BoreSpec {
    let mut rough = spec.rough.unwrap();
    change(&mut rough);
    BoreSpec { rough: Some(rough), ..spec }
}

/// Every way to begin, both senses, several levels, exact and for a control.
fn variants() -> Vec<BoreSpec> {
    let mut all = Vec::new();
    for (start, entry) in [
        (None, Entry::Plunge),
        (Some([20.0, -255.5]), Entry::Plunge),
        (None, Entry::Helix { radius: 12.0, pitch: 3.0 }),
        (None, Entry::PreDrilled { diameter: 60.0 }),
        (None, Entry::PreDrilled { diameter: 41.0 }),
    ] {
        for sense in [Sense::Climb, Sense::Conventional] {
            for resolution in [None, Some(1e-4), Some(1e-3)] {
                for (ends, deep) in [
                    (None, false),
                    (Some(([-23.0, -210.5], [27.0, -195.5])), true),
                    (Some(([17.0, -250.5], [17.0, -250.5])), false),
                ] {
                    let entry = Some(entry);
                    let spec = BoreSpec { centre: [17.0, -250.5], entry, sense, resolution, ..paper() };
                    let spec = with_rough(spec, |r| r.start = start);
                    let spec = if deep {
                        BoreSpec { breakthrough: Some(2.0), depth: 61.0, ..spec }
                    } else {
                        with_rough(spec, |r| r.stepdown = Some(11.0))
                    };
                    let [start, end] = ends.map_or([LeadEnd::Usual; 2], |e| [e.0, e.1].map(LeadEnd::Point));
                    let finish = Finish { start, end, ..spec.finish.unwrap() };
                    all.push(BoreSpec { finish: Some(finish), ..spec });
                }
            }
        }
    }
    all
}

fn xy(p: DVec3, spec: &BoreSpec) -> DVec2 {
    p.truncate() - DVec2::from_array(spec.centre)
}

/// Chain, order of contact, ends on the safe plane, heights.
fn assert_chain(spec: &BoreSpec, plan: &BorePlan) {
    let (first, last) = (&plan.moves[0], plan.moves.last().unwrap());
    assert_eq!((first.curve.start().z, last.curve.end().z), (spec.retract_z, spec.retract_z));
    assert!(first.pace == ToolpathPace::Rapid && last.pace == ToolpathPace::Rapid);
    let bottom = spec.top - spec.full_depth();
    for (w, joint) in plan.moves.windows(2).zip(plan.joints()) {
        let (a, b) = (&w[0], &w[1]);
        assert!(joint.gap < 1e-9, "{joint:?}\n{a:?}\n{b:?}\n{spec:?}");
        let planar = |m: &PlannedMove| {
            matches!(
                m.role,
                ToolpathRole::Rough
                    | ToolpathRole::Circle
                    | ToolpathRole::LeadIn
                    | ToolpathRole::Finish
                    | ToolpathRole::LeadOut
            )
        };
        if planar(a) && planar(b) {
            assert!(joint.contact >= ContactOrder::G2, "{joint:?}\n{a:?}\n{b:?}");
        }
        // The foot of a helix is level.
        if a.role == ToolpathRole::Entry && b.role == ToolpathRole::Circle {
            assert_eq!(joint.contact, ContactOrder::G3, "{joint:?}");
        }
    }
    for m in &plan.moves {
        assert!(m.curve.end().z >= bottom - 1e-9);
        assert!(!matches!(m.pace, ToolpathPace::Feed(f) if f <= 0.0));
        assert!(m.curve.length() > 0.0);
    }
    assert!(plan.moves.iter().any(|m| (m.curve.end().z - bottom).abs() < 1e-9), "the floor is never reached");
}

/// Rapids below the top stay in what a circle at the wall, or the drill, has cleared before.
fn assert_rapids_in_air(spec: &BoreSpec, plan: &BorePlan) {
    let drilled = spec.drilled().map_or(0.0, |d| 0.5 * d);
    let mut cleared: Vec<(f64, f64)> = Vec::new();
    for m in &plan.moves {
        if m.pace == ToolpathPace::Rapid {
            for i in 0..=20 {
                let p = m.curve.at(m.curve.length() * f64::from(i) / 20.0).p;
                let out = xy(p, spec).length();
                // Upwards from the floor is free: the tip has just been there.
                let free = p.z >= spec.top
                    || out + spec.cutter_radius() <= drilled
                    || cleared.iter().any(|(floor, radius)| p.z >= *floor - 1e-9 && out <= radius + 1e-9);
                assert!(free, "rapid through stock at {p}: {m:?}");
            }
        }
        let at_wall = m.role == ToolpathRole::Circle || m.role == ToolpathRole::Finish;
        if at_wall
            && let CurveKind::Arc(arc) = m.curve.kind()
            && arc.sweep.abs() > TAU - 1e-9
        {
            // A circle about a helix clears its inside too, for its radius is below the cutter's.
            cleared.push((arc.start.z, arc.radius()));
        }
    }
}

/// No point of the floor is farther than the cutter's radius from the path on it, and none outside the bore is nearer.
fn assert_swept(spec: &BoreSpec, plan: &BorePlan) {
    let (a, bore, bottom) = (spec.cutter_radius(), 0.5 * spec.diameter, spec.top - spec.full_depth());
    let mut points = Vec::new();
    for m in plan.moves.iter().filter(|m| (m.curve.end().z - bottom).abs() < 1e-9) {
        points.extend(m.curve.polyline(0.01).iter().filter(|p| p.z < bottom + 1e-9).map(|p| xy(*p, spec)));
    }
    let most = points.iter().fold(0f64, |m, p| m.max(p.length()));
    assert!(most <= bore - a + 1e-9, "{most}");
    assert!(spec.finish.is_none() || most >= bore - a - 1e-9);
    let drilled = spec.drilled().map_or(0.0, |d| 0.5 * d);
    for i in 0..60 {
        for j in 0..24 {
            let p = DVec2::from_angle(TAU * f64::from(j) / 24.0) * ((bore - 1.2) * f64::from(i) / 59.0);
            let near = points.iter().fold(f64::INFINITY, |m, q| m.min((*q - p).length()));
            assert!(near <= a + 0.02 || p.length() <= drilled, "a core stands at {p}: {near}\n{spec:?}");
        }
    }
}

#[test]
fn the_papers_bore_has_the_figures_of_its_tables_corrected() {
    let plan = plan_bore(&paper()).unwrap();
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * b.abs().max(1.0), "{a} {b}");
    let rough = plan.rough.as_ref().unwrap();
    assert_eq!((rough.turns, rough.curves.len(), rough.floors.as_slice()), (20.0, 2, &[-30.0][..]));
    near(rough.path_radius, 79.0);
    near(rough.step, 3.95);
    near(rough.base_radius, 0.628662025212987);
    near(rough.length, 4963.71639267187);
    near(rough.curves[1].length(), 496.371639267187);
    near(rough.slope_jump, 1.27507565367646e-6);
    let finish = plan.finish.as_ref().unwrap();
    near(finish.path_radius, 80.0);
    near(finish.roll, 9.04481476767708);
    near(finish.psi, 0.946567321657524);
    near(finish.start_angle, 9.99138208933461);
    near(finish.visible_turns, 0.560473020373619);
    near(finish.length, 242.249726898481);
    near(finish.curves[1].start().x, 64.9131188336368);
    near(finish.curves[1].start().y, -46.7577480562328);
    // The length of the moves is that of the figures.
    let moved: f64 =
        plan.moves.iter().filter(|m| m.role == ToolpathRole::Rough).map(|m| m.curve.length()).sum();
    near(moved, rough.length);
    let roles: Vec<ToolpathRole> = plan.moves.iter().map(|m| m.role).collect();
    use ToolpathRole::*;
    assert_eq!(
        roles,
        [Approach, Entry, Rough, Circle, LeadOut, Link, Link, Entry, LeadIn, Finish, LeadOut, Retract]
    );
    let (feed, rapid) = plan.lengths();
    // Spiral and circle; the way back, 7/8 pi R; plunges of 32 and 2; lead-in, circle and lead-out.
    near(
        feed,
        4963.71639267187
            + 496.371639267187
            + 0.875 * PI * 79.0
            + 34.0
            + 2.0 * 242.249726898481
            + 502.654824574367,
    );
    assert!(rapid > 48.0 + 80.0 && rapid < 250.0, "{rapid}");
}

#[test]
fn every_variant_chains_smoothly_and_moves_rapidly_in_air_only() {
    for spec in variants() {
        let plan = plan_bore(&spec).unwrap();
        assert_chain(&spec, &plan);
        assert_rapids_in_air(&spec, &plan);
    }
}

#[test]
fn no_variant_leaves_a_core() {
    for spec in variants().into_iter().step_by(7) {
        assert_swept(&spec, &plan_bore(&spec).unwrap());
    }
}

#[test]
fn conventional_is_the_mirror_image_of_climb() {
    for spec in variants().into_iter().filter(|s| s.sense == Sense::Climb) {
        let m = |p: [f64; 2]| [-p[0], p[1]];
        let lead = |end: LeadEnd| if let LeadEnd::Point(p) = end { LeadEnd::Point(m(p)) } else { end };
        let finish = spec.finish.map(|f| Finish { start: lead(f.start), end: lead(f.end), ..f });
        let other = BoreSpec { sense: Sense::Conventional, centre: m(spec.centre), finish, ..spec };
        let other = with_rough(other, |r| r.start = r.start.map(m));
        let (a, b) = (plan_bore(&spec).unwrap(), plan_bore(&other).unwrap());
        assert_eq!(a.moves.len(), b.moves.len());
        for (a, b) in a.moves.iter().zip(&b.moves) {
            for u in [0.0, 0.37, 1.0] {
                let (p, q) = (a.curve.at(a.curve.length() * u).p, b.curve.at(b.curve.length() * u).p);
                assert!((p - DVec3::new(-q.x, q.y, q.z)).length() < 1e-9);
            }
        }
    }
}

#[test]
fn climb_is_counter_clockwise() {
    let plan = plan_bore(&paper()).unwrap();
    let circle = plan.moves.iter().find(|m| m.role == ToolpathRole::Finish).unwrap();
    let j = circle.curve.at(10.0);
    assert!(j.p.cross(j.d1).z > 0.0);
}

#[test]
fn native_records_keep_their_curve_when_the_words_are_rounded() {
    for spec in variants() {
        let Some(u) = spec.resolution else { continue };
        let round = |v: f64| (v / u).round() * u;
        let plan = plan_bore(&spec).unwrap();
        let mut native = 0;
        for m in &plan.moves {
            let CurveKind::Involute { record, .. } = m.curve.kind() else { continue };
            let block = record.block().unwrap();
            if block.least_roll < 3.0 {
                continue;
            }
            native += 1;
            let p = |v: DVec2| DVec2::new(round(v.x), round(v.y));
            let (s, e, c) = (p(record.start()), p(block.end), p(block.centre));
            let (found, mismatch) = InvoluteRecord::through(
                s.to_array(),
                e.to_array(),
                (s + c).to_array(),
                round(block.base_radius),
                block.ccw,
            )
            .unwrap();
            assert!(mismatch < 3.0 * u, "{mismatch} {m:?}");
            for i in 0..=10 {
                let f = f64::from(i) / 10.0;
                let (a, b) = (record.at(record.length() * f), found.at(found.length() * f));
                // Across the path: along it the two are not synchronised.
                let off = (b.p - a.p).dot(a.d1.perp());
                assert!(off.abs() < 3.0 * u, "{off} {m:?}");
            }
        }
        assert!(native >= 2, "{spec:?}");
    }
}

#[test]
fn finishing_alone_needs_the_bore_as_it_is() {
    let spec = BoreSpec { rough: None, ..paper() };
    assert_eq!(plan_bore(&spec).unwrap_err().code(), Code::ENTRY_IMPOSSIBLE);
    let spec = BoreSpec { entry: Some(Entry::PreDrilled { diameter: 198.0 }), ..spec };
    let plan = plan_bore(&spec).unwrap();
    assert!(plan.rough.is_none());
    assert_chain(&spec, &plan);
    assert_rapids_in_air(&spec, &plan);
    let finish = Finish { start: LeadEnd::Point([0.0, 79.5]), ..spec.finish.unwrap() };
    assert_eq!(
        plan_bore(&BoreSpec { finish: Some(finish), ..spec }).unwrap_err().code(),
        Code::START_OUTSIDE
    );
}

#[test]
fn what_cannot_be_is_refused_with_code_key_and_bound() {
    let refuse = |spec: BoreSpec, code: Code, key: &str| {
        let e = plan_bore(&spec).unwrap_err();
        assert_eq!((e.code(), e.0.key.as_deref()), (code, Some(key)), "{e}");
        e.0
    };
    let p = paper();
    let cutter = |change: &dyn Fn(&mut CutterData)| {
        let mut c = p.cutter;
        change(&mut c);
        BoreSpec { cutter: c, ..p }
    };
    refuse(cutter(&|c| c.diameter = 199.0), Code::CUTTER_TOO_LARGE, "rough");
    refuse(with_rough(p, |r| r.allowance = 80.0), Code::CUTTER_TOO_LARGE, "rough");
    refuse(cutter(&|c| c.centre_cutting = false), Code::ENTRY_IMPOSSIBLE, "entry");
    refuse(cutter(&|c| c.diameter = f64::NAN), Code::PLAN_VALUE, "tool.diameter");
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refuse(with_rough(p, |r| r.stepover = Some(bad)), Code::PLAN_VALUE, "rough.stepover");
        refuse(with_rough(p, |r| r.feed = bad), Code::PLAN_VALUE, "rough.feed");
        refuse(with_rough(p, |r| r.plunge_feed = Some(bad)), Code::PLAN_VALUE, "rough.plunge_feed");
        refuse(with_rough(p, |r| r.stepdown = Some(bad)), Code::PLAN_VALUE, "rough.stepdown");
        refuse(BoreSpec { depth: bad, ..p }, Code::PLAN_VALUE, "depth");
        refuse(BoreSpec { diameter: bad, ..p }, Code::PLAN_VALUE, "diameter");
        refuse(BoreSpec { resolution: Some(bad), ..p }, Code::PLAN_VALUE, "resolution");
        refuse(
            BoreSpec { finish: p.finish.map(|f| Finish { feed: bad, ..f }), ..p },
            Code::PLAN_VALUE,
            "finish.feed",
        );
    }
    refuse(with_rough(p, |r| r.allowance = -0.1), Code::PLAN_VALUE, "rough.allowance");
    let f = refuse(with_rough(p, |r| r.stepover = Some(41.0)), Code::PLAN_VALUE, "rough.stepover");
    assert_eq!(f.bound.unwrap().value, 40.0);
    let f = refuse(with_rough(p, |r| r.stepdown = Some(46.0)), Code::PLAN_VALUE, "rough.stepdown");
    assert_eq!(f.bound.unwrap().value, 45.0);
    refuse(BoreSpec { approach_z: 0.0, ..p }, Code::PLAN_VALUE, "approach");
    refuse(BoreSpec { retract_z: 1.0, ..p }, Code::PLAN_VALUE, "retract");
    refuse(BoreSpec { centre: [f64::NAN, 0.0], ..p }, Code::PLAN_VALUE, "at");
    refuse(
        BoreSpec { finish: p.finish.map(|f| Finish { turns: 0, ..f }), ..p },
        Code::PLAN_VALUE,
        "finish.turns",
    );
    refuse(
        BoreSpec { finish: p.finish.map(|f| Finish { start: LeadEnd::Point([79.5, 0.0]), ..f }), ..p },
        Code::START_OUTSIDE,
        "finish.start",
    );
    refuse(
        BoreSpec { finish: p.finish.map(|f| Finish { end: LeadEnd::Point([0.0, 90.0]), ..f }), ..p },
        Code::START_OUTSIDE,
        "finish.end",
    );
    // A core: the start too far out, the helix too wide.
    let at = |x| with_rough(p, |r| r.start = Some([x, 0.0]));
    let f = refuse(at(18.0), Code::ENTRY_IMPOSSIBLE, "rough.start");
    assert!(f.value.unwrap().value > 20.0 && f.bound.unwrap().value == 20.0);
    refuse(at(100.0), Code::START_OUTSIDE, "rough.start");
    let helix = |radius, pitch| BoreSpec { entry: Some(Entry::Helix { radius, pitch }), ..p };
    refuse(helix(20.0, 2.0), Code::ENTRY_IMPOSSIBLE, "entry.radius");
    refuse(helix(15.0, 0.0), Code::ENTRY_IMPOSSIBLE, "entry.pitch");
    let f = refuse(helix(15.0, 12.0), Code::ENTRY_IMPOSSIBLE, "entry.pitch");
    assert!((f.bound.unwrap().value - 0.1f64.to_degrees()).abs() < 1e-12);
    assert!((f.value.unwrap().value - (12.0 / (30.0 * PI)).atan().to_degrees()).abs() < 1e-9);
    let drilled = |diameter| BoreSpec { entry: Some(Entry::PreDrilled { diameter }), ..p };
    let begins = with_rough(drilled(60.0), |r| r.start = Some([3.0, 0.0]));
    refuse(begins, Code::ENTRY_IMPOSSIBLE, "rough.start");
    refuse(drilled(40.0), Code::ENTRY_IMPOSSIBLE, "entry.diameter");
    refuse(drilled(198.5), Code::PLAN_VALUE, "entry.diameter");
    assert_eq!(plan_bore(&BoreSpec { rough: None, finish: None, ..p }).unwrap_err().code(), Code::PLAN_VALUE);
}

#[test]
fn a_helix_ends_where_its_spiral_begins_and_has_whole_turns() {
    let spec = BoreSpec {
        entry: Some(Entry::Helix { radius: 12.0, pitch: 3.0 }),
        resolution: Some(1e-3),
        ..paper()
    };
    let plan = plan_bore(&spec).unwrap();
    let helix = plan.moves.iter().find(|m| m.role == ToolpathRole::Entry).unwrap();
    let CurveKind::Arc(arc) = helix.curve.kind() else { panic!("{helix:?}") };
    // 32 mm in eleven pitches of at most 3, the last half of which is the fading turn.
    let pitch = 32.0 / 11.5;
    assert!((arc.sweep / TAU - 11.0).abs() < 1e-12 && (arc.rise + 11.0 * pitch).abs() < 1e-12, "{arc:?}");
    let foot: Vec<_> = plan.moves.iter().skip_while(|m| m.role != ToolpathRole::Entry).take(3).collect();
    let joints = [joint(&foot[0].curve, &foot[1].curve), joint(&foot[1].curve, &foot[2].curve)];
    assert!(joints.iter().all(|j| j.contact == ContactOrder::G3), "{joints:?}");
    assert_eq!(foot[2].role, ToolpathRole::Circle);
    let inner = plan.rough.unwrap().inner_radius;
    assert!((arc.radius() - inner).abs() < 1e-12 && (inner - 12.0).abs() < 34.0 * PI * 1e-3, "{inner}");
}

/// The paper's bore with constant engagement of 60 degrees from a helix of 10 mm.
fn evenly_engaged(stepover: Option<f64>) -> BoreSpec {
    let rough = Rough { stepover, allowance: 1.0, ..Rough::by_engagement(60f64.to_radians(), 100.0) };
    BoreSpec {
        strategy: Strategy::ConstantEngagement,
        entry: Some(Entry::Helix { radius: 10.0, pitch: 2.0 }),
        rough: Some(rough),
        finish: None,
        ..paper()
    }
}

#[test]
fn without_a_stepover_the_engagement_alone_limits_the_steps() {
    let alone = plan_bore(&evenly_engaged(None)).unwrap().rough.unwrap();
    assert_eq!(alone.turns, 11.0);
    assert!((alone.length - 2800.0).abs() < 1.0, "{}", alone.length);
    // At the wall the step of 60 degrees is 99 - sqrt(79^2 + 20^2 + 79 * 20) = 8.33 mm; whole turns take a little less.
    assert!(alone.step > 7.5 && alone.step < 8.331, "{}", alone.step);
    let samples = engagement::engagement(&alone.curves, 20.0, Some(30.0), 4000).unwrap();
    let most = samples.iter().map(|s| s.angle).fold(0.0, f64::max).to_degrees();
    assert!(most > 55.0 && most < 60.1, "{most}");
    // A step that no turn reaches changes nothing, a smaller one holds as well.
    assert_eq!(plan_bore(&evenly_engaged(Some(39.9))).unwrap().rough.unwrap().curves, alone.curves);
    let both = plan_bore(&evenly_engaged(Some(4.0))).unwrap().rough.unwrap();
    assert!(both.step <= 4.0 + 1e-9 && both.turns > 17.0, "{both:?}");
}

#[test]
fn a_missing_stepover_is_an_error_where_nothing_else_limits_the_steps() {
    use Strategy::*;
    for strategy in
        [Involute, Annular, Lens1, Lens2, Arcs2, Arcs4, Archimedean, Rings, RingsTangent, Trochoidal, Ramping]
    {
        let e = plan_bore(&BoreSpec { strategy, ..evenly_engaged(None) }).unwrap_err();
        assert_eq!((e.code(), e.0.key.as_deref()), (Code::PLAN_VALUE, Some("rough.stepover")), "{e}");
        assert!(e.0.message.contains(&strategy.name()) && e.0.bound.as_ref().unwrap().value == 40.0, "{e}");
        assert!(e.0.help.contains("stepover = .."), "{e}");
    }
    let e = plan_bore(&with_rough(evenly_engaged(None), |r| r.engagement = None)).unwrap_err();
    assert_eq!((e.code(), e.0.key.as_deref()), (Code::PLAN_VALUE, Some("rough.engagement")), "{e}");
    // One helix has no turns side by side.
    let through = BoreSpec { strategy: OutlineHelix, breakthrough: Some(1.0), ..evenly_engaged(None) };
    plan_bore(&through).unwrap();
    let half_axes = [100.0, 60.0];
    let bore = BoreSpec { diameter: 120.0, ..with_rough(paper(), |r| r.stepover = None) };
    let pocket = EllipseSpec { half_axes, turned: 0.0, order: crate::geom::LensOrder::One, bore };
    let e = plan_ellipse(&pocket).unwrap_err();
    assert_eq!((e.code(), e.0.key.as_deref()), (Code::PLAN_VALUE, Some("rough.stepover")), "{e}");
}

proptest! {
    #![proptest_config(kinecut_cases::property(128))]
    #[test]
    fn any_bore_is_planned_or_refused(
        diameter in 1.0..400.0f64, share in 0.05..0.98f64, step in 0.02..1.2f64, allowance in 0.0..3.0f64,
        depth in 0.1..100.0f64, u in 0.0..1.0f64, at in -3.0..3.0f64, turns in 1u32..5, kind in 0u8..4, fine in 0u8..3,
        cw: bool, auto: bool,
    ) {
        let tool = diameter * share;
        let radius = 0.5 * (diameter - tool);
        let start = radius * u * DVec2::from_angle(at);
        let (begin, entry) = match kind {
            0 => (None, Entry::Plunge),
            1 => (Some((0.3 * start).to_array()), Entry::Plunge),
            2 => (None, Entry::Helix { radius: 0.5 * tool * u, pitch: 0.02 * tool * u }),
            _ => (None, Entry::PreDrilled { diameter: tool * (1.0 + u) }),
        };
        let spec = BoreSpec {
            diameter,
            depth,
            cutter: CutterData { diameter: tool, ..paper().cutter },
            sense: if cw { Sense::Conventional } else { Sense::Climb },
            entry: Some(entry),
            rough: Some(Rough { stepover: Some(tool * step), allowance, start: begin, ..paper().rough.unwrap() }),
            finish: Some(Finish {
                turns,
                start: if auto { LeadEnd::Usual } else { LeadEnd::Point(start.to_array()) },
                ..Finish::new(10.0)
            }),
            resolution: [None, Some(1e-3), Some(1e-4)][usize::from(fine)],
            ..paper()
        };
        if let Ok(plan) = plan_bore(&spec) {
            assert_chain(&spec, &plan);
            assert_rapids_in_air(&spec, &plan);
        }
    }
}
