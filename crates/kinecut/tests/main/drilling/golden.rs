//! The golden cases of drilling: computed by an independent reference, checked there by brute force.

use kinecut::base::Code;
use kinecut::drilling::{
    BoundarySurface, Coordinates, DrillMethod, DrillPlan, DrillSpec, End, FeedChoice, Feeds, Lengths,
    PaperCase, PartFace, PreHole, Side, SpindleSpeed, ZoneStage, paper, plan_drill,
};
use kinecut::tool::{DrillPoint, StepStage as ToolStage};
use serde_json::Value;

use crate::common::golden::{self, number};

fn or(v: &Value, key: &str, default: f64) -> f64 {
    v[key].as_f64().unwrap_or(default)
}

fn point(d: &Value) -> DrillPoint {
    let angle = |key: &str| number(d, key).to_radians();
    match d["type"].as_str().unwrap() {
        "twist_single" => DrillPoint::SinglePlane { angle: angle("two_phi") },
        "twist_double" => DrillPoint::DoubleGround { angle: angle("two_phi"), second: angle("two_phi1") },
        "twist_zhirov" => DrillPoint::CastIron {
            angle: angle("two_phi"),
            second: angle("two_phi1"),
            third: angle("two_phi2"),
            slot: or(d, "l", 0.0),
        },
        "twist_rounded" => DrillPoint::Rounded { radius: number(d, "rho") },
        "twist_corner_radius" => {
            DrillPoint::CornerRadius { angle: angle("two_phi"), radius: number(d, "rho") }
        }
        "web_thinned" => DrillPoint::ThinnedWeb { angle: angle("two_phi"), flat: number(d, "l") },
        "web_slotted" => DrillPoint::SlottedChisel { angle: angle("two_phi"), slot: number(d, "l") },
        "annular" => DrillPoint::Annular { core: number(d, "d_core") },
        "insert_flat" => DrillPoint::Flat,
        "cannon" => DrillPoint::Cannon { overlap: number(d, "e"), edge_angle: angle("alpha") },
        "gun" => DrillPoint::Gun {
            apex: Some(number(d, "b")),
            outer_angle: angle("alpha_o"),
            inner_angle: angle("alpha_i"),
        },
        "auger" => DrillPoint::Auger { angle: angle("two_phi") },
        "ejector" => DrillPoint::Ejector { angle: angle("two_phi") },
        "cone_flat" => DrillPoint::Cone { angle: angle("two_phi"), nose: or(d, "d_nose", 0.0) },
        "center_drill" => {
            let pilot =
                ToolStage { diameter: number(d, "d1"), length: number(d, "lp"), shoulder: angle("two_psi") };
            DrillPoint::Stepped { angle: angle("two_phi"), stages: vec![pilot] }
        }
        other => panic!("{other}"),
    }
}

fn face(s: &Value) -> PartFace {
    let offset = or(s, "x", 0.0);
    match s["kind"].as_str().unwrap() {
        "plane" => PartFace::Plane { inclination: or(s, "alpha_deg", 0.0).to_radians(), offset },
        "cyl_outer" => PartFace::OuterCylinder { radius: number(s, "RS"), offset },
        "cyl_inner" => PartFace::InnerCylinder { radius: number(s, "RS"), offset },
        other => panic!("{other}"),
    }
}

fn spec(inputs: &Value) -> kinecut::base::Result<DrillSpec> {
    let d = &inputs["drill"];
    let length = or(inputs, "L", 0.0);
    let entry = face(&inputs["entry"]).surface(Side::Entry, 0.0)?;
    let end = match inputs.get("stop") {
        None => {
            let exit = face(&inputs["exit"]).surface(Side::Exit, -length)?;
            End::Through { exit, overrun: number(inputs, "Lper") }
        }
        Some(stop) => match (stop["full_diameter"].as_f64(), stop["diameter"].as_f64()) {
            (Some(depth), _) => End::FullDiameter(depth),
            (_, Some(diameter)) => End::Reached(diameter),
            _ => End::Tip(number(stop, "tip")),
        },
    };
    let method = match d["type"].as_str().unwrap() {
        "cone_flat" => DrillMethod::Countersinking,
        "center_drill" => DrillMethod::Centring,
        _ => DrillMethod::Drilling,
    };
    Ok(DrillSpec {
        method,
        length,
        end,
        pre_hole: d["d0"].as_f64().map(PreHole::through),
        approach: number(inputs, "Lpod"),
        turning: SpindleSpeed::CuttingSpeed(or(inputs, "v", 25.0) * 1000.0 / 60.0),
        feed: FeedChoice {
            entry: inputs["s1"].as_f64(),
            steady: or(inputs, "s2", 0.8),
            exit: inputs["s3"].as_f64(),
        },
        guided: true,
        ..DrillSpec::new(number(d, "D"), point(d), entry, BoundarySurface::Plane { height: 0.0, slope: 0.0 })
    })
}

fn near(id: &str, name: &str, found: f64, expected: f64) {
    // The file has six decimals.
    assert!((found - expected).abs() < 1e-6, "{id} {name}: {found} instead of {expected}");
}

/// The paper's names with their values.
fn named(l: &Lengths, z: &Coordinates) -> [(&'static str, f64); 15] {
    let ([k1, k2], [h1, h2]) = (z.exit_own.unwrap(), z.exit.unwrap());
    [
        ("L_vr1", l.point),
        ("L_vr2", l.entry_surface),
        ("L_vyh2", l.exit_surface.unwrap()),
        ("L_nvr", l.to_entry),
        ("L_kvyh", l.to_exit.unwrap()),
        ("Z_nvr1", z.entry[0]),
        ("Z_nvr2", z.entry[1]),
        ("Z_kvyh1", k1),
        ("Z_kvyh2", k2),
        ("Z_nvyh1", h1),
        ("Z_nvyh2", h2),
        ("L_vr", l.entry),
        ("L_ust", l.steady),
        ("L_vyh", l.exit.unwrap()),
        ("L_rx", l.stroke),
    ]
}

#[test]
fn every_golden_case_holds() {
    let golden = golden::file("drilling");
    let cases = golden["cases"].as_array().unwrap();
    assert_eq!(cases.len() as u64, golden["n_cases"].as_u64().unwrap());
    for case in cases {
        let (id, inputs, exact) = (case["id"].as_str().unwrap(), &case["inputs"], &case["exact"]);
        let spec = spec(inputs).unwrap();
        let plan = plan_drill(&spec).unwrap();
        let (l, z) = (&plan.lengths, &plan.coordinates);
        for (name, found) in named(l, z) {
            near(id, name, found, number(exact, name));
        }
        for (name, found) in [("n", plan.spindle * 60.0 / std::f64::consts::TAU), ("T0", plan.time)] {
            near(id, name, found, number(exact, name));
        }
        if !id.contains("limit") {
            for (name, t) in [("entry", plan.entry), ("exit", plan.exit.unwrap())] {
                near(id, "r_first", t.first_radius, number(exact, &format!("r_first_{name}")));
                near(id, "r_last", t.last_radius, number(exact, &format!("r_last_{name}")));
                assert_eq!(
                    t.first_radius < 1e-9,
                    exact[format!("tip_first_{name}")].as_bool().unwrap(),
                    "{id}"
                );
            }
        }
        same_zones(id, &plan, exact);
        for (name, stage) in
            [("T_vr", ZoneStage::Entry), ("T_ust", ZoneStage::Steady), ("T_vyh", ZoneStage::Exit)]
        {
            if let Some(expected) = exact[name].as_f64() {
                near(id, name, plan.time_of(stage), expected);
            }
        }
        assert_eq!(l.steady < 0.0, exact["overlap"].as_bool().unwrap(), "{id}");
        same_paper(id, inputs, &case["paper"], &plan);
    }
}

fn same_zones(id: &str, plan: &DrillPlan, exact: &Value) {
    let expected = exact["zones"].as_array().unwrap();
    assert_eq!(plan.zones.len(), expected.len(), "{id}: {:?}", plan.zones);
    for (zone, e) in plan.zones.iter().zip(expected) {
        for (i, found) in [zone.from, zone.to, zone.feed, zone.time(plan.spindle)].into_iter().enumerate() {
            near(id, "zone", found, e[i].as_f64().unwrap());
        }
    }
}

fn same_paper(id: &str, inputs: &Value, expected: &Value, plan: &DrillPlan) {
    let d = &inputs["drill"];
    let found = paper(&PaperCase {
        point: point(d),
        diameter: number(d, "D"),
        entry: face(&inputs["entry"]),
        exit: face(&inputs["exit"]),
        length: number(inputs, "L"),
        approach: number(inputs, "Lpod"),
        overrun: number(inputs, "Lper"),
        spindle: plan.spindle,
        feeds: Feeds {
            entry: number(inputs, "s1"),
            steady: number(inputs, "s2"),
            exit: number(inputs, "s3"),
        },
    });
    if expected.is_null() {
        assert!(found.is_none(), "{id}: the paper has no formula");
        return;
    }
    let p = found.unwrap_or_else(|| panic!("{id}: the paper has a formula"));
    let (l, z) = (&p.lengths, &p.coordinates);
    for (name, value) in named(l, z) {
        near(id, &format!("paper {name}"), value, number(expected, name));
    }
    for (name, value) in [("T_vr", p.times[0]), ("T_ust", p.times[1]), ("T_vyh", p.times[2])] {
        if let Some(e) = expected[name].as_f64() {
            near(id, &format!("paper {name}"), value, e);
        }
    }
    if let Some(e) = expected["L_vr1_as_printed"].as_f64() {
        near(id, "L_vr1 as printed", p.point_as_printed.unwrap(), e);
    }
}

#[test]
fn figure_seven_is_printed_to_the_last_digit() {
    let golden = golden::file("drilling");
    let printed = &golden["fig7_printed"];
    let case = &golden["cases"][0];
    assert_eq!(case["id"], "fig7_worked_example");
    let inputs = &case["inputs"];
    let found = paper(&PaperCase {
        point: point(&inputs["drill"]),
        diameter: 20.0,
        entry: face(&inputs["entry"]),
        exit: face(&inputs["exit"]),
        length: 50.0,
        approach: 2.0,
        overrun: 2.0,
        spindle: 25e3 / 60.0 / 10.0,
        feeds: Feeds { entry: 0.6, steady: 0.8, exit: 0.2 },
    })
    .unwrap()
    .printed;
    for (name, value) in kinecut::drilling::PRINTED_LENGTHS.iter().zip(found.lengths) {
        assert_eq!(format!("{value:.3}"), format!("{:.3}", number(printed, name)), "{name}");
    }
    for (name, value) in ["T_vr", "T_ust", "T_vyh", "T0"].iter().zip(found.times) {
        assert_eq!(format!("{value:.3}"), format!("{:.3}", number(printed, name)), "{name}");
    }
}

#[test]
fn blind_holes_and_recesses_hold() {
    for case in golden::file("drilling")["blind"].as_array().unwrap() {
        let (id, exact) = (case["id"].as_str().unwrap(), &case["exact"]);
        let plan = plan_drill(&spec(&case["inputs"]).unwrap()).unwrap();
        for (name, found) in [
            ("L_vr1", plan.lengths.point),
            ("Z_first", plan.entry.first),
            ("r_first", plan.entry.first_radius),
            ("Z_full", plan.entry.last),
            ("r_last", plan.entry.last_radius),
            ("Z_nvr1", plan.coordinates.entry[0]),
            ("Z_end", plan.coordinates.end),
        ] {
            near(id, name, found, number(exact, name));
        }
        assert_eq!(plan.zones.last().unwrap().to, plan.coordinates.end, "{id}");
    }
}

#[test]
fn golden_errors_are_errors() {
    for case in golden::file("drilling")["errors"].as_array().unwrap() {
        let error = spec(&case["inputs"]).and_then(|s| plan_drill(&s)).unwrap_err();
        let code = if case["id"] == "rounded_rho_too_small" { Code::TOOL_VALUE } else { Code::DRILL_SURFACE };
        assert_eq!(error.code(), code, "{}: {error}", case["id"]);
    }
}

#[test]
fn all_forty_nine_pairs_are_reachable() {
    let t = 12f64.to_radians();
    let faces = [
        PartFace::Plane { inclination: 0.0, offset: 0.0 },
        PartFace::Plane { inclination: -t, offset: 6.0 },
        PartFace::Plane { inclination: t, offset: 6.0 },
        PartFace::OuterCylinder { radius: 40.0, offset: 0.0 },
        PartFace::OuterCylinder { radius: 40.0, offset: 7.0 },
        PartFace::InnerCylinder { radius: 30.0, offset: 0.0 },
        PartFace::InnerCylinder { radius: 30.0, offset: 7.0 },
    ];
    let point = DrillPoint::SinglePlane { angle: 118f64.to_radians() };
    let mut plans = 0;
    for entry in faces {
        for exit in faces {
            let entry = entry.surface(Side::Entry, 0.0).unwrap();
            let exit = exit.surface(Side::Exit, -150.0).unwrap();
            let plan =
                plan_drill(&DrillSpec { length: 150.0, ..DrillSpec::new(20.0, point.clone(), entry, exit) })
                    .unwrap();
            assert_eq!(plan.zones.len(), 3);
            assert!(plan.findings.is_empty(), "{:?}", plan.findings);
            plans += 1;
        }
    }
    assert_eq!(plans, 49);
}
