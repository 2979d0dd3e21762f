//! Face milling operations, checked: the outline read and placed, units, the bad exit angles.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::plan::{PlannedFace, plan_face};
use super::{FacingTable, PsiSide, top_outline};
use crate::base::bounded::{MAX_LENGTH, bounded, length, positive};
use crate::base::unit::in_degrees;
use crate::base::{Code, Finding, Loader, Result};
use crate::cutting::StartCut;
use crate::facing::{BadSet, FaceCase, Thresholds};
use crate::geom::{Outline, OutlineRead};
use crate::operations::kind::{self, Attempt};
use crate::operations::outlines::{Drawn, MeshPart, OutlineEntry};
use crate::operations::{
    Around, CalledTool, CuttingKeys, FeedKeys, Milling, Setting, StockOutline, milling_of, tool_of,
};
use crate::tool::Tool;

/// Milling of a face.
#[derive(Clone, Debug)]
pub struct FaceOperation {
    /// As written.
    pub table: FacingTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
    /// The outline in coordinates of the work offset, the cutter, the bad exit angles without guard.
    pub case: FaceCase,
    /// Rule for judging the exit angles, as a person reads it.
    pub rule: String,
    /// Feed [mm/s].
    pub feed: f64,
    /// Feed per revolution [mm].
    pub feed_per_revolution: f64,
    /// Guard [rad].
    pub guard: f64,
    /// Distance of the outline inside the cutter [mm].
    pub margin: f64,
    /// Heights of the levels, the finished plane last [mm].
    pub levels: Vec<f64>,
    /// Notes of the outline's reader.
    pub notes: Vec<String>,
}

impl kind::Checked for FaceOperation {
    type Plan = PlannedFace;

    const NOUN: &'static str = "face";

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn name(&self) -> String {
        let [min, max] = self.case.outline.bounds();
        let size = max - min;
        format!("face {} x {}", shown(size.x), shown(size.y))
    }

    fn is_left_hand(&self) -> bool {
        self.table.left_hand
    }

    /// Its first level would be deeper than planned.
    fn under_stock(&self, top: f64) -> Option<Finding> {
        /// Rounding of a height [mm].
        const ROUNDING: f64 = 1e-6;
        let height = top - self.table.top;
        (height > self.table.depth + ROUNDING).then(|| {
            Finding::warning(
                Code::FACE_ADVICE,
                format!("{}: the stock stands higher over the finished plane than `depth` says", self.name()),
            )
            .value_mm(height)
            .bound_mm(self.table.depth)
            .help(format!("set depth = {height}, with stepdown if that is too much at once"))
            .key("depth")
        })
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedFace>> {
        plan_face(self, setting)
    }
}

impl kind::Table for FacingTable {
    type Of = FaceOperation;

    fn check(&self, around: &Around<'_>) -> Result<FaceOperation> {
        operation(self, around.tools, around.stock, around.loader)
    }

    fn face(&self) -> Option<&FacingTable> {
        Some(self)
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        let feed = Some(FeedKeys { feed: &mut self.feed, per_tooth: &mut self.feed_per_tooth });
        Some(CuttingKeys {
            speed: &mut self.speed,
            cutting_speed: &mut self.cutting_speed,
            feed,
            per_rev: None,
            cut: StartCut::Face,
        })
    }

    fn file(&self) -> Option<(&'static str, &str)> {
        match &self.outline {
            OutlineEntry::Name(name) if name != "top" => Some(("outline", name)),
            _ => None,
        }
    }
}

/// A length to the hundredth, without zeros at its end.
fn shown(mm: f64) -> String {
    crate::page::trimmed(mm, 2)
}

/// Most levels of one operation.
const MOST_LEVELS: f64 = 1000.0;

fn operation(
    t: &FacingTable,
    tools: &[Tool],
    stock: &StockOutline<'_>,
    loader: &dyn Loader,
) -> Result<FaceOperation> {
    let tool = tool_of(&t.tool, tools)?;
    let Some(radius) = tool.cutter.flat_radius() else {
        return Err(Finding::error(Code::JOB_REFERENCE, format!("{} mills no flat face", tool.number))
            .help("use a face mill or an end mill")
            .key("tool")
            .into());
    };
    let depth = positive("depth", t.depth, MAX_LENGTH, "mm")?;
    length("top", t.top, -MAX_LENGTH, MAX_LENGTH)?;
    let levels = levels(t, depth)?;
    let spindle = spindle(t, radius)?;
    let (feed, feed_per_revolution) = feed(t, spindle, tool.teeth)?;
    let OutlineRead { outline, weights, notes, .. } = outline(t, stock, loader)?;
    let last = levels.len().checked_sub(2).map_or(depth, |i| levels[i] - t.top);
    let (bad, rule) = bad_set(t, last)?;
    let weights = weights_of(t, &outline, &weights)?;
    let case = FaceCase::new(outline, radius, bad)?.with_weights(weights).map_err(|e| e.under("weights"))?;
    let margin = length("margin", t.margin.unwrap_or(0.02 * radius), 0.0, radius)?;
    let guard = bounded("guard", t.guard.unwrap_or(2.0), 0.0, 45.0, "deg")?.to_radians();
    length("clearance", t.clearance.unwrap_or(5.0), 0.0, 1000.0)?;
    length("off_centre", t.off_centre, 0.0, radius)?;
    for (i, [from, to]) in t.forbidden.iter().enumerate() {
        for (end, value) in [("[0]", from), ("[1]", to)] {
            bounded(&format!("forbidden[{i}]{end}"), *value, -360.0, 360.0, "deg")?;
        }
        if to - from > 360.0 {
            return Err(Finding::error(Code::JOB_VALUE, "a forbidden interval spans a turn at most")
                .value(to - from, "deg")
                .bound(360.0, "deg")
                .key(format!("forbidden[{i}]"))
                .into());
        }
        if to <= from {
            return Err(Finding::error(
                Code::JOB_VALUE,
                "the end of a forbidden interval must exceed its begin",
            )
            .value(*to, "deg")
            .bound(*from, "deg")
            .key(format!("forbidden[{i}]"))
            .into());
        }
    }
    if let Some([from, to]) = t.engagement {
        bounded("engagement[0]", from, -90.0, 90.0, "deg")?;
        bounded("engagement[1]", to, -90.0, 90.0, "deg")?;
        if to <= from {
            return Err(Finding::error(Code::JOB_VALUE, "the end of the engagement must exceed its begin")
                .value(to, "deg")
                .bound(from, "deg")
                .key("engagement")
                .into());
        }
    }
    Ok(FaceOperation {
        milling: milling_of(tool, spindle, t.coolant, t.tolerance)?,
        case,
        rule,
        feed,
        feed_per_revolution,
        guard,
        margin,
        levels,
        notes,
        table: t.clone(),
    })
}

fn levels(t: &FacingTable, depth: f64) -> Result<Vec<f64>> {
    let step = positive("stepdown", t.stepdown.unwrap_or(depth), MAX_LENGTH, "mm")?;
    // A level more for a thousandth of a step would be rounding.
    let count = (depth / step - 1e-3).ceil().max(1.0);
    if count > MOST_LEVELS {
        return Err(Finding::error(Code::JOB_VALUE, "the axial step makes too many levels")
            .value(count, "levels")
            .bound(MOST_LEVELS, "levels")
            .key("stepdown")
            .into());
    }
    Ok((1..=count as u32).map(|i| t.top + depth * (1.0 - f64::from(i) / count)).collect())
}

fn spindle(t: &FacingTable, radius: f64) -> Result<f64> {
    match (t.speed, t.cutting_speed) {
        (Some(_), Some(_)) => {
            Err(Finding::error(Code::JOB_SHAPE, "`speed` and `cutting_speed` exclude each other")
                .help("give one of them")
                .key("speed")
                .into())
        }
        (Some(speed), None) => Ok(positive("speed", speed, 200_000.0, "rev/min")? * TAU / 60.0),
        (None, Some(v)) => {
            let rate = positive("cutting_speed", v, 10_000.0, "m/min")? * 1000.0 / 60.0 / radius;
            let rpm = (rate / TAU * 60.0).round();
            Ok(if rpm >= 1.0 { rpm * TAU / 60.0 } else { rate })
        }
        (None, None) => Err(Finding::error(Code::JOB_SHAPE, "face milling needs a speed")
            .help("give cutting_speed = 120 (m/min) or speed = 3800 (rev/min)")
            .into()),
    }
}

/// Feed [mm/s] and per revolution [mm].
fn feed(t: &FacingTable, spindle: f64, teeth: u32) -> Result<(f64, f64)> {
    let per_second = spindle / TAU;
    match (t.feed, t.feed_per_tooth) {
        (Some(_), Some(_)) => {
            Err(Finding::error(Code::JOB_SHAPE, "`feed` and `feed_per_tooth` exclude each other")
                .help("give one of them")
                .key("feed")
                .into())
        }
        (Some(feed), None) => {
            let feed = positive("feed", feed, 1e6, "mm/min")? / 60.0;
            Ok((feed, feed / per_second))
        }
        (None, Some(fz)) => {
            let fz = positive("feed_per_tooth", fz, 100.0, "mm")?;
            let per_revolution = fz * f64::from(teeth);
            Ok((per_revolution * per_second, per_revolution))
        }
        (None, None) => Err(Finding::error(Code::JOB_SHAPE, "face milling needs a feed")
            .help("give feed_per_tooth = 0.05 (mm) or feed = 600 (mm/min)")
            .into()),
    }
}

fn outline(t: &FacingTable, stock: &StockOutline<'_>, loader: &dyn Loader) -> Result<OutlineRead> {
    match &t.outline {
        OutlineEntry::Name(name) if name == "top" => {
            let outline = top_outline(stock, t.top).map_err(|e| e.under("outline"))?;
            // It lies where the stock lies.
            let weights = vec![1.0; outline.edges().len()];
            Ok(OutlineRead { outline, weights, notes: Vec::new(), edge: None })
        }
        outline => {
            let (unit, layers) = (t.unit, t.layers.as_deref());
            let part = t.section.map(MeshPart::Material);
            Drawn { outline, unit, layers, snap: t.snap, part, at: t.at, angle: t.angle }.read(loader)
        }
    }
}

/// The bad exit angles and the rule as a person reads it.
fn bad_set(t: &FacingTable, depth: f64) -> Result<(BadSet, String)> {
    let given = [t.exit_angle_min.is_some(), t.thresholds.is_some(), t.bad.is_some()];
    if given.iter().filter(|g| **g).count() > 1 {
        return Err(Finding::error(
            Code::JOB_SHAPE,
            "`exit_angle_min`, `thresholds` and `bad` exclude each other",
        )
        .help("say in one way which exit angles are bad")
        .key("exit_angle_min")
        .into());
    }
    let (set, what) = if let Some(bad) = &t.bad {
        let set = BadSet::new(bad.clone()).map_err(|e| e.under("bad"))?;
        let list = bad
            .iter()
            .map(|b| format!("{} to {} degrees (weight {})", in_degrees(b.from), in_degrees(b.to), b.weight));
        (set, list.collect::<Vec<_>>().join(", "))
    } else {
        let (key, threshold) = match (t.exit_angle_min, &t.thresholds) {
            (Some(angle), _) => ("exit_angle_min", angle.to_radians()),
            (None, Some(points)) => {
                let points = points.iter().map(|&[d, a]| [d, a.to_radians()]).collect();
                ("thresholds", Thresholds::new(points).map_err(|e| e.under("thresholds"))?.at(depth))
            }
            (None, None) => ("exit_angle_min", Thresholds::default().at(depth)),
        };
        let set = BadSet::below(threshold).map_err(|e| e.under(key))?;
        let from = if t.exit_angle_min.is_some() { "given" } else { "from the table of thresholds" };
        let degrees = shown(threshold.to_degrees());
        (set, format!("above 0 and below {degrees} degrees ({from}, last level {} mm deep)", shown(depth)))
    };
    Ok(match t.psi_side {
        PsiSide::Paper => (
            set,
            format!(
                "an exit is bad where the angle from the edge (material on its right) to the tooth's velocity lies {what}"
            ),
        ),
        PsiSide::Supplement => (
            set.supplement(),
            format!(
                "an exit is bad where 180 degrees minus the angle from the edge (material on its right) to the tooth's velocity lies {what}"
            ),
        ),
    })
}

/// Weights by label, where the job gives them; otherwise those of the outline's own file.
fn weights_of(t: &FacingTable, outline: &Outline, own: &[f64]) -> Result<Vec<f64>> {
    for label in t.weights.keys() {
        if !outline.labels().contains(label) {
            let known = outline.labels().iter().map(|l| format!("`{l}`")).collect::<Vec<_>>();
            let help = match known.is_empty() {
                true => "the outline has no labels: leave out `weights`".to_owned(),
                false => format!("the outline has {}", known.join(", ")),
            };
            return Err(Finding::error(
                Code::JOB_REFERENCE,
                format!("no edge has the label `{}`", label.escape_default()),
            )
            .help(help)
            .key("weights")
            .into());
        }
    }
    let weight = |edge: usize| {
        let given = outline.label(edge).and_then(|l| t.weights.get(l)).copied();
        given.unwrap_or_else(|| own.get(edge).copied().unwrap_or(1.0))
    };
    Ok((0..outline.edges().len()).map(weight).collect())
}
