//! Stretches of one feed, from the surfaces that a hole passes.
//!
//! On every stretch the least feed of the passages that cover it holds. Where none does, the engaged part of the edge
//! does not change: it is all of it (steady), nothing (air), or a part, given by the shares of the disc that the
//! surfaces passed so far cover.

use super::{Side, Transient};

/// A boundary of the part on the drill's way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage {
    /// Z interval in which the edge passes it [mm].
    pub transient: Transient,
    /// Into material or out of it.
    pub side: Side,
    /// Share of the edge's annulus over which it lies: 1 for a surface that covers all of it.
    pub share: f64,
}

/// Feeds by what the drill does [mm/rev].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feeds {
    /// Going in.
    pub entry: f64,
    /// All of the edge in material.
    pub steady: f64,
    /// Coming out.
    pub exit: f64,
}

impl Feeds {
    /// One feed throughout [mm/rev].
    pub fn constant(feed: f64) -> Feeds {
        Feeds { entry: feed, steady: feed, exit: feed }
    }

    /// The least of the three [mm/rev].
    pub fn least(&self) -> f64 {
        let low = if self.entry < self.steady { self.entry } else { self.steady };
        if self.exit < low { self.exit } else { low }
    }
}

/// State of the drill on a stretch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ZoneStage {
    /// Going in.
    Entry,
    /// All of the edge is in material.
    Steady,
    /// A part of the edge is in material, always the same.
    Partial,
    /// Coming out.
    Exit,
    /// Going in and coming out at the same time: a thin wall, a cross bore.
    Mixed,
    /// Nothing of the edge is in material.
    Air,
}

impl ZoneStage {
    /// The word shown.
    pub fn word(self) -> &'static str {
        match self {
            ZoneStage::Entry => "entry",
            ZoneStage::Steady => "steady",
            ZoneStage::Partial => "partial",
            ZoneStage::Exit => "exit",
            ZoneStage::Mixed => "mixed",
            ZoneStage::Air => "air",
        }
    }
}

/// A stretch of one feed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zone {
    /// Z at which it begins [mm].
    pub from: f64,
    /// Z at which it ends [mm], below `from`.
    pub to: f64,
    /// State of the drill.
    pub stage: ZoneStage,
    /// Feed [mm/rev].
    pub feed: f64,
}

impl Zone {
    /// Length [mm].
    pub fn length(&self) -> f64 {
        self.from - self.to
    }

    /// Revolutions of the spindle.
    pub fn revolutions(&self) -> f64 {
        self.length() / self.feed
    }

    /// Time at a spindle speed [rad/s], in s.
    pub fn time(&self, spindle: f64) -> f64 {
        self.revolutions() * std::f64::consts::TAU / spindle
    }
}

/// Start and end of the drill's travel at feed [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Travel {
    /// Z at the start, above everything.
    pub start: f64,
    /// Z at the end.
    pub end: f64,
}

/// Stretches shorter than this are rounding [mm].
const SHORTEST: f64 = 1e-12;
/// Shares of the disc nearer to all or nothing than this are that: far below what can be cut.
const SHARE_ROUNDING: f64 = 1e-6;

/// The stretches of one feed between two heights, top down, into `zones` (which is cleared). The way to the first contact
/// belongs to the entry, the way after the last to the exit.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::drilling::*;
/// let at = |first, last, side| Passage {
///     transient: Transient { first, last, first_radius: 0.0, last_radius: 5.0 }, side, share: 1.0,
/// };
/// // A wall thinner than the point is long: out before all is in.
/// let wall = [at(0.0, -3.0, Side::Entry), at(-2.0, -5.0, Side::Exit)];
/// let feeds = Feeds { entry: 0.2, steady: 0.3, exit: 0.1 };
/// let mut found = Vec::new();
/// zones(&wall, Travel { start: 2.0, end: -7.0 }, &feeds, &mut found);
/// assert_eq!(found.iter().map(|z| (z.to, z.feed)).collect::<Vec<_>>(), [(-2.0, 0.2), (-3.0, 0.1), (-7.0, 0.1)]);
/// ```
pub fn zones(passages: &[Passage], travel: Travel, feeds: &Feeds, zones: &mut Vec<Zone>) {
    zones.clear();
    let highest = |side: Side| {
        let all = passages.iter().filter(|p| p.side == side).map(|p| p.transient.first);
        all.fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a })
    };
    let lowest = |side: Side| {
        let all = passages.iter().filter(|p| p.side == side).map(|p| p.transient.last);
        all.fold(f64::INFINITY, |a, b| if b < a { b } else { a })
    };
    let (top, bottom) = (highest(Side::Entry), lowest(Side::Exit));
    // Nothing is left to cut below the last passage if it goes out.
    let through = bottom <= lowest(Side::Entry);
    let mut from = travel.start;
    while from > travel.end + SHORTEST {
        // The next border below.
        let mut to = travel.end;
        for p in passages {
            let (first, last) = (p.transient.first, p.transient.last);
            let opens = p.side == Side::Entry && first == top;
            let closes = p.side == Side::Exit && through && last == bottom;
            for z in [if opens { travel.start } else { first }, if closes { travel.end } else { last }] {
                if z < from - SHORTEST && z > to {
                    to = z;
                }
            }
        }
        let middle = 0.5 * (from + to);
        let (mut entering, mut leaving, mut share) = (false, false, 0.0);
        for p in passages {
            let (first, last) = (p.transient.first, p.transient.last);
            let covers = middle < first && middle > last;
            match p.side {
                Side::Entry => entering |= covers || middle >= first && first == top,
                Side::Exit => leaving |= covers || through && middle <= last && last == bottom,
            }
            if middle <= last {
                share += if p.side == Side::Entry { p.share } else { -p.share };
            }
        }
        let (stage, feed) = match (entering, leaving) {
            (true, true) => {
                (ZoneStage::Mixed, if feeds.entry < feeds.exit { feeds.entry } else { feeds.exit })
            }
            (true, false) => (ZoneStage::Entry, feeds.entry),
            (false, true) => (ZoneStage::Exit, feeds.exit),
            (false, false) if share > 1.0 - SHARE_ROUNDING => (ZoneStage::Steady, feeds.steady),
            (false, false) if share < SHARE_ROUNDING => (ZoneStage::Air, feeds.steady),
            // One side only is loaded, as it is when going in.
            (false, false) => {
                (ZoneStage::Partial, if feeds.entry < feeds.steady { feeds.entry } else { feeds.steady })
            }
        };
        match zones.last_mut() {
            Some(last) if last.stage == stage => last.to = to,
            _ => zones.push(Zone { from, to, stage, feed }),
        }
        from = to;
    }
}
