//! Formulas bound to an order of their names: flat programs for a stack, without allocation.

use std::sync::Arc;

use super::power::{integer_power, powi};
use super::{Expression, Function, Node};
use crate::base::{Code, Finding, Result};

/// Stack of nearly all formulas; a deeper one costs a little more.
const SHALLOW: usize = 16;
/// Stack of the deepest formula that can be bound.
const DEEP: usize = 256;
/// Most steps of a bound formula; only formulas that were put into one another many times have more.
const MOST_STEPS: usize = 1_000_000;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Step {
    Number(f64),
    Variable(u32),
    Add,
    Subtract,
    Multiply,
    Divide,
    Negate,
    Power,
    Whole(i32),
    One(Function),
    Two(Function),
}

/// A formula whose names have places in a list of values; cheap to clone.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundFormula {
    steps: Arc<[Step]>,
    stack: usize,
}

impl Expression {
    /// Binds names to places in a list of values.
    ///
    /// # Errors
    /// `KC1102` for a name that is not among `names`; `KC1103` for a formula that is too large.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let law = Expression::parse("t**2/(4*f)").unwrap().bind(&["f", "t"]).unwrap();
    /// assert_eq!(law.value(&[15.0, 30.0]), 15.0);
    /// ```
    pub fn bind(&self, names: &[&str]) -> Result<BoundFormula> {
        let mut steps = Vec::new();
        compile(self, names, &mut steps)?;
        let (mut height, mut stack) = (0_usize, 0);
        for step in &steps {
            match step {
                Step::Number(_) | Step::Variable(_) => height += 1,
                Step::Add | Step::Subtract | Step::Multiply | Step::Divide | Step::Power | Step::Two(_) => {
                    height -= 1
                }
                Step::Negate | Step::Whole(_) | Step::One(_) => {}
            }
            stack = stack.max(height);
        }
        if stack > DEEP {
            return Err(Finding::error(Code::EXPRESSION_SIZE, "a formula is nested too deep")
                .value(stack as f64, "")
                .bound(DEEP as f64, "")
                .help("divide it into several formulas")
                .into());
        }
        Ok(BoundFormula { steps: steps.into(), stack })
    }
}

fn compile(formula: &Expression, names: &[&str], steps: &mut Vec<Step>) -> Result<()> {
    if steps.len() >= MOST_STEPS {
        return Err(Finding::error(Code::EXPRESSION_SIZE, "a formula has too many steps")
            .value(steps.len() as f64, "")
            .bound(MOST_STEPS as f64, "")
            .help("divide it into several formulas")
            .into());
    }
    match formula.node() {
        Node::Number(value) => steps.push(Step::Number(*value)),
        Node::Pi => steps.push(Step::Number(std::f64::consts::PI)),
        Node::Euler => steps.push(match names.iter().position(|known| *known == "e") {
            Some(place) => Step::Variable(place as u32),
            None => Step::Number(std::f64::consts::E),
        }),
        Node::Variable(name) => match names.iter().position(|known| *known == &**name) {
            Some(place) => steps.push(Step::Variable(place as u32)),
            None => return Err(unknown(formula, name, names)),
        },
        Node::Sum(parts) => {
            for (i, part) in parts.iter().enumerate() {
                match part.node() {
                    Node::Negative(of) if i > 0 => {
                        compile(of, names, steps)?;
                        steps.push(Step::Subtract);
                    }
                    _ => {
                        compile(part, names, steps)?;
                        if i > 0 {
                            steps.push(Step::Add);
                        }
                    }
                }
            }
        }
        Node::Product(parts) => {
            for (i, part) in parts.iter().enumerate() {
                compile(part, names, steps)?;
                if i > 0 {
                    steps.push(Step::Multiply);
                }
            }
        }
        Node::Quotient(above, below) => {
            compile(above, names, steps)?;
            compile(below, names, steps)?;
            steps.push(Step::Divide);
        }
        Node::Power(base, exponent) => {
            compile(base, names, steps)?;
            if let Some(whole) = exponent.as_number().and_then(integer_power) {
                steps.push(Step::Whole(whole));
            } else {
                compile(exponent, names, steps)?;
                steps.push(Step::Power);
            }
        }
        Node::Negative(of) => {
            compile(of, names, steps)?;
            steps.push(Step::Negate);
        }
        Node::Call(function, arguments) => {
            for (i, argument) in arguments.iter().enumerate() {
                compile(argument, names, steps)?;
                if i > 0 {
                    steps.push(Step::Two(*function));
                }
            }
            if arguments.len() == 1 {
                steps.push(Step::One(*function));
            }
        }
    }
    Ok(())
}

fn unknown(formula: &Expression, name: &str, names: &[&str]) -> crate::base::Error {
    let near = names
        .iter()
        .map(|known| (strsim::jaro_winkler(name, known), *known))
        .filter(|(likeness, _)| *likeness >= super::parse::LIKENESS)
        .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(a.1)));
    let known = if names.is_empty() {
        "no names are known here".to_owned()
    } else {
        format!("known are {}", names.join(", "))
    };
    let help = match near {
        Some((_, near)) => format!("did you mean `{near}`? {known}"),
        None => known,
    };
    Finding::error(Code::EXPRESSION_NAME, format!("`{name}` is not known (in `{formula}`)")).help(help).into()
}

impl BoundFormula {
    /// The value for these values of the names, in the order of binding. A value that is missing is `NaN`.
    pub fn value(&self, values: &[f64]) -> f64 {
        if self.stack <= SHALLOW {
            run(&self.steps, values, &mut [0.0; SHALLOW])
        } else {
            run(&self.steps, values, &mut [0.0; DEEP])
        }
    }
}

fn run(steps: &[Step], values: &[f64], stack: &mut [f64]) -> f64 {
    // `top` is the value on top of the stack, `stack[..height]` is below it.
    let (mut top, mut height) = (0.0, 0_usize);
    for step in steps {
        match *step {
            Step::Number(value) => {
                stack[height] = top;
                height += 1;
                top = value;
            }
            Step::Variable(place) => {
                stack[height] = top;
                height += 1;
                top = values.get(place as usize).copied().unwrap_or(f64::NAN);
            }
            Step::Negate => top = -top,
            Step::Whole(2) => top *= top,
            Step::Whole(exponent) => top = powi(top, exponent),
            Step::One(function) => top = function.value(top),
            two => {
                height -= 1;
                let below = stack[height];
                top = match two {
                    Step::Add => below + top,
                    Step::Subtract => below - top,
                    Step::Multiply => below * top,
                    Step::Divide => below / top,
                    Step::Power => below.powf(top),
                    Step::Two(function) => function.value_of_two(below, top),
                    _ => f64::NAN,
                };
            }
        }
    }
    top
}
