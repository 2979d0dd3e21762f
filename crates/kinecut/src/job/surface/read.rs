//! From the name of a surface or its file to its definition.

use glam::DVec3;

use crate::base::{Code, Error, Expression, Finding, Result, Sources};
use crate::job::file::{ChainEntry, NumberEntry, SurfaceTable};
use crate::job::read::{nearest, read_table};
use crate::machine::Elementary;
use crate::machine::surface::{Element, Surface, Variable, parse_chain};

/// A surface from the text of its file, TOML or JSON.
///
/// ```
/// use kinecut::job::surface::surface;
/// let text = "like = \"cone\"\nparameters = { R = 40 }\n";
/// assert_eq!(surface("c.toml", text).unwrap().code().to_string(), "6153");
/// ```
///
/// # Errors
/// `KC0101`, `KC0102` for a text that is no such file, `KC1101` to `KC1107` for a formula, a chain or the definition, each
/// with its place.
pub fn surface(name: &str, text: &str) -> Result<Surface> {
    let stem = name.rsplit(['/', '\\']).next().unwrap_or(name).split('.').next().unwrap_or(name).to_owned();
    if text.trim_start().starts_with('{') {
        let value: serde_json::Value = serde_json::from_str(text)
            .map_err(|e| Finding::error(Code::JOB_SYNTAX, format!("the text is no JSON: {e}")))?;
        let table: SurfaceTable = serde_path_to_error::deserialize(value).map_err(|e| {
            let message = e.inner().to_string();
            let cure = nearest(&message).unwrap_or_default();
            Error::from(Finding::error(Code::JOB_SHAPE, message).cure(cure).key(e.path().to_string()))
        })?;
        return of_table(&table, &stem);
    }
    let mut sources = Sources::default();
    let id = sources.add(name, text);
    read_table(&sources, id, |table: &SurfaceTable| of_table(table, &stem))
}

/// The surface of a name in the catalogue or, where there is a text, of a file of that name.
///
/// # Errors
/// As [`surface`]; `KC1107` for a name that the catalogue does not have.
pub fn load_surface(name: &str, text: Option<&str>) -> Result<Surface> {
    match text {
        Some(text) => surface(name, text),
        None => Surface::named(name),
    }
}

/// The surface with another value of a parameter that it has, a number or a formula of numbers.
///
/// # Errors
/// `KC1102` for a parameter that it does not have; `KC1101`, `KC0103` for a value that is none.
pub fn set_parameter(surface: Surface, name: &str, value: &str) -> Result<Surface> {
    if surface.parameter(name).is_none() {
        let known: Vec<&str> = surface.parameters.iter().map(|(n, _)| n.as_str()).collect();
        return Err(Finding::error(
            Code::EXPRESSION_NAME,
            format!("surface `{}` has no parameter `{name}`", surface.name),
        )
        .cure(format!("its parameters are {}", known.join(", ")))
        .into());
    }
    let value = number(&NumberEntry::Formula(value.to_owned()))?;
    Ok(surface.with(name, value))
}

fn of_table(t: &SurfaceTable, stem: &str) -> Result<Surface> {
    let mut surface = match &t.like {
        Some(like) => Surface::named(like).map_err(|e| e.under("like"))?,
        None => {
            for (key, given) in [
                ("variables", !t.variables.is_empty()),
                ("directrix", t.directrix.is_some()),
                ("generatrix", t.generatrix.is_some()),
            ] {
                if !given {
                    return Err(Finding::error(Code::JOB_SHAPE, format!("the surface has no {key}"))
                        .cure("give variables, directrix and generatrix, or like = \"cone\"")
                        .into());
                }
            }
            Surface {
                name: stem.to_owned(),
                title: String::new(),
                parameters: Vec::new(),
                variables: [Variable::new("", 0.0, 1.0), Variable::new("", 0.0, 1.0)],
                directrix: Vec::new(),
                generatrix: Vec::new(),
                inward: false,
                inclined: [None; 3],
                implicit: None,
            }
        }
    };
    if let Some(name) = &t.name {
        surface.name.clone_from(name);
    }
    if let Some(title) = &t.title {
        surface.title.clone_from(title);
    }
    if t.like.is_some() && (t.directrix.is_some() || t.generatrix.is_some()) {
        // Another chain is another surface, of which the formula of the catalogue says nothing.
        surface.implicit = None;
    }
    for (name, entry) in &t.parameters {
        let value = number(entry).map_err(|e| e.under(&format!("parameters.{name}")))?;
        surface = surface.with(name, value);
    }
    if !t.variables.is_empty() {
        let [u, v] = &t.variables[..] else {
            return Err(Finding::error(Code::JOB_SHAPE, "a surface has two free variables")
                .value(t.variables.len() as f64, "variables")
                .bound(2.0, "variables")
                .key("variables")
                .into());
        };
        let read = |i: usize, (name, from, to): &(String, NumberEntry, NumberEntry)| {
            let bound = |k: usize, entry| number(entry).map_err(|e| e.under(&format!("variables[{i}][{k}]")));
            Ok::<Variable, Error>(Variable::new(name, bound(1, from)?, bound(2, to)?))
        };
        surface.variables = [read(0, u)?, read(1, v)?];
    }
    if let Some(entry) = &t.directrix {
        surface.directrix = chain(entry).map_err(|e| e.under("directrix"))?;
    }
    if let Some(entry) = &t.generatrix {
        surface.generatrix = chain(entry).map_err(|e| e.under("generatrix"))?;
    }
    surface.inward = t.inward.unwrap_or(surface.inward);
    for (digit, direction) in &t.inclined {
        let key = format!("inclined.{digit}");
        let index = ["7", "8", "9"].iter().position(|d| d == digit).ok_or_else(|| {
            Finding::error(Code::JOB_SHAPE, format!("`{digit}` is no inclined motion"))
                .cure("inclined motions are 7, 8 and 9")
                .key(key.clone())
        })?;
        let direction = DVec3::from_array(*direction);
        if direction.try_normalize().is_none() {
            return Err(Finding::error(Code::JOB_VALUE, "this is no direction")
                .value(direction.length(), "")
                .bound(0.0, "")
                .key(key)
                .into());
        }
        surface.inclined[index] = Some(direction);
    }
    if let Some(text) = &t.implicit {
        surface.implicit = Some(Expression::parse(text).map_err(|e| e.under("implicit"))?);
    }
    surface.check()?;
    Ok(surface)
}

fn chain(entry: &ChainEntry) -> Result<Vec<Element>> {
    match entry {
        ChainEntry::Text(text) => parse_chain(text),
        ChainEntry::List(list) => list
            .iter()
            .enumerate()
            .map(|(i, (digit, law))| {
                let motion = Elementary::from_digit(*digit).ok_or_else(|| {
                    Finding::error(Code::SURFACE_TEXT, format!("{digit} is no motion"))
                        .cure("write digits from 1 to 9")
                        .key(format!("[{i}][0]"))
                })?;
                let law = match law {
                    NumberEntry::Number(v) => Expression::number(*v),
                    NumberEntry::Formula(text) => {
                        Expression::parse(text).map_err(|e| e.under(&format!("[{i}][1]")))?
                    }
                };
                Ok(Element::new(motion, law))
            })
            .collect(),
    }
}

/// A number, or the value of a formula without names.
pub(super) fn number(entry: &NumberEntry) -> Result<f64> {
    match entry {
        NumberEntry::Number(v) => Ok(*v),
        NumberEntry::Formula(text) => {
            let formula = Expression::parse(text)?;
            formula.constant().ok_or_else(|| {
                Finding::error(Code::JOB_VALUE, format!("`{text}` is not a formula of numbers"))
                    .cure(format!("it has the names {}", formula.names().join(", ")))
                    .into()
            })
        }
    }
}
