//! Looks for events while a phase runs, and locates their times.

use crate::error::Error;
use crate::simulate::event::{EventState, Events};
use crate::simulate::system::System;
use crate::state::State;

/// Event times are found to this, relative to the time or, below one second, in s.
const ACCURACY: f64 = 1e-13;

/// How far before and after an instant the rates of values are taken from, relative to the step: far above rounding,
/// and short enough for a sign.
const NEAR: f64 = 1e-3;

/// The part of a bracket that remains in a step of a golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The integrated vector at a time within the step, into the last argument.
pub(crate) type StateAt<'a> = dyn FnMut(f64, &mut Vec<f64>) -> Result<(), Error> + 'a;

/// Watches the values of events from step to step.
pub(crate) struct EventLocator<'a> {
    system: &'a System<'a>,
    events: &'a mut dyn Events,
    armed: Vec<bool>,
    now: EventValues,
}

/// Values and their rates at one instant.
#[derive(Clone, Debug, Default)]
struct EventValues {
    values: Vec<f64>,
    rates: Vec<f64>,
}

impl<'a> EventLocator<'a> {
    pub(crate) fn new(system: &'a System<'a>, events: &'a mut dyn Events) -> Self {
        let count = events.count();
        let now = EventValues { values: vec![0.0; count], rates: vec![0.0; count] };
        Self { system, events, armed: vec![false; count], now }
    }

    /// Whether there is nothing to watch.
    pub(crate) fn is_idle(&self) -> bool {
        self.armed.is_empty()
    }

    /// Looks at x, whose derivative is `rate`, at the start of a phase.
    pub(crate) fn start(&mut self, time: f64, step: f64, x: &[f64], rate: &[f64]) -> Result<(), Error> {
        self.now = self.look(time, step, x, rate)?;
        self.arm();
        Ok(())
    }

    /// Looks at x at the end of a step: the first event within it, and when it was.
    pub(crate) fn end_step(
        &mut self,
        [start, end]: [f64; 2],
        x: &[f64],
        rate: &[f64],
        state_at: &mut StateAt<'_>,
    ) -> Result<Option<(usize, f64)>, Error> {
        let next = self.look(end, end - start, x, rate)?;
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
                self.dip(event, [start, end], state_at)?
            } else {
                None
            };
            if let Some((late, below)) = bracket {
                let time = self.root(event, [start, late], [values[0], below], state_at)?;
                if first.is_none_or(|(_, earlier)| time < earlier) {
                    first = Some((event, time));
                }
            }
        }
        self.arm();
        Ok(first)
    }

    fn arm(&mut self) {
        for (armed, value) in self.armed.iter_mut().zip(&self.now.values) {
            *armed |= *value > 0.0;
        }
    }

    fn look(&mut self, time: f64, step: f64, x: &[f64], rate: &[f64]) -> Result<EventValues, Error> {
        let count = self.armed.len();
        let mut look = EventValues { values: vec![0.0; count], rates: vec![0.0; count] };
        self.values(time, x, &mut look.values)?;
        let apart = NEAR * step;
        let mut beside = |side: f64| {
            let x: Vec<f64> = x.iter().zip(rate).map(|(x, rate)| x + side * apart * rate).collect();
            let mut values = vec![0.0; count];
            self.values(time + side * apart, &x, &mut values).map(|()| values)
        };
        let (before, after) = (beside(-1.0)?, beside(1.0)?);
        for (rate, (after, before)) in look.rates.iter_mut().zip(after.iter().zip(&before)) {
            *rate = (after - before) / (2.0 * apart);
        }
        Ok(look)
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

    /// A time between two at which a value that falls at first and rises at last is 0 or below, and the value.
    fn dip(
        &mut self,
        event: usize,
        [mut start, mut end]: [f64; 2],
        state_at: &mut StateAt<'_>,
    ) -> Result<Option<(f64, f64)>, Error> {
        // a value is flat at its minimum: half the digits of the time are all that shows
        let enough = (end - start) * f64::EPSILON.sqrt();
        let mut inner = [end - GOLDEN * (end - start), start + GOLDEN * (end - start)];
        let mut values = [self.value_at(event, inner[0], state_at)?, self.value_at(event, inner[1], state_at)?];
        loop {
            let lower = usize::from(values[1] < values[0]);
            if values[lower] <= 0.0 {
                return Ok(Some((inner[lower], values[lower])));
            }
            if end - start <= enough {
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

    /// When a value that is above 0 at the first time and 0 or below at the second falls to 0, or just after. By the
    /// method of Oliveira & Takahashi (2020): as good as bisection at worst, superlinear for what is smooth.
    fn root(
        &mut self,
        event: usize,
        [mut above, mut below]: [f64; 2],
        [mut high, mut low]: [f64; 2],
        state_at: &mut StateAt<'_>,
    ) -> Result<f64, Error> {
        let enough = ACCURACY * below.abs().max(1.0);
        let shift = 0.2 / (below - above);
        let mut reach = enough * 2.0_f64.powi(2 + bisections(below - above, enough));
        while below - above > enough && low < 0.0 {
            let middle = above + 0.5 * (below - above);
            let chord = above + (below - above) * (high / (high - low));
            let toward = (middle - chord).signum();
            let moved = shift * (below - above).powi(2);
            let truncated = if moved <= (middle - chord).abs() { chord + toward * moved } else { middle };
            let radius = (0.5 * (reach - (below - above))).max(0.0);
            let time = if (truncated - middle).abs() <= radius { truncated } else { middle - toward * radius };
            let value = self.value_at(event, time, state_at)?;
            if value > 0.0 {
                (above, high) = (time, value);
            } else {
                (below, low) = (time, value);
            }
            reach *= 0.5;
        }
        Ok(below)
    }
}

/// How many bisections make a bracket short enough.
#[allow(clippy::cast_possible_truncation, reason = "54 at most, for the accuracy is above rounding")]
fn bisections(length: f64, enough: f64) -> i32 {
    (length / enough).log2().ceil().max(0.0) as i32
}
