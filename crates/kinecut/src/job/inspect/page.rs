//! Sections, points and distances in the report.

use super::{CutBy, Facing, InspectedPoint, Inspection, LEAST_BEND, Measure, PartSection, Place, Stretch};
use crate::page::{Block, Cell, Drawing, Look, Row, Section, Table, fixed, trimmed};

/// Decimals of lengths: micrometres, finer than the tolerance of any usual mesh.
const DECIMALS: usize = 3;

/// The section of the report.
pub(super) fn shown(inspection: &Inspection) -> Section {
    let about = format!(
        "From the mesh of the part: distances are within {} mm where it bends with a radius of {} mm or more, and a web or \
         slot thinner than {} mm, the distance of the lines, may be missing.",
        fixed(inspection.within, DECIMALS),
        trimmed(LEAST_BEND * inspection.step, 6),
        trimmed(inspection.step, 6),
    );
    let mut section = Section::new("Sections, points and distances").with(Block::Text(about));
    for plane in &inspection.sections {
        add_section(&mut section, plane);
    }
    for point in &inspection.points {
        section = section.with(table(point));
    }
    for measure in &inspection.measures {
        section = section.with(stretches(measure));
    }
    section
}

fn add_section(section: &mut Section, plane: &PartSection) {
    let name = format!("Section at {}", plane.plane);
    let Some(file) = &plane.file else {
        section.blocks.push(Block::Text(format!("{name}: the plane does not meet the part.")));
        return;
    };
    let [right, up] = plane.plane.seen().map(|i| ["X", "Y", "Z"][i]);
    // As many decimals as the bound has a say in, which is rounded up.
    let decimals = (-plane.area_bound.log10().floor()).clamp(0.0, 6.0) as usize;
    let unit = 10f64.powi(decimals as i32);
    let [area, bound] = [plane.area, (plane.area_bound * unit).ceil() / unit].map(|v| fixed(v, decimals));
    let mut table = Table::new(
        format!("{name}: {area} \u{b1} {bound} mm\u{b2} of material, picture {file}"),
        &format!(
            "Outline; Area [mm\u{b2}]; Length [mm]; {right} from [mm]; {right} to [mm]; {up} from [mm]; {up} to [mm]"
        ),
    );
    /// Most outlines listed; the rest is counted.
    const LISTED: usize = 20;
    table.rows.extend(plane.outlines.iter().take(LISTED).map(|o| {
        let mut cells = vec![Cell::new(if o.hole { "hole" } else { "outer" })];
        cells.extend([(o.area, decimals), (o.length, DECIMALS)].map(|(v, n)| Cell::new(fixed(v, n))));
        for i in plane.plane.seen() {
            cells.extend([o.low[i], o.high[i]].map(|v| Cell::new(fixed(v, DECIMALS))));
        }
        Row::new(cells)
    }));
    if let Some(more) = plane.outlines.len().checked_sub(LISTED).filter(|more| *more > 0) {
        table = table.note(format!("and {more} smaller ones, all of them in inspection.json"));
    }
    section.blocks.push(table.into());
    let points = || plane.outlines.iter().flat_map(|o| &o.points);
    let bound = |i: usize, pick: fn(f64, f64) -> f64| points().map(|p| p[i]).reduce(pick).unwrap_or(0.0);
    let (low, high) = ([bound(0, f64::min), bound(1, f64::min)], [bound(0, f64::max), bound(1, f64::max)]);
    let room = 0.03 * (high[0] - low[0]).max(high[1] - low[1]);
    let window = [low.map(|v| v - room), high.map(|v| v + room)];
    let mut drawing = Drawing::new(format!("{name}, {right} to the right, {up} upwards"), window);
    drawing.hatched = plane.outlines.iter().map(|o| o.points.clone()).collect();
    for outline in &plane.outlines {
        let ring = outline.points.iter().chain(outline.points.first()).copied().collect();
        drawing.line(Look::Edge, ring);
    }
    section.blocks.push(drawing.into());
}

fn table(point: &InspectedPoint) -> Table {
    let at = point.at.map(|v| trimmed(v, 6)).join(", ");
    let place = match point.place {
        Place::Material => "in the material",
        Place::Outside => "outside of the material",
        Place::Surface => "on the surface, as far as the mesh can tell",
    };
    let mut table =
        Table::new(format!("Point {at}: {place}"), "Surface; Distance [mm]; X [mm]; Y [mm]; Z [mm]; Cut by");
    table.rows = point.surfaces.iter().map(row).collect();
    if point.surfaces.is_empty() {
        table = table.note("There is no surface: nothing is left of the part.");
    }
    if point.place == Place::Material {
        let along = |axis: &str| {
            let towards = |way: &str| {
                let name = format!("{way}{axis}");
                point.surfaces.iter().find(|s| s.towards == name).map(|s| s.distance)
            };
            Some(format!("{axis} {} mm", fixed(towards("-")? + towards("+")?, DECIMALS)))
        };
        let thick: Vec<String> = ["X", "Y", "Z"].into_iter().filter_map(along).collect();
        table = table.note(format!("Thickness of the material through the point: {}.", thick.join(", ")));
    }
    table
}

fn row(surface: &Facing) -> Row {
    let mut cells = vec![Cell::new(surface.towards), Cell::new(fixed(surface.distance, DECIMALS))];
    cells.extend(surface.at.map(|v| Cell::new(fixed(v, DECIMALS))));
    made_by(cells, Some(&surface.cut_by))
}

/// Material and voids between two points.
fn stretches(measure: &Measure) -> Table {
    let [from, to] = [measure.from, measure.to].map(|p| p.map(|v| trimmed(v, 6)).join(", "));
    let mut table = Table::new(
        format!("From {from} to {to}: {} mm", fixed(measure.distance, DECIMALS)),
        "Between; Length [mm]; Within [mm]; To X [mm]; To Y [mm]; To Z [mm]; Cut by",
    );
    let row = |s: &Stretch| {
        // Rounded up: never kinder than it is.
        let unit = 10f64.powi(DECIMALS as i32);
        let within = s.within.map_or("unknown".to_owned(), |w| fixed((w * unit).ceil() / unit, DECIMALS));
        let between = if s.material { "material" } else { "void" };
        let mut cells = vec![Cell::new(between), Cell::new(fixed(s.length, DECIMALS)), Cell::new(within)];
        cells.extend(s.end.map(|v| Cell::new(fixed(v, DECIMALS))));
        made_by(cells, s.cut_by.as_ref())
    };
    table.rows = measure.stretches.iter().map(row).collect();
    table
}

/// A row that ends with the maker of a surface; without one with a dash.
fn made_by(mut cells: Vec<Cell>, maker: Option<&CutBy>) -> Row {
    let (by, block) = match maker {
        None => ("-".to_owned(), None),
        Some(CutBy::RawStock) => ("raw stock".to_owned(), None),
        Some(CutBy::NoMove) => ("a hole of the stock, or a core taken out".to_owned(), None),
        Some(CutBy::Line { program, line, of_all }) => {
            (format!("{program} line {line}"), Some((*of_all, *line)))
        }
    };
    cells.push(Cell::new(by));
    let mut row = Row::new(cells);
    row.block = block.map(|(of_all, _)| of_all);
    row.line = block.map(|(_, line)| line);
    row
}
