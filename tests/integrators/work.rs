//! Work and precision of every method on one motion.

use crate::Problem;
use crate::method::{Fineness, Method};
use crate::motion::{Problems, end};
use planar_capture::simulate::stepper::{Formulation, Integration, Integrator};
use planar_capture::simulate::{Phase, PhaseError};

/// The work–precision data of one motion.
pub struct Work {
    /// In a title.
    pub title: &'static str,
    /// Difference between the two best solutions.
    pub reference_error: f64,
    pub lines: Vec<Line>,
}

/// The runs of one method.
pub struct Line {
    pub method: Method,
    /// From coarse to fine; `None` where the motion could not be computed.
    pub points: Vec<(Fineness, Option<Point>)>,
}

/// One run.
#[derive(Clone, Copy)]
pub struct Point {
    /// Of the derivative.
    pub evaluations: u64,
    /// Largest of any position or rate at the end; rad, m and per second.
    pub error: f64,
}

type Run<'a> = dyn Fn((Integration, f64)) -> Result<(Phase, u64), PhaseError> + 'a;

pub fn approach() -> Result<Work, Problem> {
    let problems = Problems::new()?;
    let run = |how| problems.approach(how);
    measure("The paper's approach, 20 s under PD control", problems.approach_duration(), &run)
}

pub fn tumbling() -> Result<Work, Problem> {
    let problems = Problems::new()?;
    let duration = 20.0;
    let run = |how| problems.free(&Problems::tumbling(), duration, duration, how);
    measure("Free tumbling, 20 s", duration, &run)
}

fn measure(title: &'static str, duration: f64, run: &Run<'_>) -> Result<Work, Problem> {
    let best = |coordinates| {
        let integration = Integration { integrator: Integrator::Adaptive { tolerance: 1e-14 }, coordinates };
        run((integration, duration)).map(|(phase, _)| end(&phase))
    };
    let (reference, other) = (best(Formulation::Full)?, best(Formulation::Reduced)?);
    let lines = Method::all().into_iter().map(|method| {
        let points = finenesses(method).into_iter().map(|fineness| {
            let point = run(method.with(fineness, duration))
                .ok()
                .map(|(phase, evaluations)| Point { evaluations, error: difference(&end(&phase), &reference) });
            // beyond this the solution is another one
            (fineness, point.filter(|point| point.error < 1.0))
        });
        Line { method, points: points.collect() }
    });
    let lines = lines.collect();
    Ok(Work { title, reference_error: difference(&reference, &other), lines })
}

fn finenesses(method: Method) -> Vec<Fineness> {
    let steps = |steps: &[f64]| steps.iter().copied().map(Fineness::Step).collect();
    match method.integration.integrator {
        Integrator::RungeKutta4 => steps(&[0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001]),
        Integrator::GaussLegendre => steps(&[0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005]),
        Integrator::SemiImplicitEuler => steps(&[0.02, 0.01, 0.005, 0.002, 0.001, 0.0005, 0.0002]),
        Integrator::Adaptive { .. } => {
            [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13].map(Fineness::Tolerance).to_vec()
        }
    }
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

/// Evaluations for an error.
pub enum Cost {
    /// By linear interpolation of the logarithms.
    About(f64),
    /// The coarsest run was better.
    AtMost(f64),
    /// No run was as good.
    More,
}

impl Line {
    /// Evaluations for an error.
    pub fn evaluations_for(&self, error: f64) -> Cost {
        let points: Vec<Point> = self.points.iter().filter_map(|(_, point)| *point).collect();
        if let Some(first) = points.first().filter(|first| first.error < error) {
            return Cost::AtMost(10_f64.powf(logarithms(*first).0));
        }
        let Some(pair) = points.windows(2).find(|pair| pair[0].error >= error && pair[1].error < error) else {
            return Cost::More;
        };
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]].map(logarithms);
        Cost::About(10_f64.powf(x0 + (x1 - x0) * (error.log10() - y0) / (y1 - y0)))
    }
}

/// Of evaluations and error, to base 10.
#[allow(clippy::cast_precision_loss, reason = "far below 2^52")]
pub fn logarithms(point: Point) -> (f64, f64) {
    ((point.evaluations as f64).log10(), point.error.max(1e-16).log10())
}
