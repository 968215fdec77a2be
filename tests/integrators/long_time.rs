//! Energy and momentum of free motion over a thousand seconds.

use crate::Problem;
use crate::method::{Fineness, Method};
use crate::motion::Problems;
use planar_capture::dynamics::AnyModel;
use planar_capture::error::Error;
use planar_capture::owned::RobotState;
use planar_capture::simulate::stepper::{Formulation, Integration, Integrator};
use planar_capture::simulate::{Phase, Sample};

/// s.
pub const DURATION: f64 = 1000.0;
/// Time between samples, s.
const SAMPLE: f64 = 0.5;

/// One run.
pub struct Run {
    pub method: Method,
    pub fineness: Fineness,
    pub evaluations: u64,
    /// (time, error), relative.
    pub energy: Vec<(f64, f64)>,
    /// (time, error): the larger of linear and angular, relative to the bodies' momenta at the start.
    pub momentum: Vec<(f64, f64)>,
}

impl Run {
    /// The largest energy error up to a time.
    pub fn energy_until(&self, time: f64) -> f64 {
        largest(&self.energy, time)
    }

    /// The largest momentum error up to a time.
    pub fn momentum_until(&self, time: f64) -> f64 {
        largest(&self.momentum, time)
    }
}

fn largest(series: &[(f64, f64)], until: f64) -> f64 {
    series.iter().filter(|(time, _)| *time <= until).fold(0.0, |most, (_, error)| most.max(*error))
}

/// The runs of one motion.
pub struct LongTime {
    /// In a title.
    pub title: &'static str,
    pub runs: Vec<Run>,
}

/// A regular motion and a chaotic one.
pub fn motions() -> Result<[LongTime; 2], Problem> {
    Ok([
        LongTime { title: "Turning with the arms out", runs: runs(&Problems::turning(), [0.5, 0.25], [0.1, 0.05])? },
        LongTime { title: "Tumbling", runs: runs(&Problems::tumbling(), [0.1, 0.05], [0.02, 0.005])? },
    ])
}

/// The methods, with these steps of Gauss–Legendre and Runge–Kutta, s.
fn methods(gauss: [f64; 2], runge_kutta: [f64; 2]) -> Vec<(Method, Fineness)> {
    let method = |integrator, coordinates| Method { integration: Integration { integrator, coordinates } };
    let adaptive = Integrator::Adaptive { tolerance: 0.0 };
    let (full, reduced) = (Formulation::Full, Formulation::Reduced);
    let mut all = Vec::from(gauss.map(|step| (method(Integrator::GaussLegendre, full), Fineness::Step(step))));
    for coordinates in [full, reduced] {
        all.extend(runge_kutta.map(|step| (method(Integrator::RungeKutta4, coordinates), Fineness::Step(step))));
    }
    all.extend([
        (method(adaptive, full), Fineness::Tolerance(1e-8)),
        (method(adaptive, full), Fineness::Tolerance(1e-11)),
        (method(adaptive, reduced), Fineness::Tolerance(1e-11)),
        (method(Integrator::SemiImplicitEuler, full), Fineness::Step(0.001)),
        (method(Integrator::SemiImplicitEuler, reduced), Fineness::Step(0.001)),
    ]);
    all
}

fn runs(start: &RobotState, gauss: [f64; 2], runge_kutta: [f64; 2]) -> Result<Vec<Run>, Problem> {
    let problems = Problems::new()?;
    let scale = Scale::of(&*problems.model, start)?;
    methods(gauss, runge_kutta)
        .into_iter()
        .map(|(method, fineness)| {
            let how = method.with(fineness, SAMPLE);
            let (phase, evaluations) = problems.free(start, DURATION, SAMPLE, how)?;
            let series = |error: &dyn Fn(&Sample, &Sample) -> f64| errors(&phase, error);
            let energy = series(&|now, start| {
                (now.momentum.kinetic_energy - start.momentum.kinetic_energy).abs() / start.momentum.kinetic_energy
            });
            let momentum = series(&|now, start| scale.momentum_error(now, start));
            Ok(Run { method, fineness, evaluations, energy, momentum })
        })
        .collect()
}

fn errors(phase: &Phase, error: &dyn Fn(&Sample, &Sample) -> f64) -> Vec<(f64, f64)> {
    let Some(start) = phase.samples.first() else { return Vec::new() };
    phase.samples.iter().map(|sample| (sample.time, error(sample, start))).collect()
}

/// Sums of the magnitudes of the bodies' momenta at the start.
struct Scale {
    linear: f64,
    angular: f64,
}

impl Scale {
    fn of(model: &AnyModel<f64>, start: &RobotState) -> Result<Self, Error> {
        let bodies = model.joints() + 1;
        let (mut inertias, mut poses, mut twists) =
            (vec![[0.0; 2]; bodies], vec![[0.0; 3]; bodies], vec![[0.0; 3]; bodies]);
        model.body_inertias(&mut inertias)?;
        model.body_poses(&start.base_pose, &start.joint_angles, &mut poses)?;
        model.body_twists(&start.view(), &mut twists)?;
        let (mut linear, mut angular) = (0.0, 0.0);
        for (([mass, inertia], [_, x, y]), [omega, vx, vy]) in inertias.iter().zip(&poses).zip(&twists) {
            linear += mass * vx.hypot(*vy);
            angular += (inertia * omega).abs() + mass * (x * vy - y * vx).abs();
        }
        Ok(Self { linear, angular })
    }

    fn momentum_error(&self, now: &Sample, start: &Sample) -> f64 {
        let [dx, dy] = [0, 1].map(|i| now.momentum.linear_momentum[i] - start.momentum.linear_momentum[i]);
        let angular = now.momentum.angular_momentum - start.momentum.angular_momentum;
        (dx.hypot(dy) / self.linear).max(angular.abs() / self.angular)
    }
}
