//! Terms: a fraction times whole powers of formulas that are no products themselves.

use std::collections::BTreeMap;

use super::{Expression, Function, Node};

/// Up to here whole numbers of type `f64` are exact.
const EXACT: f64 = 9_007_199_254_740_992.0;
/// Greatest power that is multiplied out to factors.
const MOST_POWER: f64 = 64.0;

/// A fraction; above any number, below a whole number from 1 on. Whole numbers are kept reduced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fraction {
    pub(super) above: f64,
    pub(super) below: f64,
}

impl Fraction {
    pub(super) const ONE: Fraction = Fraction { above: 1.0, below: 1.0 };
    pub(super) const ZERO: Fraction = Fraction { above: 0.0, below: 1.0 };

    fn is_whole(x: f64) -> bool {
        x.fract() == 0.0 && x.abs() <= EXACT
    }

    pub(super) fn number(above: f64) -> Fraction {
        Fraction { above, below: 1.0 }
    }

    fn reduced(above: f64, below: f64) -> Fraction {
        let sign = if below < 0.0 { -1.0 } else { 1.0 };
        let (above, below) = (above * sign, below * sign);
        if !Fraction::is_whole(below) {
            return Fraction { above: above / below, below: 1.0 };
        }
        if !Fraction::is_whole(above) {
            return Fraction { above, below };
        }
        let (mut a, mut b) = (above.abs(), below);
        while b > 0.0 {
            (a, b) = (b, a % b);
        }
        let divisor = a.max(1.0);
        Fraction { above: above / divisor, below: below / divisor }
    }

    pub(super) fn times(self, other: Fraction) -> Fraction {
        Fraction::reduced(self.above * other.above, self.below * other.below)
    }

    pub(super) fn plus(self, other: Fraction) -> Fraction {
        if self.below == other.below {
            return Fraction::reduced(self.above + other.above, self.below);
        }
        Fraction::reduced(self.above * other.below + other.above * self.below, self.below * other.below)
    }

    /// None of zero.
    fn inverse(self) -> Option<Fraction> {
        (self.above != 0.0).then(|| Fraction::reduced(self.below, self.above))
    }

    pub(super) fn negative(self) -> Fraction {
        Fraction { above: -self.above, ..self }
    }
}

/// A fraction times factors to whole powers, in the order in which they were found; no factor is a product, a quotient
/// or a finite number.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Term {
    pub(super) fraction: Fraction,
    pub(super) factors: Vec<(Expression, i32)>,
}

impl Term {
    pub(super) fn number(value: f64) -> Term {
        Term { fraction: Fraction::number(value), factors: Vec::new() }
    }

    fn factor(of: Expression) -> Term {
        Term { fraction: Fraction::ONE, factors: vec![(of, 1)] }
    }

    /// Takes a formula apart whose parts are simple already.
    pub(super) fn of(formula: &Expression) -> Term {
        match formula.node() {
            Node::Number(value) if value.is_finite() => Term::number(*value),
            Node::Negative(of) => {
                let term = Term::of(of);
                Term { fraction: term.fraction.negative(), ..term }
            }
            Node::Product(parts) => {
                parts.iter().fold(Term::number(1.0), |all, part| all.times(&Term::of(part)))
            }
            Node::Quotient(above, below) => match Term::of(below).power(-1) {
                Some(inverse) => Term::of(above).times(&inverse),
                None => Term::factor(formula.clone()),
            },
            Node::Power(base, exponent) => {
                let whole = exponent.as_number().filter(|n| n.fract() == 0.0 && n.abs() <= MOST_POWER);
                whole
                    .and_then(|n| Term::of(base).power(n as i32))
                    .unwrap_or_else(|| Term::factor(formula.clone()))
            }
            _ => Term::factor(formula.clone()),
        }
    }

    /// None where it would divide by zero or leave the numbers.
    pub(super) fn power(&self, exponent: i32) -> Option<Term> {
        let base = if exponent < 0 { self.fraction.inverse()? } else { self.fraction };
        let mut fraction = Fraction::ONE;
        for _ in 0..exponent.unsigned_abs() {
            fraction = fraction.times(base);
        }
        if !fraction.above.is_finite() || (fraction.above == 0.0 && self.fraction.above != 0.0) {
            return None;
        }
        let mut term = Term { fraction, factors: Vec::new() };
        for (factor, n) in &self.factors {
            term.multiply(factor, n.checked_mul(exponent)?);
        }
        Some(term)
    }

    pub(super) fn times(&self, other: &Term) -> Term {
        let mut product = self.clone();
        product.fraction = self.fraction.times(other.fraction);
        if !product.fraction.above.is_finite() {
            // Too large for a number: the second fraction stays a factor, so that no value becomes infinite.
            product.fraction = self.fraction;
            product.factors.push((Expression::number(other.fraction.above), 1));
            product.factors.push((Expression::number(other.fraction.below), -1));
        }
        for (factor, n) in &other.factors {
            product.multiply(factor, *n);
        }
        product
    }

    fn multiply(&mut self, factor: &Expression, exponent: i32) {
        match self.factors.iter().position(|(known, _)| known == factor) {
            Some(i) => {
                let sum = self.factors[i].1.saturating_add(exponent);
                self.factors[i].1 = sum;
                if sum == 0 {
                    self.factors.remove(i);
                }
            }
            None if exponent != 0 => self.factors.push((factor.clone(), exponent)),
            None => {}
        }
        self.square_roots();
    }

    /// `sqrt(u)^2` is `u` wherever it has a value; `u/sqrt(u)` is `sqrt(u)`.
    fn square_roots(&mut self) {
        let inside = |factor: &Expression| match factor.node() {
            Node::Call(Function::Sqrt, arguments) => arguments.first().cloned(),
            _ => None,
        };
        let found = self.factors.iter().enumerate().find_map(|(i, (factor, n))| {
            let u = inside(factor)?;
            let beside = self.factors.iter().find(|(other, _)| *other == u).map_or(0, |(_, m)| *m);
            // Of different sign: one divides the other.
            let joins = n.abs() >= 2 || beside * n < 0;
            joins.then(|| (i, u, n.saturating_add(beside.saturating_mul(2)), beside))
        });
        let Some((i, u, halves, beside)) = found else { return };
        let Some(whole) = Term::of(&u).power(halves / 2) else { return };
        let root = self.factors.remove(i).0;
        if beside != 0 {
            self.factors.retain(|(factor, _)| *factor != u);
        }
        if halves % 2 != 0 {
            self.factors.push((root, halves % 2));
        }
        *self = self.times(&whole);
    }

    /// Key that two terms must share to be added: the factors in an order of their own.
    pub(super) fn key(&self) -> Vec<(Expression, i32)> {
        let mut key = self.factors.clone();
        key.sort();
        key
    }

    /// As a formula: constants first, then variables, sums, functions; negative powers below the line.
    pub(super) fn expression(&self) -> Expression {
        if self.fraction.above == 0.0 {
            return Expression::number(0.0);
        }
        let rank = |factor: &Expression| match factor.node() {
            Node::Number(_) => 0,
            Node::Pi | Node::Euler => 1,
            Node::Variable(_) => 2,
            Node::Call(..) => 4,
            _ => 3,
        };
        let mut sorted = self.factors.clone();
        sorted.sort_by_key(|(factor, _)| rank(factor));
        let number = |value: f64| (value != 1.0).then(|| Expression::number(value));
        let mut above: Vec<Expression> = number(self.fraction.above.abs()).into_iter().collect();
        let mut below: Vec<Expression> = number(self.fraction.below).into_iter().collect();
        for (factor, n) in sorted {
            let power = match n.unsigned_abs() {
                1 => factor,
                size => Expression::power(factor, Expression::number(f64::from(size))),
            };
            if n > 0 { above.push(power) } else { below.push(power) }
        }
        let mut whole = Expression::product(above);
        if !below.is_empty() {
            whole = Expression::quotient(whole, Expression::product(below));
        }
        if self.fraction.above < 0.0 { Expression::negative(whole) } else { whole }
    }
}

/// Adds terms that are equal but for their fractions; in the order of first appearance, a positive one first.
pub(super) fn collect(terms: Vec<Term>) -> Vec<Term> {
    let mut places: BTreeMap<Vec<(Expression, i32)>, usize> = BTreeMap::new();
    let mut collected: Vec<Term> = Vec::new();
    for term in terms {
        match places.get(&term.key()) {
            Some(&place) => collected[place].fraction = collected[place].fraction.plus(term.fraction),
            None => {
                places.insert(term.key(), collected.len());
                collected.push(term);
            }
        }
    }
    collected.retain(|term| term.fraction.above != 0.0);
    if let Some(first) = collected.iter().position(|term| !(term.fraction.above < 0.0)) {
        collected[..=first].rotate_right(1);
    }
    collected
}

/// The sum of terms as a formula.
pub(super) fn sum(terms: &[Term]) -> Expression {
    Expression::sum(terms.iter().map(Term::expression).collect())
}
