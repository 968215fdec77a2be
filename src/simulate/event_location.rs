//! Event location: finds events within steps, and their times.

use crate::error::Error;
use crate::simulate::event::{EventState, Events};
use crate::simulate::path::PathInterval;
use crate::simulate::root::root;
use crate::simulate::stepper::{StateAt, Stepper};
use crate::simulate::subdivision::Subdivision;
use crate::simulate::system::System;
use crate::state::State;

/// Accuracy of event times, relative to the time, or in s below one second.
const TIME_TOLERANCE: f64 = 1e-13;

/// Half the interval of the difference quotients for the rates of values, relative to the step: far above rounding, and
/// short enough for a sign.
const DIFFERENCE: f64 = 1e-3;

/// The part of a bracket that a step of golden-section search keeps.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Accuracy of the time of an event at about this time, s.
pub(crate) fn time_tolerance(time: f64) -> f64 {
    TIME_TOLERANCE * time.abs().max(1.0)
}

/// The values of events at the end of the last step.
pub(crate) struct EventLocator<'a> {
    system: &'a System<'a>,
    events: &'a mut dyn Events,
    armed: Vec<bool>,
    now: EventValues,
    is_started: bool,
}

/// Values and their rates at one instant.
struct EventValues {
    values: Vec<f64>,
    rates: Vec<f64>,
}

impl<'a> EventLocator<'a> {
    pub(crate) fn new(system: &'a System<'a>, events: &'a mut dyn Events) -> Self {
        let count = events.count();
        let now = EventValues { values: vec![0.0; count], rates: vec![0.0; count] };
        Self { system, events, armed: vec![false; count], now, is_started: false }
    }

    /// Before a part of a step, from `x`: evaluates the events at the start of a phase.
    pub(crate) fn begin(&mut self, [start, end]: [f64; 2], x: &[f64], stepper: &mut Stepper<'_>) -> Result<(), Error> {
        if self.is_started || self.armed.is_empty() || self.events.are_bounded() {
            return Ok(());
        }
        let mut rate = vec![0.0; x.len()];
        stepper.rate(start, x, &mut rate)?;
        self.start(start, end - start, x, &rate)
    }

    /// Evaluates the events at the start of a phase, at x with the derivative `rate`.
    fn start(&mut self, time: f64, step: f64, x: &[f64], rate: &[f64]) -> Result<(), Error> {
        self.is_started = true;
        self.now = self.evaluate(time, step, x, rate)?;
        self.arm();
        Ok(())
    }

    /// After a part of a step, which ends at `x`: the first event within it and its time.
    pub(crate) fn find(
        &mut self,
        part @ [start, end]: [f64; 2],
        x: &[f64],
        subdivision: &Subdivision,
        stepper: &mut Stepper<'_>,
    ) -> Result<Option<(usize, f64)>, Error> {
        if self.armed.is_empty() {
            return Ok(None);
        }
        if !self.events.are_bounded() {
            let mut rate = vec![0.0; x.len()];
            stepper.rate(end, x, &mut rate)?;
            return self.end_step(part, x, &rate, &mut |t, into| stepper.within([start, t], into));
        }
        for interval in subdivision.intervals() {
            let mut state_at = |t: f64, into: &mut Vec<f64>| stepper.within([start, t], into);
            let event = self.end_bounded_step(&interval?, &mut state_at)?;
            if event.is_some() {
                return Ok(event);
            }
        }
        Ok(None)
    }

    /// Evaluates the events at the end of a step; returns the first one within the step and its time.
    fn end_step(
        &mut self,
        [start, end]: [f64; 2],
        x: &[f64],
        rate: &[f64],
        state_at: &mut StateAt<'_>,
    ) -> Result<Option<(usize, f64)>, Error> {
        let next = self.evaluate(end, end - start, x, rate)?;
        let before = std::mem::replace(&mut self.now, next);
        let mut first: Option<(usize, f64)> = None;
        for event in 0..self.armed.len() {
            if !self.armed[event] {
                continue;
            }
            let values = [before.values[event], self.now.values[event]];
            let bracket = if values[1] <= 0.0 {
                Some((end, values[1]))
            } else if before.rates[event] < 0.0 && self.now.rates[event] > 0.0 {
                self.find_below_zero(event, [start, end], state_at)?
            } else {
                None
            };
            if let Some((late, below)) = bracket {
                let time = self.time_of(event, [start, late], [values[0], below], state_at)?;
                if first.is_none_or(|(_, earlier)| time < earlier) {
                    first = Some((event, time));
                }
            }
        }
        self.arm();
        Ok(first)
    }

    /// As [`end_step`](Self::end_step), by the bounds of the events.
    fn end_bounded_step(
        &mut self,
        step: &PathInterval<'_>,
        state_at: &mut StateAt<'_>,
    ) -> Result<Option<(usize, f64)>, Error> {
        let crossings = self.events.crossings(step)?;
        let mut first: Option<(usize, f64)> = None;
        for (event, bracket) in crossings.into_iter().enumerate() {
            let Some([above, below]) = bracket else { continue };
            let values = [self.value_at(event, above, state_at)?, self.value_at(event, below, state_at)?];
            // the interpolant and the dense output differ by rounding and the error of a step
            let time = if values[0] > 0.0 { self.time_of(event, [above, below], values, state_at)? } else { above };
            if first.is_none_or(|(_, earlier)| time < earlier) {
                first = Some((event, time));
            }
        }
        Ok(first)
    }

    fn arm(&mut self) {
        for (armed, value) in self.armed.iter_mut().zip(&self.now.values) {
            *armed |= *value > 0.0;
        }
    }

    fn evaluate(&mut self, time: f64, step: f64, x: &[f64], rate: &[f64]) -> Result<EventValues, Error> {
        let count = self.armed.len();
        let interval = DIFFERENCE * step;
        let mut values_at = |offset: f64| {
            let x: Vec<f64> = x.iter().zip(rate).map(|(x, rate)| x + offset * rate).collect();
            let mut values = vec![0.0; count];
            self.values(time + offset, &x, &mut values).map(|()| values)
        };
        let [before, values, after] = [values_at(-interval)?, values_at(0.0)?, values_at(interval)?];
        let rates = after.iter().zip(&before).map(|(after, before)| (after - before) / (2.0 * interval)).collect();
        Ok(EventValues { values, rates })
    }

    fn values(&mut self, time: f64, x: &[f64], values: &mut [f64]) -> Result<(), Error> {
        let state = State::from_vector(x, self.system.model.joints())?;
        let bodies = self.system.bodies_at(x)?;
        self.events.values(&EventState { time, system: self.system, state, bodies: &bodies }, values)
    }

    fn value_at(&mut self, event: usize, time: f64, state_at: &mut StateAt<'_>) -> Result<f64, Error> {
        let mut x = Vec::new();
        state_at(time, &mut x)?;
        let mut values = vec![0.0; self.armed.len()];
        self.values(time, &x, &mut values)?;
        Ok(values[event])
    }

    /// The time, or just after it, at which a value falls to 0 that is above 0 at the first time and 0 or below at the
    /// second.
    fn time_of(
        &mut self,
        event: usize,
        times @ [_, below]: [f64; 2],
        values: [f64; 2],
        state_at: &mut StateAt<'_>,
    ) -> Result<f64, Error> {
        root(times, values, time_tolerance(below), |time| self.value_at(event, time, state_at))
    }

    /// Golden-section search for a time at which a value that falls at the start and rises at the end is 0 or below;
    /// returns the time and the value.
    fn find_below_zero(
        &mut self,
        event: usize,
        [mut start, mut end]: [f64; 2],
        state_at: &mut StateAt<'_>,
    ) -> Result<Option<(f64, f64)>, Error> {
        // near a minimum the value resolves only half the digits of the time
        let tolerance = (end - start) * f64::EPSILON.sqrt();
        let mut inner = [end - GOLDEN * (end - start), start + GOLDEN * (end - start)];
        let mut values = [self.value_at(event, inner[0], state_at)?, self.value_at(event, inner[1], state_at)?];
        loop {
            let lower = usize::from(values[1] < values[0]);
            if values[lower] <= 0.0 {
                return Ok(Some((inner[lower], values[lower])));
            }
            if end - start <= tolerance {
                return Ok(None);
            }
            if lower == 0 {
                end = inner[1];
                inner = [end - GOLDEN * (end - start), inner[0]];
                values = [self.value_at(event, inner[0], state_at)?, values[0]];
            } else {
                start = inner[0];
                inner = [inner[1], start + GOLDEN * (end - start)];
                values = [values[1], self.value_at(event, inner[1], state_at)?];
            }
        }
    }
}

#[cfg(test)]
mod tests;
