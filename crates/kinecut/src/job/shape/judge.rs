//! Deviations out of tolerance as findings, those within as claims, and what could not be measured as doubts.

use super::Deviation;
use super::design::RegionMeasure;
use super::wanted::Wanted;
use crate::base::{Code, Finding};
use crate::operations::Operation;
use crate::operations::measured::{BoreMeasure, FaceMeasure, Worst};
use crate::stock::FIXED_STEP;

/// Judges the walls and floors of bores; `wanted` and `measures` go together.
pub(super) fn bores(wanted: &[Wanted<'_>], measures: &[BoreMeasure], answer: &mut Deviation) {
    for (bore, m) in wanted.iter().zip(measures) {
        let tolerance = bore.operation.milling().tolerance;
        let name = bore.operation.name();
        let [gouged, left] = match bore.wall.slope() {
            Some(slope) => [("cut too deep", "low"), ("too narrow", "high")].map(|(how, face)| {
                let what = format!("the {} is {how}, or the face beside it too {face}", slope.noun());
                (what, "correct `top`, `width` or the tool")
            }),
            None => [
                ("the wanted surface is gouged".to_owned(), "correct diameter, depth or tool"),
                ("stock is left".to_owned(), "finish the wall, go deeper, or allow more"),
            ],
        };
        let sides =
            [(Code::WALL_GOUGED, gouged.0, &m.gouge, gouged.1), (Code::STOCK_LEFT, left.0, &m.left, left.1)];
        for (code, what, worst, help) in sides {
            answer.judge(code, &format!("{name}: {what}"), worst, tolerance, (help, Some(bore.number)));
        }
    }
    let pairs: Vec<_> = wanted.iter().zip(measures).collect();
    for group in pairs.chunk_by(|a, b| a.0.number == b.0.number) {
        let operation = group[0].0.operation;
        // What goes through has no floor.
        let is_blind = group.iter().any(|(bore, _)| bore.floor.is_some());
        let (what, lie) = match group[0].0.wall.slope() {
            Some(slope) if slope.ball.is_some() => ("the break", "lies"),
            Some(_) => ("the chamfer", "lies"),
            None if is_blind => ("wall and floor", "lie"),
            None => ("the wall", "lies"),
        };
        let worst = group.iter().map(|(_, m)| m.worst()).fold(0.0, f64::max);
        let ends: usize = group.iter().map(|(_, m)| m.ends).sum();
        if worst <= operation.milling().tolerance && ends > 0 {
            let claim = format!(
                "{}: {what} {lie} within {} \u{b5}m of the wanted surface at {ends} line ends",
                operation.name(),
                micrometres(worst)
            );
            answer.proven.push(claim);
        }
        let unmeasured = group.iter().filter(|(_, m)| m.ends == 0 && !m.replaced).count();
        if unmeasured > 0 {
            let of = if group.len() > 1 {
                let noun = if group[0].0.wall.slope().is_some() { "pieces" } else { "holes" };
                format!(" of {unmeasured} of its {} {noun}", group.len())
            } else {
                String::new()
            };
            answer.not_measured(&format!("{}: {what}{of}", operation.name()), group[0].0.number);
        }
    }
}

/// Judges the height of a milled face.
pub(super) fn face(operation: &Operation, m: &FaceMeasure, answer: &mut Deviation) {
    let (name, tolerance) = (operation.name(), operation.milling().tolerance);
    let sides = [
        (Code::WALL_GOUGED, "the face is cut too deep", &m.gouge, "correct `top`"),
        (
            Code::STOCK_LEFT,
            "stock is left on the face",
            &m.left,
            "correct the outline, or mill in more passes",
        ),
    ];
    for (code, what, worst, help) in sides {
        answer.judge(code, &format!("{name}: {what}"), worst, tolerance, (help, Some(m.operation)));
    }
    if m.ends == 0 {
        return answer.not_measured(&format!("{name}: the face"), m.operation);
    }
    let worst = m.gouge.depth.max(m.left.depth);
    if worst <= tolerance {
        let (um, ends) = (micrometres(worst), m.ends);
        answer
            .proven
            .push(format!("{name}: the face lies within {um} \u{b5}m of its plane at {ends} line ends"));
    }
}

/// Judges the part against a region of the design mesh, or against what lies in none; the whole mesh has none to be named.
/// `advice` is about tools that could take away what is left.
pub(super) fn design(m: &RegionMeasure, in_regions: bool, advice: Option<&str>, answer: &mut Deviation) {
    let help = "add the operations that are missing, or correct those that cut too deep";
    let of = match (in_regions, m.name.as_str()) {
        (false, _) => String::new(),
        (true, "") => "outside of all regions ".to_owned(),
        (true, name) => format!("at `{name}` "),
    };
    let what = format!("{of}the part is cut into the design");
    answer.judge(Code::WALL_GOUGED, &what, &m.gouge, m.gouge_limit, (help, None));
    // Another block than the worst one may have been the first.
    if let Some(first) = m.first.filter(|first| first.cut != m.gouge.cut) {
        let what = format!("{what} for the first time");
        answer.judge(Code::WALL_GOUGED, &what, &first, m.gouge_limit, (help, None));
    }
    let what = format!("{of}stock is left on the design");
    answer.judge(Code::STOCK_LEFT, &what, &m.left, m.rest_limit, (advice.unwrap_or(help), None));
    if m.is_within() && m.ends > 0 {
        let (um, ends) = (micrometres(m.gouge.depth.max(m.left.depth)), m.ends);
        answer
            .proven
            .push(format!("{of}the part lies within {um} \u{b5}m of the design mesh at {ends} line ends"));
    }
    if in_regions && !m.name.is_empty() && m.ends == 0 {
        let f = Finding::doubt(
            Code::NOT_MEASURED,
            format!(
                "region `{}` of the design could not be measured: no line of the stock ends near it",
                m.name
            ),
        )
        .help("lower simulate.step, or look whether the region lies on the part");
        answer.findings.push((f, 0, None));
    }
}

impl Deviation {
    /// Notes the worst deviation to one side, and a finding when it is out of tolerance, with its help and the operation that
    /// wanted the surface; without one it is the design's.
    fn judge(
        &mut self,
        code: Code,
        what: &str,
        worst: &Worst,
        tolerance: f64,
        (help, operation): (&str, Option<u32>),
    ) {
        if worst.depth > tolerance {
            let f = Finding::error(code, what)
                .value_mm((worst.depth * 1e5).round() / 1e5)
                .bound_mm(tolerance)
                .point(worst.point.to_array())
                .help(help);
            self.findings.push((f, worst.cut, operation));
        }
    }

    /// Notes that something wanted could not be measured.
    fn not_measured(&mut self, what: &str, operation: u32) {
        let f = Finding::doubt(
            Code::NOT_MEASURED,
            format!("{what} could not be measured: no line of the stock ends there"),
        )
        .help("lower simulate.step, or look whether the operation lies in the part");
        self.unmeasured.push((f, operation));
    }
}

/// Micrometres, in the digits that are known: the ends of lines are rounded to 10 nm.
fn micrometres(mm: f64) -> String {
    let least = FIXED_STEP;
    if mm <= least { format!("{}", least * 1e3) } else { format!("{:.1}", (mm * 1e4).ceil() / 10.0) }
}
