//! The numbers of the standards for the check of posted threads, written down and not computed: the planner has its own.

use crate::threading::ThreadForm;

/// Profile of a thread, of the pitch 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Profile {
    /// By what the pitch diameter is less than the major one.
    pub(super) pitch_diameter: f64,
    /// By what the root diameter of a bolt is less.
    pub(super) root_diameter: f64,
    /// Angle between flank and a plane across the axis (degrees).
    pub(super) half_angle: f64,
}

/// The profile of a form: ISO 68-1, BS 84, ASME B1.20.1.
pub(super) fn profile(form: ThreadForm) -> Profile {
    let [pitch_diameter, root_diameter, half_angle] = match form {
        ThreadForm::Metric => [0.649_519_053, 1.226_869_322, 30.0],
        ThreadForm::Whitworth => [0.640_327_376, 1.280_654_751, 27.5],
        ThreadForm::Npt => [0.8, 1.6, 30.0],
    };
    Profile { pitch_diameter, root_diameter, half_angle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threading::Thread;

    #[test]
    fn both_sides_have_the_same_standards() {
        for form in [ThreadForm::Metric, ThreadForm::Whitworth, ThreadForm::Npt] {
            let (own, planned) = (profile(form), Thread::new(form, 20.0, 1.0));
            assert!((20.0 - own.pitch_diameter - planned.pitch_diameter()).abs() < 1e-9, "{form:?}");
            assert!((20.0 - own.root_diameter - planned.root_diameter()).abs() < 1e-9, "{form:?}");
            assert!((own.half_angle.to_radians() - form.half_angle()).abs() < 1e-12, "{form:?}");
        }
    }
}
