//! `time`: the time of programs and jobs, and samples of their motion, from the shell.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

use crate::shell::{self, root, text};

const PROGRAM: &str = "%\nO7 (PLATE)\nG17 G21 G40 G49 G80 G90 G94\nT1 M6\nG54 G0 X15. Y20. S3000 M3\nG43 H1 Z20. M8\nZ2.\n\
    G1 Z-3. F200.\nX45. F4000.\nY20.5\nX15.\nG4 P500\nG0 Z20. M9\nM5\nM30\n%\n";
const MACHINE: &str =
    "name = \"mill\"\ncode = \"2103\"\ndynamics = { rapid = 30000, acceleration = 5, jerk = 50 }\n";

fn kinecut(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_kinecut")).args(args).current_dir(folder).output().unwrap()
}

/// A folder of this test's own with a program and machines.
fn folder(name: &str) -> PathBuf {
    let folder = shell::folder(name);
    std::fs::write(folder.join("P.nc"), PROGRAM).unwrap();
    std::fs::write(folder.join("mill.toml"), MACHINE).unwrap();
    std::fs::write(folder.join("slow.toml"), MACHINE.replace(", acceleration = 5", "")).unwrap();
    folder
}

const MILLED: [&str; 6] = ["time", "P.nc", "--control", "fanuc", "--machine", "mill.toml"];

/// The rows of a table of a page.
fn rows_of(page: &str, caption: &str) -> Vec<Vec<String>> {
    let table = page.split(caption).nth(1).and_then(|rest| rest.split("</table>").next()).unwrap();
    let rows = table.split("<tbody>").nth(1).unwrap().split("<tr").skip(1);
    // The first cell of a row is a heading.
    let cell = |cell: &str| cell.split_once('>').unwrap().1.split("</t").next().unwrap().to_owned();
    rows.map(|row| row.split("<t").filter(|c| c.starts_with(['d', 'h'])).map(cell).collect()).collect()
}

fn json(output: &Output) -> Value {
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn the_time_of_a_program_has_its_bracket_shares_and_slowest_blocks() {
    let folder = folder("time");
    let done = kinecut(&folder, &MILLED);
    let shown = text(&done.stdout);
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    for said in [
        "P.nc for fanuc, 16 lines",
        "if jerk had no limit",
        "at feed (",
        "dwells",
        "Blocks that lose most time",
    ] {
        assert!(shown.contains(said), "{said}: {shown}");
    }
    let sheet = json(&kinecut(&folder, &[&MILLED[..], &["--json", "--slowest", "2"]].concat()));
    let number = |key: &str| sheet[key].as_f64().unwrap();
    assert!(number("time_without_jerk_limit") < number("time"));
    assert!(number("time_at_programmed_feeds") < number("time_without_jerk_limit"));
    let shares = sheet["shares"].as_object().unwrap();
    assert!((shares.values().map(|v| v.as_f64().unwrap()).sum::<f64>() - number("time")).abs() < 1e-9);
    assert_eq!(shares["dwells"].as_f64(), Some(0.5));
    let slowest = sheet["slowest"].as_array().unwrap();
    assert_eq!(slowest.len(), 2);
    let block = |i: usize| (slowest[i]["line"].as_u64().unwrap(), slowest[i]["block"].as_str().unwrap());
    assert!(matches!([block(0), block(1)], [(9 | 11, _), (9 | 11, _)]), "{slowest:?}");
    for slow in slowest {
        let [programmed, mean] = ["programmed_feed", "mean_feed"].map(|key| slow[key].as_f64().unwrap());
        assert!((programmed - 4000.0).abs() < 1e-6 && mean < 3900.0, "{slow}");
    }
    assert!(shown.contains("Corners that are smoothed most"), "{shown}");
    let smoothed = sheet["smoothed"].as_array().unwrap();
    assert!((1..=2).contains(&smoothed.len()), "{smoothed:?}");
    for joint in smoothed {
        let [corner, off] = ["corner", "off"].map(|key| joint[key].as_f64().unwrap());
        assert!((corner - 90.0).abs() < 1e-9 && off > 0.0 && off <= 0.01 + 1e-12, "{joint}");
        let line = joint["line"].as_u64().unwrap();
        assert!((9..=11).contains(&line), "{joint}");
        let text = PROGRAM.lines().nth(line as usize - 1).unwrap();
        assert_eq!(joint["block"].as_str(), Some(text));
    }
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn samples_are_written_as_csv_and_json_with_units_in_their_columns() {
    let folder = folder("samples");
    let with = |more: &[&str]| kinecut(&folder, &[&MILLED[..], &["--json"], more].concat());
    let sheet = json(&with(&["--samples", "deep/m.csv", "--cycle", "0.004"]));
    let csv = std::fs::read_to_string(folder.join("deep/m.csv")).unwrap();
    let mut lines = csv.lines();
    assert_eq!(
        lines.next().unwrap(),
        "time_s,line,x_mm,y_mm,z_mm,feed_mm_per_min,vx_mm_per_s,vy_mm_per_s,vz_mm_per_s,ax_mm_per_s2,ay_mm_per_s2,\
         az_mm_per_s2,jx_mm_per_s3,jy_mm_per_s3,jz_mm_per_s3"
    );
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert_eq!(sheet["samples"]["count"].as_u64(), Some(rows.len() as u64));
    assert_eq!(sheet["samples"]["jumps"].as_u64(), Some(0));
    let last = &rows[rows.len() - 1];
    assert!((last[0] - sheet["time"].as_f64().unwrap()).abs() < 1e-8);
    assert!((rows[1][0] - 0.004).abs() < 1e-12 && rows.iter().all(|row| row.len() == 15));
    // Half a second of rest in the line of the dwell.
    let resting = rows.iter().filter(|row| row[1] == 12.0).inspect(|row| assert_eq!(row[5], 0.0)).count();
    assert!((resting as i32 - 125).abs() <= 1, "{resting}");
    let whole = json(&with(&["--samples", "m.json", "--cycle", "0.004"]));
    assert_eq!(whole["samples"]["count"], sheet["samples"]["count"]);
    let table: Value = serde_json::from_slice(&std::fs::read(folder.join("m.json")).unwrap()).unwrap();
    assert_eq!(table["columns"].as_array().unwrap().len(), 15);
    let found = table["rows"].as_array().unwrap();
    assert!(found.len() == rows.len() && found[7][2].as_f64() == Some(rows[7][2]), "{}", found.len());
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_job_is_timed_without_being_cut() {
    let folder = folder("timed");
    std::fs::copy(root().join("examples/01_bore/job.toml"), folder.join("job.toml")).unwrap();
    let sheet = json(&kinecut(&folder, &["time", "job.toml", "--json"]));
    assert_eq!(sheet["programs"][0]["file"].as_str(), Some("BORE200.mpf"), "{sheet}");
    assert!(sheet["time"].as_f64().unwrap() > sheet["time_at_programmed_feeds"].as_f64().unwrap());
    // Nothing else is written.
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 4);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn wrong_input_is_refused_before_anything_is_written() {
    let folder = folder("untimed");
    let machine = |name: &'static str| ["time", "P.nc", "--control", "fanuc", "--machine", name].to_vec();
    let milled = |more: &[&'static str]| [&MILLED[..], more].concat();
    for (args, says) in [
        (machine("slow.toml"), "no acceleration for axes X, Y, Z"),
        (vec!["time", "P.nc", "--control", "fanuc"], "--machine"),
        (milled(&["--samples", "m.txt"]), ".csv or .json"),
        (milled(&["--samples", "m.csv", "--cycle", "0"]), "positive"),
        (milled(&["--samples", "m.csv", "--cycle", "1e-9"]), "--cycle 0.000000"),
        (milled(&["--cycle", "0.002"]), "--samples"),
        (milled(&["--samples", "mill.toml.csv/"]), "mill.toml.csv"),
        (vec!["time", "missing.toml"], "missing.toml"),
    ] {
        let done = kinecut(&folder, &args);
        let said = text(&done.stderr);
        assert!(done.status.code() == Some(2) && said.contains(says), "{args:?}: {said}");
    }
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 3);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn the_page_has_graphs_of_feed_velocity_acceleration_and_jerk() {
    let folder = folder("graphs");
    let done = kinecut(&folder, &[&MILLED[..], &["--out", "page"]].concat());
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    let page = std::fs::read_to_string(folder.join("page/time.html")).unwrap();
    for said in [
        "Feed, least and most of samples each 1 ms",
        "Velocity of each axis over its limit",
        "Acceleration of each axis over its limit",
        "Jerk of each axis over its limit",
        "Acceleration of X, Y and Z together",
        "Jerk of X, Y and Z together",
        "over way of the tip [mm]",
        "at the programmed feed",
        "at the jerk of an axis",
        "X, of 30000 mm/min",
        "Z, of 50 m/s³",
        "line 9",
    ] {
        assert!(page.contains(said), "{said}");
    }
    assert!(!page.contains("NaN") && !page.contains("inf"));
    // The time at the limits is all of it; in it rest the axes while the program dwells.
    let sheet = json(&kinecut(&folder, &[&MILLED[..], &["--json"]].concat()));
    let rows = rows_of(&page, "Limits that the motion is at");
    let sum = |column: usize| rows.iter().map(|row| row[column].parse::<f64>().unwrap()).sum::<f64>();
    assert!((sum(1) - sheet["time"].as_f64().unwrap()).abs() < 1e-3 * rows.len() as f64, "{rows:?}");
    assert!((sum(2) - sheet["shares"]["rapid"].as_f64().unwrap()).abs() < 2e-3, "{rows:?}");
    assert!((sum(3) - 100.0).abs() < 0.1 * rows.len() as f64, "{rows:?}");
    // Down 3 from Z 2, along X and back, 0.5 over, and up: 5 + 60.5 + 23 mm, after 18 down to Z 2.
    assert!((sum(4) - 106.5).abs() < 0.3, "{rows:?}");
    let of = |limit: &str| rows.iter().find(|row| row[0].starts_with(limit)).map(|row| row[1].as_str());
    assert_eq!(of("rest"), Some("0.500"), "{rows:?}");
    assert!(of("programmed feed").is_some() && of("jerk of X, 50 m/s").is_some(), "{rows:?}");
    // Without a limit of jerk there is nothing to be over.
    std::fs::write(folder.join("mill.toml"), MACHINE.replace(", jerk = 50", "")).unwrap();
    let done = kinecut(&folder, &[&MILLED[..], &["--out", "page", "--samples", "s.csv"]].concat());
    assert!(text(&done.stdout).contains("accelerations jump"), "{}", text(&done.stdout));
    let page = std::fs::read_to_string(folder.join("page/time.html")).unwrap();
    assert!(page.contains("Acceleration of each axis") && !page.contains("Jerk of each axis"));
    assert!(page.contains("jerk is not limited on all moves, and not drawn"));
    std::fs::remove_dir_all(folder).unwrap();
}
