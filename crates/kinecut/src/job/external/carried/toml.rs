//! Tools that are carried, as a job file has them and in words.

use std::fmt::Write as _;

use super::tools::CarriedTool;

/// Length of the flutes of a tool of which nothing says it [diameters].
const FLUTES: f64 = 4.0;
/// Most tools that one sentence lists.
const LISTED: usize = 12;

/// Half the angle of the point of a conical cutter [degrees].
fn half_angle(tool: &CarriedTool) -> f64 {
    0.5 * tool.point_angle.unwrap_or(90.0)
}

/// Length of the flutes that is taken [mm].
fn flutes(tool: &CarriedTool) -> f64 {
    micrometres(match tool.kind {
        // A sharp tip is taken.
        "tapered" => 0.5 * tool.diameter / half_angle(tool).to_radians().tan(),
        _ => FLUTES * tool.diameter,
    })
}

/// Length from the gauge point, where it is above the flutes and can be that of the whole tool [mm].
fn gauge_length(tool: &CarriedTool) -> Option<f64> {
    tool.length.map(micrometres).filter(|length| *length >= flutes(tool))
}

/// Tools as TOML of a job file.
pub(crate) fn toml_of(tools: &[CarriedTool]) -> String {
    let mut out = String::new();
    for tool in tools {
        let _ = writeln!(out, "[[tool]]                                # from line {}", tool.line);
        let _ = writeln!(out, "number = {}\ntype = \"{}\"", tool.number, tool.kind);
        // A conical cutter is given by its tip.
        let diameter = if tool.kind == "tapered" { 0.0 } else { tool.diameter };
        let _ = writeln!(out, "diameter = {}", micrometres(diameter));
        let height = flutes(tool);
        if tool.kind == "tapered" {
            let half = micrometres(half_angle(tool));
            let _ = writeln!(out, "half_angle = {half}\nflute_length = {height}  # a sharp tip is taken");
        } else {
            let _ =
                writeln!(out, "flute_length = {height}                     # a guess: {FLUTES} diameters");
        }
        if let Some(radius) = tool.corner_radius {
            let _ = writeln!(out, "corner_radius = {}", micrometres(radius));
        }
        if let Some(angle) = tool.point_angle.filter(|_| tool.kind == "drill") {
            let _ = writeln!(out, "point_angle = {}", micrometres(angle));
        }
        if let Some(length) = gauge_length(tool) {
            let _ = writeln!(out, "gauge_length = {length}");
        } else if let Some(length) = tool.length {
            let _ = writeln!(out, "# gauge_length = {}: not above the flutes", micrometres(length));
        }
        out.push('\n');
    }
    out
}

/// A tool in words.
fn in_words(tool: &CarriedTool) -> String {
    let length = match (gauge_length(tool), tool.length) {
        (Some(length), _) => format!(", {length} mm long"),
        (None, Some(length)) => {
            format!(", its length of {} mm not taken, as it is not above the flutes", micrometres(length))
        }
        (None, None) => String::new(),
    };
    let diameter = micrometres(tool.diameter);
    format!("T{} {} {diameter} mm{length} (line {})", tool.number, tool.kind, tool.line)
}

/// Tools in words, the first of many.
pub(crate) fn all_in_words(tools: &[CarriedTool]) -> String {
    let first: Vec<String> = tools.iter().take(LISTED).map(in_words).collect();
    let rest = tools.len().saturating_sub(LISTED);
    let rest = if rest > 0 { format!(" and {rest} more") } else { String::new() };
    first.join(", ") + &rest
}

/// A length in micrometres at most.
pub(crate) fn micrometres(value: f64) -> f64 {
    (value * 1e3).round() / 1e3 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tool(number: u32, length: Option<f64>) -> CarriedTool {
        let (corner_radius, point_angle) = (None, None);
        CarriedTool { number, kind: "end-mill", diameter: 6.0, corner_radius, point_angle, length, line: 7 }
    }

    #[test]
    fn a_length_counts_above_the_flutes_only() {
        let toml = toml_of(&[tool(1, Some(24.0))]);
        assert!(toml.contains("flute_length = 24 ") && toml.contains("\ngauge_length = 24\n"), "{toml}");
        for (length, words) in [
            (Some(24.0), "T1 end-mill 6 mm, 24 mm long (line 7)"),
            (
                Some(23.9),
                "T1 end-mill 6 mm, its length of 23.9 mm not taken, as it is not above the flutes (line 7)",
            ),
            (
                Some(-40.0),
                "T1 end-mill 6 mm, its length of -40 mm not taken, as it is not above the flutes (line 7)",
            ),
            (None, "T1 end-mill 6 mm (line 7)"),
        ] {
            assert_eq!(all_in_words(&[tool(1, length)]), words);
            assert_eq!(toml_of(&[tool(1, length)]).contains("\ngauge_length"), length == Some(24.0));
        }
    }

    #[test]
    fn of_many_tools_the_first_are_listed() {
        let tools: Vec<CarriedTool> = (1..=14).map(|number| tool(number, None)).collect();
        let said = all_in_words(&tools);
        assert!(said.contains("T12 ") && !said.contains("T13 ") && said.ends_with(" and 2 more"), "{said}");
    }
}
