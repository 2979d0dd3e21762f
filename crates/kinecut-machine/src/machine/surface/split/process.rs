//! Names of processes, by rules from the tool, the motions and the set-up.

use super::super::GeneratedSurface;
use super::{ContactEffect, LinkKind, Source, Split, ToolKind};
use super::{Retreat, SetupMotion};
use crate::machine::Elementary;

impl LinkKind {
    /// Process that uses a link of this kind.
    fn process(self) -> &'static str {
        match self {
            LinkKind::Screw => "thread cutting",
            LinkKind::Cam => "variable-pitch helicoid (cam) cutting",
            LinkKind::Rolling => "generating by rolling (obkat)",
            LinkKind::Spiral => "spiral (scroll) cutting",
            LinkKind::Ruled => "ruled-surface generation",
            LinkKind::Polygon => "polygon / elliptic turning",
            LinkKind::Contour => "contour (copy) cutting",
        }
    }
}

/// The name of a valid split.
pub(super) fn process(split: &Split) -> String {
    let turns = split.forming.iter().any(|m| m.is_rotation());
    let shifts = split.forming.iter().any(|m| !m.is_rotation());
    let linked = !split.links.is_empty();
    let tool = split.tool_kind.map_or("", ToolKind::name);
    let hard = split.links.iter().map(|l| l.kind).find(|k| *k != LinkKind::Contour);
    match split.tool_kind {
        Some(ToolKind::Surface) => die(&split.setup).to_owned(),
        _ if hard.is_some() => {
            let name = hard.map_or("", LinkKind::process);
            format!("{name}, {tool} (linked motions)")
        }
        Some(ToolKind::Point) => point(turns, shifts, linked).to_owned(),
        _ if turns => {
            let axial =
                split.setup.chosen.is_some_and(|c| c.source == Source::AddedLink && is_along_z(c.retreat));
            if axial && split.setting.is_empty() {
                format!("axial form tool, {tool} (countersink, hollow mill, core drill)")
            } else {
                format!("form turning, {tool}{}", angle_note(split))
            }
        }
        _ if split.setup.chosen.is_some_and(|c| c.verdict == ContactEffect::Sliding) => {
            format!("broaching / drawing, {tool} = full closed profile")
        }
        _ => {
            let note = if linked { " (linked translations)" } else { "" };
            format!("form planing, broaching or wire cutting, {tool}{note}")
        }
    }
}

fn is_along_z(retreat: Retreat) -> bool {
    matches!(retreat, Retreat::Link { motion: Elementary::Z, .. })
}

fn point(turns: bool, shifts: bool, linked: bool) -> &'static str {
    match (turns, shifts, linked) {
        (true, _, true) => "contour turning, point tool (linked translations)",
        (true, true, false) => "longitudinal or face turning, point tool",
        (true, false, false) => {
            "turning by two rotations (radius turning, whirling, ring generation), point tool"
        }
        (false, _, true) => "contour planing, point tool (linked translations)",
        (false, _, false) => "planing / shaping, point tool",
    }
}

fn angle_note(split: &Split) -> &'static str {
    if split.setting.iter().any(|m| m.is_rotation()) {
        " (edge angle set on the machine)"
    } else if split.built_in.iter().any(|e| e.motion.is_rotation()) {
        " (edge angle ground into the tool)"
    } else {
        ""
    }
}

fn die(setup: &SetupMotion) -> &'static str {
    match setup.chosen {
        None => "no single-piece die (undercut): split die, rolling or casting",
        Some(c) if c.verdict == ContactEffect::Free => "stamping / die sinking",
        Some(c) if c.verdict == ContactEffect::Tangent => "stamping / die sinking with zero draft",
        Some(c) if matches!(c.retreat, Retreat::Slide(super::super::Slide::Turn { .. })) => {
            "tapping / die threading"
        }
        Some(_) => "broaching / drawing / extrusion",
    }
}

/// Remarks on a valid split in addition to its name.
pub(super) fn remarks(surface: &GeneratedSurface, split: &Split) -> Vec<String> {
    let mut remarks = Vec::new();
    for element in &split.built_in {
        remarks.push(if element.motion.is_rotation() {
            format!("the edge angle {} is ground into the tool", element.law)
        } else {
            format!("the length {} along {} is built into the tool", element.law, axis_name(element.motion))
        });
    }
    for element in split.machine.iter().filter(|e| !surface.is_forming(e)) {
        remarks.push(format!("motion {} is set to {} and stands still", element.motion, element.law));
    }
    for link in &split.links {
        let motions: Vec<String> =
            link.elements.iter().map(|e| format!("{} by {}", e.motion, e.law)).collect();
        remarks.push(format!("linked over {} ({}): {}", link.variable, link.kind.name(), motions.join(", ")));
    }
    match split.setup.chosen {
        None if split.setup.needed => {
            remarks.push("the tool cannot go back in one piece: make it in parts".to_owned())
        }
        Some(c) if c.verdict == ContactEffect::Tangent => {
            remarks.push(
                "the tool slides along the surface somewhere as it goes back: give it draft".to_owned(),
            );
        }
        Some(c) if c.source == Source::SettingLink => {
            remarks.push(format!("the tool is set by {}, which the machine has anyway", c.retreat));
        }
        Some(c) if c.source == Source::AddedLink => {
            remarks.push(format!("the tool is set by a motion of its own: it goes back by {}", c.retreat));
        }
        Some(c) => remarks.push(format!("the tool goes back by the {}", c.retreat)),
        None => {}
    }
    remarks
}

fn axis_name(motion: Elementary) -> String {
    motion.letter().map_or_else(|| motion.to_string(), String::from)
}
