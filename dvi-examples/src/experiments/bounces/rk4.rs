//! The classical Runge–Kutta method between impacts, which are found by bisection and keep the energy.

use crate::models::{Bouncer, BouncerState};

pub(super) struct Rk4<'a> {
    system: &'a Bouncer,
    /// x, y and their rates.
    state: [f64; 4],
    bounces: u64,
}

impl<'a> Rk4<'a> {
    pub(super) fn new(system: &'a Bouncer, start: &BouncerState) -> Self {
        let BouncerState { x, y, dot_x, dot_y } = *start;
        Self { system, state: [x, y, dot_x, dot_y], bounces: 0 }
    }

    pub(super) fn energy(&self) -> f64 {
        self.system.energy_at(self.state)
    }

    pub(super) fn bounces(&self) -> u64 {
        self.bounces
    }

    /// Takes a step of length `h`, with as many impacts as there are.
    pub(super) fn step(&mut self, h: f64) {
        let mut left = h;
        loop {
            let next = self.after(left);
            if self.gap(next) >= 0.0 {
                self.state = next;
                return;
            }
            let [mut open, mut closed] = [0.0, left];
            loop {
                let middle = 0.5 * (open + closed);
                if middle <= open || middle >= closed {
                    break;
                }
                if self.gap(self.after(middle)) >= 0.0 {
                    open = middle;
                } else {
                    closed = middle;
                }
            }
            self.state = self.after(open);
            left -= open;
            let [x, y, u, w] = self.state;
            let (_, normal) = Bouncer::above([x, y], self.system.a);
            let squared = normal[0] * normal[0] + normal[1] * normal[1];
            let change = 2.0 * (u * normal[0] + w * normal[1]) / squared;
            self.state = [x, y, u - change * normal[0], w - change * normal[1]];
            self.bounces += 1;
        }
    }

    fn gap(&self, [x, y, ..]: [f64; 4]) -> f64 {
        Bouncer::above([x, y], self.system.a).0
    }

    /// The state after a step without impacts.
    fn after(&self, h: f64) -> [f64; 4] {
        let rate = |[x, y, u, w]: [f64; 4]| {
            let [f, g] = self.system.acceleration([x, y]);
            [u, w, f, g]
        };
        let along = |h: f64, k: [f64; 4]| std::array::from_fn(|i| self.state[i] + h * k[i]);
        let k1 = rate(self.state);
        let k2 = rate(along(0.5 * h, k1));
        let k3 = rate(along(0.5 * h, k2));
        let k4 = rate(along(h, k3));
        std::array::from_fn(|i| self.state[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
    }
}
