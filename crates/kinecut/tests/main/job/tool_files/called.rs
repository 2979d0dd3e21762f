//! Tools as operations of a job call them.

use kinecut::base::{Error, Finding, Loader, MemoryLoader, Sources};
use kinecut::job::{Job, JobText, check, parts};

/// A job without tools; `{tool}` is the one that is called.
const JOB: &str = r#"format = 1
stock = { box = { min = [-30, -30, -10], max = [30, 30, 0] } }
post = { control = "sinumerik-840d" }
simulate = { step = 1.0 }
{head}
[[setup]]
offset = "G54"

[[setup.operation]]
type = "pocket"
tool = {tool}
rectangle = { at = [0, 0], size = [40, 30], corner = 6 }
depth = 5
{data}
"#;

const SHOP: &str = r#"[[holder]]
name = "Chuck"
segments = [{ height = 20, lower_diameter = 40 }]

[[tool]]
number = 5
name = "End Mill  10"
type = "end-mill"
diameter = 10
flute_length = 22
stickout = 30
holder = "Chuck"

[[tool.preset]]
material = "C45"
cutting_speed = 150
feed_per_tooth = 0.06

[[tool.preset]]
material = "Brass"
speed = 9000
feed = 1500

[[tool]]
number = 6
name = "end mill 8"
type = "end-mill"
diameter = 8
flute_length = 19

[[tool]]
number = 7
name = "odd mill"
type = "end-mill"
diameter = -8
flute_length = 19
"#;

const DATA: &str = "speed = 6000\nfeed_per_tooth = 0.05";

fn job(head: &str, tool: &str, data: &str) -> String {
    JOB.replace("{head}", head).replace("{tool}", tool).replace("{data}", data)
}

/// A checked job with what its text gave.
struct Read {
    job: Job,
    text: JobText,
    notes: Vec<Finding>,
}

fn read_with(text: &str, loader: &dyn Loader) -> Result<Read, Error> {
    let mut sources = Sources::default();
    let id = sources.add("job.toml", text);
    let text = JobText::read(&mut sources, id, loader)?;
    let job = check(&text.file, "job", loader).map_err(|e| text.locate(&sources, e))?;
    let mut notes = text.notes(&sources);
    notes.extend(job.data_notes().into_iter().map(|note| *text.locate(&sources, note.into()).0));
    Ok(Read { job, text, notes })
}

fn loader() -> MemoryLoader {
    MemoryLoader::default().with("shop.toml", SHOP)
}

fn read(head: &str, tool: &str) -> Result<Read, Error> {
    read_with(&job(head, tool, DATA), &loader())
}

fn refused(head: &str, tool: &str) -> Error {
    read(head, tool).map(|read| read.job.tools).unwrap_err()
}

/// File, line and source line of an error.
fn place(error: &Error) -> (String, u32, String) {
    error.0.place.clone().map(|p| (p.file, p.line, p.text)).unwrap()
}

#[test]
fn a_tool_is_called_by_number_or_name() {
    let by_number = read("tools = \"shop.toml\"", "5").unwrap();
    for name in ["\"end mill 10\"", "\"End Mill  10\"", "\" END\\tMILL 10 \""] {
        for head in ["tools = \"shop.toml\"", "tools = [\"shop.toml\"]", "tools = [{ file = \"shop.toml\" }]"]
        {
            let read = read(head, name).unwrap();
            assert_eq!(read.job.tools, by_number.job.tools, "{name}");
            assert_eq!(read.job.setups[0].operations[0].milling().tool.number.0, 5);
        }
    }
    // Only what is called comes into the job, with its holder.
    let [tool] = &by_number.job.tools[..] else { panic!("{:?}", by_number.job.tools) };
    assert_eq!((tool.name.as_str(), tool.cutter.diameter(5.0), tool.stickout), ("End Mill  10", 10.0, 30.0));
    assert_eq!(tool.holder.as_ref().unwrap().segments[0].lower_diameter, 40.0);
    assert!(by_number.notes.is_empty(), "{:?}", by_number.notes);
    // A job without files calls its own tools by name, too.
    let own =
        "[[tool]]\nnumber = 3\nname = \"the mill\"\ntype = \"end-mill\"\ndiameter = 10\nflute_length = 22\n";
    assert_eq!(read(own, "\"The Mill\"").unwrap().job.setups[0].operations[0].milling().tool.number.0, 3);
}

#[test]
fn an_unknown_tool_is_refused_with_the_nearest() {
    let error = refused("tools = \"shop.toml\"", "\"end mil 10\"");
    assert_eq!(
        (error.code().to_string().as_str(), error.0.key.as_deref()),
        ("KC0104", Some("setup[0].operation[0].tool"))
    );
    assert_eq!(place(&error), ("job.toml".to_owned(), 11, "tool = \"end mil 10\"".to_owned()));
    assert!(error.to_string().contains("`end mil 10` is not defined"), "{error}");
    assert!(error.0.help.contains("did you mean `End Mill  10` or `end mill 8`"), "{}", error.0.help);
    let error = refused("tools = \"shop.toml\"", "4");
    assert!(error.0.help.contains("in `shop.toml`; the nearest are T5, T6, T7"), "{}", error.0.help);
    // The name of a kind is no name of a tool without one.
    let own = "[[tool]]\nnumber = 3\ntype = \"end-mill\"\ndiameter = 10\nflute_length = 22\n";
    assert!(refused(own, "\"end mill\"").to_string().contains("is not defined"));
    let error = refused("tools = \"gone.toml\"", "5");
    assert_eq!(error.code().to_string(), "KC0001");
    for wrong in ["tools = 5", "tools = [5]", "tools = { name = \"a\" }"] {
        assert!(refused(wrong, "5").to_string().contains("tool file"), "{wrong}");
    }
    for wrong in ["-1", "1.5", "true", "[5]"] {
        let error = refused("tools = \"shop.toml\"", wrong);
        assert_eq!((error.code().to_string().as_str(), place(&error).1), ("KC0102", 11), "{error}");
        assert!(error.to_string().contains("number or the name of a tool"), "{error}");
    }
}

#[test]
fn a_name_or_number_of_two_tools_is_refused_where_it_is_called() {
    let other = MemoryLoader::default()
        .with("shop.toml", SHOP)
        .with("b.toml", SHOP.replace("number = 5", "number = 50"))
        .with("c.toml", SHOP.replace("End Mill  10", "other"));
    let head = |second: &str| format!("tools = [\"shop.toml\", \"{second}\"]");
    let error = read_with(&job(&head("b.toml"), "\"end mill 10\"", DATA), &other).map(|_| ()).unwrap_err();
    let told = "`end mill 10` is the name of several tools: T5 `End Mill  10` of `shop.toml`, T50 `End Mill  10` of `b.toml`";
    assert!(error.to_string().contains(told), "{error}");
    assert_eq!(place(&error).1, 11);
    assert_eq!(read_with(&job(&head("b.toml"), "50", DATA), &other).unwrap().job.tools[0].number.0, 50);
    let error = read_with(&job(&head("c.toml"), "5", DATA), &other).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("T5 is the number of several tools"), "{error}");
    // By their names both are found; in one program they would have one number.
    let one = job(&head("c.toml"), "\"other\"", DATA);
    let two = one.clone() + &one[one.find("[[setup.operation]]").unwrap()..].replace("other", "End Mill 10");
    assert_eq!(read_with(&one, &other).unwrap().job.tools.len(), 1);
    let error = read_with(&two, &other).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("have one number"), "{error}");
    assert_eq!(error.0.key.as_deref(), Some("setup[0].operation[1].tool"));
}

#[test]
fn a_tool_of_the_job_stands_in_the_place_of_one_of_its_number() {
    let own = "tools = \"shop.toml\"\n[[tool]]\nnumber = 5\nname = \"mine\"\ntype = \"end-mill\"\ndiameter = 9\nflute_length = 22\n";
    let by_number = read(own, "5").unwrap();
    assert_eq!(by_number.job.tools.len(), 1);
    assert_eq!(by_number.job.tools[0].cutter.diameter(5.0), 9.0);
    assert_eq!(by_number.notes.len(), 1, "{:?}", by_number.notes);
    assert_eq!(by_number.notes[0].message, "T5 is that of the job, not that of `shop.toml`");
    // That of the file is not there under its name either.
    assert!(refused(own, "\"end mill 10\"").to_string().contains("is not defined"));
    let both = read(own, "\"end mill 8\"").unwrap();
    assert_eq!(both.job.tools.iter().map(|t| t.number.0).collect::<Vec<_>>(), [5, 6]);
}

#[test]
fn errors_of_a_tool_file_stand_in_that_file() {
    let error = refused("tools = \"shop.toml\"", "7");
    let line = SHOP.lines().position(|line| line == "diameter = -8").unwrap() as u32 + 1;
    assert_eq!(place(&error), ("shop.toml".to_owned(), line, "diameter = -8".to_owned()));
    // A tool that nobody calls is in nobody's way.
    assert!(read("tools = \"shop.toml\"", "6").is_ok());
    let broken = MemoryLoader::default().with("shop.toml", SHOP.replace("diameter = 8\n", "diametr = 8\n"));
    let error = read_with(&job("tools = \"shop.toml\"", "5", DATA), &broken).map(|_| ()).unwrap_err();
    assert_eq!((place(&error).0.as_str(), place(&error).2.as_str()), ("shop.toml", "diametr = 8"));
    let holder = MemoryLoader::default().with("shop.toml", SHOP.replace("height = 20", "height = -20"));
    let error = read_with(&job("tools = \"shop.toml\"", "5", DATA), &holder).map(|_| ()).unwrap_err();
    assert_eq!((place(&error).0.as_str(), place(&error).1), ("shop.toml", 3), "{error}");
}

#[test]
fn what_a_file_does_not_tell_is_missed_where_the_tool_is_called() {
    let table = MemoryLoader::default().with("tool.tbl", "T3 P3 Z80 D10 ;end mill\nT4 D8\n");
    let head = "tools = \"tool.tbl\"";
    let error = read_with(&job(head, "3", DATA), &table).map(|_| ()).unwrap_err();
    assert_eq!((error.code().to_string().as_str(), place(&error).1), ("KC0706", 11));
    assert!(error.to_string().contains("T3 `end mill` lacks flute_length (not in a tool table)"), "{error}");
    // A tool of the job in its place has all.
    let own =
        "tools = \"tool.tbl\"\n[[tool]]\nnumber = 3\ntype = \"end-mill\"\ndiameter = 10\nflute_length = 22\n";
    assert!(read_with(&job(own, "3", DATA), &table).is_ok());
}

#[test]
fn fields_that_are_not_taken_and_guesses_are_told_of_the_tools_that_are_called() {
    let bit = r#"{ "name": "mill", "shape": "endmill.fcstd",
        "parameter": { "Diameter": 10, "CuttingEdgeHeight": "22 mm", "Length": "60 mm" } }"#;
    let loader = MemoryLoader::default().with("a.fctb", bit).with("b.fctb", bit);
    let head = "tools = [{ file = \"a.fctb\", number = 3 }, { file = \"b.fctb\", number = 4 }]";
    let read = read_with(&job(head, "3", DATA), &loader).unwrap();
    let told: Vec<(String, &str)> =
        read.notes.iter().map(|n| (n.code.to_string(), n.message.as_str())).collect();
    assert_eq!(
        told,
        [
            ("KC0707".to_owned(), "not taken of T3 `mill`: parameter.Length"),
            ("KC0708".to_owned(), "assumed of T3 `mill`: Diameter as 10 mm"),
        ]
    );
    assert_eq!(read.notes[0].place.as_ref().unwrap().file, "a.fctb");
}

#[test]
fn a_verdict_is_about_the_tool_files_that_were_read() {
    let files = |shop: &str| -> Vec<(String, Option<String>, String)> {
        let loader = MemoryLoader::default().with("shop.toml", shop);
        let read = read_with(&job("tools = \"shop.toml\"", "5", DATA), &loader).unwrap();
        let parts = parts(&read.text.file, &loader).unwrap();
        parts.into_iter().filter(|p| p.role == "tools").map(|p| (p.role, p.file, p.sha256)).collect()
    };
    let (before, after) = (files(SHOP), files(&SHOP.replace("diameter = 10", "diameter = 10.5")));
    assert_eq!(before.len(), 2);
    assert_eq!(before[1].1.as_deref(), Some("shop.toml"));
    assert!(before[0].2 != after[0].2 && before[1].2 != after[1].2);
    // Another tool of the file changes its bytes, not the tools of the job.
    let other = files(&SHOP.replace("diameter = 8", "diameter = 8.5"));
    assert!(before[0].2 == other[0].2 && before[1].2 != other[1].2);
}

#[test]
fn an_operation_without_a_speed_takes_the_preset_of_the_material() {
    let with = |material: &str, data: &str| {
        read_with(&job(&format!("tools = \"shop.toml\"\nmaterial = \"{material}\""), "5", data), &loader())
    };
    let spindle =
        |read: &Read| read.job.setups[0].operations[0].milling().spindle * 60.0 / std::f64::consts::TAU;
    let read = with("c45", "").unwrap();
    // 150 m/min on 10 mm.
    assert!((spindle(&read) - 4775.0).abs() < 0.5, "{}", spindle(&read));
    assert_eq!(read.notes.len(), 1, "{:?}", read.notes);
    let told = "cutting_speed 150 m/min, feed_per_tooth 0.06 mm from the preset C45 of T5 of `shop.toml`";
    assert_eq!((read.notes[0].code.to_string().as_str(), read.notes[0].message.as_str()), ("KC0709", told));
    assert_eq!(read.notes[0].place.as_ref().unwrap().file, "job.toml");
    assert!((spindle(&with("Brass", "").unwrap()) - 9000.0).abs() < 1e-6);
    // Keys of the operation count first.
    let said = with("C45", "speed = 3000\nfeed = 200").unwrap();
    assert!((spindle(&said) - 3000.0).abs() < 1e-6 && said.notes.is_empty());
    let feed = with("C45", "feed = 200").unwrap();
    assert!(feed.notes[0].message.starts_with("cutting_speed 150 m/min from"), "{}", feed.notes[0].message);
    for (material, data) in [("S235", ""), ("", "")] {
        let error = with(material, data).map(|_| ()).unwrap_err();
        assert!(error.to_string().contains("needs a speed"), "{error}");
    }
}

#[test]
fn a_program_of_others_gets_the_tools_that_it_calls() {
    let text = "format = 1\ntools = \"shop.toml\"\nstock = { box = { min = [-30, -30, -10], max = [30, 30, 0] } }\n\
                post = { control = \"fanuc\" }\n[[setup]]\noffset = \"G54\"\nprogram = { file = \"O1.nc\" }\n";
    let tools = |program: &str| {
        let read = read_with(text, &loader().with("O1.nc", program)).unwrap();
        read.job.tools.iter().map(|t| t.number.0).collect::<Vec<_>>()
    };
    assert_eq!(tools("%\nO1\nT5 M6\nM30\n%\n"), [5]);
    assert_eq!(tools("%\nO1\nT6 M6\nT5 M6\nM30\n%\n"), [5, 6]);
    assert_eq!(tools("%\nO1\nM30\n%\n"), [0u32; 0]);
}

#[test]
fn of_several_presets_for_a_material_none_is_taken() {
    let second = "[[tool.preset]]\nmaterial = \"c45\"\nname = \"slotting\"\ncutting_speed = 90\nfeed_per_tooth = 0.04\n\n[[tool]]\nnumber = 6";
    let shop = SHOP.replace("[[tool]]\nnumber = 6", second);
    let with = |shop: &str, data: &str| {
        let loader = MemoryLoader::default().with("shop.toml", shop);
        read_with(&job("tools = \"shop.toml\"\nmaterial = \"C45\"", "5", data), &loader)
    };
    let error = with(&shop, "").map(|_| ()).unwrap_err();
    let told = "T5 has several presets for C45, and none is taken: one without a name, `slotting`";
    assert!(error.to_string().contains(told), "{error}");
    assert_eq!(
        (error.code().to_string().as_str(), error.0.key.as_deref(), place(&error).0.as_str()),
        ("KC0102", Some("setup[0].operation[0]"), "job.toml")
    );
    // An operation with a speed of its own does not ask.
    assert!(with(&shop, DATA).unwrap().notes.is_empty());
    // Two of the same numbers are one.
    let same = shop
        .replace("cutting_speed = 90\nfeed_per_tooth = 0.04", "cutting_speed = 150\nfeed_per_tooth = 0.06");
    assert!(with(&same, "").unwrap().notes[0].message.starts_with("cutting_speed 150 m/min"));
}

/// A job about a program that others wrote, with tool files.
fn given(files: &str) -> String {
    format!(
        "format = 1\ntools = {files}\nstock = {{ box = {{ min = [-30, -30, -10], max = [30, 30, 0] }} }}\n\
         post = {{ control = \"fanuc\" }}\n[[setup]]\noffset = \"G54\"\nprogram = {{ file = \"O1.nc\" }}\n"
    )
}

#[test]
fn a_number_in_a_comment_is_no_call_of_a_tool_that_is_wrong() {
    let tools = |program: &str| -> Result<Vec<u32>, Error> {
        let read = read_with(&given("\"shop.toml\""), &loader().with("O1.nc", program))?;
        Ok(read.job.tools.iter().map(|t| t.number.0).collect())
    };
    // The diameter of T7 is wrong.
    for comment in ["(T7 ODD MILL)", "(NOT T7", "; T7", "(SEE T#7)"] {
        let found = tools(&format!("%\nO1\n{comment}\nN10T5M6\nM30\n%\n")).unwrap();
        assert!(found.contains(&5) && !found.contains(&7), "{comment}: {found:?}");
    }
    assert_eq!(tools("%\nO1\n(T6 MILL)\nM6T5\nM30\n%\n").unwrap(), [5, 6]);
    let error = tools("%\nO1\n(ODD) M6T7\nM30\n%\n").unwrap_err();
    assert_eq!(place(&error).2, "diameter = -8");
}

#[test]
fn a_program_gets_none_of_two_tools_that_both_fit() {
    let read = |second: &str, program: &str| {
        let loader = loader().with("O1.nc", program).with("b.toml", second);
        let read = read_with(&given("[\"shop.toml\", \"b.toml\"]"), &loader).unwrap();
        let numbers: Vec<u32> = read.job.tools.iter().map(|t| t.number.0).collect();
        let notes: Vec<String> = read.notes.iter().map(|n| format!("{} {}", n.code, n.message)).collect();
        (numbers, notes)
    };
    let second =
        "[[tool]]\nnumber = 5\nname = \"other\"\ntype = \"end-mill\"\ndiameter = 9\nflute_length = 22\n";
    let program = "%\nO1\nT5 M6\nT6 M6\nM30\n%\n";
    let (numbers, notes) = read(second, program);
    assert_eq!(numbers, [6]);
    assert_eq!(
        notes,
        [
            "KC0709 a program calls T5, and several tools have this number: T5 `End Mill  10` of `shop.toml`, T5 `other` of `b.toml`"
        ]
    );
    // In a comment it is no call. One that is wrong does not fit.
    assert_eq!(read(second, &program.replace("T5 M6", "(T5)")), (vec![6], vec![]));
    assert_eq!(read(&second.replace("= 9", "= -9"), program), (vec![5, 6], vec![]));
}
