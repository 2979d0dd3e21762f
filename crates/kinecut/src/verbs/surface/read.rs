//! From the name of a surface or its file to its definition.

use crate::base::{Code, Error, Finding, Result, Sources};
use crate::job::read::read_table;
use crate::job::unknown::nearest;
use crate::machine::formula::Expression;
use crate::machine::surface::{GeneratedSurface, SurfaceFile};

/// A surface from the text of its file, TOML or JSON. Without a name it is called as its file.
///
/// ```
/// use kinecut::verbs::surface::surface;
/// let text = "like = \"cone\"\nparameters = { R = 40 }\n";
/// assert_eq!(surface("c.toml", text).unwrap().code().to_string(), "6153");
/// ```
///
/// # Errors
/// `KC0101`, `KC0102` for a text that is not a surface file; those of [`SurfaceFile::surface`] with their place in the
/// text.
pub fn surface(name: &str, text: &str) -> Result<GeneratedSurface> {
    let stem = name.rsplit(['/', '\\']).next().unwrap_or(name).split('.').next().unwrap_or(name);
    let read = |file: &SurfaceFile| {
        let mut file = file.clone();
        if file.name.is_none() && file.like.is_none() && !stem.is_empty() && stem != "-" {
            file.name = Some(stem.to_owned());
        }
        file.surface()
    };
    if text.trim_start().starts_with('{') {
        let value: serde_json::Value = serde_json::from_str(text)
            .map_err(|e| Finding::error(Code::JOB_SYNTAX, format!("the text is no JSON: {e}")))?;
        let file: SurfaceFile = serde_path_to_error::deserialize(value).map_err(|e| {
            let message = e.inner().to_string();
            let help = nearest(&message).unwrap_or_default();
            Error::from(Finding::error(Code::JOB_SHAPE, message).help(help).key(e.path().to_string()))
        })?;
        return read(&file);
    }
    let mut sources = Sources::default();
    let id = sources.add(name, text);
    read_table(&sources, id, read)
}

/// The surface of a name in the catalogue or, where there is a text, of a file of that name.
///
/// # Errors
/// As [`surface`]; `KC1107` for a name that the catalogue does not have.
pub fn load_surface(name: &str, text: Option<&str>) -> Result<GeneratedSurface> {
    match text {
        Some(text) => surface(name, text),
        None => GeneratedSurface::named(name),
    }
}

/// The surface with another value of a parameter that it has, a number or a formula of numbers.
///
/// # Errors
/// `KC1102` for a parameter that it does not have; `KC1101`, `KC0103` for an invalid value.
pub fn set_parameter(surface: GeneratedSurface, name: &str, value: &str) -> Result<GeneratedSurface> {
    if surface.parameter(name).is_none() {
        let known: Vec<&str> = surface.parameters.iter().map(|(n, _)| n.as_str()).collect();
        return Err(Finding::error(
            Code::EXPRESSION_NAME,
            format!("surface `{}` has no parameter `{name}`", surface.name),
        )
        .help(format!("its parameters are {}", known.join(", ")))
        .key(name)
        .into());
    }
    let number = || Expression::parse(value)?.bind(&[]).map(|law| law.value(&[]));
    let value = number().map_err(|mut e| {
        e.0.key = Some(name.to_owned());
        e
    })?;
    if !value.is_finite() {
        return Err(Finding::error(Code::JOB_VALUE, format!("the value of `{name}` is not finite"))
            .value(value, "")
            .help("give a number, or a formula of numbers")
            .key(name)
            .into());
    }
    Ok(surface.with(name, value))
}
