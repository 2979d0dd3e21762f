//! Random programs, each as it is and with twenty mistakes: where a simulation of this test's own (points in the stock, the
//! tool at poses a quarter of a millimetre apart) sees a rapid, a standing spindle, a shank or a holder in material, the
//! outcome is never safe; and right programs are safe.
//!
//! A tenth of the jobs runs in the suite, all of them in the weekly form.

mod dense;
mod mistake;
mod program;

use kinecut::job::Judgement;

use dense::touches;
use mistake::{MISTAKES, mistaken};
use program::{Part, Random};

use crate::common::job;
use kinecut_cases::cases;

/// The outcome of a program; none when it is refused.
fn outcome(part: &Part, step: f64) -> Option<(Judgement, String)> {
    let outcome = job::run_program(&part.job(step), &part.text()).ok()?;
    let found: Vec<String> = outcome.verdict.found.iter().map(|f| format!("{} {f}", f.code)).collect();
    Some((outcome.verdict.outcome, found.join("\n")))
}

#[test]
fn a_program_with_a_contact_is_never_safe_and_right_ones_are() {
    let jobs = u64::from(cases(10, 100));
    let (mut safe, mut contacts, mut mistakes) = (0, 0, 0);
    let (mut missed, mut amber) = (Vec::new(), Vec::new());
    for number in 0..jobs {
        let mut random = Random::new(number);
        let part = Part::new(&mut random);
        let step = random.between(0.6, 2.0);
        assert_eq!(touches(&part), None, "job {number} is wrong itself:\n{}", part.text());
        match outcome(&part, step) {
            Some((Judgement::Safe, _)) => safe += 1,
            other => amber.push(format!("job {number}, step {step:.2}: {other:?}")),
        }
        for _ in 0..MISTAKES {
            let (wrong, what) = mistaken(&part, &mut random);
            mistakes += 1;
            let Some(seen) = touches(&wrong) else { continue };
            contacts += 1;
            if let Some((Judgement::Safe, _)) = outcome(&wrong, step) {
                missed.push(format!("job {number}, {what}: {seen}, step {step:.2}\n{}", wrong.text()));
            }
        }
    }
    assert!(
        missed.is_empty(),
        "{} of {contacts} contacts are headlined safe:\n{}",
        missed.len(),
        missed.join("\n\n")
    );
    assert!(10 * safe >= 9 * jobs, "only {safe} of {jobs} right programs are safe:\n{}", amber.join("\n"));
    // The mistakes must be of the kind that touches something.
    assert!(5 * contacts >= mistakes, "{contacts} contacts in {mistakes} mistakes");
}
