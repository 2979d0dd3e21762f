//! Ways down into pockets, and pockets of which a larger cutter has cleared most: posted for each control, their text judged by its
//! own points, without the planner.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, dvec2};
use kinecut::base::{Code, Finding, MemoryLoader, Silent};
use kinecut::geom::{NearestEdge, Outline};
use kinecut::job::{Outcome, plan_json, report, run};
use kinecut::tool::ToolNumber;
use kinecut::trace::SegmentPace;

const CONTROLS: [&str; 5] = ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"];

pub(super) fn job(control: &str, operations: &str) -> String {
    let tool = |number: u32, diameter: f64, more: &str| {
        format!(
            "[[tool]]\nnumber = {number}\ntype = \"end-mill\"\ndiameter = {diameter}\nteeth = 4\nflute_length = 26\n\
             stickout = 40\ngauge_length = 120\n{more}\n"
        )
    };
    let no_centre = "centre_cutting = false\nmax_ramp_angle = 2";
    format!(
        "format = 1\npost = {{ control = \"{control}\" }}\n\
         stock = {{ box = {{ min = [-60, -45, -20], max = [60, 45, 0] }} }}\nsimulate = {{ step = 0.5 }}\n{}{}{}\
         [[setup]]\noffset = \"G54\"\n{operations}",
        tool(1, 10.0, ""),
        tool(2, 10.0, no_centre),
        tool(3, 4.0, ""),
    )
}

/// Speeds and feeds by which the moves of a text are known: passes and laps, down, links [mm/min].
const FEEDS: &str = "speed = 6000\nfeed = 1200\nplunge_feed = 500\nlink_feed = 2000\n";

pub(super) fn pocket(tool: u32, keys: &str) -> String {
    format!("[[setup.operation]]\ntype = \"pocket\"\ntool = {tool}\n{FEEDS}{keys}\n")
}

fn done(control: &str, operations: &str) -> Outcome {
    run("job.toml", &job(control, operations), &MemoryLoader::default(), &Silent)
        .unwrap_or_else(|e| panic!("{control}: {e}"))
}

fn refused(operations: &str) -> Finding {
    *run("job.toml", &job("fanuc", operations), &MemoryLoader::default(), &Silent).map(|_| ()).unwrap_err().0
}

/// All that cutters have swept at a floor, by points of their ways.
#[derive(Default)]
pub(super) struct Swept {
    cells: HashMap<[i64; 2], Vec<(DVec2, f64)>>,
}

/// Width of a cell, at least the radius of any cutter [mm].
const CELL: f64 = 5.0;

impl Swept {
    fn cell(p: DVec2) -> [i64; 2] {
        [(p.x / CELL).floor() as i64, (p.y / CELL).floor() as i64]
    }

    fn add(&mut self, p: DVec2, radius: f64) {
        self.cells.entry(Swept::cell(p)).or_default().push((p, radius));
    }

    pub(super) fn holds(&self, p: DVec2) -> bool {
        let [x, y] = Swept::cell(p);
        (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y])).any(|cell| {
            // Thinner than two micrometres is no chip.
            self.cells.get(&cell).is_some_and(|all| all.iter().any(|(q, r)| q.distance(p) < r + 0.002))
        })
    }
}

/// Findings about the text of a tool at a floor.
#[derive(Debug, Default)]
pub(super) struct Judged {
    /// Largest engagement at the feed of passes, at that of the way down, and at that of links [deg].
    pub(super) pass: f64,
    pub(super) down: f64,
    pub(super) link: f64,
    /// Least distance of the cutter's edge from the wall, negative in it [mm].
    pub(super) room: f64,
    /// Length at the feed of passes [mm].
    length: f64,
}

/// Follows the text at a floor; what other tools have swept before counts as swept.
pub(super) fn judge(outcome: &Outcome, outline: &Outline, floor: f64, tool: u32) -> (Judged, Swept) {
    let near = NearestEdge::new(outline.edges());
    let mut swept = Swept::default();
    let mut found = Judged { room: f64::INFINITY, ..Judged::default() };
    let mut looks = 0_usize;
    for segment in outcome.setups[0].trace.segments.iter().filter(|s| !s.alternative) {
        let radius = if segment.tool == Some(ToolNumber(3)) { 2.0 } else { 5.0 };
        let is_its = segment.tool == Some(ToolNumber(tool));
        let SegmentPace::Feed(feed) = segment.motion else { continue };
        let feed = feed * 60.0;
        let length = segment.curve.length();
        let count = (length / 0.02).ceil().max(1.0) as usize;
        for k in 0..=count {
            let jet = segment.curve.at(length * k as f64 / count as f64);
            let at = jet.p.truncate();
            if jet.p.z < -1e-3 {
                let room = -near.at(at, f64::INFINITY).expect("an edge").distance - radius;
                found.room = found.room.min(room);
            }
            // Links run a little higher.
            if jet.p.z > floor + 0.2 + 1e-6 {
                continue;
            }
            looks += 1;
            if let Some(along) =
                jet.d1.truncate().try_normalize().filter(|_| is_its && looks.is_multiple_of(53))
            {
                const STEPS: u32 = 720;
                let is_cut = |k: &u32| {
                    let angle = -FRAC_PI_2 + PI * (f64::from(*k) + 0.5) / f64::from(STEPS);
                    !swept.holds(at + radius * (1.0 - 1e-6) * DVec2::from_angle(angle).rotate(along))
                };
                let engaged = 180.0 * f64::from((0..STEPS).filter(is_cut).count() as u32) / f64::from(STEPS);
                let on_floor = jet.p.z < floor + 1e-6;
                match feed.round() as u32 {
                    1200 if on_floor => found.pass = found.pass.max(engaged),
                    500 => found.down = found.down.max(engaged),
                    1200 | 2000 => found.link = found.link.max(engaged),
                    // Of a finish.
                    _ => {}
                }
            }
            if jet.p.z < floor + 1e-6 {
                swept.add(at, radius);
                found.length +=
                    if is_its && (feed - 1200.0).abs() < 1.0 { length / count as f64 } else { 0.0 };
            }
        }
    }
    (found, swept)
}

pub(super) fn json(outcome: &Outcome, number: usize) -> serde_json::Value {
    let plan: serde_json::Value = serde_json::from_str(&plan_json(outcome)).unwrap();
    plan["setups"][0]["pockets"][number].clone()
}

#[test]
fn a_strip_is_entered_by_a_ramp_on_every_control() {
    for control in CONTROLS {
        let keys = "rectangle = { at = [3, 2], size = [60, 12], angle = 20 }\ndepth = 5\nstepdown = 3\nfinish = { allowance = 0.1, feed = 900 }";
        let outcome = done(control, &pocket(2, keys));
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        // Sharp corners stay, and nothing else is found.
        assert!(
            outcome.verdict.found.iter().all(|f| f.code == Code::CORNERS_STAY),
            "{:?}",
            outcome.verdict.found
        );
        assert!(outcome.deviation.bores[0].worst() < 1e-3, "{control}: {:?}", outcome.deviation.bores[0]);
        let plan = json(&outcome, 0);
        assert_eq!((&plan["entries"], &plan["ramps"], &plan["plunges"]), (&1.into(), &1.into(), &0.into()));
        assert_eq!(plan["entry_engagement"].as_f64().map(f64::round), Some(180.0));
        assert!(plan["largest_engagement"].as_f64().is_some_and(|e| e < 60.1), "{plan}");
        let strip =
            Outline::polygon(&[dvec2(-30.0, -6.0), dvec2(30.0, -6.0), dvec2(30.0, 6.0), dvec2(-30.0, 6.0)])
                .unwrap()
                .moved(20.0_f64.to_radians(), dvec2(3.0, 2.0));
        for floor in [-2.5, -5.0] {
            let (found, _) = judge(&outcome, &strip, floor, 2);
            assert!(found.pass < 61.0 && found.link < 16.0, "{control}: {found:?}");
            assert!(found.down > 170.0 && found.length > 50.0, "{control}: {found:?}");
            assert!(found.room > -0.0015, "{control}: {found:?}");
        }
        // No steeper than the cutter may.
        let steepest = outcome.setups[0].trace.segments.iter().filter_map(|s| {
            let along = s.curve.at(0.5 * s.curve.length()).d1;
            (along.z < -1e-9 && along.truncate().length() > 1e-3)
                .then(|| along.z.abs() / along.truncate().length())
        });
        let steepest = steepest.fold(0.0, f64::max);
        assert!(steepest < 2.0_f64.to_radians().tan() * 1.001, "{control}: {steepest}");
    }
}

#[test]
fn a_way_down_that_is_asked_for_is_taken_or_refused() {
    let wide = "rectangle = { size = [60, 40], corner = 6 }\ndepth = 4";
    for (way, plunges) in [("ramp", 0), ("plunge", 1)] {
        let outcome =
            done("fanuc", &pocket(1, &format!("{wide}\nentry = {{ way = \"{way}\", helix = 2.5 }}")));
        assert!(outcome.verdict.is_safe(), "{way}: {:?}", outcome.verdict.found);
        assert!(outcome.deviation.bores[0].worst() < 1e-3, "{way}");
        let plan = json(&outcome, 0);
        assert_eq!((&plan["ramps"], &plan["plunges"]), (&(1 - plunges).into(), &plunges.into()), "{way}");
        let page = format!("{:?}", report::of_job(&outcome).sections);
        let words = if plunges == 1 { "1 way straight down" } else { "1 ramp of 2.5" };
        assert!(page.contains(words) && page.contains("engagement 180\u{b0} seen from above"), "{way}");
    }
    let strip = "rectangle = { size = [60, 12] }\ndepth = 4";
    let found = refused(&pocket(2, &format!("{strip}\nentry = {{ way = \"plunge\" }}")));
    assert_eq!(found.code, Code::ENTRY_IMPOSSIBLE);
    assert!(found.key.as_deref().is_some_and(|key| key.ends_with("entry.way")), "{found:?}");
    let found = refused(&pocket(2, &format!("{strip}\nentry = {{ helix = 2.5 }}")));
    assert_eq!(found.code, Code::PLAN_VALUE, "{found:?}");
    let slot = format!(
        "[[setup.operation]]\ntype = \"slot\"\ntool = 1\n{FEEDS}line = [[-20, 0], [20, 0]]\nwidth = 14\ndepth = 3\n\
         entry = {{ way = \"ramp\" }}\n"
    );
    assert!(refused(&slot).message.contains("follows from its width"));
}

const BASIN: &str =
    "name = \"basin\"\nrectangle = { at = [2, 1], size = [60, 40], corner = 2.5, angle = 15 }\ndepth = 5";

#[test]
fn a_second_cutter_clears_what_the_first_has_left_on_every_control() {
    let (x, y, r) = (30.0 - 2.5, 20.0 - 2.5, 2.5);
    let corner = |k: i32, x: f64, y: f64| {
        kinecut::geom::OutlineEdge::arc(dvec2(x, y), r, f64::from(k) * FRAC_PI_2, FRAC_PI_2)
    };
    let arcs = [corner(0, x, y), corner(1, -x, y), corner(2, -x, -y), corner(3, x, -y)];
    let edges = (0..4)
        .flat_map(|k| [arcs[k], kinecut::geom::OutlineEdge::line(arcs[k].end, arcs[(k + 1) % 4].start)])
        .collect();
    let outline =
        Outline::new(vec![edges], Vec::new()).unwrap().moved(15.0_f64.to_radians(), dvec2(2.0, 1.0));
    for control in CONTROLS {
        let second = pocket(
            3,
            "rest = \"basin\"\ndepth = 5\nengagement = 50\nfinish = { allowance = 0.1, feed = 900 }",
        );
        let outcome = done(control, &format!("{}{second}", pocket(1, BASIN)));
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        // The corners of the first one are no finding where the second clears them, and it leaves none.
        assert!(outcome.verdict.found.is_empty(), "{control}: {:?}", outcome.verdict.found);
        let walls = &outcome.deviation.bores;
        assert!(walls.len() == 2 && walls.iter().all(|w| w.worst() < 1e-3), "{control}: {walls:?}");
        let plan = json(&outcome, 1);
        assert_eq!((&plan["rest"]["places"], &plan["entries"]), (&4.into(), &0.into()), "{control}: {plan}");
        let (judged, swept) = judge(&outcome, &outline, -5.0, 3);
        assert!(judged.pass < 51.0 && judged.pass > 15.0, "{control}: {judged:?}");
        assert!(judged.link < 20.0 && judged.room > -0.0015, "{control}: {judged:?}");
        // All of the pocket is swept.
        let near = NearestEdge::new(outline.edges());
        let [low, high] = outline.bounds();
        let (mut all, mut left) = (0, 0);
        for i in 0..700 {
            for j in 0..600 {
                let p = low + 0.1 * dvec2(f64::from(i), f64::from(j)) + dvec2(0.03, 0.07);
                if p.x < high.x
                    && p.y < high.y
                    && near.at(p, f64::INFINITY).expect("an edge").distance < -0.005
                {
                    all += 1;
                    left += usize::from(!swept.holds(p));
                }
            }
        }
        assert!(all > 200_000 && left == 0, "{control}: {left} of {all}");
        // By far less than a whole pocket with the small cutter.
        let whole = json(&outcome, 0)["area"].as_f64().unwrap() / 2.0;
        assert!(plan["cutting_length"].as_f64().unwrap() < 0.15 * whole, "{control}: {plan}");
    }
}

#[test]
fn a_rest_is_refused_where_the_pocket_before_does_not_hold() {
    let second = |keys: &str| format!("{}{}", pocket(1, BASIN), pocket(3, keys));
    for (operations, key, words) in [
        (
            second("rest = \"bassin\"\ndepth = 5"),
            "rest",
            "no pocket before it in the setup has the name `bassin`",
        ),
        (second("rest = \"basin\"\ndepth = 5\ncircle = { diameter = 30 }"), "rest", "takes the outline"),
        (second("rest = \"basin\"\ndepth = 6"), "depth", "is less deep"),
        (second("rest = \"basin\"\ntop = 1\ndepth = 5"), "top", "begins lower"),
        (
            format!("{}{}", pocket(3, BASIN), pocket(1, "rest = \"basin\"\ndepth = 5")),
            "tool",
            "is not smaller",
        ),
        (
            format!("{}{}", pocket(3, "rest = \"basin\"\ndepth = 5"), pocket(1, BASIN)),
            "rest",
            "no pocket before it",
        ),
    ] {
        let found = refused(&operations);
        assert_eq!(found.code, Code::JOB_REFERENCE, "{found:?}");
        let at = found.key.clone().unwrap_or_default();
        assert!(at.ends_with(key) && found.message.contains(words), "{key}: {found:?}");
    }
}
