//! Drawings, page and text of drilled holes as a person meets them: every name with its value, to scale, nothing on
//! anything else, nothing from outside active.

use std::f64::consts::PI;

use super::*;
use crate::base::{Code, Finding};
use crate::drilling::{
    BoundarySurface, CrossBore, DrillMethod, DrillPlan, DrillSpec, End, FeedChoice, PaperCase, PaperResult,
    PartFace, Side, paper, plan_drill,
};
use crate::page::{Block, Chart, Drawing, Section, WIDTH, text};
use crate::tool::{DrillPoint, StepStage};

fn deg(v: f64) -> f64 {
    v.to_radians()
}

fn figure_7() -> (DrillSpec, DrillPlan, PaperResult) {
    let point = DrillPoint::DoubleGround { angle: deg(118.0), second: deg(70.0) };
    let exit = BoundarySurface::Valley { radius: 100.0, offset: 0.0, height: -50.0 };
    let mut spec =
        DrillSpec::new(20.0, point.clone(), BoundarySurface::Plane { height: 0.0, slope: 0.0 }, exit);
    spec.length = 50.0;
    spec.feed = FeedChoice { entry: Some(0.6), steady: 0.8, exit: Some(0.2) };
    let plan = plan_drill(&spec).unwrap();
    let case = PaperCase {
        point,
        diameter: 20.0,
        entry: PartFace::Plane { inclination: 0.0, offset: 0.0 },
        exit: PartFace::OuterCylinder { radius: 100.0, offset: 0.0 },
        length: 50.0,
        approach: 2.0,
        overrun: 2.0,
        spindle: plan.spindle,
        feeds: plan.feeds,
    };
    let by_paper = paper(&case).unwrap();
    (spec, plan, by_paper)
}

fn words(d: &Drawing) -> Vec<String> {
    let spans = d.spans.iter().map(|s| s.text.clone());
    spans
        .chain(d.callouts.iter().map(|c| c.lines.join(" ")))
        .chain(d.angles.iter().map(|a| a.text.clone()))
        .collect()
}

/// The drawing as the page shows it, and as it does on a narrow screen.
fn widths(d: &Drawing) -> [String; 2] {
    let page = crate::page::drawing::figure(d).into_string();
    let (wide, narrow) = page.split_once("<svg class=\"narrow\"").unwrap();
    [wide.to_owned(), format!("<svg {narrow}")]
}

fn svg(d: &Drawing) -> String {
    let [wide, _] = widths(d);
    wide
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    tag.split(&format!(" {name}=\"")).nth(1)?.split('"').next()
}

fn numbers(text: &str) -> Vec<f64> {
    let split = text.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'));
    split.filter_map(|t| t.parse().ok()).collect()
}

/// Boxes of all words: left, top, right, bottom, by a rough width of letters of its own.
fn boxes(svg: &str) -> Vec<([f64; 4], String)> {
    svg.split("<text ")
        .skip(1)
        .map(|t| {
            let tag = format!(" {}", t.split('>').next().unwrap());
            let inner = t.split("</text>").next().unwrap();
            let content: String = inner.split('<').filter_map(|b| b.split_once('>').map(|p| p.1)).collect();
            let small: usize = inner
                .split("class=\"lowered\"")
                .skip(1)
                .map(|b| b.split('<').next().unwrap().chars().count() - 8)
                .sum();
            // Of 12 px, lowered ones of 9 px.
            let width = (content.chars().count() - small) as f64 * 6.4 + small as f64 * 4.9;
            let anchor = if attribute(&tag, "text-anchor") == Some("middle") { width / 2.0 } else { 0.0 };
            let b = match attribute(&tag, "transform") {
                Some(t) => {
                    let at = numbers(t);
                    [at[0] - 9.0, at[1] - width / 2.0, at[0] + 1.0, at[1] + width / 2.0]
                }
                None => {
                    let [x, y] = ["x", "y"].map(|n| attribute(&tag, n).unwrap().parse::<f64>().unwrap());
                    [x - anchor, y - 9.0, x - anchor + width, y + 1.0]
                }
            };
            (b, content)
        })
        .collect()
}

fn check_readable(d: &Drawing, what: &str) {
    for svg in widths(d) {
        check_one(&svg, what);
    }
}

fn check_one(svg: &str, what: &str) {
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{what}");
    let tag = svg.split("<svg ").find(|t| t.contains("role=\"img\"")).unwrap();
    let view = numbers(attribute(&format!(" {tag}"), "viewBox").unwrap());
    let all = boxes(svg);
    for (i, (a, text)) in all.iter().enumerate() {
        assert!(a[0] >= -1.0 && a[2] <= view[2] + 1.0, "{what}: {text} leaves the paper sideways: {a:?}");
        assert!(
            a[1] >= view[1] - 1.0 && a[3] <= view[1] + view[3] + 1.0,
            "{what}: {text} is cut: {a:?} {view:?}"
        );
        for (b, other) in &all[..i] {
            let apart = a[0] >= b[2] || b[0] >= a[2] || a[1] >= b[3] || b[1] >= a[3];
            assert!(apart, "{what}: {text} lies on {other}: {a:?} {b:?}");
        }
    }
}

#[test]
fn every_length_and_coordinate_of_figure_7_is_named_with_its_value() {
    let (spec, plan, _) = figure_7();
    let drawings = section_drawings(&DrilledHole::new("f", &spec, &plan)).unwrap();
    let all: Vec<String> = drawings.iter().flat_map(words).collect();
    for wanted in [
        "L_pod 2.000",
        "L_vr1 7.907",
        "L_vr2 0.000",
        "L_vr 9.907",
        "L_ust 142.093",
        "L_vyh1 7.907",
        "L_vyh2 0.000",
        "L_per 2.000",
        "L_vyh 9.907",
        "L_rx 161.907",
        "L 50.000",
        "L_nvr 0.000",
        "L_kvyh 100.000",
    ] {
        assert!(all.iter().any(|t| t == wanted), "{wanted} in {all:?}");
    }
    for wanted in [
        "W_h: Z_nvr1 2.000 W_k: 52.000",
        "W_h: Z_nvr2 -7.907 W_k: 42.093",
        "W_h: Z_nvyh1 -150.000 W_k: Z_kvyh1 -100.000",
        "W_h: Z_nvyh2 -159.907 W_k: Z_kvyh2 -109.907",
        "touches first: tip, r 0.000 at Z 0.000",
        "last to go out: corner, r 10.000 at Z -107.907",
    ] {
        assert!(all.iter().any(|t| t == wanted), "{wanted} in {all:?}");
    }
    // The rim passes the lowest line of the shaft before and behind the section.
    assert!(drawings[2].notes[0].contains("10.000 mm before and behind"), "{:?}", drawings[2].notes);
}

#[test]
fn the_section_is_to_scale() {
    let (spec, plan, _) = figure_7();
    for drawing in section_drawings(&DrilledHole::new("f", &spec, &plan)).unwrap() {
        let svg = svg(&drawing);
        let scale: f64 = attribute(&svg, "data-mm").unwrap().parse().unwrap();
        // The point as it starts or ends: as wide as the drill.
        let curve = svg
            .split("<path ")
            .filter(|p| p.contains("class=\"c-s0 ") || p.contains("class=\"c-s3 "))
            .last()
            .unwrap();
        let d = numbers(attribute(&format!(" {curve}"), "d").unwrap());
        let (xs, ys): (Vec<f64>, Vec<f64>) = d.chunks_exact(2).map(|p| (p[0], p[1])).unzip();
        let span = |v: &[f64]| {
            v.iter().copied().fold(f64::MIN, f64::max) - v.iter().copied().fold(f64::MAX, f64::min)
        };
        assert!((span(&xs) - 20.0 * scale).abs() < 0.05, "{} {scale}", span(&xs));
        // Its point, and margins of 3 mm.
        assert!((span(&ys) - 10.906656 * scale).abs() < 0.05);
        // The dimension lines are as long as what they measure, if nothing is left out between.
        for (name, length) in [("L_vr1", 7.906656), ("L_vyh1", 7.906656)] {
            for s in drawing.spans.iter().filter(|s| s.text.starts_with(name)) {
                assert!((s.from[1] - s.to[1] - length).abs() < 1e-6);
                let drawn = svg.split("<path class=\"dimension\" ").skip(1).any(|p| {
                    let n = numbers(attribute(&format!(" {p}"), "d").unwrap());
                    n.len() == 4 && n[0] == n[2] && ((n[1] - n[3]).abs() - length * scale).abs() < 0.05
                });
                assert!(drawn, "{name}");
            }
        }
    }
}

fn points() -> Vec<DrillPoint> {
    let pilot = [
        StepStage { diameter: 0.3, length: 0.4, shoulder: deg(60.0) },
        StepStage { diameter: 0.6, length: 1.1, shoulder: PI },
    ];
    // Of a diameter of 1.
    vec![
        DrillPoint::SinglePlane { angle: deg(118.0) },
        DrillPoint::DoubleGround { angle: deg(118.0), second: deg(70.0) },
        DrillPoint::CastIron { angle: deg(118.0), second: deg(70.0), third: deg(55.0), slot: 0.05 },
        DrillPoint::Rounded { radius: 0.7 },
        DrillPoint::CornerRadius { angle: deg(118.0), radius: 0.15 },
        DrillPoint::ThinnedWeb { angle: deg(118.0), flat: 0.07 },
        DrillPoint::SlottedChisel { angle: deg(118.0), slot: 0.07 },
        DrillPoint::Annular { core: 0.6 },
        DrillPoint::Flat,
        DrillPoint::Cannon { overlap: 0.02, edge_angle: deg(80.0) },
        DrillPoint::Gun { apex: Some(0.25), outer_angle: deg(60.0), inner_angle: deg(70.0) },
        DrillPoint::Auger { angle: deg(90.0) },
        DrillPoint::Ejector { angle: deg(150.0) },
        DrillPoint::Cone { angle: deg(90.0), nose: 0.42 },
        DrillPoint::Stepped { angle: deg(120.0), stages: pilot.to_vec() },
    ]
}

/// The point as large as wanted.
fn scaled(point: &DrillPoint, by: f64) -> DrillPoint {
    match point.clone() {
        DrillPoint::CastIron { angle, second, third, slot } => {
            DrillPoint::CastIron { angle, second, third, slot: by * slot }
        }
        DrillPoint::Rounded { radius } => DrillPoint::Rounded { radius: by * radius },
        DrillPoint::CornerRadius { angle, radius } => DrillPoint::CornerRadius { angle, radius: by * radius },
        DrillPoint::ThinnedWeb { angle, flat } => DrillPoint::ThinnedWeb { angle, flat: by * flat },
        DrillPoint::SlottedChisel { angle, slot } => DrillPoint::SlottedChisel { angle, slot: by * slot },
        DrillPoint::Annular { core } => DrillPoint::Annular { core: by * core },
        DrillPoint::Cannon { overlap, edge_angle } => {
            DrillPoint::Cannon { overlap: by * overlap, edge_angle }
        }
        DrillPoint::Gun { apex, outer_angle, inner_angle } => {
            DrillPoint::Gun { apex: apex.map(|b| by * b), outer_angle, inner_angle }
        }
        DrillPoint::Cone { angle, nose } => DrillPoint::Cone { angle, nose: by * nose },
        DrillPoint::Stepped { angle, stages } => {
            let scaled = |s: &StepStage| StepStage { diameter: by * s.diameter, length: by * s.length, ..*s };
            DrillPoint::Stepped { angle, stages: stages.iter().map(scaled).collect() }
        }
        other => other,
    }
}

#[test]
fn the_drawing_of_every_point_is_readable_at_any_size_and_names_its_parameters() {
    let named: [&[&str]; 15] = [
        &["2φ 118°"],
        &["2φ 118°", "2φ_1 70° (half)", "b_1"],
        &["2φ_2 55° (half)", "b_2", "l "],
        &["ρ "],
        &["ρ ", "2φ 118°"],
        &["flat l"],
        &["slot l"],
        &["core d"],
        &["2φ 180°"],
        &["overlap e", "α 80°"],
        &["apex b", "α_o 60°", "α_i 70°"],
        &["2φ 90°"],
        &["2φ 150°"],
        &["nose d", "2φ 90° (half)"],
        &["d_1", "d_2", "l_1", "l_2", "2ψ_1 60° (half)", "2ψ_2 180°"],
    ];
    for (point, named) in points().iter().zip(named) {
        for diameter in [0.1, 20.0, 3000.0] {
            let d = point_drawing(&scaled(point, diameter), diameter).unwrap();
            check_readable(&d, &format!("{} {diameter}", point.name()));
            let all = words(&d);
            for name in named.iter().chain(&["D ", "L_vr1 "]) {
                assert!(all.iter().any(|t| t.starts_with(name)), "{name} in {all:?}");
            }
        }
    }
    assert_eq!(point_drawing(&DrillPoint::Flat, f64::NAN).unwrap_err().code(), Code::TOOL_VALUE);
}

#[test]
fn sections_of_strange_holes_are_readable() {
    let plane = |angle: f64, height| BoundarySurface::Plane { height, slope: deg(angle).tan() };
    let ridge = |radius, offset, height| BoundarySurface::Ridge { radius, offset, height };
    let valley = |radius, offset, height| BoundarySurface::Valley { radius, offset, height };
    for (n, point) in points().iter().enumerate() {
        for size in [0.02, 1.0, 200.0] {
            let d = 10.0 * size;
            let ways = [
                (plane(0.0, 0.0), plane(0.0, -0.5 * d), 0.5 * d),
                (plane(80.0, 0.0), plane(0.0, -9.0 * d), 9.0 * d),
                (plane(-30.0, 0.0), plane(30.0, -80.0 * d), 80.0 * d),
                (ridge(2.0 * d, 0.3 * d, 0.0), valley(2.0 * d, 0.3 * d, 0.0), 0.0),
                (valley(0.7 * d, -0.1 * d, 0.0), ridge(60.0 * d, 0.0, -100.0 * d), 100.0 * d),
            ];
            for (k, (entry, exit, length)) in ways.into_iter().enumerate() {
                for blind in [false, true] {
                    let mut spec = DrillSpec { length, ..DrillSpec::new(d, scaled(point, d), entry, exit) };
                    spec.approach = 0.2 * d;
                    spec.exit_turn = if k == 3 { 0.5 * PI } else { 0.0 };
                    // Turned so that it is a circle, an ellipse, a strip.
                    let turn = [0.0, 1.0, 0.5 * PI][n % 3];
                    if size == 1.0 && n % 5 == k {
                        spec.bores =
                            vec![CrossBore { radius: 0.6 * d, offset: 0.4 * d, height: -1.5 * d, turn }];
                    }
                    if blind {
                        let top = plan_drill(&spec).map_or(0.0, |p| p.entry.first);
                        spec.end = End::Tip(top - 3.0 * d);
                    }
                    let Ok(plan) = plan_drill(&spec) else { continue };
                    let hole = DrilledHole::new("h", &spec, &plan);
                    // All cases are drawn; a few of each are looked at, for time.
                    let drawings = section_drawings(&hole).unwrap();
                    if (n + k) % 3 == 0 && (size == 1.0 || n % 4 == 0) {
                        for drawing in &drawings {
                            check_readable(
                                drawing,
                                &format!("{} {d} way {k} {blind}: {}", point.name(), drawing.title),
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn the_share_in_material_changes_between_the_planned_coordinates_on_all_pairs() {
    let faces = [
        PartFace::Plane { inclination: 0.0, offset: 0.0 },
        PartFace::Plane { inclination: deg(-12.0), offset: 6.0 },
        PartFace::Plane { inclination: deg(12.0), offset: 6.0 },
        PartFace::OuterCylinder { radius: 40.0, offset: 0.0 },
        PartFace::OuterCylinder { radius: 40.0, offset: 7.0 },
        PartFace::InnerCylinder { radius: 30.0, offset: 0.0 },
        PartFace::InnerCylinder { radius: 30.0, offset: 7.0 },
    ];
    let point = DrillPoint::DoubleGround { angle: deg(118.0), second: deg(70.0) };
    for a in &faces {
        for b in &faces {
            let (entry, exit) =
                (a.surface(Side::Entry, 0.0).unwrap(), b.surface(Side::Exit, -150.0).unwrap());
            let spec = DrillSpec { length: 150.0, ..DrillSpec::new(20.0, point.clone(), entry, exit) };
            let plan = plan_drill(&spec).unwrap();
            let hole = DrilledHole::new("h", &spec, &plan);
            let (e, x) = (plan.entry, plan.exit.unwrap());
            let at = |z: f64| share_in_material(&hole, z);
            assert!(at(e.first + 1e-6) < 1e-9 && at(e.first - 0.2) > 0.0, "{a:?} {b:?}");
            assert!(at(e.last + 0.2) < 1.0 && at(e.last - 1e-6) > 1.0 - 1e-9);
            assert!(at(x.first + 1e-6) > 1.0 - 1e-9 && at(x.first - 0.2) < 1.0);
            assert!(at(x.last + 0.2) > 0.0 && at(x.last - 1e-6) < 1e-9);
        }
    }
}

fn chart(section: &Section) -> &Chart {
    section.blocks.iter().rev().find_map(|b| if let Block::Chart(c) = b { Some(c) } else { None }).unwrap()
}

#[test]
fn the_chart_runs_over_the_program_time_where_it_is_known() {
    let (spec, plan, _) = figure_7();
    let simulated = [[1.0, 0.0], [-7.906656, 1.0], [-150.0, 1.0]];
    let hole =
        DrilledHole { simulated: &simulated, starts_at: Some(12.5), ..DrilledHole::new("f", &spec, &plan) };
    let section = drill_section(&hole);
    let by_time = chart(&section);
    assert_eq!(by_time.follows_from, 12.5);
    assert!((by_time.series[1].points[1][0] - 2.4898).abs() < 1e-4, "the entry takes 2.490 s");
    assert!((by_time.series[1].points[2][0] - 29.2737).abs() < 1e-4);
    assert!((by_time.series[0].points.last().unwrap()[0] - 36.7432).abs() < 1e-3);
    let section = drill_section(&DrilledHole::new("f", &spec, &plan));
    let by_way = chart(&section);
    assert!((by_way.series[0].points.last().unwrap()[0] - 161.906656).abs() < 1e-6);
    assert_eq!(
        by_way.marks.iter().map(|m| m.text.as_str()).collect::<Vec<_>>(),
        ["steady Z -7.907", "exit Z -150.000"]
    );
}

#[test]
fn the_text_shows_the_papers_window_and_both_numbers_where_they_differ() {
    let (spec, plan, by_paper) = figure_7();
    let hole = DrilledHole { paper: Some(&by_paper), ..DrilledHole::new("Figure 7\u{1b}[2J", &spec, &plan) };
    let text = text(&[drill_words(&hole)], WIDTH);
    assert!(text.starts_with("Figure 7\\x1b[2J\n"));
    let flat = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for wanted in [
        "L_vyh2 what the exit surface adds 0.000 (printed: -0.501)",
        "Z_nvyh2 end, W_h -159.907 (printed: -159.405)",
        "entry 2.000 -7.907 52.000 42.093 9.907 0.6 238.7 16.51 2.490",
        "entry 1.485",
        "397.9 rev/min (25.0 m/min at the largest diameter that cuts)",
    ] {
        assert!(flat.contains(wanted), "{wanted} in\n{text}");
    }
    assert!(text.lines().all(|l| l.chars().count() <= 100), "{text}");
    let section = drill_section(&hole);
    let tables: Vec<_> =
        section.blocks.iter().filter_map(|b| if let Block::Table(t) = b { Some(t) } else { None }).collect();
    let end = tables[1].rows.iter().find(|r| r.cells[0].text == "Z_kvyh2").unwrap();
    assert_eq!((end.cells[2].text.as_str(), end.cells[2].printed.as_deref()), ("-109.907", Some("-109.405")));
    assert_eq!(
        tables[2].rows[0].cells.iter().map(|c| c.text.as_str()).collect::<Vec<_>>(),
        ["entry", "1.485", "2.490", "2.490"]
    );
}

#[test]
fn a_pattern_is_a_table_with_the_first_and_the_worst_drawn() {
    let flat = |height: f64, angle: f64| BoundarySurface::Plane { height, slope: deg(angle).tan() };
    let twist = DrillPoint::SinglePlane { angle: deg(118.0) };
    let specs: Vec<DrillSpec> = (0..200)
        .map(|i| {
            let angle = if i == 150 { 45.0 } else { 0.0 };
            DrillSpec {
                length: 30.0,
                ..DrillSpec::new(8.0, twist.clone(), flat(0.0, angle), flat(-30.0, 0.0))
            }
        })
        .collect();
    let plans: Vec<DrillPlan> = specs.iter().map(|s| plan_drill(s).unwrap()).collect();
    let titles: Vec<String> = (0..200).map(|i| format!("hole {i} <b>")).collect();
    let holes: Vec<DrilledHole> = (0..200)
        .map(|i| DrilledHole {
            at: Some([i as f64, 0.0, 0.0]),
            ..DrilledHole::new(&titles[i], &specs[i], &plans[i])
        })
        .collect();
    let refused = [RefusedHole {
        title: "beside <script>alert(1)</script>".to_owned(),
        at: None,
        finding: Finding::error(Code::DRILL_MISSES, "the hole lies beside the part"),
    }];
    let sections = drill_sections("All holes", &holes, &refused);
    assert_eq!(
        sections.iter().map(|s| s.title.as_str()).collect::<Vec<_>>(),
        ["All holes", "hole 0 <b>", "hole 150 <b>"]
    );
    let Block::Table(table) = &sections[0].blocks[0] else { panic!("a table") };
    assert_eq!(table.rows.len(), 201);
    let page = drill_html(&holes, &refused);
    assert!(!page.contains("<script") && !page.contains("hole 0 <b>") && page.contains("hole 150 &lt;b&gt;"));
    assert!(page.contains("beside the part"));
    let list = text(&[drill_list(&holes, &refused)], WIDTH);
    let one_each = list.lines().filter(|line| line.contains("hole ") && line.contains("<b>")).count();
    assert_eq!((one_each, list.lines().filter(|line| line.contains("beside the part")).count()), (200, 1));
    assert_eq!(page, drill_html(&holes, &refused));
}

#[test]
fn a_countersink_is_drawn_as_it_ends() {
    let point = DrillPoint::Cone { angle: deg(90.0), nose: 0.0 };
    let shaft = BoundarySurface::Ridge { radius: 40.0, offset: 0.0, height: 0.0 };
    let spec = DrillSpec {
        method: DrillMethod::Countersinking,
        pre_hole: Some(crate::drilling::PreHole::through(8.4)),
        end: End::Reached(16.0),
        ..DrillSpec::new(20.0, point.clone(), shaft, shaft)
    };
    let plan = plan_drill(&spec).unwrap();
    let hole = DrilledHole::new("c", &spec, &plan);
    let drawings = section_drawings(&hole).unwrap();
    assert_eq!(drawings.len(), 2);
    assert!(
        text(&[drill_words(&hole)], 2 * WIDTH).contains("A hole of \u{2300}8.4 mm is there, a through one.")
    );
    assert!(words(&drawings[0]).iter().any(|t| t == "W_h: Z_end 31.192"), "{:?}", words(&drawings[0]));
    drawings.iter().for_each(|d| check_readable(d, &d.title));
}

#[test]
fn a_drawing_survives_json() {
    let (spec, plan, _) = figure_7();
    let ring = DrillSpec { point: DrillPoint::Annular { core: 12.0 }, ..spec };
    let plan = DrillPlan { ..plan_drill(&ring).unwrap_or(plan) };
    for drawing in section_drawings(&DrilledHole::new("f", &ring, &plan)).unwrap() {
        let json = serde_json::to_string(&drawing).unwrap();
        let back: Drawing = serde_json::from_str(&json).unwrap();
        assert_eq!(svg(&back), svg(&drawing));
    }
}
