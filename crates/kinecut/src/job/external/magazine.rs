//! The tools with which a program of others is followed.

use crate::program::{Item, Program, ToolNumber};
use crate::tool::{Cutter, Tool, ToolLimits, ToothSpacing};

/// Stand-ins allowed for tools and work offsets that are not given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Missing {
    /// Nothing: tools and work offsets must be given, for the program is cut.
    Refused,
    /// Tools without body, work offsets at the place of the first: for reading and translating.
    StoodFor,
}

/// Tools, and which of them is in the spindle at the beginning.
#[derive(Clone, Debug, Default)]
pub(crate) struct Magazine {
    /// The tools.
    pub(crate) tools: Vec<Tool>,
    /// The tool in the spindle before the program calls one.
    pub(crate) in_spindle: Option<ToolNumber>,
    /// Tools that were called and not given.
    pub(crate) stand_ins: Vec<ToolNumber>,
    /// Assumptions that had to be made, in words.
    pub(crate) assumed: Vec<String>,
}

/// Number of the stand-in for a tool that is never called.
const NO_TOOL: ToolNumber = ToolNumber(0);

impl Magazine {
    /// The magazine for a program.
    pub(crate) fn of(
        given: &[Tool],
        program: &Program,
        in_spindle: Option<ToolNumber>,
        missing: Missing,
    ) -> Magazine {
        let mut magazine = Magazine { tools: given.to_vec(), in_spindle, ..Magazine::default() };
        let items = program.items.few();
        let mut called: Vec<ToolNumber> = items
            .filter_map(|i| if let Item::Tool { id, .. } = program.items.get(i) { Some(id) } else { None })
            .collect();
        called.sort_unstable();
        called.dedup();
        if let (None, true, [tool]) = (in_spindle, called.is_empty(), given) {
            magazine.in_spindle = Some(tool.number);
            magazine.assumed.push(format!("the program calls no tool: {} is in the spindle", tool.number));
        }
        if missing == Missing::Refused {
            return magazine;
        }
        let not_given = called.into_iter().filter(|n| given.iter().all(|t| t.number != *n));
        magazine.stand_ins = not_given.collect();
        if !magazine.stand_ins.is_empty() {
            let names: Vec<String> = magazine.stand_ins.iter().map(ToString::to_string).collect();
            let names = names.join(", ");
            magazine.assumed.push(format!("{names}: not given, taken without length and radius"));
        }
        let stands = magazine.stand_ins.iter().copied().map(stand_in);
        magazine.tools.extend(stands);
        if magazine.in_spindle.is_none() {
            if magazine.tools.iter().all(|t| t.number != NO_TOOL) {
                magazine.tools.push(stand_in(NO_TOOL));
            }
            magazine.in_spindle = Some(NO_TOOL);
        }
        magazine
    }
}

/// A tool of no size: its path is followed, it cuts nothing.
fn stand_in(number: ToolNumber) -> Tool {
    Tool {
        number,
        name: "not given".to_owned(),
        cutter: Cutter::EndMill { diameter: 0.0 },
        teeth: 1,
        spacing: ToothSpacing::default(),
        flute_length: 0.0,
        stickout: 0.0,
        shank_diameter: 0.0,
        holder: None,
        centre_cutting: true,
        max_ramp_angle: None,
        gauge_length: None,
        limits: ToolLimits::default(),
        elasticity: None,
    }
}
