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
        let parts = budget.stock + budget.surface + budget.comparison + budget.engagement + budget.moves;
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
