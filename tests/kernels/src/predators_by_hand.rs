//! The one-step midpoint scheme on Lotka–Volterra, α = ln y/x dx and H = x + y − ln x − 2 ln y, by hand:
//! Newton's method for Δ and ȳ, and for y at the end of the step.

const DEPTH: usize = 7;
const EXTRAPOLATION: [f64; DEPTH] = [7.0, -21.0, 35.0, -35.0, 21.0, -7.0, 1.0];

/// ∂L/∂x, ∂L/∂y and the derivatives that Newton's method takes, at (x, y) with the velocity v of x.
struct Second {
    theta: f64,
    f: [f64; 2],
    f_xx: f64,
    f_xy: f64,
    f_yy: f64,
    /// ∂θ/∂x and ∂θ/∂y, which are ∂²L/∂x∂v and ∂²L/∂y∂v.
    theta_q: [f64; 2],
}

#[inline(always)]
fn derivatives([x, y]: [f64; 2], v: f64) -> Second {
    let (over_x, over_y) = (1.0 / x, 1.0 / y);
    let theta = y.ln() * over_x;
    let theta_q = [-theta * over_x, over_x * over_y];
    Second {
        theta,
        f: [theta_q[0] * v - 1.0 + over_x, theta_q[1] * v - 1.0 + 2.0 * over_y],
        f_xx: -2.0 * theta_q[0] * over_x * v - over_x * over_x,
        f_xy: -theta_q[1] * over_x * v,
        f_yy: -theta_q[1] * over_y * v - 2.0 * over_y * over_y,
        theta_q,
    }
}

/// The criterion of the library: the last correction, or the next as the rate of the last two predicts it.
pub(super) struct Tolerance {
    tolerance: f64,
    previous: f64,
}

impl Tolerance {
    pub(super) fn new(scale: f64) -> Self {
        Self { tolerance: 1e-12 * scale, previous: 0.0 }
    }

    #[inline(always)]
    pub(super) fn is_met(&mut self, correction: f64) -> bool {
        let Self { tolerance, previous } = *self;
        self.previous = correction;
        correction <= tolerance
            || (correction < previous && correction * correction <= tolerance * (previous - correction))
    }
}

pub(crate) struct OneStepMidpoint {
    h: f64,
    p: f64,
    pub(crate) q: [f64; 2],
    /// Mean rates of change of x and of y to ȳ.
    ring: [[f64; 2]; DEPTH],
    newest: usize,
}

impl OneStepMidpoint {
    pub(crate) fn new(h: f64, q: [f64; 2]) -> Self {
        let [x, y] = q;
        let mut scheme = Self { h, p: y.ln() / x, q, ring: [[0.0; 2]; DEPTH], newest: 0 };
        let mut rates = [x * (y - 2.0), y * (1.0 - x)];
        for _ in 0..DEPTH {
            rates = scheme.step_from(rates);
        }
        scheme
    }

    #[inline(always)]
    pub(crate) fn step(&mut self) {
        let mut rates = [0.0; 2];
        let mut place = self.newest;
        for coefficient in EXTRAPOLATION {
            place = if place == 0 { DEPTH - 1 } else { place - 1 };
            rates = [0, 1].map(|i| rates[i] + coefficient * self.ring[place][i]);
        }
        self.step_from(rates);
    }

    #[inline(always)]
    fn step_from(&mut self, rates: [f64; 2]) -> [f64; 2] {
        let Self { h, p, q: [x, y], .. } = *self;
        let (mut delta, mut middle) = (h * rates[0], y + 0.5 * h * rates[1]);
        let mut tolerance = Tolerance::new(x.abs().max(y.abs()).max(delta.abs().max(middle.abs())));
        loop {
            let Second { theta, f, f_xx, f_xy, f_yy, theta_q } =
                derivatives([x + 0.5 * delta, middle], delta / h);
            let mut r = [theta - 0.5 * h * f[0] - p, -0.5 * h * f[1]];
            let a = [
                -0.25 * h * f_xx + 0.5 * theta_q[0] - 0.5 * theta_q[0],
                theta_q[1] - 0.5 * h * f_xy,
                -0.25 * h * f_xy - 0.5 * theta_q[1],
                -0.5 * h * f_yy,
            ];
            let determinant = 1.0 / (a[0] * a[3] - a[1] * a[2]);
            r = [(a[3] * r[0] - a[1] * r[1]) * determinant, (a[0] * r[1] - a[2] * r[0]) * determinant];
            delta -= r[0];
            middle -= r[1];
            if tolerance.is_met(r[0].abs().max(r[1].abs())) {
                break;
            }
        }
        let Second { f, .. } = derivatives([x + 0.5 * delta, middle], delta / h);
        self.p += h * f[0];
        let end = x + delta;
        let mut last = 2.0 * middle - y;
        let mut tolerance = Tolerance::new(end.abs().max(last.abs()));
        loop {
            let correction = (last.ln() / end - self.p) * (end * last);
            last -= correction;
            if tolerance.is_met(correction.abs()) {
                break;
            }
        }
        self.q = [end, last];
        let rates = [delta / h, 2.0 * (middle - y) / h];
        self.ring[self.newest] = rates;
        self.newest = if self.newest + 1 < DEPTH { self.newest + 1 } else { 0 };
        rates
    }
}
