//! The texts of a request: those that are being edited lie over those on disk.

use std::collections::BTreeMap;

use kinecut::base::{FileKind, OverlayLoader, Result as Found};
use kinecut::job::program_text;
use serde::Deserialize;

use crate::app::App;
use crate::folder::{Listed, id_of, may_be_new, split};
use crate::kind::Kind;
use crate::refusal::Refusal;

/// A file that a request is about.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct About {
    /// Identifier of a file of the folder.
    file: Option<String>,
    /// Name of one that is not on disk yet.
    new: Option<String>,
    /// Identifier of a file beside which the new one is to lie.
    beside: Option<String>,
    /// The text as it is edited; without, as it is on disk.
    text: Option<String>,
    /// Other files that are being edited.
    #[serde(default)]
    edits: Vec<Edit>,
}

#[derive(Clone, Debug, Deserialize)]
struct Edit {
    file: String,
    text: String,
}

/// The texts of a request.
pub(crate) struct Texts {
    /// Path below the folder of the file that it is about.
    pub(crate) name: String,
    pub(crate) kind: Kind,
    text: Option<String>,
    /// Texts by path below the folder.
    edits: BTreeMap<String, String>,
}

impl About {
    /// Finds the files.
    ///
    /// # Errors
    /// One of them is not there, or both or none of the two names are given.
    pub(crate) fn texts(self, app: &App) -> Result<Texts, Refusal> {
        let (name, kind) = match (&self.file, &self.new) {
            (Some(id), None) => {
                let Listed { name, kind, .. } = app.file(id)?;
                (name, kind)
            }
            (None, Some(new)) => (new_name(app, new, self.beside.as_deref())?, Kind::Text),
            _ => return Err(Refusal::request("name one file: `file` or `new`")),
        };
        if self.new.is_some() && self.text.is_none() {
            return Err(Refusal::request("a file that is not on disk needs its text"));
        }
        let edits = edited(app, self.edits)?;
        let of_text =
            |text: &String| Kind::of_name(split(&name).1).flatten().unwrap_or_else(|| Kind::of_text(text));
        let kind = self.text.as_ref().filter(|_| self.new.is_some()).map_or(kind, of_text);
        Ok(Texts { name, kind, text: self.text, edits })
    }

    /// The same for a question that may be about no file: then only the other texts are there.
    ///
    /// # Errors
    /// As [`About::texts`].
    pub(crate) fn texts_or_none(self, app: &App) -> Result<Option<Texts>, Refusal> {
        if self.file.is_some() || self.new.is_some() {
            return self.texts(app).map(Some);
        }
        if self.text.is_some() || self.beside.is_some() {
            return Err(Refusal::request("a text is of a file: name it by `file` or `new`"));
        }
        Ok(None)
    }

    /// The texts of the other files, of a question that is about no file of its own.
    ///
    /// # Errors
    /// One of them is not there, or a file is named.
    pub(crate) fn others(&self, app: &App) -> Result<Texts, Refusal> {
        if self.file.is_some() || self.new.is_some() || self.text.is_some() || self.beside.is_some() {
            return Err(Refusal::request(
                "the question is about no file: leave out `file`, `new`, `beside`, `text`",
            ));
        }
        self.edited(app)
    }

    /// The texts of the other files alone.
    ///
    /// # Errors
    /// One of them is not there.
    pub(crate) fn edited(&self, app: &App) -> Result<Texts, Refusal> {
        let edits = edited(app, self.edits.clone())?;
        Ok(Texts { name: String::new(), kind: Kind::Text, text: None, edits })
    }
}

/// Texts that are being edited, by path below the folder.
fn edited(app: &App, edits: Vec<Edit>) -> Result<BTreeMap<String, String>, Refusal> {
    edits.into_iter().map(|Edit { file, text }| Ok((app.file(&file)?.name, text))).collect()
}

/// The path below the folder of a new file.
///
/// # Errors
/// The name is none, or its neighbour is not there.
pub(crate) fn new_name(app: &App, new: &str, beside: Option<&str>) -> Result<String, Refusal> {
    if !may_be_new(new) {
        return Err(Refusal::request(format!("`{}` is no name for a new file", kinecut::page::visible(new)))
            .help("one name with an ending that kinecut reads, for example part.toml"));
    }
    let neighbour = beside.map(|id| app.file(id)).transpose()?;
    let folder = neighbour.as_ref().map_or("", |file| split(&file.name).0);
    Ok(if folder.is_empty() { new.to_owned() } else { format!("{folder}/{new}") })
}

impl Texts {
    /// Identifier of the file.
    pub(crate) fn id(&self) -> String {
        id_of(&self.name)
    }

    /// The text of the file.
    ///
    /// # Errors
    /// Those of reading it.
    pub(crate) fn text(&self, app: &App) -> Found<String> {
        match &self.text {
            Some(text) => Ok(text.clone()),
            None => self.text_of(app, &self.name, FileKind::Text),
        }
    }

    /// The bytes of the file, a program.
    ///
    /// # Errors
    /// Those of reading it.
    pub(crate) fn program(&self, app: &App) -> Found<Vec<u8>> {
        match &self.text {
            Some(text) => Ok(text.clone().into_bytes()),
            None => app.folder.read(&self.name, FileKind::Program),
        }
    }

    /// The text of another file of the folder, as edited. Only programs and tables of a control need not be UTF-8.
    ///
    /// # Errors
    /// Those of reading it.
    pub(crate) fn text_of(&self, app: &App, name: &str, kind: FileKind) -> Found<String> {
        if let Some(text) = self.edits.get(name) {
            return Ok(text.clone());
        }
        let bytes = app.folder.read(name, kind)?;
        match kind {
            FileKind::Program => Ok(program_text(&bytes).0.into_owned()),
            _ => kinecut::base::read_text_stream(name, bytes.as_slice()),
        }
    }

    /// A loader for what a file of the folder names, through which edited texts are seen.
    pub(crate) fn over<'a>(&'a self, disk: &'a dyn kinecut::base::Loader, name: &str) -> OverlayLoader<'a> {
        let folder = split(name).0;
        let below = |path: &'a str| match folder {
            "" => Some(path),
            folder => path.strip_prefix(folder)?.strip_prefix('/'),
        };
        let own = self.text.iter().map(|text| (self.name.as_str(), text));
        let all = self.edits.iter().map(|(name, text)| (name.as_str(), text)).chain(own);
        let seen = all.filter_map(|(path, text)| Some((below(path)?, text)));
        seen.fold(OverlayLoader::new(disk), |loader, (path, text)| loader.with(path, text.as_bytes()))
    }
}
