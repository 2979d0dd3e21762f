//! Values of the registers that a program calls, and findings about those that are not of the tool in the spindle.
//!
//! A tool that is called with the length of another one is the classic crash: the control lifts it by the wrong length. The
//! simulation does the same where both lengths are known.

use std::collections::{HashMap, HashSet};

use super::super::check::{Job, JobProgram, JobSetup};
use crate::base::{Code, Finding, Location};
use crate::nc::{Control, Reading};
use crate::program::{Comp, ControlData, Item, OWN_REGISTERS, Program, Target, ToolNumber};
use crate::tool::Tool;

/// Lengths or radii closer than this are equal [mm]: resolution of a tool presetter.
const SAME: f64 = 1e-4;

/// Values of registers for the trace, and what was found about them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Registers {
    /// Lengths that are not the tool's own.
    pub(crate) lengths: Vec<(ToolNumber, Option<u32>, f64)>,
    /// Radii.
    pub(crate) radii: Vec<(u32, f64)>,
    /// Findings about them.
    pub(crate) findings: Vec<Finding>,
}

impl Registers {
    /// The registers of a program as read; `place` gives the place of an item.
    pub(crate) fn of(
        job: &Job,
        setup: &JobSetup,
        given: &JobProgram,
        reading: &Reading,
        in_spindle: Option<ToolNumber>,
        place: impl Fn(u32) -> Option<Location>,
    ) -> Registers {
        let program = &reading.program;
        let mut found = Registers { radii: given.radii.clone(), ..Registers::default() };
        // What the program sets itself counts.
        let mut lengths = reading.lengths.clone();
        lengths.extend(&given.lengths);
        let compensated = compensated(program);
        for tool in given.kept.tools.iter().flatten() {
            lengths.push((tool.number, tool.offset[2]));
            if let Some(diameter) = tool.diameter.filter(|_| compensated.contains(&tool.number))
                && found.radii.iter().all(|(register, _)| *register != tool.number)
            {
                found.radii.push((tool.number, 0.5 * diameter));
            }
        }
        let mut of_register: HashMap<u32, f64> = lengths.iter().rev().copied().collect();
        for (own, number) in reading.own_lengths.iter().zip(OWN_REGISTERS..) {
            // Each counts from one before it.
            let of =
                |register| of_register.get(&register).map(|length| [Some(0.0), Some(0.0), Some(*length)]);
            if let [.., Some(length)] = own.offset(of) {
                of_register.insert(number, length);
                lengths.push((number, length));
            }
        }
        let mut seen: Vec<(ToolNumber, Option<u32>)> = Vec::new();
        // The tool in the spindle: a program may call a length only.
        let mut tool = job.tools.iter().find(|t| Some(t.number) == in_spindle);
        // Straight moves have no register but that of a compensation.
        let every = if program.compensates() { program.items.len() } else { 0 };
        let few = program.items.few().take(if every > 0 { 0 } else { usize::MAX });
        for index in few.chain(0..every) {
            let called = match program.items.get(index) {
                Item::Tool { id, length, .. } => Some((id, length)),
                Item::Data(ControlData::LengthCall { register }) => tool.map(|t| (t.number, register)),
                _ => None,
            };
            match program.items.get(index) {
                Item::Tool { .. } | Item::Data(ControlData::LengthCall { .. }) => {
                    let Some((id, length)) = called else { continue };
                    tool = job.tools.iter().find(|t| t.number == id);
                    let Some(tool) = tool.filter(|_| !seen.contains(&(id, length))) else { continue };
                    // The block that calls a length mostly moves Z, and is what has to be mended.
                    let first = first_in_z(program, index);
                    if length.is_none() && first.is_none() {
                        continue;
                    }
                    seen.push((id, length));
                    let held = held(job, setup, (given.control, &lengths), tool, length);
                    if let Some(held) = held {
                        found.lengths.push((id, length, held));
                    }
                    if let Some(finding) = length_finding(given.control, tool, length, held) {
                        let at = first.unwrap_or(index) as u32;
                        found.findings.push(Finding { place: place(at), ..finding });
                    }
                }
                Item::Move(_) => {
                    let (Some(tool), Comp::Left(register) | Comp::Right(register)) =
                        (tool, program.state(index).comp)
                    else {
                        continue;
                    };
                    let known = found.radii.iter().any(|(r, _)| *r == register);
                    let other = others(job, given.control, tool, register);
                    if let (false, Some(other)) = (known, other) {
                        let radius = radius(other);
                        if (radius - self::radius(tool)).abs() > SAME {
                            let finding = Finding::error(
                                Code::REGISTER,
                                format!("{} is compensated by the radius of {}", tool.number, other.number),
                            )
                            .value_mm(radius)
                            .bound_mm(self::radius(tool))
                            .help("call the register of the tool in the spindle, or give its value in the job: registers = { D1 = 5.0 }");
                            found.findings.push(Finding { place: place(index as u32), ..finding });
                        }
                        found.radii.push((register, radius));
                    }
                }
                _ => {}
            }
        }
        found
    }
}

/// The radius registers that a program calls.
fn compensated(program: &Program) -> HashSet<u32> {
    let every = if program.compensates() { program.items.len() } else { 0 };
    let register = |item| match program.state(item).comp {
        Comp::Left(register) | Comp::Right(register) => Some(register),
        Comp::Off => None,
    };
    (0..every).filter_map(register).collect()
}

/// The tool whose own register this is, if it is another one than that in the spindle.
fn others<'a>(job: &'a Job, control: Control, tool: &Tool, register: u32) -> Option<&'a Tool> {
    // Only where registers go by the numbers of the tools.
    let by_number = control.length_register(ToolNumber(register)) == register
        && control.length_register(ToolNumber(u32::MAX)) == u32::MAX;
    let other = job.tools.iter().find(|t| t.number.0 == register && t.number != tool.number);
    other.filter(|_| by_number)
}

fn radius(tool: &Tool) -> f64 {
    tool.cutter.diameter(tool.flute_length) / 2.0
}

/// The first move of Z in the coordinates of the work before the next call of a tool or length.
pub(crate) fn first_in_z(program: &Program, call: usize) -> Option<usize> {
    let next = (call + 1..program.items.len())
        .find(|i| matches!(program.items.get(*i), Item::Tool { .. }))
        .unwrap_or(program.items.len());
    (call + 1..next).find(|i| match program.items.get(*i) {
        Item::Move(motion) => matches!(motion.end, Target::Tip { point, .. } if point.z.is_finite()),
        Item::Cycle(..) => true,
        _ => false,
    })
}

/// The length that a register holds, where it is known and may differ from the tool's own [mm].
fn held(
    job: &Job,
    setup: &JobSetup,
    (control, lengths): (Control, &[(u32, f64)]),
    tool: &Tool,
    length: Option<u32>,
) -> Option<f64> {
    let Some(register) = length else {
        // No length is called if the zero was set with the tool itself; length zero counts if the work is located.
        return setup.setup.located.then_some(0.0);
    };
    if register == 0 && matches!(control, Control::Fanuc | Control::Haas) {
        // H0 cannot be set: it is length zero by definition. It counts if the work is located.
        return setup.setup.located.then_some(0.0);
    }
    let said = lengths.iter().find(|(number, _)| *number == register).map(|(_, value)| *value);
    said.or_else(|| others(job, control, tool, register).and_then(|t| t.gauge_length))
}

/// Finding about a length that is not the tool's own.
fn length_finding(control: Control, tool: &Tool, length: Option<u32>, held: Option<f64>) -> Option<Finding> {
    let own = control.length_register(tool.number);
    let number = tool.number;
    let differs = match (held, tool.gauge_length) {
        (Some(held), Some(own)) => Some((held, own)).filter(|(a, b)| (a - b).abs() > SAME),
        _ => None,
    };
    let (what, help) = match length {
        None => (
            format!("{number} moves in Z without its length"),
            format!("call it (G43 H{own}) before the first move in Z"),
        ),
        Some(register) if register == own => {
            differs?;
            (
                format!("the length register of {number} does not hold the length of the tool"),
                "measure the tool again".to_owned(),
            )
        }
        Some(register) if register >= OWN_REGISTERS => (
            format!("{number} is called with a length that the program makes (G43.1, G43.2)"),
            "give the tool that length: gauge_length".to_owned(),
        ),
        Some(0) if matches!(control, Control::Fanuc | Control::Haas) => (
            format!("{number} is called with H0, which is length zero"),
            format!("call the register of the tool: G43 H{own}"),
        ),
        Some(register) => (
            format!("{number} is called with the length of register {register}, not with its own"),
            format!(
                "call register {own}, or give the value in the job: registers = {{ H{register} = 100.0 }}"
            ),
        ),
    };
    Some(match differs {
        Some((held, own)) => Finding::error(Code::REGISTER, what).value_mm(held).bound_mm(own).help(help),
        // The same length under another number, given in the job, is the shop's own order.
        None if length.is_some() && held.is_some() && tool.gauge_length.is_some() => return None,
        // Neither the register nor the place on the machine is known: it cannot be simulated as the machine would run it.
        None => Finding::doubt(Code::REGISTER, what).help(help),
    })
}
