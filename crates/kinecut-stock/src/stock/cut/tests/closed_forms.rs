//! Volumes and walls against closed forms, and what must be the same.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::reference::Random;
use crate::base::{Code, Progress, Silent};
use crate::geom::{Aabb, Arc, Curve, InvoluteRecord, Line, Mesh, Profile};
use crate::stock::cut::{
    BodyContact, CutAxis, CutMove, CutOptions, MoveEffect, Stance, SweptFace, ToolBody, cut,
};
use crate::stock::{Axis, DexelGrid, Interval, TriDexel, fixed, unfixed};

fn mill(diameter: f64, length: f64) -> ToolBody {
    ToolBody::new(Profile::cylinder(diameter, length).unwrap())
}

fn block(x: f64, y: f64, z: f64, step: f64) -> TriDexel {
    let bounds = Aabb { min: DVec3::new(-x / 2.0, -y / 2.0, -z), max: DVec3::new(x / 2.0, y / 2.0, 0.0) };
    TriDexel::from_box(bounds, step).unwrap()
}

fn up(curve: impl Into<Curve>) -> CutMove {
    CutMove::new(curve, CutAxis::PlusZ, 0)
}

fn line(a: [f64; 3], b: [f64; 3]) -> Line {
    Line { start: a.into(), end: b.into() }
}

fn circle(radius: f64, z: f64) -> Arc {
    Arc::new(DVec3::new(radius, 0.0, z), DVec3::new(0.0, 0.0, z), DVec3::Z, TAU, 0.0).unwrap()
}

fn run(stock: &mut TriDexel, tool: &ToolBody, moves: &[CutMove]) -> Vec<MoveEffect> {
    cut(stock, std::slice::from_ref(tool), moves, &CutOptions::default(), &Silent).unwrap()
}

fn lines(stock: &TriDexel) -> Vec<(Axis, u32, u32, Vec<Interval>)> {
    let n = stock.lattice().counts;
    let mut all = Vec::new();
    for axis in Axis::ALL {
        let (a, b) = axis.others();
        for j in 0..n[b.index()] {
            for i in 0..n[a.index()] {
                all.push((axis, i, j, stock.line(axis, i, j).to_vec()));
            }
        }
    }
    all
}

/// A lead-in, a spiral, a circle, a ramp, a helix, a plunge: all kernels of a flat cutter and a ball.
fn mixed() -> Vec<CutMove> {
    let record = InvoluteRecord::new(70.0, [0.0, 0.0], 0.4, 0.0, 8.0).unwrap();
    let helix = Arc::new(DVec3::new(5.0, 0.0, 1.0), DVec3::ZERO, DVec3::Z, 14.0, -4.0).unwrap();
    let mut moves = vec![
        up(helix),
        up(line([5.0, 0.0, -3.0], [0.0, 0.0, -3.0])),
        up(Curve::involute(record, -3.0, 0.0)),
        up(circle(9.0, -3.0)),
        up(line([-12.0, -12.0, 0.0], [11.0, 13.0, -2.5])),
        up(line([-12.0, 12.0, 3.0], [-12.0, 12.0, -4.5])),
    ];
    let second = moves.clone();
    moves.extend(second.into_iter().map(|m| {
        let lower = crate::geom::Rigid::from_translation(DVec3::new(2.0, 1.0, -0.5));
        CutMove { curve: m.curve.moved(&lower), body: 1, ..m }
    }));
    moves
}

fn tools() -> [ToolBody; 2] {
    let ball = ToolBody {
        cutting: Profile::bull_nose(4.0, 2.0, 6.0).unwrap(),
        edge: None,
        shank: vec![(Profile::cylinder(3.0, 10.0).unwrap(), 6.0)],
        holder: vec![(Profile::cylinder(9.0, 5.0).unwrap(), 8.0)],
    };
    [mill(6.0, 8.0), ball]
}

#[test]
fn a_pocket_has_its_volume() {
    let mut stock = block(30.0, 24.0, 6.0, 0.05);
    let before = stock.volumes();
    let (a, b, z) = (10.0, 6.0, -4.0);
    let mut moves = vec![up(line([-a, -b, 3.0], [-a, -b, z]))];
    for i in 0..=6 {
        let y = -b + 2.0 * f64::from(i);
        moves.push(up(line([-a, y, z], [a, y, z])));
        moves.push(up(line([a, y, z], [-a, (y + 2.0).min(b), z])));
    }
    for (p, q) in [([-a, -b], [a, -b]), ([a, -b], [a, b]), ([a, b], [-a, b]), ([-a, b], [-a, -b])] {
        moves.push(up(line([p[0], p[1], z], [q[0], q[1], z])));
    }
    let effects = run(&mut stock, &mill(5.0, 10.0), &moves);
    let exact = (25.0 * 17.0 - (4.0 - PI) * 2.5 * 2.5) * 4.0;
    for (v, w) in stock.volumes().into_iter().zip(before) {
        assert!(((w - v) / exact - 1.0).abs() < 1e-4, "{} {exact}", w - v);
    }
    let removed: f64 = effects.iter().map(|e| e.removed).sum();
    assert!((removed - (before[2] - stock.volume())).abs() < 1e-6);
    assert!(effects.iter().all(|e| e.removed >= 0.0 && e.path_error == 0.0));
}

#[test]
fn a_helical_bore_has_its_volume_and_its_radius() {
    let mut stock = block(24.0, 24.0, 5.0, 0.05);
    let before = stock.volumes();
    let helix = Arc::new(DVec3::new(4.0, 0.0, 0.5), DVec3::ZERO, DVec3::Z, 6.0 * TAU, -4.5).unwrap();
    run(&mut stock, &mill(9.0, 20.0), &[up(helix), up(circle(4.0, -4.0))]);
    let exact = PI * 8.5 * 8.5 * 4.0;
    let volumes = stock.volumes();
    for (i, most) in [(0, 1e-4), (1, 1e-4), (2, 1e-3)] {
        let removed = before[i] - volumes[i];
        assert!((removed / exact - 1.0).abs() < most, "{i} {removed} {exact}");
    }
    let lattice = *stock.lattice();
    let (mut walls, mut troughs) = (0, 0);
    for (axis, i, j, line) in lines(&stock).into_iter().filter(|l| l.0 != Axis::Z) {
        for end in line.iter().flat_map(|i| [i.lo, i.hi]).filter(|e| e.cut != 0) {
            let across =
                if axis == Axis::X { lattice.coordinate(Axis::Y, i) } else { lattice.coordinate(Axis::X, j) };
            let r = across.hypot(unfixed(end.at));
            assert!((r - 8.5).abs() < 1e-4, "{r}");
            let face = SweptFace::of_class(end.normal.class()).unwrap();
            // Both faces meet in one rounded end where the trough of the lower edge runs into the wall.
            assert!(matches!(face, SweptFace::WallRight | SweptFace::Trough), "{face:?}");
            (walls, troughs) = (walls + 1, troughs + usize::from(face == SweptFace::Trough));
        }
    }
    assert!(walls > 2 * 2 * 80 * 300 && troughs * 1000 < walls, "{walls} {troughs}");
}

#[test]
fn the_bore_of_an_involute_is_round_to_a_micron() {
    let mut stock = block(60.0, 60.0, 2.0, 0.25);
    let (tool, path) = (8.0, 20.0);
    let base = path / (10.0 * TAU);
    let length = 0.5 * path * path / base;
    let spiral = InvoluteRecord::new(length, [0.0, 0.0], 0.0, 0.0, path).unwrap();
    let end = spiral.end();
    // The involute ends square to the circle about the base centre on which it touches the wall.
    let centre = spiral.base_centre();
    let radial = end - centre;
    let axis_centre = DVec3::new(0.0, 0.0, -3.0);
    let start = DVec3::new(radial.x, radial.y, -3.0);
    let finish = Arc::new(start, axis_centre, DVec3::Z, TAU, 0.0).unwrap();
    let curve = Curve::involute(spiral.shifted(-centre), -3.0, 0.0);
    let effects = run(&mut stock, &mill(tool, 10.0), &[up(curve), up(finish)]);
    assert_eq!(effects[0].path_error, CutOptions::default().path_tolerance);
    let wall = radial.length() + 0.5 * tool;
    let lattice = *stock.lattice();
    for (axis, i, j, line) in lines(&stock).into_iter().filter(|l| l.0 != Axis::Z) {
        let across =
            if axis == Axis::X { lattice.coordinate(Axis::Y, i) } else { lattice.coordinate(Axis::X, j) };
        if across.abs() < wall - 1e-3 {
            // A through bore without a core: two stretches.
            assert_eq!(line.len(), 2, "{axis:?} {across}");
        }
        for end in line.iter().flat_map(|i| [i.lo, i.hi]).filter(|e| e.cut != 0) {
            assert!((across.hypot(unfixed(end.at)) - wall).abs() < 1e-3);
        }
    }
}

#[test]
fn one_thread_and_two_give_the_same() {
    let result = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut stock = block(32.0, 32.0, 5.0, 0.2);
            let effects = cut(&mut stock, &tools(), &mixed(), &CutOptions::default(), &Silent).unwrap();
            (lines(&stock), effects)
        })
    };
    let (one, two) = (result(1), result(2));
    assert_eq!(one.1, two.1);
    assert!(one.0 == two.0);
}

#[test]
fn calls_chain_and_material_only_goes() {
    let mut whole = block(32.0, 32.0, 5.0, 0.4);
    let effects = cut(&mut whole, &tools(), &mixed(), &CutOptions::default(), &Silent).unwrap();
    let mut parts = block(32.0, 32.0, 5.0, 0.4);
    let mut volume = parts.volume();
    for (i, m) in mixed().into_iter().enumerate() {
        let options = CutOptions { first_cut: i as u32, ..CutOptions::default() };
        let one = cut(&mut parts, &tools(), std::slice::from_ref(&m), &options, &Silent).unwrap();
        assert_eq!(one[0], effects[i]);
        let now = parts.volume();
        assert!((volume - now - one[0].removed).abs() < 1e-6 && now <= volume);
        volume = now;
        // The same move again finds nothing.
        let again = cut(&mut parts, &tools(), &[m], &options, &Silent).unwrap();
        assert_eq!((again[0].removed, again[0].deepest, again[0].first_contact), (0.0, 0.0, None));
    }
    assert!(lines(&whole) == lines(&parts));
}

#[test]
fn a_mesh_is_cut_like_the_box_it_is() {
    let (min, max) = (DVec3::new(-16.0, -16.0, -5.0), DVec3::new(16.0, 16.0, 0.0));
    let vertices =
        (0..8).map(|i| DVec3::select(glam::BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), max, min)).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
    let mut mesh = TriDexel::from_mesh(&Mesh { vertices, triangles }, 0.4).unwrap();
    let mut exact = block(32.0, 32.0, 5.0, 0.4);
    for stock in [&mut mesh, &mut exact] {
        cut(stock, &tools(), &mixed(), &CutOptions::default(), &Silent).unwrap();
    }
    for (a, b) in lines(&mesh).into_iter().zip(lines(&exact)) {
        let ends =
            |l: &[Interval]| l.iter().map(|i| (i.lo.at, i.hi.at, i.lo.cut, i.hi.cut)).collect::<Vec<_>>();
        assert_eq!(ends(&a.3), ends(&b.3));
    }
}

#[test]
fn turned_tools_cut_turned_bodies() {
    let cube = || {
        let bounds = Aabb { min: DVec3::splat(-6.0), max: DVec3::splat(6.0) };
        TriDexel::from_box(bounds, 0.3).unwrap()
    };
    let turn = |axis: CutAxis| -> crate::geom::Rigid {
        // Z to the tool axis, cyclic.
        let columns = match axis {
            CutAxis::PlusX => [DVec3::Y, DVec3::Z, DVec3::X],
            _ => [DVec3::Z, DVec3::X, DVec3::Y],
        };
        let rotation = glam::DMat3::from_cols(columns[0], columns[1], columns[2]);
        crate::geom::Rigid { rotation, translation: DVec3::ZERO }
    };
    let lift = crate::geom::Rigid::from_translation(DVec3::Z * 6.0);
    let mut upright = cube();
    let moves: Vec<CutMove> =
        mixed().into_iter().map(|m| CutMove { curve: m.curve.moved(&lift), ..m }).collect();
    let effects = cut(&mut upright, &tools(), &moves, &CutOptions::default(), &Silent).unwrap();
    for axis in [CutAxis::PlusX, CutAxis::PlusY] {
        let turn = turn(axis);
        let mut stock = cube();
        let moves: Vec<CutMove> = moves
            .iter()
            .map(|m| CutMove { curve: m.curve.moved(&turn), stance: Stance::Along(axis), ..m.clone() })
            .collect();
        let turned = cut(&mut stock, &tools(), &moves, &CutOptions::default(), &Silent).unwrap();
        for (a, b) in turned.iter().zip(&effects) {
            assert_eq!((a.removed, a.deepest), (b.removed, b.deepest));
            assert_eq!(a.first_contact.map(|p| turn.inverse().point(p.into()).to_array()), b.first_contact);
        }
        for along in Axis::ALL {
            let to = Axis::ALL[(along.index() + if axis == CutAxis::PlusX { 1 } else { 2 }) % 3];
            for (j, i) in (0..40).flat_map(|j| (0..40).map(move |i| (j, i))) {
                let (a, b) = (upright.line(along, i, j), stock.line(to, i, j));
                let ends =
                    |l: &[Interval]| l.iter().map(|i| (i.lo.at, i.hi.at, i.hi.cut)).collect::<Vec<_>>();
                assert_eq!(ends(a), ends(b), "{along:?} {i} {j}");
            }
        }
    }
}

#[test]
fn the_three_lines_through_a_point_agree_also_on_faces_in_the_lattice() {
    for axis in CutAxis::ALL {
        let bounds = Aabb { min: DVec3::splat(-4.0), max: DVec3::splat(4.0) };
        let mut stock = TriDexel::from_box(bounds, 0.5).unwrap();
        // Lattice points at 0.25 + 0.5 k: walls, floor and roof of the slots run through them.
        let (a, b) = axis.along().others();
        let at = |u: f64, v: f64, w: f64| {
            let mut p = axis.vector() * w;
            p[a.index()] = u;
            p[b.index()] = v;
            p
        };
        let slots = [
            Line { start: at(-6.0, 0.75, 1.25), end: at(6.0, 0.75, 1.25) },
            Line { start: at(1.25, -1.25, -0.75), end: at(1.25, 6.0, -0.75) },
            Line { start: at(-2.25, -2.25, 3.0), end: at(-2.25, -2.25, 0.25) },
        ];
        let moves = slots.map(|s| CutMove::new(s, axis, 0));
        run(&mut stock, &mill(2.0, 1.5), &moves);
        let lattice = *stock.lattice();
        let mut material = 0;
        for (i, j, k) in (0..16).flat_map(|i| (0..16).flat_map(move |j| (0..16).map(move |k| (i, j, k)))) {
            let index = [i, j, k];
            let inside = Axis::ALL.map(|along| {
                let (a, b) = along.others();
                let c = fixed(lattice.coordinate(along, index[along.index()]));
                let line = stock.line(along, index[a.index()], index[b.index()]);
                line.iter().any(|i| i.lo.at <= c && c < i.hi.at)
            });
            assert!(inside == [inside[0]; 3], "{axis:?} {index:?} {inside:?}");
            material += usize::from(inside[0]);
        }
        assert!(material > 3000 && material < 4000, "{material}");
    }
}

#[test]
fn contacts_are_told_apart() {
    let tool = ToolBody {
        cutting: Profile::cylinder(6.0, 5.0).unwrap(),
        edge: None,
        shank: vec![(Profile::cylinder(6.0, 10.0).unwrap(), 5.0)],
        holder: vec![(Profile::cylinder(20.0, 10.0).unwrap(), 15.0)],
    };
    let mut stock = block(60.0, 30.0, 30.0, 0.5);
    // Down in steps of the flute length, round and round: the shank rubs along the wall that was cut.
    let mut moves = Vec::new();
    for z in [-4.0, -8.0, -12.0] {
        moves.push(up(line([4.0, 0.0, z + 4.0], [4.0, 0.0, z])));
        moves.push(up(circle(4.0, z)));
    }
    moves.push(up(line([4.0, 0.0, -12.0], [4.0, 0.0, 5.0])));
    // And a rapid along the wall: the same line again.
    moves.push(up(line([4.0, 0.0, 5.0], [4.0, 0.0, -11.0])));
    let effects = run(&mut stock, &tool, &moves);
    assert!(effects.iter().all(|e| e.shank().is_none() && e.holder().is_none()), "{effects:?}");
    assert_eq!(effects[6].first_contact, None);
    assert_eq!(effects[7].first_contact, None);
    assert!((effects[1].deepest - 4.0).abs() < 1e-5);
    // The circle first meets material next to the hole of the plunge.
    let p = DVec3::from(effects[1].first_contact.unwrap());
    assert!((p.truncate().distance([4.0, 0.0].into()) - 3.0).abs() < 0.6 && p.z == 0.0, "{p}");

    // Deeper than the flutes are long, sideways: the shank meets 12 - 5 = 7 mm of the wall it has not cut.
    let slot = run(&mut stock, &tool, &[up(line([4.0, 0.0, -12.0], [20.0, 0.0, -12.0]))]);
    let BodyContact { depth, point, .. } = slot[0].shank().unwrap();
    assert!((depth - 7.0 + 1e-3).abs() < 1e-4, "{depth}");
    assert!(point[0].hypot(point[1]) > 6.9 && point[2] == 0.0, "{point:?}");
    assert_eq!(slot[0].holder(), None);

    // Deep into the open bore: the holder comes down on the top face.
    let mut other = stock.clone();
    let dive = up(line([0.0, 0.0, -10.0], [0.0, 0.0, -17.0]));
    let look = CutMove { removes: false, ..dive.clone() };
    let (found, kept) = (run(&mut other, &tool, &[look]), run(&mut stock, &tool, &[dive]));
    let holder = kept[0].holder().unwrap();
    assert!((holder.depth - 2.0 + 1e-3).abs() < 1e-4, "{holder:?}");
    assert_eq!((found[0].removed, found[0].holder()), (0.0, Some(holder)));
    // The core that the ring left standing: from the tip at -17 to the top of the edges at the start, -5.
    assert!((found[0].deepest - 12.0).abs() < 1e-5 && found[0].first_contact.is_some());
    assert!(kept[0].removed > 100.0);
}

#[test]
fn a_rising_shank_is_compared_with_what_it_passes() {
    // A cutter below an overhang that rises sideways: the edges come where the shank was, but later.
    let tool = ToolBody {
        cutting: Profile::cylinder(4.0, 3.0).unwrap(),
        edge: None,
        shank: vec![(Profile::cylinder(4.0, 20.0).unwrap(), 3.0)],
        holder: vec![],
    };
    let ramp = line([-20.0, 0.0, -8.0], [8.0, 0.0, -1.0]);
    let up_the_ramp = run(&mut block(20.0, 20.0, 8.0, 0.5), &tool, &[up(ramp)]);
    // At x the shank begins at the height of the tip + 3; entering at x = -10 the tip is at -5.5 +- 0.5.
    let depth = up_the_ramp[0].shank().unwrap().depth;
    assert!(depth > 2.5 && depth < 3.1, "{depth}");
}

#[test]
fn the_first_contact_of_a_drill_is_the_top() {
    let drill = ToolBody::new(Profile::cylinder(3.0, 30.0).unwrap());
    let mut stock = block(10.0, 10.0, 5.0, 0.25);
    let effects = run(&mut stock, &drill, &[up(line([0.1, 0.2, 10.0], [0.1, 0.2, -7.0]))]);
    let p = effects[0].first_contact.unwrap();
    assert_eq!(p[2], 0.0);
    assert!((effects[0].deepest - 5.0).abs() < 1e-9);
    assert!((effects[0].removed / (PI * 2.25 * 5.0) - 1.0).abs() < 0.02);
}

#[test]
fn wrong_input_is_refused_and_leaves_the_stock_alone() {
    struct Stop;
    impl Progress for Stop {
        fn stage(&self, _: &str, _: u64) {}
        fn advance(&self, _: u64) {}
        fn cancelled(&self) -> bool {
            true
        }
    }
    let mut stock = block(10.0, 10.0, 5.0, 0.5);
    let tool = mill(3.0, 10.0);
    let good = up(line([0.0, 0.0, -2.0], [5.0, 0.0, -2.0]));
    let mut refused = |m: CutMove, options: CutOptions| {
        let error =
            cut(&mut stock, std::slice::from_ref(&tool), &[good.clone(), m], &options, &Silent).unwrap_err();
        assert!((stock.volume() - 500.0).abs() < 1e-9);
        (error.code(), error.0.key.clone())
    };
    let options = CutOptions::default();
    let at = |key: &str| (Code::GEOMETRY, Some(key.to_owned()));
    assert_eq!(refused(CutMove { body: 1, ..good.clone() }, options), at("moves[1].body"));
    assert_eq!(refused(up(line([0.0; 3], [f64::NAN, 0.0, 0.0])), options), at("moves[1].curve"));
    assert_eq!(refused(up(line([0.0; 3], [1e9, 0.0, 0.0])), options), at("moves[1].curve"));
    let many = Arc::new(DVec3::X, DVec3::ZERO, DVec3::Z, 1e9, 1.0).unwrap();
    assert_eq!(refused(up(many), options), at("moves[1].curve"));
    assert_eq!(refused(good.clone(), CutOptions { path_tolerance: 0.0, ..options }), at("path_tolerance"));
    assert_eq!(refused(good.clone(), CutOptions { clearance: f64::NAN, ..options }), at("clearance"));
    let error = cut(&mut stock, &[tool], &[good], &options, &Stop).unwrap_err();
    assert_eq!(error.code(), Code::CANCELLED);
}

#[test]
fn any_moves_leave_sound_lines() {
    let mut random = Random(3);
    let mut stock = block(20.0, 20.0, 6.0, 0.4);
    let mut moves = Vec::new();
    for i in 0..300 {
        let p = |r: &mut Random| {
            let q = r.plane(12.0);
            DVec3::new(q.x, q.y, r.within(-6.0, 1.0))
        };
        let (a, b) = (p(&mut random), p(&mut random));
        let axis = CutAxis::ALL[i % 6];
        let curve: Curve = match i % 4 {
            0 => Line { start: a, end: b }.into(),
            1 => Line { start: a, end: a }.into(),
            _ => {
                let (sweep, rise) =
                    (random.within(-9.0, 9.0), if i % 3 == 0 { 0.0 } else { random.within(-2.0, 2.0) });
                Arc::new(a, b, axis.vector(), sweep, rise).unwrap().into()
            }
        };
        moves.push(CutMove { body: (i % 2) as u32, ..CutMove::new(curve, axis, 0) });
    }
    let thin =
        [mill(0.7, 1.2), ToolBody { cutting: Profile::bull_nose(0.9, 0.3, 1.0).unwrap(), ..mill(1.0, 1.0) }];
    let effects = cut(&mut stock, &thin, &moves, &CutOptions::default(), &Silent).unwrap();
    assert!(effects.iter().all(|e| e.removed.is_finite() && e.removed >= 0.0));
    let mut most = 0;
    for (.., line) in lines(&stock) {
        assert!(line.iter().all(|i| i.lo.at < i.hi.at));
        assert!(line.windows(2).all(|w| w[0].hi.at < w[1].lo.at));
        most = most.max(line.len());
    }
    assert!(most > 4, "{most}");
    let v = stock.volumes();
    assert!((v[0] / v[1] - 1.0).abs() < 0.01 && (v[0] / v[2] - 1.0).abs() < 0.01, "{v:?}");
}
