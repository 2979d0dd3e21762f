//! Exact derivatives of formulas.
//!
//! Functions with corners have the derivative of their pieces: `abs(u)' = sign(u)*u'`,
//! `min(u, v)' = (u' + v' - sign(u - v)*(u' - v'))/2` (at a tie the mean of both sides); `floor` and `sign` have 0.

use super::{Expression, Function, Node};

impl Expression {
    /// The derivative by a variable, simplified.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let slope = |text: &str| Expression::parse(text).unwrap().derivative("x").to_string();
    /// assert_eq!(slope("x^3"), "3*x^2");
    /// assert_eq!(slope("atan2(x, a)"), "a/(x^2 + a^2)");
    /// assert_eq!(slope("abs(x)"), "sign(x)");
    /// ```
    #[must_use]
    pub fn derivative(&self, name: &str) -> Expression {
        raw(&self.simplified(), name).simplified()
    }
}

fn raw(formula: &Expression, name: &str) -> Expression {
    let number = Expression::number;
    if !formula.has(name) {
        return number(0.0);
    }
    match formula.node() {
        Node::Number(_) | Node::Pi => number(0.0),
        Node::Variable(_) | Node::Euler => number(1.0),
        Node::Sum(parts) => parts.iter().fold(number(0.0), |sum, part| &sum + &raw(part, name)),
        Node::Product(parts) => (0..parts.len()).fold(number(0.0), |sum, i| {
            let changed = parts.iter().enumerate().fold(number(1.0), |product, (k, part)| {
                if k == i { &product * &raw(part, name) } else { &product * part }
            });
            &sum + &changed
        }),
        Node::Quotient(above, below) => {
            let by_above = &raw(above, name) / below;
            if below.has(name) {
                &by_above - &(&(above * &raw(below, name)) / &below.squared())
            } else {
                by_above
            }
        }
        Node::Power(base, exponent) => power(base, exponent, name),
        Node::Negative(of) => -&raw(of, name),
        Node::Call(function, arguments) => call(*function, arguments, name),
    }
}

/// `(u^v)' = v*u^(v - 1)*u' + u^v*ln(u)*v'`, without the parts that vanish: `ln(u)` may have no value there.
fn power(u: &Expression, v: &Expression, name: &str) -> Expression {
    let ln = |of: &Expression| Expression::call(Function::Ln, vec![of.clone()]);
    let lower = match v.as_number() {
        Some(value) => Expression::number(value - 1.0),
        None => v - &Expression::number(1.0),
    };
    let by_base = || &(v * &Expression::power(u.clone(), lower)) * &raw(u, name);
    let by_exponent = || &(&Expression::power(u.clone(), v.clone()) * &ln(u)) * &raw(v, name);
    match (u.has(name), v.has(name)) {
        (true, true) => &by_base() + &by_exponent(),
        (false, true) => by_exponent(),
        _ => by_base(),
    }
}

fn call(function: Function, arguments: &[Expression], name: &str) -> Expression {
    let one = || Expression::number(1.0);
    let two = || Expression::number(2.0);
    let of = |function: Function, argument: &Expression| Expression::call(function, vec![argument.clone()]);
    match arguments {
        [u] => {
            let inner = raw(u, name);
            let outer = match function {
                Function::Sin => of(Function::Cos, u),
                Function::Cos => -of(Function::Sin, u),
                Function::Tan => one() / of(Function::Cos, u).squared(),
                Function::Asin => one() / (one() - u.squared()).sqrt(),
                Function::Acos => -(one() / (one() - u.squared()).sqrt()),
                Function::Atan => one() / (one() + u.squared()),
                Function::Sqrt => one() / (two() * of(Function::Sqrt, u)),
                Function::Abs => of(Function::Sign, u),
                Function::Exp => of(Function::Exp, u),
                Function::Ln => one() / u.clone(),
                // Steps: constant between them.
                _ => return Expression::number(0.0),
            };
            outer * inner
        }
        [u, v] => {
            let (du, dv) = (raw(u, name), raw(v, name));
            match function {
                Function::Atan2 => (v * &du - u * &dv) / (u.squared() + v.squared()),
                Function::Hypot => {
                    (u * &du + v * &dv) / Expression::call(Function::Hypot, vec![u.clone(), v.clone()])
                }
                _ => {
                    let side = of(Function::Sign, &(u - v)) * (&du - &dv);
                    let both = du + dv;
                    (if function == Function::Min { both - side } else { both + side }) / two()
                }
            }
        }
        // The smallest or greatest of many is that of the last and of all before.
        [before @ .., last] if before.len() > 1 => {
            let first = Expression::call(function, before.to_vec());
            call(function, &[first, last.clone()], name)
        }
        _ => Expression::number(0.0),
    }
}
