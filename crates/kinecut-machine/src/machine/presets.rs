//! Machines known by name: the usual arrangements of three to six axes.
//!
//! Offsets and travel of those modelled on LinuxCNC's simulators are theirs; those of the others are illustrative and
//! not the data of a maker. All axes are given at home; the machine's zero is the tip of a tool without length, or lies
//! below it by the offset of the spindle.

use glam::{DMat3, DVec3};

use super::{CoordinateCode, Joint, Machine};
use crate::base::{Code, Finding, Result};
use crate::geom::Rigid;

/// A machine known by name.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// Name.
    pub name: &'static str,
    /// Coordinate code.
    pub code: &'static str,
    /// Description in a few words.
    pub note: &'static str,
    /// From workpiece to tool.
    axes: &'static [Axis],
    /// The gauge point at home [mm].
    spindle: [f64; 3],
    /// True if the tool points along X at home (from tip to holder), not along Z.
    along_x: bool,
}

/// An axis of a preset.
#[derive(Clone, Copy, Debug)]
struct Axis {
    /// Least and greatest position [mm or degrees].
    travel: [f64; 2],
    /// A point of a rotary axis [mm].
    point: [f64; 3],
    /// Sense of the control.
    sense: f64,
    /// Angle from Z towards Y of an inclined axis [degrees].
    inclined: f64,
}

const fn linear(least: f64, most: f64) -> Axis {
    Axis { travel: [least, most], point: [0.0; 3], sense: 1.0, inclined: 0.0 }
}

const fn rotary(least: f64, most: f64, point: [f64; 3]) -> Axis {
    Axis { travel: [least, most], point, sense: 1.0, inclined: 0.0 }
}

const fn reversed(axis: Axis) -> Axis {
    Axis { sense: -1.0, ..axis }
}

const fn inclined(axis: Axis, degrees: f64) -> Axis {
    Axis { inclined: degrees, ..axis }
}

/// Travel of a rotary axis without stops [degrees]: a hundred turns, as the simulators have it.
const ENDLESS: f64 = 36_000.0;
/// Travel where nothing is known [mm].
const OPEN: Axis = linear(-500.0, 500.0);
/// The zero of the machine.
const ZERO: [f64; 3] = [0.0; 3];

static PRESETS: [Preset; 14] = [
    Preset {
        name: "mill3_xyz",
        code: "2103",
        note: "knee mill of three axes: table X on saddle Y, quill Z",
        axes: &[linear(-250.0, 250.0), linear(-400.0, 400.0), linear(-500.0, 0.0)],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "mill4_xyza",
        code: "41203",
        note: "mill of three axes with a rotary A on its table, centre height 50",
        axes: &[rotary(-360.0, 360.0, [0.0, 0.0, 50.0]), OPEN, OPEN, OPEN],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "trt_xyzac",
        code: "641203",
        note: "trunnion A that carries C, offsets 20 in Y and 10 in Z (LinuxCNC xyzac-trt, senses of ISO 841)",
        axes: &[
            rotary(-ENDLESS, ENDLESS, ZERO),
            rotary(-100.0, 50.0, [0.0, 20.0, 10.0]),
            linear(-200.0, 200.0),
            linear(-100.0, 100.0),
            linear(-120.0, 120.0),
        ],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "trt_xyzac_lcnc_default",
        code: "641203",
        note: "as trt_xyzac, with the default senses of LinuxCNC: both rotary axes reversed",
        axes: &[
            reversed(rotary(-ENDLESS, ENDLESS, ZERO)),
            reversed(rotary(-100.0, 50.0, [0.0, 20.0, 10.0])),
            linear(-200.0, 200.0),
            linear(-100.0, 100.0),
            linear(-120.0, 120.0),
        ],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "trt_xyzbc",
        code: "651203",
        note: "trunnion B that carries C, offsets 20 in X and 10 in Z (LinuxCNC xyzbc-trt, senses of ISO 841)",
        axes: &[
            rotary(-ENDLESS, ENDLESS, ZERO),
            rotary(-100.0, 100.0, [20.0, 0.0, 10.0]),
            linear(-200.0, 200.0),
            linear(-200.0, 200.0),
            linear(-120.0, 120.0),
        ],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "tdr_xyzab",
        code: "450123",
        note: "two rotary tables, A next to the work, offset -10 in Z (LinuxCNC xyzab-tdr)",
        axes: &[
            rotary(-3600.0, 3600.0, [0.0, 0.0, -10.0]),
            rotary(-180.0, 180.0, ZERO),
            linear(-200.0, 200.0),
            linear(-200.0, 200.0),
            linear(-300.0, 300.0),
        ],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "head_bc_bridge",
        code: "012365",
        note: "bridge mill with C and then B in the head, pivot length 250 (LinuxCNC 5axiskins; its B is reversed)",
        axes: &[
            linear(-500.0, 500.0),
            linear(-500.0, 500.0),
            linear(-500.0, 100.0),
            rotary(-ENDLESS, ENDLESS, [0.0, 0.0, 250.0]),
            rotary(-120.0, 120.0, [0.0, 0.0, 250.0]),
        ],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "ht_bc_max",
        code: "612035",
        note: "rotary table C and tilting head B, pivot 120 (arrangement of LinuxCNC maxkins)",
        axes: &[
            rotary(-3600.0, 3600.0, ZERO),
            linear(-100.0, 200.0),
            linear(-60.0, 60.0),
            linear(-149.0, 1.0),
            rotary(-90.0, 90.0, [0.0, 0.0, 120.0]),
        ],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "nut_head_c_b45",
        code: "012367",
        note: "head with C and a nutating axis at 45 degrees, pivots 50 in Y and 120 in Z",
        axes: &[
            OPEN,
            OPEN,
            OPEN,
            rotary(-320.0, 320.0, ZERO),
            inclined(rotary(-185.0, 185.0, [0.0, 50.0, 120.0]), 45.0),
        ],
        spindle: [0.0, 50.0, 0.0],
        along_x: false,
    },
    Preset {
        name: "dmu_nut_table",
        code: "671203",
        note: "C table on a swivel that nutates at 45 degrees, axes meeting at the centre of the table",
        axes: &[rotary(-ENDLESS, ENDLESS, ZERO), inclined(rotary(-5.0, 185.0, ZERO), 45.0), OPEN, OPEN, OPEN],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "hermle_like_c42",
        code: "640213",
        note: "A and C trunnion on the bed, three translations on the tool side; height of the pivot illustrative",
        axes: &[
            rotary(-ENDLESS, ENDLESS, ZERO),
            rotary(-130.0, 130.0, [0.0, 0.0, 60.0]),
            linear(-400.0, 400.0),
            linear(-400.0, 400.0),
            linear(-550.0, 0.0),
        ],
        spindle: ZERO,
        along_x: false,
    },
    Preset {
        name: "lathe_xzc",
        code: "6031",
        note: "turning centre with C; the tool stands radially (+X from tip to holder)",
        axes: &[rotary(-ENDLESS, ENDLESS, ZERO), linear(-50.0, 600.0), linear(-20.0, 250.0)],
        spindle: ZERO,
        along_x: true,
    },
    Preset {
        name: "millturn_xyzbc",
        code: "603125",
        note: "mill-turn: work spindle C, swivelling head B with its pivot 150 above the tip, radial at B 0",
        axes: &[
            rotary(-ENDLESS, ENDLESS, ZERO),
            linear(-50.0, 1500.0),
            linear(-20.0, 600.0),
            linear(-125.0, 125.0),
            rotary(-120.0, 120.0, [150.0, 0.0, 0.0]),
        ],
        spindle: ZERO,
        along_x: true,
    },
    Preset {
        name: "six_axis_trsrn",
        code: "4012367",
        note: "A table, head with C and a nutating axis at 55 degrees (LinuxCNC xyzacb-trsrn); hold A to solve it",
        axes: &[
            rotary(-360.0, 360.0, [0.0, 0.0, -120.0]),
            OPEN,
            OPEN,
            OPEN,
            rotary(-320.0, 320.0, ZERO),
            inclined(rotary(-185.0, 185.0, [0.0, 50.0, 120.0]), 55.0),
        ],
        spindle: [0.0, 50.0, 0.0],
        along_x: false,
    },
];

/// All machines known by name.
pub fn presets() -> &'static [Preset] {
    &PRESETS
}

impl Preset {
    /// The machine.
    ///
    /// # Errors
    /// None for the presets there are; the errors of [`Machine::check`].
    pub fn machine(&self) -> Result<Machine> {
        let code = CoordinateCode::parse(self.code)?;
        let joints = code.word().0.iter().zip(self.axes).map(|(&motion, axis)| {
            let unit = if motion.is_rotation() { std::f64::consts::PI / 180.0 } else { 1.0 };
            let (sin, cos) = axis.inclined.to_radians().sin_cos();
            Joint {
                direction: motion.direction().unwrap_or(DVec3::new(0.0, sin, cos)),
                point: DVec3::from_array(axis.point),
                sense: axis.sense,
                travel: Some(axis.travel.map(|end| end * unit)),
                ..Joint::standard(motion)
            }
        });
        let joints = joints.collect();
        let rotation =
            if self.along_x { DMat3::from_cols(DVec3::NEG_Z, DVec3::Y, DVec3::X) } else { DMat3::IDENTITY };
        let machine = Machine {
            name: self.name.to_owned(),
            joints,
            spindle: Rigid { rotation, translation: DVec3::from_array(self.spindle) },
            ..Machine::of_code(code)
        };
        machine.check()?;
        Ok(machine)
    }
}

impl Machine {
    /// The machine known by this name; see [`presets`].
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::Machine;
    /// let machine = Machine::preset("trt_xyzac").unwrap();
    /// assert_eq!(machine.code.to_string(), "641203");
    /// assert_eq!(machine.joints[1].point.to_array(), [0.0, 20.0, 10.0]);
    /// assert!(Machine::preset("trt").is_err());
    /// ```
    ///
    /// # Errors
    /// `KC1117` for a name that is not known; the help lists those that are.
    pub fn preset(name: &str) -> Result<Machine> {
        match PRESETS.iter().find(|preset| preset.name == name) {
            Some(preset) => preset.machine(),
            None => {
                let names: Vec<_> = PRESETS.iter().map(|preset| preset.name).collect();
                Err(Finding::error(Code::MACHINE_PRESET, format!("no machine is known as `{name}`"))
                    .help(format!("take one of {}", names.join(", ")))
                    .into())
            }
        }
    }
}
