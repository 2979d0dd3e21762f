//! Letters of pictures: on every page between 10 and 18 pixels, whatever the picture's size.

use std::path::Path;

use crate::shell::{example, folder, kinecut, text};

/// Smallest and largest letter [px].
const BOUNDS: [f64; 2] = [10.0, 18.0];

/// A rule of a style sheet that holds on a screen: one selector, its last part, and what it sets.
struct Rule<'a> {
    selector: &'a str,
    last: &'a str,
    sets: &'a str,
}

/// The rules of a page that hold on a screen.
fn rules(style: &str) -> Vec<Rule<'_>> {
    let (mut found, mut rest, mut print) = (Vec::new(), style, None);
    let mut depth = 0usize;
    while let Some(at) = rest.find(['{', '}']) {
        let (before, brace) = (rest[..at].trim(), &rest[at..=at]);
        rest = &rest[at + 1..];
        if brace == "}" {
            depth -= 1;
            print = print.filter(|d| *d <= depth);
        } else if before.starts_with("@media") {
            depth += 1;
            if before.contains("print") {
                print = Some(depth);
            }
        } else {
            let end = rest.find('}').unwrap();
            if print.is_none() {
                let sets = &rest[..end];
                found.extend(selectors(before).into_iter().map(|selector| Rule {
                    selector,
                    last: last_part(selector),
                    sets,
                }));
            }
            rest = &rest[end + 1..];
        }
    }
    found
}

/// The selectors of a list, commas within brackets aside.
fn selectors(list: &str) -> Vec<&str> {
    let (mut depth, mut from, mut found) = (0i32, 0, Vec::new());
    for (i, c) in list.char_indices().chain([(list.len(), ',')]) {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth == 0 => {
                found.push(list[from..i].trim());
                from = i + 1;
            }
            _ => {}
        }
    }
    found
}

fn last_part(selector: &str) -> &str {
    let mut depth = 0;
    let cut = selector.trim().char_indices().rev().find(|(_, c)| {
        depth += i32::from(*c == ')') - i32::from(*c == '(');
        depth == 0 && (c.is_whitespace() || *c == '>')
    });
    cut.map_or(selector.trim(), |(i, c)| &selector.trim()[i + c.len_utf8()..])
}

impl Rule<'_> {
    /// Whether it may be about an element that lies in others of these classes.
    fn is_about(&self, tag: &str, classes: &str, around: &str) -> bool {
        let before = &self.selector[..self.selector.len() - self.last.len()];
        let mut outer = before
            .split('.')
            .skip(1)
            .map(|c| c.split([':', ')', '[', ',', ' ', '>']).next().unwrap_or_default());
        if !outer.all(|c| around.split(' ').any(|own| own == c)) {
            return false;
        }
        let named = self.last.split(['.', ':', '[', '(']).next().unwrap_or_default();
        let mut wanted =
            self.last.split('.').skip(1).map(|c| c.split([':', ')', '[', ',']).next().unwrap_or_default());
        let tag_fits = named == tag || (named.is_empty() && self.last.contains('.'));
        tag_fits && (!self.last.contains('.') || wanted.any(|c| classes.split(' ').any(|own| own == c)))
    }

    /// The length that it gives a property [px].
    fn px(&self, property: &str) -> Option<f64> {
        let one = self.sets.split(';').find_map(|s| s.strip_prefix(property)?.strip_prefix(':'))?;
        one.strip_suffix("px")?.parse().ok()
    }
}

fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    tag.split(&format!(" {name}=\"")).nth(1)?.split('"').next()
}

/// The sizes of all letters in pictures of a page [px].
fn sizes(page: &str, name: &str) -> Vec<f64> {
    let style = page.split("<style>").nth(1).unwrap().split("</style>").next().unwrap();
    let rules = rules(style);
    for rule in rules
        .iter()
        .filter(|r| r.is_about("svg", "wide", "plan chart drawing picture") && r.last.starts_with("svg"))
    {
        assert!(!rule.sets.contains("width:"), "{name}: {} scales pictures: {}", rule.last, rule.sets);
    }
    let mut found = Vec::new();
    // What is drawn at one scale: its factor, outermost first; the classes of the figure around it.
    let (mut scales, mut figure): (Vec<f64>, &str) = (Vec::new(), "");
    let body = page.split("</head>").nth(1).unwrap_or(page);
    for part in body.split("<script").next().unwrap().split('<').skip(1) {
        let tag = part.split('>').next().unwrap();
        if tag.starts_with("/svg") {
            scales.pop();
        } else if tag.starts_with("figure") {
            figure = attribute(tag, "class").unwrap_or_default();
        } else if tag.starts_with("svg") {
            let view: Vec<f64> = attribute(tag, "viewBox")
                .map_or(Vec::new(), |v| v.split(' ').map(|n| n.parse().unwrap()).collect());
            let width: Option<f64> = attribute(tag, "width").and_then(|w| w.parse().ok());
            // Without a width the page decides: at most its own.
            let width = width.unwrap_or(1144.0);
            scales.push(view.get(2).map_or(1.0, |v| width / v));
        } else if let (true, Some(tag_name)) =
            (!scales.is_empty(), ["text", "tspan"].into_iter().find(|t| tag.starts_with(t)))
        {
            let classes = attribute(tag, "class").unwrap_or_default();
            let set: Vec<f64> = rules
                .iter()
                .filter(|r| r.is_about(tag_name, classes, figure))
                .filter_map(|r| r.px("font-size"))
                .collect();
            assert!(!set.is_empty() || tag_name == "tspan", "{name}: <{tag}> has no size");
            found.extend(set.iter().map(|s| s * scales.iter().product::<f64>()));
        }
    }
    assert!(scales.is_empty(), "{name}");
    found
}

fn check(file: &Path) {
    let name = file.display().to_string();
    let page = std::fs::read_to_string(file).unwrap();
    let sizes = sizes(&page, &name);
    assert!(sizes.len() > 10, "{name} has letters");
    for size in sizes {
        assert!((BOUNDS[0]..=BOUNDS[1]).contains(&size), "{name}: {size} px");
    }
}

#[test]
fn letters_of_every_page_have_a_size_that_can_be_read() {
    let out = folder("letters");
    let into = |name: &str| out.join(name).display().to_string();
    let pages: [(&[&str], &str); 9] = [
        (&["hole", "12_compare/hole.toml"], "hole.html"),
        (&["hole", "12_compare/hole.toml", "--compare"], "compare.html"),
        (&["drill", "03_drill_through_shaft/figure_7.toml", "--paper"], "drill.html"),
        (&["face", "04_gear_pump_cover/face.toml"], "face.html"),
        (&["grazing", "06_five_axis_sweep/tool.toml"], "grazing.html"),
        (&["envelope", "06_five_axis_sweep/envelope.toml"], "envelope.html"),
        (&["surface", "05_machine_from_code/cone.toml"], "surface.html"),
        (&["layouts", "2103", "--show", "2"], "layouts.html"),
        (&["run", "01_bore/job.toml"], "report.html"),
    ];
    for (args, page) in pages {
        let file = args.iter().map(|a| if a.contains(".toml") { example(a) } else { (*a).to_owned() });
        let mut args: Vec<String> = file.collect();
        let folder = into(page);
        args.extend(["--out".to_owned(), folder.clone()]);
        let run = kinecut(&args.iter().map(String::as_str).collect::<Vec<_>>(), "");
        assert!(matches!(run.status.code(), Some(0 | 1)), "{page}: {}", text(&run.stderr));
        check(&Path::new(&folder).join(page));
    }
    std::fs::remove_dir_all(out).unwrap();
}

#[test]
fn rules_are_read_as_a_browser_reads_them() {
    let style = "svg text{font-size:11px}@media print{svg text{font-size:3px}}.plan :is(.b,.c){font-size:12px}@media screen{.d{font-size:14px}}.other .d{font-size:30px}";
    let sizes = |tag: &str, class: &str| {
        let found = rules(style);
        found
            .iter()
            .filter(|r| r.is_about(tag, class, "plan"))
            .filter_map(|r| r.px("font-size"))
            .collect::<Vec<_>>()
    };
    assert_eq!(sizes("text", "x"), [11.0]);
    assert_eq!(sizes("text", "c"), [11.0, 12.0]);
    assert_eq!(sizes("tspan", "d"), [14.0]);
}
