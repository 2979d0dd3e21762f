//! Golden numbers of the kinematics of machines, from an independent reference: forward, all inverse solutions, rank,
//! tilt, orientation cover, a turned work frame, poses near the pole, wind-up, linearisation.
//!
//! The file has 12 significant digits: a length of 400 mm is good to 5e-10 mm there, an angle of 100 degrees to 9e-12
//! rad.

mod chain;

use chain::{Golden, axis, tip};
use kinecut::base::Silent;
use kinecut::geom::Rigid;
use kinecut::machine::kinematics::{PathOptions, RetractKind, ToolPose, Travels};
use kinecut::machine::{Kinematics, Machine, presets};
use serde_json::Value;

use crate::common::golden::{self, numbers, vector};

/// Bound on lengths [mm] and what the last of the 12 digits leaves open.
fn length_bound(size: f64) -> f64 {
    1e-9 + 1e-12 * size.abs()
}

/// Bound on angles [rad] and what the last of the 12 digits (in degrees) leaves open.
fn angle_bound(degrees: f64) -> f64 {
    1e-11 + (1e-12 * degrees.abs()).to_radians()
}

/// Holds a list of solutions against that of the file, as sets.
fn assert_same_solutions(machine: &Golden, found: &[Vec<f64>], wanted: &[Vec<f64>], loose: f64, what: &str) {
    assert_eq!(found.len(), wanted.len(), "{what}: {found:?} {wanted:?}");
    for want in wanted {
        let fits = |have: &Vec<f64>| {
            have.iter().zip(want).zip(&machine.joints).all(|((a, b), joint)| {
                if joint.motion.is_rotation() {
                    let turns = (a - b) / std::f64::consts::TAU;
                    let apart = (turns - turns.round()) * std::f64::consts::TAU;
                    apart.abs() < angle_bound(b.to_degrees()) * loose
                } else {
                    (a - b).abs() < length_bound(*b) * loose
                }
            })
        };
        assert!(found.iter().any(fits), "{what}: {want:?} not in {found:?}");
    }
}

#[test]
fn forward_and_all_inverse_solutions_of_all_machines() {
    let file = golden::file("kinematics");
    let machines = file["machines"].as_array().unwrap();
    assert_eq!(machines.len(), 10);
    let mut poses = 0;
    for value in machines {
        let machine = Golden::read(value);
        let chain = machine.chain();
        for pose in value["poses"].as_array().unwrap() {
            poses += 1;
            let what = format!("{} pose {poses}", machine.name);
            let q = machine.inside(&numbers(&pose["q_deg_mm"]));
            let at = chain.forward(&q);
            assert!((at.translation - vector(&pose["tip"])).length() < length_bound(400.0), "{what}");
            assert!((at.rotation.z_axis - vector(&pose["axis"])).length() < 1e-11, "{what}");
            let spin = chain.jacobian(&q).spin();
            assert_eq!(chain.rank(&q, &[spin]), pose["rank"].as_u64().unwrap() as usize, "{what}");
            // The pose of the exact positions: the rounded one of the file would loosen the bounds.
            let found = if value["mode"] == "polar" {
                chain.inverse_polar(at.translation, &[]).unwrap()
            } else if machine.name == "six_axis_trsrn" {
                let locked = [true, false, false, false, false, false];
                chain.inverse_locked(at.translation, at.rotation.z_axis, &q[..1], &locked).unwrap()
            } else {
                chain.inverse(at.translation, at.rotation.z_axis, &[]).unwrap()
            };
            let listed: Vec<_> = found.iter().map(|s| s.values.to_vec()).collect();
            let wanted = pose["ik"].as_array().unwrap();
            let want: Vec<_> = wanted.iter().map(|s| machine.inside(&numbers(&s["q_deg_mm"]))).collect();
            assert_same_solutions(&machine, &listed, &want, 1.0, &what);
            assert!(found.iter().all(|s| wanted.iter().all(|w| w["singular"] == s.singular)), "{what}");
            if !found[0].singular {
                let itself = |s: &Vec<f64>| {
                    s.iter().zip(&q).all(|(a, b)| {
                        let turns = ((a - b) / std::f64::consts::TAU).round();
                        (a - b).abs() < 1e-9 || (a - b - turns * std::f64::consts::TAU).abs() < 1e-11
                    })
                };
                assert!(listed.iter().any(itself), "{what}: {q:?} is not among {listed:?}");
            }
            for solution in found.iter() {
                let back = chain.forward(&solution.values);
                assert!((back.translation - at.translation).length() < 1e-9, "{what}");
                if value["mode"] != "polar" {
                    assert!((back.rotation.z_axis - at.rotation.z_axis).length() < 1e-11, "{what}");
                }
            }
        }
    }
    assert_eq!(poses, 120);
}

#[test]
fn a_turned_work_frame() {
    let file = golden::file("kinematics");
    let fixture = &file["fixture_W0"];
    let machine = Golden::named(&file, fixture["machine"].as_str().unwrap());
    let rows: Vec<Vec<f64>> = fixture["W0"].as_array().unwrap().iter().map(numbers).collect();
    let work = Rigid {
        rotation: glam::DMat3::from_cols_array_2d(&[0, 1, 2].map(|c| [rows[0][c], rows[1][c], rows[2][c]])),
        translation: glam::DVec3::new(rows[0][3], rows[1][3], rows[2][3]),
    };
    let chain = Kinematics::new(&machine.joints, work, machine.tool);
    for row in fixture["rows"].as_array().unwrap() {
        let q = numbers(&row["q_rad_mm"]);
        let at = chain.forward(&q);
        assert!((at.translation - tip(row)).length() < length_bound(100.0));
        assert!((at.rotation.z_axis - axis(row)).length() < 1e-11);
        let found = chain.inverse(at.translation, at.rotation.z_axis, &[]).unwrap();
        let listed: Vec<_> = found.iter().map(|s| s.values.to_vec()).collect();
        let want: Vec<_> = row["ik_rad"].as_array().unwrap().iter().map(numbers).collect();
        // One pose is tilted by 0.04 degrees only: the rounding of the frame in the file weighs 1/sin of it there.
        let sine = q[1].sin().abs();
        assert_same_solutions(&machine, &listed, &want, 1.0 / sine, "fixture");
    }
}

#[test]
fn poses_near_the_pole_keep_twelve_digits() {
    let file = golden::file("kinematics");
    let machine = Golden::named(&file, "trt_xyzac");
    let chain = machine.chain();
    let rows = file["near_singular"].as_array().unwrap();
    assert_eq!(rows.len(), 5);
    for row in rows {
        let tilt = row["tilt_deg"].as_f64().unwrap().to_radians();
        let azimuth = row["azimuth_deg"].as_f64().unwrap().to_radians();
        let axis = glam::DVec3::new(tilt.sin() * azimuth.cos(), tilt.sin() * azimuth.sin(), tilt.cos());
        assert!((axis - vector(&row["axis"])).length() < 1e-12);
        let found = chain.inverse(tip(row), axis, &[0.3]).unwrap();
        let wanted: &Vec<Value> = row["ik_deg"].as_array().unwrap();
        assert_eq!(found.len(), wanted.len());
        for (have, want) in found.iter().zip(wanted) {
            assert_eq!(have.singular, want["singular"].as_bool().unwrap());
            for (value, name) in have.values.iter().zip(["C", "A"]) {
                let want = want[name].as_f64().unwrap().to_radians();
                assert!((value - want).abs() < 1e-12, "{name} {value} {want} at {tilt}");
            }
            let back = chain.forward(&have.values);
            assert!((back.translation - tip(row)).length() < 1e-12);
            assert!((back.rotation.z_axis - axis).length() < 1e-12);
        }
    }
}

#[test]
fn ranges_of_tilt_and_cover_of_directions() {
    let file = golden::file("kinematics");
    let (mut ranges, mut covers) = (0, 0);
    for value in file["machines"].as_array().unwrap() {
        let machine = Golden::read(value);
        let chain = machine.chain();
        if let Some(range) = value.get("tilt_range_deg") {
            ranges += 1;
            let found = chain.tilt_range(&[]).unwrap();
            for (have, want) in found.iter().zip(numbers(range)) {
                // The reference takes its angles by arc cosine, which is good to 1e-8 at its ends.
                assert!((have.to_degrees() - want).abs() < 3e-6, "{} {found:?}", machine.name);
            }
        }
        if let Some(cover) = value.get("orientation_cover") {
            covers += 1;
            let count = cover["n"].as_u64().unwrap() as usize;
            let found = chain.orientation_cover(&machine.travels(), &[], &[], count).unwrap();
            assert_eq!(found.sphere, cover["sphere"].as_f64().unwrap(), "{}", machine.name);
            assert!((found.half_sphere - cover["half_sphere"].as_f64().unwrap()).abs() < 1e-12);
        }
    }
    assert_eq!((ranges, covers), (9, 8));
}

#[test]
fn three_turns_of_an_inclined_tool() {
    let file = golden::file("kinematics");
    let rows = file["windup"].as_array().unwrap();
    assert_eq!(rows.len(), 3);
    for row in rows {
        let machine = Golden::named(&file, row["machine"].as_str().unwrap());
        let chain = machine.chain();
        let limit = row["C_limit_deg"].as_f64().unwrap().to_radians();
        let mut travels = Travels::default();
        travels.0[0] = Some([-limit, limit]);
        travels.0[1] = Some([-100f64.to_radians(), 100f64.to_radians()]);
        let tilt = row["tilt_rad"].as_f64().unwrap();
        let steps = row["steps"].as_u64().unwrap();
        let step = row["azimuth_step_deg"].as_f64().unwrap();
        let poses: Vec<ToolPose> = (0..steps)
            .map(|i| {
                let degrees = i as f64 * step;
                let (sin, cos) = degrees.to_radians().sin_cos();
                let axis = glam::DVec3::new(tilt.sin() * cos, tilt.sin() * sin, tilt.cos());
                let tip = glam::DVec3::new(30.0 * cos, 30.0 * sin, degrees / 60.0);
                ToolPose { tip, axis: Some(axis) }
            })
            .collect();
        let path = chain.path(&poses, &PathOptions::new(travels), &Silent).unwrap();
        assert_eq!(path.retracts.len() as u64, row["rewinds"].as_u64().unwrap());
        assert!(path.retracts.iter().all(|r| r.kind == RetractKind::Unwind && r.joint == 0));
        let cost = row["cost_deg"].as_f64().unwrap();
        assert!((path.cost.to_degrees() - cost).abs() < 1e-8, "{} {cost}", path.cost.to_degrees());
        for (pose, q) in poses.iter().zip(&path.values) {
            let at = chain.forward(q);
            assert!((at.translation - pose.tip).length() < 1e-9);
            assert!((at.rotation.z_axis - pose.axis.unwrap()).length() < 1e-11);
            assert!(q[0].abs() < limit + 1e-9);
        }
        let of = |joint: usize| path.values.iter().map(move |q| q[joint].to_degrees());
        for (joint, key) in [(0, "C_deg"), (1, "B_deg")] {
            for (have, want) in of(joint).zip(numbers(&row[key])) {
                assert!((have - want).abs() < 1e-9, "{key} {:?}", of(joint).collect::<Vec<_>>());
            }
        }
    }
}

#[test]
fn presets_are_the_machines_of_the_file() {
    let file = golden::file("kinematics");
    assert_eq!(presets().len(), 14);
    for preset in presets() {
        let machine = preset.machine().unwrap();
        let listed = file["machines"].as_array().unwrap();
        let Some(value) = listed.iter().find(|m| m["name"] == preset.name) else { continue };
        let golden = Golden::read(value);
        assert_eq!(value["code"], machine.code.to_string());
        for (have, want) in machine.joints.iter().zip(&golden.joints) {
            assert!((have.direction - want.direction).length() < 1e-12, "{}", preset.name);
            assert_eq!((have.motion, have.point, have.sense), (want.motion, want.point, want.sense));
            assert_eq!(have.travel, want.travel, "{}", preset.name);
        }
        let home = machine.kinematics(0.0).forward(&[]);
        assert_eq!(home.translation, vector(&value["tip0"]));
        assert_eq!(home.rotation.z_axis, vector(&value["axis0"]));
    }
    let missing = ["mill3_xyz", "mill4_xyza", "ht_bc_max", "dmu_nut_table"];
    assert!(
        missing.iter().all(|name| file["machines"].as_array().unwrap().iter().all(|m| m["name"] != *name))
    );
    for name in missing {
        assert!(Machine::preset(name).is_ok());
    }
}

#[test]
fn moves_of_all_axes_in_proportion() {
    let file = golden::file("kinematics");
    let mut rows = file["linearisation"].as_array().unwrap().clone();
    assert_eq!(rows.len(), 36);
    rows.push(file["linearisation_single"].clone());
    for row in &rows {
        let chain = Machine::preset(row["machine"].as_str().unwrap()).unwrap().kinematics(0.0);
        let (from, to) = (numbers(&row["q0"]), numbers(&row["q1"]));
        let near = |have: f64, key: &str| {
            let want = row[key].as_f64().unwrap();
            assert!((have - want).abs() < length_bound(want), "{} {key} {have} {want}", row["machine"]);
        };
        let found = chain.linear_deviation(&from, &to, 400);
        near(found.in_step, "max_dev");
        let bound = chain.linear_bound(&from, &to);
        near(bound, "bound");
        assert!(found.in_step <= bound);
        if let Some(parts) = row.get("n_for_5um") {
            near(found.from_line, "max_perp");
            assert_eq!((bound / 0.005).sqrt().ceil(), parts.as_f64().unwrap());
        }
    }
}
