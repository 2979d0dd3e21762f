//! Multiplying out.

use super::term::{Term, collect, sum};
use super::trigonometry::contract;
use super::{Expression, Node};

/// Most terms of a sum that is multiplied out; a longer one stays a product.
const MOST_TERMS: usize = 2_000;
/// Greatest power of a sum that is multiplied out.
const MOST_POWER: i32 = 8;

impl Expression {
    /// Products of sums multiplied out, equal terms added, and products of sines and cosines drawn together where that
    /// leaves fewer terms (`sin(a)^2 + cos(a)^2 = 1`, `cos(a)*cos(b) + sin(a)*sin(b) = cos(a - b)`).
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let expanded = |text: &str| Expression::parse(text).unwrap().expanded().to_string();
    /// assert_eq!(expanded("(v + 1)^2 - v^2"), "2*v + 1");
    /// assert_eq!(expanded("r*sin(f)*(r*sin(f)) + r^2*cos(f)^2"), "r^2");
    /// assert_eq!(expanded("cos(a)*sin(b) - sin(a)*cos(b)"), "-sin(a - b)");
    /// ```
    #[must_use]
    pub fn expanded(&self) -> Expression {
        sum(&contract(collect(self.simplified().expanded_terms())))
    }

    fn expanded_terms(&self) -> Vec<Term> {
        match self.node() {
            Node::Sum(parts) => {
                let terms = parts.iter().flat_map(Expression::expanded_terms).collect();
                collect(terms)
            }
            Node::Negative(of) => {
                let mut terms = of.expanded_terms();
                terms.iter_mut().for_each(|term| term.fraction = term.fraction.negative());
                terms
            }
            Node::Call(..) => {
                let whole = self.map_parts(&mut Expression::expanded).simplified();
                if matches!(whole.node(), Node::Call(..)) {
                    vec![Term::of(&whole)]
                } else {
                    whole.expanded_terms()
                }
            }
            _ => multiplied_out(Term::of(self)),
        }
    }
}

/// A term with its sums multiplied out.
fn multiplied_out(term: Term) -> Vec<Term> {
    let mut product = vec![Term { fraction: term.fraction, factors: Vec::new() }];
    for (factor, n) in term.factors {
        let parts = match factor.node() {
            Node::Call(..) => factor.expanded_terms(),
            Node::Sum(_) => factor.expanded_terms(),
            _ => vec![Term { fraction: super::term::Fraction::ONE, factors: vec![(factor.clone(), 1)] }],
        };
        let one = match parts.as_slice() {
            [single] => single.power(n),
            _ => None,
        };
        let times = match (one, n) {
            (Some(power), _) => vec![power],
            (None, 1..=MOST_POWER) => (1..n).fold(parts.clone(), |power, _| {
                if power.len() * parts.len() > MOST_TERMS { power } else { times(&power, &parts) }
            }),
            _ => vec![Term { fraction: super::term::Fraction::ONE, factors: vec![(sum(&parts), n)] }],
        };
        if product.len() * times.len() > MOST_TERMS {
            product.iter_mut().for_each(|each| {
                *each = each.times(&Term {
                    fraction: super::term::Fraction::ONE,
                    factors: vec![(factor.clone(), n)],
                });
            });
        } else {
            product = self::times(&product, &times);
        }
    }
    product
}

fn times(a: &[Term], b: &[Term]) -> Vec<Term> {
    collect(a.iter().flat_map(|x| b.iter().map(|y| x.times(y))).collect())
}
