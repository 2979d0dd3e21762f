//! What cannot be solved is refused with its reason.

use glam::DVec3;
use kinecut::base::Result;
use kinecut::geom::Rigid;
use kinecut::machine::kinematics::{LinearOptions, Travels};
use kinecut::machine::{Joint, Kinematics, Machine, Word};

fn code<T: std::fmt::Debug>(result: Result<T>) -> String {
    result.unwrap_err().code().to_string()
}

fn standard(word: &str) -> Kinematics {
    let joints: Vec<Joint> = Word::parse(word).unwrap().0.into_iter().map(Joint::standard).collect();
    Kinematics::new(&joints, Rigid::IDENTITY, Rigid::IDENTITY)
}

#[test]
fn an_unreachable_direction_says_by_how_many_degrees() {
    let chain = Machine::preset("nut_head_c_b45").unwrap().kinematics(0.0);
    let tilt = 97.5f64.to_radians();
    let axis = DVec3::new(tilt.sin(), 0.0, tilt.cos());
    let error = chain.inverse(DVec3::ZERO, axis, &[]).unwrap_err();
    assert_eq!(error.code().as_str(), "KC1111");
    assert!(error.to_string().contains("lies 7.500000 degrees outside"), "{error}");
    assert!((error.0.value.as_ref().unwrap().value - 97.5).abs() < 1e-9);
    assert!((error.0.bound.as_ref().unwrap().value - 90.0).abs() < 1e-9);
    let reach = chain.direction_reach(axis, &Travels::default(), &[], &[]).unwrap();
    assert!((reach.outside.to_degrees() - 7.5).abs() < 1e-10 && !reach.reached());
    // An allowance of 8 degrees takes the nearest direction, and the tip stays exact.
    let tip = DVec3::new(10.0, -20.0, 30.0);
    let found = chain.inverse_nearest(tip, axis, &[], &[], 8f64.to_radians()).unwrap();
    let at = chain.forward(&found[0].values);
    assert!(at.translation.distance(tip) < 1e-12);
    assert!(at.rotation.z_axis.distance(DVec3::X) < 1e-9);
    // Without or with one rotary axis.
    assert_eq!(code(standard("123").inverse(tip, axis, &[])), "KC1111");
    assert_eq!(code(standard("4123").inverse(tip, DVec3::X, &[])), "KC1111");
    assert_eq!(
        standard("123").inverse(tip, DVec3::Z * 3.0, &[]).unwrap()[0].values.to_vec(),
        [10.0, -20.0, 30.0]
    );
    let tilted = standard("4123").inverse(tip, DVec3::Y, &[]).unwrap();
    assert!((tilted[0].values[0].to_degrees() + 90.0).abs() < 1e-12);
}

#[test]
fn translations_that_are_not_independent_say_how_far_the_tip_stays_away() {
    // X, then A, then Y and Z with another A turned into them: at a quarter turn of B in X B Y Z ... Z lies along X.
    let chain = standard("15236");
    let quarter = std::f64::consts::FRAC_PI_2;
    let at = chain.forward(&[0.0, quarter, 0.0, 0.0, 0.0]);
    let beside = at.translation + DVec3::new(0.0, 0.0, 7.0);
    let error = chain.inverse(beside, at.rotation.z_axis, &[]).unwrap_err();
    assert_eq!(error.code().as_str(), "KC1112");
    assert!((error.0.value.as_ref().unwrap().value - 7.0).abs() < 1e-9, "{error}");
    // In the plane they span one keeps its position.
    let inside = at.translation + DVec3::new(30.0, 0.0, 0.0);
    let found = chain.inverse(inside, at.rotation.z_axis, &[0.0, 0.0, 0.0, 12.0, 0.0]).unwrap();
    assert!(found[0].singular);
    let back = chain.forward(&found[0].values);
    assert!(back.translation.distance(inside) < 1e-12);
    // A lathe without C reaches its plane only.
    let lathe = standard("31");
    assert_eq!(
        lathe.inverse(DVec3::new(3.0, 0.0, 4.0), DVec3::Z, &[]).unwrap()[0].values.to_vec(),
        [4.0, 3.0]
    );
    assert_eq!(code(lathe.inverse(DVec3::new(3.0, 1.0, 4.0), DVec3::Z, &[])), "KC1112");
}

#[test]
fn chains_and_numbers_that_cannot_be_used() {
    let chain = standard("64123");
    assert_eq!(code(chain.inverse(DVec3::NAN, DVec3::Z, &[])), "KC1114");
    assert_eq!(code(chain.inverse(DVec3::ZERO, DVec3::ZERO, &[])), "KC1114");
    assert_eq!(code(chain.inverse(DVec3::ZERO, DVec3::Z, &[f64::INFINITY])), "KC1114");
    assert_eq!(code(standard("645123").inverse(DVec3::ZERO, DVec3::Z, &[])), "KC1113");
    assert_eq!(code(chain.inverse_polar(DVec3::ZERO, &[])), "KC1113");
    let lathe = standard("631");
    assert!(lathe.inverse_polar(DVec3::ZERO, &[0.4]).unwrap()[0].singular);
    assert_eq!(lathe.inverse_polar(DVec3::ZERO, &[0.4]).unwrap()[0].values[0], 0.4);
    // A tip beyond the circle that an offset tool leaves out.
    let offset = Rigid::from_translation(DVec3::new(0.0, 30.0, 0.0));
    let joints: Vec<Joint> = Word::parse("631").unwrap().0.into_iter().map(Joint::standard).collect();
    let lathe = Kinematics::new(&joints, Rigid::IDENTITY, offset);
    let error = lathe.inverse_polar(DVec3::new(20.0, 0.0, 0.0), &[]).unwrap_err();
    assert_eq!(error.code().as_str(), "KC1112");
    assert!((error.0.value.as_ref().unwrap().value - 10.0).abs() < 1e-9, "{error}");
    assert_eq!(lathe.inverse_polar(DVec3::new(40.0, 0.0, 0.0), &[]).unwrap().len(), 2);
    assert_eq!(code(chain.linear_move(&[f64::NAN], &[0.0], &LinearOptions::new(0.01))), "KC1114");
    assert_eq!(code(chain.linear_move(&[0.0; 5], &[0.1; 5], &LinearOptions::new(0.0))), "KC1119");
    assert_eq!(code(Machine::preset("nothing")), "KC1117");
}

#[test]
fn parallel_rotary_axes_and_axes_along_the_tool_keep_their_position() {
    // The last axis only spins the tool: it stays where it is given.
    let chain = standard("12346");
    let found = chain.inverse(DVec3::ZERO, DVec3::new(0.0, -1.0, 1.0), &[0.0, 0.0, 0.0, 0.0, 0.7]).unwrap();
    assert_eq!((found.len(), found[0].singular, found[0].values[4]), (1, true, 0.7));
    assert!((found[0].values[3].to_degrees() - 45.0).abs() < 1e-12);
    // Two tables about one direction share the turn.
    let mut joints: Vec<Joint> = Word::parse("44123").unwrap().0.into_iter().map(Joint::standard).collect();
    joints[1].point = DVec3::new(0.0, 40.0, 0.0);
    let chain = Kinematics::new(&joints, Rigid::IDENTITY, Rigid::IDENTITY);
    let axis = DVec3::new(0.0, -1.0, 1.0);
    let found = chain.inverse(DVec3::new(1.0, 2.0, 3.0), axis, &[0.0, 0.25]).unwrap();
    assert_eq!(found[0].values[1], 0.25);
    let at = chain.forward(&found[0].values);
    assert!(at.translation.distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-12);
    assert!(at.rotation.z_axis.cross(axis).length() < 1e-14);
}
