//! Random pockets: down on ramps, helices or straight, the rest by a second cutter; their text judged by its own points.

use std::f64::consts::TAU;

use glam::{DVec2, dvec2};
use kinecut::base::{Code, MemoryLoader, Silent};
use kinecut::geom::{NearestEdge, Outline, OutlineEdge};
use kinecut::job::run;

use super::pocket_entry::{Swept, job, json, judge, pocket};
use crate::common::random::Random;

const FLOOR: f64 = -4.0;
/// Radius of the smaller cutter [mm].
const SMALL: f64 = 2.0;

/// Corners of a star, with the bulge of the edge that begins there, as they are written.
fn star(random: &mut Random) -> Vec<[f64; 3]> {
    let count = 4 + random.below(5);
    let rounded = |v: f64, digits: f64| (v * digits).round() / digits;
    (0..count)
        .map(|i| {
            let angle = TAU * (i as f64 + 0.4 * random.share()) / count as f64;
            let far = random.between(16.0, 38.0) * DVec2::from_angle(angle);
            let bulge = if random.share() < 0.4 { random.between(-0.25, 0.25) } else { 0.0 };
            [rounded(far.x, 1e3), rounded(far.y, 1e3), rounded(bulge, 1e4)]
        })
        .collect()
}

/// Places from which a cutter of the smaller radius reaches them, and that nobody has swept.
fn left(outline: &Outline, swept: &Swept) -> (usize, usize) {
    let near = NearestEdge::new(outline.edges());
    let inside = |p: DVec2| -near.at(p, f64::INFINITY).expect("an edge").distance;
    let [low, high] = outline.bounds();
    let (mut all, mut left) = (0, 0);
    let step = 0.23;
    let count = |v: f64| (v / step).ceil() as u32;
    for i in 0..count(high.x - low.x) {
        for j in 0..count(high.y - low.y) {
            let p = low + step * dvec2(f64::from(i), f64::from(j)) + dvec2(0.03, 0.07);
            let depth = inside(p);
            // At the wall itself the bend of an arc hides a micrometre.
            if depth < 0.02 {
                continue;
            }
            let centre = if depth >= SMALL {
                p
            } else {
                let edge = outline.edges().iter().map(|e| e.nearest(p)).min_by(|a, b| a.1.total_cmp(&b.1));
                let foot = outline
                    .edges()
                    .iter()
                    .find(|e| Some(e.nearest(p).1) == edge.map(|e| e.1))
                    .map_or(p, |e| e.at(e.nearest(p).0));
                foot + (p - foot) * (SMALL / depth)
            };
            if inside(centre) >= SMALL - 1e-6 {
                all += 1;
                left += usize::from(!swept.holds(p));
            }
        }
    }
    (all, left)
}

#[test]
fn random_pockets_are_cleared_by_two_cutters_whatever_their_way_down() {
    let mut random = Random(77);
    let (mut made, mut refused) = (0, 0);
    for case in 0..16 {
        let corners = star(&mut random);
        let written: Vec<String> =
            corners.iter().map(|c| format!("[{}, {}, {}]", c[0], c[1], c[2])).collect();
        let edges = (0..corners.len()).map(|i| {
            let [a, b] = [corners[i], corners[(i + 1) % corners.len()]];
            OutlineEdge::bulge(dvec2(a[0], a[1]), dvec2(b[0], b[1]), a[2])
        });
        let Ok(outline) = Outline::new(vec![edges.collect()], Vec::new()) else { continue };
        let way = [
            "",
            "entry = { way = \"ramp\" }\n",
            "entry = { way = \"helix\" }\n",
            "entry = { way = \"plunge\" }\n",
        ][case % 4];
        let first = format!(
            "name = \"basin\"\noutline = {{ loops = [[{}]] }}\ndepth = 4\nfinish = {{ allowance = 0.1, feed = 900 }}\n{way}",
            written.join(", ")
        );
        let second = "rest = \"basin\"\ndepth = 4\nengagement = 50\nfinish = { allowance = 0.1, feed = 900 }";
        let text = job("fanuc", &format!("{}{}", pocket(1, &first), pocket(3, second)));
        let outcome = match run("job.toml", &text, &MemoryLoader::default(), &Silent) {
            Ok(outcome) => outcome,
            // No room for the cutter, or for a way down; the place is said.
            Err(e) => {
                let known = [Code::ENTRY_IMPOSSIBLE, Code::CUTTER_TOO_LARGE, Code::LEAD_ROOM];
                assert!(known.contains(&e.0.code), "{case}: {first} {e}");
                refused += 1;
                continue;
            }
        };
        made += 1;
        assert!(outcome.verdict.is_safe(), "{case}: {first} {:?}", outcome.verdict.found);
        let (large, _) = judge(&outcome, &outline, FLOOR, 1);
        let plan = json(&outcome, 0);
        // Beside a hole of its own size a cutter begins wider, and that is said.
        let stated = plan["largest_engagement"].as_f64().unwrap().max(match plan["plunges"].as_u64() {
            Some(0) => 60.0,
            _ => plan["entry_engagement"].as_f64().unwrap(),
        });
        assert!(large.pass < stated + 1.5 && large.link < 20.0, "{case}: {first} {large:?} {plan}");
        let (small, swept) = judge(&outcome, &outline, FLOOR, 3);
        assert!(small.pass < 51.5 && small.link < 20.0, "{case}: {first} {small:?}");
        assert!(large.room > -0.0015 && small.room > -0.0015, "{case}: {first} {large:?} {small:?}");
        // What both leave is said; without a word of it nothing is left that the smaller one reaches.
        let told = outcome.verdict.found.iter().any(|f| f.code != Code::CORNERS_STAY);
        let (all, left) = left(&outline, &swept);
        assert!(all > 2_000 && (told || left == 0), "{case}: {first} {left} of {all}");
    }
    assert!(made >= 10 && refused <= 4, "{made} {refused}");
}
