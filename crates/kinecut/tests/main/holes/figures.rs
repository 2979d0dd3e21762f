//! Figures 3, 4 and 5 of the paper on the page of a planned hole: every symbol has the value of the plan, and what is
//! drawn is where it says.

use kinecut::page::{Drawing, Stroke};
use kinecut::verbs::Answer as _;
use kinecut::verbs::hole::{HolePlan, plan_hole, read_holes};

/// The paper's example for a control without involutes, which takes the base radius as it is.
fn planned(finish: &str, direction: &str) -> HolePlan {
    let text = format!(
        "tool = {{ number = 1, type = \"end-mill\", diameter = 40, flute_length = 45, teeth = 4, centre_cutting = true }}\n\
         post = {{ control = \"heidenhain\", decimals = 4 }}\n[operation]\ntype = \"bore\"\ntool = 1\nat = [300, -20]\n\
         diameter = 200\ndepth = 30\nstrategy = \"involute\"\nentry = \"plunge\"\nspeed = 2400\n\
         direction = \"{direction}\"\nrough = {{ stepover = 4, allowance = 1, feed = 6000 }}\n\
         finish = {{ turns = 2, feed = 3000, {finish} }}\n"
    );
    of(text)
}

fn of(text: impl Into<String>) -> HolePlan {
    plan_hole(&read_holes("hole.toml", text).unwrap().item(0).unwrap()).unwrap_or_else(|e| panic!("{e}"))
}

const PAPER: &str = "start = [260, 20]";

fn words(d: &Drawing) -> String {
    let spans = d.spans.iter().map(|s| s.text.clone());
    let angles = d.angles.iter().map(|a| a.text.clone());
    let callouts = d.callouts.iter().map(|c| c.lines.join(" "));
    spans.chain(angles).chain(callouts).chain(d.notes.iter().cloned()).collect::<Vec<_>>().join("; ")
}

fn strokes<'a>(d: &'a Drawing, name: &str) -> Vec<&'a Stroke> {
    d.strokes.iter().filter(|s| s.name == name).collect()
}

/// Centre and radius of a circle, by three of its points.
fn circle(stroke: &Stroke) -> ([f64; 2], f64) {
    let n = stroke.points.len();
    let [a, b, c] = [0, n / 3, 2 * n / 3].map(|i| stroke.points[i]);
    let square = |p: [f64; 2]| p[0] * p[0] + p[1] * p[1];
    let d = 2.0 * (a[0] * (b[1] - c[1]) + b[0] * (c[1] - a[1]) + c[0] * (a[1] - b[1]));
    let x = (square(a) * (b[1] - c[1]) + square(b) * (c[1] - a[1]) + square(c) * (a[1] - b[1])) / d;
    let y = (square(a) * (c[0] - b[0]) + square(b) * (a[0] - c[0]) + square(c) * (b[0] - a[0])) / d;
    ([x, y], (a[0] - x).hypot(a[1] - y))
}

fn holds(d: &Drawing, wanted: &[&str]) {
    let words = words(d);
    for one in wanted {
        assert!(words.contains(one), "{}: {one} is not in {words}", d.title);
    }
}

#[test]
fn the_papers_lead_in_is_drawn_with_the_values_of_its_symbols() {
    let plan = planned(PAPER, "climb");
    let [whole, base, touching, start] = &plan.drawings[..] else { panic!("{}", plan.drawings.len()) };
    holds(
        whole,
        &[
            "r = R / 2\u{3c0}n = 80.000 mm / 2\u{3c0} 2 = 6.3662 mm",
            "R_1 40.000",
            "R_n 57.581",
            "\u{3c6}_0 9.0448",
        ],
    );
    holds(base, &["r 6.3662", "C lies at X -3.721 Y -5.166 from O"]);
    holds(
        touching,
        &[
            "\u{3c8} = 0.946567 rad = 54.234\u{b0}, counted counter-clockwise",
            "-35.766\u{b0} (touch_angle)",
            "X 64.913",
            "Y -46.758",
            "R 80.000",
        ],
    );
    holds(
        start,
        &[
            "\u{3c1} = 56.569 mm",
            "\u{3c6}\u{2080} = 9.044815 rad = 518.23\u{b0}",
            "R\u{2099} = 57.581 mm",
            "242.250 mm long, 0.5605 turns",
            "X -40.000 Y 40.000",
        ],
    );
    let angle = &touching.angles[0];
    assert!((angle.from.to_degrees() + 90.0).abs() < 1e-9 && (angle.to.to_degrees() + 35.766).abs() < 1e-3);
    let finish = plan.passes.iter().find(|p| p.pass == "finish").unwrap();
    assert!((finish.base_radius - 6.36619772367581).abs() < 1e-12);
    assert!((finish.roll - 9.04481476767708).abs() < 1e-12);
    assert!((finish.touch_angle_deg - (0.946567321657524f64.to_degrees() - 90.0)).abs() < 1e-9);
    assert!((finish.start_curvature_radius - 57.5810791850552).abs() < 1e-9);
}

#[test]
fn the_centres_of_the_osculating_circles_lie_on_the_base_circle() {
    let plan = planned("start_radius = 30, touch_angle = 70", "climb");
    let whole = &plan.drawings[0];
    let (c, r) = circle(strokes(whole, "base circle")[0]);
    assert!((r - 80.0 / (4.0 * std::f64::consts::PI)).abs() < 1e-9);
    // O is on it.
    assert!((c[0].hypot(c[1]) - r).abs() < 1e-9);
    let circles = strokes(whole, "osculating circles");
    assert_eq!(circles.len(), 2);
    for osculating in circles {
        let (centre, radius) = circle(osculating);
        assert!(((centre[0] - c[0]).hypot(centre[1] - c[1]) - r).abs() < 1e-9, "{centre:?}");
        // Within the wall path, which osculates later.
        assert!(centre[0].hypot(centre[1]) + radius < 80.0 + 1e-9);
    }
    // The lead-in begins at its distance and ends in the wanted direction.
    let run = &strokes(whole, "lead-in")[0].points;
    let ([x, y], [u, v]) = (run[0], run[run.len() - 1]);
    assert!((x.hypot(y) - 30.0).abs() < 1e-9);
    assert!((u.hypot(v) - 80.0).abs() < 1e-9 && (v.atan2(u).to_degrees() - 70.0).abs() < 1e-9);
}

#[test]
fn a_clockwise_lead_in_is_drawn_mirrored_with_the_same_values() {
    let climb = planned(PAPER, "climb");
    let other = planned("start = [340, 20]", "conventional");
    assert_eq!(climb.drawings.len(), other.drawings.len());
    for (a, b) in climb.drawings.iter().zip(&other.drawings) {
        assert_eq!(a.strokes.len(), b.strokes.len());
        let drawn = |d: &Drawing| -> Vec<Stroke> {
            d.strokes.iter().filter(|s| !s.name.is_empty()).cloned().collect()
        };
        for (s, t) in drawn(a).iter().zip(&drawn(b)) {
            // Circles are drawn from their own first point.
            if s.name.contains("circle") || s.name == "wall path" {
                let ((c, r), (k, q)) = (circle(s), circle(t));
                assert!((c[0] + k[0]).abs() + (c[1] - k[1]).abs() + (r - q).abs() < 1e-6, "{}", s.name);
                continue;
            }
            for (p, q) in s.points.iter().zip(&t.points) {
                assert!((p[0] + q[0]).abs() + (p[1] - q[1]).abs() < 1e-6, "{} {p:?} {q:?}", s.name);
            }
        }
    }
    holds(
        &other.drawings[2],
        &["\u{3c8} = 0.946567 rad = 54.234\u{b0}, counted clockwise", "-144.234\u{b0} (touch_angle)"],
    );
    let angle = &other.drawings[2].angles[0];
    assert!(
        (angle.to.to_degrees() - 270.0).abs() < 1e-9
            && ((angle.to - angle.from).to_degrees() - 54.234).abs() < 1e-3
    );
}

#[test]
fn a_lens_has_an_evolute_that_is_no_circle() {
    let plan = planned("contact = \"g4\", start = [260, 20]", "climb");
    let whole = &plan.drawings[0];
    assert!(strokes(whole, "base circle").is_empty());
    // Closed, and a cusp in O.
    let evolute = &strokes(whole, "evolute")[0].points;
    let [first, last] = [evolute[0], evolute[evolute.len() - 1]];
    assert!(first[0].hypot(first[1]) < 1e-9 && last[0].hypot(last[1]) < 1e-9);
    holds(whole, &["R_n 59.830", "\u{3b8}_0 9.0800"]);
}

#[test]
fn the_page_holds_the_figures_and_every_form_of_a_lead_in_draws() {
    for finish in [
        "start = [300, -20]",
        "start_curvature_radius = 20",
        "start_length = 300",
        "touch_angle = -180",
        "start_radius = 0, contact = \"g6\"",
        "start = [300.001, -20]",
    ] {
        for direction in ["climb", "conventional"] {
            let plan = planned(finish, direction);
            let page = HolePlan::files(&[&plan]).unwrap();
            let (name, html) = page.files().next().unwrap();
            let html = std::str::from_utf8(html).unwrap();
            assert_eq!(name, "hole.html");
            assert_eq!(html.matches("<figure class=\"drawing").count(), 4, "{finish}");
            assert!(!html.contains("NaN") && !html.contains("There is nothing to draw"), "{finish}");
        }
    }
    // Without finishing there is no lead-in.
    assert!(of(ROUGH_ONLY).drawings.is_empty());
}

const ROUGH_ONLY: &str = "tool = { number = 1, type = \"end-mill\", diameter = 40, flute_length = 45, teeth = 4 }\n\
    [operation]\ntype = \"bore\"\ntool = 1\nat = [0, 0]\ndiameter = 200\ndepth = 30\nstrategy = \"involute\"\n\
    entry = { pre-drilled = { diameter = 60 } }\nspeed = 2400\nrough = { stepover = 4, feed = 6000 }\n";
