//! A value of another type than its key takes, in plain words.

/// A message of serde about a value of the wrong type in plain words, with what to write instead; `None` for other messages.
pub(super) fn wrong_type(message: &str) -> Option<(String, String)> {
    let rest = message.strip_prefix("invalid type: ").or_else(|| message.strip_prefix("invalid value: "))?;
    let (given, wanted) = rest.split_once(", expected ")?;
    if given == "unit variant" && wanted == "newtype variant" {
        let help = "write it as a table: { name = value }".to_owned();
        return Some(("the name alone says too little here: it needs a value".to_owned(), help));
    }
    let wanted = match wanted {
        "f64" | "f32" => "a number",
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number from 0",
        "i8" | "i16" | "i32" | "i64" => "a whole number",
        "a string" => "a text",
        "a boolean" => "true or false",
        "a sequence" => "a list",
        _ => return None,
    };
    let (kind, value) = given.split_once(' ').unwrap_or((given, ""));
    let value = value.trim_start_matches("point ").trim_matches(['`', '"']);
    let given = match kind {
        "string" => format!("the text \"{value}\""),
        "integer" | "floating" | "boolean" => value.to_owned(),
        "map" => "a table".to_owned(),
        "sequence" => "a list".to_owned(),
        _ => return None,
    };
    let help = match (kind, wanted) {
        ("string", "a number" | "a whole number" | "a whole number from 0")
            if value.parse::<f64>().is_ok() =>
        {
            format!("write it without quotes: {value}")
        }
        ("integer" | "floating" | "boolean", "a text") => format!("put it in quotes: \"{value}\""),
        ("integer" | "floating" | "string", "a list") => "put it in square brackets".to_owned(),
        _ => String::new(),
    };
    Some((format!("{wanted} belongs here, not {given}"), help))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn told<T: serde::de::DeserializeOwned>(text: &str) -> (String, String) {
        let error = toml::from_str::<BTreeMap<String, T>>(text).map(|_| ()).unwrap_err();
        wrong_type(error.message()).unwrap_or_else(|| panic!("{}", error.message()))
    }

    #[test]
    fn each_type_has_its_words() {
        let text = |a: &str, b: &str| (a.to_owned(), b.to_owned());
        assert_eq!(
            told::<f64>("d = \"40\""),
            text("a number belongs here, not the text \"40\"", "write it without quotes: 40")
        );
        assert_eq!(told::<f64>("d = \"4O mm\""), text("a number belongs here, not the text \"4O mm\"", ""));
        assert_eq!(told::<f64>("d = { mm = 4 }"), text("a number belongs here, not a table", ""));
        assert_eq!(told::<u32>("d = 1.5"), text("a whole number from 0 belongs here, not 1.5", ""));
        assert_eq!(told::<u32>("d = -3"), text("a whole number from 0 belongs here, not -3", ""));
        assert_eq!(told::<String>("d = 5"), text("a text belongs here, not 5", "put it in quotes: \"5\""));
        assert_eq!(told::<bool>("d = 1"), text("true or false belongs here, not 1", ""));
        assert_eq!(
            told::<Vec<f64>>("d = 1.0"),
            text("a list belongs here, not 1.0", "put it in square brackets")
        );
        assert!(wrong_type("missing field `tool`").is_none());
        let rows = told::<crate::facing::PassesChoice>("d = \"rows\"");
        assert_eq!(rows.1, "write it as a table: { name = value }");
    }
}
