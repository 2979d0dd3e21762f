//! Kinematics modules as chains of joints.
//!
//! | module | chain | axes at home |
//! |---|---|---|
//! | `xyzac-trt-kins` | 641203 | C through the rotation point, A through it shifted by (0, y-offset, z-offset) |
//! | `xyzbc-trt-kins` | 651203 | C through the rotation point, B through it shifted by (x-offset, 0, z-offset) |
//! | `xyzab_tdr_kins` | 450123 | B through the rotation point, A through it shifted by (0, 0, z-offset) |
//! | `5axiskins` | 012365 | C and B through (0, 0, pivot-length); B against ISO 841 |
//! | `xyzacb_trsrn` | 4012367 | A through (0, y-rot-axis, z-rot-axis), C through (x-offset, y-offset + y-pivot, 0), the nutating axis (0, sin, cos) of nut-angle through (0, y-pivot, z-pivot) |
//!
//! The trt modules count both rotary axes against ISO 841 unless `conventional-directions` is 1. All modules report the
//! point with the tool's length in Z added; here the length is part of the tool.

use glam::DVec3;

use super::hal::same;
use super::limits::units;
use super::{Reading, wrong};
use crate::base::{Code, Finding, Result};
use crate::machine::{CoordinateCode, Machine};

/// Modules that are read, with their code (none: it must be given), and the coordinates of their joints by default.
const MODULES: &[(&str, &str, &str)] = &[
    ("xyzac-trt-kins", "641203", "XYZAC"),
    ("xyzbc-trt-kins", "651203", "XYZBC"),
    ("xyzab_tdr_kins", "450123", "XYZAB"),
    ("5axiskins", "012365", "XYZBCW"),
    ("xyzacb_trsrn", "4012367", "XYZABC"),
    ("trivkins", "", "XYZABCUVW"),
];

/// The machine of the module, without limits; its name; the coordinates of joints 0, 1, 2...
pub(super) fn machine(
    reading: &mut Reading<'_>,
    code: Option<&CoordinateCode>,
) -> Result<(String, Machine, String)> {
    let Some(kins) = reading.ini.take("KINS", "KINEMATICS", "the chain of axes") else {
        return Err(Finding::error(Code::MACHINE_IMPORT, "the configuration names no kinematics module")
            .help("add [KINS] KINEMATICS = ..., as LinuxCNC needs it since version 2.8")
            .into());
    };
    let mut words = kins.value.split_whitespace();
    let name = words.next().unwrap_or("").to_owned();
    if same(&name, "maxkins") {
        return Err(Finding::error(
            Code::MACHINE_IMPORT,
            "maxkins is not read: its forward kinematics does not turn the offset of the pivot by C, and so does not \
             agree with its inverse",
        )
        .at(reading.sources.locate(kins.span))
        .help("describe the machine by its axes: preset = \"ht_bc_max\" with the pivot's height in [axis.B] point")
        .into());
    }
    let Some(&(_, own, usual)) = MODULES.iter().find(|(module, ..)| same(module, &name)) else {
        let known: Vec<&str> = MODULES.iter().map(|(module, ..)| *module).collect();
        return Err(Finding::error(
            Code::MACHINE_IMPORT,
            format!("the kinematics module `{name}` is not known"),
        )
        .at(reading.sources.locate(kins.span))
        .help(format!(
            "known are {}; describe another machine by its axes in a machine file",
            known.join(", ")
        ))
        .into());
    };
    // trivkins takes its letters from its own parameter only; [TRAJ] says which coordinates the interpreter has.
    let mut letters = usual.to_owned();
    for word in words {
        if let Some(given) = word.to_ascii_lowercase().strip_prefix("coordinates=") {
            letters = given.to_ascii_uppercase();
        }
    }
    let coordinates = reading.ini.take("TRAJ", "COORDINATES", "coordinates of the program");
    let coordinates: Option<String> =
        coordinates.map(|e| e.value.to_ascii_uppercase().chars().filter(|c| !c.is_whitespace()).collect());
    if own.is_empty()
        && letters == usual
        && let Some(c) = &coordinates
    {
        // Without the parameter the joints follow XYZABCUVW, without the letters that [TRAJ] does not have.
        letters = usual.chars().map(|l| if c.contains(l) { l } else { '-' }).collect();
    }
    if let Some(bad) = letters.chars().find(|c| !"XYZABCUVW-".contains(*c)) {
        return Err(wrong(reading.sources, kins.span, format!("`{bad}` is no coordinate")));
    }
    for second in ['U', 'V', 'W'] {
        if letters.contains(second) {
            reading.remarks.push(format!(
                "{second} is a second slide along a direction that the code has already; it is held at zero"
            ));
        }
    }
    let code = chosen_code(reading, own, &letters, code, kins.span)?;
    let mut machine = Machine::of_code(code);
    axes(reading, &name, &mut machine)?;
    Ok((name, machine, letters))
}

fn chosen_code(
    reading: &mut Reading<'_>,
    own: &str,
    letters: &str,
    given: Option<&CoordinateCode>,
    span: crate::base::Span,
) -> Result<CoordinateCode> {
    let needed = |code: &CoordinateCode| code.axes().find(|&axis| !letters.contains(axis));
    if !own.is_empty() {
        let own = CoordinateCode::parse(own)?;
        if let Some(lacking) = needed(&own) {
            let text = format!("the module needs coordinate {lacking}, which its coordinates {letters} lack");
            return Err(wrong(reading.sources, span, text));
        }
        return match given {
            Some(code) if code.word() != own.word() => {
                Err(Finding::error(Code::MACHINE_CODE, format!("the module's chain is {own}, not {code}"))
                    .help("a code beside such a module may only move the bed (0)")
                    .into())
            }
            Some(code) => Ok(code.clone()),
            None => Ok(own),
        };
    }
    let rotary: Vec<char> = "ABC".chars().filter(|&c| letters.contains(c)).collect();
    match given {
        Some(code) => match needed(code) {
            Some(lacking) => Err(Finding::error(
                Code::MACHINE_CODE,
                format!("code {code} has {lacking}, the configuration has not"),
            )
            .help(format!("its coordinates are {}", letters.replace('-', "")))
            .into()),
            None => Ok(code.clone()),
        },
        None if rotary.is_empty() => {
            reading.missing("which slide carries which", "2103; it matters for drawings only");
            CoordinateCode::parse("2103")
        }
        None => Err(Finding::error(
            Code::MACHINE_IMPORT,
            "trivkins tells the letters of the axes only, not which carries which",
        )
        .at(reading.sources.locate(span))
        .help("give the code too, from workpiece to tool: --code 641203")
        .into()),
    }
}

/// Directions, points and senses.
fn axes(reading: &mut Reading<'_>, name: &str, machine: &mut Machine) -> Result<()> {
    let unit = units(reading)?.length;
    let place = |machine: &mut Machine, letter: char, point: DVec3, sense: f64| {
        if let Some(joint) = machine.joints.iter_mut().find(|j| j.letter == letter) {
            joint.point = point;
            joint.sense = sense;
        }
    };
    if same(name, "xyzac-trt-kins") || same(name, "xyzbc-trt-kins") || same(name, "xyzab_tdr_kins") {
        let tdr = same(name, "xyzab_tdr_kins");
        let tilt = if same(name, "xyzbc-trt-kins") { 'B' } else { 'A' };
        let table = if tdr { 'B' } else { 'C' };
        let mut rotation_point = DVec3::ZERO;
        for (pin, component) in
            ["x-rot-point", "y-rot-point", "z-rot-point"].iter().zip(rotation_point.as_mut())
        {
            *component = reading.pin(name, pin, 0.0, "rotation point")? * unit;
        }
        let mut offset = DVec3::ZERO;
        match (tdr, tilt) {
            (false, 'A') => {
                offset.y = reading.pin(name, "y-offset", 0.0, "offset of the tilting axis in Y")?
            }
            (false, _) => offset.x = reading.pin(name, "x-offset", 0.0, "offset of the tilting axis in X")?,
            _ => {}
        }
        offset.z = reading.pin(name, "z-offset", 0.0, "offset of the tilting axis in Z")?;
        let conventional =
            tdr || reading.pin(name, "conventional-directions", 0.0, "sense of the rotary axes")? != 0.0;
        let sense = if conventional { 1.0 } else { -1.0 };
        if !conventional {
            reading.remarks.push(format!(
                "{tilt} and {table} count against ISO 841 (conventional-directions is 0, the module's default)"
            ));
        }
        place(machine, table, rotation_point, sense);
        place(machine, tilt, rotation_point + offset * unit, sense);
    } else if same(name, "5axiskins") {
        // 250 is the module's own default, in the units of the machine.
        let pivot = DVec3::Z * reading.pin(name, "pivot-length", 250.0, "pivot length")? * unit;
        place(machine, 'C', pivot, 1.0);
        place(machine, 'B', pivot, -1.0);
        reading.remarks.push("B counts against ISO 841, as the module has it".to_owned());
    } else if same(name, "xyzacb_trsrn") {
        let pin = |reading: &mut Reading<'_>, pin: &str, what: &str| reading.pin(name, pin, 0.0, what);
        let y_pivot = pin(reading, "y-pivot", "offset of the nutating axis in Y")? * unit;
        let z_pivot = pin(reading, "z-pivot", "height of the nutating axis")? * unit;
        let x_offset = pin(reading, "x-offset", "offset of C in X")? * unit;
        let y_offset = pin(reading, "y-offset", "offset of C in Y")? * unit;
        let y_table = pin(reading, "y-rot-axis", "place of the table's axis in Y")? * unit;
        let z_table = pin(reading, "z-rot-axis", "place of the table's axis in Z")? * unit;
        let angle = pin(reading, "nut-angle", "angle of the nutating axis")?;
        if !(angle.abs() > 0.0 && angle.abs() < 180.0) {
            return Err(Finding::error(
                Code::MACHINE_IMPORT,
                "the nutating axis lies along C: nut-angle is not set",
            )
            .value(angle, "deg")
            .bound(0.0, "deg")
            .help("set the pin nut-angle of the module in a HAL file, and name the file")
            .into());
        }
        place(machine, 'A', DVec3::new(0.0, y_table, z_table), 1.0);
        place(machine, 'C', DVec3::new(x_offset, y_offset + y_pivot, 0.0), 1.0);
        place(machine, 'B', DVec3::new(0.0, y_pivot, z_pivot), 1.0);
        let (sin, cos) = angle.to_radians().sin_cos();
        if let Some(nutating) = machine.joints.iter_mut().find(|j| j.letter == 'B') {
            nutating.direction = DVec3::new(0.0, sin, cos);
        }
    }
    for pin in ["tool-offset", "tool-offset-z"] {
        if reading.hal.take(name, pin, "length of the tool").is_some() {
            reading.remarks.push("the tool's length is part of the tool here, not of the machine".to_owned());
        }
    }
    Ok(())
}
