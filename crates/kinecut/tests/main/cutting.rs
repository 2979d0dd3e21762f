//! Cutting data: golden numbers, the integral over the arc of engagement, the rows of start values.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use kinecut::cutting::{
    CuttingForce, DrillingCut, EdgeMaterial, Material, MilledChip, MillingCut, RoundPart, StartCut,
    effective_diameter, tip_deflection,
};
use serde_json::Value;

use crate::common::golden::{file, number, numbers};
use crate::common::random::Random;

fn cases(kind: &str) -> Vec<Value> {
    let all = file("cutting")["cases"].as_array().unwrap().clone();
    let found: Vec<Value> = all.into_iter().filter(|c| c["kind"] == kind).collect();
    assert!(!found.is_empty());
    found
}

/// Holds numbers against a case, each within its tolerance; all of them, but for those of `others`.
#[track_caller]
fn meets(case: &Value, found: &[(&str, f64)], others: usize) {
    let keys = case["expected"].as_object().unwrap();
    assert_eq!(keys.len(), found.len() + others, "{case}");
    for (key, value) in found {
        let (wanted, tolerance) = (number(&case["expected"], key), number(&case["tolerance"], key));
        assert!((value - wanted).abs() <= tolerance, "{key}: {value}, wanted {wanted} in {}", case["name"]);
    }
}

fn force(case: &Value) -> CuttingForce {
    CuttingForce { kc11: number(&case["input"], "kc11"), mc: number(&case["input"], "mc") }
}

fn per_second(rpm: f64) -> f64 {
    rpm * TAU / 60.0
}

fn milling(input: &Value) -> MillingCut {
    MillingCut {
        diameter: number(input, "D"),
        teeth: number(input, "teeth") as u32,
        speed: per_second(number(input, "speed")),
        feed: number(input, "feed") / 60.0,
        depth: number(input, "depth"),
        width: number(input, "width"),
    }
}

/// Power (kW) by the integral over the arc: force and way of each tooth at each angle.
fn by_integral(cut: &MillingCut, force: &CuttingForce) -> f64 {
    let arc = cut.chip().engagement;
    let steps = 200_000;
    let width = arc / f64::from(steps);
    let work: f64 = (0..steps)
        .map(|i| {
            let h = cut.feed_per_tooth() * ((f64::from(i) + 0.5) * width).sin();
            force.kc11 * h.powf(1.0 - force.mc) * cut.depth * 0.5 * cut.diameter * width
        })
        .sum();
    work * f64::from(cut.teeth) * cut.speed / TAU / 1e6
}

#[test]
fn chips_are_those_of_the_reference() {
    for case in cases("chip") {
        let input = &case["input"];
        let fz = number(input, "feed_per_tooth");
        let chip = MilledChip::of(fz, number(input, "width"), number(input, "D"));
        let found = [
            ("largest", chip.largest),
            ("mean", chip.mean),
            ("engagement", chip.engagement.to_degrees()),
            ("feed_for_same_largest", fz * MilledChip::thinning(chip.engagement)),
        ];
        meets(&case, &found, 0);
        assert!((MilledChip::within(fz, chip.engagement).mean - chip.mean).abs() < 1e-12);
    }
}

#[test]
fn the_largest_chip_is_the_way_between_two_teeth() {
    // The thickness along the radius between the circles of two teeth, one feed apart.
    let mut random = Random(71);
    for _ in 0..200 {
        let (d, fz) = (random.between(3.0, 60.0), random.between(0.01, 0.3));
        let width = random.between(0.02 * d, d);
        let engagement = MilledChip::of(fz, width, d).engagement;
        let r = 0.5 * d;
        let thickness = |phi: f64| {
            // The ray at an angle from the direction of the wall meets the circle before at r - h.
            let across = fz * phi.cos();
            r + fz * phi.sin() - (r * r - across * across).sqrt()
        };
        let largest = (0..=2000).map(|i| thickness(engagement * f64::from(i) / 2000.0)).fold(0.0, f64::max);
        let found = MilledChip::of(fz, width, d).largest;
        assert!((found - largest).abs() <= fz * fz / d + 1e-9, "{found} {largest}");
    }
}

#[test]
fn balls_cut_at_their_effective_diameter() {
    for case in cases("ball") {
        let input = &case["input"];
        let found = effective_diameter(
            number(input, "D"),
            number(input, "depth"),
            number(input, "tilt").to_radians(),
        );
        meets(&case, &[("effective_diameter", found)], 0);
    }
    assert_eq!(effective_diameter(10.0, 6.0, 0.3), 10.0);
    // By points of the ball's engaged part, each at its distance from the tilted axis.
    let (d, depth, tilt) = (12.0, 0.7, 0.4_f64);
    let contact = (1.0_f64 - 2.0 * depth / d).acos();
    let widest = (0..=4000)
        .map(|i| {
            let angle = contact * (f64::from(i) / 2000.0 - 1.0);
            0.5 * d * (angle + tilt).sin().abs()
        })
        .fold(0.0, f64::max);
    assert!((2.0 * widest - effective_diameter(d, depth, tilt)).abs() < 1e-9);
}

#[test]
fn power_of_milling_is_that_of_the_reference_and_near_the_integral() {
    for case in cases("milling power") {
        let (cut, force) = (milling(&case["input"]), force(&case));
        let load = cut.load(&force);
        let found = [
            ("fz", cut.feed_per_tooth()),
            ("hm", cut.chip().mean),
            ("kc", force.at(cut.chip().mean)),
            ("Q", cut.rate() * 0.06),
            ("P", load.power / 1000.0),
            ("M", load.torque),
            ("Fc_mean", load.force),
        ];
        meets(&case, &found, 1);
        let integral = by_integral(&cut, &force);
        let wanted = number(&case["expected"], "P_integral");
        assert!((integral - wanted).abs() < 2e-4 * wanted, "{integral} {wanted}");
        let high = load.power / 1000.0 / integral - 1.0;
        assert!((0.01..0.045).contains(&high), "{high} in {}", case["name"]);
    }
}

#[test]
fn load_of_drills_is_that_of_the_reference() {
    for case in cases("drilling power") {
        let input = &case["input"];
        let cut = DrillingCut {
            diameter: number(input, "D"),
            feed: number(input, "feed"),
            lips: 2,
            point: number(input, "point").to_radians(),
            speed: per_second(number(input, "speed")),
        };
        let load = cut.load(&force(&case));
        let found = [
            ("h", cut.chip()),
            ("kc", force(&case).at(cut.chip())),
            ("M", load.torque),
            ("P", load.power / 1000.0),
            ("F", load.force),
            ("Q", cut.rate() * 0.06),
        ];
        meets(&case, &found, 0);
    }
}

#[test]
fn tools_bend_as_beams_do() {
    for case in cases("deflection") {
        let input = &case["input"];
        let parts: Vec<RoundPart> = input["parts_from_holder"]
            .as_array()
            .unwrap()
            .iter()
            .map(|part| {
                let [length, diameter] = numbers(part).try_into().unwrap();
                RoundPart { length, diameter }
            })
            .collect();
        let found = tip_deflection(number(input, "force"), number(input, "modulus"), &parts);
        meets(&case, &[("deflection", found)], 0);
        // By the curvature along the beam.
        let length: f64 = parts.iter().map(|p| p.length).sum();
        let steps = 100_000;
        let mut bent = 0.0;
        for i in 0..steps {
            let u = length * (f64::from(i) + 0.5) / f64::from(steps);
            let mut from = length;
            let part = parts.iter().find(|p| {
                from -= p.length;
                u >= from
            });
            let inertia = PI * part.unwrap().diameter.powi(4) / 64.0;
            let moment = number(input, "force") * u;
            bent += moment / (number(input, "modulus") * inertia) * u * length / f64::from(steps);
        }
        assert!((bent - found).abs() < 1e-4 * found, "{bent} {found}");
    }
}

#[test]
fn start_values_follow_their_rows() {
    let c45 = Material::of("C45").unwrap();
    let start = |cut, edge, d, out| c45.start(cut, edge, d, out).unwrap();
    let slot = start(StartCut::Slot, EdgeMaterial::Carbide, 10.0, Some(40.0));
    assert_eq!((slot.cutting_speed, slot.plain_feed), (150.0, Some(0.06)));
    assert!((slot.feed.unwrap() - 0.048).abs() < 1e-12);
    assert_eq!(slot.row, "C45, carbide, full width");
    // A pocket at 60 degrees is wider than a tenth: the lower speed, and 1 / sin 60.
    let side = start(StartCut::Side(PI / 3.0), EdgeMaterial::Carbide, 10.0, None);
    assert_eq!(side.cutting_speed, 150.0);
    assert!((side.feed.unwrap() - 0.06 / (PI / 3.0).sin()).abs() < 1e-12);
    // Sticking out by six diameters.
    let long = start(StartCut::Side(FRAC_PI_2), EdgeMaterial::Carbide, 10.0, Some(60.0));
    assert!((long.feed.unwrap() - 0.06 * (2.0_f64 / 3.0).powf(1.5)).abs() < 1e-12);
    assert_eq!(long.changes.iter().map(|c| c.what).collect::<Vec<_>>(), ["stickout"]);
    let hss = start(StartCut::Slot, EdgeMaterial::Hss, 10.0, None);
    assert!((hss.cutting_speed - 45.0).abs() < 1e-12);
    let tap = start(StartCut::Tap, EdgeMaterial::Hss, 8.0, None);
    assert_eq!((tap.cutting_speed, tap.feed), (12.0, None));
    let spot = start(StartCut::Spot, EdgeMaterial::Hss, 10.0, None);
    assert!((spot.cutting_speed - 20.0).abs() < 1e-12 && (spot.feed.unwrap() - 0.16).abs() < 1e-12);
    // Wide tools: no feed grows without end.
    for material in Material::all().iter().filter(|m| m.has_start()) {
        for d in [0.3, 3.0, 16.0, 63.0, 200.0] {
            let slot = material.start(StartCut::Slot, EdgeMaterial::Carbide, d, None).unwrap();
            assert!(slot.feed.unwrap() <= 0.8 * 0.12 + 1e-12 && slot.feed.unwrap() > 0.0);
            let drill = material.start(StartCut::Drill, EdgeMaterial::Carbide, d, None).unwrap();
            assert!(drill.feed.unwrap() <= 0.6 + 1e-12);
        }
    }
    assert!(Material::of("S235").unwrap().start(StartCut::Slot, EdgeMaterial::Carbide, 10.0, None).is_none());
}

/// The materials as a table of the manual.
fn table() -> String {
    let number = |v: f64| format!("{v:.3}").trim_end_matches('0').trim_end_matches('.').to_owned();
    let mut text = String::from(
        "| material | also | kc1.1 (N/mm2), mc | carbide mill: full width / narrow | feed per tooth | HSS drill | feed per revolution | carbide drill | tap | reamer |\n|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for material in Material::all() {
        let force = material.force.map_or("not known".to_owned(), |force| {
            let of = if material.force_is_checked { "" } else { " (not compared)" };
            format!("{}, {}{of}", number(force.kc11), number(force.mc))
        });
        let start = |cut, edge| material.start(cut, edge, 10.0, None);
        let speed = |cut, edge| start(cut, edge).map_or(String::new(), |data| number(data.cutting_speed));
        let share = |cut, edge| {
            start(cut, edge).and_then(|data| data.plain_feed).map_or(String::new(), |f| number(f / 10.0))
        };
        let mill = match start(StartCut::Slot, EdgeMaterial::Carbide) {
            Some(_) => format!(
                "{} / {}",
                speed(StartCut::Slot, EdgeMaterial::Carbide),
                speed(StartCut::Side(0.3), EdgeMaterial::Carbide)
            ),
            None => String::new(),
        };
        let cells = [
            material.name.to_owned(),
            material.aliases.join(", "),
            force,
            mill,
            share(StartCut::Slot, EdgeMaterial::Carbide),
            speed(StartCut::Drill, EdgeMaterial::Hss),
            share(StartCut::Drill, EdgeMaterial::Hss),
            speed(StartCut::Drill, EdgeMaterial::Carbide),
            speed(StartCut::Tap, EdgeMaterial::Hss),
            speed(StartCut::Ream, EdgeMaterial::Hss),
        ];
        text.push_str(&format!("| {} |\n", cells.join(" | ")));
    }
    text
}

#[test]
fn the_manual_has_the_materials() {
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/cutting-data.md");
    let text = std::fs::read_to_string(page).unwrap();
    assert!(text.contains(&table()), "docs/cutting-data.md should have\n{}", table());
}
