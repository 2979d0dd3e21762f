//! Answers of a control to a planner of drilling: its feeds, and the drilling cycles that it can run as its own.

use crate::program::{Between, Cycle, DeepHole, Shortening};

use super::Control;
use super::native::{Native, TapWord};

impl Control {
    /// Whether it has a feed per revolution of the spindle (`G95`, `FU`); GRBL has none.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::nc::Control;
    /// assert!(Control::Heidenhain.has_feed_per_revolution() && !Control::Grbl.has_feed_per_revolution());
    /// ```
    pub fn has_feed_per_revolution(self) -> bool {
        self.dialect().per_revolution
    }

    /// Whether it taps with the feed geared to the spindle; GRBL does not.
    pub fn has_rigid_tapping(self) -> bool {
        self.dialect().tap != TapWord::None
    }

    /// The cycle nearest to the wanted one that the control runs as its own; the wanted one where there is none, which is
    /// then written as its moves. `unit` is the least step of coordinates [mm].
    ///
    /// The hole and the heights of approach and return stay. What may change: the clearance and the lift
    /// (fixed on LinuxCNC, by the parameters 5115 and 5114 on FANUC); on SINUMERIK the step becomes smaller, so that the steps are whole;
    /// on HEIDENHAIN the steps of pecking count from the height that lies the clearance below the reference.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::nc::Control;
    /// use kinecut::program::Cycle;
    /// let wanted = Cycle::Peck { reference: 2.0, bottom: -10.0, retract: 50.0, step: 5.0, clearance: 0.5 };
    /// let Cycle::Peck { step, clearance, .. } = Control::Sinumerik840d.own_cycle(wanted, 0.001) else { panic!() };
    /// assert_eq!((step, clearance), (4.0, 0.5));
    /// ```
    pub fn own_cycle(self, wanted: Cycle, unit: f64) -> Cycle {
        match (self.dialect().native, wanted) {
            (Native::Canned(canned), Cycle::Peck { reference, bottom, retract, step, .. })
                if step >= canned.clearance =>
            {
                Cycle::Peck { reference, bottom, retract, step, clearance: canned.clearance }
            }
            (Native::Canned(canned), Cycle::ChipBreak { reference, bottom, retract, step, .. })
                if step >= canned.lift =>
            {
                Cycle::ChipBreak { reference, bottom, retract, step, lift: canned.lift }
            }
            (Native::Calls, Cycle::Peck { reference, bottom, retract, step, clearance }) => {
                let step = whole_step(reference, bottom, step, unit).unwrap_or(step);
                Cycle::Peck { reference, bottom, retract, step, clearance }
            }
            (Native::Defined, Cycle::Peck { reference, bottom, retract, step, clearance })
                if clearance >= 0.0 && reference - clearance - step > bottom =>
            {
                Cycle::DeepHole(DeepHole {
                    reference,
                    first: reference - clearance - step,
                    bottom,
                    retract,
                    step,
                    shortening: Shortening::None,
                    between: Between::Withdraw { clearance, dwell: 0.0 },
                    first_feed: 1.0,
                    dwell: 0.0,
                    dwell_bottom: 0.0,
                })
            }
            _ => wanted,
        }
    }
}

/// The largest step on the grid that is not larger than the wanted one and divides the hole, if one of at least half of
/// it does.
fn whole_step(reference: f64, bottom: f64, step: f64, unit: f64) -> Option<f64> {
    /// Coordinates are below a kilometre and the grid not finer than a millionth: counts are exact.
    const MOST: f64 = 1e12;
    let [top, low] = [(reference / unit).round(), (bottom / unit).round()];
    let (depth, most) = (top - low, step / unit);
    if !(depth > 0.0 && depth < MOST && most >= 1.0) {
        return None;
    }
    // The rounding of a decimal step is not a smaller step.
    let least = (depth / (most + 0.5)).ceil().max(1.0);
    let mut count = least;
    while count <= 2.0 * least && count <= depth {
        if depth % count == 0.0 {
            return Some(depth / count * unit);
        }
        count += 1.0;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_made_whole() {
        assert_eq!(whole_step(2.0, -10.0, 4.0, 0.001), Some(4.0));
        assert_eq!(whole_step(2.0, -10.0, 3.9, 0.001), Some(3.0));
        // 12.001 mm are 12001 steps of the grid, 11 times 1091.
        let step = whole_step(2.0, -10.001, 1.2, 0.001).unwrap();
        assert!((step - 1.091).abs() < 1e-12, "{step}");
        // A prime number of steps.
        assert_eq!(whole_step(2.0, -10.007, 4.0, 0.001), None);
        assert_eq!(whole_step(2.0, f64::NAN, 4.0, 0.001), None);
        assert_eq!(whole_step(2.0, -10.0, 0.0001, 0.001), None);
    }

    #[test]
    fn cycles_that_no_control_changes_stay() {
        let drill = Cycle::Drill { reference: 2.0, bottom: -10.0, retract: 50.0, dwell: 0.0 };
        let peck = Cycle::Peck { reference: 2.0, bottom: -10.0, retract: 50.0, step: 0.1, clearance: 0.5 };
        for control in Control::ALL {
            assert_eq!(control.own_cycle(drill, 0.001), drill);
        }
        assert_eq!(Control::Grbl.own_cycle(peck, 0.001), peck);
        // A step smaller than the clearance would lead above R.
        assert_eq!(Control::LinuxCnc.own_cycle(peck, 0.001), peck);
    }
}
