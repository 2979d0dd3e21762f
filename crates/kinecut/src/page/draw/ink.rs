//! Looks of shapes: a colour of the palette with a width and a dash, an area, a dot, a face of a body. Each look is a few
//! classes; their rules are here, for pages and for files alike.

use serde::{Deserialize, Serialize};

use super::palette;

/// Width at which charts and plans are laid out, and that for a narrow screen and for two beside each other on paper [px].
pub(crate) const WIDTHS: [f64; 2] = [512.0, 300.0];

/// A colour by its meaning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Colour {
    /// The text's own.
    Ink,
    /// The colour of receding parts.
    #[default]
    Quiet,
    /// The colour of separating lines.
    Rule,
    /// The ground.
    Panel,
    /// A receding ground.
    Sunk,
    /// Chosen or moving things.
    Accent,
    /// Right.
    Safe,
    /// In doubt.
    Doubt,
    /// Wrong.
    Bad,
    /// A thing at hand.
    Steel,
    /// One of six things told apart, from 0.
    Series(u8),
    /// One of nine kinds of curves on bodies, from 0.
    Kind(u8),
    /// One of six kinds of path, from 0.
    Path(u8),
}

/// Width of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Width {
    /// 0.7 px.
    Hair,
    /// 1 px.
    #[default]
    Fine,
    /// 1.4 px.
    Thin,
    /// 2 px.
    Middle,
    /// 2.5 px.
    Bold,
    /// 3.2 px.
    Wide,
    /// 5 px.
    Thick,
}

/// Dash of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Dash {
    /// None.
    #[default]
    Full,
    /// Dashes.
    Dashes,
    /// Dots.
    Dots,
    /// Long and short.
    Chain,
    /// Short dashes.
    Short,
    /// Long dashes.
    Long,
    /// Parts behind something: receding dashes.
    Hidden,
}

/// Colour of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tint {
    /// Grey.
    #[default]
    Grey,
    /// Blue.
    Blue,
    /// Orange.
    Orange,
    /// Sand.
    Sand,
    /// Steel.
    Steel,
    /// Teal.
    Teal,
    /// Rose.
    Rose,
}

/// Look of a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ink {
    /// A line.
    Line(Colour, Width, Dash),
    /// An area without a border.
    Area(Colour),
    /// An area that is seen through, with a border.
    Glass(Colour),
    /// A dot.
    Dot(Colour),
    /// A ring on the ground's colour.
    Ring(Colour),
    /// A step of the scale, from 0, the least, to [`Ink::STEPS`] less one.
    Step(u8),
    /// A face of a body by its shade, from 0, the lightest, to [`Ink::SHADES`] less one.
    Face(Tint, u8),
    /// The ground's colour around a line that lies over others.
    Halo,
}

impl Default for Ink {
    fn default() -> Ink {
        Ink::line(Colour::Quiet, Width::Fine)
    }
}

impl Ink {
    /// Steps of the scale.
    pub const STEPS: u8 = 16;
    /// Shades of a body.
    pub const SHADES: u8 = 8;
    /// Lines of an axis.
    pub const GRID: Ink = Ink::line(Colour::Sunk, Width::Fine);
    /// The line of an axis at zero.
    pub const ZERO: Ink = Ink::line(Colour::Rule, Width::Thin);
    /// The border of a plot.
    pub const FRAME: Ink = Ink::line(Colour::Rule, Width::Fine);

    /// A full line.
    pub const fn line(colour: Colour, width: Width) -> Ink {
        Ink::Line(colour, width, Dash::Full)
    }

    /// The line of one of several things told apart by colour and dash.
    pub fn series(index: usize) -> Ink {
        const DASHES: [Dash; 6] =
            [Dash::Full, Dash::Dashes, Dash::Dots, Dash::Chain, Dash::Short, Dash::Long];
        let n = index % DASHES.len();
        Ink::Line(Colour::Series(n as u8), Width::Thin, DASHES[n])
    }

    /// The classes of the look.
    pub(crate) fn class(self) -> String {
        match self {
            Ink::Line(colour, width, dash) => {
                let width = match width {
                    Width::Hair => "w-hair",
                    Width::Fine => "w-fine",
                    Width::Thin => "w-thin",
                    Width::Middle => "w-middle",
                    Width::Bold => "w-bold",
                    Width::Wide => "w-wide",
                    Width::Thick => "w-thick",
                };
                let dash = match dash {
                    Dash::Full => "",
                    Dash::Dashes => " d-dashes",
                    Dash::Dots => " d-dots",
                    Dash::Chain => " d-chain",
                    Dash::Short => " d-short",
                    Dash::Long => " d-long",
                    Dash::Hidden => " d-hidden",
                };
                format!("{} {width}{dash}", colour.class())
            }
            Ink::Area(colour) => format!("k-area {}", colour.class()),
            Ink::Glass(colour) => format!("k-glass {}", colour.class()),
            Ink::Dot(colour) => format!("k-dot {}", colour.class()),
            Ink::Ring(colour) => format!("k-ring {}", colour.class()),
            Ink::Step(n) => format!("k-m{}", n.min(Ink::STEPS - 1)),
            Ink::Face(tint, n) => format!("t-{} k-f{}", tint.name(), n.min(Ink::SHADES - 1)),
            Ink::Halo => "k-halo".to_owned(),
        }
    }
}

impl Colour {
    /// The class that sets it.
    pub(crate) fn class(self) -> String {
        format!("c-{}", self.variable())
    }

    /// The variable of the palette.
    fn variable(self) -> String {
        match self {
            Colour::Ink => "ink".to_owned(),
            Colour::Quiet => "quiet".to_owned(),
            Colour::Rule => "rule".to_owned(),
            Colour::Panel => "panel".to_owned(),
            Colour::Sunk => "sunk".to_owned(),
            Colour::Accent => "accent".to_owned(),
            Colour::Safe => "safe".to_owned(),
            Colour::Doubt => "np".to_owned(),
            Colour::Bad => "bad".to_owned(),
            Colour::Steel => "steel".to_owned(),
            Colour::Series(n) => format!("s{}", n.min(5)),
            Colour::Kind(n) => format!("k{}", n.min(8)),
            Colour::Path(n) => PATHS[usize::from(n.min(5))].to_owned(),
        }
    }
}

impl Tint {
    fn name(self) -> &'static str {
        match self {
            Tint::Grey => "grey",
            Tint::Blue => "blue",
            Tint::Orange => "orange",
            Tint::Sand => "sand",
            Tint::Steel => "steel",
            Tint::Teal => "teal",
            Tint::Rose => "rose",
        }
    }
}

/// The colours of paths by their names in the palette.
const PATHS: [&str; 6] = ["rapid", "link", "lead", "feed", "rough", "finish"];

/// Rules of widths, dashes and kinds of areas.
const RULES: &str = "\
:is(path,circle,line):is([class^=c-],[class^=k-],[class^=t-]){stroke-linejoin:round;stroke-linecap:round}\
:is(path,circle,line)[class^=c-]{fill:none;stroke:currentColor}\
.w-hair{stroke-width:.7}.w-fine{stroke-width:1}.w-thin{stroke-width:1.4}.w-middle{stroke-width:2}.w-bold{stroke-width:2.5}\
.w-wide{stroke-width:3.2}.w-thick{stroke-width:5}\
.d-dashes{stroke-dasharray:6 5}.d-dots{stroke-dasharray:1 4}.d-chain{stroke-dasharray:12 4 2 4}\
.d-short{stroke-dasharray:4 2.5}.d-long{stroke-dasharray:13 5}\
.d-hidden{stroke-dasharray:5 4;stroke-opacity:.7;stroke-linecap:butt!important}\
.k-area{fill:currentColor;stroke:none}.k-glass{fill:currentColor;fill-opacity:.12;stroke:currentColor;stroke-width:1.2}\
.k-dot{fill:currentColor;stroke:var(--panel);stroke-width:1}.k-ring{fill:var(--panel);stroke:currentColor;stroke-width:2}\
.k-halo{fill:none;stroke:var(--panel);stroke-width:4.5}\
[class*=k-m]{stroke-width:.6;stroke-linecap:butt!important;stroke-linejoin:miter!important}[class^=t-]{stroke-width:.7}";

/// Rules of the letters in pictures: 11 px for numbers, 12 for words, 14 for names.
const LETTERS: &str = "\
.picture text{paint-order:stroke;stroke:var(--panel);stroke-width:3px;stroke-linejoin:round}\
.picture text:is(.word,.tick){font-size:11px}.picture text:is(.title,.letter){font-size:14px;font-weight:650;fill:var(--ink)}\
.picture text.letter[class*=c-]{fill:currentColor}";

/// The rules of all looks.
pub(crate) fn rules() -> String {
    let shade = |n: u8| {
        let share = 100 * u32::from(n) / u32::from(Ink::SHADES - 1);
        let mixed = format!("color-mix(in srgb,var(--dim) {share}%,var(--lit))");
        format!(".k-f{n}{{fill:{mixed};stroke:{mixed}}}")
    };
    format!("{RULES}{LETTERS}{}{}", palette::rules(), (0..Ink::SHADES).map(shade).collect::<String>())
}
