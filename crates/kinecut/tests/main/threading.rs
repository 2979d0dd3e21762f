//! Threads as planned: golden numbers, the groove of the tool by brute force, directions, mirror images, passes, errors.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, DVec3, dvec2};
use kinecut::base::{Code, Severity};
use kinecut::geom::CurveKind;
use kinecut::holes::{PlannedMove, Sense, ToolpathPace, ToolpathRole, Wear};
use kinecut::threading::{
    MillProfile, Thread, ThreadCutter, ThreadForm, ThreadMillSpec, ThreadPlan, ThreadSide, coarse_pitch,
    plan_threads,
};
use kinecut::tool::{Hand, Neck, Tap, ThreadMill};
use serde_json::Value;

use crate::common::golden::{file, number};
use crate::common::groove::{Tooth, pitch_radius};
use crate::common::random::Random;

fn cutter(diameter: f64, pitch: f64, rows: u32, form: ThreadForm) -> ThreadCutter {
    let mill = ThreadMill { diameter, pitch, rows, half_angle: form.half_angle(), neck: None };
    let flute_length = f64::from(rows) * pitch;
    // A shank that goes into the hole with the teeth.
    let shank_diameter = 0.4 * diameter;
    ThreadCutter { mill, profile: MillProfile::Standard, flute_length, shank_diameter, stickout: 100.0 }
}

fn spec(diameter: f64, pitch: f64, tool: f64, rows: u32) -> ThreadMillSpec {
    let thread = Thread::new(ThreadForm::Metric, diameter, pitch);
    ThreadMillSpec::new(thread, 12.0 * pitch, cutter(tool, pitch, rows, ThreadForm::Metric), 10.0)
}

fn planned(spec: &ThreadMillSpec) -> ThreadPlan {
    let plan = plan_threads(spec).unwrap_or_else(|e| panic!("{e} in {spec:?}"));
    for pair in plan.moves.windows(2) {
        let gap = pair[1].curve.start().distance(pair[0].curve.end());
        assert!(gap < 1e-9, "{gap} at {:?}", pair[1]);
    }
    plan
}

fn cases(kind: &str) -> Vec<Value> {
    let all = file("thread")["cases"].as_array().unwrap().clone();
    let found: Vec<Value> = all.into_iter().filter(|c| c["kind"] == kind).collect();
    assert!(!found.is_empty());
    found
}

/// Holds numbers against a case, each within its tolerance.
#[track_caller]
fn meets(case: &Value, found: &[(&str, f64)]) {
    let keys = case["expected"].as_object().unwrap();
    assert_eq!(keys.len(), found.len(), "{case}");
    for (key, value) in found {
        let (wanted, tolerance) = (number(&case["expected"], key), number(&case["tolerance"], key));
        assert!((value - wanted).abs() <= tolerance, "{key}: {value}, wanted {wanted} in {}", case["name"]);
    }
}

#[test]
fn golden_profiles() {
    for case in cases("thread") {
        let [diameter, pitch] = ["D", "P"].map(|key| number(&case["input"], key));
        let thread = Thread::new(ThreadForm::Metric, diameter, pitch);
        let tap = |forming| Tap { diameter, pitch, lead: 2.0, tip: 0.0, forming };
        let core = tap(false).core_diameter();
        // The sharp triangle is 1.6 times as high as the thread of a nut.
        let sharp = thread.height(ThreadSide::Inside) * 1.6;
        meets(
            &case,
            &[
                ("H", sharp),
                ("D2", thread.pitch_diameter()),
                ("D1", thread.minor_diameter()),
                ("d3", thread.root_diameter()),
                ("cut_pilot", core),
                ("form_pilot", tap(true).core_diameter()),
                ("full_thread_percent_at_cut_pilot", 100.0 * tap(false).thread_share(core)),
            ],
        );
        assert_eq!(coarse_pitch(diameter), Some(pitch));
    }
}

#[test]
fn golden_helices_inside() {
    for case in cases("thread mill inside") {
        let [diameter, pitch, tool] = ["D", "P", "tool"].map(|key| number(&case["input"], key));
        let spec = spec(diameter, pitch, tool, 1);
        let plan = planned(&spec);
        let [nominal, run] = plan.radii;
        let plain = ThreadMillSpec {
            cutter: ThreadCutter { profile: MillProfile::Corrected, ..spec.cutter },
            ..spec.clone()
        };
        let plain = planned(&plain);
        let of = |plan: &ThreadPlan, role: ToolpathRole| {
            plan.moves.iter().find(|m| m.role == role).unwrap().curve.clone()
        };
        let (way_in, helix) = (of(&plain, ToolpathRole::LeadIn), of(&plain, ToolpathRole::Finish));
        let rise = way_in.end().z - way_in.start().z;
        meets(
            &case,
            &[
                ("centre_radius", nominal),
                ("pitch_line_tool_radius", spec.tool_radius()),
                ("flank_gain", plan.gain[0]),
                // The first correction: that of the radius without one.
                ("centre_radius_corrected", nominal - plan.gain[0]),
                ("feed_factor", spec.feed_share()),
                ("lead_in_half_circle_radius", 0.5 * way_in.end().truncate().length()),
                ("lead_in_z", rise),
                ("helix_length", helix.length() / plain.runs[0].turns),
            ],
        );
        // On the radius that is run the overcut is a little less: the first correction leaves up to 3 um in radius.
        let left = nominal - plan.gain[0] - run;
        assert!(left > 0.0 && left < 3e-3, "{left}");
        let by_hand = [("M20x2.5 with 12", 0.0335), ("M20x2.5 with 14", 0.0533), ("M8x1.25 with 6", 0.0428)];
        if let Some((_, second)) = by_hand.iter().find(|(name, _)| case["name"] == *name) {
            assert!((plan.gain[1] - second).abs() < 5e-5, "{}", plan.gain[1]);
        }
        assert!(plan.gain[1] < plan.gain[0] && plan.gain[1] > 0.97 * plan.gain[0]);
    }
}

#[test]
fn golden_helices_outside() {
    for case in cases("thread mill outside") {
        let [diameter, pitch, tool, root] =
            ["D", "P", "tool", "root_diameter"].map(|key| number(&case["input"], key));
        let spec = ThreadMillSpec { side: ThreadSide::Outside, ..spec(diameter, pitch, tool, 1) };
        assert!((spec.thread.root_diameter() - root).abs() < 1e-9);
        let plan = planned(&spec);
        meets(
            &case,
            &[
                ("centre_radius", plan.radii[0]),
                ("pitch_line_tool_radius", spec.tool_radius()),
                ("flank_gain", plan.gain[0]),
            ],
        );
        assert!((plan.radii[1] - plan.radii[0] - plan.gain[0]).abs() < 1e-4 && plan.radii[1] > plan.radii[0]);
    }
}

#[test]
fn golden_tapers() {
    for case in cases("taper thread") {
        let [pitch, taper] = ["pitch", "taper"].map(|key| number(&case["input"], key));
        let thread = Thread { taper, ..Thread::new(ThreadForm::Npt, 20.0, pitch) };
        let angle = thread.taper_angle().to_degrees();
        meets(&case, &[("radius_per_turn", thread.radius_per_turn()), ("half_angle", angle)]);
    }
}

/// Middles of the lowest tooth along the helices of a plan, in each turn so many.
fn middles(spec: &ThreadMillSpec, plan: &ThreadPlan, each: f64) -> Vec<DVec3> {
    let up = DVec3::Z * 0.5 * spec.thread.pitch;
    let mut path = Vec::new();
    for m in plan.runs.iter().flat_map(|run| &plan.moves[run.moves.clone()]) {
        let length = m.curve.length();
        let count = (length / (TAU * plan.radii[1]) * each).ceil();
        path.extend((0..=count as u32).map(|i| m.curve.at(length * f64::from(i) / count).p + up));
    }
    path
}

fn tooth(spec: &ThreadMillSpec) -> Tooth {
    Tooth {
        crest: 0.5 * spec.cutter.mill.diameter,
        pitch_line: spec.tool_radius(),
        pitch: spec.thread.pitch,
        half_angle: spec.cutter.mill.half_angle,
    }
}

#[test]
fn the_groove_has_the_pitch_diameter() {
    for (diameter, pitch, tool) in
        [(20.0, 2.5, 12.0), (20.0, 2.5, 16.0), (8.0, 1.25, 6.0), (3.0, 0.5, 2.2), (30.0, 1.5, 16.0)]
    {
        for side in [ThreadSide::Inside, ThreadSide::Outside] {
            let mut spec = ThreadMillSpec { side, depth: 1.5 * pitch, ..spec(diameter, pitch, tool, 1) };
            for sense in [Sense::Climb, Sense::Conventional] {
                spec.sense = sense;
                let plan = planned(&spec);
                let path = middles(&spec, &plan, 2e5);
                // One turn about the middle of the run, away from both ends.
                let z = spec.top - 0.75 * pitch;
                let path: Vec<DVec3> = path.into_iter().filter(|p| (p.z - z).abs() < 0.5 * pitch).collect();
                let angle = path[path.len() / 2].truncate().to_angle();
                let found = 2.0 * pitch_radius(tooth(&spec), &path, side == ThreadSide::Inside, angle);
                let off = found - spec.thread.pitch_diameter();
                assert!(off.abs() < 1e-5, "{side:?} M{diameter}x{pitch} with {tool}: {off}");
            }
            // Without the correction it is as far off as the gain says.
            spec.cutter.profile = MillProfile::Corrected;
            let plan = planned(&spec);
            let path = middles(&spec, &plan, 2e5);
            let path: Vec<DVec3> =
                path.into_iter().filter(|p| (p.z + 0.75 * pitch).abs() < 0.5 * pitch).collect();
            let angle = path[path.len() / 2].truncate().to_angle();
            let found = 2.0 * pitch_radius(tooth(&spec), &path, side == ThreadSide::Inside, angle);
            let off = (found - spec.thread.pitch_diameter()).abs();
            assert!((off - 2.0 * plan.gain[0]).abs() < 1e-5, "{side:?} M{diameter}: {off}");
        }
    }
}

#[test]
fn a_whitworth_thread_has_its_flanks() {
    // G 1/2: 20.955 by 14 threads an inch.
    let thread = Thread::new(ThreadForm::Whitworth, 20.955, 25.4 / 14.0);
    assert!(
        (thread.pitch_diameter() - 19.793).abs() < 1e-3 && (thread.minor_diameter() - 18.631).abs() < 1e-3
    );
    let cutter = cutter(14.0, thread.pitch, 1, ThreadForm::Whitworth);
    let spec = ThreadMillSpec::new(thread, 1.5 * thread.pitch, cutter, 10.0);
    let plan = planned(&spec);
    let path: Vec<DVec3> = middles(&spec, &plan, 2e5)
        .into_iter()
        .filter(|p| (p.z + 0.75 * thread.pitch).abs() < 0.5 * thread.pitch)
        .collect();
    let angle = path[path.len() / 2].truncate().to_angle();
    let found = 2.0 * pitch_radius(tooth(&spec), &path, true, angle);
    assert!((found - thread.pitch_diameter()).abs() < 1e-5, "{found}");
}

/// The taper of NPT 1/2: 21.223 at the mouth.
fn npt(side: ThreadSide) -> ThreadMillSpec {
    let thread = Thread { taper: 1.0 / 16.0, ..Thread::new(ThreadForm::Npt, 21.223, 25.4 / 14.0) };
    let cutter = cutter(12.0, thread.pitch, 1, ThreadForm::Npt);
    ThreadMillSpec { side, ..ThreadMillSpec::new(thread, 13.6, cutter, 10.0) }
}

#[test]
fn a_taper_thread_is_wider_at_the_mouth_of_a_hole_and_at_the_foot_of_a_boss() {
    for side in [ThreadSide::Inside, ThreadSide::Outside] {
        for sense in [Sense::Climb, Sense::Conventional] {
            for hand in [Hand::Right, Hand::Left] {
                let mut spec = ThreadMillSpec { sense, ..npt(side) };
                spec.thread.hand = hand;
                let plan = planned(&spec);
                let inside = side == ThreadSide::Inside;
                let all = middles(&spec, &plan, 4e4);
                for depth in [2.0, 6.0, 11.0] {
                    let turn: Vec<DVec3> = all
                        .iter()
                        .filter(|p| (p.z + depth).abs() < 0.5 * spec.thread.pitch)
                        .copied()
                        .collect();
                    let angle = turn[turn.len() / 2].truncate().to_angle();
                    let found = pitch_radius(tooth(&spec), &turn, inside, angle);
                    let wider = if inside { -1.0 } else { 1.0 } * depth / 32.0;
                    let off = found - (0.5 * spec.thread.pitch_diameter() + wider);
                    // The cone leans against the section by a few hundredths of a pitch.
                    assert!(off.abs() < 1e-3, "{side:?} {sense:?} {hand:?} at {depth}: {off}");
                }
                // The radius changes by a thirty-second of a pitch in a turn, and a little with the overcut.
                let [r0, r1] = plan.runs[0].radii;
                let each = (r1 - r0).abs() / plan.runs[0].turns;
                assert!((each - spec.thread.radius_per_turn()).abs() < 5e-4, "{each}");
                assert_eq!(r1 > r0, plan.travel.upwards == inside);
            }
        }
    }
}

/// Turn of a helix in space: counter-clockwise, and its climb in a turn.
fn turning(m: &PlannedMove) -> (bool, f64) {
    let CurveKind::Arc(arc) = m.curve.kind() else { panic!("{m:?}") };
    (arc.sweep > 0.0, arc.rise / arc.sweep.abs() * TAU)
}

#[test]
fn directions_are_those_of_the_table_and_the_hand_is_the_thread() {
    use Hand::{Left, Right};
    use Sense::{Climb, Conventional};
    use ThreadSide::{Inside, Outside};
    let ways = [
        (Inside, Right, Climb, false, true, true),
        (Inside, Right, Conventional, false, false, false),
        (Inside, Left, Climb, false, true, false),
        (Inside, Left, Conventional, false, false, true),
        (Outside, Right, Climb, false, false, false),
        (Outside, Right, Conventional, false, true, true),
        (Outside, Left, Climb, false, false, true),
        (Outside, Left, Conventional, false, true, false),
        // With a left-hand cutter climb and conventional change.
        (Inside, Right, Climb, true, false, false),
        (Outside, Left, Conventional, true, false, true),
    ];
    for (side, hand, sense, left_hand, counter_clockwise, upwards) in ways {
        for rows in [1, 4] {
            let mut spec = ThreadMillSpec { side, sense, left_hand, ..spec(20.0, 2.5, 12.0, rows) };
            spec.thread.hand = hand;
            let plan = planned(&spec);
            assert!(plan.runs.len() == if rows == 1 { 1 } else { 4 });
            for run in &plan.runs {
                let (ccw, climb) = turning(&plan.moves[run.moves.start]);
                assert_eq!((ccw, climb > 0.0), (counter_clockwise, upwards), "{side:?} {hand:?} {sense:?}");
                assert!((climb.abs() - 2.5).abs() < 1e-12);
                // A right-hand thread rises counter-clockwise.
                assert_eq!(ccw == (climb > 0.0), hand == Right);
            }
        }
    }
}

#[test]
fn a_mirrored_thread_is_milled_on_the_mirrored_path() {
    let mut random = Random(11);
    for _ in 0..40 {
        let pitch = 0.5 + 2.0 * random.share();
        let diameter = pitch * (6.0 + 10.0 * random.share());
        let side = if random.share() < 0.5 { ThreadSide::Inside } else { ThreadSide::Outside };
        let sense = if random.share() < 0.5 { Sense::Climb } else { Sense::Conventional };
        let rows = 1 + (5.0 * random.share()) as u32;
        let wear = (random.share() < 0.5).then_some(Wear { register: 2, largest: 0.01 });
        let mut one = ThreadMillSpec {
            side,
            sense,
            infeed: vec![0.6, 1.0],
            spring_passes: 1,
            wear,
            places: vec![dvec2(3.0, -4.0)],
            ..spec(diameter, pitch, (0.3 + 0.2 * random.share()) * diameter, rows)
        };
        let plan = planned(&one);
        // The mirror image in Y: the other hand, a cutter of the other hand.
        one.thread.hand = Hand::Left;
        one.left_hand = true;
        one.places = vec![dvec2(3.0, 4.0)];
        let mirrored = planned(&one);
        assert_eq!(plan.moves.len(), mirrored.moves.len());
        for (a, b) in plan.moves.iter().zip(&mirrored.moves) {
            assert_eq!((a.role, a.pace, a.comp), (b.role, b.pace, b.comp));
            for share in [0.0, 0.3, 0.8, 1.0] {
                let (p, q) = (a.curve.at(share * a.curve.length()).p, b.curve.at(share * b.curve.length()).p);
                assert!((p - DVec3::new(q.x, -q.y, q.z)).length() < 1e-9, "{a:?} {b:?}");
            }
        }
        // Conventional is climb run the other way.
        let other = if sense == Sense::Climb { Sense::Conventional } else { Sense::Climb };
        one.thread.hand = Hand::Right;
        one.left_hand = false;
        one.sense = other;
        let back = planned(&one);
        assert_eq!(back.travel.counter_clockwise, !plan.travel.counter_clockwise);
        assert_eq!(back.travel.upwards, !plan.travel.upwards);
        assert!((back.radii[1] - plan.radii[1]).abs() < 1e-12 && (back.feed - plan.feed).abs() < 1e-12);
    }
}

#[test]
fn leads_run_on_the_slope_of_the_helix_and_join_it_without_a_kink() {
    for side in [ThreadSide::Inside, ThreadSide::Outside] {
        for wear in [None, Some(Wear { register: 2, largest: 0.05 })] {
            let spec = ThreadMillSpec { side, wear, infeed: vec![0.7, 1.0], ..spec(20.0, 2.5, 12.0, 3) };
            let plan = planned(&spec);
            let mut joined = 0;
            for pair in plan.moves.windows(2) {
                let feeds = |m: &PlannedMove| matches!(m.pace, ToolpathPace::Feed(_));
                if !feeds(&pair[0]) || !feeds(&pair[1]) {
                    continue;
                }
                let straight =
                    [&pair[0], &pair[1]].iter().any(|m| matches!(m.curve.kind(), CurveKind::Line(_)));
                let (out, on) = (pair[0].curve.at(pair[0].curve.length()).d1, pair[1].curve.at(0.0).d1);
                // The straight lines under compensation are level.
                let kink = if straight {
                    out.truncate().normalize_or_zero().distance(on.truncate().normalize_or_zero())
                } else {
                    out.distance(on)
                };
                assert!(kink < 1e-9, "{side:?}: {kink} at {:?}", pair[1]);
                joined += 1;
            }
            assert!(joined >= 2 * plan.runs.len(), "{joined}");
            let comp = plan.moves.iter().filter(|m| m.comp).count();
            assert_eq!(comp > 0, wear.is_some());
        }
    }
}

#[test]
fn rows_of_teeth_step_by_what_they_cut_and_the_last_step_is_shorter() {
    // 30 mm by 4 rows of 2.5: 7.5 in a step; the fourth row of the last one begins at the mouth.
    let lows = |rows: u32, depth: f64| -> Vec<f64> {
        let spec = ThreadMillSpec { depth, ..spec(20.0, 2.5, 12.0, rows) };
        planned(&spec).runs.iter().map(|r| r.heights[0] + depth).collect()
    };
    assert_eq!(lows(4, 30.0), [0.0, 7.5, 15.0, 22.5]);
    assert_eq!(lows(4, 20.0), [0.0, 7.5, 12.5]);
    // One pitch less than all is needed: one turn and an eighth is enough.
    assert_eq!(lows(9, 20.0), [0.0]);
    assert_eq!(lows(8, 20.0), [0.0, 2.5]);
    assert_eq!(lows(1, 20.0), [0.0]);
    let spec = spec(20.0, 2.5, 12.0, 20);
    assert_eq!(planned(&spec).runs[0].turns, 1.125);
}

#[test]
fn passes_come_from_the_axis_of_a_hole_and_from_beyond_a_boss() {
    for (side, sign) in [(ThreadSide::Inside, -1.0), (ThreadSide::Outside, 1.0)] {
        let spec = ThreadMillSpec {
            side,
            infeed: vec![0.5, 0.8, 1.0],
            spring_passes: 2,
            ..spec(20.0, 2.5, 12.0, 1)
        };
        let plan = planned(&spec);
        let height = spec.thread.height(side);
        let radii: Vec<f64> =
            plan.runs.iter().map(|r| sign * (r.radii[0] - plan.radii[1]) / height).collect();
        for (found, wanted) in radii.iter().zip([0.5, 0.2, 0.0, 0.0, 0.0]) {
            assert!((found - wanted).abs() < 1e-12, "{radii:?}");
        }
        let last: Vec<bool> = plan.runs.iter().map(|r| r.finishing).collect();
        assert_eq!(last, [false, false, true, true, true]);
    }
}

#[test]
fn the_feed_is_that_of_the_edge_and_nothing_rapid_touches_the_wall() {
    let spec = ThreadMillSpec { infeed: vec![0.3, 0.7, 1.0], ..spec(20.0, 2.5, 16.0, 1) };
    let plan = planned(&spec);
    let slope = (2.5 / (TAU * plan.radii[1])).atan();
    // 11 degrees, 2 %.
    assert!((slope.to_degrees() - 11.8).abs() < 0.2);
    assert_eq!(plan.feed, plan.runs[2].feed);
    let mut before = 0.0;
    for run in &plan.runs {
        let [radius, _] = run.radii;
        let slope = (2.5 / (TAU * radius)).atan();
        // The crests are on a radius that is larger by 8.
        let edge = run.feed / slope.cos() * (radius + 8.0) / radius;
        assert!((edge - 10.0).abs() < 1e-12, "{edge} on {radius}");
        assert!(run.feed > before, "{run:?}");
        before = run.feed;
        assert!(plan.moves[run.moves.clone()].iter().all(|m| m.pace == ToolpathPace::Feed(run.feed)));
    }
    assert_eq!(plan.runs.len(), 3);
    let open = 0.5 * (spec.thread.minor_diameter() - 16.0);
    for m in plan.moves.iter().filter(|m| m.pace == ToolpathPace::Rapid) {
        for end in [m.curve.start(), m.curve.end()] {
            assert!(end.z > 0.0 || end.truncate().length() <= open, "{m:?}");
        }
    }
    let low = plan.moves.iter().map(|m| m.curve.start().z).fold(f64::INFINITY, f64::min);
    assert!((low - plan.lowest).abs() < 1e-12 && (low + 30.0 + 0.75 * 2.5).abs() < 1e-12, "{low}");
}

#[test]
fn a_boss_is_joined_from_clear_of_it() {
    let spec = ThreadMillSpec { side: ThreadSide::Outside, ..spec(20.0, 2.5, 16.0, 1) };
    let plan = planned(&spec);
    for m in plan.moves.iter().filter(|m| m.pace == ToolpathPace::Rapid) {
        for end in [m.curve.start(), m.curve.end()] {
            assert!(end.z > 0.0 || end.truncate().length() >= 10.0 + 8.0 + 1.9, "{m:?}");
        }
    }
    let slope = (2.5 / (TAU * plan.radii[1])).atan();
    assert!((plan.runs[0].feed - 10.0 * 1.8 * slope.cos()).abs() < 1e-12 && plan.feed == plan.runs[0].feed);
    let way_in = plan.moves.iter().find(|m| m.role == ToolpathRole::LeadIn).unwrap();
    let CurveKind::Arc(arc) = way_in.curve.kind() else { panic!("{way_in:?}") };
    assert!((arc.sweep.abs() - FRAC_PI_2).abs() < 1e-12);
    let wanted = 2.5 * arc.radius() / (4.0 * plan.radii[1]);
    assert!((arc.rise.abs() - wanted).abs() < 1e-12, "{arc:?}");
}

#[track_caller]
fn refused(spec: &ThreadMillSpec, code: Code, key: &str, parts: &[&str]) {
    let error = plan_threads(spec).expect_err("it is planned");
    let text = error.to_string();
    assert_eq!((error.code(), error.0.key.as_deref()), (code, Some(key)), "{text}");
    for part in parts {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
}

#[test]
fn tools_that_do_not_fit_are_refused_with_numbers() {
    let m8 = |tool: f64| spec(8.0, 1.25, tool, 1);
    refused(&m8(6.5), Code::THREAD_TOOL, "tool", &["6.5 does not pass the hole of 6.647", "below 6.447"]);
    let mut thick = m8(5.0);
    thick.cutter.shank_diameter = 6.0;
    refused(
        &thick,
        Code::THREAD_TOOL,
        "tool",
        &["shank of 6 mm meets the wall", "neck_diameter", "teeth end 1.25"],
    );
    // A neck that is thin and long enough helps.
    thick.cutter.mill.neck = Some(Neck { diameter: 3.0, top: 20.0 });
    planned(&thick);
    thick.cutter.mill.neck = Some(Neck { diameter: 3.0, top: 12.0 });
    refused(&thick, Code::THREAD_TOOL, "tool", &["shank of 6 mm", "12 above its tip"]);
    thick.cutter.mill.neck = Some(Neck { diameter: 4.9, top: 20.0 });
    refused(&thick, Code::THREAD_TOOL, "tool", &["neck of 4.9 mm"]);
    let mut short = m8(5.0);
    short.cutter.stickout = 15.5;
    refused(&short, Code::THREAD_TOOL, "depth", &["too short", "15.5"]);
    let mut other = m8(5.0);
    other.cutter.mill.pitch = 1.0;
    refused(&other, Code::THREAD_TOOL, "tool", &["pitch of 1, the thread 1.25"]);
    other = m8(5.0);
    other.cutter.mill.half_angle = 27.5_f64.to_radians();
    refused(&other, Code::THREAD_TOOL, "tool", &["27.5 degrees", "30"]);
    let mut rows = npt(ThreadSide::Inside);
    rows.cutter = cutter(12.0, rows.thread.pitch, 5, ThreadForm::Npt);
    refused(&rows, Code::THREAD_TOOL, "tool", &["single row"]);
}

#[test]
fn values_out_of_range_are_refused_with_their_key() {
    let m8 = spec(8.0, 1.25, 5.0, 1);
    let with = |change: fn(&mut ThreadMillSpec)| {
        let mut spec = m8.clone();
        change(&mut spec);
        spec
    };
    for (spec, key) in [
        (with(|s| s.depth = 0.0), "depth"),
        (with(|s| s.depth = f64::NAN), "depth"),
        (with(|s| s.depth = 1e6), "depth"),
        (with(|s| s.feed = 0.0), "feed"),
        (with(|s| s.thread.pitch = -1.0), "pitch"),
        (with(|s| s.thread.pitch = 5.0), "pitch"),
        (with(|s| s.thread.diameter = f64::INFINITY), "tool"),
        (with(|s| s.oversize = 1.0), "oversize"),
        (with(|s| s.thread.taper = 0.5), "taper"),
        (with(|s| s.infeed = Vec::new()), "infeed"),
        (with(|s| s.infeed = vec![0.7, 0.6, 1.0]), "infeed[1]"),
        (with(|s| s.infeed = vec![0.7]), "infeed[0]"),
        (with(|s| s.infeed = vec![0.0, 1.0]), "infeed[0]"),
        (with(|s| s.infeed = vec![f64::NAN, 1.0]), "infeed[0]"),
        (with(|s| s.spring_passes = 30), "infeed"),
        (with(|s| s.places = vec![DVec2::ZERO; 100_000]), "points"),
        (with(|s| s.wear = Some(Wear { register: 2, largest: 0.9 })), "wear_largest"),
        (with(|s| s.wear = Some(Wear { register: 2, largest: 0.6 })), "wear_largest"),
    ] {
        let error = plan_threads(&spec).expect_err(key);
        if key != "tool" {
            assert_eq!(error.0.key.as_deref(), Some(key), "{error}");
        }
    }
    planned(&with(|s| s.wear = Some(Wear { register: 2, largest: 0.05 })));
}

#[test]
fn a_pass_that_the_correction_takes_out_of_the_material_is_refused() {
    // The crests end a tenth short of a groove 1.353 deep: 7.4 %.
    let m20 = |side, first| ThreadMillSpec { side, infeed: vec![first, 1.0], ..spec(20.0, 2.5, 16.0, 1) };
    let inside = ["does not reach the wall of the hole", "write more than 0.075"];
    refused(&m20(ThreadSide::Inside, 0.07), Code::PLAN_VALUE, "infeed[0]", &inside);
    planned(&m20(ThreadSide::Inside, 0.075));
    // About a boss 0.7 %.
    let outside = ["does not reach the boss", "write more than 0.008"];
    refused(&m20(ThreadSide::Outside, 0.007), Code::PLAN_VALUE, "infeed[0]", &outside);
    planned(&m20(ThreadSide::Outside, 0.008));
    // A tool whose path is not corrected cuts in each pass.
    let mut corrected = m20(ThreadSide::Inside, 0.01);
    corrected.cutter.profile = MillProfile::Corrected;
    planned(&corrected);
    let second = ThreadMillSpec { infeed: vec![0.01, 0.02, 1.0], ..m20(ThreadSide::Inside, 1.0) };
    refused(&second, Code::PLAN_VALUE, "infeed[0]", &inside);
}

#[test]
fn more_moves_than_a_program_holds_are_refused_before_they_are_made() {
    // 8 moves and 13 turns in each of ten passes.
    let many = |places: usize| ThreadMillSpec {
        infeed: (1..=10).map(|i| 0.1 * f64::from(i)).collect(),
        places: vec![DVec2::ZERO; places],
        ..spec(20.0, 2.5, 12.0, 1)
    };
    let text = ["too many moves and turns of milled threads", "fewer threads"];
    refused(&many(5000), Code::PLAN_VALUE, "points", &text);
    planned(&many(50));
    // Quarters of a turn on a cone.
    let cone = ThreadMillSpec { places: vec![DVec2::ZERO; 30_000], ..npt(ThreadSide::Inside) };
    refused(&cone, Code::PLAN_VALUE, "points", &text);
}

#[test]
fn the_name_of_a_thread_has_its_taper() {
    let name = npt(ThreadSide::Inside).thread.name();
    assert_eq!(name, "21.223 x 1.8143 NPT taper 1 in 16");
    assert_eq!(spec(20.0, 2.5, 12.0, 1).thread.name(), "M20x2.5");
}

/// The findings of a plan about the overcut of the flanks, of a severity.
fn overcut(spec: &ThreadMillSpec, severity: Severity) -> Vec<String> {
    let plan = planned(spec);
    assert!(plan.findings.len() <= 1 && plan.findings.iter().all(|f| f.code == Code::THREAD_OVERCUT));
    plan.findings.iter().filter(|f| f.severity == severity).map(ToString::to_string).collect()
}

#[test]
fn a_large_tool_is_warned_of_with_its_overcut() {
    let warned = |spec: &ThreadMillSpec| overcut(spec, Severity::Warning);
    let m20 = spec(20.0, 2.5, 16.0, 1);
    let told = warned(&m20);
    assert_eq!(told.len(), 1);
    for part in [
        "thread mill 16 for M20x2.5 overcuts the flanks by 0.094",
        "the major diameter is 0.201 mm too small",
        "14 or less",
        "profile = \"corrected\"",
    ] {
        assert!(told[0].contains(part), "no `{part}` in {told:?}");
    }
    assert!(warned(&spec(20.0, 2.5, 14.0, 1)).is_empty());
    // Fine threads allow 0.8 of the diameter.
    assert!(warned(&spec(20.0, 1.5, 16.0, 1)).is_empty());
    assert_eq!(warned(&spec(20.0, 1.5, 16.1, 1)).len(), 1);
    let corrected = ThreadCutter { profile: MillProfile::Corrected, ..m20.cutter };
    let corrected = ThreadMillSpec { cutter: corrected, ..m20 };
    assert!(planned(&corrected).findings.is_empty());
}

#[test]
fn a_major_diameter_below_nominal_is_noted_above_two_hundredths() {
    let noted = |spec: &ThreadMillSpec| overcut(spec, Severity::Note);
    let m20 = spec(20.0, 2.5, 14.0, 1);
    let told = noted(&m20);
    assert_eq!(told.len(), 1);
    for part in ["thread mill 14 for M20x2.5", "the major diameter is 0.110 mm below nominal"] {
        assert!(told[0].contains(part), "no `{part}` in {told:?}");
    }
    // That is what the crests leave.
    let [_, run] = planned(&m20).radii;
    assert!((20.0 - 2.0 * (run + 7.0) - 0.110).abs() < 5e-4, "{run}");
    // An oversize brings it back; what is below two hundredths is not said.
    let wider = ThreadMillSpec { oversize: 0.1, ..m20.clone() };
    assert!(noted(&wider).is_empty());
    let wider = ThreadMillSpec { oversize: 0.05, ..m20.clone() };
    assert!(noted(&wider)[0].contains("is 0.059 mm below nominal"), "{:?}", noted(&wider));
    assert!(planned(&spec(20.0, 2.5, 5.0, 1)).findings.is_empty());
    assert!(planned(&ThreadMillSpec { side: ThreadSide::Outside, ..m20 }).findings.is_empty());
}
