//! Tools that could take away stock that is left on the design: those of the job, and smaller ones.
//!
//! Of the ends of lines with more stock than allowed some are looked at, evenly over all of them. At each of them a tool is
//! brought to the design as near as the limit allows, from each direction from which the programs cut; it comes there if no
//! part of it meets the design. Clamps, the machine and the way to the place are not looked at.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::design::OfDesign;
use crate::base::Result;
use crate::contact::{Access, Body, MovingTool, ToolPart};
use crate::geom::{MeshDistance, Profile, Rigid, Solid};
use crate::job::SetupOutcome;
use crate::job::check::{Design, Job};
use crate::job::contacts::fixtures::moving;
use crate::stock::{EndMap, TriDexel};
use crate::sweep::ToolMotion;
use crate::tool::{Tool, ToolNumber};
use crate::trace::SegmentPace;

/// Most places.
const PLACES: usize = 300;
/// Most directions.
const DIRECTIONS: usize = 12;
/// Directions that count as one [parts of a unit vector].
const SAME: f64 = 100.0;
/// Least stock that may be left for this [mm]: bodies that are nearer touch.
const NEAREST: f64 = 0.025;
/// Diameters of the smaller tools [mm], the largest first.
const SIZES: [f64; 13] = [32.0, 25.0, 20.0, 16.0, 12.0, 10.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0];

/// Tools that come to the places at which too much stock is left on the design.
#[derive(Clone, Debug, PartialEq)]
pub struct RestReach {
    /// Ends of lines with more stock than their limit.
    pub ends: usize,
    /// Those that were looked at.
    pub places: usize,
    /// Directions of the tool axis from which the programs cut [part coordinates].
    pub directions: Vec<DVec3>,
    /// Directions that are left out because there are too many.
    pub other_directions: usize,
    /// The milling tools of the job.
    pub tools: Vec<ToolReach>,
    /// Cutters of whole diameters, as long as they need to be, the largest first.
    pub sizes: Vec<SizeReach>,
}

/// Places that a milling tool of the job comes to.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolReach {
    /// Its number.
    pub tool: ToolNumber,
    /// Places that it comes to.
    pub free: usize,
    /// Places that only its cutting part comes to: shank or holder would meet the part.
    pub too_short: usize,
}

/// Places that a cutter of a diameter comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizeReach {
    /// Diameter [mm].
    pub diameter: f64,
    /// Places that an end mill comes to.
    pub end_mill: usize,
    /// Places that a ball nose comes to.
    pub ball_nose: usize,
}

impl RestReach {
    /// A tool that would take most of it away, in words.
    pub(super) fn advice(&self) -> String {
        let part = |count: usize| self.part(count);
        let mut parts = Vec::new();
        let best = self.tools.iter().max_by(|a, b| a.free.cmp(&b.free).then(b.tool.cmp(&a.tool)));
        let known = best.map_or(0, |best| best.free);
        match best.filter(|best| best.free > 0) {
            Some(best) => parts.push(format!(
                "{} comes to {} of {} places where too much is left",
                best.tool,
                part(known),
                self.places
            )),
            None => parts.push("no milling tool of the job comes there".to_owned()),
        }
        let short = self.tools.iter().max_by(|a, b| a.too_short.cmp(&b.too_short).then(b.tool.cmp(&a.tool)));
        if let Some(short) = short.filter(|short| short.too_short > known) {
            parts.push(format!("{} is too short at {}", short.tool, part(short.too_short)));
        }
        if let Some(last) = self.sizes.last() {
            let flat = last.end_mill >= last.ball_nose;
            let count = |size: &SizeReach| if flat { size.end_mill } else { size.ball_nose };
            // The largest that does nearly as well as the smallest.
            let size = self.sizes.iter().find(|size| 10 * count(size) >= 9 * count(last)).unwrap_or(last);
            let kind = if flat { "an end mill" } else { "a ball nose" };
            match count(size) {
                0 => parts.push(format!(
                    "an end mill or ball nose of {} mm neither, from where the programs cut",
                    last.diameter
                )),
                most if most > known => {
                    parts.push(format!("{kind} of {} mm would come to {}", size.diameter, part(most)));
                }
                _ => {}
            }
        }
        parts.join("; ")
    }

    /// A number of places as a part of them, not more than it is: "84 %".
    pub(in crate::job) fn part(&self, count: usize) -> String {
        match 100 * count / self.places.max(1) {
            0 if count > 0 => "under 1 %".to_owned(),
            percent => format!("{percent} %"),
        }
    }
}

/// A place near the design, with the normal of the surface.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: DVec3,
    normal: DVec3,
    /// A tool may be off as much [mm]: together with the distance from the design as much as may be left.
    off: f64,
}

/// The tools that come to the ends with too much stock; none if there are none, or if the programs cut from no direction.
pub(super) fn reach(
    (job, design): (&Job, &Design),
    setups: &[SetupOutcome],
    stock: &TriDexel,
    ends: &EndMap<OfDesign>,
) -> Result<Option<RestReach>> {
    let (count, places) = places(design, stock, ends)?;
    let (directions, other_directions) = directions(setups);
    if places.is_empty() || directions.is_empty() {
        return Ok(None);
    }
    let body = Body::new("design", &Solid::Mesh(design.mesh.clone()), Rigid::IDENTITY, 0.0)?;
    let access = |tool: &MovingTool, place: &Place| {
        let of = |axis: &DVec3| tool.access(place.at, place.normal, *axis, place.off, &body);
        let mut best = Access::Closed;
        for axis in &directions {
            best = best.min(of(axis));
            if best == Access::Free {
                break;
            }
        }
        best
    };
    let mills: Vec<&Tool> = job.tools.iter().filter(|tool| tool.cutter.mills_walls()).collect();
    let tools = mills.iter().map(|tool| moving(tool)).collect::<Result<Vec<_>>>()?;
    // Long enough for any place.
    let height = design.mesh.bounds().size().length() + SIZES[0];
    let ideal = |ball: bool| -> Result<Vec<MovingTool>> {
        let cutter = |diameter: &f64| {
            let corner = if ball { 0.5 * diameter } else { 0.0 };
            let profile = Profile::bull_nose(*diameter, corner, height)?;
            Ok(MovingTool::new([(ToolPart::Cutter, &profile, 0.0)]))
        };
        SIZES.iter().map(cutter).collect()
    };
    let kinds = [ideal(false)?, ideal(true)?];
    let at = |place: &Place| -> (Vec<Access>, [usize; 2]) {
        let own = tools.iter().map(|tool| access(tool, place)).collect();
        // A smaller one comes wherever a larger one does.
        let first = |kind: &Vec<MovingTool>| {
            let mut range = (0, kind.len());
            while range.0 < range.1 {
                let middle = (range.0 + range.1) / 2;
                match access(&kind[middle], place) {
                    Access::Free => range.1 = middle,
                    _ => range.0 = middle + 1,
                }
            }
            range.0
        };
        (own, [first(&kinds[0]), first(&kinds[1])])
    };
    let found: Vec<(Vec<Access>, [usize; 2])> = places.par_iter().map(at).collect();
    let tools = mills.iter().enumerate().map(|(i, tool)| {
        let count = |is: fn(&Access) -> bool| found.iter().filter(|(own, _)| is(&own[i])).count();
        ToolReach {
            tool: tool.number,
            free: count(|a| *a == Access::Free),
            too_short: count(|a| matches!(a, Access::Hindered(_))),
        }
    });
    let sizes = SIZES.iter().enumerate().map(|(i, diameter)| {
        let count = |kind: usize| found.iter().filter(|(_, first)| first[kind] <= i).count();
        SizeReach { diameter: *diameter, end_mill: count(0), ball_nose: count(1) }
    });
    Ok(Some(RestReach {
        ends: count,
        places: places.len(),
        tools: tools.collect(),
        sizes: sizes.collect(),
        directions,
        other_directions,
    }))
}

/// The number of ends with more stock than allowed, and places at some of them.
fn places(design: &Design, stock: &TriDexel, ends: &EndMap<OfDesign>) -> Result<(usize, Vec<Place>)> {
    let mut count = 0;
    ends.visit(stock, |_, _, of| count += usize::from(of.is_left(design).is_some()));
    if count == 0 {
        return Ok((0, Vec::new()));
    }
    let distance = MeshDistance::new(&design.mesh)?;
    let (mut places, mut passed) = (Vec::new(), 0);
    ends.visit(stock, |p, _, of| {
        let Some(limit) = of.is_left(design) else { return };
        passed += 1;
        // Evenly: one each time the share of those that have passed is more than that of those taken.
        if passed * PLACES < (places.len() + 1) * count.max(PLACES) {
            return;
        }
        let nearest = distance.nearest(p).filter(|n| n.distance > 0.0);
        if let Some((n, normal)) = nearest.and_then(|n| Some((n, (p - n.point).try_normalize()?))) {
            let off = 0.5 * limit.max(NEAREST);
            places.push(Place { at: n.point + off * normal, normal, off });
        }
    });
    Ok((count, places))
}

/// Directions of the tool axis in which the programs cut, far from one another, and the number of others.
fn directions(setups: &[SetupOutcome]) -> (Vec<DVec3>, usize) {
    let mut all: BTreeMap<[i32; 3], DVec3> = BTreeMap::new();
    let mut note = |axis: DVec3| {
        if axis.is_finite() {
            all.entry((axis * SAME).round().to_array().map(|x| x as i32)).or_insert(axis);
        }
    };
    for segment in setups.iter().flat_map(|done| &done.trace.segments) {
        if !matches!(segment.motion, SegmentPace::Feed(_)) || segment.alternative {
            continue;
        }
        if segment.turning.is_none() {
            note(segment.axis);
        } else if let Ok(motion) = ToolMotion::of_segment(segment) {
            [0.0, 0.5, 1.0].into_iter().for_each(|t| note(motion.pose(t).rotation.z_axis));
        }
    }
    let all: Vec<DVec3> = all.into_values().collect();
    // Each time the one that is farthest from all before it.
    let mut apart = vec![f64::INFINITY; all.len()];
    let mut taken: Vec<DVec3> = Vec::new();
    while taken.len() < DIRECTIONS.min(all.len()) {
        let next = (1..all.len()).fold(0, |best, i| if apart[i] > apart[best] { i } else { best });
        taken.push(all[next]);
        for (apart, direction) in apart.iter_mut().zip(&all) {
            *apart = apart.min(direction.distance(all[next]));
        }
    }
    let others = all.len() - taken.len();
    (taken, others)
}
