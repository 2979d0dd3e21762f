//! Looks of pictures of envelopes, light and dark.

/// Lightest and darkest colour of each part, in light and in dark: wall, start, end, inside.
const PARTS: [[[u8; 3]; 4]; 4] = [
    [[0xd6, 0xea, 0xe4], [0x6f, 0xa3, 0x9a], [0x4d, 0x8a, 0x80], [0x17, 0x37, 0x33]],
    [[0xe6, 0xec, 0xf2], [0x8f, 0x9d, 0xac], [0x74, 0x82, 0x90], [0x2b, 0x33, 0x3b]],
    [[0xfb, 0xdf, 0xc2], [0xcf, 0x85, 0x46], [0xb8, 0x75, 0x3c], [0x57, 0x33, 0x17]],
    [[0xf6, 0xc9, 0xd0], [0xc0, 0x4a, 0x60], [0xb4, 0x46, 0x5c], [0x55, 0x1b, 0x28]],
];
/// Shades of a part.
const SHADES: u8 = 8;
/// Rules besides the fills.
const RULES: &str = "\
path[class^=v-]{stroke-width:.6;stroke-linejoin:round}\
path.e-curve,path.e-hidden{fill:none;stroke:var(--g-ink);stroke-width:1.3;stroke-linejoin:round}\
path.e-hidden{stroke-width:.8;stroke-dasharray:4 4;stroke-opacity:.55}\
path.e-phantom{fill:none;stroke:var(--g-move);stroke-width:.9;stroke-dasharray:10 3 2 3 2 3;stroke-opacity:.8}\
path.g-outline{stroke-linecap:round}";

fn sets(dark: bool) -> String {
    let mut out = Vec::new();
    for (part, colours) in PARTS.iter().enumerate() {
        let [from, to] = if dark { [colours[2], colours[3]] } else { [colours[0], colours[1]] };
        for n in 0..SHADES {
            let mixed = [0, 1, 2].map(|k| {
                let share = f64::from(n) / f64::from(SHADES - 1);
                (f64::from(from[k]) * (1.0 - share) + f64::from(to[k]) * share).round() as u8
            });
            out.push(format!("--v-{part}{n}:#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]));
        }
    }
    out.join(";")
}

fn rules(under: &str) -> String {
    let mut out = String::new();
    for part in 0..PARTS.len() {
        for n in 0..SHADES {
            out += &format!("{under} path.v-{part}{n}{{fill:var(--v-{part}{n});stroke:var(--v-{part}{n})}}");
        }
    }
    for rule in RULES.split_inclusive('}') {
        out += &format!("{under} {}", rule.replace(",path.", &format!(",{under} path.")));
    }
    out
}

/// The rules of a page, beside those of grazing curves.
pub(crate) fn page_style() -> String {
    let dark = sets(true);
    format!(
        ".picture{{{}}}@media screen and (prefers-color-scheme:dark){{:root:not([data-theme=light]):not(.printing) .picture{{{dark}}}}}\
         @media screen{{:root[data-theme=dark]:not(.printing) .picture{{{dark}}}}}{}",
        sets(false),
        rules(".picture"),
    )
}

/// The rules of an SVG file whose shapes are in a group of class `gz`, beside those of grazing curves.
pub(crate) fn file_style() -> String {
    format!(
        ".gz{{{}}}@media screen and (prefers-color-scheme:dark){{.gz{{{}}}}}{}",
        sets(false),
        sets(true),
        rules(".gz")
    )
}
