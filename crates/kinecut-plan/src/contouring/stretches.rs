//! Stretches of the loops of an outline, joined to a set: which parts of a loop lie on it, and which do not.

use super::OutlinePiece;
use crate::geom::{Outline, OutlineEdge};

/// Stretches of the loops of an outline; their places count modulo the length of the loop.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::contouring::{LoopStretches, OutlinePiece};
/// use kinecut::geom::Outline;
/// let square = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(10.0, 0.0), dvec2(10.0, 10.0), dvec2(0.0, 10.0)])?;
/// let over_the_end = OutlinePiece { of_loop: 0, along: [35.0, 42.0] };
/// let stretches = LoopStretches::new(&square, &[over_the_end]);
/// let split = stretches.split(0, [1.0, 38.0]);
/// assert_eq!((split.on, split.off), (vec![[1.0, 2.0], [35.0, 38.0]], vec![[2.0, 35.0]]));
/// # Ok::<(), kinecut::base::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LoopStretches {
    /// For each loop what lies on it, from its first point to its end, ascending, apart from one another [mm].
    loops: Vec<Vec<[f64; 2]>>,
}

/// A part of a loop, divided into what lies on stretches and what does not, each ascending [mm].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SplitStretch {
    /// On them.
    pub on: Vec<[f64; 2]>,
    /// Off them.
    pub off: Vec<[f64; 2]>,
}

/// Lengths and gaps that are rounding [mm].
const ROUNDING: f64 = 1e-7;

impl LoopStretches {
    /// The stretches of an outline, which may overlap.
    pub fn new(outline: &Outline, stretches: &[OutlinePiece]) -> LoopStretches {
        let of = |of_loop: usize| {
            let whole = loop_length(outline, of_loop);
            let mut all: Vec<[f64; 2]> = Vec::new();
            for [from, to] in stretches.iter().filter(|s| s.of_loop == of_loop).map(|s| s.along) {
                if to - from >= whole - ROUNDING {
                    return vec![[0.0, whole]];
                }
                let begin = from.rem_euclid(whole);
                let end = begin + (to - from);
                if end > whole {
                    all.extend([[begin, whole], [0.0, end - whole]]);
                } else {
                    all.push([begin, end]);
                }
            }
            all.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let mut joined: Vec<[f64; 2]> = Vec::new();
            for one in all {
                match joined.last_mut().filter(|last| one[0] - last[1] <= ROUNDING) {
                    Some(last) if one[1] > last[1] => last[1] = one[1],
                    Some(_) => {}
                    None => joined.push(one),
                }
            }
            joined
        };
        LoopStretches { loops: (0..outline.loops().len()).map(of).collect() }
    }

    /// The stretches of a loop, from its first point to its end, ascending, apart from one another [mm].
    pub fn of_loop(&self, of_loop: usize) -> &[[f64; 2]] {
        self.loops.get(of_loop).map_or(&[], Vec::as_slice)
    }

    /// A part of a loop, from its first point to its end at most, divided.
    pub fn split(&self, of_loop: usize, [from, to]: [f64; 2]) -> SplitStretch {
        let mut split = SplitStretch::default();
        let keep = |list: &mut Vec<[f64; 2]>, a: f64, b: f64| {
            if b - a > ROUNDING {
                list.push([a, b]);
            }
        };
        let mut at = from;
        for &[low, high] in self.of_loop(of_loop) {
            let (low, high) = (if low > at { low } else { at }, if high < to { high } else { to });
            if high - low > ROUNDING {
                keep(&mut split.off, at, low);
                keep(&mut split.on, low, high);
                at = high;
            }
        }
        keep(&mut split.off, at, to);
        split
    }

    /// The parts of the edges of their outline that lie on none of them.
    pub(super) fn edges_off(&self, outline: &Outline) -> Vec<OutlineEdge> {
        let mut found = Vec::new();
        for (of_loop, one) in outline.loops().iter().enumerate() {
            let mut begin = 0.0;
            for edge in &outline.edges()[one.edges.clone()] {
                let length = edge.length();
                let off = self.split(of_loop, [begin, begin + length]).off;
                found.extend(off.iter().map(|[a, b]| edge.part((a - begin) / length, (b - begin) / length)));
                begin += length;
            }
        }
        found
    }
}

/// Length of a loop [mm].
pub(super) fn loop_length(outline: &Outline, of_loop: usize) -> f64 {
    let edges = outline.loops().get(of_loop).map(|l| &outline.edges()[l.edges.clone()]);
    edges.map_or(0.0, |edges| edges.iter().map(OutlineEdge::length).sum())
}

#[cfg(test)]
mod tests {
    use glam::dvec2;

    use super::*;

    #[test]
    fn what_is_on_and_off_is_that_of_each_place() {
        let square = [dvec2(0.0, 0.0), dvec2(10.0, 0.0), dvec2(10.0, 10.0), dvec2(0.0, 10.0)];
        let outline = Outline::polygon(&square).unwrap();
        let piece = |along: [f64; 2]| OutlinePiece { of_loop: 0, along };
        for pieces in [
            vec![],
            vec![piece([3.0, 7.0])],
            vec![piece([38.0, 45.0]), piece([4.0, 9.0]), piece([20.0, 21.0])],
            vec![piece([-3.0, -1.0]), piece([50.0, 52.0]), piece([10.5, 11.5])],
            vec![piece([7.0, 47.0])],
        ] {
            let stretches = LoopStretches::new(&outline, &pieces);
            for [from, to] in [[0.0, 40.0], [2.0, 39.0], [4.5, 4.7]] {
                let split = stretches.split(0, [from, to]);
                for i in 0..400 {
                    let at = from + (to - from) * (f64::from(i) + 0.5) / 400.0;
                    let is_on = pieces.iter().any(|p| {
                        (-2..=2).any(|turn| {
                            let at = at + 40.0 * f64::from(turn);
                            p.along[0] < at && at < p.along[1]
                        })
                    });
                    let within = |list: &[[f64; 2]]| list.iter().any(|[a, b]| (*a..*b).contains(&at));
                    assert_eq!((within(&split.on), within(&split.off)), (is_on, !is_on), "{pieces:?} {at}");
                }
            }
            // The edges beside them are as long as what is off.
            let off: f64 = stretches.split(0, [0.0, 40.0]).off.iter().map(|[a, b]| b - a).sum();
            let edges: f64 = stretches.edges_off(&outline).iter().map(OutlineEdge::length).sum();
            assert!((off - edges).abs() < 1e-9, "{pieces:?} {off} {edges}");
        }
    }
}
