//! Lagrange's polynomials through nodes of a step, integrated from its end on.

/// Number of nodes.
pub(super) const NODES: usize = 5;

/// Weights of the ẋ at nodes of a step for the second to the fifth power of time from the end of the step, in lengths of it:
/// those of Lagrange's polynomials, integrated.
pub(super) fn integrated_weights(nodes: &[f64; NODES]) -> [[f64; NODES]; 4] {
    let lagrange: [[f64; NODES]; NODES] = std::array::from_fn(|of| {
        // in powers of the time from the end
        let mut factors = [1.0, 0.0, 0.0, 0.0, 0.0];
        for (_, other) in nodes.iter().enumerate().filter(|(i, _)| *i != of) {
            let mut product = [0.0; NODES];
            for (i, factor) in factors.iter().enumerate() {
                product[i] += factor * (1.0 - other) / (nodes[of] - other);
                if let Some(next) = product.get_mut(i + 1) {
                    *next += factor / (nodes[of] - other);
                }
            }
            factors = product;
        }
        factors
    });
    [(1, 2.0), (2, 3.0), (3, 4.0), (4, 5.0)]
        .map(|(power, integrated)| lagrange.map(|factors| factors[power] / integrated))
}
