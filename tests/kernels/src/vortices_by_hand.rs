//! Four vortices as an expert would write them: flat arrays, one reciprocal per pair, constants
//! precomputed, the same schemes and stopping rules as the generated ones.

use std::f64::consts::PI;

/// The coordinates x0..x3, y0..y3.
pub type State = [f64; 8];

/// z' = f(z).
#[derive(Clone, Debug)]
pub struct Field {
    /// Γ/2π
    strength: [f64; 4],
}

impl Field {
    /// The field of vortices with these circulations.
    pub fn new(gamma: [f64; 4]) -> Self {
        Self { strength: gamma.map(|gamma| gamma / (2.0 * PI)) }
    }

    /// f(z)
    #[inline(always)]
    pub fn velocity(&self, z: &State) -> State {
        let mut v = [0.0; 8];
        for j in 0..4 {
            for k in j + 1..4 {
                let (dx, dy) = (z[j] - z[k], z[4 + j] - z[4 + k]);
                let inverse = 1.0 / (dx * dx + dy * dy);
                let (from_j, from_k) = (self.strength[j] * inverse, self.strength[k] * inverse);
                v[j] -= from_k * dy;
                v[4 + j] += from_k * dx;
                v[k] += from_j * dy;
                v[4 + k] -= from_j * dx;
            }
        }
        v
    }

    /// The velocity, and 1 − (h/2) Df.
    #[inline(always)]
    pub(crate) fn newton_matrix(&self, z: &State, half: f64) -> (State, [State; 8]) {
        let mut v = [0.0; 8];
        let mut m = [[0.0; 8]; 8];
        for i in 0..8 {
            m[i][i] = 1.0;
        }
        for j in 0..4 {
            for k in j + 1..4 {
                let (dx, dy) = (z[j] - z[k], z[4 + j] - z[4 + k]);
                let (x2, y2) = (dx * dx, dy * dy);
                let inverse = 1.0 / (x2 + y2);
                // ∂(dy/r²)/∂x and ∂(dx/r²)/∂x, times h/2.
                let square = half * inverse * inverse;
                let (cross, difference) = (2.0 * dx * dy * square, (y2 - x2) * square);
                for (a, b, sign) in [(j, k, 1.0), (k, j, -1.0)] {
                    let strength = self.strength[b];
                    v[a] -= sign * strength * inverse * dy;
                    v[4 + a] += sign * strength * inverse * dx;
                    // Row x: −Γ dy/r²; row y: Γ dx/r².
                    m[a][a] -= strength * cross;
                    m[a][b] += strength * cross;
                    m[a][4 + a] -= strength * difference;
                    m[a][4 + b] += strength * difference;
                    m[4 + a][a] -= strength * difference;
                    m[4 + a][b] += strength * difference;
                    m[4 + a][4 + a] += strength * cross;
                    m[4 + a][4 + b] -= strength * cross;
                }
            }
        }
        (v, m)
    }
}

/// z_{k+2} = z_k + 2h f(z_{k+1}).
pub(crate) struct Leapfrog {
    field: Field,
    h: f64,
    earlier: State,
    pub(crate) z: State,
}

impl Leapfrog {
    pub(crate) fn new(field: Field, h: f64, z: State) -> Self {
        let first = field.velocity(&z);
        let middle = std::array::from_fn(|i| z[i] + h / 2.0 * first[i]);
        let velocity = field.velocity(&middle);
        Self { field, h, earlier: z, z: std::array::from_fn(|i| z[i] + h * velocity[i]) }
    }

    #[inline(always)]
    pub(crate) fn step(&mut self) {
        let v = self.field.velocity(&self.z);
        let next = std::array::from_fn(|i| self.earlier[i] + 2.0 * self.h * v[i]);
        self.earlier = self.z;
        self.z = next;
    }
}

const DEPTH: usize = 7;
const EXTRAPOLATION: [f64; DEPTH] = [7.0, -21.0, 35.0, -35.0, 21.0, -7.0, 1.0];

/// The implicit midpoint rule with the increment extrapolated from the last seven.
pub(crate) struct Midpoint {
    field: Field,
    h: f64,
    ring: [State; DEPTH],
    newest: usize,
    pub(crate) z: State,
}

impl Midpoint {
    pub(crate) fn new(field: Field, h: f64, z: State) -> Self {
        let mut midpoint = Self { field, h, ring: [[0.0; 8]; DEPTH], newest: 0, z };
        let mut guess = midpoint.field.velocity(&z).map(|v| h * v);
        for _ in 0..DEPTH {
            guess = midpoint.fixed_point(guess);
            midpoint.accept(guess);
        }
        midpoint
    }

    #[inline(always)]
    fn guess(&self) -> State {
        let mut guess = [0.0; 8];
        let mut place = self.newest;
        for coefficient in EXTRAPOLATION {
            place = if place == 0 { DEPTH - 1 } else { place - 1 };
            for i in 0..8 {
                guess[i] += coefficient * self.ring[place][i];
            }
        }
        guess
    }

    #[inline(always)]
    fn accept(&mut self, increment: State) {
        self.z = std::array::from_fn(|i| self.z[i] + increment[i]);
        self.ring[self.newest] = increment;
        self.newest = if self.newest + 1 < DEPTH { self.newest + 1 } else { 0 };
    }

    #[inline(always)]
    fn tolerance(&self, increment: &State) -> f64 {
        1e-12 * (largest(&self.z) + largest(increment))
    }

    #[inline(always)]
    fn fixed_point(&self, mut increment: State) -> State {
        let tolerance = self.tolerance(&increment);
        let mut previous = 0.0;
        loop {
            let middle = std::array::from_fn(|i| self.z[i] + 0.5 * increment[i]);
            let v = self.field.velocity(&middle);
            let next = std::array::from_fn(|i| self.h * v[i]);
            let correction = distance(&next, &increment);
            increment = next;
            let predicted =
                correction < previous && correction * correction <= tolerance * (previous - correction);
            if correction <= tolerance || predicted {
                return increment;
            }
            previous = correction;
        }
    }

    #[inline(always)]
    pub(crate) fn step_by_fixed_point(&mut self) {
        let increment = self.fixed_point(self.guess());
        self.accept(increment);
    }

    #[inline(always)]
    pub(crate) fn step_by_newton(&mut self) {
        let mut increment = self.guess();
        let tolerance = self.tolerance(&increment);
        let mut previous = 0.0;
        loop {
            let middle = std::array::from_fn(|i| self.z[i] + 0.5 * increment[i]);
            let (v, mut m) = self.field.newton_matrix(&middle, self.h / 2.0);
            let mut r = std::array::from_fn(|i| self.h * v[i] - increment[i]);
            eliminate(&mut m, &mut r);
            let correction = largest(&r);
            increment = std::array::from_fn(|i| increment[i] + r[i]);
            let predicted =
                correction < previous && correction * correction <= tolerance * (previous - correction);
            if correction <= tolerance || predicted {
                break;
            }
            previous = correction;
        }
        self.accept(increment);
    }
}

#[inline(always)]
fn largest(z: &State) -> f64 {
    z.iter().fold(0.0, |largest, z| if z.abs() > largest { z.abs() } else { largest })
}

#[inline(always)]
fn distance(a: &State, b: &State) -> f64 {
    largest(&std::array::from_fn(|i| a[i] - b[i]))
}

/// Gaussian elimination with partial pivoting.
#[inline(always)]
fn eliminate(m: &mut [State; 8], r: &mut State) {
    for column in 0..8 {
        let mut pivot = column;
        for row in column + 1..8 {
            if m[row][column].abs() > m[pivot][column].abs() {
                pivot = row;
            }
        }
        m.swap(column, pivot);
        r.swap(column, pivot);
        let inverse = 1.0 / m[column][column];
        for row in column + 1..8 {
            let factor = m[row][column] * inverse;
            for i in column + 1..8 {
                m[row][i] -= factor * m[column][i];
            }
            r[row] -= factor * r[column];
        }
    }
    for row in (0..8).rev() {
        for i in row + 1..8 {
            r[row] -= m[row][i] * r[i];
        }
        r[row] /= m[row][row];
    }
}
