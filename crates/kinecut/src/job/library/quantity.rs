//! Numbers with units as texts: `6.0000 mm`, `0,25 in`, `1/4 "`, `118 °`.

/// A number, and what its unit is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Quantity {
    /// A length [mm].
    Length(f64),
    /// An angle (degrees).
    Angle(f64),
    /// A number without a unit.
    Bare(f64),
}

/// Reads a text; `None` for what is no number with one of the units.
pub(super) fn quantity(text: &str) -> Option<Quantity> {
    let text = text.trim();
    let end = text.find(|c: char| !(c.is_ascii_digit() || "+-.,/eE".contains(c))).unwrap_or(text.len());
    // `5e` is a number and the beginning of a word, `5e3` a number.
    let number = text[..end].trim_end_matches(['e', 'E']);
    let value = match number.split_once('/') {
        Some((over, under)) => decimal(over)? / decimal(under)?,
        None => decimal(number)?,
    };
    if !value.is_finite() {
        return None;
    }
    match text[number.len()..].trim().to_lowercase().as_str() {
        "" => Some(Quantity::Bare(value)),
        "mm" => Some(Quantity::Length(value)),
        "cm" => Some(Quantity::Length(10.0 * value)),
        "m" => Some(Quantity::Length(1000.0 * value)),
        "in" | "inch" | "\"" | "''" => Some(Quantity::Length(25.4 * value)),
        "°" | "deg" => Some(Quantity::Angle(value)),
        "rad" => Some(Quantity::Angle(value.to_degrees())),
        _ => None,
    }
}

/// A number with a point or a comma before its decimals.
fn decimal(text: &str) -> Option<f64> {
    let points = text.matches(['.', ',']).count();
    if points > 1 {
        return None;
    }
    text.replace(',', ".").parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_commas_and_fractions_are_read() {
        use Quantity::{Angle, Bare, Length};
        for (text, wanted) in [
            ("6.0000 mm", Length(6.0)),
            ("5,0 mm", Length(5.0)),
            ("0.25 in", Length(6.35)),
            ("0,25 in", Length(6.35)),
            ("1/4 \"", Length(6.35)),
            (".5\"", Length(12.7)),
            ("2 cm", Length(20.0)),
            ("118.0 °", Angle(118.0)),
            ("20,0 deg", Angle(20.0)),
            (" 3 ", Bare(3.0)),
            ("1e1 mm", Length(10.0)),
        ] {
            assert_eq!(quantity(text), Some(wanted), "{text}");
        }
        for text in
            ["", "mm", "six mm", "1.2.3 mm", "1,000.5 mm", "5 furlong", "1/0 mm", "1e999 mm", "--5 mm"]
        {
            assert_eq!(quantity(text), None, "{text}");
        }
    }
}
