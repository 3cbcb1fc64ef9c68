//! L = ½ v·M v − V(q, t) without a frequency: the positions of the interior nodes, from their forces alone.
//!
//! With the displacements and velocities of the nodes eliminated, the step is the Nyström method of the pair
//! IIIA–IIIB. Node 0 is where it begins and node 1 where it ends, and the force there moves no position of
//! the step:
//!
//! Qᵢ = q0 + h cᵢ M⁻¹(p0 + L₁) + h M⁻¹Σⱼ νᵢⱼ Lⱼ,   Lᵢ = hwᵢ f(Qᵢ, t + cᵢh),   i and j inside
//! q1 = q0 + h M⁻¹(p0 + L₁) + h M⁻¹Σⱼ (1 − cⱼ) Lⱼ,   p1 = p0 + L₁ + Σⱼ Lⱼ + Lₛ
//!
//! So it is a method like Gauss collocation between two kicks, as the step of Störmer and Verlet is a free
//! motion between two. With νᵢⱼ − νⱼᵢ = cᵢ − cⱼ exactly it is symplectic in the arithmetic (Antoñana,
//! Makazaga & Murua 2025). A step begins with the polynomial through the forces at all nodes of the step
//! before, continued. Each interior node has a lane in packs of `W` ≥ S − 2; what stands in the others does
//! not count.

use core::fmt::{self, Debug};
use core::marker::PhantomData;

use super::evaluation::NodeForces;
use crate::discrete::Rule as _;
use crate::mechanics::mass::Mass;
use crate::mechanics::motion::weigh;
use crate::mechanics::phase::PhasePoint;
use crate::memory::{Memory, lasting};
use crate::methods::collocation::lobatto::Lobatto;
use crate::methods::collocation::packs::{Nystrom, combine, continuation, sum};
use crate::scalar::Lanes;
use crate::scalar::lanes::{read_lane, write_lane};
use crate::scalar::simd::Task;
use crate::solve::Due;
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, Space, System, Vector};

/// The interior nodes of a step, and what the step before leaves to it.
pub struct Interior<const NODES: usize, const W: usize, S: System, T: Real, E> {
    nystrom: Nystrom<W, T>,
    weights: Lanes<W, T>,
    /// The weight of an end.
    end: T,
    /// The Lagrange polynomials of all nodes, row k in terms of the Legendre polynomial of degree k.
    lagrange: [[T; NODES]; NODES],
    /// Their continuation into a step of the same length.
    continuation: [Lanes<W, T>; NODES],
    /// The forces inside the last completed step, and where it began.
    completed: [Vector<S, Lanes<W, T>>; 1],
    first: Vector<S, T>,
    /// The length of that step; zero before the first, and after a jump.
    last: T,
    forces: Vector<S, Lanes<W, T>>,
    /// L, of these forces, and h M⁻¹L.
    terms: Vector<S, Lanes<W, T>>,
    displacements: Vector<S, Lanes<W, T>>,
    places: Vector<S, Lanes<W, T>>,
    renewed: Vector<S, Lanes<W, T>>,
    /// h M⁻¹p0, and h M⁻¹ of what the first kick adds to it.
    drift: Vector<S, T>,
    kick: Vector<S, T>,
    work: [Vector<S, T>; 2],
    /// In which the iteration judges coordinates.
    sizes: Vector<S, T>,
    evaluation: PhantomData<E>,
}

impl<const NODES: usize, const W: usize, S: System, T: Real, E> Memory<T> for Interior<NODES, W, S, T, E> {
    lasting!(T; packs completed, numbers first, number last);
}

impl<const NODES: usize, const W: usize, S: System, T: Real, E> Debug for Interior<NODES, W, S, T, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Interior").field("completed", &self.completed).finish_non_exhaustive()
    }
}

/// Where a step begins and how long it is.
#[derive(Debug)]
pub struct Departure<'a, S: System, T: Real> {
    pub(super) q: &'a [T],
    pub(super) phase: &'a PhasePoint<S, T>,
    pub(super) mass: &'a Mass<S, T>,
    pub(super) h: T,
}

/// The interior nodes of a step.
pub trait InteriorNodes<const NODES: usize, S: System, T: Real>: Memory<T> + Debug + Sized {
    /// Of the Lobatto rule.
    fn new(system: &S) -> Self;
    /// The impulse of the force at an end of a step of length `h`.
    fn end_impulse(&self, h: T, force: T) -> T;
    /// Forgets the last step: the next one begins with the force at its start.
    fn forget(&mut self);
    /// Remembers the forces of a completed step of length `h` that began with the force `first`.
    fn remember(&mut self, h: T, first: &[T]);
    /// Continues the forces of the step before and moves the nodes by them.
    fn depart(&mut self, at: &Departure<'_, S, T>);
    /// Evaluates the forces at all nodes once and moves these, and returns the largest change of a position
    /// in units of the coordinates.
    fn improve(
        &mut self,
        system: &S,
        at: &Departure<'_, S, T>,
        t: T,
        due: &mut Due,
        statistics: &mut Statistics,
    ) -> T;
    /// Puts the nodes where the `unknowns` say, q0, the displacements and Δ, and evaluates the forces there,
    /// in a step of length h from t.
    fn visit(
        &mut self,
        system: &S,
        unknowns: &[Vector<S, T>; NODES],
        interval: [T; 2],
        statistics: &mut Statistics,
    );
    /// The change of coordinate `k`, and that of its momentum but for the kicks.
    fn increments(&self, k: usize) -> [T; 2];
    /// Coordinate `k` of a node that is inside, from 1, less that of the straight path from `q` by
    /// `increment`.
    fn displacement(&self, node: usize, k: usize, q: T, increment: T) -> T;
    /// Runs steps.
    fn run<K: Task>(steps: K) -> K::Output;
}

impl<const NODES: usize, const W: usize, S, T: Real, E> InteriorNodes<NODES, S, T>
    for Interior<NODES, W, S, T, E>
where
    S: NondegenerateLagrangian<T>,
    E: NodeForces<W, S, T>,
{
    fn new(system: &S) -> Self {
        const { assert!(W >= NODES - 2, "each interior node has a lane") };
        let rule = Lobatto::<NODES>::new();
        // Lanes without a node repeat the last one, with no weight.
        let node = |lane: usize| lane.min(Self::COUNT - 1) + 1;
        let (nu, c) = (rule.nystrom(), |lane: usize| rule.nodes()[node(lane)]);
        let lanes = |of: &dyn Fn(usize) -> f64| Lanes(core::array::from_fn(|lane| T::lift(of(lane))));
        let lagrange = rule.lagrange().map(|row| row.map(T::lift));
        let nodes = lanes(&c);
        let packs = || system.space().vector();
        Self {
            nystrom: Nystrom {
                nu: core::array::from_fn(|j| lanes(&|lane| nu[node(lane)][node(j)])),
                beta: lanes(&|lane| 1.0 - c(lane)),
                nodes,
            },
            weights: lanes(&|lane| if lane < Self::COUNT { rule.weights()[node(lane)] } else { 0.0 }),
            end: T::lift(rule.weights()[0]),
            lagrange,
            continuation: continuation(&lagrange, nodes, T::lift(1.0)),
            completed: [packs()],
            first: system.space().vector(),
            last: T::lift(0.0),
            forces: packs(),
            terms: packs(),
            displacements: packs(),
            places: packs(),
            renewed: packs(),
            drift: system.space().vector(),
            kick: system.space().vector(),
            work: system.space().vectors(),
            sizes: system.space().vector(),
            evaluation: PhantomData,
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn end_impulse(&self, h: T, force: T) -> T {
        h * self.end * force
    }

    fn forget(&mut self) {
        self.last = T::lift(0.0);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn remember(&mut self, h: T, first: &[T]) {
        self.completed[0].copy_from_slice(&self.forces);
        self.first.copy_from_slice(first);
        self.last = h;
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn depart(&mut self, at: &Departure<'_, S, T>) {
        let Departure { phase, mass, h, .. } = *at;
        self.continue_forces(&phase.force, h);
        mass.displace(h, &phase.p, &mut self.drift);
        let [impulse, _] = &mut self.work;
        for (k, impulse) in impulse.iter_mut().enumerate() {
            *impulse = h * self.end * phase.force[k] + phase.left_out_of_p(k);
        }
        mass.displace(h, impulse, &mut self.kick);
        self.place(at);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(
        &mut self,
        system: &S,
        at: &Departure<'_, S, T>,
        t: T,
        due: &mut Due,
        statistics: &mut Statistics,
    ) -> T {
        due.prepare_places(system, &mut self.sizes, at.q, &mut self.places);
        self.evaluate(system, [t, at.h], statistics);
        self.place(at)
    }

    fn visit(
        &mut self,
        system: &S,
        unknowns: &[Vector<S, T>; NODES],
        interval: [T; 2],
        statistics: &mut Statistics,
    ) {
        for (k, place) in self.places.iter_mut().enumerate() {
            for lane in 0..W {
                let node = lane.min(Self::COUNT - 1);
                let straight = unknowns[0][k] + self.nystrom.nodes.0[lane] * unknowns[NODES - 1][k];
                place.0[lane] = straight + unknowns[node + 1][k];
            }
        }
        self.evaluate(system, interval, statistics);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn increments(&self, k: usize) -> [T; 2] {
        let forced = self.nystrom.beta * self.displacements[k];
        let displaced = self.drift[k] + (sum(&forced.0[..Self::COUNT]) + self.kick[k]);
        [displaced, sum(&self.terms[k].0[..Self::COUNT])]
    }

    fn displacement(&self, node: usize, k: usize, q: T, increment: T) -> T {
        (self.places[k].0[node - 1] - q) - self.nystrom.nodes.0[node - 1] * increment
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run<K: Task>(steps: K) -> K::Output {
        E::run(steps)
    }
}

impl<const NODES: usize, const W: usize, S: NondegenerateLagrangian<T>, T: Real, E>
    Interior<NODES, W, S, T, E>
{
    /// How many nodes there are inside.
    const COUNT: usize = NODES - 2;

    /// Evaluates the forces at the nodes of a step of length h from t.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate(&mut self, system: &S, [t, h]: [T; 2], statistics: &mut Statistics)
    where
        E: NodeForces<W, S, T>,
    {
        let Self { nystrom, weights, forces, terms, places, work: [place, force], .. } = self;
        let times = Lanes::all(t) + nystrom.nodes * Lanes::all(h);
        E::evaluate(system, Self::COUNT, places, times, forces, [place, force]);
        statistics.gradients += Self::COUNT as u64;
        let by = Lanes::all(h) * *weights;
        weigh(|_| by, forces, terms);
    }

    /// Continues the polynomial through the forces of the step before into a step of length `h`, where the
    /// force is `force` at its start; before the first step, that force.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn continue_forces(&mut self, force: &[T], h: T) {
        let Self {
            lagrange,
            continuation: same,
            completed,
            first,
            last,
            forces,
            terms,
            weights,
            nystrom,
            ..
        } = self;
        if *last == T::lift(0.0) {
            for (pack, &force) in forces.iter_mut().zip(force) {
                *pack = Lanes::all(force);
            }
        } else {
            let other;
            let columns = if h == *last {
                &*same
            } else {
                other = continuation(lagrange, nystrom.nodes, h / *last);
                &other
            };
            let from = |k: usize| {
                let ends = columns[0] * Lanes::all(first[k]) + columns[NODES - 1] * Lanes::all(force[k]);
                (T::lift(0.0), ends)
            };
            combine(&columns[1..=Self::COUNT], &completed[0], from, forces);
        }
        let by = Lanes::all(h) * *weights;
        weigh(|_| by, forces, terms);
    }

    /// Moves the nodes by the forces, and returns the largest change of a position in units of the
    /// coordinates.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(&mut self, at: &Departure<'_, S, T>) -> T {
        let Departure { q, phase, mass, h } = *at;
        let Self { nystrom, terms, displacements, places, renewed, drift, kick, work, sizes, .. } = self;
        if let Some(reciprocals) = mass.reciprocals() {
            weigh(|k| Lanes::all(h * reciprocals[k]), terms, displacements);
        } else {
            let [impulse, displacement] = work;
            for lane in 0..Self::COUNT {
                read_lane(lane, terms, impulse);
                mass.displace(h, impulse, displacement);
                write_lane(lane, displacement, displacements);
            }
        }
        let nodes = nystrom.nodes;
        let from = |k: usize| {
            let small = Lanes::all(phase.left_out_of_q(k)) + nodes * Lanes::all(kick[k]);
            (q[k], small + nodes * Lanes::all(drift[k]))
        };
        nystrom.place(Self::COUNT, displacements, from, sizes, [places, renewed])
    }
}
