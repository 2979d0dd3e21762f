//! Pieces of an outline along which chosen burrs are taken off.

use super::{BurrPart, BurrState};
use crate::geom::Outline;

/// Lengths by which pieces are made [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceLengths {
    /// Gaps below this are run over.
    pub gap: f64,
    /// Length by which a piece is longer than its burr at both ends.
    pub beyond: f64,
    /// Burrs that are shorter than this in all are left.
    pub least: f64,
}

impl PieceLengths {
    /// The usual ones for a tool of a diameter [mm]: gaps below two diameters, 1 mm at both ends, 0.5 mm at least.
    pub fn of_tool(diameter: f64) -> PieceLengths {
        PieceLengths { gap: 2.0 * diameter, beyond: 1.0, least: 0.5 }
    }
}

/// A piece of a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct BurrPiece {
    /// The loop.
    pub of_loop: usize,
    /// From and to along the loop, from its first point; the second lies beyond the first, and may lie beyond the end [mm].
    pub along: [f64; 2],
    /// Whether it is all of the loop.
    pub closed: bool,
    /// The burrs on it.
    pub parts: Vec<BurrPart>,
}

impl BurrPiece {
    /// Greatest height of its burrs by the table [mm].
    pub fn height(&self) -> Option<f64> {
        self.parts.iter().filter_map(|p| p.height).max_by(f64::total_cmp)
    }

    /// Length of the burrs on it [mm].
    pub fn burr_length(&self) -> f64 {
        self.parts.iter().map(BurrPart::length).sum()
    }
}

/// The pieces of an outline, and burrs that are left as too short.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BurrPieces {
    /// The pieces, loop after loop.
    pub pieces: Vec<BurrPiece>,
    /// Chosen burrs that are on none of them.
    pub short: Vec<BurrPart>,
}

/// Makes pieces of the chosen burrs: gaps below a length run over, what is too short left, the rest lengthened within its loop,
/// around corners.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::dvec2;
/// use kinecut::facing::burrs::{BurrPart, BurrState, PieceLengths, burr_pieces};
/// use kinecut::geom::Outline;
/// let plate = Outline::polygon(&[dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 30.0), dvec2(0.0, 30.0)])?;
/// let burr = |edge: usize, along: [f64; 2]| BurrPart {
///     edge, along, exit_angles: [0.2, 0.4], height: None, state: BurrState::Chosen,
/// };
/// let first = plate.edges()[0].length();
/// let made = burr_pieces(&plate, &[burr(0, [3.0, 5.0]), burr(0, [first - 0.2, first]), burr(2, [1.0, 4.0])],
///     PieceLengths::of_tool(1.0));
/// assert_eq!(made.pieces[0].along, [2.0, 6.0]);
/// assert_eq!((made.pieces.len(), made.short.len()), (2, 1));
/// # Ok::<(), kinecut::base::Error>(())
/// ```
pub fn burr_pieces(outline: &Outline, parts: &[BurrPart], lengths: PieceLengths) -> BurrPieces {
    let mut made = BurrPieces::default();
    // Pieces that are lengthened must not run into one another.
    let gap = if lengths.gap > 2.0 * lengths.beyond { lengths.gap } else { 2.0 * lengths.beyond };
    for (of_loop, one) in outline.loops().iter().enumerate() {
        let mut begins = vec![0.0];
        for edge in &outline.edges()[one.edges.clone()] {
            begins.push(begins[begins.len() - 1] + edge.length());
        }
        let whole = begins[begins.len() - 1];
        let chosen = parts.iter().filter(|p| p.state == BurrState::Chosen && one.edges.contains(&p.edge));
        let mut runs: Vec<BurrPiece> = Vec::new();
        for part in chosen {
            let along = part.along.map(|s| begins[part.edge - one.edges.start] + s);
            match runs.last_mut().filter(|last| along[0] - last.along[1] < gap) {
                Some(last) => {
                    last.along[1] = along[1];
                    last.parts.push(*part);
                }
                None => runs.push(BurrPiece { of_loop, along, closed: false, parts: vec![*part] }),
            }
        }
        // The last one may go on in the first.
        if let [first, .., last] = &mut runs[..]
            && first.along[0] + whole - last.along[1] < gap
        {
            last.along[1] = first.along[1] + whole;
            last.parts.append(&mut first.parts);
            runs.remove(0);
        }
        for mut run in runs {
            let length = run.along[1] - run.along[0];
            if length < lengths.least {
                made.short.append(&mut run.parts);
                continue;
            }
            run.closed = whole - length < gap;
            let [from, to] = [run.along[0] - lengths.beyond, run.along[1] + lengths.beyond];
            run.along = if run.closed {
                [0.0, whole]
            } else {
                let within = from.rem_euclid(whole);
                [within, within + (to - from)]
            };
            made.pieces.push(run);
        }
    }
    made
}
