//! Grazing curves of random tools under random motions: what must hold for every one of them.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DVec2, DVec3};
use kinecut::geom::Rigid;
use kinecut::machine::Twist;
use kinecut::sweep::{Grazing, Motion, ProfileChain, SegmentKind, twist_of};
use kinecut::tool::{Contour, ContourElement, ElementRole};

use crate::common::random::Random;
use kinecut_cases::cases;

/// An element between two points: a line, or an arc of a given bulge.
fn joined(from: DVec2, to: DVec2, bulge: f64, role: ElementRole) -> ContourElement {
    if bulge == 0.0 {
        return ContourElement::line(from.to_array(), to.to_array(), role);
    }
    // Half the angle of the arc; positive bulges to the right of the way, away from the material.
    let half = 2.0 * bulge.atan();
    let chord = to - from;
    let right = DVec2::new(chord.y, -chord.x).try_normalize().unwrap();
    let radius = chord.length() / (2.0 * half.sin().abs());
    let centre = 0.5 * (from + to) - right * (radius * half.cos() * bulge.signum());
    let phi = right.y.atan2(right.x);
    ContourElement::arc(centre.to_array(), radius, phi - half, phi + half, role)
}

/// A tool of up to eight elements of all kinds, its radius rising and falling.
fn tool(numbers: &mut Random) -> ProfileChain {
    loop {
        let count = 2 + numbers.below(6);
        let mut elements = Vec::new();
        let mut at = DVec2::new(0.0, numbers.between(-3.0, 1.0));
        for k in 0..count {
            let role = [ElementRole::Cutting, ElementRole::Shank, ElementRole::Holder][(3 * k) / count];
            let next = DVec2::new(numbers.between(2.0, 12.0), at.y + numbers.between(2.0, 12.0));
            let next = match numbers.below(4) {
                0 => DVec2::new(next.x, at.y),
                1 if at.x > 0.0 => DVec2::new(at.x, next.y),
                _ => next,
            };
            let bulge = if numbers.below(2) == 0 { 0.0 } else { numbers.between(-0.3, 0.4) };
            if (next - at).length() > 0.5 {
                elements.push(joined(at, next, bulge, role));
                at = next;
            }
        }
        // A ball at the tip, now and then.
        if numbers.below(3) == 0 {
            let r = numbers.between(1.0, 6.0);
            let bottom = elements[0].shape.end();
            elements[0] = ContourElement::line([r, r + bottom.y], bottom.to_array(), ElementRole::Cutting);
            if bottom.x == r && bottom.y == r + bottom.y {
                continue;
            }
            let ball = ContourElement::arc([0.0, r + bottom.y], r, -FRAC_PI_2, 0.0, ElementRole::Cutting);
            elements.insert(0, ball);
            if elements[1].shape.length() < 1e-6 {
                elements.remove(1);
            }
        }
        elements.push(joined(at, DVec2::new(0.0, at.y + 4.0 * numbers.share()), 0.0, ElementRole::Holder));
        if let Ok(contour) = Contour::new(elements) {
            return ProfileChain::new(&contour);
        }
    }
}

/// A motion: half of them general, the others special.
fn motion(numbers: &mut Random) -> Twist {
    let (turn, shift) = (numbers.vector(5.0), numbers.vector(20.0));
    match numbers.below(10) {
        0 => Twist { turn: DVec3::ZERO, shift },
        1 => Twist { turn, shift: DVec3::new(shift.x, shift.y, 0.0) },
        2 => Twist { turn: DVec3::new(turn.x, 0.0, turn.z), shift },
        3 => Twist { turn: 1e-3 * turn, shift },
        4 => Twist { turn, shift: 1e-3 * shift },
        _ => Twist { turn, shift },
    }
}

/// Spans of two grazing results agree, on the same or on exchanged branches, turned about the axis.
fn same(chain: &ProfileChain, a: &Grazing, b: &Grazing, exchanged: bool, turned: f64, what: &str) {
    assert_eq!(a.spans.len(), b.spans.len(), "{what}");
    let rotation = DMat3::from_rotation_z(turned);
    let reach = chain.reach();
    for (x, y) in a.spans.iter().zip(&b.spans) {
        assert_eq!((x.piece, x.kind, x.folds), (y.piece, y.kind, y.folds), "{what}");
        for t in [0.1, 0.5, 0.8] {
            let (p, q) = (chain.grazing_points(x, t), chain.grazing_points(y, t));
            let q = if exchanged { [q[1], q[0]] } else { q };
            for (p, q) in p.iter().zip(&q) {
                let off = (rotation * p.point - q.point).length();
                // Where a fold is nearly double the curve itself is that sensitive.
                assert!(off < 1e-6 * reach, "{what}: off by {off:e} at {t}, piece {}", x.piece);
            }
        }
    }
    let ends =
        |g: &Grazing| g.loops.iter().map(|l| (l.spans.clone(), l.winding, l.closed)).collect::<Vec<_>>();
    assert_eq!(ends(a), ends(b), "{what}");
}

fn invariants(seed: u64) {
    let mut numbers = Random(seed);
    let chain = tool(&mut numbers);
    let twist = motion(&mut numbers);
    let grazing = chain.grazing(&twist);
    let what = format!("seed {seed}");
    let windings: u32 = grazing.loops.iter().map(|l| u32::from(l.winding)).sum();
    if grazing.motion != Motion::Across && twist.shift.z != 0.0 {
        assert_eq!(windings % 2, 1, "{what}: {windings}");
        assert!(grazing.loops.iter().all(|l| l.closed), "{what}");
        for of in &grazing.loops {
            let spans = &grazing.spans[of.spans.clone()];
            for (k, span) in spans.iter().enumerate() {
                assert_eq!(span.folds, [k == 0, k + 1 == spans.len()], "{what}");
            }
        }
    } else {
        assert_eq!(grazing.loops.len(), 1, "{what}");
        assert!(grazing.loops[0].closed, "{what}");
    }
    let size = twist.shift.length() + twist.turn.length() * chain.reach();
    for of in &grazing.loops {
        // Curves are closed and their points graze.
        let points = chain.curve(&grazing, of, 0.5);
        let gap = (points[0].point - points[points.len() - 1].point).length();
        assert!(gap < 1e-6 * chain.reach(), "{what}: open by {gap:e}");
        for p in &points {
            let off = p.normal.dot(twist.shift + twist.turn.cross(p.point)).abs();
            assert!(off < 1e-11 * size, "{what}: {off:e} at {p:?}");
        }
        for pair in points.windows(2).filter(|p| p[0].piece != p[1].piece && p[0].branch == p[1].branch) {
            let gap = (pair[0].point - pair[1].point).length();
            assert!(gap < 1e-6 * chain.reach(), "{what}: pieces part by {gap:e}");
        }
    }
    // The motion back, a faster one, a spinning tool, another direction.
    let back = Twist { turn: -twist.turn, shift: -twist.shift };
    same(&chain, &grazing, &chain.grazing(&back), true, 0.0, &format!("{what} reversed"));
    let faster = Twist { turn: 3.7 * twist.turn, shift: 3.7 * twist.shift };
    same(&chain, &grazing, &chain.grazing(&faster), false, 0.0, &format!("{what} faster"));
    let spin = Twist { turn: twist.turn + 40.0 * DVec3::Z, ..twist };
    same(&chain, &grazing, &chain.grazing(&spin), false, 0.0, &format!("{what} with spin"));
    let by = numbers.between(-PI, PI);
    let rotation = DMat3::from_rotation_z(by);
    let turned = Twist { turn: rotation * twist.turn, shift: rotation * twist.shift };
    same(&chain, &grazing, &chain.grazing(&turned), false, by, &format!("{what} turned"));
}

#[test]
fn what_holds_for_all_tools_and_motions() {
    (0..u64::from(cases(4000, 100_000))).for_each(invariants);
}

/// Counts the regions of one sign of the normal velocity on a grid over the whole tool.
fn regions(chain: &ProfileChain, twist: &Twist, rows: usize, columns: usize) -> usize {
    let mut signs: Vec<Vec<bool>> = Vec::new();
    for piece in chain.pieces() {
        for k in 0..rows {
            let u = piece.from + (piece.to - piece.from) * (k as f64 + 0.5) / rows as f64;
            let (p, n) = (piece.point(u), piece.normal(u));
            let sign = |j: usize| {
                let (sin, cos) = (2.0 * PI * (j as f64 + 0.5) / columns as f64).sin_cos();
                let (p, n) = (DVec3::new(p.x * cos, p.x * sin, p.y), DVec3::new(n.x * cos, n.x * sin, n.y));
                n.dot(twist.shift + twist.turn.cross(p)) > 0.0
            };
            signs.push((0..columns).map(sign).collect());
        }
    }
    let mut seen = vec![vec![false; columns]; signs.len()];
    let mut count = 0;
    for i in 0..signs.len() {
        for j in 0..columns {
            if seen[i][j] {
                continue;
            }
            count += 1;
            let mut open = vec![(i, j)];
            seen[i][j] = true;
            while let Some((a, b)) = open.pop() {
                let mut near = vec![(a, (b + 1) % columns), (a, (b + columns - 1) % columns)];
                // The poles join all columns of the first and of the last row.
                if a == 0 || a + 1 == signs.len() {
                    near.extend((0..columns).map(|c| (a, c)));
                }
                near.extend((a > 0).then(|| (a - 1, b)));
                near.extend((a + 1 < signs.len()).then_some((a + 1, b)));
                for (c, d) in near {
                    if !seen[c][d] && signs[c][d] == signs[a][b] {
                        seen[c][d] = true;
                        open.push((c, d));
                    }
                }
            }
        }
    }
    count
}

#[test]
fn the_regions_of_one_sign_are_one_more_than_the_curves() {
    let mut told = 0;
    for seed in 0..150 {
        let mut numbers = Random(seed);
        let chain = tool(&mut numbers);
        let twist = Twist { turn: numbers.vector(5.0), shift: numbers.vector(20.0) };
        let grazing = chain.grazing(&twist);
        // Curves smaller than the grid, or nearer to one another, are not told by it.
        let small = grazing.loops.iter().any(|of| {
            grazing.spans[of.spans.clone()].iter().any(|s| {
                let piece = &chain.pieces()[s.piece];
                (s.to - s.from).abs() < 0.08 * (piece.to - piece.from).abs()
            })
        });
        if small {
            continue;
        }
        let (coarse, fine) = (regions(&chain, &twist, 24, 90), regions(&chain, &twist, 48, 180));
        if coarse == fine {
            // Necks narrower than a cell are told by a finer grid.
            let wanted = grazing.loops.len() + 1;
            let mut found = fine;
            for finer in [4, 8, 16] {
                if found != wanted {
                    found = regions(&chain, &twist, 48 * finer, 150 * finer);
                }
            }
            assert_eq!(found, wanted, "seed {seed}");
            told += 1;
        }
    }
    assert!(told > 50, "{told}");
}

/// The number of grazing points on a parallel circle, by sign changes of plain vectors.
#[test]
fn every_parallel_circle_has_the_points_that_brute_force_finds() {
    let mut numbers = Random(77);
    for _ in 0..cases(300, 3000) {
        let chain = tool(&mut numbers);
        let twist = motion(&mut numbers);
        let grazing = chain.grazing(&twist);
        for (index, piece) in chain.pieces().iter().enumerate() {
            for k in 0..5 {
                let u = piece.from + (piece.to - piece.from) * (f64::from(k) + 0.37) / 5.0;
                let (p, n) = (piece.point(u), piece.normal(u));
                let value = |j: usize| {
                    let (sin, cos) = (2.0 * PI * j as f64 / 720.0).sin_cos();
                    let (p, n) =
                        (DVec3::new(p.x * cos, p.x * sin, p.y), DVec3::new(n.x * cos, n.x * sin, n.y));
                    n.dot(twist.shift + twist.turn.cross(p))
                };
                let values: Vec<f64> = (0..720).map(value).collect();
                let changes =
                    (0..720).filter(|&j| (values[j] > 0.0) != (values[(j + 1) % 720] > 0.0)).count();
                let spans = grazing.spans.iter().filter(|s| s.piece == index);
                let inside = spans.filter(|s| (u - s.from) * (u - s.to) < 0.0).count();
                let low = values.iter().fold(f64::INFINITY, |m, v| m.min(v.abs()));
                let high = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
                // Two points nearer than the sampling are not told by it.
                if low > 1e-4 * high || changes == 2 {
                    assert_eq!(changes, 2 * inside, "piece {index} at {u}");
                }
            }
        }
    }
}

#[test]
fn concentric_arcs_share_their_folds() {
    let mut numbers = Random(5);
    for _ in 0..cases(2000, 20_000) {
        let twist = Twist { turn: numbers.vector(5.0), shift: numbers.vector(20.0) };
        let (x, z) = (numbers.between(4.0, 9.0), numbers.between(2.0, 9.0));
        let folds = |r: f64| {
            let contour = Contour::new(vec![
                ContourElement::line([0.0, z - r], [x, z - r], ElementRole::Cutting),
                ContourElement::arc([x, z], r, -FRAC_PI_2, 0.0, ElementRole::Cutting),
                ContourElement::line([x + r, z], [x + r, 40.0], ElementRole::Cutting),
                ContourElement::line([x + r, 40.0], [0.0, 40.0], ElementRole::Shank),
            ]);
            let chain = ProfileChain::new(&contour.unwrap());
            let grazing = chain.grazing(&twist);
            let on_arc = grazing.spans.iter().filter(|s| s.kind == SegmentKind::TorusOuter);
            on_arc.flat_map(|s| [s.from, s.to]).collect::<Vec<f64>>()
        };
        let (small, large) = (folds(0.5), folds(1.9));
        assert_eq!(small.len(), large.len());
        assert!(small.iter().zip(&large).all(|(a, b)| (a - b).abs() < 1e-9), "{small:?} {large:?}");
    }
}

#[test]
fn a_pose_and_its_rate_give_the_twist() {
    let mut numbers = Random(11);
    for _ in 0..cases(200, 2000) {
        let axis = numbers.vector(1.0).try_normalize().unwrap();
        let rotation = DMat3::from_axis_angle(axis, numbers.between(-3.0, 3.0));
        let (turn, shift) = (numbers.vector(2.0), numbers.vector(9.0));
        let skew = DMat3::from_cols(turn.cross(DVec3::X), turn.cross(DVec3::Y), turn.cross(DVec3::Z));
        let pose = Rigid { rotation, translation: numbers.vector(100.0) };
        let twist = twist_of(&pose, rotation * skew, rotation * shift).unwrap();
        assert!((twist.turn - turn).length() < 1e-13 && (twist.shift - shift).length() < 1e-13);
    }
    let pose = Rigid::IDENTITY;
    let code = |pose: &Rigid, rate: DMat3| twist_of(pose, rate, DVec3::X).unwrap_err().0.code.as_str();
    assert_eq!(code(&Rigid { rotation: 2.0 * DMat3::IDENTITY, ..pose }, DMat3::ZERO), "KC1202");
    assert_eq!(code(&Rigid { rotation: DMat3::ZERO, ..pose }, DMat3::ZERO), "KC1202");
    let mirrored = DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0));
    assert_eq!(code(&Rigid { rotation: mirrored, ..pose }, DMat3::ZERO), "KC1202");
    assert_eq!(code(&pose, DMat3::IDENTITY), "KC1202");
    assert_eq!(code(&pose, DMat3::from_cols(DVec3::NAN, DVec3::ZERO, DVec3::ZERO)), "KC1202");
}

#[test]
fn without_motion_there_is_no_curve() {
    let mut numbers = Random(3);
    let chain = tool(&mut numbers);
    for (turn, motion) in [(DVec3::ZERO, Motion::Still), (7.0 * DVec3::Z, Motion::Spin)] {
        let grazing = chain.grazing(&Twist { turn, shift: DVec3::ZERO });
        assert_eq!(grazing.motion, motion);
        assert!(grazing.loops.is_empty() && grazing.spans.is_empty());
    }
}
