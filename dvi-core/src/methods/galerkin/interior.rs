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

use core::marker::PhantomData;

use super::evaluation::NodeForces;
use crate::discrete::Interval;
use crate::error::StepFailure;
use crate::mechanics::motion::{weigh, weigh_each};
use crate::memory::{Memory, lasting};
use crate::methods::collocation::lobatto::Lobatto;
use crate::methods::collocation::packs::{Nystrom, combine, continuation, moved, replace, sum};
use crate::methods::step::Begin;
use crate::scalar::lanes::{read_lane, write_lane};
use crate::scalar::{Lanes, norm};
use crate::solve::{Convergence, Due, Stopping, repeat};
use crate::state::Statistics;
use crate::{NondegenerateLagrangian, Real, Space, System, Vector};

/// The interior nodes of a step, and what the step before leaves to it.
#[derive(Debug)]
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
    /// The force where this step begins, and those inside.
    start: Vector<S, T>,
    forces: Vector<S, Lanes<W, T>>,
    /// L, of these forces, and h M⁻¹L.
    terms: Vector<S, Lanes<W, T>>,
    displacements: Vector<S, Lanes<W, T>>,
    places: Vector<S, Lanes<W, T>>,
    renewed: Vector<S, Lanes<W, T>>,
    /// h M⁻¹p0, and h M⁻¹ of what the first kick adds to it.
    drift: Vector<S, T>,
    kick: Vector<S, T>,
    /// What these add to q0 at the nodes.
    free: Vector<S, Lanes<W, T>>,
    work: [Vector<S, T>; 2],
    /// In which the iteration judges coordinates.
    sizes: Vector<S, T>,
    evaluation: PhantomData<E>,
}

lasting!([const NODES: usize, const W: usize, S: System, T: Real, E] Interior<NODES, W, S, T, E>, T;
    packs completed, numbers first, number last);

/// The interior nodes of a step.
pub trait InteriorNodes<const NODES: usize, S: System, T: Real>: Memory<T> + Sized {
    /// Of the Lobatto rule.
    fn new(system: &S) -> Self;
    /// Remembers the forces of a completed step of length `h`; of no length, forgets it: the next step begins
    /// with the force at its start.
    fn remember(&mut self, h: T);
    /// Finds the positions by the fixed point, in up to so many iterations, and sets Δ, and p1 − p0 but for
    /// the kick at the end.
    ///
    /// # Errors
    /// [`StepFailure::NotConverged`], [`StepFailure::NotFinite`].
    fn solve(
        &mut self,
        at: &Begin<'_, S, T>,
        limits: (Stopping, usize),
        increments: [&mut Vector<S, T>; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure>;
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
        let (nu, c) = (rule.nystrom(), |lane: usize| rule.c[node(lane)]);
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
            weights: lanes(&|lane| if lane < Self::COUNT { rule.b[node(lane)] } else { 0.0 }),
            end: T::lift(rule.b[0]),
            lagrange,
            continuation: continuation(&lagrange, nodes, T::lift(1.0)),
            completed: [packs()],
            first: system.space().vector(),
            last: T::lift(0.0),
            start: system.space().vector(),
            forces: packs(),
            terms: packs(),
            displacements: packs(),
            places: packs(),
            renewed: packs(),
            drift: system.space().vector(),
            kick: system.space().vector(),
            free: packs(),
            work: system.space().vectors(),
            sizes: system.space().vector(),
            evaluation: PhantomData,
        }
    }

    #[inline]
    fn remember(&mut self, h: T) {
        self.completed[0].copy_from_slice(&self.forces);
        self.first.copy_from_slice(&self.start);
        self.last = h;
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn solve(
        &mut self,
        at: &Begin<'_, S, T>,
        (stopping, budget): (Stopping, usize),
        [delta, impulse]: [&mut Vector<S, T>; 2],
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        self.depart(at);
        // The momentum is that of the forces before the last correction, whose size counts, and not that of
        // the next one alone.
        let convergence = Convergence::fixed_point(stopping, budget);
        repeat(
            convergence,
            statistics,
            #[cfg_attr(not(debug_assertions), inline(always))]
            |due: &mut Due, statistics: &mut Statistics| {
                due.prepare_places(at.system, &mut self.sizes, at.q, &mut self.places);
                self.evaluate(at, statistics);
                Ok(self.place(at))
            },
        )?;
        for (k, delta) in delta.iter_mut().enumerate() {
            let forced = self.nystrom.beta * self.displacements[k];
            *delta = self.drift[k] + (sum(&forced.0[..Self::COUNT]) + self.kick[k]);
        }
        for ((impulse, &force), terms) in impulse.iter_mut().zip(self.start.iter()).zip(self.terms.iter()) {
            *impulse = at.interval.h * self.end * force + sum(&terms.0[..Self::COUNT]);
        }
        norm::finite(delta)
    }
}

impl<const NODES: usize, const W: usize, S: NondegenerateLagrangian<T>, T: Real, E>
    Interior<NODES, W, S, T, E>
{
    /// How many nodes there are inside.
    const COUNT: usize = NODES - 2;

    /// Continues the forces of the step before, and moves the nodes by them.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn depart(&mut self, at: &Begin<'_, S, T>) {
        let Begin { interval: Interval { h, .. }, phase, mass, .. } = *at;
        self.continue_forces(&phase.force, h);
        self.start.copy_from_slice(&phase.force);
        mass.displace(h, &phase.p, &mut self.drift);
        let [impulse, _] = &mut self.work;
        for (k, impulse) in impulse.iter_mut().enumerate() {
            *impulse = h * self.end * phase.force[k] + phase.carried[1].left_out_of(k);
        }
        mass.displace(h, impulse, &mut self.kick);
        let nodes = self.nystrom.nodes;
        for (k, (free, (&drift, &kick))) in
            self.free.iter_mut().zip(self.drift.iter().zip(self.kick.iter())).enumerate()
        {
            let small = Lanes::all(phase.carried[0].left_out_of(k)) + nodes * Lanes::all(kick);
            *free = small + nodes * Lanes::all(drift);
        }
        self.place(at);
    }

    /// Evaluates the forces at the nodes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate(&mut self, at: &Begin<'_, S, T>, statistics: &mut Statistics)
    where
        E: NodeForces<W, S, T>,
    {
        let Self { nystrom, weights, forces, terms, places, work: [place, force], .. } = self;
        let Interval { t, h } = at.interval;
        let times = Lanes::all(t) + nystrom.nodes * Lanes::all(h);
        E::evaluate(at.system, Self::COUNT, places, times, forces, [place, force]);
        statistics.gradients += Self::COUNT as u64;
        let by = Lanes::all(h) * *weights;
        weigh(by, forces, terms);
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
            combine(
                &columns[1..=Self::COUNT],
                &completed[0],
                |k| {
                    let ends = columns[0] * Lanes::all(first[k]) + columns[NODES - 1] * Lanes::all(force[k]);
                    (T::lift(0.0), ends)
                },
                forces,
            );
        }
        let by = Lanes::all(h) * *weights;
        weigh(by, forces, terms);
    }

    /// Moves the nodes by the forces, and returns the largest change of a position in units of the
    /// coordinates.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn place(&mut self, at: &Begin<'_, S, T>) -> T {
        let Begin { system, interval: Interval { h, .. }, q, mass, .. } = *at;
        let Self { nystrom, terms, displacements, places, renewed, free, work, sizes, .. } = self;
        if let Some(reciprocals) = mass.reciprocals() {
            weigh_each(h, reciprocals, terms, displacements);
        } else {
            let [impulse, displacement] = work;
            for lane in 0..Self::COUNT {
                read_lane(lane, terms, impulse);
                mass.displace(h, impulse, displacement);
                write_lane(lane, displacement, displacements);
            }
        }
        combine(&nystrom.nu[..Self::COUNT], displacements, moved(q, free), renewed);
        replace(system, sizes, places, renewed, |_, _| ())
    }
}
