//! A path of the cutter's centre over the face, in the part's frame.

use glam::DVec2;

use crate::facing::Placement;
use crate::geom::OutlineEdge;

/// A path of the cutter's centre in the part's own frame: chains of lines and arcs in feed. Between chains the cutter
/// is lifted and moves straight.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::passes::PassPath;
/// let path = PassPath::lines(&[vec![dvec2(0.0, 0.0), dvec2(30.0, 0.0)], vec![dvec2(30.0, 40.0), dvec2(0.0, 40.0)]]);
/// assert_eq!(path.feed_length(), 60.0);
/// assert_eq!(path.link_length(), 40.0);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassPath {
    /// The chains in the order they are milled; the pieces of a chain join.
    pub chains: Vec<Vec<OutlineEdge>>,
}

impl PassPath {
    /// The path of these chains; chains without pieces are left out.
    pub fn new(chains: Vec<Vec<OutlineEdge>>) -> PassPath {
        PassPath { chains: chains.into_iter().filter(|c| !c.is_empty()).collect() }
    }

    /// A path of straight pieces: each list of points is a chain.
    pub fn lines(chains: &[Vec<DVec2>]) -> PassPath {
        let chain = |points: &Vec<DVec2>| points.windows(2).map(|w| OutlineEdge::line(w[0], w[1])).collect();
        PassPath::new(chains.iter().map(chain).collect())
    }

    /// A straight pass of a placement over a part whose extent along the feed is `extent`, beginning and ending `run`
    /// beyond it [mm].
    pub fn straight(placement: Placement, extent: [f64; 2], run: f64) -> PassPath {
        let at = |x: f64| placement.in_part(DVec2::new(x, placement.offset));
        PassPath::lines(&[vec![at(extent[0] - run), at(extent[1] + run)]])
    }

    /// Length in feed [mm].
    pub fn feed_length(&self) -> f64 {
        self.chains.iter().flatten().map(OutlineEdge::length).sum()
    }

    /// Length of the links between the chains [mm].
    pub fn link_length(&self) -> f64 {
        self.links().map(|[from, to]| from.distance(to)).sum()
    }

    /// The links: where each chain ends and the next begins.
    pub fn links(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        self.chains.windows(2).filter_map(|w| Some([w[0].last()?.end, w[1].first()?.start]))
    }

    /// The same path the other way round.
    #[must_use]
    pub fn reversed(&self) -> PassPath {
        let chain = |c: &Vec<OutlineEdge>| c.iter().rev().map(OutlineEdge::reversed).collect();
        PassPath { chains: self.chains.iter().rev().map(chain).collect() }
    }

    /// The path turned about the origin by `angle` [rad], then moved by `shift` [mm].
    #[must_use]
    pub fn moved(&self, angle: f64, shift: DVec2) -> PassPath {
        let chain = |c: &Vec<OutlineEdge>| c.iter().map(|e| e.moved(angle, shift)).collect();
        PassPath { chains: self.chains.iter().map(chain).collect() }
    }

    /// The path with `y` and `-y` exchanged, travelled in the same order: what a path over the mirrored case is for an
    /// M4 spindle.
    #[must_use]
    pub fn mirrored(&self) -> PassPath {
        let chain = |c: &Vec<OutlineEdge>| c.iter().map(|e| e.mirrored().reversed()).collect();
        PassPath { chains: self.chains.iter().map(chain).collect() }
    }

    /// True if two paths have the same pieces in the same order to within `distance` [mm]: rows of a part seen from
    /// both sides are the same but for rounding.
    pub fn is_near(&self, other: &PassPath, distance: f64) -> bool {
        let near = |p: DVec2, q: DVec2| p.distance(q) < distance;
        let pieces = |path: &PassPath| path.chains.iter().map(Vec::len).collect::<Vec<_>>();
        let mut both = self.chains.iter().flatten().zip(other.chains.iter().flatten());
        pieces(self) == pieces(other)
            && both.all(|(p, q)| near(p.start, q.start) && near(p.end, q.end) && near(p.at(0.5), q.at(0.5)))
    }

    /// Distance of a point from the nearest place of the path; infinite for a path without pieces [mm].
    pub fn distance(&self, point: DVec2) -> f64 {
        self.chains.iter().flatten().fold(f64::INFINITY, |least, piece| {
            let d = distance(piece, point);
            if d < least { d } else { least }
        })
    }
}

/// Distance of a point from a line or an arc [mm].
pub(super) fn distance(piece: &OutlineEdge, point: DVec2) -> f64 {
    match place(piece, point) {
        NearestOn::End(end) => point.distance(end),
        // Not from the nearest point itself, whose rounding is that of its coordinates.
        NearestOn::Within => match piece.turn {
            None => {
                let way = piece.end - piece.start;
                (point - piece.start).perp_dot(way).abs() / way.length()
            }
            Some(turn) => (point.distance(turn.centre) - turn.radius).abs(),
        },
    }
}

/// The nearest point of a line or an arc [mm].
pub(super) fn nearest(piece: &OutlineEdge, point: DVec2) -> DVec2 {
    match place(piece, point) {
        NearestOn::End(end) => end,
        NearestOn::Within => match piece.turn {
            None => {
                let way = piece.end - piece.start;
                piece.start + ((point - piece.start).dot(way) / way.length_squared()) * way
            }
            Some(turn) => turn.centre + turn.radius * (point - turn.centre).normalize_or(DVec2::X),
        },
    }
}

/// The place of a piece that is nearest to a point: an end, or its inside.
enum NearestOn {
    End(DVec2),
    Within,
}

fn place(piece: &OutlineEdge, point: DVec2) -> NearestOn {
    let within = match piece.turn {
        // A piece without length is its end points.
        None => {
            let way = piece.end - piece.start;
            let along = (point - piece.start).dot(way);
            along > 0.0 && along < way.length_squared()
        }
        Some(turn) => {
            let out = point - turn.centre;
            piece.passes(out.y.atan2(out.x))
        }
    };
    if within {
        return NearestOn::Within;
    }
    let nearer_start = point.distance_squared(piece.start) <= point.distance_squared(piece.end);
    NearestOn::End(if nearer_start { piece.start } else { piece.end })
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;

    #[test]
    fn distances_are_those_of_dense_points() {
        let pieces = [
            OutlineEdge::line(dvec2(1.0, 2.0), dvec2(-3.0, 5.0)),
            OutlineEdge::arc(dvec2(1.0, 1.0), 3.0, 0.4, 2.0),
            OutlineEdge::arc(dvec2(-1.0, 0.0), 2.0, -1.0, -5.0),
        ];
        for piece in &pieces {
            for k in 0..40 {
                let p = 6.0 * DVec2::from_angle(0.7 * f64::from(k)) * (0.05 * f64::from(k % 20));
                let near = (0..=4000).map(|i| piece.at(f64::from(i) / 4000.0).distance(p));
                let near = near.fold(f64::INFINITY, f64::min);
                let have = distance(piece, p);
                assert!(have <= near + 1e-12 && near - have < 2e-3, "{piece:?} {p}: {have} {near}");
                assert!((nearest(piece, p).distance(p) - have).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_mirrored_path_keeps_its_order_and_twice_mirrored_is_itself() {
        let arc = OutlineEdge::arc(dvec2(0.0, 5.0), 5.0, -1.5, 1.0);
        let path = PassPath::new(vec![vec![OutlineEdge::line(dvec2(-9.0, 1.0), arc.start), arc], vec![]]);
        let flipped = path.mirrored();
        assert_eq!(flipped.chains.len(), 1);
        for (a, b) in path.chains[0].iter().zip(&flipped.chains[0]) {
            for s in [0.0, 0.3, 1.0] {
                let (p, q) = (a.at(s), b.at(s));
                assert!((p - dvec2(q.x, -q.y)).length() < 1e-12);
            }
        }
        assert!((path.reversed().feed_length() - path.feed_length()).abs() < 1e-12);
    }
}
