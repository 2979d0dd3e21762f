//! The ways down to a roughing level: which are possible with a cutter, what each would leave, which is taken. None may
//! leave a core standing: the cutter would meet it with its face, or it would come loose.
//!
//! Order of preference: a hole drilled before (no load at all), a helix below the cutter's radius (even load, no
//! core), a ramp along the spiral, a plunge (only for cutters that cut at their centre).

use std::f64::consts::TAU;

use super::helix;
use super::spec::{BoreSpec, CutterData, Entry, Rough};
use super::strategy::Strategy;
use crate::base::{Code, Finding, Result};

/// Ramp that nearly every end mill follows [rad]: 2 degrees.
pub const USUAL_RAMP: f64 = 0.035;
/// Radius of the usual entry helix in cutter radii: below 1 no core is left, and the load of the helix is even.
const USUAL_SHARE: f64 = 0.6;
/// Share of the allowed ramp that is used: the planner may move the radius of a helix a little.
const RESERVE: f64 = 0.9;

/// A way down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EntryMethod {
    /// Into a hole drilled before.
    PreDrilled,
    /// Down a helix.
    Helix,
    /// Down along the roughing spiral.
    Ramp,
    /// Straight down.
    Plunge,
}

impl EntryMethod {
    /// All, the best first.
    pub const ALL: [EntryMethod; 4] =
        [EntryMethod::PreDrilled, EntryMethod::Helix, EntryMethod::Ramp, EntryMethod::Plunge];

    /// Name in the trade.
    pub fn title(self) -> &'static str {
        match self {
            EntryMethod::PreDrilled => "pre-drilled hole",
            EntryMethod::Helix => "helix",
            EntryMethod::Ramp => "ramp along the spiral",
            EntryMethod::Plunge => "plunge",
        }
    }
}

/// A row of the entry table.
#[derive(Clone, Debug, PartialEq)]
pub struct EntryRow {
    /// The way.
    pub way: EntryMethod,
    /// Whether the cutter may take it here.
    pub possible: bool,
    /// Diameter of the core that it would leave [mm]; zero for none.
    pub core: f64,
    /// Why, or why not.
    pub reason: String,
    /// Whether it is taken.
    pub chosen: bool,
}

/// The entry of a bore that is roughed to a path of radius `wall` [mm], checked where the strategy goes it by itself, and
/// the entry table.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::holes::entry::{EntryMethod, ways};
/// use kinecut::holes::*;
/// let cutter =
///     CutterData { diameter: 40.0, centre_cutting: false, max_ramp_angle: None, flute_length: 45.0 };
/// let rough = Rough::new(4.0, 100.0);
/// let spec = BoreSpec { rough: Some(rough), ..BoreSpec::new(200.0, 30.0, cutter) };
/// let (_, table) = ways(&spec, &rough, 80.0).unwrap();
/// assert!(!table.iter().find(|r| r.way == EntryMethod::Plunge).unwrap().possible);
/// assert_eq!(table.iter().find(|r| r.chosen).unwrap().way, EntryMethod::Helix);
/// ```
///
/// # Errors
/// `KC0403` with the bound that is broken and the help.
pub fn ways(spec: &BoreSpec, rough: &Rough, wall: f64) -> Result<(Entry, Vec<EntryRow>)> {
    let entry = chosen(spec, rough, wall);
    if spec.strategy.clearing().is_some() {
        check(spec, rough, entry, wall)?;
    }
    let taken = match (spec.strategy, entry) {
        (Strategy::Helix | Strategy::OutlineHelix, _) => EntryMethod::Helix,
        (_, Entry::PreDrilled { .. }) => EntryMethod::PreDrilled,
        (Strategy::Ramping, _) => EntryMethod::Ramp,
        (_, Entry::Plunge) => EntryMethod::Plunge,
        (_, Entry::Helix { .. }) => EntryMethod::Helix,
    };
    let rows = EntryMethod::ALL.map(|way| {
        let (possible, core, reason) = match way {
            EntryMethod::PreDrilled => match spec.drilled() {
                Some(diameter) if diameter > spec.cutter.diameter => {
                    (true, 0.0, format!("the cutter fits into the hole of {diameter} mm"))
                }
                Some(diameter) => {
                    (false, 0.0, format!("the hole of {diameter} mm is not larger than the cutter"))
                }
                None => (false, 0.0, "no hole is drilled before".to_owned()),
            },
            EntryMethod::Helix => helix_row(spec, rough, wall),
            EntryMethod::Ramp => {
                let angle = spec.cutter.max_ramp_angle.unwrap_or(USUAL_RAMP).to_degrees();
                let given = if spec.cutter.max_ramp_angle.is_some() { "" } else { ", our default," };
                (true, 0.0, format!("strategy `ramping`, at most {angle:.2}\u{b0}{given} down"))
            }
            EntryMethod::Plunge if spec.cutter.centre_cutting => {
                (true, 0.0, "the cutter cuts at its centre; its whole face is loaded".to_owned())
            }
            EntryMethod::Plunge => (false, 0.0, "the cutter does not cut at its centre".to_owned()),
        };
        EntryRow { way, possible, core, reason, chosen: way == taken }
    });
    Ok((entry, rows.to_vec()))
}

fn helix_row(spec: &BoreSpec, rough: &Rough, wall: f64) -> (bool, f64, String) {
    let a = spec.cutter_radius();
    if let Strategy::Helix | Strategy::OutlineHelix = spec.strategy {
        let core = 2.0 * (wall - a).clamp(0.0, f64::INFINITY);
        let reason = if core > 0.0 {
            format!("at the wall it leaves a core of {core:.3} mm")
        } else {
            "at the wall the cutter reaches over the centre".to_owned()
        };
        return (core == 0.0 || spec.strategy == Strategy::OutlineHelix, core, reason);
    }
    let given = spec.entry.filter(|e| matches!(e, Entry::Helix { .. }));
    let entry = given.unwrap_or_else(|| usual_helix(spec, wall));
    let Entry::Helix { radius, pitch } = entry else { return (false, 0.0, String::new()) };
    let core = 2.0 * (radius - a).clamp(0.0, f64::INFINITY);
    let slope = (pitch / (TAU * radius)).atan().to_degrees();
    let about = format!("radius {radius:.3} mm, pitch {pitch:.3} mm, {slope:.2}\u{b0} down");
    match check(spec, &Rough { start: None, ..*rough }, entry, wall) {
        Ok(()) => (true, core, format!("{about}; below the cutter's radius: no core")),
        Err(e) => (false, core, format!("{about}; {}", e.0.message)),
    }
}

/// The entry that the plan takes to a path of radius `wall` [mm]: the given one, or the best possible.
pub fn chosen(spec: &BoreSpec, rough: &Rough, wall: f64) -> Entry {
    match (spec.entry, rough.start) {
        (Some(given), _) => given,
        (None, Some(_)) => Entry::Plunge,
        (None, None) => usual_helix(spec, wall),
    }
}

/// The usual helix into a bore.
fn usual_helix(spec: &BoreSpec, wall: f64) -> Entry {
    let radius = usual_radius(spec, wall);
    Entry::Helix { radius, pitch: usual_pitch(spec, radius) }
}

/// Descent of a turn of a helix as steep as the cutter is known to follow [mm].
pub(super) fn usual_pitch(spec: &BoreSpec, radius: f64) -> f64 {
    TAU * radius * usual_ramp(&spec.cutter).tan()
}

/// Radius of the usual entry helix [mm].
pub(super) fn usual_radius(spec: &BoreSpec, wall: f64) -> f64 {
    let (radius, room) = (USUAL_SHARE * spec.cutter_radius(), 0.5 * wall);
    if room < radius { room } else { radius }
}

fn usual_ramp(cutter: &CutterData) -> f64 {
    RESERVE * cutter.max_ramp_angle.unwrap_or(USUAL_RAMP).clamp(0.0, USUAL_RAMP)
}

/// Checks a way down to a path of radius `wall` [mm]: whether the cutter may go it, and whether it fits the start.
///
/// # Errors
/// `KC0403` with the bound that is broken and the help.
pub(super) fn check(spec: &BoreSpec, rough: &Rough, entry: Entry, wall: f64) -> Result<()> {
    let a = spec.cutter_radius();
    match (entry, rough.start) {
        (Entry::PreDrilled { .. }, Some(_)) => Err(impossible(
            "roughing from a pre-drilled hole starts in the middle of the hole, not in another point",
        )
        .help("leave out `rough.start`, or plunge there")
        .key("rough.start")
        .into()),
        (Entry::PreDrilled { diameter }, None) => {
            if diameter > spec.cutter.diameter && diameter.is_finite() {
                return Ok(());
            }
            Err(impossible("the cutter does not fit into the pre-drilled hole")
                .value_mm(diameter)
                .bound_mm(spec.cutter.diameter)
                .help("drill larger, use a smaller cutter, or enter by a helix from the centre")
                .key("entry.diameter")
                .into())
        }
        (Entry::Plunge, _) if !spec.cutter.centre_cutting => {
            Err(impossible("a cutter that does not cut at its centre cannot plunge")
                .help("enter by a helix, drill first, or use a centre-cutting cutter")
                .key("entry")
                .into())
        }
        (Entry::Plunge, _) => Ok(()),
        (Entry::Helix { .. }, Some(_)) => {
            Err(impossible("a helix is about the bore's centre and cannot begin in another point")
                .help("start in the centre, or plunge")
                .key("entry")
                .into())
        }
        (Entry::Helix { radius, pitch }, None) => {
            let bound = a.min(wall);
            if !(radius > 0.0 && radius < bound) {
                return Err(impossible(
                    "the entry helix leaves a core: its radius must lie below the cutter's and the path's",
                )
                .value_mm(radius)
                .bound_mm(bound)
                .key("entry.radius")
                .help("use a smaller helix radius")
                .into());
            }
            helix::follows(&spec.cutter, radius, pitch)
        }
    }
}

pub(super) fn impossible(message: &str) -> Finding {
    Finding::error(Code::ENTRY_IMPOSSIBLE, message)
}
