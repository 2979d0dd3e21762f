//! Intervals of the chain with grazing points, and the closed curves that they make.

use super::{Grazing, GrazingLoop, GrazingSpan, kind};
use std::f64::consts::PI;

use crate::machine::Twist;
use crate::sweep::discriminant::{Discriminant, Roots};
use crate::sweep::normal_velocity::PieceVelocity;
use crate::sweep::{ChainPiece, NormalVelocity, PieceShape, ProfileChain};

/// Part of the motion's velocity that counts as none around a parallel circle which a double root names.
const CIRCLE: f64 = 1e-9;
/// The same on a piece that has no normal velocity at all.
const WHOLE: f64 = 1e-12;
/// Radius below which a parallel circle is a point [mm].
const POINT: f64 = 1e-12;
/// Distance beyond the ends of a piece, by its length, at which a double root still counts as being on it: rounding.
const BEYOND: f64 = 1e-12;

pub(super) fn find(chain: &ProfileChain, twist: &Twist, size: f64, grazing: &mut Grazing) {
    let pieces = chain.pieces();
    let translation = twist.turn.truncate().length_squared() == 0.0;
    let across = twist.shift.z == 0.0;
    let Some(first) = pieces.first() else { return };
    let mut before = positive(PieceVelocity::new(first, twist).at(first.from), across);
    for (index, piece) in pieces.iter().enumerate() {
        let velocity = PieceVelocity::new(piece, twist);
        let length = (piece.to - piece.from).abs();
        let discriminant = Discriminant::new(velocity, length);
        // The sign at a joint is found once, so that the spans of both of its sides agree, whatever rounding does.
        let after = positive(velocity.at(piece.to), across);
        let whole = discriminant.roots == Roots::Zero && touches(&velocity, piece, size, index, grazing);
        if let Roots::Double { at, .. } = discriminant.roots {
            circle(&velocity, piece, at, size, index, grazing);
        }
        if !(whole || discriminant.roots == Roots::Zero) {
            let span = |from, to, folds| GrazingSpan {
                piece: index,
                from,
                to,
                folds,
                kind: kind(piece, translation),
                velocity,
                discriminant,
            };
            for (from, to, folds) in intervals(&discriminant, piece, (before, after), across) {
                grazing.spans.push(span(from, to, folds));
            }
        }
        before = after;
    }
    loops(chain, across, grazing);
}

/// True if a parallel circle has two grazing points. Without velocity along the axis every one has.
fn positive(velocity: NormalVelocity, across: bool) -> bool {
    across || velocity.across.length_squared() > velocity.mean * velocity.mean
}

/// The intervals of a piece with a positive discriminant: start, end, folds. At most two.
fn intervals(
    discriminant: &Discriminant,
    piece: &ChainPiece,
    ends: (bool, bool),
    across: bool,
) -> impl Iterator<Item = (f64, f64, [bool; 2])> {
    let (from, to) = (piece.from, piece.to);
    let inside = if across { [None; 2] } else { roots_inside(discriminant, piece) };
    let found = match (ends, inside) {
        ((true, true), [Some(a), Some(b)]) => [Some((from, a, [false, true])), Some((b, to, [true, false]))],
        ((true, true), _) => [Some((from, to, [false, false])), None],
        ((true, false), [Some(a), _]) => [Some((from, a, [false, true])), None],
        ((false, true), [Some(a), b]) => [Some((b.unwrap_or(a), to, [true, false])), None],
        // Rounding has put the root just beyond one of the ends: the piece lies on one side of it.
        ((true, false) | (false, true), _) => {
            let inner = discriminant.at(0.5 * (from + to)) > 0.0;
            [inner.then_some((from, to, [!ends.0, !ends.1])), None]
        }
        ((false, false), [Some(a), Some(b)]) => {
            let middle = discriminant.at(0.5 * (a + b)) > 0.0;
            [middle.then_some((a, b, [true, true])), None]
        }
        ((false, false), _) => [None, None],
    };
    found.into_iter().flatten()
}

/// Simple roots strictly inside of a piece, in the order of the chain.
fn roots_inside(discriminant: &Discriminant, piece: &ChainPiece) -> [Option<f64>; 2] {
    let Roots::Two(roots) = discriminant.roots else { return [None; 2] };
    let (low, high) = (piece.from.min(piece.to), piece.from.max(piece.to));
    let mut inside = [None; 2];
    let mut count = 0;
    let mut take = |root: f64| {
        if root > low && root < high && count < 2 {
            inside[count] = Some(root);
            count += 1;
        }
    };
    match piece.shape {
        PieceShape::Line { .. } => roots.into_iter().for_each(take),
        PieceShape::Arc { .. } => {
            // No arc is longer than half a turn: each root lies on it once at most, twice only at both of its ends.
            for root in roots {
                let place = low + (root - low).rem_euclid(PI);
                take(place);
            }
        }
    }
    if let [Some(a), Some(b)] = inside
        && (a > b) != (piece.from > piece.to)
    {
        inside.swap(0, 1);
    }
    inside
}

/// A piece whose discriminant is zero everywhere: it grazes as a whole, or touches along one curve.
fn touches(
    velocity: &PieceVelocity,
    piece: &ChainPiece,
    size: f64,
    index: usize,
    grazing: &mut Grazing,
) -> bool {
    let middle = velocity.at(0.5 * (piece.from + piece.to));
    let whole = middle.across.length() <= WHOLE * size && middle.mean.abs() <= WHOLE * size;
    match whole {
        true => grazing.whole.push(index),
        false => grazing.touching.push(index),
    }
    whole
}

/// A parallel circle that grazes as a whole, at a double root.
fn circle(
    velocity: &PieceVelocity,
    piece: &ChainPiece,
    at: f64,
    size: f64,
    index: usize,
    grazing: &mut Grazing,
) {
    let (low, high) = (piece.from.min(piece.to), piece.from.max(piece.to));
    let slack = BEYOND * (high - low).max(1.0);
    let place = match piece.shape {
        PieceShape::Line { .. } => at,
        PieceShape::Arc { .. } => at + ((low - slack - at) / PI).ceil() * PI,
    };
    if place < low - slack || place > high + slack {
        return;
    }
    let u = place.clamp(low, high);
    let there = velocity.at(u);
    let still = there.across.length() <= CIRCLE * size && there.mean.abs() <= CIRCLE * size;
    if still && piece.point(u).x > POINT {
        grazing.circles.push((index, u));
    }
}

/// Joins spans to curves: where one ends without a fold, the next begins.
fn loops(chain: &ProfileChain, across: bool, grazing: &mut Grazing) {
    let spans = &mut grazing.spans;
    let mut start = 0;
    for end in 1..=spans.len() {
        let joined = spans.get(end).is_some_and(|next| {
            let last = &spans[end - 1];
            !last.folds[1] && !next.folds[0] && next.piece == last.piece + 1
        });
        if joined {
            continue;
        }
        if !across {
            // The joint is the fold if rounding has put a root beyond it.
            spans[start].folds[0] = true;
            spans[end - 1].folds[1] = true;
        }
        let (first, last) = (&spans[start], &spans[end - 1]);
        let ends = [first.velocity.at(first.from).mean, last.velocity.at(last.to).mean];
        let folds = first.folds[0] && last.folds[1];
        let poles = first.piece == 0 && last.piece + 1 == chain.pieces().len();
        let winding = u8::from(folds && (ends[0] < 0.0) != (ends[1] < 0.0));
        let closed = folds || (across && poles);
        grazing.loops.push(GrazingLoop { spans: start..end, winding, closed });
        start = end;
    }
}
