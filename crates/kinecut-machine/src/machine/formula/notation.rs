//! Formulas as they are printed in books: Greek letters, raised and lowered digits; text and MathML.

use std::fmt::Write as _;

use super::display::{Binding, Digits};
use super::{Expression, Function, Node};

/// Names of Greek letters; `th` and `bet` as short for two of them.
const GREEK: [(&str, char); 36] = [
    ("alpha", 'α'),
    ("beta", 'β'),
    ("bet", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("eps", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("th", 'θ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("rho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("upsilon", 'υ'),
    ("phi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Theta", 'Θ'),
    ("Lambda", 'Λ'),
    ("Xi", 'Ξ'),
    ("Pi", 'Π'),
    ("Sigma", 'Σ'),
    ("Phi", 'Φ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
    ("pi", 'π'),
];

/// A name as stem and index: `R0` is R and 0, `alpha_12` is α and 12, `r_b` is r and b.
fn stem_and_index(name: &str) -> (String, &str) {
    let (stem, index) = match name.trim_end_matches(|c: char| c.is_ascii_digit()) {
        // Digits at the end, or what follows the last underscore.
        stem if stem.len() < name.len() && !stem.is_empty() => {
            (stem.trim_end_matches('_'), &name[stem.len()..])
        }
        _ => match name.rsplit_once('_') {
            Some((stem, index)) if !stem.is_empty() && !index.is_empty() => (stem, index),
            _ => (name, ""),
        },
    };
    if stem.is_empty() {
        return (name.to_owned(), "");
    }
    let greek = GREEK.iter().find(|(written, _)| *written == stem);
    (greek.map_or_else(|| stem.to_owned(), |(_, letter)| letter.to_string()), index)
}

/// A name with Greek letters and lowered digits: `alpha1` is α₁.
///
/// ```
/// # use kinecut_machine as kinecut;
/// use kinecut::machine::formula::name_in_unicode;
/// assert_eq!(["phi", "R0", "rb", "alpha_1", "r_b"].map(name_in_unicode), ["φ", "R₀", "rb", "α₁", "r_b"]);
/// ```
pub fn name_in_unicode(name: &str) -> String {
    let (stem, index) = stem_and_index(name);
    let digits: Option<String> =
        index.chars().map(|c| c.to_digit(10).and_then(|d| char::from_u32(0x2080 + d))).collect();
    match digits {
        Some(digits) => stem + &digits,
        None => format!("{stem}_{index}"),
    }
}

/// Raised digits of a whole number.
fn raised(number: f64) -> Option<String> {
    /// More digits read worse than the plain form.
    const MOST: f64 = 1000.0;
    if number.fract() != 0.0 || number.abs() >= MOST {
        return None;
    }
    let digit = |c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        _ => '⁰',
    };
    Some(format!("{number}").chars().map(digit).collect())
}

/// The part of a sum without its sign, if it has one.
fn unsigned(part: &Expression) -> (bool, Expression) {
    match part.node() {
        Node::Negative(of) => (true, of.clone()),
        Node::Number(value) if *value < 0.0 => (true, Expression::number(-value)),
        _ => (false, part.clone()),
    }
}

impl Expression {
    /// As printed in books, in one line of text: `(R − z·sin α)·cos φ`.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let x = Expression::parse("(R0 - z*sin(alpha))*cos(phi)^2").unwrap();
    /// assert_eq!(x.unicode(), "(R₀ − z·sin α)·(cos φ)²");
    /// ```
    pub fn unicode(&self) -> String {
        let mut text = String::new();
        self.write_unicode(&mut text);
        text
    }

    fn unicode_part(&self, wants: Binding, text: &mut String) {
        if self.node().binding() >= wants {
            self.write_unicode(text);
        } else {
            text.push('(');
            self.write_unicode(text);
            text.push(')');
        }
    }

    fn write_unicode(&self, text: &mut String) {
        match self.node() {
            Node::Number(_) => text.push_str(&self.to_string().replace('-', "−")),
            Node::Pi => text.push('π'),
            Node::Euler => text.push('e'),
            Node::Variable(name) => text.push_str(&name_in_unicode(name)),
            Node::Negative(of) => {
                text.push('−');
                of.unicode_part(Binding::Product, text);
            }
            Node::Sum(parts) => {
                for (i, part) in parts.iter().enumerate() {
                    let (minus, part) = unsigned(part);
                    text.push_str(match (minus, i) {
                        (true, 0) => "−",
                        (false, 0) => "",
                        (true, _) => " − ",
                        (false, _) => " + ",
                    });
                    part.unicode_part(Binding::Product, text);
                }
            }
            Node::Product(parts) => {
                for (i, part) in parts.iter().enumerate() {
                    let leads = i == 0 && matches!(part.node(), Node::Quotient(..));
                    text.push_str(if i > 0 { "·" } else { "" });
                    part.unicode_part(if leads { Binding::Product } else { Binding::Power }, text);
                }
            }
            Node::Quotient(above, below) => {
                above.unicode_part(Binding::Product, text);
                text.push('/');
                below.unicode_part(Binding::Power, text);
            }
            Node::Power(base, exponent) => {
                if matches!(base.node(), Node::Call(..)) {
                    text.push('(');
                    base.write_unicode(text);
                    text.push(')');
                } else {
                    base.unicode_part(Binding::Atom, text);
                }
                match exponent.as_number().and_then(raised) {
                    Some(digits) => text.push_str(&digits),
                    None => {
                        text.push('^');
                        exponent.unicode_part(Binding::Atom, text);
                    }
                }
            }
            Node::Call(function, arguments) => {
                let plain = |e: &Expression| {
                    matches!(e.node(), Node::Variable(_) | Node::Pi)
                        || matches!(e.node(), Node::Number(value) if *value >= 0.0)
                };
                let name = if *function == Function::Sqrt { "√" } else { function.name() };
                text.push_str(name);
                match arguments.as_slice() {
                    [argument] if plain(argument) => {
                        text.push_str(if *function == Function::Sqrt { "" } else { " " });
                        argument.write_unicode(text);
                    }
                    _ => {
                        text.push('(');
                        for (i, argument) in arguments.iter().enumerate() {
                            text.push_str(if i > 0 { ", " } else { "" });
                            argument.write_unicode(text);
                        }
                        text.push(')');
                    }
                }
            }
        }
    }

    /// As presentation MathML: the content of `<math>...</math>`, one row.
    ///
    /// ```
    /// # use kinecut_machine as kinecut;
    /// use kinecut::machine::formula::Expression;
    /// let law = Expression::parse("t^2/(4*f)").unwrap();
    /// assert_eq!(law.mathml(), "<mfrac><msup><mi>t</mi><mn>2</mn></msup><mrow><mn>4</mn><mi>f</mi></mrow></mfrac>");
    /// ```
    pub fn mathml(&self) -> String {
        let mut text = String::new();
        self.write_mathml(&mut text);
        text
    }

    fn mathml_part(&self, wants: Binding, text: &mut String) {
        if self.node().binding() >= wants {
            self.write_mathml(text);
        } else {
            text.push_str("<mrow><mo>(</mo>");
            self.write_mathml(text);
            text.push_str("<mo>)</mo></mrow>");
        }
    }

    fn write_mathml(&self, text: &mut String) {
        match self.node() {
            Node::Number(value) if !value.is_finite() => text.push_str(if value.is_nan() {
                "<mi>NaN</mi>"
            } else if *value > 0.0 {
                "<mi>∞</mi>"
            } else {
                "<mrow><mo>−</mo><mi>∞</mi></mrow>"
            }),
            // Writing to a text cannot fail.
            Node::Number(value) if *value < 0.0 => {
                let _ = write!(text, "<mrow><mo>−</mo><mn>{}</mn></mrow>", Digits(-value));
            }
            Node::Number(value) => {
                let _ = write!(text, "<mn>{}</mn>", Digits(*value));
            }
            Node::Pi => text.push_str("<mi>π</mi>"),
            Node::Euler => text.push_str("<mi>e</mi>"),
            Node::Variable(name) => {
                let (stem, index) = stem_and_index(name);
                let _ = match index {
                    "" => write!(text, "<mi>{stem}</mi>"),
                    digits if digits.starts_with(|c: char| c.is_ascii_digit()) => {
                        write!(text, "<msub><mi>{stem}</mi><mn>{digits}</mn></msub>")
                    }
                    index => write!(text, "<msub><mi>{stem}</mi><mi>{index}</mi></msub>"),
                };
            }
            Node::Negative(of) => {
                text.push_str("<mrow><mo>−</mo>");
                of.mathml_part(Binding::Product, text);
                text.push_str("</mrow>");
            }
            Node::Sum(parts) => {
                text.push_str("<mrow>");
                for (i, part) in parts.iter().enumerate() {
                    let (minus, part) = unsigned(part);
                    text.push_str(match (minus, i) {
                        (true, _) => "<mo>−</mo>",
                        (false, 0) => "",
                        (false, _) => "<mo>+</mo>",
                    });
                    part.mathml_part(Binding::Product, text);
                }
                text.push_str("</mrow>");
            }
            Node::Product(parts) => {
                text.push_str("<mrow>");
                for (i, part) in parts.iter().enumerate() {
                    // Two numbers next to one another would read as one.
                    let number = matches!(part.node(), Node::Number(_) | Node::Power(..));
                    text.push_str(if i > 0 && number { "<mo>·</mo>" } else { "" });
                    part.mathml_part(Binding::Product, text);
                }
                text.push_str("</mrow>");
            }
            Node::Quotient(above, below) => {
                text.push_str("<mfrac>");
                above.write_mathml(text);
                below.write_mathml(text);
                text.push_str("</mfrac>");
            }
            Node::Power(base, exponent) => {
                text.push_str("<msup>");
                if matches!(base.node(), Node::Call(..)) {
                    text.push_str("<mrow><mo>(</mo>");
                    base.write_mathml(text);
                    text.push_str("<mo>)</mo></mrow>");
                } else {
                    base.mathml_part(Binding::Atom, text);
                }
                exponent.write_mathml(text);
                text.push_str("</msup>");
            }
            Node::Call(function, arguments) => mathml_call(*function, arguments, text),
        }
    }
}

/// A call as MathML.
fn mathml_call(function: Function, arguments: &[Expression], text: &mut String) {
    match (function, arguments) {
        (Function::Sqrt, [inside]) => {
            text.push_str("<msqrt>");
            inside.write_mathml(text);
            text.push_str("</msqrt>");
        }
        (Function::Abs, [inside]) => {
            text.push_str("<mrow><mo>|</mo>");
            inside.write_mathml(text);
            text.push_str("<mo>|</mo></mrow>");
        }
        (function, [inside])
            if inside.node().binding() == Binding::Atom && !matches!(inside.node(), Node::Call(..)) =>
        {
            let _ = write!(text, "<mrow><mi>{}</mi><mo>&#8289;</mo>", function.name());
            inside.write_mathml(text);
            text.push_str("</mrow>");
        }
        (function, several) => {
            let _ = write!(text, "<mrow><mi>{}</mi><mo>&#8289;</mo><mo>(</mo>", function.name());
            for (i, argument) in several.iter().enumerate() {
                text.push_str(if i > 0 { "<mo>,</mo>" } else { "" });
                argument.write_mathml(text);
            }
            text.push_str("<mo>)</mo></mrow>");
        }
    }
}
