//! The execution core: a program is run as its control runs it.
//!
//! Values and variables, expressions, calls, branches with their budgets: what every control language has, whatever its
//! words are. A grammar brings the text of its blocks and the rules of its arithmetic.

mod arithmetic;
mod budget;
mod expression;
mod names;
mod recurrence;
mod value;
mod variables;

pub(in crate::nc) use arithmetic::Arithmetic;
pub(in crate::nc) use budget::Budget;
pub(in crate::nc) use expression::Expression;
pub(in crate::nc) use names::{Known, Names, WithMade};
pub(in crate::nc) use recurrence::{Recurrence, mixed};
pub(in crate::nc) use value::Value;
pub(in crate::nc) use variables::{Level, LocalNames, Variables};
