//! The verb `kinecut explain`: what a finding means.

use serde::Serialize;

use super::Answer;
use crate::base::{Code, Finding, ManualPage, Result, manual};
use crate::page::{Block, Row, Section, Table};

/// Codes and titles of all findings.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct Manual(Vec<Title>);

#[derive(Clone, Debug, Serialize)]
struct Title {
    code: Code,
    title: &'static str,
}

impl Manual {
    /// All of them.
    pub fn all() -> Manual {
        Manual(manual().iter().map(|p| Title { code: p.code, title: p.title }).collect())
    }
}

impl Answer for Manual {
    fn sections(&self) -> Vec<Section> {
        let row = |p: &Title| Row::new(vec![p.code.to_string().into(), p.title.into()]);
        vec![Section::default().with(Table::new("", "Code; Finding").rows(self.0.iter().map(row)))]
    }
}

/// The manual page of a finding.
///
/// # Errors
/// `KC0104` for a code that no finding has.
pub fn page(code: &str) -> Result<ManualPage> {
    Code::parse(code).and_then(|c| manual().iter().find(|p| p.code == c)).copied().ok_or_else(|| {
        Finding::error(Code::JOB_REFERENCE, format!("there is no finding `{code}`"))
            .help("`kinecut explain` lists all")
            .into()
    })
}

impl Answer for ManualPage {
    fn sections(&self) -> Vec<Section> {
        vec![Section::new(format!("{}: {}", self.code, self.title)).with(Block::Text(self.text.to_owned()))]
    }
}
