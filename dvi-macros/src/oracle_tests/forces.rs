//! The forces on a system, and what a dissipation function adds to them.

use super::evaluate::{Oracle, Outside};
use super::formula::Formula;
use super::jet::{Jet, Sized};

impl Oracle<'_> {
    /// The force on each coordinate.
    pub(super) fn forces(&mut self) -> Result<Vec<Jet>, Outside> {
        let mut forces = vec![Jet::constant(0.0); self.system.dimension()];
        for (block, force) in &self.system.forces {
            let (offset, length) = (self.system.offset(*block), self.system.block_length(*block));
            let mut add = |place: usize, force: &Jet| forces[place] = forces[place].plus(force);
            if self.system.axes(*block) == 1 && force.is_vector() {
                let components = self.values(force)?;
                components.iter().enumerate().for_each(|(i, force)| add(offset + i, force));
                continue;
            }
            for i in 0..length {
                let is_array = self.system.blocks[*block].size.is_some();
                let indices: &[i64] = if is_array { &[i as i64] } else { &[] };
                let components = self.inside(indices, force)?;
                components
                    .iter()
                    .enumerate()
                    .for_each(|(axis, force)| add(offset + axis * length + i, force));
            }
        }
        match &self.system.dissipation {
            Some(function) => self.with_friction(function, forces),
            None => Ok(forces),
        }
    }

    /// These with −∂R/∂v.
    fn with_friction(&mut self, function: &Formula, mut forces: Vec<Jet>) -> Result<Vec<Jet>, Outside> {
        let (function, n) = (self.value(function)?, forces.len());
        for (i, force) in forces.iter_mut().enumerate() {
            let slope = Jet::from_derivatives(
                function.gradient(n + i),
                self.variables(),
                |j| function.hessian(n + i, j),
                |_, _| Sized::default(),
            );
            *force = force.plus(&slope.scaled(-1.0));
        }
        Ok(forces)
    }
}
