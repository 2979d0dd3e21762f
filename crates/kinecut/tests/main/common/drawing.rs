//! Drawings as bytes of their files.

/// A DXF file in millimetres with these entities: groups, set apart by white space.
pub(crate) fn dxf(entities: &str) -> Vec<u8> {
    let groups: Vec<&str> = entities.split_whitespace().collect();
    let body = groups.join("\n");
    format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{body}\n0\nENDSEC\n0\nEOF\n").into()
}
