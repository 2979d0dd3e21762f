//! LinuxCNC's trajectory planner, as it comes: trapezoids of speed along each move, arcs in corners, and a look-ahead over the
//! speeds at their ends.
//!
//! Moves become elements of a queue with limits of their own ([`limits`]). At each joint the fastest of three ways is taken
//! ([`corner`]): go on where the directions are nearly the same, overlap both moves, or put an arc into the corner
//! ([`blend_arc`]). Speeds at the ends follow from behind ([`queue`]), those over time from the front ([`pace`]).
//! What differs from the control: lines that it would merge are not merged (of `G64 P Q` a program keeps the sum, which is the
//! tolerance here), `G61` stops as `G61.1` does, moves in which the tool turns have the limits of their fastest part, ramps are
//! continuous and not in steps of a cycle, and the queue is full from the start. Its S-curves (`PLANNER_TYPE = 1`) and its settings other than as they come are not
//! there: a servo cycle of 1 ms, `ARC_BLEND_OPTIMIZATION_DEPTH = 50`, `ARC_BLEND_GAP_CYCLES = 4`, `ARC_BLEND_RAMP_FREQ = 100`,
//! `ARC_BLEND_KINK_RATIO = 0.1`, `MAX_FEED_OVERRIDE = 1`.
//! Source: LinuxCNC 2.10, `src/emc/tp` and `src/emc/task/emccanon.cc`; `benches/peers/linuxcnc.py` compares with the planner
//! itself.

mod blend_arc;
mod corner;
mod element;
mod limits;
mod pace;
mod queue;
mod shape;

use glam::DVec3;

use self::element::Element;
pub(super) use self::limits::Ending;
use self::limits::goes_on;
use self::pace::Pace;
use self::queue::Queue;
use super::super::{AxisLimit, Moment};
use super::joint::AXES;
use super::run::Piece;
use crate::trace::AxisJet;

/// Servo cycle [s].
const CYCLE: f64 = 1e-3;
/// Shares of the acceleration along an arc and across it.
const TANGENTIAL_SHARE: f64 = 0.5;
const NORMAL_SHARE: f64 = 0.866_025_403_784_438_6;
/// Share of the acceleration that a joint without an arc may take.
const KINK: f64 = 0.1;

/// Limits of X Y Z [mm/s, mm/s^2].
struct Bounds {
    velocity: DVec3,
    acceleration: DVec3,
}

impl Bounds {
    /// Largest size that no axis exceeds, whatever the direction in a plane.
    fn in_plane(&self, limits: DVec3, normal: DVec3) -> f64 {
        let extent = |a: usize| limits[a] / (1.0 - normal[a] * normal[a]).max(0.0).sqrt().max(1e-12);
        extent(0).min(extent(1)).min(extent(2))
    }
}

/// The run over moves that follow one another.
pub(super) struct Planned<'a> {
    elements: Vec<Element<'a>>,
    paces: Vec<Pace>,
    /// Index of the segment of each move, and whether its tip stands.
    segments: Vec<(usize, bool)>,
}

/// Motion along one element.
pub(super) struct Along {
    /// Motion of the length.
    pub(super) at: Moment,
    pub(super) axes: [AxisJet; AXES],
    /// Positions at its start.
    pub(super) from: [f64; AXES],
}

/// Motion at a moment.
pub(super) struct OnElements {
    /// Index of the segment, and whether its tip stands.
    pub(super) of: (usize, bool),
    pub(super) this: Along,
    /// The next element, where both overlap: it adds its way.
    pub(super) next: Option<Along>,
}

impl<'a> Planned<'a> {
    /// The run over a sequence from rest to rest, with the item and the ending of each move; `None` if an axis that moves has
    /// no limits.
    pub(super) fn of(
        pieces: &[Piece<'a>],
        endings: &[(u32, Ending)],
        limits: &[Option<AxisLimit>; AXES],
    ) -> Option<Planned<'a>> {
        let of = |get: fn(&AxisLimit) -> f64| {
            let axis = |a: usize| limits[a].as_ref().map_or(f64::INFINITY, get);
            DVec3::new(axis(0), axis(1), axis(2))
        };
        let mut queue =
            Queue::new(Bounds { velocity: of(|l| l.velocity), acceleration: of(|l| l.acceleration) });
        let mut first = 0;
        while let (Some(piece), Some((item, ending))) = (pieces.get(first), endings.get(first)) {
            // Chords of one move on which all axes go straight.
            let rest = pieces[first..].windows(2).zip(&endings[first + 1..]);
            let more = rest.take_while(|(two, next)| next.0 == *item && goes_on(&two[0], &two[1])).count();
            let way = &pieces[first..=first + more];
            limits::elements(first, piece, way, *ending, limits, &mut |element| queue.add(element))?;
            first += more + 1;
        }
        let paces = pace::run(&queue.elements);
        let segments = pieces.iter().map(|piece| (piece.segment, piece.stands)).collect();
        Some(Planned { elements: queue.elements, paces, segments })
    }

    /// Time of each move [s]: the arc in a corner counts to the move before it.
    pub(super) fn times(&self) -> Vec<f64> {
        let mut times = vec![0.0; self.segments.len()];
        let mut before = 0.0;
        for (element, pace) in self.elements.iter().zip(&self.paces) {
            times[element.piece] += pace.end - before;
            before = pace.end;
        }
        times
    }

    /// Time of all moves [s].
    pub(super) fn duration(&self) -> f64 {
        self.paces.last().map_or(0.0, |pace| pace.end)
    }

    /// The motion at a moment [s]; `None` where nothing moves.
    pub(super) fn at(&self, time: f64) -> Option<OnElements> {
        let last = self.paces.partition_point(|pace| pace.start <= time).checked_sub(1)?;
        let along = |k: usize| {
            let (shape, at) = (&self.elements[k].shape, self.paces[k].at(time));
            Along { at, axes: shape.at(at.way), from: shape.at(0.0).map(|jet| jet.q) }
        };
        let overlaps = last > 0 && time < self.paces[last - 1].end;
        let first = if overlaps { last - 1 } else { last };
        Some(OnElements {
            of: self.segments[self.elements[first].piece],
            this: along(first),
            next: overlaps.then(|| along(last)),
        })
    }
}
