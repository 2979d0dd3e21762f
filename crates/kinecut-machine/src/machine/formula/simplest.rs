//! The shortest of several forms of a formula.

use super::term::{Term, collect, sum};
use super::{Expression, simplify::summands};

impl Expression {
    /// The shortest of the formula simplified, multiplied out, and multiplied out with common factors taken out again.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let simplest = |text: &str| Expression::parse(text).unwrap().simplest().to_string();
    /// assert_eq!(simplest("cos(phi)*(R - z*sin(a))"), "(R - z*sin(a))*cos(phi)");
    /// assert_eq!(simplest("cos(f)*(h + r*cos(2*f)) + sin(f)*(r*sin(2*f))"), "(h + r)*cos(f)");
    /// ```
    #[must_use]
    pub fn simplest(&self) -> Expression {
        let simple = self.simplified();
        let expanded = simple.expanded();
        let factored = expanded.factored();
        // Of equally long ones the first.
        [simple, factored, expanded].into_iter().min_by_key(Expression::size).unwrap_or_else(|| self.clone())
    }

    /// A sum with the factors that all of its terms have before a bracket.
    fn factored(&self) -> Expression {
        let terms = collect(summands(self));
        let [first, others @ ..] = terms.as_slice() else { return self.clone() };
        if others.is_empty() {
            return self.clone();
        }
        let mut common = Term::number(1.0);
        for (factor, n) in &first.factors {
            let least = |term: &Term| term.factors.iter().find(|(f, _)| f == factor).map_or(0, |(_, n)| *n);
            let shared = others.iter().map(least).fold(*n, i32::min);
            if shared > 0 {
                common.factors.push((factor.clone(), shared));
            }
        }
        let Some(inverse) = common.power(-1).filter(|_| !common.factors.is_empty()) else {
            return self.clone();
        };
        let inside: Vec<Term> = terms.iter().map(|term| term.times(&inverse)).collect();
        (sum(&inside) * common.expression()).simplified()
    }
}
