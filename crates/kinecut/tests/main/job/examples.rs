//! The examples as a user runs them, on a coarser grid: the program, the cut part, the verdict, the files.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use kinecut::base::{Code, DiskLoader, Silent};
use kinecut::job::Outcome;
use kinecut::trace::SegmentPace;

use crate::common::job::removed;

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name)
}

/// Runs an example with some texts of its job replaced.
pub(super) fn run(name: &str, replace: &[(&str, &str)]) -> Outcome {
    let folder = example(name);
    let mut text = std::fs::read_to_string(folder.join("job.toml")).unwrap();
    for (from, to) in replace {
        assert!(text.contains(from), "`{from}` is not in {name}");
        text = text.replace(from, to);
    }
    kinecut::job::run("job.toml", &text, &DiskLoader::new(folder), &Silent)
        .unwrap_or_else(|e| panic!("{name}: {e}"))
}

#[test]
fn the_papers_bore_is_cut_right_from_the_posted_text() {
    let outcome = run("01_bore", &[("step = 0.2 }", "step = 0.5 }")]);
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
    // Exact along the lines: the radius within a micrometre of 100 mm.
    let bore = &outcome.deviation.bores[0];
    assert!(bore.ends > 10_000);
    assert!(
        (bore.radius().unwrap()[0] - 100.0).abs() < 1e-3 && (bore.radius().unwrap()[1] - 100.0).abs() < 1e-3,
        "{:?}",
        bore.radius().unwrap()
    );
    let wanted = PI * 100.0 * 100.0 * 30.0;
    assert!((removed(&outcome) / wanted - 1.0).abs() < 1e-4, "{}", removed(&outcome) / wanted - 1.0);
    // Within 0.1 of the grid step on the mesh: every vertex of the wall, and the volume.
    let tenth = 0.05;
    let on_wall = |v: &&glam::DVec3| (v.truncate().length() - 100.0).abs() < 5.0 && v.z < -0.5 && v.z > -29.5;
    let wall: Vec<_> = outcome.part.vertices.iter().filter(on_wall).collect();
    assert!(wall.len() > 1000, "{}", wall.len());
    for v in wall {
        assert!((v.truncate().length() - 100.0).abs() < tenth, "{v}");
    }
    // Its colours are those of the line ends around it.
    let coloured = outcome.deviation.at_vertices.iter().filter(|d| d.is_finite());
    assert!(coloured.clone().all(|d| f64::from(d.abs()) <= bore.worst()) && coloured.count() > 1000);
    let part = 260.0 * 260.0 * 30.0 - wanted;
    assert!((outcome.part.volume() / part - 1.0).abs() < 1e-4, "{}", outcome.part.volume() / part - 1.0);
    outcome.part.check_closed().unwrap();
    // The text within a micrometre and the control's resolution.
    assert!(outcome.setups[0].read_back.largest < 1e-3 + 1e-4, "{:?}", outcome.setups[0].read_back);
    assert!(outcome.setups[0].posted.text.contains("INVCCW"));
}

#[test]
fn every_control_and_sense_cuts_the_same_bore() {
    let base = [("step = 0.2 }", "step = 1.0 }")];
    for (control, word) in [("sinumerik-840d", "INVCW"), ("linuxcnc", "G2")] {
        for direction in ["climb", "conventional"] {
            let outcome = run(
                "01_bore",
                &[base[0], ("sinumerik-840d", control), ("\"climb\"", &format!("\"{direction}\""))],
            );
            assert!(outcome.verdict.is_safe(), "{control} {direction}: {:#?}", outcome.verdict.found);
            let bore = &outcome.deviation.bores[0];
            assert!(
                (bore.radius().unwrap()[1] - 100.0).abs() < 1e-3
                    && (bore.radius().unwrap()[0] - 100.0).abs() < 1e-3,
                "{bore:?}"
            );
            assert!(outcome.setups[0].read_back.largest < 1e-3 + 1e-4, "{control} {direction}");
            let text = &outcome.setups[0].posted.text;
            let expected = if direction == "climb" && control != "linuxcnc" { "INVCCW" } else { word };
            assert!(text.contains(expected), "{control} {direction}");
        }
    }
}

#[test]
fn a_spiral_from_a_given_start_point_cuts_the_same_bore() {
    for direction in ["climb", "conventional"] {
        let outcome = run(
            "01_bore",
            &[
                ("step = 0.2 }", "step = 1.0 }"),
                ("\"climb\"", &format!("\"{direction}\"")),
                ("allowance = 1,", "allowance = 1, start = [6, -3],"),
            ],
        );
        assert!(outcome.verdict.is_safe(), "{direction}: {:#?}", outcome.verdict.found);
        let plunge =
            outcome.setups[0].plan_trace.segments.iter().find(|s| s.motion != SegmentPace::Rapid).unwrap();
        assert_eq!((plunge.curve.end().x, plunge.curve.end().y), (6.0, -3.0));
        let bore = &outcome.deviation.bores[0];
        assert!(
            (bore.radius().unwrap()[0] - 100.0).abs() < 1e-3
                && (bore.radius().unwrap()[1] - 100.0).abs() < 1e-3,
            "{bore:?}"
        );
    }
}

#[test]
fn a_blind_bore_by_helix_for_linuxcnc_is_right_and_has_a_flat_floor() {
    let outcome = run("02_blind_bore", &[("step = 0.15 }", "step = 0.4 }")]);
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
    let bore = &outcome.deviation.bores[0];
    assert!(
        (bore.radius().unwrap()[0] - 30.0).abs() < 1e-3 && (bore.radius().unwrap()[1] - 30.0).abs() < 1e-3,
        "{bore:?}"
    );
    let floor = bore.floor.unwrap();
    assert!(floor[0].abs() < 1e-4 && floor[1].abs() < 1e-4, "{floor:?}");
    // Counting lines of a circle of 75 steps is good to some 1e-3; the mesh knows the circle between the lines.
    let wanted = PI * 30.0 * 30.0 * 24.0;
    assert!((removed(&outcome) / wanted - 1.0).abs() < 2e-3, "{}", removed(&outcome) / wanted - 1.0);
    let part = PI * 45.0 * 45.0 * 40.0 - wanted;
    assert!((outcome.part.volume() / part - 1.0).abs() < 1e-4, "{}", outcome.part.volume() / part - 1.0);
}

#[test]
fn a_predrilled_bore_is_opened_out_without_a_rapid_in_stock() {
    let outcome = run("11_predrilled_bore", &[("step = 0.2 }", "step = 0.5 }")]);
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
    let bore = &outcome.deviation.bores[0];
    assert!(
        (bore.radius().unwrap()[0] - 60.0).abs() < 2e-3 && (bore.radius().unwrap()[1] - 60.0).abs() < 2e-3,
        "{bore:?}"
    );
}

#[test]
fn what_goes_wrong_in_the_program_is_found() {
    let coarse = ("step = 0.2 }", "step = 1.0 }");
    let codes = |outcome: &Outcome| -> Vec<Code> { outcome.verdict.found.iter().map(|f| f.code).collect() };
    // No finishing pass: the allowance is wanted, so nothing is wrong; without its allowance said, stock is left.
    let rough_only =
        run("01_bore", &[coarse, ("finish = { turns = 2, feed = 3000, start = [-40, 40] }", "")]);
    assert!(rough_only.verdict.is_safe(), "{:#?}", rough_only.verdict.found);
    assert!((rough_only.deviation.bores[0].radius().unwrap()[1] - 99.0).abs() < 1e-3);
    // A stubby tool: its holder meets the plate; a thick shank does so too.
    let stubby = run(
        "01_bore",
        &[coarse, ("stickout = 90", "stickout = 29"), ("flute_length = 45", "flute_length = 20")],
    );
    assert!(codes(&stubby).contains(&Code::HOLDER_IN_STOCK), "{:?}", codes(&stubby));
    assert!(!stubby.verdict.is_safe());
    let head = |o: &Outcome| o.setups[0].posted.text.lines().take(6).collect::<String>();
    assert!(head(&stubby).contains("NOT SAFE, ") && !head(&rough_only).contains("NOT SAFE"));
    assert!(head(&rough_only).contains("simulated: SAFE"));
    let thick = run(
        "01_bore",
        &[coarse, ("shank_diameter = 36", "shank_diameter = 44"), ("flute_length = 45", "flute_length = 20")],
    );
    assert!(codes(&thick).contains(&Code::SHANK_IN_STOCK), "{:?}", codes(&thick));
    // A part too far out on the table.
    let far = run("01_bore", &[coarse, ("position = [0, 0, -380]", "position = [350, 0, -380]")]);
    assert!(codes(&far).contains(&Code::TRAVEL_EXCEEDED), "{:?}", codes(&far));
    // A pre-drilled entry where there is no hole: rapid into the full.
    let folder = example("11_predrilled_bore");
    let text = std::fs::read_to_string(folder.join("job.toml")).unwrap();
    let text: String = text.lines().filter(|l| !l.starts_with("drilled")).map(|l| format!("{l}\n")).collect();
    let text = text.replace("step = 0.2 }", "step = 1.0 }");
    let blind = kinecut::job::run("job.toml", &text, &DiskLoader::new(folder), &Silent).unwrap();
    let rapid = blind.verdict.found.iter().find(|f| f.code == Code::RAPID_IN_STOCK).expect("rapid in stock");
    let place = rapid.place.as_ref().expect("a place");
    assert!(place.file.ends_with(".mpf") && place.text.contains("Z-20"), "{place:?}");
    // Every finding of a program names a block and a point.
    for f in stubby.verdict.found.iter().chain(&thick.verdict.found).chain(&blind.verdict.found) {
        assert!(f.place.is_some() && f.point.is_some() && !f.help.is_empty(), "{f:?}");
    }
}

#[test]
fn the_first_descent_starts_above_the_part() {
    let outcome = run("01_bore", &[("step = 0.2 }", "step = 2.0 }")]);
    let first = &outcome.setups[0].trace.segments[0];
    assert_eq!(first.motion, SegmentPace::Rapid);
    assert!(first.curve.start().z > 50.0);
}

#[test]
fn a_machine_whose_travel_does_not_end_at_zero_is_retracted_to_its_upper_end() {
    let outcome = run(
        "01_bore",
        &[
            ("step = 0.2 }", "step = 2.0 }"),
            ("Z = [-500, 0]", "Z = [0, 500]"),
            ("position = [0, 0, -380]", "position = [0, 0, 120]"),
        ],
    );
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
    let text = &outcome.setups[0].posted.text;
    assert_eq!((text.matches("SUPA Z500").count(), text.matches("SUPA Z0").count()), (2, 0));
}

#[test]
fn the_usual_entry_is_a_helix_that_leaves_no_core() {
    let outcome = run("01_bore", &[("step = 0.2 }", "step = 1.0 }"), ("entry = \"plunge\"", "")]);
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
    let nan = example("01_bore");
    let text = std::fs::read_to_string(nan.join("job.toml")).unwrap();
    let text = text.replace("entry = \"plunge\"", "").replace("diameter = 200", "diameter = nan");
    assert!(kinecut::job::run("job.toml", &text, &DiskLoader::new(nan), &Silent).is_err());
}

#[test]
fn outputs_are_whole_and_a_changed_byte_voids_the_verdict() {
    let out = std::env::temp_dir().join(format!("kinecut-main-job-{}", std::process::id()));
    let folder = out.join("job");
    std::fs::create_dir_all(&folder).unwrap();
    let text = std::fs::read_to_string(example("01_bore").join("job.toml")).unwrap();
    std::fs::write(folder.join("job.toml"), text.replace("step = 0.2 }", "step = 2.0 }")).unwrap();
    let job = folder.join("job.toml");
    let results = out.join("results");
    let done = kinecut::run(&job, &results, &Silent).unwrap();
    let names: Vec<&str> = done.outputs.files().map(|(name, _)| name).collect();
    for name in
        ["BORE200.mpf", "plan.json", "engagement.json", "verdict.json", "part.stl", "part.glb", "report.html"]
    {
        assert!(names.contains(&name), "{name} not in {names:?}");
        assert!(std::fs::metadata(results.join(name)).unwrap().len() > 100, "{name}");
    }
    assert_eq!(std::fs::read_dir(&results).unwrap().count(), names.len(), "no temporary file is left");
    assert!(kinecut::verify(&results, None).unwrap().void.is_empty());
    // Same input, same bytes.
    let again = out.join("again");
    kinecut::run(&job, &again, &Silent).unwrap();
    for name in names {
        assert_eq!(
            std::fs::read(results.join(name)).unwrap(),
            std::fs::read(again.join(name)).unwrap(),
            "{name}"
        );
    }
    // One character of the program, of a tool, of the verdict.
    let program = results.join("BORE200.mpf");
    let mpf = std::fs::read_to_string(&program).unwrap();
    std::fs::write(&program, mpf.replacen("M3", "M4", 1)).unwrap();
    assert_eq!(kinecut::verify(&results, None).unwrap().void[0].code, Code::VERDICT_VOID);
    std::fs::write(&program, mpf).unwrap();
    let toml = std::fs::read_to_string(&job).unwrap();
    std::fs::write(&job, toml.replace("flute_length = 45", "flute_length = 46")).unwrap();
    let check = kinecut::verify(&results, None).unwrap();
    assert!(check.void.iter().any(|f| f.message.contains("tools")), "{:?}", check.void);
    assert!(check.unchanged.iter().any(|r| r.contains("machine")), "{:?}", check.unchanged);
    std::fs::remove_dir_all(&out).unwrap();
}

#[test]
fn an_output_folder_that_cannot_be_made_is_one_error_and_nothing_is_written() {
    let out = std::env::temp_dir().join(format!("kinecut-unwritable-{}", std::process::id()));
    std::fs::write(&out, "a file where the folder should be").unwrap();
    let job = example("01_bore").join("job.toml");
    let mut outputs = kinecut::job::Outputs::default();
    outputs.add("a", "b");
    let error = outputs.write(&out).unwrap_err();
    assert_eq!(error.code(), Code::OUTPUT_NOT_WRITTEN);
    assert_eq!(std::fs::read_to_string(&out).unwrap(), "a file where the folder should be");
    std::fs::remove_file(&out).unwrap();
    // A folder in the way of one file: the other files are not written either.
    std::fs::create_dir_all(out.join("b.txt")).unwrap();
    let mut outputs = kinecut::job::Outputs::default();
    outputs.add("a.txt", "a");
    outputs.add("b.txt", "b");
    assert!(outputs.write(&out).is_err());
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 1, "only the folder that was there");
    std::fs::remove_dir_all(&out).unwrap();
    assert!(job.exists());
}

#[test]
fn a_design_mesh_is_compared_with_the_whole_part() {
    let folder = example("01_bore");
    let text =
        std::fs::read_to_string(folder.join("job.toml")).unwrap().replace("step = 0.2 }", "step = 1.0 }");
    let part = kinecut::job::run("job.toml", &text, &DiskLoader::new(folder), &Silent).unwrap().part;
    // The mesh of the same part is the design: facets and 32-bit numbers are all that differs.
    let with_design = |tolerance: &str, bore: &str| {
        let text = text.replacen(
            "format = 1",
            &format!("format = 1\ndesign = {{ mesh = \"d.stl\", tolerance = {tolerance} }}"),
            1,
        );
        let loader = kinecut::base::MemoryLoader::default().with("d.stl", kinecut::geom::write_stl(&part));
        kinecut::job::run("job.toml", &text.replace("diameter = 200", bore), &loader, &Silent).unwrap()
    };
    let same = with_design("0.05", "diameter = 200");
    assert!(same.verdict.is_safe(), "{:#?}", same.verdict.found);
    assert!(same.verdict.proven.iter().any(|p| p.claim.contains("design mesh")), "{:?}", same.verdict.proven);
    let small = with_design("0.05", "diameter = 199");
    let left = small.verdict.found.iter().find(|f| f.code == Code::STOCK_LEFT).expect("stock left");
    assert!((left.value.as_ref().unwrap().value - 0.5).abs() < 0.05, "{left:?}");
    let large = with_design("0.05", "diameter = 201");
    assert!(large.verdict.found.iter().any(|f| f.code == Code::WALL_GOUGED && f.place.is_some()));
}

#[test]
fn a_wall_or_floor_beyond_the_wanted_one_is_gouged_and_one_before_it_is_stock_left() {
    use kinecut::job::deviation;
    use kinecut::operations::OperationPlan;
    // The same cut part held against bores that are a little smaller or larger than what was cut.
    let measured = |name: &str, step: &str, change: &dyn Fn(&mut kinecut::operations::bore::BoreTable)| {
        let mut outcome = run(name, &[(step, "step = 1.0 }")]);
        let plan = &mut outcome.setups[0].planned.operations[0].plan;
        let OperationPlan::Bore(bore) = plan else { panic!("a bore") };
        change(&mut std::sync::Arc::make_mut(&mut bore.of).table);
        let d = deviation(&outcome.job, &outcome.setups, &outcome.simulation, &outcome.part).unwrap();
        let codes: Vec<Code> = d.findings.iter().map(|f| f.0.code).collect();
        (d.bores[0].gouge.depth, d.bores[0].left.depth, codes, d.largest.unwrap().deviation)
    };
    let near = |a: f64, b: f64| (a - b).abs() < 2e-3;
    let (gouge, left, codes, largest) = measured("01_bore", "step = 0.2 }", &|t| t.diameter = 199.9);
    assert!(near(gouge, 0.05) && left == 0.0 && near(largest, -0.05), "{gouge} {left} {largest}");
    assert_eq!(codes, [Code::WALL_GOUGED]);
    let (gouge, left, codes, largest) = measured("01_bore", "step = 0.2 }", &|t| t.diameter = 200.1);
    assert!(near(left, 0.05) && gouge == 0.0 && near(largest, 0.05), "{gouge} {left} {largest}");
    assert_eq!(codes, [Code::STOCK_LEFT]);
    let (gouge, _, codes, _) = measured("02_blind_bore", "step = 0.15 }", &|t| t.depth = 23.9);
    assert!(near(gouge, 0.1) && codes == [Code::WALL_GOUGED], "{gouge} {codes:?}");
    let (_, left, codes, _) = measured("02_blind_bore", "step = 0.15 }", &|t| t.depth = 24.1);
    assert!(near(left, 0.1) && codes == [Code::STOCK_LEFT], "{left} {codes:?}");
}

#[test]
fn a_second_setup_cuts_the_turned_part_that_the_first_has_left() {
    let bore = |at: &str, diameter: u32, depth: u32| {
        format!(
            "[[setup.operation]]\ntype = \"bore\"\ntool = 2\nat = {at}\ndiameter = {diameter}\ndepth = {depth}\n\
             strategy = \"involute\"\nspeed = 4000\nrough = {{ stepover = 2, feed = 900, allowance = 0.2 }}\n\
             finish = {{ feed = 600 }}\n"
        )
    };
    let job = format!(
        "format = 1\nstock = {{ box = {{ min = [-40, -40, -40], max = [40, 40, 0] }} }}\n\
         post = {{ control = \"sinumerik-840d\" }}\nsimulate = {{ step = 0.5 }}\n\
         [[tool]]\nnumber = 2\ntype = \"end-mill\"\ndiameter = 12\nflute_length = 26\n\
         [[setup]]\noffset = \"G54\"\n{}\
         [[setup]]\noffset = \"G55\"\nzero = [0, -40, -28]\norient = {{ x = [1, 0, 0], z = [0, -1, 0] }}\n{}",
        bore("[0, 0]", 40, 15),
        bore("[3, 0]", 20, 10)
    );
    let outcome = kinecut::job::run("two.toml", &job, &DiskLoader::new("."), &Silent).unwrap();
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
    assert_eq!(
        outcome.setups.iter().map(|s| s.file.as_str()).collect::<Vec<_>>(),
        ["two_1.mpf", "two_2.mpf"]
    );
    for (bore, radius) in outcome.deviation.bores.iter().zip([20.0, 10.0]) {
        assert!(
            bore.ends > 1000 && bore.radius().unwrap().iter().all(|r| (r - radius).abs() < 1e-3),
            "{bore:?}"
        );
        assert!(bore.floor.unwrap().iter().all(|f| f.abs() < 1e-4), "{bore:?}");
    }
    // Their axes are Z and Y of the part: one opens upwards, one to the front.
    let inside = |x: f64, y: f64, z: f64| {
        outcome.part.vertices.iter().any(|v| (v.x - x).hypot((v.y - y).hypot(v.z - z)) < 1.0)
    };
    assert!(inside(20.0, 0.0, -7.0) && inside(13.0, -35.0, -28.0));
    let wanted = PI * (20.0 * 20.0 * 15.0 + 10.0 * 10.0 * 10.0);
    assert!((removed(&outcome) / wanted - 1.0).abs() < 3e-3, "{}", removed(&outcome) / wanted);
}

#[test]
fn a_text_that_strays_from_its_plan_is_measured_and_a_lost_or_changed_move_refused() {
    use kinecut::geom::Rigid;
    use kinecut::job::compare;
    let outcome = run("01_bore", &[("step = 0.2 }", "step = 2.0 }")]);
    let setup = &outcome.setups[0];
    let with = |change: &dyn Fn(&mut Vec<kinecut::trace::Segment>, usize)| {
        let mut text = setup.trace.clone();
        let spiral = (0..text.segments.len())
            .max_by(|&a, &b| text.segments[a].curve.length().total_cmp(&text.segments[b].curve.length()))
            .unwrap();
        change(&mut text.segments, spiral);
        compare(&setup.plan_trace, &text, |item| setup.planned_item(item))
    };
    assert!(with(&|_, _| {}).unwrap().largest < 1.1e-3);
    let shift = Rigid::from_translation(glam::DVec3::new(0.01, 0.0, 0.0));
    let strayed = with(&|s, i| s[i].curve = s[i].curve.moved(&shift)).unwrap().largest;
    assert!((strayed - 0.01).abs() < 1.1e-3, "{strayed}");
    for wrong in [
        with(&|s, i| {
            s.remove(i);
        }),
        with(&|s, i| s[i].motion = SegmentPace::Rapid),
        with(&|s, i| s[i].motion = SegmentPace::Feed(1.0)),
        with(&|s, _| s.push(s[0].clone())),
    ] {
        assert_eq!(wrong.unwrap_err().code(), Code::READ_BACK);
    }
}

/// The words, the codes and the number of the steps at which they were found.
type Headlines = std::collections::BTreeMap<(String, Vec<Code>), Vec<f64>>;

/// Every example is judged alike, however far apart the lines of the stock model stand: some steps in the suite, forty in
/// the weekly form, at which lines lie in faces and on borders.
#[test]
fn every_example_is_judged_alike_at_any_step() {
    let many = kinecut_cases::cases(2, 40);
    // 0.8 mm puts a line into a floor of example 1 and onto the border of one in example 13.
    let steps: Vec<f64> = (0..many)
        .map(|i| 0.5 * 5f64.powf(f64::from(i) / f64::from(many)))
        .map(|s| (s * 1000.0).round() / 1000.0)
        .chain([0.8])
        .collect();
    let mut jobs: Vec<PathBuf> =
        std::fs::read_dir(example("")).unwrap().map(|e| e.unwrap().path().join("job.toml")).collect();
    jobs.retain(|p| p.is_file() && std::fs::read_to_string(p).unwrap().contains("[[setup]]"));
    jobs.sort();
    assert!(jobs.len() >= 10, "{jobs:?}");
    for path in jobs {
        let text = std::fs::read_to_string(&path).unwrap();
        let head: Vec<&str> = text.lines().filter(|l| !l.starts_with("simulate")).collect();
        let mut seen = Headlines::new();
        for step in &steps {
            let job = head.join("\n").replacen(
                "format = 1",
                &format!("format = 1\nsimulate = {{ step = {step:?} }}"),
                1,
            );
            let folder = path.parent().unwrap();
            let outcome = kinecut::job::run("job.toml", &job, &DiskLoader::new(folder), &Silent)
                .unwrap_or_else(|e| panic!("{} at {step}: {e}", path.display()));
            let mut codes: Vec<Code> = outcome.verdict.found.iter().map(|f| f.code).collect();
            codes.sort();
            codes.dedup();
            seen.entry((format!("{:?}", outcome.verdict.outcome), codes)).or_default().push(*step);
        }
        assert_eq!(seen.len(), 1, "{}: {seen:?}", path.display());
    }
}
