//! The verb `layouts`: all layouts of a code or a set of axes.

use kinecut::base::Error;
use kinecut::verbs::layouts::{LayoutWants, layout_sheet};

use crate::answers::{To, answer};
use crate::args::{Args, Layouts};

/// Runs the verb.
pub(crate) fn layouts(args: &Args, layouts: &Layouts) -> Result<u8, Error> {
    let to = To { out: layouts.out.as_deref(), svg: layouts.svg.as_deref(), ..To::default() };
    let sheet = layout_sheet(&LayoutWants {
        of: layouts.of.clone(),
        full_mobility: layouts.full,
        regular: layouts.regular,
        most_work_links: layouts.work_links,
        work_axes: layouts.work_axes.clone(),
        tool_axes: layouts.tool_axes.clone(),
        kinds: layouts.kind.clone(),
        tilt: layouts.tilt,
        stroke: layouts.stroke,
        part: layouts.part,
        tool_length: layouts.tool_length,
        stacking: layouts.stacking,
        spindle: layouts.spindle.clone(),
        quarter_turns_are_one: layouts.quarter_turns,
        weights: layouts.weight.clone(),
        show: layouts.show,
    })?;
    answer(args, to, sheet)
}
