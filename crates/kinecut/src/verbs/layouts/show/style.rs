//! Colours of pictures of machines and splits: light and dark, by CSS variables of their own.

/// What a thing in a picture is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Look {
    /// What stands still.
    Bed,
    /// Carries the work.
    Work,
    /// Carries the tool.
    Tool,
    /// The workpiece.
    Part,
    /// Spindle and cutter.
    Steel,
}

impl Look {
    /// The class of a face of a shade from 0, the lightest, to 2.
    pub(crate) fn class(self, shade: usize) -> String {
        let letter = match self {
            Look::Bed => 'b',
            Look::Work => 'w',
            Look::Tool => 't',
            Look::Part => 'p',
            Look::Steel => 's',
        };
        format!("k{letter}{shade}")
    }
}

/// Names of the colours, with those for light and for dark.
const COLOURS: [(&str, &str, &str); 22] = [
    ("ink", "#16191d", "#e6e9ec"),
    ("quiet", "#5a626b", "#9aa4af"),
    ("paper", "#ffffff", "#1b1f24"),
    ("b0", "#d3d7dc", "#565e67"),
    ("b1", "#b9c0c7", "#434a52"),
    ("b2", "#a5adb6", "#353b42"),
    ("w0", "#d3e5f8", "#3b76b0"),
    ("w1", "#adcdee", "#2b5d8f"),
    ("w2", "#8fb8e2", "#204973"),
    ("t0", "#fce3cd", "#b06f35"),
    ("t1", "#f5c9a2", "#905825"),
    ("t2", "#e8b182", "#74441a"),
    ("p0", "#efeadb", "#a39c83"),
    ("p1", "#dcd5c0", "#87816b"),
    ("p2", "#cbc2a9", "#706b58"),
    ("s0", "#e4e9ee", "#a7b4c0"),
    ("s1", "#bec9d3", "#84929f"),
    ("s2", "#9dabb8", "#697783"),
    ("forming", "#0b5cad", "#6cb2f5"),
    ("linked", "#a0438a", "#e39aca"),
    ("setting", "#6b7682", "#93a0ad"),
    ("edge", "#c4510a", "#ff9a5c"),
];

/// Rules for everything in a group of class `kc`.
const RULES: &str = "\
.kc path,.kc line,.kc circle{stroke-linejoin:round;stroke-linecap:round}\
.kc .face{stroke:var(--k-ink);stroke-width:.7}\
.kc .seam{stroke-width:1}.kc .edge-line{fill:none;stroke:var(--k-ink);stroke-width:.7}\
.kc .halo{fill:none;stroke:var(--k-paper);stroke-width:4.5}\
.kc .move{fill:none;stroke:var(--k-ink);stroke-width:1.8}\
.kc .tip{fill:var(--k-ink);stroke:none}\
.kc .leader{fill:none;stroke:var(--k-quiet);stroke-width:.7}\
.kc .dot{fill:var(--k-quiet);stroke:none}\
.kc .ground{fill:none;stroke:var(--k-quiet);stroke-width:.9}\
.kc .bar{fill:none;stroke:var(--k-quiet);stroke-width:1.1}\
.kc .paper{fill:var(--k-paper);stroke:none}\
.kc .cell{fill:none;stroke:var(--k-b1);stroke-width:.8}\
.kc text{font-family:system-ui,Segoe UI,Roboto,Helvetica Neue,Arial,sans-serif;font-size:12px;fill:var(--k-ink)}\
.kc .letter{font-size:14px;font-weight:650}\
.kc .title{font-size:14px;font-weight:650}\
.kc .quiet{fill:var(--k-quiet);font-size:11px}\
.kc .on{paint-order:stroke;stroke:var(--k-paper);stroke-width:3px;stroke-linejoin:round}\
.kc .patch{stroke:var(--k-ink);stroke-width:.5;stroke-opacity:.42}\
.kc .body{fill:var(--k-s1);fill-opacity:.75;stroke:var(--k-ink);stroke-width:.7}\
.kc .generated{fill:none;stroke:var(--k-edge);stroke-width:2.6}\
.kc .point{fill:var(--k-edge);stroke:var(--k-paper);stroke-width:1}\
.kc .tool-patch{fill:var(--k-edge);fill-opacity:.3;stroke:var(--k-edge);stroke-width:.7}\
.kc .forming{stroke:var(--k-forming)}.kc .linked{stroke:var(--k-linked)}\
.kc .setting{stroke:var(--k-setting);stroke-dasharray:5 3}\
.kc .tip.forming{fill:var(--k-forming);stroke:none}.kc .tip.linked{fill:var(--k-linked);stroke:none}\
.kc .tip.setting{fill:var(--k-setting);stroke:none}\
.kc .set-up{stroke:var(--k-edge);stroke-dasharray:1 4}.kc .tip.set-up{fill:var(--k-edge);stroke:none}.kc text.set-up{fill:var(--k-edge)}\
.kc text.forming{fill:var(--k-forming)}.kc text.linked{fill:var(--k-linked)}.kc text.setting{fill:var(--k-setting)}\
.kc text.forming,.kc text.linked,.kc text.setting,.kc text.set-up{stroke:var(--k-paper);stroke-dasharray:none}\
.kc .axis{fill:none;stroke:var(--k-quiet);stroke-width:.8;stroke-dasharray:9 3 2 3}";

/// The rules that pictures of machines and splits need in a page; a file of its own carries them itself.
pub fn layout_style() -> String {
    let set = |dark: bool| {
        let one = |(name, light, night): &(&str, &str, &str)| {
            format!("--k-{name}:{}", if dark { night } else { light })
        };
        COLOURS.iter().map(one).collect::<Vec<_>>().join(";")
    };
    let fills: String = ["b", "w", "t", "p", "s"]
        .iter()
        .flat_map(|letter| (0..3).map(move |n| format!(".kc .k{letter}{n}{{fill:var(--k-{letter}{n})}}")))
        .collect();
    format!(
        ".kc{{{}}}@media screen and (prefers-color-scheme:dark){{:root:not([data-theme=light]):not(.printing) .kc{{{dark}}}}}\
         @media screen{{:root[data-theme=dark]:not(.printing) .kc{{{dark}}}}}{RULES}{fills}",
        set(false),
        dark = set(true),
    )
}
