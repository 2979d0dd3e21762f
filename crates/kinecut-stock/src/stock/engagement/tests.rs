//! Against closed forms of the drilling spec, evaluated here, and a count over a dense polar grid.

use std::f64::consts::PI;

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use crate::base::Silent;
use crate::geom::{Aabb, Line, Mesh, Profile};
use crate::stock::TriDexel;
use crate::stock::cut::{CutMove, CutOptions, ToolBody, cut};

fn plate(thickness: f64, step: f64) -> TriDexel {
    let bounds = Aabb { min: DVec3::new(-7.0, -7.0, -thickness), max: DVec3::new(7.0, 7.0, 0.0) };
    TriDexel::from_box(bounds, step).unwrap()
}

fn cone(radius: f64, length: f64) -> EdgeProfile {
    EdgeProfile::polyline(&[[0.0, 0.0], [radius, length]]).unwrap()
}

fn kinds(engagement: &PointEngagement) -> Vec<Engaged> {
    engagement.stages().iter().map(|s| s.engaged).collect()
}

/// Heights of first contact, full engagement, break-through and end.
fn borders(engagement: &PointEngagement) -> [f64; 4] {
    use Engaged::{Fully, Partly};
    let stages = engagement.stages();
    assert_eq!(kinds(engagement), [Partly, Fully, Partly]);
    [stages[0].from, stages[1].from, stages[1].to, stages[2].to]
}

/// The sampled border lies inside the exact one, by no more than the bound.
fn assert_within(found: [f64; 4], exact: [f64; 4], bound: f64, what: &str) {
    /// End points are fixed point, and a mesh has facets.
    const ROUND: f64 = 1e-3;
    for (i, inward) in [1.0, -1.0, 1.0, -1.0].into_iter().enumerate() {
        let miss = (exact[i] - found[i]) * inward;
        assert!(miss > -ROUND && miss < bound + ROUND, "{what} {i}: {found:?} {exact:?} {bound}");
    }
}

#[test]
fn a_cone_enters_a_plate_with_the_square_of_its_depth() {
    let (radius, length, thickness, step) = (5.0, 3.0, 8.0, 0.1);
    let engagement = point_engagement(
        &plate(thickness, step),
        &cone(radius, length),
        DVec3::new(0.02, 0.03, 9.0),
        CutAxis::PlusZ,
    );
    let area = engagement.columns() as f64 * engagement.column_area();
    assert!((area / (PI * radius * radius) - 1.0).abs() < 5e-3, "{area}");
    for i in 0..=60 {
        let z = -0.05 * f64::from(i);
        let exact = (z / length).powi(2).min(1.0);
        // Lines that a circle cuts off on one side only: its length times half a step.
        let slack = 2.0 * step / radius;
        assert!((engagement.share(z) - exact).abs() < slack, "{z} {} {exact}", engagement.share(z));
    }
    let bound = PointEngagement::sampling_error(length / radius, 0.0, step);
    assert_within(borders(&engagement), [0.0, -3.0, -8.0, -11.0], bound, "plate");
    assert_eq!(
        (engagement.first(), engagement.last()),
        (Some(borders(&engagement)[0]), Some(borders(&engagement)[3]))
    );
    assert_eq!([engagement.share(0.1), engagement.share(-5.0), engagement.share(-11.1)], [0.0, 1.0, 0.0]);
}

#[test]
fn a_flat_point_is_engaged_at_once() {
    let edge = EdgeProfile::polyline(&[[2.0, 0.0], [5.0, 0.0]]).unwrap();
    let engagement = point_engagement(&plate(4.0, 0.2), &edge, DVec3::ZERO, CutAxis::MinusZ);
    let stages = engagement.stages();
    assert_eq!(stages, [PointStage { from: 4.0, to: 0.0, engaged: Engaged::Fully }]);
    assert_eq!(engagement.height(DVec3::new(1.0, 2.0, -4.0)), 4.0);
    assert_eq!([engagement.share(4.0), engagement.share(0.0), engagement.share(4.001)], [1.0, 1.0, 0.0]);
    // Two steps of an edge whose step runs through columns: they are engaged at both heights.
    let step = EdgeProfile::polyline(&[[0.0, 0.0], [0.1, 0.0], [0.1, 9.0], [1.0, 9.0]]).unwrap();
    let on_step = DVec3::new(LINE_OFFSET + 0.1 - 0.1, LINE_OFFSET + 0.1, 0.0);
    let stock = plate(4.0, 0.2);
    let engagement = point_engagement(&stock, &step, on_step, CutAxis::PlusZ);
    assert_eq!(engagement.first(), Some(0.0));
    assert_eq!(kinds(&engagement), [Engaged::Partly, Engaged::Not, Engaged::Partly]);
}

#[test]
fn columns_beside_the_stock_are_air() {
    let engagement =
        point_engagement(&plate(8.0, 0.1), &cone(5.0, 3.0), DVec3::new(7.0, 0.0, 0.0), CutAxis::PlusZ);
    let inside = point_engagement(&plate(8.0, 0.1), &cone(5.0, 3.0), DVec3::ZERO, CutAxis::PlusZ);
    assert!((engagement.columns() as f64 / inside.columns() as f64 - 1.0).abs() < 1e-2);
    assert!((engagement.share(-5.0) - 0.5).abs() < 0.02, "{}", engagement.share(-5.0));
    assert_eq!(kinds(&engagement), [Engaged::Partly]);
    let far = point_engagement(&plate(8.0, 0.1), &cone(5.0, 3.0), DVec3::new(30.0, 0.0, 0.0), CutAxis::PlusZ);
    assert_eq!((far.first(), far.last(), far.stages(), far.share(0.0)), (None, None, vec![], 0.0));
    let nowhere = point_engagement(&plate(8.0, 0.1), &cone(5.0, 3.0), DVec3::NAN, CutAxis::PlusZ);
    assert_eq!((nowhere.columns(), nowhere.share(0.0)), (0, 0.0));
}

/// A box turned about Y, as a mesh.
fn tilted(angle: f64) -> Mesh {
    let (min, max) = (DVec3::new(-14.0, -5.0, -6.0), DVec3::new(14.0, 5.0, 0.0));
    let turn = glam::DMat3::from_rotation_y(-angle);
    let corner = |i: i32| turn * DVec3::select(glam::BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), max, min);
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
    Mesh { vertices: (0..8).map(corner).collect(), triangles }
}

#[test]
fn an_inclined_plane_is_met_tip_first_or_corner_first() {
    let (radius, length, step) = (4.0, 2.4, 0.15);
    for angle in [10.0f64, 25.0, 40.0] {
        let stock = TriDexel::from_mesh(&tilted(angle.to_radians()), step).unwrap();
        let t = angle.to_radians().tan();
        // The top passes through the origin; along the tool axis the underside lies 6 / cos below it.
        let first = if t * radius > length { t * radius - length } else { 0.0 };
        let last = -radius * t - length;
        let down = 6.0 / angle.to_radians().cos();
        let bound = PointEngagement::sampling_error(length / radius, t, step);
        let engagement =
            point_engagement(&stock, &cone(radius, length), DVec3::new(0.0, 0.04, 0.0), CutAxis::PlusZ);
        assert_within(borders(&engagement), [first, last, first - down, last - down], bound, "plane");
    }
}

#[test]
fn a_shaft_drilled_across_is_a_ridge_and_a_valley() {
    let (shaft, x, radius, length, step): (f64, f64, f64, f64, f64) = (12.0, 3.0, 4.0, 2.4, 0.1);
    let base = DVec3::new(1.0, 0.5, -9.0);
    let stock = TriDexel::from_cylinder(base, shaft, 18.0, step).unwrap();
    let f = |u: f64| (shaft * shaft - u * u).sqrt();
    // Tip first as 3 < 12 cos(59 deg); the valley's bottom generator lies within the rim.
    let exact = [f(x), f(x + radius) - length, -f(x), -shaft - length];
    let bound = PointEngagement::sampling_error(length / radius, (x + radius) / f(x + radius), step);
    for (axis, centre) in [(CutAxis::PlusX, 1.0), (CutAxis::MinusX, -1.0)] {
        let at = base + DVec3::new(0.0, x, 9.0);
        let engagement = point_engagement(&stock, &cone(radius, length), at, axis);
        assert_within(borders(&engagement), exact.map(|z| z + centre), bound, "across X");
    }
    for (axis, centre) in [(CutAxis::PlusY, 0.5), (CutAxis::MinusY, -0.5)] {
        let at = base + DVec3::new(-x, 0.0, 9.0);
        let engagement = point_engagement(&stock, &cone(radius, length), at, axis);
        assert_within(borders(&engagement), exact.map(|z| z + centre), bound, "across Y");
    }
}

#[test]
fn a_thin_wall_never_has_the_whole_point() {
    // Thinner than the point is long: at most the ring between two circles of the cone.
    let engagement =
        point_engagement(&plate(1.2, 0.1), &cone(5.0, 3.0), DVec3::new(0.03, 0.0, 0.0), CutAxis::PlusZ);
    assert_eq!(kinds(&engagement), [Engaged::Partly]);
    let exact = 1.0 - (1.8f64 / 3.0).powi(2);
    assert!((engagement.share(-3.0) - exact).abs() < 0.03, "{}", engagement.share(-3.0));
    assert!((engagement.last().unwrap() + 4.2).abs() < PointEngagement::sampling_error(0.6, 0.0, 0.1));
}

#[test]
fn a_cross_bore_leaves_air_or_a_mixed_stretch() {
    // Bores of radius Rc along Y at the depth 12, drilled first; the drill comes from above with R = 2, L1 = 1.2.
    let (radius, length, depth, step) = (2.0, 1.2, 12.0, 0.1);
    let bored = |rc: f64| {
        let bounds = Aabb { min: DVec3::new(-9.0, -5.0, -24.0), max: DVec3::new(9.0, 5.0, 0.0) };
        let mut stock = TriDexel::from_box(bounds, step).unwrap();
        let tool = ToolBody::new(Profile::cylinder(2.0 * rc, 40.0).unwrap());
        let way = Line { start: DVec3::new(0.0, 6.0, -depth), end: DVec3::new(0.0, -6.0, -depth) };
        let moves = [CutMove::new(way, CutAxis::PlusY, 0)];
        cut(&mut stock, &[tool], &moves, &CutOptions::default(), &Silent).unwrap();
        point_engagement(&stock, &cone(radius, length), DVec3::new(0.01, 0.02, 0.0), CutAxis::PlusZ)
    };
    use Engaged::{Fully, Not, Partly};
    // Wide: in, full, out into the bore, air, in again, full, out.
    let wide = bored(6.0);
    assert_eq!(kinds(&wide), [Partly, Fully, Partly, Not, Partly, Fully, Partly]);
    let f = |rc: f64, u: f64| (rc * rc - u * u).sqrt();
    let stages = wide.stages();
    let bound = PointEngagement::sampling_error(0.6, 2.0 / f(6.0, 2.0), step);
    // The roof is a ridge from below: break-in at Rc, out when the rim has left; the floor a valley.
    let roof = [-depth + 6.0, -depth + f(6.0, radius) - length];
    let floor = [-depth - 6.0, -depth - 6.0 - length];
    for (found, exact) in [
        (stages[2].from, roof[0]),
        (stages[2].to, roof[1]),
        (stages[4].from, floor[0]),
        (stages[4].to, floor[1]),
    ] {
        assert!((found - exact).abs() < bound, "{found} {exact}");
    }
    // Narrower than the drill: one mixed stretch between break-in and complete re-entry.
    for rc in [1.6, 1.0] {
        let narrow = bored(rc);
        assert_eq!(kinds(&narrow), [Partly, Fully, Partly, Fully, Partly], "{rc}");
        let mixed = narrow.stages()[2];
        assert!(
            (mixed.from - (rc - depth)).abs() < 0.2 && (mixed.to - (-depth - rc - length)).abs() < 0.2,
            "{mixed:?}"
        );
    }
}

proptest! {
    #![proptest_config(kinecut_cases::property(40))]
    /// Shares and stages are what a count of columns at the height says.
    #[test]
    fn the_sorted_events_are_a_count(
        cuts in prop::collection::vec((0.5f64..4.0, -3.0f64..3.0, -5.0f64..0.0), 0..4),
        kind in 0usize..4,
        x in -3.0f64..3.0,
        axis in 0usize..6,
        heights in prop::collection::vec(-9.0f64..9.0, 20),
    ) {
        let edge = [
            EdgeProfile::polyline(&[[0.0, 0.0], [3.0, 2.0]]),
            EdgeProfile::polyline(&[[0.0, 1.0], [1.0, 0.0], [1.0, 1.5], [3.0, 2.0]]),
            EdgeProfile::polyline(&[[1.5, 0.0], [3.0, 0.0]]),
            EdgeProfile::polyline(&[[0.0, 1.5], [1.5, 0.0], [3.0, 1.0]]),
        ][kind].clone().unwrap();
        let axis = CutAxis::ALL[axis];
        let bounds = Aabb { min: DVec3::splat(-5.0), max: DVec3::splat(5.0) };
        let mut stock = TriDexel::from_box(bounds, 0.7).unwrap();
        for (r, y, z) in cuts {
            let tool = ToolBody::new(Profile::cylinder(r, 3.0).unwrap());
            let way = Line { start: DVec3::new(-9.0, y, z), end: DVec3::new(9.0, y, z + 2.0) };
            cut(&mut stock, &[tool], &[CutMove::new(way, CutAxis::PlusZ, 0)], &CutOptions::default(), &Silent).unwrap();
        }
        let at = DVec3::new(x, 0.3 - x, 0.2 * x);
        let engagement = point_engagement(&stock, &edge, at, axis);
        let n = axis.vector();
        let lattice = *stock.lattice();
        let (a, b) = axis.along().others();
        let stages = engagement.stages();
        for height in heights {
            // All columns by their points, those outside by their number only.
            let (mut all, mut engaged) = (0, 0);
            for j in -30i32..60 {
                for i in -30i32..60 {
                    let mut p = DVec3::ZERO;
                    p[a.index()] = lattice.origin[a.index()] + f64::from(i) * lattice.step + LINE_OFFSET;
                    p[b.index()] = lattice.origin[b.index()] + f64::from(j) * lattice.step + LINE_OFFSET;
                    let v = p - at;
                    let Some(z) = edge.height((v - n * v.dot(n)).length()) else { continue };
                    all += 1;
                    let inside = |i: i32, axis: Axis| i >= 0 && (i as u32) < lattice.counts[axis.index()];
                    if inside(i, a) && inside(j, b) {
                        let w = (height + z) * n[axis.along().index()];
                        let line = stock.line(axis.along(), i as u32, j as u32);
                        engaged += usize::from(line.iter().any(|i| unfixed(i.lo.at) <= w && w <= unfixed(i.hi.at)));
                    }
                }
            }
            prop_assert_eq!((engagement.columns(), engagement.engaged(height)), (all, engaged));
            let kind = stages.iter().find(|s| s.to < height && height < s.from).map_or(Engaged::Not, |s| s.engaged);
            let wanted = match engaged {
                0 => Engaged::Not,
                n if n == all => Engaged::Fully,
                _ => Engaged::Partly,
            };
            prop_assert_eq!(kind, wanted);
        }
        for pair in stages.windows(2) {
            prop_assert!(pair[0].to == pair[1].from && pair[0].engaged != pair[1].engaged);
        }
        for s in &stages {
            prop_assert!(s.to < s.from);
        }
    }
}
