//! The cutting data of a shop: rows of a file.

use crate::base::{Code, Finding, Loader, Result, Sources};
use crate::cutting::{EdgeMaterial, Material, StartCut};
use crate::job::file::{CuttingFileTable, CuttingRow, CuttingTool, EdgeName, JobFile, ToolTable};
use crate::job::forms::InMm;
use crate::job::places::{Places, parse};
use crate::job::read::decode;
use crate::operations::plain_name;

use super::start::{cut_of, largest};

/// Most rows of a file: more than a shop has.
const MOST_ROWS: usize = 100_000;

/// The rows of a shop's file, each with its line; none without a file.
#[derive(Clone, Debug, Default)]
pub(in crate::job) struct ShopTable {
    file: String,
    rows: Vec<(CuttingRow, u32)>,
}

/// A tool in a cut, as rows know it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut<'a> {
    pub(super) material: &'a str,
    pub(super) tool: &'a ToolTable,
    pub(super) cut: StartCut,
}

impl ShopTable {
    /// Reads the file that a job names; `places` are those of the job.
    ///
    /// # Errors
    /// Those of the loader, at the key of the job; `KC0101` to `KC0103` with their place in the file.
    pub(in crate::job) fn read(
        sources: &mut Sources,
        file: &JobFile,
        places: &Places,
        loader: &dyn Loader,
    ) -> Result<ShopTable> {
        let Some(name) = &file.cutting else { return Ok(ShopTable::default()) };
        let text = loader.read_text(name).map_err(|e| places.locate(sources, e.under("cutting")))?;
        let id = sources.add(name.clone(), text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned());
        let mut root = parse(sources, id, sources.text(id))?;
        let own = Places::of(id, &root);
        let in_mm = InMm::of::<CuttingFileTable>(&mut root);
        in_mm.put_into::<CuttingFileTable>(&mut root);
        let table: CuttingFileTable = decode(sources, id, root)?;
        if table.rows.len() > MOST_ROWS {
            let finding = Finding::error(Code::JOB_VALUE, "a file of cutting data has too many rows");
            let finding = finding.value(table.rows.len() as f64, "rows").bound(MOST_ROWS as f64, "rows");
            return Err(own.locate(sources, finding.key("cutting").into()));
        }
        let mut rows = Vec::with_capacity(table.rows.len());
        for (i, row) in table.rows.into_iter().enumerate() {
            let key = format!("cutting[{i}]");
            row.check().map_err(|e| own.locate(sources, e.under(&key)))?;
            // The place of a row is that of a finding about it.
            let at = own.locate(sources, Finding::error(Code::JOB_VALUE, "").key(key).into());
            rows.push((row, at.0.place.map_or(0, |place| place.line)));
        }
        Ok(ShopTable { file: name.clone(), rows })
    }

    /// The number of the first row that fits a cut and has it; with its file and line.
    pub(super) fn find(
        &self,
        cut: Cut<'_>,
        number: impl Fn(&CuttingRow) -> Option<f64>,
    ) -> Option<(f64, &str, u32)> {
        let fits = self.rows.iter().filter(|(row, _)| fits(row, cut));
        fits.filter_map(|(row, line)| Some((number(row)?, self.file.as_str(), *line))).next()
    }

    /// Whether there is a file.
    pub(super) fn name(&self) -> Option<&str> {
        (!self.file.is_empty()).then_some(self.file.as_str())
    }
}

/// Whether a row is for a cut.
fn fits(row: &CuttingRow, of: Cut<'_>) -> bool {
    /// Rounding of a diameter [mm], and of an angle [degrees].
    const SAME: f64 = 1e-6;
    let same = |material: &str| {
        plain_name(material) == plain_name(of.material)
            || Material::of(material).is_some_and(|m| Material::of(of.material) == Some(m))
    };
    let cut = cut_of(of.tool.kind, of.cut);
    let arc = match cut {
        StartCut::Side(arc) => arc.to_degrees(),
        _ => 180.0,
    };
    let edge = match row.tool_material {
        None => true,
        Some(EdgeName::Carbide) => of.tool.edge_material() == EdgeMaterial::Carbide,
        Some(EdgeName::Hss) => of.tool.edge_material() == EdgeMaterial::Hss,
    };
    let diameter = largest(of.tool);
    let wide = row.diameter.is_none_or(|[least, most]| diameter >= least - SAME && diameter <= most + SAME);
    // An angle counts for end mills alone.
    let engaged = row.tool != CuttingTool::EndMill || arc <= row.engagement.unwrap_or(180.0) + SAME;
    same(&row.material) && row.tool == tool_of(cut) && edge && wide && engaged
}

/// The kind of a tool by its cut.
fn tool_of(cut: StartCut) -> CuttingTool {
    match cut {
        StartCut::Slot | StartCut::Side(_) => CuttingTool::EndMill,
        StartCut::Face => CuttingTool::FaceMill,
        StartCut::Edge => CuttingTool::Chamfer,
        StartCut::ThreadMill => CuttingTool::ThreadMill,
        StartCut::Drill => CuttingTool::Drill,
        StartCut::Spot => CuttingTool::SpotDrill,
        StartCut::Ream => CuttingTool::Reamer,
        StartCut::Tap => CuttingTool::Tap,
    }
}
