//! Rigid captures of many instances, by the balance of momentum of each: exact for light and heavy targets, too.

use crate::chunks::chunk;
use crate::instance::Instance;
use planar_capture::dynamics::Robot as _;
use planar_capture::error::Error;
use planar_capture::evaluator::{Evaluator, GraphModel, Status};
use planar_capture::rigid_capture::rigid_capture;
use std::sync::Arc;
use std::thread;

/// The names of the inputs, in order.
pub const INPUTS: [&str; 8] = [
    "base_pose",
    "joint_angles",
    "base_twist",
    "joint_rates",
    "target_masses",
    "target_inertias",
    "contacts",
    "target_twists",
];

/// So many instances take several times as long as starting a thread.
const LEAST: usize = 64;

/// The same instances of two outputs.
type Pair<'a> = (&'a mut [f64], &'a mut [f64]);

/// Captures, of one robot or, with parameters, of robots of their own.
pub struct Captures<'a> {
    pub evaluator: &'a Arc<Evaluator>,
    pub model: &'a GraphModel,
    pub parameters: Option<&'a [f64]>,
    /// Those of [`INPUTS`].
    pub inputs: &'a [&'a [f64]],
    pub instances: usize,
    pub threads: Option<usize>,
}

/// Base twists, joint rates, twists of the targets and impulses of all instances; zeros where the status is not `Done`.
pub struct After {
    pub outputs: [Vec<f64>; 4],
    pub statuses: Vec<Status>,
}

impl Captures<'_> {
    /// The numbers of elements of the inputs.
    pub fn rows(model: &GraphModel) -> [usize; 8] {
        let (joints, arms) = (model.joints(), model.arms());
        [3, joints, 3, joints, arms, arms, 2 * arms, 3 * arms]
    }

    /// Computes all of them.
    pub fn run(&self) -> After {
        let (joints, arms) = (self.model.joints(), self.model.arms());
        let rows = [3, joints, 3 * arms, 3 * arms];
        let mut outputs = rows.map(|rows| vec![0.0; rows * self.instances]);
        let mut statuses = vec![Status::Done; self.instances];
        let chunk = chunk(self.instances, self.threads, LEAST);
        let [base, rates, twists, impulses] = &mut outputs;
        let parts = base.chunks_mut(chunk * rows[0]).zip(rates.chunks_mut(chunk * rows[1]));
        let of_arms = twists.chunks_mut(chunk * rows[2]).zip(impulses.chunks_mut(chunk * rows[3]));
        let parts = parts.zip(of_arms).zip(statuses.chunks_mut(chunk)).enumerate();
        let work = |(index, part): (usize, ((Pair<'_>, Pair<'_>), &mut [Status]))| {
            let (((base, rates), (twists, impulses)), statuses) = part;
            for (i, status) in statuses.iter_mut().enumerate() {
                let outputs = [&mut *base, &mut *rates, &mut *twists, &mut *impulses].into_iter().zip(rows);
                let outputs = outputs.map(|(all, rows)| &mut all[i * rows..][..rows]);
                *status = self.one(index * chunk + i, outputs);
            }
        };
        if chunk >= self.instances {
            parts.for_each(work);
        } else {
            thread::scope(|scope| {
                for part in parts {
                    scope.spawn(move || work(part));
                }
            });
        }
        After { outputs, statuses }
    }

    fn one<'o>(&self, index: usize, outputs: impl Iterator<Item = &'o mut [f64]>) -> Status {
        let rows = Self::rows(self.model);
        let inputs = self.inputs.iter().zip(rows).map(|(all, rows)| &all[index * rows..][..rows]);
        let instance = Instance::of(INPUTS.into_iter().zip(inputs), &[]);
        let own = self.parameters.map(|all| {
            let count = self.evaluator.parameters().len();
            all[index * count..][..count].to_vec()
        });
        if own.iter().flatten().any(|number| !number.is_finite()) {
            return Status::NotFinite;
        }
        let own = own.and_then(|parameters| self.evaluator.model_with(parameters));
        let model = own.as_ref().unwrap_or(self.model);
        match rigid_capture(model, &instance.state(), &instance.targets()) {
            Ok(after) => {
                let found: [&[f64]; 4] = [
                    &after.base_twist,
                    &after.joint_rates,
                    after.target_twists.as_flattened(),
                    after.impulses.as_flattened(),
                ];
                if !found.iter().all(|numbers| numbers.iter().all(|number| number.is_finite())) {
                    return Status::NotFinite;
                }
                outputs.zip(found).for_each(|(to, from)| to.copy_from_slice(from));
                Status::Done
            }
            Err(Error::NotFinite { .. }) => Status::NotFinite,
            Err(_) => Status::Singular,
        }
    }
}
