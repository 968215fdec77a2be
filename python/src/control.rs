//! Control laws that are callables of Python's.
//!
//! Such a law may remember what it was called with: it is called once per sample. What it raises stops the phase, and is
//! raised again where the study was started.

use numpy::{PyArray1, PyReadonlyArray1};
use planar_capture::control::Control;
use planar_capture::dynamics::AnyModel;
use planar_capture::error::Error;
use planar_capture::laws::{PostCaptureLaw, PostCaptureTask, Run, TrackingLaw, TrackingTask};
use planar_capture::simulate::{Phase, PhaseError};
use planar_capture::state::State;
use planar_capture::trajectory::{ConstantSetpoint, DesiredJoint, Trajectory};
use pyo3::prelude::{Py, PyAny, PyAnyMethods, PyErr, PyResult, Python};
use std::sync::{Mutex, PoisonError};

/// A callable, and what it has raised.
pub struct Callable {
    /// Has the methods `begin` and `torques` of the class `Law` in `planar_capture.control`.
    law: Py<PyAny>,
    raised: Mutex<Option<PyErr>>,
}

impl Callable {
    /// Nothing is called.
    pub fn new(law: Py<PyAny>) -> Self {
        Self { law, raised: Mutex::new(None) }
    }

    /// What it has raised, the first time that this is asked.
    pub fn raised(&self) -> Option<PyErr> {
        self.raised.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn attempt<T>(&self, call: impl FnOnce(Python<'_>) -> PyResult<T>) -> Result<T, Error> {
        Python::attach(call).map_err(|error| {
            self.raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
            // stops the phase; the other error is what is shown
            Error::NotFinite { quantity: "joint_torques", index: 0, value: f64::NAN }
        })
    }

    /// A phase begins, at so many seconds after the first impact.
    fn begin(&self, since_impact: f64) -> Result<(), PhaseError> {
        let begun = self.attempt(|py| self.law.bind(py).call_method1("begin", (since_impact,)).map(|_| ()));
        begun.map_err(|source| PhaseError { time: 0.0, source })
    }
}

impl TrackingLaw for Callable {
    fn name(&self) -> &'static str {
        "python"
    }

    fn track(&self, task: &TrackingTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        self.begin(0.0)?;
        run(&mut Called { law: self, trajectory: task.trajectory })
    }
}

impl PostCaptureLaw for Callable {
    fn name(&self) -> &'static str {
        "python"
    }

    fn control(&self, task: &PostCaptureTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        self.begin(task.since_impact)?;
        run(&mut Called { law: self, trajectory: ConstantSetpoint { angles: task.angles } })
    }
}

/// The law of one phase.
struct Called<'a, D> {
    law: &'a Callable,
    trajectory: D,
}

impl<D: Trajectory<f64>> Control<f64> for Called<'_, D> {
    fn joint_torques(
        &mut self,
        time: f64,
        _: &AnyModel<f64>,
        state: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        // resolved motion rate control has no trajectory, and nothing is desired of the joints then
        let desired: Option<Vec<DesiredJoint<f64>>> =
            (0..torques.len()).map(|joint| self.trajectory.joint(joint, time)).collect();
        self.law.attempt(|py| {
            let array = |numbers: &[f64]| PyArray1::from_slice(py, numbers);
            let part = |part: fn(&DesiredJoint<f64>) -> f64| {
                desired.as_ref().map(|joints| array(&joints.iter().map(part).collect::<Vec<_>>()))
            };
            let arguments = (
                time,
                array(&state.base_pose),
                array(state.joint_angles),
                array(&state.base_twist),
                array(state.joint_rates),
                part(|joint| joint.angle),
                part(|joint| joint.rate),
                part(|joint| joint.acceleration),
            );
            let found = self.law.law.bind(py).call_method1("torques", arguments)?;
            let found: PyReadonlyArray1<'_, f64> = found.extract()?;
            torques.copy_from_slice(found.as_slice()?);
            Ok(())
        })
    }

    fn has_memory(&self) -> bool {
        true
    }
}
