//! Ends of lines that are not at the tool that is said to have cut them.

use super::Simulated;
use crate::base::{Code, Finding};
use crate::stock::certify::GAP;

/// A doubt about the stock where its certificate does not hold.
pub(super) fn certified(run: &Simulated<'_>) -> Vec<Finding> {
    let Some(certificate) = run.simulation.certificate.filter(|c| c.strayed > 0) else { return Vec::new() };
    let (strayed, ends) = (certificate.strayed, certificate.ends);
    let what = format!("{strayed} of {ends} ends of lines lie off the tool that is said to have cut them");
    let finding = Finding::doubt(Code::NOT_CERTIFIED, what)
        .value_mm(certificate.farthest)
        .bound_mm(GAP)
        .help("report the program: this is a fault of kinecut");
    vec![finding]
}
