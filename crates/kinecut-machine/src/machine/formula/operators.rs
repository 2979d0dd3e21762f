//! Building formulas in Rust: constructors and operators.
//!
//! The constructors keep what they are given, but for the sign of a number and sums and products of fewer than two
//! parts; the operators drop zeros and ones.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{Expression, Function, Node};

impl Expression {
    /// A sum; of no parts 0.
    pub fn sum(mut parts: Vec<Expression>) -> Expression {
        match parts.len() {
            0 => Expression::number(0.0),
            1 => parts.swap_remove(0),
            _ => Expression::from_node(Node::Sum(parts)),
        }
    }

    /// A product; of no parts 1.
    pub fn product(mut parts: Vec<Expression>) -> Expression {
        match parts.len() {
            0 => Expression::number(1.0),
            1 => parts.swap_remove(0),
            _ => Expression::from_node(Node::Product(parts)),
        }
    }

    /// The first divided by the second.
    pub fn quotient(above: Expression, below: Expression) -> Expression {
        Expression::from_node(Node::Quotient(above, below))
    }

    /// The first to the power of the second.
    pub fn power(base: Expression, exponent: Expression) -> Expression {
        Expression::from_node(Node::Power(base, exponent))
    }

    /// The opposite.
    pub fn negative(of: Expression) -> Expression {
        match of.as_number() {
            Some(value) => Expression::number(-value),
            None => Expression::from_node(Node::Negative(of)),
        }
    }

    /// A function of its arguments. A wrong number of arguments gives the number `NaN`.
    pub fn call(function: Function, arguments: Vec<Expression>) -> Expression {
        let (least, most) = function.arguments();
        if arguments.len() < least || arguments.len() > most {
            return Expression::number(f64::NAN);
        }
        Expression::from_node(Node::Call(function, arguments))
    }

    /// Its sine.
    #[must_use]
    pub fn sin(&self) -> Expression {
        Expression::call(Function::Sin, vec![self.clone()])
    }

    /// Its cosine.
    #[must_use]
    pub fn cos(&self) -> Expression {
        Expression::call(Function::Cos, vec![self.clone()])
    }

    /// Its square root.
    #[must_use]
    pub fn sqrt(&self) -> Expression {
        Expression::call(Function::Sqrt, vec![self.clone()])
    }

    /// Its square.
    #[must_use]
    pub fn squared(&self) -> Expression {
        Expression::power(self.clone(), Expression::number(2.0))
    }

    /// True if it is the number 0 literally.
    pub fn is_zero(&self) -> bool {
        self.as_number() == Some(0.0)
    }

    /// True if it is the number 1 literally.
    pub fn is_one(&self) -> bool {
        self.as_number() == Some(1.0)
    }
}

impl Add for &Expression {
    type Output = Expression;

    fn add(self, other: &Expression) -> Expression {
        if self.is_zero() {
            return other.clone();
        }
        if other.is_zero() {
            return self.clone();
        }
        let mut parts = match self.node() {
            Node::Sum(parts) => parts.clone(),
            _ => vec![self.clone()],
        };
        parts.push(other.clone());
        Expression::sum(parts)
    }
}

impl Sub for &Expression {
    type Output = Expression;

    fn sub(self, other: &Expression) -> Expression {
        if other.is_zero() { self.clone() } else { self + &-other }
    }
}

impl Mul for &Expression {
    type Output = Expression;

    fn mul(self, other: &Expression) -> Expression {
        if self.is_zero() || other.is_one() {
            return self.clone();
        }
        if other.is_zero() || self.is_one() {
            return other.clone();
        }
        let mut parts = match self.node() {
            Node::Product(parts) => parts.clone(),
            _ => vec![self.clone()],
        };
        parts.push(other.clone());
        Expression::product(parts)
    }
}

impl Div for &Expression {
    type Output = Expression;

    fn div(self, other: &Expression) -> Expression {
        if other.is_one() { self.clone() } else { Expression::quotient(self.clone(), other.clone()) }
    }
}

impl Neg for &Expression {
    type Output = Expression;

    fn neg(self) -> Expression {
        match self.node() {
            Node::Negative(of) => of.clone(),
            _ => Expression::negative(self.clone()),
        }
    }
}

macro_rules! by_value {
    ($($operator:ident :: $method:ident),*) => {$(
        impl $operator for Expression {
            type Output = Expression;

            fn $method(self, other: Expression) -> Expression {
                $operator::$method(&self, &other)
            }
        }
    )*};
}

by_value!(Add::add, Sub::sub, Mul::mul, Div::div);

impl Neg for Expression {
    type Output = Expression;

    fn neg(self) -> Expression {
        -&self
    }
}
