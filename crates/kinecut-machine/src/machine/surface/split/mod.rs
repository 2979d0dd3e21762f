//! Redistributions of a surface's motions between machine and tool.
//!
//! Every set of elements that can be brought to the tool end of the chain may become the tool. A variable that machine
//! and tool would share is refused, because the tool would not be rigid. The machine's elements are forming (the law
//! has a variable) or setting (constant); forming elements with a common variable are linked.

mod filters;
mod links;
mod process;
mod setup;
mod tool;

pub use filters::filters;
pub use links::{LinkKind, LinkedMotion};
pub use setup::{Candidate, ContactEffect, Retreat, SetupMotion, Source};
pub use tool::ToolKind;

use super::{ChainElement, GeneratedSurface, ShapeFunction, word};
use crate::base::Result;
use crate::machine::{Elementary, Word};

/// Fineness of the search for the worst point of contact of a split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SplitOptions {
    /// Samples of each variable of a contact.
    pub samples: usize,
    /// True if the worst point of contact is searched between the samples.
    pub refine: bool,
}

impl Default for SplitOptions {
    fn default() -> SplitOptions {
        SplitOptions { samples: 17, refine: true }
    }
}

/// One redistribution of the chain of a surface between machine and tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Split {
    /// Rising indices in the chain of the elements that the tool has.
    pub in_tool: Vec<usize>,
    /// The machine's part of the chain, from the work on.
    pub machine: Vec<ChainElement>,
    /// The tool's part of the chain, to the point of the surface.
    pub tool: Vec<ChainElement>,
    /// Motions of the machine whose laws have a variable.
    pub forming: Vec<Elementary>,
    /// Motions of the machine that are constant.
    pub setting: Vec<Elementary>,
    /// Variables of the machine's part, sorted.
    pub machine_variables: Vec<String>,
    /// Variables of the tool's part, sorted.
    pub tool_variables: Vec<String>,
    /// Linked motions of the machine, by their variables.
    pub links: Vec<LinkedMotion>,
    /// Constant elements of the tool: dimensions ground into it. Empty if the split is refused.
    pub built_in: Vec<ChainElement>,
    /// The tool; `None` if the split is refused, because the tool would not be rigid.
    pub tool_kind: Option<ToolKind>,
    /// Motion by which the tool gets into its place.
    pub setup: SetupMotion,
    /// Name of the process; empty if the split is refused.
    pub process: String,
    /// Remarks in addition to the name; the reason if the split is refused.
    pub remarks: Vec<String>,
}

impl Split {
    /// Code of the machine.
    pub fn machine_code(&self) -> Word {
        word(&self.machine)
    }

    /// Code of the tool.
    pub fn tool_code(&self) -> Word {
        word(&self.tool)
    }

    /// True if it can be done with a rigid tool.
    pub fn is_valid(&self) -> bool {
        self.tool_kind.is_some()
    }

    /// True if the tool takes just the end of the chain.
    pub fn is_suffix(&self) -> bool {
        let length = self.machine.len() + self.tool.len();
        self.in_tool.iter().copied().eq(length - self.in_tool.len()..length)
    }
}

impl GeneratedSurface {
    /// All redistributions between machine and tool, those with few elements in the tool first.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::{GeneratedSurface, ToolKind};
    /// let splits = GeneratedSurface::named("cone").unwrap().splits().unwrap();
    /// let codes: Vec<String> = splits.iter().map(|s| s.machine_code().to_string()).collect();
    /// assert_eq!(codes, ["6153", "615", "61", "6", ""]);
    /// let edge = &splits[2]; // the edge angle is ground into the tool
    /// assert_eq!(edge.tool_kind, Some(ToolKind::StraightEdge));
    /// assert_eq!(edge.setup.chosen.unwrap().retreat.to_string(), "+1");
    /// assert!((edge.setup.chosen.unwrap().margin - 0.35_f64.cos()).abs() < 1e-9);
    /// ```
    ///
    /// # Errors
    /// Those of [`GeneratedSurface::check`].
    pub fn splits(&self) -> Result<Vec<Split>> {
        self.splits_with(&SplitOptions::default())
    }

    /// All redistributions, looked at as closely as the options say.
    ///
    /// # Errors
    /// Those of [`GeneratedSurface::check`].
    pub fn splits_with(&self, options: &SplitOptions) -> Result<Vec<Split>> {
        self.check()?;
        let chain = self.chain();
        let shape = self.compiled()?;
        filters(&chain).into_iter().map(|in_tool| self.split(&chain, &shape, in_tool, options)).collect()
    }

    fn split(
        &self,
        chain: &[ChainElement],
        shape: &ShapeFunction,
        in_tool: Vec<usize>,
        options: &SplitOptions,
    ) -> Result<Split> {
        let part = |tool: bool| {
            let chosen = chain.iter().enumerate().filter(|(i, _)| in_tool.contains(i) == tool);
            chosen.map(|(_, e)| e.clone()).collect::<Vec<ChainElement>>()
        };
        let (machine, tool) = (part(false), part(true));
        let variables = |elements: &[ChainElement]| {
            let used =
                self.variables.iter().map(|v| v.name.clone()).filter(|n| elements.iter().any(|e| e.has(n)));
            let mut used: Vec<String> = used.collect();
            used.sort();
            used
        };
        let motions = |forming: bool| {
            machine.iter().filter(|e| self.is_forming(e) == forming).map(|e| e.motion).collect::<Vec<_>>()
        };
        let machine_variables = variables(&machine);
        let mut split = Split {
            forming: motions(true),
            setting: motions(false),
            links: links::links(self, &machine, &machine_variables),
            tool_variables: variables(&tool),
            machine_variables,
            in_tool,
            machine,
            tool,
            built_in: Vec::new(),
            tool_kind: None,
            setup: SetupMotion { needed: false, candidates: Vec::new(), chosen: None, sliding: None },
            process: String::new(),
            remarks: Vec::new(),
        };
        if let Some(shared) = split.machine_variables.iter().find(|v| split.tool_variables.contains(v)) {
            let why =
                format!("machine and tool would share the variable {shared}: the tool would not be rigid");
            split.remarks.push(why);
            return Ok(split);
        }
        let has = [0, 1].map(|k| split.tool_variables.contains(&self.variables[k].name));
        split.tool_kind = Some(tool::kind(self, &ShapeFunction::new(self, &split.tool)?, has));
        split.built_in = split.tool.iter().filter(|e| !self.is_forming(e)).cloned().collect();
        split.setup = setup::setup(self, shape, &split.machine, has, options)?;
        split.process = process::process(&split);
        split.remarks = process::remarks(self, &split);
        Ok(split)
    }
}
