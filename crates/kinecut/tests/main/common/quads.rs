//! Bodies of plane quadrilaterals as STL files.

/// A quadrilateral, its corners counter-clockwise seen from outside.
pub(crate) type Quad = [[f64; 3]; 4];

/// The four corners of an upright rectangle about the Z axis at a height, by half of its sides, counter-clockwise from the lower left.
pub(crate) fn ring(half: [f64; 2], z: f64) -> Quad {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        .map(|s: [f64; 2]| [s[0] * half[0], s[1] * half[1], z])
}

/// The sides between two rings of corners, the first one below if they look outwards.
pub(crate) fn sides(low: Quad, high: Quad) -> [Quad; 4] {
    std::array::from_fn(|i| {
        let j = (i + 1) % 4;
        [low[i], low[j], high[j], high[i]]
    })
}

/// A ring of corners the other way round.
pub(crate) fn turned(ring: Quad) -> Quad {
    [ring[3], ring[2], ring[1], ring[0]]
}

/// An STL file in text.
pub(crate) fn stl(quads: &[Quad]) -> Vec<u8> {
    let mut text = "solid body\n".to_owned();
    for [a, b, c, d] in quads {
        for triangle in [[a, b, c], [a, c, d]] {
            text += "facet normal 0 0 0\nouter loop\n";
            for [x, y, z] in triangle {
                text += &format!("vertex {x} {y} {z}\n");
            }
            text += "endloop\nendfacet\n";
        }
    }
    (text + "endsolid body\n").into_bytes()
}
