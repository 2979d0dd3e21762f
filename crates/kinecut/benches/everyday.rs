//! Operations of every day, planned and posted, on one core: a contour, a pocket of 100 cm2, a broken edge, a thread, and an outline of
//! 10,000 segments with 50 islands.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use kinecut::base::{MemoryLoader, Sources};
use kinecut::job::{Job, JobText, check, plan};
use kinecut::nc;

fn main() {
    divan::main();
}

const CASES: [&str; 5] = ["contour", "pocket", "deburr", "thread", "islands"];

fn job(case: &str) -> Job {
    let mill = |number: u32, diameter: f64| {
        format!(
            "[[tool]]\nnumber = {number}\ntype = \"end-mill\"\ndiameter = {diameter}\nteeth = 4\nflute_length = 26\nstickout = 40\n"
        )
    };
    let ball = "[[tool]]\nnumber = 3\ntype = \"ball-nose\"\ndiameter = 6\nteeth = 2\nflute_length = 12\nstickout = 30\n";
    let thread = "[[tool]]\nnumber = 4\ntype = \"thread-mill\"\ndiameter = 12\npitch = 1.5\nteeth = 4\nflute_length = 30\nstickout = 40\n";
    let operation = match case {
        "contour" => "type = \"contour\"\ntool = 1\nrectangle = { size = [150, 90], corner = 8 }\ndepth = 12\nstepdown = 4\ntabs = { count = 4, width = 6, height = 1.5 }\n\
             speed = 6000\nfeed = 1200\nfinish = { allowance = 0.2 }\n"
            .to_owned(),
        "pocket" => "type = \"pocket\"\ntool = 1\nrectangle = { size = [125, 80], corner = 8 }\ndepth = 5\nspeed = 6000\nfeed = 1200\n".to_owned(),
        "deburr" => format!(
            "type = \"deburr\"\ntool = 3\noutline = {{ loops = [{}] }}\nwidth = 0.2\nspeed = 9000\nfeed = 900\n",
            wave(150, 60.0, 3.0, [0.0; 2])
        ),
        "thread" => "type = \"thread-mill\"\ntool = 4\nsize = \"M20x1.5\"\npoints = [[0, 0]]\ncore = { diameter = 18.5 }\ndepth = 20\n\
             speed = 3000\nfeed = 300\n"
            .to_owned(),
        "islands" => {
            let mut loops = wave(7500, 150.0, 2.0, [0.0; 2]);
            let places = (-4..=4).flat_map(|i| (-4..=4).map(move |k| [f64::from(i) * 28.0, f64::from(k) * 28.0]));
            for at in places.filter(|p| p[0].hypot(p[1]) < 119.0).take(50) {
                let _ = write!(loops, ", {}", wave(50, 5.0, 0.3, at));
            }
            format!("type = \"pocket\"\ntool = 2\noutline = {{ loops = [{loops}] }}\ndepth = 3\nspeed = 9000\nfeed = 1500\n")
        }
        _ => String::new(),
    };
    let text = format!(
        "format = 1\nstock = {{ box = {{ min = [-170, -170, -25], max = [170, 170, 0] }} }}\npost = {{ control = \"fanuc\" }}\n\
         simulate = {{ step = 5 }}\n{}{}{ball}{thread}[[setup]]\noffset = \"G54\"\n[[setup.operation]]\n{operation}",
        mill(1, 10.0),
        mill(2, 6.0)
    );
    let mut sources = Sources::default();
    let id = sources.add("job.toml", text.as_str());
    let loader = MemoryLoader::default();
    let read = JobText::read(&mut sources, id, &loader).expect("the job reads");
    check(&read.file, "job", &loader).expect("the job is right")
}

/// A loop of lines whose distance from a place swings seven times.
fn wave(count: usize, radius: f64, swing: f64, at: [f64; 2]) -> String {
    let points = (0..count).map(|i| {
        let angle = TAU * i as f64 / count as f64;
        let r = radius + swing * (7.0 * angle).sin();
        format!("[{:.4}, {:.4}]", at[0] + r * angle.cos(), at[1] + r * angle.sin())
    });
    format!("[{}]", points.collect::<Vec<_>>().join(", "))
}

#[divan::bench(args = CASES, sample_count = 10)]
fn plan_and_post(bencher: divan::Bencher, case: &str) {
    let job = job(case);
    bencher.bench_local(|| {
        let planned = plan(&job, &kinecut::base::Silent).expect("it can be planned");
        let text = |p: &kinecut::job::SetupPlan| {
            nc::write(&p.program, &job.tools, &job.post).expect("it can be posted").text.len()
        };
        planned.iter().map(text).sum::<usize>()
    });
}
