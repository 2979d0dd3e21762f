//! The dialect of each control.

use super::dialect::Dialect;
use super::{Control, fanuc, grbl, grblhal, haas, heidenhain, linuxcnc, sinumerik};

impl Control {
    /// The words of the control.
    pub(super) fn dialect(self) -> &'static Dialect {
        match self {
            Control::Sinumerik840d => &sinumerik::DIALECT,
            Control::LinuxCnc => &linuxcnc::DIALECT,
            Control::Fanuc => &fanuc::DIALECT,
            Control::Haas => &haas::DIALECT,
            Control::Grbl => &grbl::DIALECT,
            Control::GrblHal => &grblhal::DIALECT,
            Control::Heidenhain => &heidenhain::DIALECT,
        }
    }
}
