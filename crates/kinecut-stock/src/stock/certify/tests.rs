//! Random tools in random motions cut stocks, and what is left is proven against them; and what was spoilt is found.

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

use super::{Certificate, CertifiedRun, GAP, certify};
use crate::base::Silent;
use crate::geom::{Aabb, Arc, CubicSpan, Curve, InvoluteRecord, Line, Profile, ProfileElement, Rigid};
use crate::machine::Machine;
use crate::machine::kinematics::Twist;
use crate::num::random::Random;
use crate::stock::cut::{CutAxis, CutMove, CutOptions, ToolBody, cut};
use crate::stock::{Axis, DexelGrid, Lattice, TriDexel, fixed};
use crate::sweep::ToolMotion;

fn within(random: &mut Random, from: f64, to: f64) -> f64 {
    from + (to - from) * random.share()
}

/// A point in and about the block.
fn place(random: &mut Random) -> DVec3 {
    DVec3::new(within(random, -9.0, 9.0), within(random, -8.0, 8.0), within(random, -5.0, 2.0))
}

/// A direction that leans by up to `most` from Z [rad].
fn leaning(random: &mut Random, most: f64) -> DVec3 {
    let (lean, round) = (within(random, 0.0, most), within(random, 0.0, TAU));
    DVec3::new(lean.sin() * round.cos(), lean.sin() * round.sin(), lean.cos())
}

fn tools() -> Vec<Profile> {
    let cone = |z0: f64, r0: f64, z1: f64, r1: f64| ProfileElement::Cone { z0, r0, z1, r1 };
    let torus = |centre_radius: f64, centre_z: f64, radius: f64, z0: f64, z1: f64| ProfileElement::Torus {
        centre_radius,
        centre_z,
        radius,
        z0,
        z1,
    };
    let barrel = 12.0 - (400f64 - 18.5 * 18.5).sqrt();
    let form = vec![cone(0.0, 0.0, 0.6, 1.2), cone(0.6, 1.2, 2.0, 1.4), torus(2.0, 3.0, 1.0, 2.0, 3.0)];
    let form = form.into_iter().chain([cone(3.0, 3.0, 9.0, 3.0)]).collect();
    [
        Profile::cylinder(6.0, 9.0),
        Profile::bull_nose(6.0, 3.0, 9.0),
        Profile::bull_nose(6.0, 1.0, 9.0),
        Profile::new(vec![cone(0.0, 0.0, 1.8, 3.0), cone(1.8, 3.0, 9.0, 3.0)]),
        Profile::new(vec![cone(0.0, 1.0, 6.0, 2.0), cone(6.0, 2.0, 9.0, 2.0)]),
        Profile::new(vec![torus(-16.0, 12.0, 20.0, barrel, 12.0), cone(12.0, 4.0, 15.0, 4.0)]),
        Profile::new(form),
    ]
    .map(Result::unwrap)
    .into()
}

/// Positions of a machine at which the tip is at a place, the rotary axes as given.
fn reaching(machine: &Machine, rotary: [f64; 2], tip: DVec3) -> Vec<f64> {
    let chain = machine.kinematics(50.0);
    let rotates: Vec<bool> = machine.joints.iter().map(|joint| joint.motion.is_rotation()).collect();
    let at = |linear: [f64; 3]| -> Vec<f64> {
        let (mut linear, mut rotary) = (linear.into_iter(), rotary.into_iter());
        let next = |rotates: &bool| if *rotates { rotary.next() } else { linear.next() };
        rotates.iter().map(next).map(Option::unwrap).collect()
    };
    let tip_at = |linear: [f64; 3]| chain.forward(&at(linear)).translation;
    let zero = tip_at([0.0; 3]);
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|q| tip_at(q) - zero);
    at((DMat3::from_cols(x, y, z).inverse() * (tip - zero)).to_array())
}

/// A move from a place to another: upright, leaning or turning, along a line, an arc, an involute or as the joints of a machine go.
fn random_move(random: &mut Random, machine: &Machine) -> CutMove {
    let (a, b) = (place(random), place(random));
    // Half of them are short, as those of programs for free surfaces are.
    let b = if random.share() < 0.5 { b } else { a + (b - a) * 0.05 };
    let line = Curve::from(Line { start: a, end: b });
    let spin = if random.share() < 0.5 { DVec3::Z } else { leaning(random, 1.0) };
    let arc = Arc::new(a, place(random), spin, within(random, -4.0, 4.0), within(random, -1.0, 1.0));
    let curve = match (random.bits() % 4, arc) {
        (0, Ok(arc)) => Curve::from(arc),
        (1, _) => Curve::involute(InvoluteRecord::circle(4.0, within(random, 1.0, 2.5)).unwrap(), a.z, -1.0),
        _ => line.clone(),
    };
    let (axis, other) = (leaning(random, 1.2), leaning(random, 1.2));
    let near = (axis + (other - axis) * within(random, 0.0, 0.5)).normalize_or(axis);
    let leaning = |motion: ToolMotion| CutMove::leaning(motion, curve.clone(), 0);
    match random.bits() % 7 {
        0 | 1 => CutMove::new(
            curve.clone(),
            CutAxis::ALL[if b.x < 0.0 { 4 } else { (random.bits() % 6) as usize }],
            0,
        ),
        2 => leaning(ToolMotion::fixed(curve.clone(), axis).unwrap()),
        3 | 4 => leaning(ToolMotion::between(curve.clone(), axis, near).unwrap()),
        5 => {
            let rotation = ToolMotion::fixed(line, axis).unwrap().pose(0.0).rotation;
            let turn = DVec3::new(within(random, -0.4, 0.4), within(random, -0.4, 0.4), 0.3);
            let twist = Twist { turn, shift: rotation.transpose() * (b - a) };
            leaning(ToolMotion::screw(Rigid { rotation, translation: a }, twist).unwrap())
        }
        _ => {
            let chain = machine.kinematics(50.0);
            let rotary = |random: &mut Random| [within(random, -0.9, 0.9), within(random, -3.0, 3.0)];
            let from = rotary(random);
            let share = within(random, 0.0, 0.2);
            let to = [0, 1].map(|i| from[i] + share * (within(random, -2.0, 2.0)));
            let (from, to) = (reaching(machine, from, a), reaching(machine, to, b));
            if random.bits().is_multiple_of(2) {
                return leaning(ToolMotion::joints(chain, &from, &to).unwrap());
            }
            leaning(ToolMotion::tip_and_joints(line, chain, &from, &to).unwrap())
        }
    }
}

fn block() -> Aabb {
    Aabb { min: DVec3::new(-9.0, -8.0, -7.0), max: DVec3::new(9.3, 8.1, 0.2) }
}

/// Cuts and proves a stock; the number of lines that lost something, with the certificate.
fn cut_and_certified(profile: &Profile, moves: &[CutMove], step: f64, what: &str) -> (usize, Certificate) {
    let mut stock = TriDexel::from_box(block(), step).unwrap();
    let bodies = [ToolBody::new(profile.clone())];
    cut(&mut stock, &bodies, moves, &CutOptions::default(), &Silent).unwrap();
    let before = stock.clone();
    let runs = [CertifiedRun { first_cut: 0, moves }];
    let proof = certify(&mut stock, &bodies, &runs, &Silent).unwrap();
    assert_eq!((proof.taken, proof.strayed), (0, 0), "{what}: {proof:?} {profile:?} {moves:?}");
    assert!(proof.gap <= 2.0 * GAP, "{what}: {proof:?}");
    let mut lines = 0;
    each_line(stock.lattice(), |axis, a, b| {
        assert_eq!(stock.line(axis, a, b), before.line(axis, a, b));
        let line = stock.line(axis, a, b);
        lines += usize::from(line.is_empty() || line.iter().any(|i| i.lo.cut > 0 || i.hi.cut > 0));
    });
    (lines, proof)
}

fn each_line(lattice: &Lattice, mut each: impl FnMut(Axis, u32, u32)) {
    for axis in Axis::ALL {
        let (u, v) = axis.others();
        for b in 0..lattice.counts[v.index()] {
            for a in 0..lattice.counts[u.index()] {
                each(axis, a, b);
            }
        }
    }
}

#[test]
fn no_line_of_any_tool_in_any_motion_is_left_too_long_or_too_short() {
    let mut random = Random(90);
    let machine = Machine::preset("trt_xyzac").unwrap();
    let (mut lines, mut ends) = (0, 0);
    let tools = tools();
    for round in 0..kinecut_cases::cases(56, 2800) as usize {
        let profile = &tools[round % tools.len()];
        // One move alone, or many, of which some then are cut at once.
        let count = [1, 3, 12][round / tools.len() % 3];
        let moves: Vec<CutMove> = (0..count).map(|_| random_move(&mut random, &machine)).collect();
        let step = within(&mut random, 0.4, 0.8);
        let (some, proof) = cut_and_certified(profile, &moves, step, &format!("round {round}"));
        lines += some;
        ends += proof.ends;
    }
    assert!(lines > 30_000 && ends > 30_000, "{lines} {ends}");
}

#[test]
fn barrels_on_slopes_leave_what_their_poses_leave() {
    let mut random = Random(91);
    let barrel = &tools()[5];
    for round in 0..kinecut_cases::cases(24, 600) as usize {
        let (start, end) = (place(&mut random), place(&mut random));
        let axis = CutAxis::ALL[round % 6];
        let curve =
            match Arc::new(start, place(&mut random), axis.vector(), 2.0, within(&mut random, -3.0, 3.0)) {
                Ok(arc) if round % 3 == 0 => Curve::from(arc),
                _ => Curve::from(Line { start, end }),
            };
        cut_and_certified(barrel, &[CutMove::new(curve, axis, 0)], 0.6, &format!("round {round}"));
    }
}

#[test]
fn a_raster_that_leans_and_is_cut_at_once_is_proven_and_what_is_spoilt_is_found() {
    let profile = Profile::bull_nose(6.0, 1.0, 20.0).unwrap();
    let axis = DVec3::new(0.3, 0.2, 1.0).normalize_or(DVec3::Z);
    let moves: Vec<CutMove> = (0..600)
        .map(|i| {
            let (row, k) = (f64::from(i / 30), f64::from(i % 30));
            let at = |k: f64| {
                DVec3::new(0.6 * k - 9.0, 0.8 * row - 8.0, -2.0 + (0.3 * k).sin() * (0.2 * row).cos())
            };
            let line = Line { start: at(k), end: at(k + 1.0) };
            CutMove::leaning(ToolMotion::fixed(line.into(), axis).unwrap(), line, 0)
        })
        .collect();
    let (lines, proof) = cut_and_certified(&profile, &moves, 0.3, "raster");
    assert!(lines > 3000 && proof.ends > 3000 && proof.moves == 600, "{lines} {proof:?}");

    let mut stock = TriDexel::from_box(block(), 0.3).unwrap();
    let bodies = [ToolBody::new(profile)];
    cut(&mut stock, &bodies, &moves, &CutOptions::default(), &Silent).unwrap();
    let sound = stock.clone();
    // One line is left 4 um too high and another is cut 5 um too deep; 0.5 um are within the gap.
    let mut spoil = |a: u32, b: u32, by: f64| {
        let mut line = stock.line(Axis::Z, a, b).to_vec();
        let last = line.len() - 1;
        line[last].hi.at += fixed(by);
        stock.set_line(Axis::Z, a, b, &line);
    };
    spoil(20, 20, 0.004);
    spoil(30, 22, -0.005);
    spoil(25, 30, 0.0005);
    let runs = [CertifiedRun { first_cut: 0, moves: &moves }];
    let proof = certify(&mut stock, &bodies, &runs, &Silent).unwrap();
    assert_eq!((proof.taken, proof.strayed), (1, 1), "{proof:?}");
    // Square to the surface it is less than along the line.
    assert!(proof.deepest > 0.003 && proof.deepest < 0.004, "{proof:?}");
    assert!(proof.farthest > 0.001 && proof.farthest <= 0.005, "{proof:?}");
    let [mended, whole] = [&stock, &sound].map(|stock| stock.line(Axis::Z, 20, 20).to_vec());
    assert!((mended[0].hi.at - whole[0].hi.at).abs() <= fixed(1.5 * GAP), "{mended:?} {whole:?}");
}

#[test]
fn a_flat_end_along_the_lattice_takes_few_boxes() {
    // A face on which all lines of a layer lie, cut by long moves: each is bounded by few planes, not by many points.
    let profile = Profile::cylinder(6.0, 20.0).unwrap();
    let moves: Vec<CutMove> = (0..8)
        .map(|row| {
            let y = -8.0 + 2.0 * f64::from(row);
            let at = |x: f64| DVec3::new(x, y, -3.3);
            CutMove::new(Line { start: at(-13.0), end: at(13.0) }, CutAxis::PlusZ, 0)
        })
        .collect();
    let (lines, proof) = cut_and_certified(&profile, &moves, 0.5, "raster");
    assert!(lines > 1000 && proof.boxes < 200 * lines as u64, "{lines} {proof:?}");
    assert!((proof.gap - GAP).abs() < 1e-9, "{proof:?}");
}

#[test]
fn moves_with_a_sampled_bound_are_counted() {
    let at = |x: f64, y: f64| glam::DVec2::new(x, y);
    let span = CubicSpan::new([at(-6.0, -5.0), at(-2.0, 6.0), at(2.0, -6.0), at(6.0, 5.0)]).unwrap();
    let along = |curve| CutMove::new(curve, CutAxis::ALL[4], 0);
    let line = Line { start: DVec3::new(-6.0, 0.0, -2.0), end: DVec3::new(6.0, 0.0, -2.0) };
    let moves = [along(line.into()), along(Curve::cubic(span, -3.0))];
    let (_, proof) = cut_and_certified(&Profile::bull_nose(6.0, 3.0, 9.0).unwrap(), &moves, 1.0, "a cubic");
    assert_eq!((proof.moves, proof.sampled), (2, 1));
}
