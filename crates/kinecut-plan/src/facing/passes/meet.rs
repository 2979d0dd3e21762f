//! Meetings of a line or an arc with a whole line or circle: closed forms.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::geom::OutlineEdge;

/// A whole line or circle.
#[derive(Clone, Copy, Debug)]
pub(super) enum Whole {
    /// Through `point` along the unit vector `along`.
    Line { point: DVec2, along: DVec2 },
    /// All round.
    Circle { centre: DVec2, radius: f64 },
}

impl Whole {
    /// The whole line or circle on which a piece lies.
    pub(super) fn of(piece: &OutlineEdge) -> Whole {
        match piece.turn {
            None => Whole::Line { point: piece.start, along: (piece.end - piece.start).normalize_or_zero() },
            Some(t) => Whole::Circle { centre: t.centre, radius: t.radius },
        }
    }
}

/// Appends the shares of `piece` in (0, 1) at which it meets `whole`; a piece that lies on it entirely meets it nowhere
/// or at places without meaning.
pub(super) fn meet(piece: &OutlineEdge, whole: Whole, shares: &mut Vec<f64>) {
    let Some(turn) = piece.turn else {
        let way = piece.end - piece.start;
        let mut push = |s: f64| {
            if s > 0.0 && s < 1.0 {
                shares.push(s);
            }
        };
        match whole {
            Whole::Line { point, along } => push((point - piece.start).perp_dot(along) / way.perp_dot(along)),
            Whole::Circle { centre, radius } => {
                let length = way.length();
                let unit = way / length;
                let out = centre - piece.start;
                let (along, aside) = (out.dot(unit), out.perp_dot(unit));
                let square = (radius - aside.abs()) * (radius + aside.abs());
                if square >= 0.0 {
                    let half = square.sqrt();
                    push((along - half) / length);
                    push((along + half) / length);
                }
            }
        }
        return;
    };
    // The polar angles are `middle` plus and minus the angle of this cosine.
    let (middle, cosine) = match whole {
        Whole::Line { point, along } => {
            let normal = along.perp();
            (normal.y.atan2(normal.x), normal.dot(point - turn.centre) / turn.radius)
        }
        Whole::Circle { centre, radius } => {
            let out = centre - turn.centre;
            let d = out.length();
            // (r^2 + d^2 - radius^2) / (2 r d), the difference of squares as a product.
            (
                out.y.atan2(out.x),
                ((turn.radius - radius) * (turn.radius + radius) + d * d) / (2.0 * turn.radius * d),
            )
        }
    };
    // Also refuses what is not a number: circles about the same centre.
    if !(cosine.abs() <= 1.0) {
        return;
    }
    let half = cosine.acos();
    for angle in [middle - half, middle + half] {
        let gone = if turn.sweep > 0.0 { angle - turn.from } else { turn.from - angle };
        let share = gone.rem_euclid(TAU) / turn.sweep.abs();
        if share > 0.0 && share < 1.0 {
            shares.push(share);
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec2;
    use proptest::prelude::*;

    use super::*;

    fn level(whole: Whole, p: DVec2) -> f64 {
        match whole {
            Whole::Line { point, along } => along.perp_dot(p - point),
            Whole::Circle { centre, radius } => p.distance(centre) - radius,
        }
    }

    proptest! {
        #![proptest_config(kinecut_cases::property(256))]
        #[test]
        fn every_change_of_side_is_found_and_every_root_is_one(
            c in prop::array::uniform10(-4.0..4.0f64),
            piece_is_arc: bool,
            whole_is_circle: bool,
        ) {
            let piece = if piece_is_arc {
                OutlineEdge::arc(dvec2(c[0], c[1]), 0.1 + c[2].abs(), c[3], 1.5 * c[4])
            } else {
                OutlineEdge::line(dvec2(c[0], c[1]), dvec2(c[2], c[3]))
            };
            let whole = if whole_is_circle {
                Whole::Circle { centre: dvec2(c[5], c[6]), radius: 0.1 + c[7].abs() }
            } else {
                Whole::Line { point: dvec2(c[5], c[6]), along: DVec2::from_angle(c[7]) }
            };
            let mut shares = Vec::new();
            meet(&piece, whole, &mut shares);
            for &s in &shares {
                prop_assert!(level(whole, piece.at(s)).abs() < 1e-7, "{s}");
            }
            let n = 500;
            for i in 0..n {
                let (a, b) = (f64::from(i) / f64::from(n), f64::from(i + 1) / f64::from(n));
                if level(whole, piece.at(a)) * level(whole, piece.at(b)) < 0.0 {
                    prop_assert!(shares.iter().any(|&s| a - 1e-9 <= s && s <= b + 1e-9));
                }
            }
        }
    }
}
