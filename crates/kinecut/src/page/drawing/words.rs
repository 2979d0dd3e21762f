//! Words in a drawing: names with lowered letters, and how wide they are.

use maud::{Markup, html};

use crate::page::visible;

/// Size of letters [px]; the same as in the style of drawings.
pub(crate) const SIZE: f64 = 12.0;
/// A character on average, and a lowered one, as shares of the size: measured on common sans-serif fonts, a little above.
const CHARACTER: f64 = 0.57;
const LOWERED: f64 = 0.48;

/// A bit of text, and whether it is lowered.
fn bits(text: &str) -> Vec<(&str, bool)> {
    let mut bits = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find('_') {
        let (before, after) = (&rest[..at], &rest[at + 1..]);
        let end = after.find(|c: char| !c.is_alphanumeric()).unwrap_or(after.len());
        bits.push((before, false));
        bits.push((&after[..end], true));
        rest = &after[end..];
    }
    bits.push((rest, false));
    bits.retain(|(t, _)| !t.is_empty());
    bits
}

/// The text for SVG.
pub(crate) fn markup(text: &str) -> Markup {
    let text = visible(text);
    let mut lowered = false;
    let bits: Vec<(&str, bool, Option<&str>)> = bits(&text)
        .into_iter()
        .map(|(bit, low)| {
            let step = (low != lowered).then_some(if low { "3" } else { "-3" });
            lowered = low;
            (bit, low, step)
        })
        .collect();
    html! {
        @for (bit, low, step) in bits { tspan class=[low.then_some("lowered")] dy=[step] { (bit) } }
    }
}

/// Its width [px].
pub(crate) fn width(text: &str) -> f64 {
    let one = |(t, low): (&str, bool)| t.chars().count() as f64 * if low { LOWERED } else { CHARACTER };
    SIZE * bits(text).into_iter().map(one).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_an_underscore_is_lowered_up_to_the_next_blank() {
        assert_eq!(bits("L_vr1 7.907"), [("L", false), ("vr1", true), (" 7.907", false)]);
        let svg = markup("L_vr1 <7>").into_string();
        let expected = "<tspan>L</tspan><tspan class=\"lowered\" dy=\"3\">vr1</tspan><tspan dy=\"-3\"> &lt;7&gt;</tspan>";
        assert_eq!(svg, expected);
        assert!(width("L_vr1") < width("Lvr1"));
    }
}
