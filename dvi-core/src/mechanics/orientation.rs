//! Whether Ω and the mass matrix keep their orientation from step to step.
//!
//! Where Ω or ∂²L/∂v∂v is singular, the motion is not determined, and no step may pass: on the other side
//! there is another system. A step that jumps over such a place finds regular matrices at both ends, but
//! another number of negative eigenvalues of the mass matrix, or another sign of the Pfaffian of Ω. Two
//! passages within one step are not seen, nor eigenvalues of a mass matrix that change their signs in
//! opposite directions, nor two pivots of Ω that vanish together, unless Ω couples the coordinates in pairs,
//! whose entries are compared one by one.
//!
//! The Pfaffian comes from skew elimination, A = P L T Lᵀ Pᵀ (Wimmer 2012, ACM TOMS 38, algorithm 923).

use crate::error::StepFailure;
use crate::memory::lasting;
use crate::scalar::norm::reported;
use crate::space::inertia::{Inertia, inertia};
use crate::space::scratch;
use crate::{
    DegenerateLagrangian, Matrix, NondegenerateLagrangian, Real, Scalar, Space, System, Vector, Weights,
};

/// Ω at the end of the last step, and at the point that was compared with it last. If it is the same
/// everywhere, nothing is compared.
#[derive(Debug)]
pub(crate) struct FormOrientation<S: System, T: Real> {
    /// The entry of each row, where Ω couples the coordinates in pairs.
    entries: Vector<S, T>,
    next: Vector<S, T>,
    /// Where it does not.
    pfaffian: Option<Pfaffian<S, T>>,
}

/// The sign of the Pfaffian times the smallest pivot, and storage.
#[derive(Debug)]
struct Pfaffian<S: System, T: Real> {
    last: T,
    next: T,
    matrix: Matrix<S, T>,
}

impl<S: DegenerateLagrangian<T>, T: Real> FormOrientation<S, T> {
    /// At (`q`, `t`).
    pub(crate) fn new(system: &S, q: &[T], t: T) -> Self {
        let space = system.space();
        let [mut entries, next]: [Vector<S, T>; 2] = space.vectors();
        if !S::AFFINE && S::CANONICAL {
            system.conjugate_entries(q, t, T::lift(-1.0), T::lift(1.0), &mut entries);
        }
        let pfaffian = (!S::AFFINE && !S::CANONICAL).then(|| {
            let mut matrix = space.matrix();
            let last = pfaffian(system, q, t, &mut matrix);
            Pfaffian { last, next: last, matrix }
        });
        Self { entries, next, pfaffian }
    }

    /// The Pfaffian, of which the compiler knows where there is none.
    fn pfaffian(&mut self) -> Option<&mut Pfaffian<S, T>> {
        if S::CANONICAL { None } else { self.pfaffian.as_mut() }
    }

    /// Compares Ω at points and times `within` a step and at its `end` with the last, and keeps that at the
    /// end.
    ///
    /// # Errors
    /// [`StepFailure::Orientation`]; the last is kept then.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn pass(
        &mut self,
        system: &S,
        within: &[(&[T], T)],
        (q1, t1): (&[T], T),
    ) -> Result<(), StepFailure> {
        for &(q, t) in within {
            self.compare(system, q, t)?;
        }
        self.compare(system, q1, t1)?;
        if let Some(Pfaffian { last, next, .. }) = self.pfaffian() {
            *last = *next;
        } else if !S::AFFINE {
            self.entries.copy_from_slice(&self.next);
        }
        Ok(())
    }

    /// Compares Ω at (`q`, `t`), within a step, with the last.
    ///
    /// # Errors
    /// [`StepFailure::Orientation`].
    #[inline]
    pub(crate) fn compare(&mut self, system: &S, q: &[T], t: T) -> Result<(), StepFailure> {
        if S::AFFINE {
            return Ok(());
        }
        let Some(Pfaffian { last, next, matrix }) = self.pfaffian() else {
            return compare_pairs(system, q, t, &self.entries, &mut self.next);
        };
        *next = pfaffian(system, q, t, matrix);
        compare(*last, *next)
    }
}

#[inline(never)]
fn pfaffian<S: DegenerateLagrangian<T>, T: Real>(system: &S, q: &[T], t: T, matrix: &mut Matrix<S, T>) -> T {
    matrix.fill(T::lift(0.0));
    system.one_form_jacobian(q, t, T::lift(-1.0), T::lift(1.0), matrix);
    pfaffian_sign(matrix, system.space().dimension())
}

/// Sets `next` to the entries of Ω at (`q`, `t`), and compares them with the last.
#[inline]
fn compare_pairs<S: DegenerateLagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    t: T,
    entries: &[T],
    next: &mut [T],
) -> Result<(), StepFailure> {
    system.conjugate_entries(q, t, T::lift(-1.0), T::lift(1.0), next);
    // Ω is skew: the other row of a pair has the same entry with the other sign.
    for i in (0..entries.len()).filter(|&i| system.conjugate(i) < i) {
        // Where a formula has left its domain there is no Ω.
        compare(entries[i], next[i]).map_err(|failure| {
            if next[i].is_finite() {
                failure
            } else {
                StepFailure::NotFinite { coordinate: i, value: reported(next[i]) }
            }
        })?;
    }
    Ok(())
}

lasting!([S: System, T: Real] FormOrientation<S, T>, T; numbers entries, parts pfaffian);

lasting!([S: System, T: Real] Pfaffian<S, T>, T; number last);

/// The sign of the Pfaffian of a skew n×n matrix times its smallest pivot, zero if it is singular.
fn pfaffian_sign<T: Real>(a: &mut [T], n: usize) -> T {
    let (mut sign, mut smallest) = (T::lift(1.0), None);
    for k in (0..n).step_by(2) {
        let candidates = k + 1..n;
        let best = |best: usize, i: usize| {
            if Scalar::abs(a[i * n + k]) > Scalar::abs(a[best * n + k]) { i } else { best }
        };
        // Of a space of odd dimension the last row has no conjugate.
        let Some(row) = candidates.reduce(best) else { return T::lift(0.0) };
        if row != k + 1 {
            for j in 0..n {
                a.swap(row * n + j, (k + 1) * n + j);
            }
            for i in 0..n {
                a.swap(i * n + row, i * n + k + 1);
            }
            sign = -sign;
        }
        let pivot = a[k * n + k + 1];
        let size = Scalar::abs(pivot);
        if pivot < T::lift(0.0) {
            sign = -sign;
        }
        smallest = Some(smallest.map_or(size, |least: T| if least < size { least } else { size }));
        for i in k + 2..n {
            for j in k + 2..n {
                let update = a[k * n + i] * a[j * n + k + 1] - a[k * n + j] * a[i * n + k + 1];
                a[i * n + j] += update / pivot;
            }
        }
    }
    sign * smallest.unwrap_or(T::lift(1.0))
}

/// The mass matrix at the end of the last step, and storage.
#[derive(Debug)]
pub(crate) struct MassOrientation<S: System, T: Real> {
    inertia: Inertia<T>,
    work: Work<S, T>,
}

#[derive(Debug)]
struct Work<S: System, T: Real> {
    entries: Entries<S, T>,
    l_q: Vector<S, T>,
    l_v: Vector<S, T>,
}

/// The entries of a mass matrix.
#[derive(Debug)]
enum Entries<S: System, T: Real> {
    Diagonal(Vector<S, T>),
    All(Matrix<S, T>),
}

impl<S: NondegenerateLagrangian<T>, T: Real> MassOrientation<S, T> {
    /// At (`q`, `v`, `t`).
    ///
    /// # Errors
    /// [`StepFailure::Singular`].
    pub(crate) fn new(system: &S, q: &[T], v: &[T], t: T) -> Result<Self, StepFailure> {
        let space = system.space();
        let entries =
            if S::DIAGONAL_MASS { Entries::Diagonal(space.vector()) } else { Entries::All(space.matrix()) };
        let mut work = Work { entries, l_q: space.vector(), l_v: space.vector() };
        Ok(Self { inertia: work.evaluate(system, q, v, t)?, work })
    }

    /// Compares the mass matrix at (`q`, `v`, `t`), the end of a step, with the last, and keeps it.
    ///
    /// # Errors
    /// [`StepFailure::Singular`] and [`StepFailure::Orientation`]; the last is kept then.
    pub(crate) fn check(&mut self, system: &S, q: &[T], v: &[T], t: T) -> Result<(), StepFailure> {
        let after = self.work.evaluate(system, q, v, t)?;
        keep(&mut self.inertia, after)
    }
}

/// Replaces the inertia of a mass matrix by that at the end of a step.
///
/// # Errors
/// [`StepFailure::Orientation`] if another number of eigenvalues is negative; the last is kept then.
pub(crate) fn keep<T: Real>(last: &mut Inertia<T>, after: Inertia<T>) -> Result<(), StepFailure> {
    if after.negative == last.negative {
        *last = after;
        return Ok(());
    }
    // Those that crossed zero went from one side to the other.
    let [from, to] = if after.negative > last.negative { [0, 1] } else { [1, 0] };
    let [before, after] = [last.least[from], after.least[to]].map(reported);
    Err(StepFailure::Orientation { matrix: "the mass matrix", before, after })
}

lasting!([S: System, T: Real] MassOrientation<S, T>, T; part inertia);

impl<S: NondegenerateLagrangian<T>, T: Real> Work<S, T> {
    fn evaluate(&mut self, system: &S, q: &[T], v: &[T], t: T) -> Result<Inertia<T>, StepFailure> {
        let (zero, Self { entries, l_q, l_v }) = (T::lift(0.0), self);
        let weights = Weights::mass();
        // The gradients are not needed: on the stack, where nobody reads them, they are not computed.
        scratch!(gradient = system, *l_q);
        scratch!(momentum = system, *l_v);
        match entries {
            Entries::Diagonal(diagonal) => {
                diagonal.fill(zero);
                let mut sink = |row: usize, column: usize, entry: T| {
                    if row == column {
                        diagonal[row] += entry;
                    }
                };
                system.linearize(q, v, t, weights, gradient, momentum, &mut sink);
                Inertia::of_diagonal(diagonal)
            }
            Entries::All(matrix) => {
                matrix.fill(zero);
                system.linearize(q, v, t, weights, gradient, momentum, matrix);
                inertia(matrix, l_q)
            }
        }
    }
}

#[inline]
fn compare<T: Real>(before: T, after: T) -> Result<(), StepFailure> {
    if before * after > T::lift(0.0) { Ok(()) } else { compare_signs(before, after) }
}

/// The same where the product may have underflowed, or is none.
#[cold]
#[inline(never)]
fn compare_signs<T: Real>(before: T, after: T) -> Result<(), StepFailure> {
    // What is not a number has no sign. A matrix that was singular has none to lose.
    let zero = T::lift(0.0);
    let same = (before > zero && after > zero) || (before < zero && after < zero);
    if same || before == zero {
        return Ok(());
    }
    let [before, after] = [before, after].map(reported);
    Err(StepFailure::Orientation { matrix: "Ω", before, after })
}

#[cfg(test)]
mod tests {
    use super::pfaffian_sign;

    /// a f − b e + c d is the Pfaffian of the skew matrix with the upper rows (a b c), (d e), (f).
    #[test]
    fn the_sign_is_that_of_the_pfaffian() {
        let mut seen = [0; 2];
        for seed in 0..100_u32 {
            let entry = |k: u32| f64::from((seed * 7 + k * 13 + seed * k * 5) % 19) - 9.0;
            let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(entry);
            let exact = a * f - b * e + c * d;
            if exact == 0.0 {
                continue;
            }
            #[rustfmt::skip]
            let mut matrix = [
                0.0,  a,   b,   c,
                -a,  0.0,  d,   e,
                -b,  -d,  0.0,  f,
                -c,  -e,  -f,  0.0,
            ];
            assert_eq!(pfaffian_sign(&mut matrix, 4) > 0.0, exact > 0.0, "seed {seed}");
            seen[usize::from(exact > 0.0)] += 1;
        }
        assert!(seen[0] > 10 && seen[1] > 10, "{seen:?}");
        assert_eq!(pfaffian_sign(&mut [0.0, -2.0, 2.0, 0.0], 2), -2.0);
        assert_eq!(pfaffian_sign(&mut [0.0], 1), 0.0);
    }
}
