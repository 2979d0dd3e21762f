//! A program of others in the words of another control.
//!
//! The text is read as its control reads it, written for the other control, read back as that one reads it, and the two
//! motions are compared. What the other control cannot say is an error at its block; what has no counterpart there and moves
//! nothing is a finding.

use glam::DVec3;
use std::borrow::Cow;
use std::sync::Arc;

use serde::{Serialize, Serializer};

use super::reorient::{Reoriented, Saying, reorient};
use super::rework::{blend_on, rework};
use crate::base::{Code, Error, Finding, Result, Severity, Sources, at_most};
use crate::job::external::given::GivenJob;
use crate::job::external::{Errors, Missing, follow};
use crate::nc::{self, Control, Kept, PostSettings, ReadSettings};
use crate::page::{Block, Fact, Section};
use crate::program::{Blend, Item, Origin, Program};
use crate::trace::{RegisterState, Trace, TraceOptions, trace};
use crate::verbs::Answer;

use crate::job::check::JobProgram;
use crate::job::following::CHORD;
use crate::job::read_back::{ReadBack, compare};
use crate::operations::OrientationName;

/// A translated program.
#[derive(Clone, Debug, Serialize)]
pub struct Translation {
    /// The control that it was read for.
    #[serde(serialize_with = "name")]
    pub from: Control,
    /// The control that it was written for.
    #[serde(serialize_with = "name")]
    pub to: Control,
    /// The text.
    pub text: String,
    /// Distance of the new text from the old one; zero if nothing moves.
    pub read_back: ReadBack,
    /// Findings, the worst first.
    pub findings: Vec<Finding>,
    /// Assumptions that had to be made.
    pub assumed: Vec<String>,
}

fn name<S: Serializer>(control: &Control, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serializer.serialize_str(control.name())
}

impl Answer for Translation {
    fn sections(&self) -> Vec<Section> {
        let back = &self.read_back;
        let turned = match back.largest_angle {
            0.0 => String::new(),
            angle => format!(", its tool {} degrees", at_most(angle.to_degrees(), 4)),
        };
        let apart = at_most(back.largest * 1e3, 2);
        let apart = format!("the new text lies {apart} \u{b5}m from the old one{turned}");
        let mut facts = vec![
            Fact::new("Read back", apart).note(format!("{} points on {} moves", back.points, back.moves)),
        ];
        facts.extend(self.assumed.iter().map(|assumed| Fact::new("Remark", assumed.as_str())));
        vec![Section::new(format!("{} to {}", self.from.title(), self.to.title())).with(Block::Facts(facts))]
    }

    fn data(&self) -> Cow<'_, str> {
        Cow::Borrowed(&self.text)
    }

    fn findings(&self) -> Vec<&Finding> {
        self.findings.iter().collect()
    }
}

/// Smallest distance of the two motions that is reported [mm]: more than the rounding of three decimals explains.
const FAR: f64 = 2e-3;
/// Smallest angle of two directions of the tool that is reported [rad]: a few units of the third decimal of a degree.
const FAR_TURNED: f64 = 1e-4;

/// Translates a given program: `post` is the other control, and how to write for it; `orientation` how directions of the tool
/// are to be said, if not as they are.
///
/// # Errors
/// Those of the reader and of the trace; those of the writer, at the block that the other control cannot run; `KC0303` when
/// the text that was written does not move as the program does.
pub fn translate(
    given: &GivenJob,
    post: &PostSettings,
    orientation: Option<OrientationName>,
) -> Result<Translation> {
    let (job, program) = (given.job(), given.program()?);
    let (from, to) = (program.control, post.control);
    let source = follow(job, 0, program, Missing::StoodFor, Errors::Stop)?;
    let read = &source.reading.program;
    let reworked = rework(read, &source.radii, from, to)?;
    let place = |origin: &Origin| origin.span.map(|s| source.sources.locate(s));
    let at = |e: Error| at_source(e, &reworked.program, place);
    let said = match orientation {
        None => Reoriented {
            of: (0..reworked.program.items.len() as u32).collect(),
            program: reworked.program.clone(),
        },
        Some(wanted) => {
            let machine = job.machine.as_ref().ok_or_else(no_machine)?;
            let say = Saying { machine, wanted, to, tolerance: FAR / 2.0 };
            reorient(&source, &reworked.program, &say).map_err(at)?
        }
    };
    let at_said = |e: Error| at_source(e, &said.program, place);
    let mut post = post.clone();
    post.header.extend(source.reading.header.iter().cloned());
    let posted = nc::write(&said.program, &job.tools, &post).map_err(at_said)?;
    let file = format!("{}.{}", post.program_name, to.extension());
    let mut sources = Sources::default();
    let written = sources.add(&file, Arc::clone(&posted.text));
    // The same machine keeps the same offsets.
    let kept = if to == from { program.kept.clone() } else { Kept::default() };
    let settings = ReadSettings { kept, ..ReadSettings::default() };
    let back = nc::read_source(&sources, written, to, &read.setups, &settings)?;
    let lines: Vec<Option<u32>> = (0..back.program.items.len())
        .map(|i| back.program.origin(i).span.map(|s| sources.line(s).saturating_sub(1)))
        .collect();
    let options = TraceOptions {
        chord: CHORD,
        machine: job.machine.as_ref(),
        tools: &source.magazine.tools,
        retract_height: job.setups[0].retract_height(),
        operator: RegisterState {
            in_spindle: source.magazine.in_spindle,
            start: program.start.map(DVec3::from_array),
            lengths: &[],
            own_radius: true,
        },
        radii: &reworked.radii,
        comp_start: to.comp_start(),
    };
    let written = trace(&back.program, &options)?;
    let planned = |item: u32| {
        let line = lines.get(item as usize).copied().flatten()?;
        let item = posted.lines.get(line as usize).copied().flatten()?;
        said.of.get(item as usize).copied()
    };
    let read_back = compare(&source.trace, &written, planned).map_err(at)?;
    let mut findings = source.findings.clone();
    findings.extend(
        reworked
            .findings
            .iter()
            .map(|(item, f)| Finding { place: place(&reworked.program.origin(*item as usize)), ..f.clone() }),
    );
    findings.extend(lost_words(&source.reading.findings, to));
    findings.extend(lost_blends(read, to, place));
    findings.extend(lost_messages(read, from, to, place));
    findings.extend(rapids(program, &source.trace, &written, to));
    findings.extend(apart(&read_back, &file));
    findings.sort_by_key(|f| std::cmp::Reverse(f.severity));
    let mut assumed: Vec<String> = source.trace.assumed.clone();
    assumed.extend(source.unfollowed.iter().map(ToString::to_string));
    Ok(Translation { from, to, text: posted.text.to_string(), read_back, findings, assumed })
}

fn no_machine() -> Error {
    Finding::error(Code::JOB_REFERENCE, "directions of the tool are said otherwise on a machine only")
        .help("name it: --machine, or --job with one")
        .into()
}

/// An error about an item, at the place of the block that it came from.
fn at_source(
    mut error: Error,
    program: &Program,
    place: impl Fn(&Origin) -> Option<crate::base::Location>,
) -> Error {
    if let Some(item) = error.0.item.take_if(|i| (*i as usize) < program.items.len()) {
        error.0.place = place(&program.origin(item as usize));
    }
    error
}

/// Words that were read, move nothing and are not in the new text.
fn lost_words(read: &[Finding], to: Control) -> Vec<Finding> {
    let words = read.iter().filter(|f| f.severity == Severity::Note && f.code == Code::NC_WORD);
    words
        .map(|f| {
            let mut finding = Finding::warning(
                Code::TRANSLATED,
                format!("{}: it is not in the text for {}", f.message, to.title()),
            )
            .help("say it by hand, if the other machine needs it");
            finding.place.clone_from(&f.place);
            finding
        })
        .collect()
}

/// Passages between moves that the other control does not have: each kind once.
fn lost_blends(
    program: &Program,
    to: Control,
    place: impl Fn(&Origin) -> Option<crate::base::Location>,
) -> Vec<Finding> {
    let mut told = Vec::new();
    let mut findings = Vec::new();
    for i in 0..program.items.len() {
        let wanted = program.state(i).blend;
        let written = blend_on(to, wanted);
        // One distance for two of the same sum: the path is the same within it.
        let within = |blend| matches!(blend, Blend::Tolerance { .. });
        let same =
            written == wanted || within(written) && within(wanted) && written.bound() == wanted.bound();
        if !matches!(program.items.get(i), Item::Move(_)) || same || told.contains(&wanted) {
            continue;
        }
        told.push(wanted);
        let name = |blend: Blend| match blend {
            Blend::Stop => "an exact stop".to_owned(),
            Blend::Exact => "an exact path".to_owned(),
            Blend::Continuous => "a continuous path".to_owned(),
            Blend::Tolerance { path, merge, .. } => {
                format!("a continuous path within {} mm", ((path + merge) * 1e6).round() / 1e6)
            }
        };
        let what = format!(
            "{} has no word for {} between moves: {} is written",
            to.title(),
            name(wanted),
            name(written)
        );
        let finding = Finding::warning(Code::TRANSLATED, what).help("look at the corners of the part");
        findings.push(Finding { place: place(&program.origin(i)), ..finding });
    }
    findings
}

/// A warning when messages to the operator become comments.
fn lost_messages(
    program: &Program,
    from: Control,
    to: Control,
    place: impl Fn(&Origin) -> Option<crate::base::Location>,
) -> Option<Finding> {
    let items = &program.items;
    let is_message = |i: &usize| matches!(items.get(*i), Item::Message(text) if !text.is_empty());
    let messages: Vec<usize> = (0..items.len()).filter(is_message).collect();
    let first = *messages.first().filter(|_| from != to && !to.has_messages())?;
    let what = format!(
        "{} shows no messages of a program to the operator: {} of them are comments in the text",
        to.title(),
        messages.len()
    );
    let finding =
        Finding::warning(Code::TRANSLATED, what).help("stop there (M0) where the operator has to read it");
    Some(Finding { place: place(&program.origin(first)), ..finding })
}

/// A warning when rapid moves that keep to the straight line no longer do.
fn rapids(program: &JobProgram, source: &Trace, written: &Trace, to: Control) -> Option<Finding> {
    let legs = |t: &Trace| t.segments.iter().filter(|s| s.alternative).count();
    (legs(source) == 0 && legs(written) > 0).then(|| {
        let what = format!(
            "rapid moves keep to the straight line on {}, on {} each axis may run for itself",
            program.control.title(),
            to.title()
        );
        Finding::warning(Code::TRANSLATED, what).help("simulate the new text before it is run")
    })
}

/// A finding when the two motions lie apart.
fn apart(read_back: &ReadBack, file: &str) -> Option<Finding> {
    if read_back.largest <= FAR && read_back.largest_angle <= FAR_TURNED {
        return None;
    }
    let finding = Finding::error(Code::READ_BACK, format!("`{file}` does not run where the program did"))
        .point(read_back.at)
        .help("use more decimals, or see what the other control does differently there");
    Some(if read_back.largest > FAR {
        finding.value_mm(read_back.largest).bound_mm(FAR)
    } else {
        let degrees = read_back.largest_angle.to_degrees();
        finding.value(degrees, "degrees").bound(FAR_TURNED.to_degrees(), "degrees")
    })
}
