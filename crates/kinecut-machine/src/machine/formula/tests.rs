//! Formulas against an independent evaluator: random trees with their own printing, values and dual numbers.

use proptest::prelude::*;

use super::Expression;
use crate::base::Code;

/// A formula of the test: text and value are worked out here, apart from what is tested.
#[derive(Clone, Debug)]
enum Tree {
    Number(f64),
    Name(usize),
    Pi,
    Two(&'static str, Box<Tree>, Box<Tree>),
    Minus(Box<Tree>),
    Whole(Box<Tree>, i32),
    Call(&'static str, Box<Tree>),
    Call2(&'static str, Box<Tree>, Box<Tree>),
}

const NAMES: [&str; 3] = ["x", "R0", "_phi"];

/// A value, its derivative by the first name, and the greatest size met on the way.
#[derive(Clone, Copy, Debug)]
struct Dual(f64, f64, f64);

impl Tree {
    fn text(&self) -> String {
        match self {
            Tree::Number(value) => format!("{value:?}"),
            Tree::Name(i) => NAMES[*i].to_owned(),
            Tree::Pi => "pi".to_owned(),
            Tree::Two(sign, a, b) => format!("({}) {sign} ({})", a.text(), b.text()),
            Tree::Minus(a) => format!("-({})", a.text()),
            Tree::Whole(a, n) => format!("({})**{n}", a.text()),
            Tree::Call(name, a) => format!("{name}({})", a.text()),
            Tree::Call2(name, a, b) => format!("{name}( {},{} )", a.text(), b.text()),
        }
    }

    fn value(&self, at: &[f64; 3]) -> Dual {
        let Dual(v, d, most) = match self {
            Tree::Number(value) => Dual(*value, 0.0, 0.0),
            Tree::Name(i) => Dual(at[*i], if *i == 0 { 1.0 } else { 0.0 }, 0.0),
            Tree::Pi => Dual(std::f64::consts::PI, 0.0, 0.0),
            Tree::Minus(a) => {
                let Dual(v, d, m) = a.value(at);
                Dual(-v, -d, m)
            }
            Tree::Whole(a, n) => {
                let Dual(v, d, m) = a.value(at);
                Dual(v.powi(*n), f64::from(*n) * v.powi(n - 1) * d, m)
            }
            Tree::Two(sign, a, b) => {
                let (Dual(u, du, m), Dual(v, dv, n)) = (a.value(at), b.value(at));
                let m = m.max(n);
                match *sign {
                    "+" => Dual(u + v, du + dv, m),
                    "-" => Dual(u - v, du - dv, m),
                    "*" => Dual(u * v, du * v + u * dv, m),
                    // A small divisor makes a large size; trees with one are left out.
                    _ => Dual(u / v, (du * v - u * dv) / (v * v), m.max(1.0 / v.abs())),
                }
            }
            Tree::Call(name, a) => {
                let Dual(u, du, m) = a.value(at);
                match *name {
                    "sin" => Dual(u.sin(), u.cos() * du, m),
                    "cos" => Dual(u.cos(), -u.sin() * du, m),
                    "atan" => Dual(u.atan(), du / (1.0 + u * u), m),
                    "abs" => Dual(u.abs(), if u < 0.0 { -du } else { du }, m.max(1e-3 / u.abs())),
                    _ => Dual(u.sqrt(), du / (2.0 * u.sqrt()), m.max(1.0 / u.abs())),
                }
            }
            Tree::Call2(name, a, b) => {
                let (Dual(u, du, m), Dual(v, dv, n)) = (a.value(at), b.value(at));
                let (r2, near) = (u * u + v * v, 1e-3 / (u - v).abs());
                match *name {
                    "min" => Dual(u.min(v), if u < v { du } else { dv }, m.max(n).max(near)),
                    "max" => Dual(u.max(v), if u > v { du } else { dv }, m.max(n).max(near)),
                    "atan2" => {
                        Dual(u.atan2(v), (v * du - u * dv) / r2, m.max(n).max(1.0 / r2).max(cut(u, v)))
                    }
                    _ => Dual(r2.sqrt(), (u * du + v * dv) / r2.sqrt(), m.max(n).max(1.0 / r2)),
                }
            }
        };
        let most = if v.is_nan() || d.is_nan() { f64::INFINITY } else { most };
        Dual(v, d, most.max(v.abs()).max(d.abs()))
    }
}

/// Large near the cut of the angle of a point.
fn cut(y: f64, x: f64) -> f64 {
    if x < 0.0 { 1e-3 / y.abs() } else { 0.0 }
}

fn trees() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (-40i32..40).prop_map(|n| Tree::Number(f64::from(n.abs()) / 8.0)),
        (0usize..3).prop_map(Tree::Name),
        (0usize..3).prop_map(Tree::Name),
        Just(Tree::Pi),
    ];
    leaf.prop_recursive(5, 24, 2, |inner| {
        let two = (prop::sample::select(vec!["+", "-", "*", "*", "/"]), inner.clone(), inner.clone());
        let call =
            (prop::sample::select(vec!["sin", "cos", "sin", "cos", "atan", "abs", "sqrt"]), inner.clone());
        let call2 =
            (prop::sample::select(vec!["min", "max", "atan2", "hypot"]), inner.clone(), inner.clone());
        prop_oneof![
            4 => two.prop_map(|(s, a, b)| Tree::Two(s, Box::new(a), Box::new(b))),
            1 => inner.clone().prop_map(|a| Tree::Minus(Box::new(a))),
            1 => (inner, 0i32..4).prop_map(|(a, n)| Tree::Whole(Box::new(a), n)),
            2 => call.prop_map(|(n, a)| Tree::Call(n, Box::new(a))),
            1 => call2.prop_map(|(n, a, b)| Tree::Call2(n, Box::new(a), Box::new(b))),
        ]
    })
}

fn value(formula: &Expression, at: &[f64; 3]) -> f64 {
    formula.bind(&NAMES).unwrap().value(at)
}

/// Trees that come near a pole, or grow beyond this, say nothing about rounding.
const LARGEST: f64 = 1e3;
/// Rounding of a value of size up to [`LARGEST`] that was put together in another order, squares in between.
const ROUNDING: f64 = 1e-8;

proptest! {
    #![proptest_config(kinecut_cases::property(2000))]

    #[test]
    fn values_derivatives_and_other_forms_agree_with_dual_numbers(
        tree in trees(), at in prop::array::uniform3(-3.0..3.0f64),
    ) {
        let formula = Expression::parse(&tree.text()).unwrap();
        let again = Expression::parse(&formula.to_string()).unwrap();
        prop_assert_eq!(&again, &formula, "printed and read: {}", formula);
        let Dual(v, d, most) = tree.value(&at);
        prop_assume!(v.is_finite() && d.is_finite() && most < LARGEST);
        let found = value(&formula, &at);
        prop_assert!((found - v).abs() <= 1e-12 * (1.0 + most * most), "{found} for {v}");
        for (other, name) in [(formula.simplified(), "simplified"), (formula.expanded(), "expanded")] {
            let found = value(&other, &at);
            prop_assert!((found - v).abs() <= ROUNDING * (1.0 + most), "{name} {formula} = {other}: {found} for {v}");
            prop_assert_eq!(&Expression::parse(&other.to_string()).unwrap(), &other, "{}", name);
            prop_assert_eq!(&other.simplified(), &other.simplified().simplified(), "{}", name);
        }
        let slope = formula.derivative("x");
        let found = value(&slope, &at);
        prop_assert!((found - d).abs() <= ROUNDING * (1.0 + most), "({formula})' = {slope}: {found} for {d}");
        if let Some((slope, offset)) = formula.is_affine_in("x") {
            prop_assert!(!slope.has("x") && !offset.has("x"));
            let other = [at[0] + 1.0, at[1], at[2]];
            let line = value(&slope, &other) * other[0] + value(&offset, &other);
            let Dual(v, _, most) = tree.value(&other);
            prop_assume!(most < LARGEST && line.is_finite());
            prop_assert!((line - v).abs() <= ROUNDING * (1.0 + most), "{formula} is not {slope} x + {offset}");
        }
    }
}

fn parsed(text: &str) -> Expression {
    Expression::parse(text).unwrap()
}

#[test]
fn operators_bind_as_in_mathematics() {
    let value = |text: &str| parsed(text).constant().unwrap();
    for (text, expected) in [
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^3^2", 512.0),
        ("2**-1", 0.5),
        ("8/4/2", 1.0),
        ("8/4*2", 4.0),
        ("2*-3 + +4", -2.0),
        ("7 - 2 - 1", 4.0),
        ("1.5e-3*1E3", 1.5),
        (".5 + 5.", 5.5),
        ("--3", 3.0),
        ("min(3, 1, 2) + max(1, 5)", 6.0),
        ("pow(2, 10) - sqrt(49)", 1017.0),
        ("ln(e) + log(e^2)", 3.0),
        ("hypot(3, 4) + floor(-1.5) + sign(-7)", 2.0),
        ("atan2(1, 1)*4 - pi", 0.0),
        ("2*e", 2.0 * std::f64::consts::E),
    ] {
        assert!((value(text) - expected).abs() < 1e-14, "{text} = {}", value(text));
    }
}

#[test]
fn faults_are_shown_at_their_column() {
    for (text, column, says) in [
        ("", 1, "the end"),
        ("R + ", 5, "the end"),
        ("R + * 2", 5, "`*`"),
        ("2 x", 3, "`x`"),
        ("2(x)", 2, "`(`"),
        ("(a + b", 7, "`)`"),
        ("a + b)", 6, "closes nothing"),
        ("sinus(x)", 1, "`sin`"),
        ("x + qwk(1)", 5, "no function"),
        ("sin + 1", 1, "without brackets"),
        ("sin(1,5)", 1, "2 arguments"),
        ("min(1)", 1, "2 or more"),
        ("pow(1)", 1, "needs 2"),
        ("a # b", 3, "`#`"),
        ("é + φ", 1, "`é`"),
        ("1 + 1e999", 5, "too large"),
        ("f()", 1, "no function"),
    ] {
        let error = Expression::parse(text).unwrap_err();
        assert_eq!(error.code(), Code::EXPRESSION_SYNTAX);
        let message = error.to_string();
        assert!(
            message.contains(&format!("column {column}:")) && message.contains(says),
            "{text}: {message}"
        );
    }
}

#[test]
fn deep_and_long_formulas_are_refused_and_do_not_overflow() {
    let deep = ["(", "-", "2^", "sin(", "+", "1/", "(1+"].map(|opening| opening.repeat(4_000) + "1");
    let sum = "1+".repeat(3_000) + "1";
    for text in deep.iter().chain([&"x".repeat(20_000)]) {
        let code = Expression::parse(text).unwrap_err().code();
        assert!(code == Code::EXPRESSION_SYNTAX, "{}", &text[..10]);
    }
    assert_eq!(Expression::parse(&sum).unwrap().constant(), Some(3_001.0)); // long, but not deep
    assert!(Expression::parse(&("1/".repeat(3_000) + "1")).is_err());
}

#[test]
fn unknown_names_are_said_with_those_that_are_known() {
    let error = parsed("R0 + alpah").bind(&["R0", "alpha"]).unwrap_err();
    assert_eq!(error.code(), Code::EXPRESSION_NAME);
    let message = error.to_string();
    assert!(
        message.contains("`alpah`") && message.contains("`alpha`?") && message.contains("R0, alpha"),
        "{message}"
    );
}

#[test]
fn substitution_that_doubles_again_and_again_is_refused_by_its_size() {
    let mut formula = parsed("x*x");
    for _ in 0..20 {
        let inside = formula.clone();
        formula = parsed("x + x*x").substitute(&|_| Some(inside.clone()));
    }
    assert_eq!(formula.bind(&["x"]).unwrap_err().code(), Code::EXPRESSION_SIZE);
}

#[test]
fn sines_and_cosines_are_drawn_together() {
    for (text, expected) in [
        ("cos(f)^2 + sin(f)^2", "1"),
        ("R*cos(f)*cos(f) + R*sin(f)*sin(f) - R", "0"),
        ("cos(a)*cos(b) - sin(a)*sin(b)", "cos(a + b)"),
        ("sin(a)*cos(b) + cos(a)*sin(b)", "sin(a + b)"),
        ("(r*sin(2*f))*sin(f) + r*cos(f)*cos(2*f)", "r*cos(f)"),
        ("x*cos(a)^2*cos(b) + x*sin(a)^2*cos(b)", "x*cos(b)"),
        ("sin(pi/2) + cos(3*pi) + sin(2*pi)", "0"),
    ] {
        assert_eq!(parsed(text).expanded().to_string(), expected, "{text}");
    }
}

#[test]
fn simple_forms_read_as_one_would_write_them() {
    for (text, expected) in [
        ("0 + x - 0*y", "x"),
        ("-(a - b)", "b - a"),
        ("2*x/4", "x/2"),
        ("x^2*x^-1", "x"),
        ("x^-2", "1/x^2"),
        ("1/3 + 1/6", "1/2"),
        ("cos(-2*f)", "cos(2*f)"),
        ("sin(b - a) + sin(a - b)", "0"),
        ("sqrt(x)^2", "x"),
        ("sqrt(a^2)", "abs(a)"),
        ("sqrt(2)", "sqrt(2)"),
        ("(1 + x)/sqrt(1 + x)", "sqrt(1 + x)"),
        ("sqrt(x)^3/x", "sqrt(x)"),
        ("cos(atan(x)) - sin(atan(x))/x", "0"),
        ("cos(-atan2(y, -x))", "-x/hypot(x, y)"),
        ("exp(0)*ln(1)", "0"),
        ("x/0", "x/0"),
        ("cos(0.35)", "cos(0.35)"),
        ("p*phi/(2*pi)", "p*phi/(2*pi)"),
    ] {
        assert_eq!(parsed(text).simplified().to_string(), expected, "{text}");
    }
}

#[test]
fn affine_means_affine() {
    let affine = |text: &str| parsed(text).is_affine_in("v").map(|(s, o)| (s.to_string(), o.to_string()));
    // At zero this is nothing times infinity; the line has a value there.
    let at = |text: &str| {
        affine(text)
            .map(|(s, o)| (value(&parsed(&s), &[0.0, 2.0, 0.0]), value(&parsed(&o), &[0.0, 2.0, 0.0])))
    };
    assert!(at("(v*R0)*(0.125/v + 0.125)").is_none_or(|line| line == (0.25, 0.25)));
    assert_eq!(affine("(v + 1)^2 - v^2"), Some(("2".to_owned(), "1".to_owned())));
    assert_eq!(affine("a"), Some(("0".to_owned(), "a".to_owned())));
    assert_eq!(affine("v*sin(a) - rp*f*sin(a)^2"), Some(("sin(a)".to_owned(), "-rp*f*sin(a)^2".to_owned())));
    for text in
        ["v^2", "abs(v)", "floor(v)", "sign(v) + v", "min(v, 1)", "atan2(v, 2*v)", "1/v", "2^v", "v*cos(v)"]
    {
        assert_eq!(affine(text), None, "{text}");
    }
}

#[test]
fn a_name_that_is_given_goes_before_the_constant_e() {
    let formula = parsed("e*x + ln(e)");
    assert_eq!(formula.names(), ["x"]);
    assert_eq!(formula.simplified().bind(&["x"]).unwrap().value(&[2.0]), 2.0 * std::f64::consts::E + 1.0);
    assert_eq!(formula.simplified().bind(&["e", "x"]).unwrap().value(&[6.0, 2.0]), 12.0 + 6.0_f64.ln());
    let six = formula.substitute(&|name| (name == "e").then(|| Expression::number(6.0)));
    assert_eq!(six.to_string(), "6*x + ln(6)");
    assert!(formula.has("e") && parsed("e^2*x").derivative("e").to_string() == "2*e*x");
}

#[test]
fn formulas_vanish_at_their_zeros() {
    let names = ["a", "b", "c", "o", "x"];
    let mut values = [0.7, -1.3, 0.4, 0.9, 0.0];
    for (text, expected) in [
        ("a*x + b - c*(x - 1)", 1),
        ("a*cos(x) + b*sin(x)", 2),
        ("a*cos(x) + b*sin(x) + c", 2),
        ("a*cos(x + o) - c*sin(o - x) + c/2", 2),
        ("(a*cos(x) + b*sin(x))*(1 + c^2)*(x - a)", 3),
        ("sin(x)*a", 2),
        ("b*cos(x)", 2),
        ("x^2 - a", 0),
        ("a*b", 0),
        ("cos(2*x) + a", 0),
    ] {
        let formula = parsed(text);
        let zeros = formula.zeros("x");
        assert_eq!(zeros.len(), expected, "{text}: {zeros:?}");
        let mut found = Vec::new();
        for zero in zeros {
            values[4] = 0.0;
            values[4] = zero.bind(&names).unwrap().value(&values);
            let rest = formula.bind(&names).unwrap().value(&values);
            assert!(rest.abs() < 1e-14, "{text} is {rest} at {zero}");
            assert!(found.iter().all(|f: &f64| (f - values[4]).abs() > 1e-3), "{text}: {zero} twice");
            found.push(values[4]);
        }
    }
}

#[test]
fn equations_lose_what_cannot_vanish() {
    for (text, expected) in [
        ("-2*r*v/3 + 4*r*a/3", "2*a - v"),
        ("-r*sin(v)", "sin(v)"),
        ("r*v/(2*p) + s/p", "r*v + 2*s"),
        ("a*b", "1"),
    ] {
        assert_eq!(parsed(text).primitive(&["v"]).to_string(), expected, "{text}");
    }
}

#[test]
fn a_missing_value_is_not_a_number() {
    let bound = parsed("a + b").bind(&["a", "b"]).unwrap();
    assert!(bound.value(&[1.0]).is_nan());
    assert_eq!(bound.value(&[1.0, 2.0, 3.0]), 3.0);
}

#[test]
fn formulas_are_kept_in_files_as_text() {
    let formula = parsed("R - z*sin(alpha)");
    let text = serde_json::to_string(&formula).unwrap();
    assert_eq!(text, "\"R - z*sin(alpha)\"");
    assert_eq!(serde_json::from_str::<Expression>(&text).unwrap(), formula);
    assert!(serde_json::from_str::<Expression>("\"R -\"").is_err());
}
