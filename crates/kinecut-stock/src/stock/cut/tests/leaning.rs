//! Tools that lean or turn: against sampled poses, against the kernels of upright tools, and what their moves do.

use std::f64::consts::PI;

use glam::DVec3;

use super::against_poses::{CLOSE, SHAPES, block, compare_move};
use super::reference::{Random, Swept};
use crate::base::Silent;
use crate::geom::{Aabb, Arc, Curve, Line, Profile, ProfileElement, Rigid};
use crate::machine::kinematics::Twist;
use crate::stock::cut::{CutAxis, CutMove, CutOptions, MoveEffect, ToolBody, cut, meets_at_rest};
use crate::stock::{Axis, DexelGrid, TriDexel};
use crate::sweep::ToolMotion;

/// A direction that leans by up to `most` from Z [rad].
fn leaning(random: &mut Random, most: f64) -> DVec3 {
    let (lean, round) = (random.within(0.05, most), random.within(0.0, 2.0 * PI));
    DVec3::new(lean.sin() * round.cos(), lean.sin() * round.sin(), lean.cos())
}

/// A point in the upper half of the block.
fn inside(random: &mut Random) -> DVec3 {
    random.plane(4.0).extend(random.within(-4.0, -0.5))
}

/// Compares a motion; no point of the tools is more than 11 mm from the tip.
fn compare(shape: super::reference::Shape, motion: ToolMotion, curve: Curve) -> usize {
    let way = (0..64).map(|i| motion.speed(f64::from(i) / 63.0, 11.0)).fold(0.0, f64::max) * 1.2;
    let one = CutMove::leaning(motion.clone(), curve, 0);
    let poses = move |t: f64| {
        let pose = motion.pose(t);
        (pose.translation, pose.rotation.z_axis)
    };
    compare_move(shape, one, &Swept::of(shape, Box::new(poses), way), 1.3, CLOSE)
}

#[test]
fn lines_and_arcs_of_a_leaning_tool() {
    let mut random = Random(23);
    let mut compared = 0;
    for shape in SHAPES {
        for most in [0.2, 0.8, 2.0] {
            let axis = leaning(&mut random, most);
            let line = Line { start: inside(&mut random), end: inside(&mut random) };
            compared += compare(shape, ToolMotion::fixed(line.into(), axis).unwrap(), line.into());
            let plunge = Line { start: line.start + axis * 3.0, end: line.start - axis * 0.7 };
            compared += compare(shape, ToolMotion::fixed(plunge.into(), axis).unwrap(), plunge.into());
            let centre = inside(&mut random);
            let arc = Arc::new(line.start, centre, leaning(&mut random, 1.0), random.within(-3.0, 3.0), 0.5);
            let arc = Curve::from(arc.unwrap());
            compared += compare(shape, ToolMotion::fixed(arc.clone(), axis).unwrap(), arc);
        }
    }
    assert!(compared > 2_000, "{compared}");
}

#[test]
fn turning_tools() {
    let mut random = Random(29);
    let mut compared = 0;
    for shape in SHAPES {
        for most in [0.3, 1.0] {
            let [from, to] = [0, 1].map(|_| leaning(&mut random, most));
            let line = Curve::from(Line { start: inside(&mut random), end: inside(&mut random) });
            compared += compare(shape, ToolMotion::between(line.clone(), from, to).unwrap(), line.clone());
            // About a point of the tool, and about one beside it.
            for shift in [DVec3::ZERO, DVec3::new(1.0, -2.0, 0.5)] {
                let twist = Twist { turn: leaning(&mut random, 1.5) * random.within(-0.8, 0.8), shift };
                let start = Rigid { translation: inside(&mut random), ..Rigid::IDENTITY };
                compared += compare(shape, ToolMotion::screw(start, twist).unwrap(), line.clone());
            }
        }
    }
    assert!(compared > 1_500, "{compared}");
}

/// Effects of moves, and the stock after them.
fn run(body: &ToolBody, moves: &[CutMove]) -> (Vec<MoveEffect>, TriDexel) {
    let mut stock = TriDexel::from_box(block(), 0.35).unwrap();
    let bodies = std::slice::from_ref(body);
    let effects = cut(&mut stock, bodies, moves, &CutOptions::default(), &Silent).unwrap();
    (effects, stock)
}

#[test]
fn an_upright_tool_is_cut_as_by_the_kernels_of_upright_tools() {
    let mut random = Random(31);
    for (k, shape) in SHAPES.into_iter().enumerate() {
        let body = ToolBody {
            // The shank is thicker than the edges, and rubs.
            shank: vec![(Profile::cylinder(9.0, 6.0).unwrap(), shape.profile().top())],
            ..ToolBody::new(shape.profile())
        };
        let axis = CutAxis::ALL[k % 6];
        let mut moves = Vec::new();
        for i in 0..8 {
            // Level and falling: on a rise a shank is compared before its edges cut, span by span here and once a move there.
            let start = inside(&mut random);
            let drop = axis.vector() * if i % 2 == 0 { 0.0 } else { -1.5 };
            let way = random.plane(6.0);
            let way = DVec3::new(way.x, way.y, way.x - way.y);
            let across = way - axis.vector() * way.dot(axis.vector());
            let line = Line { start, end: start + across + drop };
            moves.push(if i == 5 {
                CutMove::new(line, axis, 0).watched()
            } else {
                CutMove::new(line, axis, 0)
            });
        }
        let lean = |m: &CutMove| CutMove {
            watch: m.watch,
            ..CutMove::leaning(ToolMotion::fixed(m.curve.clone(), axis.vector()).unwrap(), m.curve.clone(), 0)
        };
        let leaning: Vec<CutMove> = moves.iter().map(lean).collect();
        let ((plain, upright), (own, leant)) = (run(&body, &moves), run(&body, &leaning));
        for (a, b) in plain.iter().zip(&own) {
            assert!((a.removed - b.removed).abs() < 1e-3, "{shape:?} {axis:?} {} {}", a.removed, b.removed);
            // What a pilot takes counts with what its step takes after it.
            let more = b.deepest - a.deepest;
            assert!(more.abs() < 0.05 || k == 6 && more > 0.0, "{shape:?} {a:?} {b:?}");
            assert_eq!(a.first_contact.is_some(), b.first_contact.is_some());
            assert_eq!(a.shank().is_some(), b.shank().is_some(), "{shape:?} {a:?} {b:?}");
        }
        for along in Axis::ALL {
            let (a, b) = along.others();
            let counts = upright.lattice().counts;
            for j in 0..counts[b.index()] {
                for i in 0..counts[a.index()] {
                    // A sliver at a touch may be there in one of them.
                    let told = |s: &TriDexel| -> Vec<i32> {
                        let line = s.line(along, i, j).iter().filter(|i| i.hi.at - i.lo.at > 300);
                        line.flat_map(|i| [i.lo.at, i.hi.at]).collect()
                    };
                    let (x, y) = (told(&upright), told(&leant));
                    let same = x.len() == y.len() && x.iter().zip(&y).all(|(x, y)| (x - y).abs() <= 2);
                    assert!(same, "{shape:?} {along:?} {i} {j}: {x:?} {y:?}");
                }
            }
        }
    }
}

#[test]
fn a_move_that_leans_tells_what_it_removes_and_what_its_holder_meets() {
    let axis = DVec3::new(0.0, 0.6, 0.8);
    let body = ToolBody {
        holder: vec![(Profile::cylinder(10.0, 10.0).unwrap(), 6.0)],
        ..ToolBody::new(Profile::bull_nose(2.0, 1.0, 6.0).unwrap())
    };
    let lean = |from: DVec3, to: DVec3| {
        let line = Line { start: from, end: to };
        CutMove::leaning(ToolMotion::fixed(line.into(), axis).unwrap(), line, 0)
    };
    let at = |x: f64, z: f64| DVec3::new(x, 0.0, z);
    let above = lean(at(-12.0, 3.0), at(12.0, 3.0)).watched();
    let through = lean(at(-12.0, -0.5), at(12.0, -0.5)).watched();
    // Ten deep along the tool: the holder goes in.
    let dive = lean(axis * 4.0, axis * -6.0);
    let (effects, stock) = run(&body, &[above, through, dive]);
    assert_eq!(effects[0], MoveEffect::default());
    assert!(effects[1].first_contact.unwrap()[0] < -7.0 && effects[1].removed > 1.0);
    assert!(effects[1].overlap() > 0.3 && effects[1].overlap() < 2.0, "{:?}", effects[1]);
    assert!(effects[1].holder().is_none());
    assert!(effects[2].holder().is_some_and(|h| h.overlap() > 1.0), "{:?}", effects[2]);
    let removed: f64 = effects.iter().map(|e| e.removed).sum();
    let raw = TriDexel::from_box(block(), 0.35).unwrap().volume();
    assert!((raw - stock.volume() - removed).abs() < 1e-6);
}

/// Cuts a motion and puts the tool, a tenth of a micrometre smaller, back at poses of it.
fn fits(stock: &mut TriDexel, profile: &Profile, line: Line, [from, to]: [DVec3; 2]) {
    let motion = ToolMotion::between(line.into(), from, to).unwrap();
    let moves = [CutMove::leaning(motion.clone(), line, 0)];
    cut(stock, &[ToolBody::new(profile.clone())], &moves, &CutOptions::default(), &Silent).unwrap();
    for k in 0..=20 {
        let pose = motion.pose(f64::from(k) / 20.0);
        let (tip, axis) = (pose.translation, pose.rotation.z_axis);
        assert!(!meets_at_rest(stock, &[(profile, 0.0)], tip, axis, -1e-4), "{profile:?} {line:?} {k}");
    }
}

#[test]
fn after_a_move_the_tool_fits_into_what_it_has_cut_at_all_of_its_poses() {
    let mut random = Random(37);
    let bull = Profile::bull_nose(12.0, 3.0, 20.0).unwrap();
    for profile in
        [&bull, &Profile::cylinder(8.0, 20.0).unwrap(), &Profile::bull_nose(6.0, 3.0, 20.0).unwrap()]
    {
        for _ in 0..6 {
            let mut stock = TriDexel::from_box(block().grown(12.0), 0.4).unwrap();
            let turn = [0, 1].map(|_| leaning(&mut random, 0.6));
            let start = inside(&mut random);
            let line = Line { start, end: start + random.plane(3.0).extend(random.within(-0.5, 0.5)) };
            fits(&mut stock, profile, line, turn);
        }
    }
    // Long ways with little turn, as along a surface: lines that a flat end nearly lies along.
    let along = [
        (DVec3::new(10.0, 4.5922, -11.1918), DVec3::new(-0.0947, -0.1608, 0.9824)),
        (DVec3::new(15.0, 6.6668, -10.248), DVec3::new(-0.1337, -0.2270, 0.9647)),
        (DVec3::new(20.0, 8.4853, -9.0426), DVec3::new(-0.1642, -0.2787, 0.9462)),
    ];
    let part = Aabb { min: DVec3::new(14.0, 0.0, -13.0), max: DVec3::new(27.0, 14.0, -6.0) };
    let mut stock = TriDexel::from_box(part, 0.079).unwrap();
    for pair in along.windows(2) {
        fits(&mut stock, &bull, Line { start: pair[0].0, end: pair[1].0 }, [pair[0].1, pair[1].1]);
    }
}

/// A move that only looks, past a point of the block at about the reach of a tool.
fn passing(random: &mut Random, profile: &Profile, i: u32) -> CutMove {
    let axis = leaning(random, 1.2);
    let b = block();
    // A corner, a point of an edge, or one of a face.
    let mut near = b.min + (b.max - b.min) * DVec3::splat(0.5);
    for k in 0..3 - (i % 3) as usize {
        near[(k + 2) % 3] =
            if k == 0 || random.within(0.0, 1.0) > 0.5 { b.max[(k + 2) % 3] } else { b.min[(k + 2) % 3] };
    }
    let out = (near - b.min - (b.max - b.min) * 0.5).normalize_or(DVec3::Z);
    // The tool's furthest point inwards comes to a little below the place, or above it.
    let (along, across) = (-out.dot(axis), (-out + axis * out.dot(axis)).length());
    let deep = profile.support(across, along);
    let tip = near + out * (deep + random.within(-0.5, 0.2));
    let way = (leaning(random, 2.0) - out * leaning(random, 2.0).dot(out)) * random.within(4.0, 30.0);
    let way = way - out * way.dot(out);
    let line = Line { start: tip - way * random.within(0.3, 0.7), end: tip + way * random.within(0.3, 0.7) };
    let motion = if i.is_multiple_of(2) {
        ToolMotion::fixed(line.into(), axis)
    } else {
        ToolMotion::between(line.into(), axis, axis + random.plane(0.2).extend(0.0))
    };
    CutMove { removes: false, ..CutMove::leaning(motion.unwrap(), line, 0).watched() }
}

/// A tool of 6 mm with a point of 118 degrees.
fn pointed() -> Profile {
    let cone = ProfileElement::Cone { z0: 0.0, r0: 0.0, z1: 1.8, r1: 3.0 };
    Profile::new(vec![cone, ProfileElement::Cone { z0: 1.8, r0: 3.0, z1: 20.0, r1: 3.0 }]).unwrap()
}

#[test]
fn a_tip_that_scratches_between_the_lines_is_an_edge_and_one_above_the_face_is_none() {
    let axis = DVec3::new(0.2, 0.1, 1.0);
    let scratched = |x: f64, y: f64, z: f64| {
        let tip = DVec3::new(x, y, z);
        let line = Line { start: tip, end: tip + DVec3::X * 0.01 };
        let one = CutMove::leaning(ToolMotion::fixed(line.into(), axis).unwrap(), line, 0).watched();
        let mut stock = TriDexel::from_box(block(), 0.7).unwrap();
        let bodies = [ToolBody::new(pointed())];
        let effect = &cut(&mut stock, &bodies, &[one], &CutOptions::default(), &Silent).unwrap()[0];
        assert!(effect.first_contact.is_none(), "{effect:?}");
        effect.edge().is_some()
    };
    // Around the middle of four lines, which run at -8 + 0.35 + 0.7 k.
    for (x, y) in [(-1.0, -1.0), (-1.17, -0.95), (-0.9, -1.2), (-0.83, -0.9), (-1.13, -1.13)] {
        assert!(scratched(x, y, -0.055), "{x} {y}");
        assert!(!scratched(x, y, 0.02), "{x} {y}");
    }
}

#[test]
fn an_overlap_that_fine_lines_meet_is_met_by_coarse_ones_or_an_edge() {
    let mut random = Random(41);
    let cone = Profile::new(vec![
        ProfileElement::Cone { z0: 0.0, r0: 0.0, z1: 1.8, r1: 3.0 },
        ProfileElement::Cone { z0: 1.8, r0: 3.0, z1: 20.0, r1: 3.0 },
    ]);
    let tools =
        [cone.unwrap(), Profile::cylinder(5.0, 20.0).unwrap(), Profile::bull_nose(6.0, 3.0, 20.0).unwrap()];
    let (mut met, mut edges, mut clear, mut alarms) = (0, 0, 0, 0);
    for i in 0..=1126 {
        let tool = &tools[(i / 6 % 3) as usize];
        let one = passing(&mut random, tool, i);
        // The last one is a clip that a net of points on the faces beside it does not tell.
        if (240..1126).contains(&i) {
            continue;
        }
        let look = |step: f64| {
            let mut stock = TriDexel::from_box(block(), step).unwrap();
            let body = ToolBody::new(tool.clone());
            cut(&mut stock, &[body], std::slice::from_ref(&one), &CutOptions::default(), &Silent)
                .unwrap()
                .swap_remove(0)
        };
        let (fine, coarse) = (look(0.09), look(0.7));
        if fine.overlap() > 0.06 {
            assert!(coarse.first_contact.is_some() || coarse.edge().is_some(), "{i}: {fine:?} {one:?}");
        }
        match (coarse.first_contact, coarse.edge(), fine.first_contact) {
            (Some(_), ..) => met += 1,
            (None, Some(_), Some(_)) => edges += 1,
            (None, Some(_), None) => alarms += 1,
            _ => clear += 1,
        }
    }
    assert!(met > 50 && edges > 10 && clear > 30, "{met} {edges} {alarms} {clear}");
}

#[test]
fn a_motion_that_is_a_slip_is_refused_and_the_stock_stays() {
    let body = ToolBody::new(Profile::cylinder(6.0, 9.0).unwrap());
    let line = Curve::from(Line { start: DVec3::ZERO, end: DVec3::X });
    let refused = |twist: Twist| {
        let motion = ToolMotion::screw(Rigid::IDENTITY, twist).unwrap();
        let mut stock = TriDexel::from_box(block(), 1.0).unwrap();
        let before = stock.volume();
        let moves = [CutMove::leaning(motion, line.clone(), 0)];
        let error = cut(&mut stock, std::slice::from_ref(&body), &moves, &CutOptions::default(), &Silent);
        assert_eq!(stock.volume(), before);
        error.unwrap_err().0.key.clone()
    };
    let key = Some("moves[0].stance".into());
    assert_eq!(refused(Twist { turn: DVec3::X * 6300.0, shift: DVec3::ZERO }), key);
    assert_eq!(refused(Twist { turn: DVec3::ZERO, shift: DVec3::X * 2e5 }), key);
}
