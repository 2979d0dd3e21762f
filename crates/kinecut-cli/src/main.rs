//! The kinecut command line: reads arguments, calls the library, prints.

mod answers;
mod args;
mod files;
mod layouts;
mod machine;
mod numbers;
mod open;
mod planned;
mod printing;
mod program;
mod progress;
mod render;
mod show;
mod surface;
mod swept;
mod time;
mod tools;

use std::process::ExitCode;

use clap::Parser as _;
use kinecut::base::{Error, Severity};
use kinecut::verbs::json_document;

use args::Args;
use printing::Printing;
use show::{complain, json as print_json, put};

/// Exit codes: fine or safe; 1 is not safe, not proven or a denied warning; wrong input or cannot say; a defect of ours.
pub(crate) const FINE: u8 = 0;
pub(crate) const WRONG_INPUT: u8 = 2;
const DEFECT: u8 = 3;

fn main() -> ExitCode {
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(error) => return not_understood(&error),
    };
    // The message of a panic goes to standard error by itself; here it becomes an exit code of its own.
    let outcome = std::panic::catch_unwind(|| args.verb.answer(&args.printing));
    match outcome {
        Ok(Ok(code)) => ExitCode::from(code),
        Ok(Err(error)) => {
            print_error(&args.printing, &error);
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

fn print_error(args: &Printing, error: &Error) {
    if args.json {
        print_json(&json_document(&*error.0));
    } else {
        debug_assert_eq!(error.0.severity, Severity::Error);
        complain(render::finding(&error.0, args.colour()));
    }
}
