//! The proof of the feed zones of drilling: in the stock, a point comes into engagement, is engaged fully, breaks
//! through and leaves at the heights that the golden numbers say, within a grid step.
//!
//! The parts are closed meshes built here; the stock is their tri-dexel model; nothing of the layer that computes the
//! zones is used.

use std::f64::consts::PI;

use glam::DVec3;
use kinecut::base::{Code, Silent};
use kinecut::geom::{EdgeProfile, Line, Mesh};
use kinecut::job::{Job, Outcome, Simulation, simulate};
use kinecut::operations::measured::{Loose, Probe};
use kinecut::stock::cut::CutAxis;
use kinecut::stock::{Engaged, PointEngagement, TriDexel, point_engagement};
use kinecut::tool::{Cutter, DrillPoint};
use kinecut::trace::Trace;
use serde_json::Value;

use crate::common::{golden, job};

/// Grid step of the stock [mm].
const STEP: f64 = 0.25;
/// What facets of the mesh and the six decimals of the golden numbers may take away [mm].
const FACETS: f64 = 0.004;

/// A surface over the disc: its height at a way u from the tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Surface {
    Plane {
        rise: f64,
        x: f64,
    },
    /// +1 for the upper side of a cylinder about the frame's origin, -1 for the lower one.
    Round {
        radius: f64,
        x: f64,
        side: f64,
    },
}

impl Surface {
    fn height(self, u: f64) -> f64 {
        match self {
            Surface::Plane { rise, x } => (x + u) * rise,
            Surface::Round { radius, x, side } => side * (radius * radius - (x + u) * (x + u)).sqrt(),
        }
    }

    /// Of an entry or exit of the golden file.
    fn of(v: &Value, entry: bool) -> Surface {
        let n = |key: &str| v[key].as_f64().unwrap();
        let side = if entry { 1.0 } else { -1.0 };
        match v["kind"].as_str().unwrap() {
            "plane" => Surface::Plane { rise: n("alpha_deg").to_radians().tan(), x: n("x") },
            "cyl_outer" => Surface::Round { radius: n("RS"), x: n("x"), side },
            "cyl_inner" => Surface::Round { radius: n("RS"), x: n("x"), side: -side },
            other => panic!("{other}"),
        }
    }
}

/// The point of a golden drill and its diameter.
fn drill(v: &Value) -> (DrillPoint, f64) {
    let n = |key: &str| v[key].as_f64().unwrap();
    let angle = |key: &str| n(key).to_radians();
    let point = match v["type"].as_str().unwrap() {
        "twist_single" => DrillPoint::SinglePlane { angle: angle("two_phi") },
        "twist_double" => DrillPoint::DoubleGround { angle: angle("two_phi"), second: angle("two_phi1") },
        "twist_rounded" => DrillPoint::Rounded { radius: n("rho") },
        "web_slotted" => DrillPoint::SlottedChisel { angle: angle("two_phi"), slot: n("l") },
        "annular" => DrillPoint::Annular { core: n("d_core") },
        "insert_flat" => DrillPoint::Flat,
        "cannon" => DrillPoint::Cannon { overlap: n("e"), edge_angle: angle("alpha") },
        "gun" => DrillPoint::Gun {
            apex: Some(n("b")),
            outer_angle: angle("alpha_o"),
            inner_angle: angle("alpha_i"),
        },
        other => panic!("{other}"),
    };
    (point, n("D"))
}

/// The body between an entry surface, which changes along X, and an exit surface `down` below it, which changes along
/// Y: a turn of one against the other changes nothing.
fn part(entry: Surface, exit: Surface, down: f64, half: f64) -> Mesh {
    /// Cells along an edge: 0.33 mm wide, on a cylinder of 30 mm at 18 mm off its axis 1 um of sagitta.
    const CELLS: u32 = 64;
    let at = |i: u32| half * (2.0 * f64::from(i) / f64::from(CELLS) - 1.0);
    let n = CELLS + 1;
    let points = || (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let over = points().map(|(i, j)| DVec3::new(at(i), at(j), entry.height(at(i))));
    let below = points().map(|(i, j)| DVec3::new(at(i), at(j), exit.height(at(j)) - down));
    let vertices = over.chain(below).collect();
    let mut triangles = Vec::new();
    let mut quad = |a: u32, b: u32, c: u32, d: u32| triangles.extend([[a, b, c], [a, c, d]]);
    let (top, under) = (|i: u32, j: u32| j * n + i, |i: u32, j: u32| n * n + j * n + i);
    for j in 0..CELLS {
        for i in 0..CELLS {
            quad(top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1));
            quad(under(i, j), under(i, j + 1), under(i + 1, j + 1), under(i + 1, j));
        }
        quad(under(j, 0), under(j + 1, 0), top(j + 1, 0), top(j, 0));
        quad(under(j + 1, CELLS), under(j, CELLS), top(j, CELLS), top(j + 1, CELLS));
        quad(under(0, j + 1), under(0, j), top(0, j), top(0, j + 1));
        quad(under(CELLS, j), under(CELLS, j + 1), top(CELLS, j + 1), top(CELLS, j));
    }
    Mesh { vertices, triangles }
}

fn measured(entry: Surface, exit: Surface, down: f64, edge: &EdgeProfile) -> PointEngagement {
    let mesh = part(entry, exit, down, edge.outer_radius() + 0.5);
    let stock = TriDexel::from_mesh(&mesh, STEP).unwrap();
    point_engagement(&stock, edge, DVec3::ZERO, CutAxis::PlusZ)
}

/// First contact, full engagement, break-through and end.
fn borders(engagement: &PointEngagement) -> [f64; 4] {
    use Engaged::{Fully, Partly};
    let stages = engagement.stages();
    let kinds: Vec<Engaged> = stages.iter().map(|s| s.engaged).filter(|e| *e == Fully).collect();
    assert_eq!(kinds, [Fully]);
    let full = stages.iter().find(|s| s.engaged == Fully).unwrap();
    assert!(stages.iter().all(|s| s.engaged == Fully || s.engaged == Partly));
    [engagement.first().unwrap(), full.from, full.to, engagement.last().unwrap()]
}

/// The columns see no more than there is, and miss less than a step; returns the largest miss.
fn compare(found: &[f64], exact: &[f64], inward: &[f64], what: &str) -> f64 {
    let mut worst: f64 = 0.0;
    for ((found, exact), inward) in found.iter().zip(exact).zip(inward) {
        let miss = (exact - found) * inward;
        assert!(miss > -FACETS && miss < STEP, "{what}: {found} against {exact}");
        worst = worst.max(miss);
    }
    worst
}

/// A golden number.
fn exact(case: &Value, key: &str) -> f64 {
    case["exact"][key].as_f64().unwrap()
}

fn input(case: &Value, key: &str) -> f64 {
    case["inputs"][key].as_f64().unwrap()
}

/// First contact and full engagement in the frame of the entry.
fn run_in(case: &Value) -> [f64; 2] {
    [exact(case, "Z_nvr1") - input(case, "Lpod"), exact(case, "Z_nvr2")]
}

/// Break-through and end in the frame of the exit.
fn run_out(case: &Value) -> [f64; 2] {
    [exact(case, "Z_kvyh1"), exact(case, "Z_kvyh2") + input(case, "Lper")]
}

/// One of the seven surfaces with its two heights.
type Known = (Surface, [f64; 2]);

#[test]
fn all_49_pairs_engage_where_the_golden_numbers_say() {
    let golden = golden::file("drilling");
    let cases = golden["cases"].as_array().unwrap();
    let combos: Vec<&Value> =
        cases.iter().filter(|c| c["id"].as_str().unwrap().starts_with("combo_")).collect();
    let (mut entries, mut exits): (Vec<Known>, Vec<Known>) = (Vec::new(), Vec::new());
    for case in &combos {
        for (list, surface, heights) in [
            (&mut entries, Surface::of(&case["inputs"]["entry"], true), run_in(case)),
            (&mut exits, Surface::of(&case["inputs"]["exit"], false), run_out(case)),
        ] {
            match list.iter().find(|known| known.0 == surface) {
                // An end does not depend on the other one.
                Some(known) => assert_eq!(known.1, heights),
                None => list.push((surface, heights)),
            }
        }
    }
    assert_eq!((entries.len(), exits.len()), (7, 7));
    let (point, diameter) = drill(&combos[0]["inputs"]["drill"]);
    let edge = point.edge(diameter).unwrap();
    let down = input(combos[0], "L");
    let mut worst: f64 = 0.0;
    for (entry, run_in) in &entries {
        for (exit, run_out) in &exits {
            let found = borders(&measured(*entry, *exit, down, &edge));
            let exact = [run_in[0], run_in[1], run_out[0] - down, run_out[1] - down];
            worst =
                worst.max(compare(&found, &exact, &[1.0, -1.0, 1.0, -1.0], &format!("{entry:?} {exit:?}")));
        }
    }
    println!("largest miss {worst:.4} mm at a step of {STEP} mm");
}

#[test]
fn other_points_engage_where_the_golden_numbers_say() {
    let golden = golden::file("drilling");
    let cases = golden["cases"].as_array().unwrap();
    for id in [
        "fig7_worked_example",
        "drill_02_twist_double_inner_x_inner_x",
        "drill_04_twist_rounded_incl_outer_x",
        "drill_06_web_slotted_inner_x_inner_x",
        "drill_07_annular_plane",
        "drill_07_annular_incl_outer_x",
        "drill_08_cannon_incl_outer_x",
        "drill_09_gun_incl_outer_x",
        "flat_insert_incl",
        "steep_plane_25_cone140",
        "valley_tight_bore",
    ] {
        let case = cases.iter().find(|c| c["id"] == id).unwrap_or_else(|| panic!("{id}"));
        let inputs = &case["inputs"];
        let (point, diameter) = drill(&inputs["drill"]);
        let (entry, exit) = (Surface::of(&inputs["entry"], true), Surface::of(&inputs["exit"], false));
        let down = input(case, "L");
        let found = borders(&measured(entry, exit, down, &point.edge(diameter).unwrap()));
        let (run_in, run_out) = (run_in(case), run_out(case).map(|z| z - down));
        compare(&found, &[run_in[0], run_in[1], run_out[0], run_out[1]], &[1.0, -1.0, 1.0, -1.0], id);
    }
}

#[test]
fn a_thin_inclined_wall_is_never_full() {
    let golden = golden::file("drilling");
    let case = golden["cases"].as_array().unwrap().iter().find(|c| c["id"] == "thin_wall_overlap").unwrap();
    let inputs = &case["inputs"];
    let (point, diameter) = drill(&inputs["drill"]);
    let (entry, exit) = (Surface::of(&inputs["entry"], true), Surface::of(&inputs["exit"], false));
    // Both faces rise along X: an exit turned by a quarter would cut through the entry.
    let down = input(case, "L");
    let (half, edge) = (diameter / 2.0 + 0.5, point.edge(diameter).unwrap());
    let mut mesh = part(entry, entry, 0.0, half);
    let n = mesh.vertices.len() / 2;
    for i in 0..n {
        let v = mesh.vertices[i];
        mesh.vertices[n + i] = v.with_z(exit.height(v.x) - down);
    }
    let stock = TriDexel::from_mesh(&mesh, STEP).unwrap();
    let engagement = point_engagement(&stock, &edge, DVec3::ZERO, CutAxis::PlusZ);
    let kinds: Vec<Engaged> = engagement.stages().iter().map(|s| s.engaged).collect();
    assert_eq!(kinds, [Engaged::Partly]);
    let found = [engagement.first().unwrap(), engagement.last().unwrap()];
    compare(&found, &[run_in(case)[0], run_out(case)[1] - down], &[1.0, -1.0], "thin wall");
}

/// Places of two holes.
const PLACES: [[f64; 2]; 2] = [[-10.5, 0.3], [10.5, -0.2]];

/// A plate of 12 mm and the way of an annular drill through it: item 3 is the first hole, 4 the way over to the second
/// one, 5 the second one; each hole down and up.
fn two_holes(drill: Cutter) -> (Job, Trace) {
    const PLATE: &str = r#"
format = 1
stock = { box = { min = [-22, -11, -12], max = [22, 11, 0] } }
post = { control = "linuxcnc" }
simulate = { step = 0.4 }
[[tool]]
number = 1
type = "end-mill"
diameter = 12
flute_length = 40
max_ramp_angle = 5
[[setup]]
offset = "G54"
[[setup.operation]]
type = "bore"
tool = 1
at = [0, 0]
diameter = 20
depth = 2
strategy = "helix"
speed = 5000
rough = { stepover = 3, engagement = 75, allowance = 0, feed = 1200, stepdown = 6 }
"#;
    let run = job::run(PLATE);
    let Outcome { mut job, setups, .. } = run.unwrap_or_else(|e| panic!("{e:?}"));
    job.tools[0].cutter = drill;
    let sample = setups[0].trace.segments[0].clone();
    let [one, two] = PLACES;
    let line = |item: u32, from: [f64; 2], to: [f64; 2], heights: [f64; 2]| {
        let [start, end] = [(from, heights[0]), (to, heights[1])].map(|(p, z)| DVec3::new(p[0], p[1], z));
        let mut segment = sample.clone();
        segment.curve = Line { start, end }.into();
        (segment.item, segment.alternative) = (item, false);
        segment
    };
    let segments = vec![
        line(3, one, one, [2.0, -14.0]),
        line(3, one, one, [-14.0, 2.0]),
        line(4, one, two, [2.0, 2.0]),
        line(5, two, two, [2.0, -14.0]),
        line(5, two, two, [-14.0, 2.0]),
    ];
    (job, Trace { segments, ..Trace::default() })
}

#[test]
fn probes_measure_between_the_holes_of_a_program_and_a_core_can_be_taken_out() {
    let point = DrillPoint::Annular { core: 9.0 };
    let (job, trace) = two_holes(Cutter::Drill { diameter: 16.0, point: point.clone() });
    let traces = [trace];
    let (core, hole) = (PI * 4.5 * 4.5 * 12.0, PI * 8.0 * 8.0 * 12.0);
    let removed = |s: &Simulation| s.raw_volume - s.stock.volume();
    let edge = point.edge(16.0).unwrap();
    let whole = DrillPoint::Flat.edge(16.0).unwrap();
    let probe = |at: [f64; 2], item: u32, edge: EdgeProfile| Probe {
        setup: 0,
        item,
        at: DVec3::new(at[0], at[1], 3.0),
        out: DVec3::Z,
        edge,
    };
    // Not in the order of the program.
    let probes = [
        probe(PLACES[1], 5, edge),
        probe(PLACES[0], 3, edge),
        probe(PLACES[0], 4, edge),
        probe(PLACES[0], 4, whole),
        probe(PLACES[1], u32::MAX, whole),
    ];
    let loose =
        Loose { item: 4, centre: DVec3::new(-10.5, 0.3, 0.0), out: DVec3::Z, diameter: 9.0, depth: 12.0 };
    let again = simulate(&job, &[&traces[0]], &[vec![]], &probes, &[], &Silent).unwrap();
    // Both cores stand.
    assert!((removed(&again) / (2.0 * (hole - core)) - 1.0).abs() < 0.01);
    // To measure changes nothing.
    let unmeasured = simulate(&job, &[&traces[0]], &[], &[], &[], &Silent).unwrap();
    assert_eq!((again.stock.volumes(), &again.effects), (unmeasured.stock.volumes(), &unmeasured.effects));
    let shares = |s: &Simulation| -> Vec<f64> { s.engagements.iter().map(|e| e.share(-6.0)).collect() };
    // Solid before each hole; the ring is gone after it, the core is not.
    let standing = (4.5f64 / 8.0).powi(2);
    let found = shares(&again);
    assert_eq!(found[..3], [1.0, 1.0, 0.0]);
    assert!((found[3] - standing).abs() < 0.02 && (found[4] - standing).abs() < 0.02, "{found:?}");
    let stages = again.engagements[0].stages();
    assert_eq!((stages.len(), stages[0].engaged), (1, Engaged::Fully));
    assert!(stages[0].from.abs() < 1e-9 && (stages[0].to + 12.0).abs() < 1e-9, "{stages:?}");
    // Taken out before the second hole, and before what is measured there.
    let taken = simulate(&job, &[&traces[0]], &[vec![loose]], &probes, &[], &Silent).unwrap();
    assert!(((removed(&taken) - removed(&again)) / core - 1.0).abs() < 0.02);
    let found = shares(&taken);
    assert_eq!(found[..4], [1.0, 1.0, 0.0, 0.0]);
    assert!((found[4] - standing).abs() < 0.02);
    // The core stood within the drill over the whole height of the plate.
    let deepest = again.effects[0].iter().filter_map(|e| e.core()).map(|c| c.depth).fold(0.0, f64::max);
    assert!((deepest - 12.0).abs() < 0.01, "{deepest}");
    let wrong = Probe { setup: 1, ..probe(PLACES[0], 0, edge) };
    let error = simulate(&job, &[&traces[0]], &[vec![]], &[wrong], &[], &Silent).unwrap_err();
    assert_eq!(error.0.key.as_deref(), Some("probes[0].setup"));
}

#[test]
fn no_point_leaves_stock_that_was_not_meant_to_stay() {
    let points = [
        "twist = {}",
        "double-ground = {}",
        "cast-iron = { slot = 0.8 }",
        "rounded-lips = { lip_radius = 9 }",
        "corner-radius = { corner_radius = 2 }",
        "thinned-web = { flat = 1 }",
        "slotted-chisel = { slot = 1.2 }",
        "annular = { core_diameter = 9 }",
        "cannon = { overlap = 0.6, edge_angle = 70 }",
        "gun = {}",
        // Its nub stands higher than the corner.
        "gun = { inner_angle = 45 }",
        "auger = {}",
        "ejector = {}",
    ];
    for point in points.iter().map(|p| format!("{{ {p} }}")).chain(["\"flat\"".to_owned()]) {
        for end in ["exit = \"same\"\nlength = 12", "depth = 4"] {
            let job = format!(
                r#"
format = 1
stock = {{ box = {{ min = [-11, -11, -12], max = [11, 11, 0] }} }}
post = {{ control = "linuxcnc" }}
simulate = {{ step = 0.4 }}
[[tool]]
number = 1
type = "drill"
diameter = 16
flute_length = 40
point = {point}
[[setup]]
offset = "G54"
[[setup.operation]]
type = "drill"
tool = 1
points = [[0.3, 0.1]]
entry = {{ surface = "plane" }}
{end}
cutting_speed = 25
feed_per_rev = {{ entry = 0.1, steady = 0.2, exit = 0.1 }}
"#
            );
            let outcome = job::run(&job).unwrap_or_else(|e| panic!("{point}: {e:?}"));
            let left: Vec<_> = outcome
                .verdict
                .found
                .iter()
                .filter(|f| f.code == Code::STOCK_LEFT || f.code == Code::WALL_GOUGED)
                .collect();
            assert!(left.is_empty(), "{point} {end}: {left:?}");
            let compared: usize = outcome.deviation.bores.iter().map(|b| b.ends).sum();
            assert!(compared > 300, "{point} {end}: {compared}");
            outcome.part.check_closed().unwrap();
        }
    }
}
