//! Messages about tables of a wrong form: each names the key, what it takes with its unit, and what to write.

use schemars::JsonSchema;
use serde::de::DeserializeOwned;

use crate::base::{MemoryLoader, Sources};
use crate::job::JobText;
use crate::job::file::{HoleTable, JobFile, MachineTable, SetupTable, ToolTable};
use crate::job::lacking::with_lines_of_whole;
use crate::job::read::read_table;
use crate::operations::OperationTable;

/// The message and the help of a text that is no `T`.
fn told<T: DeserializeOwned + JsonSchema + Clone>(text: &str) -> (String, String) {
    let mut sources = Sources::default();
    let id = sources.add("t.toml", text);
    match read_table(&sources, id, |table: &T| Ok(table.clone())) {
        Ok(_) => panic!("{text} is read"),
        Err(error) => (error.0.message, error.0.help),
    }
}

fn tool(line: &str) -> (String, String) {
    let key = line.split(' ').next().unwrap();
    let rest = ["number = 1", "type = \"end-mill\"", "diameter = 10", "flute_length = 22"];
    let rest: Vec<&str> = rest.into_iter().filter(|l| !l.starts_with(&format!("{key} "))).collect();
    told::<ToolTable>(&format!("{line}\n{}", rest.join("\n")))
}

/// That of an operation in a job.
fn operation(kind: &str, lines: &str) -> (String, String) {
    let text = format!("[[setup]]\noffset = \"G54\"\n[[setup.operation]]\ntype = \"{kind}\"\n{lines}\n");
    let error = job(&(START.to_owned() + &text), &[]);
    assert!(error.place.is_some_and(|place| place.line > 5), "{lines}");
    (error.message, error.help)
}

/// The first lines of a job.
const START: &str = "format = 1\nstock = { mesh = \"a.stl\" }\npost = { control = \"fanuc\" }\n";

fn check(given: (String, String), message: &str, help: &str) {
    assert_eq!((given.0.as_str(), given.1.as_str()), (message, help));
}

#[test]
fn numbers() {
    let slot = |line: &str| operation("slot", &format!("tool = 1\nwidth = 12\ndepth = 4\n{line}"));
    check(
        slot("speed = \"4000 rpm\""),
        "`speed` takes a number in rev/min, without its unit, not \"4000 rpm\"",
        "write speed = 4000",
    );
    check(
        slot("speed = \"120 m/min\""),
        "`speed` takes a number in rev/min, not in m/min: \"120 m/min\"",
        "a number in m/min belongs to `cutting_speed`, as cutting_speed = 120",
    );
    check(
        slot("speed = [4000]"),
        "`speed` takes a number in rev/min, not a list of one",
        "write speed = 4000",
    );
    check(
        slot("speed = { rpm = 4000 }"),
        "`speed` takes a number in rev/min, not a table",
        "write it as speed = 3800",
    );
    check(
        tool("diameter = \"10\""),
        "`diameter` takes a number in mm, without quotes, not \"10\"",
        "write diameter = 10",
    );
    check(
        tool("diameter = \"6,6 mm\""),
        "`diameter` takes a number in mm, without its unit, not \"6,6 mm\"",
        "write diameter = 6.6",
    );
    check(
        tool("diameter = \"0.5 in\""),
        "`diameter` takes a number in mm, not in inches: \"0.5 in\"",
        "write it as diameter = 10",
    );
    check(
        tool("diameter = \"4O mm\""),
        "`diameter` takes a number in mm, not \"4O mm\"",
        "write it as diameter = 10",
    );
    check(tool("diameter = true"), "`diameter` takes a number in mm, not true", "write it as diameter = 10");
    check(tool("teeth = 2.5"), "`teeth` takes a whole number from 0, not 2.5", "write it as teeth = 4");
    check(tool("teeth = 4.0"), "`teeth` takes a whole number from 0, not 4.0", "write teeth = 4");
    check(
        tool("teeth = \"4\""),
        "`teeth` takes a whole number from 0, without quotes, not \"4\"",
        "write teeth = 4",
    );
    check(tool("teeth = -4"), "`teeth` takes a whole number from 0, not -4", "write it as teeth = 4");
}

#[test]
fn texts_and_truths() {
    check(
        told::<SetupTable>("offset = 54"),
        "`offset` takes a text in quotes, not 54",
        "write offset = \"54\"",
    );
    check(
        tool("centre_cutting = \"true\""),
        "`centre_cutting` takes true or false, not \"true\"",
        "write centre_cutting = true",
    );
    check(
        tool("centre_cutting = 1"),
        "`centre_cutting` takes true or false, not 1",
        "write centre_cutting = true",
    );
}

#[test]
fn lists() {
    let drill = |line: &str| operation("drill", &format!("tool = 1\n{line}"));
    check(
        drill("points = [0, 0, 40, 0]"),
        "`points` takes a list of lists, 2 numbers in mm each, not one with 0 in it",
        "write points = [[0, 0], [40, 0]]",
    );
    check(
        drill("points = [[0, \"5 mm\"]]"),
        "`points` takes a list of lists, 2 numbers in mm each, without units, not one with \"5 mm\" in it",
        "write points = [[0, 5]]",
    );
    let bore = |line: &str| {
        operation(
            "bore",
            &format!("tool = 1\n{line}\ndiameter = 40\ndepth = 8\nstrategy = \"involute\"\nspeed = 8000"),
        )
    };
    check(
        bore("at = [0, 0, 0]"),
        "`at` takes a list of 2 numbers in mm, not of 3",
        "write it as at = [0, 0]",
    );
    check(bore("at = 5"), "`at` takes a list of 2 numbers in mm, not 5", "write it as at = [0, 0]");
    check(bore("at = \"5, 6\""), "`at` takes a list of 2 numbers in mm, not \"5, 6\"", "write at = [5, 6]");
    check(tool("runout = 0.01"), "`runout` takes a list of numbers in mm, not 0.01", "write runout = [0.01]");
}

#[test]
fn tables_and_choices() {
    let contour = |line: &str| operation("contour", &format!("tool = 1\ndepth = 4\n{line}"));
    check(
        contour("entry = \"ramp\""),
        "`entry` takes \"plunge\" or a table { ramp = .. }, not \"ramp\"",
        "write entry = { ramp = 3 }",
    );
    check(
        contour("entry = { ramp = \"3 deg\" }"),
        "`ramp` takes a number in degrees, without its unit, not \"3 deg\"",
        "write ramp = 3",
    );
    check(contour("tabs = 4"), "`tabs` takes a table, not 4", "write it as tabs = { width = 6, height = 2 }");
    check(
        told::<JobFile>(&format!("{START}[[setup]]\noffset = \"G54\"\n[tool]\nnumber = 1\n")),
        "`tool` takes a list of tables, not a table",
        "write [[tool]] in place of [tool], or put the table in square brackets",
    );
    check(
        told::<JobFile>(&format!("{START}[[setup]]\noffset = \"G54\"\n[[simulate]]\nstep = 1\n")),
        "`simulate` takes a table, not a list of one",
        "write [simulate] in place of [[simulate]]: there is one only",
    );
    let (message, _) = operation("drill", "tool = 1\nexit = { surface = \"plane\", inclinaton = 3 }");
    assert!(message.starts_with("unknown field `inclinaton`, expected one of "), "{message}");
    let (message, help) = operation("drill", "tool = 1\nexit = { inclination = 3 }");
    assert_eq!(message, "`surface` is missing");
    assert!(help.starts_with("for example surface = \"plane\""), "{help}");
    check(
        operation("contour", "depth = 4\ntool = 1.5"),
        "`tool` takes the number or the name of a tool, not 1.5",
        "write it as tool = 1",
    );
    check(
        told::<MachineTable>("travel = { X = 400 }"),
        "`X` takes a list of 2 numbers in mm, rotary axes degrees, not 400",
        "write it as X = [.., ..]",
    );
    check(
        told::<HoleTable>("size = [6, 7]"),
        "`size` takes a number in mm or a text in quotes, not a list of 2",
        "write it as size = \"M8\"",
    );
}

/// The error of a job with its files.
fn job(text: &str, files: &[(&str, &str)]) -> crate::base::Finding {
    let mut sources = Sources::default();
    let id = sources.add("job.toml", text);
    let loader = files.iter().fold(MemoryLoader::default(), |l, (name, text)| l.with(name, *text));
    *JobText::read(&mut sources, id, &loader).unwrap_err().0
}

#[test]
fn all_that_a_job_and_its_files_lack_is_in_one_error() {
    let text = r#"machine = "vmc.toml"
tools = ["shop.toml"]
stock = { box = { min = [0, 0, -10] } }
drilled = [{ at = [1, 1], diameter = 3 }]

[post]

[[holder]]
name = "a"
segments = [{ height = 20 }]

[[tool]]
number = 1

[[tool]]
number = 2
type = "drill"
diameter = 5
point = { stepped = { stages = [{ diameter = 3 }] } }

[[fixture]]
name = "vise"
vise = { opening = 40 }

[[setup]]
[[setup.operation]]
type = "slot"
tool = 1
arc = { radius = 30 }
[[setup.operation]]
type = "hole"
[[setup]]
offset = "G55"
[[setup.operation]]
type = "drill"
exit = { inclination = 3 }
pattern = { grid = { at = [0, 0] } }
"#;
    let vmc = "code = \"2103\"\n[[body]]\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\n";
    let shop = "[[tool]]\nnumber = 7\ntype = \"drill\"\nflute_length = 30\n";
    let error = job(text, &[("vmc.toml", vmc), ("shop.toml", shop)]);
    assert_eq!(error.message, "`format` is missing");
    let help = error.help;
    for words in [
        "for example format = 1 (a whole number, ",
        "line 3 lacks max = [100, 60, 0] (mm, greatest corner)",
        "line 4 lacks top = 0 (mm, height of the hole's upper end) and bottom = -20 (mm, ",
        "line 6 lacks control = \"fanuc\" (the control: ",
        "line 10 lacks lower_diameter = 50 (mm, diameter at the lower end)",
        "line 12 lacks type = \"end-mill\" (kind), diameter = 10 (mm) and flute_length = 22 (mm, height",
        "line 15 lacks `flute_length`",
        "line 19 lacks length = 15 (mm, ",
        "line 23 lacks jaw_width = 150 (mm, ",
        "line 25 lacks offset = \"G54\"",
        "line 26 lacks width = 12 (mm, ",
        "line 29 lacks from = 0 (degrees, ",
    ] {
        assert!(help.contains(words), "{words}: {help}");
    }
    assert!(help.contains("more tables lack keys"), "{help}");
    assert!(help.contains("vmc.toml line 2 lacks link = \"Z\""), "{help}");
    assert!(help.contains("shop.toml line 1 lacks diameter = 10 (mm)"), "{help}");
    // Where the job itself is whole, that of its machine and those of its tools.
    let whole = "format = 1\nmachine = \"vmc.toml\"\ntools = \"shop.toml\"\nstock = { mesh = \"a.stl\" }\n\
                 post = { control = \"fanuc\" }\n[[setup]]\noffset = \"G54\"\n";
    let error = job(whole, &[("vmc.toml", vmc), ("shop.toml", shop)]);
    assert_eq!(
        (error.message.as_str(), error.place.unwrap().file.as_str()),
        ("`link` is missing", "vmc.toml")
    );
    assert!(error.help.contains("shop.toml line 1 lacks diameter = 10 (mm)"), "{}", error.help);
    let error = job(&whole.replace("machine = \"vmc.toml\"\n", ""), &[("shop.toml", shop)]);
    assert_eq!(
        (error.message.as_str(), error.place.unwrap().file.as_str()),
        ("`diameter` is missing", "shop.toml")
    );
    // A machine in the job itself.
    let inline = whole.replace("machine = \"vmc.toml\"\ntools = \"shop.toml\"\n", "") + "[machine]\n" + vmc;
    let inline = inline.replace("[[body]]", "[[machine.body]]").replace("offset = \"G54\"", "");
    let error = job(&inline, &[]);
    assert_eq!(error.message, "`offset` is missing");
    assert!(error.help.contains("line 8 lacks link = \"Z\""), "{}", error.help);
}

#[test]
fn another_fault_comes_first_and_what_is_missing_elsewhere_is_in_its_help() {
    let slots = "[[setup]]\noffset = \"G54\"\n[[setup.operation]]\ntype = \"slot\"\ntool = 1\nwith = 5\ndepth = 3\n\
                 speed = 9000\n[[setup.operation]]\ntype = \"slot\"\ntool = 1\nwidth = 9\n";
    let text = START.to_owned() + slots;
    let error = job(&text, &[]);
    assert!(error.message.starts_with("unknown field `with`"), "{error}");
    // A key of a wrong name is not missing.
    let help = "did you mean `width`? Line 12 lacks depth = 8 (mm, depth below it)";
    assert_eq!((error.help.as_str(), error.place.unwrap().line), (help, 9));
    let error = job(&text.replace("with", "width").replace("9000", "\"9000 rpm\""), &[]);
    assert_eq!(error.help, "write speed = 9000; line 12 lacks depth = 8 (mm, depth below it)");
    // The setup is read before its operations.
    let error = job(&text.replace("offset = \"G54\"\n", ""), &[]);
    assert_eq!(error.message, "`offset` is missing");
    let words = "for example offset = \"G54\" (work offset); line 5 lacks width = 12 (mm, its width, that of the \
                 cutter or more), in place of `with`; line 11 lacks depth = 8 (mm, depth below it)";
    assert_eq!(error.help, words);
}

#[test]
fn lines_of_a_part_are_those_of_the_whole_text() {
    let help = "for example feed = 500 (mm/min, in line 3); line 12 lacks `feed`; line x lacks nothing";
    let moved = "for example feed = 500 (mm/min, in line 3); line 112 lacks `feed`; line x lacks nothing";
    assert_eq!(with_lines_of_whole(help, 100), moved);
}

#[test]
fn a_value_without_a_place_is_found_in_its_table() {
    let told =
        told::<OperationTable>("type = \"slot\"\ntool = 1\nwidth = 12\ndepth = 4\nspeed = \"4000 rpm\"");
    check(
        told,
        "`speed` takes a number in rev/min, without its unit, not \"4000 rpm\"",
        "write speed = 4000",
    );
}
