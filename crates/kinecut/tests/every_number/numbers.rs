//! Every number of a document, and every number that its schema would let stand in it.

use serde_json::{Map, Value};

/// Where a number stands or could stand: keys and indices from the root.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Step {
    Key(String),
    Index(usize),
}

/// The places of all numbers of a document, then those of the optional properties that are numbers by its schema.
pub(crate) fn places(schema: &Value, document: &Value) -> Vec<Vec<Step>> {
    let mut places = Vec::new();
    walk(schema, &[schema], document, &mut Vec::new(), &mut places);
    places
}

/// The document with this at a place.
pub(crate) fn with(document: &Value, place: &[Step], value: &Value) -> Value {
    let mut changed = document.clone();
    let mut at = &mut changed;
    for step in place {
        at = match step {
            Step::Key(key) => {
                at.as_object_mut().unwrap().entry(key.clone()).or_insert(Value::Object(Map::new()))
            }
            Step::Index(i) => &mut at.as_array_mut().unwrap()[*i],
        };
    }
    *at = value.clone();
    changed
}

fn walk(root: &Value, nodes: &[&Value], document: &Value, at: &mut Vec<Step>, places: &mut Vec<Vec<Step>>) {
    let mut branches = Vec::new();
    nodes.iter().for_each(|node| flatten(root, node, document, &mut branches));
    match document {
        Value::Number(_) => places.push(at.clone()),
        Value::Array(items) => {
            let of: Vec<&Value> = branches.iter().filter_map(|b| b.get("items")).collect();
            for (i, item) in items.iter().enumerate() {
                at.push(Step::Index(i));
                walk(root, &of, item, at, places);
                at.pop();
            }
        }
        Value::Object(map) => {
            for (key, value) in map {
                let of: Vec<&Value> = branches
                    .iter()
                    .filter_map(|b| {
                        b.get("properties").and_then(|p| p.get(key)).or(b.get("additionalProperties"))
                    })
                    .collect();
                at.push(Step::Key(key.clone()));
                walk(root, &of, value, at, places);
                at.pop();
            }
            for branch in &branches {
                let Some(properties) = branch.get("properties").and_then(Value::as_object) else { continue };
                for (key, property) in properties.iter().filter(|(key, _)| !map.contains_key(*key)) {
                    let place = [at.as_slice(), &[Step::Key(key.clone())]].concat();
                    if is_number(root, property) && !places.contains(&place) {
                        places.push(place);
                    }
                }
            }
        }
        _ => {}
    }
}

/// The schemas that may speak of a document: those behind references and alternatives, but for alternatives of another type.
fn flatten<'s>(root: &'s Value, node: &'s Value, document: &Value, out: &mut Vec<&'s Value>) {
    if let Some(target) = node.get("$ref").and_then(Value::as_str) {
        flatten(root, root.pointer(&target[1..]).unwrap(), document, out);
    }
    let types = node.get("properties").and_then(|p| p.get("type")).and_then(|t| t.get("const"));
    if types.is_some_and(|t| document.get("type").is_some_and(|d| d != t)) {
        return;
    }
    out.push(node);
    for name in ["anyOf", "oneOf", "allOf"] {
        for one in node.get(name).and_then(Value::as_array).into_iter().flatten() {
            flatten(root, one, document, out);
        }
    }
}

fn is_number(root: &Value, node: &Value) -> bool {
    let mut branches = Vec::new();
    flatten(root, node, &Value::Null, &mut branches);
    let says = |t: &Value| {
        let number = |v: &Value| matches!(v.as_str(), Some("number" | "integer"));
        number(t) || t.as_array().is_some_and(|all| all.iter().any(number))
    };
    branches.iter().any(|b| b.get("type").is_some_and(says))
}
