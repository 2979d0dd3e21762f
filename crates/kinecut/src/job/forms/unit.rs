//! The unit of a number, from the words about its key; and numbers with a unit in texts.

use super::{Form, Kind};

/// Units that the words about a key name, the longer of two that begin alike first.
const NAMED: &[&str] = &[
    "mm/min, of rotary axes rev/min",
    "m/s2, of rotary axes degrees/s2",
    "m/s3, of rotary axes degrees/s3",
    "mm, rotary axes degrees",
    "mm, or degrees",
    "degrees/min",
    "mm or rad",
    "degrees and mm",
    "mm and degrees",
    "rev/min and N m",
    "rev/min",
    "mm/min",
    "mm/rev",
    "m/min",
    "m/s2",
    "m/s3",
    "degrees",
    "seconds",
    "pitches",
    "N m",
    "kW",
    "MB",
    "Hz",
    "mm",
    "s",
];
/// Words with which the description of numbers without unit begins.
const PURE: &[&str] = &["direction", "share", "weight", "radial passes as shares", "-1 when"];

/// Ways of writing a unit, each with its name here; compared without case.
const SPELLED: &[(&str, &str)] = &[
    ("rpm", "rev/min"),
    ("r/min", "rev/min"),
    ("u/min", "rev/min"),
    ("1/min", "rev/min"),
    ("min-1", "rev/min"),
    ("min^-1", "rev/min"),
    ("rev/min", "rev/min"),
    ("mm/min", "mm/min"),
    ("mm/u", "mm/rev"),
    ("mm/r", "mm/rev"),
    ("mm/rev", "mm/rev"),
    ("mm/tooth", "mm"),
    ("mm", "mm"),
    ("m/min", "m/min"),
    ("m/s2", "m/s2"),
    ("m/s^2", "m/s2"),
    ("m/s3", "m/s3"),
    ("m/s^3", "m/s3"),
    ("deg", "degrees"),
    ("degree", "degrees"),
    ("degrees", "degrees"),
    ("°", "degrees"),
    ("rad", "radians"),
    ("s", "seconds"),
    ("sec", "seconds"),
    ("second", "seconds"),
    ("seconds", "seconds"),
    ("min", "minutes"),
    ("ms", "milliseconds"),
    ("hz", "Hz"),
    ("kw", "kW"),
    ("w", "W"),
    ("nm", "N m"),
    ("n m", "N m"),
    ("mb", "MB"),
    ("in", "inches"),
    ("inch", "inches"),
    ("inches", "inches"),
    ("\"", "inches"),
    ("in/min", "inches/min"),
    ("ipm", "inches/min"),
    ("sfm", "feet/min"),
    ("ft/min", "feet/min"),
    ("cm", "cm"),
    ("m", "m"),
    ("um", "um"),
    ("µm", "um"),
    ("%", "percent"),
];

/// The unit of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::job) enum Unit<'a> {
    /// One of these words.
    Of(&'a str),
    /// A number without unit.
    Pure,
    /// A count.
    Count,
}

impl<'a> Form<'a> {
    /// The unit of the numbers of a form; `None` where it has no numbers.
    pub(in crate::job) fn unit(self) -> Option<Unit<'a>> {
        match self.kind() {
            Kind::Whole => Some(Unit::Count),
            Kind::Number => Some(unit(self.about)),
            Kind::List => self.item().unit(),
            _ => None,
        }
    }
}

/// The unit that the words about a key name: the first one behind a comma, a colon, a semicolon, a bracket or a default;
/// lengths in mm need no word.
fn unit(about: &str) -> Unit<'_> {
    let line = about.split("\n\n").next().unwrap_or_default();
    let first = line.split(['.', ';']).next().unwrap_or_default();
    let begins = |at: usize| {
        let before = line[..at].trim_end();
        let behind_number = before.rsplit(' ').next().is_some_and(|word| word.parse::<f64>().is_ok());
        let default =
            before.rsplit_once(' ').is_some_and(|(rest, _)| rest.to_ascii_lowercase().ends_with("default"));
        before.ends_with([',', ';', ':', '(', '[']) || behind_number && default
    };
    let ends = |at: usize| !line[at..].starts_with(|c: char| c.is_alphanumeric() || c == '/');
    let places = NAMED.iter().enumerate().flat_map(|(rank, name)| {
        let all = line.match_indices(name).map(|(at, _)| at);
        all.filter(|at| begins(*at) && ends(at + name.len())).map(move |at| (at, rank)).collect::<Vec<_>>()
    });
    if let Some((_, rank)) = places.min() {
        return Unit::Of(if NAMED[rank] == "s" { "seconds" } else { NAMED[rank] });
    }
    let lower = first.to_ascii_lowercase();
    if lower.contains("no unit") || PURE.iter().any(|words| lower.starts_with(words)) {
        return Unit::Pure;
    }
    Unit::Of("mm")
}

/// The number at the beginning of a text, with a point or a comma, and the name of the unit behind it: empty without one, `None`
/// for words that are no unit.
pub(in crate::job) fn number_with_unit(text: &str) -> Option<(f64, Option<&'static str>)> {
    let text = text.trim();
    let is_part = |c: char| c.is_ascii_digit() || ['+', '-', '.', ','].contains(&c);
    let end = text.find(|c: char| !is_part(c)).unwrap_or(text.len());
    let number = text[..end].parse().ok().or_else(|| {
        let (whole, part) = text[..end].split_once(',')?;
        // Three digits behind a comma may be thousands.
        (part.len() != 3).then(|| format!("{whole}.{part}").parse().ok())?
    })?;
    let rest: String = text[end..].to_lowercase().split_whitespace().collect();
    if rest.is_empty() {
        return Some((number, Some("")));
    }
    let unit = SPELLED.iter().find(|(spelled, _)| *spelled == rest).map(|(_, unit)| *unit);
    Some((number, unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_is_that_of_the_words() {
        let of = |about: &'static str| match unit(about) {
            Unit::Of(name) => name,
            _ => "",
        };
        for (about, unit) in [
            ("Diameter.", "mm"),
            ("Spindle speed, rev/min; or give `cutting_speed`.", "rev/min"),
            ("Feed; mm/min in a file.", "mm/min"),
            ("Point angle; default 118 degrees.", "degrees"),
            ("Wait at the bottom, seconds; default 0.", "seconds"),
            ("Time of a tool change, chip to chip, s; 0 to 600.", "seconds"),
            ("Rapid speed: mm/min, of rotary axes rev/min.", "mm/min, of rotary axes rev/min"),
            ("Corner radius of a bull-nose end mill, or with an entering angle of 90 degrees.", "mm"),
            ("Largest distance, seen from above.", "mm"),
            ("Direction of its X; default [1, 0, 0].", ""),
            ("Direction of the rows from X, degrees; default 0.", "degrees"),
            ("Radial passes as shares of the thread's depth.", ""),
            ("The zero of a setup, in any direction; default 0.", "mm"),
            ("Parameters of the laws [mm or rad]: numbers.", "mm or rad"),
            ("Travel of the axes by their letters: mm, rotary axes degrees. `X`", "mm, rotary axes degrees"),
        ] {
            assert_eq!(of(about), unit, "{about}");
        }
    }

    #[test]
    fn numbers_in_texts_have_their_unit() {
        for (text, number) in [
            ("4000 rpm", Some((4000.0, Some("rev/min")))),
            ("120m/min", Some((120.0, Some("m/min")))),
            (" 6,6 ", Some((6.6, Some("")))),
            ("-5 °", Some((-5.0, Some("degrees")))),
            ("3 apples", Some((3.0, None))),
            ("1,000.5 mm", None),
            ("4,000 rpm", None),
            ("M8", None),
            ("", None),
        ] {
            assert_eq!(number_with_unit(text), number, "{text}");
        }
    }
}
