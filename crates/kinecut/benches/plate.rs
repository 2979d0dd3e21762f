//! A plate of 1000 bores of 30 mm: planned and posted, on one core.

use kinecut::base::{MemoryLoader, Sources};
use kinecut::job::{Job, JobText, check, plan};
use kinecut::nc;

fn main() {
    divan::main();
}

fn job(control: &str, strategy: &str) -> Job {
    let mut text = format!(
        r#"
format = 1
stock = {{ box = {{ min = [-20, -20, -12], max = [1300, 1580, 0] }} }}
post = {{ control = "{control}" }}
simulate = {{ step = 5 }}
[[tool]]
number = 1
type = "end-mill"
diameter = 12
flute_length = 26
max_ramp_angle = 5
[[setup]]
offset = "G54"
"#
    );
    for i in 0..1000 {
        text += &format!(
            r#"
[[setup.operation]]
type = "bore"
tool = 1
at = [{}, {}]
diameter = 30
depth = 12
breakthrough = 1
strategy = "{strategy}"
speed = 5000
rough = {{ stepover = 3, engagement = 75, allowance = 0.3, feed = 1200 }}
finish = {{ feed = 600 }}
"#,
            i % 33 * 40,
            i / 33 * 40
        );
    }
    let mut sources = Sources::default();
    let id = sources.add("plate.toml", text.as_str());
    let loader = MemoryLoader::default();
    let read = JobText::read(&mut sources, id, &loader).expect("the job reads");
    check(&read.file, "plate", &loader).expect("the job is right")
}

#[divan::bench(args = [
    "sinumerik-840d involute", "sinumerik-840d lens-1", "fanuc involute", "linuxcnc involute", "linuxcnc constant-engagement",
    "grbl lens-1", "heidenhain lens-1",
], sample_count = 5)]
fn plan_and_post_1000_bores(bencher: divan::Bencher, case: &str) {
    let (control, strategy) = case.split_once(' ').expect("two words");
    let job = job(control, strategy);
    bencher.bench_local(|| {
        let planned = plan(&job, &kinecut::base::Silent).expect("it can be planned");
        planned
            .iter()
            .map(|p| nc::write(&p.program, &job.tools, &job.post).expect("it can be posted").text.len())
            .sum::<usize>()
    });
}
