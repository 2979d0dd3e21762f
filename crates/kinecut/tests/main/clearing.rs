//! Pockets: engagement, completeness and lengths, judged by distances to all that was cut before.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, dvec2};
use kinecut::clearing::{PocketPlan, PocketSpec, WALL_STOCK, plan_pocket};
use kinecut::geom::{NearestEdge, Outline, OutlineEdge};
use kinecut::holes::{CutterData, ToolpathRole};

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

/// What the judge has found.
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
    let a = spec.radius();
    let near = NearestEdge::new(spec.outline.edges());
    let stock = |p: DVec2| spec.stock.as_ref().is_none_or(|s| s.contains(p));
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
            if planned.role == ToolpathRole::Entry || is_pass {
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
