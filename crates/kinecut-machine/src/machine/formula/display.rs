//! Printing formulas so that reading gives the same tree again.

use std::fmt;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Expression, Node};

/// Binding strength of the outermost operator of a formula.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    /// A sum, or something with a sign before it.
    Sum,
    /// A product or quotient.
    Product,
    /// A power.
    Power,
    /// A number, a name, a function.
    Atom,
}

impl Node {
    pub(super) fn binding(&self) -> Binding {
        match self {
            Node::Number(value) if *value < 0.0 => Binding::Sum,
            Node::Number(value) if !value.is_finite() => Binding::Product,
            Node::Sum(_) | Node::Negative(_) => Binding::Sum,
            Node::Product(_) | Node::Quotient(..) => Binding::Product,
            Node::Power(..) => Binding::Power,
            _ => Binding::Atom,
        }
    }
}

/// Prints a part in brackets, unless it binds at least as closely as its place wants.
fn part(f: &mut fmt::Formatter<'_>, part: &Expression, wants: Binding) -> fmt::Result {
    if part.node().binding() >= wants { write!(f, "{part}") } else { write!(f, "({part})") }
}

/// The part of a sum without its sign, if it has one.
fn without_sign(part: &Expression) -> Option<Expression> {
    match part.node() {
        Node::Negative(of) => Some(of.clone()),
        Node::Number(value) if *value < 0.0 => Some(Expression::number(-value)),
        _ => None,
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.node() {
            Node::Number(value) if value.is_nan() => f.write_str("0/0"),
            Node::Number(value) if value.is_infinite() => {
                write!(f, "{}1/0", if *value < 0.0 { "-" } else { "" })
            }
            Node::Number(value) => write!(f, "{}", Digits(*value)),
            Node::Pi => f.write_str("pi"),
            Node::Euler => f.write_str("e"),
            Node::Variable(name) => f.write_str(name),
            Node::Negative(of) => {
                f.write_str("-")?;
                part(f, of, Binding::Product)
            }
            Node::Sum(parts) => {
                for (i, each) in parts.iter().enumerate() {
                    match (without_sign(each), i) {
                        (Some(of), 0) => {
                            f.write_str("-")?;
                            part(f, &of, Binding::Product)?;
                        }
                        (Some(of), _) => {
                            f.write_str(" - ")?;
                            part(f, &of, Binding::Product)?;
                        }
                        (None, 0) => part(f, each, Binding::Product)?,
                        (None, _) => {
                            f.write_str(" + ")?;
                            part(f, each, Binding::Product)?;
                        }
                    }
                }
                Ok(())
            }
            Node::Product(parts) => {
                for (i, each) in parts.iter().enumerate() {
                    let leads = i == 0 && matches!(each.node(), Node::Quotient(..));
                    if i > 0 {
                        f.write_str("*")?;
                    }
                    part(f, each, if leads { Binding::Product } else { Binding::Power })?;
                }
                Ok(())
            }
            Node::Quotient(above, below) => {
                part(f, above, Binding::Product)?;
                f.write_str("/")?;
                part(f, below, Binding::Power)
            }
            Node::Power(base, exponent) => {
                part(f, base, Binding::Atom)?;
                f.write_str("^")?;
                part(f, exponent, Binding::Atom)
            }
            Node::Call(function, arguments) => {
                write!(f, "{}(", function.name())?;
                for (i, argument) in arguments.iter().enumerate() {
                    write!(f, "{}{argument}", if i == 0 { "" } else { ", " })?;
                }
                f.write_str(")")
            }
        }
    }
}

/// A finite number with as many digits as give it back; very large and very small ones with an exponent.
pub(super) struct Digits(pub(super) f64);

impl fmt::Display for Digits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// From here on the digits before or after the point are only zeros that someone must count.
        const LARGE: f64 = 1e16;
        const SMALL: f64 = 1e-5;
        let size = self.0.abs();
        if size >= LARGE || (size < SMALL && size > 0.0) {
            write!(f, "{:e}", self.0)
        } else {
            write!(f, "{}", self.0)
        }
    }
}

impl Serialize for Expression {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Expression {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Expression, D::Error> {
        let text = String::deserialize(deserializer)?;
        Expression::parse(&text).map_err(serde::de::Error::custom)
    }
}
