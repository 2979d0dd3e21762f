//! The verb `kinecut verify`: does a verdict still hold?

use super::Answer;
use crate::base::Finding;
use crate::job::VerdictCheck;
use crate::page::{Block, Fact, Section};

impl Answer for VerdictCheck {
    fn sections(&self) -> Vec<Section> {
        let state = match (self.void.is_empty(), self.unknown.is_empty()) {
            (false, _) => "VOID: a file was changed after the verdict",
            (true, false) => "UNKNOWN: a file is not there",
            (true, true) => "UNCHANGED: the verdict is about these bytes",
        };
        let mut facts = vec![Fact::new("Verdict", self.sentence.as_str())];
        facts.extend(self.unchanged.iter().map(|role| Fact::new("Unchanged", role.as_str())));
        vec![Section::new(state).with(Block::Facts(facts))]
    }

    fn findings(&self) -> Vec<&Finding> {
        self.void.iter().chain(&self.unknown).collect()
    }

    fn is_no(&self) -> bool {
        !self.outcome.is_safe()
    }

    /// A change is known, whatever is missing.
    fn parts(&self) -> [usize; 2] {
        [1, usize::from(self.void.is_empty() && !self.unknown.is_empty())]
    }
}
