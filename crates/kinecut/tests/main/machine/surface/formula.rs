//! Shape-generation functions written out: their text, read back, against matrices multiplied as numbers and the golden
//! points of the reference implementation.

use glam::DVec3;
use kinecut::machine::Elementary;
use kinecut::machine::formula::Expression;
use kinecut::machine::surface::{ChainElement, GeneratedSurface, ShapeFormula, parse_chain};
use proptest::prelude::*;
use serde_json::Value;

use crate::common::golden;

fn elements(value: &Value) -> Vec<ChainElement> {
    let element = |pair: &Value| {
        let motion = Elementary::from_digit(pair[0].as_u64().unwrap() as u8).unwrap();
        ChainElement::new(motion, Expression::parse(pair[1].as_str().unwrap()).unwrap())
    };
    value.as_array().unwrap().iter().map(element).collect()
}

type Numbers = [[f64; 4]; 4];

/// The matrix of a motion, as the table of the elementary motions has it.
fn matrix(digit: u8, q: f64, inclined: DVec3) -> Numbers {
    let (s, c) = q.sin_cos();
    let mut m = [[1., 0., 0., 0.], [0., 1., 0., 0.], [0., 0., 1., 0.], [0., 0., 0., 1.]];
    match digit {
        1..=3 => m[usize::from(digit) - 1][3] = q,
        4 => (m[1][1], m[1][2], m[2][1], m[2][2]) = (c, -s, s, c),
        5 => (m[0][0], m[0][2], m[2][0], m[2][2]) = (c, s, -s, c),
        6 => (m[0][0], m[0][1], m[1][0], m[1][1]) = (c, -s, s, c),
        _ => {
            for (k, unit) in [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate() {
                let a = inclined;
                let turned = unit * c + a.cross(unit) * s + a * a.dot(unit) * (1.0 - c);
                (m[0][k], m[1][k], m[2][k]) = (turned.x, turned.y, turned.z);
            }
        }
    }
    m
}

fn multiplied(a: &Numbers, b: &Numbers) -> Numbers {
    std::array::from_fn(|i| std::array::from_fn(|k| (0..4).map(|j| a[i][j] * b[j][k]).sum()))
}

/// A printed formula, read back and evaluated.
fn read_back(text: &str, names: &[&str], values: &[f64]) -> f64 {
    Expression::parse(text).unwrap().bind(names).unwrap().value(values)
}

/// Entries of a printed row `| a  b  c  d |`.
fn entries(row: &str) -> Vec<&str> {
    let inner = row.trim_start_matches("| ").trim_end_matches(" |");
    inner.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect()
}

/// All that is printed of a chain agrees with the product of numbers.
fn agrees(chain: &[ChainElement], inclined: DVec3, names: &[&str], values: &[f64], tolerance: f64) {
    let formula = ShapeFormula::new(chain, [Some(inclined), None, None]);
    let unit = inclined.try_normalize().unwrap();
    let mut product = matrix(1, 0.0, unit);
    for (element, symbolic) in chain.iter().zip(formula.matrices()) {
        let law = element.law.bind(names).unwrap().value(values);
        let numbers = matrix(element.motion.digit(), law, unit);
        for (row, wanted) in symbolic.rows_text().iter().zip(numbers) {
            let cells = entries(row);
            assert_eq!(cells.len(), 4, "{row}");
            for (cell, wanted) in cells.iter().zip(wanted) {
                let found = read_back(cell, names, values);
                assert!((found - wanted).abs() <= tolerance * wanted.abs().max(1.0), "{element}: {cell}");
            }
        }
        product = multiplied(&product, &numbers);
    }
    let whole = formula.product();
    for i in 0..3 {
        let text = formula.point()[i].to_string();
        let found = read_back(&text, names, values);
        let size = product[i][3].abs().max(1.0);
        assert!((found - product[i][3]).abs() <= tolerance * size, "{text}: {found} for {}", product[i][3]);
        for k in 0..4 {
            let found = read_back(&whole.0[i][k].to_string(), names, values);
            assert!((found - product[i][k]).abs() <= tolerance * size, "{i}{k}: {} {found}", whole.0[i][k]);
        }
    }
}

#[test]
fn printed_formulas_of_all_golden_surfaces_give_the_points() {
    let golden = golden::file("kinematics");
    let surfaces = golden["surfaces"].as_array().unwrap();
    assert!(surfaces.len() >= 14);
    for surface in surfaces {
        let chain = elements(&surface["chain"]);
        let (parameters, variables) = (&surface["params"], &surface["vars"]);
        let parameters: Vec<_> = parameters.as_object().unwrap().iter().collect();
        let variables: Vec<_> = variables.as_object().unwrap().iter().collect();
        let names: Vec<&str> = parameters.iter().chain(&variables).map(|(name, _)| name.as_str()).collect();
        let constants: Vec<f64> = parameters.iter().map(|(_, value)| value.as_f64().unwrap()).collect();
        let order = order_of_samples(surface, &variables);
        let formula = ShapeFormula::new(&chain, [None; 3]);
        for sample in surface["samples"].as_array().unwrap() {
            let mut values = constants.clone();
            values.extend(order.iter().map(|&k| sample["v"][k].as_f64().unwrap()));
            agrees(&chain, DVec3::Z, &names, &values, 1e-12);
            for k in 0..3 {
                let found = read_back(&formula.point()[k].to_string(), &names, &values);
                let wanted = sample["p"][k].as_f64().unwrap();
                // Twelve digits in the file.
                assert!((found - wanted).abs() < 1e-10, "{}: {found} for {wanted}", surface["id"]);
            }
        }
    }
}

/// Places in the samples of the variables as the object lists them: samples follow the order of the file, which a sorted
/// object may lose; the domain tells which is which.
fn order_of_samples(surface: &Value, variables: &[(&String, &Value)]) -> [usize; 2] {
    let samples = surface["samples"].as_array().unwrap();
    let last = &samples[samples.len() - 1]["v"];
    let ends =
        |k: usize, domain: &Value| (last[k].as_f64().unwrap() - domain[1].as_f64().unwrap()).abs() < 1e-9;
    let first = usize::from(!(ends(0, variables[0].1) && ends(1, variables[1].1)));
    [first, 1 - first]
}

#[test]
fn the_cone_of_the_paper_reads_with_its_brackets() {
    let golden = golden::file("kinematics");
    let errata = &golden["errata"];
    let formula = GeneratedSurface::named("cone").unwrap().formula();
    assert_eq!(
        formula.point_text(),
        "((R - z*sin(alpha))*cos(phi), (R - z*sin(alpha))*sin(phi), z*cos(alpha))"
    );
    for k in 0..3 {
        let text = formula.point()[k].to_string();
        let found = read_back(&text, &["R", "alpha", "z", "phi"], &[30.0, 0.35, 20.0, 1.0]);
        assert!((found - errata["eq4_correct"][k].as_f64().unwrap()).abs() < 1e-10);
        // What the paper prints differs in its first two coordinates.
        let printed = errata["eq4_as_printed"][k].as_f64().unwrap();
        assert_eq!((found - printed).abs() < 1e-6, k == 2);
    }
    let page = "\
r0 = A6(phi) A1(R) A5(-alpha) A3(z) e4

          | cos(phi)  -sin(phi)  0  0 |
A6(phi) = | sin(phi)  cos(phi)   0  0 |
          | 0         0          1  0 |
          | 0         0          0  1 |

        | 1  0  0  R |
A1(R) = | 0  1  0  0 |
        | 0  0  1  0 |
        | 0  0  0  1 |

             | cos(alpha)  0  -sin(alpha)  0 |
A5(-alpha) = | 0           1  0            0 |
             | sin(alpha)  0  cos(alpha)   0 |
             | 0           0  0            1 |

        | 1  0  0  0 |
A3(z) = | 0  1  0  0 |
        | 0  0  1  z |
        | 0  0  0  1 |

r0 = ((R - z*sin(alpha))*cos(phi), (R - z*sin(alpha))*sin(phi), z*cos(alpha))
";
    assert_eq!(formula.text(), page);
    assert!(formula.unicode().contains("A5(−α) = | 0      1  0       0 |"), "{}", formula.unicode());
    let mathml = formula.mathml();
    assert_eq!(mathml.matches("<mtable>").count(), 6);
    assert!(roxmltree::Document::parse(&mathml).is_ok());
}

#[test]
fn points_of_the_catalogue_read_as_in_books() {
    let point = |name: &str| GeneratedSurface::named(name).unwrap().formula().point_text();
    for (name, wanted) in [
        ("plane", "(v, u, h)"),
        ("cylinder", "(R*cos(phi), R*sin(phi), z)"),
        ("sphere", "(R*sin(th)*cos(phi), R*sin(th)*sin(phi), R*cos(th))"),
        ("torus", "((R + r*cos(th))*cos(phi), (R + r*cos(th))*sin(phi), -r*sin(th))"),
        ("elliptic-cylinder", "((e + r)*cos(phi), (e - r)*sin(phi), z)"),
        ("right-helicoid", "(r*cos(phi), r*sin(phi), p*phi/(2*pi))"),
        ("involute-cylinder", "(rb*(cos(phi) + phi*sin(phi)), rb*(sin(phi) - phi*cos(phi)), z)"),
        ("hyperboloid", "(a*cos(phi) + v*sin(bet)*sin(phi), a*sin(phi) - v*sin(bet)*cos(phi), v*cos(bet))"),
        ("scroll", "((a + b*phi)*cos(phi), (a + b*phi)*sin(phi), z)"),
    ] {
        assert_eq!(point(name), wanted, "{name}");
    }
}

#[test]
fn neighbouring_rotations_about_one_axis_are_drawn_together() {
    let formula = ShapeFormula::new(&parse_chain("6(f) 6(a) 1(r) 4(b) 4(-b) 2(s)").unwrap(), [None; 3]);
    assert_eq!(formula.point_text(), "(r*cos(a + f) - s*sin(a + f), r*sin(a + f) + s*cos(a + f), 0)");
    assert_eq!(formula.product().0[2][2].to_string(), "1");
}

#[test]
fn derivatives_of_the_cone_give_its_normal() {
    let cone = GeneratedSurface::named("cone").unwrap().formula();
    let text = cone.tangent("phi").map(|x| x.to_string());
    assert_eq!(text, ["(z*sin(alpha) - R)*sin(phi)", "(R - z*sin(alpha))*cos(phi)", "0"]);
    let normal = cone.normal(["phi", "z"]).map(|x| x.to_string());
    assert_eq!(normal[2], "(R - z*sin(alpha))*sin(alpha)");
}

fn laws() -> impl Strategy<Value = String> {
    prop::sample::select(vec![
        "u",
        "v",
        "R",
        "-a",
        "R + a*u",
        "2*v",
        "R*cos(u)",
        "atan(v/R)",
        "a*u^2",
        "0.5",
        "u - v",
    ])
    .prop_map(str::to_owned)
}

proptest! {
    #![proptest_config(kinecut_cases::property(60))]

    #[test]
    fn any_chain_agrees_with_its_matrices(
        links in prop::collection::vec((1u8..=7, laws()), 1..6),
        values in prop::array::uniform4(-2.0..2.0f64),
        axis in prop::array::uniform3(-1.0..1.0f64),
    ) {
        let inclined = DVec3::from_array(axis);
        prop_assume!(inclined.length() > 0.1 && values[2].abs() > 0.2);
        let chain: Vec<ChainElement> = links
            .iter()
            .map(|(digit, law)| ChainElement::new(Elementary::from_digit(*digit).unwrap(), law.parse().unwrap()))
            .collect();
        agrees(&chain, inclined, &["u", "v", "R", "a"], &values, 1e-12);
    }
}
