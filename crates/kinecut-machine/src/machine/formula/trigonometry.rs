//! Drawing products of sines and cosines together.
//!
//! Two terms of a sum that are equal but for `cos A cos B` in one and `sin A sin B` in the other become one with
//! `cos(A - B)` or `cos(A + B)`; `sin A cos B` and `cos A sin B` become `sin(A + B)` or `sin(A - B)`. With `A = B` this
//! is `cos^2 + sin^2 = 1`. A greedy search for the first pair, until no pair remains: each step leaves one term less.

use super::term::{Term, collect};
use super::{Expression, Function, Node};

/// Most terms that are compared in pairs.
const MOST_TERMS: usize = 200;

/// A term as its two functions of angles and the rest.
struct Split {
    functions: [(Function, Expression); 2],
    rest: Term,
}

/// Draws terms together as long as it leaves fewer of them.
pub(super) fn contract(mut terms: Vec<Term>) -> Vec<Term> {
    while terms.len() <= MOST_TERMS {
        let Some((i, k, one)) = first_pair(&terms) else { return terms };
        terms.remove(k);
        terms[i] = one;
        terms = collect(
            terms
                .into_iter()
                .flat_map(|term| super::simplify::summands(&term.expression().simplified()))
                .collect(),
        );
    }
    terms
}

fn first_pair(terms: &[Term]) -> Option<(usize, usize, Term)> {
    let splits: Vec<Vec<Split>> = terms.iter().map(splits).collect();
    for i in 0..terms.len() {
        for k in i + 1..terms.len() {
            for a in &splits[i] {
                for b in &splits[k] {
                    if let Some(one) = drawn_together(a, b) {
                        return Some((i, k, one));
                    }
                }
            }
        }
    }
    None
}

/// All ways to take two sines or cosines out of a term, in the order of its factors.
fn splits(term: &Term) -> Vec<Split> {
    let angles: Vec<(usize, Function, Expression)> = term
        .factors
        .iter()
        .enumerate()
        .filter(|(_, (_, n))| *n > 0)
        .filter_map(|(i, (factor, _))| match factor.node() {
            Node::Call(function @ (Function::Sin | Function::Cos), angle) => {
                angle.first().map(|angle| (i, *function, angle.clone()))
            }
            _ => None,
        })
        .collect();
    let mut found = Vec::new();
    for (p, (i, f, a)) in angles.iter().enumerate() {
        for (k, g, b) in &angles[p..] {
            if i == k && term.factors[*i].1 < 2 {
                continue;
            }
            let mut rest = term.clone();
            rest.factors[*i].1 -= 1;
            rest.factors[*k].1 -= 1;
            rest.factors.retain(|(_, n)| *n != 0);
            found.push(Split { functions: [(*f, a.clone()), (*g, b.clone())], rest });
        }
    }
    found
}

fn drawn_together(x: &Split, y: &Split) -> Option<Term> {
    let same = x.rest.fraction == y.rest.fraction;
    if !same && x.rest.fraction != y.rest.fraction.negative() || x.rest.key() != y.rest.key() {
        return None;
    }
    let [(f, a), (g, b)] = &x.functions;
    let (sin, cos) = (Function::Sin, Function::Cos);
    let has = |wanted: [(Function, &Expression); 2]| {
        let [(p, c), (q, d)] = &y.functions;
        let [first, second] = wanted;
        ((*p, c) == first && (*q, d) == second) || ((*p, c) == second && (*q, d) == first)
    };
    let (value, negative) = match (*f, *g) {
        // cos a cos b + sin a sin b = cos(a - b); cos a cos b - sin a sin b = cos(a + b)
        (Function::Cos, Function::Cos) if has([(sin, a), (sin, b)]) => {
            (if same { a - b } else { a + b }.cos(), false)
        }
        // sin a sin b + cos a cos b = cos(a - b); sin a sin b - cos a cos b = -cos(a + b)
        (Function::Sin, Function::Sin) if has([(cos, a), (cos, b)]) => {
            (if same { a - b } else { a + b }.cos(), !same)
        }
        // sin a cos b +- cos a sin b = sin(a +- b)
        (Function::Sin, Function::Cos) if has([(cos, a), (sin, b)]) => {
            (if same { a + b } else { a - b }.sin(), false)
        }
        // cos a sin b + sin a cos b = sin(a + b); cos a sin b - sin a cos b = -sin(a - b)
        (Function::Cos, Function::Sin) if has([(sin, a), (cos, b)]) => {
            (if same { a + b } else { a - b }.sin(), !same)
        }
        _ => return None,
    };
    let one = x.rest.times(&Term::of(&value.simplified()));
    Some(if negative { Term { fraction: one.fraction.negative(), ..one } } else { one })
}
