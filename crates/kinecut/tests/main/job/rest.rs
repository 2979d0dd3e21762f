//! Tools that could take away stock that is left on the design.

use glam::{DVec2, DVec3};
use kinecut::base::{Code, MemoryLoader, Silent};
use kinecut::geom::{Mesh, write_stl};
use kinecut::job::{Outcome, RestReach, SizeReach, report};
use kinecut::tool::ToolNumber;

use super::fixtures::found;

/// An L of 60 x 40 x 12 mm with arms of 20 mm; its inner corner has a radius of 3 mm.
fn angle() -> Mesh {
    let mut outline: Vec<DVec2> =
        [[0.0, 40.0], [0.0, 0.0], [60.0, 0.0], [60.0, 20.0]].map(DVec2::from).to_vec();
    for i in 0..=90 {
        let angle = (270.0 - f64::from(i)).to_radians();
        outline.push(DVec2::new(23.0, 23.0) + 3.0 * DVec2::from_angle(angle));
    }
    outline.push(DVec2::new(20.0, 40.0));
    let n = outline.len() as u32;
    let vertices = [-12.0, 0.0].iter().flat_map(|z| outline.iter().map(|p| p.extend(*z))).collect();
    let mut mesh = Mesh { vertices, triangles: Vec::new() };
    for i in 0..n {
        let j = (i + 1) % n;
        mesh.triangles.extend([[i, j, j + n], [i, j + n, i + n]]);
        // All of it is seen from the outer corner.
        if i != 1 && j != 1 {
            mesh.triangles.extend([[1, j, i], [1 + n, i + n, j + n]]);
        }
    }
    mesh.check_closed().unwrap();
    mesh
}

/// The angle cut out of a block by the first of some tools, which goes along both arms and leaves so much.
fn run(tools: &str, radius: f64, left: f64) -> Outcome {
    let text = format!(
        r#"format = 1
stock = {{ box = {{ min = [0, 0, -12], max = [60, 40, 0] }} }}
simulate = {{ step = 0.25 }}
post = {{ control = "linuxcnc" }}
[design]
mesh = "angle.stl"
tolerance = 0.03
[[holder]]
name = "wide"
segments = [{{ height = 40, lower_diameter = 60 }}]
{tools}
[[setup]]
offset = "G54"
program = {{ file = "P.ngc" }}
"#
    );
    let mut program = "G17 G21 G90 G94 G54\nT1 M6\nG43\nS3000 M3\nG0 X75 Y60 Z20\nG1 Z-12 F900\n".to_owned();
    // Passes across, one by one nearer to the corner.
    let near = 20.0 + radius + left;
    for k in (0..=8).rev() {
        let y = near + 2.5 * f64::from(k);
        program.push_str(&format!("G1 X75 Y{y}\nX{near}\nY60\nX75\n"));
    }
    program.push_str("G0 Z20\nM2\n");
    let loader = MemoryLoader::default().with("angle.stl", write_stl(&angle())).with("P.ngc", program);
    kinecut::job::run("job.toml", &text, &loader, &Silent).unwrap()
}

fn end_mill(number: u32, diameter: f64, more: &str) -> String {
    format!(
        "[[tool]]\nnumber = {number}\ntype = \"end-mill\"\ndiameter = {diameter}\nflute_length = 20\n{more}\n"
    )
}

fn reach(done: &Outcome) -> &RestReach {
    done.deviation.reach.as_ref().unwrap()
}

fn size(reach: &RestReach, diameter: f64) -> SizeReach {
    *reach.sizes.iter().find(|size| size.diameter == diameter).unwrap()
}

#[test]
fn a_corner_needs_a_cutter_of_its_radius() {
    let holder = "stickout = 7\nholder = \"wide\"";
    let drill =
        "[[tool]]\nnumber = 4\ntype = \"drill\"\ndiameter = 3\npoint_angle = 118\nflute_length = 30\n";
    let tools = [
        &end_mill(1, 16.0, ""),
        &end_mill(2, 6.0, ""),
        &end_mill(3, 6.0, holder).replace("flute_length = 20", "flute_length = 7"),
        drill,
    ]
    .map(|s| s.to_owned())
    .concat();
    let done = run(&tools, 8.0, 0.0);
    let reach = reach(&done);
    assert!(reach.ends > 500 && reach.places == 300, "{reach:?}");
    assert_eq!((&reach.directions[..], reach.other_directions), (&[DVec3::Z][..], 0));
    // The corner lies between the places where the large cutter leaves the walls: only near those it is still deep enough.
    let [first, second, third] = &reach.tools[..] else { panic!("{:?}", reach.tools) };
    assert_eq!([first.tool, second.tool, third.tool], [1, 2, 3].map(ToolNumber), "drills do not mill");
    assert!(first.free < 15 && first.too_short == 0, "{first:?}");
    assert_eq!((second.free, second.too_short), (300, 0));
    // Its holder is 7 mm above the tip: too low for the lowest 5 of 12 mm.
    assert!(third.free + third.too_short == 300 && (110..150).contains(&third.too_short), "{third:?}");
    assert_eq!([6.0, 5.0].map(|d| size(reach, d).end_mill), [300; 2]);
    // 8 mm cleans the walls from 4 mm beside the corner on: of the arc that 16 mm leave, six parts in ten; less at its ends.
    assert!((130..180).contains(&size(reach, 8.0).end_mill), "{reach:?}");
    assert_eq!(size(reach, 16.0).end_mill, first.free);
    // The finding tells it, and the report.
    let all = found(&done, Code::STOCK_LEFT);
    let help = all[0].help.clone();
    assert_eq!(help, "T2 comes to 100 % of 300 places where too much is left");
    let section =
        report::of_job(&done).sections.into_iter().find(|s| s.title == "Stock left on the design").unwrap();
    let text = format!("{section:?}");
    assert!(
        text.contains("T3") && text.contains("300 of") && text.contains("the direction in which"),
        "{text}"
    );
}

#[test]
fn walls_with_stock_are_for_the_same_tool_again() {
    let done = run(&end_mill(1, 16.0, ""), 8.0, 0.5);
    let reach = reach(&done);
    let part = reach.tools[0].free as f64 / reach.places as f64;
    // Both walls but for the corner.
    assert!(part > 0.6 && part < 0.95, "{reach:?}");
    let help = found(&done, Code::STOCK_LEFT)[0].help.clone();
    assert!(
        help.starts_with("T1 comes to ") && help.contains("; an end mill of 8 mm would come to"),
        "{help}"
    );
}

#[test]
fn a_part_that_is_right_needs_none() {
    let done = run(&end_mill(1, 6.0, ""), 3.0, 0.0);
    assert!(done.deviation.reach.is_none(), "{:?}", done.deviation.reach);
    assert!(found(&done, Code::STOCK_LEFT).is_empty());
    assert!(report::of_job(&done).sections.iter().all(|s| s.title != "Stock left on the design"));
}
