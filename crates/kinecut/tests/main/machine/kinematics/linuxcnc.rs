//! LinuxCNC's kinematics modules as oracles, by their formulas: each gives the tip in workpiece coordinates from the
//! joints, composed of a rotation of the table, its offsets and the linear axes.
//!
//! With conventional directions a table that turns by +C carries the work by -C: the tip turns by +C in the work.

use glam::DVec3;
use kinecut::machine::{Joint, Machine};

use crate::common::random::Random;
use kinecut_cases::cases;

/// (cos, sin) rotations about one axis, written out.
fn about_x(p: DVec3, a: f64) -> DVec3 {
    let (s, c) = a.sin_cos();
    DVec3::new(p.x, p.y * c - p.z * s, p.y * s + p.z * c)
}

fn about_y(p: DVec3, b: f64) -> DVec3 {
    let (s, c) = b.sin_cos();
    DVec3::new(p.x * c + p.z * s, p.y, -p.x * s + p.z * c)
}

fn about_z(p: DVec3, a: f64) -> DVec3 {
    let (s, c) = a.sin_cos();
    DVec3::new(p.x * c - p.y * s, p.x * s + p.y * c, p.z)
}

/// A preset with its rotary points replaced.
fn preset(name: &str, points: &[(char, DVec3)]) -> Machine {
    let mut machine = Machine::preset(name).unwrap();
    for (letter, point) in points {
        let (place, _) = machine.joint(*letter).unwrap();
        machine.joints[place].point = *point;
    }
    machine
}

fn positions(machine: &Machine, random: &mut Random) -> Vec<f64> {
    let joints = machine.joints.iter();
    joints.map(|j: &Joint| random.unit() * if j.motion.is_rotation() { 3.0 } else { 200.0 }).collect()
}

#[test]
fn xyzac_trt_with_conventional_directions() {
    let mut random = Random(3);
    for _ in 0..cases(200, 2000) {
        // x, y, z rotation point, dy and dz from it to the axis of A.
        let (point, dy, dz) = (random.vector(50.0), 60.0 * random.unit(), 60.0 * random.unit());
        let offset = DVec3::new(0.0, dy, dz);
        let machine = preset("trt_xyzac", &[('C', point), ('A', point + offset)]);
        let q = positions(&machine, &mut random);
        let [c, a, x, y, z] = [q[0], q[1], q[2], q[3], q[4]];
        // xyzac_trt: x = c_c (jx - xp) - s_c c_a (jy - dy - yp) + s_c s_a (jz - dz - zp) - s_c dy + xp, and so on.
        let inner = about_x(DVec3::new(x, y, z) - point - offset, a) + offset;
        let wanted = about_z(inner, c) + point;
        let at = machine.kinematics(0.0).forward(&q);
        assert!(at.translation.distance(wanted) < 1e-12 * 1e3);
        let axis = about_z(about_x(DVec3::Z, a), c);
        assert!(at.rotation.z_axis.distance(axis) < 1e-14);
        // The x of the module, written out.
        let (sc, cc) = c.sin_cos();
        let (sa, ca) = a.sin_cos();
        let module_x = cc * (x - point.x) - sc * ca * (y - dy - point.y) + sc * sa * (z - dz - point.z)
            - sc * dy
            + point.x;
        assert!((at.translation.x - module_x).abs() < 1e-9);
    }
}

#[test]
fn xyzbc_trt_with_conventional_directions() {
    let mut random = Random(4);
    for _ in 0..cases(200, 2000) {
        let (point, dx, dz) = (random.vector(50.0), 60.0 * random.unit(), 60.0 * random.unit());
        let offset = DVec3::new(dx, 0.0, dz);
        let machine = preset("trt_xyzbc", &[('C', point), ('B', point + offset)]);
        let q = positions(&machine, &mut random);
        let inner = about_y(DVec3::new(q[2], q[3], q[4]) - point - offset, q[1]) + offset;
        let wanted = about_z(inner, q[0]) + point;
        let at = machine.kinematics(0.0).forward(&q);
        assert!(at.translation.distance(wanted) < 1e-9);
        assert!(at.rotation.z_axis.distance(about_z(about_y(DVec3::Z, q[1]), q[0])) < 1e-14);
    }
    // Check values of LinuxCNC's issue 2435, without offsets.
    let machine = preset("trt_xyzbc", &[('C', DVec3::ZERO), ('B', DVec3::ZERO)]);
    let chain = machine.kinematics(0.0);
    let quarter = std::f64::consts::FRAC_PI_2;
    for (b, c, joints) in [(quarter, 0.0, [-2.0, 0.0, 1.0]), (0.0, quarter, [0.0, -1.0, 2.0])] {
        let at = chain.forward(&[c, b, joints[0], joints[1], joints[2]]);
        assert!(at.translation.distance(DVec3::new(1.0, 0.0, 2.0)) < 1e-15, "{}", at.translation);
        let found = chain.inverse(DVec3::new(1.0, 0.0, 2.0), at.rotation.z_axis, &[c]).unwrap();
        let near = |s: &kinecut::machine::kinematics::Solution| {
            s.values.iter().zip([c, b, joints[0], joints[1], joints[2]]).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        assert!(found.iter().any(near));
    }
}

#[test]
fn five_axis_bridge_with_its_b_reversed() {
    let mut random = Random(5);
    let machine = preset("head_bc_bridge", &[]);
    let pivot = 250.0;
    for _ in 0..cases(200, 2000) {
        // 5axiskins: the joints place the pivot; the tip hangs below it by the pivot length plus that of the tool (W).
        let tool = 100.0 * random.unit().abs();
        let q = positions(&machine, &mut random);
        let (theta, phi, r) = (q[3], -q[4], pivot + tool);
        // s2r(r, theta, phi) of the module, its B reversed: x = r sin(phi) cos(theta), ...
        let hang = DVec3::new(-r * phi.sin() * theta.cos(), -r * phi.sin() * theta.sin(), r * phi.cos());
        let wanted = DVec3::new(q[0], q[1], q[2] + pivot) - hang;
        let at = machine.kinematics(tool).forward(&q);
        assert!(at.translation.distance(wanted) < 1e-9, "{} {wanted}", at.translation);
    }
}

#[test]
fn two_rotary_tables() {
    let mut random = Random(6);
    for _ in 0..cases(200, 2000) {
        let point = random.vector(50.0);
        let offset = DVec3::new(0.0, 0.0, 60.0 * random.unit());
        let machine = preset("tdr_xyzab", &[('B', point), ('A', point + offset)]);
        let q = positions(&machine, &mut random);
        let inner = about_y(DVec3::new(q[2], q[3], q[4]) - point, q[1]) + point;
        let wanted = about_x(inner - point - offset, q[0]) + point + offset;
        let at = machine.kinematics(0.0).forward(&q);
        assert!(at.translation.distance(wanted) < 1e-9);
    }
}

#[test]
fn nutating_head_turns_about_its_declared_axis() {
    // trsrn: the nutating axis is (0, sin nu, cos nu); the rotation written with the angles of the module.
    let mut random = Random(8);
    let machine = preset("six_axis_trsrn", &[]);
    let chain = machine.kinematics(0.0);
    let nu = 55f64.to_radians();
    for _ in 0..cases(200, 2000) {
        let q = positions(&machine, &mut random);
        let (sv, cv) = nu.sin_cos();
        let (ss, cs) = q[5].sin_cos();
        let r = cs + sv * sv * (1.0 - cs);
        let s = cs + cv * cv * (1.0 - cs);
        let t = sv * cv * (1.0 - cs);
        // Columns of the rotation by the nutating axis.
        let nutate = |p: DVec3| {
            DVec3::new(
                cs * p.x - cv * ss * p.y + sv * ss * p.z,
                cv * ss * p.x + r * p.y + t * p.z,
                -sv * ss * p.x + t * p.y + s * p.z,
            )
        };
        let pivot = DVec3::new(0.0, 50.0, 120.0);
        let tip = nutate(DVec3::new(0.0, 50.0, 0.0) - pivot) + pivot;
        let tip = about_z(tip, q[4]) + DVec3::new(q[1], q[2], q[3]);
        let table = DVec3::new(0.0, 0.0, -120.0);
        let tip = about_x(tip - table, q[0]) + table;
        let axis = about_x(about_z(nutate(DVec3::Z), q[4]), q[0]);
        let at = chain.forward(&q);
        assert!(at.translation.distance(tip) < 1e-9);
        assert!(at.rotation.z_axis.distance(axis) < 1e-14);
    }
}
