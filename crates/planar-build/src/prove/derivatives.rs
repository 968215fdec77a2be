//! Derivatives by dual numbers through the functions of a graph: the reference for those that the graph computes.

use crate::format::{Derivative, FunctionResult, Given, Graph, PIVOT, ReferenceState, Variable};
use crate::prove::interpreter::{Arguments, interpret_some};
use crate::prove::vectors::Reference;
use planar_dynamics::scalar::Dual;

/// Rounding units that a derivative may be off, in those of the function: a solution enters another system of equations.
const FACTOR: f64 = 4.0;

/// The reference with the graph's derivatives among the expected results, and with a direction in its inputs.
///
/// # Errors
/// What the graph lacks.
pub fn with_derivatives(graph: &Graph, reference: Reference, direction: &[Given]) -> Result<ReferenceState, String> {
    let Reference { mut state, roundings } = reference;
    let directions = graph.inputs.iter().filter_map(|input| {
        let of = input.name.strip_suffix("_direction")?;
        Some(Given {
            name: input.name.clone(),
            values: values_of(direction, of).unwrap_or_else(|| of_parameters(&state.parameters)),
        })
    });
    state.inputs.extend(directions);
    let mut derived = Vec::new();
    for function in graph.functions() {
        for output in &function.outputs {
            if let Some(derivative) = output.derivative.as_ref().filter(|_| output.name != PIVOT) {
                let point = Point { graph, state: &state, roundings: &roundings, derivative };
                let rows = point.rows()?;
                let [values, sizes] = point.expected(output, &rows)?;
                derived.push(FunctionResult {
                    function: function.name.clone(),
                    output: output.name.clone(),
                    values,
                    sizes,
                });
            }
        }
    }
    state.expected.extend(derived);
    Ok(state)
}

fn values_of(given: &[Given], name: &str) -> Option<Vec<f64>> {
    given.iter().find(|given| given.name == name).map(|given| given.values.clone())
}

/// The direction in the parameters: every one changes, by about half of it.
fn of_parameters(parameters: &[f64]) -> Vec<f64> {
    let change = |(i, p): (usize, f64)| if i % 2 == 0 { 0.5 * p + 0.125 } else { 0.125 - 0.5 * p };
    parameters.iter().copied().enumerate().map(change).collect()
}

/// A derivative at a state.
struct Point<'a> {
    graph: &'a Graph,
    state: &'a ReferenceState,
    roundings: &'a [f64],
    derivative: &'a Derivative,
}

impl Point<'_> {
    /// Values of the output, and how many rounding units each may be off.
    ///
    /// An entry's natural size is that of its row, the result that is derived, times the largest entry of all columns of
    /// the same input in units of their rows; the largest entry itself for a row that has no size, as momenta at rest.
    fn expected(&self, output: &Variable, rows: &[Row]) -> Result<[Vec<f64>; 2], String> {
        let Derivative { by, along, .. } = self.derivative;
        if by.is_empty() && along.is_empty() {
            return Ok([rows.iter().map(|row| row.value).collect(), rows.iter().map(|row| row.size).collect()]);
        }
        let mut values = vec![0.0; output.elements.len()];
        let mut sizes = vec![0.0; output.elements.len()];
        let columns = output.elements.len() / rows.len().max(1);
        let mut first = 0;
        for input in by {
            let count = self.given(input)?.len();
            let block = (0..count).map(|i| self.column(&|name, k| if name == input && k == i { 1.0 } else { 0.0 }));
            let block = block.collect::<Result<Vec<_>, _>>()?;
            let largest = Largest::of(&block, rows);
            for (i, column) in block.iter().enumerate() {
                for (j, (value, row)) in column.iter().zip(rows).enumerate() {
                    let place = j * columns + first + i;
                    let (Some(into), Some(size)) = (values.get_mut(place), sizes.get_mut(place)) else {
                        return Err(format!("`{}` has fewer columns than it is derived by", output.name));
                    };
                    (*into, *size) = (*value, FACTOR * largest.size(row));
                }
            }
            first += count;
        }
        for input in along {
            let direction = self.given(&format!("{input}_direction"))?;
            let part =
                self.column(&|name, k| if name == input { direction.get(k).copied().unwrap_or(0.0) } else { 0.0 })?;
            let largest = Largest::of(std::slice::from_ref(&part), rows);
            for ((into, size), (value, row)) in values.iter_mut().zip(&mut sizes).zip(part.iter().zip(rows)) {
                *into += value;
                *size += FACTOR * largest.size(row);
            }
        }
        Ok([values, sizes])
    }

    /// The results that are derived.
    fn rows(&self) -> Result<Vec<Row>, String> {
        let Derivative { function, outputs, .. } = self.derivative;
        let mut rows = Vec::new();
        for output in outputs {
            let known = self.state.expected.iter().zip(self.roundings);
            let found = known.into_iter().find(|(e, _)| e.function == *function && e.output == *output);
            let (expected, roundings) =
                found.ok_or_else(|| format!("there is nothing to compare `{output}` of `{function}` with"))?;
            let row = |(value, size): (&f64, &f64)| Row { value: *value, size: *size, roundings: *roundings };
            rows.extend(expected.values.iter().zip(&expected.sizes).map(row));
        }
        Ok(rows)
    }

    fn given(&self, input: &str) -> Result<&[f64], String> {
        let found = self.state.inputs.iter().find(|given| given.name == input);
        found.map(|given| given.values.as_slice()).ok_or_else(|| format!("input `{input}` has no value"))
    }

    /// Derivatives of the results along a direction.
    fn column(&self, direction: &dyn Fn(&str, usize) -> f64) -> Result<Vec<f64>, String> {
        let Derivative { function, outputs, .. } = self.derivative;
        let dual = |name: &str, i: usize, value: f64| Dual(value, direction(name, i));
        let found = interpret_some(self.graph, Arguments::of(self.state), &dual, &|other| other.name == *function)?;
        let results = outputs.iter().filter_map(|output| found.iter().find(|found| found.output == *output));
        Ok(results.flat_map(|result| result.values.iter().map(|value| value.1)).collect())
    }
}

/// One number that is derived.
struct Row {
    value: f64,
    /// Rounding units that it may be off, in all and in natural sizes.
    size: f64,
    roundings: f64,
}

/// The largest entry of some columns.
struct Largest {
    /// In natural sizes of its row, 1 at least.
    scaled: f64,
    entry: f64,
}

impl Largest {
    fn of(columns: &[Vec<f64>], rows: &[Row]) -> Self {
        let entries = || columns.iter().flat_map(|column| column.iter().zip(rows));
        let scaled =
            entries().filter(|(_, row)| row.size > 0.0).map(|(value, row)| value.abs() * row.roundings / row.size);
        let (scaled, entry) =
            (scaled.fold(1.0, f64::max), entries().fold(0.0, |most: f64, (value, _)| most.max(value.abs())));
        Self { scaled, entry }
    }

    /// Rounding units that an entry of a row may be off.
    fn size(&self, row: &Row) -> f64 {
        if row.size > 0.0 { row.size * self.scaled } else { row.roundings * self.entry }
    }
}
