//! The verbs about programs that others wrote: `simulate`, `check`, `post`.

use std::path::Path;

use kinecut::base::{Error, FileKind, Finding, at_most};
use kinecut::job::{self, GivenFile, GivenJob, ProgramWants, given_alone, given_with_job};
use kinecut::nc::{Control, PostSettings};
use kinecut::verbs::check::program_sheet;
use kinecut::verbs::post::{TranslateWants, Translation, translate};
use serde::Serialize;

use crate::answers::{To, answer, counts, tell};
use crate::args::{Args, Check, Orientation, Post, ProgramOf, Simulate};
use crate::{FINDINGS, FINE, complain, data, files, print_json, progress, put, show_done};

/// The job about the program that the arguments name.
fn given(
    of: &ProgramOf,
    control: Option<&String>,
    stock: Option<[f64; 6]>,
    cut: bool,
) -> Result<GivenJob, Error> {
    let name = of.program.display().to_string();
    let bytes = files::bytes(&of.program, FileKind::Program)?;
    let program = GivenFile { name: &name, bytes: &bytes };
    let mut wants = ProgramWants {
        control: control.cloned(),
        stock,
        position: of.position,
        tool: of.tool,
        setup: of.setup,
        ..ProgramWants::default()
    };
    match &of.job {
        Some(path) => {
            let (loader, _) = files::beside(path);
            given_with_job(
                program,
                &wants,
                (&path.display().to_string(), &files::text(&path.to_string_lossy())?),
                &loader,
            )
        }
        None => {
            wants.machine = of.machine.as_deref().map(crate::machine::of_name).transpose()?;
            if let Some(path) = &of.tools {
                wants.tools = Some((path.display().to_string(), files::text(&path.to_string_lossy())?));
            }
            given_alone(program, &wants, cut)
        }
    }
}

/// Cuts a program of others.
pub(crate) fn simulate(args: &Args, simulate: &Simulate) -> Result<u8, Error> {
    let bar = progress::Bar::new();
    let is_job = simulate.of.program.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    let done = if is_job {
        let path = &simulate.of.program;
        kinecut::simulate_job(path, &simulate.out, &bar)?
    } else {
        let mut given = given(&simulate.of, simulate.control.as_ref(), simulate.stock, true)?;
        if let Some(step) = simulate.step {
            given.set_step(step)?;
        }
        kinecut::simulate_given(given, files::read(), &simulate.out, &bar)?
    };
    drop(bar);
    Ok(show_done(args, &done, &simulate.out))
}

/// Reads a program of others and says what is wrong with it.
pub(crate) fn check(args: &Args, check: &Check) -> Result<u8, Error> {
    let given = given(&check.of, check.control.as_ref(), None, false)?;
    answer(args, To::default(), program_sheet(&given)?)
}

/// What `post --json` prints.
#[derive(Serialize)]
struct Posted<'a> {
    from: &'static str,
    to: &'static str,
    text: &'a str,
    read_back: job::ReadBack,
    findings: &'a [Finding],
    assumed: &'a [String],
}

/// Writes a program of others for another control.
pub(crate) fn post(args: &Args, post: &Post) -> Result<u8, Error> {
    let given = given(&post.of, post.from.as_ref(), None, false)?;
    let to = Control::parse(&post.to)?;
    let mut settings = PostSettings::new(to);
    settings.program_name = program_name(&post.of.program);
    if let Some(decimals) = post.decimals {
        settings.decimals = decimals;
    }
    let orientation = post.orientation.map(|o| match o {
        Orientation::Vectors => kinecut::operations::OrientationName::Vectors,
        Orientation::Angles => kinecut::operations::OrientationName::Angles,
        Orientation::Axes => kinecut::operations::OrientationName::Axes,
    });
    let done = translate(&given, &TranslateWants { post: settings, orientation })?;
    let name = post.output.as_deref();
    if let Some(file) = name {
        files::write_one(file, &done.text)?;
    }
    if args.json {
        print_json(&Posted {
            from: done.from.name(),
            to: done.to.name(),
            text: &done.text,
            read_back: done.read_back,
            findings: &done.findings,
            assumed: &done.assumed,
        });
    } else {
        tell(args, &done.findings);
        match name {
            None => data(&done.text),
            Some(file) => put(format!("Written to {}\n", file.display())),
        }
        complain(summary(&done));
    }
    Ok(if counts(args, &done.findings) { FINDINGS } else { FINE })
}

/// How far the two texts lie apart, in a line or two.
fn summary(done: &Translation) -> String {
    let back = &done.read_back;
    let turned = match back.largest_angle {
        0.0 => String::new(),
        angle => format!(", its tool {} degrees", at_most(angle.to_degrees(), 4)),
    };
    let mut text = format!(
        "{} to {}: read back, the new text lies {} \u{b5}m from the old one{turned} ({} points on {} moves)",
        done.from.title(),
        done.to.title(),
        at_most(back.largest * 1e3, 2),
        back.points,
        back.moves
    );
    for assumed in &done.assumed {
        text.push_str(&format!("\nRemark: {assumed}"));
    }
    text
}

/// A name for the program that every control takes, from that of its file.
fn program_name(path: &Path) -> String {
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c } else { '_' };
    let name: String = stem.chars().map(plain).take(24).collect();
    if name.is_empty() { "PROGRAM".to_owned() } else { name }
}
