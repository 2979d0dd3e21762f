//! Drills whose edge leaves a core or a nub. The reference is the union of densely sampled poses of points (r, z) of
//! the edge, by formulas of its own.

use std::f64::consts::PI;

use glam::DVec3;

use crate::base::{Code, Silent};
use crate::geom::{Aabb, Curve, EdgeProfile, Line, Profile};
use crate::stock::cut::{CutAxis, CutMove, CutOptions, MoveEffect, SweptFace, ToolBody, cut};
use crate::stock::surface::{SurfaceOptions, surface};
use crate::stock::tri_dexel::LINE_OFFSET;
use crate::stock::{Axis, DexelGrid, TriDexel, unfixed};
use crate::sweep::ToolMotion;
use crate::tool::{DrillPoint, StepStage, filled};

const TOP: f64 = 40.0;

fn deg(a: f64) -> f64 {
    a.to_radians()
}

/// All kinds of points, of a diameter of 8 mm, and some more that leave something.
fn points() -> Vec<DrillPoint> {
    let pilot = StepStage { diameter: 3.0, length: 2.5, shoulder: deg(90.0) };
    vec![
        DrillPoint::SinglePlane { angle: deg(118.0) },
        DrillPoint::DoubleGround { angle: deg(118.0), second: deg(70.0) },
        DrillPoint::CastIron { angle: deg(118.0), second: deg(70.0), third: deg(55.0), slot: 0.6 },
        DrillPoint::Rounded { radius: 5.0 },
        DrillPoint::CornerRadius { angle: deg(118.0), radius: 1.0 },
        DrillPoint::ThinnedWeb { angle: deg(118.0), flat: 0.8 },
        DrillPoint::SlottedChisel { angle: deg(118.0), slot: 0.7 },
        DrillPoint::Annular { core: 4.6 },
        DrillPoint::Flat,
        DrillPoint::Cannon { overlap: 0.9, edge_angle: deg(60.0) },
        DrillPoint::Gun { apex: Some(2.0), outer_angle: deg(60.0), inner_angle: deg(50.0) },
        DrillPoint::Auger { angle: deg(120.0) },
        DrillPoint::Ejector { angle: deg(140.0) },
        DrillPoint::Cone { angle: deg(90.0), nose: 3.0 },
        DrillPoint::Stepped { angle: deg(120.0), stages: vec![pilot] },
        DrillPoint::Gun { apex: Some(4.0), outer_angle: deg(60.0), inner_angle: deg(45.0) },
    ]
}

/// A valley between two ridges: an arc that falls and rises, a step down, a cone.
fn valley() -> EdgeProfile {
    use crate::geom::EdgeSegment::{Arc, Line};
    EdgeProfile::new(&[
        Line { r: [0.5, 1.0], z: [0.2, 1.1] },
        Arc { r: [1.0, 2.6], centre: [2.0, 2.5], radius: 2.5 },
        Line { r: [2.6, 4.0], z: [0.7, 1.0] },
    ])
    .unwrap()
}

#[test]
fn a_spared_edge_takes_no_more_than_it_surely_does() {
    use crate::stock::cut::{CutList, Spared, cut_list};
    let bounds = Aabb { min: DVec3::new(-8.0, -8.0, -10.0), max: DVec3::new(8.0, 8.0, 0.0) };
    let needle = ToolBody::new(Profile::cylinder(0.3, TOP).unwrap());
    let bodies: Vec<ToolBody> = points()
        .iter()
        .map(|point| body(&point.edge(8.0).unwrap()))
        .chain([body(&valley()), needle])
        .collect();
    let ends = [DVec3::new(0.0, 0.0, 2.0), DVec3::new(0.0, 0.0, -7.0), DVec3::new(3.0, 0.0, -7.0)];
    let lean = DVec3::new(0.2, 0.1, 1.0).normalize_or_zero();
    for leaning in [false, true] {
        for (i, own) in bodies.iter().enumerate() {
            let lines = ends.windows(2).map(|pair| Line { start: pair[0], end: pair[1] });
            let moves: Vec<CutMove> = lines
                .map(|line| match leaning {
                    true => CutMove::leaning(ToolMotion::fixed(line.into(), lean).unwrap(), line, 0),
                    false => CutMove::new(line, CutAxis::PlusZ, 0),
                })
                .collect();
            let left = |spared: Spared| {
                let mut stock = TriDexel::from_box(bounds, 0.5).unwrap();
                let body = std::slice::from_ref(own);
                let list =
                    CutList::sparing(body, &[spared], moves.clone(), &CutOptions::default(), 0.5).unwrap();
                cut_list(&mut stock, &list, 0..moves.len(), &Silent).unwrap();
                stock.volume()
            };
            let (all, some) = (left(Spared::NOTHING), left(Spared { around: 0.2, along: 0.3 }));
            assert!(some >= all, "{i} {leaning}: {some} {all}");
            // Nothing is left of a needle, and of an edge around a core nothing is sure.
            let nothing = i == bodies.len() - 1 || own.edge.is_some_and(|edge| edge.inner_radius() > 0.0);
            assert!((some == 2560.0) == nothing, "{i} {leaning}: {some}");
        }
    }
}

fn body(edge: &EdgeProfile) -> ToolBody {
    ToolBody { edge: Some(*edge), ..ToolBody::new(filled(edge, TOP).unwrap()) }
}

fn block() -> Aabb {
    Aabb { min: DVec3::new(-5.0, -5.2, -5.4), max: DVec3::new(5.6, 5.3, 5.1) }
}

/// Cuts a block along a direction through `through` with tips from one height along the axis to another.
fn drilled(
    edge: &EdgeProfile,
    n: DVec3,
    through: DVec3,
    heights: [f64; 2],
    step: f64,
) -> (TriDexel, MoveEffect) {
    let mut stock = TriDexel::from_box(block(), step).unwrap();
    let on_axis = through - n * through.dot(n);
    let way = Line { start: on_axis + n * heights[0], end: on_axis + n * heights[1] };
    let options = CutOptions { first_cut: 6, ..CutOptions::default() };
    let moves = [match CutAxis::of(n) {
        Some(axis) => CutMove::new(way, axis, 0),
        None => CutMove::leaning(ToolMotion::fixed(way.into(), n).unwrap(), way, 0),
    }];
    let effect = cut(&mut stock, &[body(edge)], &moves, &options, &Silent).unwrap().swap_remove(0);
    (stock, effect)
}

/// Height of the edge at a radius from its definition as a list of points, lowest at a step.
fn z_of(edge: &EdgeProfile, r: f64) -> Option<f64> {
    edge.height(r)
}

/// True if a point is in the union of the poses: of all tips in the range there is one whose edge lies at or below.
fn inside(edge: &EdgeProfile, r: f64, w: f64, tips: [f64; 2]) -> bool {
    // The lowest pose is one of them, and the others overlap.
    const POSES: u32 = 32;
    let Some(z) = z_of(edge, r) else { return false };
    (0..=POSES).any(|i| {
        let tip = tips[0] + (tips[1] - tips[0]) * f64::from(i) / f64::from(POSES);
        tip + z <= w && w <= tip + TOP
    })
}

/// Compares points along all lines with the poses, and ends with the edge; returns how many ends were compared.
fn compare(edge: &EdgeProfile, n: DVec3, through: DVec3, heights: [f64; 2], step: f64) -> usize {
    /// Ends are rounded to 5 nm; across a slope of a ridge of the edge that is drawn out.
    const CLOSE: f64 = 2e-5;
    let (stock, _) = drilled(edge, n, through, heights, step);
    let lattice = *stock.lattice();
    let lowest = if heights[0] < heights[1] { heights[0] } else { heights[1] };
    let mut compared = 0;
    for along in Axis::ALL {
        let (a, b) = along.others();
        for j in 0..lattice.counts[b.index()] {
            for i in 0..lattice.counts[a.index()] {
                let mut p = DVec3::ZERO;
                p[a.index()] = lattice.coordinate(a, i) + LINE_OFFSET;
                p[b.index()] = lattice.coordinate(b, j) + LINE_OFFSET;
                let polar = |at: f64| {
                    let mut p = p;
                    p[along.index()] = at;
                    let (v, w) = (p - through, p.dot(n));
                    ((v - n * v.dot(n)).length(), w)
                };
                let line = stock.line(along, i, j);
                let material = |at: f64| line.iter().any(|i| unfixed(i.lo.at) <= at && at < unfixed(i.hi.at));
                let (lo, hi) = (block().min[along.index()], block().max[along.index()]);
                for k in 0..40 {
                    let at = lo + (hi - lo) * (f64::from(k) + 0.317) / 40.0;
                    let (r, w) = polar(at);
                    let wanted = !inside(edge, r, w, heights);
                    // Near to the boundary rounding may decide.
                    let sure = [(CLOSE, 0.0), (-CLOSE, 0.0), (0.0, CLOSE), (0.0, -CLOSE)]
                        .iter()
                        .all(|d| wanted != inside(edge, (r + d.0).abs(), w + d.1, heights));
                    assert!(
                        !sure || material(at) == wanted,
                        "{edge:?} {n} {along:?} r {r} w {w} tip {lowest}: {}",
                        material(at)
                    );
                }
                for end in line.iter().flat_map(|i| [i.lo, i.hi]).filter(|e| e.cut != 0) {
                    assert_eq!(end.cut, 7);
                    let at = unfixed(end.at);
                    let (r, w) = polar(at);
                    let of = |dr: f64, dw: f64| inside(edge, (r + dr).abs(), w + dw, heights);
                    let here = of(0.0, 0.0);
                    assert!(
                        [(CLOSE, 0.0), (-CLOSE, 0.0), (0.0, CLOSE), (0.0, -CLOSE)]
                            .iter()
                            .any(|d| of(d.0, d.1) != here),
                        "no boundary at r {r} w {w} of {edge:?} {n} {along:?}"
                    );
                    let mut q = p;
                    q[along.index()] = at;
                    let gone = |q: DVec3| {
                        let v = q - through;
                        inside(edge, (v - n * v.dot(n)).length(), q.dot(n), heights)
                    };
                    normal_points_into_the_void(end.normal.normal(), q, gone);
                    compared += 1;
                }
            }
        }
    }
    compared
}

/// A little way along the normal there is nothing left, a little way against it there is material.
fn normal_points_into_the_void(normal: DVec3, q: DVec3, gone: impl Fn(DVec3) -> bool) {
    const WAY: f64 = 2e-3;
    // At the corners of the section there is no one normal: where the sides of a little cross disagree, skip.
    let around = |way: f64| {
        let t = normal.any_orthonormal_pair();
        [t.0, -t.0, t.1, -t.1].iter().all(|t| gone(q + normal * way + *t * WAY) == gone(q + normal * way))
    };
    if around(WAY * 1.5) && around(-WAY * 1.5) {
        assert!(gone(q + normal * WAY * 1.5), "normal {normal} at {q}");
        assert!(!gone(q - normal * WAY * 1.5), "normal {normal} at {q}");
    }
}

#[test]
fn all_points_blind_and_through_along_all_axes_are_the_union_of_their_poses() {
    let mut edges: Vec<EdgeProfile> = points().iter().map(|p| p.edge(8.0).unwrap()).collect();
    edges.push(valley());
    let mut compared = 0;
    for (k, edge) in edges.iter().enumerate() {
        let axis = CutAxis::ALL[k % 6];
        let through = DVec3::new(0.31, -0.17, 0.23);
        // Blind from above; through; out of the depth upwards.
        compared += compare(edge, axis.vector(), through, [6.0, 0.3], 0.83);
        compared += compare(edge, CutAxis::ALL[(k + 1) % 6].vector(), through, [6.0, -12.0], 0.91);
        compared += compare(edge, CutAxis::ALL[(k + 4) % 6].vector(), through, [-1.0, 7.0], 0.97);
    }
    for axis in CutAxis::ALL {
        let gun = DrillPoint::Gun { apex: Some(2.0), outer_angle: deg(60.0), inner_angle: deg(50.0) };
        compared +=
            compare(&gun.edge(8.0).unwrap(), axis.vector(), DVec3::new(0.1, 0.2, -0.3), [6.0, 0.4], 0.67);
    }
    assert!(compared > 15_000, "{compared}");
}

#[test]
fn all_points_along_directions_that_lean_are_the_union_of_their_poses() {
    let mut edges: Vec<EdgeProfile> = points().iter().map(|p| p.edge(8.0).unwrap()).collect();
    edges.push(valley());
    let through = DVec3::new(0.31, -0.17, 0.23);
    let mut compared = 0;
    for (k, edge) in edges.iter().enumerate() {
        let round = k as f64 * 0.37;
        let lean = DVec3::new(0.5 * round.cos(), 0.5 * round.sin(), 0.75f64.sqrt());
        let n = [lean, DVec3::new(lean.z, lean.x, lean.y), -lean][k % 3];
        compared += compare(edge, n, through, [6.0, 0.3], 0.83);
        compared += compare(edge, n, through, [-1.0, 7.0], 0.97);
        let (_, effect) = drilled(edge, n, through, [6.0, 0.3], 0.83);
        assert!(!effect.as_filled && effect.removed > 50.0, "{effect:?}");
        let inner = edge.inner_radius();
        assert!(effect.core().is_some() || inner < 1.0, "{edge:?}");
        assert!(effect.core().is_none() || inner > 0.0, "{edge:?}");
    }
    assert!(compared > 8_000, "{compared}");
}

#[test]
fn a_way_that_lies_beside_the_axis_by_rounding_is_one_along_it_and_its_error_is_told() {
    let edge = DrillPoint::Annular { core: 4.6 }.edge(8.0).unwrap();
    let axis = DVec3::new(0.0, -0.6, 0.8);
    // Coordinates to a micrometre, and a way that is five times as far off as these explain.
    for (off, filled) in [(0.0007, false), (0.01, true)] {
        let way = Line { start: axis * 9.0 + DVec3::X * off, end: DVec3::ZERO };
        let one = CutMove::leaning(ToolMotion::fixed(way.into(), axis).unwrap(), way, 0);
        let mut stock = TriDexel::from_box(block(), 0.4).unwrap();
        let effect = &cut(&mut stock, &[body(&edge)], &[one], &CutOptions::default(), &Silent).unwrap()[0];
        assert_eq!((effect.as_filled, effect.core().is_some()), (filled, !filled), "{effect:?}");
        assert!(filled || (effect.path_error - off).abs() < 1e-4, "{effect:?}");
    }
}

/// Volume left within the diameter of a blind hole, compared with the filled body cut the same way.
fn left_standing(point: &DrillPoint, heights: [f64; 2]) -> [f64; 3] {
    let edge = point.edge(8.0).unwrap();
    let (stock, effect) = drilled(&edge, DVec3::Z, DVec3::ZERO, heights, 0.1);
    let mut full = TriDexel::from_box(block(), 0.1).unwrap();
    let before = full.volumes();
    let way = Line { start: DVec3::Z * heights[0], end: DVec3::Z * heights[1] };
    let tool = ToolBody::new(filled(&edge, TOP).unwrap());
    cut(&mut full, &[tool], &[CutMove::new(way, CutAxis::PlusZ, 0)], &CutOptions::default(), &Silent)
        .unwrap();
    assert!((before[2] - stock.volume() - effect.removed).abs() < 1e-6);
    [0, 1, 2].map(|i| stock.volumes()[i] - full.volumes()[i])
}

#[test]
fn cores_and_nubs_have_their_volumes() {
    // The nub of a gun drill: a cone of the apex' radius.
    let (apex, inner) = (2.0, deg(50.0));
    let gun = DrillPoint::Gun { apex: Some(apex), outer_angle: deg(60.0), inner_angle: inner };
    let nub = PI * apex * apex * apex / inner.tan() / 3.0;
    // The core of an annular drill: a cylinder as high as the hole is deep.
    let core = PI * 2.3 * 2.3 * 5.1;
    // Through the block it remains over the whole height.
    let through = PI * 2.3 * 2.3 * 10.5;
    // A lip that passes the axis by e at k = cot a: a nub e k high below a step of 2 e k.
    let (e, k) = (0.9, deg(60.0).tan().recip());
    let dome = PI * e * e * (e * k) / 3.0;
    let annular = DrillPoint::Annular { core: 4.6 };
    let cannon = DrillPoint::Cannon { overlap: e, edge_angle: deg(60.0) };
    for (point, heights, volume) in [
        (gun, [6.0, 0.0], nub),
        (annular.clone(), [6.0, 0.0], core),
        (annular, [6.0, -6.0], through),
        (cannon, [6.0, 0.0], dome),
    ] {
        for v in left_standing(&point, heights) {
            assert!((v / volume - 1.0).abs() < 0.01, "{point:?}: {v} {volume}");
        }
    }
}

#[test]
fn the_surface_of_a_blind_hole_shows_the_nub() {
    let gun = DrillPoint::Gun { apex: Some(2.0), outer_angle: deg(60.0), inner_angle: deg(50.0) };
    let (stock, _) = drilled(&gun.edge(8.0).unwrap(), DVec3::Z, DVec3::ZERO, [6.0, 0.0], 0.25);
    let mesh = surface(&stock, &SurfaceOptions::default(), &Silent).unwrap();
    let summit = 2.0 / deg(50.0).tan();
    // The summit of the nub lies on the axis, and its foot is a circle of the apex' radius at the height 0.
    let near = |r: f64, z: f64| {
        mesh.vertices.iter().map(|v| (v.truncate().length() - r).hypot(v.z - z)).fold(f64::INFINITY, f64::min)
    };
    assert!(near(0.0, summit) < 0.05, "{}", near(0.0, summit));
    assert!(near(2.0, 0.0) < 0.03, "{}", near(2.0, 0.0));
    // Between them the vertices lie on the cone; nearer to the axis than two steps the summit is rounded a little.
    let on_nub = |v: &&DVec3| (0.5..1.8).contains(&v.truncate().length()) && v.z > -1.0;
    let above = |v: &DVec3| v.z - (2.0 - v.truncate().length()) / deg(50.0).tan();
    let off: Vec<f64> = mesh.vertices.iter().filter(on_nub).map(|v| above(v).abs()).collect();
    let worst = off.iter().copied().fold(0.0, f64::max);
    assert!(off.len() > 100 && worst < 0.02, "{} {worst}", off.len());
    // Block less cylinder, with the nub and what the outer edge leaves under it: 2 pi r z(r) over the radius.
    let size = block().size();
    let cot = |a: f64| deg(a).tan().recip();
    let below = 2.0 * PI * (cot(50.0) * (4.0 - 8.0 / 3.0) + cot(60.0) * (20.0 / 3.0));
    let exact = size.element_product() - PI * 16.0 * block().max.z + below;
    assert!((mesh.volume() / exact - 1.0).abs() < 5e-4, "{} {exact}", mesh.volume());
}

#[test]
fn a_second_pass_finds_nothing_and_what_stands_inside_is_told() {
    let edge = DrillPoint::Annular { core: 4.6 }.edge(8.0).unwrap();
    let mut stock = TriDexel::from_box(block(), 0.3).unwrap();
    let line = |from: f64, to: f64| -> Curve {
        Line { start: DVec3::new(0.1, 0.2, from), end: DVec3::new(0.1, 0.2, to) }.into()
    };
    let moves = [line(7.0, 1.0), line(1.0, 7.0), line(7.0, 1.1), line(1.1, 0.5)]
        .map(|curve| CutMove::new(curve, CutAxis::PlusZ, 0));
    let effects = cut(&mut stock, &[body(&edge)], &moves, &CutOptions::default(), &Silent).unwrap();
    assert!((effects[0].deepest - 4.1).abs() < 1e-4);
    let first = effects[0].first_contact.unwrap();
    assert!((first[2] - 5.1).abs() < 1e-4);
    let r = (first[0] - 0.1).hypot(first[1] - 0.2);
    assert!(r > 2.3 && r < 4.0, "{r}");
    for (i, depth) in [(0, 4.1), (1, 4.1), (2, 4.0), (3, 4.6)] {
        let core = effects[i].core().unwrap();
        assert!((core.depth - depth).abs() < 0.01, "{i}: {core:?}");
        assert!((core.point[0] - 0.1).hypot(core.point[1] - 0.2) < 2.3);
    }
    for effect in &effects[1..3] {
        assert_eq!((effect.removed, effect.deepest, effect.first_contact), (0.0, 0.0, None));
    }
    assert!((effects[3].deepest - 0.5).abs() < 1e-4 && !effects.iter().any(|e| e.as_filled));
}

#[test]
fn a_hollow_drill_that_moves_sideways_is_cut_as_filled_and_that_is_told() {
    let edge = DrillPoint::Annular { core: 4.6 }.edge(8.0).unwrap();
    let side = Line { start: DVec3::new(-3.0, 0.0, 4.0), end: DVec3::new(3.0, 0.0, 4.0) };
    let above = Line { start: DVec3::new(3.0, 0.0, 6.0), end: DVec3::new(-3.0, 0.0, 6.0) };
    let moves = [above, side].map(|l| CutMove::new(l, CutAxis::PlusZ, 0));
    let run = |tool: ToolBody| {
        let mut stock = TriDexel::from_box(block(), 0.4).unwrap();
        let effects = cut(&mut stock, &[tool], &moves, &CutOptions::default(), &Silent).unwrap();
        (stock.volumes(), effects)
    };
    let (volumes, effects) = run(body(&edge));
    let (solid, _) = run(ToolBody::new(Profile::cylinder(8.0, TOP).unwrap()));
    assert_eq!(volumes, solid);
    assert_eq!([effects[0].as_filled, effects[1].as_filled], [false, true]);
    // A twist drill is its own filled body: nothing to tell.
    let twist = DrillPoint::SinglePlane { angle: deg(118.0) }.edge(8.0).unwrap();
    assert!(run(body(&twist)).1.iter().all(|e| !e.as_filled));
}

#[test]
fn an_edge_that_leaves_its_body_is_refused() {
    let edge = DrillPoint::Annular { core: 4.6 }.edge(8.0).unwrap();
    let tool = ToolBody { edge: Some(edge), ..ToolBody::new(Profile::cylinder(7.0, 20.0).unwrap()) };
    let mut stock = TriDexel::from_box(block(), 1.0).unwrap();
    let error = cut(&mut stock, &[tool], &[], &CutOptions::default(), &Silent).unwrap_err();
    assert_eq!((error.code(), error.0.key.as_deref()), (Code::GEOMETRY, Some("bodies[0].edge")));
}

#[test]
fn the_walls_of_core_and_hole_are_two_faces() {
    let edge = DrillPoint::Annular { core: 4.6 }.edge(8.0).unwrap();
    let (stock, _) = drilled(&edge, DVec3::NEG_Y, DVec3::ZERO, [6.0, 0.0], 0.4);
    let lattice = *stock.lattice();
    let mut counts = [0; 2];
    for j in 0..lattice.counts[1] {
        for i in 0..lattice.counts[0] {
            for end in stock.line(Axis::Z, i, j).iter().flat_map(|i| [i.lo, i.hi]).filter(|e| e.cut != 0) {
                let x = lattice.coordinate(Axis::X, i);
                let r = x.hypot(unfixed(end.at));
                let core = (r - 2.3).abs() < 1e-4;
                assert!(core || (r - 4.0).abs() < 1e-4, "{r}");
                let face = SweptFace::of_class(end.normal.class());
                assert_eq!(face, Some(if core { SweptFace::WallStart } else { SweptFace::WallEnd }));
                counts[usize::from(core)] += 1;
            }
        }
    }
    assert!(counts[0] > 400 && counts[1] > 200, "{counts:?}");
}
