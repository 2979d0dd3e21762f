//! A program rebuilt for another control: registers by the other control's order, everything else as it is.

use crate::base::{Code, Finding, Result};
use crate::job::external::registers::first_in_z;
use crate::nc::Control;
use crate::program::{Blend, Comp, ControlData, Item, OWN_REGISTERS, Program, State, ToolNumber};

/// A program with the registers of another control, and what was found on the way: the item and the finding.
#[derive(Debug)]
pub(crate) struct Reworked {
    pub(crate) program: Program,
    /// Values of radius registers under their new numbers [mm].
    pub(crate) radii: Vec<(u32, f64)>,
    pub(crate) findings: Vec<(u32, Finding)>,
}

/// Gives the registers of a program the numbers that another control uses for the same thing: the tool's own register, and
/// that of its wear. The second, where it gets another number, and a register that is neither, which keeps its number, are
/// reported.
///
/// # Errors
/// None but those of cycles, which the program already has.
pub(crate) fn rework(source: &Program, radii: &[(u32, f64)], from: Control, to: Control) -> Result<Reworked> {
    let mut program = Program::new(source.setups.clone());
    for frame in &source.frames {
        program.add_frame(*frame);
    }
    let mut done = Reworked { program: Program::default(), radii: Vec::new(), findings: Vec::new() };
    let mut tool = None;
    let mut told: Vec<(Option<ToolNumber>, u32)> = Vec::new();
    let mut without_lengths = false;
    for index in 0..source.items.len() {
        let mut number = |register: u32, tool: Option<ToolNumber>| {
            let (new, order) = register_on(to, from, tool, register);
            let of = tool.filter(|_| order == Order::Wear);
            if let Some(finding) =
                moved(from, to, of, [register, new], order).filter(|_| !told.contains(&(of, register)))
            {
                told.push((of, register));
                done.findings.push((index as u32, finding));
            }
            if let Some((_, value)) = radii.iter().find(|(r, _)| *r == register)
                && done.radii.iter().all(|(r, _)| *r != new)
            {
                done.radii.push((new, *value));
            }
            new
        };
        let mut state: State = *source.state(index);
        state.comp = match state.comp {
            Comp::Off => Comp::Off,
            Comp::Left(register) => Comp::Left(number(register, tool)),
            Comp::Right(register) => Comp::Right(number(register, tool)),
        };
        state.blend = blend_on(to, state.blend);
        let origin = source.origin(index);
        match source.items.get(index) {
            Item::Move(motion) => program.push_move(motion, &state, origin),
            Item::Cycle(cycle, _) => program.push_cycle(*cycle, &state, origin)?,
            Item::Tool { id, length, radius, again } => {
                tool = Some(id);
                let mut of = |r: Option<u32>| r.map(|r| number(r, tool));
                // A tool that does not move in Z before its length is called may as well be called with it.
                let called = length.or_else(|| length_to_come(source, index, id));
                let (mut length, radius) = (of(called), of(radius));
                if !to.has_lengths() {
                    if length.is_some() && from.has_lengths() && !without_lengths {
                        without_lengths = true;
                        done.findings.push((index as u32, no_lengths(to)));
                    }
                    // Placeholder for the tool itself on that control.
                    length = Some(to.length_register(id));
                }
                program.push_tool(id, length, radius, &state, origin);
                if again {
                    program.change_again();
                }
            }
            Item::Dwell(seconds) => program.push_dwell(seconds, &state, origin),
            Item::Stop(kind) => program.push_stop(kind, &state, origin),
            Item::Text(text) => program.push_text(text, &state, origin),
            Item::Message(text) => program.push_message(text, &state, origin),
            Item::Data(ControlData::LengthCall { register }) => {
                if to.has_lengths() {
                    let register = register.map(|register| number(register, tool));
                    program.push_data(ControlData::LengthCall { register }, &state, origin);
                } else if !without_lengths {
                    without_lengths = true;
                    done.findings.push((index as u32, no_lengths(to)));
                }
            }
            Item::Data(data) => program.push_data(data, &state, origin),
        }
    }
    done.program = program;
    Ok(done)
}

/// A program that calls a length, for a control that has none.
fn no_lengths(to: Control) -> Finding {
    let what = format!("{} has no tool lengths to call", to.title());
    Finding::warning(Code::TRANSLATED, what).help("set the zero of Z with each tool")
}

/// The passage between moves that is written for a control where a program asks for another: klartext has no exact stop.
pub(crate) fn blend_on(to: Control, wanted: Blend) -> Blend {
    match (to, to.blend(wanted)) {
        (Control::Heidenhain, Blend::Stop | Blend::Exact) => Blend::Continuous,
        (_, blend) => blend,
    }
}

/// The length with which the same tool is called next, if it does not move in Z before.
fn length_to_come(program: &Program, call: usize, tool: ToolNumber) -> Option<u32> {
    if first_in_z(program, call).is_some() {
        return None;
    }
    (call + 1..program.items.len()).find_map(|i| match program.items.get(i) {
        // One that the program makes is made behind the call.
        Item::Tool { id, length, .. } => Some(length.filter(|length| id == tool && *length < OWN_REGISTERS)),
        _ => None,
    })?
}

/// A finding about a register that is not the tool's own: `of` the tool, where its number depends on that; its numbers on
/// both controls.
fn moved(
    from: Control,
    to: Control,
    of: Option<ToolNumber>,
    [old, new]: [u32; 2],
    order: Order,
) -> Option<Finding> {
    let (here, there) = (from.title(), to.title());
    let (what, help) = match order {
        _ if from == to => return None,
        // The writer refuses it, or says that the control has no lengths.
        _ if old >= OWN_REGISTERS => return None,
        Order::Kept => (
            format!("register {old} is not the tool's own on {here}: it keeps its number on {there}"),
            "check what stands in this register on the other machine".to_owned(),
        ),
        Order::Wear if old != new => {
            let tool = of.map_or_else(String::new, |tool| format!(" of {tool}"));
            (
                format!("register {old}{tool} on {here} is called as register {new} on {there}"),
                format!("put what register {old} holds into register {new} of the other machine"),
            )
        }
        Order::Own | Order::Wear => return None,
    };
    Some(Finding::warning(Code::REGISTER, what).help(help))
}

/// Place of a register in the order of a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    /// The tool's own.
    Own,
    /// The one that kinecut takes for the wear of the tool: others may use it for anything.
    Wear,
    /// Neither: its number stays.
    Kept,
}

/// The register of another control that replaces this one.
fn register_on(to: Control, from: Control, tool: Option<ToolNumber>, register: u32) -> (u32, Order) {
    match tool {
        Some(tool) if register == from.length_register(tool) => (to.length_register(tool), Order::Own),
        Some(tool) if register == from.wear_register(tool) => (to.wear_register(tool), Order::Wear),
        _ => (register, Order::Kept),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tools_own_register_is_called_by_its_number_on_the_other_control() {
        let tool = Some(ToolNumber(7));
        let on = |to, from, register| register_on(to, from, tool, register);
        assert_eq!(on(Control::Sinumerik840d, Control::Fanuc, 7), (1, Order::Own));
        assert_eq!(on(Control::Fanuc, Control::Heidenhain, 1), (7, Order::Own));
        assert_eq!(on(Control::LinuxCnc, Control::Sinumerik840d, 2), (107, Order::Wear));
        assert_eq!(on(Control::LinuxCnc, Control::Fanuc, 12), (12, Order::Kept));
    }
}
