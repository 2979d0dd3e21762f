//! Wrong jobs about programs of others: each is refused with its place and a help.

use kinecut::base::{Code, MemoryLoader, Severity, Silent};
use kinecut::job::run;

use super::{FANUC, PLAIN, job, outcome};

fn error(setup: &str) -> (Code, String) {
    let error = outcome("fanuc", setup, FANUC).unwrap_err();
    assert!(error.0.place.is_some(), "{error}");
    (error.code(), error.to_string())
}

#[test]
fn a_setup_has_operations_or_a_program() {
    let operation = "[[setup.operation]]\ntype = \"bore\"\ntool = 1\nat = [30, 20]\ndiameter = 30\ndepth = 5\n\
        strategy = \"involute\"\nentry = \"plunge\"\nspeed = 4000\nrough = { stepover = 2, feed = 500 }\n";
    let (code, text) = error(&format!("{PLAIN}\n{operation}"));
    assert!(code == Code::JOB_SHAPE && text.contains("not both"), "{text}");
    let (code, text) = error("");
    assert!(code == Code::JOB_SHAPE && text.contains("needs operations or a program"), "{text}");
}

#[test]
fn wrong_keys_and_values_are_named() {
    for (table, code, says) in [
        ("{ file = \"missing.nc\" }", Code::FILE_NOT_READ, "missing.nc"),
        ("{ file = \"P.nc\", control = \"fanac\" }", Code::POST_CONTROL, "did you mean `fanuc`"),
        ("{ file = \"P.nc\", tool = 7 }", Code::JOB_REFERENCE, "T7 is not defined"),
        ("{ file = \"P.nc\", registers = { Q5 = 1.0 } }", Code::JOB_VALUE, "`Q5` is no register"),
        ("{ file = \"P.nc\", registers = { H = 1.0 } }", Code::JOB_VALUE, "`H` is no register"),
        ("{ file = \"P.nc\", registers = { D-1 = 1.0 } }", Code::JOB_VALUE, "is no register"),
        ("{ file = \"P.nc\", registers = { H1 = nan } }", Code::JOB_VALUE, "not a number"),
        ("{ file = \"P.nc\", registers = { H1 = 1e30 } }", Code::JOB_VALUE, "too large"),
        ("{ file = \"P.nc\", controll = \"fanuc\" }", Code::JOB_SHAPE, "did you mean `control`"),
        ("{ control = \"fanuc\" }", Code::JOB_SHAPE, "file"),
    ] {
        let (found, text) = error(&format!("program = {table}"));
        assert!(found == code && text.contains(says), "{table}: {text}");
    }
    let (code, text) = error(&format!("offsets = {{ G12 = [0, 0, 0] }}\n{PLAIN}"));
    assert!(code == Code::JOB_VALUE && text.contains("`G12` is no work offset"), "{text}");
}

#[test]
fn a_program_without_a_tool_is_refused_and_one_with_an_unknown_start_is_not_proven_at_its_block() {
    let error = outcome("grbl", PLAIN, super::GRBL).unwrap_err();
    assert!(error.to_string().contains("before a tool is called"), "{error}");
    assert!(error.0.place.as_ref().is_some_and(|p| p.line > 1), "{error}");
    let unknown = super::GRBL.replace("Z20\nM8\nZ2\n", "");
    let done = outcome("grbl", "program = { file = \"P.nc\", tool = 1 }", &unknown).unwrap();
    let found: Vec<_> = done.verdict.found.iter().filter(|f| f.code == Code::UNKNOWN_START).collect();
    let severities: Vec<Severity> = found.iter().map(|f| f.severity).collect();
    assert!(severities.contains(&Severity::Doubt) && severities.contains(&Severity::Warning), "{found:?}");
    assert!(found.iter().all(|f| f.place.as_ref().unwrap().text == "G1 Z-3 F200"), "{found:?}");
}

#[test]
fn a_program_that_is_no_utf8_is_read_and_that_is_said() {
    let mut bytes = FANUC.as_bytes().to_vec();
    let at = FANUC.find("(SLOT)").unwrap() + 1;
    bytes[at] = 0xd6;
    let loader = MemoryLoader::default().with("P.nc", bytes);
    let outcome = run("plate.toml", &job("fanuc", PLAIN), &loader, &Silent).unwrap();
    assert!(outcome.verdict.unchecked().any(|n| n.what.contains("Latin-1")));
}
