//! `simulate`, `check`, `post`: programs that others wrote, from the shell.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::shell::{self, text};

const PROGRAM: &str = "%\nO7 (PLATE)\nG17 G21 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X15. Y20. S3000 M3\nG43 H1 Z20. M8\nZ2.\n\
    G1 Z-3. F200.\nX45. F400.\nG0 Z20. M9\nM5\nM30\n%\n";
const TOOLS: &str =
    "[[tool]]\nnumber = 1\ntype = \"end-mill\"\ndiameter = 8\nflute_length = 20\ngauge_length = 100\n";
const STOCK: &str = "0,0,-12,60,40,0";

fn kinecut(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_kinecut")).args(args).current_dir(folder).output().unwrap()
}

/// A folder of this test's own with a program and tools.
fn folder(name: &str) -> PathBuf {
    let folder = shell::folder(name);
    std::fs::write(folder.join("P.nc"), PROGRAM).unwrap();
    std::fs::write(folder.join("tools.toml"), TOOLS).unwrap();
    let job = format!(
        "format = 1\npost = {{ control = \"fanuc\" }}\nsimulate = {{ step = 1.0 }}\n\
         stock = {{ box = {{ min = [0, 0, -12], max = [60, 40, 0] }} }}\n{TOOLS}[[setup]]\noffset = \"G54\"\n\
         program = {{ file = \"P.nc\" }}\n"
    );
    std::fs::write(folder.join("job.toml"), job).unwrap();
    folder
}

#[test]
fn a_program_is_simulated_with_a_job_and_its_verdict_holds_until_a_byte_changes() {
    let folder = folder("job");
    for args in
        [vec!["simulate", "job.toml"], vec!["run", "job.toml"], vec!["simulate", "P.nc", "--job", "job.toml"]]
    {
        let run = kinecut(&folder, &args);
        assert_eq!(run.status.code(), Some(0), "{args:?}: {}", text(&run.stderr));
        assert!(text(&run.stdout).starts_with("SAFE"), "{}", text(&run.stdout));
        assert!(!folder.join("out/P.nc").exists() && folder.join("out/report.html").exists());
        let verify = kinecut(&folder, &["verify", "out"]);
        assert_eq!(verify.status.code(), Some(0), "{args:?}: {}", text(&verify.stdout));
        std::fs::write(folder.join("P.nc"), PROGRAM.replace("F400.", "F401.")).unwrap();
        let verify = kinecut(&folder, &["verify", "out"]);
        assert_eq!(verify.status.code(), Some(1), "{args:?}: {}", text(&verify.stdout));
        assert!(text(&verify.stderr).contains("P.nc"), "{}", text(&verify.stderr));
        std::fs::write(folder.join("P.nc"), PROGRAM).unwrap();
    }
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_program_is_simulated_without_a_job_and_findings_exit_1() {
    let folder = folder("alone");
    let base =
        ["simulate", "P.nc", "--control", "fanuc", "--stock", STOCK, "--tools", "tools.toml", "--step", "1"];
    let run = kinecut(&folder, &base);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    assert_eq!(kinecut(&folder, &["verify", "out"]).status.code(), Some(0));
    std::fs::write(folder.join("P.nc"), PROGRAM.replace("G0 Z20. M9", "G0 X50. Z20. M9\nZ-1. X20.")).unwrap();
    let run = kinecut(&folder, &base);
    assert_eq!(run.status.code(), Some(1));
    assert!(
        text(&run.stderr).contains("KC0501") && text(&run.stderr).contains("P.nc:10:1"),
        "{}",
        text(&run.stderr)
    );
    assert_eq!(kinecut(&folder, &["verify", "out"]).status.code(), Some(1));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_part_that_was_cut_is_the_stock_of_the_next_program() {
    let folder = folder("next");
    let cut = |stock: &str, out: &str| {
        let args = [
            "simulate",
            "P.nc",
            "--control",
            "fanuc",
            "--tools",
            "tools.toml",
            "--step",
            "1",
            "--mesh",
            "stl",
        ];
        kinecut(&folder, &[&args[..], &["--stock", stock, "--out", out]].concat())
    };
    let removed = |out: &str| {
        let plan = std::fs::read_to_string(folder.join(out).join("plan.json")).unwrap();
        serde_json::from_str::<serde_json::Value>(&plan).unwrap()["removed_volume"].as_f64().unwrap()
    };
    assert_eq!(cut(STOCK, "out").status.code(), Some(0));
    let again = cut("out/part.stl", "again");
    assert_eq!(again.status.code(), Some(0), "{}", text(&again.stderr));
    // The program has nothing left to cut but what the mesh lies outside of the tool's round.
    assert!(removed("again") < 0.01 * removed("out"), "{} {}", removed("again"), removed("out"));
    assert_eq!(kinecut(&folder, &["verify", "again"]).status.code(), Some(0));
    std::fs::write(folder.join("out/part.stl"), "solid other").unwrap();
    assert_eq!(kinecut(&folder, &["verify", "again"]).status.code(), Some(1));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_program_by_itself_is_compared_with_a_design() {
    let folder = folder("design");
    let base =
        ["simulate", "P.nc", "--control", "fanuc", "--tools", "tools.toml", "--stock", STOCK, "--step", "1"];
    let cut = |more: &[&str]| kinecut(&folder, &[&base[..], more].concat());
    assert_eq!(cut(&["--mesh", "3mf,stl", "--out", "wanted"]).status.code(), Some(0));
    for design in ["wanted/part.3mf", "wanted/part.stl"] {
        let run = cut(&["--design", design]);
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        let said = text(&run.stdout);
        assert!(said.contains("of the design mesh at") && !said.contains("no design"), "{said}");
    }
    // 0.2 mm too deep along the groove: found at the block that cuts it, within a tolerance of 0.3 mm not.
    std::fs::write(folder.join("P.nc"), PROGRAM.replace("Z-3.", "Z-3.2")).unwrap();
    let run = cut(&["--design", "wanted/part.3mf"]);
    let said = text(&run.stderr);
    assert_eq!(run.status.code(), Some(1), "{said}");
    assert!(said.contains("KC0505") && said.contains("the part is cut into the design"), "{said}");
    assert!(said.contains("P.nc:8:1") || said.contains("P.nc:9:1"), "{said}");
    // Deeper still at the end of the groove: the worst block, and the first one.
    let deeper = PROGRAM.replace("Z-3.", "Z-3.2").replace("X45. F400.", "X45. F400.\nZ-3.8");
    std::fs::write(folder.join("P.nc"), deeper).unwrap();
    let both = text(&cut(&["--design", "wanted/part.3mf"]).stderr);
    let at = |what: &str| both.split("error[").find(|e| e.contains(what)).unwrap_or_else(|| panic!("{both}"));
    let first = at("cut into the design for the first time");
    assert!(first.contains("P.nc:8:1") || first.contains("P.nc:9:1"), "{both}");
    assert!(at("cut into the design:").contains("P.nc:10:1"), "{both}");
    std::fs::write(folder.join("P.nc"), PROGRAM.replace("Z-3.", "Z-3.2")).unwrap();
    let run = cut(&["--design", "wanted/part.3mf", "--design-tolerance", "0.3"]);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    assert_eq!(kinecut(&folder, &["verify", "out"]).status.code(), Some(0));
    std::fs::write(folder.join("wanted/part.3mf"), "PK").unwrap();
    assert_eq!(kinecut(&folder, &["verify", "out"]).status.code(), Some(1));
    let run = cut(&["--design", "wanted/part.3mf"]);
    assert_eq!(run.status.code(), Some(2));
    assert!(text(&run.stderr).contains("is not a package"), "{}", text(&run.stderr));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn wrong_input_exits_2_and_says_what_to_do() {
    let folder = folder("wrong");
    std::fs::write(folder.join("bad.nc"), "G0 X1.\nG1 Q7.\n").unwrap();
    for (args, says) in [
        (&["check", "missing.nc", "--control", "fanuc"][..], "missing.nc"),
        (&["check", "P.nc"], "--control"),
        (&["check", "P.nc", "--control", "fanuk"], "did you mean `fanuc`"),
        (&["check", "bad.nc", "--control", "fanuc"], "bad.nc:2:4"),
        (&["simulate", "P.nc", "--control", "fanuc"], "--stock"),
        (&["simulate", "bad.nc", "--control", "fanuc"], "bad.nc:2:4"),
        (&["simulate", "P.nc", "--control", "fanuc", "--stock", STOCK], "not among the tools"),
        (&["simulate", "P.nc", "--control", "fanuc", "--stock", "0,0,0,1,nan,1"], "six numbers"),
        (&["simulate", "P.nc", "--control", "fanuc", "--stock", "blank.step"], "STL or 3MF file"),
        (&["simulate", "P.nc", "--control", "fanuc", "--stock", "missing.stl"], "missing.stl"),
        (
            &["simulate", "P.nc", "--control", "fanuc", "--stock", "0,0,0,1,1,0", "--tools", "tools.toml"],
            "exceed",
        ),
        (
            &[
                "simulate",
                "P.nc",
                "--control",
                "fanuc",
                "--stock",
                STOCK,
                "--tools",
                "tools.toml",
                "--step",
                "0",
            ],
            "step",
        ),
        (&["simulate", "P.nc", "--job", "job.toml", "--uncertainty", "0.1,0.1"], "such as 0.05,0.02,0.5"),
        (&["simulate", "P.nc", "--job", "job.toml", "--uncertainty", "0.1,-0.1,0"], "'--uncertainty"),
        (&["simulate", "P.nc", "--job", "job.toml", "--uncertainty", "99,0,0"], "offset is too large"),
        (&["simulate", "P.nc", "--job", "job.toml", "--setup", "2"], "no setup 2"),
        (&["simulate", "P.nc", "--job", "nothing.toml"], "nothing.toml"),
        (&["post", "P.nc", "--from", "fanuc", "--to", "nothing"], "not known"),
        (&["post", "P.nc", "--from", "fanuc", "--to", "grbl", "--orientation", "axes"], "--machine"),
        (&["post", "P.nc", "--from", "fanuc", "--to", "fanuc", "-o", "P.nc"], "would be replaced"),
    ] {
        let run = kinecut(&folder, args);
        let said = text(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{args:?}: {said}");
        assert!(said.contains(says), "{args:?}: {said}");
    }
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_program_is_checked_and_translated() {
    let folder = folder("post");
    let check = kinecut(&folder, &["check", "P.nc", "--control", "fanuc"]);
    assert_eq!(check.status.code(), Some(0), "{}", text(&check.stderr));
    assert!(text(&check.stdout).contains("X 15.000 to 45.000"), "{}", text(&check.stdout));
    let json = kinecut(&folder, &["check", "P.nc", "--control", "fanuc", "--json"]);
    let sheet: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!((sheet["feed_moves"].as_u64(), sheet["tools"][0].as_str()), (Some(2), Some("T1")));
    let post = kinecut(&folder, &["post", "P.nc", "--from", "fanuc", "--to", "heidenhain", "-o", "P.h"]);
    assert_eq!(post.status.code(), Some(0), "{}", text(&post.stderr));
    assert!(text(&post.stdout).contains("lies under 0.01 \u{b5}m from"), "{}", text(&post.stdout));
    let written = std::fs::read_to_string(folder.join("P.h")).unwrap();
    assert!(written.contains("L X+45 F400") && written.contains("; PLATE"), "{written}");
    let again = kinecut(&folder, &["check", "P.h"]);
    assert_eq!(again.status.code(), Some(0), "{}", text(&again.stderr));
    let json = kinecut(&folder, &["post", "P.nc", "--from", "fanuc", "--to", "linuxcnc", "--json"]);
    let done: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert!(
        done["text"].as_str().unwrap().contains("G1 Z-3 F200")
            && done["read_back"]["moves"].as_u64() > Some(3)
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_program_alone_is_simulated_with_a_guess_that_is_saved_as_a_job() {
    let folder = folder("guess");
    let own = "(T1 D=8. CR=0. - FLAT END MILL)\n";
    std::fs::write(folder.join("alone.nc"), PROGRAM.replacen("%\n", &format!("%\n{own}"), 1)).unwrap();
    let args = ["simulate", "alone.nc", "--control", "fanuc", "--step", "1", "--write-job", "guess.toml"];
    let run = kinecut(&folder, &args);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    let said = text(&run.stdout);
    // The feed moves go from (15, 20) to (45, 20), down to -3, with a mill of 8 mm.
    let flat = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        flat.contains("NOT PROVEN, 2 doubts") && flat.contains("is a guess, 11,16,-3 to 49,24,0"),
        "{said}"
    );
    assert!(flat.contains("T1 end-mill 8 mm (line 2)"), "{said}");
    let job = kinecut(&folder, &["simulate", "guess.toml", "--step", "1"]);
    assert_eq!(job.status.code(), Some(0), "{}{}", text(&job.stdout), text(&job.stderr));
    assert!(!text(&job.stdout).contains("guess,"), "{}", text(&job.stdout));
    let check = kinecut(&folder, &["check", "alone.nc", "--control", "fanuc", "--write-job", "again.toml"]);
    assert_eq!(check.status.code(), Some(0), "{}", text(&check.stderr));
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    assert_eq!(read("guess.toml"), read("again.toml"));
    // The job names the program as it is seen from there, and lies beside it or above it.
    std::fs::create_dir_all(folder.join("jobs")).unwrap();
    let below =
        kinecut(&folder, &["check", "alone.nc", "--control", "fanuc", "--write-job", "jobs/other.toml"]);
    assert_eq!(below.status.code(), Some(2));
    assert!(
        text(&below.stderr).contains("neither beside its program nor above it"),
        "{}",
        text(&below.stderr)
    );
    std::fs::rename(folder.join("alone.nc"), folder.join("jobs/alone.nc")).unwrap();
    let args = ["check", "jobs/alone.nc", "--control", "fanuc", "--write-job", "above.toml"];
    assert_eq!(kinecut(&folder, &args).status.code(), Some(0));
    assert_eq!(kinecut(&folder, &["simulate", "above.toml", "--step", "1"]).status.code(), Some(0));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn subprograms_are_looked_for_in_folders_that_are_named() {
    let folder = folder("subprograms");
    std::fs::create_dir_all(folder.join("subs")).unwrap();
    std::fs::write(folder.join("main.ngc"), "G21 G54 G0 X0 Y0 Z5\no<step> call [7]\nM2\n").unwrap();
    std::fs::write(folder.join("subs/step.ngc"), "o<step> sub\nG1 X#1 F100\no<step> endsub\n").unwrap();
    let alone = kinecut(&folder, &["check", "main.ngc"]);
    assert_eq!(alone.status.code(), Some(2));
    assert!(text(&alone.stderr).contains("the subprogram `step` that is called"), "{}", text(&alone.stderr));
    let found = kinecut(&folder, &["check", "main.ngc", "--subprograms", "subs"]);
    assert_eq!(found.status.code(), Some(0), "{}", text(&found.stderr));
    assert!(text(&found.stdout).contains("X 0.000 to 7.000"), "{}", text(&found.stdout));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_length_that_the_program_sets_is_compared_with_the_tool() {
    let folder = folder("lengths");
    let with = |by: &str| PROGRAM.replacen("T1 M6\n", &format!("T1 M6\nG90 G10 L10 P1 R{by}\n"), 1);
    for (by, code) in [("100.", 0), ("98.5", 1)] {
        std::fs::write(folder.join("P.nc"), with(by)).unwrap();
        let run = kinecut(&folder, &["simulate", "job.toml"]);
        assert_eq!(run.status.code(), Some(code), "{by}: {}{}", text(&run.stdout), text(&run.stderr));
    }
    let said = text(&kinecut(&folder, &["simulate", "job.toml"]).stderr);
    assert!(said.contains("the length register of T1 does not hold the length of the tool"), "{said}");
    let ngc = "G21 G17 G40 G49 G80 G90 G94 G54\nT1 M6\nG43.1 Z{}\nG0 X15 Y20 S3000 M3\nZ20\nG1 Z-3 F200\nX45 F400\nG0 Z20\nM2\n";
    for (by, code, says) in
        [("100", 0, ""), ("99", 1, "is called with a length that the program makes (G43.1, G43.2)")]
    {
        std::fs::write(folder.join("P.ngc"), ngc.replace("{}", by)).unwrap();
        let args = ["simulate", "P.ngc", "--stock", STOCK, "--tools", "tools.toml", "--step", "1"];
        let run = kinecut(&folder, &args);
        assert_eq!(run.status.code(), Some(code), "{by}: {}{}", text(&run.stdout), text(&run.stderr));
        assert!(text(&run.stderr).contains(says), "{}", text(&run.stderr));
    }
    // The tool is in the spindle already, and the length of another is called.
    let own = ngc.replace("T1 M6\n", "").replace("G43.1 Z{}", "G43 H2");
    std::fs::write(folder.join("P.ngc"), own).unwrap();
    let args = ["simulate", "P.ngc", "--stock", STOCK, "--tools", "tools.toml", "--tool", "1", "--step", "1"];
    let run = kinecut(&folder, &args);
    assert_eq!(run.status.code(), Some(1), "{}{}", text(&run.stdout), text(&run.stderr));
    assert!(
        text(&run.stderr).contains("T1 is called with the length of register 2"),
        "{}",
        text(&run.stderr)
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_tool_table_of_the_machine_tells_lengths_and_diameters() {
    let folder = folder("table");
    let ngc = "G21 G17 G40 G49 G80 G90 G94 G54 G64 P0.01\nT1 M6\nG43 H{}\nG0 X15 Y20 S3000 M3\nZ20\nG1 Z-3 F200\nX45 F400\nG0 Z20\nM2\n";
    // Remarks are in any language and of any age.
    let table = b"T1 P1 Z75.2 D6 ;6 mm end mill\nT2 P2 Z101.5 D5 ;5mm drill\nT3 Z90 ;Fr\xe4ser\nT4 X1 D5\n";
    std::fs::write(folder.join("tool.tbl"), table).unwrap();
    for (register, outcome, says) in [
        (1, "NOT PROVEN", "T1 end-mill 6 mm, 75.2 mm long (line 1)"),
        (2, "NOT SAFE", "101.5 mm, bound 75.2 mm"),
    ] {
        std::fs::write(folder.join("P.ngc"), ngc.replace("{}", &register.to_string())).unwrap();
        let args = ["simulate", "P.ngc", "--stock", STOCK, "--tools", "tool.tbl", "--step", "1"];
        let run = kinecut(&folder, &args);
        let shown = text(&run.stdout);
        assert!(shown.starts_with(outcome) && run.status.code() == Some(1), "{register}: {shown}");
        assert!(text(&run.stderr).contains(says), "{}", text(&run.stderr));
        let left_out = "left out: T3 (no diameter); left out: T4 (offset across the axis)";
        assert!(text(&run.stderr).contains(left_out), "{}", text(&run.stderr));
    }
    // Inches make another tool of it; a line of another form is refused with its place.
    let args =
        ["simulate", "P.ngc", "--stock", STOCK, "--tools", "tool.tbl", "--machine-in-inches", "--step", "1"];
    assert!(text(&kinecut(&folder, &args).stderr).contains("T1 end-mill 152.4 mm, 1910.08 mm long"));
    std::fs::write(folder.join("old.tbl"), "T1 P1\n 1 1 +0.511 0.125 1/8 end mill\n").unwrap();
    let run = kinecut(&folder, &["check", "P.ngc", "--tools", "old.tbl"]);
    assert_eq!(run.status.code(), Some(2));
    assert!(text(&run.stderr).contains("old.tbl:2:2"), "{}", text(&run.stderr));
    let run = kinecut(&folder, &["check", "P.ngc", "--tools", "tools.toml", "--machine-in-inches"]);
    assert!(text(&run.stderr).contains("only a tool table (.tbl) or a parameter file may be in inches"));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_machine_keeps_offsets_for_a_program() {
    let folder = folder("kept");
    let text_of = "G21 G17 G40 G49 G80 G90 G94 G64 P0.01\nT1 M6\nG43\nG54 G0 X0 Y0 Z5 S3000 M3\nG1 Z-1 F200\nG0 Z5\nG55\nX0 Y0 Z5\nG1 Z-1\nG0 Z5\nG28\nM2\n";
    std::fs::write(folder.join("P.ngc"), text_of).unwrap();
    std::fs::write(folder.join("linuxcnc.var"), "5161 200\n5162 100\n5163 90\n5220 1\n5221 50\n5241 70\n")
        .unwrap();
    std::fs::write(folder.join("tool.tbl"), "T1 Z75.2 D6 ;end mill\n").unwrap();
    let given = ["--tools", "tool.tbl", "--parameters", "linuxcnc.var"];
    let check = |more: &[&str]| kinecut(&folder, &[&["check", "P.ngc"], more].concat());
    // Without them G55 is taken to lie where G54 does; with them it is 20 mm away.
    assert!(text(&check(&[]).stdout).contains("G55 lies where G54 does"), "{}", text(&check(&[]).stdout));
    let known = text(&check(&given).stdout);
    assert!(known.contains("G55: placed from G54 as the offsets of the control have it"), "{known}");
    assert!(!known.contains("taken to be machine zero"), "{known}");
    let post =
        kinecut(&folder, &[&["post", "P.ngc", "--to", "linuxcnc", "-o", "out.ngc"], &given[..]].concat());
    // Its tools are a guess.
    assert_eq!(post.status.code(), Some(1), "{}", text(&post.stderr));
    let out = std::fs::read_to_string(folder.join("out.ngc")).unwrap();
    assert!(out.contains("G53 G0 X200 Y100 Z90"), "{out}");
    // The files of a machine that the tool is not in, or that are no such files.
    std::fs::write(folder.join("other.tbl"), "T2 Z75.2 D6\n").unwrap();
    let run = check(&["--tools", "other.tbl"]);
    assert_eq!(run.status.code(), Some(2));
    assert!(
        text(&run.stderr).contains("T1 is not in the tool table of the machine"),
        "{}",
        text(&run.stderr)
    );
    std::fs::write(folder.join("wrong.var"), "5220 1\nX 5\n").unwrap();
    let run = check(&["--parameters", "wrong.var"]);
    assert!(text(&run.stderr).contains("wrong.var:2:1"), "{}", text(&run.stderr));
    let run = kinecut(&folder, &["check", "P.ngc", "--control", "fanuc", "--parameters", "linuxcnc.var"]);
    assert_eq!(run.status.code(), Some(2));
    assert!(text(&run.stderr).contains("`linuxcnc.var` is a file of LinuxCNC"), "{}", text(&run.stderr));
    // In a job they are files beside it.
    let job = format!(
        "format = 1\npost = {{ control = \"linuxcnc\" }}\nstock = {{ box = {{ min = [-10, -10, -5], max = [50, 10, 0] }} }}\n{}\n[[setup]]\noffset = \"G54\"\noffsets = {{ G55 = [20, 0, 0] }}\nprogram = {{ file = \"P.ngc\", tool_table = \"tool.tbl\", parameters = \"linuxcnc.var\" }}\n",
        "[[tool]]\nnumber = 1\nname = \"mill\"\ntype = \"end-mill\"\ndiameter = 6\nflute_length = 20\nstickout = 40\ngauge_length = 80\n"
    );
    std::fs::write(folder.join("job.toml"), job).unwrap();
    let run = kinecut(&folder, &["simulate", "job.toml", "--step", "1", "--out", "out"]);
    assert!(text(&run.stdout).contains("SAFE"), "{}{}", text(&run.stdout), text(&run.stderr));
    let said = text(&run.stderr);
    assert!(said.contains("the length register of T1 does not hold the length of the tool"), "{said}");
    let verdict = std::fs::read_to_string(folder.join("out/verdict.json")).unwrap();
    assert!(verdict.contains("linuxcnc.var") && verdict.contains("tool.tbl"), "the verdict names the files");
    // Where the job and the control have an offset in two places, neither is proven.
    let there = std::fs::read_to_string(folder.join("job.toml")).unwrap();
    std::fs::write(folder.join("job.toml"), there.replace("G55 = [20, 0, 0]", "G55 = [20, 0, 1]")).unwrap();
    let run = kinecut(&folder, &["simulate", "job.toml", "--step", "1", "--out", "out"]);
    let said = text(&run.stderr);
    assert!(said.contains("G55 lies 1 mm from where the control has it, as seen from G54"), "{said}");
    std::fs::remove_dir_all(folder).unwrap();
}
