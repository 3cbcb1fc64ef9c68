//! The classical Runge–Kutta method, beside which others are set.

use std::convert::Infallible;

use dvi_core::mechanics::Rates;

use crate::vocabulary::*;

pub fn rk4<const N: usize>(y: &[f64; N], h: f64, f: impl Fn(&[f64; N]) -> [f64; N]) -> [f64; N] {
    let Ok(next) = try_rk4(y, h, |y| Ok::<_, Infallible>(f(y)));
    next
}

/// The same with slopes that may fail.
pub fn try_rk4<Y, E>(y: &Y, h: f64, f: impl Fn(&Y) -> Result<Y, E>) -> Result<Y, E>
where
    Y: Clone + AsRef<[f64]> + AsMut<[f64]>,
{
    let moved = |by: f64, slope: &Y| {
        let mut moved = y.clone();
        moved.as_mut().iter_mut().zip(slope.as_ref()).for_each(|(y, k)| *y += by * k);
        moved
    };
    let first = f(y)?;
    let second = f(&moved(0.5 * h, &first))?;
    let third = f(&moved(0.5 * h, &second))?;
    let fourth = f(&moved(h, &third))?;
    let [a, b, c, d] = [&first, &second, &third, &fourth].map(Y::as_ref);
    let mut next = y.clone();
    for (i, next) in next.as_mut().iter_mut().enumerate() {
        *next += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
    }
    Ok(next)
}

pub fn rk4_to<const N: usize>(y: [f64; N], end: f64, h: f64, f: impl Fn(&[f64; N]) -> [f64; N]) -> [f64; N] {
    (0..(end / h).round() as u64).fold(y, |y, _| rk4(&y, h, &f))
}

/// A run of it on what a system with constraints is without them: the equations of motion with the
/// accelerations at each state.
///
/// The forces of the constraints make their second derivative in time vanish, and nothing else. So RK4 keeps
/// the constraints only up to its error.
pub struct Accelerations<'a, S> {
    system: &'a S,
    h: f64,
    y: Vec<f64>,
}

impl<'a, S: AtState + System<Kind: Rates<S, f64>>> Accelerations<'a, S> {
    pub fn new(system: &'a S, h: f64, start: &S::State<f64>) -> Result<Self> {
        Ok(Self { system, h, y: system.values(start)?.collect() })
    }

    pub fn state(&self) -> S::State<f64> {
        self.system.state_of(self.y.iter().copied())
    }

    pub fn energy(&self) -> Result<f64, StartError> {
        self.system.energy_at(0.0, &self.state())
    }

    pub fn step(&mut self) -> Result<(), StartError> {
        self.y = try_rk4(&self.y, self.h, |y| self.slope(y))?;
        Ok(())
    }

    pub fn up_to(mut self, end: f64) -> Result<S::State<f64>> {
        (0..(end / self.h).round() as u64).try_for_each(|_| self.step())?;
        Ok(self.state())
    }

    fn slope(&self, y: &[f64]) -> Result<Vec<f64>, StartError> {
        let rates = self.system.vector_field(0.0, &self.system.state_of(y.iter().copied()))?;
        Ok(self.system.values(&rates)?.collect())
    }
}
