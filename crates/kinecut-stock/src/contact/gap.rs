//! Distance of two convex bodies, each known by its farthest point in a direction.
//!
//! The difference of the bodies is convex, and its point nearest to the origin is as long as the distance. It is approached by
//! simplices of points of its surface. Each step proves a lower bound, the distance of a plane beyond which all of the
//! difference lies, and has an upper one, the point found; so that a search may stop as soon as either decides.
//!
//! Source: Gilbert, Johnson and Keerthi, 1988; the nearest points of triangles and tetrahedra as in Ericson, 2005, section 5.1.

use glam::DVec3;

/// A convex body by its farthest point in a direction, which need not be of unit length.
pub(super) trait Convex {
    /// A point of the body that is farthest in a direction [mm].
    fn farthest(&self, direction: DVec3) -> DVec3;
}

/// Distance of two bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// It is not less than this [mm]; negative or zero where nothing was proven.
    pub(super) least: f64,
    /// It is not more than this [mm]; zero where the bodies overlap.
    pub(super) most: f64,
    /// The point of the second body that is nearest to the first, or a common one.
    pub(super) place: DVec3,
}

/// Steps after which the bounds are taken as they are: flat and round bodies need ten, slivers some more.
const STEPS: usize = 64;
/// Part of the distance, and length [mm], below which both bounds count as one.
const CLOSE: f64 = 1e-7;
const CLOSE_MM: f64 = 1e-6;

/// A point of the difference of the bodies, and the point of the second one in it.
#[derive(Clone, Copy, Debug, Default)]
struct Corner {
    w: DVec3,
    second: DVec3,
}

/// Points of the difference: at most four.
#[derive(Clone, Copy, Debug, Default)]
struct Simplex {
    corners: [Corner; 4],
    count: usize,
}

/// The distance of two bodies. It is not sought any closer once it is known to be more than `far` or not more than `near` [mm].
pub(super) fn gap(first: &impl Convex, second: &impl Convex, near: f64, far: f64) -> Gap {
    let corner = |towards: DVec3| {
        let (p, q) = (first.farthest(towards), second.farthest(-towards));
        Corner { w: p - q, second: q }
    };
    let start = corner(DVec3::X);
    let mut simplex = Simplex { corners: [start; 4], count: 1 };
    let mut v = start.w;
    let mut found = Gap { least: f64::NEG_INFINITY, most: v.length(), place: start.second };
    for _ in 0..STEPS {
        if found.most <= near || found.most <= CLOSE_MM {
            break;
        }
        let next = corner(-v);
        found.least = found.least.max(v.dot(next.w) / found.most);
        let open = found.most - found.least;
        if found.least > far || open <= CLOSE_MM || open <= CLOSE * found.most {
            break;
        }
        if simplex.corners[..simplex.count].iter().any(|c| c.w == next.w) {
            break;
        }
        simplex.corners[simplex.count] = next;
        simplex.count += 1;
        let Some((nearest, place)) = simplex.reduce() else {
            (found.most, found.place) = (0.0, next.second);
            break;
        };
        let length = nearest.length();
        // Rounding: a flat simplex gives no nearer point.
        if length >= found.most {
            break;
        }
        v = nearest;
        (found.most, found.place) = (length, place);
    }
    if found.most <= CLOSE_MM {
        (found.most, found.least) = (0.0, found.least.min(0.0));
    }
    found
}

impl Simplex {
    /// The point nearest to the origin with its place on the second body; the corners that do not hold it are left out. `None`
    /// where the origin is within.
    fn reduce(&mut self) -> Option<(DVec3, DVec3)> {
        let c = self.corners;
        let (kept, shares) = match self.count {
            1 => ([0, 0, 0], [1.0, 0.0, 0.0]),
            2 => segment(&c, 0, 1),
            3 => triangle(&c, 0, 1, 2),
            _ => tetrahedron(&c)?,
        };
        let mut count = 0;
        let (mut nearest, mut place) = (DVec3::ZERO, DVec3::ZERO);
        for (corner, share) in kept.into_iter().zip(shares) {
            if share > 0.0 {
                self.corners[count] = c[corner];
                count += 1;
                nearest += share * c[corner].w;
                place += share * c[corner].second;
            }
        }
        self.count = count;
        Some((nearest, place))
    }
}

/// Corners that hold the nearest point, and its shares of them.
type Held = ([usize; 3], [f64; 3]);

fn segment(c: &[Corner; 4], a: usize, b: usize) -> Held {
    let (p, d) = (c[a].w, c[b].w - c[a].w);
    let t = (-p.dot(d) / d.length_squared()).clamp(0.0, 1.0);
    // Twice the same point.
    let t = if t.is_nan() { 0.0 } else { t };
    ([a, b, b], [1.0 - t, t, 0.0])
}

fn triangle(c: &[Corner; 4], i: usize, j: usize, k: usize) -> Held {
    let (a, b, d) = (c[i].w, c[j].w, c[k].w);
    let (ab, ac) = (b - a, d - a);
    let (d1, d2) = (-ab.dot(a), -ac.dot(a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return ([i, i, i], [1.0, 0.0, 0.0]);
    }
    let (d3, d4) = (-ab.dot(b), -ac.dot(b));
    if d3 >= 0.0 && d4 <= d3 {
        return ([j, j, j], [1.0, 0.0, 0.0]);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return segment(c, i, j);
    }
    let (d5, d6) = (-ab.dot(d), -ac.dot(d));
    if d6 >= 0.0 && d5 <= d6 {
        return ([k, k, k], [1.0, 0.0, 0.0]);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return segment(c, i, k);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return segment(c, j, k);
    }
    let whole = va + vb + vc;
    if !(whole > 0.0) {
        // Three points on a line: the nearest of its sides.
        return least(c, [segment(c, i, j), segment(c, j, k), segment(c, i, k)]);
    }
    ([i, j, k], [va / whole, vb / whole, vc / whole])
}

/// `None` where the origin is within.
fn tetrahedron(c: &[Corner; 4]) -> Option<Held> {
    let faces = [(0, 1, 2, 3), (0, 2, 3, 1), (0, 3, 1, 2), (1, 3, 2, 0)];
    let mut outside = false;
    let mut best: Option<Held> = None;
    for (i, j, k, other) in faces {
        let (a, b, d) = (c[i].w, c[j].w, c[k].w);
        let normal = (b - a).cross(d - a);
        let (origin, beyond) = (-normal.dot(a), normal.dot(c[other].w - a));
        // A flat one has no inside.
        if origin * beyond <= 0.0 {
            outside = true;
            let held = triangle(c, i, j, k);
            best = Some(match best {
                None => held,
                Some(before) => least(c, [before, held, held]),
            });
        }
    }
    if outside { best } else { None }
}

/// The one of three whose point is nearest to the origin.
fn least(c: &[Corner; 4], all: [Held; 3]) -> Held {
    let length = |held: &Held| {
        let point: DVec3 = held.0.iter().zip(held.1).map(|(i, share)| c[*i].w * share).sum();
        point.length_squared()
    };
    let mut best = all[0];
    for held in &all[1..] {
        if length(held) < length(&best) {
            best = *held;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Points, and all within a distance of what lies between them.
    struct Rounded(Vec<DVec3>, f64);

    impl Convex for Rounded {
        fn farthest(&self, d: DVec3) -> DVec3 {
            let mut best = self.0[0];
            for p in &self.0 {
                if p.dot(d) > best.dot(d) {
                    best = *p;
                }
            }
            best + self.1 * d.normalize_or_zero()
        }
    }

    fn point() -> impl Strategy<Value = DVec3> {
        (-50.0..50.0f64, -50.0..50.0f64, -50.0..50.0f64).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    #[test]
    fn simple_bodies_are_as_far_apart_as_they_are() {
        let ball = |at: [f64; 3], r: f64| Rounded(vec![at.into()], r);
        let apart = |a: &Rounded, b: &Rounded| gap(a, b, 0.0, f64::INFINITY);
        let two = apart(&ball([0.0; 3], 2.0), &ball([3.0, 4.0, 0.0], 1.0));
        assert!((two.most - 2.0).abs() < 2e-6 && (two.least - 2.0).abs() < 2e-6, "{two:?}");
        assert!((two.place - DVec3::new(2.4, 3.2, 0.0)).length() < 1e-3);
        assert_eq!(apart(&ball([0.0; 3], 2.0), &ball([1.0, 1.0, 0.0], 1.0)).most, 0.0);
        // Two edges that cross, 7 apart.
        let edge = |a: [f64; 3], b: [f64; 3]| Rounded(vec![a.into(), b.into()], 0.0);
        let crossed =
            apart(&edge([-9.0, 0.0, 0.0], [9.0, 0.0, 0.0]), &edge([0.0, -9.0, 7.0], [0.0, 9.0, 7.0]));
        assert!((crossed.most - 7.0).abs() < 1e-9 && (crossed.least - 7.0).abs() < 1e-6);
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(2000))]

        /// The bounds hold and meet: against the best of many directions and of many pairs of points.
        #[test]
        fn bounds_hold(
            a in prop::collection::vec(point(), 1..6), b in prop::collection::vec(point(), 1..6), away in point(),
            rounds in (0.0..5.0f64, 0.0..5.0f64),
        ) {
            let first = Rounded(a, rounds.0);
            let second = Rounded(b.iter().map(|p| *p + 1.5 * away).collect(), rounds.1);
            let found = gap(&first, &second, 0.0, f64::INFINITY);
            prop_assert!(found.least <= found.most + 1e-9);
            if found.most > 0.0 {
                prop_assert!(found.most - found.least < 1e-4, "{:?}", found);
                // A plane proves the lower bound: no pair of corners is nearer along the line between the places.
                let mixed = |points: &[DVec3], shares: &[f64]| -> DVec3 {
                    let sum: f64 = shares.iter().sum();
                    points.iter().zip(shares).map(|(p, s)| *p * (*s / sum)).sum()
                };
                for i in 0..200u32 {
                    let share = |k: u32| f64::from((i * 7919 + k * 104_729) % 1000) / 1000.0 + 1e-3;
                    let p = mixed(&first.0, &[share(1), share(2), share(3), share(4), share(5)][..first.0.len()]);
                    let q = mixed(&second.0, &[share(6), share(7), share(8), share(9), share(10)][..second.0.len()]);
                    prop_assert!((p - q).length() - rounds.0 - rounds.1 >= found.least - 1e-6);
                }
            }
        }

        /// A search that may stop early is not wrong.
        #[test]
        fn it_stops_early(a in prop::collection::vec(point(), 1..6), b in prop::collection::vec(point(), 1..6), at in 0.0..60.0f64) {
            let (first, second) = (Rounded(a, 1.0), Rounded(b, 0.0));
            let whole = gap(&first, &second, 0.0, f64::INFINITY);
            let early = gap(&first, &second, at, at);
            prop_assert!(early.least <= whole.most + 1e-6 && early.most >= whole.least - 1e-6);
            prop_assert!(early.least > at || early.most <= at || (whole.most - at).abs() < 1e-3);
        }
    }
}
