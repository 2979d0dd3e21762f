//! The way down into a pocket where a helix has no room, or another way is asked for.

use glam::{DVec2, DVec3, dvec2};
use kinecut::base::Code;
use kinecut::clearing::{PocketEntry, PocketPlan, PocketSpec, plan_pocket};
use kinecut::geom::Outline;
use kinecut::holes::{CutterData, Sense, ToolpathPace, ToolpathRole};

use super::{disc, judge, polygon, rectangle, spec, with_circle};

/// A cutter that does not cut at its centre, with a steepest ramp [deg].
fn without_centre(of: PocketSpec, steepest: f64) -> PocketSpec {
    let cutter =
        CutterData { centre_cutting: false, max_ramp_angle: Some(steepest.to_radians()), ..of.cutter };
    PocketSpec { cutter, ramp: steepest.min(3.0).to_radians(), ..of }
}

/// The moves down of a level.
fn entry(plan: &PocketPlan, level: u32) -> Vec<(DVec3, DVec3, f64)> {
    let moves = plan.moves.iter().filter(|m| m.level == level && m.role == ToolpathRole::Entry);
    let flat = |m: &&kinecut::holes::PlannedMove| {
        m.curve.start().truncate().distance(m.curve.end().truncate()) > 1e-9
    };
    moves.filter(flat).map(|m| (m.curve.start(), m.curve.end(), m.curve.length())).collect()
}

/// Falls along the moves down, flat at last; none steeper than an angle [deg].
fn is_a_ramp(plan: &PocketPlan, steepest: f64) {
    for (level, floor) in plan.levels.iter().enumerate() {
        let moves = entry(plan, level as u32);
        let mut flat = 0.0;
        for (from, to, length) in &moves {
            let fall = from.z - to.z;
            let level = (length * length - fall * fall).max(0.0).sqrt();
            assert!(fall > -1e-9 && fall <= level * steepest.to_radians().tan() + 1e-9, "{from} {to}");
            flat = if fall.abs() < 1e-9 { flat + level } else { 0.0 };
        }
        let last = moves.last().expect("moves down").1;
        assert!((last.z - floor).abs() < 1e-9 && flat > 0.0, "{last} {floor}");
        // All of the way was cut to the floor: each place of it is on the way along the floor at last.
        let on_floor: Vec<_> = moves.iter().filter(|(from, to, _)| from.z.max(to.z) < floor + 1e-9).collect();
        for (from, _, _) in &moves {
            let p = from.truncate();
            let near = |a: &DVec3, b: &DVec3| {
                let (a, b) = (a.truncate(), b.truncate());
                let share = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                p.distance(a.lerp(b, share))
            };
            let far = on_floor.iter().map(|(a, b, _)| near(a, b)).fold(f64::INFINITY, f64::min);
            assert!(far < 0.05, "{p} is {far} off the way along the floor");
        }
    }
}

fn ring() -> Outline {
    with_circle(&disc(30.0), DVec2::ZERO, 18.5)
}

#[test]
fn a_ramp_enters_where_the_helix_has_no_room() {
    // Room for a radius of 1 mm where a helix needs 1.5; a bent strip; a ring about an island.
    let strip = rectangle(60.0, 12.0);
    let bent = polygon(&[[0.0, 0.0], [60.0, 0.0], [60.0, 11.0], [11.0, 11.0], [11.0, 50.0], [0.0, 50.0]]);
    for (name, outline) in [
        ("strip", strip),
        ("turned", rectangle(60.0, 11.0).moved(0.4, DVec2::ZERO)),
        ("bent", bent),
        ("ring", ring()),
    ] {
        for steepest in [3.0, 1.0] {
            let spec = without_centre(spec(outline.clone(), 10.0, 60.0), steepest);
            let spec = PocketSpec { stepdown: Some(3.0), ..spec };
            let plan = plan_pocket(&spec).expect(name);
            let f = plan.figures;
            assert_eq!((f.entries, f.ramps, f.plunges), (1, 1, 0), "{name}");
            assert!((f.entry.to_degrees() - 180.0).abs() < 1e-9, "{name}");
            is_a_ramp(&plan, steepest);
            let found = judge(&spec, &plan, 211);
            // Of the passes; that of the way down is said by itself.
            assert!(found.pass < 61.0 && f.largest.to_degrees() < 60.1, "{name}: {found:?} {f:?}");
            assert!(found.left == 0.0 && found.link < 16.0, "{name}: {found:?}");
        }
    }
}

#[test]
fn a_ramp_is_made_where_it_is_asked_for() {
    let base = spec(rectangle(70.0, 40.0), 10.0, 60.0);
    let asked = PocketSpec { entry: PocketEntry::Ramp, ..base.clone() };
    let plan = plan_pocket(&asked).expect("a plan");
    assert_eq!((plan.figures.entries, plan.figures.ramps), (1, 1));
    is_a_ramp(&plan, 3.0);
    // Along the line in the middle of the longer walls.
    assert!(entry(&plan, 0).iter().all(|(a, b, _)| (a.y - 20.0).abs() < 0.5 && (b.y - 20.0).abs() < 0.5));
    let found = judge(&asked, &plan, 211);
    assert!(found.pass < 61.0 && found.left == 0.0 && found.link < 16.0, "{found:?}");
    let helix = plan_pocket(&base).expect("a plan");
    assert_eq!((helix.figures.entries, helix.figures.ramps), (1, 0));
    // Conventional is the mirror of it.
    let mirrored =
        PocketSpec { sense: Sense::Conventional, outline: asked.outline.mirrored(), ..asked.clone() };
    let other = plan_pocket(&mirrored).expect("a plan");
    assert_eq!(plan.moves.len(), other.moves.len());
    for (m, n) in plan.moves.iter().zip(&other.moves) {
        let flip = |p: DVec3| p.with_y(-p.y);
        assert!(flip(m.curve.end()).distance(n.curve.end()) < 1e-6);
    }
    // An open side needs no way down, whatever is asked for.
    let stock = Some(rectangle(45.0, 100.0).moved(0.0, dvec2(0.0, -30.0)));
    let open = PocketSpec { stock, ..asked };
    assert_eq!(plan_pocket(&open).expect("a plan").figures.entries, 0);
}

#[test]
fn a_cutter_plunges_last_and_only_with_a_centre() {
    // Too small for a ramp as long as the cutter is wide.
    let small = spec(rectangle(17.0, 12.0), 10.0, 60.0);
    let plan = plan_pocket(&small).expect("a plan");
    assert_eq!((plan.figures.entries, plan.figures.ramps, plan.figures.plunges), (1, 0, 1));
    let down = plan.moves.iter().filter(|m| m.role == ToolpathRole::Entry && m.curve.start().z > 0.0);
    let slowest = down
        .filter(|m| m.curve.start().truncate().distance(m.curve.end().truncate()) < 1e-9)
        .map(|m| match m.pace {
            ToolpathPace::Feed(feed) => feed,
            ToolpathPace::Rapid => f64::INFINITY,
        })
        .fold(0.0, f64::max);
    assert!((slowest - 0.3 * small.feed).abs() < 1e-9, "{slowest}");
    let found = judge(&small, &plan, 31);
    assert!(found.pass < 61.0 && found.left == 0.0, "{found:?}");
    let refused = plan_pocket(&without_centre(small, 3.0)).expect_err("no way in").0;
    assert_eq!(refused.code, Code::ENTRY_IMPOSSIBLE);
    for words in [
        "the helix needs a width of 13.040 mm and has 12.000 mm",
        "the ramp needs 10.000 mm",
        "drill 11.0 mm at (8.500, 6.000)",
    ] {
        let all = format!("{} {:?}", refused.message, refused.help);
        assert!(all.contains(words), "{words}: {all}");
    }
    let wide = spec(rectangle(70.0, 40.0), 10.0, 60.0);
    let asked = PocketSpec { entry: PocketEntry::Plunge, ..wide.clone() };
    let plan = plan_pocket(&asked).expect("a plan");
    assert_eq!(plan.figures.plunges, 1);
    let found = judge(&asked, &plan, 211);
    assert!(found.pass < 61.0 && found.left == 0.0, "{found:?}");
    let refused = plan_pocket(&without_centre(asked, 3.0)).expect_err("no centre").0;
    assert_eq!((refused.code, refused.key.as_deref()), (Code::ENTRY_IMPOSSIBLE, Some("entry.way")));
    let asked = PocketSpec {
        entry: PocketEntry::Helix,
        ..without_centre(spec(rectangle(60.0, 12.0), 10.0, 60.0), 3.0)
    };
    assert_eq!(plan_pocket(&asked).expect_err("no helix").0.code, Code::ENTRY_IMPOSSIBLE);
}
