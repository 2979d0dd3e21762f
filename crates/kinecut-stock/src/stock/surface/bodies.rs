//! Bodies for tests whose lines are known exactly: planes, balls, cylinders, cones and what is left of one when
//! others are taken out.

use glam::DVec3;

use crate::stock::{Axis, DexelGrid, EndPoint, Interval, Lattice, PackedNormal, fixed};

/// A stretch of a line inside a body: both ends with the outward normals there.
pub(crate) type BodyChord = (f64, DVec3, f64, DVec3);

/// A convex body, or a double cone with one half in use.
#[derive(Clone, Debug)]
pub(crate) enum Solid {
    /// Intersection of half-spaces `n . p <= d`.
    Planes(Vec<(DVec3, f64)>),
    /// Centre and radius.
    Ball(DVec3, f64),
    /// Point on the axis, unit direction, radius; endless.
    Cylinder(DVec3, DVec3, f64),
    /// Apex, unit direction of the axis into the cone, tangent of half the angle; endless.
    Cone(DVec3, DVec3, f64),
}

pub(crate) fn cuboid(min: DVec3, max: DVec3) -> Solid {
    let mut planes = Vec::new();
    for a in [DVec3::X, DVec3::Y, DVec3::Z] {
        planes.push((a, max.dot(a)));
        planes.push((-a, -min.dot(a)));
    }
    Solid::Planes(planes)
}

impl Solid {
    /// The stretches of the line `p + t e`.
    pub(crate) fn spans(&self, p: DVec3, e: DVec3) -> Vec<BodyChord> {
        match self {
            Solid::Planes(planes) => {
                let (mut lo, mut hi) = ((-1e4, -e), (1e4, e));
                for &(n, d) in planes {
                    let (rate, gap) = (n.dot(e), d - n.dot(p));
                    if rate > 1e-12 {
                        if gap / rate < hi.0 {
                            hi = (gap / rate, n);
                        }
                    } else if rate < -1e-12 {
                        if gap / rate > lo.0 {
                            lo = (gap / rate, n);
                        }
                    } else if gap < 0.0 {
                        return Vec::new();
                    }
                }
                if lo.0 < hi.0 { vec![(lo.0, lo.1, hi.0, hi.1)] } else { Vec::new() }
            }
            Solid::Ball(c, r) => {
                quadratic(1.0, (p - c).dot(e), (p - c).length_squared() - r * r, |t| (p + t * e - c) / *r)
            }
            Solid::Cylinder(c, a, r) => {
                let flat = |v: DVec3| v - *a * v.dot(*a);
                let (q, f) = (flat(p - c), flat(e));
                if f.length_squared() < 1e-18 {
                    return if q.length() < *r { vec![(-1e4, -e, 1e4, e)] } else { Vec::new() };
                }
                quadratic(f.length_squared(), q.dot(f), q.length_squared() - r * r, |t| {
                    flat(p + t * e - c) / *r
                })
            }
            Solid::Cone(c, a, k) => {
                // Inside: |flat|^2 <= k^2 h^2 and h >= 0.
                let q = p - c;
                let (h0, h1) = (q.dot(*a), e.dot(*a));
                let (f0, f1) = (q - *a * h0, e - *a * h1);
                let (aa, bb, cc) = (
                    f1.length_squared() - k * k * h1 * h1,
                    f0.dot(f1) - k * k * h0 * h1,
                    f0.length_squared() - k * k * h0 * h0,
                );
                let normal = |t: f64| {
                    let flat = f0 + f1 * t;
                    (flat / flat.length() - *a * *k) / (1.0 + k * k).sqrt()
                };
                let disc = bb * bb - aa * cc;
                if aa.abs() < 1e-12 || disc <= 0.0 {
                    return if aa < 0.0 && h1.abs() > 0.5 {
                        let t = -bb / aa;
                        if h1 > 0.0 { vec![(t, normal(t), 1e4, e)] } else { vec![(-1e4, -e, t, normal(t))] }
                    } else {
                        Vec::new()
                    };
                }
                let (t0, t1) = ((-bb - disc.sqrt()) / aa, (-bb + disc.sqrt()) / aa);
                let (t0, t1) = (t0.min(t1), t0.max(t1));
                let up = |t: f64| h0 + h1 * t > 0.0;
                if aa > 0.0 {
                    if up(t0) && up(t1) { vec![(t0, normal(t0), t1, normal(t1))] } else { Vec::new() }
                } else if h1 > 0.0 {
                    vec![(t1, normal(t1), 1e4, e)]
                } else {
                    vec![(-1e4, -e, t0, normal(t0))]
                }
            }
        }
    }
}

fn quadratic(a: f64, b: f64, c: f64, normal: impl Fn(f64) -> DVec3) -> Vec<BodyChord> {
    let disc = b * b - a * c;
    if disc <= 0.0 {
        return Vec::new();
    }
    let (t0, t1) = ((-b - disc.sqrt()) / a, (-b + disc.sqrt()) / a);
    vec![(t0, normal(t0), t1, normal(t1))]
}

fn minus(spans: Vec<BodyChord>, cut: BodyChord) -> Vec<BodyChord> {
    let mut out = Vec::new();
    for s in spans {
        if cut.2 <= s.0 || s.2 <= cut.0 {
            out.push(s);
            continue;
        }
        if s.0 < cut.0 {
            out.push((s.0, s.1, cut.0, -cut.1));
        }
        if cut.2 < s.2 {
            out.push((cut.2, -cut.3, s.2, s.3));
        }
    }
    out
}

/// A grid with its lines written out.
pub(crate) struct TestGrid {
    pub(crate) lattice: Lattice,
    pub(crate) lines: [Vec<Vec<Interval>>; 3],
}

impl TestGrid {
    /// A solid without others, on a lattice half a step inside the box.
    pub(crate) fn of(min: DVec3, max: DVec3, step: f64, solid: &Solid, without: &[Vec<Solid>]) -> TestGrid {
        let counts = ((max - min) / step).round().to_array().map(|n| n as u32);
        let lattice = Lattice { origin: min + 0.5 * step, step, counts };
        let lines = Axis::ALL.map(|axis| {
            let (u, v) = axis.others();
            let mut e = DVec3::ZERO;
            e[axis.index()] = 1.0;
            let mut lines = Vec::new();
            for b in 0..counts[v.index()] {
                for a in 0..counts[u.index()] {
                    let mut p = DVec3::ZERO;
                    p[u.index()] = lattice.coordinate(u, a);
                    p[v.index()] = lattice.coordinate(v, b);
                    let mut spans = solid.spans(p, e);
                    for cut in without {
                        for s in together(cut, p, e) {
                            spans = minus(spans, s);
                        }
                    }
                    let end =
                        |t: f64, n: DVec3| EndPoint { at: fixed(t), normal: PackedNormal::new(n, 0), cut: 0 };
                    let spans = spans.into_iter().map(|s| Interval { lo: end(s.0, s.1), hi: end(s.2, s.3) });
                    lines.push(spans.filter(|i| i.lo.at < i.hi.at).collect());
                }
            }
            lines
        });
        TestGrid { lattice, lines }
    }
}

/// The stretches of a line that lie in all of some convex bodies.
fn together(solids: &[Solid], p: DVec3, e: DVec3) -> Vec<BodyChord> {
    let mut spans = vec![(-1e5, -e, 1e5, e)];
    for solid in solids {
        let mut next = Vec::new();
        for s in solid.spans(p, e) {
            for t in &spans {
                let lo = if s.0 > t.0 { (s.0, s.1) } else { (t.0, t.1) };
                let hi = if s.2 < t.2 { (s.2, s.3) } else { (t.2, t.3) };
                if lo.0 < hi.0 {
                    next.push((lo.0, lo.1, hi.0, hi.1));
                }
            }
        }
        spans = next;
    }
    spans
}

impl DexelGrid for TestGrid {
    fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    fn line(&self, axis: Axis, a: u32, b: u32) -> &[Interval] {
        let across = self.lattice.counts[axis.others().0.index()];
        &self.lines[axis.index()][(b * across + a) as usize]
    }
}
