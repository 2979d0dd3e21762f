//! Pockets: engagement, completeness and lengths, judged by distances to all that was cut before.

mod entry;
mod narrowing;
mod rest;
mod slot;

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, dvec2};
use kinecut::clearing::{Clearing, PocketPlan, PocketSpec, WALL_STOCK, plan_pocket};
use kinecut::geom::{NearestEdge, Outline, OutlineEdge};
use kinecut::holes::{CutterData, Sense, ToolpathRole};

use crate::common::random::Random;

fn polygon(points: &[[f64; 2]]) -> Outline {
    Outline::polygon(&points.iter().map(|p| DVec2::from_array(*p)).collect::<Vec<_>>()).expect("a polygon")
}

fn rectangle(x: f64, y: f64) -> Outline {
    polygon(&[[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]])
}

fn with_circle(outer: &Outline, centre: DVec2, radius: f64) -> Outline {
    let loops = vec![outer.edges().to_vec(), vec![OutlineEdge::arc(centre, radius, 0.0, TAU)]];
    Outline::new(loops, Vec::new()).expect("an island")
}

fn disc(radius: f64) -> Outline {
    Outline::new(vec![vec![OutlineEdge::arc(DVec2::ZERO, radius, 0.0, TAU)]], Vec::new()).expect("a disc")
}

fn ell() -> Outline {
    polygon(&[[0.0, 0.0], [80.0, 0.0], [80.0, 30.0], [30.0, 30.0], [30.0, 70.0], [0.0, 70.0]])
}

fn spec(outline: Outline, diameter: f64, degrees: f64) -> PocketSpec {
    let cutter = CutterData { diameter, centre_cutting: true, max_ramp_angle: None, flute_length: 22.0 };
    PocketSpec { engagement: degrees.to_radians(), ..PocketSpec::new(outline, 6.0, cutter, 10.0) }
}

/// All that a cutter has swept, as points so close together that what lies between them is below a micrometre.
struct Swept {
    radius: f64,
    cells: HashMap<(i64, i64), Vec<DVec2>>,
}

/// Stock thinner than this is no chip [mm]: at a sharp corner the cutter's circle lies on it all around.
const SLIVER: f64 = 0.002;
/// Way between two of those points [mm].
const CHORD: f64 = 0.02;

impl Swept {
    fn cell(&self, p: DVec2) -> (i64, i64) {
        ((p.x / self.radius).floor() as i64, (p.y / self.radius).floor() as i64)
    }

    fn add(&mut self, p: DVec2) {
        self.cells.entry(self.cell(p)).or_default().push(p);
    }

    fn holds(&self, p: DVec2) -> bool {
        let (column, row) = self.cell(p);
        (-1..=1).any(|i| {
            (-1..=1).any(|j| {
                self.cells
                    .get(&(column + i, row + j))
                    .is_some_and(|points| points.iter().any(|q| q.distance(p) < self.radius + SLIVER))
            })
        })
    }

    /// Angle of the front half of the cutter's circle that lies in stock [deg].
    fn engaged(&self, at: DVec2, along: DVec2, stock: &impl Fn(DVec2) -> bool) -> f64 {
        const STEPS: u32 = 720;
        let is_cut = |k: &u32| {
            let angle = -FRAC_PI_2 + PI * (f64::from(*k) + 0.5) / f64::from(STEPS);
            let p = at + self.radius * (1.0 - 1e-6) * DVec2::from_angle(angle).rotate(along);
            stock(p) && !self.holds(p)
        };
        180.0 * (0..STEPS).filter(is_cut).count() as f64 / f64::from(STEPS)
    }
}

/// Findings of the judge.
#[derive(Debug, Default)]
struct Judged {
    /// Largest engagement of passes and of links [deg].
    pass: f64,
    link: f64,
    /// Share of the looks at passes within ten degrees of the wanted engagement, of those that cut.
    near: f64,
    /// Points of the area within reach that were not swept, out of all.
    left: f64,
}

/// Looks at every `every`-th place of a plan's first level.
fn judge(spec: &PocketSpec, plan: &PocketPlan, every: usize) -> Judged {
    judge_in(spec, plan, every, |_| true)
}

/// The same with stock only where `is_left` is true.
fn judge_in(spec: &PocketSpec, plan: &PocketPlan, every: usize, is_left: impl Fn(DVec2) -> bool) -> Judged {
    let a = spec.radius();
    let near = NearestEdge::new(spec.outline.edges());
    let stock = |p: DVec2| {
        spec.stock.as_ref().is_none_or(|s| s.contains(p))
            && spec.holes.iter().all(|(at, radius)| at.distance(p) > *radius)
            && is_left(p)
    };
    let mut swept = Swept { radius: a, cells: HashMap::new() };
    let mut found = Judged::default();
    let (mut looks, mut cutting, mut good) = (0, 0, 0);
    for planned in plan.moves.iter().filter(|m| m.level == 0) {
        let curve = &planned.curve;
        let on_floor = |z: f64| z < plan.levels[0] + spec.lift + 1e-9;
        if !on_floor(curve.start().z) && !on_floor(curve.end().z) {
            continue;
        }
        let count = (curve.length() / CHORD).ceil().max(1.0) as usize;
        for k in 0..=count {
            let jet = curve.at(curve.length() * k as f64 / count as f64);
            let at = jet.p.truncate();
            let Some(along) = jet.d1.truncate().try_normalize() else { continue };
            let room = near.at(at, f64::INFINITY).expect("a nearest edge").distance;
            assert!(
                -room > a + spec.allowance + 0.5 * WALL_STOCK || spec.stock.is_some(),
                "{at} is {room} from the wall"
            );
            let is_pass = planned.role == ToolpathRole::Rough;
            let is_link = planned.role == ToolpathRole::Link;
            if is_pass || is_link {
                looks += 1;
                if looks % every == 0 {
                    let engaged = swept.engaged(at, along, &stock);
                    if is_pass {
                        found.pass = found.pass.max(engaged);
                        cutting += usize::from(engaged > 3.0);
                        good += usize::from(engaged > spec.engagement.to_degrees() - 10.0);
                    } else {
                        found.link = found.link.max(engaged);
                    }
                }
            }
            // The middle of a full turn down clears a disc, not only its rim.
            let on_the_floor = jet.p.z < plan.levels[0] + 1e-9;
            if planned.role == ToolpathRole::Entry || is_pass || on_the_floor {
                swept.add(at);
            }
        }
    }
    found.near = f64::from(good as u32) / f64::from(cutting as u32);
    let [low, high] = spec.outline.bounds();
    let (mut all, mut left) = (0, 0);
    for k in 0..40_000_u32 {
        // Points without a pattern that could follow the passes.
        let share = dvec2((f64::from(k) * 0.754_877_666).fract(), (f64::from(k) * 0.569_840_291).fract());
        let p = low + share * (high - low);
        let room = near.at(p, f64::INFINITY).expect("a nearest edge").distance;
        // Deep inside only: what a cutter reaches near corners is another matter.
        if -room > a && stock(p) {
            all += 1;
            left += usize::from(!swept.holds(p) && !swept.holds(p + dvec2(1e-6, 0.0)));
        }
    }
    found.left = left as f64 / f64::from(all);
    found
}

#[test]
fn the_engagement_of_passes_stays_below_the_wanted_one() {
    let island = with_circle(&rectangle(100.0, 70.0), dvec2(50.0, 35.0), 15.0);
    // Bounds of lengths: passes and links, in the least length of a path that holds the engagement.
    let cases = [
        ("disc", disc(40.0), 10.0, 60.0, [1.15, 0.0, 0.85]),
        ("disc, 45", disc(40.0), 10.0, 45.0, [1.15, 0.0, 0.85]),
        ("square", rectangle(80.0, 80.0), 10.0, 60.0, [1.25, 0.3, 0.85]),
        ("square, 90", rectangle(80.0, 80.0), 10.0, 90.0, [1.25, 0.35, 0.8]),
        ("L", ell(), 10.0, 60.0, [1.45, 0.9, 0.85]),
        ("island", island, 10.0, 60.0, [1.45, 0.9, 0.85]),
        ("small", rectangle(20.0, 15.0), 3.0, 30.0, [1.45, 0.9, 0.8]),
    ];
    for (name, outline, diameter, degrees, [cutting, links, near]) in cases {
        let spec = spec(outline, diameter, degrees);
        let plan = plan_pocket(&spec).expect(name);
        let found = judge(&spec, &plan, 307);
        let f = plan.figures;
        assert!(found.pass < degrees + 1.0, "{name}: {found:?}");
        assert!(found.link < 16.0, "{name}: {found:?}");
        assert!(found.near > near, "{name}: {found:?}");
        assert!(found.left == 0.0, "{name}: {found:?}");
        assert!(f.cutting < cutting * f.bound && f.links <= links * f.bound, "{name}: {f:?}");
        assert!(plan.findings.is_empty(), "{name}: {:?}", plan.findings);
    }
}

/// Distance of a point from a line, which may be a point.
fn off_line(p: DVec2, from: DVec2, to: DVec2) -> f64 {
    if from == to { p.distance(from) } else { OutlineEdge::line(from, to).nearest(p).1 }
}

#[test]
fn the_engagement_is_that_of_dense_points_of_the_circle() {
    let mut random = Random(11);
    let a = 5.0;
    for round in 0..40 {
        let area = [dvec2(-20.0, -20.0), dvec2(20.0, 20.0)];
        let mut clearing = Clearing::new(area, a);
        let stock = rectangle(15.0, 12.0);
        if round % 2 == 1 {
            clearing = clearing.with_stock(&stock);
        }
        let mut swept: Vec<(DVec2, DVec2, f64)> = Vec::new();
        let mut at = dvec2(random.between(-15.0, 15.0), random.between(-15.0, 15.0));
        for _ in 0..30 {
            let far = random.between(0.0, 1.0);
            let next = at + far * far * 12.0 * DVec2::from_angle(random.between(0.0, TAU));
            let radius = if random.between(0.0, 1.0) < 0.1 { random.between(a, 8.0) } else { a };
            let next = next.clamp(area[0], area[1]);
            clearing.sweep(at, next, radius);
            swept.push((at, next, radius));
            at = next;
        }
        let is_stock = |p: DVec2| {
            (round % 2 == 0 || stock.contains(p))
                && swept.iter().all(|(from, to, radius)| off_line(p, *from, *to) > *radius)
        };
        for _ in 0..20 {
            let at = dvec2(random.between(-20.0, 20.0), random.between(-20.0, 20.0));
            let heading = random.between(-PI, PI);
            let found = clearing.engagement(at, heading);
            let steps = 3600;
            let on = |k: i32| {
                let angle = heading - FRAC_PI_2 + PI * (f64::from(k) + 0.5) / f64::from(steps);
                is_stock(at + a * DVec2::from_angle(angle))
            };
            let counted = (0..steps).filter(|k| on(*k)).count() as f64 * PI / f64::from(steps);
            assert!((found.total - counted).abs() < 0.01, "{round}: {} {counted}", found.total);
            let first = (0..steps).find(|k| on(*k)).map_or(PI, |k| f64::from(k) * PI / f64::from(steps));
            assert!((found.from_right - first).abs() < 0.01 || found.total < 0.01, "{round}: {first}");
            assert!(found.largest <= found.total + 1e-12);
        }
    }
}

/// Area that moves at the floor of a level sweep, on a lattice [mm2], and the largest distance over the wall.
fn swept_area(plan: &PocketPlan, a: f64) -> f64 {
    let mut swept = Swept { radius: a, cells: HashMap::new() };
    for planned in plan.moves.iter().filter(|m| m.level == 0 && m.role != ToolpathRole::Retract) {
        let length = planned.curve.length();
        for k in 0..=(length / 0.1).ceil() as usize {
            let p = planned.curve.at((0.1 * k as f64).min(length)).p;
            if p.z < plan.levels[0] + 1e-6 {
                swept.add(p.truncate());
            }
        }
    }
    let step = 0.25;
    let mut count = 0;
    for i in -400..400 {
        for j in -400..400 {
            count += usize::from(swept.holds(dvec2(step * f64::from(i), step * f64::from(j))));
        }
    }
    count as f64 * step * step
}

#[test]
fn conventional_passes_are_the_mirror_of_climb() {
    let climb = spec(ell(), 10.0, 60.0);
    let mirrored =
        PocketSpec { sense: Sense::Conventional, outline: climb.outline.mirrored(), ..climb.clone() };
    let left = PocketSpec { left_hand: true, ..mirrored.clone() };
    let left = PocketSpec { sense: Sense::Climb, ..left };
    let [one, two, three] = [&climb, &mirrored, &left].map(|s| plan_pocket(s).expect("a plan"));
    assert_eq!(two.moves, three.moves);
    assert_eq!(one.moves.len(), two.moves.len());
    for (m, n) in one.moves.iter().zip(&two.moves) {
        let flip = |p: glam::DVec3| glam::dvec3(p.x, -p.y, p.z);
        assert!(flip(m.curve.start()).distance(n.curve.start()) < 1e-6);
        assert!((m.curve.length() - n.curve.length()).abs() < 1e-6);
    }
    assert_eq!((one.figures.passes, one.figures.retracts), (two.figures.passes, two.figures.retracts));
}

#[test]
fn random_pockets_are_cleared_and_nothing_else() {
    let mut random = Random(7);
    let mut planned = 0;
    for round in 0..24 {
        // A star of lines around the middle, some with an island.
        let corners = 3 + round % 7;
        let size = random.between(20.0, 45.0);
        let points: Vec<DVec2> = (0..corners)
            .map(|k| {
                let angle = TAU * (f64::from(k) + random.between(-0.3, 0.3)) / f64::from(corners);
                size * random.between(0.6, 1.0) * DVec2::from_angle(angle)
            })
            .collect();
        let outer = Outline::polygon(&points).expect("a star");
        let island = with_circle_inside(&outer, random.between(2.0, 5.0));
        let outline = if round % 3 == 0 { outer } else { island };
        let diameter = random.between(4.0, 9.0);
        let spec = spec(outline, diameter, random.between(30.0, 90.0));
        let Ok(plan) = plan_pocket(&spec) else { continue };
        planned += 1;
        let found = judge(&spec, &plan, 997);
        assert!(found.left < 1e-3, "{round}: {found:?}");
        // Rings that are hardly wider than the cutter cost the most.
        assert!(plan.figures.cutting < 1.9 * plan.figures.bound, "{round}: {:?}", plan.figures);
        let area = swept_area(&plan, spec.radius());
        let bound = 0.01 * plan.figures.area + plan.figures.left;
        assert!((area - plan.figures.area).abs() < bound, "{round}: {area} of {:?}", plan.figures);
        let joined = plan.moves.windows(2).all(|w| (w[1].curve.start() - w[0].curve.end()).length() < 1e-6);
        assert!(joined, "{round}");
    }
    assert!(planned >= 18, "{planned}");
}

fn with_circle_inside(outer: &Outline, radius: f64) -> Outline {
    with_circle(outer, dvec2(1.0, -2.0), radius)
}

#[test]
fn holes_and_open_sides_need_no_helix() {
    let base = spec(rectangle(60.0, 40.0), 10.0, 60.0);
    let helices = |spec: &PocketSpec| plan_pocket(spec).expect("a plan").figures.entries;
    assert_eq!(helices(&base), 1);
    let hole = |radius: f64| PocketSpec { holes: vec![(dvec2(20.0, 25.0), radius)], ..base.clone() };
    // Half a millimetre around the cutter, at least.
    assert_eq!([helices(&hole(6.0)), helices(&hole(5.5)), helices(&hole(5.4))], [0, 0, 1]);
    let stock = |x: f64| PocketSpec {
        stock: Some(rectangle(x, 100.0).moved(0.0, dvec2(0.0, -30.0))),
        ..base.clone()
    };
    // The cutter has to come in beside the stock.
    assert_eq!([helices(&stock(49.0)), helices(&stock(58.0))], [0, 1]);
    let open = stock(45.0);
    let plan = plan_pocket(&open).expect("a plan");
    // The least length counts stock only: 45 mm of 60, less what corners keep.
    let least = |area: f64| area / (5.0 * (1.0 - open.engagement.cos()));
    let bound = plan.figures.bound;
    assert!(bound < least(45.0 * 40.0) && bound > least(44.0 * 38.0), "{bound}");
    let found = judge(&open, &plan, 101);
    assert!(found.pass < 61.0 && found.left == 0.0, "{found:?}");
}

#[test]
fn parts_between_which_the_cutter_does_not_pass_are_named() {
    let bone = polygon(&[
        [0.0, 0.0],
        [30.0, 0.0],
        [30.0, 11.0],
        [50.0, 11.0],
        [50.0, 0.0],
        [80.0, 0.0],
        [80.0, 30.0],
        [50.0, 30.0],
        [50.0, 19.0],
        [30.0, 19.0],
        [30.0, 30.0],
        [0.0, 30.0],
    ]);
    let plan = plan_pocket(&spec(bone.clone(), 10.0, 60.0)).expect("a plan");
    assert!(plan.findings.len() == 1 && plan.findings[0].message.contains("2 parts"), "{:?}", plan.findings);
    assert_eq!(plan.figures.entries, 2);
    assert!(plan_pocket(&spec(bone, 6.0, 60.0)).expect("a plan").findings.is_empty());
}

#[test]
fn narrow_places_are_refused_or_cleared() {
    let legs = |width: f64| {
        polygon(&[[0.0, 0.0], [60.0, 0.0], [60.0, width], [30.0, width], [30.0, 30.0], [0.0, 30.0]])
    };
    for width in [13.0, 11.0] {
        let spec = spec(legs(width), 10.0, 60.0);
        let plan = plan_pocket(&spec).expect("a plan");
        let found = judge(&spec, &plan, 997);
        assert!(found.pass < 61.0 && found.left == 0.0, "{width}: {found:?}");
    }
    for width in [10.2, 9.0] {
        let outcome = plan_pocket(&spec(legs(width), 10.0, 60.0));
        // A leg that is narrower than the cutter stays, as corners do; one that is hardly wider cannot be cleared.
        assert_eq!(outcome.is_err(), width > 10.0, "{width}");
    }
}
