//! Elements of a chain: an elementary motion with its law.

use std::fmt;

use super::super::{Elementary, Word};
use crate::machine::formula::Expression;

/// A link of a chain: an elementary motion by the value of a law [mm or rad], which is a constant, a variable of the
/// surface, or a formula of variables and parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainElement {
    /// The motion.
    pub motion: Elementary,
    /// Its value [mm or rad].
    pub law: Expression,
}

impl ChainElement {
    /// A link.
    pub fn new(motion: Elementary, law: Expression) -> ChainElement {
        ChainElement { motion, law }
    }

    /// True if the law contains this name.
    pub fn has(&self, name: &str) -> bool {
        self.law.has(name)
    }
}

/// As read by [`super::parse_chain`]: `5(-alpha)`.
impl fmt::Display for ChainElement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}({})", self.motion, self.law)
    }
}

/// The motions of a chain without their laws.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::surface::{parse_chain, word};
/// assert_eq!(word(&parse_chain("6(phi) 1(R) 5(-alpha) 3(z)").unwrap()).to_string(), "6153");
/// ```
pub fn word(chain: &[ChainElement]) -> Word {
    Word(chain.iter().map(|element| element.motion).collect())
}

/// A chain as text, as [`super::parse_chain`] reads it; `-` if it is empty.
pub fn chain_text(chain: &[ChainElement]) -> String {
    if chain.is_empty() {
        return "-".to_owned();
    }
    chain.iter().map(ChainElement::to_string).collect::<Vec<_>>().join(" ")
}
