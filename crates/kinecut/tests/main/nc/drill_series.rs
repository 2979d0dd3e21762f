//! A row of holes drilled at one feed: a series of cycles in the text, read back and proven like single moves.

use crate::common::job;

fn row(control: &str) -> String {
    format!(
        r#"
        format = 1
        stock = {{ box = {{ min = [-40, -10, -20], max = [40, 10, 0] }} }}
        post = {{ control = "{control}", decimals = 3 }}
        simulate = {{ step = 1.0 }}
        [[tool]]
        number = 2
        type = "drill"
        flute_length = 60
        diameter = 6
        [[setup]]
        offset = "G54"
        safe_height = 20
        [[setup.operation]]
        type = "drill"
        tool = 2
        points = [[-30, 0], [-15, 0], [0, 0], [15, 0], [30, 0]]
        entry = {{ surface = "plane" }}
        exit = {{ surface = "plane" }}
        length = 20
        speed = 1200
        feed_per_rev = {{ entry = 0.1, steady = 0.1, exit = 0.1 }}
        "#
    )
}

#[test]
fn a_row_of_holes_is_a_series_and_read_back_on_every_control() {
    for (control, words) in [
        ("sinumerik-840d", "\nMCALL CYCLE81("),
        ("linuxcnc", "\nX-15\nX0\nX15\nX30\nG80\n"),
        ("fanuc", "\nX-15.\nX0.\nX15.\nX30.\nG80\n"),
        ("grbl", "G0 X30"),
        ("heidenhain", "FMAX"),
    ] {
        let outcome = job::run(&row(control)).unwrap_or_else(|e| panic!("{control}: {e}"));
        let setup = &outcome.setups[0];
        let plain: String = setup
            .posted
            .text
            .lines()
            .map(|l| match l.strip_prefix('N') {
                Some(rest) => {
                    format!("\n{}", rest.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start())
                }
                None => format!("\n{l}"),
            })
            .collect();
        assert!(plain.contains(words), "{control}\n{}", setup.posted.text);
        assert!(setup.read_back.largest < 1e-3, "{control}: {:?}", setup.read_back);
        assert!(setup.read_back.moves >= 5 * 3, "{control}: {:?}", setup.read_back);
        assert!(outcome.verdict.is_safe(), "{control}: {:?}\n{}", outcome.verdict.found, setup.posted.text);
    }
}
