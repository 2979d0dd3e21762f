//! The part of a report is drawn from some lines; what is said of it is known by all.

use kinecut::base::{Code, MemoryLoader, Silent};
use kinecut::job::{
    GivenFile, GivenStock, InspectWants, Inspection, Outcome, PartSurface, ProgramWants, RunWants,
    StockWants, given_alone, report, run_with, simulate_given,
};

/// A slot 8 mm wide and 3 mm deep, and a hole of 4 mm through the block.
const PROGRAM: &str = "G21 G90 G17\nT1 M6\nS8000 M3\nG0 X-10 Y15\nG0 Z5\nG1 Z-3 F500\nG1 X50\nG0 Z20\n\
                       T2 M6\nS8000 M3\nG0 X30 Y5\nG0 Z5\nG1 Z-14 F200\nG0 Z20\nM2\n";
const TOOLS: &str = "[[tool]]\nnumber = 1\ntype = \"end-mill\"\ndiameter = 8.0\nflute_length = 20.0\nstickout = 40.0\n\
                     [[tool]]\nnumber = 2\ntype = \"end-mill\"\ndiameter = 4.0\nflute_length = 20.0\nstickout = 40.0\n";

fn simulated(step: f64, surface: PartSurface) -> Outcome {
    let program = GivenFile { name: "P.ngc", bytes: PROGRAM.as_bytes() };
    let wants = ProgramWants {
        step: Some(step),
        stock: Some(GivenStock::Block([0.0, 0.0, -10.0, 40.0, 30.0, 0.0])),
        tools: Some(("tools.toml".to_owned(), TOOLS.to_owned())),
        ..ProgramWants::default()
    };
    let mut job = given_alone(program, &wants, true).unwrap();
    job.simulated(&StockWants { surface, ..StockWants::default() }).unwrap();
    simulate_given(job, &Silent).unwrap()
}

#[test]
fn a_picture_takes_every_second_line_where_there_are_too_many_and_numbers_take_all() {
    // 760,000 lines.
    let [drawn, lines] = [PartSurface::Picture, PartSurface::None].map(|surface| simulated(0.05, surface));
    assert_eq!((drawn.drawn_step, lines.drawn_step), (Some(0.1), None));
    assert!(drawn.verdict.to_json() == lines.verdict.to_json());
    assert_eq!(drawn.removed, lines.removed);
    let exact = 40.0 * 30.0 * 10.0 - 40.0 * 8.0 * 3.0 - std::f64::consts::PI * 4.0 * 10.0;
    let volume = drawn.part.volume();
    assert!((volume - exact).abs() < 3e-4 * exact, "{volume} {exact}");
    let page = report::of_job(&drawn);
    assert!(page.part.as_ref().is_some_and(|part| !part.triangles.is_empty()));
    let said = "Part drawn from lines 0.1 mm apart";
    assert!(report::html(&page).contains(said) && !report::html(&report::of_job(&lines)).contains(said));
    // Sections and points are those of the whole surface.
    let wants = InspectWants { sections: vec!["z=-1".parse().unwrap()], ..InspectWants::default() };
    assert_eq!(Inspection::of(&drawn, &wants).unwrap_err().code(), Code::GEOMETRY);
}

#[test]
fn a_picture_of_few_lines_is_the_surface() {
    let [drawn, full] = [PartSurface::Picture, PartSurface::Full].map(|surface| simulated(0.4, surface));
    assert_eq!(drawn.drawn_step, None);
    assert!(drawn.part == full.part && drawn.removed == full.removed);
}

/// Colours of deviation are those of the ends around each vertex: lines left out would hide some.
#[test]
fn a_part_that_is_compared_has_its_surface_of_all_lines() {
    let job = r#"
        format = 1
        stock = { box = { min = [-12, -12, -6], max = [12, 12, 0] } }
        post = { control = "fanuc" }
        simulate = { step = 0.05 }
        [[tool]]
        number = 1
        type = "drill"
        diameter = 8
        flute_length = 60
        [[setup]]
        offset = "G54"
        safe_height = 20
        [[setup.operation]]
        type = "drill"
        tool = 1
        points = [[0, 0]]
        entry = { surface = "plane" }
        exit = "same"
        length = 6
        tolerance = 0.05
        speed = 1800
        feed_per_rev = { entry = 0.1, steady = 0.2, exit = 0.1 }
    "#;
    let stock = StockWants { surface: PartSurface::Picture, ..StockWants::default() };
    let wants = RunWants { stock, ..RunWants::default() };
    let outcome = run_with("job.toml", job, &wants, &MemoryLoader::default(), &Silent).unwrap();
    assert!(outcome.simulation.budget.line_count > 300_000);
    assert!(outcome.drawn_step.is_none() && !outcome.deviation.at_vertices.is_empty());
    assert_eq!(outcome.deviation.at_vertices.len(), outcome.part.vertices.len());
}
