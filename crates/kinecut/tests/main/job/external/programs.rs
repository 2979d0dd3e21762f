//! The same part by programs for all controls, its proof, its places.

use std::f64::consts::PI;

use kinecut::base::{Code, MemoryLoader, Severity, Silent};
use kinecut::geom::{Aabb, write_stl};
use kinecut::job::{
    GivenFile, GivenStock, ProgramWants, StockWants, given_alone, given_with_job, plan_json, run,
    simulate_given,
};
use kinecut::stock::TriDexel;
use kinecut::stock::surface::{SurfaceOptions, surface};
use kinecut::verbs::Answer as _;
use kinecut::verbs::check::program_sheet;

use super::{FANUC, GRBL, HEIDENHAIN, LINUXCNC, PLAIN, SINUMERIK, job, outcome, removed};

const SLOT: f64 = 3.0 * (30.0 * 8.0 + PI * 16.0);
const HOLES: f64 = 2.0 * 10.0 * PI * 9.0;

#[test]
fn a_certified_simulation_says_so_with_its_bounds() {
    let job = job("fanuc", PLAIN);
    let loader = MemoryLoader::default().with("P.nc", FANUC.as_bytes());
    let program = GivenFile { name: "P.nc", bytes: FANUC.as_bytes() };
    let mut given = given_with_job(program, &ProgramWants::default(), ("job.toml", &job), &loader).unwrap();
    let wants = StockWants { certified: true, step: Some(1.0), ..StockWants::default() };
    given.simulated(&wants).unwrap();
    let too_coarse = StockWants { mesh_tolerance: Some(1.1), ..wants.clone() };
    assert_eq!(given.simulated(&too_coarse).unwrap_err().code(), Code::JOB_VALUE);
    given.simulated(&wants).unwrap();
    let done = simulate_given(given, &Silent).unwrap();
    let certificate = done.simulation.certificate.unwrap();
    let faults = certificate.taken + certificate.strayed;
    assert!(
        certificate.moves == 5 && certificate.left_out == 9 && certificate.ends > 500 && faults == 0,
        "{certificate:?}"
    );
    let proof = done.verdict.proven.iter().find(|p| p.claim.starts_with("certified")).unwrap();
    assert!(proof.claim.contains("1 mm between"), "{proof:?}");
    assert!(proof.bound.contains(&format!("{} moves", certificate.moves)), "{proof:?}");
}

#[test]
fn programs_for_all_controls_cut_the_same_part_and_are_safe() {
    for (control, text, wanted) in [
        ("fanuc", FANUC, SLOT + HOLES),
        ("linuxcnc", LINUXCNC, SLOT + HOLES),
        ("sinumerik-840d", SINUMERIK, SLOT + HOLES),
        ("heidenhain", HEIDENHAIN, SLOT + HOLES),
        ("grbl", GRBL, SLOT),
    ] {
        let setup = if control == "grbl" { "program = { file = \"P.nc\", tool = 1 }" } else { PLAIN };
        let outcome = outcome(control, setup, text).unwrap_or_else(|e| panic!("{control}: {e}"));
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        let share = removed(&outcome) / wanted;
        assert!((share - 1.0).abs() < 1e-2, "{control}: {share}");
        let (time, _) = outcome.setups[0].trace.duration();
        // 5 mm at 200 and 30 mm at 400 mm/min, two holes of 12 mm at 150.
        let least =
            5.0 / 200.0 * 60.0 + 30.0 / 400.0 * 60.0 + if wanted > SLOT { 24.0 / 150.0 * 60.0 } else { 0.0 };
        assert!((time - least).abs() < 1e-6, "{control}: {time} s, {least} s");
        assert!(outcome.verdict.subjects.iter().any(|s| s.role == "external program"));
        assert!(outcome.verdict.subjects.iter().all(|s| s.role != "program"));
        assert!(outcome.verdict.proven[0].claim.contains("read whole"), "{:?}", outcome.verdict.proven);
        let plan: serde_json::Value = serde_json::from_str(&plan_json(&outcome)).unwrap();
        assert_eq!(plan["setups"][0]["control"], control);
        // The moves are those of the text, which the hash names.
        let setup = &plan["setups"][0];
        assert!(setup["move_count"].as_u64().unwrap() >= 4);
        assert!(setup["moves"].is_null() && setup["read_back"].is_null());
        let of_text = outcome.verdict.subjects.iter().find(|s| s.role == "external program").unwrap();
        assert_eq!(setup["program_sha256"], of_text.sha256);
        let page = kinecut::job::report::html(&kinecut::job::report::of_job(&outcome));
        assert!(page.contains("SAFE") && !page.contains("Text to plan"));
    }
}

#[test]
fn a_wrong_rapid_is_found_at_its_line_with_its_text() {
    let wrong = FANUC.replace("X45. F400.\nG0 Z20. M9", "X45. F400.\nG0 X50. Y30.\nZ20. M9");
    let outcome = outcome("fanuc", PLAIN, &wrong).unwrap();
    assert!(!outcome.verdict.is_safe());
    let found: Vec<_> = outcome.verdict.found.iter().filter(|f| f.code == Code::RAPID_IN_STOCK).collect();
    let place = found[0].place.as_ref().unwrap();
    assert_eq!((place.file.as_str(), place.text.as_str()), ("P.nc", "G0 X50. Y30."));
    assert_eq!(place.line as usize, 1 + wrong.lines().position(|l| l == "G0 X50. Y30.").unwrap());
}

#[test]
fn an_unknown_word_is_refused_at_its_place() {
    let error = outcome("fanuc", PLAIN, &FANUC.replace("Z2.\n", "Z2. Q9.\n")).unwrap_err();
    let place = error.0.place.clone().unwrap();
    assert_eq!((error.code(), place.line, place.column), (Code::NC_WORD, 8, 5), "{error}");
    let error = outcome("fanuc", PLAIN, &FANUC.replace("T2 M6", "T9 M6")).unwrap_err();
    assert_eq!(error.code(), Code::JOB_REFERENCE);
    assert_eq!(error.0.place.as_ref().map(|p| p.text.as_str()), Some("T9 M6"), "{error}");
}

#[test]
fn further_work_offsets_lie_where_the_job_says() {
    let text = "G21 G90 G94 G17\nT1 M6\nG54 G0 X15. Y20. S3000 M3\nG43 H1 Z2.\nG1 Z-3. F200.\nG0 Z2.\nG55 G0 X15. Y20. Z2.\n\
        G1 Z-3. F200.\nG0 Z2.\nM30\n";
    let refused = outcome("fanuc", PLAIN, text).unwrap_err();
    assert!(refused.to_string().contains("G55 is not defined"), "{refused}");
    let two = format!("offsets = {{ G55 = [30, 0, 0] }}\n{PLAIN}");
    let apart = removed(&outcome("fanuc", &two, text).unwrap());
    assert!((apart / (2.0 * 3.0 * PI * 16.0) - 1.0).abs() < 0.05, "{apart}");
    let twice = outcome("fanuc", &two.replace("G55 =", "G54 ="), text).unwrap_err();
    assert!(twice.to_string().contains("G54 is said twice"), "{twice}");
}

#[test]
fn limits_are_compared_with_the_block_that_breaks_them() {
    let machine = "[machine]\ncode = \"2103\"\ntravel = { X = [-400, 0], Y = [-300, 0], Z = [-270, 0] }\n";
    let setup = format!("position = [-200, -150, -380]\n{PLAIN}\n{machine}");
    let outcome = outcome("fanuc", &setup, FANUC).unwrap();
    let found = &outcome.verdict.found[0];
    assert_eq!(found.code, Code::TRAVEL_EXCEEDED, "{:?}", outcome.verdict.found);
    // The gauge point is a length above the tip: at -380 - 3 + 100 with the mill, at -380 - 10 + 130 with the drill.
    assert_eq!(found.place.as_ref().unwrap().text, "G1 Z-3. F200.", "{found}");
}

#[test]
fn a_program_given_by_itself_is_cut_with_what_is_said_beside_it() {
    let program = GivenFile { name: "dir/P.ngc", bytes: LINUXCNC.as_bytes() };
    let tools = job("fanuc", "").replace("[[setup]]\noffset = \"G54\"\n", "");
    let wants = ProgramWants {
        stock: Some(GivenStock::Block([0.0, 0.0, -12.0, 60.0, 40.0, 0.0])),
        tools: Some(("tools.toml".to_owned(), tools)),
        ..ProgramWants::default()
    };
    let mut given = given_alone(program, &wants, true).unwrap();
    given.simulated(&StockWants { step: Some(0.5), ..StockWants::default() }).unwrap();
    assert_eq!(
        given.simulated(&StockWants { step: Some(f64::NAN), ..StockWants::default() }).unwrap_err().code(),
        Code::JOB_VALUE
    );
    let outcome = simulate_given(given, &Silent).unwrap();
    assert!(outcome.verdict.is_safe() && (removed(&outcome) / (SLOT + HOLES) - 1.0).abs() < 1e-2);
    let roles: Vec<&str> = outcome.verdict.subjects.iter().map(|s| s.role.as_str()).collect();
    assert_eq!(roles, ["given program", "tools", "stock"]);
    let no_stock = ProgramWants { stock: None, ..wants.clone() };
    assert!(given_alone(program, &no_stock, true).unwrap_err().to_string().contains("--stock"));
    let flat = ProgramWants { stock: Some(GivenStock::Block([0.0, 0.0, 0.0, 60.0, 40.0, 0.0])), ..wants };
    assert_eq!(given_alone(program, &flat, true).unwrap_err().code(), Code::JOB_VALUE);
}

#[test]
fn a_program_given_by_itself_is_cut_out_of_a_mesh() {
    let program = GivenFile { name: "P.ngc", bytes: LINUXCNC.as_bytes() };
    let tools = job("fanuc", "").replace("[[setup]]\noffset = \"G54\"\n", "");
    let with = |stock: GivenStock| ProgramWants {
        stock: Some(stock),
        tools: Some(("tools.toml".to_owned(), tools.clone())),
        ..ProgramWants::default()
    };
    let corners = Aabb { min: [0.0, 0.0, -12.0].into(), max: [60.0, 40.0, 0.0].into() };
    let stl = write_stl(
        &surface(&TriDexel::from_box(corners, 4.0).unwrap(), &SurfaceOptions::default(), &Silent).unwrap(),
    );
    let wants = with(GivenStock::Mesh("blank.stl".to_owned(), stl.clone()));
    let mut given = given_alone(program, &wants, true).unwrap();
    given.simulated(&StockWants { step: Some(0.5), ..StockWants::default() }).unwrap();
    let outcome = simulate_given(given, &Silent).unwrap();
    assert!(outcome.verdict.is_safe() && (removed(&outcome) / (SLOT + HOLES) - 1.0).abs() < 1e-2);
    let stock = outcome.verdict.subjects.iter().find(|s| s.role == "stock").unwrap();
    assert_eq!(stock.file.as_deref(), Some("blank.stl"));
    // A mesh that does not close.
    let mut open = stl;
    open.truncate(open.len() - 50);
    let count = u32::from_le_bytes(open[80..84].try_into().unwrap()) - 1;
    open[80..84].copy_from_slice(&count.to_le_bytes());
    let error =
        given_alone(program, &with(GivenStock::Mesh("blank.stl".to_owned(), open)), true).unwrap_err();
    assert_eq!(error.code(), Code::MESH_OPEN);
    assert!(error.to_string().contains("blank.stl"), "{error}");
}

#[test]
fn the_operations_of_a_job_beside_do_not_count_and_its_verdict_is_about_the_job_as_it_is() {
    let operation = "[[setup.operation]]\ntype = \"bore\"\ntool = 1\nat = [30, 20]\ndiameter = 30\ndepth = 5\n\
        strategy = \"involute\"\nentry = \"plunge\"\nspeed = 4000\nrough = { stepover = 2, feed = 500 }\n";
    let text = job("fanuc", operation);
    let loader = MemoryLoader::default();
    let planned = run("plate.toml", &text, &loader, &Silent).unwrap();
    let program = GivenFile { name: "P.nc", bytes: FANUC.as_bytes() };
    let given = given_with_job(program, &ProgramWants::default(), ("plate.toml", &text), &loader).unwrap();
    let outcome = simulate_given(given, &Silent).unwrap();
    assert!((removed(&outcome) / (SLOT + HOLES) - 1.0).abs() < 1e-2);
    let setups = |o: &kinecut::job::Outcome| o.verdict.subjects.iter().find(|s| s.role == "setups").cloned();
    assert_eq!(setups(&outcome), setups(&planned));
    let third = ProgramWants { setup: Some(3), ..ProgramWants::default() };
    let error = given_with_job(program, &third, ("plate.toml", &text), &loader).unwrap_err();
    assert!(error.to_string().contains("no setup 3"), "{error}");
}

#[test]
fn a_sheet_tells_what_a_program_does_without_tools_or_stock() {
    let program = GivenFile { name: "P.nc", bytes: FANUC.as_bytes() };
    let wants = ProgramWants { control: Some("fanuc".to_owned()), ..ProgramWants::default() };
    let sheet = program_sheet(&given_alone(program, &wants, false).unwrap()).unwrap();
    assert_eq!(sheet.tools, ["T1", "T2"]);
    assert_eq!((sheet.offsets.join(" "), sheet.cycles), ("G54".to_owned(), 2));
    assert_eq!(sheet.range, Some([[15.0, 8.0, -10.0], [45.0, 20.0, 2.0]]));
    assert!(sheet.findings.is_empty(), "{:?}", sheet.findings);
    assert!(sheet.remarks.iter().any(|r| r.contains("G28")), "{:?}", sheet.remarks);
    assert!(sheet.text().contains("X 15.000 to 45.000"), "{}", sheet.text());
    let nothing = GivenFile { name: "P.nc", bytes: b"(NOTHING)\nM30\n" };
    let sheet = program_sheet(&given_alone(nothing, &wants, false).unwrap()).unwrap();
    assert_eq!(sheet.findings[0].severity, Severity::Warning);
    let unknown = given_alone(nothing, &ProgramWants::default(), false).unwrap_err();
    assert!(unknown.to_string().contains("tells its control"), "{unknown}");
    // The text of the other shows it.
    let sheet = program_sheet(&given_alone(program, &ProgramWants::default(), false).unwrap()).unwrap();
    assert!(
        sheet.remarks.iter().any(|r| r.starts_with("the text is read as one for FANUC")),
        "{:?}",
        sheet.remarks
    );
    let okuma = GivenFile { name: "P.nc", bytes: b"$P.MIN%\nG15 H1\n" };
    let other = given_alone(okuma, &ProgramWants::default(), false).unwrap_err();
    assert!(other.to_string().contains("a program for Okuma, which kinecut does not read"), "{other}");
}

#[test]
fn a_start_that_is_given_is_followed_from() {
    let program = GivenFile { name: "a.ngc", bytes: b"G21 G54 G90\nG1 X10 Y0 Z5 F600\nG1 Y3\nM2\n" };
    let sheet = |start| {
        let wants = ProgramWants { start, ..ProgramWants::default() };
        program_sheet(&given_alone(program, &wants, false).unwrap()).unwrap()
    };
    let given = sheet(Some([2.0, 0.0, 5.0]));
    assert!((given.feed_length - 11.0).abs() < 1e-12 && given.findings.is_empty(), "{:?}", given.findings);
    // Otherwise the first move is not followed, and the second is.
    let open = sheet(None);
    assert!((open.feed_length - 3.0).abs() < 1e-12, "{}", open.feed_length);
    assert_eq!(open.findings[0].code, Code::UNKNOWN_START);
}

#[test]
fn all_errors_of_a_program_are_found_in_one_run() {
    let text = b"G21 G54 G90\nG0 X0 Y0 Z5\nM777\nG0 X0 Y0 Z5\nM777\nG0 X0 Y0 Z5\nG1 X5\nM2\n";
    let program = GivenFile { name: "a.ngc", bytes: text };
    let sheet = program_sheet(&given_alone(program, &ProgramWants::default(), false).unwrap()).unwrap();
    assert_eq!(sheet.errors, 2);
    let said: Vec<&str> = sheet.findings.iter().map(|f| f.message.as_str()).collect();
    assert!(
        said.iter()
            .any(|m| m.starts_with("`M777` is not understood") && m.ends_with("(2 times: lines 3, 5)")),
        "{said:?}"
    );
    assert!(said.iter().any(|m| m.contains("a feed move without a feed")), "{said:?}");
    assert!(sheet.text().contains("from line 3 on nothing is"), "{}", sheet.text());
}
