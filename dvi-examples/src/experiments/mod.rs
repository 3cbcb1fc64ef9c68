//! The experiments, a file each, and what several of them share.

mod accuracy_cost;
mod average_acceleration;
mod barnes;
mod beam;
mod billiard;
mod bounces;
mod chaotic;
mod disc;
mod double_pendulum;
mod elliptic;
mod energy;
mod energy_momentum;
mod field_lines;
mod friction;
mod geodesics;
mod guiding_centre;
mod kepler;
mod kepler_frequency;
mod kepler_long;
mod kepler_steps;
mod kepler_work;
mod leapfrogging;
mod links;
mod lotka_volterra;
mod massless;
mod molecules;
mod momenta;
mod order;
mod oscillator;
mod parasitic;
mod phase_space;
mod quasi_periodic;
mod rigid_body;
mod rivals;
mod rk4;
mod round_off;
mod schroedinger;
mod sections;
mod shadow;
mod shear_layer;
mod sphere_vortices;
mod spherical_pendulum;
mod spring_chain;
mod stability;
mod symmetry;
mod tabulated_field;
mod three_species;
mod top;
mod turnings;

use crate::gallery::{Experiment, Outcome};
use crate::job::Job;

const fn of(
    name: &'static str,
    share: f64,
    title: &'static str,
    run: fn(&Job<'_>) -> anyhow::Result<Outcome>,
) -> Experiment {
    Experiment { name, title, share, run }
}

/// All experiments, in the order of the papers: Rowley & Marsden, Kosmas & Vlachos, and what goes beyond.
/// Each with its rough share of the time that all take, and its title.
#[rustfmt::skip]
pub const ALL: &[Experiment] = &[
    of("order",               1.0,   "Orders of convergence over σ, linear and vortices", order::run),
    of("stability",           20.0,  "The stability of the σ-family, by running it", stability::run),
    of("fig2-energy",         1.0,   "Energy error of two leapfrogging pairs, VE2 against RK2", energy::run),
    of("fig2-symmetry",       5.0,   "How long the run of Fig. 2 lasts, and its mirror symmetry", symmetry::run),
    of("fig3-leapfrogging",   1.0,   "Trajectories of two leapfrogging pairs", leapfrogging::run),
    of("fig4-quasi-periodic", 25.0,  "Poincaré sections of a quasi-periodic motion", quasi_periodic::run),
    of("fig5-chaotic",        70.0,  "Poincaré sections of a chaotic motion", chaotic::run),
    of("momenta",             1.0,   "Conserved quantities, scheme by scheme", momenta::run),
    of("parasitic",           1.0,   "Growth of the parasitic mode (beyond the paper)", parasitic::run),
    of("oscillator",          10.0,  "The harmonic oscillator, exact at any step", oscillator::run),
    of("kepler-steps",        25.0,  "One third of the steps, in each reading", kepler_steps::run),
    of("kepler-long",         90.0,  "A Kepler orbit with e = 0.95 over 10⁵ periods", kepler_long::run),
    of("kepler-frequency",    1.0,   "The frequency of a Kepler orbit, e = 0.95", kepler_frequency::run),
    of("kepler-work",         30.0,  "Work and precision on Kepler orbits", kepler_work::run),
    of("accuracy-cost",       20.0,  "Accuracy and cost of methods of order 2 to 16", accuracy_cost::run),
    of("barnes",              1.0,   "Barnes's phase flows, and a circle carried along", barnes::run),
    of("double-pendulum",     5.0,   "A chaotic double pendulum, variational against RK4", double_pendulum::run),
    of("friction",            1.0,   "The decay of the energy under friction, variational against RK4", friction::run),
    of("energy-momentum",     1.5,   "Steps that keep the discrete energy, and where there are none", energy_momentum::run),
    of("links",               25.0,  "A pendulum of 50 links by constraints, beside RK4 on its accelerations", links::run),
    of("molecules",           10.0,  "A chain of rigid molecules by RATTLE, beside molecules with stiff springs", molecules::run),
    of("disc",                18.0,  "A disc that rolls and a sleigh that turns: constraints of velocities", disc::run),
    of("spring-chain",        5.0,   "Newmark's method on a chain of stiff and soft springs, beside RK4", spring_chain::run),
    of("beam",                19.0,  "A vibrating beam of 400 degrees of freedom, with small and with large deflections", beam::run),
    of("bounces",             13.0,  "A particle on a curved floor: the energy over 10⁵ bounces", bounces::run),
    of("billiard",            7.0,   "Billiards in an ellipse and in a rounded square: sections by impacts", billiard::run),
    of("top",                 41.0,  "The top of Lagrange against its integrals, by rotation matrices", top::run),
    of("rigid-body",          5.0,   "A free body that flips, against elliptic functions", rigid_body::run),
    of("spherical-pendulum",  18.0,  "A spherical pendulum by unit vectors and by a constraint", spherical_pendulum::run),
    of("round-off",           150.0, "Rounding errors of long runs, with plain and with compensated sums", round_off::run),
    of("lotka-volterra",      2.0,   "Predators and prey, in one step and in two", lotka_volterra::run),
    of("guiding-centre",      8.0,   "A guiding centre in a tokamak, in class and out of class", guiding_centre::run),
    of("tabulated-field",     3.0,   "A guiding centre in a field that comes from a table", tabulated_field::run),
    of("field-lines",         4.0,   "Magnetic field lines of an ABC flow and of a perturbed tokamak", field_lines::run),
    of("phase-space",         1.0,   "The pendulum in phase-space form, by one-step schemes", phase_space::run),
    of("massless-particle",   4.0,   "A charged particle without mass, in two gauges", massless::run),
    of("breather",            11.0,  "A discrete breather of a Schrödinger lattice", schroedinger::run),
    of("sphere-vortices",     9.0,   "Point vortices on a sphere", sphere_vortices::run),
    of("shear-layer",         150.0, "A shear layer of vortex blobs that rolls up", shear_layer::run),
    of("three-species",       1.5,   "Lotka–Volterra with three species", three_species::run),
];
