//! Sizes of holes: a diameter, a fit, a thread.

use crate::base::bounded::{MAX_LENGTH, positive};
use crate::base::{Code, Finding, Result};
use crate::job::file::HoleSize;
use crate::threading::ThreadSize;

/// A size as its maker reads it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Size {
    /// Drilled to a diameter [mm].
    Plain(f64),
    /// Reamed to a diameter [mm], with the name of its fit.
    Fit(f64, String),
    /// Threaded.
    Thread(ThreadSize),
}

impl Size {
    /// Of a size as it is written, a text in a unit [mm].
    ///
    /// # Errors
    /// `KC0103` for a text that is no size, with the key `size`.
    pub(super) fn of(written: &HoleSize, unit: f64) -> Result<Size> {
        let text = match written {
            HoleSize::Diameter(diameter) => {
                return Ok(Size::Plain(positive("size", *diameter, MAX_LENGTH, "mm")?));
            }
            HoleSize::Text(text) => text.trim(),
        };
        if text.starts_with(['M', 'm']) {
            return ThreadSize::parse(text).map(Size::Thread).map_err(|e| e.under("size"));
        }
        let end = text.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(text.len());
        let (number, fit) = text.split_at(end);
        let diameter =
            number.parse::<f64>().ok().map(|d| positive("size", d * unit, MAX_LENGTH, "mm")).transpose()?;
        match (diameter, fit.trim()) {
            (Some(diameter), "") => Ok(Size::Plain(diameter)),
            (Some(diameter), fit) if is_fit(fit) => Ok(Size::Fit(diameter, fit.to_owned())),
            _ => {
                let shown: String = text.chars().take(20).collect();
                let what = format!("`{}` is no size of a hole", shown.escape_default());
                let help = "write a diameter: 6.6, a fit: \"8H7\", or a metric thread: \"M8\", \"M8x1\"";
                Err(Finding::error(Code::JOB_VALUE, what).help(help).key("size").into())
            }
        }
    }

    /// Diameter of the finished hole, of a thread the major one [mm].
    pub(super) fn diameter(&self) -> f64 {
        match self {
            Size::Plain(diameter) | Size::Fit(diameter, _) => *diameter,
            Size::Thread(thread) => thread.diameter,
        }
    }

    /// It as a person writes it.
    pub(super) fn word(&self) -> String {
        match self {
            Size::Plain(diameter) => format!("a hole of {diameter}"),
            Size::Fit(diameter, fit) => format!("{diameter}{fit}"),
            Size::Thread(t) => format!("M{}x{}", t.diameter, t.pitch),
        }
    }

    /// Least, usual and largest diameter of the drill [mm].
    ///
    /// Source: of reamers the allowances usual in workshops, 0.1 to 0.2 up to 10 mm, 0.2 to 0.3 up to 20, 0.3 to 0.5 above;
    /// of threads ISO 2306, diameter less pitch, as drills in stock round it: 6.8 for 6.75, 10.2 for 10.25.
    pub(super) fn drill(&self) -> [f64; 3] {
        match self {
            Size::Plain(d) => [d - SAME, *d, d + SAME],
            Size::Fit(d, _) => {
                let [most, least] = match *d {
                    d if d <= 10.0 => [0.2, 0.1],
                    d if d <= 20.0 => [0.3, 0.2],
                    _ => [0.5, 0.3],
                };
                [d - most - SAME, d - 0.5 * (most + least), d - least + SAME]
            }
            Size::Thread(t) => {
                let core = t.diameter - t.pitch;
                [core - ROUNDED - SAME, core, core + ROUNDED + SAME]
            }
        }
    }
}

/// Difference of a tool's diameter from the wanted one that is nothing [mm].
pub(super) const SAME: f64 = 0.005 + 1e-9;

/// Rounding of the drills for core holes [mm].
const ROUNDED: f64 = 0.05;

/// Whether a text is a fit of a hole (ISO 286): `H7`, `JS6`.
fn is_fit(text: &str) -> bool {
    let letters = text.chars().take_while(char::is_ascii_uppercase).count();
    let grade = &text[letters..];
    (1..=2).contains(&letters)
        && grade.parse::<u32>().is_ok_and(|g| (1..=18).contains(&g))
        && !grade.starts_with('+')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Size> {
        Size::of(&HoleSize::Text(text.to_owned()), 1.0)
    }

    #[test]
    fn sizes_are_diameters_fits_and_threads() {
        assert_eq!(of("6.6").unwrap(), Size::Plain(6.6));
        assert_eq!(Size::of(&HoleSize::Diameter(6.6), 25.4).unwrap(), Size::Plain(6.6));
        assert_eq!(
            Size::of(&HoleSize::Text("0.5H7".to_owned()), 25.4).unwrap(),
            Size::Fit(12.7, "H7".to_owned())
        );
        assert_eq!(of(" 8H7 ").unwrap(), Size::Fit(8.0, "H7".to_owned()));
        assert_eq!(of("12.5 JS6").unwrap(), Size::Fit(12.5, "JS6".to_owned()));
        assert_eq!(of("M8").unwrap(), Size::Thread(ThreadSize { diameter: 8.0, pitch: 1.25 }));
        for text in [
            "", "8h7", "8H", "8H19", "8H+7", "8HH7x", "eight", "-8", "0", "8.5.1", "H7", "8 mm", "NaN", "M21",
        ] {
            let error = *of(text).unwrap_err().0;
            assert_eq!(error.key.as_deref(), Some("size"), "{text}: {error:?}");
        }
    }

    #[test]
    fn the_drill_before_leaves_what_reamers_and_taps_want() {
        for (text, low, high) in [
            ("6H7", 5.8, 5.9),
            ("10H7", 9.8, 9.9),
            ("12H7", 11.7, 11.8),
            ("25H7", 24.5, 24.7),
            ("M8", 6.7, 6.8),
            ("M12", 10.2, 10.3),
            ("7", 7.0, 7.0),
        ] {
            let [least, usual, most] = of(text).unwrap().drill();
            assert!(least < low && low - least < 0.0051 && most > high && most - high < 0.0051, "{text}");
            assert!(least < usual && usual < most, "{text}");
        }
    }
}
