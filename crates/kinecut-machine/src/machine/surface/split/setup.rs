//! Set-up motions: the way into its place of a tool that brings a line or the whole surface along.
//!
//! This tool must come into contact everywhere at once. A motion by which it can go back has a speed w with
//! `n . w >= 0` at every point of contact, n being the normal out of the material: for an edge at one pose of the
//! machine, for a die everywhere. The test is of first order and local: it does not see what is far away.
//!
//! Candidates: constant links that the machine has anyway, translations added at the tool end of the machine, and for a
//! die the motions by which the surface slides in itself. A pure rotation never brings a die off a closed surface.

use std::fmt;

use glam::DVec3;

use super::super::sliding::{Form, Sample, Slide, sliding_group};
use super::super::{ChainElement, GeneratedSurface, ShapeFunction};
use super::SplitOptions;
use crate::base::Result;
use crate::machine::Elementary;

/// Way in which a motion leaves the contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ContactEffect {
    /// It leaves at once everywhere.
    Free,
    /// It never goes into the material, and slides along it somewhere (no draft).
    Tangent,
    /// It slides along the whole contact.
    Sliding,
    /// It goes into the material somewhere.
    Blocked,
}

impl ContactEffect {
    /// The name in lower case.
    pub fn name(self) -> &'static str {
        match self {
            ContactEffect::Free => "free",
            ContactEffect::Tangent => "tangent",
            ContactEffect::Sliding => "sliding",
            ContactEffect::Blocked => "blocked",
        }
    }
}

/// Origin of a set-up motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Source {
    /// A constant link that the machine has anyway.
    SettingLink,
    /// A translation added to the machine at its tool end.
    AddedLink,
    /// A motion by which the surface slides in itself.
    SlidingGroup,
}

impl Source {
    /// The name in words.
    pub fn name(self) -> &'static str {
        match self {
            Source::SettingLink => "setting link",
            Source::AddedLink => "added link",
            Source::SlidingGroup => "sliding group",
        }
    }
}

/// A motion of the tool away from the work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Retreat {
    /// A link, forwards or back.
    Link {
        /// The motion.
        motion: Elementary,
        /// True if it goes to greater values.
        forward: bool,
    },
    /// A motion of the sliding group of the surface.
    Slide(Slide),
}

/// `+3`, `-1`, or the translation or screw in words.
impl fmt::Display for Retreat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Retreat::Link { motion, forward } => write!(f, "{}{motion}", if *forward { '+' } else { '-' }),
            Retreat::Slide(slide) => slide.fmt(f),
        }
    }
}

/// A set-up motion that was looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The way back.
    pub retreat: Retreat,
    /// Origin of the motion.
    pub source: Source,
    /// Way in which it leaves the contact.
    pub verdict: ContactEffect,
    /// Least speed away from the material at unit speed of the fastest point of contact: the sine of the draft angle.
    /// Negative if blocked; zero if sliding or tangent.
    pub margin: f64,
}

/// The set-up motion of a split.
#[derive(Clone, Debug, PartialEq)]
pub struct SetupMotion {
    /// True if one is needed: not for a point, which may enter at the border of the surface.
    pub needed: bool,
    /// All that were looked at, in this order.
    pub candidates: Vec<Candidate>,
    /// The best: a free setting link first, because it costs nothing; `None` if the tool cannot get out in one piece.
    pub chosen: Option<Candidate>,
    /// Dimension of the sliding group, of a die.
    pub sliding: Option<usize>,
}

/// Speed that counts as zero: rounding of laws.
const STILL: f64 = 1e-7;
/// Translations that may be added, in the order in which they are tried.
const ADDED: [Elementary; 3] = [Elementary::Z, Elementary::X, Elementary::Y];
/// Halvings of the step in the search for the worst point of contact, from the distance of samples.
const HALVINGS: u32 = 24;

/// A contact between tool and work: the part of the domain that the tool brings along.
struct DomainContact<'a> {
    surface: &'a GeneratedSurface,
    shape: &'a ShapeFunction,
    in_tool: [bool; 2],
    options: &'a SplitOptions,
    samples: Vec<([f64; 2], Sample)>,
}

/// The set-up motion of the split of a surface whose tool has these of the two variables.
pub(super) fn setup(
    surface: &GeneratedSurface,
    shape: &ShapeFunction,
    machine: &[ChainElement],
    in_tool: [bool; 2],
    options: &SplitOptions,
) -> Result<SetupMotion> {
    let none = SetupMotion { needed: false, candidates: Vec::new(), chosen: None, sliding: None };
    if in_tool == [false, false] {
        return Ok(none);
    }
    let contact = DomainContact::new(surface, shape, in_tool, options);
    let [u, v] = [surface.variables[0].middle(), surface.variables[1].middle()];
    let mut candidates = Vec::new();
    for (i, element) in machine.iter().enumerate().filter(|(_, e)| !surface.is_forming(e)) {
        let frame = ShapeFunction::new(surface, &machine[..i])?.frame(u, v);
        let axis = frame.vector(surface.direction(element.motion));
        let place = frame.translation;
        let turns = element.motion.is_rotation();
        let speed = |p: DVec3| if turns { axis.cross(p - place) } else { axis };
        contact.both_ways(element.motion, Source::SettingLink, &speed, &mut candidates);
    }
    let end = ShapeFunction::new(surface, machine)?.frame(u, v);
    for motion in ADDED {
        let axis = end.vector(surface.direction(motion));
        contact.both_ways(motion, Source::AddedLink, &|_| axis, &mut candidates);
    }
    let cost = |c: &Candidate| {
        let costs = c.source != Source::SettingLink || c.verdict != ContactEffect::Free;
        (costs, c.verdict)
    };
    // The first of equal ones: min_by_key keeps it.
    let mut chosen =
        candidates.iter().filter(|c| c.verdict != ContactEffect::Blocked).min_by_key(|c| cost(c)).copied();
    let mut sliding = None;
    if in_tool == [true, true] {
        let samples: Vec<Sample> = contact.samples.iter().map(|(_, s)| *s).collect();
        // Too few regular samples leave the group unknown, which is no error of the surface.
        if let Ok(group) = sliding_group(&samples, 0.0) {
            sliding = Some(group.form.dimension());
            chosen = chosen.or_else(|| slide_out(&group.slides, group.form));
        }
    }
    Ok(SetupMotion { needed: true, candidates, chosen, sliding })
}

/// A translation or screw of the sliding group; a rotation does not lead out.
fn slide_out(slides: &[Slide], form: Form) -> Option<Candidate> {
    let leads_out = |slide: &&Slide| match slide {
        Slide::Shift { .. } => form != Form::General,
        Slide::Turn { pitch, .. } => *pitch != 0.0,
    };
    slides.iter().find(leads_out).map(|slide| Candidate {
        retreat: Retreat::Slide(*slide),
        source: Source::SlidingGroup,
        verdict: ContactEffect::Sliding,
        margin: 0.0,
    })
}

impl<'a> DomainContact<'a> {
    fn new(
        surface: &'a GeneratedSurface,
        shape: &'a ShapeFunction,
        in_tool: [bool; 2],
        options: &'a SplitOptions,
    ) -> DomainContact<'a> {
        let mut contact = DomainContact { surface, shape, in_tool, options, samples: Vec::new() };
        let fractions = |k: usize| {
            let n = if in_tool[k] { options.samples.max(2) } else { 1 };
            let at = move |i: usize| if n == 1 { 0.5 } else { i as f64 / (n - 1) as f64 };
            (0..n).map(at)
        };
        for a in fractions(0) {
            for b in fractions(1) {
                let sample = contact.sample([a, b]);
                contact.samples.extend(sample.map(|s| ([a, b], s)));
            }
        }
        contact
    }

    /// Point and normal at fractions of the domain; `None` where the surface is not regular.
    fn sample(&self, fractions: [f64; 2]) -> Option<Sample> {
        let [u, v] = [self.surface.variables[0].at(fractions[0]), self.surface.variables[1].at(fractions[1])];
        let jet = self.shape.jet(u, v);
        let normal = self.shape.normal_of(&jet)?;
        Some(Sample { point: jet.point(), normal, weight: 1.0 })
    }

    fn both_ways(
        &self,
        motion: Elementary,
        source: Source,
        speed: &dyn Fn(DVec3) -> DVec3,
        candidates: &mut Vec<Candidate>,
    ) {
        let fastest = self.samples.iter().map(|(_, s)| speed(s.point).length()).fold(0.0, f64::max);
        if !(fastest > STILL) {
            return;
        }
        for forward in [true, false] {
            let scale = if forward { 1.0 / fastest } else { -1.0 / fastest };
            let (verdict, margin) = self.judge(&|p| speed(p) * scale);
            candidates.push(Candidate {
                retreat: Retreat::Link { motion, forward },
                source,
                verdict,
                margin,
            });
        }
    }

    fn judge(&self, speed: &dyn Fn(DVec3) -> DVec3) -> (ContactEffect, f64) {
        let away = |s: &Sample| s.normal.dot(speed(s.point));
        let worst = self.samples.iter().min_by(|a, b| away(&a.1).total_cmp(&away(&b.1)));
        let Some((place, sample)) = worst else { return (ContactEffect::Blocked, f64::NAN) };
        let greatest = self.samples.iter().map(|(_, s)| away(s)).fold(f64::NEG_INFINITY, f64::max);
        let mut least = away(sample);
        if self.options.refine {
            least = self.least(*place, least, &away);
        }
        if least.abs() < STILL && greatest.abs() < STILL {
            (ContactEffect::Sliding, 0.0)
        } else if least > STILL {
            (ContactEffect::Free, least)
        } else if least > -STILL {
            (ContactEffect::Tangent, 0.0)
        } else {
            (ContactEffect::Blocked, least)
        }
    }

    /// The least speed near the worst sample: a compass search within the domain.
    fn least(&self, from: [f64; 2], value: f64, away: &dyn Fn(&Sample) -> f64) -> f64 {
        let (mut place, mut least) = (from, value);
        let mut step = 1.0 / self.options.samples.max(2) as f64;
        for _ in 0..HALVINGS {
            let mut moved = false;
            for (k, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
                if !self.in_tool[k] {
                    continue;
                }
                let mut next = place;
                next[k] = (next[k] + sign * step).clamp(0.0, 1.0);
                if let Some(found) = self.sample(next).map(|s| away(&s)).filter(|x| *x < least) {
                    (place, least, moved) = (next, found, true);
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
        least
    }
}
