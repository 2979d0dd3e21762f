//! The verdict: what was proven of which bytes, what was found, what was not checked.

mod ensure;
mod headline;
mod judgement;
mod open;
mod proven;
mod unchecked;
mod verify;

pub use crate::operations::measured::Proof;
use serde::{Deserialize, Serialize};

use crate::base::{Code, Finding, Result};
use crate::job::subject::{Subject, sha256};

pub use ensure::ToEnsure;
pub use judgement::Judgement;
pub use unchecked::{Heading, Unchecked, UncheckedItem};
pub use verify::{VerdictCheck, verify};

pub(super) use ensure::to_ensure;
pub(super) use headline::{banner, scope};
pub(super) use open::not_checked;
pub(super) use proven::proven;
use unchecked::UncheckedList;

/// The verdict on one program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Version of this form: 2.
    pub format: u32,
    /// kinecut's version.
    pub kinecut: String,
    /// The worst of what was found, in one word.
    pub outcome: Judgement,
    /// The reason in one sentence: the worst that was found, or that no fault was.
    pub headline: String,
    /// Subjects of the outcome, and inputs that nobody gave: one sentence each.
    pub scope: Vec<String>,
    /// Subjects of the verdict.
    pub subjects: Vec<Subject>,
    /// Claims proven.
    pub proven: Vec<Proof>,
    /// Findings.
    pub found: Vec<Finding>,
    /// Items not checked, and assumptions; only those that apply to this program.
    pub not_checked: Vec<Unchecked>,
    /// Things that a person has to make sure of before the run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub to_ensure: Vec<ToEnsure>,
    /// SHA-256 of this verdict's other fields.
    pub digest: String,
}

impl Verdict {
    /// A verdict over its subjects: the programs `files`, what was found in them, and the `scope` of the outcome.
    pub fn new(
        subjects: Vec<Subject>,
        files: &[String],
        scope: Vec<String>,
        proven: Vec<Proof>,
        found: Vec<Finding>,
        not_checked: Vec<Unchecked>,
    ) -> Verdict {
        let mut verdict = Verdict {
            format: 2,
            kinecut: crate::VERSION.to_owned(),
            outcome: Judgement::of(&found),
            headline: headline::headline(&found, files),
            scope,
            subjects,
            proven,
            found,
            not_checked,
            to_ensure: Vec::new(),
            digest: String::new(),
        };
        verdict.digest = verdict.own_digest();
        verdict
    }

    /// The verdict with what a person has to make sure of before the run.
    #[must_use]
    pub fn ensuring(mut self, to_ensure: Vec<ToEnsure>) -> Verdict {
        self.to_ensure = to_ensure;
        self.digest = self.own_digest();
        self
    }

    /// The outcome with the number of what led to it ("SAFE, 1 warning").
    pub fn banner(&self) -> String {
        banner(&self.found)
    }

    /// The whole verdict in a line: outcome, reason, scope.
    pub fn sentence(&self) -> String {
        let reason = (!self.outcome.is_safe()).then_some(self.headline.as_str());
        let parts: Vec<String> = std::iter::once(self.banner())
            .chain(reason.into_iter().map(str::to_owned))
            .chain(self.scope.iter().cloned())
            .collect();
        format!("{}.", parts.join(". "))
    }

    /// The verdict as one about files that were written, too: each that is no program becomes a subject of the role
    /// "output".
    #[must_use]
    pub fn with_outputs<'a>(mut self, files: impl Iterator<Item = (&'a str, &'a [u8])>) -> Verdict {
        for (name, bytes) in files {
            let known = |s: &Subject| s.role == "program" && s.file.as_deref() == Some(name);
            if !self.subjects.iter().any(known) {
                self.subjects.push(Subject {
                    role: "output".to_owned(),
                    file: Some(name.to_owned()),
                    sha256: sha256(bytes),
                });
            }
        }
        self.digest = self.own_digest();
        self
    }

    /// Whether the outcome is safe.
    pub fn is_safe(&self) -> bool {
        self.outcome.is_safe()
    }

    /// All that was not checked, under whatever heading.
    pub fn unchecked(&self) -> impl Iterator<Item = &UncheckedItem> {
        self.not_checked.iter().flat_map(|group| &group.items)
    }

    /// The verdict as JSON text.
    pub fn to_json(&self) -> String {
        super::json_text(self)
    }

    /// Reads a verdict and checks its own digest.
    ///
    /// # Errors
    /// `KC0106` when the text is no verdict or was changed.
    pub fn from_json(text: &str) -> Result<Verdict> {
        let verdict: Verdict = serde_json::from_str(text).map_err(|e| {
            Finding::error(Code::VERDICT_VOID, format!("this is no verdict: {e}")).help("run the job again")
        })?;
        if verdict.digest != verdict.own_digest() {
            return Err(Finding::error(Code::VERDICT_VOID, "the verdict itself was changed")
                .help("run the job again")
                .into());
        }
        Ok(verdict)
    }

    /// Checks one subject against bytes as they are now.
    ///
    /// # Errors
    /// `KC0106` when they differ.
    pub fn check_subject(subject: &Subject, bytes: &[u8]) -> Result<()> {
        if sha256(bytes) == subject.sha256 {
            return Ok(());
        }
        let file = subject.file.as_deref().map(|f| format!(" `{f}`")).unwrap_or_default();
        Err(Finding::error(
            Code::VERDICT_VOID,
            format!("the {}{file} was changed after the verdict", subject.role),
        )
        .help("run the job again")
        .into())
    }

    fn own_digest(&self) -> String {
        let bare = Verdict { digest: String::new(), ..self.clone() };
        sha256(super::json_text(&bare).as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_with_one_changed_character_is_void() {
        let subject =
            Subject { role: "program".into(), file: Some("a.mpf".into()), sha256: sha256(b"G0 X1") };
        let proof = Proof { claim: "no rapid meets stock".into(), bound: "0.2 mm".into() };
        let verdict = Verdict::new(
            vec![subject.clone()],
            &["a.mpf".to_owned()],
            vec!["Holder of T3 not given".to_owned()],
            vec![proof],
            vec![Finding::warning(Code::FEED_IN_AIR, "feeds through air")],
            Vec::new(),
        );
        let text = verdict.to_json();
        assert_eq!(Verdict::from_json(&text).unwrap(), verdict);
        assert_eq!(verdict.sentence(), "SAFE, 1 warning. Holder of T3 not given.");
        for changed in [
            text.replace("0.2 mm", "0.1 mm"),
            text.replace("feeds through", "feed through"),
            text.replace("\"safe\"", "\"not-safe\""),
        ] {
            assert_eq!(Verdict::from_json(&changed).unwrap_err().code(), Code::VERDICT_VOID);
        }
        assert!(Verdict::check_subject(&subject, b"G0 X1").is_ok());
        assert_eq!(Verdict::check_subject(&subject, b"G0 X2").unwrap_err().code(), Code::VERDICT_VOID);
    }
}
