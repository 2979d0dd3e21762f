//! The tree of a formula: its nodes, and what is read off by walking through it.

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;

use super::Function;
use super::power::{integer_power, powi};

/// A formula; an immutable tree, cheap to clone.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::formula::Expression;
/// let profile = Expression::parse("R0 + a*cos(2*pi*t/p)").unwrap();
/// assert_eq!(profile.names(), ["R0", "a", "p", "t"]);
/// let bound = profile.bind(&["R0", "a", "p", "t"]).unwrap();
/// assert_eq!(bound.value(&[20.0, 2.0, 10.0, 5.0]), 18.0);
/// assert_eq!(profile.derivative("t").to_string(), "-2*pi*a*sin(2*pi*t/p)/p");
/// ```
#[derive(Clone)]
pub struct Expression(Arc<Inner>);

struct Inner {
    node: Node,
    depth: usize,
}

/// A node of a formula. Sums and products have two or more parts; a difference is a sum with a negative part.
#[derive(Clone, Debug)]
pub enum Node {
    /// A number.
    Number(f64),
    /// The ratio of a circle's circumference to its diameter.
    Pi,
    /// The base of natural logarithms, unless `e` is given as a name.
    Euler,
    /// A variable.
    Variable(Arc<str>),
    /// A sum.
    Sum(Vec<Expression>),
    /// A product.
    Product(Vec<Expression>),
    /// The first divided by the second.
    Quotient(Expression, Expression),
    /// The first to the power of the second.
    Power(Expression, Expression),
    /// The opposite; never of a number.
    Negative(Expression),
    /// A function of its arguments.
    Call(Function, Vec<Expression>),
}

impl Expression {
    pub(super) fn from_node(node: Node) -> Expression {
        let below = match &node {
            Node::Number(_) | Node::Pi | Node::Euler | Node::Variable(_) => 0,
            Node::Sum(parts) | Node::Product(parts) | Node::Call(_, parts) => {
                parts.iter().map(Expression::depth).max().unwrap_or(0)
            }
            Node::Quotient(a, b) | Node::Power(a, b) => a.depth().max(b.depth()),
            Node::Negative(a) => a.depth(),
        };
        Expression(Arc::new(Inner { node, depth: below + 1 }))
    }

    /// A number.
    pub fn number(value: f64) -> Expression {
        // The zero of negative sign would print as a difference from nothing.
        Expression::from_node(Node::Number(if value == 0.0 { 0.0 } else { value }))
    }

    /// A variable; `pi` and `e` are the constants, but for `e` where it is given as a name: an eccentricity, say.
    pub fn variable(name: &str) -> Expression {
        Expression::from_node(match name {
            "pi" => Node::Pi,
            "e" => Node::Euler,
            _ => Node::Variable(name.into()),
        })
    }

    /// The root of the tree.
    pub fn node(&self) -> &Node {
        &self.0.node
    }

    /// Number of nodes on the longest way from the root to a leaf.
    pub fn depth(&self) -> usize {
        self.0.depth
    }

    /// The number, if the formula is one literally.
    pub fn as_number(&self) -> Option<f64> {
        match self.node() {
            Node::Number(value) => Some(*value),
            _ => None,
        }
    }

    /// Names of the variables, sorted, each once; without `e`, which has a value of its own.
    pub fn names(&self) -> Vec<String> {
        let mut names = BTreeSet::new();
        self.visit(&mut |node| {
            if let Node::Variable(name) = node {
                names.insert(name.to_string());
            }
        });
        names.into_iter().collect()
    }

    /// True if a variable occurs; Euler's number counts as the variable `e`.
    pub fn has(&self, name: &str) -> bool {
        let mut found = false;
        self.visit(&mut |node| found |= matches!(node, Node::Variable(n) if &**n == name));
        if name == "e" {
            self.visit(&mut |node| found |= matches!(node, Node::Euler));
        }
        found
    }

    /// Number of nodes.
    pub fn size(&self) -> usize {
        let mut size = 0;
        self.visit(&mut |_| size += 1);
        size
    }

    pub(super) fn visit(&self, see: &mut dyn FnMut(&Node)) {
        see(self.node());
        match self.node() {
            Node::Number(_) | Node::Pi | Node::Euler | Node::Variable(_) => {}
            Node::Sum(parts) | Node::Product(parts) | Node::Call(_, parts) => {
                parts.iter().for_each(|part| part.visit(see));
            }
            Node::Quotient(a, b) | Node::Power(a, b) => {
                a.visit(see);
                b.visit(see);
            }
            Node::Negative(a) => a.visit(see),
        }
    }

    /// The tree with each part replaced by what `f` makes of it.
    pub(super) fn map_parts(&self, f: &mut dyn FnMut(&Expression) -> Expression) -> Expression {
        match self.node() {
            Node::Number(_) | Node::Pi | Node::Euler | Node::Variable(_) => self.clone(),
            Node::Sum(parts) => Expression::sum(parts.iter().map(f).collect()),
            Node::Product(parts) => Expression::product(parts.iter().map(f).collect()),
            Node::Call(function, parts) => Expression::call(*function, parts.iter().map(f).collect()),
            Node::Quotient(a, b) => Expression::quotient(f(a), f(b)),
            Node::Power(a, b) => Expression::power(f(a), f(b)),
            Node::Negative(a) => Expression::negative(f(a)),
        }
    }

    /// With variables replaced; those for which `with` has nothing stay. What is put in is not searched again.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let law = Expression::parse("p*phi/(2*pi)").unwrap();
    /// let law = law.substitute(&|name| (name == "p").then(|| Expression::number(6.0)));
    /// assert_eq!(law.to_string(), "6*phi/(2*pi)");
    /// ```
    #[must_use]
    pub fn substitute(&self, with: &dyn Fn(&str) -> Option<Expression>) -> Expression {
        match self.node() {
            Node::Variable(name) => with(name).unwrap_or_else(|| self.clone()),
            Node::Euler => with("e").unwrap_or_else(|| self.clone()),
            _ => self.map_parts(&mut |part| part.substitute(with)),
        }
    }

    /// The value, if there are no variables.
    pub fn constant(&self) -> Option<f64> {
        let all = |parts: &[Expression]| parts.iter().map(Expression::constant).collect::<Option<Vec<f64>>>();
        Some(match self.node() {
            Node::Number(value) => *value,
            Node::Pi => std::f64::consts::PI,
            Node::Euler => std::f64::consts::E,
            Node::Variable(_) => return None,
            Node::Sum(parts) => all(parts)?.into_iter().reduce(|a, b| a + b).unwrap_or(0.0),
            Node::Product(parts) => all(parts)?.into_iter().reduce(|a, b| a * b).unwrap_or(1.0),
            Node::Quotient(a, b) => a.constant()? / b.constant()?,
            Node::Power(a, b) => {
                let (base, exponent) = (a.constant()?, b.constant()?);
                integer_power(exponent).map_or_else(|| base.powf(exponent), |n| powi(base, n))
            }
            Node::Negative(a) => -a.constant()?,
            Node::Call(function, parts) => match all(parts)?.as_slice() {
                [x] => function.value(*x),
                several => {
                    several.iter().copied().reduce(|a, b| function.value_of_two(a, b)).unwrap_or(f64::NAN)
                }
            },
        })
    }
}

impl Node {
    /// Place of the kind of node in the order of formulas.
    fn rank(&self) -> u8 {
        match self {
            Node::Number(_) => 0,
            Node::Pi => 1,
            Node::Euler => 2,
            Node::Variable(_) => 3,
            Node::Power(..) => 4,
            Node::Product(_) => 5,
            Node::Quotient(..) => 6,
            Node::Negative(_) => 7,
            Node::Sum(_) => 8,
            Node::Call(..) => 9,
        }
    }
}

/// An order of the trees as they are written, not of their values.
impl Ord for Expression {
    fn cmp(&self, other: &Expression) -> Ordering {
        if Arc::ptr_eq(&self.0, &other.0) {
            return Ordering::Equal;
        }
        match (self.node(), other.node()) {
            (Node::Number(a), Node::Number(b)) => a.total_cmp(b),
            (Node::Variable(a), Node::Variable(b)) => a.cmp(b),
            (Node::Sum(a), Node::Sum(b)) | (Node::Product(a), Node::Product(b)) => a.cmp(b),
            (Node::Quotient(a, b), Node::Quotient(c, d)) | (Node::Power(a, b), Node::Power(c, d)) => {
                a.cmp(c).then_with(|| b.cmp(d))
            }
            (Node::Negative(a), Node::Negative(b)) => a.cmp(b),
            (Node::Call(f, a), Node::Call(g, b)) => f.cmp(g).then_with(|| a.cmp(b)),
            (a, b) => a.rank().cmp(&b.rank()),
        }
    }
}

impl PartialOrd for Expression {
    fn partial_cmp(&self, other: &Expression) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Equal as written: `a + b` and `b + a` differ.
impl PartialEq for Expression {
    fn eq(&self, other: &Expression) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Expression {}

impl fmt::Debug for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{self}`")
    }
}
