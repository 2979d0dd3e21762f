//! The first value of a text that has not the form of its key.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Form, Kind};
use crate::job::renamed::old_name;

/// A key of a text.
#[derive(Clone, Copy, Debug)]
pub(in crate::job) struct KeyAt<'v, 'a> {
    /// Its name.
    pub(in crate::job) key: &'v str,
    /// The form of its table.
    pub(in crate::job) within: Form<'a>,
    /// The form of its value.
    pub(in crate::job) form: Form<'a>,
    /// Its value.
    pub(in crate::job) value: &'v Spanned<DeValue<'v>>,
}

/// A value of a wrong form.
#[derive(Clone, Debug)]
pub(in crate::job) struct Misfit<'v, 'a> {
    /// Keys on the way to it, the nearest last.
    pub(in crate::job) keys: Vec<KeyAt<'v, 'a>>,
    /// The wrong value.
    pub(in crate::job) value: &'v DeValue<'v>,
    /// Its place, or that of the key that is not known.
    pub(in crate::job) range: Range<usize>,
    /// Its form.
    pub(in crate::job) form: Form<'a>,
    /// The key that is not known, with those that are.
    pub(in crate::job) unknown: Option<(&'v str, Vec<&'a str>)>,
    /// Number of lists in which it is, from its nearest key.
    pub(in crate::job) lists: usize,
}

impl Misfit<'_, '_> {
    /// Whether it lies within a value whose own kind is right.
    pub(super) fn is_within(&self) -> bool {
        !self.keys.is_empty() || self.lists > 0 || self.unknown.is_some()
    }
}

impl<'a> Form<'a> {
    /// The first part of a value that has not its form.
    pub(in crate::job) fn misfit<'v>(self, value: &'v Spanned<DeValue<'v>>) -> Option<Misfit<'v, 'a>> {
        let (range, whole) = (value.span(), value);
        let value = value.get_ref();
        let wrong = |form: Form<'a>| {
            let range = range.clone();
            Misfit { keys: Vec::new(), value, range, form, unknown: None, lists: 0 }
        };
        if self.kind() == Kind::Choice {
            return match self.meant(whole) {
                Some(form) => form.misfit(whole),
                None => Some(wrong(self)),
            };
        }
        let fits = match (self.kind(), value) {
            (Kind::Any, _)
            | (Kind::Number, DeValue::Integer(_) | DeValue::Float(_))
            | (Kind::Text, DeValue::String(_))
            | (Kind::Truth, DeValue::Boolean(_)) => true,
            (Kind::Word(word), DeValue::String(said)) => said == word,
            (Kind::Whole, DeValue::Integer(number)) => {
                let (least, most) = self.bounds();
                let number = i128::from_str_radix(number.as_str(), number.radix()).ok().map(|n| n as f64);
                number.is_some_and(|n| least.is_none_or(|l| l <= n) && most.is_none_or(|m| n <= m))
            }
            (Kind::List, DeValue::Array(list)) => {
                let (least, most) = self.counts();
                if !(least..=most).contains(&(list.len() as u64)) {
                    return Some(wrong(self));
                }
                return list.iter().find_map(|item| {
                    let mut misfit = self.item().misfit(item)?;
                    misfit.lists += usize::from(misfit.keys.is_empty());
                    Some(misfit)
                });
            }
            (Kind::Table, DeValue::Table(table)) => return self.misfit_in(table),
            _ => false,
        };
        (!fits).then(|| wrong(self))
    }

    /// The first part of a table that has not its form.
    pub(in crate::job) fn misfit_in<'v>(self, table: &'v DeTable<'v>) -> Option<Misfit<'v, 'a>> {
        table.iter().find_map(|(name, value)| {
            let key: &str = name.get_ref();
            let Some(form) = self.key(key) else {
                let known = self.known()?;
                if known.iter().any(|known| old_name(known) == Some(key)) {
                    return None;
                }
                let unknown = Some((key, known));
                let (value, range) = (value.get_ref(), name.span());
                return Some(Misfit { keys: Vec::new(), value, range, form: self, unknown, lists: 0 });
            };
            let mut misfit = form.misfit(value)?;
            misfit.keys.insert(0, KeyAt { key, within: self, form, value });
            Some(misfit)
        })
    }
}
