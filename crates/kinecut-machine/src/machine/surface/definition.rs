//! Surfaces by their generating lines: a directrix and a generatrix, each a chain of elementary motions.
//!
//! The shape-generation function of the surface is the product of the motions of both chains (Danilchenko et al.,
//! equation 1); elements that the directrix ends with and the generatrix begins with are written once.

use glam::DVec3;

use super::{ChainElement, word};
use crate::machine::formula::Expression;
use crate::machine::{Elementary, Word};

/// A free variable of a surface with its domain.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name in the laws.
    pub name: String,
    /// Least value [mm or rad].
    pub from: f64,
    /// Greatest value [mm or rad].
    pub to: f64,
}

impl Variable {
    /// A variable over a domain.
    pub fn new(name: &str, from: f64, to: f64) -> Variable {
        Variable { name: name.to_owned(), from, to }
    }

    /// Middle of the domain.
    pub fn middle(&self) -> f64 {
        0.5 * (self.from + self.to)
    }

    /// Value at a fraction of the domain; both ends are hit exactly.
    pub fn at(&self, fraction: f64) -> f64 {
        self.from * (1.0 - fraction) + self.to * fraction
    }
}

/// A surface by its generating lines.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneratedSurface {
    /// Short name, in kebab case ("inclined-helicoid").
    pub name: String,
    /// Title in words.
    pub title: String,
    /// Parameters with their values [mm or rad].
    pub parameters: Vec<(String, f64)>,
    /// The two free variables; the normal is that of their order.
    pub variables: [Variable; 2],
    /// Chain of the line along which the generatrix is carried.
    pub directrix: Vec<ChainElement>,
    /// Chain of the line that is carried.
    pub generatrix: Vec<ChainElement>,
    /// True if the product of the derivatives by the first and by the second variable points into the material.
    pub inward: bool,
    /// Directions of the motions 7, 8, 9 at home, of any length; `None` for those that are not used.
    pub inclined: [Option<DVec3>; 3],
    /// A formula in X, Y, Z and the parameters that vanishes on the surface and is positive outside of the material.
    pub implicit: Option<Expression>,
}

impl GeneratedSurface {
    /// Number of elements that the directrix ends with and the generatrix begins with.
    pub fn overlap(&self) -> usize {
        let (d, g) = (&self.directrix, &self.generatrix);
        (0..=d.len().min(g.len())).rev().find(|&n| d[d.len() - n..] == g[..n]).unwrap_or(0)
    }

    /// The primary chain, from the work to the point of the surface: directrix and generatrix, with what they share
    /// written once (the paper's common parameter).
    pub fn chain(&self) -> Vec<ChainElement> {
        self.directrix.iter().chain(&self.generatrix[self.overlap()..]).cloned().collect()
    }

    /// The primary code: the motions of [`GeneratedSurface::chain`].
    pub fn code(&self) -> Word {
        word(&self.chain())
    }

    /// The chain in its canonical order: the smallest motion that can be brought to the front comes first, and so on.
    /// Equal neighbours stay apart, because they have laws of their own.
    pub fn canonical(&self) -> Vec<ChainElement> {
        let mut rest = self.chain();
        let mut sorted = Vec::with_capacity(rest.len());
        while !rest.is_empty() {
            let free =
                (0..rest.len()).filter(|&i| rest[..i].iter().all(|e| e.motion.commutes(rest[i].motion)));
            let Some(first) = free.min_by_key(|&i| (rest[i].motion, i)) else { break };
            sorted.push(rest.remove(first));
        }
        sorted
    }

    /// True if the law of an element contains a free variable: it is forming then, otherwise setting.
    pub fn is_forming(&self, element: &ChainElement) -> bool {
        self.variables.iter().any(|v| element.has(&v.name))
    }

    /// A law with the numbers of the parameters put in.
    pub fn with_numbers(&self, law: &Expression) -> Expression {
        let number = |name: &str| {
            let variable = self.variables.iter().any(|v| v.name == name);
            let found = self.parameters.iter().find(|(n, _)| !variable && n == name);
            found.map(|(_, value)| Expression::number(*value))
        };
        law.substitute(&number).simplified()
    }

    /// Direction of a motion at home: a unit vector; Z for an inclined one that is not declared.
    pub fn direction(&self, motion: Elementary) -> DVec3 {
        motion.direction().unwrap_or_else(|| {
            let declared =
                self.inclined.get(usize::from(motion.digit().saturating_sub(7))).copied().flatten();
            declared.and_then(DVec3::try_normalize).unwrap_or(DVec3::Z)
        })
    }

    /// The parameter of this name [mm or rad].
    pub fn parameter(&self, name: &str) -> Option<f64> {
        self.parameters.iter().find(|(n, _)| n == name).map(|(_, value)| *value)
    }

    /// The same surface with another value of a parameter [mm or rad]; a new name is added.
    #[must_use]
    pub fn with(mut self, name: &str, value: f64) -> GeneratedSurface {
        match self.parameters.iter_mut().find(|(n, _)| n == name) {
            Some((_, old)) => *old = value,
            None => self.parameters.push((name.to_owned(), value)),
        }
        self
    }

    /// The same surface over another domain of one of its variables [mm or rad]; another name changes nothing.
    #[must_use]
    pub fn over(mut self, name: &str, from: f64, to: f64) -> GeneratedSurface {
        if let Some(variable) = self.variables.iter_mut().find(|v| v.name == name) {
            (variable.from, variable.to) = (from, to);
        }
        self
    }
}
