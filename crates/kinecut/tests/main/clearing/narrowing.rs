//! Pockets that narrow to less than the cutter: beside islands near a wall or near one another, and in sharp corners.

use std::f64::consts::TAU;

use glam::{DVec2, dvec2};
use kinecut::clearing::{PocketSpec, plan_pocket};
use kinecut::geom::{Outline, OutlineEdge};

use super::{judge, polygon, rectangle, spec, with_circle};
use crate::common::random::Random;

/// Largest engagement of links [deg]: what the chords of passes leave at a wall, below 0.005 of the radius, on both sides of a
/// narrow place, `2 * 2 * acos(0.995)`.
const LINK: f64 = 22.93;

/// Most passes of a pocket: each begins at the wall, the depth of a cut after the one before.
fn most_passes(spec: &PocketSpec) -> f64 {
    let wall: f64 = spec.outline.edges().iter().map(OutlineEdge::length).sum();
    wall / (spec.radius() * (1.0 - spec.engagement.cos()))
}

/// Plans and judges; whether the pocket could be planned.
fn is_cleared(name: &str, spec: &PocketSpec) -> bool {
    // Where the narrow place is hardly wider than the cutter for long the pocket is refused.
    let Ok(plan) = plan_pocket(spec) else { return false };
    let f = plan.figures;
    assert!((f.passes as f64) < most_passes(spec), "{name}: {f:?}, {}", most_passes(spec));
    assert!(f.cutting < 1.5 * f.bound, "{name}: {f:?}");
    let found = judge(spec, &plan, 499);
    assert!(found.pass < spec.engagement.to_degrees() + 1.0, "{name}: {found:?}");
    assert!(found.link < LINK, "{name}: {found:?}");
    assert!(found.left < 1e-3, "{name}: {found:?}");
    true
}

#[test]
fn an_island_near_a_wall_costs_no_more_passes_than_its_wall_is_long() {
    let island = |x: f64| with_circle(&rectangle(90.0, 60.0), dvec2(x, 30.0), 8.0);
    // The gap to the left wall is 2, 3, 5.5 and 8 mm.
    for x in [10.0, 11.0, 13.5, 16.0] {
        assert!(is_cleared(&format!("island at {x}"), &spec(island(x), 6.0, 60.0)), "{x}");
    }
}

#[test]
fn random_passages_that_narrow_are_cleared_by_few_passes() {
    let mut random = Random(5);
    let mut planned = 0;
    for round in 0..12 {
        let diameter = random.between(4.0, 8.0);
        let radius = random.between(3.0, 9.0);
        // Less than the cutter.
        let gap = random.between(0.1, 0.9) * diameter;
        let angle = random.between(0.0, TAU);
        let outline = match round % 3 {
            0 => {
                let centre = dvec2(gap + radius, random.between(25.0, 35.0));
                with_circle(&rectangle(70.0, 60.0), centre, radius)
            }
            1 => {
                let half = (0.5 * gap + radius) * DVec2::from_angle(angle);
                let one = with_circle(&rectangle(70.0, 60.0), dvec2(35.0, 30.0) + half, radius);
                let other = OutlineEdge::arc(dvec2(35.0, 30.0) - half, radius, 0.0, TAU);
                let loops = vec![one.edges()[..4].to_vec(), one.edges()[4..].to_vec(), vec![other]];
                Outline::new(loops, Vec::new()).expect("two islands")
            }
            _ => polygon(&[[0.0, 0.0], [70.0, random.between(0.0, 8.0)], [65.0, random.between(18.0, 40.0)]]),
        };
        let spec = spec(outline, diameter, random.between(35.0, 80.0));
        planned += usize::from(is_cleared(&format!("{round}"), &spec));
    }
    assert!(planned >= 11, "{planned}");
}
