//! Items not checked, grouped under headings that a shop understands.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A heading of items that were not checked. Only those that apply to a program come under one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Heading {
    /// Surfaces that were not compared with anything, or could not be measured.
    Shape,
    /// Clamps, fixtures, the machine's own bodies.
    Bodies,
    /// Holders and lengths of tools that are not given.
    Tools,
    /// Travel of the axes, place on the machine.
    Travel,
    /// Moves that were not cut.
    Moves,
    /// Blocks that were read and are not followed.
    Blocks,
    /// Assumptions that had to be made.
    Assumed,
    /// Tasks of a person while the program runs.
    RegisterState,
}

impl Heading {
    /// As shown.
    pub fn title(self) -> &'static str {
        match self {
            Heading::Shape => "Shape of the part",
            Heading::Bodies => "Clamps, fixtures, machine",
            Heading::Tools => "Holders and tool lengths",
            Heading::Travel => "Travel of the axes",
            Heading::Moves => "Moves that were not cut",
            Heading::Blocks => "Blocks read, not followed",
            Heading::Assumed => "Assumed",
            Heading::RegisterState => "Left to the operator",
        }
    }
}

/// One thing that was not checked, with the lines of the program that it concerns.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct UncheckedItem {
    /// In words.
    pub what: String,
    /// The program that the lines are of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Lines of the program, from 1, ascending.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<u32>,
}

/// Things of one heading.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Unchecked {
    /// The heading.
    pub heading: Heading,
    /// Number of places: each line counts, and each item without lines.
    pub count: usize,
    /// The things, in the order in which they were noticed.
    pub items: Vec<UncheckedItem>,
}

/// Most lines that a sentence names; the JSON has all.
const NAMED: usize = 4;

impl fmt::Display for UncheckedItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "`{file}`")?;
            let named: Vec<String> = self.lines.iter().take(NAMED).map(u32::to_string).collect();
            match self.lines.len() {
                0 => {}
                1 => write!(f, " line {}", named[0])?,
                n if n > NAMED => write!(f, " lines {} and {} more", named.join(", "), n - NAMED)?,
                _ => write!(f, " lines {}", named.join(", "))?,
            }
            f.write_str(": ")?;
        }
        f.write_str(&self.what)
    }
}

/// Collects what was not checked.
#[derive(Clone, Debug, Default)]
pub(in crate::job) struct UncheckedList {
    groups: Vec<Unchecked>,
}

impl UncheckedList {
    /// Notes something about the job.
    pub(in crate::job) fn add(&mut self, heading: Heading, what: impl Into<String>) {
        self.push(heading, UncheckedItem { what: what.into(), file: None, lines: Vec::new() });
    }

    /// Notes something about lines, from 1, of a program; the same thing in other lines is one thing.
    pub(in crate::job) fn at(
        &mut self,
        heading: Heading,
        file: &str,
        lines: impl IntoIterator<Item = u32>,
        what: impl Into<String>,
    ) {
        let lines = lines.into_iter().collect();
        self.push(heading, UncheckedItem { what: what.into(), file: Some(file.to_owned()), lines });
    }

    fn push(&mut self, heading: Heading, item: UncheckedItem) {
        let group = match self.groups.iter_mut().position(|g| g.heading == heading) {
            Some(i) => &mut self.groups[i],
            None => {
                self.groups.push(Unchecked { heading, count: 0, items: Vec::new() });
                // The group just pushed.
                let last = self.groups.len() - 1;
                &mut self.groups[last]
            }
        };
        match group.items.iter_mut().find(|i| i.what == item.what && i.file == item.file) {
            Some(same) => same.lines.extend(item.lines),
            None => group.items.push(item),
        }
    }

    /// The groups in the order of their headings, lines in order.
    pub(in crate::job) fn groups(mut self) -> Vec<Unchecked> {
        for group in &mut self.groups {
            for item in &mut group.items {
                item.lines.sort_unstable();
                item.lines.dedup();
            }
            group.count = group.items.iter().map(|i| i.lines.len().max(1)).sum();
        }
        self.groups.sort_by_key(|g| g.heading);
        self.groups
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_thing_in_several_lines_is_one_thing_with_its_lines() {
        let mut list = UncheckedList::default();
        list.at(Heading::Moves, "P.nc", [9, 7], "what the tilted tool removes");
        list.add(Heading::Shape, "no design mesh given");
        list.at(Heading::Moves, "P.nc", [7, 12, 30, 31, 40], "what the tilted tool removes");
        let groups = list.groups();
        assert_eq!((groups.len(), groups[0].heading, groups[1].count), (2, Heading::Shape, 6));
        let shown = groups[1].items[0].to_string();
        assert_eq!(shown, "`P.nc` lines 7, 9, 12, 30 and 2 more: what the tilted tool removes");
        let json = serde_json::to_string(&groups[0]).unwrap();
        assert_eq!(json, r#"{"heading":"shape","count":1,"items":[{"what":"no design mesh given"}]}"#);
    }
}
