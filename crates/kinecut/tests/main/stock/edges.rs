//! Edges of the stock that a tool clips between the lines of the model, lower than a step and narrower than the diagonal
//! of four lines: met, or said to be near; and a tool that leaves them room is not suspected.

use glam::{DMat3, DQuat, DVec3};
use kinecut::base::{Code, MemoryLoader, Silent};
use kinecut::geom::{Aabb, Arc, Curve, Line, Profile, ProfileElement, Rigid};
use kinecut::job::{Judgement, run};
use kinecut::stock::TriDexel;
use kinecut::stock::cut::{CutAxis, CutMove, CutOptions, MoveEffect, ToolBody, cut};
use proptest::prelude::*;

/// Moves through a block of 60 x 60 x 20 mm along the tool axis, its top at 0, its middle on the axis.
fn through(axis: CutAxis, step: f64, moves: &[(Curve, &ToolBody, bool)]) -> Vec<MoveEffect> {
    let turn = DQuat::from_rotation_arc(DVec3::Z, axis.vector());
    let place = |p: DVec3| ((turn * p) * 1e6).round() / 1e6;
    let (a, b) = (place(DVec3::new(-30.0, -30.0, -20.0)), place(DVec3::new(30.0, 30.0, 0.0)));
    let mut stock = TriDexel::from_box(Aabb { min: a.min(b), max: a.max(b) }, step).unwrap();
    let there = Rigid { rotation: DMat3::from_quat(turn), translation: DVec3::ZERO };
    let bodies: Vec<ToolBody> = moves.iter().map(|m| m.1.clone()).collect();
    let list: Vec<CutMove> = moves
        .iter()
        .enumerate()
        .map(|(i, m)| CutMove { watch: m.2, ..CutMove::new(m.0.moved(&there), axis, i as u32) })
        .collect();
    cut(&mut stock, &bodies, &list, &CutOptions::default(), &Silent).unwrap()
}

fn axes() -> impl Strategy<Value = CutAxis> {
    prop_oneof![Just(CutAxis::PlusZ), Just(CutAxis::PlusX), Just(CutAxis::MinusY), Just(CutAxis::MinusZ)]
}

fn angles() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(90.0), Just(45.0), Just(-45.0), 0.0..360.0].prop_map(f64::to_radians)
}

/// A straight way at an angle, `beside` the middle, at a height, longer than the diagonal of the block.
fn straight(angle: f64, beside: f64, z: f64) -> Curve {
    let (s, c) = angle.sin_cos();
    let (d, n) = (DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0));
    let foot = n * beside + DVec3::Z * z;
    Line { start: foot - d * 60.0, end: foot + d * 60.0 }.into()
}

fn round(radius: f64, z: f64) -> Curve {
    Arc::new(DVec3::new(radius, 0.0, z), DVec3::new(0.0, 0.0, z), DVec3::Z, 5.5, 0.0).unwrap().into()
}

fn mill(flutes: f64, shank: Option<f64>) -> ToolBody {
    ToolBody {
        shank: shank.into_iter().map(|d| (Profile::cylinder(d, 40.0).unwrap(), flutes)).collect(),
        ..ToolBody::new(Profile::cylinder(12.0, flutes).unwrap())
    }
}

fn suspected(e: &MoveEffect) -> bool {
    e.edge().is_some_and(|edge| edge.width > 0.05)
}

proptest! {
    #![proptest_config(kinecut_cases::property(120))]
    #[test]
    fn a_clipped_edge_is_met_or_near_and_one_with_room_is_neither(
        axis in axes(), angle in angles(), step in 0.3f64..1.5, wide in 0.06f64..1.3, high in 0.03f64..0.95, ring: bool, depth in 3.0f64..9.0,
        room in 0.0f64..1.0,
    ) {
        let cutter = mill(20.0, None);
        let (wide, high) = (wide * step, high * step);
        prop_assume!(wide > 0.06);
        let way = |beside: f64, z: f64| if ring { round(16.0 + beside, z) } else { straight(angle, beside, z) };
        let moves = [
            (way(0.0, -depth), &cutter, false),
            // In the slot, near its edge, at rapid: with room.
            (way(0.0, -high), &cutter, true),
            (way(0.0, -depth + high), &cutter, true),
            (straight(angle, 1.0, step + room), &cutter, true),
            // And into the edge.
            (way(wide, -high), &cutter, true),
        ];
        let effects = through(axis, step, &moves);
        for e in &effects[1..4] {
            prop_assert!(e.first_contact.is_none() && !suspected(e), "{:?}", e);
        }
        let clipped = &effects[4];
        prop_assert!(clipped.first_contact.is_some() || suspected(clipped), "{} {} {:?}", wide, high, clipped);
        if let Some(edge) = clipped.edge() {
            prop_assert!(edge.width > 0.6 * (wide - 0.002), "{} {:?}", wide, edge);
        }
    }

    #[test]
    fn a_shank_over_an_edge_is_met_or_near_and_one_as_thick_as_the_cutter_is_neither(
        axis in axes(), angle in angles(), step in 0.3f64..1.5, wide in 0.06f64..1.3, high in 0.03f64..0.95, depth in 3.0f64..9.0,
    ) {
        let (wide, high) = (wide * step, high * step);
        prop_assume!(wide > 0.06);
        // The shank begins `high` below the top of the block.
        let right = mill(depth - high, Some(12.0));
        let thick = mill(depth - high, Some(12.0 + 2.0 * wide));
        let above = mill(depth + step, Some(12.0 + 2.0 * wide));
        let way = |z: f64| straight(angle, 0.0, z);
        let levels = |tool| vec![(way(-0.5 * depth), tool, false), (way(-depth), tool, false)];
        for tool in [&right, &above] {
            for e in through(axis, step, &levels(tool)) {
                prop_assert!(e.shank().is_none() && !suspected(&e), "{:?}", e);
            }
        }
        let effects = through(axis, step, &levels(&thick));
        prop_assert!(effects[1].shank().is_some() || suspected(&effects[1]), "{} {} {:?}", wide, high, effects[1]);
    }

    #[test]
    fn a_wall_between_the_lines_is_met_or_near(
        axis in axes(), quarter: bool, step in 0.3f64..1.5, thick in 0.1f64..0.9, high in 0.05f64..0.95, beside in -3.0f64..3.0,
    ) {
        let cutter = mill(20.0, None);
        let (thick, high) = (thick * step, high * step);
        let angle = if quarter { std::f64::consts::FRAC_PI_2 } else { 0.0 };
        let moves = [
            (straight(angle, beside - 6.0 - 0.5 * thick, -8.0), &cutter, false),
            (straight(angle, beside + 6.0 + 0.5 * thick, -8.0), &cutter, false),
            (straight(angle, beside, -high), &cutter, true),
        ];
        let effects = through(axis, step, &moves);
        prop_assert!(effects[2].first_contact.is_some() || suspected(&effects[2]) || thick < 0.06, "{} {} {:?}", thick, high, effects[2]);
    }
}

/// A chamfer slopes up to the body from below: only its continued end is near.
#[test]
fn an_edge_with_a_chamfer_is_met_or_near() {
    let cone = vec![
        ProfileElement::Cone { z0: 0.0, r0: 5.5, z1: 3.0, r1: 8.5 },
        ProfileElement::Cone { z0: 3.0, r0: 8.5, z1: 20.0, r1: 8.5 },
    ];
    let chamfer = ToolBody::new(Profile::new(cone).unwrap());
    let cutter = mill(20.0, None);
    for step in [0.4, 0.7, 1.1] {
        for high in [0.2, 0.5, 0.8] {
            let down: f64 = high * step;
            let into = f64::min(0.3 * step, 0.8 * down);
            let moves = [
                (straight(0.3, 0.0, -6.0), &cutter, false),
                // From 1 below the top at 6 to the top at 7.
                (straight(0.3, 0.0, -1.5), &chamfer, false),
                (straight(0.3, 1.0 - down + into, -down), &cutter, true),
            ];
            let e = &through(CutAxis::PlusZ, step, &moves)[2];
            assert!(e.first_contact.is_some() || suspected(e), "{step} {high} {e:?}");
        }
    }
}

/// A slot, then a rapid back beside it just below the top.
#[test]
fn a_program_that_clips_an_edge_is_found_at_any_step_and_one_with_room_is_safe() {
    let outcome = |step: f64, y: f64, z: f64| {
        let job = format!(
            r#"format = 1
stock = {{ box = {{ min = [0, 0, -20], max = [100, 80, 0] }} }}
post = {{ control = "fanuc" }}
simulate = {{ step = {step:?} }}
[[tool]]
number = 1
type = "end-mill"
diameter = 12
flute_length = 26
stickout = 45
gauge_length = 120
[[setup]]
offset = "G54"
program = {{ file = "P.nc" }}
"#
        );
        let program = format!(
            "%\nO0007\nG17 G21 G40 G49 G80 G90 G94\nG53 G0 Z0.\nT1 M6\nG54 G0 X-10. Y40. S4000 M3\nG43 H1 Z70. M8\nZ2.\nG1 Z-4. F800.\nX110.\nG0 Y{y:.3} Z{z:.3}\nX-10.\nG0 Z70. M9\nG53 G0 Z0. M5\nM30\n%\n"
        );
        run("block.toml", &job, &MemoryLoader::default().with("P.nc", program), &Silent).unwrap().verdict
    };
    for (step, y, z) in [(0.5, 40.3, -0.1), (0.5, 40.08, -0.3), (2.0, 40.9, -0.4), (1.3, 39.8, -0.05)] {
        let found = outcome(step, y, z);
        assert_eq!(found.outcome, Judgement::NotSafe, "{step} {y} {z}");
        let rapid: Vec<_> = found.found.iter().filter(|f| f.code == Code::RAPID_IN_STOCK).collect();
        assert_eq!((rapid.len(), rapid[0].place.as_ref().unwrap().line), (1, 12), "{rapid:?}");
        // As wide and as high as it is, less the clearance.
        let overlap = rapid[0].value.as_ref().unwrap().value;
        let made = f64::min(f64::abs(y - 40.0), -z);
        assert!((overlap - made).abs() < 2e-3, "{overlap} {made}");
        assert!(!found.proven.iter().any(|p| p.claim.contains("no rapid move")), "{:?}", found.proven);
        let right = outcome(step, 40.0, z);
        assert_eq!(right.outcome, Judgement::Safe, "{:?}", right.found);
    }
}
