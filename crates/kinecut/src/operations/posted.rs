//! The program of a setup as it was posted and read back, beside the plan that it was written from.

use super::known::{Firsts, Known};
use super::{Clamping, Milling};
use crate::geom::Rigid;
use crate::program::Program;
use crate::trace::Trace;

/// A posted program and its plan, as operations see them.
#[derive(Clone, Copy, Debug)]
pub struct PostedPlan<'a> {
    /// Index of the setup.
    pub index: usize,
    /// The clamping.
    pub clamping: &'a Clamping,
    /// The plan.
    pub planned: &'a Program,
    /// The plan on the machine.
    pub plan_trace: &'a Trace,
    /// The text as the control reads it.
    pub program: &'a Program,
    /// The text on the machine.
    pub trace: &'a Trace,
    /// For each item of `program` its line in the text, 0-based.
    pub lines: &'a [Option<u32>],
    /// For each line of the text the planned item that it was written for.
    pub(crate) written_for: &'a [Option<u32>],
    /// Facts about it that were asked for already.
    pub(crate) known: &'a Known,
}

impl PostedPlan<'_> {
    /// The planned item for which an item of the text was written.
    pub fn planned_item(&self, item: u32) -> Option<u32> {
        let line = self.lines.get(item as usize).copied().flatten()?;
        self.written_for.get(line as usize).copied().flatten()
    }

    /// The first line of the text, 0-based, that was written for an item of the plan.
    pub fn line_of_planned(&self, item: u32) -> Option<u32> {
        self.known.line_of(self.written_for, item)
    }

    /// The first item of the text that was written for this item of the plan or a later one.
    pub(crate) fn item_after_planned(&self, item: u32) -> Option<u32> {
        let all = || (0..self.program.items.len() as u32).map(|i| self.planned_item(i));
        let items = self.known.items.get_or_init(|| Firsts::of(all()));
        items.reaching(item).map(|(of_text, _)| of_text)
    }

    /// Maps part coordinates into the work offset, with the part as the plan has turned it.
    pub(crate) fn to_work(self) -> Rigid {
        let part = self.planned.setups.first().map_or(self.clamping.setup.part_on_table, |s| s.part_on_table);
        self.clamping.work().inverse().after(&part)
    }

    /// Maps coordinates of an operation's work offset or plane into those of the part.
    pub(crate) fn to_part(self, milling: &Milling) -> Rigid {
        self.clamping.to_operation(milling).inverse()
    }
}
