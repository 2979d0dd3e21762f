//! Facts about the program of a setup that are asked for often: found out once, at the first question.

use std::sync::OnceLock;

/// Answers that were found out.
#[derive(Debug, Default)]
pub(crate) struct Known {
    /// Lines of the text by the items of the plan that they were written for.
    pub(crate) lines: OnceLock<Firsts>,
    /// Items of the text by the items of the plan.
    pub(crate) items: OnceLock<Firsts>,
}

/// An index of a list of numbers: the place of the first that reaches a number, for lists that mostly ascend.
#[derive(Debug, Default)]
pub(crate) struct Firsts {
    /// Each number that is above all before it, with its index; both ascend.
    steps: Vec<(u32, u32)>,
}

impl Known {
    /// The first line, 0-based, that was written for an item of the plan; `written_for`: for each line its planned item.
    pub(crate) fn line_of(&self, written_for: &[Option<u32>], item: u32) -> Option<u32> {
        // Items are written in their order, so their lines ascend; lines without an item count as the item before.
        let lines = self.lines.get_or_init(|| Firsts::of(written_for.iter().copied()));
        let (line, first) = lines.reaching(item)?;
        (first == item).then_some(line)
    }
}

impl Firsts {
    /// Of a list; entries without a number count as reaching nothing.
    pub(crate) fn of(values: impl IntoIterator<Item = Option<u32>>) -> Firsts {
        let mut steps: Vec<(u32, u32)> = Vec::new();
        for (index, value) in values.into_iter().enumerate() {
            if let Some(value) = value.filter(|v| steps.last().is_none_or(|(last, _)| v > last)) {
                steps.push((value, index as u32));
            }
        }
        Firsts { steps }
    }

    /// The index of the first entry that is not below a number, and that entry.
    pub(crate) fn reaching(&self, number: u32) -> Option<(u32, u32)> {
        let at = self.steps.partition_point(|(value, _)| *value < number);
        self.steps.get(at).map(|&(value, index)| (index, value))
    }
}

#[cfg(test)]
mod tests {
    use super::Firsts;

    #[test]
    fn the_first_entry_that_reaches_a_number_is_found_in_any_list() {
        for list in [
            vec![None, Some(0), Some(2), None, Some(2), Some(5), Some(3), None, Some(9)],
            vec![Some(4), Some(1), None, Some(4), Some(7)],
            vec![None],
            vec![],
        ] {
            let firsts = Firsts::of(list.iter().copied());
            for number in 0..12 {
                let at = list.iter().position(|v| v.is_some_and(|v| v >= number));
                let expected = at.map(|i| (i as u32, list[i].unwrap_or_default()));
                assert_eq!(firsts.reaching(number), expected, "{number} in {list:?}");
            }
        }
    }
}
