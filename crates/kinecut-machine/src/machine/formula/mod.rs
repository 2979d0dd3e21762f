//! Formulas as people write them in files: `R0 + a*cos(2*pi*t/p)`, `t**2/(4*f)`.
//!
//! An [`Expression`] is an immutable tree that is cheap to clone. It is read ([`Expression::parse`]), printed so that it
//! can be read again, differentiated exactly, simplified, and bound to an order of its names ([`Expression::bind`]) for
//! fast values. Angles are radians, as everywhere inside.
//!
//! Grammar: `sum = ["-"] product {("+" | "-") product}`, `product = factor {("*" | "/") factor}`,
//! `factor = {"-"} power`, `power = atom [("^" | "**") factor]`, `atom = number | name | function "(" sum {"," sum} ")" |
//! "(" sum ")"`. A power binds closer than a sign: `-2^2` is -4; powers associate to the right. `pi` is a constant;
//! `e` is the base of natural logarithms, unless a name `e` is bound, substituted or differentiated by: lengths are called
//! so too.

mod affine;
mod bound;
mod derivative;
mod display;
mod expand;
mod function;
mod node;
mod notation;
mod operators;
mod parse;
mod power;
mod simplest;
mod simplify;
mod solve;
mod term;
#[cfg(test)]
mod tests;
mod token;
mod trigonometry;

pub use bound::BoundFormula;
pub use function::Function;
pub use node::{Expression, Node};
pub use notation::name_in_unicode;
pub use parse::{MOST_CHARACTERS, MOST_DEPTH};
pub use solve::without_common_factors;
