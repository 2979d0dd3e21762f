//! The height at which a tool travels in a program that is planned without a stock: nobody knows it, so no number is written.

/// Stand-in for the height while the program is planned [mm]: above any block.
pub(super) const UNKNOWN: f64 = 10_000.0;

/// Text in its place: no control reads it, so that it has to be filled in.
const TO_FILL_IN: &str = "<SAFE HEIGHT>";

/// A program with the unknown height made a place to fill in.
pub(super) fn to_fill_in(text: &str) -> String {
    let digits = format!("{UNKNOWN}");
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(&digits) {
        let (before, found) = rest.split_at(at);
        let after = &found[digits.len()..];
        // The point, and the noughts of a fixed number of decimals.
        let decimals =
            after.strip_prefix('.').map_or(0, |d| 1 + d.bytes().take_while(|b| *b == b'0').count());
        let is_whole = !before.ends_with(|c: char| c.is_ascii_digit() || matches!(c, '.' | '-'))
            && !after[decimals..].starts_with(|c: char| c.is_ascii_digit());
        if is_whole {
            out.push_str(before.strip_suffix('+').unwrap_or(before));
            out.push_str(TO_FILL_IN);
            rest = &after[decimals..];
        } else {
            out.push_str(before);
            out.push_str(&digits);
            rest = after;
        }
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::to_fill_in;

    #[test]
    fn only_the_unknown_height_is_left_to_fill_in() {
        let text = "N10 G0 Z10000\nG0 Z10000.\nL Z+10000 FMAX\nCYCLE81(10000.000,0)\n";
        let wanted =
            "N10 G0 Z<SAFE HEIGHT>\nG0 Z<SAFE HEIGHT>\nL Z<SAFE HEIGHT> FMAX\nCYCLE81(<SAFE HEIGHT>,0)\n";
        assert_eq!(to_fill_in(text), wanted);
        let other = "S10000.5\nX110000 Y-10000 Z0.10000\n";
        assert_eq!(to_fill_in(other), other);
    }
}
