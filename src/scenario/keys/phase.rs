//! Keys of both phases: duration, actuators, integration.

use crate::format::{Choice, Count, Default, Key, NumberRule, Shape};
use crate::integrate::Adaptive;
use crate::simulate::stepper::Integrator;

const DURATION_RULE: NumberRule = NumberRule::positive("a duration", "s");
/// Largest tolerance: beyond it an integrator of order 9 follows no motion.
const LARGEST_TOLERANCE: f64 = 1e-3;

pub(super) const TIME: Shape = Shape::Number(DURATION_RULE);

/// Of any law of a program's own, which has a rule for it.
const LAW_NUMBER: Shape = Shape::Number(NumberRule::any("a number", ""));

/// The numbers of a law of a program's own.
pub(super) const fn law(doc: &'static str, example: &'static str) -> Key {
    Key::optional("law", Shape::ByName(&LAW_NUMBER, "key"), Default::Words("the law's defaults"), doc).example(example)
}

pub(super) const DURATION: Key = Key::required("duration", TIME, "of the phase");

pub(super) const STEP: Key = Key::optional(
    "step",
    Shape::Number(NumberRule::positive("a time step", "s")),
    Default::Number(0.005),
    "the time step; with the adaptive integrator it is the spacing of the audit",
);

const TORQUE_LIMIT: Shape = Shape::Number(NumberRule::non_negative("a torque limit (or one per joint)", "N m"));

pub(super) const TORQUE_LIMITS: Key = Key::optional(
    "torque_limits",
    Shape::OneOrList(&TORQUE_LIMIT, Count::Joints),
    Default::Nothing,
    "largest torques of the joints; `joints_saturated` of the summary is the time of each joint at its limit",
)
.example("10.0");

pub(super) const SAMPLE_TIME: Key = Key::optional(
    "sample_time",
    Shape::Number(NumberRule::positive("a sample time", "s")),
    Default::Words("the law acts continuously"),
    "the law is evaluated at this interval, a whole number of steps, and its torques are held in between",
)
.example("0.05");

pub(super) const INTEGRATOR: Key = Key::optional(
    "integrator",
    Shape::Choice(integrators),
    Default::Words("`\"adaptive\"`; `\"rk4\"` where torques are limited or held"),
    "how the motion is integrated",
)
.example("\"adaptive\"");

pub(super) const TOLERANCE: Key = Key::optional(
    "tolerance",
    Shape::Number(NumberRule::positive("a tolerance", "parts of 1").within_because(
        Adaptive::SMALLEST_TOLERANCE,
        LARGEST_TOLERANCE,
        "a smaller one is below rounding errors, with a larger one the motion is wrong",
    )),
    Default::Number(Integrator::DEFAULT_TOLERANCE),
    "of each step, relative and absolute",
);

pub(super) const COORDINATES: Key = Key::optional(
    "coordinates",
    Shape::Choice(|| {
        vec![
            Choice { name: "full", doc: "base and joints" },
            Choice {
                name: "reduced",
                doc: "joints and base pose, with the base twist from the momentum, eq. (17); for a robot alone: targets \
                      that are pinned, held in a closed loop or free need full coordinates",
            },
        ]
    }),
    Default::Choice("full"),
    "what is integrated",
);

fn integrators() -> Vec<Choice> {
    let doc = |integrator: Integrator| match integrator {
        Integrator::Adaptive { .. } => {
            "formulas of order 9 (Verner) and, under control, of order 8 (Dormand and Prince), with variable steps"
        }
        Integrator::RungeKutta4 => "classical Runge–Kutta steps of order 4",
        Integrator::GaussLegendre => "implicit, order 6, conserves both momenta",
        Integrator::SemiImplicitEuler => "rates, then positions by the new rates: order 1",
    };
    let choice = |integrator: &Integrator| Choice { name: integrator.properties().name, doc: doc(*integrator) };
    Integrator::ALL.iter().map(choice).collect()
}
