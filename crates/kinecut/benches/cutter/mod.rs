//! The cutter of the measurements of sweeping: of each kind of surface that a tool of revolution has there is one.

use kinecut::sweep::ProfileChain;
use kinecut::tool::{Contour, ContourElement, ElementRole};

/// A bull-nose cutter 10 mm wide, corner 2 mm, cutting 20 mm, with a conical neck: disc, torus, cylinder, cone, disc, and the
/// four edges between them.
pub(crate) fn bull_nose() -> ProfileChain {
    let contour = Contour::new(vec![
        ContourElement::line([0.0, 0.0], [3.0, 0.0], ElementRole::Cutting),
        ContourElement::arc([3.0, 2.0], 2.0, -std::f64::consts::FRAC_PI_2, 0.0, ElementRole::Cutting),
        ContourElement::line([5.0, 2.0], [5.0, 20.0], ElementRole::Cutting),
        ContourElement::line([5.0, 20.0], [4.0, 40.0], ElementRole::Shank),
        ContourElement::line([4.0, 40.0], [0.0, 40.0], ElementRole::Shank),
    ]);
    ProfileChain::new(&contour.expect("a contour"))
}
