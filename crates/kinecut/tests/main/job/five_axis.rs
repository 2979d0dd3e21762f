//! Jobs on machines with rotary axes: planned, posted for four controls, read back, followed on the machine.

use glam::DVec3;
use kinecut::base::{Code, Silent};
use kinecut::job::{Outcome, run};
use kinecut::stock::{Axis, DexelGrid, unfixed};
use kinecut::trace::SegmentPace;

use crate::common::job;

const MACHINE: &str = r#"
[machine]
code = "641203"
travel = { X = [-400, 400], Y = [-350, 350], Z = [-650, 0], A = [-115, 35], C = [-3600, 3600] }
dynamics = { rapid = 30000 }
[machine.axis.A]
point = [0, 0.02, -480]
rapid = 25
[machine.axis.C]
rapid = 50
"#;

const REST: &str = r#"
[[tool]]
number = 1
type = "drill"
diameter = 8
point = { twist = { point_angle = 118 } }
flute_length = 75
stickout = 90
gauge_length = 170

[[tool]]
number = 2
type = "ball-nose"
diameter = 6
teeth = 2
flute_length = 12
stickout = 60
gauge_length = 140

[[setup]]
offset = "G54"
position = [10, -5, -420]
"#;

const HOLES: &str = r#"
[[setup.operation]]
type = "drill"
tool = 1
plane = { origin = [0, -30, -22], x = [1, 0, 0], z = [0, -1, 0] }
points = [[-20, 0], [20, 3]]
depth = 24
cutting_speed = 80
feed_per_rev = { steady = 0.15 }
"#;

fn head(control: &str, extra: &str) -> String {
    format!(
        "format = 1\nstock = {{ box = {{ min = [-40, -30, -40], max = [40, 30, 0] }} }}\n\
         post = {{ control = \"{control}\"{extra} }}\nsimulate = {{ step = 0.5 }}\n{MACHINE}{REST}"
    )
}

/// Points of a ring, the tool leaning outwards by 25 degrees: tip and direction.
fn ring() -> Vec<(DVec3, DVec3)> {
    let lean = 25f64.to_radians();
    (0..=24)
        .map(|k| {
            let (sin, cos) = (f64::from(k) * 15f64.to_radians()).sin_cos();
            let axis = DVec3::new(lean.sin() * cos, lean.sin() * sin, lean.cos());
            (DVec3::new(18.0 * cos, 18.0 * sin, 2.6) - 3.0 * axis, axis)
        })
        .collect()
}

fn path(points: &[(DVec3, DVec3)]) -> String {
    let rows: Vec<String> = points
        .iter()
        .map(|(p, a)| format!("[{:.6}, {:.6}, {:.6}, {:.9}, {:.9}, {:.9}]", p.x, p.y, p.z, a.x, a.y, a.z))
        .collect();
    format!(
        "[[setup.operation]]\ntype = \"path\"\ntool = 2\nspeed = 12000\nfeed = 900\nclearance = 7\npoints = [{}]\n",
        rows.join(", ")
    )
}

fn done(text: &str) -> Outcome {
    job::run(text).unwrap()
}

fn refused(text: &str) -> (Code, String) {
    let error = job::run(text).map(|_| ()).unwrap_err();
    (error.code(), format!("{} {:?}", error, error.0.key))
}

/// Controls with the ways in which each says directions of the tool.
const SAID: [(&str, &str); 7] = [
    ("sinumerik-840d", "vectors"),
    ("sinumerik-840d", "angles"),
    ("fanuc", "angles"),
    ("fanuc", "vectors"),
    ("heidenhain", "angles"),
    ("heidenhain", "vectors"),
    ("linuxcnc", "axes"),
];

#[test]
fn the_posted_text_runs_the_tool_through_all_points_on_every_control() {
    let points = ring();
    for (control, said) in SAID {
        let extra = format!(", orientation = \"{said}\"");
        let outcome = done(&(head(control, &extra) + &path(&points)));
        assert!(outcome.verdict.is_safe(), "{control} {said}: {:?}", outcome.verdict.found);
        let setup = &outcome.setups[0];
        assert!(setup.read_back.largest < 1.5e-3, "{control} {said}: {}", setup.read_back.largest);
        let cuts: Vec<_> = setup.trace.segments.iter().filter(|s| s.motion != SegmentPace::Rapid).collect();
        let mut at = 0;
        for (i, (tip, axis)) in points.iter().enumerate() {
            let hit = cuts[at..].iter().position(|s| {
                (s.curve.end() - *tip).length() < 1.5e-3 && s.end_axis().angle_between(*axis) < 2e-5
            });
            at += hit.unwrap_or_else(|| panic!("{control} {said}: point {i} is not reached"));
        }
        // Between the points the tip keeps to the lines, the tool to the plane of its directions.
        for segment in &cuts[1..] {
            for k in 0..=4 {
                let pose = segment.pose(segment.curve.length() * f64::from(k) / 4.0);
                let (off, lean) = points
                    .windows(2)
                    .map(|w| beside(&pose.tip.p, &pose.axis, w))
                    .fold((f64::INFINITY, f64::INFINITY), |a, b| if b.0 < a.0 { b } else { a });
                let tolerance = if said == "axes" { 0.012 } else { 1.5e-3 };
                assert!(off < tolerance, "{control} {said}: tip off by {off}");
                assert!(lean < 2.5e-4, "{control} {said}: direction off by {lean}");
            }
        }
        // The tool comes along its direction from the clearance, at feed.
        let first = cuts[0];
        assert!((first.curve.length() - 7.0).abs() < 2e-3, "{control} {said}: {}", first.curve.length());
        assert!((first.curve.start() - points[0].0).angle_between(points[0].1) < 1e-3);
    }
}

#[test]
fn where_the_axes_go_around_nothing_of_the_way_is_left_out() {
    // The tool tilts from one side over the pole to the other, and A has no travel on one of them: C goes round.
    let lean = |degrees: f64| DVec3::new(0.0, degrees.to_radians().sin(), degrees.to_radians().cos());
    let points: Vec<(DVec3, DVec3)> = (0..=10)
        .map(|k| (DVec3::new(0.0, -20.0 + 4.0 * f64::from(k), -1.0), lean(-21.0 + 4.0 * f64::from(k))))
        .collect();
    for (control, said) in [("fanuc", "angles"), ("linuxcnc", "axes"), ("sinumerik-840d", "vectors")] {
        let text = head(control, &format!(", orientation = \"{said}\"")) + &path(&points);
        let outcome = done(&text.replace("A = [-115, 35]", "A = [-115, 0.5]"));
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        let trace = &outcome.setups[0].trace;
        let cuts: Vec<_> = trace.segments.iter().filter(|s| s.motion != SegmentPace::Rapid).collect();
        // C turns by half a turn while the tool is retracted: no cut has it.
        let turned = cuts.iter().map(|s| (s.joints(1.0).unwrap()[5] - s.joints(0.0).unwrap()[5]).abs());
        assert!(turned.fold(0.0, f64::max) < 0.5, "{control}");
        let [first, last] = [cuts[1], cuts[cuts.len() - 1]].map(|s| s.joints(0.0).unwrap()[5]);
        assert!((first - last).abs() > 3.0, "{control}: C does not go round: {first} {last}");
        for step in points.windows(2) {
            for t in [0.1, 0.5, 0.9] {
                let (tip, axis) = (step[0].0.lerp(step[1].0, t), step[0].1.lerp(step[1].1, t));
                let hit = cuts.iter().any(|s| {
                    (0..=40).any(|k| {
                        let pose = s.pose(s.curve.length() * f64::from(k) / 40.0);
                        (pose.tip.p - tip).length() < 0.06 && pose.axis.angle_between(axis) < 2e-3
                    })
                });
                assert!(hit, "{control}: nothing cuts at {tip}");
            }
        }
    }
}

/// Distance of a tip from the line of a step, and angle of a direction from the plane of its directions.
fn beside(tip: &DVec3, axis: &DVec3, step: &[(DVec3, DVec3)]) -> (f64, f64) {
    let [(a, from), (b, to)] = step else { panic!("two points") };
    let t = ((*tip - *a).dot(*b - *a) / (*b - *a).length_squared()).clamp(0.0, 1.0);
    let plane = from.cross(*to).try_normalize().unwrap();
    ((*tip - a.lerp(*b, t)).length(), axis.dot(plane).abs())
}

#[test]
fn holes_in_a_tilted_plane_are_cut_in_the_simulated_stock() {
    for control in ["sinumerik-840d", "fanuc", "heidenhain", "linuxcnc"] {
        let outcome = done(&(head(control, "") + HOLES));
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        let cylinder = std::f64::consts::PI * 16.0 * 24.0;
        let cone = std::f64::consts::PI * 16.0 * (4.0 / 59f64.to_radians().tan()) / 3.0;
        let removed = outcome.simulation.raw_volume - outcome.simulation.stock.volume();
        // A circle of 8 mm on lines half a millimetre apart.
        assert!((removed / (2.0 * (cylinder + cone)) - 1.0).abs() < 1e-2, "{control}: {removed}");
        // The drill stands along -Y of the part, and A by a quarter turn.
        let down = outcome.setups[0].trace.segments.iter().find(|s| s.motion != SegmentPace::Rapid).unwrap();
        assert!((down.axis - DVec3::NEG_Y).length() < 1e-6);
        assert!((down.joints(0.0).unwrap()[3].abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-6);
        assert!(outcome.verdict.proven.iter().any(|p| p.claim.contains("the wall lies within")), "{control}");
    }
}

#[test]
fn holes_in_a_plane_between_the_axes_are_cut_and_their_walls_measured() {
    let skew = HOLES.replace("z = [0, -1, 0]", "z = [0, -0.6, 0.8]").replace("-22]", "0]");
    let skew = skew.replace("depth = 24", "depth = 12\nentry = { surface = \"plane\", inclination = 0 }");
    let outcome = done(&(head("heidenhain", "") + &skew));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    let (simulation, deviation) = (&outcome.simulation, &outcome.deviation);
    let down = outcome.setups[0].trace.segments.iter().find(|s| s.motion != SegmentPace::Rapid).unwrap();
    assert!((down.axis - DVec3::new(0.0, -0.6, 0.8)).length() < 2e-6);
    // Below the edge of the block: the plane through it cuts off a corner, so that the upper part of a hole lies in air.
    let inside = |q: DVec3| q.y > -30.0 && q.z < 0.0;
    let (to, across) = (DVec3::new(0.0, -0.6, 0.8), DVec3::new(0.0, 0.8, 0.6));
    let point = 4.0 / 59f64.to_radians().tan();
    let (mut removed, by) = (0.0, 0.05);
    for i in -80..80 {
        for j in -80..80 {
            let (u, v) = ((f64::from(i) + 0.5) * by, (f64::from(j) + 0.5) * by);
            let r = u.hypot(v);
            if r < 4.0 {
                let bottom = -12.0 - point * (1.0 - r / 4.0);
                let steps = (-bottom / by) as u32;
                let within = (0..steps).filter(|k| {
                    let depth = (f64::from(*k) + 0.5) * by;
                    inside(DVec3::new(0.0, -30.0, 0.0) + across * v - to * depth)
                });
                removed += within.count() as f64 * by * by * by;
            }
        }
    }
    let cut = simulation.raw_volume - simulation.stock.volume();
    assert!((cut / (2.0 * removed) - 1.0).abs() < 0.02, "{cut} {removed}");
    let bore = &deviation.bores[0];
    assert!(bore.ends > 500 && bore.wall[0] > -1e-4 && bore.wall[1] < 1e-4, "{bore:?}");
    assert!(outcome.verdict.proven.iter().any(|p| p.claim.contains("the wall lies within")));
}

#[test]
fn a_gun_drill_in_a_plane_between_the_axes_leaves_its_nub_on_every_control() {
    let skew = HOLES.replace("z = [0, -1, 0]", "z = [0, -0.6, 0.8]").replace("-22]", "0]");
    let skew = skew.replace("depth = 24", "depth = 12\nentry = { surface = \"plane\", inclination = 0 }");
    for control in ["sinumerik-840d", "fanuc", "heidenhain", "linuxcnc"] {
        let head = head(control, "").replace("{ twist = { point_angle = 118 } }", "{ gun = { apex = 2 } }");
        let outcome = done(&(head + &skew));
        let found = &outcome.verdict.found;
        assert!(found.iter().all(|f| f.code != Code::DRILL_SIDEWAYS), "{control}: {found:?}");
        let stock = &outcome.simulation.stock;
        let lattice = *stock.lattice();
        let material = |p: DVec3| {
            let [i, j, _] = ((p - lattice.origin) / lattice.step).round().to_array();
            let line = stock.line(Axis::Z, i as u32, j as u32);
            line.iter().any(|part| unfixed(part.lo.at) < p.z && p.z < unfixed(part.hi.at))
        };
        let feeds = outcome.setups[0].trace.segments.iter().filter(|s| s.motion != SegmentPace::Rapid);
        let deepest = feeds.min_by(|a, b| a.curve.end().z.total_cmp(&b.curve.end().z)).unwrap();
        let (tip, axis) = deepest.tool_at(1.0);
        // Under the apex the inner edge leaves a cone of 2 mm radius and 2 / tan 70 = 0.73 mm height.
        assert!(material(tip + axis * 0.3) && !material(tip + axis * 1.2), "{control}: {tip}");
    }
}

#[test]
fn bores_from_two_sides_that_meet_are_no_gouges_of_one_another() {
    let bore = |plane: &str, at: &str, depth: f64| {
        format!(
            "[[setup.operation]]\ntype = \"bore\"\ntool = 3\n{plane}\nat = {at}\ndiameter = 30\ndepth = {depth}\n\
             strategy = \"involute\"\nspeed = 6000\nrough = {{ stepover = 3, feed = 2000, allowance = 0.3 }}\n\
             finish = {{ feed = 1000 }}\n"
        )
    };
    let tool = "[[tool]]\nnumber = 3\ntype = \"end-mill\"\ndiameter = 12\nteeth = 3\nflute_length = 40\nstickout = 60\n\
                gauge_length = 150\n[[setup]]";
    let side = "plane = { origin = [40, 0, -20], x = [0, 1, 0], z = [1, 0, 0] }";
    let (a, b) = (bore(side, "[5, 0]", 15.0), bore("", "[0, 0]", 14.0));
    let text = (head("fanuc", "") + &a + &b).replacen("[[setup]]", tool, 1);
    let outcome = done(&text);
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
}

#[test]
fn the_example_is_cut_and_safe_on_every_control() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/05_machine_from_code");
    let text = std::fs::read_to_string(folder.join("job.toml")).unwrap();
    let loader = kinecut::base::DiskLoader::new(folder);
    for control in ["heidenhain", "fanuc", "sinumerik-840d", "linuxcnc"] {
        let text = text.replace("control = \"heidenhain\"", &format!("control = \"{control}\""));
        let outcome = run("job.toml", &text, &loader, &Silent).unwrap();
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        assert!(outcome.setups[0].read_back.largest < 1e-3, "{control}");
        assert!(outcome.verdict.proven.iter().any(|p| p.claim.contains("travel of the axes")), "{control}");
        // The file gives bodies of the machine.
        let clear = "the 14 bodies of the machine meet nothing";
        assert!(outcome.verdict.proven.iter().any(|p| p.claim.starts_with(clear)), "{control}");
    }
}

#[test]
fn what_the_machine_cannot_do_is_said_with_its_place() {
    let narrow = |text: &str| text.replace("A = [-115, 35]", "A = [-20, 20]");
    let (code, said) = refused(&narrow(&(head("fanuc", "") + HOLES)));
    assert_eq!(code, Code::TRAVEL_EXCEEDED, "{said}");
    assert!(said.contains("A leaves its travel") && said.contains("operation[0]"), "{said}");
    let (_, said) = refused(&narrow(&(head("fanuc", "") + &path(&ring()))));
    assert!(said.contains("A lacks least") && said.contains("points[0]"), "{said}");
    // A linear axis that runs out of its travel is an error with its block.
    let short = (head("fanuc", "") + HOLES).replace("Z = [-650, 0]", "Z = [-150, 0]");
    let outcome = done(&short);
    let found = outcome.verdict.found.iter().find(|f| f.code == Code::TRAVEL_EXCEEDED).unwrap();
    assert!(found.message.contains("Z leaves its travel") && found.place.is_some(), "{found:?}");
    assert!(!outcome.verdict.is_safe());
}

#[test]
fn wrong_jobs_are_refused_with_their_keys() {
    let plain = |text: &str| {
        let (start, end) = (text.find("[machine]").unwrap(), text.find("[[tool]]").unwrap());
        format!("{}{}", &text[..start], &text[end..])
    };
    let no_machine = refused(&plain(&(head("fanuc", "") + HOLES)));
    assert!(no_machine.1.contains("rotary axes") && no_machine.1.contains("plane"), "{no_machine:?}");
    let no_machine = refused(&plain(&(head("fanuc", "") + &path(&ring()))));
    assert!(no_machine.1.contains("rotary axes"), "{no_machine:?}");
    let skew = HOLES.replace("x = [1, 0, 0]", "x = [1, 0.5, 0]");
    assert!(refused(&(head("fanuc", "") + &skew)).1.contains("right angles"));
    let (code, said) = refused(&(head("linuxcnc", ", orientation = \"angles\"") + HOLES));
    assert_eq!(code, Code::POST_CONTROL, "{said}");
    let (code, said) = refused(&(head("heidenhain", ", orientation = \"axes\"") + &path(&ring())));
    assert!(code == Code::POST_CONTROL && said.contains("inverse time"), "{said}");
    let unplaced = (head("linuxcnc", "") + HOLES).replace("position = [10, -5, -420]", "");
    assert!(refused(&unplaced).1.contains("position"), "{:?}", refused(&unplaced));
    let empty =
        head("fanuc", "") + "[[setup.operation]]\ntype = \"path\"\ntool = 2\nspeed = 1000\nfeed = 100\n";
    assert!(refused(&empty).1.contains("no points"));
    let flat = path(&ring()[..2]).replacen(", ", ", nan, ", 1);
    assert_eq!(refused(&(head("fanuc", "") + &flat)).0, Code::JOB_VALUE);
}
