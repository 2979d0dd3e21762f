//! Tools of LinuxCNC's tool table: numbers, diameters and lengths are from there, shapes from its remarks.

use std::fmt::Write as _;

use super::tools::{CarriedTool, kind_in, tool_in};
use crate::base::{Result, Sources};
use crate::nc::{TableTool, tool_table};

/// Length of the flutes of a tool of which nothing says it [diameters].
const FLUTES: f64 = 4.0;
/// Ending of the name of a tool table.
const ENDING: &str = ".tbl";

/// Whether a file is a tool table of LinuxCNC.
pub(crate) fn is_tool_table(name: &str) -> bool {
    name.len() >= ENDING.len()
        && name.as_bytes()[name.len() - ENDING.len()..].eq_ignore_ascii_case(ENDING.as_bytes())
}

/// The tools of a tool table that have a diameter; `unit` is that of its lengths in mm.
///
/// # Errors
/// Those of [`tool_table`].
pub(crate) fn tools_of_table(name: &str, text: &str, unit: f64) -> Result<Vec<CarriedTool>> {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let all = tool_table(&sources, file, unit)?;
    Ok(all.iter().filter_map(|tool| carried(tool, unit)).collect())
}

fn carried(tool: &TableTool, unit: f64) -> Option<CarriedTool> {
    let remark = tool.remark.to_ascii_uppercase();
    let said = tool_in(&remark, Some(tool.number), unit, tool.line);
    let said = said.filter(|said| said.number == tool.number);
    let kind = said.as_ref().map(|s| s.kind).or_else(|| kind_in(&remark)).unwrap_or("end-mill");
    let diameter = tool.diameter.or(said.as_ref().map(|s| s.diameter))?;
    Some(CarriedTool {
        number: tool.number,
        kind,
        diameter,
        corner_radius: said.as_ref().and_then(|s| s.corner_radius).filter(|r| 2.0 * r < diameter),
        point_angle: said.as_ref().and_then(|s| s.point_angle),
        length: Some(tool.offset[2]).filter(|z| *z > 0.0),
        line: tool.line,
    })
}

/// Tools as TOML of a job file.
pub(crate) fn toml_of(tools: &[CarriedTool]) -> String {
    let mut out = String::new();
    for tool in tools {
        let _ = writeln!(out, "[[tool]]                                # from line {}", tool.line);
        let _ = writeln!(out, "number = {}\ntype = \"{}\"", tool.number, tool.kind);
        // A conical cutter is given by its tip.
        let diameter = if tool.kind == "tapered" { 0.0 } else { tool.diameter };
        let _ = writeln!(out, "diameter = {}", shown(diameter));
        let flutes = if tool.kind == "tapered" {
            let half = 0.5 * tool.point_angle.unwrap_or(90.0);
            let height = shown(0.5 * tool.diameter / half.to_radians().tan());
            let half = shown(half);
            let _ = writeln!(out, "half_angle = {half}\nflute_length = {height}  # a sharp tip is taken");
            height
        } else {
            let flutes = shown(FLUTES * tool.diameter);
            let _ =
                writeln!(out, "flute_length = {flutes}                     # a guess: {FLUTES} diameters");
            flutes
        };
        if let Some(radius) = tool.corner_radius {
            let _ = writeln!(out, "corner_radius = {}", shown(radius));
        }
        if let Some(angle) = tool.point_angle.filter(|_| tool.kind == "drill") {
            let _ = writeln!(out, "point_angle = {}", shown(angle));
        }
        match tool.length {
            Some(length) if length >= flutes => {
                let _ = writeln!(out, "gauge_length = {}", shown(length));
            }
            Some(length) => {
                let _ = writeln!(out, "# gauge_length = {} is shorter than the flutes", shown(length));
            }
            None => {}
        }
        out.push('\n');
    }
    out
}

/// A tool in words.
pub(crate) fn in_words(tool: &CarriedTool) -> String {
    let length = match tool.length {
        Some(length) => format!(", {} mm long", shown(length)),
        None => String::new(),
    };
    format!("T{} {} {} mm{length} (line {})", tool.number, tool.kind, shown(tool.diameter), tool.line)
}

/// A length in micrometres at most.
fn shown(value: f64) -> f64 {
    (value * 1e3).round() / 1e3 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_of_the_table_and_shapes_of_the_remarks() {
        let text = "T1 P1 Z75.2 D6 ;6 mm flat end mill\nT2 P2 D.2 Z1.2 ;#7 tap drill\nT3 P3 ;probe\nT4 D10 Z0 ;ball\nT5 Z9 ;5mm drill\n";
        let tools = tools_of_table("tool.tbl", text, 1.0).unwrap();
        let all: Vec<_> = tools.iter().map(|t| (t.number, t.kind, t.diameter, t.length)).collect();
        assert_eq!(
            all,
            [
                (1, "end-mill", 6.0, Some(75.2)),
                (2, "drill", 0.2, Some(1.2)),
                (4, "ball-nose", 10.0, None),
                (5, "drill", 5.0, Some(9.0))
            ]
        );
        let toml = toml_of(&tools);
        assert!(
            toml.contains("gauge_length = 75.2\n") && toml.contains("# gauge_length = 9 is shorter"),
            "{toml}"
        );
        assert_eq!(in_words(&tools[0]), "T1 end-mill 6 mm, 75.2 mm long (line 1)");
        assert!(is_tool_table("a/TOOL.TBL") && !is_tool_table("a.toml") && !is_tool_table("tbl"));
        assert_eq!(tools_of_table("t.tbl", "T1 D.25 Z2", 25.4).unwrap()[0].diameter, 6.35);
    }
}
