//! Every end that a move leaves lies on the boundary of the union of poses, and what lies between is inside or
//! outside as it should be.

use glam::DVec3;

use super::reference::{Random, Shape, Swept};
use crate::base::Silent;
use crate::geom::{Aabb, Arc, Curve, InvoluteRecord, Line};
use crate::stock::cut::{CutAxis, CutMove, CutOptions, ToolBody, cut};
use crate::stock::tri_dexel::LINE_OFFSET;
use crate::stock::{Axis, DexelGrid, TriDexel, unfixed};

/// Ends are rounded to 5 nm; the rest is left to the reference's own search [mm].
pub(super) const CLOSE: f64 = 2e-5;

pub(super) const SHAPES: [Shape; 7] = [
    Shape::Flat { r: 3.0, top: 9.0 },
    Shape::Bull { r: 3.0, corner: 3.0, top: 9.0 },
    Shape::Bull { r: 3.0, corner: 1.0, top: 9.0 },
    Shape::Cone { r0: 0.0, r1: 3.0, h: 1.8, top: 9.0 },
    Shape::Cone { r0: 1.0, r1: 2.0, h: 6.0, top: 9.0 },
    Shape::Cone { r0: 1.0, r1: 4.0, h: 0.6, top: 7.0 },
    Shape::Stepped { pilot: 1.2, step: 1.5, r: 3.0, corner: 1.0, top: 9.0 },
];

pub(super) fn block() -> Aabb {
    Aabb { min: DVec3::new(-8.0, -8.0, -7.0), max: DVec3::new(8.0, 8.0, 0.0) }
}

/// Cuts a block with one upright move and compares all lines; returns how many ends were compared.
fn compare(shape: Shape, curve: Curve, axis: CutAxis, step: f64, close: f64) -> usize {
    let swept = Swept::new(shape, curve.clone(), axis.vector());
    compare_move(shape, CutMove::new(curve, axis, 0), &swept, step, close)
}

/// Cuts a block with one move and compares all lines with what is swept; returns how many ends were compared.
pub(super) fn compare_move(shape: Shape, one: CutMove, swept: &Swept, step: f64, close: f64) -> usize {
    let mut stock = TriDexel::from_box(block(), step).unwrap();
    let tool = ToolBody::new(shape.profile());
    let options = CutOptions { first_cut: 41, ..CutOptions::default() };
    let (curve, axis) = (one.curve.clone(), one.stance.clone());
    cut(&mut stock, &[tool], &[one], &options, &Silent).unwrap();
    let lattice = *stock.lattice();
    let mut compared = 0;
    for along in Axis::ALL {
        let (a, b) = along.others();
        for j in 0..lattice.counts[b.index()] {
            for i in 0..lattice.counts[a.index()] {
                let mut p = DVec3::ZERO;
                p[a.index()] = lattice.coordinate(a, i) + LINE_OFFSET;
                p[b.index()] = lattice.coordinate(b, j) + LINE_OFFSET;
                let at_point = |at: f64| {
                    let mut p = p;
                    p[along.index()] = at;
                    p
                };
                let line = stock.line(along, i, j);
                for end in line.iter().flat_map(|i| [i.lo, i.hi]).filter(|e| e.cut != 0) {
                    assert_eq!(end.cut, 42);
                    let q = at_point(unfixed(end.at));
                    let d = swept.distance(q);
                    assert!(d.abs() < close, "end off by {d}: {shape:?} {curve:?} {axis:?} {along:?} {q}");
                    if compared % 8 == 0 {
                        let case = || format!("{shape:?} {curve:?} {axis:?} {end:?}");
                        check_normal(|q| swept.distance(q), q, end.normal.normal(), case);
                    }
                    compared += 1;
                }
                let bounds = block();
                let steps = 5;
                let (lo, hi) = (bounds.min[along.index()], bounds.max[along.index()]);
                for k in 0..steps {
                    let at = lo + (hi - lo) * (f64::from(k) + 0.313) / f64::from(steps);
                    let material = line.iter().any(|i| unfixed(i.lo.at) <= at && at < unfixed(i.hi.at));
                    let q = at_point(at);
                    assert_ne!(
                        Some(material),
                        swept.holds(q, close),
                        "{shape:?} {curve:?} {axis:?} {along:?} {q} {:?}",
                        swept.distance(q)
                    );
                }
            }
        }
    }
    compared
}

/// Compares a stored normal with the falling direction of the field, where the field is smooth.
fn check_normal(field: impl Fn(DVec3) -> f64, p: DVec3, normal: DVec3, case: impl Fn() -> String) {
    let gradient = |e: f64| {
        let d = |v: DVec3| (field(p + v * e) - field(p)) / e;
        DVec3::new(d(DVec3::X), d(DVec3::Y), d(DVec3::Z))
    };
    let (forth, back) = (gradient(1e-3), gradient(-1e-3));
    let mean = 0.5 * (forth + back);
    // At an edge of the removed body, or where the reference is no smooth function, there is no one normal.
    if (forth - back).length() > 0.02 * mean.length() {
        return;
    }
    let cos = -mean.dot(normal) / mean.length();
    assert!(cos > 0.999_9, "normal {normal} against {mean} at {p}: {}", case());
}

fn random_axis(random: &mut Random) -> CutAxis {
    // Upright most of the time; the frames have a test of their own.
    if random.unit() < 0.6 { CutAxis::PlusZ } else { CutAxis::ALL[(random.unit() * 6.0) as usize] }
}

/// A point that the tool reaches, given as u, v across the axis and its depth.
fn point(axis: CutAxis, u: f64, v: f64, depth: f64) -> DVec3 {
    let n = axis.vector();
    let (a, b) = axis.along().others();
    let mut p = n * -depth;
    p[a.index()] = u;
    p[b.index()] = v;
    // The block reaches from -7 to 0 along Z and from -8 to 8 along X and Y.
    match axis {
        CutAxis::PlusZ => p,
        CutAxis::MinusZ => p - DVec3::Z * 7.0,
        CutAxis::PlusX | CutAxis::MinusX => p + n * 8.0 - DVec3::Z * 3.5,
        CutAxis::PlusY | CutAxis::MinusY => p + n * 8.0 - DVec3::Z * 3.5,
    }
}

#[test]
fn lines_level_sloping_and_upright() {
    let mut random = Random(7);
    let mut compared = 0;
    for shape in SHAPES {
        for fall in [0.0, 0.0, 0.3, -0.8, 2.0, -4.0] {
            let axis = random_axis(&mut random);
            let (a, b) = (random.plane(5.0), random.plane(5.0));
            let depth = random.within(1.0, 3.5);
            let line = Line { start: point(axis, a.x, a.y, depth), end: point(axis, b.x, b.y, depth + fall) };
            compared += compare(shape, line.into(), axis, 1.1, CLOSE);
        }
        let axis = random_axis(&mut random);
        let a = random.plane(4.0);
        let plunge = Line { start: point(axis, a.x, a.y, -1.0), end: point(axis, a.x, a.y, 3.0) };
        compared += compare(shape, plunge.into(), axis, 1.1, CLOSE);
        compared += compare(shape, Curve::from(plunge).reversed(), axis, 1.1, CLOSE);
        let along = Line { start: point(axis, a.x, -6.0, 2.0), end: point(axis, a.x, 6.0, 2.5) };
        compared += compare(shape, along.into(), axis, 1.1, CLOSE);
        let steep = Line { start: point(axis, a.x, a.y, 0.2), end: point(axis, a.x + 0.4, a.y - 0.2, 4.0) };
        compared += compare(shape, steep.into(), axis, 1.1, CLOSE);
    }
    assert!(compared > 5_000, "{compared}");
}

#[test]
fn arcs_and_helices() {
    let mut random = Random(11);
    let mut compared = 0;
    for shape in SHAPES {
        for (radius, sweep, rise) in [
            (4.0, 2.5, 0.0),
            (1.5, -4.0, 0.0),
            (4.0, 6.5, 0.0),
            (4.0, -3.0, -1.0),
            (1.5, 5.0, 1.2),
            (2.5, 9.0, -2.5),
            (0.4, -12.0, -2.0),
        ] {
            let axis = random_axis(&mut random);
            let c = random.plane(3.0);
            let (sin, cos) = random.within(0.0, 6.3).sin_cos();
            let depth = if rise > 0.0 { random.within(2.5, 4.0) } else { random.within(0.8, 1.5) };
            let start = point(axis, c.x + radius * cos, c.y + radius * sin, depth);
            let arc = Arc::new(start, point(axis, c.x, c.y, 0.0), axis.vector(), sweep, rise).unwrap();
            compared += compare(shape, arc.into(), axis, 1.3, CLOSE);
        }
    }
    assert!(compared > 3_000, "{compared}");
}

#[test]
fn involutes_and_tilted_arcs_are_within_the_path_tolerance() {
    // Tolerance 0.25 um, and what rounding adds.
    let close = CutOptions::default().path_tolerance + CLOSE;
    let record = InvoluteRecord::new(30.0, [0.5, -0.5], 0.3, 0.0, 5.0).unwrap();
    for shape in [SHAPES[0], SHAPES[1]] {
        for curve in [
            Curve::involute(record, -2.0, 0.0),
            Curve::involute(record.mirrored(), -2.0, -0.5),
            Arc::new(
                DVec3::new(4.0, 0.0, -2.0),
                DVec3::new(0.0, 0.0, -2.0),
                DVec3::new(0.2, 0.0, 1.0),
                2.0,
                0.0,
            )
            .unwrap()
            .into(),
        ] {
            compare(shape, curve, CutAxis::PlusZ, 1.3, close);
        }
    }
}
