//! The kinecut command line: reads arguments, calls the library, prints.

mod answers;
mod args;
mod files;
mod layouts;
mod machine;
mod planned;
mod program;
mod progress;
mod render;
mod show;
mod surface;
mod swept;

use std::process::ExitCode;

use clap::Parser as _;
use kinecut::base::{Error, Severity};
use kinecut::verbs::explain::{Manual, page};

use answers::{To, answer, counts, tell};
use args::{Args, Run, SchemaName, Verb, Verify};
use show::{complain, data, json as print_json, put};

/// Exit codes: fine or safe; not safe, not proven or a denied warning; wrong input or cannot say; a defect of ours.
const FINE: u8 = 0;
const FINDINGS: u8 = 1;
const WRONG_INPUT: u8 = 2;
const DEFECT: u8 = 3;

fn main() -> ExitCode {
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(error) => return not_understood(&error),
    };
    // The message of a panic goes to standard error by itself; here it becomes an exit code of its own.
    let outcome = std::panic::catch_unwind(|| dispatch(&args));
    match outcome {
        Ok(Ok(code)) => ExitCode::from(code),
        Ok(Err(error)) => {
            print_error(&args, &error);
            ExitCode::from(WRONG_INPUT)
        }
        Err(_) => {
            complain(format!(
                "this is a defect of kinecut {}; please report it with the job file",
                kinecut::VERSION
            ));
            ExitCode::from(DEFECT)
        }
    }
}

/// Shows what is wrong with a command line, or the help that it asks for: what was typed is text like any other.
fn not_understood(error: &clap::Error) -> ExitCode {
    let text = error.render().to_string();
    if error.use_stderr() {
        complain(text.trim_end());
        ExitCode::from(WRONG_INPUT)
    } else {
        put(text);
        ExitCode::from(FINE)
    }
}

fn dispatch(args: &Args) -> Result<u8, Error> {
    match &args.verb {
        Verb::Run(run) => self::run(args, run),
        Verb::Simulate(simulate) => program::simulate(args, simulate),
        Verb::Check(check) => program::check(args, check),
        Verb::Post(post) => program::post(args, post),
        Verb::Hole(hole) => planned::hole(args, hole),
        Verb::Drill(drill) => planned::drill(args, drill),
        Verb::Face(face) => planned::face(args, face),
        Verb::Grazing(grazing) => swept::grazing(args, grazing),
        Verb::Envelope(envelope) => swept::envelope(args, envelope),
        Verb::Machine(machine) => machine::machine(args, machine),
        Verb::Fk(fk) => machine::fk(args, fk),
        Verb::Ik(ik) => machine::ik(args, ik),
        Verb::Reach(reach) => machine::reach(args, reach),
        Verb::Layouts(layouts) => layouts::layouts(args, layouts),
        Verb::Surface(surface) => surface::surface(args, surface),
        Verb::Verify(verify) => self::verify(args, verify),
        Verb::Schema { name } => {
            print_json(&match name {
                SchemaName::Job => kinecut::job::file::schema(),
                SchemaName::Hole => kinecut::verbs::hole::hole_schema(),
                SchemaName::Outline => kinecut::job::file::outline_schema(),
                SchemaName::Envelope => kinecut::verbs::envelope::envelope_schema(),
                SchemaName::Grazing => kinecut::verbs::grazing::grazing_schema(),
                SchemaName::Machine => kinecut::job::file::machine_schema(),
                SchemaName::Surface => kinecut::job::file::surface_schema(),
                SchemaName::Contour => kinecut::job::file::contour_schema(),
            });
            Ok(FINE)
        }
        Verb::Explain { code: None } => answer(args, To::default(), Manual::all()),
        Verb::Explain { code: Some(code) } => answer(args, To::default(), page(code)?),
    }
}

fn run(args: &Args, run: &Run) -> Result<u8, Error> {
    let bar = progress::Bar::new();
    let done = kinecut::run(&run.job, &run.out, &bar)?;
    drop(bar);
    Ok(show_done(args, &done, &run.out))
}

/// Shows what a run has done; its exit code.
fn show_done(args: &Args, done: &kinecut::Done, out: &std::path::Path) -> u8 {
    let found = &done.verdict.found;
    if args.json {
        print_json(&done.verdict);
    } else {
        tell(args, found);
        put(&done.summary);
        put(format!("\nWritten to {}: {}\n", out.display(), done.files.join(", ")));
    }
    if done.verdict.is_safe() && !counts(args, found) { FINE } else { FINDINGS }
}

fn verify(args: &Args, verify: &Verify) -> Result<u8, Error> {
    let check = kinecut::verify(&verify.verdict, verify.job.as_deref())?;
    if args.json {
        print_json(&check);
    } else {
        for finding in check.void.iter().chain(&check.unknown) {
            put(render::finding(finding, args.colour()));
            put("\n");
        }
        for role in &check.unchanged {
            put(format!("unchanged  {role}\n"));
        }
        let state = if !check.void.is_empty() {
            "VOID: a file was changed after the verdict"
        } else if !check.unknown.is_empty() {
            "UNKNOWN: a file is not there"
        } else {
            "UNCHANGED: the verdict is about these bytes"
        };
        put(format!("{state}\nVerdict    {}\n", check.sentence));
    }
    // Something that was changed is known, whatever is missing.
    Ok(match (check.void.is_empty(), check.unknown.is_empty()) {
        (false, _) => FINDINGS,
        (true, false) => WRONG_INPUT,
        (true, true) if check.outcome.is_safe() => FINE,
        (true, true) => FINDINGS,
    })
}

fn print_error(args: &Args, error: &Error) {
    if args.json {
        print_json(&*error.0);
    } else {
        debug_assert_eq!(error.0.severity, Severity::Error);
        complain(render::finding(&error.0, args.colour()));
    }
}
