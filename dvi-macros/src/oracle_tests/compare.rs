//! Every generated function of a system against the oracle.

mod call;
mod constraints;

use super::evaluate::{Oracle, Outside, Point};
use super::expand::{environment, expand};
use super::jet::{Jet, ROUNDING, Sized};
use super::random::Random;
use super::rust::{Environment, Expansion, Machine, Value};
use super::structure::{self, Claims};
use super::system::{Gauge, System};
use call::Call;
/// Rounding errors stay below this, relative to the size of the terms.
pub(super) const TOLERANCE: f64 = 1e-10;
/// Second derivatives of a gauge are no larger than this, or not by much.
const GAUGES: f64 = 10.0;

/// A derivative that is a smaller part of its terms may be rounding.
const MOVES: f64 = 1e-6;

/// The number of points that a system is compared at, and of points that are drawn to find them.
const POINTS: usize = 2;
const DRAWN: usize = 40;

/// The jets of a system at one point.
pub(super) struct Expected {
    pub(super) point: Point,
    pub(super) lagrangian: Jet,
    /// L at v = 0: −H of a degenerate system.
    pub(super) at_rest: Jet,
    /// The force on each coordinate.
    pub(super) forces: Vec<Jet>,
    pub(super) constraints: Vec<Jet>,
    pub(super) momenta: Vec<Jet>,
    /// At whose zeros L or a force is not smooth, as far as they do not stand in sums.
    pub(super) seams: Vec<Jet>,
    /// Whether other velocities leave ∂²L/∂v∂v as it is.
    pub(super) is_quadratic: bool,
}

impl Expected {
    /// ∂L/∂qⁱ + Fᵢ, or ∂L/∂vⁱ behind.
    fn first(&self, i: usize) -> Sized {
        let of_lagrangian = self.lagrangian.gradient(i);
        self.forces.get(i).map_or(of_lagrangian, |force| of_lagrangian.plus(force.value))
    }

    /// The derivative of that by variable `j`.
    fn second(&self, i: usize, j: usize) -> Sized {
        let of_lagrangian = self.lagrangian.hessian(i, j);
        self.forces.get(i).map_or(of_lagrangian, |force| of_lagrangian.plus(force.gradient(j)))
    }

    /// ∂H/∂qⁱ − Fᵢ
    fn source(&self, i: usize) -> Sized {
        self.at_rest.gradient(i).plus(self.forces[i].value).scaled(-1.0)
    }
}

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

/// Points in the domain with their jets.
fn points(system: &System, random: &mut Random) -> Result<Vec<Expected>, Outside> {
    let mut points = Vec::new();
    for _ in 0..DRAWN {
        let mut draw = || (0..system.dimension()).map(|_| random.between(-0.6, 1.8)).collect();
        let (q, v) = (draw(), draw());
        match expected(system, Point { q, v, t: random.between(-1.0, 2.0) }) {
            Ok(point) => points.push(point),
            Err(Outside::Index) => return Err(Outside::Index),
            Err(Outside::Domain) => {}
        }
        if points.len() == POINTS {
            break;
        }
    }
    if points.is_empty() { Err(Outside::Domain) } else { Ok(points) }
}

fn expected(system: &System, point: Point) -> Result<Expected, Outside> {
    let rest = Point { v: vec![0.0; point.v.len()], ..point.clone() };
    let mut oracle = Oracle::new(system, &point);
    let lagrangian = oracle.lagrangian()?;
    let forces = oracle.forces()?;
    let seams = oracle.seams;
    let momenta = system.momenta.iter().map(|formula| Oracle::new(system, &point).value(formula));
    let momenta = momenta.collect::<Result<_, _>>()?;
    let constraints = Oracle::new(system, &point).constraints()?;
    // A regular L need not exist at rest.
    let at_rest =
        if system.is_regular() { lagrangian.clone() } else { Oracle::new(system, &rest).lagrangian()? };
    let n = system.dimension();
    let other = Point { v: point.v.iter().map(|v| 0.3 - 0.7 * v).collect(), ..point.clone() };
    let is_quadratic = match Oracle::new(system, &other).lagrangian() {
        Ok(other) => (0..n).all(|i| {
            (0..n).all(|j| structure::same(lagrangian.hessian(n + i, n + j), other.hessian(n + i, n + j)))
        }),
        Err(_) => true,
    };
    Ok(Expected { point, lagrangian, at_rest, forces, constraints, momenta, seams, is_quadratic })
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
        let n = self.system.dimension();
        found.iter().enumerate().try_for_each(|(place, found)| {
            let (i, j) = (place / n, place % n);
            self.same(what, &[i, j], expected(i, j), *found)
        })
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
        let Expected { point: Point { q, t, .. }, lagrangian: jet, .. } = expected;
        let (_, slices) = self.call().slice(q).real(*t).slice(&vec![7.0; n]).run("flow_source")?;
        // Second derivatives of the gauge cancel in both, and leave their rounding errors.
        let cancelled = Sized { value: 0.0, size: ROUNDING * GAUGES };
        self.same_vector("flow_source with a gauge", &slices[1], |i| {
            expected.source(i).plus(jet.hessian(n + i, 2 * n)).plus(cancelled)
        })?;
        let call = self.call().slice(q).real(*t).real(1.0).real(-1.0).slice(&vec![0.0; n * n]);
        let (_, slices) = call.run("one_form_jacobian")?;
        self.same_matrix("Ω with a gauge", &slices[1], |i, j| {
            cancelled.plus(jet.hessian(n + i, j)).plus(jet.hessian(n + j, i).scaled(-1.0))
        })
    }

    fn common(&mut self, expected: &Expected, random: &mut Random) -> Result<(), Difference> {
        let n = self.system.dimension();
        let (jet, Point { q, v, t }) = (&expected.lagrangian, &expected.point);
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
        let value = self.call().slice(q).slice(v).real(*t).number("lagrangian")?;
        self.same("lagrangian", &[], jet.value, value)?;

        // Slices hold something before: gradients are set, and the matrix is added to.
        let before = vec![7.0; n];
        let call = self.call().slice(q).slice(v).real(*t).slice(&before).slice(&before);
        let (_, slices) = call.run("gradient")?;
        self.same_vector("gradient, ∂L/∂q", &slices[2], |i| expected.first(i))?;
        self.same_vector("gradient, ∂L/∂v", &slices[3], |i| jet.gradient(n + i))?;

        let weights = [0; 4].map(|_| random.between(0.3, 1.7));
        let matrix: Vec<f64> = (0..n * n).map(|_| random.between(-1.0, 1.0)).collect();
        let mut call = self.call().slice(q).slice(v).real(*t);
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
        let applied = if self.expansion.constants["FORCED"] {
            let call = self.call().slice(q).slice(v).real(*t).slice(&before);
            let (_, mut slices) = call.run("applied_force")?;
            slices.remove(2)
        } else {
            // Forces that cancel as they are written are none.
            vec![0.0; n]
        };
        self.same_vector("applied_force", &applied, |i| expected.forces[i].value)?;

        for (index, jet) in expected.momenta.iter().enumerate() {
            let value = self.call().index(index).slice(q).slice(v).real(*t).number("momentum")?;
            self.same(&format!("momentum {index}"), &[], jet.value, value)?;
            let value = self.call().index(index).slice(q).slice(v).real(*t).number("event")?;
            self.same(&format!("event {index}"), &[], jet.value, value)?;
            let call = self.call().index(index).slice(q).slice(v).real(*t).slice(&before).slice(&before);
            let (by_time, slices) = call.run("event_gradient")?;
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
        let n = self.system.dimension();
        let (jet, Point { q, v, t }) = (&expected.lagrangian, &expected.point);
        let energy = self.call().slice(q).slice(v).real(*t).number("energy")?;
        let kinetic = |sum: Sized, i: usize| sum.plus(jet.gradient(n + i).times(Sized::new(v[i])));
        let wanted = (0..n).fold(jet.value.scaled(-1.0), kinetic);
        self.same("energy", &[], wanted, energy)?;
        let (_, slices) = self.call().slice(q).slice(v).real(*t).slice(&vec![7.0; n]).run("force")?;
        self.same_vector("force", &slices[2], |i| expected.first(i))?;
        let (_, slices) =
            self.call().slice(q).slice(v).real(*t).slice(&vec![7.0; n]).run("conjugate_momentum")?;
        self.same_vector("conjugate_momentum", &slices[2], |i| jet.gradient(n + i))?;
        let call = self.call().slice(q).slice(v).real(*t).slice(&vec![7.0; n]);
        let (_, slices) = call.run("momentum_rate")?;
        self.same_vector("momentum_rate", &slices[2], |i| jet.hessian(n + i, 2 * n))
    }

    fn degenerate(&mut self, expected: &Expected, random: &mut Random) -> Result<(), Difference> {
        let n = self.system.dimension();
        let Expected { point: Point { q, v, t }, lagrangian: jet, at_rest, momenta, .. } = expected;
        let before = vec![7.0; n];
        let minus = |value: Sized| value.scaled(-1.0);
        let hamiltonian = self.call().slice(q).real(*t).number("hamiltonian")?;
        self.same("hamiltonian", &[], minus(at_rest.value), hamiltonian)?;
        let energy = self.call().slice(q).slice(v).real(*t).number("energy")?;
        self.same("energy", &[], minus(at_rest.value), energy)?;
        let vector = |name: &str| -> Result<Vec<f64>, Difference> {
            let (_, mut slices) = self.call().slice(q).real(*t).slice(&before).run(name)?;
            Ok(slices.remove(1))
        };
        let (gradient, one_form, source) =
            (vector("hamiltonian_gradient")?, vector("one_form")?, vector("flow_source")?);
        self.same_vector("hamiltonian_gradient", &gradient, |i| expected.source(i))?;
        self.same_vector("one_form", &one_form, |i| jet.gradient(n + i))?;
        self.same_vector("flow_source", &source, |i| expected.source(i).plus(jet.hessian(n + i, 2 * n)))?;

        let (a, b) = (random.between(0.3, 1.7), random.between(-1.7, -0.3));
        let combination =
            |i: usize, j: usize| jet.hessian(n + i, j).scaled(a).plus(jet.hessian(n + j, i).scaled(b));
        let matrix: Vec<f64> = (0..n * n).map(|_| random.between(-1.0, 1.0)).collect();
        let call = self.call().slice(q).real(*t).real(a).real(b).slice(&matrix);
        let (_, slices) = call.run("one_form_jacobian")?;
        self.same_matrix("one_form_jacobian", &slices[1], |i, j| {
            Sized::new(matrix[i * n + j]).plus(combination(i, j))
        })?;
        let call = self.call().slice(q).real(*t).real(a).real(b).slice(&before);
        let (_, slices) = call.run("conjugate_entries")?;
        let (conjugates, canonical) = (self.conjugates(), self.expansion.constants["CANONICAL"]);
        self.same_vector("conjugate_entries", &slices[1], |i| {
            if canonical { combination(i, conjugates[i]) } else { Sized::default() }
        })?;

        for (index, jet) in momenta.iter().enumerate() {
            let call = self.call().index(index).slice(q).real(*t).slice(&before);
            let (_, slices) = call.run("momentum_gradient")?;
            self.same_vector("momentum_gradient", &slices[1], |i| jet.gradient(i))?;
        }
        Ok(())
    }
}
