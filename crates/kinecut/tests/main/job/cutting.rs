//! Cutting data of operations that have none: presets, values to start with, limits of speed; power and torque of the simulated cut.

use std::f64::consts::{PI, TAU};

use kinecut::base::{Code, Finding, MemoryLoader, Silent};
use kinecut::job::{DataOrigin, Outcome, engagement_json, plan_json, run};
use serde_json::Value;

/// A block of 80 x 60 x 20 with its upper face at 0; an end mill without a preset, a drill with one that has no feed.
fn job(material: &str, machine: &str, operations: &str) -> String {
    format!(
        r#"format = 1
{material}
post = {{ control = "linuxcnc" }}
stock = {{ box = {{ min = [-40, -30, -20], max = [40, 30, 0] }} }}
simulate = {{ step = 0.5 }}
{machine}
[[tool]]
number = 1
type = "end-mill"
diameter = 10
flute_length = 22
teeth = 4
stickout = 40
material = "carbide"
[[tool]]
number = 2
type = "drill"
diameter = 8
flute_length = 60
stickout = 80
preset = [{{ material = "C45", cutting_speed = 31 }}]
[[tool]]
number = 3
type = "tapered"
diameter = 0
half_angle = 45
flute_length = 5
teeth = 2
stickout = 30
shank_diameter = 10
[[tool]]
number = 4
type = "end-mill"
diameter = 10
flute_length = 22
teeth = 4
stickout = 60
max_speed = 3000
[[setup]]
offset = "G54"
safe_height = 20
{operations}
"#
    )
}

fn done(material: &str, machine: &str, operations: &str) -> Outcome {
    run("job.toml", &job(material, machine, operations), &MemoryLoader::default(), &Silent)
        .unwrap_or_else(|e| panic!("{e}"))
}

fn refused(material: &str, operations: &str) -> Box<Finding> {
    run("job.toml", &job(material, "", operations), &MemoryLoader::default(), &Silent).unwrap_err().0
}

const C45: &str = "material = \"C45\"";

fn slot(rest: &str) -> String {
    format!(
        "[[setup.operation]]\ntype = \"slot\"\ntool = 1\nline = [[-25, 0], [25, 0]]\nwidth = 10\nengagement = 180\ndepth = 4\nstepdown = 4\n{rest}\n"
    )
}

fn drill(rest: &str) -> String {
    format!("[[setup.operation]]\ntype = \"drill\"\ntool = 2\npoints = [[0, 20]]\ndepth = 10\n{rest}\n")
}

/// The speed of a program and its feed in the first move at feed, in lines that cut below the face.
fn words(outcome: &Outcome, letter: char) -> Vec<f64> {
    let text = &outcome.setups[0].posted.text;
    text.split_whitespace().filter_map(|word| word.strip_prefix(letter)?.parse().ok()).collect()
}

fn noted<'a>(outcome: &'a Outcome, part: &str) -> &'a Finding {
    let found = outcome.verdict.found.iter().find(|f| f.message.contains(part));
    found.unwrap_or_else(|| panic!("{part} in {:#?}", outcome.verdict.found))
}

#[test]
fn an_operation_without_data_takes_values_to_start_with() {
    let outcome = done(C45, "", &slot(""));
    // 150 m/min at 10 mm are 4775 rev/min; 0.006 x 10 x 0.8 are 0.048 mm per tooth, and 917 mm/min with four.
    let speed = (150_000.0 / (PI * 10.0)).round();
    assert_eq!(words(&outcome, 'S').first(), Some(&speed));
    let feed = speed * 4.0 * 0.048;
    assert!(
        words(&outcome, 'F').iter().any(|f| (f - feed).abs() < 0.1),
        "{feed} in {:?}",
        words(&outcome, 'F')
    );
    let note = noted(&outcome, "to start with");
    assert_eq!(note.code, Code::TOOL_CHOSEN);
    for part in
        ["cutting_speed 150 m/min", "feed_per_tooth 0.048 mm", "0.06 x 0.8 (full width)", "no recommendation"]
    {
        assert!(note.message.contains(part), "{part}: {}", note.message);
    }
    assert!(note.message.contains("the largest speed of the machine is not known"), "{}", note.message);
    assert!(!note.message.contains("taken as"), "T1 says that it is of carbide: {}", note.message);
    let plan: Value = serde_json::from_str(&plan_json(&outcome)).unwrap();
    let data = &plan["cutting"][0];
    assert_eq!((data["operation"].as_u64(), data["tool"].as_u64()), (Some(1), Some(1)));
    assert_eq!(data["spindle"].as_f64().unwrap().round(), speed);
    assert_eq!(data["feed"]["origin"], "built-in: C45, carbide, full width");
    assert_eq!(data["feed"]["changed_by"][0], "full width x0.8000");
}

#[test]
fn each_number_is_that_of_the_operation_then_of_the_preset_then_one_to_start_with() {
    // The preset has the speed, nothing has the feed: 0.020 x 8.
    let outcome = done(C45, "", &drill(""));
    let [taken] = &outcome.job.cutting[..] else { panic!("{:?}", outcome.job.cutting) };
    let (speed, feed) = (taken.speed.as_ref().unwrap(), taken.feed.as_ref().unwrap());
    assert_eq!((speed.value, feed.value), (31.0, 0.16));
    assert!(matches!(speed.origin, DataOrigin::Preset { .. }), "{speed:?}");
    assert!(matches!(feed.origin, DataOrigin::Start { .. }), "{feed:?}");
    assert!(noted(&outcome, "from the preset C45 of T2").message.contains("cutting_speed 31 m/min"));
    assert!(noted(&outcome, "to start with").message.contains("T2 is taken as HSS"));
    // The operation's own number stays.
    let outcome = done(C45, "", &drill("speed = 900"));
    let [taken] = &outcome.job.cutting[..] else { panic!("{:?}", outcome.job.cutting) };
    assert!(taken.speed.is_none() && taken.feed.is_some());
    assert_eq!(words(&outcome, 'S').first(), Some(&900.0));
    let outcome = done(C45, "", &drill("speed = 900\nfeed_per_rev = { steady = 0.1 }"));
    assert!(outcome.job.cutting.is_empty());
    // Other names of the material are the same material, for values to start with.
    let outcome = done("material = \"AISI 1045\"", "", &drill(""));
    assert_eq!(outcome.job.cutting[0].speed.as_ref().unwrap().value, 25.0);
}

#[test]
fn a_pocket_makes_up_for_its_thin_chip_and_a_long_tool_takes_less() {
    let pocket = |tool: u32, rest: &str| {
        format!(
            "[[setup.operation]]\ntype = \"pocket\"\ntool = {tool}\nrectangle = {{ size = [40, 30], corner = 6 }}\ndepth = 3\n{rest}\n"
        )
    };
    let value = |outcome: &Outcome| outcome.job.cutting[0].feed.as_ref().unwrap().value;
    let usual = done(C45, "", &pocket(1, ""));
    assert!((value(&usual) - 0.06 / (PI / 3.0).sin()).abs() < 1e-4);
    assert_eq!(usual.job.cutting[0].speed.as_ref().unwrap().value, 150.0);
    let narrow = done(C45, "", &pocket(1, "engagement = 30"));
    assert!((value(&narrow) - 0.12).abs() < 1e-4);
    assert_eq!(narrow.job.cutting[0].speed.as_ref().unwrap().value, 200.0);
    // T4 sticks out by six diameters.
    let long = done(C45, "", &pocket(4, ""));
    let share = (4.0_f64 / 6.0).powf(1.5);
    assert!((value(&long) - 0.06 / (PI / 3.0).sin() * share).abs() < 1e-4);
}

#[test]
fn a_speed_that_was_given_is_lowered_to_what_tool_and_machine_allow() {
    let own = |tool: u32| slot("").replace("tool = 1", &format!("tool = {tool}"));
    let outcome = done(C45, "", &own(4));
    assert_eq!(words(&outcome, 'S').first(), Some(&3000.0));
    let limited = outcome.job.cutting[0].limited.unwrap();
    assert!(limited.of_tool && (limited.cutting_speed.unwrap() - 0.03 * PI * 1000.0).abs() < 0.1);
    let told =
        "T4 would turn at 4775 rev/min, and T4 has 3000: the cutting speed falls from 150 to 94.2 m/min";
    assert_eq!(noted(&outcome, "would turn").message, told);
    // The feed per tooth stays, so that the feed falls with the speed.
    let share = (4.0_f64 / 6.0).powf(1.5);
    let feed = 3000.0 * 4.0 * (0.06 * 0.8 * share * 1e4).floor() / 1e4;
    assert!(
        words(&outcome, 'F').iter().any(|f| (f - feed).abs() < 0.1),
        "{feed} in {:?}",
        words(&outcome, 'F')
    );
    assert!(outcome.verdict.found.iter().all(|f| f.code != Code::SPINDLE_WRONG));
    let machine = "[machine]\ncode = \"2103\"\ndynamics = { max_speed = 2500 }\n";
    let outcome = done(C45, machine, &own(4));
    assert_eq!(words(&outcome, 'S').first(), Some(&2500.0));
    assert!(!outcome.job.cutting[0].limited.unwrap().of_tool);
    assert!(outcome.verdict.found.iter().all(|f| !f.message.contains("is not known")));
    // One of the operation's own is an error, as before.
    let outcome = done(C45, machine, &slot("speed = 4000"));
    assert!(outcome.verdict.found.iter().any(|f| f.code == Code::SPINDLE_WRONG));
}

#[test]
fn a_feed_in_a_minute_falls_with_the_speed_of_its_preset() {
    let preset = "preset = [{ material = \"C45\", cutting_speed = 150, feed = 764 }]\n[[setup]]";
    let text = job(C45, "", &slot("").replace("tool = 1", "tool = 4")).replace("[[setup]]", preset);
    let outcome = run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap();
    // 3000 of 4775 rev/min: 480 of 764 mm/min, the same 0.04 mm per tooth.
    let feed = outcome.job.cutting[0].feed.as_ref().unwrap();
    assert!((feed.value - 480.0).abs() < 0.1 && feed.plain == 764.0, "{feed:?}");
    assert!(words(&outcome, 'F').iter().any(|f| (f - 480.0).abs() < 0.2), "{:?}", words(&outcome, 'F'));
    assert!(words(&outcome, 'F').iter().all(|f| (f - 764.0).abs() > 1.0), "{:?}", words(&outcome, 'F'));
}

#[test]
fn values_to_start_with_are_for_half_the_diameter_deep() {
    // A groove around a boss: from its first lap down it is in the full width.
    let of = |material: &str, depth: f64, rest: &str| -> Vec<Finding> {
        let groove = format!(
            "[[setup.operation]]\ntype = \"contour\"\ntool = 1\nrectangle = {{ size = [50, 30] }}\ndepth = {depth}\nstepdown = {depth}\n{rest}\n"
        );
        let outcome = done(material, "", &groove);
        outcome.verdict.found.iter().filter(|f| f.code == Code::START_DEPTH).cloned().collect()
    };
    assert!(of(C45, 5.0, "").is_empty());
    let found = of(C45, 8.0, "");
    assert!(found.len() == 1 && found[0].place.is_some(), "{found:?}");
    let deepest = found[0].value.as_ref().unwrap().value;
    assert!((7.0..8.01).contains(&deepest), "{}", found[0]);
    assert!(found[0].help.contains("stepdown = 5"), "{}", found[0]);
    // Own numbers are the person's own, and soft metals take more.
    assert!(of(C45, 8.0, "speed = 3000\nfeed = 400").is_empty());
    assert!(of("material = \"6082\"", 8.0, "").is_empty());
}

#[test]
fn a_small_cutter_at_an_edge_turns_as_fast_as_the_machine_may() {
    let chamfer = "[[setup.operation]]\ntype = \"chamfer\"\ntool = 3\nrectangle = { size = [80, 60] }\nside = \"outside\"\nwidth = 0.5\n";
    let machine = "[machine]\ncode = \"2103\"\ndynamics = { max_speed = 12000 }\n";
    let outcome = done(C45, machine, chamfer);
    assert_eq!(words(&outcome, 'S').first(), Some(&12000.0));
    let limited = outcome.job.cutting[0].limited.unwrap();
    assert!(limited.wanted > 20_000.0 && limited.cutting_speed.unwrap() < 200.0, "{limited:?}");
}

#[test]
fn materials_that_are_not_known_are_refused_where_a_number_is_lacking() {
    let error = refused("material = \"C46\"", &slot(""));
    assert_eq!(error.code, Code::JOB_SHAPE);
    assert!(
        error.message.contains("T1 has no preset for C46, and the material `C46` is not known"),
        "{error}"
    );
    assert!(error.help.contains("did you mean `C45`"), "{error}");
    let error = refused("material = \"S235\"", &slot(""));
    assert!(error.message.contains("no values to start with for S235"), "{error}");
    assert!(error.place.is_some());
    let error = refused("material = \"S235\"", &slot("speed = 3000"));
    assert!(error.message.contains("needs a feed"), "{error}");
    let error = refused("", &slot(""));
    assert!(error.message.contains("needs a speed"), "{error}");
    // With numbers of its own any name is good.
    done("material = \"C46\"", "", &slot("speed = 3000\nfeed = 400"));
}

/// Power (kW) of a slot by the sum over the teeth in the arc, at each angle.
fn by_integral(per_tooth: f64, depth: f64, diameter: f64, teeth: f64, turns: f64) -> f64 {
    let steps = 100_000;
    let width = PI / f64::from(steps);
    let work: f64 = (0..steps)
        .map(|i| {
            let h = per_tooth * ((f64::from(i) + 0.5) * width).sin();
            2110.0 * h.powf(1.0 - 0.17) * depth * 0.5 * diameter * width
        })
        .sum();
    work * teeth * turns / 1e6
}

/// A program by another hand that cuts a slot 4 mm deep right through the block, in the full width of T1.
fn slotted(material: &str, machine: &str, feed: f64) -> Outcome {
    let program =
        format!("G21 G17 G90 G54\nT1 M6\nG43 H1\nS3000 M3\nG0 X-50 Y0\nG0 Z-4\nG1 X50 F{feed}\nG0 Z20\nM2\n");
    let loader = MemoryLoader::default().with("P.ngc", program);
    run("job.toml", &job(material, machine, "program = { file = \"P.ngc\" }"), &loader, &Silent)
        .unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn the_simulated_cut_has_the_power_of_its_integral() {
    let outcome = slotted(C45, "", 600.0);
    let wanted = by_integral(0.05, 4.0, 10.0, 4.0, 50.0);
    let json: Value = serde_json::from_str(&engagement_json(&outcome).unwrap()).unwrap();
    let blocks = json["setups"][0]["blocks"].as_array().unwrap();
    // The longest block: the pass itself.
    let pass = blocks
        .iter()
        .max_by(|a, b| a["removed"].as_f64().unwrap().total_cmp(&b["removed"].as_f64().unwrap()))
        .unwrap();
    let power = pass["power"].as_f64().unwrap();
    // At the mean chip up to 4.5 % high, and the stock's lines are 0.5 mm apart.
    assert!((0.97..1.12).contains(&(power / wanted)), "{power} {wanted}");
    let torque = pass["torque"].as_f64().unwrap();
    assert!((torque - 1000.0 * power / (50.0 * TAU)).abs() < 1e-6 * torque);
    // Without a material nothing is said.
    let outcome = slotted("", "", 600.0);
    assert!(!engagement_json(&outcome).unwrap().contains("power"));
    // A drill in the solid: its torque is kc f D^2 / 8000 at the chip of its lips.
    let outcome = done(C45, "", &drill("speed = 900\nfeed_per_rev = { steady = 0.16 }"));
    let json: Value = serde_json::from_str(&engagement_json(&outcome).unwrap()).unwrap();
    let blocks = json["setups"][0]["blocks"].as_array().unwrap();
    let torque = blocks.iter().filter_map(|b| b["torque"].as_f64()).fold(0.0, f64::max);
    let h = 0.08 * 59f64.to_radians().sin();
    let wanted = 2110.0 * h.powf(-0.17) * 0.16 * 64.0 / 8000.0;
    assert!((torque / wanted - 1.0).abs() < 0.1, "{torque} {wanted}");
}

#[test]
fn a_cut_that_needs_more_than_the_spindle_has_is_a_warning() {
    let machine = |power: f64, torque: f64| {
        format!(
            "[machine]\ncode = \"2103\"\ndynamics = {{ spindle_power = {power}, spindle_torque = {torque} }}\n"
        )
    };
    let of = |power: f64, torque: f64| -> Vec<Finding> {
        let outcome = slotted(C45, &machine(power, torque), 600.0);
        outcome.verdict.found.iter().filter(|f| f.code == Code::CUTTING_LOAD).cloned().collect()
    };
    let wanted = by_integral(0.05, 4.0, 10.0, 4.0, 50.0);
    assert!(of(10.0, 100.0).is_empty());
    // Four fifths arrive at the tool.
    let found = of(1.2 * wanted, 100.0);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].message.contains("more than the power of the spindle, within 25 %, at 3000 rev/min"),
        "{}",
        found[0]
    );
    assert!(found[0].place.is_some());
    assert!(of(1.45 * wanted, 100.0)[0].message.contains("nearly all of the power"));
    let found = of(10.0, 0.9 * 1000.0 * wanted / (50.0 * TAU));
    assert!(found.len() == 1 && found[0].message.contains("more than the torque"), "{found:?}");
    // The curve: at 3000 rev/min half of the torque at 1500, whose power it keeps.
    let curve = |torque: f64| {
        let machine = format!(
            "[machine]\ncode = \"2103\"\ndynamics = {{ spindle_curve = [[1500, {}], [6000, {}]] }}\n",
            2.0 * torque,
            0.5 * torque
        );
        let outcome = slotted(C45, &machine, 600.0);
        let found: Vec<Finding> =
            outcome.verdict.found.iter().filter(|f| f.code == Code::CUTTING_LOAD).cloned().collect();
        found
    };
    let torque = 1000.0 * wanted / (50.0 * TAU);
    assert!(curve(1.5 * torque).is_empty());
    let found = curve(0.9 * torque);
    assert!(found.len() == 1 && found[0].message.contains("more than the torque"), "{found:?}");
    let bound = found[0].bound.as_ref().unwrap();
    assert!((bound.value - 0.9 * torque).abs() < 0.06 && bound.unit.contains("spindle_curve"), "{bound:?}");
    // A speed at which nothing is known of the force: POM.
    let outcome = slotted("material = \"POM\"", &machine(0.01, 0.1), 600.0);
    assert!(outcome.verdict.found.iter().all(|f| f.code != Code::CUTTING_LOAD));
    let said = "what the cuts need of the spindle: the job has no material whose cutting force is known";
    assert!(
        outcome.verdict.not_checked.iter().any(|line| format!("{line:?}").contains(said)),
        "{:?}",
        outcome.verdict.not_checked
    );
}

#[test]
fn taps_that_cut_have_a_torque_within_a_half_and_those_that_form_have_none() {
    let tap = |forming: bool| {
        format!(
            "[[tool]]\nnumber = 5\ntype = \"tap\"\ndiameter = 8\npitch = 1.25\nlead = 2.5\nteeth = 3\nforming = {forming}\n\
             flute_length = 20\nshank_diameter = 6\nstickout = 60\n"
        )
    };
    let of = |forming: bool, torque: f64| {
        let machine = format!(
            "[machine]\ncode = \"2103\"\ndynamics = {{ spindle_power = 20, spindle_torque = {torque} }}\n{}",
            tap(forming)
        );
        let core = if forming { 7.4 } else { 6.8 };
        let drill =
            drill("speed = 900\nfeed_per_rev = { steady = 0.16 }").replace("depth = 10", "depth = 16");
        let tapped =
            "[[setup.operation]]\ntype = \"tap\"\ntool = 5\npoints = [[0, 20]]\ndepth = 10\nspeed = 480\n";
        let text = job(C45, &machine, &format!("{drill}{tapped}"));
        let text = text.replacen(
            "diameter = 8\nflute_length = 60",
            &format!("diameter = {core}\nflute_length = 60"),
            1,
        );
        run("job.toml", &text, &MemoryLoader::default(), &Silent).unwrap_or_else(|e| panic!("{e}"))
    };
    let loads = |outcome: &Outcome| -> Vec<f64> {
        let json: Value = serde_json::from_str(&engagement_json(outcome).unwrap()).unwrap();
        let blocks = json["setups"][0]["blocks"].as_array().unwrap().clone();
        blocks.iter().filter(|b| b["tool"] == 5).filter_map(|b| b["torque"].as_f64()).collect()
    };
    // kc P^2 D / 8000 at the chip P / (2 z lead), written out.
    let wanted = 2110.0 * (1.25_f64 / (2.0 * 3.0 * 2.5)).powf(-0.17) * 1.25 * 1.25 * 8.0 / 8000.0;
    let outcome = of(false, 100.0);
    let found = loads(&outcome);
    assert!(!found.is_empty() && found.iter().all(|t| (t - wanted).abs() < 1e-9), "{found:?} {wanted}");
    let page = format!("{:?}", kinecut::job::report::of_job(&outcome).sections);
    assert!(page.contains("5.0 (\u{b1}50 %)"), "{page}");
    let warned = |outcome: &Outcome| -> Vec<Finding> {
        outcome.verdict.found.iter().filter(|f| f.code == Code::CUTTING_LOAD).cloned().collect()
    };
    assert!(warned(&outcome).is_empty(), "{:?}", warned(&outcome));
    let found = warned(&of(false, 0.9 * wanted));
    // The drill before it needs more than that too.
    let own = found.iter().find(|f| f.message.contains("T5")).expect("a warning about the tap");
    assert!(own.message.contains("more than the torque of the spindle, within 50 %"), "{own}");
    // Of one that forms nothing is known, and that is said.
    let forming = of(true, 100.0);
    assert!(loads(&forming).is_empty());
    let said = format!("{:?}", forming.verdict.not_checked);
    assert!(said.contains("taps that form their thread"), "{said}");
    assert!(!format!("{:?}", outcome.verdict.not_checked).contains("taps that form"));
}

#[test]
fn a_wall_from_which_the_cutter_is_pressed_away_is_a_warning() {
    let wall = |rest: &str, finish: &str| {
        format!(
            "[[setup.operation]]\ntype = \"contour\"\nside = \"left\"\ntool = 1\npolyline = [[-60, 0], [60, 0]]\ndepth = 10\n\
             speed = 6000\nfeed = 2400\n{rest}\nfinish = {{ allowance = 1{finish} }}\n"
        )
    };
    let of = |material: &str, operation: &str| -> Vec<Finding> {
        let outcome = done(material, "", operation);
        outcome.verdict.found.iter().filter(|f| f.code == Code::TOOL_DEFLECTION).cloned().collect()
    };
    // One tooth at a time in an arc of acos 0.8: the mean of kc1.1 h^(1 - mc) ap over the arc.
    let (arc, steps) = (0.8_f64.acos(), 10_000);
    let one =
        |i: i32| 2110.0 * (0.1 * (arc * (f64::from(i) + 0.5) / f64::from(steps)).sin()).powf(0.83) * 10.0;
    let force = (0..steps).map(one).sum::<f64>() / f64::from(steps);
    // 18 mm of shank and 22 mm of flutes as thick as 8 mm.
    let stiff = |diameter: f64| 3.0 * 600_000.0 * PI * diameter.powi(4) / 64.0;
    let wanted =
        0.5 * force * ((40_f64.powi(3) - 22_f64.powi(3)) / stiff(10.0) + 22_f64.powi(3) / stiff(8.0));
    let found = of(C45, &wall("", ""));
    assert_eq!(found.len(), 1, "{found:?}");
    let value = found[0].value.as_ref().unwrap().value;
    // At the mean chip up to 4.5 % high.
    assert!((1.0..1.06).contains(&(value / wanted)), "{value} {wanted}");
    assert!(found[0].bound.as_ref().unwrap().value == 0.02 && found[0].place.is_some(), "{}", found[0]);
    let json: Value = serde_json::from_str(&engagement_json(&done(C45, "", &wall("", ""))).unwrap()).unwrap();
    let blocks = json["setups"][0]["blocks"].as_array().unwrap();
    let most = blocks.iter().filter_map(|b| b["deflection"].as_f64()).fold(0.0, f64::max);
    // As simulated, on lines that are 0.5 mm apart.
    assert!((0.8..1.3).contains(&(most / value)), "{most} {value}");
    // A tolerance of its own; a spring pass; a material of which no force is known.
    let strict = of(C45, &wall("tolerance = 0.03", ""));
    assert!(
        strict[0].bound.as_ref().unwrap().value == 0.01
            && strict[0].message.contains("a third of the tolerance")
    );
    for (material, rest, finish) in
        [(C45, "tolerance = 0.3", ""), (C45, "", ", spring_passes = 1"), ("material = \"POM\"", "", "")]
    {
        assert!(of(material, &wall(rest, finish)).is_empty(), "{material} {rest} {finish}");
    }
}

#[test]
fn a_cutter_with_chips_thinner_than_its_edge_rubs() {
    let of = |feed: f64| -> Vec<Finding> {
        let outcome = done(C45, "", &slot(&format!("speed = 3000\nfeed = {feed}")));
        outcome.verdict.found.iter().filter(|f| f.code == Code::EDGE_RUBS).cloned().collect()
    };
    // 12 000 teeth a minute: 2 and 4 um.
    let found = of(24.0);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!((found[0].value.as_ref().unwrap().value - 0.002).abs() < 2e-4, "{}", found[0]);
    assert!(of(48.0).is_empty());
}

/// The cutting data of a shop.
const TABLE: &str = "# Our own.
[[cutting]]
material = \"1.0503\"
tool = \"end-mill\"
tool_material = \"hss\"
cutting_speed = 30
feed_per_tooth = 0.03
[[cutting]]
material = \"C45\"
tool = \"end-mill\"
engagement = 40
cutting_speed = 230
[[cutting]]
material = \"C45\"
tool = \"end-mill\"
diameter = [8, 12]
cutting_speed = 120
feed_per_tooth = 0.055
[[cutting]]
material = \"C45\"
tool = \"drill\"
diameter = [0, 7.9]
feed_per_rev = 0.5
[[cutting]]
material = \"C45\"
tool = \"drill\"
cutting_speed = 99
feed_per_rev = 0.14
";

fn tabled(table: &str, operations: &str) -> kinecut::base::Result<Outcome> {
    let loader = MemoryLoader::default().with("cutting.toml", table.as_bytes().to_vec());
    let material = format!("{C45}\ncutting = \"cutting.toml\"");
    run("job.toml", &job(&material, "", operations), &loader, &Silent)
}

#[test]
fn the_table_of_the_shop_goes_before_values_to_start_with() {
    let numbers = |operations: &str| {
        let outcome = tabled(TABLE, operations).unwrap();
        let taken = outcome.job.cutting[0].clone();
        (taken.speed.unwrap(), taken.feed.unwrap(), outcome)
    };
    // The first row is of other edges, the second of a narrower cut.
    let (speed, feed, outcome) = numbers(&slot(""));
    assert_eq!((speed.value, feed.value), (120.0, 0.055));
    assert_eq!(feed.origin, DataOrigin::Table { file: "cutting.toml".to_owned(), line: 13 });
    noted(&outcome, "feed_per_tooth 0.055 mm of T1 from line 13 of `cutting.toml`");
    let plan: Value = serde_json::from_str(&plan_json(&outcome)).unwrap();
    assert_eq!(plan["cutting"][0]["speed"]["origin"], "table: cutting.toml:13");
    assert!(outcome.verdict.subjects.iter().any(|s| s.file.as_deref() == Some("cutting.toml")));
    // A narrow cut: the speed of the second row, which has no feed.
    let pocket = "[[setup.operation]]\ntype = \"pocket\"\ntool = 1\nrectangle = { size = [40, 30], corner = 6 }\ndepth = 3\nengagement = 30\n";
    let (speed, feed, _) = numbers(pocket);
    assert_eq!((speed.value, feed.value), (230.0, 0.055));
    // The preset of the drill has its speed; its feed is that of a row for its diameter.
    let (speed, feed, _) = numbers(&drill(""));
    assert_eq!((speed.value, feed.value), (31.0, 0.14));
    // Nothing for a chamfer: a value to start with.
    let chamfer = "[[setup.operation]]\ntype = \"chamfer\"\ntool = 3\nrectangle = { size = [80, 60] }\nside = \"outside\"\nwidth = 0.5\n";
    assert!(matches!(numbers(chamfer).0.origin, DataOrigin::Start { .. }));
}

#[test]
fn a_wrong_table_of_the_shop_is_refused_at_its_place() {
    for (table, key, line) in [
        ("[[cutting]]\nmaterial = \"C45\"\ntool = \"drill\"\ncutting_speed = -3\n", "cutting_speed", 4),
        ("[[cutting]]\nmaterial = \"C45\"\ntool = \"drill\"\ndiameter = [5, 3]\n", "diameter", 4),
        ("\n[[cutting]]\nmaterial = \"C45\"\ntool = \"lathe\"\n", "lathe", 4),
    ] {
        let error = tabled(table, &slot("")).unwrap_err().0;
        let place = error.place.as_ref().unwrap();
        assert_eq!((&*place.file, place.line), ("cutting.toml", line), "{error}");
        assert!(
            error.to_string().contains(key) || error.key.as_deref().unwrap_or_default().contains(key),
            "{error}"
        );
    }
    let error =
        run("job.toml", &job("cutting = \"none.toml\"", "", &slot("")), &MemoryLoader::default(), &Silent);
    assert_eq!(error.unwrap_err().0.place.unwrap().line, 2);
}
