//! Checks of the definition of a surface.

use std::collections::BTreeSet;

use super::{GeneratedSurface, chain_text};
use crate::base::{Code, Error, Finding, Result};

/// Most elements of a chain: redistributions grow as powers of two.
pub const LONGEST_CHAIN: usize = 12;

/// Samples of each variable in the search for a regular point.
const SAMPLES: usize = 13;
/// Sine of the angle between the derivatives below which they count as parallel in a whole domain.
const PARALLEL: f64 = 1e-9;

impl GeneratedSurface {
    /// Whether the definition makes a surface: two free variables that are both used, no unknown name, no two equal
    /// constant motions that stand next to one another, all values finite, and derivatives that are somewhere
    /// independent.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::surface::{GeneratedSurface, parse_chain};
    /// let mut cone = GeneratedSurface::named("cone").unwrap();
    /// assert!(cone.check().is_ok());
    /// cone.generatrix = parse_chain("1(Q) 5(-alpha) 3(z)").unwrap();
    /// assert!(cone.check().unwrap_err().to_string().contains("`Q`"));
    /// ```
    ///
    /// # Errors
    /// `KC1104` for the definition, `KC1105` if it makes no surface.
    pub fn check(&self) -> Result<()> {
        self.check_names()?;
        self.check_chain()?;
        self.check_shape()
    }

    fn fault(&self, what: impl Into<String>) -> Finding {
        Finding::error(Code::SURFACE_FORM, format!("surface `{}` {}", self.name, what.into()))
    }

    fn check_names(&self) -> Result<()> {
        let [u, v] = &self.variables;
        let mut known = BTreeSet::new();
        let names =
            self.variables.iter().map(|v| &v.name).chain(self.parameters.iter().map(|(name, _)| name));
        for name in names {
            if !known.insert(name.as_str()) {
                let help = "variables and parameters need names of their own";
                return Err(self.fault(format!("has the name `{name}` twice")).help(help).into());
            }
        }
        if let Some((name, value)) = self.parameters.iter().find(|(_, value)| !value.is_finite()) {
            let what = format!("has no number for the parameter `{name}`");
            return Err(self.fault(what).value(*value, "").help("give a finite number").into());
        }
        for variable in [u, v] {
            if !(variable.from < variable.to && variable.from.is_finite() && variable.to.is_finite()) {
                let what = format!("has an empty domain of `{}`", variable.name);
                let finding = self.fault(what).value(variable.from, "").bound(variable.to, "");
                return Err(finding.help("its least value must be below its greatest").into());
            }
        }
        let chain = self.chain();
        for name in chain.iter().flat_map(|e| e.law.names()) {
            if !known.contains(name.as_str()) {
                let all: Vec<&str> = known.iter().copied().collect();
                let help = format!("give it a value as a parameter; known are {}", all.join(", "));
                return Err(self
                    .fault(format!("has the unknown name `{name}` in its laws"))
                    .help(help)
                    .into());
            }
        }
        for variable in [u, v] {
            if !chain.iter().any(|e| e.has(&variable.name)) {
                let what = format!("does not use its variable `{}`", variable.name);
                let help = format!("a surface has two free variables; the chain is {}", chain_text(&chain));
                return Err(self.fault(what).help(help).into());
            }
        }
        Ok(())
    }

    fn check_chain(&self) -> Result<()> {
        let chain = self.chain();
        if chain.len() > LONGEST_CHAIN {
            let finding = self.fault("has too long a chain").value(chain.len() as f64, "motions");
            return Err(finding
                .bound(LONGEST_CHAIN as f64, "motions")
                .help("multiply constant motions out")
                .into());
        }
        for element in &chain {
            let digit = element.motion.digit();
            let declared = || self.inclined.get(usize::from(digit - 7)).copied().flatten();
            let known = digit < 7 || declared().is_some_and(|d| d.try_normalize().is_some());
            if !known {
                let what = format!("turns about the inclined axis {digit}, which has no direction");
                return Err(self.fault(what).help("declare its direction, a vector that is not zero").into());
            }
        }
        // Neighbours in the chain itself and in its canonical order, since equal motions may have others between them.
        let canonical = self.canonical();
        let neighbours = chain.windows(2).chain(canonical.windows(2));
        for pair in neighbours {
            let [a, b] = [&pair[0], &pair[1]];
            if a.motion == b.motion && !self.is_forming(a) && !self.is_forming(b) {
                let what =
                    format!("has motion {} twice in one place, as {a} and {b}, both constant", a.motion);
                let help = format!(
                    "write it once, as {}(({}) + ({})); where directrix and generatrix share a motion, give it the same law",
                    a.motion, a.law, b.law
                );
                return Err(self.fault(what).help(help).into());
            }
        }
        Ok(())
    }

    fn check_shape(&self) -> Result<()> {
        let shape = self.compiled()?;
        let [u, v] = &self.variables;
        let fraction = |i: usize| i as f64 / (SAMPLES - 1) as f64;
        let mut regular = 0.0_f64;
        for i in 0..SAMPLES {
            for j in 0..SAMPLES {
                let (a, b) = (u.at(fraction(i)), v.at(fraction(j)));
                let jet = shape.jet(a, b);
                if !jet.point().is_finite() {
                    let what = format!("has no point at {} = {a}, {} = {b}", u.name, v.name);
                    return Err(Error::from(
                        self.fault(what)
                            .help("a law has no value there: change the domain or the parameters"),
                    ));
                }
                let lengths = jet.tangents[0].length() * jet.tangents[1].length();
                if lengths > 0.0 {
                    regular = regular.max(jet.area().length() / lengths);
                }
            }
        }
        if regular > PARALLEL {
            return Ok(());
        }
        let what = format!("is a line: {} and {} move its point along the same curve", u.name, v.name);
        Err(Finding::error(Code::SURFACE_DEGENERATE, format!("surface `{}` {what}", self.name))
            .value(regular, "")
            .bound(PARALLEL, "")
            .help("the derivatives by the two variables must not be parallel")
            .into())
    }
}
