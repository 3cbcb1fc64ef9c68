//! The experiments, a file each, and the ideas beside them, which several of them may share.

mod accuracy_cost;
mod average_acceleration;
mod barnes;
mod beam;
mod beam_frequencies;
mod billiard;
mod bounces;
mod chaotic;
mod crossings;
mod decay;
mod disc;
mod disc_energy;
mod double_pendulum;
mod energy;
mod energy_momentum;
mod energy_steps;
mod equal_errors;
mod exchange;
mod field_lines;
mod flips;
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
mod longest_steps;
mod lotka_volterra;
mod massless;
mod molecules;
mod momenta;
mod order;
mod oscillator;
mod parasitic;
mod phase_space;
mod poincare_map;
mod quasi_periodic;
mod random_walk;
mod regularised;
mod rigid_body;
mod round_off;
mod schroedinger;
mod sections;
mod shear_layer;
mod sleigh;
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

/// The sources whose experiments the main job reproduces.
pub const SOURCES: [&str; 3] = [ROWLEY, KOSMAS, BARNES];
const ROWLEY: &str = "Rowley & Marsden 2002";
const KOSMAS: &str = "Kosmas & Vlachos 2010";
const BARNES: &str = "Barnes 1997";

const fn of(
    name: &'static str,
    share: f64,
    source: &'static str,
    run: fn(&Job<'_>) -> anyhow::Result<Outcome>,
    title: &'static str,
) -> Experiment {
    Experiment { name, title, source, share, run }
}

/// All experiments, in the order of the papers: Rowley & Marsden, Kosmas & Vlachos, and what goes beyond.
/// Each with its seconds on one core, its source if it has one, and a sentence on what it shows.
#[rustfmt::skip]
pub const ALL: &[Experiment] = &[
    of("order", 0.1, ROWLEY, order::run,
        "The σ-family is of second order on vortices, and two members are of fourth on linear equations"),
    of("stability", 1.5, ROWLEY, stability::run,
        "Which members of the σ-family are stable, and for which steps, by running them"),
    of("fig2-energy", 0.15, ROWLEY, energy::run,
        "With large steps VE2 keeps the energy of two leapfrogging pairs in a band, and RK2 does not"),
    of("fig2-symmetry", 0.5, ROWLEY, symmetry::run,
        "The run of Fig. 2 lasts as long as its mirror symmetry, which rounding breaks at last"),
    of("fig3-leapfrogging", 0.12, ROWLEY, leapfrogging::run,
        "With steps at which RK2 loses them, VE2 keeps two pairs of vortices leapfrogging"),
    of("fig4-quasi-periodic", 2.8, ROWLEY, quasi_periodic::run,
        "On a quasi-periodic motion the sections of VI2 stay curves at a step that spoils those of RK4"),
    of("fig5-chaotic", 11.0, ROWLEY, chaotic::run,
        "On a chaotic motion sections of VI2 stay in the region of accurate orbits, those of RK4 do not"),
    of("momenta", 0.2, ROWLEY, momenta::run,
        "Which scheme keeps which momentum of point vortices, exactly or not"),
    of("parasitic", 0.2, ROWLEY, parasitic::run,
        "The parasitic mode of two-step schemes grows with σ = 0 and σ = ¼, and with σ = ½ it does not"),
    of("oscillator", 1.8, KOSMAS, oscillator::run,
        "Phase fitting solves the harmonic oscillator at any step; momenta need fitted weights"),
    of("kepler-steps", 4.3, KOSMAS, kepler_steps::run,
        "Whether phase fitting takes one third of the steps, in each way to read that claim"),
    of("kepler-long", 250.0, KOSMAS, kepler_long::run,
        "Over 10⁵ periods of an orbit with e = 0.95 the energy stays in limits, and the position does not"),
    of("kepler-frequency", 0.14, KOSMAS, kepler_frequency::run,
        "The fitted frequency along a Kepler orbit with e = 0.95, over ten periods"),
    of("kepler-work", 30.0, "", kepler_work::run,
        "What a digit costs on Kepler orbits, by general methods and by those made for them"),
    of("accuracy-cost", 20.0, "Hairer, Lubich & Wanner 2006; Kahan & Li 1997", accuracy_cost::run,
        "Energy errors of methods of order 2 to 16 against their evaluations, on three problems"),
    of("barnes", 0.11, BARNES, barnes::run,
        "Phase curves of three oscillators are contours of the energy; a circle of points goes along"),
    of("double-pendulum", 5.0, "", double_pendulum::run,
        "Over a long chaotic run the energy of a double pendulum stays in a band, and by RK4 it drifts"),
    of("friction", 1.0, "Kane, Marsden, Ortiz & West 2000; Marsden & West 2001", friction::run,
        "Variational methods lose energy to friction at the right rate, and RK4 adds a rate of its own"),
    of("energy-momentum", 1.5, "Kane, Marsden & Ortiz 1999", energy_momentum::run,
        "Steps of varying length can keep the discrete energy, until there is no such step"),
    of("links", 25.0, "Wendlandt & Marsden 1997; Leimkuhler & Skeel 1994", links::run,
        "A pendulum of 50 links keeps its rods by constraints, and by RK4 on its accelerations it does not"),
    of("molecules", 10.0, "Andersen 1983; Leimkuhler & Skeel 1994", molecules::run,
        "Rigid molecules by RATTLE, and how much shorter steps must be with stiff springs in place of rods"),
    of("disc", 18.0, "Cortés & Martínez 2001; Modin & Verdier 2020", disc::run,
        "Constraints of velocities: a rolling disc and a sleigh, whose energy stays or wanders"),
    of("spring-chain", 5.0, "Kane, Marsden, Ortiz & West 2000; Hairer, Lubich & Wanner 2006",
        spring_chain::run,
        "Newmark's method keeps the energy of stiff springs, and changes how fast they exchange it"),
    of("beam", 19.0, "Simo, Tarnow & Wong 1992; Gonzalez & Simo 1996", beam::run,
        "A vibrating beam of 400 degrees of freedom has its frequencies, and where large steps are lost"),
    of("bounces", 13.0, "Fetecau, Marsden, Ortiz & West 2003", bounces::run,
        "Over 10⁵ bounces on a curved floor the energy stays where impacts keep it, and else it wanders"),
    of("billiard", 7.0, "Birkhoff 1927", billiard::run,
        "Billiards in an ellipse and in a rounded square: regular and chaotic sections by impacts"),
    of("top", 41.0, "Lee, Leok & McClamroch 2007; Goldstein 1980", top::run,
        "The axis of a heavy top turns where theory says, and its matrix stays orthogonal over 10⁷ steps"),
    of("rigid-body", 5.0, "Marsden, Pekarsky & Shkoller 1999; Landau & Lifshitz 1976", rigid_body::run,
        "A free body flips with the period of elliptic functions and keeps its angular momentum in space"),
    of("spherical-pendulum", 18.0, "Lee, Leok & McClamroch 2009", spherical_pendulum::run,
        "A spherical pendulum stays on its sphere along great circles, and by a constraint"),
    of("round-off", 150.0, "Kahan 1965; Brouwer 1937", round_off::run,
        "How rounding errors add up over 10⁸ steps, with plain and with compensated sums"),
    of("lotka-volterra", 2.0, "", lotka_volterra::run,
        "One-step schemes keep predators and prey on closed curves, where the two-step scheme fails"),
    of("guiding-centre", 8.0, "Littlejohn 1983; Kraus 2017", guiding_centre::run,
        "A banana and a passing orbit in a tokamak keep their energy, in class and out of class"),
    of("tabulated-field", 3.0, "de Boor 1978", tabulated_field::run,
        "The banana orbit in a field that comes from a table, by cubic and by quintic splines"),
    of("field-lines", 4.0, "Cary & Littlejohn 1983; Dombre et al. 1986", field_lines::run,
        "Field lines of an ABC flow and of a tokamak with islands; flux surfaces over 10⁵ turns"),
    of("phase-space", 1.2, BARNES, phase_space::run,
        "In phase space one-step schemes are leapfrog and the midpoint rule, and keep areas"),
    of("massless-particle", 4.0, "Kraus 2017", massless::run,
        "One motion in two gauges: one-step schemes in the one, a growing parasitic mode in the other"),
    of("breather", 11.0, "MacKay & Aubry 1994", schroedinger::run,
        "A discrete breather of a Schrödinger lattice keeps its norm and energy over 10⁴ periods"),
    of("sphere-vortices", 9.0, "Polvani & Dritschel 1993", sphere_vortices::run,
        "Vortices on a sphere: a pair and a ring in closed form, and what is kept of their moment"),
    of("shear-layer", 150.0, "Rayleigh 1880; Krasny 1986", shear_layer::run,
        "A shear layer of 10⁵ vortex blobs rolls up at the rate of linear theory, by a fast sum"),
    of("three-species", 1.5, "", three_species::run,
        "Of three species one step keeps xyz to rounding, by a coordinate that is conjugate to the Casimir"),
];

pub fn names() -> Vec<&'static str> {
    ALL.iter().map(|experiment| experiment.name).collect()
}
