//! Test of a formula for being affine in a variable.

use super::{Expression, Function, Node};

impl Expression {
    /// Slope and offset, if the formula is `slope*x + offset` with both free of `x`.
    ///
    /// The test is symbolic: the derivative, multiplied out if need be, does not hold the variable. An affine formula in
    /// a disguise that this does not see through gives none; what is given is exact.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let law = Expression::parse("p*phi/(2*pi) + z0").unwrap();
    /// let (slope, offset) = law.is_affine_in("phi").unwrap();
    /// assert_eq!((slope.to_string(), offset.to_string()), ("p/(2*pi)".to_owned(), "z0".to_owned()));
    /// assert!(law.is_affine_in("p").is_some());
    /// assert!(Expression::parse("cos(phi)").unwrap().is_affine_in("phi").is_none());
    /// ```
    pub fn is_affine_in(&self, name: &str) -> Option<(Expression, Expression)> {
        let simple = self.simplified();
        let tried = [simple.clone(), simple.expanded()];
        tried.into_iter().find_map(|formula| {
            if broken(&formula, name) {
                return None;
            }
            let slope = formula.derivative(name);
            let slope = if slope.has(name) { slope.expanded() } else { slope };
            if slope.has(name) {
                return None;
            }
            let offset = formula.substitute(&|n| (n == name).then(|| Expression::number(0.0))).simplified();
            Some((slope, offset))
        })
    }
}

/// True if the variable is inside a function with steps, corners or a cut, where its derivative may be free of the
/// variable though it is another line on each side; or in a denominator, where the value at zero does not belong to the
/// line.
fn broken(formula: &Expression, name: &str) -> bool {
    use Function::{Abs, Atan2, Floor, Hypot, Max, Min, Sign};
    let mut found = false;
    formula.visit(&mut |node| {
        if let Node::Call(Floor | Sign | Abs | Atan2 | Hypot | Min | Max, arguments) = node {
            found |= arguments.iter().any(|argument| argument.has(name));
        }
        found |= match node {
            Node::Quotient(_, below) => below.has(name),
            Node::Power(base, exponent) => {
                base.has(name) && !matches!(exponent.node(), Node::Number(n) if *n >= 0.0)
            }
            _ => false,
        };
    });
    found
}
