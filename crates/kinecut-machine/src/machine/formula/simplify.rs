//! Simplifying formulas: equal terms added, factors collected, exact values of functions.
//!
//! Nothing is multiplied out here (see [`Expression::expanded`]), and no number is rounded that a reader would want to
//! see: `cos(0.35)` and `1/3` stay. Where a formula has a value it keeps it, to rounding; removable gaps (`x/x` at 0)
//! are closed.

use super::term::{Fraction, Term, collect, sum};
use super::{Expression, Function, Node};

impl Expression {
    /// The same formula with zeros, ones and double signs dropped, equal terms added and factors collected.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let simple = |text: &str| Expression::parse(text).unwrap().simplified().to_string();
    /// assert_eq!(simple("x*1 + 0*y + x"), "2*x");
    /// assert_eq!(simple("cos(phi)*(-(z*sin(a)) + R)"), "(R - z*sin(a))*cos(phi)");
    /// assert_eq!(simple("sin(-alpha)*2*x/(4*x^2)"), "-sin(alpha)/(2*x)");
    /// ```
    #[must_use]
    pub fn simplified(&self) -> Expression {
        let formula = self.map_parts(&mut Expression::simplified);
        match formula.node() {
            Node::Number(_) | Node::Pi | Node::Euler | Node::Variable(_) => formula,
            Node::Sum(_) | Node::Negative(_) => sum(&collect(summands(&formula))),
            Node::Call(function, arguments) => value_of_call(*function, arguments).unwrap_or(formula),
            Node::Power(base, exponent) if exponent.as_number().is_none() && base.is_one() => base.clone(),
            _ => Term::of(&formula).expression(),
        }
    }
}

/// The terms of a sum whose parts are simple, sums inside included.
pub(super) fn summands(formula: &Expression) -> Vec<Term> {
    match formula.node() {
        Node::Sum(parts) => parts.iter().flat_map(summands).collect(),
        Node::Negative(of) => {
            let mut terms = summands(of);
            terms.iter_mut().for_each(|term| term.fraction = term.fraction.negative());
            terms
        }
        _ => vec![Term::of(formula)],
    }
}

/// The formula with the other sign, if it is the one of the two with a minus; signs of sums by their smallest term.
pub(super) fn opposite(formula: &Expression) -> Option<Expression> {
    let mut terms = summands(formula);
    let first = terms.iter().min_by_key(|term| term.key())?;
    if !(first.fraction.above < 0.0) {
        return None;
    }
    terms.iter_mut().for_each(|term| term.fraction = term.fraction.negative());
    Some(sum(&collect(terms)))
}

/// Quarter turns, if the formula is a whole number of them.
fn quarter_turns(formula: &Expression) -> Option<u8> {
    let term = Term::of(formula);
    match term.factors.as_slice() {
        [] if term.fraction == Fraction::ZERO => Some(0),
        [(factor, 1)] if matches!(factor.node(), Node::Pi) => {
            let quarters = 2.0 * term.fraction.above / term.fraction.below;
            (quarters.fract() == 0.0).then(|| quarters.rem_euclid(4.0) as u8)
        }
        _ => None,
    }
}

/// A simpler formula for a function of simple arguments.
fn value_of_call(function: Function, arguments: &[Expression]) -> Option<Expression> {
    let number = Expression::number;
    let call = |argument: Expression| Expression::call(function, vec![argument]);
    if let [u] = arguments {
        let known = u.as_number();
        return match function {
            Function::Sin => match quarter_turns(u) {
                Some(turns) => Some(number([0.0, 1.0, 0.0, -1.0][usize::from(turns)])),
                None => {
                    of_arc(u, 0).or_else(|| opposite(u).map(|u| Expression::negative(u.sin().simplified())))
                }
            },
            Function::Cos => match quarter_turns(u) {
                Some(turns) => Some(number([1.0, 0.0, -1.0, 0.0][usize::from(turns)])),
                None => of_arc(u, 1).or_else(|| opposite(u).map(|u| u.cos().simplified())),
            },
            Function::Tan | Function::Asin | Function::Atan if u.is_zero() => Some(number(0.0)),
            Function::Tan | Function::Asin | Function::Atan => {
                opposite(u).map(|u| Expression::negative(call(u)))
            }
            Function::Acos if u.is_one() => Some(number(0.0)),
            Function::Exp if u.is_zero() => Some(number(1.0)),
            Function::Ln if u.is_one() => Some(number(0.0)),
            Function::Sqrt => match known {
                Some(square) => {
                    let root = square.sqrt();
                    (root.fract() == 0.0 && root * root == square).then(|| number(root))
                }
                None => square_of(u).map(|root| Expression::call(Function::Abs, vec![root])),
            },
            Function::Abs => match (known, opposite(u)) {
                (Some(value), _) => Some(number(value.abs())),
                (None, Some(u)) => Some(call(u)),
                (None, None) => None,
            },
            Function::Sign => match (known, opposite(u)) {
                (Some(value), _) => Some(number(function.value(value))),
                (None, Some(u)) => Some(Expression::negative(call(u))),
                (None, None) => None,
            },
            Function::Floor => known.map(|value| number(value.floor())),
            _ => None,
        };
    }
    match function {
        Function::Min | Function::Max => {
            let known: Option<Vec<f64>> = arguments.iter().map(Expression::as_number).collect();
            let alike = arguments.windows(2).all(|pair| pair[0] == pair[1]);
            match known {
                Some(values) => values.into_iter().reduce(|a, b| function.value_of_two(a, b)).map(number),
                None if alike => arguments.first().cloned(),
                None => None,
            }
        }
        Function::Hypot => {
            let rest = arguments.iter().position(Expression::is_zero).map(|i| arguments[1 - i].clone());
            match rest {
                Some(u) => Some(Expression::call(Function::Abs, vec![u]).simplified()),
                None => arguments.iter().any(|u| opposite(u).is_some()).then(|| {
                    let positive = |u: &Expression| opposite(u).unwrap_or_else(|| u.clone());
                    Expression::call(function, arguments.iter().map(positive).collect())
                }),
            }
        }
        Function::Atan2 => match arguments {
            [y, x] if y.is_zero() && x.as_number().is_some_and(|x| x > 0.0) => Some(number(0.0)),
            _ => None,
        },
        _ => None,
    }
}

/// Sine (0) or cosine (1) of an arc tangent: `x/sqrt(1 + x^2)` and `1/sqrt(1 + x^2)`, or `y/hypot(x, y)` and
/// `x/hypot(x, y)`.
fn of_arc(angle: &Expression, which: usize) -> Option<Expression> {
    let Node::Call(function, arguments) = angle.node() else { return None };
    let (parts, length) = match (function, arguments.as_slice()) {
        (Function::Atan, [x]) => {
            let one = Expression::number(1.0);
            ([x.clone(), one.clone()], (one + x.squared()).sqrt())
        }
        (Function::Atan2, [y, x]) => {
            let length = Expression::call(Function::Hypot, vec![x.clone(), y.clone()]);
            ([y.clone(), x.clone()], length)
        }
        _ => return None,
    };
    parts.into_iter().nth(which).map(|part| (part / length).simplified())
}

/// Base of a formula that is written as a square; `None` for any other formula.
fn square_of(formula: &Expression) -> Option<Expression> {
    match formula.node() {
        Node::Power(base, exponent) if exponent.as_number() == Some(2.0) => Some(base.clone()),
        _ => None,
    }
}
