//! Zeros of formulas, as formulas: affine equations, and those of one angle.

use super::simplify::{opposite, summands};
use super::term::{Term, collect};
use super::{Expression, Function, Node};

/// Names in place of cosine and sine while an equation of an angle is taken apart; no text that is read has them.
const COSINE: &str = "cos of the angle";
const SINE: &str = "sin of the angle";

impl Expression {
    /// The values of a variable for which the formula vanishes, if it is affine in it (at most one), or affine in the
    /// sine and the cosine of it (two, each up to whole turns): `a*cos(x) + b*sin(x) + c = 0` has
    /// `x = atan2(b, a) +- acos(-c/hypot(a, b))`, without a real value where `|c|` is greater than `hypot(a, b)`. Empty
    /// if it is neither, or free of the variable.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let zeros = |text: &str| Expression::parse(text).unwrap().zeros("x").iter().map(Expression::to_string).collect::<Vec<_>>();
    /// assert_eq!(zeros("2*x - a"), ["a/2"]);
    /// assert_eq!(zeros("r*cos(x) + s*sin(x)"), ["atan2(-r, s)", "atan2(r, -s)"]);
    /// assert_eq!(zeros("x + sin(x)"), Vec::<String>::new());
    /// ```
    pub fn zeros(&self, name: &str) -> Vec<Expression> {
        if let Some((slope, offset)) = self.is_affine_in(name) {
            let slope = slope.simplest();
            return if slope.is_zero() { Vec::new() } else { vec![(-(offset / slope)).simplest()] };
        }
        let product = Term::of(&self.simplest());
        let holding: Vec<_> =
            product.factors.iter().filter(|(factor, n)| *n > 0 && factor.has(name)).collect();
        if holding.len() > 1 {
            return holding.iter().flat_map(|(factor, _)| factor.zeros(name)).collect();
        }
        let Some([a, b, c]) = self.harmonic(name) else { return Vec::new() };
        let call =
            |function, arguments: [Expression; 2]| Expression::call(function, arguments.into()).simplified();
        if c.is_zero() {
            let (minus_a, minus_b) = ((-&a).simplest(), (-&b).simplest());
            return match (a.is_zero(), b.is_zero()) {
                // The angle is known if one of them vanishes for all parameters.
                (true, true) => Vec::new(),
                (true, false) => vec![Expression::number(0.0), Expression::variable("pi")],
                (false, true) => {
                    let quarter = Expression::variable("pi") / Expression::number(2.0);
                    vec![quarter.clone(), -quarter]
                }
                (false, false) => {
                    vec![call(Function::Atan2, [minus_a, b]), call(Function::Atan2, [a, minus_b])]
                }
            };
        }
        let middle = call(Function::Atan2, [b.clone(), a.clone()]);
        let far = (-(c / call(Function::Hypot, [a, b]))).simplified();
        let half = Expression::call(Function::Acos, vec![far]);
        [&middle + &half, &middle - &half].map(|x| x.simplified()).into()
    }

    /// Factors a, b and rest c of `a*cos(x) + b*sin(x) + c`, all free of `x`.
    fn harmonic(&self, name: &str) -> Option<[Expression; 3]> {
        let cosine = |formula: &Expression| {
            let by_cosine = replaced(formula, name);
            let (a, rest) = by_cosine.is_affine_in(COSINE)?;
            let (b, c) = rest.is_affine_in(SINE)?;
            let free = [&a, &b, &c].iter().all(|f| !f.has(name) && !f.has(SINE) && !f.has(COSINE));
            free.then(|| [a.simplest(), b.simplest(), c.simplest()])
        };
        let simple = self.simplified();
        cosine(&simple).or_else(|| cosine(&simple.expanded()))
    }

    /// The formula without factors and divisors that hold none of these names: it vanishes at the same places, as far as
    /// those factors do not.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let equation = Expression::parse("-r*t*v/2 + r*t*a").unwrap();
    /// assert_eq!(equation.primitive(&["v"]).to_string(), "2*a - v");
    /// ```
    #[must_use]
    pub fn primitive(&self, names: &[&str]) -> Expression {
        let simple = self.simplest();
        let holds = |factor: &Expression| names.iter().any(|name| factor.has(name));
        let mut terms = collect(summands(&simple));
        // Factors that all terms share, and the greatest divisor, go.
        let Some(first) = terms.first().cloned() else { return simple };
        let mut shared = Term::number(1.0);
        for (factor, n) in first.factors.iter().filter(|(factor, _)| !holds(factor)) {
            let of = |term: &Term| term.factors.iter().find(|(f, _)| f == factor).map_or(0, |(_, n)| *n);
            let least = terms.iter().map(of).fold(*n, i32::min);
            shared.factors.push((factor.clone(), least));
        }
        let below: Vec<(Expression, i32)> = terms
            .iter()
            .flat_map(|term| term.factors.iter().filter(|(f, n)| *n < 0 && !holds(f)).cloned())
            .collect();
        for (factor, n) in below {
            match shared.factors.iter_mut().find(|(known, _)| *known == factor) {
                Some((_, least)) => *least = n.min(*least),
                None => shared.factors.push((factor, n)),
            }
        }
        shared.factors.retain(|(_, n)| *n != 0);
        let inverse =
            Term { factors: shared.factors.iter().map(|(f, n)| (f.clone(), -n)).collect(), ..shared };
        terms.iter_mut().for_each(|term| *term = term.times(&inverse));
        if let [single] = terms.as_mut_slice() {
            for (factor, _) in &mut single.factors {
                if matches!(factor.node(), Node::Sum(_)) {
                    *factor = super::term::sum(&scaled(collect(summands(factor))));
                }
            }
        }
        super::term::sum(&collect(scaled(terms))).simplest()
    }
}

/// Terms times the number that makes their fractions whole and small, where they are fractions of small whole numbers; the
/// only term of one becomes positive.
fn scaled(terms: Vec<Term>) -> Vec<Term> {
    /// Beyond this a common divisor is an accident of decimals.
    const MOST: f64 = 1e6;
    let below = terms.iter().fold(1.0, |all, term| least_multiple(all, term.fraction.below));
    let whole = |term: &Term| term.fraction.above * (below / term.fraction.below);
    let divisor = terms.iter().fold(0.0, |all, term| greatest_divisor(all, whole(term).abs()));
    let fine = terms.iter().all(|term| whole(term).fract() == 0.0)
        && below <= MOST
        && (1.0..=MOST).contains(&divisor);
    let sign = if terms.iter().all(|term| term.fraction.above < 0.0) { -1.0 } else { 1.0 };
    let mut factor = Term::number(sign * if fine { below } else { 1.0 });
    if fine {
        factor = factor.times(&Term::number(divisor).power(-1).unwrap_or_else(|| Term::number(1.0)));
    }
    terms.iter().map(|term| term.times(&factor)).collect()
}

fn greatest_divisor(mut a: f64, mut b: f64) -> f64 {
    while b > 0.0 {
        (a, b) = (b, a % b);
    }
    a
}

fn least_multiple(a: f64, b: f64) -> f64 {
    a / greatest_divisor(a, b).max(1.0) * b
}

/// The formula with sine and cosine of the variable, and of `x + o` and `o - x`, replaced by names.
fn replaced(formula: &Expression, name: &str) -> Expression {
    if let Node::Call(function @ (Function::Sin | Function::Cos), arguments) = formula.node()
        && let Some((slope, offset)) = arguments.first().and_then(|angle| angle.is_affine_in(name))
        && let Some(sign) = slope.as_number().filter(|slope| slope.abs() == 1.0)
    {
        let (cosine, sine) =
            (Expression::variable(COSINE), Expression::variable(SINE) * Expression::number(sign));
        return match function {
            Function::Cos => cosine * offset.cos() - sine * offset.sin(),
            _ => sine * offset.cos() + cosine * offset.sin(),
        }
        .simplified();
    }
    formula.map_parts(&mut |part| replaced(part, name))
}

/// Formulas without the factors that all of them have, signs of sums aside: a direction stays what it is but for its
/// length and sense.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::formula::{Expression, without_common_factors};
/// let normal = ["r*t*sin(a)", "-r*t*cos(a)", "0"].map(|text| Expression::parse(text).unwrap());
/// assert_eq!(without_common_factors(&normal).map(|x| x.to_string()), ["sin(a)", "-cos(a)", "0"]);
/// ```
pub fn without_common_factors<const N: usize>(formulas: &[Expression; N]) -> [Expression; N] {
    let mut terms = formulas.each_ref().map(|formula| {
        let mut term = Term::of(&formula.simplest());
        // Sums that differ by their sign only become one factor.
        for (factor, n) in &mut term.factors {
            if let Some(other) =
                Some(&*factor).filter(|f| matches!(f.node(), Node::Sum(_))).and_then(opposite)
            {
                *factor = other;
                if *n % 2 != 0 {
                    term.fraction = term.fraction.negative();
                }
            }
        }
        term
    });
    let nonzero = |term: &&Term| term.fraction.above != 0.0;
    let Some(first) = terms.iter().find(nonzero).cloned() else { return formulas.clone() };
    let exponent = |term: &Term, factor: &Expression| {
        term.factors.iter().find(|(f, _)| f == factor).map_or(0, |(_, n)| *n)
    };
    let mut candidates: Vec<Expression> = Vec::new();
    for (factor, _) in terms.iter().filter(nonzero).flat_map(|term| &term.factors) {
        if !candidates.contains(factor) {
            candidates.push(factor.clone());
        }
    }
    let least = |factor: &Expression| {
        terms
            .iter()
            .filter(nonzero)
            .map(|term| exponent(term, factor))
            .fold(exponent(&first, factor), i32::min)
    };
    let common: Vec<(Expression, i32)> = candidates
        .into_iter()
        .map(|f| (least(&f), f))
        .filter(|(n, _)| *n != 0)
        .map(|(n, f)| (f, -n))
        .collect();
    let inverse = Term { factors: common, ..Term::number(1.0) };
    terms.iter_mut().for_each(|term| *term = term.times(&inverse));
    terms.map(|term| term.expression().simplest())
}
