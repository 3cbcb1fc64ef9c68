//! Tensor-product B-splines: functions of several variables that take the values of a table on a grid.
//!
//! f(x) = Σ c_{j₁…j_D} B_{j₁}(x₁) ⋯ B_{j_D}(x_D), with the coefficients that are found axis by axis (de
//! Boor, *A Practical Guide to Splines*, 2001, chapter XVII). One pass over the (p + 1)ᴰ coefficients of a
//! cell gives the value with all first and second derivatives: a line of p + 1 of them along the last axis
//! is a function of the last variable, and is multiplied by a B-spline of each of the others.

use alloc::vec::Vec;

use super::basis::{Basis, Local, entry};
use super::interpolation::Equations;
use super::table::{SplineError, points, sampled};
use super::{Axis, Expansion, ScalarField, constant};
use crate::Scalar;

/// Rounding errors of values may show in a spline enlarged by this factor: half of the digits are left.
const LARGEST_GROWTH: f64 = 1e8;

/// A spline of `D` variables through the values of a table: piecewise polynomials, of degree 3 with two
/// continuous derivatives, or of degree 5 with four.
///
/// [`new`](Self::new) makes a cubic spline and [`quintic`](Spline::quintic) one of degree 5. Both take the
/// values at the points of the grid, up to rounding. Where the table was sampled from a smooth function at
/// distances h, the value of the cubic spline differs from it by a multiple of h⁴, the first derivatives by
/// h³ and the second by h²; for the quintic spline these are h⁶, h⁵ and h⁴.
///
/// Neighbouring distances of a grid should be similar. Where they grow by a large factor from each to the
/// next, splines oscillate between the points, those of degree 5 sooner. Of cubic splines through random
/// values between 0 and 1 at 40 points, 200 of them, the largest values were between 0.9 and 5 for a factor
/// of 2, and between 19 and 6700 for a factor of 3. Of quintic ones they were between 0.9 and 6 for a factor
/// of 1.2, and between 3 and 4000 for a factor of 1.5.
///
/// Rounding errors of values grow where two points are close beside their neighbours, by the ratio of these
/// distances and more, and the factors of all axes multiply. A grid on which they could grow more than 10⁸
/// times, so that fewer than half of the digits were left, is refused. On one axis that is otherwise nearly
/// uniform, a distance may be 10⁷ times smaller than the larger one beside it, in degree 5 10⁶ times, and
/// not 10⁹ times. Through the values of 1 + x²/10, with two points 10⁻⁷ apart among others at distances of
/// 0.3 to 0.9, a cubic spline and its second derivative were off by no more than 10⁻⁹ and 10⁻⁷.
///
/// At an end without a period the polynomials of the first two cells are the same one (*not a knot*; of the
/// first three, in degree 5), and no derivative there has to be known. In every variable, polynomials up to
/// the degree of the spline are reproduced.
///
/// Outside of the [domain](ScalarField::domain) the value and all derivatives are not numbers. A spline is
/// never extrapolated. In a variable with a period every finite number is inside.
///
/// An evaluation does not allocate. It finds a cell in a fixed time on a grid that is nearly uniform, and by
/// bisection on any other. In single precision a spline of more than 2²⁴ coefficients is not a number,
/// because the place of a coefficient is not one.
///
/// ```
/// use dvi_core::field::{Axis, Expansion, ScalarField, Spline};
///
/// // r² sin θ on a grid of 5 × 36 points.
/// let radius = Axis::uniform([1.0, 2.0], 5)?;
/// let degrees: Vec<f64> = (0..36).map(|j| 10.0 * f64::from(j)).collect();
/// let angle = Axis::periodic(&degrees, 360.0)?;
/// let psi = Spline::sample([radius, angle], |[r, theta]| r * r * theta.to_radians().sin())?;
///
/// let there: Expansion<2> = psi.expansion([1.7, 30.0 - 720.0]);
/// assert!((there.value - 1.7 * 1.7 * 0.5).abs() < 1e-12);
/// assert!((there.gradient[0] - 1.7).abs() < 1e-12);
/// assert!((there.hessian[0][0] - 1.0).abs() < 1e-12);
/// let outside: Expansion<2> = psi.expansion([2.1, 0.0]);
/// assert!(outside.value.is_nan());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Spline<const D: usize, const DEGREE: usize = 3> {
    bases: [Basis<DEGREE>; D],
    /// How far apart neighbours are on each axis.
    strides: [usize; D],
    coefficients: Vec<f64>,
}

impl<const D: usize> Spline<D> {
    /// The cubic spline through `values` at the points of a grid. The last axis is that of neighbouring
    /// values.
    ///
    /// Each axis has at least four points.
    ///
    /// # Errors
    /// What is wrong with the table, as a [`SplineError`].
    pub fn new(axes: [Axis; D], values: &[f64]) -> Result<Self, SplineError> {
        Self::through(&axes, values)
    }

    /// The cubic spline through the values of `function` at the points of a grid.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn sample(axes: [Axis; D], function: impl FnMut([f64; D]) -> f64) -> Result<Self, SplineError> {
        Self::through(&axes, &sampled(&axes, function)?)
    }
}

impl<const D: usize> Spline<D, 5> {
    /// The spline of degree 5 through `values` at the points of a grid. The last axis is that of
    /// neighbouring values.
    ///
    /// Each axis has at least six points.
    ///
    /// # Errors
    /// What is wrong with the table, as a [`SplineError`].
    pub fn quintic(axes: [Axis; D], values: &[f64]) -> Result<Self, SplineError> {
        Self::through(&axes, values)
    }

    /// The spline of degree 5 through the values of `function` at the points of a grid.
    ///
    /// # Errors
    /// Those of [`quintic`](Self::quintic).
    pub fn sample_quintic(
        axes: [Axis; D],
        function: impl FnMut([f64; D]) -> f64,
    ) -> Result<Self, SplineError> {
        Self::through(&axes, &sampled(&axes, function)?)
    }
}

impl<const D: usize, const DEGREE: usize> Spline<D, DEGREE> {
    fn through(axes: &[Axis; D], values: &[f64]) -> Result<Self, SplineError> {
        const { assert!(D > 0, "a spline has at least one variable") };
        for (axis, points) in axes.iter().enumerate() {
            let found = points.points().len();
            if found <= DEGREE {
                return Err(SplineError::TooFewPoints { axis, found, expected: DEGREE + 1 });
            }
        }
        let expected = points(axes)?;
        if values.len() != expected {
            return Err(SplineError::Count { found: values.len(), expected });
        }
        if let Some(index) = values.iter().position(|value| !value.is_finite()) {
            return Err(SplineError::NotFinite { index, value: values[index] });
        }
        let bases = axes.each_ref().map(Basis::new);
        let mut coefficients = values.to_vec();
        let mut stride = 1;
        let (mut strides, mut growths) = ([1; D], [1.0; D]);
        for (axis, points) in axes.iter().enumerate().rev() {
            let size = bases[axis].cells() + DEGREE;
            let equations = Equations::new(points, &bases[axis]);
            growths[axis] = equations.growth();
            coefficients = equations.solve_lines(&coefficients, stride, size);
            strides[axis] = stride;
            stride *= size;
        }
        let growth = growths.iter().product::<f64>();
        if growth > LARGEST_GROWTH {
            return Err(too_unequal(axes, growths, growth));
        }
        if coefficients.iter().all(|c| c.is_finite()) {
            Ok(Self { bases, strides, coefficients })
        } else {
            Err(SplineError::Overflow)
        }
    }

    /// 0, or not a number where `T` cannot hold the place of each coefficient.
    fn if_countable<T: Scalar>(&self) -> T {
        // An odd number can be held if and only if all smaller ones can.
        let odd = (self.coefficients.len() | 1) as f64;
        T::lift(odd).piecewise(|held| if held == odd { 0.0 } else { f64::NAN })
    }
}

impl<const D: usize, const DEGREE: usize> ScalarField<D> for Spline<D, DEGREE> {
    fn expansion<T: Scalar>(&self, mut at: [T; D]) -> Expansion<D, T> {
        at[0] += self.if_countable();
        let mut local = [Local::none(); D];
        for axis in 0..D {
            local[axis] = self.bases[axis].at(at[axis]);
        }
        let first = (0..D)
            .fold(T::lift(0.0), |first, axis| first + local[axis].cell * T::lift(self.strides[axis] as f64));
        let mut sum = constant(0.0);
        let functions = DEGREE + 1;
        for line in 0..functions.pow(D as u32 - 1) {
            let (mut product, mut offset, mut rest) = (constant(1.0), 0, line);
            for axis in 0..D - 1 {
                let function = rest % functions;
                rest /= functions;
                offset += function * self.strides[axis];
                multiply(&mut product, axis, local[axis].functions[function]);
            }
            let coefficient = |i: usize| {
                first.piecewise(|first| entry(&self.coefficients, first as usize + offset, functions, i))
            };
            multiply(&mut product, D - 1, combination::<DEGREE, T>(coefficient, &local[D - 1].functions));
            add(&mut sum, &product);
        }
        // So far the derivatives are those in cells of width 1.
        for i in 0..D {
            sum.gradient[i] = sum.gradient[i] * local[i].reciprocal;
            for j in 0..=i {
                sum.hessian[i][j] = sum.hessian[i][j] * (local[i].reciprocal * local[j].reciprocal);
                sum.hessian[j][i] = sum.hessian[i][j];
            }
        }
        sum
    }

    fn domain(&self) -> [(f64, f64); D] {
        core::array::from_fn(|axis| self.bases[axis].domain())
    }
}

/// Multiplies a function of the variables before `axis` by one of that variable, given with its two
/// derivatives. Of the matrix of second derivatives the lower half is computed.
fn multiply<const D: usize, T: Scalar>(f: &mut Expansion<D, T>, axis: usize, [g, dg, ddg]: [T; 3]) {
    for i in 0..axis {
        for j in 0..=i {
            f.hessian[i][j] = f.hessian[i][j] * g;
        }
        f.hessian[axis][i] = f.gradient[i] * dg;
        f.gradient[i] = f.gradient[i] * g;
    }
    f.hessian[axis][axis] = f.value * ddg;
    f.gradient[axis] = f.value * dg;
    f.value = f.value * g;
}

/// Σ cᵢ Bᵢ with its two derivatives.
fn combination<const P: usize, T: Scalar>(coefficient: impl Fn(usize) -> T, functions: &[[T; 3]]) -> [T; 3] {
    let first = coefficient(0);
    let mut sum = functions[0].map(|f| first * f);
    for (i, function) in functions.iter().enumerate().take(P + 1).skip(1) {
        let coefficient = coefficient(i);
        for (sum, f) in sum.iter_mut().zip(function) {
            *sum += coefficient * *f;
        }
    }
    sum
}

fn add<const D: usize, T: Scalar>(sum: &mut Expansion<D, T>, term: &Expansion<D, T>) {
    sum.value += term.value;
    for i in 0..D {
        sum.gradient[i] += term.gradient[i];
        for j in 0..=i {
            sum.hessian[i][j] += term.hessian[i][j];
        }
    }
}

/// The error of a grid on which rounding errors grow by the product of `growths`.
fn too_unequal<const D: usize>(axes: &[Axis; D], growths: [f64; D], growth: f64) -> SplineError {
    let axis = (0..D).fold(0, |worst, axis| if growths[axis] > growths[worst] { axis } else { worst });
    let points = axes[axis].points();
    let distance = |index: usize| points[index] - points[index - 1];
    // The smallest part of a distance beside it.
    let part = |index: usize| {
        let beside = [index.max(2) - 1, (index + 1).min(points.len() - 1)].map(distance);
        distance(index) / beside[0].max(beside[1])
    };
    let index =
        (1..points.len()).fold(1, |least, index| if part(index) < part(least) { index } else { least });
    SplineError::Unequal { axis, index, before: points[index - 1], after: points[index], growth }
}
