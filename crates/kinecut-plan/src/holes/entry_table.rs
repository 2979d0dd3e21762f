//! Which ways down are possible with a cutter, what each would leave, and which is taken.
//!
//! Order of preference: a hole drilled before (no load at all), a helix below the cutter's radius (even load, no
//! core), a ramp along the spiral, a plunge (only for cutters that cut at their centre).

use super::entry::{self, USUAL_RAMP, chosen, usual_helix};
use super::spec::{BoreSpec, Entry, Rough, Strategy};
use crate::base::Result;

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

/// The entry table of a bore that is roughed.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::holes::entry_table::{EntryMethod, ways};
/// use kinecut::holes::*;
/// let cutter =
///     CutterData { diameter: 40.0, centre_cutting: false, max_ramp_angle: None, flute_length: 45.0 };
/// let rough = Rough::new(4.0, 100.0);
/// let spec = BoreSpec { rough: Some(rough), ..BoreSpec::new(200.0, 30.0, cutter) };
/// let table = ways(&spec, &rough).unwrap();
/// assert!(!table.iter().find(|r| r.way == EntryMethod::Plunge).unwrap().possible);
/// assert_eq!(table.iter().find(|r| r.chosen).unwrap().way, EntryMethod::Helix);
/// ```
///
/// # Errors
/// Those of a bore without room for the cutter.
pub fn ways(spec: &BoreSpec, rough: &Rough) -> Result<Vec<EntryRow>> {
    let wall = spec.rough_radius(rough, spec.floor())?;
    let taken = match (spec.strategy, chosen(spec, rough)) {
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
    Ok(rows.to_vec())
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
    let entry = given.unwrap_or_else(|| usual_helix(spec, rough));
    let Entry::Helix { radius, pitch } = entry else { return (false, 0.0, String::new()) };
    let core = 2.0 * (radius - a).clamp(0.0, f64::INFINITY);
    let slope = (pitch / (std::f64::consts::TAU * radius)).atan().to_degrees();
    let about = format!("radius {radius:.3} mm, pitch {pitch:.3} mm, {slope:.2}\u{b0} down");
    let probe = BoreSpec { entry: Some(entry), ..*spec };
    match entry::check(&probe, &Rough { start: None, ..*rough }) {
        Ok(()) => (true, core, format!("{about}; below the cutter's radius: no core")),
        Err(e) => (false, core, format!("{about}; {}", e.0.message)),
    }
}
