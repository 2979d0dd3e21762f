//! Programs with variables, branches, loops and calls: what they do is what their control does.

use kinecut_nc::base::Sources;
use kinecut_nc::nc::{self, Control, Reading};
use kinecut_nc::program::{Item, Path, Speed, Target};

mod controls;
mod data;
mod fanuc_corners;
mod fanuc_cycles;
mod fanuc_modal_macro;
mod fanuc_modes;
mod fanuc_offsets;
mod fanuc_round_trip;
mod fanuc_scaling;
mod haas_patterns;
mod haas_pockets;
mod hostile;
mod linuxcnc;
mod linuxcnc_threads;
mod macro_b;
mod passing;
mod plain;
mod state;

/// Reads a program; the error as it is shown.
fn read(text: &str, control: Control) -> Result<Reading, String> {
    nc::read(&mut Sources::default(), "a.nc", text, control, &[]).map_err(|e| e.to_string())
}

/// Ends of all moves and holes, rapids marked `R`, feed moves `F`, holes `H`.
fn moves(reading: &Reading) -> Vec<String> {
    let items = &reading.program.items;
    let mut at = [f64::NAN; 3];
    let mut said = Vec::new();
    for i in 0..items.len() {
        match items.get(i) {
            Item::Move(motion) => {
                let Target::Tip { point, .. } = motion.end else { continue };
                at = point.to_array();
                let rapid = matches!(reading.program.state(i).speed, Speed::Rapid { .. });
                let kind = if rapid { "R" } else { "F" };
                let arc = if matches!(motion.path, Path::Arc { .. }) { " arc" } else { "" };
                said.push(format!("{kind} {}{arc}", shown(at)));
            }
            Item::Cycle(cycle, _) => {
                let [reference, bottom, retract] = cycle.heights();
                said.push(format!("H {} {} {}", number(reference), number(bottom), number(retract)));
                at[2] = retract;
            }
            _ => {}
        }
    }
    said
}

fn number(value: f64) -> String {
    let rounded = (value * 1e4).round() / 1e4;
    if rounded.is_nan() { "?".to_owned() } else { (rounded + 0.0).to_string() }
}

fn shown(at: [f64; 3]) -> String {
    at.map(number).join(" ")
}

/// The moves of a program in millimetres, from a known place.
fn run(body: &str, control: Control) -> Vec<String> {
    let start = if matches!(control, Control::Fanuc | Control::Haas) {
        "G21 G54 G0 X0. Y0. Z0.\n"
    } else {
        "G21 G54 G0 X0 Y0 Z0\n"
    };
    let reading = read(&format!("{start}{body}\nM30\n"), control).unwrap_or_else(|e| panic!("{e}"));
    moves(&reading).split_off(1)
}

/// The error of such a program.
fn refused(body: &str, control: Control) -> String {
    let start = if matches!(control, Control::Fanuc | Control::Haas) {
        "G21 G54 G0 X0. Y0. Z0.\n"
    } else {
        "G21 G54 G0 X0 Y0 Z0\n"
    };
    read(&format!("{start}{body}\nM30\n"), control).expect_err(body)
}
