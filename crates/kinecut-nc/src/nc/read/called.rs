//! Programs that a text calls and does not hold.

use crate::nc::Control;
use crate::nc::dialect::FlowWords;
use crate::nc::fanuc::statement::Places;
use crate::nc::linuxcnc::o_word::OLines;
use crate::nc::scan::lines_with;

/// Names under which programs may be found that a text calls and does not hold: each list is one program, its names in the
/// order in which they are looked for, in small letters and without ending.
///
/// A call with a computed number is not among them.
///
/// ```
/// # use kinecut_nc as kinecut;
/// use kinecut::nc::{Control, called};
/// let text = "o<drill> call [5]\nM98 P20\nM2\nO20\nM99\n";
/// assert_eq!(called(text, Control::LinuxCnc), [["drill"]]);
/// assert_eq!(called("M98 P10 L2\nM30", Control::Fanuc), [["o0010", "0010", "o10", "10"]]);
/// assert_eq!(called("G66 P10 A1.\nM30", Control::Fanuc), [["o0010", "0010", "o10", "10"]]);
/// ```
pub fn called(text: &str, control: Control) -> Vec<Vec<String>> {
    let flow = control.dialect().flow;
    let mut found: Vec<Vec<String>> = Vec::new();
    let mut add = |names: Vec<String>| {
        if !found.contains(&names) {
            found.push(names);
        }
    };
    match flow {
        FlowWords::None => {}
        FlowWords::OWords => {
            let lines = OLines::of(text);
            lines
                .calls(text)
                .into_iter()
                .filter(|name| lines.sub(name).is_none())
                .for_each(|name| add(vec![name]));
            for number in numbers(text, false) {
                if lines.program(number).is_none() {
                    add(vec![number.to_string()]);
                }
            }
        }
        FlowWords::MacroB => {
            let asked = numbers(text, true);
            let places = if asked.is_empty() { Places::default() } else { Places::of(text) };
            for number in asked {
                if places.program(number).is_none() {
                    add(names_of(number));
                }
            }
        }
    }
    found
}

/// Names under which the program of a number may be kept.
pub(super) fn names_of(number: u32) -> Vec<String> {
    let mut names =
        vec![format!("o{number:04}"), format!("{number:04}"), format!("o{number}"), number.to_string()];
    names.dedup();
    names
}

/// Numbers of programs behind `M98`, `G65` and `G66`.
fn numbers(text: &str, macro_b: bool) -> Vec<u32> {
    let mut found = Vec::new();
    // A number stands behind a P.
    for (start, after) in lines_with(text, b'P') {
        let line = &text[start..after];
        let may = line.contains("98") && line.contains(['M', 'm'])
            || macro_b && (line.contains("65") || line.contains("66"));
        if !may {
            continue;
        }
        let code: String = line
            .split(['(', ';'])
            .next()
            .unwrap_or_default()
            .chars()
            .filter(|c| !c.is_ascii_whitespace())
            .map(|c| c.to_ascii_uppercase())
            .collect();
        let macro_call = macro_b && (code.contains("G65P") || code.contains("G66P"));
        if !code.contains("M98") && !macro_call {
            continue;
        }
        let Some(at) = code.find('P') else { continue };
        let digits: String = code[at + 1..].chars().take_while(char::is_ascii_digit).collect();
        let Ok(mut number) = digits.parse::<u32>() else { continue };
        if macro_b && !macro_call && digits.len() > 4 && !code.contains('L') {
            number %= 10_000;
        }
        if !found.contains(&number) {
            found.push(number);
        }
    }
    found
}
