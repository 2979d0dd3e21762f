//! Tools and raw stock that a program carries in its comments.
//!
//! Systems that make programs write what they know into comments: Fusion `(T1 D=6. CR=0. - ZMIN=-5. - FLAT END MILL)`, Mastercam
//! `(T1 | 6. FLAT ENDMILL | H1)`, others `(TOOL 4 = 3/8IN ENDMILL)` or `T27 M6 (8.5MM DRILL)`; Vectric the size of the material,
//! SINUMERIK `WORKPIECE(..)`, HEIDENHAIN `BLK FORM`. What is taken from there is a guess: it is said, and no proof rests upon it.

mod stock;
mod table;
mod toml;
mod tools;

pub use stock::CarriedStock;
pub(crate) use table::TableTools;
pub use table::is_tool_table;
pub(crate) use toml::{all_in_words, micrometres, toml_of};
pub use tools::CarriedTool;
pub(in crate::job) use tools::kind_in;

use crate::nc::Control;

/// What a program carries.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Carried {
    /// Its tools, by number.
    pub tools: Vec<CarriedTool>,
    /// Its raw stock.
    pub stock: Option<CarriedStock>,
}

/// What the comments of a program tell of tools and stock, in mm.
///
/// ```
/// use kinecut::job::carried;
/// use kinecut::nc::Control;
/// let text = "(T1 D=6. CR=0. - ZMIN=-5. - FLAT END MILL)\nG21 G90\nT1 M6\n";
/// let tools = carried(text, Control::Fanuc).tools;
/// assert_eq!((tools[0].number, tools[0].kind, tools[0].diameter, tools[0].line), (1, "end-mill", 6.0, 1));
/// ```
pub fn carried(text: &str, control: Control) -> Carried {
    let unit = if in_inches(text) { 25.4 } else { 1.0 };
    Carried { tools: tools::tools(text, unit), stock: stock::stock(text, unit, control) }
}

/// Whether the first unit that a program says is the inch.
fn in_inches(text: &str) -> bool {
    for line in text.lines() {
        let code = code_of(line);
        let bytes = code.as_bytes();
        for (at, _) in code.match_indices(['G', 'g']) {
            let digits: String = code[at + 1..].chars().take_while(|c| c.is_ascii_digit()).take(4).collect();
            let starts = at == 0 || !bytes[at - 1].is_ascii_alphabetic();
            match digits.trim_start_matches('0') {
                "20" | "70" | "700" if starts => return true,
                "21" | "71" | "710" if starts => return false,
                _ => {}
            }
        }
        if code.trim_start().starts_with("BEGIN PGM") || code.contains(" BEGIN PGM ") {
            return code.trim_end().ends_with("INCH");
        }
    }
    false
}

/// The line before its first comment.
fn code_of(line: &str) -> &str {
    &line[..line.find(['(', ';']).unwrap_or(line.len())]
}

/// The comments of a line.
fn comments_of(line: &str) -> impl Iterator<Item = &str> {
    let mut rest = line;
    std::iter::from_fn(move || {
        let at = rest.find(['(', ';'])?;
        let inner = &rest[at + 1..];
        if rest.as_bytes()[at] == b';' {
            rest = "";
            return Some(inner.trim());
        }
        let end = inner.find(')').unwrap_or(inner.len());
        rest = inner.get(end + 1..).unwrap_or_default();
        Some(inner[..end].trim())
    })
}

/// The number that a text begins with: `6.`, `.375`, `3/8`, `1-1/2`; and what is behind it.
fn number(text: &str) -> Option<(f64, &str)> {
    let decimal = |t: &str| -> Option<(f64, usize)> {
        let length = t.bytes().take_while(|b| b.is_ascii_digit() || *b == b'.').count();
        Some((t[..length].parse().ok()?, length))
    };
    let (sign, body) = match text.strip_prefix('-') {
        Some(body) => (-1.0, body),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    let (first, length) = decimal(body)?;
    let rest = &body[length..];
    let fraction = |over: f64, rest: &str| -> Option<(f64, usize)> {
        let under = rest.strip_prefix('/')?;
        let (under, length) = decimal(under)?;
        (under > 0.0).then_some((over / under, 1 + length))
    };
    if let Some((value, length)) = fraction(first, rest) {
        return Some((sign * value, &rest[length..]));
    }
    if let Some((over, length)) = rest.strip_prefix('-').and_then(decimal)
        && let Some((value, behind)) = fraction(over, &rest[1 + length..])
    {
        return Some((sign * (first + value), &rest[1 + length + behind..]));
    }
    Some((sign * first, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_decimal_or_fractions() {
        assert_eq!(number("6. FLAT"), Some((6.0, " FLAT")));
        assert_eq!(number(".375 DRILL"), Some((0.375, " DRILL")));
        assert_eq!(number("3/8IN"), Some((0.375, "IN")));
        assert_eq!(number("1-1/2 X"), Some((1.5, " X")));
        assert_eq!(number("-12.7,"), Some((-12.7, ",")));
        assert_eq!(number("FLAT"), None);
    }

    #[test]
    fn the_unit_is_the_first_that_is_said() {
        assert!(in_inches("(G21)\nN1 G20 G17\nG21") && !in_inches("G0 X20\nG21\nG20"));
        assert!(!in_inches("") && in_inches("0 BEGIN PGM A INCH\n"));
    }
}
