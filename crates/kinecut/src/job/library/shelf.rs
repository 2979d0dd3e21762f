//! The holders of a file in which each tool carries its own: the same one is kept once, others of its name get a number.

use std::collections::{BTreeMap, BTreeSet};

use crate::tool::{Holder, HolderSegment};

/// Holders with names of their own.
#[derive(Default)]
pub(super) struct Shelf {
    holders: Vec<Holder>,
    /// Names by the name in the file and the numbers of the segments.
    known: BTreeMap<(String, Vec<u64>), String>,
    taken: BTreeSet<String>,
    /// The number that the next holder of a name gets.
    next: BTreeMap<String, u32>,
}

impl Shelf {
    /// The name of a holder of these segments: that of one that is there, or a new one.
    pub(super) fn name(&mut self, name: &str, segments: Vec<HolderSegment>) -> String {
        let numbers = |s: &HolderSegment| [s.height, s.lower_diameter, s.upper()].map(f64::to_bits);
        let shape: Vec<u64> = segments.iter().flat_map(numbers).collect();
        let key = (name.to_owned(), shape);
        if let Some(known) = self.known.get(&key) {
            return known.clone();
        }
        let mut own = name.to_owned();
        let next = self.next.entry(name.to_owned()).or_insert(2);
        while !self.taken.insert(own.clone()) {
            own = format!("{name} ({next})");
            *next += 1;
        }
        self.known.insert(key, own.clone());
        self.holders.push(Holder { name: own.clone(), segments });
        own
    }

    /// The holders in the order in which they came.
    pub(super) fn holders(self) -> Vec<Holder> {
        self.holders
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_holder_is_kept_once_and_names_differ() {
        let segment =
            |height: f64| vec![HolderSegment { height, lower_diameter: 20.0, upper_diameter: Some(20.0) }];
        let mut shelf = Shelf::default();
        assert_eq!(shelf.name("ER", segment(1.0)), "ER");
        assert_eq!(shelf.name("ER (2)", segment(5.0)), "ER (2)");
        assert_eq!(shelf.name("ER", segment(2.0)), "ER (3)");
        assert_eq!(shelf.name("ER", segment(1.0)), "ER");
        assert_eq!(shelf.name("ER", segment(2.0)), "ER (3)");
        // Ten thousand of one name take no time.
        for height in 3..10_000 {
            shelf.name("ER", segment(f64::from(height)));
        }
        let holders = shelf.holders();
        let names: BTreeSet<&str> = holders.iter().map(|holder| holder.name.as_str()).collect();
        assert_eq!((names.len(), holders.len()), (10_000, 10_000));
    }
}
