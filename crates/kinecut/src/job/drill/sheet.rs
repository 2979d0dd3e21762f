//! The verb `kinecut drill`: an operation planned for itself, as a sheet of numbers for a person or another program.

use serde::Serialize;

use super::super::file::{BoxTable, OrientTable};
use super::super::file::{DrillTable, FaceTable, OperationTable, SetupTable, StockTable, SurfaceName};
use super::super::hole::{HoleTable, job_file, own_key};
use super::super::{Operation, check};
use super::holes::{PlannedHole, plan_each};
use crate::base::{Code, Error, Finding, Loader, Result};
use crate::drilling::{PaperCase, PaperResult, Zone, paper};
use crate::nc;

/// A planned drilling: one tool, one or many holes.
#[derive(Clone, Debug)]
pub struct DrillSheet {
    /// Title.
    pub title: String,
    /// What is done, in words.
    pub name: String,
    /// Diameter of the tool [mm].
    pub diameter: f64,
    /// Its point.
    pub point: crate::tool::DrillPoint,
    /// Places of the holes [mm].
    pub places: Vec<[f64; 2]>,
    /// The holes, each planned or the reason why it cannot be.
    pub holes: Vec<Result<PlannedHole>>,
    /// Control posted for.
    pub control: &'static str,
    /// The program, not simulated: blocks to look at.
    pub program: String,
}

/// Plans a drilling.
///
/// # Errors
/// Those of the job's checks and of a single hole, with the key in the operation's own table. What is wrong with one
/// hole of several stands in its place.
pub fn plan_drill_sheet(table: &HoleTable, loader: &dyn Loader) -> Result<DrillSheet> {
    let OperationTable::Drill(drill) = &table.operation else {
        return Err(Finding::error(Code::JOB_SHAPE, "this verb plans drilling only")
            .cure("write type = \"drill\", or use `kinecut hole`")
            .key("operation.type")
            .into());
    };
    let mut drill = drill.clone();
    if drill.points.is_none() && drill.pattern.is_none() {
        drill.points = Some(vec![[0.0, 0.0]]);
    }
    let (stock, mut setup) = around(table, &mut drill)?;
    setup.operations = vec![OperationTable::Drill(drill)];
    let job = check(&job_file(table, stock, setup), "DRILL", loader).map_err(own_key)?;
    let setup = &job.setups[0];
    let Some(Operation::Drill(drill)) = setup.operations.first() else {
        return Err(Finding::error(Code::JOB_SHAPE, "a drilling has one operation").into());
    };
    // The sheet has the cutting speed as it is given, the program whole revolutions.
    let mut exact = drill.clone();
    exact.milling.spindle = drill.exact_spindle;
    let mut holes = plan_each(&job, setup, &exact).map_err(|e| e.under("operation"))?;
    for hole in &mut holes {
        if let Err(e) = hole {
            *e = e.clone().under("operation");
        }
    }
    if let [Err(e)] = &holes[..] {
        return Err(e.clone());
    }
    let program = match super::super::plan(&job) {
        Ok(planned) => nc::write(&planned[0].program, &job.tools, &job.post)?.text,
        // No hole can be drilled: each says why.
        Err(_) => String::new(),
    };
    Ok(DrillSheet {
        title: job.title.clone(),
        name: drill.name(),
        diameter: drill.diameter(),
        point: drill.point,
        places: drill.holes.iter().map(|h| h.at).collect(),
        holes,
        control: job.post.control.name(),
        program,
    })
}

/// The stock and clamping around the hole: the part's mesh turned under the tool, or a block that nobody looks at.
fn around(table: &HoleTable, drill: &mut DrillTable) -> Result<(StockTable, SetupTable)> {
    let mut setup = SetupTable::of(table.operation.clone());
    if let Some(part) = &table.part {
        let way = glam::DVec3::from_array(part.direction.unwrap_or([0.0, 0.0, -1.0]));
        let Some(way) = way.try_normalize() else {
            return Err(Finding::error(Code::JOB_VALUE, "this is no direction").key("part.direction").into());
        };
        let z = -way;
        // Looking down along the drill, X stays as near to X as it can.
        let helper = if z.x.abs() < 0.9 { glam::DVec3::X } else { glam::DVec3::Y };
        let x = (helper - z * helper.dot(z)).try_normalize().unwrap_or(glam::DVec3::X);
        setup.zero = Some(part.at);
        if z != glam::DVec3::Z {
            setup.orient = Some(OrientTable { x: x.to_array(), z: z.to_array() });
        }
        return Ok((StockTable::Mesh(part.mesh.clone()), setup));
    }
    if drill.entry.is_none() && drill.body.is_none() {
        drill.entry = Some(FaceTable {
            surface: SurfaceName::Plane,
            radius: None,
            inclination: None,
            offset: None,
            at: None,
            direction: None,
        });
    }
    /// Larger than any hole, so that its height never matters [mm].
    const BLOCK: f64 = 5000.0;
    setup.safe_height = Some(2.0 * BLOCK);
    Ok((StockTable::Box(BoxTable { min: [-BLOCK; 3], max: [BLOCK; 3] }), setup))
}

impl PlannedHole {
    /// What the paper's own formulas give; `None` where it has none, or where the surfaces were found in a body.
    pub fn paper(&self) -> Option<PaperResult> {
        let [Some(entry), Some(exit)] = self.faces? else { return None };
        if self.spec.pre_hole.is_some() || !self.spec.bores.is_empty() {
            return None;
        }
        let crate::drilling::End::Through { overrun, .. } = self.spec.end else { return None };
        paper(&PaperCase {
            point: self.spec.point,
            diameter: self.spec.diameter,
            entry,
            exit,
            length: self.spec.length,
            approach: self.spec.approach,
            overrun,
            spindle: self.plan.spindle,
            feeds: self.plan.feeds,
        })
    }
}

/// A hole as JSON: lengths in mm, Z in the frame that its name says, speeds in rev/min, feeds in mm/rev, times in s.
#[derive(Debug, Serialize)]
struct HoleJson {
    number: usize,
    at: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Finding>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    plan: Option<PlanJson>,
}

#[derive(Debug, Serialize)]
struct PlanJson {
    zero: f64,
    lengths: LengthsJson,
    coordinates: CoordinatesJson,
    zones: Vec<ZoneJson>,
    spindle_speed: f64,
    time: f64,
    constant_feed: f64,
    constant_feed_time: f64,
    saved_time: f64,
    first_contact_radius: f64,
    last_contact_radius: f64,
    lip_eccentricity: Option<f64>,
    lip_difference: f64,
    findings: Vec<Finding>,
    #[serde(skip_serializing_if = "Option::is_none")]
    paper: Option<PaperJson>,
}

#[allow(non_snake_case, reason = "the paper's symbols are the names")]
#[derive(Debug, Serialize)]
struct LengthsJson {
    L_vr1: f64,
    L_vr2: f64,
    L_vyh1: f64,
    L_vyh2: Option<f64>,
    L_nvr: f64,
    L_kvyh: Option<f64>,
    L_vr: f64,
    L_ust: f64,
    L_vyh: Option<f64>,
    L_rx: f64,
}

#[allow(non_snake_case, reason = "the paper's symbols are the names")]
#[derive(Debug, Serialize)]
struct CoordinatesJson {
    Z_nvr1: f64,
    Z_nvr2: f64,
    Z_kvyh1: Option<f64>,
    Z_kvyh2: Option<f64>,
    Z_nvyh1: Option<f64>,
    Z_nvyh2: Option<f64>,
    Z_end: f64,
    best_zero_h: Option<f64>,
    best_zero_k: Option<f64>,
}

#[derive(Debug, Serialize)]
struct ZoneJson {
    stage: &'static str,
    from: f64,
    to: f64,
    from_exit_frame: f64,
    to_exit_frame: f64,
    feed: f64,
    revolutions: f64,
    time: f64,
}

#[allow(non_snake_case, reason = "the paper's symbols are the names")]
#[derive(Debug, Serialize)]
struct PaperJson {
    lengths: LengthsJson,
    coordinates: CoordinatesJson,
    times: [f64; 3],
    L_vr1_as_printed: Option<f64>,
    printed_lengths: std::collections::BTreeMap<&'static str, f64>,
    printed_times: [f64; 4],
}

#[derive(Debug, Serialize)]
struct SheetJson<'a> {
    title: &'a str,
    name: &'a str,
    point: &'static str,
    diameter: f64,
    control: &'static str,
    holes: Vec<HoleJson>,
    program: &'a str,
}

impl DrillSheet {
    /// The sheet as data for JSON; with what the paper's formulas give where asked for.
    pub fn json(&self, with_paper: bool) -> impl Serialize + '_ {
        let holes = self.holes.iter().zip(&self.places).enumerate();
        let holes = holes.map(|(number, (hole, at))| match hole {
            Ok(hole) => HoleJson { number, at: *at, error: None, plan: Some(plan_json(hole, with_paper)) },
            Err(e) => HoleJson { number, at: *at, error: Some((*e.0).clone()), plan: None },
        });
        SheetJson {
            title: &self.title,
            name: &self.name,
            point: self.point.name(),
            diameter: self.diameter,
            control: self.control,
            holes: holes.collect(),
            program: &self.program,
        }
    }

    /// The holes that cannot be drilled.
    pub fn errors(&self) -> impl Iterator<Item = &Error> {
        self.holes.iter().filter_map(|h| h.as_ref().err())
    }
}

fn plan_json(hole: &PlannedHole, with_paper: bool) -> PlanJson {
    let p = &hole.plan;
    PlanJson {
        zero: hole.zero,
        lengths: lengths(&p.lengths),
        coordinates: coordinates(&p.coordinates),
        zones: p.zones.iter().map(|z| zone(z, hole)).collect(),
        spindle_speed: p.spindle * 60.0 / std::f64::consts::TAU,
        time: p.time,
        constant_feed: p.feeds.least(),
        constant_feed_time: p.constant_time,
        saved_time: p.constant_time - p.time,
        first_contact_radius: p.entry.first_radius,
        last_contact_radius: p.entry.last_radius,
        lip_eccentricity: Some(p.balance.eccentricity).filter(|e| e.is_finite()),
        lip_difference: p.balance.difference,
        findings: p.findings.clone(),
        paper: if with_paper { hole.paper().map(|p| paper_json(&p)) } else { None },
    }
}

fn paper_json(p: &PaperResult) -> PaperJson {
    let names = crate::drilling::PRINTED_LENGTHS;
    PaperJson {
        lengths: lengths(&p.lengths),
        coordinates: coordinates(&p.coordinates),
        times: p.times,
        L_vr1_as_printed: p.point_as_printed,
        printed_lengths: names.into_iter().zip(p.printed.lengths).collect(),
        printed_times: p.printed.times,
    }
}

fn lengths(l: &crate::drilling::Lengths) -> LengthsJson {
    LengthsJson {
        L_vr1: l.point,
        L_vr2: l.entry_surface,
        L_vyh1: l.point,
        L_vyh2: l.exit_surface,
        L_nvr: l.to_entry,
        L_kvyh: l.to_exit,
        L_vr: l.entry,
        L_ust: l.steady,
        L_vyh: l.exit,
        L_rx: l.stroke,
    }
}

fn coordinates(c: &crate::drilling::Coordinates) -> CoordinatesJson {
    CoordinatesJson {
        Z_nvr1: c.entry[0],
        Z_nvr2: c.entry[1],
        Z_kvyh1: c.exit_own.map(|z| z[0]),
        Z_kvyh2: c.exit_own.map(|z| z[1]),
        Z_nvyh1: c.exit.map(|z| z[0]),
        Z_nvyh2: c.exit.map(|z| z[1]),
        Z_end: c.end,
        best_zero_h: c.best_zeros[0],
        best_zero_k: c.best_zeros[1],
    }
}

fn zone(z: &Zone, hole: &PlannedHole) -> ZoneJson {
    ZoneJson {
        stage: z.stage.word(),
        from: z.from,
        to: z.to,
        from_exit_frame: z.from + hole.spec.length,
        to_exit_frame: z.to + hole.spec.length,
        feed: z.feed,
        revolutions: z.revolutions(),
        time: z.time(hole.plan.spindle),
    }
}
