//! Bound on the length of a template's texts, computed before it is run.
//!
//! The engine bounds the steps of a template, but a step may double a text. What is bound to a name (`set`, `for`, `with`) is
//! followed in the order of the tags: a text is at most as long as all names and literals of its tag together, times the
//! whole numbers it is multiplied by. What could bind more than once (macros, recursive loops, captured blocks) is refused.

use std::collections::BTreeSet;

/// Filters that make texts of any length, or that nobody needs for blocks.
pub(super) const WITHOUT_FILTERS: &[&str] = &[
    "batch",
    "chain",
    "dictsort",
    "escape",
    "e",
    "format",
    "groupby",
    "indent",
    "json",
    "pprint",
    "replace",
    "safe",
    "slice",
    "tojson",
    "urlencode",
    "zip",
];
/// Functions that hold more than one value or show all.
pub(super) const WITHOUT_FUNCTIONS: &[&str] = &["debug", "dict", "namespace"];

/// Tags that a template cannot have, each with the text to write instead.
const REFUSED: &[&str] = &[
    "macro",
    "call",
    "filter",
    "import",
    "include",
    "extends",
    "autoescape",
    "do",
    "recursive",
    "block",
    "from",
];

/// Words of expressions that are no values.
const WORDS: &[&str] = &[
    "set", "for", "in", "if", "elif", "else", "endif", "endfor", "with", "endwith", "and", "or", "not", "is",
    "true", "false", "none", "loop", "range", "endset", "raw", "endraw", "break", "continue",
];

enum Token<'t> {
    Name(&'t str),
    Text(&'t str),
    Number(f64),
    Sign(char),
}

/// The length that no text of the template can exceed [bytes], where no name of its context is longer than `longest`; or what
/// the template cannot have.
pub(super) fn longest(template: &str, longest: usize) -> Result<f64, String> {
    let mut bound: BTreeSet<&str> = BTreeSet::new();
    let mut most = longest as f64;
    let mut largest = most;
    for (statement, tag) in tags(template) {
        let tokens = tokens(tag);
        let first = tokens.iter().find_map(|t| if let Token::Name(n) = t { Some(*n) } else { None });
        let keyword = if statement { first.unwrap_or("") } else { "" };
        if let Some(word) = tokens.iter().find_map(|t| match t {
            Token::Name(n) if statement && REFUSED.contains(n) => Some(*n),
            _ => None,
        }) {
            return Err(format!("`{word}` is not taken"));
        }
        if keyword == "set" && !tokens.iter().any(|t| matches!(t, Token::Sign('='))) {
            return Err("a block is not taken as the value of `set`".to_owned());
        }
        let mut size = 0.0;
        for (i, token) in tokens.iter().enumerate() {
            let after = i.checked_sub(1).map(|i| &tokens[i]);
            match token {
                // An attribute or a filter is no value of its own.
                Token::Name(_) if matches!(after, Some(Token::Sign('.' | '|'))) => {}
                Token::Name(name) if WORDS.contains(name) => {}
                Token::Name(name) => size += if bound.contains(name) { most } else { longest as f64 },
                Token::Text(text) => size += text.len() as f64,
                Token::Number(_) | Token::Sign(_) => size += 32.0,
            }
        }
        for (i, _) in tokens.iter().enumerate().filter(|(_, t)| matches!(t, Token::Sign('*'))) {
            let beside = [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter_map(|i| tokens.get(i));
            let factor = beside.filter_map(|t| if let Token::Number(n) = t { Some(*n) } else { None }).next();
            match factor {
                Some(n) => size *= n.max(1.0),
                None => return Err("a product needs a number beside its `*`".to_owned()),
            }
        }
        // A list is joined with its joiner between all of its elements.
        for (i, _) in tokens.iter().enumerate().filter(|(_, t)| matches!(t, Token::Name("join"))) {
            size *= match (tokens.get(i + 1), tokens.get(i + 2), tokens.get(i + 3)) {
                (Some(Token::Sign('(')), Some(Token::Text(joiner)), Some(Token::Sign(')'))) => {
                    2.0 + joiner.len() as f64
                }
                (Some(Token::Sign('(')), ..) => 2.0 + size,
                _ => 2.0,
            };
        }
        largest = f64::max(largest, size);
        if matches!(keyword, "set" | "for" | "with") {
            most = most.max(size);
            bound.extend(tokens.iter().filter_map(|t| if let Token::Name(n) = t { Some(*n) } else { None }));
        }
    }
    Ok(largest)
}

/// The tags of a template, each with whether it is a statement.
fn tags(template: &str) -> Vec<(bool, &str)> {
    let mut tags = Vec::new();
    let mut rest = template;
    while let Some(at) = rest.find('{') {
        rest = &rest[at + 1..];
        let statement = match rest.chars().next() {
            Some('%') => true,
            Some('{') => false,
            Some('#') => {
                rest = rest.find("#}").map_or("", |end| &rest[end + 2..]);
                continue;
            }
            _ => continue,
        };
        rest = &rest[1..];
        let end = end_of_tag(rest, if statement { "%}" } else { "}}" });
        tags.push((statement, &rest[..end]));
        rest = &rest[end..];
    }
    tags
}

/// End of a tag: its closing mark outside of texts.
fn end_of_tag(text: &str, mark: &str) -> usize {
    let mut quote = None;
    let mut escaped = false;
    for (i, c) in text.char_indices() {
        match quote {
            Some(_) if escaped => escaped = false,
            Some(_) if c == '\\' => escaped = true,
            Some(q) if c == q => quote = None,
            Some(_) => {}
            None if c == '"' || c == '\'' => quote = Some(c),
            None if text[i..].starts_with(mark) => return i,
            None => {}
        }
    }
    text.len()
}

fn tokens(tag: &str) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let mut rest = tag;
    while let Some(c) = rest.chars().next() {
        let is_name = |c: char| c.is_alphanumeric() || c == '_';
        let length = match c {
            '"' | '\'' => {
                let body = &rest[1..];
                let end = end_of_tag(body, &rest[..1]).min(closing(body, c));
                tokens.push(Token::Text(&body[..end]));
                (end + 2).min(rest.len())
            }
            c if c.is_ascii_digit() => {
                let end = rest.find(|c: char| !(is_name(c) || c == '.')).unwrap_or(rest.len());
                // A number in another notation counts as infinite.
                tokens.push(Token::Number(rest[..end].replace('_', "").parse().unwrap_or(f64::INFINITY)));
                end
            }
            c if is_name(c) => {
                let end = rest.find(|c: char| !is_name(c)).unwrap_or(rest.len());
                tokens.push(Token::Name(&rest[..end]));
                end
            }
            c => {
                if !c.is_whitespace() {
                    tokens.push(Token::Sign(c));
                }
                c.len_utf8()
            }
        };
        rest = &rest[length..];
    }
    tokens
}

/// End of a text.
fn closing(body: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in body.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            c if c == quote => return i,
            _ => {}
        }
    }
    body.len()
}

#[cfg(test)]
mod tests {
    use super::longest;

    #[test]
    fn doubling_is_seen_before_it_is_done() {
        let doubling = format!(
            "{{% set a = \"{}\" %}}{}{{{{ a }}}}",
            "a".repeat(16),
            "{% set a = a ~ a ~ a ~ a ~ a ~ a ~ a ~ a %}".repeat(9)
        );
        assert!(longest(&doubling, 100).unwrap() > 1e9);
        assert!(longest("{{ 'x' * 100000000 }}", 10).unwrap() > 1e8);
        assert!(longest("{% set a = program_name + program_name %}{{ a }}", 10).unwrap() < 1000.0);
        // The same, hidden: in loops, after a closing mark in a text, by lists.
        let loops = "{% for a in [a ~ a ~ a ~ a] %}".repeat(12);
        assert!(longest(&format!("{{% set a = '%}}' %}}{loops}{{{{ a }}}}"), 10).unwrap() > 1e7);
        assert!(longest(&"{%- set a = [a, a, a, a] -%}".repeat(14), 10).unwrap() > 1e7);
        assert!(longest("{% set a = 'x' * 1000 %}{{ range(9999)|join(a) }}", 100).unwrap() > 1e6);
        for refused in [
            "{% macro m(a) %}{{ m(a ~ a) }}{% endmacro %}",
            "{% for a in b recursive %}{{ loop(a) }}{% endfor %}",
            "{% set a %}{{ b }}{% endset %}",
            "{% filter upper %}x{% endfilter %}",
            "{{ a * b }}",
        ] {
            assert!(longest(refused, 10).is_err(), "{refused}");
        }
    }

    #[test]
    fn a_template_of_a_shop_is_short() {
        let shop = "( {{ program_name }} in {{ units }} {# 100 * 100 #} )\n{% set n = 0 %}{% for t in tools if t.number > 1 %}\
                    {% set n = n + 10 %}N{{ n }} (T{{ t.number }} D{{ t.diameter * 0.5 }} {{ t.name|upper }})\n{% endfor %}\
                    {{ offsets|join(' ') }} {% if offset == 'G54' %}G54{% else %}{{ offset }}{% endif %}";
        assert!(longest(shop, 500).unwrap() < 10_000.0);
    }
}
