//! The report as a whole: nothing fetched, nothing from outside active, the same bytes each time, all parts in order.

use kinecut::base::{Code, Finding, Location};
use kinecut::job::report::{
    PartView, PathPiece, PathRole, ProgramView, Report, ReportVerdict, ToolView, html, sections,
};
use kinecut::page::{Block, Cell, Chart, Column, Fact, Plan, Row, Section, Table, WIDTH};

#[path = "../fixtures/report.rs"]
mod fixture;

/// The report as a terminal shows it.
fn text(report: &Report) -> String {
    kinecut::page::text(&sections(report), WIDTH)
}

/// The page without the script and the style of the program itself.
fn own_markup(page: &str) -> String {
    let script = include_str!("../../src/page/assets/report.js");
    let style = include_str!("../../src/page/assets/report.css");
    let moves = include_str!("../../src/page/assets/picture.js");
    let looks = include_str!("../../src/page/assets/picture.css");
    [script, style, moves, looks].iter().fold(page.to_owned(), |page, own| {
        assert!(page.contains(own));
        page.replace(own, "")
    })
}

/// Names and attributes of all tags, by a small reader of its own: text and quoted values may hold anything but `<`.
fn tags(page: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut tags = Vec::new();
    let mut rest = page;
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        let name_end = rest.find(|c: char| c.is_whitespace() || c == '>').expect("a tag ends");
        let name = rest[..name_end].to_owned();
        rest = &rest[name_end..];
        let mut attributes = Vec::new();
        loop {
            rest = rest.trim_start();
            if let Some(after) = rest.strip_prefix('>') {
                rest = after;
                break;
            }
            let end =
                rest.find(|c: char| c == '=' || c == '>' || c.is_whitespace()).expect("an attribute ends");
            let key = rest[..end].to_owned();
            rest = &rest[end..];
            let mut value = String::new();
            if let Some(after) = rest.strip_prefix("=\"") {
                let close = after.find('"').expect("a value is closed");
                value = after[..close].to_owned();
                rest = &after[close + 1..];
            }
            attributes.push((key, value));
        }
        tags.push((name, attributes));
    }
    tags
}

#[test]
fn the_banner_has_the_class_of_its_outcome() {
    use kinecut::job::Judgement;
    for (outcome, class) in
        [(Judgement::Safe, "safe"), (Judgement::NotProven, "doubt"), (Judgement::NotSafe, "unsafe")]
    {
        let page = html(&Report::new("Plate", ReportVerdict::new(outcome, "why")));
        assert!(page.contains(&format!("<section class=\"verdict {class}\" role=\"status\"")), "{class}");
        assert!(page.contains(&format!("<title>{}: Plate</title>", outcome.word())), "{class}");
    }
}

#[test]
fn the_page_fetches_nothing() {
    let page = html(&fixture::plate(false));
    let own = own_markup(&page);
    assert!(!own.contains("http://") && !own.contains("https://"));
    for (name, attributes) in tags(&own) {
        assert!(!["link", "iframe", "object", "embed", "base", "form"].contains(&name.as_str()), "<{name}>");
        for (key, value) in attributes {
            assert!(
                !["src", "srcset", "action", "style", "background"].contains(&key.as_str()),
                "{name} {key}={value}"
            );
            assert!(!key.starts_with("on"), "{name} {key}");
            if key == "href" {
                assert!(value.starts_with('#'), "{value}");
            }
        }
    }
    let policy = page.split("http-equiv=\"Content-Security-Policy\" content=\"").nth(1).unwrap();
    let policy = policy.split('"').next().unwrap();
    assert!(policy.contains("default-src 'none'") && !policy.contains("unsafe"), "{policy}");
    for word in ["fetch(", "XMLHttpRequest", "WebSocket", "@import", "url("] {
        assert!(!include_str!("../../src/page/assets/report.css").contains(word), "style: {word}");
        assert!(!include_str!("../../src/page/assets/picture.css").contains(word), "style: {word}");
        assert!(!include_str!("../../src/page/assets/picture.js").contains(word), "script: {word}");
    }
    assert!(!include_str!("../../src/page/assets/report.js").contains("</script"));
}

#[test]
fn the_policy_allows_exactly_the_script_and_the_style_of_the_page() {
    use base64::Engine as _;
    use sha2::Digest as _;
    let page = html(&fixture::plate(true));
    let between = |open: &str, close: &str| {
        let from = page.rfind(open).unwrap() + open.len();
        let len = page[from..].find(close).unwrap();
        page[from..from + len].to_owned()
    };
    for (body, key) in
        [(between("<script>", "</script>"), "script-src"), (between("<style>", "</style>"), "style-src")]
    {
        let hash = base64::engine::general_purpose::STANDARD.encode(sha2::Sha256::digest(body.as_bytes()));
        assert!(page.contains(&format!("{key} 'sha256-{hash}'")), "{key}");
    }
}

/// Text that breaks out of anything that forgets to escape it.
const HOSTILE: &str =
    "</script><img src=x onerror=alert(1)>\"'`&amp;<!--\u{1b}[2J\u{0}\u{202e}\u{2028}\u{9b}]]>\r\n";

fn hostile() -> Report {
    let bad = || HOSTILE.to_owned();
    let mut report = Report::new(bad(), ReportVerdict::new(kinecut::job::Judgement::NotSafe, bad()));
    let v = &mut report.verdict;
    (v.proven, v.found, v.sha256, v.scope) = (vec![bad()], vec![bad()], bad(), vec![bad()]);
    v.not_checked = vec![fixture::unchecked(kinecut::job::Heading::Assumed, &bad())];
    v.facts = vec![Fact::new(bad(), bad()).note(bad())];
    report.job_file = bad();
    report.version = bad();
    report.program = Some(ProgramView {
        file: bad(),
        control: bad(),
        lines: vec![bad(), "N10 (x)".to_owned(), bad()],
        time: vec![1.0, f32::NAN, f32::INFINITY],
        length: vec![-1.0],
        parts: Vec::new(),
    });
    let mut tool = ToolView::new(1, bad(), f64::NAN, f64::INFINITY);
    tool.note = bad();
    report.tools = vec![tool];
    report.path = vec![PathPiece::new(
        2,
        PathRole::Rough,
        vec![[0.0, 0.0, 0.0], [f32::NAN, 1.0, 0.0], [5.0, 1.0, 2.0]],
    )];
    report.part = Some(PartView {
        vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, f32::INFINITY, 0.0]],
        triangles: vec![[0, 1, 2], [0, 1, u32::MAX]],
        deviation: vec![f32::NAN, 1e30],
        tolerance: 0.01,
        relative: false,
    });
    let mut finding =
        Finding::error(Code::NC_WORD, bad()).value(f64::NAN, HOSTILE).bound(1.0, HOSTILE).help(bad());
    finding = finding.key(bad()).at(Location { line: 1, ..Location::whole_file(HOSTILE) }).point([
        f64::NAN,
        0.0,
        0.0,
    ]);
    report.findings = vec![finding];
    let mut chart = Chart::new(HOSTILE, (HOSTILE, HOSTILE), (HOSTILE, HOSTILE));
    chart = chart.series(bad(), vec![[0.0, 1.0], [1.0, 2.0]]).mark(0.5, bad()).level(1.5, bad());
    let mut plan = Plan::new(bad());
    plan.points = vec![([0.0, 0.0], bad()), ([1.0, 1.0], bad())];
    let table = Table {
        caption: bad(),
        columns: vec![Column::text(bad()), Column::number(bad(), bad())],
        rows: vec![Row::new(vec![bad().into(), Cell::corrected(bad(), bad())]).at(1)],
        notes: vec![bad()],
    };
    let section = Section::new(bad()).with(Block::Text(bad())).with(Block::List(vec![bad()]));
    report.sections = vec![section.with(Block::Heading(bad())).with(chart).with(plan).with(table)];
    report
}

#[test]
fn hostile_text_stays_text() {
    let page = html(&hostile());
    let own = own_markup(&page);
    let strange = |c: char| (c.is_control() && c != '\n') || ('\u{2028}'..='\u{202e}').contains(&c);
    let data: Vec<&str> = own
        .split("type=\"application/json\">")
        .skip(1)
        .map(|s| s.split("</script>").next().unwrap())
        .collect();
    assert_eq!(data.len(), 2);
    for json in &data {
        assert!(!json.contains(['<', '>', '&']) && !json.chars().any(strange));
        serde_json::from_str::<serde_json::Value>(json).unwrap();
    }
    assert!(!own.chars().any(strange));
    let reference = tags(&own_markup(&html(&fixture::plate(false))));
    let known: Vec<&String> = reference.iter().map(|t| &t.0).collect();
    for (name, attributes) in tags(&own) {
        assert!(known.contains(&&name) || ["h3", "/h3", "ul", "br"].contains(&name.as_str()), "<{name}>");
        assert!(name != "img" || attributes.iter().any(|a| a.1 == "kc-still"));
        assert!(
            attributes.iter().all(|(key, _)| !key.starts_with("on") && key != "src"),
            "<{name}> {attributes:?}"
        );
    }
    // Three lines of program stay three lines.
    let pre = own.split("<pre").nth(1).unwrap().split("</pre>").next().unwrap();
    assert_eq!(pre.matches('\n').count(), 3);
    for word in ["NaN", "inf\""] {
        assert!(!own.contains(word), "{word}");
    }
    assert!(!text(&hostile()).chars().any(strange));
}

#[test]
fn the_same_report_gives_the_same_bytes() {
    assert_eq!(html(&fixture::plate(false)), html(&fixture::plate(false)));
    assert_eq!(text(&fixture::plate(false)), text(&fixture::plate(false)));
}

#[test]
fn parts_stand_in_the_order_in_which_they_are_read() {
    let mut report = fixture::plate(false);
    report.sections.push(Section::new("Drilling").with(Block::Text("second".to_owned())));
    let page = own_markup(&html(&report));
    let order = [
        "<h1>",
        "NOT SAFE</p>",
        "the wall of the bore is gouged",
        "Time at programmed feeds",
        "id=\"kc-canvas\"",
        "id=\"kc-list\"",
        "<h2>Bore</h2>",
        "<h2>Drilling</h2>",
        "<h2>Tools</h2>",
        "<h2>Findings",
        "KC0505",
        "KC0503",
        "KC0506",
        "<h2>Checks</h2>",
        "does not replace the dry run",
        "SHA-256",
        "Program text",
    ];
    let mut at = page.find("<body>").unwrap();
    for word in order {
        at += page[at..].find(word).unwrap_or_else(|| panic!("`{word}` is missing or too early"));
    }
}

#[test]
fn a_small_report_is_small_and_needs_nothing() {
    let page =
        html(&Report::new("Nothing", ReportVerdict::new(kinecut::job::Judgement::Safe, "nothing to do")));
    assert!(!own_markup(&page).contains("kc-canvas"));
    assert!(html(&fixture::plate(true)).len() < 1_500_000);
    assert!(page.contains(">SAFE<") && !page.contains("NOT SAFE"));
}

#[test]
fn a_long_report_stays_below_its_limit() {
    let mut report = fixture::plate(true);
    let part = report.part.as_mut().unwrap();
    let (vertices, triangles, deviation) =
        (part.vertices.clone(), part.triangles.clone(), part.deviation.clone());
    // Fifty parts in a row: a million triangles, which the page shows with fewer.
    for k in 1..50 {
        let base = part.vertices.len() as u32;
        part.vertices.extend(vertices.iter().map(|v| [v[0] + 130.0 * k as f32, v[1], v[2]]));
        part.triangles.extend(triangles.iter().map(|t| t.map(|i| i + base)));
        part.deviation.extend_from_slice(&deviation);
    }
    let program = report.program.as_mut().unwrap();
    let lines = program.lines.clone();
    for _ in 1..125 {
        program.lines.extend_from_slice(&lines);
    }
    let page = html(&report);
    assert!(page.len() < 15_000_000, "{}", page.len());
    assert!(page.contains("numbers are of the full mesh"));
}

/// Text, path, times and lengths of a long program are columns of numbers that change little from line to line.
#[test]
fn a_long_program_takes_few_bytes_a_line() {
    const MOVES: u32 = 50_000;
    let mut report = Report::new("Rows", ReportVerdict::new(kinecut::job::Judgement::Safe, ""));
    let nothing = html(&report).len();
    let mut program = ProgramView { file: "ROWS.NC".to_owned(), ..ProgramView::default() };
    let mut last = [0.0f32; 3];
    for i in 0..MOVES {
        // Rows to and fro over a wave, with the last decimal as a planner rounds it.
        let (row, along) = (i / 500, i % 500);
        let x = 0.2 * f64::from(if row % 2 == 0 { along } else { 499 - along });
        let y = 0.25 * f64::from(row);
        let z = 4.0 * (x / 17.0).sin() * (y / 23.0).cos() - 6.0;
        program.lines.push(format!("X{x:.5} Y{y:.5} Z{z:.5}"));
        program.time.push(0.01);
        program.length.push(0.2);
        let at = [x, y, z].map(|v| v as f32);
        report.path.push(PathPiece::new(i, PathRole::Feed, vec![last, at]));
        last = at;
    }
    report.program = Some(program);
    let page = html(&report);
    // The lines alone have 26 bytes each. The plan from above has its own bound, by what can be seen.
    let plan = page.split("<figure class=\"plan\">").nth(1).unwrap().split("</figure>").next().unwrap().len();
    let each = (page.len() - nothing - plan) as f64 / f64::from(MOVES);
    assert!(each < 4.0, "{each} bytes a line");
    assert!(page.contains("its text is packed") && !page.contains("X0.20000"));
}

#[test]
fn the_model_survives_json() {
    let mut report = fixture::plate(false);
    // Numbers with few binary digits: the reader of JSON may be off by one in the last of others.
    report.time = Some(22.75);
    report.path = vec![PathPiece::new(7, PathRole::Finish, vec![[0.5, 1.25, -3.0]])];
    report.part = Some(PartView {
        vertices: vec![[0.0, 0.5, 1.0]; 3],
        triangles: vec![[0, 1, 2]],
        deviation: vec![0.25, f32::NAN, -0.5],
        tolerance: 0.125,
        relative: false,
    });
    report.program = None;
    let gap =
        Chart::new("c", ("x", ""), ("y", "")).series("s", vec![[0.0, 1.0], [1.0, f64::NAN], [2.0, 0.5]]);
    report.sections = vec![Section::new("S").with(gap)];
    let json = serde_json::to_string(&report).unwrap();
    let back: Report = serde_json::from_str(&json).unwrap();
    // NaN is not equal to itself; written again both give the same text.
    assert_eq!(serde_json::to_string(&back).unwrap(), json);
    let deviation = back.part.unwrap().deviation;
    assert!(deviation[1].is_nan() && deviation[2] == -0.5);
    let Block::Chart(chart) = &back.sections[0].blocks[0] else { panic!("a chart") };
    assert!(chart.series[0].points[1][1].is_nan() && chart.series[0].points[2] == [2.0, 0.5]);
}

#[test]
fn the_text_says_the_essentials() {
    let text = text(&fixture::plate(false));
    for word in [
        "NOT SAFE",
        "Largest deviation",
        "-66.4 µm",
        "T1 end mill",
        "error KC0505 PLATE.MPF:312:1",
        "Not checked",
        "dry run",
    ] {
        assert!(text.contains(word), "{word}\n{text}");
    }
    assert!(text.lines().next().unwrap().starts_with("NOT SAFE"));
}

/// A forgotten build of the script is found without Node: the record names the sources it was made from.
#[test]
fn the_script_was_built_from_its_sources() {
    use sha2::Digest as _;
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("viewer");
    let mut names: Vec<String> = std::fs::read_dir(folder.join("src"))
        .unwrap()
        .map(|entry| format!("src/{}", entry.unwrap().file_name().into_string().unwrap()))
        .collect();
    names.push("package-lock.json".to_owned());
    names.sort();
    let mut hash = sha2::Sha256::new();
    for name in names {
        hash.update(name.as_bytes());
        hash.update([0]);
        hash.update(std::fs::read(folder.join(&name)).unwrap());
        hash.update([0]);
    }
    let digest: String = hash.finalize().iter().map(|b| format!("{b:02x}")).collect();
    let record = include_str!("../../src/page/assets/sources.sha256").trim();
    assert_eq!(digest, record, "run `npm ci && npm run build` in crates/kinecut/viewer");
}
