//! From a file to the contour of a tool.

use crate::base::unit::variant_key;
use crate::base::{Code, Error, FileKind, Finding, Loader, Location, Result, Sources};
use crate::geom::OutlineOptions;
use crate::job::file::ContourTable;
use crate::job::read::read_table;
use crate::job::unknown::nearest;
use crate::tool::{Assembly, ContourFile, ContourRead};

/// The tool of a table: shape, shank and holder as one contour; drawings are read by the loader.
///
/// ```
/// use kinecut::base::MemoryLoader;
/// use kinecut::job::contour::load_contour;
/// let text = "shape.ball-nose = { diameter = 10, flute_length = 20 }\nstickout = 40\n";
/// let files = MemoryLoader::default().with("tool.toml", text);
/// let tool = load_contour("tool.toml", &files).unwrap().contour;
/// assert_eq!((tool.height(), tool.largest_radius(), tool.elements().len()), (40.0, 5.0, 4));
/// ```
///
/// # Errors
/// `KC0701` and `KC0704` with the key of what makes no tool; those of the files.
pub fn contour_of(table: &ContourTable, loader: &dyn Loader) -> Result<ContourRead> {
    let of_shape = |e: Error| e.under(&format!("shape.{}", variant_key(&table.shape)));
    let ContourRead { contour: cutting, notes } = table.shape.read(loader).map_err(of_shape)?;
    let end = cutting.height();
    let stickout = table.stickout.unwrap_or(end);
    // Radius at which the face of the upper end begins [mm].
    let upper = cutting.elements().last().map_or(0.0, |e| e.shape.start().x);
    let assembly = Assembly {
        cutting,
        shank_diameter: Some(table.shank_diameter.unwrap_or(2.0 * upper)),
        stickout,
        holder: table.holder.clone(),
    };
    Ok(ContourRead { contour: assembly.contour()?, notes })
}

/// The tool of a file: a table as TOML or JSON, the elements of a contour as JSON, or half a section as DXF, SVG or outline
/// in JSON, with the tool's axis along Y.
///
/// # Errors
/// `KC0001` when the file cannot be read; `KC0101`, `KC0102` for a text that is not a table of a contour; else as
/// [`contour_of`].
pub fn load_contour(name: &str, loader: &dyn Loader) -> Result<ContourRead> {
    let ending = name.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase()).unwrap_or_default();
    match ending.as_str() {
        "toml" => {
            let text = loader.read_text(name)?;
            let mut sources = Sources::default();
            let id = sources.add(name, text.as_str());
            read_table(&sources, id, |table: &ContourTable| contour_of(table, loader))
        }
        "json" => json(name, &loader.read_text_as(name, FileKind::Drawing)?, loader),
        _ => ContourRead::of_drawing(
            name,
            &loader.read_as(name, FileKind::Drawing)?,
            &OutlineOptions::default(),
        ),
    }
}

fn json(name: &str, text: &str, loader: &dyn Loader) -> Result<ContourRead> {
    let in_file = |mut e: Error| {
        e.0.place.get_or_insert_with(|| Location::whole_file(name));
        e
    };
    let value: serde_json::Value = serde_json::from_str(text)
        .map_err(|e| in_file(Finding::error(Code::JOB_SYNTAX, format!("the text is no JSON: {e}")).into()))?;
    if value.get("loops").is_some() {
        return ContourRead::of_drawing(name, text.as_bytes(), &OutlineOptions::default());
    }
    let misshapen = |e: serde_path_to_error::Error<serde_json::Error>| {
        let message = e.inner().to_string();
        let help = nearest(&message).unwrap_or_default();
        in_file(Finding::error(Code::JOB_SHAPE, message).help(help).key(e.path().to_string()).into())
    };
    if value.get("elements").is_some() {
        let file: ContourFile = serde_path_to_error::deserialize(value).map_err(misshapen)?;
        let contour = file.contour().map_err(in_file)?;
        return Ok(ContourRead { contour, notes: Vec::new() });
    }
    let table: ContourTable = serde_path_to_error::deserialize(value).map_err(misshapen)?;
    contour_of(&table, loader).map_err(in_file)
}
