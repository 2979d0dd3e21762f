//! Exit angles and bad length of any path, exactly.
//!
//! Piece after piece of the path takes from each edge the part that it covers of what was left: the ends of these
//! stretches are where the edge meets the offsets of the piece or the discs about its ends, all closed forms. Within a
//! stretch the exit angle passes a bound where two lines or circles meet ([`super::contact`]). Each gap between these
//! places is judged by its middle; nothing is sampled.

use std::f64::consts::PI;

use glam::DVec2;

use super::contact::{borders, centres, exit_angle};
use super::meet::meet;
use super::path::distance;
use super::{EdgeStretch, Met, PassPath, PathBurr};
use crate::facing::{BadSet, FaceCase};
use crate::geom::OutlineEdge;

/// Points nearer than this to the border of the cutter, per size of the case, are not covered: rounding of coordinates.
const ZERO: f64 = 1e-12;

/// Exit angles nearer than this to the end of a bad interval are not bad [rad]: an edge along the feed keeps one exit
/// angle, which rounding must not move over the end.
const ANGLE_ZERO: f64 = 1e-10;

/// Burrs that a path leaves at the edges of a case: first contact decides the exit angle of each point of the outline.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::passes::{PassPath, path_burr};
/// use kinecut::facing::{BadSet, FaceCase};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(100.0, 0.0), dvec2(100.0, 60.0), dvec2(0.0, 60.0)])?;
/// let case = FaceCase::new(plate, 50.0, BadSet::below(90f64.to_radians())?)?;
/// let centred = PassPath::lines(&[vec![dvec2(-60.0, 30.0), dvec2(160.0, 30.0)]]);
/// assert!((path_burr(&case, &centred).bad - 130.0).abs() < 1e-9);
/// // Round the part with the edge on the left of the feed: every tooth enters there.
/// let round = [dvec2(-60.0, 0.0), dvec2(-60.0, 70.0), dvec2(110.0, 70.0), dvec2(110.0, -10.0), dvec2(-60.0, -10.0)];
/// assert_eq!(path_burr(&case, &PassPath::lines(&[round.to_vec()])).bad, 0.0);
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn path_burr(case: &FaceCase, path: &PassPath) -> PathBurr {
    let mut law = ExitLaw::new(case);
    let pieces: Vec<Reached> = path.chains.iter().flatten().map(|p| Reached::new(p, case.radius)).collect();
    let mut burr = PathBurr::default();
    for (index, edge) in case.outline.edges().iter().enumerate() {
        let first = burr.stretches.len();
        law.edge(index, edge, path, &pieces, &mut burr.stretches);
        let stretches = &mut burr.stretches[first..];
        stretches.sort_by(|a, b| a.from.total_cmp(&b.from));
        for s in stretches.iter() {
            let length = (s.to - s.from) * edge.length();
            match s.met {
                Met::Never => burr.uncut += length,
                Met::Lowered { .. } => burr.lowered += length,
                Met::First { exit, weight, .. } => {
                    burr.bad += length * weight * case.weights[index];
                    *if exit { &mut burr.exits } else { &mut burr.entries } += length;
                }
            }
        }
    }
    burr
}

/// A piece of path with the box its cutter reaches.
struct Reached {
    low: DVec2,
    high: DVec2,
}

impl Reached {
    fn new(piece: &OutlineEdge, radius: f64) -> Reached {
        let ([x0, x1], [y0, y1]) = (piece.extent(DVec2::X), piece.extent(DVec2::Y));
        Reached {
            low: DVec2::new(x0, y0) - DVec2::splat(radius),
            high: DVec2::new(x1, y1) + DVec2::splat(radius),
        }
    }

    fn reaches(&self, other: &Reached) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// The case with the exit angles at which something changes, and space that is used again.
struct ExitLaw<'a> {
    radius: f64,
    near: f64,
    bad: &'a BadSet,
    bounds: Vec<f64>,
    shares: Vec<f64>,
    inner: Vec<f64>,
    left: Vec<[f64; 2]>,
    next: Vec<[f64; 2]>,
}

impl<'a> ExitLaw<'a> {
    fn new(case: &'a FaceCase) -> ExitLaw<'a> {
        let [low, high] = case.outline.bounds();
        let mut bounds: Vec<f64> = case.bad.parts().iter().flat_map(|p| [p.from, p.to]).collect();
        bounds.extend([0.0, PI]);
        bounds.sort_by(f64::total_cmp);
        bounds.dedup();
        ExitLaw {
            radius: case.radius,
            near: ZERO * (case.radius + low.length() + high.length()),
            bad: &case.bad,
            bounds,
            shares: Vec::new(),
            inner: Vec::new(),
            left: Vec::new(),
            next: Vec::new(),
        }
    }

    fn edge(
        &mut self,
        index: usize,
        edge: &OutlineEdge,
        path: &PassPath,
        pieces: &[Reached],
        out: &mut Vec<EdgeStretch>,
    ) {
        let first = out.len();
        self.left.clear();
        self.left.push([0.0, 1.0]);
        let bounds = Reached::new(edge, 0.0);
        let mut count = 0;
        for (c, chain) in path.chains.iter().enumerate() {
            for (k, piece) in chain.iter().enumerate() {
                let reach = &pieces[count];
                count += 1;
                if self.left.is_empty() {
                    return;
                }
                if !reach.reaches(&bounds) {
                    continue;
                }
                if k == 0 {
                    let point = OutlineEdge::line(piece.start, piece.start);
                    self.take(edge, &point, out, |_, from, to, out| {
                        out.push(EdgeStretch { edge: index, from, to, met: Met::Lowered { chain: c } });
                    });
                }
                self.take(edge, piece, out, |law, from, to, out| {
                    law.split(edge, piece, from, to, |from, to, angles, exit, weight| {
                        let met = Met::First { chain: c, piece: k, angles, exit, weight };
                        push_joined(out, first, EdgeStretch { edge: index, from, to, met });
                    });
                });
            }
        }
        let left = self.left.iter().map(|&[from, to]| EdgeStretch { edge: index, from, to, met: Met::Never });
        out.extend(left);
    }

    /// Takes from what is left of the edge the stretches that the piece covers, and calls `taken` with each.
    fn take(
        &mut self,
        edge: &OutlineEdge,
        piece: &OutlineEdge,
        out: &mut Vec<EdgeStretch>,
        mut taken: impl FnMut(&mut Self, f64, f64, &mut Vec<EdgeStretch>),
    ) {
        self.shares.clear();
        let point = piece.turn.is_none() && piece.start == piece.end;
        for border in borders(piece, self.radius).into_iter().take(if point { 1 } else { 4 }) {
            meet(edge, border, &mut self.shares);
        }
        self.shares.extend([0.0, 1.0]);
        self.shares.extend(self.left.iter().flatten());
        self.shares.sort_by(f64::total_cmp);
        self.shares.dedup();
        self.next.clear();
        let (shares, left) = (std::mem::take(&mut self.shares), std::mem::take(&mut self.left));
        let mut open: Option<[f64; 2]> = None;
        let mut of_left = 0;
        for w in shares.windows(2) {
            while of_left < left.len() && left[of_left][1] <= w[0] {
                of_left += 1;
            }
            if of_left == left.len() {
                break;
            }
            if left[of_left][0] > w[0] {
                continue;
            }
            let middle = edge.at(0.5 * (w[0] + w[1]));
            if distance(piece, middle) < self.radius - self.near {
                match &mut open {
                    Some(stretch) if stretch[1] == w[0] => stretch[1] = w[1],
                    _ => {
                        if let Some([from, to]) = open.replace([w[0], w[1]]) {
                            taken(self, from, to, out);
                        }
                    }
                }
            } else {
                match self.next.last_mut() {
                    Some(last) if last[1] == w[0] => last[1] = w[1],
                    _ => self.next.push([w[0], w[1]]),
                }
            }
        }
        if let Some([from, to]) = open {
            taken(self, from, to, out);
        }
        self.shares = shares;
        self.left = left;
        std::mem::swap(&mut self.left, &mut self.next);
    }

    /// Cuts a stretch that the piece meets first where the exit angle passes a bound.
    fn split(
        &mut self,
        edge: &OutlineEdge,
        piece: &OutlineEdge,
        from: f64,
        to: f64,
        mut found: impl FnMut(f64, f64, [f64; 2], bool, f64),
    ) {
        let whole = super::meet::Whole::of(piece);
        self.inner.clear();
        for &psi in &self.bounds {
            if let Some(locus) = centres(edge, self.radius, psi) {
                meet(&locus, whole, &mut self.inner);
            }
        }
        self.inner.retain(|&s| from < s && s < to);
        self.inner.extend([from, to]);
        self.inner.sort_by(f64::total_cmp);
        let at = |s: f64| exit_angle(edge, s, piece, self.radius);
        let tell = |s: f64| {
            let psi = at(s);
            let inside = |from: f64, to: f64| from + ANGLE_ZERO < psi && psi < to - ANGLE_ZERO;
            let layers = self.bad.layers().iter().filter(|p| inside(p.from, p.to));
            (inside(0.0, PI), layers.map(|p| p.weight).sum::<f64>())
        };
        let mut open: Option<(f64, f64, (bool, f64))> = None;
        for w in self.inner.windows(2).filter(|w| w[1] > w[0]) {
            let told = tell(0.5 * (w[0] + w[1]));
            match &mut open {
                Some((_, end, same)) if *same == told => *end = w[1],
                _ => {
                    if let Some((a, b, (exit, weight))) = open.replace((w[0], w[1], told)) {
                        found(a, b, [at(a), at(b)], exit, weight);
                    }
                }
            }
        }
        if let Some((a, b, (exit, weight))) = open {
            found(a, b, [at(a), at(b)], exit, weight);
        }
    }
}

/// Appends a stretch, or lengthens the last one if it is of the same kind and piece.
fn push_joined(out: &mut Vec<EdgeStretch>, first: usize, stretch: EdgeStretch) {
    if out.len() > first
        && let Some(last) = out.last_mut()
        && last.to == stretch.from
        && let (
            Met::First { chain: c1, piece: k1, angles: a1, exit: e1, weight: w1 },
            Met::First { chain, piece, angles, exit, weight },
        ) = (&mut last.met, stretch.met)
        && (*c1, *k1, *e1, *w1) == (chain, piece, exit, weight)
    {
        last.to = stretch.to;
        a1[1] = angles[1];
        return;
    }
    out.push(stretch);
}
