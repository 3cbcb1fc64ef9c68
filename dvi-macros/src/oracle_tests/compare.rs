//! Every generated function of a system against the oracle.

mod call;
mod constraints;
mod expected;

use super::evaluate::{Outside, Point};
use super::expand::{environment, expand};
use super::jet::{Jet, ROUNDING, Sized};
use super::random::Random;
use super::rust::{Environment, Expansion, Machine, Value};
use super::structure::{self, Claims};
use super::system::{Gauge, System};
use call::Call;
pub(super) use expected::Expected;
use expected::points;

/// Rounding errors stay below this, relative to the size of the terms.
pub(super) const TOLERANCE: f64 = 1e-10;
/// Second derivatives of a gauge are no larger than this, or not by much.
const GAUGES: f64 = 10.0;

/// A derivative that is a smaller part of its terms may be rounding.
const MOVES: f64 = 1e-6;

/// What came out.
#[derive(Debug)]
pub(super) enum Verdict {
    Agrees {
        largest: f64,
        claims: Claims,
    },
    /// The macro refuses the system with these messages.
    Refused(Vec<String>),
    /// No point of the domain was found.
    NoPoint,
    /// The formula has an index out of range, and the macro or the generated check says so.
    OutOfRange,
    /// Where, and how.
    Differs {
        what: String,
        details: String,
    },
}

fn differs(what: &str, details: impl Into<String>) -> Verdict {
    Verdict::Differs { what: what.into(), details: details.into() }
}

/// Compares the expansion of a system with the oracle at points that are drawn from `random`.
pub(super) fn compare(system: &System, random: &mut Random) -> Verdict {
    let expansion = match expand(system) {
        Ok(expansion) => expansion,
        Err(messages) => return Verdict::Refused(messages),
    };
    let environment = environment(system);
    let mut comparison =
        Comparison { system, expansion: &expansion, environment: &environment, largest: 0.0 };
    let checked = comparison.machine().call("check", Vec::new());
    let points = match points(system, random) {
        Ok(points) => points,
        Err(Outside::Index) => {
            return match checked {
                Ok(Value::Failure(_)) => Verdict::OutOfRange,
                _ => differs("check", "an index is out of range, and the check does not say so"),
            };
        }
        Err(Outside::Domain) => return Verdict::NoPoint,
    };
    match checked {
        Ok(Value::Unit) => {}
        Ok(Value::Failure(said)) => {
            return differs("check", format!("all indices are in range, and the check says: {said}"));
        }
        other => return differs("check", format!("the check ends with {other:?}")),
    }
    for point in &points {
        if let Err((what, details)) = comparison.at(point, random) {
            return differs(&what, details);
        }
    }
    if system.gauge == Gauge::Auto {
        return Verdict::Agrees { largest: comparison.largest, claims: structure::Claims::new() };
    }
    match structure::hold(system, &expansion, &comparison.conjugates(), &points) {
        Ok(claims) => Verdict::Agrees { largest: comparison.largest, claims },
        Err((what, details)) => differs(&what, details),
    }
}

/// A difference: the output and both numbers.
pub(super) type Difference = (String, String);

struct Comparison<'a> {
    system: &'a System,
    expansion: &'a Expansion,
    environment: &'a Environment,
    largest: f64,
}

impl<'a> Comparison<'a> {
    fn machine(&self) -> Machine<'a> {
        Machine { expansion: self.expansion, environment: self.environment, arrays: Vec::new() }
    }

    fn call(&self) -> Call<'a> {
        Call { machine: self.machine(), arguments: Vec::new() }
    }

    fn at_rest(&self, Point { q, t, .. }: &Point) -> Call<'a> {
        self.call().slice(q).real(*t)
    }

    fn moving(&self, Point { q, v, t }: &Point) -> Call<'a> {
        self.call().slice(q).slice(v).real(*t)
    }

    /// The conjugates of all coordinates, where the functions of degenerate systems are generated.
    fn conjugates(&self) -> Vec<usize> {
        if self.system.is_regular() {
            return Vec::new();
        }
        let conjugate = |i| match self.call().index(i).run("conjugate") {
            Ok((conjugate, _)) => conjugate.integer() as usize,
            Err((_, reason)) => panic!("{reason}"),
        };
        (0..self.system.dimension()).map(conjugate).collect()
    }

    fn same(&mut self, what: &str, at: &[usize], expected: Sized, found: f64) -> Result<(), Difference> {
        let difference = (found - expected.value).abs();
        if difference == 0.0 {
            return Ok(());
        }
        let relative = difference / expected.size;
        // What is not a number is a difference.
        if relative.is_nan() || relative > TOLERANCE {
            let entry: String = at.iter().map(|i| format!("[{i}]")).collect();
            let details = format!("{what}{entry} is {found:?}, expected {:?}", expected.value);
            return Err((what.into(), details));
        }
        self.largest = self.largest.max(relative);
        Ok(())
    }

    fn same_vector(
        &mut self,
        what: &str,
        found: &[f64],
        expected: impl Fn(usize) -> Sized,
    ) -> Result<(), Difference> {
        found.iter().enumerate().try_for_each(|(i, found)| self.same(what, &[i], expected(i), *found))
    }

    fn same_matrix(
        &mut self,
        what: &str,
        found: &[f64],
        expected: impl Fn(usize, usize) -> Sized,
    ) -> Result<(), Difference> {
        let n = found.len().isqrt();
        found.iter().enumerate().try_for_each(|(place, found)| {
            let (i, j) = (place / n, place % n);
            self.same(what, &[i, j], expected(i, j), *found)
        })
    }

    /// A function that returns a number.
    fn returns(&mut self, name: &str, call: Call<'a>, expected: Sized) -> Result<(), Difference> {
        let value = call.number(name)?;
        self.same(name, &[], expected, value)
    }

    /// A function that sets a vector of so many entries, whatever they are before.
    fn sets(
        &mut self,
        name: &str,
        call: Call<'a>,
        count: usize,
        expected: impl Fn(usize) -> Sized,
    ) -> Result<(), Difference> {
        // Arrays of the function itself come behind it.
        let set = call.machine.arrays.len();
        let (_, slices) = call.slice(&vec![7.0; count]).run(name)?;
        self.same_vector(name, &slices[set], expected)
    }

    fn at(&mut self, expected: &Expected, random: &mut Random) -> Result<(), Difference> {
        let compared = match (&self.system.gauge, self.system.is_regular()) {
            (Gauge::Auto, _) => self.motion(expected),
            (_, true) => self
                .common(expected, random)
                .and_then(|()| self.regular(expected))
                .and_then(|()| self.constraints(expected, random)),
            (_, false) => self.common(expected, random).and_then(|()| self.degenerate(expected, random)),
        };
        compared.map_err(|(what, details)| {
            let Point { q, v, t } = &expected.point;
            (what, format!("{details}\n  at q = {q:?}, v = {v:?}, t = {t:?}"))
        })
    }

    /// What a gauge leaves as it is: Ω and ∇H + ∂α/∂t. The self-check of the macro holds the rest against
    /// the gauge that it has found.
    fn motion(&mut self, expected: &Expected) -> Result<(), Difference> {
        let n = self.system.dimension();
        let Expected { point, lagrangian: jet, .. } = expected;
        // Second derivatives of the gauge cancel in both, and leave their rounding errors.
        let cancelled = Sized { value: 0.0, size: ROUNDING * GAUGES };
        self.sets("flow_source", self.at_rest(point), n, |i| {
            expected.source(i).plus(jet.hessian(n + i, 2 * n)).plus(cancelled)
        })?;
        let call = self.at_rest(point).real(1.0).real(-1.0).slice(&vec![0.0; n * n]);
        let (_, slices) = call.run("one_form_jacobian")?;
        self.same_matrix("Ω with a gauge", &slices[1], |i, j| {
            cancelled.plus(jet.hessian(n + i, j)).plus(jet.hessian(n + j, i).scaled(-1.0))
        })
    }

    fn common(&mut self, expected: &Expected, random: &mut Random) -> Result<(), Difference> {
        let n = self.system.dimension();
        let Expected { point: point @ Point { q, v, t }, lagrangian: jet, .. } = expected;
        for block in 0..self.system.blocks.len() {
            let (length, _) = self.call().index(block).run("block_len")?;
            let wanted = self.system.block_length(block);
            if length.integer() != wanted as i128 {
                return Err((
                    "block_len".into(),
                    format!("block {block} has length {length:?}, not {wanted}"),
                ));
            }
        }
        self.returns("lagrangian", self.moving(point), jet.value)?;

        // Slices hold something before: gradients are set, and the matrix is added to.
        let before = vec![7.0; n];
        let (_, slices) = self.moving(point).slice(&before).slice(&before).run("gradient")?;
        self.same_vector("gradient, ∂L/∂q", &slices[2], |i| expected.first(i))?;
        self.same_vector("gradient, ∂L/∂v", &slices[3], |i| jet.gradient(n + i))?;

        let weights = [0; 4].map(|_| random.between(0.3, 1.7));
        let matrix: Vec<f64> = (0..n * n).map(|_| random.between(-1.0, 1.0)).collect();
        let mut call = self.moving(point);
        call.arguments.push(Value::Weights(weights));
        let (_, slices) = call.slice(&before).slice(&before).slice(&matrix).run("linearize")?;
        self.same_vector("linearize, ∂L/∂q", &slices[2], |i| expected.first(i))?;
        self.same_vector("linearize, ∂L/∂v", &slices[3], |i| jet.gradient(n + i))?;
        let [qq, qv, vq, vv] = weights;
        self.same_matrix("linearize, second derivatives", &slices[4], |i, j| {
            let blocks = [(qq, i, j), (qv, i, n + j), (vq, n + i, j), (vv, n + i, n + j)];
            let start = Sized::new(matrix[i * n + j]);
            blocks
                .iter()
                .fold(start, |sum, (weight, i, j)| sum.plus(expected.second(*i, *j).scaled(*weight)))
        })?;
        let force = |i: usize| expected.forces[i].value;
        match self.expansion.constants["FORCED"] {
            true => self.sets("applied_force", self.moving(point), n, force)?,
            // Forces that cancel as they are written are none.
            false => self.same_vector("applied_force", &vec![0.0; n], force)?,
        }

        for (index, jet) in expected.momenta.iter().enumerate() {
            let call = || self.call().index(index).slice(q).slice(v).real(*t);
            let (momentum, event) = (call(), call());
            let (by_time, slices) = call().slice(&before).slice(&before).run("event_gradient")?;
            self.returns("momentum", momentum, jet.value)?;
            self.returns("event", event, jet.value)?;
            self.same("event_gradient, ∂g/∂t", &[], jet.gradient(2 * n), by_time.real())?;
            self.same_vector("event_gradient, ∂g/∂q", &slices[2], |i| jet.gradient(i))?;
            self.same_vector("event_gradient, ∂g/∂v", &slices[3], |i| jet.gradient(n + i))?;
        }
        self.seams(expected)
    }

    /// What the formulas compare is among the seams, if it moves; either side of it may stand first.
    fn seams(&mut self, expected: &Expected) -> Result<(), Difference> {
        let Expected { point: Point { q, v, t }, seams, .. } = expected;
        let moves = |seam: &&Jet| {
            (0..=2 * q.len()).any(|i| {
                let Sized { value, size } = seam.gradient(i);
                value.abs() > MOVES * size
            })
        };
        for seam in seams.iter().filter(moves) {
            let mut nearest = f64::NAN;
            for index in 0..self.expansion.seams {
                let found = self.call().index(index).slice(q).slice(v).real(*t).number("seam")?;
                for found in [found, -found] {
                    let is_nearer = (found - seam.value.value).abs() < (nearest - seam.value.value).abs();
                    nearest = if is_nearer || nearest.is_nan() { found } else { nearest };
                }
            }
            self.same("seam", &[], seam.value, nearest)?;
        }
        Ok(())
    }

    fn regular(&mut self, expected: &Expected) -> Result<(), Difference> {
        let (n, point, jet) = (self.system.dimension(), &expected.point, &expected.lagrangian);
        let kinetic = |sum: Sized, i: usize| sum.plus(jet.gradient(n + i).times(Sized::new(point.v[i])));
        let energy = (0..n).fold(jet.value.scaled(-1.0), kinetic);
        self.returns("energy", self.moving(point), energy)?;
        self.sets("force", self.moving(point), n, |i| expected.first(i))?;
        self.sets("conjugate_momentum", self.moving(point), n, |i| jet.gradient(n + i))?;
        self.sets("momentum_rate", self.moving(point), n, |i| jet.hessian(n + i, 2 * n))
    }

    fn degenerate(&mut self, expected: &Expected, random: &mut Random) -> Result<(), Difference> {
        let n = self.system.dimension();
        let Expected { point, lagrangian: jet, at_rest, momenta, .. } = expected;
        let hamiltonian = at_rest.value.scaled(-1.0);
        self.returns("hamiltonian", self.at_rest(point), hamiltonian)?;
        self.returns("energy", self.moving(point), hamiltonian)?;
        self.sets("hamiltonian_gradient", self.at_rest(point), n, |i| expected.source(i))?;
        self.sets("one_form", self.at_rest(point), n, |i| jet.gradient(n + i))?;
        let source = |i: usize| expected.source(i).plus(jet.hessian(n + i, 2 * n));
        self.sets("flow_source", self.at_rest(point), n, source)?;

        let (a, b) = (random.between(0.3, 1.7), random.between(-1.7, -0.3));
        let combination =
            |i: usize, j: usize| jet.hessian(n + i, j).scaled(a).plus(jet.hessian(n + j, i).scaled(b));
        let matrix: Vec<f64> = (0..n * n).map(|_| random.between(-1.0, 1.0)).collect();
        let (_, slices) = self.at_rest(point).real(a).real(b).slice(&matrix).run("one_form_jacobian")?;
        self.same_matrix("one_form_jacobian", &slices[1], |i, j| {
            Sized::new(matrix[i * n + j]).plus(combination(i, j))
        })?;
        let (conjugates, canonical) = (self.conjugates(), self.expansion.constants["CANONICAL"]);
        self.sets("conjugate_entries", self.at_rest(point).real(a).real(b), n, |i| {
            if canonical { combination(i, conjugates[i]) } else { Sized::default() }
        })?;

        for (index, jet) in momenta.iter().enumerate() {
            let call = self.call().index(index).slice(&point.q).real(point.t);
            self.sets("momentum_gradient", call, n, |i| jet.gradient(i))?;
        }
        Ok(())
    }
}
