//! The share of a point in material where no closed form holds: an eccentric or blind hole that is there, or a body of
//! which only the passages are known.

use super::share::{passed, passed_ceiling, passed_recess};
use crate::drilling::{BoundarySurface, DrillPlan, DrillSpec, Side};
use crate::page::simplify;

/// Rings of equal area and places on each: an error of the share below a hundredth.
const RINGS: u32 = 96;
const PLACES: u32 = 120;

/// Source of the share.
pub(super) enum Share<'a> {
    /// From surfaces that cover the whole edge or a strip of it.
    Closed(&'a DrillSpec, &'a DrillPlan),
    /// Counted over places of the edge: for each sheet its sign and S - z of each place, falling.
    Counted(Vec<(f64, Vec<f64>)>, f64),
    /// At the ends of passages of a body, in between by straight lines: Z, falling, and share.
    Known(Vec<[f64; 2]>),
}

impl<'a> Share<'a> {
    /// The share along a hole.
    pub(super) fn of(spec: &'a DrillSpec, plan: &'a DrillPlan) -> Share<'a> {
        let simple = spec.pre_hole.as_ref().is_none_or(|h| h.bottom.is_none() && h.is_concentric());
        match &spec.passages {
            Some(_) => Share::Known(known(plan)),
            None if simple => Share::Closed(spec, plan),
            None => counted(spec, plan),
        }
    }

    /// Whether it holds everywhere, not only where passages begin and end.
    pub(super) fn is_complete(&self) -> bool {
        !matches!(self, Share::Known(_))
    }

    /// The share with the reference point at a Z [mm].
    pub(super) fn at(&self, z: f64) -> f64 {
        let share = match self {
            Share::Closed(spec, plan) => {
                let one = |surface: &BoundarySurface| passed(&plan.edge, surface, z);
                let entered = match &spec.mouth {
                    Some(mouth) => passed_recess(&plan.edge, mouth, &spec.entry, z),
                    None => one(&spec.entry),
                };
                let left = match (&spec.ceiling, spec.end.exit()) {
                    (Some(ceiling), Some(exit)) => passed_ceiling(&plan.edge, ceiling, exit, z),
                    (None, Some(exit)) => one(exit),
                    (_, None) => 0.0,
                };
                let mut share = entered - left;
                for bore in &spec.bores {
                    let [roof, floor] = walls(bore.radius, bore.offset, bore.height);
                    share += one(&floor) - one(&roof);
                }
                share
            }
            Share::Counted(sheets, count) => {
                let one =
                    |(sign, values): &(f64, Vec<f64>)| sign * values.partition_point(|v| *v >= z) as f64;
                sheets.iter().map(one).sum::<f64>() / count
            }
            Share::Known(points) => {
                let after = points.partition_point(|p| p[0] > z);
                match (after.checked_sub(1).map(|i| points[i]), points.get(after)) {
                    (Some(a), Some(b)) if b[0] < a[0] => a[1] + (b[1] - a[1]) * (a[0] - z) / (a[0] - b[0]),
                    (_, Some(b)) => b[1],
                    (Some(a), None) => a[1],
                    (None, None) => 0.0,
                }
            }
        };
        share.clamp(0.0, 1.0)
    }
}

/// Roof and floor of a bore.
fn walls(radius: f64, offset: f64, height: f64) -> [BoundarySurface; 2] {
    [BoundarySurface::Ridge { radius, offset, height }, BoundarySurface::Valley { radius, offset, height }]
}

fn counted(spec: &DrillSpec, plan: &DrillPlan) -> Share<'static> {
    let edge = &plan.edge;
    let (inner, outer) = (edge.inner_radius(), edge.outer_radius());
    let mut sheets: Vec<(f64, Vec<f64>)> = vec![(1.0, Vec::new())];
    let mut count = 0.0;
    let (mut out, mut roofs, mut floors) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..RINGS {
        let part = (f64::from(i) + 0.5) / f64::from(RINGS);
        let r = (inner * inner + (outer * outer - inner * inner) * part).sqrt();
        let Some(z) = edge.height(r) else { continue };
        for j in 0..PLACES {
            let (sin, cos) = (std::f64::consts::TAU * (f64::from(j) + 0.5) / f64::from(PLACES)).sin_cos();
            let (x, y) = (r * cos, r * sin);
            let along = |turn: f64| x * turn.cos() + y * turn.sin();
            let mut top = spec.entry.height(x);
            if let Some(depth) = spec.mouth.as_ref().and_then(|m| Some(m.height + m.edge.height(r)?)) {
                top = depth;
            }
            if let Some(hole) = &spec.pre_hole {
                let d = (x - hole.at[0]).hypot(y - hole.at[1]);
                if d < 0.5 * hole.diameter {
                    let Some(bottom) = &hole.bottom else { continue };
                    top = bottom.height + bottom.edge.height(d).unwrap_or(0.0);
                }
            }
            count += 1.0;
            sheets[0].1.push(top - z);
            out.extend(spec.end.exit().map(|s| s.height(along(spec.exit_turn)) - z));
            for bore in &spec.bores {
                let u = along(bore.turn);
                if (bore.offset + u).abs() < bore.radius {
                    let [roof, floor] = walls(bore.radius, bore.offset, bore.height).map(|s| s.height(u) - z);
                    roofs.push(roof);
                    floors.push(floor);
                }
            }
        }
    }
    sheets.extend([(-1.0, out), (-1.0, roofs), (1.0, floors)]);
    sheets.iter_mut().for_each(|s| s.1.sort_unstable_by(|a, b| b.total_cmp(a)));
    Share::Counted(sheets, if count > 0.0 { count } else { 1.0 })
}

/// The share wherever no passage is under way, from the shares of those passed.
fn known(plan: &DrillPlan) -> Vec<[f64; 2]> {
    let mut zs: Vec<f64> = plan.passages.iter().flat_map(|p| [p.transient.first, p.transient.last]).collect();
    zs.extend([plan.travel.start, plan.travel.end]);
    zs.sort_unstable_by(|a, b| b.total_cmp(a));
    let free = |z: &f64| plan.passages.iter().all(|p| *z >= p.transient.first || *z <= p.transient.last);
    let share = |z: f64| {
        let passed = plan.passages.iter().filter(|p| z <= p.transient.last);
        passed.map(|p| if p.side == Side::Entry { p.share } else { -p.share }).sum::<f64>()
    };
    let points: Vec<[f64; 2]> = zs.into_iter().filter(free).map(|z| [z, share(z)]).collect();
    let kept = simplify::kept(&points, 0.0);
    kept.into_iter().map(|i| points[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drilling::{Passage, PreHole, Transient, plan_drill};
    use crate::tool::DrillPoint;

    fn plate() -> DrillSpec {
        let flat = |height| BoundarySurface::Plane { height, slope: 0.0 };
        let point = DrillPoint::SinglePlane { angle: 118f64.to_radians() };
        DrillSpec { length: 40.0, ..DrillSpec::new(20.0, point, flat(0.0), flat(-40.0)) }
    }

    #[test]
    fn an_eccentric_hole_is_left_out_and_the_bottom_of_a_blind_one_comes_later() {
        let mut spec = plate();
        spec.pre_hole = Some(PreHole::through(6.0).moved([4.0, 0.0]));
        let plan = plan_drill(&spec).unwrap();
        let share = Share::of(&spec, &plan);
        assert!(matches!(share, Share::Counted(..)));
        assert_eq!((share.at(1.0), share.at(-20.0), share.at(-60.0)), (0.0, 1.0, 0.0));
        spec.pre_hole = Some(PreHole::flat(6.0, -10.0).unwrap().moved([4.0, 0.0]));
        let plan = plan_drill(&spec).unwrap();
        let share = Share::of(&spec, &plan);
        // All but the hole of 3 mm in 10 mm.
        assert!((share.at(-7.0) - 0.91).abs() < 0.01, "{}", share.at(-7.0));
        assert!((share.at(-20.0) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn counting_agrees_with_the_closed_form() {
        let mut spec = plate();
        spec.entry = BoundarySurface::Ridge { radius: 40.0, offset: 7.0, height: 0.0 };
        let plan = plan_drill(&spec).unwrap();
        let closed = Share::of(&spec, &plan);
        let counted = counted(&spec, &plan);
        for z in [38.0, 36.0, 33.0, 31.0] {
            assert!((closed.at(z) - counted.at(z)).abs() < 0.01, "{z}: {} {}", closed.at(z), counted.at(z));
        }
    }

    #[test]
    fn of_a_body_the_share_is_known_between_its_passages() {
        let mut spec = plate();
        let passage = |first, last, side, share| Passage {
            transient: Transient { first, last, first_radius: 0.0, last_radius: 10.0 },
            side,
            share,
        };
        spec.passages = Some(vec![
            passage(0.0, -4.0, Side::Entry, 0.75),
            passage(-10.0, -16.0, Side::Entry, 0.25),
            passage(-40.0, -46.0, Side::Exit, 1.0),
        ]);
        let plan = plan_drill(&spec).unwrap();
        let share = Share::of(&spec, &plan);
        assert!(!share.is_complete());
        assert_eq!(
            [0.0, -2.0, -7.0, -13.0, -30.0, -46.0].map(|z| share.at(z)),
            [0.0, 0.375, 0.75, 0.875, 1.0, 0.0]
        );
    }
}
