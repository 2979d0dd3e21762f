//! Burrs that face milling leaves: golden numbers, dense points along edges under passes of any form, pieces by counting cells.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, dvec2};
use kinecut::base::Code;
use kinecut::facing::burrs::{
    BurrChoice, BurrPart, BurrState, BurrTable, MilledEdges, PieceLengths, burr_parts, burr_pieces,
};
use kinecut::facing::passes::PassPath;
use kinecut::facing::{BadPart, BadSet, FaceCase};
use kinecut::geom::{Outline, OutlineEdge};
use serde_json::Value;

use crate::common::golden::{file, number, numbers};
use crate::common::random::Random;

fn table_of(input: &Value) -> BurrTable {
    let points = input["table"].as_array().unwrap().iter().map(numbers);
    BurrTable::new(points.map(|p| [p[0].to_radians(), p[1]]).collect()).unwrap()
}

/// A face under one straight pass along X.
fn under_pass(outline: Outline, radius: f64, offset: f64) -> MilledEdges {
    let case = FaceCase::new(outline, radius, BadSet::below(FRAC_PI_2).unwrap()).unwrap();
    let path = PassPath::lines(&[vec![dvec2(-2000.0, offset), dvec2(2000.0, offset)]]);
    MilledEdges { case, path, left_hand: false }
}

/// A triangle, the material on the right of its first edge, and the number of that edge.
fn beside(from: DVec2, to: DVec2) -> (Outline, usize) {
    let right = -(to - from).perp();
    let outline = Outline::polygon(&[from, to, 0.5 * (from + to) + right]).unwrap();
    let edge = outline.edges().iter().position(|e| e.start == from && e.end == to).unwrap();
    (outline, edge)
}

#[test]
fn golden_edges() {
    let mut seen = 0;
    for case in file("edges")["cases"].as_array().unwrap().iter().filter(|c| c["kind"] == "burr edge") {
        let (input, want, tolerance) = (&case["input"], &case["expected"], &case["tolerance"]);
        let (y0, y1, length) = (number(input, "y0"), number(input, "y1"), number(input, "length"));
        // The golden places count from y0; the edge with its material on the right runs towards it.
        let heading = number(input, "normal").to_radians() - FRAC_PI_2;
        let along = DVec2::from_angle(heading);
        let from = dvec2(0.0, y1);
        let to = dvec2(along.x * length, y0);
        assert!((to.distance(from) - length).abs() < 1e-9 && (to.y - from.y) * along.y > 0.0, "{case}");
        let (outline, edge) = beside(from, to);
        let milled = under_pass(outline, number(input, "R"), number(input, "centre_line"));
        let table = table_of(input);
        let choice = BurrChoice::above(number(input, "limit")).unwrap();
        let parts = burr_parts(&milled, &choice, Some(&table));
        let own = parts.iter().filter(|p| p.edge == edge && p.state == BurrState::Chosen);
        let found: Vec<[f64; 2]> = own.map(|p| [length - p.along[1], length - p.along[0]]).collect();
        let bad: Vec<Vec<f64>> = want["bad"].as_array().unwrap().iter().map(numbers).collect();
        assert_eq!(found.len(), bad.len(), "{case}: {found:?}");
        for (a, b) in found.iter().flatten().zip(bad.iter().flatten()) {
            assert!((a - b).abs() <= number(tolerance, "bad"), "{case}: {found:?}");
        }
        let theta = ((0.5 * (y0 + y1) - number(input, "centre_line")) / number(input, "R")).asin();
        let psi = theta - number(input, "normal").to_radians();
        let height = number(want, "height_at_middle");
        assert!((table.at(psi) - height).abs() <= number(tolerance, "height_at_middle"), "{case}");
        // What no exit has is no part.
        let middle =
            parts.iter().any(|p| p.edge == edge && p.along[0] < 0.5 * length && 0.5 * length < p.along[1]);
        assert_eq!(middle, height > 0.0, "{case}");
        seen += 1;
    }
    assert_eq!(seen, 4);
}

#[test]
fn golden_circles() {
    let mut seen = 0;
    for case in file("edges")["cases"].as_array().unwrap().iter().filter(|c| c["kind"] == "burr circle") {
        let (input, want) = (&case["input"], number(&case["expected"], "length"));
        let centre = dvec2(3.0, number(input, "cy"));
        let around = [dvec2(-40.0, -40.0), dvec2(40.0, -40.0), dvec2(40.0, 40.0), dvec2(-40.0, 40.0)];
        let square = (0..4).map(|i| OutlineEdge::line(around[i], around[(i + 1) % 4])).collect();
        let hole = vec![OutlineEdge::arc(centre, number(input, "radius"), 1.0, TAU)];
        let outline = Outline::new(vec![square, hole], vec![]).unwrap();
        let inner = outline.loops().iter().find(|l| !l.outer).unwrap().edges.clone();
        let milled = under_pass(outline, number(input, "R"), number(input, "centre_line"));
        let choice = BurrChoice::above(number(input, "limit")).unwrap();
        let parts = burr_parts(&milled, &choice, Some(&table_of(input)));
        let own = parts.iter().filter(|p| inner.contains(&p.edge) && p.state == BurrState::Chosen);
        let length: f64 = own.map(BurrPart::length).sum();
        assert!((length - want).abs() <= number(&case["tolerance"], "length"), "{case}: {length}");
        seen += 1;
    }
    assert_eq!(seen, 2);
}

/// The exit angle of a point with its edge's outward normal, by walking the path in small steps; none where nothing is cut in feed.
fn walked(path: &PassPath, p: DVec2, outward: f64, radius: f64, clockwise: bool) -> Option<f64> {
    const STEPS: u32 = 4000;
    for chain in &path.chains {
        if chain[0].start.distance(p) < radius {
            return None;
        }
        for piece in chain {
            let place = |i: u32| piece.at(f64::from(i) / f64::from(STEPS));
            let Some(i) = (1..=STEPS).find(|i| place(*i).distance(p) < radius) else { continue };
            let (mut out, mut on) = (f64::from(i - 1) / f64::from(STEPS), f64::from(i) / f64::from(STEPS));
            for _ in 0..50 {
                let middle = 0.5 * (out + on);
                if piece.at(middle).distance(p) < radius { on = middle } else { out = middle }
            }
            let arm = p - piece.at(on);
            let angle = if clockwise { arm.to_angle() - outward } else { outward - arm.to_angle() };
            return Some((angle + FRAC_PI_2).rem_euclid(TAU) - FRAC_PI_2);
        }
    }
    None
}

/// A star of lines and arcs with a hole.
fn star(random: &mut Random) -> Option<Outline> {
    let count = 3 + random.below(6);
    let corner = |i: usize, r: &mut Random| {
        DVec2::from_angle(TAU * (i as f64 + 0.5 * r.share()) / count as f64) * r.between(20.0, 45.0)
    };
    let corners: Vec<DVec2> = (0..count).map(|i| corner(i, random)).collect();
    let bulge = |r: &mut Random| if r.share() < 0.5 { 0.0 } else { r.between(-0.3, 0.3) };
    let edges =
        (0..count).map(|i| OutlineEdge::bulge(corners[i], corners[(i + 1) % count], bulge(random))).collect();
    let hole = vec![OutlineEdge::arc(dvec2(1.0, -2.0), random.between(3.0, 8.0), 0.3, TAU)];
    Outline::new(vec![edges, hole], vec![]).ok()
}

/// Passes at random: rows and bows.
fn passes(random: &mut Random, radius: f64) -> PassPath {
    let turn = random.between(0.0, TAU);
    let rows = 1 + random.below(4);
    let chains = (0..rows).map(|i| {
        let y = (i as f64 - 0.5 * (rows as f64 - 1.0)) * 1.3 * radius + random.between(-3.0, 3.0);
        let ends = [dvec2(-120.0, y), dvec2(120.0, y)].map(|p| DVec2::from_angle(turn).rotate(p));
        let bulge = if random.share() < 0.4 { random.between(-0.1, 0.1) } else { 0.0 };
        let piece = OutlineEdge::bulge(ends[0], ends[1], bulge);
        vec![if random.share() < 0.5 { piece } else { piece.reversed() }]
    });
    PassPath::new(chains.collect())
}

#[test]
fn dense_points_have_the_burr_of_their_part() {
    let mut random = Random(71);
    let table =
        BurrTable::new([[0.0, 0.3], [0.5, 0.25], [0.9, 0.05], [1.4, 0.21], [2.2, 0.02]].to_vec()).unwrap();
    let (mut chosen, mut others, mut none) = (0, 0, 0);
    for round in 0..60 {
        let Some(outline) = star(&mut random) else { continue };
        let radius = random.between(15.0, 60.0);
        let bad = BadSet::new(vec![
            BadPart { from: 0.1, to: 0.8, weight: 1.0 },
            BadPart { from: 1.3, to: 2.0, weight: 3.0 },
        ])
        .unwrap();
        let case = FaceCase::new(outline.clone(), radius, bad.clone()).unwrap();
        let left_hand = round % 3 == 0;
        let milled = MilledEdges { case, path: passes(&mut random, radius), left_hand };
        let choice = if round % 2 == 0 { BurrChoice::Bad(bad) } else { BurrChoice::Above(0.2) };
        let parts = burr_parts(&milled, &choice, Some(&table));
        for (i, edge) in outline.edges().iter().enumerate() {
            let length = edge.length();
            for k in 0..40 {
                let s = (f64::from(k) + random.share()) / 40.0;
                let at = s * length;
                let own: Vec<&BurrPart> = parts.iter().filter(|p| p.edge == i).collect();
                let near = |v: f64| (v - at).abs() < 1e-3;
                if near(0.0) || near(length) || own.iter().any(|p| near(p.along[0]) || near(p.along[1])) {
                    continue;
                }
                let part = own.iter().find(|p| p.along[0] < at && at < p.along[1]);
                let found = walked(&milled.path, edge.at(s), edge.outward(s), radius, !left_hand);
                let Some(psi) = found.filter(|psi| (0.0..PI).contains(psi)) else {
                    let lowered = part.is_none_or(|p| p.state == BurrState::Lowered);
                    assert!(lowered, "{round}, edge {i} at {at}: {part:?} against {found:?}");
                    none += 1;
                    continue;
                };
                let part = part.unwrap_or_else(|| panic!("{round}, edge {i} at {at}: {psi}"));
                let is_chosen = match &choice {
                    BurrChoice::Bad(_) => (0.1..0.8).contains(&psi) || (1.3..2.0).contains(&psi),
                    BurrChoice::Above(_) => table.at(psi) > 0.2,
                };
                assert_eq!(
                    part.state == BurrState::Chosen,
                    is_chosen,
                    "{round}, edge {i} at {at}: {psi} {part:?}"
                );
                // A walk in steps may pass by a touch of a millionth of the radius.
                let [least, most] = part.exit_angles;
                assert!(least - 1e-6 < psi && psi < most + 1e-6, "{round}, edge {i} at {at}: {psi} {part:?}");
                assert!(table.at(psi) < part.height.unwrap() + 1e-6, "{psi} {part:?}");
                *if is_chosen { &mut chosen } else { &mut others } += 1;
            }
        }
    }
    assert!(chosen > 1000 && others > 1000 && none > 1000, "{chosen} {others} {none}");
}

#[test]
fn the_mirrored_part_has_mirrored_burrs() {
    let mut random = Random(5);
    for _ in 0..20 {
        let Some(outline) = star(&mut random) else { continue };
        let radius = random.between(15.0, 60.0);
        let case = FaceCase::new(outline.clone(), radius, BadSet::below(1.2).unwrap()).unwrap();
        let milled = MilledEdges { case, path: passes(&mut random, radius), left_hand: false };
        let other =
            MilledEdges { case: milled.case.mirrored(), path: milled.path.mirrored(), left_hand: true };
        let choice = BurrChoice::Bad(milled.case.bad.clone());
        let places = |of: &MilledEdges, sign: f64| {
            let mut all: Vec<[f64; 5]> = burr_parts(of, &choice, None)
                .iter()
                .map(|p| {
                    let edge = &of.case.outline.edges()[p.edge];
                    let middle = edge.at(0.5 * (p.along[0] + p.along[1]) / edge.length());
                    let [a, b] = p.exit_angles;
                    [middle.x, sign * middle.y, p.length(), a, b]
                })
                .collect();
            all.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
            all
        };
        let (one, two) = (places(&milled, 1.0), places(&other, -1.0));
        assert!(!one.is_empty() && one.len() == two.len());
        for (a, b) in one.iter().flatten().zip(two.iter().flatten()) {
            assert!((a - b).abs() < 1e-6, "{one:?} {two:?}");
        }
    }
}

#[test]
fn heights_fall_between_table_points_and_beyond_them_stay() {
    // An edge along the feed keeps one exit angle: all of it or nothing.
    let plate = [dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)];
    let milled = under_pass(Outline::polygon(&plate).unwrap(), 50.0, 30.0);
    let psi = 0.8_f64.acos();
    let at = PI - FRAC_PI_2 - psi;
    for (angle, chosen) in [(at - 1e-6, false), (at, false), (at + 1e-6, true)] {
        // As high as the limit at an angle, higher below it.
        let table = BurrTable::new(vec![[angle - 0.1, 0.2], [angle + 0.1, 0.0]]).unwrap();
        let parts = burr_parts(&milled, &BurrChoice::above(0.1).unwrap(), Some(&table));
        let side = parts.iter().find(|p| p.length() > 99.0).unwrap();
        assert!((side.exit_angles[0] - at).abs() < 1e-9);
        assert_eq!(side.state == BurrState::Chosen, chosen, "{angle}: {side:?}");
    }
    assert_eq!(BurrChoice::above(0.0).unwrap_err().code(), Code::JOB_VALUE);
}

#[test]
fn pieces_are_those_of_cells() {
    // A square of 40, in cells of 0.01.
    let outline =
        Outline::polygon(&[dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 40.0), dvec2(0.0, 40.0)]).unwrap();
    const CELLS: usize = 16_000;
    let mut random = Random(9);
    let (mut many, mut whole) = (0, 0);
    for _ in 0..300 {
        let count = 1 + random.below(9);
        let mut ends: Vec<usize> = (0..2 * count).map(|_| random.below(CELLS)).collect();
        // Short ones among them.
        if random.share() < 0.5 {
            ends[1] = (ends[0] + 5 + random.below(70)).min(CELLS);
        }
        ends.sort_unstable();
        ends.dedup();
        let burrs: Vec<[usize; 2]> = ends.chunks_exact(2).map(|w| [w[0], w[1]]).collect();
        let mut parts = Vec::new();
        for [from, to] in &burrs {
            for edge in 0..4 {
                let (low, high) = ((*from).max(4000 * edge), (*to).min(4000 * (edge + 1)));
                if low < high {
                    let along = [low, high].map(|c| 0.01 * (c - 4000 * edge) as f64);
                    let exit_angles = [0.1, 0.2];
                    parts.push(BurrPart { edge, along, exit_angles, height: None, state: BurrState::Chosen });
                }
            }
        }
        let gap = if random.share() < 0.2 { 70.0 } else { 1.0 + random.share() * 6.0 };
        let lengths = PieceLengths { gap: (gap * 100.0).round() / 100.0 + 0.005, beyond: 1.0, least: 0.495 };
        let made = burr_pieces(&outline, &parts, lengths);
        // The same by cells: gaps filled, short runs dropped, the rest grown.
        let close = (lengths.gap.max(2.0) * 100.0).floor() as usize;
        let mut on = vec![false; CELLS];
        burrs.iter().for_each(|[a, b]| on[*a..*b].fill(true));
        // From the run on that has the widest gap before it.
        let gap_before = |c: usize| (1..CELLS).find(|k| on[(c + CELLS - k) % CELLS]).unwrap_or(CELLS);
        let starts = (0..CELLS).filter(|c| on[*c] && !on[(c + CELLS - 1) % CELLS]);
        let first = starts.max_by_key(|c| gap_before(*c));
        let Some(first) = first else { continue };
        let mut cells: Vec<bool> = (0..CELLS).map(|c| on[(first + c) % CELLS]).collect();
        let runs = |cells: &[bool], of: bool| {
            let mut all: Vec<[usize; 2]> = Vec::new();
            for (c, _) in cells.iter().enumerate().filter(|(_, v)| **v == of) {
                match all.last_mut().filter(|r| r[1] == c) {
                    Some(r) => r[1] = c + 1,
                    None => all.push([c, c + 1]),
                }
            }
            all
        };
        let limit = |r: &[usize; 2]| r[1] - r[0] <= close && (lengths.gap > 2.0 || r[1] - r[0] < close);
        for r in runs(&cells, false).into_iter().filter(limit) {
            cells[r[0]..r[1]].fill(true);
        }
        let closed = cells.iter().all(|c| *c);
        let kept: Vec<[usize; 2]> = runs(&cells, true);
        let joins = !closed && kept.len() > 1 && kept[0][0] == 0 && kept[kept.len() - 1][1] == CELLS;
        assert!(!joins, "cells begin with a run");
        let wanted: Vec<f64> =
            kept.iter().map(|r| 0.01 * (r[1] - r[0]) as f64).filter(|l| *l >= lengths.least).collect();
        let mut wanted: Vec<f64> = wanted.into_iter().map(|l| if closed { l } else { l + 2.0 }).collect();
        let mut found: Vec<f64> = made.pieces.iter().map(|p| p.along[1] - p.along[0]).collect();
        wanted.sort_by(f64::total_cmp);
        found.sort_by(f64::total_cmp);
        assert_eq!(wanted.len(), found.len(), "{wanted:?} {found:?}");
        assert!(wanted.iter().zip(&found).all(|(a, b)| (a - b).abs() < 1e-6), "{wanted:?} {found:?}");
        assert!(made.pieces.iter().all(|p| p.closed == closed));
        // Nothing gets lost, and each burr lies on its piece.
        let sum: f64 =
            made.pieces.iter().flat_map(|p| &p.parts).chain(&made.short).map(BurrPart::length).sum();
        assert!((sum - parts.iter().map(BurrPart::length).sum::<f64>()).abs() < 1e-6);
        for piece in &made.pieces {
            for part in &piece.parts {
                let at = 40.0 * part.edge as f64 + part.along[0];
                let gone = (at - piece.along[0]).rem_euclid(160.0);
                let least = if closed { -1e-6 } else { 1.0 - 1e-6 };
                assert!(gone >= least && gone + part.length() <= piece.along[1] - piece.along[0] - least);
            }
        }
        many += usize::from(made.pieces.len() > 2);
        whole += usize::from(closed);
    }
    assert!(many > 50 && whole > 3, "{many} {whole}");
}
