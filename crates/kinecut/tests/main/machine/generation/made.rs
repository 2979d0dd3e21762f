//! Surfaces of the catalogue on machines, and error budgets.

use glam::{DMat3, DVec3};
use kinecut::base::Silent;
use kinecut::geom::Rigid;
use kinecut::machine::generation::{
    FeasibleOptions, Hold, LinkError, Made, Obstacle, error_budget, error_gain, make_split,
};
use kinecut::machine::surface::{GeneratedSurface, catalogue};
use kinecut::machine::{CoordinateCode, Kinematics, Machine};
use proptest::prelude::*;

fn machine(code: &str) -> Machine {
    Machine::of_code(CoordinateCode::parse(code).unwrap())
}

fn coarse() -> FeasibleOptions {
    FeasibleOptions { cells: [6, 8], ..FeasibleOptions::default() }
}

#[test]
fn the_code_of_a_split_is_a_machine_that_makes_the_surface() {
    let mut made_count = 0;
    for surface in catalogue() {
        for split in surface.splits().unwrap() {
            let text = format!("0{}", split.machine_code());
            let Ok(code) = CoordinateCode::parse(&text) else { continue }; // a motion stands in it twice
            let made =
                make_split(surface, &split, &Machine::of_code(code), Rigid::IDENTITY, &coarse(), &Silent)
                    .unwrap();
            let name = format!("{} {text}", surface.name);
            if !split.is_valid() {
                assert!(matches!(made.outcome, Err(Obstacle::NotRigid { .. })), "{name}");
                continue;
            }
            let way = made.outcome.unwrap_or_else(|e| panic!("{name}: {e:?}"));
            // A joint moves only if its element does, and then with its variables.
            for (element, law) in split.machine.iter().zip(&way.laws) {
                if made.hold == Hold::Frame {
                    assert_eq!(surface.is_forming(element), law.is_forming(), "{name}: {element}");
                }
            }
            assert!(way.tip_error < 1e-7 && way.turn_error < 1e-9, "{name}: {}", way.tip_error);
            let residual = made.residual.unwrap();
            let exact = way.laws.iter().all(|l| l.law != kinecut::machine::generation::VariableLaw::Sampled);
            let bound = if exact { 1e-8 } else { 0.2 };
            assert!(residual.worst().distance.abs() < bound, "{name}: {residual:?}");
            made_count += 1;
        }
    }
    assert!(made_count > 60, "{made_count}");
}

#[test]
fn a_thread_on_a_lathe_and_a_cone_by_a_ground_edge() {
    let lathe = machine("6031");
    let thread = GeneratedSurface::named("inclined-helicoid").unwrap();
    let splits = thread.splits().unwrap();
    let point = splits.iter().find(|s| s.tool.is_empty()).unwrap();
    let made = make_split(&thread, point, &lathe, Rigid::IDENTITY, &coarse(), &Silent).unwrap();
    let way = made.outcome.unwrap();
    let pitch = thread.parameter("p").unwrap();
    assert!(way.lines().contains(&format!("Z follows C, {pitch} mm/rev")), "{:?}", way.lines());
    assert!(made.residual.unwrap().worst().distance.abs() < 1e-8);
    let told = Made { outcome: Ok(way), ..made }.lines(&thread, &lathe);
    assert!(told.last().unwrap().starts_with("made to 0 um .. 0 um of the surface"), "{told:?}");
    // The whole edge: B 5 1 is ground into the tool.
    let cone = GeneratedSurface::named("cone").unwrap();
    let edge = cone.splits().unwrap().into_iter().find(|s| s.machine_code().to_string() == "61").unwrap();
    let made = make_split(&cone, &edge, &lathe, Rigid::IDENTITY, &coarse(), &Silent).unwrap();
    assert_eq!(made.hold, Hold::Frame);
    let way = made.outcome.unwrap();
    assert!(way.lines().contains(&"X is set to 30 mm".to_owned()), "{:?}", way.lines());
    assert!(made.residual.unwrap().worst().distance.abs() < 1e-9);
    // The same machine has no B for the split that swivels it.
    let swivelled =
        cone.splits().unwrap().into_iter().find(|s| s.machine_code().to_string() == "615").unwrap();
    let made = make_split(&cone, &swivelled, &lathe, Rigid::IDENTITY, &coarse(), &Silent).unwrap();
    let told = made.lines(&cone, &lathe);
    assert!(told.len() == 1 && told[0].contains("lacks a motion: 20.05 degrees about Y"), "{told:?}");
    let obstacle = made.outcome.unwrap_err();
    assert!(matches!(obstacle, Obstacle::Unreached { turn, .. } if (turn.length() - 0.35).abs() < 1e-6));
}

#[test]
fn sampled_laws_are_worth_their_nodes() {
    let sphere = GeneratedSurface::named("sphere").unwrap();
    let point = sphere.splits().unwrap().into_iter().find(|s| s.tool.is_empty()).unwrap();
    let lathe = machine("6031");
    let worst = |cells: usize| {
        let options = FeasibleOptions { cells: [4, cells], ..FeasibleOptions::default() };
        let made = make_split(&sphere, &point, &lathe, Rigid::IDENTITY, &options, &Silent).unwrap();
        made.residual.unwrap().worst().distance.abs()
    };
    // Cubics through four nodes: the error falls with the fourth power.
    let (few, many) = (worst(8), worst(16));
    assert!(few > 1e-5 && few / many > 10.0, "{few} {many}");
}

/// A chain whose link `i` has an error, exactly: the chain up to and with it, the error, and the rest.
fn with_error(machine: &Machine, q: &[f64], i: usize, error: LinkError) -> Rigid {
    let (before, after) = machine.joints.split_at(i + 1);
    let first = Kinematics::new(before, machine.work, Rigid::IDENTITY).forward(&q[..=i]);
    let rest = Kinematics::new(after, Rigid::IDENTITY, machine.spindle).forward(&q[i + 1..]);
    let turn = error.turn.length();
    let rotation =
        error.turn.try_normalize().map_or(DMat3::IDENTITY, |axis| DMat3::from_axis_angle(axis, turn));
    let point = machine.joints[i].point;
    let wrong = Rigid { rotation, translation: point - rotation * point + error.shift };
    first.after(&wrong).after(&rest)
}

proptest! {
    #![proptest_config(kinecut_cases::property(64))]

    #[test]
    fn an_error_budget_is_the_first_order_of_the_chain_with_errors(
        q in prop::array::uniform5(-1.0..1.0f64),
        e in prop::array::uniform6(-1.0..1.0f64),
        point in prop::array::uniform3(-50.0..50.0f64),
        link in 0usize..5,
    ) {
        let mut five = machine("641203");
        for (joint, at) in five.joints.iter_mut().zip([3.0, -20.0, 7.0, 11.0, 0.0]) {
            joint.point = DVec3::new(at, 2.0 * at, 10.0 - at);
        }
        five.joints[1].sense = -1.0;
        five.work = Rigid { rotation: DMat3::from_rotation_x(0.2), translation: DVec3::new(5.0, 6.0, 7.0) };
        let q = [q[0], q[1], q[2] * 80.0, q[3] * 80.0, q[4] * 80.0];
        let frame = five.kinematics(0.0).forward(&q);
        let local = DVec3::from(point);
        let at = frame.point(local);
        let normal = (DVec3::from(e.map(|x| x + 0.3)[..3].try_into().unwrap_or([1.0; 3]))).try_normalize().unwrap();
        let small = 1e-5;
        let error = LinkError {
            shift: DVec3::new(e[0], e[1], e[2]) * small,
            turn: DVec3::new(e[3], e[4], e[5]) * small,
        };
        let mut errors = vec![LinkError::default(); 5];
        errors[link] = error;
        let moved = with_error(&five, &q, link, error).point(local) - at;
        let budget = error_budget(&five, &q, at, normal, &errors);
        // Second order: the square of the turn by the arm.
        prop_assert!((budget.total() - moved).length() < 1e-7, "{} {moved}", budget.total());
        prop_assert!((budget.form() - moved.dot(normal)).abs() < 1e-7);
        let gain = error_gain(&five, &q, at, normal);
        let six = [e[0], e[1], e[2], e[3], e[4], e[5]];
        let weighed: f64 = (0..6).map(|k| gain.gains[link][k] * six[k] * small).sum();
        prop_assert!((weighed - budget.form()).abs() < 1e-12);
    }
}

#[test]
fn a_tolerance_budget_of_a_lathe() {
    // A taper of 30 mm radius at 200 mm from the headstock: a lean of C by 10 um/m and a slide by 3 um.
    let lathe = machine("6031");
    let sizes = [
        LinkError { turn: DVec3::splat(1e-5), ..Default::default() },
        LinkError { shift: DVec3::splat(3e-3), ..Default::default() },
        LinkError::default(),
    ];
    let gain = error_gain(&lathe, &[0.0, 200.0, 30.0], DVec3::new(30.0, 0.0, 200.0), DVec3::X);
    // Along X: C's lean about Y acts at 200 mm, about Z not at all; of the slide X alone counts.
    assert!((gain.worst(&sizes) - (2e-3 + 3e-3)).abs() < 1e-12);
    assert!((gain.independent(&sizes) - 2e-3f64.hypot(3e-3)).abs() < 1e-12);
    assert!((gain.gains[0][4] - 200.0).abs() < 1e-9 && gain.gains[0][5].abs() < 1e-9);
}
