//! Copying and tracing, read off from a redistribution of a chain.

use std::fmt;

use super::super::{ChainElement, GeneratedSurface, LinkKind, Retreat, Slide, Split};
use super::{GeneratingMethod, Group, notation};
use crate::machine::Elementary;

/// Method by which one of the two lines of a surface is made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineMethod {
    /// The variable that runs along the line.
    pub variable: String,
    /// Copying or tracing.
    pub method: GeneratingMethod,
    /// Motions of the machine that run along the line, linked if there are several; empty if it is copied.
    pub motions: Vec<Elementary>,
}

/// Methods by which a split makes both lines of a surface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SplitMethods {
    /// The line along which the other is carried.
    pub directrix: LineMethod,
    /// The line that is carried.
    pub generatrix: LineMethod,
    /// The motions, the cutting motion first.
    pub groups: Vec<Group>,
    /// The motions in one line: `v(B1)s(P2)`; empty without motions.
    pub notation: String,
}

/// Rank of a group of motions as the cutting motion of a machine: the least wins.
fn rank(split: &Split, line: &LineMethod) -> u8 {
    let kind = split.links.iter().find(|link| link.variable == line.variable).map(|link| link.kind);
    match (kind, line.motions.as_slice()) {
        (None, [single]) if single.is_rotation() => 0,
        (Some(LinkKind::Screw), _) => 1,
        (Some(LinkKind::Polygon), _) => 2,
        (None, _) => 3,
        _ => FEED,
    }
}

/// Rank of linked motions that are slow: contours, cams, spirals.
const FEED: u8 = 4;

impl Split {
    /// Methods by which the lines of its surface are made; `None` if the split is refused.
    ///
    /// The cutting motion is a rotation of its own, then a screw, then linked rotations, then a translation of its own;
    /// other linked motions are feeds, even if there is no other. A tool that brings the whole surface cuts by the
    /// motion by which it comes in.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::GeneratedSurface;
    /// let surface = GeneratedSurface::named("revolution").unwrap();
    /// let splits = surface.splits().unwrap();
    /// let turning = splits[0].methods(&surface).unwrap();
    /// assert_eq!(turning.notation, "v(B1)s(P2P3)");
    /// assert_eq!(turning.to_string(), "directrix (phi) traced by 6, generatrix (t) traced by 1 and 3 linked: v(B1)s(P2P3)");
    /// ```
    pub fn methods(&self, surface: &GeneratedSurface) -> Option<SplitMethods> {
        if !self.is_valid() {
            return None;
        }
        let names = surface.variables.each_ref().map(|v| v.name.as_str());
        let within = |chain: &[ChainElement], name: &str| chain.iter().any(|e| e.has(name));
        // The variable of the directrix is the one that it holds; by their order if it holds both.
        let swapped = !within(&surface.directrix, names[0]) && within(&surface.directrix, names[1]);
        let [along, carried] = if swapped { [names[1], names[0]] } else { names };
        let line = |name: &str| {
            let motions: Vec<Elementary> =
                self.machine.iter().filter(|e| e.has(name)).map(|e| e.motion).collect();
            let method =
                if motions.is_empty() { GeneratingMethod::Copying } else { GeneratingMethod::Tracing };
            LineMethod { variable: name.to_owned(), method, motions }
        };
        let (directrix, generatrix) = (line(along), line(carried));
        let mut moved: Vec<&LineMethod> =
            [&directrix, &generatrix].into_iter().filter(|l| !l.motions.is_empty()).collect();
        moved.sort_by_key(|line| rank(self, line));
        let mut groups: Vec<Group> = moved
            .iter()
            .enumerate()
            .map(|(i, line)| {
                // With two groups one of them cuts, whatever it is.
                let cutting = i == 0 && (rank(self, line) < FEED || moved.len() > 1);
                Group { cutting, motions: line.motions.clone() }
            })
            .collect();
        if groups.is_empty() {
            groups.extend(
                self.setup.chosen.map(|chosen| Group { cutting: true, motions: retreat(&chosen.retreat) }),
            );
        }
        let notation = notation(&groups);
        Some(SplitMethods { directrix, generatrix, groups, notation })
    }
}

/// Motions of the way back of a die: a translation, a rotation, or a rotation linked with a translation.
fn retreat(retreat: &Retreat) -> Vec<Elementary> {
    match retreat {
        Retreat::Link { motion, .. } => vec![*motion],
        Retreat::Slide(Slide::Shift { .. }) => vec![Elementary::Z],
        Retreat::Slide(Slide::Turn { pitch, .. }) if *pitch == 0.0 => vec![Elementary::C],
        Retreat::Slide(Slide::Turn { .. }) => vec![Elementary::C, Elementary::Z],
    }
}

impl fmt::Display for LineMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}) ", self.variable)?;
        match self.motions.as_slice() {
            [] => f.write_str("copied by the tool"),
            [single] => write!(f, "traced by {single}"),
            [first @ .., last] => {
                let first: Vec<String> = first.iter().map(Elementary::to_string).collect();
                write!(f, "traced by {} and {last} linked", first.join(", "))
            }
        }
    }
}

impl fmt::Display for SplitMethods {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "directrix {}, generatrix {}", self.directrix, self.generatrix)?;
        if self.notation.is_empty() { Ok(()) } else { write!(f, ": {}", self.notation) }
    }
}
