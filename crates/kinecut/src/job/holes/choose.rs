//! Choice of the tools of a hole by their kinds and diameters.

use super::size::{SAME, Size};
use crate::base::{Code, Error, Finding, Result};
use crate::job::file::{ToolTable, ToolType};
use crate::page::trimmed;
use crate::threading::coarse_pitch;
use crate::tool::{DrillPoint, Hand, Tap};

/// Point angle up to which a drill is one for spots, degrees: no drill for the solid is so sharp.
const SPOT_ANGLE: f64 = 100.0;
/// Angles nearer than this are equal [rad].
pub(super) const SAME_ANGLE: f64 = 1e-6;
/// Share of a spot drill's diameter that is used.
const SPOT_SHARE: f64 = 0.95;
/// Largest diameter of a thread mill, in diameters of a coarse and of a fine thread: above, the flanks are overcut by much.
const COARSE: f64 = 0.7;
const FINE: f64 = 0.8;

/// The tools that a job has, in the order in which it names them, and the words for where they are.
pub(super) struct ToolList<'a> {
    pub(super) tools: Vec<&'a ToolTable>,
    pub(super) place: String,
}

/// Whether a tool works along its axis.
fn is_drill_kind(tool: &ToolTable) -> bool {
    tool.kind == ToolType::Drill
}

/// Whether a tool drills into the solid.
fn is_drill(tool: &ToolTable) -> bool {
    is_drill_kind(tool) && tool.centre_cutting != Some(false)
}

fn is_spot_drill(tool: &ToolTable) -> bool {
    is_drill(tool)
        && tool.point.is_none()
        && tool.point_angle.is_some_and(|angle| angle <= SPOT_ANGLE.to_radians())
}

/// Whether a tool makes a plain hole into the solid.
fn is_hole_drill(tool: &ToolTable) -> bool {
    let other = matches!(
        tool.point,
        Some(
            DrillPoint::Centre { .. }
                | DrillPoint::Cone { .. }
                | DrillPoint::Annular { .. }
                | DrillPoint::Stepped { .. }
                | DrillPoint::Gun { .. }
                | DrillPoint::Cannon { .. }
        )
    );
    is_drill(tool) && !is_spot_drill(tool) && !other
}

fn is_reamer(tool: &ToolTable) -> bool {
    tool.kind == ToolType::Drill && tool.centre_cutting == Some(false)
}

fn said(tool: &ToolTable, word: &str) -> bool {
    tool.name.as_deref().is_some_and(|name| name.contains(word))
}

impl<'a> ToolList<'a> {
    fn of(&self, accept: impl Fn(&ToolTable) -> bool) -> impl Iterator<Item = &'a ToolTable> {
        self.tools.iter().copied().filter(move |tool| accept(tool))
    }

    /// The smallest spot drill that makes a spot of a diameter [mm], or else the widest; with the diameter that it makes.
    pub(super) fn spot(&self, diameter: f64) -> Result<(&'a ToolTable, f64)> {
        let mut all: Vec<&ToolTable> = self.of(is_spot_drill).collect();
        all.sort_by(|a, b| a.diameter.total_cmp(&b.diameter));
        let wide = |tool: &&&ToolTable| tool.diameter * SPOT_SHARE >= diameter - 1e-9;
        let tool = all.iter().find(wide).or(all.last()).copied();
        let tool = tool.ok_or_else(|| {
            self.missing("no spot drill", "add a drill with point_angle = 90, or write spot = false")
        })?;
        Ok((tool, ToolList::spot_within(tool, diameter)))
    }

    /// Diameter of the spot that a spot drill makes where one is wanted [mm].
    pub(super) fn spot_within(tool: &ToolTable, diameter: f64) -> f64 {
        diameter.min(SPOT_SHARE * tool.diameter)
    }

    /// The drill between two diameters: the nearest to the usual one, among those alike the shortest that reaches `depth` [mm], or
    /// the longest for a hole through.
    pub(super) fn drill(
        &self,
        [least, usual, most]: [f64; 3],
        size: &Size,
        pilot: Option<f64>,
        depth: Option<f64>,
    ) -> Result<&'a ToolTable> {
        let fit = self.of(is_hole_drill).filter(|t| t.diameter >= least && t.diameter <= most);
        let off = |t: &ToolTable| ((t.diameter - usual).abs() / SAME).round();
        // Of two as near the wider: a tap turns easier in it.
        let wide = |t: &ToolTable| -t.diameter;
        let length = |t: &ToolTable| match depth {
            Some(depth) if t.flute_length >= depth + t.diameter => t.flute_length,
            Some(_) => f64::INFINITY,
            None => -t.flute_length,
        };
        let best = fit.min_by(|a, b| {
            let near = off(a).total_cmp(&off(b)).then(wide(a).total_cmp(&wide(b)));
            near.then(length(a).total_cmp(&length(b)))
        });
        best.ok_or_else(|| self.no_drill(size, pilot, [least + SAME, most - SAME]))
    }

    /// The smallest countersink for a mouth of a diameter [mm] and a cone of an angle [rad], whose nose runs in a hole; else a spot
    /// drill of that angle.
    pub(super) fn countersink(&self, diameter: f64, angle: f64, hole: f64) -> Result<&'a ToolTable> {
        let same = |a: f64| (a - angle).abs() < SAME_ANGLE;
        let is_countersink = |t: &ToolTable| {
            is_drill(t)
                && matches!(t.point, Some(DrillPoint::Cone { angle, nose }) if same(angle) && nose <= hole + SAME)
        };
        let smallest = |accept: &dyn Fn(&ToolTable) -> bool| {
            let wide = self.of(|t| accept(t) && t.diameter >= diameter - SAME);
            wide.min_by(|a, b| a.diameter.total_cmp(&b.diameter))
        };
        let spots = |t: &ToolTable| {
            is_spot_drill(t)
                && t.point_angle.is_some_and(same)
                && ToolList::spot_within(t, diameter) >= diameter - SAME
        };
        let tool = smallest(&is_countersink).or_else(|| smallest(&spots));
        tool.ok_or_else(|| {
            let degrees = trimmed(angle.to_degrees(), 3);
            let what = format!("no countersink of {degrees} degrees for {}", short(diameter));
            let help = format!(
                "add a drill with point = {{ cone = {{ cone_angle = {degrees}, nose_diameter = 2 }} }}, its nose no wider than {}",
                short(hole)
            );
            keyed(self.missing(&what, &help), "countersink")
        })
    }

    /// The counterbore of a diameter [mm].
    pub(super) fn counterbore(&self, diameter: f64) -> Result<&'a ToolTable> {
        let fits = |t: &ToolTable| {
            is_drill_kind(t)
                && matches!(t.point, Some(DrillPoint::Flat))
                && (t.diameter - diameter).abs() <= SAME
        };
        self.of(fits).next().ok_or_else(|| {
            let what = format!("no counterbore {}", short(diameter));
            let help = "add a drill with point = \"flat\", or mill the recess with type = \"bore\"";
            keyed(self.missing(&what, help), "counterbore")
        })
    }

    /// The error where no drill fits, with the nearest that are there.
    fn no_drill(&self, size: &Size, pilot: Option<f64>, [least, most]: [f64; 2]) -> Error {
        let wanted = match most - least < SAME {
            true => short(least),
            false => format!("of {} to {}", short(least), short(most)),
        };
        let drills: Vec<f64> = self.of(is_hole_drill).map(|t| t.diameter).collect();
        let below = drills.iter().copied().filter(|d| *d < least).reduce(f64::max);
        let above = drills.iter().copied().filter(|d| *d > most && *d < size.diameter()).reduce(f64::min);
        let above = match size {
            Size::Plain(_) => drills.iter().copied().filter(|d| *d > most).reduce(f64::min),
            _ => above,
        };
        let near: Vec<f64> = below.into_iter().chain(above).collect();
        let near = match (&near[..], size) {
            ([], _) => String::new(),
            (all, Size::Thread(t)) => {
                let tap = Tap { diameter: t.diameter, pitch: t.pitch, lead: 0.0, tip: 0.0, forming: false };
                let share = |d: &f64| {
                    format!("{} gives {:.0} % of the thread", short(*d), tap.thread_share(*d) * 100.0)
                };
                format!("; {}", all.iter().map(share).collect::<Vec<_>>().join(", "))
            }
            (all, _) => {
                let all: Vec<String> = all.iter().map(|d| short(*d)).collect();
                format!("; the nearest {} {}", if all.len() > 1 { "are" } else { "is" }, all.join(" and "))
            }
        };
        let add = "add one to a tool file, or as [[tool]] to the job";
        let cure = match (size, pilot, above.or(below)) {
            (Size::Plain(_), ..) | (_, Some(_), _) | (.., None) => add.to_owned(),
            (.., Some(d)) => format!("{add}, or write pilot = {}", short(d)),
        };
        let mut error = self.missing(&format!("no drill {wanted} for {}", size.word()), &cure);
        error.0.message += &near;
        error
    }

    /// The reamer for a diameter [mm] and a fit; whether its name says the fit.
    pub(super) fn reamer(&self, diameter: f64, fit: &str) -> Result<(&'a ToolTable, bool)> {
        let all = self.of(is_reamer).filter(|t| (t.diameter - diameter).abs() <= SAME);
        let best = all.min_by_key(|t| {
            if said(t, fit) {
                0
            } else if said(t, "ream") {
                1
            } else {
                2
            }
        });
        let best = best.ok_or_else(|| {
            let what = format!("no reamer {} for {}{fit}", short(diameter), short(diameter));
            self.missing(
                &what,
                "add a drill with centre_cutting = false, or mill the hole with type = \"bore\"",
            )
        })?;
        Ok((best, said(best, fit)))
    }

    /// The tap of a diameter and a pitch [mm], right-handed.
    pub(super) fn tap(&self, diameter: f64, pitch: f64) -> Option<&'a ToolTable> {
        let same = |a: f64, b: f64| (a - b).abs() < 1e-6;
        let fits = |t: &ToolTable| {
            t.kind == ToolType::Tap
                && t.hand == Hand::Right
                && same(t.diameter, diameter)
                && t.pitch.is_some_and(|p| same(p, pitch))
        };
        self.of(fits).next()
    }

    /// The widest thread mill that is narrow enough for a diameter and a pitch [mm], or else the narrowest.
    pub(super) fn thread_mill(&self, diameter: f64, pitch: f64) -> Option<&'a ToolTable> {
        let fits = |t: &ToolTable| {
            t.kind == ToolType::ThreadMill
                && t.pitch.is_some_and(|p| (p - pitch).abs() < 1e-6)
                && t.diameter < diameter
        };
        let share = if coarse_pitch(diameter).is_some_and(|p| pitch >= p - 1e-6) { COARSE } else { FINE };
        let all: Vec<&ToolTable> = self.of(fits).collect();
        let by_width = |a: &&&ToolTable, b: &&&ToolTable| a.diameter.total_cmp(&b.diameter);
        let narrow = all.iter().filter(|t| t.diameter <= share * diameter + 1e-9).max_by(by_width);
        narrow.or_else(|| all.iter().min_by(by_width)).copied()
    }

    /// An error of what the tools lack.
    pub(super) fn missing(&self, what: &str, help: &str) -> Error {
        let what = format!("{what} in {}", self.place);
        Finding::error(Code::JOB_REFERENCE, what).help(help).key("size").into()
    }
}

/// The error with another key of the hole.
fn keyed(mut error: Error, key: &str) -> Error {
    error.0.key = Some(key.to_owned());
    error
}

/// A length as a message shows it [mm].
pub(super) fn short(length: f64) -> String {
    trimmed(length, 3)
}

/// The name of a tool for a message.
pub(super) fn title(tool: &ToolTable) -> String {
    match &tool.name {
        Some(name) => format!("T{} `{}`", tool.number, name.escape_debug()),
        None => format!("T{}", tool.number),
    }
}
