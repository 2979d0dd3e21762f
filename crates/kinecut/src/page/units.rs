//! Numbers as the shop reads them.

/// A time [s]: `1 h 02 min 03 s`, `4 min 12 s`, `42 s`, `8.4 s`; "unknown" when it is not a number.
///
/// ```
/// use kinecut::page::duration;
/// assert_eq!(duration(3723.2), "1 h 02 min 03 s");
/// assert_eq!(duration(251.6), "4 min 12 s");
/// assert_eq!(duration(8.44), "8.4 s");
/// ```
pub fn duration(seconds: f64) -> String {
    // Above this the number is not a machining time and a u64 of it would mislead.
    const LONGEST: f64 = 1e12;
    if !seconds.is_finite() || seconds.abs() > LONGEST {
        return "unknown".to_owned();
    }
    let sign = if seconds < 0.0 { "-" } else { "" };
    let s = seconds.abs();
    if s < 9.95 {
        return format!("{sign}{s:.1} s");
    }
    let whole = s.round() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, s) => format!("{sign}{s} s"),
        (0, m, s) => format!("{sign}{m} min {s:02} s"),
        (h, m, s) => format!("{sign}{h} h {m:02} min {s:02} s"),
    }
}

/// A number with fixed decimals; never "-0.000"; "–" when it is not finite.
///
/// ```
/// assert_eq!(kinecut::page::fixed(-0.00004, 3), "0.000");
/// ```
pub fn fixed(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| b == b'0' || b == b'.') => rest.to_owned(),
        _ => text,
    }
}

/// A length of path [mm]: in mm below 10 m, then in m.
///
/// ```
/// use kinecut::page::length;
/// assert_eq!((length(123.456).as_str(), length(31_415.9).as_str()), ("123.5 mm", "31.42 m"));
/// ```
pub fn length(mm: f64) -> String {
    if mm.abs() < 10_000.0 { format!("{} mm", fixed(mm, 1)) } else { format!("{} m", fixed(mm / 1000.0, 2)) }
}

/// A deviation [mm] in micrometres with its sign, one decimal below 100: `+4.2 µm`.
///
/// ```
/// assert_eq!(kinecut::page::micrometres(-0.0123), "-12.3 µm");
/// ```
pub fn micrometres(mm: f64) -> String {
    let um = mm * 1000.0;
    let text = fixed(um, if um.abs() < 100.0 { 1 } else { 0 });
    let sign = if um > 0.0 && text.bytes().any(|b| (b'1'..=b'9').contains(&b)) { "+" } else { "" };
    format!("{sign}{text} µm")
}

/// A share as a percentage that never shows something as nothing: `12.3 %`, `< 0.1 %`, `0 %`.
///
/// ```
/// use kinecut::page::area_share;
/// assert_eq!((area_share(0.1234).as_str(), area_share(1e-6).as_str()), ("12.3 %", "< 0.1 %"));
/// ```
pub fn area_share(share: f64) -> String {
    match share {
        0.0 => "0 %".to_owned(),
        s if s < 0.001 => "< 0.1 %".to_owned(),
        s if s > 0.999 && s < 1.0 => "> 99.9 %".to_owned(),
        s => format!("{} %", fixed(s * 100.0, 1)),
    }
}

/// A number with as many decimals at most, without zeros at its end.
pub(crate) fn trimmed(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A name as a heading: with a capital.
pub(crate) fn heading(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A coordinate of a drawing.
pub(crate) fn px(v: f64) -> String {
    trimmed(v, 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_carry_over_at_each_border() {
        let shown = [0.0, 9.94, 9.96, 59.4, 59.6, 3599.6, 86_400.0, -75.0].map(duration);
        assert_eq!(
            shown,
            [
                "0.0 s",
                "9.9 s",
                "10 s",
                "59 s",
                "1 min 00 s",
                "1 h 00 min 00 s",
                "24 h 00 min 00 s",
                "-1 min 15 s"
            ]
        );
        assert_eq!(duration(f64::NAN), "unknown");
    }

    #[test]
    fn zero_has_no_sign() {
        assert_eq!(micrometres(1e-9), "0.0 µm");
        assert_eq!(micrometres(-1e-9), "0.0 µm");
        assert_eq!(micrometres(0.25), "+250 µm");
        assert_eq!(area_share(0.9999), "> 99.9 %");
    }
}
