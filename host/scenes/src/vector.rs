//! Vectors in `f64`; sums are taken in order, so that they are the same on every machine.

/// The scalar product.
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]
}

/// The vector product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// `a` without `b`.
pub fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The normal of a triangle, twice its area long.
pub fn normal(p: [[f32; 3]; 3]) -> [f64; 3] {
    let [a, b, c] = p.map(|vertex| vertex.map(f64::from));
    cross(sub(b, a), sub(c, a))
}
