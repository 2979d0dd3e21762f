//! Unknown keys and words of a file, and the nearest known one.

use std::borrow::Cow;

/// Least likeness of a wrong name to the one that was meant.
const NEAR: f64 = 0.75;

/// Whether a wrong name is most likely that of a known key.
pub(super) fn is_near(unknown: &str, known: &str) -> bool {
    strsim::jaro_winkler(unknown, known) > NEAR
}

/// "did you mean" for a message of the form "unknown field `x`, expected one of `a`, `b`".
pub(crate) fn nearest(message: &str) -> Option<String> {
    let mut words = message.split('`').skip(1).step_by(2);
    let unknown = message.starts_with("unknown ").then(|| words.next()).flatten()?;
    let best =
        words.max_by(|a, b| strsim::jaro_winkler(unknown, a).total_cmp(&strsim::jaro_winkler(unknown, b)))?;
    is_near(unknown, best).then(|| format!("did you mean `{best}`?"))
}

/// A message of TOML in the words of serde: an unknown key of a variant's table has its own there.
pub(super) fn in_serde_words(message: &str) -> Cow<'_, str> {
    let keys = message.strip_prefix("unexpected keys in table: ");
    let Some((unknown, known)) = keys.and_then(|k| k.split_once(", available keys: ")) else {
        return Cow::Borrowed(message);
    };
    let unknown = unknown.split(", ").next().unwrap_or(unknown);
    Cow::Owned(unknown_field(unknown, &known.split(", ").collect::<Vec<_>>()))
}

/// A key that is not known, as serde says it.
pub(super) fn unknown_field(unknown: &str, known: &[&str]) -> String {
    let known: Vec<String> = known.iter().map(|key| format!("`{key}`")).collect();
    let expected = match &known[..] {
        [one] => one.clone(),
        [one, other] => format!("{one} or {other}"),
        all => format!("one of {}", all.join(", ")),
    };
    format!("unknown field `{unknown}`, expected {expected}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::DrillPoint;
    use std::collections::BTreeMap;

    #[test]
    fn a_wrong_key_of_a_variant_is_told_as_that_of_any_table() {
        let told = |text: &str| {
            let error = toml::from_str::<BTreeMap<String, DrillPoint>>(text).unwrap_err();
            in_serde_words(error.message()).into_owned()
        };
        let twist = told("point = { twist = { point_angel = 118 } }");
        assert_eq!(twist, "unknown field `point_angel`, expected `point_angle`");
        assert_eq!(nearest(&twist).unwrap(), "did you mean `point_angle`?");
        let cone = told("point = { cone = { angle = 90, nose = 1 } }");
        assert_eq!(cone, "unknown field `angle`, expected `cone_angle` or `nose_diameter`");
        let gun = told("point = { gun = { outer = 60 } }");
        assert_eq!(gun, "unknown field `outer`, expected one of `apex`, `outer_angle`, `inner_angle`");
        assert_eq!(in_serde_words("missing field `tool`"), "missing field `tool`");
    }
}
