//! The verdict: what was proven of which bytes, what was found, what was not checked.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::Judgement;
use crate::base::{Code, Finding, Result};

/// SHA-256 of bytes, in hexadecimal.
///
/// ```
/// assert_eq!(kinecut::job::sha256(b"")[..8], *"e3b0c442");
/// ```
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}

/// A thing that the verdict is about: its role, the file it came from if there is one, and its hash.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Subject {
    /// "program", "output", "job", "tools", "machine", "stock", "design", "setups".
    pub role: String,
    /// File, relative to the folder of the verdict for outputs, as the job spells it for inputs; `None` for a part
    /// of the job.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// SHA-256 of the bytes; of a part of the job, of its canonical JSON.
    pub sha256: String,
}

/// Something proven, with the bound on what can have been missed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proof {
    /// What holds.
    pub claim: String,
    /// What can have been missed, in words with numbers ("below 0.2 mm across the lines, exact along them").
    pub bound: String,
}

/// The verdict on one program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Version of this form: 2.
    pub format: u32,
    /// kinecut's version.
    pub kinecut: String,
    /// The worst of what was found, in one word.
    pub outcome: Judgement,
    /// What the verdict is about.
    pub subjects: Vec<Subject>,
    /// What was proven.
    pub proven: Vec<Proof>,
    /// What was found.
    pub found: Vec<Finding>,
    /// What was not checked, or had to be assumed.
    pub not_checked: Vec<String>,
    /// SHA-256 of this verdict's other fields.
    pub digest: String,
}

impl Verdict {
    /// A verdict over its subjects.
    pub fn new(
        subjects: Vec<Subject>,
        proven: Vec<Proof>,
        found: Vec<Finding>,
        not_checked: Vec<String>,
    ) -> Verdict {
        let mut verdict = Verdict {
            format: 2,
            kinecut: crate::VERSION.to_owned(),
            outcome: Judgement::of(&found),
            subjects,
            proven,
            found,
            not_checked,
            digest: String::new(),
        };
        verdict.digest = verdict.own_digest();
        verdict
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
            Finding::error(Code::VERDICT_VOID, format!("this is no verdict: {e}")).cure("run the job again")
        })?;
        if verdict.digest != verdict.own_digest() {
            return Err(Finding::error(Code::VERDICT_VOID, "the verdict itself was changed")
                .cure("run the job again")
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
        .cure("run the job again")
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
        let verdict = Verdict::new(vec![subject.clone()], vec![proof], Vec::new(), vec!["fixtures".into()]);
        let text = verdict.to_json();
        assert_eq!(Verdict::from_json(&text).unwrap(), verdict);
        for changed in [
            text.replace("0.2 mm", "0.1 mm"),
            text.replace("fixtures", "fixture"),
            text.replace("\"safe\"", "\"not-safe\""),
        ] {
            assert_eq!(Verdict::from_json(&changed).unwrap_err().code(), Code::VERDICT_VOID);
        }
        assert!(Verdict::check_subject(&subject, b"G0 X1").is_ok());
        assert_eq!(Verdict::check_subject(&subject, b"G0 X2").unwrap_err().code(), Code::VERDICT_VOID);
    }
}
