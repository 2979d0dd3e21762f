//! Settings of a writer, and its result.

use std::sync::Arc;

use super::Control;

/// Unit of the lengths in a text, and of its feeds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Units {
    /// Millimetres, mm/min, mm/rev.
    #[default]
    Millimetres,
    /// Inches, in/min, in/rev; HEIDENHAIN's feeds are tenths of an inch in a minute.
    Inches,
}

impl Units {
    /// Millimetres of one: 1 or 25.4.
    ///
    /// ```
    /// assert_eq!(kinecut_nc::nc::Units::Inches.mm(), 25.4);
    /// ```
    pub fn mm(self) -> f64 {
        match self {
            Units::Millimetres => 1.0,
            Units::Inches => 25.4,
        }
    }

    /// Its sign: `mm` or `in`.
    pub fn sign(self) -> &'static str {
        match self {
            Units::Millimetres => "mm",
            Units::Inches => "in",
        }
    }

    /// A block that says millimetres (`G21`, `G710`), with the word of this unit.
    pub(super) fn said_in(self, block: &str) -> String {
        if !self.is_inch() {
            return block.to_owned();
        }
        let word = |word| match word {
            "G21" => "G20",
            "G710" => "G700",
            other => other,
        };
        block.split(' ').map(word).collect::<Vec<_>>().join(" ")
    }

    /// Whether numbers are inches.
    pub fn is_inch(self) -> bool {
        self == Units::Inches
    }
}

/// Settings for writing a program.
#[derive(Clone, Debug, PartialEq)]
pub struct PostSettings {
    /// The control.
    pub control: Control,
    /// Unit of the text's lengths and feeds; everything else here is in mm.
    pub units: Units,
    /// Decimals of coordinates, 3 to 6.
    pub decimals: u8,
    /// Whether blocks are numbered.
    pub block_numbers: bool,
    /// Least step of coordinates where it is not one unit of the last decimal, such as 0.005 [mm].
    pub resolution: Option<f64>,
    /// Largest distance of the arcs (or cubics) that replace an involute or spiral from it [mm], where the control has
    /// none or cannot run this one.
    pub arc_tolerance: f64,
    /// Whether involutes are written as the control's own involute where it has one.
    pub involute_native: bool,
    /// Whether spirals and involutes at a height are written as cubics (`G5`, LinuxCNC only) within `arc_tolerance`,
    /// in place of arcs. Not under cutter compensation, and not where `arcs` is off.
    pub cubic: bool,
    /// Whether circles and helices keep their form; otherwise every curve becomes straight moves.
    pub arcs: bool,
    /// Largest distance of those straight moves from a curve [mm]; their ends lie on it.
    pub chord_tolerance: f64,
    /// Whether frames that are shifted or turned about Z within a work offset are written as the control's own shift and
    /// rotation where it has them; otherwise the coordinates themselves are turned.
    pub rotation: bool,
    /// Name of the program.
    pub program_name: String,
    /// Number of the program, 1 to 9999, on controls that name programs by numbers (FANUC).
    pub program_number: u32,
    /// Template of the blocks that put the control into a known state, in place of the built-in ones.
    ///
    /// Variables: `program_name`, `program_number`, `control`, `units` ("mm" or "in"), `decimals`, `offsets` (work offsets in
    /// the order of use), `offset` (the first), `tools` (in the order of use: `number`, `name`, `diameter`, `length` or
    /// none), `version`. Syntax of Jinja; a name that does not exist is an error.
    pub start_template: Option<String>,
    /// Template of the last blocks, in place of the built-in end; spindle and coolant are off before it. It must end
    /// the program. Variables as in `start_template`.
    pub end_template: Option<String>,
    /// Whether the text begins with the control's own file header (`%_N_NAME_MPF`), where it has one.
    pub file_header: bool,
    /// Lines of comment for the head of the program.
    pub header: Vec<String>,
}

impl PostSettings {
    /// The settings that are usual on a control, in a unit: numbers in inches have one more decimal.
    ///
    /// ```
    /// use kinecut_nc::nc::{Control, PostSettings, Units};
    /// let decimals = |control| PostSettings::in_units(control, Units::Inches).decimals;
    /// assert_eq!((decimals(Control::Fanuc), decimals(Control::Heidenhain)), (4, 5));
    /// ```
    pub fn in_units(control: Control, units: Units) -> PostSettings {
        let decimals = control.usual_decimals() + u8::from(units.is_inch());
        PostSettings { units, decimals, ..PostSettings::new(control) }
    }

    /// Half a micrometre: below what a machine can follow, and with the rounding of the points still below 1 um.
    pub const ARC_TOLERANCE: f64 = 0.0005;

    /// A hundredth of a millimetre is the usual tolerance of workshop programs without arcs; half of it leaves room for the
    /// rest.
    pub const CHORD_TOLERANCE: f64 = 0.005;

    /// The settings that are usual on a control, in millimetres.
    pub fn new(control: Control) -> PostSettings {
        PostSettings {
            control,
            units: Units::Millimetres,
            decimals: control.usual_decimals(),
            resolution: None,
            block_numbers: matches!(control, Control::Sinumerik840d | Control::Heidenhain),
            arc_tolerance: PostSettings::ARC_TOLERANCE,
            involute_native: true,
            cubic: false,
            arcs: true,
            rotation: true,
            chord_tolerance: PostSettings::CHORD_TOLERANCE,
            program_name: "PROGRAM".to_owned(),
            program_number: 1,
            start_template: None,
            end_template: None,
            file_header: false,
            header: Vec::new(),
        }
    }
}

/// A program as text.
#[derive(Clone, Debug, PartialEq)]
pub struct Posted {
    /// The text.
    pub text: Arc<str>,
    /// For each line of the text (0-based) the item of the program that it was written for.
    pub lines: Vec<Option<u32>>,
    /// Changes that the number format made to the program.
    pub notes: PostNotes,
}

/// Changes that the number format of a control made to a program.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PostNotes {
    /// Largest distance of a written end point from the exact one, along an axis [mm].
    pub rounding: f64,
    /// Largest difference of the distances of start and end from a written centre [mm].
    pub radius_difference: f64,
    /// Largest distance between the involutes of the written base radius through start and end [mm].
    pub involute_difference: f64,
    /// Involutes written as the control's own.
    pub involutes: u32,
    /// Spirals and involutes written as chains of arcs or cubics.
    pub chains: u32,
    /// Blocks of cubics.
    pub cubics: u32,
    /// Largest distance of a chain from its involute [mm], before rounding.
    pub chain_tolerance: f64,
    /// Arcs too small for the number format that were written as lines.
    pub straightened: u32,
    /// Largest distance by which the rounding of the angles of a tilted plane moves a point [mm].
    pub tilt: f64,
}
