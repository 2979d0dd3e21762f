//! Numbers of the tools that the text of a program calls, as far as that can be seen without running it.

use std::collections::BTreeSet;

/// All numbers that could be those of its tools, comments among them; `None` where a tool is called by a value or a name.
pub(super) fn called_numbers(text: &str) -> Option<BTreeSet<u32>> {
    let text = text.to_ascii_uppercase();
    let bytes = text.as_bytes();
    let mut numbers = BTreeSet::new();
    for (at, word) in text.match_indices("TOOL CALL").chain(text.match_indices('T')) {
        // A word may follow the number of the one before it: `M6T5`.
        let begins = at == 0 || !(bytes[at - 1].is_ascii_alphabetic() || bytes[at - 1] == b'_');
        if !begins {
            continue;
        }
        let rest = text[at + word.len()..].trim_start_matches(' ');
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        match rest[..digits].parse::<u32>() {
            Ok(number) => {
                numbers.insert(number);
                // Two digits behind the number are that of its offset on some controls.
                numbers.insert(number / 100);
            }
            Err(_) if word == "T" && !rest.starts_with(['#', '=', '[', '<', '"']) => {}
            // A line end is a TOOL CALL of the tool that is in the spindle.
            Err(_) if rest.is_empty() || rest.starts_with(['\r', '\n']) => {}
            // `TOOL CALL Z S2000` is one of the same tool, too.
            Err(_) if word != "T" && rest.starts_with(['X', 'Y', 'Z', 'S']) => {}
            Err(_) => return None,
        }
    }
    Some(numbers)
}

/// A text without its comments: in round brackets, or from a semicolon to the end of the line.
pub(super) fn without_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let mut rest = line.trim_end_matches(['\r', '\n']);
        while let Some(at) = rest.find(['(', ';']) {
            out.push_str(&rest[..at]);
            // A word ends at a comment.
            out.push(' ');
            let close = rest[at..].find(')').filter(|_| rest.as_bytes()[at] == b'(');
            rest = close.map_or("", |close| &rest[at + close + 1..]);
        }
        out.push_str(rest);
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_words_and_calls() {
        let of = |text: &str| called_numbers(text).map(|all| all.into_iter().collect::<Vec<_>>());
        assert_eq!(of("N1 T5 M6\nG1 X1\nT 12\n"), Some(vec![0, 5, 12]));
        assert_eq!(of("T0101"), Some(vec![1, 101]));
        for text in ["M6T5", "N10T5M6", "G43H1T5", "N10 G0X1.T5"] {
            assert_eq!(of(text), Some(vec![0, 5]), "{text}");
        }
        assert_eq!(of("N10T#1M6"), None);
        assert_eq!(of("#_TOOL_T5 = 1 OUT6\n"), Some(vec![]));
        assert_eq!(of("1 TOOL CALL 7 Z S2000\n2 TOOL CALL Z S900\n3 TOOL CALL\n"), Some(vec![0, 7]));
        assert_eq!(of("G0 X1 (ROUT ALL)\nSTOP\n"), Some(vec![]));
        let certain = |text: &str| of(&without_comments(text));
        assert_eq!(certain("N1 T5 (T6) M6 (T7\n(T8) T12;T9\n; T10\nT11"), Some(vec![0, 5, 11, 12]));
        assert_eq!(certain("(T#1)\r\n(a) (b)\r\n"), Some(vec![]));
        assert_eq!(of("(T#1)"), None);
        assert_eq!(certain("1 TOOL CALL ; the same\n2 TOOL CALL 5 Z ; T6"), Some(vec![0, 5]));
        for text in ["T#500 M6", "T=\"MILL\"", "T[1+#2]", "1 TOOL CALL Q5 Z", "1 TOOL CALL \"D10\" Z"] {
            assert_eq!(of(text), None, "{text}");
        }
    }
}
