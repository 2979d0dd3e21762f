//! Contours through the whole: posted for each control, read back, cut, and their walls measured.

use kinecut::base::{Code, MemoryLoader, Severity, Silent};
use kinecut::job::{Outcome, run};

use crate::common::quads::{ring, sides, stl, turned};

pub(super) fn job(control: &str, operation: &str) -> String {
    format!(
        r#"format = 1
post = {{ control = "{control}" }}
stock = {{ box = {{ min = [-80, -50, -20], max = [80, 50, 0] }} }}
simulate = {{ step = 0.5, engagement = false }}
[[tool]]
number = 1
type = "end-mill"
diameter = 10
teeth = 4
flute_length = 26
stickout = 40
gauge_length = 120
[[setup]]
offset = "G54"
[[setup.operation]]
type = "contour"
tool = 1
speed = 6000
feed = 1200
stepdown = 5
{operation}
"#
    )
}

fn done(job: &str, loader: &MemoryLoader) -> Outcome {
    run("job.toml", job, loader, &Silent).unwrap_or_else(|e| panic!("{e}"))
}

fn cut(control: &str, operation: &str) -> Outcome {
    done(&job(control, operation), &MemoryLoader::default())
}

fn refused(operation: &str) -> kinecut::base::Error {
    run("job.toml", &job("fanuc", operation), &MemoryLoader::default(), &Silent).unwrap_err()
}

const PLATE: &str = "rectangle = { size = [120, 70], corner = 6 }\ndepth = 20\nbreakthrough = 0.5\n";
const TABS: &str = "tabs = { count = 4, width = 6, height = 1.5 }\n";

fn removed(outcome: &Outcome) -> f64 {
    outcome.simulation.raw_volume - outcome.simulation.stock.volume()
}

/// Area of the slot of 10 mm around the plate, without leads [mm2].
fn slot() -> f64 {
    let around = 2.0 * (108.0 + 58.0);
    10.0 * around + std::f64::consts::PI * (16.0_f64.powi(2) - 6.0_f64.powi(2))
}

#[test]
fn a_plate_with_tabs_is_safe_on_every_control() {
    for control in ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"] {
        let outcome =
            cut(control, &format!("{PLATE}{TABS}finish = {{ allowance = 0.2, spring_passes = 1 }}"));
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        assert!(outcome.verdict.found.is_empty(), "{control}: {:?}", outcome.verdict.found);
        let claim = outcome.verdict.proven.iter().find(|p| p.claim.contains("the wall lies within"));
        assert!(claim.is_some(), "{control}");
    }
}

#[test]
fn tabs_keep_the_volume_that_they_say() {
    let whole = cut("fanuc", PLATE);
    // The lead-out, and nothing else, is beside the slot.
    let leads = removed(&whole) - 20.0 * slot();
    assert!(leads > 0.0 && leads < 20.0 * 30.0, "{leads}");
    let held = cut("fanuc", &format!("{PLATE}{TABS}"));
    // Of each tab the slot's width, as long as the cutter is lifted, less the half discs that it cuts into both ends.
    let tab = (16.0 * 10.0 - std::f64::consts::PI * 25.0) * 1.5;
    let kept = removed(&whole) - removed(&held);
    assert!((kept - 4.0 * tab).abs() < 0.02 * kept, "{kept}, not {}", 4.0 * tab);
    // Without tabs the part comes loose.
    let loose =
        |o: &Outcome| o.verdict.found.iter().any(|f| f.code == Code::SLUG && f.severity == Severity::Warning);
    assert!(loose(&whole) && !loose(&held));
}

#[test]
fn walls_of_all_sides_are_measured() {
    let pocket = "side = \"inside\"\npolygon = [[-40, -30], [40, -30], [40, 30], [10, 30], [10, 5], [-10, 5], [-10, 30], [-40, 30]]\ndepth = 8\n";
    for (operation, corners) in [
        ("circle = { at = [10, 5], diameter = 60 }\ndepth = 8\n", 0),
        ("side = \"inside\"\ncircle = { diameter = 60 }\ndepth = 8\nentry = \"plunge\"\n", 0),
        (
            "rectangle = { size = [60, 40], corner = 4, angle = 25 }\ndepth = 8\ndirection = \"conventional\"\nfeed_at = \"wall\"\n",
            0,
        ),
        (pocket, 6),
        ("side = \"inside\"\nrectangle = { size = [60, 40] }\ndepth = 8\nstock_to_leave = 0.4\n", 4),
    ] {
        let outcome = cut("linuxcnc", operation);
        assert!(outcome.verdict.is_safe(), "{operation}: {:?}", outcome.verdict.found);
        let wall = &outcome.deviation.bores[0];
        assert!(wall.ends > 3000 && wall.worst() < 1e-3, "{operation}: {wall:?}");
        assert!(wall.floor.is_some_and(|f| f[0].abs() < 1e-3 && f[1].abs() < 1e-3), "{operation}: {wall:?}");
        let warned = outcome.verdict.found.iter().filter(|f| f.code == Code::CORNERS_STAY).count();
        assert_eq!(warned, usize::from(corners > 0), "{operation}");
        let told = outcome
            .verdict
            .unchecked()
            .any(|item| format!("{item:?}").contains("beyond the cutter's fillet"));
        assert_eq!(told, corners > 0, "{operation}");
    }
}

#[test]
fn the_floor_of_a_blind_contour_is_compared_on_all_of_its_width() {
    let blind = "rectangle = { size = [60, 40], corner = 4 }\ndepth = 8\n";
    let claims = |o: &Outcome, words: &str| o.verdict.proven.iter().any(|p| p.claim.contains(words));
    let whole = cut("fanuc", blind);
    assert!(whole.verdict.is_safe() && claims(&whole, "wall and floor lie within"));
    assert!(!claims(&whole, "the wall lies within"));
    // A groove in the floor, in the half of the slot that is away from the wall.
    let groove = "[[setup.operation]]\ntype = \"contour\"\ntool = 2\nspeed = 6000\nfeed = 600\nside = \"on\"\n\
        rectangle = { size = [76, 56], corner = 12 }\ndepth = 8.2\nstepdown = 4.1\n";
    let tool = "[[tool]]\nnumber = 2\ntype = \"end-mill\"\ndiameter = 3\nteeth = 2\nflute_length = 9\nstickout = 30\n\
        gauge_length = 120\n[[setup]]";
    let both = job("fanuc", &format!("{blind}{groove}")).replace("[[setup]]", tool);
    let deep = done(&both, &MemoryLoader::default());
    let floor = deep.deviation.bores[0].floor.unwrap();
    assert!((floor[0] + 0.2).abs() < 1e-3, "{floor:?}");
    assert!(deep.verdict.found.iter().any(|f| f.code == Code::WALL_GOUGED), "{:?}", deep.verdict.found);
}

#[test]
fn the_fillet_of_a_cutter_with_a_corner_is_no_stock() {
    let bull = job("fanuc", "rectangle = { size = [60, 40], corner = 4 }\ndepth = 8\n").replace(
        "type = \"end-mill\"\ndiameter = 10",
        "type = \"bull-nose\"\ndiameter = 10\ncorner_radius = 1.5",
    );
    let outcome = done(&bull, &MemoryLoader::default());
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    let wall = &outcome.deviation.bores[0];
    let floor = wall.floor.unwrap();
    assert!(wall.worst() < 1e-3 && floor[0].abs() < 1e-3 && floor[1].abs() < 1e-3, "{wall:?}");
}

#[test]
fn stock_is_left_and_the_wear_register_moves_the_wall() {
    let left = cut("linuxcnc", &format!("{PLATE}{TABS}stock_to_leave = 0.4\n"));
    assert!(left.verdict.is_safe() && left.deviation.bores[0].worst() < 1e-3);
    let more = removed(&left) - removed(&cut("linuxcnc", &format!("{PLATE}{TABS}")));
    // The slot moves outwards by 0.4, and is as much longer; volumes are known to half a line at each wall.
    assert!((more - std::f64::consts::TAU * 0.4 * 10.0 * 20.0).abs() < 250.0, "{more}");
    for (control, register) in
        [("linuxcnc", "D7"), ("sinumerik-840d", "D2"), ("fanuc", "D101"), ("heidenhain", "D2")]
    {
        let finish = |value: f64| {
            let tabs = "tabs = { count = 4, width = 6, height = 1.5, shape = \"ramp\" }\n";
            let finish = format!("finish = {{ wear_offset = \"{register}\", wear_value = {value} }}");
            cut(control, &format!("{PLATE}{tabs}{finish}"))
        };
        let (plain, worn) = (finish(0.0), finish(0.03));
        // Against the wall where the register's value has it.
        for outcome in [&plain, &worn] {
            assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
            let wall = &outcome.deviation.bores[0];
            assert!(wall.ends > 3000 && wall.worst() < 2e-3, "{control}: {wall:?}");
        }
    }
    let grbl = run(
        "job.toml",
        &job("grbl", &format!("{PLATE}{TABS}finish = {{ wear_offset = \"D2\" }}")),
        &MemoryLoader::default(),
        &Silent,
    );
    assert_eq!(grbl.unwrap_err().0.key.as_deref(), Some("setup[0].operation[0].finish.wear_offset"));
}

#[test]
fn holes_hardly_wider_than_the_cutter_have_a_lead() {
    for diameter in [10.2, 10.6, 11.0, 12.0] {
        let hole = format!("side = \"inside\"\ncircle = {{ diameter = {diameter} }}\ndepth = 3");
        let outcome = cut("linuxcnc", &hole);
        assert!(outcome.verdict.is_safe(), "{diameter}: {:?}", outcome.verdict.found);
        assert!(outcome.deviation.bores[0].worst() < 1e-3, "{diameter}: {:?}", outcome.deviation.bores[0]);
    }
    // A lead that is asked for stays, and is refused with its place.
    let given = refused("side = \"inside\"\ncircle = { diameter = 11 }\ndepth = 3\nlead_radius = 2");
    assert!(given.code() == Code::LEAD_ROOM && given.0.message.contains("at ("), "{given}");
}

#[test]
fn a_drawing_is_cut_by_its_layers() {
    let drawing = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n\
        0\nLWPOLYLINE\n8\nPART\n90\n4\n70\n1\n10\n0\n20\n0\n10\n90\n20\n0\n42\n0.2\n10\n90\n20\n50\n10\n0\n20\n50\n\
        0\nCIRCLE\n8\nHOLES\n10\n20\n20\n25\n40\n9\n0\nENDSEC\n0\nEOF\n";
    let loader = MemoryLoader::default().with("plate.dxf", drawing);
    let of = |more: &str| {
        let operation = format!("outline = \"plate.dxf\"\nat = [-45, -25]\ndepth = 6\n{more}");
        done(&job("fanuc", &operation), &loader)
    };
    for (more, outer, loops) in
        [("", true, 2), ("layers = [\"PART\"]\n", true, 1), ("loops = \"inner\"\n", false, 1)]
    {
        let outcome = of(more);
        assert!(outcome.verdict.is_safe(), "{more}: {:?}", outcome.verdict.found);
        assert!(outcome.deviation.bores[0].worst() < 1e-3, "{more}");
        let json: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
        let contour = &json["setups"][0]["contours"][0];
        let own = contour["loops"].as_array().unwrap();
        assert_eq!(own.len(), loops, "{more}");
        assert_eq!(own[loops - 1]["outer"], outer, "{more}");
    }
}

#[test]
fn what_makes_no_contour_is_refused_with_a_cure() {
    let key = |e: &kinecut::base::Error| e.0.key.clone().unwrap_or_default();
    let under = |key: &str| format!("setup[0].operation[0].{key}");
    let none = refused("depth = 3");
    assert!(none.code() == Code::JOB_SHAPE && none.0.help.contains("rectangle = {"), "{none}");
    let two = refused("circle = { diameter = 40 }\nrectangle = { size = [40, 30] }\ndepth = 3");
    assert_eq!((two.code(), key(&two)), (Code::JOB_SHAPE, under("outline")));
    let corner = refused("rectangle = { size = [40, 30], corner = 16 }\ndepth = 3");
    assert_eq!(key(&corner), under("rectangle.corner"));
    let narrow = refused("side = \"inside\"\nrectangle = { size = [40, 9] }\ndepth = 3");
    let widest = narrow.0.bound.as_ref().unwrap().value;
    assert!(narrow.code() == Code::CUTTER_TOO_LARGE && (8.95..=9.0).contains(&widest), "{narrow}");
    // Not the size of the loop, but the gap beside it.
    let ring = "side = \"outside\"\noutline = { loops = [ { centre = [0, 0], radius = 40 }, \
        { centre = [0, 0], radius = 30 }, { centre = [0, 0], radius = 27 } ] }\ndepth = 3";
    let ring = refused(ring);
    let gap = ring.0.bound.as_ref().unwrap().value;
    assert!(ring.code() == Code::CUTTER_TOO_LARGE && (2.9..=3.0).contains(&gap), "{ring}");
    assert!(ring.0.message.contains("nor along another loop"), "{ring}");
    let tabs = refused(
        "circle = { diameter = 40 }\ndepth = 3\ntabs = { count = 3, places = [[0, 0]], width = 3, height = 1 }",
    );
    assert_eq!(key(&tabs), under("tabs.count"));
    let feeds = refused("circle = { diameter = 40 }\ndepth = 3\nfeed_per_tooth = 0.05");
    assert_eq!(key(&feeds), under("feed"));
    let open = refused("polygon = [[0, 0], [40, 0], [0, 30], [40, 30]]\ndepth = 3");
    assert_eq!((open.code(), key(&open)), (Code::OUTLINE_CROSSES, under("polygon")));
}

#[test]
fn the_example_is_safe_and_leaves_its_tabs() {
    let outcome = super::examples::run("19_outline_with_tabs", &[("step = 0.25", "step = 0.5")]);
    assert!(outcome.verdict.is_safe() && outcome.verdict.found.is_empty(), "{:?}", outcome.verdict.found);
    assert!(outcome.deviation.bores.iter().all(|wall| wall.ends > 500 && wall.worst() < 1e-3));
    // Part, core and frame are one body: nothing has come loose.
    let triangles = &outcome.part.triangles;
    let mut body: Vec<u32> = (0..outcome.part.vertices.len() as u32).collect();
    fn root(body: &mut [u32], mut i: u32) -> u32 {
        while body[i as usize] != i {
            body[i as usize] = body[body[i as usize] as usize];
            i = body[i as usize];
        }
        i
    }
    for t in triangles {
        let [a, b, c] = t.map(|v| root(&mut body, v));
        body[b as usize] = a;
        let c = root(&mut body, c);
        body[c as usize] = a;
    }
    let roots: std::collections::BTreeSet<u32> = triangles.iter().map(|t| root(&mut body, t[0])).collect();
    assert_eq!(roots.len(), 1);
}

#[test]
fn open_lines_are_cut_on_every_control() {
    let bent = "polyline = [[-80, -20], [20, -20, 0.2], [40, 10], [40, 50]]\ndepth = 8\n";
    for control in ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"] {
        for side in ["left", "right"] {
            let finish = "finish = { allowance = 0.2 }\n";
            let outcome = cut(control, &format!("side = \"{side}\"\n{bent}{finish}"));
            assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
            // On the left the arc and the lines beside it meet in inside corners.
            let corners = outcome.verdict.found.iter().filter(|f| f.code == Code::CORNERS_STAY).count();
            assert_eq!(corners, usize::from(side == "left"), "{control}");
            assert_eq!(outcome.verdict.found.len(), corners, "{control}: {:?}", outcome.verdict.found);
            // Beside the stock it comes straight down: no move goes down along the line.
            let program = &outcome.setups[0].posted.text;
            let mut moves = program.lines().filter(|l| !l.contains("BLK FORM"));
            assert!(moves.all(|l| !(l.contains('X') && l.contains(" Z-"))), "{control}: {program}");
            let wall = &outcome.deviation.bores[0];
            assert!(wall.ends > 1500 && wall.worst() < 1e-3, "{control}: {wall:?}");
            assert!(
                wall.floor.is_some_and(|f| f[0].abs() < 1e-3 && f[1].abs() < 1e-3),
                "{control}: {wall:?}"
            );
        }
    }
    let worn = "side = \"left\"\nfinish = { allowance = 0.2, wear_offset = \"D2\" }\n";
    let outcome = cut("sinumerik-840d", &format!("{worn}{bent}"));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    let on = cut("fanuc", &format!("side = \"on\"\nentry = {{ ramp = 4 }}\n{bent}"));
    assert!(on.verdict.is_safe(), "{:?} {:?}", on.verdict.outcome, on.verdict.found);
    let arc = 2.0_f64;
    assert!(removed(&on) > arc * 8.0 * 10.0 * 60.0);
}

#[test]
fn a_line_within_the_stock_is_entered_by_a_ramp() {
    let inner = "polyline = [[-40, -20], [20, -20], [20, 10]]\nside = \"left\"\ndepth = 8\nextend = 0\n";
    let outcome = cut("linuxcnc", inner);
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    assert!(outcome.deviation.bores[0].worst() < 1e-3);
    // 3 degrees, and none of it straight down into the stock: each level is reached along the line, to and fro.
    let program = &outcome.setups[0].posted.text;
    let is_slope = |l: &&str| l.contains(" Z-") && (l.contains('X') || l.contains('Y'));
    assert!(program.lines().filter(is_slope).count() >= 4, "{program}");
}

#[test]
fn lines_of_drawings_keep_their_direction() {
    // The second line is drawn against the first; a closed circle beside them.
    let entity = |kind: &str, rest: &str| format!("0\n{kind}\n8\nedge\n{rest}");
    let dxf = [
        "0\nSECTION\n2\nENTITIES\n".to_owned(),
        entity("LINE", "10\n-90\n20\n-20\n11\n20\n21\n-20\n"),
        entity("LINE", "10\n20\n20\n60\n11\n20\n21\n-20\n"),
        entity("CIRCLE", "10\n-40\n20\n20\n40\n8\n"),
        "0\nENDSEC\n0\nEOF\n".to_owned(),
    ]
    .concat();
    let loader = MemoryLoader::default().with("part.dxf", dxf.into_bytes());
    let of = |side: &str| {
        job("fanuc", &format!("outline = \"part.dxf\"\nunit = \"mm\"\nside = \"{side}\"\ndepth = 8\n"))
    };
    let outcome = done(&of("left"), &loader);
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    // Left of the first line is above it: the corner there is an inside one.
    assert!(outcome.verdict.found.iter().any(|f| f.code == Code::CORNERS_STAY));
    let right = done(&of("right"), &loader);
    assert!(right.verdict.is_safe() && right.verdict.found.is_empty(), "{:?}", right.verdict.found);
    let outside = run("job.toml", &of("outside"), &loader, &Silent).unwrap_err();
    assert!(outside.0.help.contains("side = \"left\""), "{outside}");
}

#[test]
fn wrong_lines_are_refused_with_their_key() {
    for (operation, key) in [
        ("side = \"left\"\ncircle = { diameter = 40 }\ndepth = 5\n", "side"),
        ("polyline = [[0, 0], [40, 0]]\ndepth = 5\n", "side"),
        ("side = \"left\"\npolyline = [[0, 0]]\ndepth = 5\n", "polyline"),
        ("side = \"left\"\npolyline = [[0, 0], [40, 0], [40]]\ndepth = 5\n", "polyline[2]"),
        ("side = \"left\"\npolyline = [[0, 0], [40, 0]]\ncircle = { diameter = 4 }\ndepth = 5\n", "polyline"),
        ("circle = { diameter = 40 }\nextend = 3\ndepth = 5\n", "extend"),
        ("side = \"left\"\npolyline = [[0, 0], [40, 0], [40, 8], [4, 8], [4, 4]]\ndepth = 5\n", "extend"),
        (
            "side = \"left\"\npolyline = [[0, 0], [40, 0]]\ndepth = 5\ntabs = { width = 4, height = 1 }\n",
            "tabs",
        ),
    ] {
        let e = refused(operation);
        assert!(e.0.key.as_deref().is_some_and(|k| k.ends_with(key)), "{operation}: {e} {:?}", e.0.key);
        assert!(!e.0.help.is_empty(), "{e}");
    }
}

#[test]
fn a_groove_that_nobody_wants_in_a_wall_is_a_gouge_of_it() {
    let groove = |line: &str, depth: f64| {
        format!(
            "[[setup.operation]]\ntype = \"contour\"\ntool = 1\nspeed = 6000\nfeed = 600\nside = \"on\"\n\
             polyline = {line}\ndepth = {depth}\nstepdown = 5\n"
        )
    };
    let bounds = |outcome: &Outcome| outcome.deviation.bores[0].wall;
    let is_gouged = |outcome: &Outcome| outcome.verdict.found.iter().any(|f| f.code == Code::WALL_GOUGED);
    let plate = "rectangle = { size = [90, 40] }\ndepth = 10\n";
    let line = "side = \"left\"\npolyline = [[-90, -20], [90, -20]]\ndepth = 10\n";
    // 0.6 mm beyond the wall, along it: the middle of the groove lies 4.4 mm before it.
    for (wall, along) in [(plate, "[[-20, 24.4], [20, 24.4]]"), (line, "[[-20, -15.6], [20, -15.6]]")] {
        let deep = cut("fanuc", &format!("{wall}{}", groove(along, 8.0)));
        assert!(!deep.verdict.is_safe() && is_gouged(&deep), "{wall}: {:?}", deep.verdict.found);
        assert!((bounds(&deep)[0] + 0.6).abs() < 1e-3, "{wall}: {:?}", bounds(&deep));
        // The same groove before the wall is made.
        let first = groove(along, 8.0).split_once("tool = 1\n").unwrap().1.to_owned();
        let rest = format!(
            "\n[[setup.operation]]\ntype = \"contour\"\ntool = 1\nspeed = 6000\nfeed = 1200\nstepdown = 5\n{wall}"
        );
        let before = first.replace("speed = 6000\nfeed = 600\n", "").replace("stepdown = 5\n", "");
        let before = cut("fanuc", &format!("{before}{rest}"));
        assert!(is_gouged(&before), "{wall}: {:?}", before.verdict.found);
        // Short of the wall it is within what is wanted, or beside it.
        let short = along.replace("24.4", "25.2").replace("15.6", "14.8");
        let short = cut("fanuc", &format!("{wall}{}", groove(&short, 8.0)));
        assert!(short.verdict.is_safe() && !is_gouged(&short), "{wall}: {:?}", short.verdict.found);
    }
    // One that runs out of the wall, square to it, has sides of its own; no face of it looks to the wall but its end, far behind.
    let out = cut("fanuc", &format!("{plate}{}", groove("[[0, 0], [0, 40]]", 8.0)));
    assert!(out.verdict.is_safe() && !is_gouged(&out), "{:?}", out.verdict.found);
}

#[test]
fn loops_beside_one_another_take_all_of_the_stock() {
    let plate = "rectangle = { size = [90, 40] }\ndepth = 8\nstepover = 7\n";
    let outcome = cut("fanuc", plate);
    assert!(outcome.verdict.is_safe() && outcome.verdict.found.is_empty(), "{:?}", outcome.verdict.found);
    assert!((removed(&outcome) / (8.0 * (160.0 * 100.0 - 90.0 * 40.0)) - 1.0).abs() < 1e-3);
    let engaged = cut("fanuc", &format!("{plate}passes = 2\nfinish = {{ allowance = 0.3 }}\n"));
    assert!(engaged.verdict.is_safe(), "{:?}", engaged.verdict.found);
    let ring = |d: f64| (90.0 + 40.0) * 2.0 * d + std::f64::consts::PI * d * d;
    // As wide as the cutter, the step and what finishing takes; and the leads. The walls lie between lines of the stock, which are
    // half a millimetre apart.
    let groove = 8.0 * ring(17.3);
    let more = removed(&engaged) - groove;
    let between = 0.25 * 8.0 * 2.0 * (124.6 + 74.6);
    assert!(more > -between && more < between + 8.0 * 30.0, "{more}");
    let left = cut("fanuc", "polyline = [[-80, -20], [80, -20]]\nside = \"left\"\ndepth = 8\nstepover = 8\n");
    assert!(left.verdict.is_safe(), "{:?}", left.verdict.found);
    assert!((removed(&left) / (8.0 * 160.0 * 70.0) - 1.0).abs() < 1e-3, "{}", removed(&left));
    for (operation, key) in [
        ("rectangle = { size = [90, 40] }\ndepth = 8\npasses = 3\n", "passes"),
        ("rectangle = { size = [90, 40] }\ndepth = 8\nside = \"inside\"\nstepover = 3\n", "passes"),
        ("rectangle = { size = [90, 40] }\ndepth = 8\npasses = 3\nstepover = 11\n", "stepover"),
        ("rectangle = { size = [90, 40] }\ndepth = 8\npasses = 0\nstepover = 5\n", "passes"),
        ("rectangle = { size = [90, 40] }\ndepth = 8\nstepover = 0.001\n", "stepover"),
    ] {
        let e = refused(operation);
        assert!(e.0.key.as_deref().is_some_and(|k| k.ends_with(key)), "{operation}: {e}");
    }
}

/// A plate of 60 by 40 by 20 with a square hole of 20 in its middle, as an STL in text; the hole ends 12 mm below the top.
pub(super) fn plate_with_hole() -> Vec<u8> {
    let (top, bottom) = (ring([30.0, 20.0], 0.0), ring([30.0, 20.0], -20.0));
    let (rim, floor) = (ring([10.0, 10.0], 0.0), ring([10.0, 10.0], -12.0));
    let walls = [sides(bottom, top), sides(top, rim), sides(rim, floor)].concat();
    stl(&[walls, vec![floor, turned(bottom)]].concat())
}

#[test]
fn a_mesh_is_cut_at_a_height_for_its_outline_and_for_what_it_encloses() {
    let loader = MemoryLoader::default().with("plate.stl", plate_with_hole());
    let of = |operation: &str| run("job.toml", &job("fanuc", operation), &loader, &Silent);
    let contour = |z: f64, rest: &str| format!("outline = \"plate.stl\"\nsection = {z}\ndepth = 6\n{rest}");
    // Above the floor of the hole the section has two loops, below it one.
    for (z, rest, loops) in [(-5.0, "", 2), (-5.0, "loops = \"outer\"\n", 1), (-15.0, "", 1)] {
        let outcome = of(&contour(z, rest)).unwrap_or_else(|e| panic!("{e}"));
        assert!(outcome.verdict.is_safe(), "{z}: {:?}", outcome.verdict.found);
        let json: serde_json::Value = serde_json::from_str(&kinecut::job::plan_json(&outcome)).unwrap();
        assert_eq!(json["setups"][0]["contours"][0]["loops"].as_array().unwrap().len(), loops, "{z} {rest}");
    }
    let pocket = job("fanuc", &contour(-5.0, "")).replace("type = \"contour\"", "type = \"pocket\"");
    let outcome = run("job.toml", &pocket, &loader, &Silent).unwrap_or_else(|e| panic!("{e}"));
    assert!(outcome.verdict.is_safe(), "{:?}", outcome.verdict.found);
    // 20 by 20, but for what the cutter leaves in its corners.
    let area = 400.0 - (4.0 - std::f64::consts::PI) * 25.0;
    assert!((removed(&outcome) / (6.0 * area) - 1.0).abs() < 0.02, "{}", removed(&outcome));
    for (text, code) in [
        (job("fanuc", &contour(0.5, "")), Code::OUTLINE_FILE),
        (job("fanuc", &contour(-20.0, "")), Code::OUTLINE_FILE),
        (pocket.replace("section = -5", "section = -15"), Code::OUTLINE_FILE),
        (
            job(
                "fanuc",
                "outline = { loops = [ { centre = [0, 0], radius = 40 } ] }\nsection = -5\ndepth = 6\n",
            ),
            Code::JOB_SHAPE,
        ),
    ] {
        let e = run("job.toml", &text, &loader, &Silent).unwrap_err();
        assert!(e.code() == code && !e.0.help.is_empty(), "{e}");
    }
    let e = refused("rectangle = { size = [40, 30] }\nsection = -5\ndepth = 6\n");
    assert!(e.code() == Code::JOB_SHAPE && e.0.key.as_deref().is_some_and(|k| k.ends_with("section")), "{e}");
}

/// A plate of 60 x 40 with a pocket of 40 x 30 and a boss of 10 x 10 in it, as an STL file: all of it upright walls.
fn plate_with_boss() -> Vec<u8> {
    let (top, bottom) = (ring([30.0, 20.0], 0.0), ring([30.0, 20.0], -20.0));
    let (rim, floor) = (ring([20.0, 15.0], 0.0), ring([20.0, 15.0], -12.0));
    let (foot, head) = (ring([5.0, 5.0], -12.0), ring([5.0, 5.0], -4.0));
    let walls =
        [sides(bottom, top), sides(top, rim), sides(rim, floor), sides(floor, foot), sides(foot, head)];
    stl(&[walls.concat(), vec![head, turned(bottom)]].concat())
}

#[test]
fn edges_of_meshes_are_cut_beside_their_material() {
    let loader = MemoryLoader::default().with("plate.stl", plate_with_boss());
    let of = |kind: &str, keys: &str| {
        let text = job("fanuc", &format!("outline = \"plate.stl\"\n{keys}\n"));
        run("job.toml", &text.replace("type = \"contour\"", &format!("type = \"{kind}\"")), &loader, &Silent)
    };
    for keys in ["edge_at = [30, 0, 0]\ndepth = 6", "edge_at = [5, 0, -4]\ndepth = 10"] {
        let outcome = of("contour", keys).unwrap_or_else(|e| panic!("{keys}: {e}"));
        assert!(outcome.verdict.is_safe(), "{keys}: {:?}", outcome.verdict.found);
    }
    let inside =
        of("contour", "edge_at = [20, 0, 0]\nside = \"inside\"\ndepth = 3").unwrap_or_else(|e| panic!("{e}"));
    assert!(inside.verdict.is_safe(), "{:?}", inside.verdict.found);
    // Down to the boss the rim encloses a pocket; deeper, an island that an edge does not have.
    let pocket = of("pocket", "edge_at = [20, 0, 0]\ndepth = 4").unwrap_or_else(|e| panic!("{e}"));
    assert!(pocket.verdict.is_safe(), "{:?}", pocket.verdict.found);
    for (kind, keys, words, key) in [
        ("contour", "edge_at = [20, 0, 0]\ndepth = 6", "lies around the edge", "side"),
        ("contour", "edge_at = [30, 0, 0]\nside = \"inside\"\ndepth = 6", "lies within the edge", "side"),
        ("pocket", "edge_at = [30, 0, 0]\ndepth = 6", "it encloses no pocket", "edge_at"),
        ("pocket", "edge_at = [20, 0, 0]\ndepth = 12", "higher than the floor", "edge_at"),
    ] {
        let Err(e) = of(kind, keys) else { panic!("{kind} {keys}") };
        assert!(e.0.message.contains(words), "{kind} {keys}: {e}");
        assert!(e.0.key.as_deref().is_some_and(|k| k.ends_with(key)), "{kind} {keys}: {:?}", e.0.key);
    }
}

#[test]
fn drawings_are_cut_on_all_of_their_lines() {
    // A circle, a cross, and a line with a branch: no face, but lines for a cutter.
    let json = r#"{ "loops": [{ "centre": [-60, 0], "radius": 15 }],
        "lines": [[[0, -30], [0, 30]], [[-30, 0], [30, 0]], [[50, -30], [50, 0]], [[50, 0], [40, 20]], [[50, 0], [60, 20]]] }"#;
    let loader = MemoryLoader::default().with("letters.json", json.as_bytes().to_vec());
    let operation = "outline = \"letters.json\"\nside = \"on\"\ndepth = 2\nentry = \"plunge\"\n";
    for control in ["sinumerik-840d", "heidenhain", "linuxcnc", "fanuc", "grbl"] {
        let outcome = done(&job(control, operation), &loader);
        assert!(outcome.verdict.is_safe(), "{control}: {:?}", outcome.verdict.found);
        // Grooves of 10 mm: by their area on a grid of points.
        let lines = [
            ([0.0, -30.0], [0.0, 30.0]),
            ([-30.0, 0.0], [30.0, 0.0]),
            ([50.0, -30.0], [50.0, 0.0]),
            ([50.0, 0.0], [40.0, 20.0]),
            ([50.0, 0.0], [60.0, 20.0]),
        ];
        let near = |x: f64, y: f64| {
            let of = |([a, b], [c, d]): ([f64; 2], [f64; 2])| {
                let (dx, dy) = (c - a, d - b);
                let share = (((x - a) * dx + (y - b) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
                (x - a - share * dx).hypot(y - b - share * dy)
            };
            let circle = ((x + 60.0).hypot(y) - 15.0).abs();
            lines.into_iter().map(of).fold(circle, f64::min)
        };
        const STEP: f64 = 0.1;
        let cells = |n: i32| (-n..n).map(|i| (f64::from(i) + 0.5) * STEP);
        let area = cells(900).map(|x| cells(600).filter(|y| near(x, *y) < 5.0).count()).sum::<usize>() as f64;
        let (wanted, gone) = (area * STEP * STEP * 2.0, removed(&outcome));
        assert!((gone / wanted - 1.0).abs() < 1e-2, "{control}: {gone} {wanted}");
    }
    // The same in the table itself; beside its lines only the open ones that do not meet.
    let table = "outline = { loops = [{ centre = [-60, 0], radius = 15 }], lines = [[[0, -30], [0, 30]]] }\n";
    let on = cut("fanuc", &format!("{table}side = \"on\"\ndepth = 2\nentry = \"plunge\"\n"));
    assert!(on.verdict.is_safe() && removed(&on) > 2.0 * 10.0 * (60.0 + 94.0), "{:?}", on.verdict.found);
    let left = cut("fanuc", &format!("{table}side = \"left\"\ndepth = 2\n"));
    assert!(left.verdict.is_safe() && left.deviation.bores[0].worst() < 1e-3, "{:?}", left.verdict.found);
    let face = refused(&format!("{table}depth = 2\n"));
    assert_eq!(face.code(), Code::OUTLINE_OPEN, "{face}");
    assert!(face.0.help.contains("\"left\""), "{face}");
}

#[test]
fn feeds_of_a_finish_are_lower_in_inside_corners_on_every_control() {
    let pocket = "side = \"inside\"\nrectangle = { size = [60, 40] }\ndepth = 8\n";
    for (control, word) in [
        ("sinumerik-840d", "F180"),
        ("heidenhain", "F180"),
        ("linuxcnc", "F180"),
        ("fanuc", "F180"),
        ("grbl", "F180"),
    ] {
        let finish =
            |more: &str| cut(control, &format!("{pocket}finish = {{ allowance = 0.2, feed = 600{more} }}\n"));
        let (plain, slower) = (finish(""), finish(", corner_feed = true"));
        let count = |outcome: &Outcome| outcome.setups[0].posted.text.matches(word).count();
        // Four corners: 0.2 mm of 5 mm have a chip of 0.28 of the feed, so that the least share is posted.
        assert_eq!((count(&plain), count(&slower)), (0, 4), "{control}: {}", slower.setups[0].posted.text);
        assert!(slower.verdict.is_safe() && slower.deviation.bores[0].worst() < 1e-3, "{control}");
    }
    let open = cut(
        "fanuc",
        "side = \"left\"\npolyline = [[-40, -20], [20, -20], [20, 10]]\ndepth = 8\nfinish = { allowance = 0.2, feed = 600, corner_feed = true }\n",
    );
    assert_eq!(open.setups[0].posted.text.matches("F180").count(), 1, "{}", open.setups[0].posted.text);
}
