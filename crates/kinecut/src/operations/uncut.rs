//! Inside corners that a cutter does not reach, as the parts of an operation along an outline say them.

use glam::DVec2;

use super::WearRegister;
use super::band::Fillet;
use crate::contouring::UncutCorner;
use crate::page::{Fact, fixed, trimmed};

/// A number with its noun.
pub(crate) fn count(n: usize, one: &str, more: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { more })
}

/// A place in words.
pub(crate) fn place(at: DVec2) -> String {
    format!("X{} Y{}", trimmed(at.x, 3), trimmed(at.y, 3))
}

/// The corners as fillets of a cutter's radius [mm], from which the wall is compared, under a wear register.
///
/// A register that moves the path of the centre away from the wall brings it to the intersection of its parallels. One that moves it
/// towards the wall lets the control go round the corner of the path, which is an outside one on that side. Where the register holds
/// the cutter's radius, the parallels of the wall meet either way.
pub(crate) fn fillets(uncut: &[UncutCorner], radius: f64, register: Option<WearRegister>) -> Vec<Fillet> {
    let (moved, is_full) = register.map_or((0.0, false), |r| (r.value, r.radius > 0.0));
    let fillet = |c: &UncutCorner| {
        let [from, to] = c.between;
        if moved < 0.0 && !is_full {
            return Fillet { centre: c.at, radius: radius - moved, between: c.between };
        }
        let back = (from + to) / (1.0 + from.dot(to));
        let centre = if back.is_finite() { c.at - moved * back } else { c.at };
        Fillet { centre, radius, between: c.between }
    };
    uncut.iter().map(fillet).collect()
}

/// Parts of the wall that are not compared; `radius`: that of the cutter [mm].
pub(crate) fn in_words(uncut: &[UncutCorner], radius: f64) -> Vec<String> {
    let gaps = uncut.iter().filter(|c| c.thickness.is_none()).count();
    let narrow = uncut.iter().filter(|c| c.is_part(radius)).count();
    let corners = uncut.len() - gaps - narrow;
    let mut parts = Vec::new();
    if narrow > 0 {
        parts.push(format!("{} that the cutter does not enter", count(narrow, "part", "parts")));
    }
    if corners > 0 {
        parts.push(format!("{} beyond the cutter's fillet", count(corners, "corner", "corners")));
    }
    if gaps > 0 {
        let gaps = count(gaps, "place", "places");
        parts.push(format!("{gaps} between two loops, where the cutter does not go"));
    }
    parts
}

/// The corners as the report has them; `radius`: that of the cutter [mm].
pub(crate) fn facts(uncut: &[UncutCorner], radius: f64) -> Vec<Fact> {
    let mut facts = Vec::new();
    for part in uncut.iter().filter(|c| c.is_part(radius)) {
        let note =
            format!("up to {} mm stay near {}", fixed(part.thickness.unwrap_or(0.0), 1), place(part.at));
        facts.push(Fact::new("Not entered", "a part of the outline").note(note));
    }
    let thick: Vec<f64> = uncut.iter().filter(|c| !c.is_part(radius)).filter_map(|c| c.thickness).collect();
    if let Some(worst) = thick.iter().copied().max_by(f64::total_cmp) {
        let note = format!("up to {} mm thick", fixed(worst, 3));
        facts.push(Fact::new("Corners that stay", format!("{}", thick.len())).note(note));
    }
    let between: Vec<String> = uncut.iter().filter(|c| c.thickness.is_none()).map(|c| place(c.at)).collect();
    if let Some(first) = between.first() {
        let note = format!("the cutter does not go there: for example near {first}");
        facts
            .push(Fact::new("Not cut between two loops", count(between.len(), "place", "places")).note(note));
    }
    facts
}
