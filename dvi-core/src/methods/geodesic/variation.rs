//! How a node of a step varies with the ends of the geodesic, each factor of the manifold in its own way;
//! and second derivatives over the coordinates as those over the tangent vectors of their blocks.

use nalgebra::{Matrix3, Vector3};

use super::node::{Forces, Node, Path};
use crate::mechanics::manifold::series::Series;
use crate::mechanics::manifold::{Block, blocks, matrix, rotation, set, set_matrix, vector};
use crate::mechanics::pattern::visit_second_derivatives;
use crate::space::Sink;
use crate::system::{Factor, ManifoldSystem};
use crate::{ManifoldLagrangian, Real, Scalar, Space, System, Vector};

/// Three numbers for each coordinate: how it varies with the tangent vectors of its block.
pub(super) type Rows<S, T> = <<S as System>::Space as Space>::Vector<[T; 3]>;

/// How the point and the velocity of a node vary, in each row with the tangent vectors of its block.
#[derive(Debug)]
pub(super) struct Variation<S: System, T: Real> {
    pub(super) point: Rows<S, T>,
    pub(super) velocity: Rows<S, T>,
}

impl<S: System, T: Real> Variation<S, T> {
    pub(super) fn new(system: &S) -> Self {
        let rows = || system.space().array([T::lift(0.0); 3]);
        Self { point: rows(), velocity: rows() }
    }

    /// In the three places of `block`: a variation by each of its tangent vectors, as columns.
    #[inline]
    pub(super) fn set(rows: &mut Rows<S, T>, block: Block, columns: &Matrix3<T>) {
        for (number, place) in block.vector().into_iter().enumerate() {
            rows[place] = [0, 1, 2].map(|column| columns[(number, column)]);
        }
    }

    /// The same for the nine entries of a rotation matrix R: R η̂ for η in the columns.
    #[inline]
    pub(super) fn turn(rows: &mut Rows<S, T>, block: Block, matrix: &Matrix3<T>, columns: &Matrix3<T>) {
        for (column, eta) in columns.column_iter().enumerate() {
            for row in 0..3 {
                // r η̂ = (r × η)ᵀ for a row r.
                let turned = matrix.row(row).transpose().cross(&eta);
                for (number, &entry) in turned.iter().enumerate() {
                    rows[block.place(3 * row + number)][column] = entry;
                }
            }
        }
    }
}

impl<S: ManifoldLagrangian<T>, T: Real> Node<S, T> {
    /// Δ/h
    #[inline]
    pub(super) fn swing_on_line(&mut self, block: Block, Path { displacement, h, .. }: Path<'_, T>) {
        let (zero, per_h) = (T::lift(0.0), T::lift(1.0) / h);
        for i in block.places() {
            self.work.velocity[i] = per_h * displacement[i];
            self.first.velocity[i] = [per_h, zero, zero];
            self.displacement.velocity[i] = [per_h, zero, zero];
        }
    }

    /// x(c) = x0 + c Δ
    #[inline]
    pub(super) fn stand_on_line(&mut self, block: Block, Path { q, displacement, .. }: Path<'_, T>, c: T) {
        let zero = T::lift(0.0);
        for i in block.places() {
            self.work.point[i] = q[i] + c * displacement[i];
            self.first.point[i] = [c - T::lift(1.0), zero, zero];
            self.displacement.point[i] = [c, zero, zero];
        }
    }

    /// ω = u/h. With R0 by η, where R1 is held, δu = −J(u)⁻¹η.
    #[inline]
    pub(super) fn swing_on_rotations(&mut self, block: Block, Path { displacement, h, .. }: Path<'_, T>) {
        let (u, per_h) = (vector(displacement, block), T::lift(1.0) / h);
        let inverse = Series::mean_inverse(u).matrix();
        set(&mut self.work.velocity, block, u * per_h);
        Variation::<S, T>::set(&mut self.first.velocity, block, &(inverse * per_h));
        Variation::<S, T>::set(&mut self.displacement.velocity, block, &(Matrix3::identity() * per_h));
    }

    /// R(c) = R0 exp(cû). With u varies R(c)ᵀδR = c J(−cu) δu; with R0 by η, where R1 is held, R(c)ᵀδR =
    /// exp(−cu) η + c J(−cu) δu.
    #[inline]
    pub(super) fn stand_on_rotations(
        &mut self,
        block: Block,
        Path { q, displacement, .. }: Path<'_, T>,
        c: T,
    ) {
        let (start, u) = (matrix(q, block), vector(displacement, block));
        let turn = Series::exp(u * c).matrix();
        let here = start * turn;
        let turned = Series::mean(u * -c).matrix() * c;
        let held = turned * Series::mean_inverse(u).matrix() - turn.transpose();
        set_matrix(&mut self.work.point, block, &here);
        Variation::<S, T>::turn(&mut self.first.point, block, &here, &held);
        Variation::<S, T>::turn(&mut self.displacement.point, block, &here, &turned);
    }

    /// γ'(c)/h, with tangent vectors along the circle and across.
    #[inline]
    pub(super) fn swing_on_sphere(&mut self, block: Block, path: Path<'_, T>, c: T) {
        let circle = path.circle(block);
        let (here, rest) = (circle.at(c), circle.at(T::lift(1.0) - c));
        let (one, per_h, theta) = (T::lift(1.0), T::lift(1.0) / path.h, circle.angle);
        let columns = |along: Vector3<T>, factor: T| {
            Matrix3::from_columns(&[along, circle.axis * factor, Vector3::zeros()]) * per_h
        };
        set(&mut self.work.velocity, block, here.direction * (theta * per_h));
        let set = Variation::<S, T>::set;
        // θ cos((1 − c)θ)/sin θ
        let held = rest.cosine / Scalar::sinc(theta);
        let along = here.direction + here.point * ((one - c) * theta);
        set(&mut self.first.velocity, block, &columns(along, held));
        let along = here.direction - here.point * (c * theta);
        set(&mut self.displacement.velocity, block, &columns(along, here.cosine));
    }

    /// s(c) = cos(cθ) s0 + sin(cθ) d, with the same tangent vectors.
    #[inline]
    pub(super) fn stand_on_sphere(&mut self, block: Block, path: Path<'_, T>, c: T) {
        let circle = path.circle(block);
        let (here, rest, theta) = (circle.at(c), T::lift(1.0) - c, circle.angle);
        let columns = |along: Vector3<T>, factor: T| {
            Matrix3::from_columns(&[along, circle.axis * factor, Vector3::zeros()])
        };
        // sin(cθ)/θ and sin((1 − c)θ)/sin θ
        let across = c * Scalar::sinc(c * theta);
        let held = rest * Scalar::sinc(rest * theta) / Scalar::sinc(theta);
        set(&mut self.work.point, block, here.point);
        let set = Variation::<S, T>::set;
        set(&mut self.first.point, block, &columns(here.direction * -rest, -held));
        set(&mut self.displacement.point, block, &columns(here.direction * c, across));
    }

    #[inline]
    pub(super) fn bend_of_rotation(
        &self,
        block: Block,
        Path { q, displacement, h }: Path<'_, T>,
        c: T,
        forces: Forces,
    ) -> Matrix3<T> {
        let u = vector(displacement, block);
        let (inverse, momentum) = (Series::mean_inverse(-u), vector(&self.work.momentum, block) / h);
        let Forces::Of = forces else { return -inverse.derivative(&momentum) };
        let (mean, exp) = (Series::mean(u * c), Series::exp(u * c));
        let here = matrix(q, block) * exp.matrix();
        let m = here.transpose() * matrix(&self.work.gradient, block);
        let torque = rotation::torque(&m);
        let turned = Series::mean(u * -c).matrix() * c;
        let carried = inverse.matrix() * mean.matrix() * c - exp.matrix();
        carried * rotation::torque_change(&m) * turned
            + inverse.matrix() * mean.derivative(&torque) * (c * c)
            - exp.derivative(&torque) * c
            - inverse.derivative(&(momentum + mean.of(&torque) * c))
    }
}

/// The first tangent vector of the block of each coordinate, how many the block has, and the number of the
/// coordinate in it. A number is a block of its own.
pub(super) type Slots<S> = Vector<S, [usize; 3]>;

pub(super) fn slots<S: ManifoldSystem>(system: &S) -> Slots<S> {
    let mut slots = system.space().array([0; 3]);
    for block in blocks(system) {
        for (number, place) in block.places().enumerate() {
            slots[place] = match block.factor {
                Factor::Line => [block.slot + number, 1, 0],
                Factor::Rotation | Factor::Sphere => [block.slot, block.dimension(), number],
            };
        }
    }
    slots
}

/// Visits the tangent vectors that depend on one another in the equations of a step: those of coordinates
/// that a second derivative of L at a point couples, and those of one block.
pub(super) fn visit_coupled<S: ManifoldLagrangian<T>, T: Real>(
    system: &S,
    slots: &Slots<S>,
    at: [&[T]; 2],
    t: T,
    visit: &mut dyn FnMut(usize, usize),
) {
    let mut all = |[first, rows, _]: [usize; 3], [second, columns, _]: [usize; 3]| {
        (0..rows).for_each(|i| (0..columns).for_each(|j| visit(first + i, second + j)));
    };
    for &slots in slots.iter() {
        all(slots, slots);
    }
    visit_second_derivatives(system, at, t, &mut |row, column| all(slots[row], slots[column]));
}

/// Passes the entries of a matrix over the coordinates on as those of Aᵀ M B, where the rows of A and B are
/// variations.
pub(super) struct Between<'a, S: System, T: Real, K> {
    pub(super) left: &'a Rows<S, T>,
    pub(super) right: &'a Rows<S, T>,
    pub(super) slots: &'a Slots<S>,
    pub(super) sink: &'a mut K,
}

impl<S: System, T: Real, K: Sink<T>> Sink<T> for Between<'_, S, T, K> {
    #[inline]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        // Blocks of weight zero come with the others.
        if entry == T::lift(0.0) {
            return;
        }
        let ([first, rows, _], [second, columns, _]) = (self.slots[row], self.slots[column]);
        for (column, &right) in self.right[column][..columns].iter().enumerate() {
            let changed = entry * right;
            // A velocity varies with a displacement in one place, if it is not one of a unit vector.
            if changed != T::lift(0.0) {
                for (row, &left) in self.left[row][..rows].iter().enumerate() {
                    self.sink.add(first + row, second + column, left * changed);
                }
            }
        }
    }
}
