//! Looks of pictures of grazing curves, light and dark: as part of a page, and of a file of its own.

/// Names of the colours, with those for light and for dark.
const COLOURS: [(&str, &str, &str); 21] = [
    ("in0", "#fbdfc2", "#b5713a"),
    ("in1", "#f4c497", "#955a2a"),
    ("in2", "#e6a970", "#75451e"),
    ("out0", "#e6ecf2", "#66727f"),
    ("out1", "#ccd6e0", "#515c68"),
    ("out2", "#b2bfcb", "#3e4852"),
    ("s0", "#0b5cad", "#7cc0ff"),
    ("s1", "#6a1fb0", "#d0a3ff"),
    ("s2", "#00703f", "#52e09a"),
    ("s3", "#b00040", "#ff86a8"),
    ("s4", "#007384", "#4fe0f0"),
    ("s5", "#8a4b00", "#ffd65c"),
    ("s6", "#16191d", "#ffffff"),
    ("s7", "#77808a", "#b9c2cb"),
    ("whole", "#d4006a", "#ff5fb4"),
    ("fold", "#ffffff", "#14171a"),
    ("ink", "#16191d", "#e6e9ec"),
    ("quiet", "#5a626b", "#9aa4af"),
    ("paper", "#ffffff", "#1b1f24"),
    ("rule", "#aab2ba", "#59626c"),
    ("move", "#b3161c", "#ff8078"),
];

/// Rules below a class.
const RULES: &str = "\
path:is([class^=g-in],[class^=g-out]){stroke-width:.7;stroke-linejoin:round}\
path:is([class^=g-s],.g-whole){fill:none;stroke-width:2.4;stroke-linejoin:round;stroke-linecap:round}\
path.g-hidden{stroke-width:1.4;stroke-dasharray:5 4;stroke-linecap:butt;stroke-opacity:.9}\
path.g-s7{stroke-dasharray:2 4}\
path.g-whole{stroke:var(--g-whole);stroke-width:3.4}path.g-whole.g-hidden{stroke-width:1.6}\
circle.g-fold{fill:var(--g-fold);stroke:var(--g-ink);stroke-width:1.6}\
path.g-outline{fill:none;stroke:var(--g-ink);stroke-width:.9;stroke-opacity:.75}\
path.p-way{fill:none;stroke:var(--g-move);stroke-width:2.2;stroke-dasharray:none}\
path.p-arrow{fill:var(--g-move);stroke:none}\
path.p-link{fill:none;stroke:var(--g-quiet);stroke-width:.9;stroke-dasharray:9 3 2 3}\
path.p-edge{fill:none;stroke:var(--g-quiet);stroke-width:1.2}\
path.grid{fill:none;stroke:var(--g-rule);stroke-width:.7;stroke-dasharray:2 3}\
path.frame{fill:none;stroke:var(--g-quiet);stroke-width:.9}";

fn sets(dark: bool) -> String {
    let one = |(name, light, night): &(&str, &str, &str)| {
        format!("--g-{name}:{}", if dark { night } else { light })
    };
    COLOURS.iter().map(one).collect::<Vec<_>>().join(";")
}

/// The rules of a page whose pictures are in figures of class `picture`.
pub(crate) fn page_style() -> String {
    format!(
        ".picture{{{}}}@media screen and (prefers-color-scheme:dark){{:root:not([data-theme=light]):not(.printing) .picture{{{dark}}}}}\
         @media screen{{:root[data-theme=dark]:not(.printing) .picture{{{dark}}}}}{}.pictures:not(.one){{grid-template-columns:repeat(auto-fit,minmax(min(100%,360px),1fr))}}",
        sets(false),
        rules(".picture"),
        dark = sets(true),
    )
}

/// The rules of an SVG file whose shapes are in a group of class `gz`.
pub(crate) fn file_style() -> String {
    format!(
        ".gz{{{}}}@media screen and (prefers-color-scheme:dark){{.gz{{{}}}}}{}\
         .gz text{{font-family:system-ui,Segoe UI,Roboto,Helvetica Neue,Arial,sans-serif;font-size:11px;fill:var(--g-ink)}}\
         .gz text.tick{{fill:var(--g-quiet)}}.gz text.title{{font-size:15px;font-weight:650}}\
         .gz .paper{{fill:var(--g-paper)}}",
        sets(false),
        sets(true),
        rules(".gz"),
    )
}

/// The rules under a class, with those of the colours.
fn rules(under: &str) -> String {
    let mut out = String::new();
    for n in 0..3 {
        for side in ["in", "out"] {
            out += &format!("{under} path.g-{side}{n}{{fill:var(--g-{side}{n});stroke:var(--g-{side}{n})}}");
        }
    }
    for rule in RULES.split_inclusive('}') {
        out += under;
        out += " ";
        out += rule;
    }
    for n in 0..8 {
        out += &format!("{under} path.g-s{n}{{stroke:var(--g-s{n})}}");
    }
    out
}
