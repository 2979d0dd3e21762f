//! Sizes of ISO metric threads as they are written: "M8", "M20x1.5".

use crate::base::{Code, Finding, Result};

/// Coarse pitches of ISO 261, by diameter [mm].
const COARSE: [(f64, f64); 40] = [
    (1.0, 0.25),
    (1.1, 0.25),
    (1.2, 0.25),
    (1.4, 0.3),
    (1.6, 0.35),
    (1.8, 0.35),
    (2.0, 0.4),
    (2.2, 0.45),
    (2.5, 0.45),
    (3.0, 0.5),
    (3.5, 0.6),
    (4.0, 0.7),
    (4.5, 0.75),
    (5.0, 0.8),
    (6.0, 1.0),
    (7.0, 1.0),
    (8.0, 1.25),
    (9.0, 1.25),
    (10.0, 1.5),
    (11.0, 1.5),
    (12.0, 1.75),
    (14.0, 2.0),
    (16.0, 2.0),
    (18.0, 2.5),
    (20.0, 2.5),
    (22.0, 2.5),
    (24.0, 3.0),
    (27.0, 3.0),
    (30.0, 3.5),
    (33.0, 3.5),
    (36.0, 4.0),
    (39.0, 4.0),
    (42.0, 4.5),
    (45.0, 4.5),
    (48.0, 5.0),
    (52.0, 5.0),
    (56.0, 5.5),
    (60.0, 5.5),
    (64.0, 6.0),
    (68.0, 6.0),
];

/// Difference of two sizes that is rounding [mm].
const SAME: f64 = 1e-9;

/// Diameter and pitch of a metric thread [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThreadSize {
    /// Nominal diameter.
    pub diameter: f64,
    /// Pitch.
    pub pitch: f64,
}

/// The coarse pitch of a diameter in ISO 261 [mm], if it is there.
///
/// ```
/// # use kinecut_plan as kinecut;
/// use kinecut::threading::coarse_pitch;
/// assert_eq!((coarse_pitch(20.0), coarse_pitch(21.0)), (Some(2.5), None));
/// ```
pub fn coarse_pitch(diameter: f64) -> Option<f64> {
    COARSE.iter().find(|(d, _)| (d - diameter).abs() <= SAME).map(|(_, pitch)| *pitch)
}

impl ThreadSize {
    /// A size as it is written: "M8" with the coarse pitch of ISO 261, "M20x1.5".
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::threading::ThreadSize;
    /// assert_eq!(ThreadSize::parse("M8").unwrap(), ThreadSize { diameter: 8.0, pitch: 1.25 });
    /// assert_eq!(ThreadSize::parse("M20 x 1.5").unwrap().pitch, 1.5);
    /// assert!(ThreadSize::parse("M21").is_err());
    /// ```
    ///
    /// # Errors
    /// `KC0404` for a text that is no size, and for a diameter without a coarse pitch.
    pub fn parse(text: &str) -> Result<ThreadSize> {
        let no_size = || {
            let shown: String = text.chars().take(20).collect();
            Finding::error(
                Code::PLAN_VALUE,
                format!("`{}` is no size of a metric thread", shown.escape_default()),
            )
            .help("write \"M8\" or \"M20x1.5\"; other threads by diameter and pitch, a left hand by hand = \"left\"")
        };
        let number = |t: &str| t.trim().parse::<f64>().ok().filter(|v| v.is_finite() && *v > 0.0);
        let rest = text.trim().strip_prefix(['M', 'm']).ok_or_else(no_size)?;
        let (diameter, pitch) = match rest.split_once(['x', 'X', '\u{d7}']) {
            Some((diameter, pitch)) => (number(diameter), Some(number(pitch).ok_or_else(no_size)?)),
            None => (number(rest), None),
        };
        let diameter = diameter.ok_or_else(no_size)?;
        let pitch = pitch.or_else(|| coarse_pitch(diameter)).ok_or_else(|| {
            Finding::error(Code::PLAN_VALUE, format!("M{diameter} has no coarse pitch in ISO 261"))
                .help(format!("write its pitch: \"M{diameter}x1.5\""))
        })?;
        Ok(ThreadSize { diameter, pitch })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_ascends_and_texts_that_are_no_sizes_are_refused() {
        assert!(COARSE.windows(2).all(|w| w[0].0 < w[1].0 && w[0].1 <= w[1].1));
        for (diameter, pitch) in COARSE {
            assert_eq!(ThreadSize::parse(&format!("M{diameter}")).unwrap(), ThreadSize { diameter, pitch });
        }
        for text in ["", "M", "8", "M8x", "Mx1", "M-8", "M8x-1", "M8x0", "MNaN", "Minf", "M8x1LH", "W1/4"] {
            let error = ThreadSize::parse(text).unwrap_err();
            assert!(error.to_string().contains("M20x1.5"), "{text}: {error}");
        }
    }
}
