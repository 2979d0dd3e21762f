//! Tools of LinuxCNC's tool table: numbers, diameters and lengths are from there, shapes from its remarks.

use super::tools::{CarriedTool, kind_in, solid, tool_in};
use crate::base::{Result, Sources};
use crate::nc::{TableTool, tool_table};

/// Ending of the name of a tool table.
const ENDING: &str = ".tbl";

/// Whether a file is a tool table of LinuxCNC, by its name.
///
/// ```
/// use kinecut::job::is_tool_table;
/// assert!(is_tool_table("mill/TOOL.TBL") && !is_tool_table("tools.toml"));
/// ```
pub fn is_tool_table(name: &str) -> bool {
    name.len() >= ENDING.len()
        && name.as_bytes()[name.len() - ENDING.len()..].eq_ignore_ascii_case(ENDING.as_bytes())
}

/// Tools of a tool table that can be followed, and those that cannot.
#[derive(Clone, Debug, Default)]
pub(crate) struct TableTools {
    /// By number.
    pub(crate) tools: Vec<CarriedTool>,
    /// Numbers of tools without a diameter.
    pub(crate) without_diameter: Vec<u32>,
    /// Numbers of tools that are offset across their axis.
    pub(crate) across: Vec<u32>,
}

impl TableTools {
    /// Reads a tool table; `unit` is that of its lengths in mm.
    ///
    /// # Errors
    /// Those of [`tool_table`].
    pub(crate) fn read(name: &str, text: &str, unit: f64) -> Result<TableTools> {
        let mut sources = Sources::default();
        let file = sources.add(name, text);
        let mut read = TableTools::default();
        for tool in tool_table(&sources, file, unit)? {
            match carried(&tool, unit) {
                _ if tool.offset[..2] != [0.0; 2] => read.across.push(tool.number),
                Some(tool) => read.tools.push(tool),
                None => read.without_diameter.push(tool.number),
            }
        }
        Ok(read)
    }

    /// The tools that cannot be followed, in words behind those that can.
    pub(crate) fn left_out(&self) -> String {
        let named = |numbers: &[u32], why: &str| {
            let all: Vec<String> = numbers.iter().map(|n| format!("T{n}")).collect();
            if all.is_empty() { String::new() } else { format!("; left out: {} ({why})", all.join(", ")) }
        };
        named(&self.without_diameter, "no diameter") + &named(&self.across, "offset across the axis")
    }
}

fn carried(tool: &TableTool, unit: f64) -> Option<CarriedTool> {
    let remark = tool.remark.to_ascii_uppercase();
    let said = tool_in(&remark, Some(tool.number), unit, tool.line);
    let said = said.filter(|said| said.number == tool.number);
    let kind = said.as_ref().map(|s| s.kind).or_else(|| kind_in(&remark)).unwrap_or("end-mill");
    let diameter = tool.diameter.or(said.as_ref().map(|s| s.diameter))?;
    let (kind, corner_radius) = solid(kind, said.as_ref().and_then(|s| s.corner_radius), diameter);
    Some(CarriedTool {
        number: tool.number,
        kind,
        diameter,
        corner_radius,
        point_angle: said.as_ref().and_then(|s| s.point_angle),
        length: Some(tool.offset[2]).filter(|z| *z != 0.0),
        line: tool.line,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_of_the_table_and_shapes_of_the_remarks() {
        let text = "T1 P1 Z75.2 D6 ;6 mm flat end mill\nT2 P2 D.2 Z1.2 ;#7 tap drill\nT3 P3 ;probe\nT4 D10 Z0 ;ball\n\
                    T5 Z9 ;5mm drill\nT6 X.5 D3 Z9\nT7 D4 ;D=10 CR=3 bull\nT8 D9 Y-1\n";
        let read = TableTools::read("tool.tbl", text, 1.0).unwrap();
        let all: Vec<_> = read.tools.iter().map(|t| (t.number, t.kind, t.diameter, t.length)).collect();
        assert_eq!(
            all,
            [
                (1, "end-mill", 6.0, Some(75.2)),
                (2, "drill", 0.2, Some(1.2)),
                (4, "ball-nose", 10.0, None),
                (5, "drill", 5.0, Some(9.0)),
                // A corner radius of 3 mm is of another tool than one of 4 mm.
                (7, "end-mill", 4.0, None)
            ]
        );
        assert_eq!(
            read.left_out(),
            "; left out: T3 (no diameter); left out: T6, T8 (offset across the axis)"
        );
        assert_eq!(TableTools::read("t.tbl", "T1 D.25 Z2", 25.4).unwrap().tools[0].diameter, 6.35);
        assert_eq!(TableTools::read("t.tbl", "T1 D.25", 1.0).unwrap().left_out(), "");
        assert!(is_tool_table("a/TOOL.TBL") && !is_tool_table("a.toml") && !is_tool_table("tbl"));
    }
}
