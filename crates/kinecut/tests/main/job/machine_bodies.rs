//! Bodies of the machine in a job: contacts at their block with what clears, near passes, bodies that touch from the start, and what is
//! said where nothing can be compared.
//!
//! Expected values follow by hand: the nose of the spindle, 80 mm wide, begins at the gauge point, 100 mm above the tip; a groove at Y 0
//! is cut from X 0 to X 30 at Z -5, with an approach and a return at Z 50.

use kinecut::base::{Code, Severity};
use kinecut::job::Outcome;

use super::fixtures::{found, line, value};
use crate::common::job::run_program;

const GROOVE: &str = "%\nO1\nG21 G17 G40 G80 G90 G94\nG54\nT1 M6\nS2000 M3\nG0 X0 Y0\nG43 H1 Z50\nG0 Z2\nG1 Z-5 F200\nX30 F400\nG0 Z50\nM30\n%\n";

/// A job with a machine of three axes whose nose is 80 mm wide, further bodies, and fixtures.
fn text(bodies: &str, fixtures: &str, position: &str) -> String {
    format!(
        r#"format = 1
stock = {{ box = {{ min = [-10, -10, -20], max = [40, 10, 0] }} }}
post = {{ control = "fanuc" }}
simulate = {{ step = 0.5 }}

[machine]
code = "1203"
travel = {{ X = [-500, 500], Y = [-500, 500], Z = [-500, 500] }}
dynamics = {{ rapid = 24000 }}

[[machine.body]]
name = "nose"
link = "Z"
cylinder = {{ base = [0, 0, 0], diameter = 80, height = 60 }}
{bodies}

[[tool]]
number = 1
type = "end-mill"
diameter = 8
flute_length = 20
stickout = 60
gauge_length = 100
{fixtures}
[[setup]]
offset = "G54"
{position}
program = {{ file = "P.nc" }}
"#
    )
}

/// The work zero is at the zero of the machine.
const PLACED: &str = "position = [0, 0, 0]";

fn outcome(bodies: &str, fixtures: &str) -> Outcome {
    run_program(&text(bodies, fixtures, PLACED), GROOVE).unwrap_or_else(|e| panic!("{e}"))
}

/// A post beside the groove, 20 mm wide, up to Z 110.
fn post(x: f64) -> String {
    format!(
        "[[fixture]]\nname = \"post\"\ncylinder = {{ base = [{x}, 0, -20], diameter = 20, height = 130 }}\n"
    )
}

#[test]
fn the_nose_meets_a_post_at_its_block_with_what_clears() {
    // Edges 40 + 10 mm apart from the middles: from X 10 on; 110 - 95 = 15 mm higher it clears.
    let done = outcome("", &post(60.0));
    let met = found(&done, Code::MACHINE_MET);
    let lines: Vec<&str> = met.iter().map(|f| line(f)).collect();
    assert_eq!(lines, ["X30 F400", "G0 Z50"]);
    assert_eq!(met[0].message, "`nose` of the machine meets `post`");
    assert_eq!(met[1].message, "`nose` of the machine meets `post` at rapid");
    assert!((value(met[0]) - 20.0).abs() < 0.03 && (value(met[1]) - 15.0).abs() < 0.03, "{met:?}");
    let help = &met[0].help;
    assert!(
        help.ends_with("; 15.01 mm higher it clears") || help.ends_with("; 15.02 mm higher it clears"),
        "{help}"
    );
    // The place: the side of the post towards the nose.
    let place = met[0].point.unwrap();
    assert!(
        (place[0] - 50.0).abs() < 0.05 && place[1].abs() < 1.5 && (place[2] - 95.0).abs() < 15.1,
        "{place:?}"
    );
    assert!(!done.verdict.is_safe());
    assert!(done.verdict.scope.iter().any(|s| s == "Fixtures as given compared, machine bodies compared"));
    // 5 mm further away it is clear, and that is proven.
    let done = outcome("", &post(81.0));
    assert!(found(&done, Code::MACHINE_MET).is_empty() && found(&done, Code::MACHINE_NEAR).is_empty());
    let claims: Vec<&str> = done.verdict.proven.iter().map(|p| p.claim.as_str()).collect();
    assert!(
        claims.contains(&"the body of the machine meets nothing in `P.nc`: tools, fixtures, the raw stock"),
        "{claims:?}"
    );
}

#[test]
fn a_near_pass_is_a_warning_with_its_distance() {
    // At X 30 the edges are 80.3 - 30 - 50 = 0.3 mm apart.
    let done = outcome("", &post(80.3));
    let near = found(&done, Code::MACHINE_NEAR);
    let [one] = near[..] else { panic!("{near:?}") };
    assert_eq!((one.severity, line(one)), (Severity::Warning, "X30 F400"));
    assert_eq!(one.message, "`nose` of the machine passes `post`");
    assert!((value(one) - 0.3).abs() < 2e-3, "{one:?}");
    // The distance to keep is that of the fixture, or of the nose, whichever is more.
    let quiet = post(80.3).replace("name =", "near = 0\nname =");
    assert_eq!(found(&outcome("", &quiet), Code::MACHINE_NEAR).len(), 1);
    let text = text("", &quiet, PLACED).replace("link = \"Z\"", "link = \"Z\"\nnear = 0");
    let done = run_program(&text, GROOVE).unwrap();
    assert!(found(&done, Code::MACHINE_NEAR).is_empty());
}

#[test]
fn the_tool_meets_a_body_of_a_link_below_it() {
    // A wall on the table link from X 24 to 25: the cutter of 8 mm is at it from X 20 to X 29.
    let wall = "[[machine.body]]\nname = \"wall\"\nlink = \"work\"\nbox = { min = [24, -5, -4], max = [25, 5, 0.5] }";
    let done = outcome(wall, "");
    let met = found(&done, Code::MACHINE_MET);
    assert_eq!((met.len(), line(met[0])), (1, "X30 F400"));
    assert_eq!(met[0].message, "the tool meets `wall` of the machine");
    assert!((value(met[0]) - 9.0).abs() < 0.03, "{met:?}");
}

#[test]
fn bodies_that_touch_from_the_start_are_one_error_and_not_compared() {
    let column = "[[machine.body]]\nname = \"column\"\nlink = \"bed\"\nbox = { min = [-100, -100, -100], max = [100, -5, 300] }";
    let done = outcome(column, "");
    let touch = found(&done, Code::BODIES_OVERLAP);
    // Nose and column are on neighbouring links: not compared. The stock is 10 mm to each side of the groove.
    let [one] = touch[..] else { panic!("{touch:?}") };
    assert_eq!(one.message, "`column` of the machine touches the stock where the program begins");
    assert_eq!((one.severity, line(one)), (Severity::Error, "G0 Z2"));
    assert!(found(&done, Code::MACHINE_MET).iter().all(|f| !f.message.contains("stock")));
    let open: Vec<String> = done.verdict.unchecked().map(ToString::to_string).collect();
    assert!(open.iter().any(|o| o.contains("`column` and `the stock`: not compared")), "{open:?}");
    assert!(done.verdict.scope.iter().any(|s| s.ends_with("machine bodies compared in part")));
}

#[test]
fn a_nose_that_is_too_low_meets_the_stock() {
    // A nose that ends 2 mm above the tip is 3 mm below the top of the stock at Z -5.
    let short = text("", "", PLACED).replace("base = [0, 0, 0]", "base = [0, 0, -98]");
    let done = run_program(&short, GROOVE).unwrap();
    let met = found(&done, Code::MACHINE_MET);
    assert!(met.len() == 3 && met.iter().all(|f| f.severity == Severity::Error), "{met:?}");
    assert_eq!((&met[0].message[..], line(met[0])), ("`nose` of the machine meets the stock", "G1 Z-5 F200"));
    assert!(
        (value(met[0]) - 3.0).abs() < 0.03 && met[0].help.ends_with("; 3.01 mm higher it clears"),
        "{}",
        met[0]
    );
    // Where zeros may be off the stock at that moment is not known.
    let off =
        short.replace("step = 0.5", "step = 0.5, uncertainty = { offset = 0.1, length = 0, stock = 0 }");
    let done = run_program(&off, GROOVE).unwrap();
    let met = found(&done, Code::MACHINE_MET);
    assert!(met.len() == 3 && met.iter().all(|f| f.severity == Severity::Doubt), "{met:?}");
    assert_eq!(met[0].message, "`nose` of the machine comes where the stock was before the first cut");
}

#[test]
fn what_is_not_compared_is_said() {
    let open = |text: &str| {
        let done = run_program(text, GROOVE).unwrap();
        let open: Vec<String> = done.verdict.unchecked().map(ToString::to_string).collect();
        (open.join("\n"), done.verdict.scope.join("\n"))
    };
    let (not_placed, scope) = open(&text("", &post(60.0), ""));
    assert!(not_placed.contains("where the part lies on the machine is not given"), "{not_placed}");
    assert!(scope.contains("machine bodies not compared"), "{scope}");
    let bare = text("", &post(60.0), PLACED).replace("gauge_length = 100\n", "");
    let (no_length, scope) = open(&bare);
    assert!(no_length.contains("in moves of T1, its gauge length is not given"), "{no_length}");
    assert!(scope.contains("machine bodies not compared"), "{scope}");
}

#[test]
fn the_example_finds_what_its_readme_says() {
    let done = super::examples::run("18_head_and_table", &[]);
    let met = found(&done, Code::MACHINE_MET);
    assert_eq!(met.len(), 6);
    assert!(met.iter().all(|f| f.message.starts_with("`head` of the machine meets `table` of the machine")));
    assert_eq!(met[0].place.as_ref().unwrap().line, 32);
    // The head has a radius of 95 and is 70 above the table.
    assert!((value(met[0]) - 25.0).abs() < 0.03, "{:?}", met[0]);
    assert!(met[0].help.contains("25.01 mm higher it clears"));
    let report = kinecut::job::report::html(&kinecut::job::report::of_job(&done));
    assert!(report.contains("id=\"machine-contact-1-1\""));
    // At the height of the first hole nothing is met.
    let done = super::examples::run("18_head_and_table", &[("[0, 70]", "[0, 100]")]);
    assert!(found(&done, Code::MACHINE_MET).is_empty());
    assert!(
        done.verdict.proven.iter().any(|p| p.claim.starts_with("the 8 bodies of the machine meet nothing"))
    );
}

#[test]
fn what_to_make_sure_of_has_its_room() {
    let room = |done: &Outcome, what: &str| {
        let one = done.verdict.to_ensure.iter().find(|e| e.what == what).unwrap();
        (one.value.clone(), one.room.clone())
    };
    // The nose passes the post at 1.256 mm.
    let done = outcome("", &post(81.256));
    let (value, near) = room(&done, "G54");
    assert_eq!(value, "machine X 0 Y 0 Z 0");
    assert!(near.unwrap().starts_with("1.25 mm: `nose` of the machine and `post`, line "));
    // The tool itself is further away than anything is looked for.
    assert_eq!(
        room(&done, "T1"),
        ("`end mill`, gauge length 100 mm".to_owned(), Some("more than 5 mm".to_owned()))
    );
    assert_eq!(room(&done, "clamps and fixtures").0, "`post`, where the job has them");
    assert_eq!(room(&done, "raw stock"), ("block 50 x 20 x 20 mm".to_owned(), None));
    let met = outcome("", &post(60.0));
    assert!(room(&met, "G54").1.unwrap().starts_with("`nose` of the machine and `post` touch, line "));
    let html = kinecut::job::report::html(&kinecut::job::report::of_job(&met));
    assert!(html.contains("Before the run"));
    // The list is part of what the digest covers.
    let mut changed = met.verdict.clone();
    changed.to_ensure[0].value.push('0');
    assert!(kinecut::job::Verdict::from_json(&changed.to_json()).is_err());
}

#[test]
fn a_longer_tool_that_comes_into_the_spindle_above_a_body_meets_it_at_its_change() {
    // 50 mm above the work zero the second tool, 30 mm longer, ends at Z 20: 10 mm within the block.
    let block = "[[fixture]]\nname = \"stop\"\nbox = { min = [100, -10, -20], max = [120, 10, 30] }\n";
    let longer = "\n[[tool]]\nnumber = 2\ntype = \"end-mill\"\ndiameter = 8\nflute_length = 20\nstickout = 90\ngauge_length = 130\n";
    let program = GROOVE.replace("G0 Z50\nM30", "G0 Z50\nX110\nT2 M6\nG43 H2 Z80\nM30");
    let done = run_program(&text("", &format!("{longer}{block}"), PLACED), &program).unwrap();
    let met = found(&done, Code::FIXTURE_MET);
    let said: Vec<(&str, &str)> = met.iter().map(|f| (line(f), f.message.as_str())).collect();
    assert_eq!(
        said,
        [
            ("T2 M6", "the tool meets `stop` as it comes into the spindle"),
            ("G43 H2 Z80", "the tool meets `stop` at rapid"),
        ]
    );
    assert!((value(met[1]) - 10.0).abs() < 0.03, "{met:?}");
    // Changed higher it clears.
    let high = program.replace("X110\nT2", "Z90\nX110\nT2").replace("Z80", "Z100");
    let done = run_program(&text("", &format!("{longer}{block}"), PLACED), &high).unwrap();
    assert!(found(&done, Code::FIXTURE_MET).is_empty());
}

/// A job whose nose, 12 mm wide, ends 10 mm above the tip of a cutter of 20 mm, in a block that goes from Y -20 to 20 and from Z -30
/// to 0.
fn thin_nose_text(flutes: u32) -> String {
    text("", "", PLACED)
        .replace("min = [-10, -10, -20], max = [40, 10, 0]", "min = [0, -20, -30], max = [60, 20, 0]")
        .replace(
            "base = [0, 0, 0], diameter = 80, height = 60",
            "base = [0, 0, -90], diameter = 12, height = 150",
        )
        .replace(
            "diameter = 8\nflute_length = 20",
            &format!("diameter = 20\nflute_length = {flutes}\nshank_diameter = 12"),
        )
}

fn thin_nose_program(blocks: &str) -> String {
    let head = "%\nO1\nG21 G17 G40 G80 G90 G94\nG54\nT1 M6\nS2000 M3\nG0 X-20 Y0\nG43 H1 Z50";
    format!("{head}\n{blocks}\nG0 Z50\nM30\n%\n")
}

fn thin_nose(flutes: u32, blocks: &str) -> Outcome {
    run_program(&thin_nose_text(flutes), &thin_nose_program(blocks)).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn the_stock_is_there_or_not_at_the_moment() {
    // Down the groove: the nose is 4 mm from its walls, and below the top of the raw stock in the last two passes.
    let passes = "G1 Z-4 F900\nX80\nZ-8\nX-20\nZ-12\nX80\nZ-16\nX-20\n";
    let right = thin_nose(9, passes);
    assert!(found(&right, Code::MACHINE_MET).is_empty(), "{:?}", right.verdict.found);
    let contacts = right.simulation.machine[0].as_ref().unwrap();
    let then = contacts.stock_then.unwrap();
    assert!(
        then.cleared == 2 && then.step == 0.5 && contacts.met.meetings.iter().all(|m| m.contact.is_none())
    );
    let claim = right.verdict.proven.iter().find(|p| p.claim.contains("body of the machine")).unwrap();
    assert!(claim.claim.ends_with("in `P.nc`: tools, the stock"), "{claim:?}");
    assert!(
        claim.bound.contains("the stock at that moment is 0.75 mm away or more, by lines 0.50 mm apart"),
        "{claim:?}"
    );
    let text = format!("{:?}", kinecut::job::report::of_job(&right).sections);
    assert!(text.contains("2 contacts with the raw stock cleared"), "{text}");
    assert!(text.contains("see the stock at that moment") && text.contains("nothing meets it"), "{text}");

    // To the depth at once the nose goes through the upper 6 mm of the stock with the tool: it is cut by the tool in the same
    // block, right before the nose is there; that is not followed.
    let at_once = thin_nose(30, "G1 Z-16 F900\nX80\n");
    let all = found(&at_once, Code::MACHINE_MET);
    assert!(all.len() == 1 && all[0].severity == Severity::Doubt, "{all:?}");
    assert_eq!(line(all[0]), "X80");
    assert_eq!(all[0].message, "`nose` of the machine comes where the stock was before the first cut");

    // Out of the groove sideways the nose meets the wall, 4 mm away, that stays: an error at its line.
    let aside = thin_nose(9, &format!("{passes}X30\nY5\nY0\n"));
    let all = found(&aside, Code::MACHINE_MET);
    assert_eq!(
        all.iter().map(|f| (f.severity, line(f))).collect::<Vec<_>>(),
        [(Severity::Error, "Y5"), (Severity::Error, "Y0")]
    );
    assert_eq!(all[0].message, "`nose` of the machine meets the stock");
    // The last 1 mm of the way of 5 mm: the nose is at the wall from Y 4 on.
    assert!((value(all[0]) - 1.0).abs() < 0.1, "{}", all[0]);
}

#[test]
fn what_a_later_block_takes_away_was_there_before() {
    // The nose meets the upper part of the wall, 4 mm away; in the end the groove is made wider there.
    let program =
        "G1 Z-4 F900\nX80\nZ-8\nX-20\nZ-12\nX80\nZ-16\nX-20\nX30\nY5\nY0\nZ-4\nX-20\nY8\nX80\nZ-8\nX-20\n";
    let done = thin_nose(9, program);
    let met = found(&done, Code::MACHINE_MET);
    let all: Vec<_> = met.iter().map(|f| (f.severity, line(f))).collect();
    assert_eq!(all, [(Severity::Error, "Y5"), (Severity::Error, "Y0")], "{met:?}");
    // The other way round it is gone before.
    let program = "G1 Z-4 F900\nX80\nZ-8\nX-20\nY8\nX80\nX-20\nY0\nZ-12\nX80\nZ-16\nX-20\nX30\nY5\nY0\n";
    let done = thin_nose(9, program);
    assert!(found(&done, Code::MACHINE_MET).is_empty(), "{:?}", done.verdict.found);
    assert_eq!(done.simulation.machine[0].as_ref().unwrap().stock_then.map(|then| then.cleared), Some(6));
}

#[test]
fn an_earlier_setup_has_cut_it_away() {
    // The groove is made in the first setup; in the second the nose comes through it, and into the wall that it has left.
    let groove = "G1 Z-4 F900\nX80\nZ-8\nX-20\nZ-12\nX80\nZ-16\nX-20";
    let second = format!("\n[[setup]]\noffset = \"G54\"\n{PLACED}\nprogram = {{ file = \"Q.nc\" }}\n");
    let run = |first: &str, blocks: &str| {
        let loader = kinecut::base::MemoryLoader::default()
            .with("P.nc", thin_nose_program(first))
            .with("Q.nc", thin_nose_program(blocks));
        let text = thin_nose_text(9) + &second;
        kinecut::job::run("job.toml", &text, &loader, &kinecut::base::Silent)
            .unwrap_or_else(|e| panic!("{e}"))
    };
    let through = "G1 Z-16 F900\nX80";
    let done = run(groove, through);
    assert!(found(&done, Code::MACHINE_MET).is_empty(), "{:?}", done.verdict.found);
    let cleared = |i: usize| done.simulation.machine[i].as_ref().unwrap().stock_then.unwrap().cleared;
    assert_eq!([cleared(0), cleared(1)], [2, 1]);
    let done = run(groove, "G1 Z-16 F900\nX30\nY5");
    let met: Vec<_> = found(&done, Code::MACHINE_MET).iter().map(|f| (f.severity, line(f))).collect();
    assert_eq!(met, [(Severity::Error, "Y5"), (Severity::Error, "G0 Z50")]);
    // What the second setup has cut by then counts as well: on its last pass the nose is 2 mm below the floor of the first.
    let done = run(groove, "G1 Z-20 F900\nX80\nZ-24\nX-20\nZ-28\nX80");
    assert!(found(&done, Code::MACHINE_MET).is_empty(), "{:?}", done.verdict.found);
    // Without the groove the second setup meets the stock.
    let met = run("G0 X-20", through);
    assert_eq!(found(&met, Code::MACHINE_MET).iter().map(|f| line(f)).collect::<Vec<_>>(), ["X80"]);
}
