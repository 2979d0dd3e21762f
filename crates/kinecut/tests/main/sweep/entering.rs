//! What enters of a tool: against the velocity of points of its surface, at many places of all golden tools.

use std::f64::consts::TAU;

use glam::DVec3;
use kinecut::machine::kinematics::Twist;
use kinecut::sweep::{Entering, ProfileChain};

use crate::common::golden;
use crate::common::random::Random;
use crate::common::sweep_golden::contour;

#[test]
fn a_point_enters_where_its_surface_moves_outwards() {
    let golden = golden::file("sweep");
    let mut random = Random(7);
    let mut places = [0; 2];
    for tool in golden["tools"].as_object().unwrap().keys() {
        let chain = ProfileChain::new(&contour(&golden, tool));
        for k in 0..40 {
            let level = if k % 8 == 0 { 0.0 } else { 1.0 };
            let mut shift = random.direction() * 10.0;
            shift.z *= level;
            let turn = random.direction() * if k % 5 == 0 { 0.0 } else { random.share() };
            let plunge = k % 13 == 0;
            let twist = match plunge {
                true => Twist { turn: DVec3::Z * 0.3, shift: DVec3::NEG_Z * 4.0 },
                false => Twist { turn, shift },
            };
            let regions = chain.entering(&twist);
            for (index, piece) in chain.pieces().iter().enumerate() {
                for _ in 0..6 {
                    let u = piece.from + (piece.to - piece.from) * random.share();
                    let theta = TAU * random.share();
                    let (sin, cos) = theta.sin_cos();
                    let (p, n) = (piece.point(u), piece.normal(u));
                    let at = DVec3::new(p.x * cos, p.x * sin, p.y);
                    let out = DVec3::new(n.x * cos, n.x * sin, n.y);
                    let speed = out.dot(twist.velocity(at));
                    let of = chain.entering_at(&twist, index, u);
                    if speed.abs() > 1e-9 {
                        assert_eq!(of.holds(theta), speed > 0.0, "{tool} {index} {u} {theta}");
                        places[usize::from(speed > 0.0)] += 1;
                    }
                    // The regions say the same of whole circles.
                    let region = regions
                        .iter()
                        .find(|r| r.piece == index && (u - r.from) * (u - r.to) < 0.0)
                        .map(|r| r.whole);
                    let expected = match of {
                        Entering::Nothing => None,
                        Entering::Whole => Some(true),
                        Entering::Arc { half, .. } => {
                            assert!((of.width() - 2.0 * half).abs() < 1e-15);
                            Some(false)
                        }
                    };
                    assert_eq!(region, expected, "{tool} {index} {u} {twist:?}");
                }
            }
        }
    }
    assert!(places[0] > 3000 && places[1] > 3000, "{places:?}");
}

#[test]
fn nothing_enters_without_motion() {
    let golden = golden::file("sweep");
    let chain = ProfileChain::new(&contour(&golden, "bull"));
    for turn in [0.0, 3.0] {
        let twist = Twist { turn: DVec3::Z * turn, shift: DVec3::ZERO };
        assert!(chain.entering(&twist).is_empty());
        assert_eq!(chain.entering_at(&twist, 0, 1.0), Entering::Nothing);
    }
}
