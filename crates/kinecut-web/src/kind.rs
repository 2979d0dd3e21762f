//! Kinds of files in an opened folder.

use serde::Serialize;

/// A kind of file, by its name and its beginning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Kind {
    /// A job.
    Job,
    /// A machine.
    Machine,
    /// Tools and holders.
    Tools,
    /// Cutting data of a shop.
    Cutting,
    /// Input of a planner: a hole, a drilling, a face, a moving tool.
    Question,
    /// A surface by its generating lines.
    Surface,
    /// A program of a machine.
    Program,
    /// A mesh.
    Mesh,
    /// An outline.
    Outline,
    /// Another text.
    Text,
    /// A file that a run has written.
    Result,
}

/// Endings of programs; those of [`control_of_name`](kinecut::job::control_of_name) are among them.
const PROGRAMS: &[&str] =
    &["nc", "ngc", "gcode", "tap", "cnc", "mpf", "spf", "h", "i", "eia", "min", "pim", "cl", "o"];

impl Kind {
    /// The kind by the name alone; `None`: the text has to tell it. The other `None`: no file for the workbench.
    pub(crate) fn of_name(name: &str) -> Option<Option<Kind>> {
        let (stem, ending) = name.rsplit_once('.').unwrap_or((name, ""));
        let ending = ending.to_ascii_lowercase();
        Some(match ending.as_str() {
            "toml" => None,
            "json" if name.ends_with(".schema.json") => return None,
            "json" if matches!(stem, "verdict" | "plan" | "engagement" | "inspection") => Some(Kind::Result),
            "json" => None,
            "stl" | "3mf" => Some(Kind::Mesh),
            "dxf" | "svg" => Some(Kind::Outline),
            "md" | "csv" | "txt" | "ini" | "hal" | "tbl" | "var" => Some(Kind::Text),
            "tools" => Some(Kind::Tools),
            "html" | "glb" | "ply" => Some(Kind::Result),
            "" if is_program_number(name) => Some(Kind::Program),
            other if PROGRAMS.contains(&other) => Some(Kind::Program),
            _ => return None,
        })
    }

    /// The kind of a TOML or JSON text by the keys at its top.
    pub(crate) fn of_text(text: &str) -> Kind {
        let has = |key: &str| text.lines().any(|line| names_key(line, key));
        let is_json = text.trim_start().starts_with(['{', '[']) && !text.trim_start().starts_with("[[");
        let json = |key: &str| is_json && text.contains(&format!("\"{key}\""));
        // Words of the planners, and of tools that move.
        let asks = [
            "operation",
            "hole",
            "drill",
            "face",
            "motion",
            "moment",
            "move",
            "moves",
            "twist",
            "pose",
            "screw",
            "joints",
            "of",
            "grazing",
            "envelope",
        ];
        if has("setup") || (has("stock") && has("post")) {
            Kind::Job
        } else if ["directrix", "like"].into_iter().any(|key| has(key) || json(key)) {
            Kind::Surface
        } else if asks.into_iter().any(|key| has(key) || json(key)) {
            Kind::Question
        } else if has("code") || has("joint") || has("axes") {
            Kind::Machine
        } else if has("tool") || has("holder") {
            Kind::Tools
        } else if has("cutting") || has("material") {
            Kind::Cutting
        } else {
            Kind::Text
        }
    }
}

/// Whether a line of TOML begins a table or a value of a key.
fn names_key(line: &str, key: &str) -> bool {
    let line = line.trim_start();
    let name = line.trim_start_matches('[').trim_start();
    let Some(rest) = name.strip_prefix(key) else { return false };
    let rest = rest.trim_start();
    match line.starts_with('[') {
        true => rest.starts_with([']', '.']),
        false => rest.starts_with(['=', '.']),
    }
}

/// `O1234`, as controls name their programs.
fn is_program_number(name: &str) -> bool {
    let digits = name.strip_prefix(['O', 'o']);
    digits.is_some_and(|d| !d.is_empty() && d.bytes().all(|b| b.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_examples_are_what_they_are() {
        let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
        for (file, kind) in [
            ("01_bore/job.toml", Kind::Job),
            ("07_external_program/job.toml", Kind::Job),
            ("12_compare/hole.toml", Kind::Question),
            ("04_gear_pump_cover/face.toml", Kind::Question),
            ("03_drill_through_shaft/figure_7.toml", Kind::Question),
            ("06_five_axis_sweep/envelope.toml", Kind::Question),
            ("06_five_axis_sweep/envelopes.toml", Kind::Question),
            ("06_five_axis_sweep/tool.toml", Kind::Question),
            ("06_five_axis_sweep/motions.toml", Kind::Question),
            ("06_five_axis_sweep/barrel.toml", Kind::Text),
            ("18_head_and_table/vertical_mill.toml", Kind::Machine),
            ("21_plate_by_sizes/tools.toml", Kind::Tools),
            ("05_machine_from_code/cone.toml", Kind::Surface),
            ("05_machine_from_code/thread.toml", Kind::Surface),
            ("05_machine_from_code/gear_flank.toml", Kind::Surface),
            ("05_machine_from_code/trunnion.toml", Kind::Machine),
        ] {
            let text = std::fs::read_to_string(format!("{examples}/{file}")).unwrap();
            assert_eq!(Kind::of_name(file), Some(None));
            assert_eq!(Kind::of_text(&text), kind, "{file}");
        }
    }

    #[test]
    fn names_tell_the_kind_of_most_files() {
        let kinds = ["O1007.nc", "O1234", "part.STL", "cover.dxf", "x.exe", "job.schema.json", "a.toml"];
        let wanted = [
            Some(Some(Kind::Program)),
            Some(Some(Kind::Program)),
            Some(Some(Kind::Mesh)),
            Some(Some(Kind::Outline)),
            None,
            None,
            Some(None),
        ];
        assert_eq!(kinds.map(Kind::of_name), wanted);
    }
}
