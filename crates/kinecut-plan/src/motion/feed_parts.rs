//! A curve in parts, each with a feed that the linear axes can hold.

use super::AxisLimit;
use super::station::places;
use crate::geom::{Curve, CurveKind};

/// A part of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct FeedPart {
    /// The part.
    pub curve: Curve,
    /// Its feed [mm/s].
    pub feed: f64,
}

/// A curve in parts with feeds that are at most `feed` [mm/s], and at which the tip can be run evenly in whatever direction
/// the axes lie: `feed |q'|`, `feed^2 |q''|` and `feed^3 |q'''|` within the limits, `q` the tip by arc length. There are few:
/// the one feed of a part costs up to 5 ms, or 2 % of its time, against feeds that follow the curve. Lower feeds are whole in
/// three digits of mm/min.
///
/// A cusp allows no feed at all: the part beside it has the feed of its other end, and is passed from or to a stop.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use glam::DVec3;
/// use kinecut::geom::{Arc, Curve};
/// use kinecut::motion::{AxisLimit, feed_parts};
/// let limit = AxisLimit { velocity: 500.0, acceleration: 5000.0, jerk: f64::INFINITY };
/// let circle: Curve = Arc::new(DVec3::X * 2.0, DVec3::ZERO, DVec3::Z, 6.0, 0.0).unwrap().into();
/// // sqrt(5000 mm/s2 x 2 mm) = 100 mm/s.
/// let parts = feed_parts(&circle, 150.0, &limit);
/// assert!(parts.len() == 1 && (parts[0].feed - 100.0).abs() < 1e-9);
/// ```
pub fn feed_parts(curve: &Curve, feed: f64, limit: &AxisLimit) -> Vec<FeedPart> {
    /// Turn between the places that are looked at [rad].
    const TURN: f64 = 0.1;
    let whole = |feed: f64| vec![FeedPart { curve: curve.clone(), feed }];
    if matches!(curve.kind(), CurveKind::Line(_)) || !(curve.length() > 0.0) {
        return whole(feed.min(lowered(limit.velocity)));
    }
    let places = places(curve, TURN);
    let held: Vec<f64> = places.iter().map(|s| held(curve, *s, limit)).collect();
    let mut parts: Vec<Open> = Vec::new();
    for i in 0..places.len() - 1 {
        let [a, b] = [held[i], held[i + 1]];
        // Not at a cusp.
        let least = if a > 0.0 && (a < b || b.is_nan() || b <= 0.0) { a } else { b };
        let least = if least > 0.0 && least < feed { least } else { feed };
        let length = places[i + 1] - places[i];
        let next = Open { from: i, to: i + 1, length, time: length / least, feed: least };
        // A part that holds the whole feed keeps it.
        let is_whole = |part: &Open| part.feed >= feed;
        match parts.last_mut() {
            Some(part) if is_whole(part) == is_whole(&next) && part.with(&next).is_fast() => {
                *part = part.with(&next)
            }
            _ => parts.push(next),
        }
    }
    let said = |held: f64| if held < feed { lowered(held) } else { feed };
    if let [part] = &parts[..] {
        return whole(said(part.feed));
    }
    let part = |part: Open| {
        let curve = curve.part(places[part.from], places[part.to]);
        FeedPart { curve, feed: said(part.feed) }
    };
    parts.into_iter().map(part).collect()
}

/// A part that may still grow.
#[derive(Clone, Copy)]
struct Open {
    /// Places at its ends.
    from: usize,
    to: usize,
    length: f64,
    /// Time at the feeds that its own pieces hold [s].
    time: f64,
    /// The least of them [mm/s].
    feed: f64,
}

impl Open {
    /// Both in one.
    fn with(&self, next: &Open) -> Open {
        Open {
            from: self.from,
            to: next.to,
            length: self.length + next.length,
            time: self.time + next.time,
            feed: self.feed.min(next.feed),
        }
    }

    /// Whether its one feed costs little time.
    fn is_fast(&self) -> bool {
        /// Time that may be lost [s]: a few blocks of a control.
        const LEAST: f64 = 0.005;
        /// Share of the time that may be lost.
        const SHARE: f64 = 0.02;
        self.length / self.feed - self.time <= LEAST.max(SHARE * self.time)
    }
}

/// A feed [mm/s] lowered to three digits of mm/min.
///
/// ```
/// # use kinecut_plan as kinecut;
/// // 1624.9 mm/min.
/// assert_eq!(kinecut::motion::lowered(27.082) * 60.0, 1620.0);
/// ```
pub fn lowered(feed: f64) -> f64 {
    let minute = feed * 60.0;
    if !(minute > 0.0 && minute.is_finite()) {
        return feed;
    }
    let unit = 10f64.powi(minute.log10().floor() as i32 - 2);
    /// Rounding of a feed that has three digits already.
    const ROUNDING: f64 = 1e-9;
    (minute / unit + ROUNDING).floor() * unit / 60.0
}

/// Largest feed at a place at which it can be held [mm/s]; zero or not a number at a cusp.
fn held(curve: &Curve, s: f64, limit: &AxisLimit) -> f64 {
    let jet = curve.at(s);
    let by_acceleration = (limit.acceleration / jet.d2.length()).sqrt();
    let by_jerk = (limit.jerk / jet.d3.length()).cbrt();
    let least = if by_jerk < by_acceleration || by_jerk.is_nan() { by_jerk } else { by_acceleration };
    if limit.velocity < least { limit.velocity } else { least }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::InvoluteRecord;
    use glam::DVec3;

    const LIMIT: AxisLimit = AxisLimit { velocity: 500.0, acceleration: 5000.0, jerk: 50_000.0 };

    /// From the cusp of an involute of base radius 0.6 mm, 20 turns.
    fn involute() -> Curve {
        let r = 0.6;
        let end = 40.0 * std::f64::consts::PI * r;
        let record = InvoluteRecord::new(0.5 * end * end / r, [0.0, 0.0], 0.0, 0.0, end).unwrap();
        Curve::involute(record, 0.0, 0.0)
    }

    #[test]
    fn the_parts_of_an_involute_are_few_and_each_holds_its_feed() {
        let whole = involute();
        let parts = feed_parts(&whole, 100.0, &LIMIT);
        assert!((5..=12).contains(&parts.len()), "{}", parts.len());
        let length: f64 = parts.iter().map(|p| p.curve.length()).sum();
        assert!((length - whole.length()).abs() < 1e-8 * length);
        let mut at = whole.start();
        for (i, part) in parts.iter().enumerate() {
            assert!((part.curve.start() - at).length() < 1e-9);
            at = part.curve.end();
            // Evenly over the part but at the cusp; the feed is not far below what the part allows.
            let places = if i == 0 { 1..2 } else { 0..41 };
            let mut least = f64::INFINITY;
            for k in places {
                let s = if i == 0 { 1.0 } else { f64::from(k) / 40.0 } * part.curve.length();
                let jet = part.curve.at(s);
                assert!(part.feed.powi(2) * jet.d2.length() <= 5000.0 * (1.0 + 1e-9), "{i} {k}");
                assert!(part.feed.powi(3) * jet.d3.length() <= 50_000.0 * (1.0 + 1e-9), "{i} {k}");
                least = least.min((50_000.0 / jet.d3.length()).cbrt());
            }
            assert!(i == 0 || part.feed > 0.985 * least.min(100.0), "{i} {} {least}", part.feed);
        }
        assert_eq!(parts[parts.len() - 1].feed, 100.0);
        assert!(parts[parts.len() - 1].curve.length() > 0.95 * whole.length());
    }

    #[test]
    fn what_holds_its_feed_stays_whole() {
        let straight: Curve = crate::geom::Line { start: DVec3::ZERO, end: DVec3::X }.into();
        for (curve, feed) in [(&straight, 100.0), (&involute(), 0.01)] {
            assert_eq!(feed_parts(curve, feed, &LIMIT)[..], [FeedPart { curve: curve.clone(), feed }]);
        }
    }
}
