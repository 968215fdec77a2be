//! The traits of the table of quantities, by the formulas of the same names.

use super::{Configuration, Generic, GenericState, store_matrix};
use planar_dynamics::error::Error;
use planar_dynamics::state::State;
use planar_dynamics::validate::{store, store_rows};
use planar_dynamics::{element, with_quantities};

macro_rules! functions {
    (
        functions { $($(#[$doc:meta])* trait $trait:ident {
            $($(#[$of_method:meta])* $quantity:ident $method:ident($inputs:ident) $kind:ident $extents:tt $unit:literal, $shown:expr;)*
        })* }
        results $results:tt
    ) => {
        $(impl planar_dynamics::dynamics::$trait<f64> for Generic {
            $(function!($method($inputs) $kind);)*
        })*
    };
}

macro_rules! function {
    ($method:ident(configuration) $kind:ident) => {
        fn $method(&self, base_pose: &[f64; 3], joint_angles: &[f64], into: &mut [element!($kind f64)]) -> Result<(), Error> {
            let result = Configuration::new(self, base_pose, joint_angles)?.$method();
            store!($kind $method result into)
        }
    };
    ($method:ident(state) $kind:ident) => {
        fn $method(&self, state: &State<'_, f64>, into: &mut [element!($kind f64)]) -> Result<(), Error> {
            let result = GenericState::new(self, state)?.$method();
            store!($kind $method result into)
        }
    };
}

macro_rules! store {
    (triples $method:ident $result:ident $into:ident) => {
        store_rows(stringify!($method), &$result, $into)
    };
    (matrix $method:ident $result:ident $into:ident) => {
        store_matrix(stringify!($method), &$result, $into)
    };
    (vector $method:ident $result:ident $into:ident) => {
        store(stringify!($method), $result.as_slice(), $into)
    };
}

with_quantities!(functions);
