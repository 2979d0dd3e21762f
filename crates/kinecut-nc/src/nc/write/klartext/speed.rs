//! The speed of a tool stands in its `TOOL CALL`.

use crate::nc::write::page::Line;

/// Block that gives a speed to the tool in the spindle.
const SPEED: &str = "TOOL CALL S";
/// Every other block that begins with these words calls a tool.
const CALL: &str = "TOOL CALL ";

/// Writes the speed that a tool first turns at into its calls before that speed, instead of in a block of its own.
///
/// This is done on the blocks that were written: what a program says of a speed in a move that writes nothing is not in
/// the text, and a look at the program ahead would find it.
pub(in crate::nc::write) fn in_tool_calls(lines: &mut Vec<Line>) {
    // Calls since the last change of tool, while no speed is known for it.
    let mut calls: Vec<usize> = Vec::new();
    let mut tool = String::new();
    let mut said = Vec::new();
    for index in 0..lines.len() {
        let line = &lines[index];
        if !line.block {
            continue;
        }
        if line.text.starts_with(SPEED) {
            let word = line.text.strip_prefix("TOOL CALL").unwrap_or_default().to_owned();
            if !calls.is_empty() {
                said.push(index);
            }
            for call in calls.drain(..) {
                lines[call].text.push_str(&word);
            }
        } else if let Some(rest) = line.text.strip_prefix(CALL) {
            let name = rest.split([' ', '.']).next().unwrap_or_default();
            if tool != name {
                calls.clear();
                name.clone_into(&mut tool);
                calls.push(index);
            } else if !calls.is_empty() {
                calls.push(index);
            }
        }
    }
    let mut index = 0;
    let mut said = said.into_iter().peekable();
    lines.retain(|_| {
        let keep = said.next_if_eq(&index).is_none();
        index += 1;
        keep
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(text: &[&str]) -> Vec<String> {
        let mut lines: Vec<Line> = text
            .iter()
            .map(|t| Line { text: (*t).to_owned(), item: None, block: !t.starts_with(';') })
            .collect();
        in_tool_calls(&mut lines);
        lines.into_iter().map(|l| l.text).collect()
    }

    #[test]
    fn the_first_speed_goes_into_the_calls_of_its_tool() {
        let found = joined(&[
            "TOOL CALL 1 Z",
            "M5",
            "TOOL CALL 1.2 Z",
            "TOOL CALL S1200",
            "M3",
            "TOOL CALL S900",
            "TOOL CALL 12 Z",
            "; TOOL CALL S5",
            "TOOL CALL 1 Z",
            "TOOL CALL S7",
        ]);
        let expected = [
            "TOOL CALL 1 Z S1200",
            "M5",
            "TOOL CALL 1.2 Z S1200",
            "M3",
            "TOOL CALL S900",
            "TOOL CALL 12 Z",
            "; TOOL CALL S5",
            "TOOL CALL 1 Z S7",
        ];
        assert_eq!(found, expected);
    }
}
