//! The controls that kinecut writes for and reads.

use std::fmt;

use super::dialect::{CompWord, TurnWord};
use super::multi_axis::{TcpWord, TiltWord};
use crate::base::{Code, Finding, Result};
use crate::program::{Blend, RotarySolution, Tcp, ToolNumber};
use crate::trace::CompStart;

/// A control.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Control {
    /// Siemens SINUMERIK 840D (sl, ONE).
    Sinumerik840d,
    /// LinuxCNC (RS274/NGC).
    LinuxCnc,
    /// FANUC 0i-M, 30i-M (milling).
    Fanuc,
    /// Haas (Classic, NGC), milling.
    Haas,
    /// GRBL 1.1.
    Grbl,
    /// grblHAL, and senders of its kind.
    GrblHal,
    /// HEIDENHAIN TNC (iTNC 530, TNC 640), klartext.
    Heidenhain,
}

impl Control {
    /// All of them: their programs are read.
    pub const ALL: &[Control] = &[
        Control::Sinumerik840d,
        Control::LinuxCnc,
        Control::Fanuc,
        Control::Haas,
        Control::Grbl,
        Control::GrblHal,
        Control::Heidenhain,
    ];

    /// Those for which programs are written.
    pub const WRITTEN: &[Control] =
        &[Control::Sinumerik840d, Control::LinuxCnc, Control::Fanuc, Control::Grbl, Control::Heidenhain];

    /// The name used in job files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Control::Sinumerik840d => "sinumerik-840d",
            Control::LinuxCnc => "linuxcnc",
            Control::Fanuc => "fanuc",
            Control::Haas => "haas",
            Control::Grbl => "grbl",
            Control::GrblHal => "grblhal",
            Control::Heidenhain => "heidenhain",
        }
    }

    /// The name as its maker writes it.
    pub fn title(self) -> &'static str {
        match self {
            Control::Sinumerik840d => "SINUMERIK 840D",
            Control::LinuxCnc => "LinuxCNC",
            Control::Fanuc => "FANUC 0i/30i",
            Control::Haas => "Haas",
            Control::Grbl => "GRBL 1.1",
            Control::GrblHal => "grblHAL",
            Control::Heidenhain => "HEIDENHAIN TNC",
        }
    }

    /// The control of this name, in any case.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::nc::Control;
    /// assert_eq!(Control::parse("LinuxCNC").unwrap(), Control::LinuxCnc);
    /// assert!(Control::parse("sinumerik").unwrap_err().to_string().contains("sinumerik-840d"));
    /// ```
    ///
    /// # Errors
    /// `KC0301` with the names of the known controls.
    pub fn parse(name: &str) -> Result<Control> {
        let wanted = name.trim().to_ascii_lowercase();
        if let Some(control) = Control::ALL.iter().find(|c| c.name() == wanted) {
            return Ok(*control);
        }
        let known = Control::ALL.iter().map(|c| format!("`{}`", c.name())).collect::<Vec<_>>().join(", ");
        let near = Control::ALL
            .iter()
            .map(|c| (strsim::jaro_winkler(&wanted, c.name()), c))
            .filter(|(likeness, _)| *likeness > LIKE)
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let help = match near {
            Some((_, control)) => format!("did you mean `{control}`? known: {known}"),
            None => format!("known: {known}"),
        };
        Err(Finding::error(
            Code::POST_CONTROL,
            format!("the control `{}` is not known", name.escape_default()),
        )
        .help(help)
        .into())
    }

    /// Ending of a program's file name, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Control::Sinumerik840d => "mpf",
            Control::LinuxCnc => "ngc",
            Control::Fanuc | Control::Haas => "nc",
            Control::Grbl | Control::GrblHal => "gcode",
            Control::Heidenhain => "h",
        }
    }

    /// Least step of a coordinate with this number of decimals [mm].
    pub fn resolution(self, decimals: u8) -> f64 {
        10f64.powi(-i32::from(decimals))
    }

    /// Register that holds the length of a tool: SINUMERIK keeps it in the tool's own first cutting edge (`D1`), LinuxCNC
    /// in the table's line of that tool (`H7` for `T7`), FANUC in the register of that number (`H7`), GRBL nowhere (its
    /// zero is set with the tool; 1 stands for that), HEIDENHAIN with the tool itself (register 1; 2 is `TOOL CALL n.2`).
    pub fn length_register(self, tool: ToolNumber) -> u32 {
        match self {
            Control::Sinumerik840d | Control::Grbl | Control::Heidenhain => 1,
            Control::LinuxCnc | Control::Fanuc | Control::Haas | Control::GrblHal => tool.0,
        }
    }

    /// Whether it has registers of tool lengths; otherwise the zero of Z is set with each tool.
    pub fn has_lengths(self) -> bool {
        self.dialect().has_lengths
    }

    /// Passage between moves if a program asks for none: SINUMERIK's `G64` keeps to the path within its own corner
    /// tolerance, LinuxCNC's only with a tolerance of its own, FANUC's `G64` does not stop at the end of a block, GRBL
    /// never leaves the path.
    pub fn usual_blend(self) -> Blend {
        match self {
            Control::Sinumerik840d
            | Control::Fanuc
            | Control::Haas
            | Control::Grbl
            | Control::GrblHal
            | Control::Heidenhain => Blend::Continuous,
            Control::LinuxCnc => Blend::within(0.005),
        }
    }

    /// The passage between moves that is written where a program asks for another: FANUC has no tolerance of its own and
    /// stops instead; GRBL keeps to the path and has but one passage.
    pub fn blend(self, wanted: Blend) -> Blend {
        self.dialect().blend(wanted)
    }

    /// Whether it shows messages of a program to the operator: `(MSG, ..)` of LinuxCNC, `MSG("..")` of SINUMERIK. Grbl drops
    /// all comments; `(MSG, ..)` is for the program that sends the text. `#3006` of FANUC is a stop.
    pub fn has_messages(self) -> bool {
        matches!(self, Control::LinuxCnc | Control::Sinumerik840d)
    }

    /// Decimals of coordinates that are usual: FANUC's increment system IS-B has three.
    pub fn usual_decimals(self) -> u8 {
        if matches!(self, Control::Fanuc | Control::Haas) { 3 } else { 4 }
    }

    /// Whether it has cutter compensation (`G41`, `G42`).
    pub fn has_compensation(self) -> bool {
        self.dialect().comp != CompWord::None
    }

    /// Whether the register of a wear correction holds the tool's length too, so that it is called for the whole pass.
    pub fn wear_holds_length(self) -> bool {
        self.dialect().comp == CompWord::Edge
    }

    /// Register of a wear correction of the radius, used with a path of the tool centre. SINUMERIK: the tool's second
    /// cutting edge, which has the length of the first and no radius of its own, so that its radius wear alone counts;
    /// it holds the length too and must be called for the whole pass. HEIDENHAIN: the tool's indexed line, `TOOL CALL n.2`,
    /// alike, with the wear as its DR. Others: a register of its own beside the
    /// tool's, `tool + 100`; on LinuxCNC the line of that number in the tool table.
    pub fn wear_register(self, tool: ToolNumber) -> u32 {
        /// Distance of the wear registers from the tools' own: magazines hold fewer.
        const APART: u32 = 100;
        match self.dialect().comp {
            CompWord::Edge => 2,
            _ => tool.0.saturating_add(APART),
        }
    }

    /// Note on a wear register for the operator, as a comment in the program.
    pub fn wear_note(self, tool: ToolNumber, register: u32) -> String {
        let tool = tool.0;
        match self {
            Control::Sinumerik840d => {
                format!("WEAR IN T{tool} D{register}: LENGTH AS D1, RADIUS 0, CORRECTION IN THE RADIUS WEAR")
            }
            Control::LinuxCnc => format!("WEAR IN TOOL TABLE T{register}: D IS TWICE THE CORRECTION"),
            Control::Heidenhain => {
                format!("WEAR IN TOOL {tool}.{register}: LENGTH AS {tool}, R 0, CORRECTION IN DR")
            }
            Control::Fanuc | Control::Haas | Control::Grbl | Control::GrblHal => {
                format!("WEAR IN D{register}: RADIUS CORRECTION ONLY")
            }
        }
    }

    /// Note on a register that holds the radius of the cutter, for the operator, as a comment in the program.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::{nc::Control, program::ToolNumber};
    /// assert_eq!(Control::LinuxCnc.radius_note(ToolNumber(3), 103), "DIAMETER OF THE CUTTER IN TOOL TABLE T103");
    /// ```
    pub fn radius_note(self, tool: ToolNumber, register: u32) -> String {
        let tool = tool.0;
        match self {
            Control::Sinumerik840d if register == 1 => format!("RADIUS OF THE CUTTER IN T{tool} D1"),
            Control::Sinumerik840d => format!("RADIUS OF THE CUTTER IN T{tool} D{register}, LENGTH AS D1"),
            Control::LinuxCnc => format!("DIAMETER OF THE CUTTER IN TOOL TABLE T{register}"),
            Control::Heidenhain if register == 1 => format!("RADIUS OF THE CUTTER IN TOOL {tool}"),
            Control::Heidenhain => {
                format!("RADIUS OF THE CUTTER IN TOOL {tool}.{register}, LENGTH AS {tool}")
            }
            Control::Fanuc | Control::Haas | Control::Grbl | Control::GrblHal => {
                format!("RADIUS OF THE CUTTER IN D{register}")
            }
        }
    }

    /// Radius by which the control compensates for the number in a register [mm]: half of it on LinuxCNC, whose
    /// table holds diameters.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::nc::Control;
    /// assert_eq!(Control::LinuxCnc.compensation_radius(0.02), 0.01);
    /// assert_eq!(Control::Sinumerik840d.compensation_radius(0.02), 0.02);
    /// ```
    pub fn compensation_radius(self, value: f64) -> f64 {
        match self {
            Control::LinuxCnc => 0.5 * value,
            _ => value,
        }
    }

    /// End of the entry of a compensation on this control.
    pub fn comp_start(self) -> CompStart {
        match self {
            Control::LinuxCnc => CompStart::AtEntry,
            _ => CompStart::AtNext,
        }
    }

    /// Whether it has a block for circle involutes.
    pub fn has_involute(self) -> bool {
        self.dialect().involute.is_some()
    }

    /// Whether it turns the coordinates of a program about Z by words of its own (`ROT`, `G68`, `G10 L2 R`, `CYCL DEF 10`).
    pub fn has_rotation(self) -> bool {
        self.dialect().turn != TurnWord::None
    }

    /// Least step of the angle of those words [rad]. A frame turned by another angle is written turned by the nearest one,
    /// with its points given in that: the path stays, but moves along its axes are no longer along those of the text.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::nc::Control;
    /// assert_eq!(Control::Fanuc.rotation_step(), Some(0.001f64.to_radians()));
    /// assert_eq!(Control::Grbl.rotation_step(), None);
    /// ```
    pub fn rotation_step(self) -> Option<f64> {
        let decimals = i32::from(self.dialect().angle_decimals);
        self.has_rotation().then(|| (1.0 / 10f64.powi(decimals)).to_radians())
    }

    /// Whether it keeps the tip on the path in this way while rotary axes turn: FANUC lets them go straight from angle to
    /// angle, SINUMERIK and HEIDENHAIN also turn the tool axis in a plane.
    ///
    /// ```
    /// # use kinecut_nc as kinecut;
    /// use kinecut::nc::Control;
    /// use kinecut::program::Tcp;
    /// assert!(Control::Fanuc.has_tcp(Tcp::Axes) && !Control::Fanuc.has_tcp(Tcp::Vector));
    /// assert!(!Control::LinuxCnc.has_tcp(Tcp::Axes));
    /// ```
    pub fn has_tcp(self, tcp: Tcp) -> bool {
        match (self.dialect().axes.tcp, tcp) {
            (_, Tcp::Off) | (TcpWord::Transformation, _) | (TcpWord::Length, Tcp::Axes) => true,
            (TcpWord::None, _) if self == Control::Heidenhain => true,
            (TcpWord::Length, Tcp::Vector) | (TcpWord::None, _) => false,
        }
    }

    /// Whether it tilts the working plane by words of its own (`G68.2`, `CYCLE800`, `PLANE SPATIAL`).
    pub fn has_planes(self) -> bool {
        self == Control::Heidenhain || self.dialect().axes.tilt != TiltWord::None
    }

    /// The choice of a tilted plane's solution that is written where a program asks for another: SINUMERIK has to be told
    /// one, and is told what its own mask proposes.
    pub fn branch(self, wanted: RotarySolution) -> RotarySolution {
        match (self.dialect().axes.tilt, wanted) {
            (TiltWord::Swivel, RotarySolution::Free) => RotarySolution::Negative,
            _ => wanted,
        }
    }

    /// Whether it can turn the tool in the plane of two directions while it keeps the tip on its path.
    pub fn turns_in_plane(self) -> bool {
        matches!(self, Control::Sinumerik840d | Control::Heidenhain)
    }

    /// Whether it has a block for cubics (`G5`).
    pub fn has_cubic(self) -> bool {
        self.dialect().has_cubic()
    }
}

impl fmt::Display for Control {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Likeness (Jaro-Winkler) from which a name is taken for a misspelling: below it suggestions look random.
const LIKE: f64 = 0.75;
