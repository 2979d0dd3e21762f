//! Forward kinematics against products of 4x4 matrices, Jacobians against differences.

use glam::DVec3;
use kinecut::machine::{Joint, Kinematics, Word};

use crate::common::random::Random;

use super::machines::{RandomMachine, classes};

type Matrix = [[f64; 4]; 4];

const IDENTITY: Matrix =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let mut c = [[0.0; 4]; 4];
    for i in 0..4 {
        for j in 0..4 {
            c[i][j] = (0..4).map(|k| a[i][k] * b[k][j]).sum();
        }
    }
    c
}

fn shift(v: DVec3) -> Matrix {
    let mut m = IDENTITY;
    (m[0][3], m[1][3], m[2][3]) = (v.x, v.y, v.z);
    m
}

/// The rotation by a quaternion, not by Rodrigues' formula.
fn rotation(axis: DVec3, angle: f64) -> Matrix {
    let (w, v) = ((angle / 2.0).cos(), axis * (angle / 2.0).sin());
    let (x, y, z) = (v.x, v.y, v.z);
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y), 0.0],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x), 0.0],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y), 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

fn joint_matrix(joint: &Joint, q: f64) -> Matrix {
    let q = q * joint.sense;
    if joint.motion.is_rotation() {
        let turn = product(&rotation(joint.direction, q), &shift(-joint.point));
        product(&shift(joint.point), &turn)
    } else {
        shift(joint.direction * q)
    }
}

#[test]
fn forward_is_the_product_of_matrices() {
    let mut random = Random(1);
    for class in &classes() {
        for inclined in [false, true] {
            let machine = RandomMachine::new(class, inclined, &mut random);
            let chain = machine.chain();
            let q = machine.positions(&mut random);
            let r = machine.work.rotation.transpose();
            let mut m = IDENTITY;
            for (i, row) in [r.row(0), r.row(1), r.row(2)].into_iter().enumerate() {
                m[i][..3].copy_from_slice(&row.to_array());
            }
            m = product(&m, &shift(-machine.work.translation));
            for (joint, &q) in machine.joints.iter().zip(&q) {
                m = product(&m, &joint_matrix(joint, q));
            }
            let home = machine.tool.translation;
            let z = machine.tool.rotation.z_axis;
            let tip: Vec<f64> =
                (0..3).map(|i| m[i][0] * home.x + m[i][1] * home.y + m[i][2] * home.z + m[i][3]).collect();
            let axis: Vec<f64> = (0..3).map(|i| m[i][0] * z.x + m[i][1] * z.y + m[i][2] * z.z).collect();
            let at = chain.forward(&q);
            assert!(at.translation.distance(DVec3::from_slice(&tip)) < 1e-11);
            assert!(at.rotation.z_axis.distance(DVec3::from_slice(&axis)) < 1e-14);
            let frame = chain.jacobian(&q).frame;
            assert!(frame.translation.distance(at.translation) < 1e-11);
        }
    }
}

#[test]
fn the_matrices_of_the_paper() {
    // Equations 2 and 3 with the sign of A5 put right: the cone, A6(phi) A1(R) A5(-alpha) A3(z).
    let (phi, radius, alpha, z) = (1.0f64, 30.0, 0.35f64, 20.0);
    let joints: Vec<Joint> = Word::parse("6153").unwrap().0.into_iter().map(Joint::standard).collect();
    let chain = Kinematics::new(&joints, kinecut::geom::Rigid::IDENTITY, kinecut::geom::Rigid::IDENTITY);
    let tip = chain.forward(&[phi, radius, -alpha, z]).translation;
    let at = radius - z * alpha.sin();
    assert!(tip.distance(DVec3::new(at * phi.cos(), at * phi.sin(), z * alpha.cos())) < 1e-14 * radius);
}

#[test]
fn jacobian_is_the_derivative() {
    let mut random = Random(2);
    for class in &classes() {
        let machine = RandomMachine::new(class, true, &mut random);
        let chain = machine.chain();
        let q = machine.positions(&mut random);
        let jacobian = chain.jacobian(&q);
        let mut velocities = vec![0.0; q.len()];
        for i in 0..q.len() {
            // The error of central differences is h^2/6 of the third derivative, some hundred mm here.
            let h = 1e-4;
            let at = |sign: f64| {
                let mut moved = q.clone();
                moved[i] += sign * h;
                chain.forward(&moved)
            };
            let (after, before) = (at(1.0), at(-1.0));
            let tip = (after.translation - before.translation) / (2.0 * h);
            let axis = (after.rotation.z_axis - before.rotation.z_axis) / (2.0 * h);
            assert!(jacobian.tip_rate(i).distance(tip) < 1e-5);
            assert!(jacobian.axis_rate(i).distance(axis) < 1e-8);
            velocities[i] = random.unit();
        }
        let [tip, axis] = jacobian.rates(&velocities);
        let sum: DVec3 = (0..q.len()).map(|i| jacobian.tip_rate(i) * velocities[i]).sum();
        assert!(tip.distance(sum) < 1e-10);
        let sum: DVec3 = (0..q.len()).map(|i| jacobian.axis_rate(i) * velocities[i]).sum();
        assert!(axis.distance(sum) < 1e-13);
    }
}

#[test]
fn mobility_of_all_pairs_of_rotary_axes() {
    let standard = |word: &str| {
        let joints: Vec<Joint> = Word::parse(word).unwrap().0.into_iter().map(Joint::standard).collect();
        Kinematics::new(&joints, kinecut::geom::Rigid::IDENTITY, kinecut::geom::Rigid::IDENTITY)
    };
    // A last rotary along the spindle only spins the tool.
    for (word, mobility) in [
        ("12346", 4),
        ("12356", 4),
        ("12345", 5),
        ("12364", 5),
        ("61235", 5),
        ("1234", 4),
        ("1236", 3),
        ("123", 3),
    ] {
        assert_eq!(standard(word).mobility(), mobility, "{word}");
    }
    // A lathe makes a thread: the screw along its spindle lies in the span, one across does not.
    let lathe = standard("631");
    let q = lathe.general_position(0);
    let jacobian = lathe.jacobian(&q);
    let screw = kinecut::machine::kinematics::Twist { turn: DVec3::Z, shift: DVec3::Z };
    assert!(jacobian.spans(&screw, &[]));
    assert_eq!(jacobian.rank(&[screw]), 2);
    let across = kinecut::machine::kinematics::Twist { turn: DVec3::X, shift: DVec3::X };
    assert!(!jacobian.spans(&across, &[]));
    assert_eq!(jacobian.rank(&[across]), 3);
}
