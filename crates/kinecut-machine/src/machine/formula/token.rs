//! The words of a formula: numbers, names and signs with their places.

/// A word of a formula.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Number(f64),
    Name(String),
    Sign(char),
    /// A character that no formula has, or a number that is too large.
    Wrong(String),
    End,
}

impl Token {
    /// As named in a message.
    pub(super) fn said(&self) -> String {
        match self {
            Token::Number(value) => format!("the number {value}"),
            Token::Name(name) => format!("`{name}`"),
            Token::Sign(sign) => format!("`{sign}`"),
            Token::Wrong(text) => format!("`{text}`"),
            Token::End => "the end".to_owned(),
        }
    }
}

/// The words of a text, each with its column (1-based, in characters); the last is the end. `**` is read as `^`.
pub(super) fn tokens(text: &str) -> Vec<(Token, usize)> {
    let chars: Vec<char> = text.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or(' ');
    let mut found = Vec::new();
    let mut i = 0;
    while i < chars.len() {
        let start = i;
        let c = chars[i];
        let token = if c.is_whitespace() {
            i += 1;
            continue;
        } else if c.is_ascii_alphabetic() || c == '_' {
            while at(i).is_ascii_alphanumeric() || at(i) == '_' {
                i += 1;
            }
            Token::Name(chars[start..i].iter().collect())
        } else if c.is_ascii_digit() || (c == '.' && at(i + 1).is_ascii_digit()) {
            i = end_of_number(&chars, i);
            let written: String = chars[start..i].iter().collect();
            match written.parse::<f64>() {
                Ok(value) if value.is_finite() => Token::Number(value),
                _ => Token::Wrong(written),
            }
        } else if c == '*' && at(i + 1) == '*' {
            i += 2;
            Token::Sign('^')
        } else {
            i += 1;
            if "+-*/^(),".contains(c) { Token::Sign(c) } else { Token::Wrong(c.to_string()) }
        };
        found.push((token, start + 1));
    }
    found.push((Token::End, chars.len() + 1));
    found
}

/// One past the last character of the number that begins at `i`. An `e` belongs to it only before digits.
fn end_of_number(chars: &[char], mut i: usize) -> usize {
    let at = |i: usize| chars.get(i).copied().unwrap_or(' ');
    while at(i).is_ascii_digit() {
        i += 1;
    }
    if at(i) == '.' {
        i += 1;
        while at(i).is_ascii_digit() {
            i += 1;
        }
    }
    let sign = usize::from(matches!(at(i + 1), '+' | '-'));
    if matches!(at(i), 'e' | 'E') && at(i + 1 + sign).is_ascii_digit() {
        i += 1 + sign;
        while at(i).is_ascii_digit() {
            i += 1;
        }
    }
    i
}
