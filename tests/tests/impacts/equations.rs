//! The equations of motion of the systems, by hand.

use dvi_tests::zoo::impacts::{Bowl, Fast, Table, Wavy};

use super::reference::ByHand;

impl ByHand<2> for Wavy {
    fn acceleration(&self, [x, y]: [f64; 2], _: [f64; 2], _: f64) -> [f64; 2] {
        [-0.3 * x - 0.4 * x.powi(3) - 0.3 * x * y * y, -1.0 - 0.3 * x * x * y]
    }
    fn gap(&self, [x, y]: [f64; 2], _: f64) -> f64 {
        y - self.a * x.cos()
    }
    fn reflected(&self, [x, _]: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        let [nx, ny] = [self.a * x.sin(), 1.0];
        let change = 2.0 * (u * nx + w * ny) / (nx * nx + ny * ny);
        [u - change * nx, w - change * ny]
    }
}

impl ByHand<2> for Bowl {
    fn acceleration(&self, [x, y]: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        let (m, c, b) = (1.0 + 0.2 * y * y, 0.3, self.b);
        // m x'' + c y'' + 0.4 y u w − b w = −x and c x'' + y'' − 0.2 y u² + b u = −1.6 y
        let (f, g) = (-x - 0.4 * y * u * w + b * w, -1.6 * y + 0.2 * y * u * u - b * u);
        let d = m - c * c;
        [(f - c * g) / d, (m * g - c * f) / d]
    }
    fn gap(&self, [x, y]: [f64; 2], _: f64) -> f64 {
        (1.0 - x * x - 0.5 * y * y).min(y + 0.7)
    }
    fn reflected(&self, [x, y]: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        let n = if 1.0 - x * x - 0.5 * y * y < y + 0.7 { [-2.0 * x, -y] } else { [0.0, 1.0] };
        let (m, c) = (1.0 + 0.2 * y * y, 0.3);
        let d = m - c * c;
        // M⁻¹n
        let k = [(n[0] - c * n[1]) / d, (m * n[1] - c * n[0]) / d];
        let lambda = -2.0 * (n[0] * u + n[1] * w) / (n[0] * k[0] + n[1] * k[1]);
        [u + lambda * k[0], w + lambda * k[1]]
    }
}

impl ByHand<2> for Fast {
    fn acceleration(&self, [x, _]: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        // p' = F with p = γv: v' = (F − v (v·F))/γ
        let (f, per_gamma) = ([-0.4 * x, -0.5], (1.0 - u * u - w * w).sqrt());
        let along = u * f[0] + w * f[1];
        [(f[0] - u * along) * per_gamma, (f[1] - w * along) * per_gamma]
    }
    fn gap(&self, [x, y]: [f64; 2], _: f64) -> f64 {
        y - 0.3 * x
    }
    fn reflected(&self, _: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        let change = 2.0 * (w - 0.3 * u) / 1.09;
        [u + 0.3 * change, w - change]
    }
}

impl ByHand<1> for Table {
    fn acceleration(&self, _: [f64; 1], [w]: [f64; 1], t: f64) -> [f64; 1] {
        [-1.0 - 0.05 * w + 0.3 * t.cos()]
    }
    fn gap(&self, [y]: [f64; 1], t: f64) -> f64 {
        y - self.a * (2.0 * t).sin()
    }
    fn reflected(&self, _: [f64; 1], [w]: [f64; 1], t: f64) -> [f64; 1] {
        [4.0 * self.a * (2.0 * t).cos() - w]
    }
}
