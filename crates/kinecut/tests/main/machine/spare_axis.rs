//! Paths on controls that move the axes straight, and spare axes: the points between keep the tip on its line, and no other
//! place of a swept axis that was tried is better.

use glam::DVec3;
use kinecut::base::{Code, Silent};
use kinecut::machine::Machine;
use kinecut::verbs::ik::{InverseWants, PathWants, StraightWants, SweepWants, path, sweep, sweep_path};
use kinecut::verbs::poses::{AxisValues, PoseTexts};

const PATH: &str =
    "X0 Y0 Z0 I0.1 J0 K1\nX10 Y0 Z0 I0.2 J0.1 K1\nX20 Y5 Z0 I0.2 J0.4 K1\nX30 Y5 Z5 I-0.1 J0.5 K1\n";

fn poses() -> PoseTexts {
    PoseTexts::read("p", PATH).unwrap()
}

#[test]
fn points_between_keep_the_tip_on_its_line() {
    let machine = Machine::preset("trt_xyzac").unwrap();
    let wants = PathWants { straight: Some(StraightWants::new(0.02)), ..PathWants::default() };
    let sheet = path(&machine, &poses(), &wants, &Silent).unwrap();
    let steps = sheet.straight.as_ref().unwrap();
    assert_eq!(steps.len(), 3);
    let chain = machine.kinematics(0.0);
    let at = |v: &AxisValues| v.joints(&machine).unwrap();
    for step in steps {
        assert!(step.deviation > 0.5 && step.left <= 0.02 && !step.inserted.is_empty(), "{step:?}");
        // Between neighbours every axis moves in proportion; the tip is followed finely.
        let ends = [&sheet.joints[step.index - 1], &sheet.joints[step.index]];
        let tips = ends.map(|v| chain.forward(&at(v)).translation);
        let off = |p: DVec3| {
            let way = tips[1] - tips[0];
            let share = ((p - tips[0]).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            p.distance(tips[0] + way * share)
        };
        let follow = |points: &[&AxisValues]| {
            let mut worst = 0.0f64;
            for pair in points.windows(2) {
                let (from, to) = (at(pair[0]), at(pair[1]));
                for i in 0..=50 {
                    let share = f64::from(i) / 50.0;
                    let q: Vec<f64> = from.iter().zip(to.iter()).map(|(a, b)| a + (b - a) * share).collect();
                    worst = worst.max(off(chain.forward(&q).translation));
                }
            }
            worst
        };
        let plain = follow(&ends);
        assert!((plain - step.deviation).abs() < 0.01 * plain, "{plain} {}", step.deviation);
        let mut all = vec![ends[0]];
        all.extend(&step.inserted);
        all.push(ends[1]);
        let with = follow(&all);
        assert!(with <= 0.0201, "{with}");
    }
    let bad = PathWants { straight: Some(StraightWants::new(-1.0)), ..PathWants::default() };
    assert_eq!(path(&machine, &poses(), &bad, &Silent).unwrap_err().code(), Code::TOO_MANY_PARTS);
}

#[test]
fn solutions_of_a_swept_axis_give_the_pose() {
    let machine = Machine::preset("six_axis_trsrn").unwrap();
    let swept = SweepWants { axis: 'A', places: 9 };
    let words = poses().items[1].clone().unwrap();
    let answer = sweep(&machine, &words, &InverseWants::default(), &swept).unwrap();
    assert_eq!(answer.places.len(), 9);
    assert_eq!((answer.places[0].at, answer.places[8].at), (-360.0, 360.0));
    let chain = machine.kinematics(0.0);
    let axis = DVec3::new(0.2, 0.1, 1.0).try_normalize().unwrap();
    let mut found = 0;
    for place in &answer.places {
        assert!(place.solutions.is_empty() == place.finding.is_some());
        for s in &place.solutions {
            assert_eq!(s.joints.0[0], ('A', place.at));
            let tip = chain.forward(&s.joints.joints(&machine).unwrap());
            assert!((tip.translation - DVec3::new(10.0, 0.0, 0.0)).length() < 1e-9);
            assert!((tip.rotation.z_axis - axis).length() < 1e-11);
            found += 1;
        }
    }
    assert!(found >= 8, "{found}");
    let best = answer.places.iter().find(|p| Some(p.at) == answer.best).unwrap();
    let of = |p: &kinecut::verbs::ik::SweptPlace| p.margin.as_ref().map_or(0.0, |m| m.margin);
    assert!(answer.places.iter().all(|p| of(p) <= of(best) + 1e-9));
}

#[test]
fn a_spare_axis_is_held_where_its_worst_pose_is_best() {
    let machine = Machine::preset("six_axis_trsrn").unwrap();
    let swept = SweepWants { axis: 'A', places: 13 };
    let answer = sweep_path(&machine, &poses(), &PathWants::default(), &swept, &Silent).unwrap();
    assert!(answer.path.joints.iter().all(|v| v.0[0] == ('A', answer.at)));
    let best = answer.places.iter().find(|p| p.at == answer.at).unwrap();
    let margin = best.margin.as_ref().unwrap();
    // The margin by hand: travels, and the area that the directions of C and B span at the tool, by differences.
    let chain = machine.kinematics(0.0);
    let mut worst = 1.0f64;
    for v in &answer.path.joints {
        let q = v.joints(&machine).unwrap();
        for (i, joint) in machine.joints.iter().enumerate().skip(1) {
            let [low, high] = joint.travel.unwrap();
            worst = worst.min((q[i] - low).min(high - q[i]) / (0.5 * (high - low)));
        }
        let rate = |i: usize| {
            let mut ahead = q;
            let mut back = q;
            ahead[i] += 1e-5;
            back[i] -= 1e-5;
            (chain.forward(&ahead).rotation.z_axis - chain.forward(&back).rotation.z_axis) / 2e-5
        };
        worst = worst.min(rate(4).cross(rate(5)).length());
    }
    assert!((margin.0.margin - worst).abs() < 1e-8, "{} {worst}", margin.0.margin);
    assert!(worst > 0.4, "a good place is found: {worst}");
    for place in answer.places.iter().filter(|p| p.finding.is_none() && p.retracts <= best.retracts) {
        assert!(place.margin.as_ref().unwrap().0.margin <= margin.0.margin + 1e-9);
    }
    // The same with fewer threads, byte by byte.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let alone =
        pool.install(|| sweep_path(&machine, &poses(), &PathWants::default(), &swept, &Silent).unwrap());
    assert_eq!(alone, answer);
}

#[test]
fn axes_that_cannot_be_swept_are_named() {
    let machine = Machine::preset("six_axis_trsrn").unwrap();
    let locked = AxisValues(vec![('A', 10.0)]);
    for (axis, places, locked) in
        [('Q', 9, None), ('A', 1, None), ('A', 100_000, None), ('A', 9, Some(&locked))]
    {
        let swept = SweepWants { axis, places };
        let error = swept.check(&machine, locked.unwrap_or(&AxisValues::default())).unwrap_err();
        assert_eq!(error.code(), Code::MACHINE_AXIS, "{axis} {places}");
    }
    // A machine without a spare axis: its pose fixes what is swept.
    let plain = Machine::preset("trt_xyzac").unwrap();
    let swept = SweepWants { axis: 'A', places: 9 };
    let error = sweep_path(&plain, &poses(), &PathWants::default(), &swept, &Silent).unwrap_err();
    assert!(error.0.message.starts_with("wherever A is held"), "{}", error.0.message);
}
