//! The tool table of LinuxCNC.

use kinecut::base::{MemoryLoader, Sources};
use kinecut::job::file::{ToolFileTable, ToolType};
use kinecut::job::library::read_library;

use super::{lacks, named, near, read, wrong};

#[test]
fn a_table_gives_what_it_has_and_says_what_is_missing() {
    let text = "; tools of the small mill\nT3 P12 Z81.25 D6 X0 I0 Q1 ;End Mill 6\nT4 P4 D8.5\nT5 P5 Z90 ;drill 5\nT7 P7 D3 X1.5\
                ;chamfer 90\nT8 Z-12.5 D4 ;surface tool\nT9 D4 Z0 ;stream drill\nT10 D8 ;reamer\n";
    let library = read("tool.tbl", text).unwrap();
    let tools = &library.tools;
    assert_eq!(tools.iter().map(|t| t.table.number).collect::<Vec<_>>(), [3, 4, 5, 7, 8, 9, 10]);
    assert_eq!((tools[0].table.diameter, tools[0].table.gauge_length), (6.0, Some(81.25)));
    assert_eq!(
        (tools[0].table.kind, tools[0].table.name.as_deref()),
        (ToolType::EndMill, Some("End Mill 6"))
    );
    assert_eq!(lacks(&tools[0]), ["flute_length"]);
    assert_eq!(
        tools[0].assumed,
        ["the type, from the remark", "gauge_length 81.25 mm, as Z counts from the spindle"]
    );
    assert_eq!(tools[0].dropped, ["P", "Q"]);
    assert_eq!(lacks(&tools[1]), ["type", "flute_length"]);
    assert_eq!(lacks(&tools[2]), ["diameter", "flute_length"]);
    assert_eq!(tools[2].table.kind, ToolType::Drill);
    // D is the largest diameter, `diameter` that of the tip.
    assert_eq!(lacks(&tools[3]), ["half_angle", "diameter", "flute_length"]);
    assert_eq!(tools[3].dropped, ["D (3 mm, the largest diameter)", "P", "X"]);
    // Below 0 it is no length; a face is a word of its own.
    assert_eq!((tools[4].table.gauge_length, tools[5].table.gauge_length), (None, None));
    assert_eq!(tools[4].dropped, ["Z (-12.5 mm: below 0 it is no length of a tool)"]);
    assert_eq!(lacks(&tools[4]), ["type", "flute_length"]);
    assert_eq!((tools[5].assumed.len(), lacks(&tools[5])), (1, vec!["flute_length"]));
    assert_eq!(lacks(&tools[6]), ["point", "flute_length"]);
    assert_eq!(library.faults().len(), 7);
    assert!(library.checked().iter().all(Option::is_none));
}

#[test]
fn lengths_may_be_in_inches() {
    let loader = MemoryLoader::default().with("tool.tbl", "T1 P1 Z0.4 D0.393700787 ;end mill\n");
    let inches = ToolFileTable { inches: true, ..named("tool.tbl") };
    let library = read_library(&mut Sources::default(), &inches, &loader).unwrap();
    assert_eq!(library.tools[0].assumed[1], "gauge_length 10.16 mm, as Z counts from the spindle");
    let tool = &library.tools[0].table;
    assert!(near(tool.gauge_length.unwrap(), 10.16) && (tool.diameter - 10.0).abs() < 1e-6, "{tool:?}");
}

#[test]
fn a_number_that_is_there_twice_is_an_error_at_its_line() {
    let error = wrong("tool.tbl", "T1 P1 D6\n;\nT2 D4\nT1 P3 D5\n");
    let place = error.0.place.as_ref().unwrap();
    assert_eq!(
        (error.code().to_string().as_str(), place.line, place.text.as_str()),
        ("KC0706", 4, "T1 P3 D5")
    );
    let error = wrong("tool.tbl", "T1 P1 D6\nT2 Dsix\n");
    assert_eq!((error.code().to_string().as_str(), error.0.place.as_ref().unwrap().line), ("KC0202", 2));
}
