//! Tests of offsets of open lines.

use std::f64::consts::PI;

use glam::{DVec2, dvec2};
use proptest::prelude::*;

use super::{Offset, offset};
use crate::geom::{NearestEdge, Outline, OutlineEdge};

fn chain(points: &[[f64; 3]]) -> Vec<OutlineEdge> {
    let at = |p: &[f64; 3]| dvec2(p[0], p[1]);
    points.windows(2).map(|w| OutlineEdge::bulge(at(&w[0]), at(&w[1]), w[0][2])).collect()
}

fn line(points: &[[f64; 3]]) -> Outline {
    Outline::of_lines(vec![chain(points)], vec![]).unwrap()
}

#[test]
fn bands_of_simple_lines_are_closed_forms() {
    let is_band = |found: &Offset, length: f64, area: f64| {
        assert!((found.length() - length).abs() < 1e-9, "{} {length}", found.length());
        assert!((found.area() - area).abs() < 1e-9, "{} {area}", found.area());
    };
    let d = 4.0;
    let straight = offset(&line(&[[0.0, 0.0, 0.0], [50.0, 0.0, 0.0]]), -d).unwrap();
    is_band(&straight, 100.0 + 2.0 * PI * d, 100.0 * d + PI * d * d);
    // About a corner an arc on one side, on the other both lines are shorter.
    let bent = offset(&line(&[[0.0, 0.0, 0.0], [50.0, 0.0, 0.0], [50.0, 30.0, 0.0]]), -d).unwrap();
    is_band(&bent, 160.0 - 2.0 * d + 2.5 * PI * d, 160.0 * d - d * d + 1.25 * PI * d * d);
    // A half circle of radius 10.
    let half = offset(&line(&[[0.0, 0.0, 1.0], [20.0, 0.0, 0.0]]), -d).unwrap();
    is_band(&half, PI * 20.0 + 2.0 * PI * d, PI * 10.0 * 2.0 * d + PI * d * d);
    // A channel that is narrower than two distances is one face; its end stays a hole where it is wider.
    let channel = line(&[[0.0, 0.0, 0.0], [40.0, 0.0, 0.0], [40.0, 6.0, 0.0], [0.0, 6.0, 0.0]]);
    let filled = offset(&channel, -d).unwrap();
    assert_eq!(filled.loops.len(), 1);
    let bulb = line(&[
        [0.0, 0.0, 0.0],
        [40.0, 0.0, 0.0],
        [40.0, -9.0, 0.0],
        [64.0, -9.0, 0.0],
        [64.0, 15.0, 0.0],
        [40.0, 15.0, 0.0],
        [40.0, 6.0, 0.0],
        [0.0, 6.0, 0.0],
    ]);
    let open = offset(&bulb, -d).unwrap();
    assert_eq!(open.loops.iter().filter(|l| l.area() < 0.0).count(), 1);
}

#[test]
fn points_beside_a_line_belong_to_the_side_on_which_they_are() {
    let line = line(&[[0.0, 0.0, 0.0], [50.0, 0.0, 0.5], [50.0, 30.0, 0.0], [10.0, 40.0, 0.0]]);
    let near = NearestEdge::of(&line);
    for (p, edge) in
        [(dvec2(20.0, 1.0), 0), (dvec2(20.0, -1.0), 5), (dvec2(57.0, 15.0), 1), (dvec2(58.0, 15.0), 4)]
    {
        let found = near.at(p, 10.0).unwrap();
        assert!(found.edge == edge && found.distance > 0.0, "{p} {found:?}");
    }
    assert!(near.at(dvec2(-1.0, 0.0), 10.0).unwrap().distance == 1.0);
    assert_eq!(line.lines().map(<[OutlineEdge]>::len).collect::<Vec<_>>(), [3]);
    let turned = line.moved(0.5, dvec2(1.0, 2.0));
    assert!(turned.is_of_lines() && (turned.perimeter() - line.perimeter()).abs() < 1e-9);
}

#[test]
fn lines_that_cross_or_have_gaps_are_refused() {
    let crossing = chain(&[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 5.0, 0.0], [5.0, -5.0, 0.0]]);
    let crossing = Outline::of_lines(vec![crossing], vec![]).unwrap_err();
    assert_eq!(crossing.code(), crate::base::Code::OUTLINE_CROSSES);
    let mut gap = chain(&[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [10.0, 5.0, 0.0]]);
    gap[1].start.x += 0.1;
    assert_eq!(Outline::of_lines(vec![gap], vec![]).unwrap_err().code(), crate::base::Code::OUTLINE_OPEN);
    assert!(Outline::of_lines(vec![], vec![]).is_err());
}

proptest! {
    #![proptest_config(kinecut_cases::property(48))]
    /// The area of the band around a random line of chords and arcs is that of a count of points near it.
    #[test]
    fn bands_have_the_area_of_the_points_near_the_line(
        turns in proptest::collection::vec((-2.4..2.4f64, 2.0..14.0f64, -1.2..1.2f64, prop::bool::ANY), 1..9),
        d in 0.5..6.0f64,
    ) {
        let mut points = vec![[0.0, 0.0, 0.0]];
        let mut heading = 0.0;
        for (turn, length, bulge, curved) in turns {
            heading += turn;
            let last = points.len() - 1;
            points[last][2] = if curved { bulge } else { 0.0 };
            let [x, y, _] = points[last];
            let next = dvec2(x, y) + length * DVec2::from_angle(heading);
            points.push([next.x, next.y, 0.0]);
        }
        let Ok(line) = Outline::of_lines(vec![chain(&points)], vec![]) else { return Ok(()) };
        let found = offset(&line, -d).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let near: Vec<DVec2> = line.lines().flatten().flat_map(|e| {
            let parts = (e.length() / 0.02).ceil();
            (0..=parts as u32).map(move |i| e.at(f64::from(i) / parts))
        }).collect();
        let [low, high] = line.bounds();
        let step = 0.12;
        let (mut count, mut y) = (0u32, low.y - d);
        while y < high.y + d {
            let mut x = low.x - d;
            while x < high.x + d {
                count += u32::from(near.iter().any(|p| p.distance_squared(dvec2(x, y)) <= d * d));
                x += step;
            }
            y += step;
        }
        let counted = f64::from(count) * step * step;
        // A border through cells of the grid is off by less than a tenth of them.
        let largest = 0.1 * found.length() * step + 0.5;
        prop_assert!((found.area() - counted).abs() < largest, "{} {counted} {points:?} {d}", found.area());
    }
}
