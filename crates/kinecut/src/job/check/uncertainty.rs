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
