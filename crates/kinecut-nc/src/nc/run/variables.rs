//! Variables of a program: with numbers and with names, of all and of each call.

use std::collections::HashMap;

use super::Value;
use super::recurrence::mixed;

/// Numbered variables up to here are kept as a list.
const LISTED: usize = 6000;
/// Stands for a variable that holds no value; no program computes it.
const VACANT: f64 = f64::NAN;

/// Named variables of one call.
pub(in crate::nc) type LocalNames = HashMap<String, f64>;

/// Variables of one call.
#[derive(Clone, Debug)]
pub(in crate::nc) struct Level {
    /// Local variables from `#1` on.
    pub(in crate::nc) locals: Vec<f64>,
    names: LocalNames,
}

impl Level {
    /// Local variables without a value, or nought.
    pub(in crate::nc) fn new(locals: usize, vacant: bool) -> Level {
        Level { locals: vec![if vacant { VACANT } else { 0.0 }; locals], names: HashMap::new() }
    }
}

/// All variables.
#[derive(Clone, Debug)]
pub(in crate::nc) struct Variables {
    /// Those from `#0` on that all calls share; `None` until one is set.
    listed: Vec<Option<f64>>,
    far: HashMap<u32, f64>,
    names: HashMap<String, f64>,
    level: Level,
    /// A number mixed from all of them.
    state: u128,
}

fn value(number: f64) -> Value {
    if number.is_nan() { Value::Vacant } else { Value::Number(number) }
}

fn number(value: Value) -> f64 {
    if value == Value::Vacant { VACANT } else { value.number() }
}

/// Place of a name among the mixed numbers.
fn place(name: &str) -> u64 {
    name.bytes().fold(0xCBF2_9CE4_8422_2325, |hash, b| (hash ^ u64::from(b)).wrapping_mul(0x0100_0000_01B3))
}

impl Variables {
    pub(in crate::nc) fn new(level: Level) -> Variables {
        let mut all =
            Variables { listed: Vec::new(), far: HashMap::new(), names: HashMap::new(), level, state: 0 };
        all.state ^= all.level_state();
        all
    }

    /// A number that differs where a variable differs.
    pub(in crate::nc) fn state(&self) -> u128 {
        self.state
    }

    fn level_state(&self) -> u128 {
        let locals = self.level.locals.iter().enumerate().map(|(i, v)| mixed(i as u64, v.to_bits()));
        let names = self.level.names.iter().map(|(n, v)| mixed(place(n), v.to_bits()));
        locals.chain(names).fold(0, |a, b| a ^ b)
    }

    /// Begins a call with these local variables; the ones before.
    pub(in crate::nc) fn enter(&mut self, level: Level) -> Level {
        self.state ^= self.level_state();
        let before = std::mem::replace(&mut self.level, level);
        self.state ^= self.level_state();
        before
    }

    /// Begins a call that shares the numbered variables and has these names of its own; the names before.
    pub(in crate::nc) fn enter_names(&mut self, names: LocalNames) -> LocalNames {
        self.state ^= self.level_state();
        let before = std::mem::replace(&mut self.level.names, names);
        self.state ^= self.level_state();
        before
    }

    /// Number of local variables with numbers of a call.
    fn locals(&self) -> u32 {
        self.level.locals.len() as u32
    }

    /// The value of a variable with a number, if one was given.
    pub(in crate::nc) fn numbered(&self, index: u32) -> Option<Value> {
        if (1..=self.locals()).contains(&index) {
            return Some(value(self.level.locals[index as usize - 1]));
        }
        let found = match self.listed.get(index as usize) {
            Some(found) => *found,
            None => self.far.get(&index).copied(),
        };
        found.map(value)
    }

    pub(in crate::nc) fn set_numbered(&mut self, index: u32, to: Value) {
        let to = number(to);
        let before = if (1..=self.locals()).contains(&index) {
            Some(std::mem::replace(&mut self.level.locals[index as usize - 1], to))
        } else if (index as usize) < LISTED {
            if self.listed.len() <= index as usize {
                self.listed.resize(index as usize + 1, None);
            }
            self.listed[index as usize].replace(to)
        } else {
            self.far.insert(index, to)
        };
        self.remix(u64::from(index).wrapping_sub(1), before, to);
    }

    /// The value of a variable with a name; those that begin with `_` are of all calls.
    pub(in crate::nc) fn named(&self, name: &str) -> Option<Value> {
        let names = if name.starts_with('_') { &self.names } else { &self.level.names };
        names.get(name).copied().map(value)
    }

    pub(in crate::nc) fn set_named(&mut self, name: &str, to: Value) {
        let to = number(to);
        let names = if name.starts_with('_') { &mut self.names } else { &mut self.level.names };
        let before = match names.get_mut(name) {
            Some(found) => Some(std::mem::replace(found, to)),
            None => names.insert(name.to_owned(), to),
        };
        self.remix(place(name), before, to);
    }

    fn remix(&mut self, place: u64, before: Option<f64>, now: f64) {
        if let Some(before) = before {
            self.state ^= mixed(place, before.to_bits());
        }
        self.state ^= mixed(place, now.to_bits());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_state_is_that_of_the_values_whatever_the_way_to_them() {
        let mut a = Variables::new(Level::new(30, false));
        let mut b = a.clone();
        a.set_numbered(1, Value::Number(3.0));
        a.set_numbered(100, Value::Number(4.0));
        a.set_named("_g", Value::Number(5.0));
        b.set_named("_g", Value::Number(1.0));
        b.set_numbered(100, Value::Number(7.0));
        b.set_numbered(100, Value::Number(4.0));
        b.set_numbered(1, Value::Number(3.0));
        assert_ne!(a.state(), b.state());
        b.set_named("_g", Value::Number(5.0));
        assert_eq!(a.state(), b.state());
        let before = a.state();
        let caller = a.enter(Level::new(30, false));
        assert_eq!(a.numbered(1), Some(Value::Number(0.0)));
        a.set_named("x", Value::Number(1.0));
        assert_ne!(a.state(), before);
        a.enter(caller);
        assert_eq!((a.state(), a.named("x")), (before, None));
    }

    #[test]
    fn a_variable_without_a_value_is_told_from_nought() {
        let mut all = Variables::new(Level::new(33, true));
        assert_eq!((all.numbered(1), all.numbered(100)), (Some(Value::Vacant), None));
        all.set_numbered(1, Value::Number(0.0));
        assert_eq!(all.numbered(1), Some(Value::Number(0.0)));
        all.set_numbered(10_001, Value::Number(2.5));
        assert_eq!(all.numbered(10_001), Some(Value::Number(2.5)));
    }
}
