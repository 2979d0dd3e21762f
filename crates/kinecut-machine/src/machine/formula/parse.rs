//! Reading formulas: recursive descent with budgets of length and depth.

use super::token::{Token, tokens};
use super::{Expression, Function};
use crate::base::{Code, Error, Finding, Result};

/// Most characters of a formula that is read.
pub const MOST_CHARACTERS: usize = 10_000;
/// Deepest tree of a formula that is read. Every walk through a tree is a recursion of this depth, so it must be small
/// against the stack of a thread; no formula of the trade comes near it.
pub const MOST_DEPTH: usize = 100;
/// Least likeness (Jaro and Winkler) of a misspelt function to one that is proposed.
pub(super) const LIKENESS: f64 = 0.75;

impl Expression {
    /// Reads a formula.
    ///
    /// # Errors
    /// `KC1101` with the column of the fault and what was expected there; also for more than [`MOST_CHARACTERS`]
    /// characters, or brackets, powers or quotients nested deeper than [`MOST_DEPTH`].
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// assert_eq!(Expression::parse("-2^2 + 3e-1*10").unwrap().constant(), Some(-1.0));
    /// let error = Expression::parse("R*coss(phi)").unwrap_err();
    /// assert!(error.to_string().contains("column 3") && error.to_string().contains("`cos`"));
    /// ```
    pub fn parse(text: &str) -> Result<Expression> {
        let length = text.chars().count();
        if length > MOST_CHARACTERS {
            return Err(Finding::error(Code::EXPRESSION_SYNTAX, "a formula is too long")
                .value(length as f64, "characters")
                .bound(MOST_CHARACTERS as f64, "characters")
                .help("divide it into several")
                .into());
        }
        let mut parser = Parser { text, tokens: tokens(text), next: 0, depth: 0 };
        let formula = parser.sum()?;
        match parser.peek() {
            Token::End => Ok(formula),
            Token::Sign(')') => Err(parser.fault("`)` closes nothing", "take it away, or open it before")),
            _ => Err(parser.expected("an operator (+ - * / ^) or the end")),
        }
    }
}

impl std::str::FromStr for Expression {
    type Err = Error;

    fn from_str(text: &str) -> Result<Expression> {
        Expression::parse(text)
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<(Token, usize)>,
    next: usize,
    depth: usize,
}

impl Parser<'_> {
    fn peek(&self) -> &Token {
        &self.tokens[self.next].0
    }

    /// Steps over the next word; the end is never passed.
    fn step(&mut self) {
        self.next = (self.next + 1).min(self.tokens.len() - 1);
    }

    /// Takes the next word if it is this sign.
    fn take(&mut self, sign: char) -> bool {
        let there = *self.peek() == Token::Sign(sign);
        if there {
            self.step();
        }
        there
    }

    fn fault(&self, what: &str, help: &str) -> Error {
        let column = self.tokens[self.next].1;
        Finding::error(
            Code::EXPRESSION_SYNTAX,
            format!("formula `{}`, column {column}: {what}", shown(self.text)),
        )
        .help(help)
        .into()
    }

    fn expected(&self, what: &str) -> Error {
        let found = self.peek().said();
        self.fault(&format!("{found} where {what} is expected"), "write it as in \"R0 + a*cos(2*pi*t/p)\"")
    }

    /// Checks the depth of a tree that was built.
    fn shallow(&self, built: Expression) -> Result<Expression> {
        if built.depth() > MOST_DEPTH { Err(self.too_deep()) } else { Ok(built) }
    }

    fn too_deep(&self) -> Error {
        self.fault(&format!("nested deeper than {MOST_DEPTH}"), "divide it into several formulas")
    }

    /// Reads one level deeper.
    fn deeper(&mut self, read: fn(&mut Self) -> Result<Expression>) -> Result<Expression> {
        if self.depth >= MOST_DEPTH {
            return Err(self.too_deep());
        }
        self.depth += 1;
        let found = read(self);
        self.depth -= 1;
        found
    }

    fn sum(&mut self) -> Result<Expression> {
        let mut parts = Vec::new();
        let mut minus = !self.take('+') && self.take('-');
        loop {
            let part = self.product()?;
            parts.push(if minus { Expression::negative(part) } else { part });
            minus = match self.peek() {
                Token::Sign('+') => false,
                Token::Sign('-') => true,
                _ => break,
            };
            self.step();
        }
        self.shallow(Expression::sum(parts))
    }

    fn product(&mut self) -> Result<Expression> {
        let mut parts = vec![self.factor()?];
        loop {
            if self.take('*') {
                parts.push(self.factor()?);
            } else if self.take('/') {
                let above = Expression::product(std::mem::take(&mut parts));
                let below = self.factor()?;
                parts.push(self.shallow(Expression::quotient(above, below))?);
            } else {
                return self.shallow(Expression::product(parts));
            }
        }
    }

    fn factor(&mut self) -> Result<Expression> {
        if self.take('+') {
            return self.deeper(Self::factor);
        }
        if self.take('-') {
            let of = self.deeper(Self::factor)?;
            return self.shallow(Expression::negative(of));
        }
        let base = self.atom()?;
        if self.take('^') {
            let exponent = self.deeper(Self::factor)?;
            return self.shallow(Expression::power(base, exponent));
        }
        Ok(base)
    }

    fn atom(&mut self) -> Result<Expression> {
        match self.peek().clone() {
            Token::Number(value) => {
                self.step();
                Ok(Expression::number(value))
            }
            Token::Sign('(') => {
                self.step();
                let inside = self.deeper(Self::sum)?;
                self.close()?;
                Ok(inside)
            }
            Token::Name(name) => {
                if self.tokens.get(self.next + 1).is_some_and(|(t, _)| *t == Token::Sign('(')) {
                    return self.call(&name);
                }
                if Function::named(&name).is_some() {
                    let help = format!("write `{name}(...)`");
                    return Err(self.fault(&format!("the function `{name}` stands without brackets"), &help));
                }
                self.step();
                Ok(Expression::variable(&name))
            }
            Token::Wrong(written) if written.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
                Err(self.fault(&format!("the number {written} is too large"), "write a finite number"))
            }
            _ => Err(self.expected("a number, a name or `(`")),
        }
    }

    fn call(&mut self, name: &str) -> Result<Expression> {
        let power = name == "pow";
        let function = Function::named(name);
        if function.is_none() && !power {
            let known = Function::ALL.iter().map(|f| f.name()).chain(["log", "pow"]);
            let near = known
                .map(|known| (strsim::jaro_winkler(name, known), known))
                .filter(|(likeness, _)| *likeness >= LIKENESS)
                .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(a.1)));
            let help = match near {
                Some((_, near)) => format!("did you mean `{near}`?"),
                None => format!("known are {}, log and pow; a product needs `*`", known_functions()),
            };
            return Err(self.fault(&format!("`{name}` is no function"), &help));
        }
        let place = self.next;
        self.step();
        self.step();
        let mut arguments = vec![self.deeper(Self::sum)?];
        while self.take(',') {
            arguments.push(self.deeper(Self::sum)?);
        }
        self.close()?;
        let (least, most) = function.map_or((2, 2), Function::arguments);
        if arguments.len() < least || arguments.len() > most {
            self.next = place;
            let needs = if least == most { least.to_string() } else { format!("{least} or more") };
            let help = "separate the arguments by commas; a decimal fraction has a point";
            return Err(
                self.fault(&format!("`{name}` has {} arguments and needs {needs}", arguments.len()), help)
            );
        }
        self.shallow(match (function, arguments.pop(), arguments.pop()) {
            (None, Some(exponent), Some(base)) => Expression::power(base, exponent),
            (Some(function), last, before) => {
                arguments.extend(before);
                arguments.extend(last);
                Expression::call(function, arguments)
            }
            (None, ..) => return Err(self.expected("two arguments")),
        })
    }

    fn close(&mut self) -> Result<()> {
        if self.take(')') { Ok(()) } else { Err(self.expected("`)` or an operator")) }
    }
}

/// The formula as shown in a message, long ones cut off.
fn shown(text: &str) -> String {
    const MOST: usize = 80;
    if text.chars().count() <= MOST {
        text.to_owned()
    } else {
        text.chars().take(MOST).chain(['…']).collect()
    }
}

fn known_functions() -> String {
    Function::ALL.map(Function::name).join(" ")
}
