//! A machine as the text of a machine file. Reading it gives the same machine, up to the last digits of angles.

use std::fmt::Write as _;

use glam::{DMat3, DVec3};

use crate::base::unit::variant_key;
use crate::geom::{Rigid, Solid};
use crate::job::check::machine::shortest;
use crate::machine::{Body, Joint, Link, Machine, OwnCode};

/// Digits of a number in a file: two fewer than a double holds, so that degrees come out as they were given.
const DIGITS: usize = 14;
/// Difference from the standard direction below which a direction is left out: rounding.
const SAME: f64 = 1e-15;

/// The text of a machine file.
pub fn machine_toml(machine: &Machine) -> String {
    let mut out = String::new();
    if !machine.name.is_empty() {
        let _ = writeln!(out, "name = {}", quoted(&machine.name));
    }
    let _ = writeln!(out, "code = \"{}\"", machine.code);
    let (d, control) = (&machine.dynamics, &machine.control);
    let mut limits = Vec::new();
    for (name, value, factor) in [
        ("rapid", d.rapid, 60.0),
        ("acceleration", d.acceleration, 1e-3),
        ("jerk", d.jerk, 1e-3),
        ("max_feed", control.max_feed, 60.0),
        ("max_speed", control.max_speed, 60.0 / std::f64::consts::TAU),
        ("spindle_power", control.spindle_power, 1e-3),
        ("spindle_torque", control.spindle_torque, 1.0),
        ("tolerance", control.tolerance, 1.0),
        ("turn_tolerance", control.turn_tolerance, 1f64.to_degrees()),
        ("junction_deviation", control.junction_deviation, 1.0),
        ("servo_bandwidth", control.servo_bandwidth, 1.0),
        ("tool_change", control.tool_change, 1.0),
        ("spindle_ramp", control.spindle_ramp, 1.0),
    ] {
        limits.extend(value.map(|v| format!("{name} = {}", number(v * factor))));
    }
    limits.extend(control.interpolator.map(|i| format!("interpolator = \"{}\"", variant_key(&i))));
    if let Some(curve) = &machine.spindle_curve {
        let turns = 60.0 / std::f64::consts::TAU;
        let point = |[speed, torque]: &[f64; 2]| format!("[{}, {}]", number(speed * turns), number(*torque));
        let points: Vec<String> = curve.points().iter().map(point).collect();
        limits.push(format!("spindle_curve = [{}]", points.join(", ")));
    }
    if !limits.is_empty() {
        let _ = writeln!(out, "dynamics = {{ {} }}", limits.join(", "));
    }
    if let Some(rapids) = machine.rapids {
        let _ = writeln!(out, "rapids = \"{}\"", variant_key(&rapids));
    }
    if !machine.codes.is_empty() {
        let named = |c: &OwnCode| format!("\"{c}\" = \"{}\"", variant_key(&c.effect));
        let codes: Vec<String> = machine.codes.iter().map(named).collect();
        let _ = writeln!(out, "codes = {{ {} }}", codes.join(", "));
    }
    for joint in &machine.joints {
        axis(&mut out, joint);
    }
    let spindle = &machine.spindle;
    if *spindle != Rigid::IDENTITY {
        out.push_str("\n[spindle]\n");
        line(&mut out, "point", spindle.translation, DVec3::ZERO);
        line(&mut out, "direction", spindle.rotation.z_axis, DVec3::Z);
        let usual = shortest(spindle.rotation.z_axis);
        if (spindle.rotation.x_axis - usual.x_axis).length() > SAME {
            let _ = writeln!(out, "x = {}", vector(spindle.rotation.x_axis));
        }
    }
    if machine.work != Rigid::IDENTITY {
        out.push_str("\n[work]\n");
        line(&mut out, "point", machine.work.translation, DVec3::ZERO);
        if machine.work.rotation != DMat3::IDENTITY {
            line(&mut out, "x", machine.work.rotation.x_axis, DVec3::X);
            line(&mut out, "z", machine.work.rotation.z_axis, DVec3::Z);
        }
    }
    for body in machine.bodies.iter() {
        self::body(&mut out, machine, body);
    }
    out
}

/// A body, with all digits.
fn body(out: &mut String, machine: &Machine, body: &Body) {
    out.push_str("\n[[body]]\n");
    if !body.name.is_empty() {
        let _ = writeln!(out, "name = {}", quoted(&body.name));
    }
    let _ = writeln!(out, "link = \"{}\"", link_name(machine, body.link));
    match &body.solid {
        Solid::Box(b) => {
            let _ = writeln!(out, "box = {{ min = {}, max = {} }}", vector(b.min), vector(b.max));
        }
        Solid::Cylinder { radius, height, .. } => {
            let _ = write!(out, "cylinder = {{ base = {}", vector(body.place.translation));
            if body.place.rotation.z_axis != DVec3::Z {
                let _ = write!(out, ", axis = {}", vector(body.place.rotation.z_axis));
            }
            let _ = writeln!(out, ", diameter = {}, height = {height} }}", 2.0 * radius);
        }
        Solid::Mesh(_) => {
            let _ = writeln!(out, "mesh = {}", quoted(body.file.as_deref().unwrap_or_default()));
        }
    }
    if body.near != Body::NEAR {
        let _ = writeln!(out, "near = {}", body.near);
    }
}

/// A link as a machine file names it.
pub(crate) fn link_name(machine: &Machine, link: Link) -> String {
    match link {
        Link::Bed => "bed".to_owned(),
        Link::Axis(i) => machine.joints.get(i).map_or_else(String::new, axis_key),
    }
}

/// The key of an axis: the letter of its motion, or the digit of an inclined one.
fn axis_key(joint: &Joint) -> String {
    joint.motion.letter().map_or_else(|| joint.motion.to_string(), String::from)
}

fn axis(out: &mut String, joint: &Joint) {
    let key = axis_key(joint);
    let rotary = joint.motion.is_rotation();
    let _ = writeln!(out, "\n[axis.{key}]");
    if joint.motion.letter() != Some(joint.letter) {
        let _ = writeln!(out, "letter = \"{}\"", joint.letter);
    }
    match joint.motion.direction() {
        Some(standard) => line(out, "direction", joint.direction, standard),
        None => {
            let _ = writeln!(out, "direction = {}", vector(joint.direction));
        }
    }
    if rotary {
        line(out, "point", joint.point, DVec3::ZERO);
    }
    if joint.sense < 0.0 {
        out.push_str("sense = -1\n");
    }
    let unit = |v: f64| if rotary { v.to_degrees() } else { v };
    if let Some([min, max]) = joint.travel {
        let _ = writeln!(out, "travel = [{}, {}]", number(unit(min)), number(unit(max)));
    }
    let d = &joint.dynamics;
    let factors = if rotary {
        [60.0 / std::f64::consts::TAU, 1f64.to_degrees(), 1f64.to_degrees()]
    } else {
        [60.0, 1e-3, 1e-3]
    };
    for ((name, value), factor) in
        [("rapid", d.rapid), ("acceleration", d.acceleration), ("jerk", d.jerk)].into_iter().zip(factors)
    {
        if let Some(v) = value {
            let _ = writeln!(out, "{name} = {}", number(v * factor));
        }
    }
}

fn line(out: &mut String, key: &str, value: DVec3, usual: DVec3) {
    if (value - usual).length() > SAME {
        let _ = writeln!(out, "{key} = {}", vector(value));
    }
}

/// Components with all digits: directions are made unit vectors again when they are read.
fn vector(v: DVec3) -> String {
    let shown = v.to_array().map(|c| if c == 0.0 { "0".to_owned() } else { format!("{c}") });
    format!("[{}]", shown.join(", "))
}

/// A number with [`DIGITS`] significant digits, without zeros at its end.
fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let rounded: f64 = format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(value);
    format!("{rounded}")
}

/// A TOML string.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", c as u32);
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
