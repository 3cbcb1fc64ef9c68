//! The energy of a run beside what backward error analysis says of it: steps of length h keep E − h²g up to
//! terms of the order h⁴, for a function g that the model knows.

use crate::vocabulary::*;

#[derive(Clone, Copy, Debug)]
pub struct Shadow {
    pub h: f64,
    /// E and g at the start.
    begin: [f64; 2],
    /// The largest |E − E(0)|, what h²g makes of it, and the largest difference of both.
    pub largest: f64,
    pub predicted: f64,
    pub rest: f64,
}

impl Shadow {
    pub fn new(h: f64, energy: f64, shift: f64) -> Self {
        Self { h, begin: [energy, shift], largest: 0.0, predicted: 0.0, rest: 0.0 }
    }

    pub fn push(&mut self, energy: f64, shift: f64) {
        let (change, predicted) = (energy - self.begin[0], self.h * self.h * (shift - self.begin[1]));
        self.largest = larger(self.largest, change.abs());
        self.predicted = larger(self.predicted, predicted.abs());
        self.rest = larger(self.rest, (change - predicted).abs());
    }
}

/// The claim that the energy error is as predicted, of runs of a `method` with steps of several lengths, the
/// longest first.
pub fn claim(method: &str, runs: &[Shadow]) -> Claim {
    let text = format!(
        "{method}: backward error analysis gives the energy error in closed form, h² times a function of \
         the state, and the rest is of the order h⁴"
    );
    let order = |error: fn(&Shadow) -> f64| order(runs.iter().map(|run| (run.h, error(run))));
    let ratio = runs.last().map(|run| run.largest / run.predicted);
    beyond(text)
        .near(format!("{method}: order of max|ΔE|"), order(|run| run.largest), [2.0, 0.05])
        .near(format!("{method}: max|ΔE| / the predicted one, shortest step"), ratio, [1.0, 0.01])
        .near(format!("{method}: order of the largest |ΔE − prediction|"), order(|run| run.rest), [4.0, 0.1])
}
