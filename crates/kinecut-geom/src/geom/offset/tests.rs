//! Offsets of outlines whose edges leave room for rounding only: tiny bulges, joints that are nearly tangent, radii nearly
//! equal to the distance, chords of smooth curves, points next to one another; judged by dense points, which share nothing
//! with what they judge.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, dvec2};

use super::*;
use crate::num::random::Random;

/// Largest distance of the judge's chords from an arc [mm].
const CHORD: f64 = 1e-6;

/// Chords of edges.
fn chords(edges: &[OutlineEdge]) -> Vec<[DVec2; 2]> {
    let mut all = Vec::new();
    for edge in edges {
        let mut points = vec![edge.start];
        if let Some(t) = edge.turn {
            let step = (8.0 * CHORD / t.radius).sqrt();
            let count = (t.sweep.abs() / step).ceil().max(1.0);
            let inner = (1..count as usize).map(|i| t.from + t.sweep * i as f64 / count);
            points.extend(inner.map(|a| t.centre + t.radius * dvec2(a.cos(), a.sin())));
        }
        points.push(edge.end);
        all.extend(points.windows(2).map(|w| [w[0], w[1]]));
    }
    all
}

/// Distance of a point from chords [mm], positive within the loops that they make.
fn depth(chords: &[[DVec2; 2]], p: DVec2) -> f64 {
    let (mut least, mut inside) = (f64::INFINITY, false);
    for [a, b] in chords {
        let (along, rest) = (*b - *a, p - *a);
        let share = if a == b { 0.0 } else { (rest.dot(along) / along.dot(along)).clamp(0.0, 1.0) };
        least = least.min((rest - share * along).length());
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
    }
    if inside { least } else { -least }
}

/// That an offset is the one of an outline.
fn judge(name: &str, outline: &Outline, distance: f64, made: &Offset, random: &mut Random) {
    let around = chords(outline.edges());
    let loops: Vec<OutlineEdge> = made.loops.iter().flat_map(|one| one.edges.clone()).collect();
    let offset = chords(&loops);
    // Its points are at the distance, and on the side.
    for _ in 0..30.min(offset.len()) {
        let [a, b] = offset[(random.share() * offset.len() as f64) as usize];
        let off = depth(&around, 0.5 * (a + b)) - distance;
        assert!(off.abs() < 3e-6, "{name} {distance}: {off:e} at {a}");
    }
    // Points beside the place where an edge has its offset are within it where they are farther than the distance.
    for _ in 0..60 {
        let edge = &outline.edges()[(random.share() * outline.edges().len() as f64) as usize];
        let share = random.share();
        let beside = [1e-4, 1e-3, 0.05, -1e-4, -1e-3, -0.05][(random.share() * 6.0) as usize];
        let p = edge.at(share) - (distance + beside) * DVec2::from_angle(edge.outward(share));
        let off = depth(&around, p) - distance;
        if off.abs() > 1e-5 {
            assert_eq!(depth(&offset, p) > 0.0, off > 0.0, "{name} {distance}: {p} {off:e}");
        }
    }
}

/// Points of a smooth closed curve.
fn wave(random: &mut Random, count: usize) -> Vec<DVec2> {
    let radius = 20.0 + 20.0 * random.share();
    let waves: Vec<[f64; 3]> =
        (2..6).map(|k| [f64::from(k), 3.0 * random.share() / f64::from(k), TAU * random.share()]).collect();
    let at = |i: usize| {
        let angle = TAU * i as f64 / count as f64;
        let out = waves.iter().map(|[k, size, from]| size * (k * angle + from).cos()).sum::<f64>();
        (radius + out) * dvec2(angle.cos(), angle.sin()) + dvec2(360.0, 200.0)
    };
    (0..count).map(at).collect()
}

fn closed(points: &[DVec2], mut bulge: impl FnMut() -> f64) -> Vec<OutlineEdge> {
    (0..points.len())
        .map(|i| OutlineEdge::bulge(points[i], points[(i + 1) % points.len()], bulge()))
        .collect()
}

/// Chords of a smooth curve, some bent a little to either side.
fn bent_chords(random: &mut Random) -> Vec<OutlineEdge> {
    let count = [12, 40, 150, 600][(random.share() * 4.0) as usize];
    let points = wave(random, count);
    let size = 10f64.powf(-3.0 - 5.0 * random.share());
    closed(&points, || if random.share() < 0.2 { 0.0 } else { size * (2.0 * random.share() - 1.0) })
}

/// A smooth curve as arcs that are tangent but for a little: each through a point, its middle and the next.
fn nearly_tangent(random: &mut Random) -> Vec<OutlineEdge> {
    let count = [10, 60, 300][(random.share() * 3.0) as usize];
    let points = wave(random, 2 * count);
    let bulge = |i: usize| {
        let (a, m, b) = (points[i], points[i + 1], points[(i + 2) % points.len()]);
        let aside = (b - a).perp_dot(m - a) / (b - a).length();
        -2.0 * aside / (b - a).length()
    };
    let end = |i: usize| points[i % points.len()];
    (0..points.len()).step_by(2).map(|i| OutlineEdge::bulge(end(i), end(i + 2), bulge(i))).collect()
}

/// A rectangle whose corners are round by nearly the distance, and nearly tangent to its sides.
fn rounded(random: &mut Random, distance: f64) -> Vec<OutlineEdge> {
    let tiny = |random: &mut Random, most: f64| {
        let sizes: [f64; 10] = [0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3];
        let size = sizes[(random.share() * 10.0) as usize];
        size.min(most) * (2.0 * random.share() - 1.0)
    };
    let (half, turn) =
        (dvec2(15.0 + 20.0 * random.share(), 12.0 + 10.0 * random.share()), TAU * random.share());
    let mut edges: Vec<OutlineEdge> = Vec::new();
    for k in 0..4 {
        let quarter = k as f64 * FRAC_PI_2;
        let radius = distance.abs() + tiny(random, 1.0);
        let away = dvec2([1.0, -1.0, -1.0, 1.0][k], [1.0, 1.0, -1.0, -1.0][k]);
        let centre = away * (half - DVec2::splat(radius));
        // A corner cut into the plate has its centre outside of it.
        let (from, sweep) = (quarter + tiny(random, 1e-4), FRAC_PI_2 + tiny(random, 1e-4));
        let arc = if random.share() < 0.5 {
            OutlineEdge::arc(centre, radius, from, sweep)
        } else {
            OutlineEdge::arc(away * half, radius, from - FRAC_PI_2, -sweep)
        };
        let arc = arc.moved(turn, dvec2(50.0, -30.0));
        if let Some(last) = edges.last() {
            edges.push(OutlineEdge::line(last.end, arc.start));
        }
        edges.push(arc);
    }
    edges.push(OutlineEdge::line(edges[edges.len() - 1].end, edges[0].start));
    edges
}

/// A star of lines and arcs with points next to one another: each edge cut anywhere, and a little piece after its start.
fn cut_up(random: &mut Random) -> Vec<OutlineEdge> {
    let count = 3 + (random.share() * 7.0) as usize;
    let at = |random: &mut Random, i: usize| {
        let angle = TAU * (i as f64 + 0.5 * random.share()) / count as f64;
        (12.0 + 25.0 * random.share()) * dvec2(angle.cos(), angle.sin())
    };
    let points: Vec<DVec2> = (0..count).map(|i| at(random, i)).collect();
    let whole = closed(&points, || if random.share() < 0.5 { 0.0 } else { 0.5 * (random.share() - 0.5) });
    let mut edges = Vec::new();
    for edge in whole {
        let piece = 10f64.powf(-6.0 + 3.0 * random.share()) / edge.length();
        let middle = 0.2 + 0.6 * random.share();
        let shares = [0.0, piece, middle, middle + piece, 1.0];
        edges.extend(shares.windows(2).map(|w| edge.part(w[0], w[1])));
    }
    // Corners moved off the line by less than the drawing's digits.
    for i in 1..edges.len() {
        let off = 10f64.powf(-12.0 + 6.0 * random.share()) * (random.share() - 0.5);
        if edges[i].turn.is_none() && edges[i - 1].turn.is_none() && edges[i].length() > 1e-4 {
            let p = edges[i].start + dvec2(off, -off);
            (edges[i - 1].end, edges[i].start) = (p, p);
        }
    }
    edges
}

#[test]
fn offsets_with_room_for_rounding_only_are_those_of_dense_points() {
    let mut random = Random(31);
    let mut seen = [0; 4];
    let count = kinecut_cases::cases(20, 600);
    while seen.iter().any(|&n| n < count) {
        let distance = [0.5, 1.0, 2.0, 3.0, 5.0][(random.share() * 5.0) as usize]
            * if random.share() < 0.5 { 1.0 } else { -1.0 };
        let kind = (0..4).min_by_key(|&k| seen[k]).unwrap();
        let edges = match kind {
            0 => bent_chords(&mut random),
            1 => nearly_tangent(&mut random),
            2 => rounded(&mut random, distance),
            _ => cut_up(&mut random),
        };
        let name = format!("kind {kind} case {}", seen[kind]);
        let Ok(outline) = Outline::new(vec![edges], vec![]) else { continue };
        seen[kind] += 1;
        for (way, made) in
            [("either", offset(&outline, distance)), ("direct", offset_direct(&outline, distance))]
        {
            let name = format!("{name} {way}");
            let made = made.unwrap_or_else(|e| panic!("{name} {distance}: {e}"));
            judge(&name, &outline, distance, &made, &mut random);
        }
    }
}

/// An edge through three points: from the first by the second to the last.
fn through(a: DVec2, m: DVec2, b: DVec2) -> OutlineEdge {
    let aside = (b - a).perp_dot(m - a) / (b - a).length();
    OutlineEdge::bulge(a, b, -2.0 * aside / (b - a).length())
}

/// Areas of the loops of an offset, made by the candidates of all edges; the other way has the same area in all.
fn areas_of(outline: &Outline, distance: f64) -> Vec<f64> {
    let areas = |made: Offset| -> Vec<f64> { made.loops.iter().map(OffsetLoop::area).collect() };
    let direct = areas(offset_direct(outline, distance).unwrap());
    let sums = [areas(offset(outline, distance).unwrap()), direct.clone()].map(|all| all.iter().sum::<f64>());
    assert!((sums[0] - sums[1]).abs() < 1e-6, "{sums:?}");
    direct
}

#[test]
fn loops_that_touch_stay_apart() {
    // Two chambers with a neck between arcs: 6 wide, and 3 from its middle on either side.
    for sense in [1.0, -1.0] {
        let p = |x: f64, y: f64| dvec2(sense * x, y);
        let edges = vec![
            OutlineEdge::line(p(-30.0, -15.0), p(-10.0, -15.0)),
            through(p(-10.0, -15.0), p(0.0, -3.0), p(10.0, -15.0)),
            OutlineEdge::line(p(10.0, -15.0), p(30.0, -15.0)),
            OutlineEdge::line(p(30.0, -15.0), p(30.0, 15.0)),
            OutlineEdge::line(p(30.0, 15.0), p(10.0, 15.0)),
            through(p(10.0, 15.0), p(0.0, 3.0), p(-10.0, 15.0)),
            OutlineEdge::line(p(-10.0, 15.0), p(-30.0, 15.0)),
            OutlineEdge::line(p(-30.0, 15.0), p(-30.0, -15.0)),
        ];
        let outline = Outline::new(vec![edges], vec![]).unwrap();
        let areas = areas_of(&outline, 3.0);
        assert_eq!(areas.len(), 2, "{areas:?}");
        assert!((areas[0] - areas[1]).abs() < 1e-6, "{areas:?}");
    }
    // Discs so far apart that the loops around them touch.
    let disc = |x: f64| vec![OutlineEdge::arc(dvec2(x, 0.0), 5.0, 0.3, TAU)];
    let areas = areas_of(&Outline::new(vec![disc(-8.0), disc(8.0)], vec![]).unwrap(), -3.0);
    assert_eq!(areas.len(), 2, "{areas:?}");
    assert!(areas.iter().all(|area| (area - 0.5 * TAU * 64.0).abs() < 1e-6), "{areas:?}");
}
