//! Bodies that end where their cone or round does, with no cylinder above: what they meet is met.

use glam::DVec3;

use crate::base::Silent;
use crate::geom::{Aabb, Line, Profile, ProfileElement};
use crate::stock::TriDexel;
use crate::stock::cut::{CutAxis, CutMove, CutOptions, MoveEffect, ToolBody, cut};
use crate::sweep::ToolMotion;

/// A cone, a ball, a round of a bull nose: each 5 mm or 3 mm high.
fn profiles() -> [Profile; 3] {
    let one = |element| Profile::new(vec![element]).unwrap();
    let round =
        |centre_radius| ProfileElement::Torus { centre_radius, centre_z: 3.0, radius: 3.0, z0: 0.0, z1: 3.0 };
    [one(ProfileElement::Cone { z0: 0.0, r0: 0.25, z1: 5.0, r1: 5.25 }), one(round(0.0)), one(round(2.0))]
}

/// Effects of a tool that moves on a line in a block whose top is at Z 0, its axis upright and leaning by 10 degrees.
fn met(tool: &ToolBody, from: [f64; 3], to: [f64; 3]) -> [MoveEffect; 2] {
    let line = Line { start: from.into(), end: to.into() };
    let axis = DVec3::new(10f64.to_radians().sin(), 0.0, 10f64.to_radians().cos());
    let motion = ToolMotion::fixed(line.into(), axis).unwrap();
    [CutMove::new(line, CutAxis::PlusZ, 0), CutMove::leaning(motion, line, 0)].map(|one| {
        let bounds = Aabb { min: DVec3::new(-10.0, -10.0, -10.0), max: DVec3::new(10.0, 10.0, 0.0) };
        let mut stock = TriDexel::from_box(bounds, 0.2).unwrap();
        let look = CutMove { removes: false, ..one.watched() };
        let tool = std::slice::from_ref(tool);
        cut(&mut stock, tool, &[look], &CutOptions::default(), &Silent).unwrap().remove(0)
    })
}

#[test]
fn a_cutting_part_meets_stock() {
    for profile in profiles() {
        let tool = ToolBody::new(profile);
        let [upright, leaning] = met(&tool, [-20.0, 0.0, -2.0], [20.0, 0.0, -2.0]);
        assert!(upright.first_contact.is_some() && leaning.first_contact.is_some(), "{tool:?}");
        // 2 mm deep; a tool that leans reaches down with its lower side.
        assert!((upright.deepest - 2.0).abs() < 0.05, "{tool:?} {upright:?}");
        assert!(leaning.deepest > 1.9, "{tool:?} {leaning:?}");
        let down = met(&tool, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0]);
        assert!(down.iter().all(|e| e.first_contact.is_some()), "{tool:?}");
        let over = met(&tool, [-20.0, 0.0, 1.5], [20.0, 0.0, 1.5]);
        assert!(over.iter().all(|e| e.first_contact.is_none()), "{tool:?}");
    }
}

#[test]
fn shanks_and_holders_meet_stock() {
    for profile in profiles() {
        let cutting = Profile::cylinder(2.0, 4.0).unwrap();
        let shank = vec![(profile.clone(), 4.0)];
        let tool = ToolBody { cutting: cutting.clone(), edge: None, shank, holder: Vec::new() };
        let holder = vec![(profile, 4.0)];
        let other = ToolBody { cutting, edge: None, shank: Vec::new(), holder };
        let found = met(&tool, [-30.0, 0.0, -6.0], [30.0, 0.0, -6.0]);
        let others = met(&other, [-30.0, 0.0, -6.0], [30.0, 0.0, -6.0]);
        let upright = found[0].shank().unwrap();
        assert!((upright.depth - 2.0).abs() < 0.05, "{upright:?}");
        for (effect, other) in found.iter().zip(&others) {
            assert_eq!(effect.shank(), other.holder());
        }
        let above = met(&tool, [-30.0, 0.0, -3.0], [30.0, 0.0, -3.0]);
        assert!(above.iter().all(|e| e.shank().is_none()));
    }
}
