//! Memory of a run: told beforehand, kept, and refused with what would fit.

use super::errors::{run, with};
use kinecut::base::Code;

/// The number after a word of a help.
fn told(help: &str, after: &str) -> f64 {
    let rest = help.split_once(after).unwrap_or_else(|| panic!("{help}")).1;
    rest.split_whitespace().next().unwrap().trim_end_matches(',').parse().unwrap()
}

#[test]
fn the_lines_need_no_more_than_was_told() {
    for step in ["1.0", "0.5"] {
        let outcome = run(&with("step = 1.0", &format!("step = {step}"))).unwrap();
        let (budget, simulation) = (outcome.simulation.budget, &outcome.simulation);
        assert!(simulation.stock.memory_held() <= budget.stock, "{budget:?}");
        let moves: usize = outcome.setups.iter().map(|s| s.trace.segments.len()).sum();
        assert_eq!(budget.move_count, moves as u64);
        let compared = budget.comparison + budget.engagement + budget.contacts;
        let parts = budget.stock + budget.surface + compared + budget.moves;
        assert!(
            budget.surface > 0 && budget.engagement > 0 && budget.comparison > 0 && budget.total() == parts,
            "{budget:?}"
        );
        let counts = kinecut::stock::DexelGrid::lattice(&simulation.stock).counts.map(u64::from);
        let [x, y, z] = counts;
        assert_eq!(budget.line_count, x * y + y * z + z * x);
    }
}

#[test]
fn the_step_that_is_told_fits_and_no_finer_one_does() {
    let at =
        |step: f64, memory: f64| run(&with("step = 1.0", &format!("step = {step:?}, memory = {memory:?}")));
    let finding = *at(0.05, 12.0).unwrap_err().0;
    assert_eq!(finding.code, Code::JOB_BUDGET, "{finding}");
    assert!(finding.message.contains("lines of the stock 0.05 mm apart"), "{finding}");
    let step = told(&finding.help, "set simulate.step to ");
    assert!(step > 0.05, "{finding}");
    // What comes with cutting is refused later, if at all; the model itself fits.
    let coarser = at(step, 12.0).err().map(|e| *e.0);
    assert!(coarser.is_none_or(|f| f.message.contains("surface")));
    let finer = *at(step * 0.99, 12.0).unwrap_err().0;
    assert!(finer.message.contains("the run needs"), "{finer}");
}

#[test]
fn moves_that_need_more_than_all_memory_are_refused_with_what_they_need() {
    let finding = *run(&with("step = 1.0", "step = 1.0, memory = 0.02")).unwrap_err().0;
    assert_eq!(finding.code, Code::JOB_BUDGET);
    let needed = told(&finding.help, "set simulate.memory to ");
    let again = run(&with("step = 1.0", &format!("step = 30.0, memory = {needed:?}"))).err().map(|e| *e.0);
    assert!(again.is_none_or(|f| !f.message.contains("the run needs")));
}

#[test]
fn a_surface_that_does_not_fit_is_refused_with_a_tolerance_that_does() {
    let job = |tolerance: f64, memory: f64| {
        run(&with("step = 1.0", &format!("step = 0.3, mesh_tolerance = {tolerance:?}, memory = {memory:?}")))
    };
    let known = job(0.3, 4000.0).unwrap().simulation.budget.total() as f64 / 1e6;
    let (mut no, mut yes) = (known, known + 100.0);
    // The least memory at which the surface fits.
    for _ in 0..8 {
        let middle = 0.5 * (no + yes);
        if job(0.0001, middle).is_ok() { yes = middle } else { no = middle }
    }
    let room = known + 0.8 * (no - known);
    let finding = *job(0.0001, room).unwrap_err().0;
    assert_eq!(finding.code, Code::JOB_BUDGET, "{finding}");
    assert!(finding.place.is_some(), "{finding}");
    let tolerance = told(&finding.help, "set the mesh tolerance to ");
    assert!(tolerance > 0.0001 && job(tolerance, room).is_ok(), "{finding}");
}

#[test]
fn bodies_and_designs_are_counted() {
    let ball = |rings: u32| {
        let (n, turn) = (rings, std::f64::consts::TAU);
        let at = |i: u32, j: u32| {
            let (polar, around) =
                (0.5 * turn * f64::from(i) / f64::from(n), turn * f64::from(j % n) / f64::from(n));
            let r = if i == 0 || i == n { 0.0 } else { polar.sin() };
            4.0 * glam::DVec3::new(r * around.cos(), r * around.sin(), polar.cos())
        };
        let mut mesh = kinecut::geom::Mesh::default();
        for i in 0..n {
            for j in 0..n {
                let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                let from = mesh.vertices.len() as u32;
                mesh.vertices.extend(corners);
                if i > 0 {
                    mesh.triangles.push([from, from + 1, from + 3]);
                }
                if i < n - 1 {
                    mesh.triangles.push([from + 3, from + 1, from + 2]);
                }
            }
        }
        mesh
    };
    let run = |design: &str, fixtures: &str, memory: f64| {
        let text = format!(
            r#"format = 1
stock = {{ box = {{ min = [0, 0, -10], max = [40, 40, 0] }} }}
simulate = {{ step = 2, memory = {memory:?} }}
post = {{ control = "linuxcnc" }}
{design}
[[tool]]
number = 1
type = "end-mill"
diameter = 8
flute_length = 20
[[setup]]
offset = "G54"
program = {{ file = "P.ngc" }}
{fixtures}
"#
        );
        let program =
            "G17 G21 G90 G94 G54\nT1 M6\nG43\nS3000 M3\nG0 X-10 Y20 Z20\nG1 Z-2 F900\nX50\nG0 Z20\nM2\n";
        let mesh = kinecut::geom::write_stl(&ball(60));
        let loader = kinecut::base::MemoryLoader::default().with("ball.stl", mesh).with("P.ngc", program);
        kinecut::job::run("job.toml", &text, &loader, &kinecut::base::Silent)
    };
    let triangles = 2 * 60 * 59;
    let fixture = "[[fixture]]\nname = \"ball\"\nmesh = \"ball.stl\"\nat = [60, 60, 0]\n";
    let budget = |design: &str, fixtures: &str| run(design, fixtures, 500.0).unwrap().simulation.budget;
    let (none, bodies) =
        (budget("", ""), budget("", &fixture.repeat(2).replacen("\"ball\"", "\"other\"", 1)));
    assert_eq!(none.contacts, 0);
    let one = kinecut::contact::Body::memory_of_mesh(triangles);
    assert!(bodies.contacts > 2 * one && bodies.contacts < 2 * one + 10_000, "{bodies:?} {one}");
    assert_eq!(bodies.total(), none.total() + bodies.contacts);
    let design = budget("[design]\nmesh = \"ball.stl\"\ntolerance = 50\n", "");
    assert!(design.comparison > one, "{design:?}");
    // Refused where they do not fit: a coarser step does not help.
    let finding = *run("", fixture, 2.0).unwrap_err().0;
    assert_eq!(finding.code, Code::JOB_BUDGET);
    assert!(finding.message.contains("bodies for contacts: 5 MB"), "{finding}");
    assert!(finding.help.starts_with("set simulate.memory to "), "{finding}");
}
