//! The chip of a milling cutter.

use std::f64::consts::FRAC_PI_2;

/// The chip of a cutter beside a wall, or of its full width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MilledChip {
    /// Largest thickness [mm].
    pub largest: f64,
    /// Mean thickness over the arc [mm].
    pub mean: f64,
    /// Arc of engagement [rad].
    pub engagement: f64,
}

impl MilledChip {
    /// Of a cutter of a diameter [mm] with a feed per tooth [mm] and a width of cut [mm], which is at most the diameter:
    ///
    /// ```text
    /// E = acos(1 - 2 x),  x = width / D;   largest fz sin(min(E, 90 degrees));   mean 2 fz x / E
    /// ```
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::cutting::MilledChip;
    /// let chip = MilledChip::of(0.1, 1.0, 10.0);
    /// assert!((chip.largest - 0.06).abs() < 1e-12);
    /// assert!((chip.engagement.to_degrees() - 36.87).abs() < 1e-3);
    /// ```
    pub fn of(feed_per_tooth: f64, width: f64, diameter: f64) -> MilledChip {
        let x = (width / diameter).clamp(0.0, 1.0);
        MilledChip::within(feed_per_tooth, (1.0 - 2.0 * x).acos())
    }

    /// With a feed per tooth [mm] and an arc of engagement [rad] from the wall on.
    pub fn within(feed_per_tooth: f64, engagement: f64) -> MilledChip {
        let x = (0.5 * engagement).sin().powi(2);
        let mean = if engagement > 0.0 { 2.0 * feed_per_tooth * x / engagement } else { 0.0 };
        MilledChip { largest: feed_per_tooth * engagement.min(FRAC_PI_2).sin(), mean, engagement }
    }

    /// Factor on the feed per tooth with which an arc of engagement [rad] below a right angle has the same largest chip as the full
    /// width has: `1 / sin E`, at most 3.
    ///
    /// ```
    /// # use kinecut_plan as kinecut;
    /// use kinecut::cutting::MilledChip;
    /// assert!((MilledChip::thinning(36.87_f64.to_radians()) - 1.6667).abs() < 1e-4);
    /// assert_eq!(MilledChip::thinning(2.0), 1.0);
    /// assert_eq!(MilledChip::thinning(0.05), 3.0);
    /// ```
    pub fn thinning(engagement: f64) -> f64 {
        /// More than that is not made up for.
        const MOST: f64 = 3.0;
        (1.0 / engagement.clamp(0.0, FRAC_PI_2).sin()).min(MOST)
    }
}
