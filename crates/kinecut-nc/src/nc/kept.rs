//! Tool table and parameters, which a machine with LinuxCNC keeps from one program to the next.

use super::{Parameters, TableTool};

/// The files in which LinuxCNC keeps offsets, as far as they are given.
///
/// ```
/// # use kinecut_nc as kinecut;
/// use kinecut::base::Sources;
/// use kinecut::nc::{self, Control, Kept, ReadSettings};
/// let mut sources = Sources::default();
/// let var = sources.add("linuxcnc.var", "5220 1\n5221 100\n5241 140\n");
/// let parameters = Some(nc::parameters(&sources, var, 1.0).unwrap());
/// let settings = ReadSettings { kept: Kept { parameters, ..Kept::default() }, ..ReadSettings::default() };
/// // G55 lies 40 mm along X from G54, so that the increment there starts from a place that is known.
/// let file = sources.add("a.ngc", "G54 G0 X50 Y0 Z5\nG55\nG91 G0 X1\nM2\n");
/// let reading = nc::read_source(&sources, file, Control::LinuxCnc, &[], &settings).unwrap();
/// # use kinecut::program::{Item, Target};
/// let Item::Move(motion) = reading.program.items.get(1) else { panic!() };
/// let Target::Tip { point, .. } = motion.end else { panic!() };
/// assert_eq!(point.x, 11.0);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kept {
    /// Its tool table.
    pub tools: Option<Vec<TableTool>>,
    /// Its parameters.
    pub parameters: Option<Parameters>,
}
