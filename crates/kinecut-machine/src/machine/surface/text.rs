//! Chains as text: `6(phi) 1(R) 5(-alpha) 3(z)`, motions with their laws in brackets.

use super::ChainElement;
use crate::base::{Code, Finding, Result};
use crate::machine::Elementary;
use crate::machine::formula::Expression;

/// Reads a chain: each motion is a digit from 1 to 9, or a letter X Y Z A B C, followed by its law in brackets. An
/// empty text, and `-`, is the empty chain.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::surface::{chain_text, parse_chain};
/// let cone = parse_chain("6(phi) 1(R) B(-alpha) 3( z )").unwrap();
/// assert_eq!(chain_text(&cone), "6(phi) 1(R) 5(-alpha) 3(z)");
/// assert!(parse_chain("6(phi) 1").is_err()); // no law
/// ```
///
/// # Errors
/// `KC1106` for a character that is no motion, a motion without a law, a bracket that does not close: the message gives
/// the column. `KC1101` for a law that is no formula.
pub fn parse_chain(text: &str) -> Result<Vec<ChainElement>> {
    let characters: Vec<char> = text.chars().collect();
    if text.trim() == "-" {
        return Ok(Vec::new());
    }
    let mut chain = Vec::new();
    let mut at = 0;
    while let Some(found) = next(&characters, at, |c| !c.is_whitespace() && c != ',') {
        let motion = motion_of(characters[found]).ok_or_else(|| {
            let what = format!("has `{}`, which is no motion", characters[found]);
            fault(
                text,
                found,
                &what,
                "write digits from 1 to 9, each with its law in brackets: \"6(phi) 1(R)\"",
            )
        })?;
        let open = next(&characters, found + 1, |c| !c.is_whitespace()).filter(|&i| characters[i] == '(');
        let open = open.ok_or_else(|| {
            let what = format!("has motion `{}` without a law", characters[found]);
            let help = format!("write its value in brackets: \"{}(10)\" or \"{0}(t)\"", characters[found]);
            fault(text, found, &what, &help)
        })?;
        let close = closing(&characters, open)
            .ok_or_else(|| fault(text, open, "has a bracket that does not close", "close it with `)`"))?;
        let law: String = characters[open + 1..close].iter().collect();
        if law.trim().is_empty() {
            return Err(fault(
                text,
                open,
                "has an empty law",
                "write a number, a name or a formula in the brackets",
            ));
        }
        let law = Expression::parse(&law).map_err(|mut error| {
            error.0.message = format!("in the law that begins at column {}: {}", open + 2, error.0.message);
            error
        })?;
        chain.push(ChainElement::new(motion, law));
        at = close + 1;
    }
    Ok(chain)
}

/// The motion of a digit from 1 to 9 or of a letter of an axis.
pub(super) fn motion_of(character: char) -> Option<Elementary> {
    let digit = character.to_digit(10).and_then(|d| Elementary::from_digit(d as u8));
    let letter = || {
        let upper = character.to_ascii_uppercase();
        Elementary::STANDARD.into_iter().find(|m| m.letter() == Some(upper))
    };
    digit.or_else(letter)
}

fn next(characters: &[char], from: usize, wanted: impl Fn(char) -> bool) -> Option<usize> {
    (from..characters.len()).find(|&i| wanted(characters[i]))
}

fn closing(characters: &[char], open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (i, c) in characters.iter().enumerate().skip(open) {
        match c {
            '(' => depth += 1,
            ')' if depth == 1 => return Some(i),
            ')' => depth -= 1,
            _ => {}
        }
    }
    None
}

fn fault(text: &str, at: usize, what: &str, help: &str) -> crate::base::Error {
    let message = format!("the chain \"{text}\" {what} at column {}", at + 1);
    Finding::error(Code::SURFACE_TEXT, message).help(help).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        parse_chain(text).map(|_| String::new()).unwrap_or_else(|e| e.to_string())
    }

    #[test]
    fn faults_are_told_with_their_column() {
        assert!(
            message("6(phi) 1(R) q(z)").contains("`q`, which is no motion at column 13"),
            "{}",
            message("6(phi) 1(R) q(z)")
        );
        assert!(message("6(phi) 0(z)").contains("column 8"));
        assert!(message("6(phi) 1 3(z)").contains("motion `1` without a law at column 8"));
        assert!(message("6(phi").contains("does not close at column 2"));
        assert!(message("6(phi) 1( )").contains("empty law at column 9"));
        assert!(message("6(phi) 1(R+*2)").contains("begins at column 10"), "{}", message("6(phi) 1(R+*2)"));
    }

    #[test]
    fn brackets_nest_and_blanks_and_commas_part() {
        let chain = parse_chain(" 6 (phi),1(R*(1+cos(phi)))3(z)").unwrap();
        assert_eq!(super::super::word(&chain).to_string(), "613");
        assert_eq!(parse_chain("").unwrap(), vec![]);
        assert_eq!(parse_chain(" - ").unwrap(), vec![]);
    }
}
