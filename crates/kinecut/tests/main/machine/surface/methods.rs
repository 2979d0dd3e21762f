//! Methods of making lines, and envelopes by contact equations that are solved as formulas.

use std::collections::BTreeSet;

use glam::DVec3;
use kinecut::machine::formula::Expression;
use kinecut::machine::surface::{
    ChainElement, ContactEquations, EnvelopeMethod, GeneratedSurface, GeneratingMethod, MethodsRow,
    catalogue, envelopes, methods_table, parse_chain,
};

use crate::common::golden;

/// A point of a chain by the motions as numbers.
fn point(chain: &[ChainElement], names: &[&str], values: &[f64]) -> DVec3 {
    chain.iter().rev().fold(DVec3::ZERO, |p, element| {
        element.motion.motion(element.law.bind(names).unwrap().value(values), DVec3::Z).point(p)
    })
}

fn number(formula: &Expression, names: &[&str], values: &[f64]) -> f64 {
    // By way of its text: what is printed is what counts.
    Expression::parse(&formula.to_string()).unwrap().bind(names).unwrap().value(values)
}

/// Golden values have twelve digits.
const DIGITS: f64 = 1e-10;

#[test]
fn a_rolling_rack_makes_the_involute() {
    let golden = golden::file("kinematics");
    let rack = &golden["rolling_rack"];
    let [rp, alpha, rb] = ["rp", "alpha", "rb"].map(|key| rack[key].as_f64().unwrap());
    let contact = ContactEquations::new(
        &parse_chain("6(phi) 1(rp) 2(-rp*phi)").unwrap(),
        &parse_chain("6(alpha) 1(v) 3(z)").unwrap(),
        ["v", "z"],
        &["phi"],
        [None; 3],
    );
    let v = contact.equations()[0].zeros("v").remove(0);
    assert_eq!(v.to_string(), "rp*phi*sin(alpha)");
    let involute = contact.envelope(&[("v", v.clone())]);
    let names = ["rp", "alpha", "phi", "z"];
    for row in rack["points"].as_array().unwrap() {
        let phi = row["phi"].as_f64().unwrap();
        let values = [rp, alpha, phi, 0.0];
        assert!((number(&v, &names, &values) - row["v"].as_f64().unwrap()).abs() < DIGITS);
        let p = DVec3::from_array(involute.each_ref().map(|x| number(x, &names, &values)));
        let wanted = DVec3::from_array(std::array::from_fn(|k| row["p"][k].as_f64().unwrap()));
        assert!(p.distance(wanted) < DIGITS, "{p} for {wanted}");
        // The involute in closed form: radius, and polar angle with the constant of the pitch point.
        let exact = rp * alpha.cos();
        let t = phi + alpha.tan();
        assert!((exact - rb).abs() < DIGITS);
        assert!((p.truncate().length() - exact * (1.0 + t * t).sqrt()).abs() < 1e-12);
        let polar = t - t.atan() - (alpha.tan() - alpha);
        assert!((p.y.atan2(p.x) - polar).abs() < 1e-12);
    }
}

#[test]
fn a_cutter_of_the_rollers_radius_makes_the_walls_of_a_cam() {
    let golden = golden::file("kinematics");
    let cam = &golden["cam_envelope"];
    let envelope = envelopes("cylindrical-cam").next().unwrap();
    let contact = envelope.contact().unwrap();
    let (variable, sides) = contact.solutions(&envelope.variables).remove(0).unwrap();
    assert_eq!((variable, sides.len()), ("psi", 2));
    let names = ["H", "rho", "phi", "r"];
    let mut checked = 0;
    for row in cam["points"].as_array().unwrap() {
        let at = |key: &str| row[key].as_f64().unwrap();
        let values = [cam["H"].as_f64().unwrap(), cam["rho"].as_f64().unwrap(), at("phi"), at("x")];
        let side = &sides[usize::from(at("side") < 0.0)];
        let wall = contact.envelope(&[("psi", side.clone())]);
        let p = DVec3::from_array(wall.each_ref().map(|x| number(x, &names, &values)));
        let wanted = DVec3::from_array(std::array::from_fn(|k| row["p"][k].as_f64().unwrap()));
        assert!(p.distance(wanted) < DIGITS, "{p} for {wanted}");
        checked += 1;
    }
    assert!(checked >= 10);
}

/// All known envelopes with their surfaces.
fn known() -> Vec<(&'static GeneratedSurface, &'static EnvelopeMethod)> {
    let all: Vec<_> = catalogue().iter().flat_map(|s| envelopes(&s.name).map(move |e| (s, e))).collect();
    assert!(all.len() >= 12);
    all
}

#[test]
fn known_envelopes_touch_and_make_their_surfaces() {
    let mut made = BTreeSet::new();
    for (surface, envelope) in known() {
        let at = format!("{} by {}", surface.name, envelope.process);
        let contact = envelope.contact().unwrap();
        let solution = envelope
            .solution(&contact)
            .unwrap_or_else(|| panic!("{at}: {}", contact.text(&envelope.variables)));
        let constants = envelope.values(surface).unwrap();
        let chain: Vec<ChainElement> =
            contact.machine().chain().iter().chain(contact.tool().chain()).cloned().collect();
        // Everything that moves, with its domain where the surface has one.
        let mut moving: Vec<&str> = envelope.parameters.to_vec();
        moving.extend(envelope.variables.iter().filter(|v| solution.iter().all(|(s, _)| s != *v)));
        let names: Vec<&str> =
            constants.iter().map(|(n, _)| n.as_str()).chain(moving.iter().copied()).collect();
        let all: Vec<&str> = names.iter().copied().chain(solution.iter().map(|(n, _)| *n)).collect();
        let implicit = surface.implicit.as_ref().unwrap();
        let implicit_names: Vec<&str> =
            surface.parameters.iter().map(|(n, _)| n.as_str()).chain(["X", "Y", "Z"]).collect();
        let touched = contact.envelope(&solution);
        let mut residuals = Vec::new();
        for (a, b) in [(0.1, 0.2), (0.3, 0.8), (0.55, 0.5), (0.7, 0.05), (0.9, 0.95)] {
            let domain = |name: &str, fraction: f64| {
                let found = surface.variables.iter().find(|v| v.name == name);
                found.map_or(5.0 * fraction, |v| v.at(fraction))
            };
            let mut values: Vec<f64> = constants.iter().map(|(_, value)| *value).collect();
            values.extend(moving.iter().zip([a, b]).map(|(name, fraction)| domain(name, fraction)));
            let solved: Vec<f64> = solution.iter().map(|(_, f)| number(f, &names, &values)).collect();
            let p = DVec3::from_array(touched.each_ref().map(|x| number(x, &names, &values)));
            let full: Vec<f64> = values.iter().chain(&solved).copied().collect();
            assert!(p.distance(point(&chain, &all, &full)) < 1e-10, "{at}");
            // The tool touches what it leaves: its velocity lies in its tangent plane.
            let difference = |name: &str| {
                let k = all.iter().position(|n| *n == name).unwrap();
                let (mut less, mut more) = (full.clone(), full.clone());
                (less[k], more[k]) = (full[k] - STEP, full[k] + STEP);
                (point(&chain, &all, &more) - point(&chain, &all, &less)) / (2.0 * STEP)
            };
            for parameter in envelope.parameters {
                let [u, v] = envelope.variables.map(difference);
                let n = u.cross(v).try_normalize().unwrap();
                let speed = difference(parameter);
                assert!(
                    n.dot(speed).abs() < 1e-7 * speed.length().max(1.0),
                    "{at} by {parameter}: {}",
                    n.dot(speed)
                );
            }
            let mut arguments: Vec<f64> = surface.parameters.iter().map(|(_, value)| *value).collect();
            arguments.extend(p.to_array());
            residuals.push(implicit.bind(&implicit_names).unwrap().value(&arguments));
        }
        let spread = residuals.iter().fold(0.0_f64, |most, r| most.max((r - residuals[0]).abs()));
        match surface.name.as_str() {
            // Those of the wheel are not those of the profile.
            "screw" => continue,
            // The tooth of the cutter makes the wall, not the middle of the track.
            "cylindrical-cam" => continue,
            // The flank begins at another angle.
            "involute-cylinder" => assert!(spread < 1e-12, "{at}: {residuals:?}"),
            _ => assert!(residuals.iter().all(|r| r.abs() < 1e-10), "{at}: {residuals:?}"),
        }
        made.insert(surface.name.as_str());
    }
    assert!(made.len() >= 9, "{made:?}");
}

/// Step of central differences [mm or rad]; their error is about its square.
const STEP: f64 = 1e-5;

#[test]
fn contact_reads_as_text() {
    let rack = envelopes("involute-cylinder").next().unwrap();
    assert_eq!(rack.method, GeneratingMethod::Rolling);
    let contact = rack.contact().unwrap();
    assert_eq!(
        contact.text(&rack.variables),
        "n = (sin(alpha), -cos(alpha), 0)\n\
         V = (rp*phi - v*sin(alpha), v*cos(alpha), 0)\n\
         n . V = 0: rp*phi*sin(alpha) - v = 0\n\
         v = rp*phi*sin(alpha)\n"
    );
    assert!(contact.unicode(&rack.variables).contains("n · V = 0: rp·φ·sin α − v = 0"));
    let ball = envelopes("sphere").next().unwrap().contact().unwrap().text(&["psi", "chi"]);
    assert!(ball.contains("psi = 0 or pi") && ball.contains("chi = 0 or pi"), "{ball}");
}

#[test]
fn splits_have_the_motions_of_their_processes() {
    for (name, machine, wanted) in [
        ("plane", "321", "v(P1)s(P2)"),
        ("plane-facing", "361", "v(B1)s(P2)"),
        ("cylinder", "613", "v(B1)s(P2)"),
        ("cylinder", "61", "v(B1)"),
        ("cylinder", "3", "v(P1)"),
        ("cylinder", "", "v(P1)"),
        ("cone", "6153", "v(B1)s(P2)"),
        ("cone", "6", "v(B1)"),
        ("sphere", "653", "v(B1)s(B2)"),
        ("sphere-ring", "653", "v(B1)"),
        ("revolution", "613", "v(B1)s(P2P3)"),
        ("extrusion", "123", "v(P1)s(P2P3)"),
        ("extrusion", "12", "s(P1P2)"),
        ("extrusion", "3", "v(P1)"),
        ("screw", "63", "v(B1P2)"),
        ("screw", "", "v(B1P2)"),
        ("inclined-helicoid", "63", "v(B1P2)"),
        ("involute-cylinder", "6123", "v(P1)s(B2P3)"),
        ("involute-cylinder", "3", "v(P1)"),
        ("hyperboloid", "6143", "v(B1)s(P2)"),
        ("scroll", "61", "s(B1P2)"),
        ("elliptic-cylinder", "616", "v(B1B2)"),
    ] {
        let surface = GeneratedSurface::named(name).unwrap();
        let splits = surface.splits().unwrap();
        let split = splits.iter().find(|s| s.machine_code().to_string() == machine && s.is_valid()).unwrap();
        let methods = split.methods(&surface).unwrap();
        assert_eq!(methods.notation, wanted, "{name} {machine}: {methods}");
        for line in [&methods.directrix, &methods.generatrix] {
            let copied = split.tool_variables.contains(&line.variable);
            assert_eq!(
                line.method,
                if copied { GeneratingMethod::Copying } else { GeneratingMethod::Tracing }
            );
            assert_eq!(line.motions.is_empty(), copied);
        }
        assert_ne!(methods.directrix.variable, methods.generatrix.variable);
    }
    let helicoid = GeneratedSurface::named("right-helicoid").unwrap();
    let refused = helicoid.splits().unwrap().into_iter().find(|s| !s.is_valid()).unwrap();
    assert!(refused.methods(&helicoid).is_none());
}

#[test]
fn the_table_has_each_surface_once_and_motions_that_are_numbered() {
    for surface in catalogue() {
        let rows = methods_table().iter().filter(|row| row.surfaces.contains(&surface.name.as_str()));
        assert_eq!(rows.count(), 1, "{}", surface.name);
        assert!(MethodsRow::of(&surface.name).is_some());
    }
    let known: BTreeSet<&str> = catalogue().iter().map(|s| s.name.as_str()).collect();
    for row in methods_table() {
        assert!(row.surfaces.iter().all(|name| known.contains(name)), "{}", row.title);
        for process in [row.tracing, row.copying, row.touching, row.rolling].concat() {
            let digits: Vec<u32> = process.motions.chars().filter_map(|c| c.to_digit(10)).collect();
            let count = process.motions.chars().filter(|c| "BP".contains(*c)).count();
            assert_eq!(digits, (1..=count as u32).collect::<Vec<_>>(), "{}", process.name);
            assert!(
                process.motions.is_empty() || process.motions.starts_with(['v', 's']),
                "{}",
                process.name
            );
            assert_eq!(process.motions.matches('(').count(), process.motions.matches(')').count());
        }
    }
}
