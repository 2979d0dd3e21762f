//! The tool table of LinuxCNC: one tool a line, `T1 P1 Z75.2 D6 ;6 mm end mill`.
//!
//! A letter and a number each, in any order, small or capital; behind `;` a remark. T is the number, P the pocket, D the
//! diameter, X Y Z and the other axes the offsets; I, J and Q are of turning tools. Where a number comes twice the later
//! line counts. Lengths are in the unit of the machine. The older form of numbers alone is refused.

use crate::base::{Code, FileId, Finding, Result, Sources, Span};

/// A tool in a tool table of LinuxCNC, lengths in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct TableTool {
    /// Number on the control.
    pub number: u32,
    /// Offsets along X, Y and Z; the last is the length of a tool that stands along Z.
    pub offset: [f64; 3],
    /// Whether it has offsets of rotary axes, too.
    pub turned: bool,
    /// Diameter, where it is said and not nought.
    pub diameter: Option<f64>,
    /// The remark.
    pub remark: String,
    /// Its line, counted from 1.
    pub line: u32,
}

/// Letters that a line may have.
const LETTERS: &str = "TPXYZABCUVWDIJQ";
/// Largest number that is believed.
const LARGEST: f64 = 1e6;
/// Most lines: more than a control has pockets.
const MOST: usize = 100_000;

/// The tools of a tool table of LinuxCNC, by number; `unit` is the unit of its lengths in mm.
///
/// ```
/// use kinecut_nc::base::Sources;
/// use kinecut_nc::nc::tool_table;
/// let mut sources = Sources::default();
/// let file = sources.add("tool.tbl", "T3 P3 Z+2.0 D0.25 ;1/4 end mill\n");
/// let tools = tool_table(&sources, file, 25.4).unwrap();
/// assert_eq!((tools[0].number, tools[0].offset[2], tools[0].diameter), (3, 50.8, Some(6.35)));
/// ```
///
/// # Errors
/// `KC0202` with its place for a line that has no tool number, another letter, a letter twice, or no number behind one.
pub fn tool_table(sources: &Sources, file: FileId, unit: f64) -> Result<Vec<TableTool>> {
    let text = sources.text(file);
    let mut tools: Vec<TableTool> = Vec::new();
    let mut start = 0;
    for (index, line) in text.split_inclusive('\n').enumerate() {
        let at =
            |from: usize, to: usize| Span { file, start: (start + from) as u32, end: (start + to) as u32 };
        let wrong = |from: usize, to: usize, why: &str| {
            let message = format!("`{}` {why}", line[from..to].trim());
            let finding = Finding::error(Code::NC_SYNTAX, message).at(sources.locate(at(from, to)));
            finding.help("write a line as T1 P1 Z75.2 D6 ;remark")
        };
        if index >= MOST {
            let finding = wrong(0, line.len(), "is one line too many for a tool table");
            return Err(finding.value(index as f64 + 1.0, "lines").bound(MOST as f64, "lines").into());
        }
        let code = &line[..line.find(';').unwrap_or(line.len())];
        if !code.trim().is_empty() {
            let mut tool = one(code, wrong)?;
            tool.offset = tool.offset.map(|v| v * unit);
            tool.diameter = tool.diameter.map(|d| d * unit);
            tool.remark = line[code.len()..].trim_start_matches(';').trim().to_owned();
            tool.line = index as u32 + 1;
            tools.push(tool);
        }
        start += line.len();
    }
    // The sort is stable, so that the last of a number is the last line.
    tools.sort_by_key(|t| t.number);
    tools.reverse();
    tools.dedup_by_key(|t| t.number);
    tools.reverse();
    Ok(tools)
}

/// The tool of a line without its remark, in the units of the table.
fn one(code: &str, wrong: impl Fn(usize, usize, &str) -> Finding) -> Result<TableTool> {
    let mut values: [Option<f64>; LETTERS.len()] = [None; LETTERS.len()];
    let mut at = 0;
    while let Some(from) = code[at..].find(|c: char| !c.is_whitespace()).map(|n| at + n) {
        let to = code[from..].find(char::is_whitespace).map_or(code.len(), |n| from + n);
        at = to;
        let letter = code[from..].chars().next().map_or('?', |c| c.to_ascii_uppercase());
        let Some(place) = LETTERS.find(letter) else {
            let why = "is no word of a tool table, which are T, P, D, X, Y, Z and further axes";
            return Err(wrong(from, to, why).into());
        };
        let Some(value) = code[from + 1..to].parse().ok().filter(|v: &f64| v.abs() <= LARGEST) else {
            return Err(wrong(from, to, "has no number behind its letter").into());
        };
        if values[place].replace(value).is_some() {
            return Err(wrong(from, to, "is there twice in a line of a tool table").into());
        }
    }
    let value = |letter: char| LETTERS.find(letter).and_then(|place| values[place]);
    let end = code.trim_end().len();
    let number = value('T').filter(|t| *t >= 0.0 && t.fract() == 0.0);
    let Some(number) = number else {
        return Err(wrong(0, end, "has no tool number: T and a whole number").into());
    };
    Ok(TableTool {
        number: number as u32,
        offset: ['X', 'Y', 'Z'].map(|axis| value(axis).unwrap_or(0.0)),
        turned: "ABC".chars().any(|axis| value(axis).is_some_and(|turned| turned != 0.0)),
        diameter: value('D').filter(|d| *d != 0.0).map(f64::abs),
        remark: String::new(),
        line: 0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Result<Vec<TableTool>> {
        let mut sources = Sources::default();
        let file = sources.add("tool.tbl", text);
        tool_table(&sources, file, 1.0)
    }

    #[test]
    fn lines_are_letters_and_numbers_in_any_order() {
        let text =
            "; head\n\nT2 P7 Z+0.1 D1.5 ;1.5 mm  end mill; long\nt1 d3 z-75.5 x.5 I+95.0 Q1\nT2 Z8\r\n";
        let tools = table(text).unwrap();
        assert_eq!(tools.iter().map(|t| (t.number, t.line)).collect::<Vec<_>>(), [(1, 4), (2, 5)]);
        assert_eq!((tools[0].offset, tools[0].diameter), ([0.5, 0.0, -75.5], Some(3.0)));
        assert_eq!((tools[1].offset[2], tools[1].diameter, &*tools[1].remark), (8.0, None, ""));
        assert_eq!(table("T2 D1 ;1.5 mm  end mill; long").unwrap()[0].remark, "1.5 mm  end mill; long");
    }

    #[test]
    fn what_is_no_line_of_it_is_said_with_its_place() {
        let said = |text: &str| table(text).unwrap_err().to_string();
        assert_eq!(
            said("T1 D1\n 1 1 +0.5 0.1 1/8 end mill\n"),
            "tool.tbl:2:2: `1` is no word of a tool table, which are T, P, D, X, Y, Z and further axes; write a line as T1 P1 Z75.2 D6 ;remark"
        );
        assert!(said("T1 Zx").contains("`Zx` has no number behind its letter; write a line as T1 P1"));
        assert!(said("T1 D1 D2").contains("twice"));
        assert!(said("P1 D2").contains("has no tool number") && said("T1.5").contains("whole"));
        assert!(said("T1 Zinf").contains("no number") && said("T1 Z\u{e4}").contains("no number"));
        assert!(said("T-1").contains("whole"));
    }
}
