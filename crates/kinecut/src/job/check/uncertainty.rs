//! Distances by which zeros, tool lengths and the raw stock may be off.

use crate::base::Result;
use crate::base::bounded::length;
use crate::job::file::UncertaintyTable;

/// Most that a zero or a length may be off [mm]: more is another setup.
const MOST_OFF: f64 = 10.0;

/// Most that the raw stock may be larger on each side [mm].
const MOST_STOCK: f64 = 100.0;

/// Distances by which a person may be off when the programs run; contacts are looked for over their whole range.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Uncertainty {
    /// The zero of a setup, in any direction [mm].
    pub offset: f64,
    /// The length of each tool, up or down [mm].
    pub length: f64,
    /// The raw stock, larger by so much on each side [mm].
    pub stock: f64,
}

impl Uncertainty {
    /// Checked, with the key under which each is given.
    ///
    /// # Errors
    /// `KC0103` for one that is negative, or too large.
    pub(in crate::job) fn checked(self, key: &str) -> Result<Uncertainty> {
        let of = |name: &str, value: f64, most: f64| length(&format!("{key}.{name}"), value, 0.0, most);
        Ok(Uncertainty {
            offset: of("offset", self.offset, MOST_OFF)?,
            length: of("length", self.length, MOST_OFF)?,
            stock: of("stock", self.stock, MOST_STOCK)?,
        })
    }

    pub(super) fn of(table: &UncertaintyTable) -> Result<Option<Uncertainty>> {
        let UncertaintyTable { offset, length, stock } = *table;
        let one = Uncertainty { offset, length, stock }.checked("simulate.uncertainty")?;
        Ok(one.is_any().then_some(one))
    }

    /// Whether anything may be off.
    pub fn is_any(&self) -> bool {
        self.offset > 0.0 || self.length > 0.0 || self.stock > 0.0
    }

    /// Distance of a tool from where a program has it, at most, against bodies that stand [mm].
    pub fn of_tool(&self) -> f64 {
        self.offset + self.length
    }

    /// The same against the faces of the raw stock [mm].
    pub fn of_raw(&self) -> f64 {
        self.offset + self.length + self.stock
    }

    /// The message of a contact as that of one that may be: "the holder may meet `clamp`, with zeros ±0.05 mm".
    pub(in crate::job) fn possible(&self, message: &str) -> String {
        const VERBS: [[&str; 2]; 6] = [
            [" is ", " may be "],
            [" goes ", " may go "],
            [" turns ", " may turn "],
            [" cuts ", " may cut "],
            [" meets ", " may meet "],
            [" comes ", " may come "],
        ];
        // The first verb of the sentence; that of a clause within it stays.
        let within = message.find("which does not cut").map_or(0, |at| at + "which does not cut".len());
        let first =
            |[verb, may]: [&'static str; 2]| Some((message[within..].find(verb)? + within, verb, may));
        let text = match VERBS.into_iter().filter_map(first).min_by_key(|(at, ..)| *at) {
            Some((at, verb, may)) => format!("{}{may}{}", &message[..at], &message[at + verb.len()..]),
            None => message.to_owned(),
        };
        format!("{text}, with {}", self.words())
    }

    /// The same against any face of the stock that is left [mm]: setups and tools before leave one as much off again.
    pub fn of_stock(&self) -> f64 {
        2.0 * self.of_tool() + self.stock
    }

    /// In words: "zeros ±0.05 mm, tool lengths ±0.02 mm, raw stock +0.5 mm".
    pub fn words(&self) -> String {
        let parts = [
            ("zeros \u{b1}", self.offset),
            ("tool lengths \u{b1}", self.length),
            ("raw stock +", self.stock),
        ];
        let given = parts.iter().filter(|(_, value)| *value > 0.0);
        let parts: Vec<String> = given.map(|(what, value)| format!("{what}{value} mm")).collect();
        parts.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contact_that_may_be_is_said_to_be_one() {
        let off = Uncertainty { offset: 0.05, length: 0.0, stock: 0.5 };
        for (certain, possible) in [
            ("a rapid move goes through stock", "a rapid move may go through stock"),
            (
                "the nose of the tool, which does not cut, meets stock",
                "the nose of the tool, which does not cut, may meet stock",
            ),
            (
                "the tool cuts while the spindle stands still",
                "the tool may cut while the spindle stands still",
            ),
            ("T1 is changed for T2 inside the stock", "T1 may be changed for T2 inside the stock"),
            (
                "`head` of the machine comes where the stock was",
                "`head` of the machine may come where the stock was",
            ),
        ] {
            assert_eq!(
                off.possible(certain),
                format!("{possible}, with zeros \u{b1}0.05 mm, raw stock +0.5 mm")
            );
        }
    }
}
