//! Generated code in `f32`: against the generic implementation in `f64`, and along an approach.

mod approach;
mod equivalence;

use planar_capture::layout::Layout;
use planar_capture::owned::CloneModel;
use planar_capture::structure::{Structure, parameters};
use planar_proof::for_every_layout;

/// The generated model of a layout's structure in `f32`, with the layout's numbers.
type Single = fn(&Layout) -> Box<dyn CloneModel<f32>>;

macro_rules! models {
    ($($name:ident)*) => {
        /// That of every shipped layout, with its name.
        const MODELS: &[(&str, Single)] = &[$((stringify!($name), |layout| {
            use planar_capture::generated::$name::{MANIFEST, Model, Parameters};
            let values = parameters(&Structure::from(&MANIFEST), layout).expect("its structure");
            #[allow(clippy::cast_possible_truncation, reason = "that is the test")]
            let values: Vec<f32> = values.into_iter().map(|x| x as f32).collect();
            Box::new(Model::new(Parameters::from_array(values.try_into().expect("as many"))))
        })),*];
    };
}
for_every_layout!(models);
