//! Systems with forces, and their motion by a program of its own: the classical Runge-Kutta method in steps
//! far below those under test, on equations of motion that were derived by hand.

use dvi_core::prelude::*;

/// A particle in a potential V(r) = r²(r² − 1)² with linear friction: the test case of the lectures of
/// Marsden and West's method.
#[lagrangian(
    coordinates(x, y),
    lagrangian = {
        let r2 = x * x + y * y;
        (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - r2 * (r2 - 1.0).powi(2)
    },
    force = [-gamma * dot(x), -gamma * dot(y)],
    momenta(l = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Damped {
    pub(crate) gamma: f64,
}

/// Arrays, a mass that depends on the position, and forces that depend on all there is.
#[lagrangian(
    coordinates(u, z[2]),
    lagrangian = (1.0 + u * u / 2.0) * dot(u).powi(2) / 2.0 + sum(0..2, |i| dot(z[i]).powi(2) / 2.0)
        - u.powi(4) / 4.0 - sum(0..2, |i| (z[i] - u).powi(2) / 2.0),
    force(z) = |i| 0.3 * t.cos() - 0.2 * dot(z[i]) * (1.0 + dot(z[(i + 1) % 2]).powi(2)) - 0.1 * drag[i] * dot(u),
    force(u) = -0.4 * dot(u) * (1.0 + z[0] * z[1]),
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Driven {
    pub(crate) drag: [f64; 2],
}

/// A force that is no gradient and no function of velocities, on a system whose step is explicit.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + 2.0 * dot(y).powi(2)) / 2.0 - x.powi(2) / 2.0 - y.powi(4) / 4.0,
    force = [-swirl * y * t.cos(), swirl * x],
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swirl {
    pub(crate) swirl: f64,
}

/// A pendulum with friction, driven, in phase space.
#[degenerate_lagrangian(
    coordinates(q, p),
    one_form = p * d(q),
    hamiltonian = p * p / 2.0 - q.cos(),
    force(q) = -gamma * p + 0.5 * (2.0 * t).cos(),
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pendulum {
    pub(crate) gamma: f64,
}

/// Predators y and prey x, of which some are taken away, in a form that is not affine.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y.ln() / x * d(x),
    hamiltonian = x - x.ln() + y - 2.0 * y.ln(),
    force = [-harvest * x / (1.0 + x * y), harvest * (x - 0.3 * y * y)],
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Harvested {
    pub(crate) harvest: f64,
}

/// y at time `to`, from `y` at time 0.
pub(crate) fn motion<const N: usize>(
    mut y: [f64; N],
    to: f64,
    rate: impl Fn(&[f64; N], f64) -> [f64; N],
) -> [f64; N] {
    let steps = 20_000;
    let h = to / f64::from(steps);
    for step in 0..steps {
        let t = f64::from(step) * h;
        let moved = |k: &[f64; N], part: f64| core::array::from_fn(|i| y[i] + part * h * k[i]);
        let k1 = rate(&y, t);
        let k2 = rate(&moved(&k1, 0.5), t + 0.5 * h);
        let k3 = rate(&moved(&k2, 0.5), t + 0.5 * h);
        let k4 = rate(&moved(&k3, 1.0), t + h);
        y = core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    y
}

/// Values in the order of a state, and their rates.
pub(crate) trait ByHand<const N: usize>: System {
    fn start() -> [f64; N];
    fn state(values: [f64; N]) -> Self::State<f64>;
    fn rate(&self, values: &[f64; N], t: f64) -> [f64; N];
}

impl ByHand<4> for Damped {
    fn start() -> [f64; 4] {
        [1.2, 0.0, 0.1, 0.9]
    }
    fn state([x, y, dot_x, dot_y]: [f64; 4]) -> DampedState {
        DampedState { x, y, dot_x, dot_y }
    }
    fn rate(&self, &[x, y, u, v]: &[f64; 4], _t: f64) -> [f64; 4] {
        let s = x * x + y * y;
        let slope = 2.0 * ((s - 1.0).powi(2) + 2.0 * s * (s - 1.0));
        [u, v, -slope * x - self.gamma * u, -slope * y - self.gamma * v]
    }
}

impl ByHand<6> for Driven {
    fn start() -> [f64; 6] {
        [0.3, -0.2, 0.5, 0.4, 0.6, 0.7]
    }
    fn state([u, z0, z1, dot_u, dot_z0, dot_z1]: [f64; 6]) -> DrivenState {
        DrivenState { u, z: [z0, z1], dot_u, dot_z: [dot_z0, dot_z1] }
    }
    fn rate(&self, &[u, z0, z1, du, d0, d1]: &[f64; 6], t: f64) -> [f64; 6] {
        let force_u = -0.4 * du * (1.0 + z0 * z1);
        // d/dt (m u̇) = m ü + u u̇², and ∂L/∂u = u u̇²/2 − V′.
        let by_u = u * du * du / 2.0 - u.powi(3) + (z0 - u) + (z1 - u) + force_u;
        let a = (by_u - u * du * du) / (1.0 + u * u / 2.0);
        let common = 0.3 * t.cos();
        let a0 = -(z0 - u) + common - 0.2 * d0 * (1.0 + d1 * d1) - 0.1 * self.drag[0] * du;
        let a1 = -(z1 - u) + common - 0.2 * d1 * (1.0 + d0 * d0) - 0.1 * self.drag[1] * du;
        [du, d0, d1, a, a0, a1]
    }
}

impl ByHand<4> for Swirl {
    fn start() -> [f64; 4] {
        [0.7, 0.4, -0.2, 0.5]
    }
    fn state([x, y, dot_x, dot_y]: [f64; 4]) -> SwirlState {
        SwirlState { x, y, dot_x, dot_y }
    }
    fn rate(&self, &[x, y, u, v]: &[f64; 4], t: f64) -> [f64; 4] {
        [u, v, -x - self.swirl * y * t.cos(), (-y.powi(3) + self.swirl * x) / 2.0]
    }
}

impl ByHand<2> for Pendulum {
    fn start() -> [f64; 2] {
        [1.0, 0.4]
    }
    fn state([q, p]: [f64; 2]) -> PendulumState {
        PendulumState { q, p }
    }
    fn rate(&self, &[q, p]: &[f64; 2], t: f64) -> [f64; 2] {
        [p, -q.sin() - self.gamma * p + 0.5 * (2.0 * t).cos()]
    }
}

impl ByHand<2> for Harvested {
    fn start() -> [f64; 2] {
        [1.4, 1.7]
    }
    fn state([x, y]: [f64; 2]) -> HarvestedState {
        HarvestedState { x, y }
    }
    fn rate(&self, &[x, y]: &[f64; 2], _t: f64) -> [f64; 2] {
        // With α = ln(y)/x dx: ẏ/(xy) = −∂H/∂x + F_x and ẋ/(xy) = ∂H/∂y − F_y.
        let force = [-self.harvest * x / (1.0 + x * y), self.harvest * (x - 0.3 * y * y)];
        [x * y * (1.0 - 2.0 / y - force[1]), x * y * (1.0 / x - 1.0 + force[0])]
    }
}
