//! Material that stretches of a move take, by where it lies about the tool at the moment at which the tool comes to it.

use std::collections::BTreeMap;

use glam::DVec3;

use super::super::way::{Coming, ToolWay, WaySpan};
use crate::stock::tile::TakenStretch;
use crate::stock::unfixed;

/// Distance within which a point lies in a face of the tool [mm].
const IN_FACE: f64 = 1e-4;
/// Angle between two points of a line beyond which the line is halved between them [degrees].
const MOST_ANGLE: f64 = 6.0;
/// Part of a step below which a line is not halved again.
const LEAST: f64 = 1.0 / 64.0;
/// Part of a stretch of the way in which the tool comes to a point as it does at one moment.
const SHORT: f64 = 5e-4;
/// Part of the velocity of a tool across its axis below which it goes along it.
const ALONG: f64 = 1e-3;

/// All that a stretch of a move takes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken {
    /// By the direction of the lines: volume [mm^3].
    pub(super) volume: [f64; 3],
    /// By the direction of the lines: stretches of material on them.
    pub(super) lines: [u32; 3],
    /// Degrees about the axis, from the direction of feed against the clock, at which there is contact.
    angles: [u64; 6],
    /// Least and greatest height above the tip [mm].
    height: [f64; 2],
    /// Least and greatest distance to the left of the axis, seen in the direction of feed [mm].
    beside: [f64; 2],
    /// Greatest velocity into material [mm by fraction of the move].
    pub(super) advance: f64,
}

impl Taken {
    const NOTHING: Taken = Taken {
        volume: [0.0; 3],
        lines: [0; 3],
        angles: [0; 6],
        height: [f64::INFINITY, f64::NEG_INFINITY],
        beside: [f64::INFINITY, f64::NEG_INFINITY],
        advance: 0.0,
    };

    /// Degrees in contact.
    pub(super) fn degrees(&self) -> u32 {
        self.angles.iter().map(|word| word.count_ones()).sum()
    }

    /// Height over which there is contact [mm].
    pub(super) fn depth(&self) -> f64 {
        (self.height[1] - self.height[0]).max(0.0)
    }

    /// Width over which there is contact [mm].
    pub(super) fn width(&self) -> f64 {
        (self.beside[1] - self.beside[0]).max(0.0)
    }

    pub(super) fn join(&mut self, other: &Taken) {
        for k in 0..3 {
            self.volume[k] += other.volume[k];
            self.lines[k] += other.lines[k];
        }
        self.angles.iter_mut().zip(other.angles).for_each(|(a, b)| *a |= b);
        let wider = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        self.height = wider(self.height, other.height);
        self.beside = wider(self.beside, other.beside);
        self.advance = self.advance.max(other.advance);
    }

    fn note(&mut self, contact: &Contact) {
        self.height = [self.height[0].min(contact.height), self.height[1].max(contact.height)];
        self.beside = [self.beside[0].min(contact.beside), self.beside[1].max(contact.beside)];
        self.advance = self.advance.max(contact.advance);
    }

    /// The degrees from an angle over a turn.
    fn note_angles(&mut self, from: f64, turn: f64) {
        let (low, high) = (from.min(from + turn), from.max(from + turn));
        // A degree counts from its middle on: then an arc is on average as long as it is.
        for degree in (low + 0.5).floor() as i32..(high + 0.5).floor() as i32 {
            let degree = degree.rem_euclid(360) as usize;
            self.angles[degree / 64] |= 1 << (degree % 64);
        }
    }
}

/// By move and stretch.
pub(super) type ByPart = BTreeMap<(u32, u32), Taken>;

/// A line from which a move takes material.
pub(super) struct TakenLine<'a> {
    /// Index of the move.
    pub(super) index: u32,
    /// Number of its stretches.
    pub(super) parts: u32,
    pub(super) way: &'a ToolWay<'a>,
    /// The stretches of the way that may reach the line.
    pub(super) near: &'a [&'a WaySpan],
    /// The point of the line at the coordinate 0, and the coordinate along it.
    pub(super) start: DVec3,
    pub(super) along: usize,
    /// Distance of the lines [mm].
    pub(super) step: f64,
}

/// A point of a line at the moment at which the tool comes to it.
#[derive(Clone, Copy, Debug)]
struct Contact {
    /// Coordinate along the line [mm].
    s: f64,
    /// Fraction of the move.
    at: f64,
    /// Angle about the axis from the direction of feed, against the clock [degrees].
    angle: f64,
    height: f64,
    beside: f64,
    advance: f64,
}

/// The turn from one angle to another on the shorter way [degrees].
fn turn(from: f64, to: f64) -> f64 {
    (to - from + 180.0).rem_euclid(360.0) - 180.0
}

impl TakenLine<'_> {
    /// Notes a stretch of its material.
    pub(super) fn note(&self, stretch: &TakenStretch, all: &mut ByPart) {
        let [lo, hi] = stretch.ends.map(unfixed);
        let (Some(from), Some(to)) = (self.contact(lo), self.contact(hi)) else { return };
        self.of(from.at, all).lines[self.along] += 1;
        self.between(&from, &to, all);
    }

    /// Whether the tool comes to two points in nearly the same way.
    fn are_close(&self, a: &Contact, b: &Contact) -> bool {
        turn(a.angle, b.angle).abs() <= MOST_ANGLE && (a.at - b.at).abs() * f64::from(self.parts) <= 1.0
    }

    fn part(&self, at: f64) -> u32 {
        ((at * f64::from(self.parts)) as u32).min(self.parts - 1)
    }

    fn of<'a>(&self, at: f64, all: &'a mut ByPart) -> &'a mut Taken {
        all.entry((self.index, self.part(at))).or_insert(Taken::NOTHING)
    }

    /// Notes the material between two points: halves it unless the tool comes to all of it in nearly the same way.
    fn between(&self, from: &Contact, to: &Contact, all: &mut ByPart) {
        let length = to.s - from.s;
        if length > LEAST * self.step
            && (length > self.step || !self.are_close(from, to))
            && let Some(middle) = self.contact(0.5 * (from.s + to.s))
            && !(self.are_close(from, &middle) && self.are_close(&middle, to) && self.are_close(from, to))
        {
            self.between(from, &middle, all);
            self.between(&middle, to, all);
            return;
        }
        let volume = (to.s - from.s) * self.step * self.step;
        self.of(0.5 * (from.at + to.at), all).volume[self.along] += volume;
        for end in [from, to] {
            self.of(end.at, all).note(end);
        }
        // The tool comes to the points between in the time between.
        let (first, last) = if from.at <= to.at { (from, to) } else { (to, from) };
        let angle = turn(first.angle, last.angle);
        let way = (last.at - first.at).max(f64::MIN_POSITIVE);
        let [begin, end] = [first, last].map(|contact| self.part(contact.at));
        let mut before = 0.0;
        for part in begin..=end {
            let at = f64::from(part + 1) / f64::from(self.parts);
            let now = if part == end { 1.0 } else { ((at - first.at) / way).clamp(0.0, 1.0) };
            let taken = all.entry((self.index, part)).or_insert(Taken::NOTHING);
            taken.note_angles(first.angle + angle * before, angle * (now - before));
            before = now;
        }
    }

    /// The point at a coordinate as the tool comes to it; none that it does not come near to.
    fn contact(&self, s: f64) -> Option<Contact> {
        let mut point = self.start;
        point[self.along] = s;
        let Coming { pose, at, span, part } = self.way.coming(self.near.iter().copied(), point, SHORT)?;
        let part = &self.way.body.parts[part];
        let from_tip = point - pose.tip;
        let height = from_tip.dot(pose.axis);
        let radial = from_tip - pose.axis * height;
        // The way of the axis at that height.
        let way = pose.velocity(pose.axis * height);
        let across = way - pose.axis * way.dot(pose.axis);
        let is_along = across.length() <= ALONG * way.length();
        let feed = if is_along { pose.axis.any_orthonormal_vector() } else { across.normalize_or_zero() };
        let left = pose.axis.cross(feed);
        let out = radial.normalize_or_zero();
        let in_floor = height - part.z0 < IN_FACE && radial.length() < part.r0 - IN_FACE;
        let normal = match in_floor {
            true => -pose.axis,
            false => {
                let (r, z) = part.side_normal(height);
                out * r + pose.axis * z
            }
        };
        Some(Contact {
            s,
            at,
            angle: radial.dot(left).atan2(radial.dot(feed)).to_degrees(),
            height,
            beside: radial.dot(left),
            advance: pose.velocity(from_tip).dot(normal).max(0.0) / span,
        })
    }
}
