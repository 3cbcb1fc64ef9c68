//! The classical Runge–Kutta method, beside which others are set.

use crate::vocabulary::*;

pub fn rk4<const N: usize>(y: &[f64; N], h: f64, f: impl Fn(&[f64; N]) -> [f64; N]) -> [f64; N] {
    let moved = |by: f64, slope: &[f64; N]| std::array::from_fn(|i| y[i] + by * slope[i]);
    let first = f(y);
    let second = f(&moved(0.5 * h, &first));
    let third = f(&moved(0.5 * h, &second));
    let fourth = f(&moved(h, &third));
    std::array::from_fn(|i| y[i] + h / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]))
}

pub fn rk4_to<const N: usize>(y: [f64; N], end: f64, h: f64, f: impl Fn(&[f64; N]) -> [f64; N]) -> [f64; N] {
    (0..(end / h).round() as u64).fold(y, |y, _| rk4(&y, h, &f))
}

/// How far quantities are from their start, as `of` says after each of so many steps.
pub fn keep_rk4<const D: usize, const N: usize>(
    job: &Job<'_>,
    mut y: [f64; D],
    (h, steps): (f64, u64),
    span: Span,
    f: impl Fn(&[f64; D]) -> [f64; D],
    of: impl Fn(&[f64; D]) -> [f64; N],
) -> Result<[Deviation; N]> {
    let (mut kept, mut step) = (span.deviations(), 0_u32);
    job.repeat(steps, || {
        y = rk4(&y, h, &f);
        step += 1;
        note(&mut kept, f64::from(step) * h, of(&y));
        Ok(())
    })?;
    Ok(kept)
}

/// A run of it on what a system with constraints is without them: the equations of motion with the
/// accelerations at each state.
///
/// The forces of the constraints make their second derivative in time vanish, and nothing else. So RK4 keeps
/// the constraints only up to its error.
pub struct Accelerations<'a, S> {
    system: &'a S,
    h: f64,
    /// Coordinates and velocities.
    y: Vec<f64>,
}

impl<'a, S: HolonomicLagrangian + AtState> Accelerations<'a, S> {
    pub fn new(system: &'a S, h: f64, start: &S::State<f64>) -> Result<Self> {
        Ok(Self { system, h, y: system.values(start)?.collect() })
    }

    pub fn state(&self) -> S::State<f64> {
        self.read(&self.y)
    }

    pub fn energy(&self) -> Result<f64, StartError> {
        self.system.energy_at(&self.state())
    }

    pub fn step(&mut self) -> Result<(), StartError> {
        let (h, y) = (self.h, self.y.clone());
        let moved = |by: f64, k: &[f64]| -> Vec<f64> { y.iter().zip(k).map(|(y, k)| y + by * k).collect() };
        let first = self.slope(&y)?;
        let second = self.slope(&moved(0.5 * h, &first))?;
        let third = self.slope(&moved(0.5 * h, &second))?;
        let fourth = self.slope(&moved(h, &third))?;
        for (i, y) in self.y.iter_mut().enumerate() {
            *y += h / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]);
        }
        Ok(())
    }

    pub fn up_to(mut self, end: f64) -> Result<S::State<f64>> {
        (0..(end / self.h).round() as u64).try_for_each(|_| self.step())?;
        Ok(self.state())
    }

    fn read(&self, y: &[f64]) -> S::State<f64> {
        let (q, v) = y.split_at(y.len() / 2);
        S::State::read(|block| self.system.block_len(block), q, v)
    }

    fn slope(&self, y: &[f64]) -> Result<Vec<f64>, StartError> {
        let rates = self.system.vector_field(&self.read(y))?;
        // The lengths are those of the state that was read.
        Ok(self.system.values(&rates).map_or_else(|_| Vec::new(), Iterator::collect))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rk4_is_of_fourth_order_on_a_pendulum() {
        let end = |h: f64| rk4_to([1.0, 0.0], 2.0, h, |&[x, v]: &[f64; 2]| [v, -x.sin()]);
        let exact = end(1e-3);
        let order = order([0.1, 0.05, 0.025].map(|h| (h, apart(&end(h), &exact))));
        assert!(order.is_some_and(|order| (order - 4.0).abs() < 0.1), "{order:?}");
    }
}
