//! Kepler's problem as an expert would write it, with the same schemes and stopping rules as the generated
//! ones.

pub(crate) type Point = [f64; 2];

fn acceleration([x, y]: Point) -> Point {
    let square = x * x + y * y;
    let factor = -1.0 / (square * square.sqrt());
    [factor * x, factor * y]
}

/// Störmer–Verlet: kick, drift, kick.
pub(crate) struct Verlet {
    h: f64,
    pub(crate) q: Point,
    p: Point,
    a: Point,
}

impl Verlet {
    pub(crate) fn new(h: f64, q: Point, p: Point) -> Self {
        Self { h, q, p, a: acceleration(q) }
    }

    #[inline(always)]
    pub(crate) fn step(&mut self) {
        let half = 0.5 * self.h;
        for i in 0..2 {
            self.p[i] += half * self.a[i];
            self.q[i] += self.h * self.p[i];
        }
        self.a = acceleration(self.q);
        for i in 0..2 {
            self.p[i] += half * self.a[i];
        }
    }
}

const DEPTH: usize = 7;
const EXTRAPOLATION: [f64; DEPTH] = [7.0, -21.0, 35.0, -35.0, 21.0, -7.0, 1.0];

/// The rule for the frequency at a point.
#[derive(Clone, Copy)]
pub(crate) enum Frequency {
    /// √(|a|/|q|), from the acceleration.
    Radial,
    /// r^(−3/2), which is what it comes to.
    Power,
}

/// Simpson's rule with the interpolation fitted to the mean of the frequencies at both ends.
pub(crate) struct FittedSimpson {
    frequency: Frequency,
    h: f64,
    tolerance: f64,
    pub(crate) q: Point,
    p: Point,
    end: End,
    ring: [Point; DEPTH],
    newest: usize,
}

/// Force and frequency at a point.
#[derive(Clone, Copy)]
struct End {
    force: Point,
    omega: f64,
}

impl End {
    #[inline(always)]
    fn at([x, y]: Point, frequency: Frequency) -> Self {
        let square = x * x + y * y;
        let cube = 1.0 / (square * square.sqrt());
        let force = [-cube * x, -cube * y];
        let omega = match frequency {
            Frequency::Radial => ((force[0] * force[0] + force[1] * force[1]) / square).sqrt().sqrt(),
            Frequency::Power => cube.sqrt(),
        };
        Self { force, omega }
    }
}

/// What one frequency makes of the step.
struct Coefficients {
    /// b = b̄ at the middle.
    middle: f64,
    /// K
    mixed: f64,
    /// A − K = C − K
    excess: f64,
    /// u/sin u times S
    stiffness: f64,
}

impl Coefficients {
    #[inline(always)]
    fn new(u: f64) -> Self {
        let (half_sine, half_cosine) = (0.5 * u).sin_cos();
        let (sine, cosine) = (2.0 * half_sine * half_cosine, 1.0 - 2.0 * half_sine * half_sine);
        let ratio = u / sine;
        let middle = 0.5 / half_cosine;
        // B = −ratio cos u, B̄ = ratio at the left end; mirrored at the right; ∓ratio cos(u/2) in the
        // middle.
        let at_middle = ratio * half_cosine;
        let mixed = ratio * ratio * cosine / 3.0 + 2.0 / 3.0 * at_middle * at_middle;
        let excess =
            ratio * ratio * (cosine * cosine + 1.0) / 6.0 + 2.0 / 3.0 * at_middle * at_middle - mixed;
        Self { middle, mixed, excess, stiffness: ratio * (2.0 + cosine) / 3.0 }
    }
}

impl FittedSimpson {
    pub(crate) fn new(frequency: Frequency, h: f64, tolerance: f64, q: Point, p: Point) -> Self {
        let end = End::at(q, frequency);
        let mut run = Self { frequency, h, tolerance, q, p, end, ring: [[0.0; 2]; DEPTH], newest: 0 };
        for _ in 0..DEPTH {
            let guess = [h * run.p[0], h * run.p[1]];
            run.step_from(guess);
        }
        run
    }

    #[inline(always)]
    pub(crate) fn step(&mut self) {
        let mut guess = [0.0; 2];
        let mut place = self.newest;
        for coefficient in EXTRAPOLATION {
            place = if place == 0 { DEPTH - 1 } else { place - 1 };
            for i in 0..2 {
                guess[i] += coefficient * self.ring[place][i];
            }
        }
        self.step_from(guess);
    }

    #[inline(always)]
    fn step_from(&mut self, mut delta: Point) {
        let (h, start) = (self.h, self.end);
        let tolerance = self.tolerance * (largest(self.q) + largest(delta));
        let mut previous = 0.0;
        loop {
            let q1 = [self.q[0] + delta[0], self.q[1] + delta[1]];
            let end = End::at(q1, self.frequency);
            let of_step = Coefficients::new(0.5 * (start.omega + end.omega) * h);
            let middle =
                acceleration([of_step.middle * (self.q[0] + q1[0]), of_step.middle * (self.q[1] + q1[1])]);
            let mut change = [0.0; 2];
            for i in 0..2 {
                let impulse = h * (start.force[i] / 6.0 + 2.0 / 3.0 * of_step.middle * middle[i]);
                let residual =
                    h * (self.p[i] + impulse) + of_step.excess * self.q[i] - of_step.mixed * delta[i];
                change[i] = residual / of_step.stiffness;
                delta[i] += change[i];
            }
            let correction = largest(change);
            let predicted =
                correction < previous && correction * correction <= tolerance * (previous - correction);
            if correction <= tolerance || predicted {
                break;
            }
            previous = correction;
        }
        self.finish(delta);
    }

    #[inline(always)]
    fn finish(&mut self, delta: Point) {
        let (h, start) = (self.h, self.end);
        let q1 = [self.q[0] + delta[0], self.q[1] + delta[1]];
        let end = End::at(q1, self.frequency);
        let of_step = Coefficients::new(0.5 * (start.omega + end.omega) * h);
        let middle =
            acceleration([of_step.middle * (self.q[0] + q1[0]), of_step.middle * (self.q[1] + q1[1])]);
        for i in 0..2 {
            let impulse = (start.force[i] + end.force[i]) / 6.0 + 4.0 / 3.0 * of_step.middle * middle[i];
            self.p[i] += h * impulse + of_step.excess * (self.q[i] + q1[i]) / h;
        }
        self.q = q1;
        self.end = end;
        self.ring[self.newest] = delta;
        self.newest = if self.newest + 1 < DEPTH { self.newest + 1 } else { 0 };
    }
}

#[inline(always)]
fn largest([x, y]: Point) -> f64 {
    if x.abs() > y.abs() { x.abs() } else { y.abs() }
}
