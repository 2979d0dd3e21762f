//! Milled threads through the whole: posted for each control, read back, cut, the groove of the text by brute force.

use glam::DVec3;
use kinecut::base::{Code, Error, MemoryLoader, Severity, Silent};
use kinecut::geom::CurveKind;
use kinecut::job::{Outcome, run};
use kinecut::trace::SegmentPace;

use crate::common::groove::{Tooth, pitch_radius};

const CONTROLS: [&str; 5] = ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"];

/// A plate of 80 x 60 x 30 with holes of 6.647 and 17.294, thread mills for M8 (5 mm, 1 row), M20 (14 mm, 6 rows), and an end mill.
fn job(control: &str, operations: &str) -> String {
    format!(
        r#"format = 1
post = {{ control = "{control}" }}
stock = {{ box = {{ min = [-40, -30, -30], max = [40, 30, 0] }} }}
drilled = [
  {{ at = [20, 10], diameter = 6.647, top = 0, bottom = -30 }},
  {{ at = [-20, 5], diameter = 17.294, top = 0, bottom = -30 }},
]
simulate = {{ step = 0.25, engagement = false }}
[[tool]]
number = 1
type = "end-mill"
diameter = 10
teeth = 4
flute_length = 32
stickout = 45
gauge_length = 120
[[tool]]
number = 4
type = "thread-mill"
diameter = 5
pitch = 1.25
teeth = 3
flute_length = 1.25
neck_diameter = 2.8
neck_length = 22
shank_diameter = 6
stickout = 40
gauge_length = 110
[[tool]]
number = 5
type = "thread-mill"
diameter = 14
pitch = 2.5
rows = 6
teeth = 4
flute_length = 15
neck_diameter = 10.5
neck_length = 30
shank_diameter = 14
stickout = 45
gauge_length = 120
[[setup]]
offset = "G54"
{operations}
"#
    )
}

const M8: &str = "[[setup.operation]]\ntype = \"thread-mill\"\ntool = 4\nsize = \"M8\"\npoints = [[20, 10]]\n\
    speed = 6000\nfeed = 500\n";
const M20: &str = "[[setup.operation]]\ntype = \"thread-mill\"\ntool = 5\nsize = \"M20\"\npoints = [[-20, 5]]\n\
    speed = 2500\nfeed = 600\n";

fn attempt(control: &str, operations: &str) -> Result<Outcome, Error> {
    run("job.toml", &job(control, operations), &MemoryLoader::default(), &Silent)
}

fn cut(control: &str, operations: &str) -> Outcome {
    attempt(control, operations).unwrap_or_else(|e| panic!("{e}"))
}

/// A helix of the text: its curve, and whether it turns counter-clockwise and climbs.
struct Turned {
    points: Vec<DVec3>,
    counter_clockwise: bool,
    climbs: bool,
}

/// The helices of a tool: moves at feed that turn about an axis by more than a quarter, one after the other, in half turns at
/// least; dense points of the middle of the lowest tooth.
fn helices(outcome: &Outcome, tool: u32, axis: [f64; 2], pitch: f64) -> Vec<Turned> {
    let axis = DVec3::new(axis[0], axis[1], 0.0);
    let segments = outcome.setups[0].trace.segments.iter();
    let mut found: Vec<Turned> = Vec::new();
    let mut open = false;
    for segment in segments.filter(|s| !s.alternative && s.tool.is_some_and(|t| t.0 == tool)) {
        let arc = match segment.curve.kind() {
            CurveKind::Arc(arc) if matches!(segment.motion, SegmentPace::Feed(_)) => arc,
            // The rest of a grid's step that ends a helix.
            CurveKind::Line(line) if open && line.start.distance(line.end) < 0.01 => continue,
            _ => {
                open = false;
                continue;
            }
        };
        let about = (arc.centre - axis).truncate().length() < 0.05;
        if !about || arc.rise == 0.0 {
            open = false;
            continue;
        }
        if !open {
            let (counter_clockwise, climbs) = (arc.sweep > 0.0, arc.rise > 0.0);
            found.push(Turned { points: Vec::new(), counter_clockwise, climbs });
        }
        open = true;
        let helix = found.last_mut().unwrap();
        assert_eq!((arc.sweep > 0.0, arc.rise > 0.0), (helix.counter_clockwise, helix.climbs));
        let count = (arc.sweep.abs() * 3e4).ceil() as u32;
        let middle = DVec3::Z * 0.5 * pitch - axis;
        helix.points.extend((0..=count).map(|i| arc.point(f64::from(i) / f64::from(count)) + middle));
    }
    found
}

/// The pitch diameter of a helix of the text, in some half-planes.
fn pitch_diameters(helix: &Turned, tool: f64, [pitch, crest]: [f64; 2], inside: bool) -> Vec<f64> {
    let tooth =
        Tooth { crest: 0.5 * tool, pitch_line: 0.5 * tool - crest, pitch, half_angle: 30f64.to_radians() };
    let count = helix.points.len();
    let z = helix.points[count / 2].z;
    let turn: Vec<DVec3> = helix.points.iter().filter(|p| (p.z - z).abs() < 0.5 * pitch).copied().collect();
    let at = |share: f64| turn[(share * turn.len() as f64) as usize].truncate().to_angle();
    // Away from the ends of the turn.
    [0.4, 0.5, 0.6].map(|share| 2.0 * pitch_radius(tooth, &turn, inside, at(share))).to_vec()
}

/// Height of the crest over the pitch line, inside and outside.
fn crest(pitch: f64, inside: bool) -> f64 {
    let sharp = 0.5 * 3f64.sqrt() * pitch;
    if inside { 3.0 / 8.0 * sharp } else { (17.0 / 24.0 - 3.0 / 8.0) * sharp }
}

#[test]
fn every_control_mills_both_threads_and_the_groove_of_the_text_has_the_pitch_diameter() {
    for control in CONTROLS {
        let outcome = cut(control, &format!("{M8}depth = 12\n{M20}depth = 20\ninfeed = [0.7, 1.0]\n"));
        let verdict = &outcome.verdict;
        assert!(verdict.is_safe(), "{control}: {:#?}", verdict.found);
        // The major diameters, 0.048 and 0.110 below nominal.
        let noted: Vec<&str> = verdict
            .found
            .iter()
            .map(|f| {
                assert_eq!((f.code, f.severity), (Code::THREAD_OVERCUT, Severity::Note), "{control}: {f}");
                f.message.as_str()
            })
            .collect();
        assert!(
            noted.len() == 2 && noted[0].contains("0.048 mm below") && noted[1].contains("0.110 mm below"),
            "{noted:?}"
        );
        let claims: Vec<&str> = verdict.proven.iter().map(|p| p.claim.as_str()).collect();
        assert!(
            claims.iter().any(|c| c.starts_with("2 milled threads: the helix of the text")),
            "{claims:?}"
        );
        assert!(format!("{verdict:?}").contains("the flanks of a milled thread"), "{control}");
        // In six rows M20 takes two steps, each in two passes.
        for (tool, axis, cutter, pitch, wanted, count, last) in [
            (4, [20.0, 10.0], 5.0, 1.25, 7.188101183952089, 1, 0),
            (5, [-20.0, 5.0], 14.0, 2.5, 18.376202367904178, 4, 2),
        ] {
            let found = helices(&outcome, tool, axis, pitch);
            assert_eq!(found.len(), count, "{control} T{tool}");
            for (i, helix) in found.iter().enumerate() {
                assert!(helix.counter_clockwise && helix.climbs, "{control}");
                if i < last {
                    continue;
                }
                for diameter in pitch_diameters(helix, cutter, [pitch, crest(pitch, true)], true) {
                    let off = diameter - wanted;
                    assert!(off.abs() < 2e-3, "{control} T{tool}: {off}");
                }
            }
        }
        // The wall of the crests, in the simulated part.
        for (wall, least) in outcome.deviation.bores.iter().zip([500, 2000]) {
            assert!(wall.ends > least && wall.worst() < 2e-3, "{control}: {wall:?}");
        }
        let json: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
        let own = &json["setups"][0]["milled_threads"];
        assert_eq!(own[1]["helices"].as_array().unwrap().len(), 4, "{control}");
        // The shallower pass is slower, so that its edge is not faster.
        let feed = |i: usize| own[1]["helices"][i]["centre_feed"].as_f64().unwrap();
        assert!(feed(0) < 0.95 * feed(2), "{control}: {} {}", feed(0), feed(2));
        let told = own[0]["deviation"].as_f64().unwrap();
        assert!(told < 2e-3, "{control}: {told}");
    }
}

#[test]
fn hands_and_senses_are_those_of_the_text() {
    for (hand, direction, counter_clockwise, climbs) in [
        ("right", "conventional", false, false),
        ("left", "climb", true, false),
        ("left", "conventional", false, true),
    ] {
        for control in ["heidenhain", "fanuc"] {
            let more = format!("depth = 6\nhand = \"{hand}\"\ndirection = \"{direction}\"\n");
            let outcome = cut(control, &format!("{M8}{more}"));
            assert!(outcome.verdict.is_safe(), "{control}: {:#?}", outcome.verdict.found);
            let found = helices(&outcome, 4, [20.0, 10.0], 1.25);
            assert_eq!(found.len(), 1, "{control} {hand} {direction}");
            assert_eq!((found[0].counter_clockwise, found[0].climbs), (counter_clockwise, climbs));
        }
    }
}

/// A boss of 20 in a pocket, cut by a contour, and a thread on it.
fn on_boss(control: &str, more: &str) -> Outcome {
    let boss = "[[setup.operation]]\ntype = \"contour\"\ntool = 1\nspeed = 6000\nfeed = 1200\n\
        circle = { at = [0, 0], diameter = 20 }\ndepth = 20\nstepdown = 20\n";
    // The stock around it is cleared first.
    let clear: String = [22.0, 26.0]
        .iter()
        .map(|radius| {
            format!(
                "[[setup.operation]]\ntype = \"contour\"\ntool = 1\nspeed = 6000\nfeed = 1200\nside = \"on\"\n\
                 circle = {{ at = [0, 0], diameter = {} }}\ndepth = 20\nstepdown = 20\n",
                2.0 * radius
            )
        })
        .collect();
    let thread = format!(
        "[[setup.operation]]\ntype = \"thread-mill\"\ntool = 5\nsize = \"M20\"\nside = \"outside\"\n\
         points = [[0, 0]]\nspeed = 2500\nfeed = 600\ndepth = 14\n{more}"
    );
    let text = job(control, &format!("{clear}{boss}{thread}"));
    let drilled = &text[text.find("drilled").unwrap()..text.find("simulate").unwrap()];
    let text = text.replace(drilled, "");
    run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_thread_on_a_boss_is_milled_clockwise_and_its_root_is_measured() {
    for control in ["sinumerik-840d", "grbl"] {
        let outcome = on_boss(control, "");
        let found: Vec<_> =
            outcome.verdict.found.iter().filter(|f| f.severity >= Severity::Warning).collect();
        assert!(outcome.verdict.is_safe(), "{control}: {found:#?}");
        let helices = helices(&outcome, 5, [0.0, 0.0], 2.5);
        // 14 mm with 12.5 in a step.
        assert_eq!(helices.len(), 2, "{control}");
        for helix in &helices {
            assert!(!helix.counter_clockwise && !helix.climbs);
            for diameter in pitch_diameters(helix, 14.0, [2.5, crest(2.5, false)], false) {
                let off = diameter - 18.376202367904178;
                assert!(off.abs() < 2e-3, "{control}: {off}");
            }
        }
        let sections = format!("{:?}", kinecut::job::report::of_job(&outcome).sections);
        for part in ["16.954 mm", "that of the standard is 16.933 mm"] {
            assert!(sections.contains(part), "no `{part}` in {sections}");
        }
        let root = outcome.deviation.bores.last().unwrap();
        assert!(root.ends > 500 && root.worst() < 2e-3, "{control}: {root:?}");
    }
}

#[test]
fn a_taper_thread_is_posted_on_every_control() {
    for control in CONTROLS {
        let thread = "[[setup.operation]]\ntype = \"thread-mill\"\ntool = 4\ndiameter = 8\npitch = 1.25\ntaper = 16\n\
            points = [[20, 10]]\nspeed = 6000\nfeed = 500\ndepth = 10\n";
        let outcome = cut(control, thread);
        let verdict = &outcome.verdict;
        assert!(verdict.is_safe(), "{control}: {:#?}", verdict.found);
        assert!(verdict.proven.iter().any(|p| p.claim.starts_with("1 milled thread:")), "{control}");
        assert!(format!("{verdict:?}").contains("a cone of steps"), "{control}");
        // Narrower at its bottom, which the cylinder of the hole is not.
        let wide = verdict.found.iter().find(|f| f.code == Code::THREAD_CORE).unwrap();
        assert!(
            wide.severity == Severity::Warning
                && wide.message.contains("taper 1 in 16")
                && wide.message.contains("is 6.647: more than 6.36 leaves")
                && wide.message.ends_with("at its bottom"),
            "{}",
            wide.message
        );
        let json: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
        let own = &json["setups"][0]["milled_threads"][0];
        let told = own["deviation"].as_f64().unwrap();
        assert!(told < 6e-3, "{control}: {told}");
        let radii: Vec<f64> =
            own["helices"][0]["radii"].as_array().unwrap().iter().map(|r| r.as_f64().unwrap()).collect();
        // Over 8.5 turns of 1.25 by 1 in 32, and a few hundredths more with the overcut of so small a tool.
        let change = (radii[1] - radii[0]) / (10.625 / 32.0);
        assert!(change > 1.02 && change < 1.05, "{radii:?}");
    }
}

#[test]
fn the_wear_register_moves_the_thread_and_is_said() {
    for (control, register, word) in
        [("fanuc", "D104", "D104"), ("linuxcnc", "D44", "D44"), ("heidenhain", "D2", "RL")]
    {
        let more =
            format!("depth = 8\nwear_offset = \"{register}\"\nwear_largest = 0.04\nwear_value = 0.03\n");
        let outcome = cut(control, &format!("{M8}{more}"));
        let verdict = &outcome.verdict;
        assert!(verdict.is_safe(), "{control}: {:#?}", verdict.found);
        assert!(outcome.setups[0].posted.text.contains(word), "{control}");
        assert!(outcome.setups[0].posted.text.contains("POSITIVE LEAVES STOCK"), "{control}");
        let proof = verdict.proven.iter().find(|p| p.claim.starts_with("1 milled thread:")).unwrap();
        assert!(proof.bound.contains("wear register"), "{control}: {}", proof.bound);
        let sections = format!("{:?}", kinecut::job::report::of_job(&outcome).sections);
        assert!(sections.contains("with 0.03 mm in the wear register"), "{control}: {sections}");
        let found = helices(&outcome, 4, [20.0, 10.0], 1.25);
        for diameter in pitch_diameters(&found[0], 5.0, [1.25, crest(1.25, true)], true) {
            // The overcut changes a little with the radius.
            let off = diameter - (7.188101183952089 - 0.06);
            assert!(off.abs() < 3e-3, "{control}: {off}");
        }
        let wall = &outcome.deviation.bores[0];
        assert!(wall.ends > 300 && wall.worst() < 2e-3, "{control}: {wall:?}");
    }
    let error = attempt("grbl", &format!("{M8}depth = 8\nwear_offset = \"D104\"\n")).unwrap_err();
    assert_eq!(
        (error.code(), error.0.key.as_deref()),
        (Code::POST_CONTROL, Some("setup[0].operation[0].wear_offset"))
    );
}

#[test]
fn a_core_hole_of_an_operation_before_is_one_and_a_pattern_is_milled_place_by_place() {
    let bore = "[[setup.operation]]\ntype = \"bore\"\ntool = 1\nat = [0, -12]\ndiameter = 17.294\ndepth = 26\n\
        strategy = \"involute\"\nentry = \"plunge\"\nspeed = 5000\nrough = { stepover = 2, feed = 900 }\n";
    let both = M20.replace("[[-20, 5]]", "[[-20, 5], [0, -12]]");
    let outcome = cut("sinumerik-840d", &format!("{bore}{both}depth = 20\n"));
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
    assert!(outcome.verdict.proven.iter().any(|p| p.claim.starts_with("2 milled threads")));
    // Deeper than 20 + 1.25 + 0.625 + 0.625 in the blind one.
    let error = attempt("sinumerik-840d", &format!("{bore}{both}depth = 24\n")).unwrap_err();
    let text = error.to_string();
    assert_eq!(error.0.key.as_deref(), Some("setup[0].operation[1].points[1]"), "{text}");
    for part in ["26 deep", "24 + 1.875", "bore to 26.5"] {
        assert!(text.contains(part), "no `{part}` in {text}");
    }
}

/// The error of an operation: code, key, message.
fn refused(operation: &str) -> (Code, String, String) {
    let error = attempt("fanuc", operation).expect_err(operation);
    (error.code(), error.0.key.clone().unwrap_or_default(), error.to_string())
}

#[test]
fn errors_have_their_place_their_numbers_and_a_cure() {
    let m8 = format!("{M8}depth = 12\n");
    let of = |from: &str, to: &str| {
        assert!(m8.contains(from), "{from}");
        refused(&m8.replace(from, to))
    };
    for (found, code, key, parts) in [
        (
            of("size = \"M8\"", "size = \"M10\"\ncore = { diameter = 8.376 }"),
            Code::THREAD_TOOL,
            "tool",
            vec!["pitch of 1.25, the thread 1.5"],
        ),
        (of("size = \"M8\"", "size = \"M8.5\""), Code::PLAN_VALUE, "size", vec!["no coarse pitch"]),
        (of("size = \"M8\"", "size = \"G1/2\""), Code::PLAN_VALUE, "size", vec!["M20x1.5"]),
        (of("size = \"M8\"", "size = \"M8\"\npitch = 1"), Code::JOB_SHAPE, "pitch", vec!["exclude"]),
        (of("size = \"M8\"\n", ""), Code::JOB_SHAPE, "tool", vec!["size = \"M8\""]),
        (of("size = \"M8\"", "diameter = 8"), Code::JOB_SHAPE, "diameter", vec!["pitch"]),
        (of("size = \"M8\"", "diameter = 8\npitch = 6"), Code::PLAN_VALUE, "pitch", vec!["too large"]),
        (
            of("tool = 4", "tool = 1"),
            Code::JOB_REFERENCE,
            "tool",
            vec!["T1 is no thread mill", "thread-mill"],
        ),
        (of("tool = 4", "tool = 9"), Code::JOB_REFERENCE, "tool", vec!["T9"]),
        (
            of("size = \"M8\"", "size = \"M8\"\ncore = { diameter = 6.4 }"),
            Code::THREAD_CORE,
            "points[0]",
            vec!["is 6.4", "needs 6.647", "bore 6.647"],
        ),
        (
            of("size = \"M8\"", "size = \"M8\"\ncore = { diameter = 8.1 }"),
            Code::THREAD_CORE,
            "points[0]",
            vec!["no thread"],
        ),
        (
            of("size = \"M8\"", "size = \"M8\"\ncore = { diameter = 6.647, depth = 12 }"),
            Code::THREAD_CORE,
            "points[0]",
            vec!["12 deep", "bore to 13.3"],
        ),
        (
            of("size = \"M8\"", "size = \"M8\"\nside = \"outside\"\ncore = { diameter = 6.647 }"),
            Code::JOB_SHAPE,
            "core",
            vec!["boss"],
        ),
        (
            of("size = \"M8\"", "size = \"M8\"\ninfeed = [0.7, 0.9]"),
            Code::PLAN_VALUE,
            "infeed[1]",
            vec!["1.0"],
        ),
        (
            of("depth = 12", "depth = 22"),
            Code::THREAD_TOOL,
            "tool",
            vec!["shank of 6 mm", "22 above its tip"],
        ),
        (of("feed = 500\n", ""), Code::JOB_SHAPE, "", vec!["feed"]),
        (
            of("depth = 12", "depth = 12\nclearance = 0"),
            Code::JOB_VALUE,
            "clearance",
            vec!["below the start of the thread", "raise `clearance` above `top`"],
        ),
        (
            of("depth = 12", "depth = 12\ntop = 3\nclearance = 2.5"),
            Code::JOB_VALUE,
            "clearance",
            vec!["2.5", "3"],
        ),
        (
            of(
                "points = [[20, 10]]",
                "spring_passes = 5\npattern = { grid = { at = [-39, -29], step = [0.1, 0.1], count = [200, 100] } }",
            ),
            Code::PLAN_VALUE,
            "pattern",
            vec!["too many moves and turns of milled threads"],
        ),
        (
            of("size = \"M8\"", "size = \"M8\"\ninfeed = [0.03, 1.0]"),
            Code::PLAN_VALUE,
            "infeed[0]",
            vec!["does not reach the wall of the hole", "write more than 0.036"],
        ),
    ] {
        let (found_code, found_key, text) = found;
        let wanted = if key.is_empty() {
            "setup[0].operation[0]".to_owned()
        } else {
            format!("setup[0].operation[0].{key}")
        };
        assert_eq!((found_code, found_key), (code, wanted), "{text}");
        for part in parts {
            assert!(text.contains(part), "no `{part}` in {text}");
        }
    }
}

#[test]
fn a_missing_or_wide_core_hole_is_a_warning_and_the_missing_one_is_met_in_the_stock() {
    let found = |operations: &str| cut("fanuc", operations);
    let missing = found(&format!("{}depth = 6\n", M8.replace("[[20, 10]]", "[[0, 0]]")));
    let told = missing.verdict.found.iter().find(|f| f.code == Code::THREAD_CORE).unwrap();
    assert!(told.severity == Severity::Warning && told.message.contains("M8x1.25 at X0 Y0: no core hole"));
    assert!(
        !missing.verdict.is_safe() && missing.verdict.found.iter().any(|f| f.code == Code::RAPID_IN_STOCK)
    );
    let wide = found(&format!("{M8}depth = 6\ncore = {{ diameter = 7.0 }}\n"));
    let told = wide.verdict.found.iter().find(|f| f.code == Code::THREAD_CORE).unwrap();
    assert!(told.message.contains("largest of class 6H is 6.916"), "{}", told.message);
}

#[test]
fn a_core_hole_of_another_form_is_warned_of_where_it_leaves_less_than_three_quarters() {
    // The minor diameter is 6.399, the thread 0.800 high.
    let whitworth = |core: f64| {
        let thread = M8.replace("size = \"M8\"", "diameter = 8\npitch = 1.25\nform = \"whitworth\"");
        let text = job("fanuc", &format!("{thread}depth = 6\ncore = {{ diameter = {core} }}\n"));
        let text = text.replacen("pitch = 1.25\nteeth", "pitch = 1.25\nhalf_angle = 27.5\nteeth", 1);
        let outcome =
            run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"));
        let found = outcome.verdict.found.iter().find(|f| f.code == Code::THREAD_CORE);
        found.map(|f| (f.severity, f.message.clone()))
    };
    assert_eq!(whitworth(6.75), None);
    let (severity, told) = whitworth(6.9).unwrap();
    assert_eq!(severity, Severity::Warning);
    assert!(told.contains("is 6.9: more than 6.799 leaves less than three quarters"), "{told}");
}

#[test]
fn the_pitch_diameter_of_a_profile_of_the_maker_is_not_claimed() {
    let outcome = cut("fanuc", &format!("{M8}depth = 6\nprofile = \"corrected\"\n"));
    let verdict = &outcome.verdict;
    assert!(verdict.is_safe(), "{:#?}", verdict.found);
    let claim = verdict.proven.iter().find(|p| p.claim.starts_with("1 milled thread:")).unwrap();
    assert!(claim.claim.ends_with("depth of the thread"), "{}", claim.claim);
    let left = format!("{:?}", verdict.not_checked);
    assert!(left.contains("pitch diameter of 1 milled thread: it depends on the profile"), "{left}");
    let json: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
    let own = &json["setups"][0]["milled_threads"][0];
    assert!(own["deviation"].is_null() && own["profile"] == "corrected", "{own}");
}

#[test]
fn an_oversize_is_in_the_report_and_the_plan() {
    let outcome = cut("fanuc", &format!("{M8}depth = 6\noversize = 0.08\n"));
    assert!(outcome.verdict.is_safe(), "{:#?}", outcome.verdict.found);
    let json: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
    let own = &json["setups"][0]["milled_threads"][0];
    let of = |key: &str| own[key].as_f64().unwrap();
    assert_eq!(of("oversize"), 0.08);
    assert!((of("pitch_diameter") - 7.188101183952089).abs() < 1e-9 && of("deviation") < 2e-3, "{own}");
    let sections = format!("{:?}", kinecut::job::report::of_job(&outcome).sections);
    assert!(sections.contains("pitch diameter 7.188 mm, oversize 0.08 mm"), "{sections}");
    let found = helices(&outcome, 4, [20.0, 10.0], 1.25);
    for diameter in pitch_diameters(&found[0], 5.0, [1.25, crest(1.25, true)], true) {
        assert!((diameter - 7.268101183952089).abs() < 2e-3, "{diameter}");
    }
}

#[test]
fn a_thread_of_half_a_pitch_has_no_wall_that_is_measured_and_that_is_said() {
    let said = |depth: f64| {
        let outcome = cut("fanuc", &format!("{M8}depth = {depth}\n"));
        let left = format!("{:?}", outcome.verdict.not_checked);
        (left.contains("the wall of the crests"), left.contains("at most half a pitch deep"))
    };
    assert_eq!(said(0.6), (true, true));
    assert_eq!(said(2.0), (false, false));
}

#[test]
fn tools_that_are_no_thread_mills_have_none_of_their_keys() {
    let text = job("fanuc", &format!("{M8}depth = 6\n"));
    let wrong = |from: &str, to: &str| {
        let text = text.replacen(from, to, 1);
        let error = run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_err();
        // A value of the tool comes with what to write instead.
        assert!(error.code() != Code::TOOL_VALUE || !error.0.help.is_empty(), "{error}");
        (error.code(), error.0.key.clone().unwrap_or_default(), error.to_string())
    };
    for (from, to, code, key) in [
        ("teeth = 4\nflute_length = 32", "rows = 2\nflute_length = 32", Code::JOB_SHAPE, "tool[0].rows"),
        ("pitch = 1.25\n", "", Code::JOB_SHAPE, "tool[1].type"),
        ("pitch = 1.25\n", "pitch = -1\n", Code::TOOL_VALUE, "tool[1].pitch"),
        ("pitch = 1.25\n", "pitch = 1.25\nrows = 0\n", Code::TOOL_VALUE, "tool[1].rows"),
        ("pitch = 1.25\n", "pitch = 1.25\nrows = 2\n", Code::TOOL_VALUE, "tool[1].flute_length"),
        ("neck_diameter = 2.8\n", "", Code::JOB_SHAPE, "tool[1].neck_length"),
        ("neck_diameter = 2.8\n", "neck_diameter = 5.2\n", Code::TOOL_VALUE, "tool[1].neck_diameter"),
        ("neck_length = 22\n", "neck_length = 50\n", Code::TOOL_VALUE, "tool[1].neck_length"),
        ("pitch = 1.25\n", "pitch = 1.25\nhalf_angle = 60\n", Code::TOOL_VALUE, "tool[1].half_angle"),
    ] {
        let (found, at, text) = wrong(from, to);
        assert_eq!((found, at.as_str()), (code, key), "{text}");
    }
}

#[test]
fn a_tap_on_grbl_is_referred_to_this() {
    let tap = "[[setup.operation]]\ntype = \"tap\"\ntool = 1\npoints = [[20, 10]]\nspeed = 300\ndepth = 6\n";
    let error = attempt("grbl", tap).unwrap_err().to_string();
    assert!(error.contains("type = \"thread-mill\" cuts this thread"), "{error}");
}
