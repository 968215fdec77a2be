//! Encoders of the joints.

use planar_capture::control::Estimator;
use planar_capture::dynamics::AnyModel;
use planar_capture::error::Error;
use planar_capture::state::State;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::collections::VecDeque;

/// What the encoders are.
#[derive(Clone, Copy, Debug)]
pub struct Encoders {
    /// An angle is off by up to half of this, rad.
    pub resolution: f64,
    /// By how many samples the angles are late.
    pub delay: usize,
    /// What the errors follow from: the same in every run.
    pub seed: u64,
}

/// Joint angles by encoders, joint rates by their filtered differences. Of the base nothing is measured: it is taken to be
/// at rest in the origin.
#[derive(Debug)]
pub struct Measured {
    encoders: Encoders,
    /// Time constant of the filter of the rates, s.
    filter_time: f64,
    errors: ChaCha8Rng,
    /// Those on their way, the latest last.
    pending: VecDeque<Vec<f64>>,
    angles: Vec<f64>,
    rates: Vec<f64>,
    /// Of the last sample, s.
    time: Option<f64>,
}

impl Measured {
    /// Before the first sample.
    pub fn new(encoders: Encoders, filter_time: f64) -> Self {
        Self {
            encoders,
            filter_time,
            errors: ChaCha8Rng::seed_from_u64(encoders.seed),
            pending: VecDeque::new(),
            angles: Vec::new(),
            rates: Vec::new(),
            time: None,
        }
    }
}

impl Estimator<f64, AnyModel<f64>> for Measured {
    fn estimate(&mut self, time: f64, _: &AnyModel<f64>, state: &State<'_, f64>) -> Result<State<'_, f64>, Error> {
        let mut read = |angle: &f64| angle + self.encoders.resolution * (self.errors.random::<f64>() - 0.5);
        self.pending.push_back(state.joint_angles.iter().map(&mut read).collect());
        // before the start the joints were where they are first
        let late = if self.pending.len() > self.encoders.delay { self.pending.pop_front() } else { None };
        let angles = late.or_else(|| self.pending.front().cloned()).unwrap_or_default();
        match self.time {
            None => self.rates = vec![0.0; angles.len()],
            Some(last) => {
                let step = time - last;
                let weight = step / (step + self.filter_time);
                for (rate, (new, old)) in self.rates.iter_mut().zip(angles.iter().zip(&self.angles)) {
                    *rate += weight * ((new - old) / step - *rate);
                }
            }
        }
        (self.angles, self.time) = (angles, Some(time));
        Ok(State { base_pose: [0.0; 3], base_twist: [0.0; 3], joint_angles: &self.angles, joint_rates: &self.rates })
    }
}
