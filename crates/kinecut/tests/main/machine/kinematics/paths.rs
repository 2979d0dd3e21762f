//! Paths of the joints and straight moves.

use glam::DVec3;
use kinecut::base::Silent;
use kinecut::machine::Machine;
use kinecut::machine::kinematics::{
    JointPath, LinearOptions, Orientation, PathOptions, RetractKind, StepCost, ToolPose, Travels,
};

use crate::common::random::Random;
use crate::common::stop::Stop;

fn tilted(tilt: f64, azimuth: f64) -> DVec3 {
    let (sin, cos) = azimuth.sin_cos();
    DVec3::new(tilt.sin() * cos, tilt.sin() * sin, tilt.cos())
}

fn circle(turns: f64, count: usize) -> Vec<ToolPose> {
    let pose = |i: usize| {
        let azimuth = turns * std::f64::consts::TAU * i as f64 / (count - 1) as f64;
        ToolPose { tip: DVec3::new(20.0, 0.0, 0.0), axis: Some(tilted(0.5, azimuth)) }
    };
    (0..count).map(pose).collect()
}

fn assert_continuous(path: &JointPath) {
    for (i, pair) in path.values.windows(2).enumerate() {
        let far = (0..2).any(|j| (pair[1][j] - pair[0][j]).abs() > 60f64.to_radians() + 1e-9);
        assert_eq!(far, path.retracts.iter().any(|r| r.index == i + 1));
    }
}

/// The cost of the best path by trying all, for few poses.
fn cheapest(machine: &Machine, poses: &[ToolPose], travels: &Travels) -> f64 {
    let chain = machine.kinematics(0.0);
    let turn = std::f64::consts::TAU;
    let mut paths: Vec<(f64, [f64; 2])> = vec![(0.0, [0.0; 2])];
    for (index, pose) in poses.iter().enumerate() {
        let mut next: Vec<(f64, [f64; 2])> = Vec::new();
        for solution in chain.inverse(pose.tip, pose.axis.unwrap(), &[]).unwrap().iter() {
            for (i, j) in (-2..=2).flat_map(|i| (-2..=2).map(move |j| (i, j))) {
                let q = [solution.values[0] + turn * f64::from(i), solution.values[1] + turn * f64::from(j)];
                if (0..2).any(|k| travels.beyond(k, q[k]) > 0.0) {
                    continue;
                }
                for (cost, before) in &paths {
                    let travel = [0, 1].map(|k| (q[k] - before[k]).abs());
                    let far = index > 0 && travel.iter().any(|t| *t > 60f64.to_radians());
                    let more = if far { 1000f64.to_radians() } else { 0.0 };
                    next.push((cost + travel[0] + travel[1] + more, q));
                }
            }
        }
        paths = next;
    }
    paths.iter().map(|(cost, _)| *cost).fold(f64::INFINITY, f64::min)
}

#[test]
fn no_path_is_cheaper() {
    let machine = Machine::preset("trt_xyzac").unwrap();
    let mut random = Random(21);
    for limit in [200f64, 380.0, 700.0] {
        for _ in 0..12 {
            let mut travels = Travels::default();
            travels.0[0] = Some([-limit.to_radians(), limit.to_radians()]);
            travels.0[1] = Some([-110f64.to_radians(), 100f64.to_radians()]);
            let mut azimuth = 3.0 * random.unit();
            let poses: Vec<ToolPose> = (0..4)
                .map(|_| {
                    azimuth += random.unit();
                    let axis = tilted(0.8 + 0.6 * random.unit(), azimuth);
                    ToolPose { tip: random.vector(50.0), axis: Some(axis) }
                })
                .collect();
            let path = machine.kinematics(0.0).path(&poses, &PathOptions::new(travels), &Silent).unwrap();
            let best = cheapest(&machine, &poses, &travels);
            assert!((path.cost - best).abs() < 1e-8, "{} {best}", path.cost);
            assert_continuous(&path);
            for (pose, q) in poses.iter().zip(&path.values) {
                let at = machine.kinematics(0.0).forward(q);
                assert!(at.translation.distance(pose.tip) < 1e-9);
                assert!(at.rotation.z_axis.distance(pose.axis.unwrap()) < 1e-11);
            }
        }
    }
}

#[test]
fn a_pose_along_the_first_axis_keeps_its_position() {
    let machine = Machine::preset("trt_xyzac").unwrap();
    let chain = machine.kinematics(0.0);
    // Tilted, upright for a while, tilted on the other side: straight through the pole, C stands.
    let tilts = [0.3, 0.2, 0.1, 0.0, 0.0, -0.1, -0.2];
    let poses: Vec<ToolPose> = tilts
        .iter()
        .map(|&tilt| ToolPose { tip: DVec3::new(5.0, 6.0, 7.0), axis: Some(tilted(tilt, 0.9)) })
        .collect();
    let path = chain.path(&poses, &PathOptions::new(machine.travels()), &Silent).unwrap();
    assert!(path.retracts.is_empty());
    assert!(path.values.iter().all(|q| (q[0] - path.values[0][0]).abs() < 1e-12));
    // Leaving the pole to another side turns C: one retraction, when it leaves.
    let mut poses = poses;
    for pose in &mut poses[5..] {
        pose.axis = Some(tilted(0.2, 0.9 + 1.5));
    }
    let path = chain.path(&poses, &PathOptions::new(machine.travels()), &Silent).unwrap();
    assert_eq!(path.retracts.len(), 1);
    assert_eq!((path.retracts[0].index, path.retracts[0].kind), (5, RetractKind::Flip));
    assert_continuous(&path);
    let strict = PathOptions { may_retract: false, ..PathOptions::new(machine.travels()) };
    let error = chain.path(&poses, &strict, &Silent).unwrap_err();
    assert_eq!(error.code().as_str(), "KC1116");
    assert!(error.to_string().contains("between poses 4 and 5"), "{error}");
    // A free start takes C from the first pose that determines it.
    let free = PathOptions { start: None, ..PathOptions::new(machine.travels()) };
    let path = chain.path(&poses[3..], &free, &Silent).unwrap();
    assert!(path.retracts.is_empty());
    assert!((path.values[0][0] - path.values[2][0]).abs() < 1e-12);
}

#[test]
fn options_of_a_path() {
    let machine = Machine::preset("trt_xyzbc").unwrap();
    let chain = machine.kinematics(0.0);
    let poses = circle(0.5, 19);
    // Nearest from B -20 degrees takes the negative side; positive is preferred where that is asked for.
    let mut start = kinecut::machine::JointValues::zero(5);
    start[1] = -20f64.to_radians();
    start[0] = std::f64::consts::PI;
    let near = PathOptions { start: Some(start), ..PathOptions::new(machine.travels()) };
    let path = chain.path(&poses, &near, &Silent).unwrap();
    assert!(path.values.iter().all(|q| q[1] < 0.0));
    let positive = PathOptions { prefer_positive: Some(1), ..near };
    let path = chain.path(&poses, &positive, &Silent).unwrap();
    assert!(path.values.iter().all(|q| q[1] > 0.0) && path.retracts.is_empty());
    // A C that is slow in time, a B that is quick: the time is that of C.
    let speeds = [0.5, 5.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
    let timed = PathOptions { cost: StepCost::Time(speeds), ..PathOptions::new(machine.travels()) };
    let path = chain.path(&poses, &timed, &Silent).unwrap();
    assert!((path.cost - std::f64::consts::PI / 0.5 - 0.5 / 5.0).abs() < 1e-9, "{}", path.cost);
    // No solution inside the travel: B reaches 20 degrees only, X 10 mm.
    let mut travels = machine.travels();
    travels.0[1] = Some([-20f64.to_radians(), 20f64.to_radians()]);
    let error = chain.path(&poses, &PathOptions::new(travels), &Silent).unwrap_err();
    assert_eq!(error.code().as_str(), "KC1115");
    assert!(error.to_string().contains("joint 2"), "{error}");
    let mut travels = machine.travels();
    travels.0[2] = Some([-1.0, 1.0]);
    let error = chain.path(&poses, &PathOptions::new(travels), &Silent).unwrap_err();
    assert!(error.to_string().contains("joint 3") && error.to_string().contains("mm"), "{error}");
    let mut bad = poses.clone();
    bad[7].axis = Some(DVec3::ZERO);
    let error = chain.path(&bad, &PathOptions::new(machine.travels()), &Silent).unwrap_err();
    assert_eq!(error.code().as_str(), "KC1114");
    assert!(error.to_string().contains("pose 7"), "{error}");
    assert!(chain.path(&[], &near, &Silent).unwrap().values.is_empty());
}

#[test]
fn long_paths_wind_and_stop_when_asked() {
    let machine = Machine::preset("hermle_like_c42").unwrap();
    let chain = machine.kinematics(0.0);
    let poses = circle(90.0, 20_001);
    let rotary = machine.travels().only(|joint| joint < 2);
    let path = chain.path(&poses, &PathOptions::new(rotary), &Silent).unwrap();
    assert!(path.retracts.is_empty());
    let wound = path.values[20_000][0] - path.values[0][0];
    assert!((wound / std::f64::consts::TAU - 90.0).abs() < 1e-9);
    let error = chain.path(&poses, &PathOptions::new(rotary), &Stop).unwrap_err();
    assert_eq!(error.code().as_str(), "KC0009");
}

#[test]
fn a_polar_lathe_mills_a_square() {
    let machine = Machine::preset("lathe_xzc").unwrap();
    let chain = machine.kinematics(0.0);
    let mut poses = Vec::new();
    for (from, to) in
        [((20, 20), (-20, 20)), ((-20, 20), (-20, -20)), ((-20, -20), (20, -20)), ((20, -20), (20, 20))]
    {
        for i in 0..40 {
            let share = f64::from(i) / 40.0;
            let (a, b) =
                (DVec3::new(from.0.into(), from.1.into(), -3.0), DVec3::new(to.0.into(), to.1.into(), -3.0));
            poses.push(ToolPose { tip: a + (b - a) * share, axis: None });
        }
    }
    let path = chain.path(&poses, &PathOptions::new(machine.travels()), &Silent).unwrap();
    assert!(path.retracts.is_empty());
    // X stays on the side that its travel allows.
    assert!(path.values.iter().all(|q| q[2] > 19.9));
    let turned = path.values[159][0] - path.values[0][0];
    assert!((315.0..361.0).contains(&turned.to_degrees().abs()), "{turned}");
}

#[test]
fn divided_moves_keep_to_the_line_and_the_great_circle() {
    let mut random = Random(31);
    for name in
        ["trt_xyzac", "head_bc_bridge", "ht_bc_max", "nut_head_c_b45", "dmu_nut_table", "millturn_xyzbc"]
    {
        let machine = Machine::preset(name).unwrap();
        let chain = machine.kinematics(60.0);
        for _ in 0..6 {
            let mut positions = |size: f64, near: &[f64]| -> Vec<f64> {
                let joints = machine.joints.iter().enumerate();
                joints
                    .map(|(i, j)| {
                        let rotary = j.motion.is_rotation();
                        near.get(i).unwrap_or(if rotary { &0.8 } else { &0.0 })
                            + random.unit() * size * if rotary { 0.4 } else { 60.0 }
                    })
                    .collect()
            };
            let from = positions(1.0, &[]);
            let to = positions(0.6, &from);
            for orientation in [Orientation::GreatCircle, Orientation::Axes] {
                for tcp in [false, true] {
                    let options = LinearOptions { orientation, tcp, ..LinearOptions::new(0.01) };
                    let parts = chain.linear_move(&from, &to, &options).unwrap();
                    assert_eq!(parts.values.len(), parts.shares.len());
                    assert_eq!(parts.shares.last(), Some(&1.0));
                    assert_eq!(parts.values.last().unwrap().to_vec(), to);
                    let (start, end) = (chain.forward(&from), chain.forward(&to));
                    let way = end.translation - start.translation;
                    let mut before = from.clone();
                    for q in &parts.values {
                        for i in 1..20 {
                            let share = f64::from(i) / 20.0;
                            let between: Vec<f64> =
                                before.iter().zip(q.iter()).map(|(a, b)| a + (b - a) * share).collect();
                            let at = chain.forward(&between);
                            let arm = at.translation - start.translation;
                            let off = arm.cross(way).length() / way.length();
                            // Checked at three places of each part; in between little more.
                            assert!(tcp || off < 0.01 * 1.1, "{name} {off}");
                            if orientation == Orientation::GreatCircle {
                                let plane = start.rotation.z_axis.cross(end.rotation.z_axis);
                                let lean = (at.rotation.z_axis.dot(plane) / plane.length()).abs().asin();
                                assert!(lean < 0.11f64.to_radians(), "{name} {lean}");
                            }
                        }
                        before = q.to_vec();
                    }
                    if tcp && orientation == Orientation::Axes {
                        assert_eq!(parts.values.len(), 1);
                    }
                }
            }
        }
    }
}

#[test]
fn a_move_over_the_pole_to_another_side_is_refused() {
    let chain = Machine::preset("trt_xyzac").unwrap().kinematics(0.0);
    // Nearly over the pole: C turns quickly, but can be divided.
    let solve = |axis: DVec3, given: &[f64]| chain.inverse(DVec3::ZERO, axis, given).unwrap();
    let from = solve(tilted(0.2, 0.0), &[])[0].values;
    let turn = std::f64::consts::TAU;
    let mut past = solve(tilted(0.2, 3.0), &[])[0].values;
    past[0] += ((from[0] - past[0]) / turn).ceil() * turn;
    let parts = chain.linear_move(&from, &past, &LinearOptions::new(0.01)).unwrap();
    assert!(parts.values.len() > 10);
    // Exactly over it with both ends on one solution: C makes half a turn while the tool is as good as upright.
    let over = solve(tilted(-0.2, 0.0), &[])[0].values;
    let parts = chain.linear_move(&from, &over, &LinearOptions::new(0.01)).unwrap();
    assert!(parts.deviation.from_line <= 0.01 && parts.deviation.axis_in_step <= 0.1f64.to_radians());
    let turned = parts.values.windows(2).map(|q| (q[1][0] - q[0][0]).abs()).fold(0.0, f64::max);
    assert!(turned > 1.5, "{turned}");
    // Where nothing is as good as upright, it would have to turn at once.
    let exact = LinearOptions { axis_tolerance: 1e-10, ..LinearOptions::new(0.01) };
    let error = chain.linear_move(&from, &over, &exact).unwrap_err();
    assert_eq!(error.code().as_str(), "KC1118");
    assert!(error.to_string().contains("50."), "{error}");
    // With the other solution at the end C stands and A passes through zero.
    let mut straight = solve(tilted(-0.2, 0.0), &[])[1].values;
    straight[0] += ((from[0] - straight[0]) / turn).round() * turn;
    let parts = chain.linear_move(&from, &straight, &LinearOptions::new(0.01)).unwrap();
    assert!(parts.values.iter().all(|q| (q[0] - from[0]).abs() < 1e-9));
}
