//! The one palette: colours by their meanings, each in light and in dark, as variables of every style sheet.

use std::fmt::Write as _;

/// Names of the colours, with those for light and for dark.
const COLOURS: [(&str, &str, &str); 66] = [
    ("page", "#f3f4f6", "#101316"),
    ("panel", "#ffffff", "#181c20"),
    ("sunk", "#eaecef", "#22272d"),
    ("stage", "#f8f9fa", "#14181c"),
    ("ink", "#15191e", "#e7eaed"),
    ("quiet", "#545d67", "#a1abb5"),
    ("rule", "#d3d8dd", "#333b43"),
    ("accent", "#0b5cad", "#74b7f7"),
    ("select", "#dcebfa", "#1b3a58"),
    ("safe", "#146c3a", "#5fcf8e"),
    ("safe-soft", "#e3f3e9", "#12301f"),
    ("np", "#855300", "#f0b64e"),
    ("np-soft", "#fdf0d0", "#36290d"),
    ("bad", "#b3161c", "#ff877f"),
    ("bad-soft", "#fbe7e6", "#3c191a"),
    ("rapid", "#c2410c", "#ff8f55"),
    ("link", "#64707c", "#98a5b2"),
    ("lead", "#a23b82", "#e79dce"),
    ("feed", "#0a6ea3", "#62b8ef"),
    ("rough", "#8a5c00", "#e5b642"),
    ("finish", "#00755a", "#45cc9f"),
    ("s0", "#0b5cad", "#74b7f7"),
    ("s1", "#c2410c", "#ff9a5c"),
    ("s2", "#00755a", "#45cc9f"),
    ("s3", "#a23b82", "#e79dce"),
    ("s4", "#6b5b00", "#d6c350"),
    ("s5", "#444b54", "#b6bec8"),
    ("part", "#d9d5cc", "#a9a59c"),
    ("cut", "#8d97a3", "#5c6773"),
    ("steel", "#5f7081", "#a9bac9"),
    ("machine", "#8a929b", "#9aa3ad"),
    ("fixture", "#707a85", "#8a939d"),
    ("raw", "#ccc6ba", "#a8a296"),
    ("milled", "#99a7b6", "#8795a4"),
    // Deviation, the same in both themes: a scale must not change its meaning with the light.
    ("band0", "#6d0014", "#6d0014"),
    ("band1", "#b2182b", "#b2182b"),
    ("band2", "#e8684f", "#e8684f"),
    ("band3", "#d8c5bd", "#d8c5bd"),
    ("band4", "#c3c8cc", "#c3c8cc"),
    ("band5", "#b3c5d4", "#b3c5d4"),
    ("band6", "#5aa2d6", "#5aa2d6"),
    ("band7", "#1d68b0", "#1d68b0"),
    ("band8", "#08306b", "#08306b"),
    // Faces of bodies, fully lit and turned away.
    ("grey-lit", "#d8dce1", "#565e67"),
    ("grey-dim", "#9ba4ae", "#2d3339"),
    ("blue-lit", "#d3e5f8", "#3b76b0"),
    ("blue-dim", "#7eabd9", "#193a5e"),
    ("orange-lit", "#fbdfc2", "#b8753c"),
    ("orange-dim", "#cf8546", "#573317"),
    ("sand-lit", "#efeadb", "#a39c83"),
    ("sand-dim", "#bdb295", "#5f5a49"),
    ("steel-lit", "#e6ecf2", "#748290"),
    ("steel-dim", "#8f9dac", "#2b333b"),
    ("teal-lit", "#d6eae4", "#4d8a80"),
    ("teal-dim", "#6fa39a", "#173733"),
    ("rose-lit", "#f3d3e8", "#a85c93"),
    ("rose-dim", "#b5579a", "#4b2040"),
    // Segments of curves on bodies, apart from one another and from the faces.
    ("k0", "#0b5cad", "#7cc0ff"),
    ("k1", "#6a1fb0", "#d0a3ff"),
    ("k2", "#00703f", "#52e09a"),
    ("k3", "#b00040", "#ff86a8"),
    ("k4", "#007384", "#4fe0f0"),
    ("k5", "#8a4b00", "#ffd65c"),
    ("k6", "#16191d", "#ffffff"),
    ("k7", "#77808a", "#b9c2cb"),
    ("k8", "#d4006a", "#ff5fb4"),
];

/// Steps of the scale from low to high (viridis), the same in both themes.
const SCALE: [&str; 16] = [
    "#440154", "#461868", "#462e7b", "#404284", "#39558b", "#31668d", "#2a778e", "#24888d", "#23988a",
    "#26a783", "#39b677", "#55c467", "#7bd04f", "#a5db35", "#d1e12c", "#fde725",
];

fn variables(dark: bool) -> String {
    let scheme = if dark { "dark" } else { "light" };
    let mut out = format!("color-scheme:{scheme}");
    for (name, light, night) in &COLOURS {
        // Writing to a String cannot fail.
        let _ = write!(out, ";--{name}:{}", if dark { night } else { light });
    }
    for (i, step) in SCALE.iter().enumerate() {
        let _ = write!(out, ";--scale{i}:{step}");
    }
    out
}

/// The colours of a page: those of the reader's system, or those that `data-theme` of the page says; light on paper.
pub(crate) fn of_page() -> String {
    let dark = variables(true);
    format!(
        ":root{{{}}}@media screen and (prefers-color-scheme:dark){{:root:not([data-theme=light]):not(.printing){{{dark}}}}}\
         @media screen{{:root[data-theme=dark]:not(.printing){{{dark}}}}}",
        variables(false)
    )
}

/// The colours of a picture in a file of its own.
pub(crate) fn of_file() -> String {
    format!(
        ":root{{{}}}@media screen and (prefers-color-scheme:dark){{:root{{{}}}}}",
        variables(false),
        variables(true)
    )
}

/// The rules that give a shape a colour of the palette, a body its shades, and a cell its step of the scale.
pub(crate) fn rules() -> String {
    let one = |(name, ..): &(&str, &str, &str)| match name.strip_suffix("-lit") {
        Some(tint) => format!(".t-{tint}{{--lit:var(--{tint}-lit);--dim:var(--{tint}-dim)}}"),
        None => format!(".c-{name}{{color:var(--{name})}}"),
    };
    let step = |(n, colour): (usize, &&str)| format!(".k-m{n}{{fill:{colour};stroke:{colour}}}");
    COLOURS.iter().map(one).chain(SCALE.iter().enumerate().map(step)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(colour: &str) -> f64 {
        let channel = |k: usize| {
            let v = f64::from(u8::from_str_radix(&colour[k..k + 2], 16).unwrap()) / 255.0;
            if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
    }

    fn contrast(a: &str, b: &str) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn text_stands_out_from_each_ground_and_lines_from_the_panel_in_both_themes() {
        let of = |name: &str| COLOURS.iter().find(|c| c.0 == name).unwrap();
        for dark in [false, true] {
            let pick = |c: &(&'static str, &'static str, &'static str)| if dark { c.2 } else { c.1 };
            for ground in ["page", "panel", "sunk", "stage"] {
                for text in ["ink", "quiet", "accent"] {
                    let found = contrast(pick(of(text)), pick(of(ground)));
                    assert!(found >= 4.5, "{text} on {ground}: {found}");
                }
            }
            for line in
                ["s0", "s1", "s2", "s3", "s4", "s5", "bad", "np", "safe", "rapid", "link", "lead", "rough"]
            {
                let found = contrast(pick(of(line)), pick(of("panel")));
                assert!(found >= 3.0, "{line}: {found}");
            }
        }
    }
}
