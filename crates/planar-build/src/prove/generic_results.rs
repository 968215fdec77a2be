//! Every quantity at one state by the generic implementation, with what its rounding may be.

use crate::prove::evaluation::{EvaluationInput, evaluate_all};
use crate::prove::generic::Generic;
use crate::prove::quantities::{NaturalSize, natural_sizes};
use crate::prove::sampling::RegimeSample;
use planar_dynamics::error::Error;
use planar_dynamics::quantity::{Quantity, Rounding};
use planar_layout::layout::Layout;
use std::collections::HashMap;

/// Rounding units that a result computed by sums and products may be off, in natural sizes.
const ROUNDINGS: f64 = 64.0;

/// The results of one quantity.
#[derive(Clone)]
pub struct Expected {
    pub values: Vec<f64>,
    /// How many rounding units each may be off.
    pub sizes: Vec<f64>,
    /// The same in natural sizes.
    pub roundings: f64,
}

pub type Results = HashMap<Quantity, Expected>;

/// Every quantity at one state by the generic implementation.
pub fn results(layout: &Layout, instant: &EvaluationInput) -> Result<Results, Error> {
    let sample = RegimeSample { layout: layout.clone(), instant: instant.clone() };
    let values = evaluate_all(&Generic::new(layout), instant)?;
    let sizes = natural_sizes(&sample, &values).into_iter();
    let each = sizes.filter_map(|(quantity, NaturalSize { sizes, condition })| {
        let roundings = match quantity.row().rounding {
            Rounding::Polynomial => ROUNDINGS,
            Rounding::Solved => ROUNDINGS.max(8.0 * condition),
        };
        let (values, sizes) = (values.get(quantity)?.to_vec(), sizes.iter().map(|size| size * roundings).collect());
        Some((quantity, Expected { values, sizes, roundings }))
    });
    Ok(each.collect())
}
