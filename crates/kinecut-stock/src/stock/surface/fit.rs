//! The vertex that fits the end points of a leaf: on the face, on the edge or in the corner they describe.
//!
//! Normals are gathered in clusters, one for each smooth face in the leaf. An end point p with normal n of a cluster
//! with mean normal c says (n + c) . (v - p) = 0: on a circle or sphere the chord between two points is normal to the
//! mean of their normals, so the vertex lies on a curved face, not on its tangent. Every cluster has the same weight,
//! however much of its face lies in the leaf. Least squares about the mean of the points; directions in which the
//! planes say less than [`CUT_OFF`] are left at the mean (Ju et al. 2002, with clusters instead of single planes).

use glam::{DMat3, DVec3};

use crate::num::eigen::symmetric_eigen;

/// Largest distance of a vertex outside its leaf when its end points agree on it [cells]. A wedge or spike can reach so
/// far between the lattice lines into a cell in which no point is material; its sharp edge belongs there.
const OVERHANG: f64 = 1.0;

/// Normals within this cosine (18 degrees) of a cluster's first one belong to it. Faces that meet at less than that
/// count as one smooth face: the error of doing so is below a tenth of a cell in a single cell.
const ALIKE: f64 = 0.95;

/// Eigenvalues below this part of the largest do not count. Two faces at 18 degrees have 0.025; the spread of
/// normals within one cluster stays below 0.01.
const CUT_OFF: f64 = 0.02;

/// Normals of a single cell within this cosine (37 degrees) of their mean may belong to one strongly curved face.
const ROUND: f64 = 0.8;

/// They do if a round face fits the ends so well [cells]; an edge almost never does.
const ROUND_FIT: f64 = 0.02;

/// An edge is taken to be no shorter than this [cells]: an end point or two say nothing about its curvature.
const LEAST_EDGE: f64 = 0.25;

/// Most faces that are distinguished.
const MOST_CLUSTERS: usize = 6;

/// An end point in a leaf: place [cells], outward unit normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hermite {
    pub(super) p: DVec3,
    pub(super) n: DVec3,
}

/// A vertex and how well it fits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    pub(super) vertex: DVec3,
    /// Largest distance of an end point from the plane of its face through the vertex [cells].
    pub(super) residual: f64,
    /// On an edge, the length along which the leaf has end points of all its faces [cells]; else infinite.
    pub(super) edge: f64,
}

impl Fit {
    /// Largest distance [cells] from the surface to be expected of facets between leaves of this size. A leaf that
    /// an edge touches in a corner only has a vertex there, and facets to the leaves along its whole side: they are
    /// chords of the edge as long as the leaf, while the residual is that of the short piece inside. The distance of
    /// a chord grows with the square of its length.
    pub(super) fn error(&self, size: f64) -> f64 {
        let longer = if self.edge < size { size / self.edge.clamp(LEAST_EDGE, size) } else { 1.0 };
        self.residual * longer * longer
    }
}

#[derive(Clone, Copy, Default)]
struct Cluster {
    seed: DVec3,
    sum: DVec3,
    count: f64,
}

/// The vertex of a piece of surface in a single cell.
pub(super) fn fit_cell(points: &[Hermite], low: DVec3, high: DVec3, cluster_of: &mut Vec<u8>) -> DVec3 {
    let n = points.iter().map(|h| h.n).sum::<DVec3>().try_normalize().unwrap_or(DVec3::ZERO);
    if points.iter().all(|h| h.n.dot(n) > ROUND) {
        let v = shifted(points, points.iter().map(|h| h.p).sum::<DVec3>() / points.len() as f64, n);
        let off = |h: &Hermite| (h.n + n).dot(h.p - v).abs() / (h.n + n).length();
        if points.iter().all(|h| off(h) < ROUND_FIT) {
            return v.clamp(low, high);
        }
    }
    fit(points, low, high, ROUND_FIT, cluster_of).vertex
}

/// The stretch, from the mean on, of an edge along which all of its faces have end points; may end before it begins.
fn stretch(edge: DVec3, mean: DVec3, points: &[Hermite], cluster_of: &[u8], count: usize) -> (f64, f64) {
    let mut reach = [(f64::INFINITY, f64::NEG_INFINITY); MOST_CLUSTERS];
    for (h, &c) in points.iter().zip(cluster_of) {
        let (at, reach) = (edge.dot(h.p - mean), &mut reach[usize::from(c)]);
        *reach = (reach.0.min(at), reach.1.max(at));
    }
    let all = |a: (f64, f64), b: &(f64, f64)| (a.0.max(b.0), a.1.min(b.1));
    reach[..count].iter().fold((f64::NEG_INFINITY, f64::INFINITY), all)
}

/// The mean of points moved along the mean normal of a smooth face onto the face.
fn shifted(points: &[Hermite], mean: DVec3, n: DVec3) -> DVec3 {
    let (mut above, mut weight) = (0.0, 0.0);
    for h in points {
        let m = h.n + n;
        above += m.dot(h.p - mean) * m.dot(n);
        weight += m.dot(n) * m.dot(n);
    }
    mean + n * (above / weight)
}

/// The vertex that fits points best, within a box or, if it fits within the tolerance, near it. `points` must not be
/// empty; `cluster_of` is scratch.
pub(super) fn fit(
    points: &[Hermite],
    low: DVec3,
    high: DVec3,
    tolerance: f64,
    cluster_of: &mut Vec<u8>,
) -> Fit {
    let mut clusters = [Cluster::default(); MOST_CLUSTERS];
    let mut count = 0;
    let mut mean = DVec3::ZERO;
    cluster_of.clear();
    let mut last = 0;
    for h in points {
        mean += h.p;
        // Neighbours mostly belong to the same face.
        let mut c = last;
        if !(c < count && clusters[c].seed.dot(h.n) > ALIKE) {
            c = (0..count).find(|&c| clusters[c].seed.dot(h.n) > ALIKE).unwrap_or(count);
        }
        if c == MOST_CLUSTERS {
            let nearest =
                |a: &usize, b: &usize| clusters[*a].seed.dot(h.n).total_cmp(&clusters[*b].seed.dot(h.n));
            c = (0..count).max_by(nearest).unwrap_or(0);
        } else if c == count {
            clusters[c].seed = h.n;
            count += 1;
        }
        clusters[c].sum += h.n;
        clusters[c].count += 1.0;
        cluster_of.push(c as u8);
        last = c;
    }
    mean /= points.len() as f64;
    for c in &mut clusters[..count] {
        c.sum = c.sum.try_normalize().unwrap_or(c.seed);
    }
    let mut edge = f64::INFINITY;
    let vertex = if count == 1 {
        shifted(points, mean, clusters[0].sum)
    } else {
        let mut a = DMat3::ZERO;
        let mut b = DVec3::ZERO;
        for (h, &c) in points.iter().zip(cluster_of.iter()) {
            let cluster = &clusters[usize::from(c)];
            let m = (h.n + cluster.sum).try_normalize().unwrap_or(h.n);
            let w = m / cluster.count;
            a += DMat3::from_cols(w * m.x, w * m.y, w * m.z);
            b += w * m.dot(h.p - mean);
        }
        let (values, vectors) = symmetric_eigen(a);
        let mut v = mean;
        for (i, (value, vector)) in values.to_array().into_iter().zip(vectors).enumerate() {
            if value > CUT_OFF * values.x {
                v += vector * (vector.dot(b) / value);
            } else if i == 2 {
                let (from, to) = stretch(vector, mean, points, cluster_of, count);
                edge = to - from;
                v += vector * ((from + to) * 0.5);
            }
        }
        v
    };
    let residual = |vertex: DVec3| {
        let off = |(h, &c): (&Hermite, &u8)| clusters[usize::from(c)].sum.dot(h.p - vertex).abs();
        points.iter().zip(cluster_of.iter()).map(off).fold(0.0, f64::max)
    };
    let near = vertex.clamp(low - OVERHANG, high + OVERHANG);
    let moved = near.clamp(low, high);
    // The tip of a cone is on the tangent planes of all of its points.
    let agreed = |(h, &c): (&Hermite, &u8)| {
        let off = |n: DVec3| n.dot(h.p - near).abs();
        off(clusters[usize::from(c)].sum).min(off(h.n)) <= tolerance
    };
    if near == moved || points.iter().zip(cluster_of.iter()).all(agreed) {
        Fit { vertex: near, residual: residual(near), edge }
    } else {
        Fit { vertex: moved, residual: residual(moved), edge }
    }
}
