//! What a system with constraints is without them: RK4 on the equations of motion with the accelerations at
//! each state.
//!
//! The forces of the constraints make their second derivative in time vanish, and nothing else. So RK4 keeps
//! the constraints only up to its error.

use anyhow::Result;
use dvi_core::State;
use dvi_core::error::StartError;
use dvi_core::prelude::*;

/// A run of RK4.
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
        let h = self.h;
        let first = self.slope(&self.y)?;
        let second = self.slope(&self.moved(0.5 * h, &first))?;
        let third = self.slope(&self.moved(0.5 * h, &second))?;
        let fourth = self.slope(&self.moved(h, &third))?;
        for (i, y) in self.y.iter_mut().enumerate() {
            *y += h / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]);
        }
        Ok(())
    }

    fn moved(&self, h: f64, slope: &[f64]) -> Vec<f64> {
        self.y.iter().zip(slope).map(|(y, slope)| y + h * slope).collect()
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
