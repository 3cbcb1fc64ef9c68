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

/// The sources whose experiments the main job reproduces.
pub const SOURCES: [&str; 3] = [ROWLEY, KOSMAS, BARNES];
const ROWLEY: &str = "Rowley & Marsden 2002";
const KOSMAS: &str = "Kosmas & Vlachos 2010";
const BARNES: &str = "Barnes 1997";

const fn of(
    name: &'static str,
    share: f64,
    title: &'static str,
    source: &'static str,
    run: fn(&Job<'_>) -> anyhow::Result<Outcome>,
) -> Experiment {
    Experiment { name, title, source, share, run }
}

/// All experiments, in the order of the papers: Rowley & Marsden, Kosmas & Vlachos, and what goes beyond.
/// Each with the seconds that it takes on one core, its title, and its source if it has one.
#[rustfmt::skip]
pub const ALL: &[Experiment] = &[
    of("order", 0.1, "Orders of convergence over σ, linear and vortices",
        ROWLEY, order::run),
    of("stability", 1.5, "The stability of the σ-family, by running it",
        ROWLEY, stability::run),
    of("fig2-energy", 0.15, "Energy error of two leapfrogging pairs, VE2 against RK2",
        ROWLEY, energy::run),
    of("fig2-symmetry", 0.5, "How long the run of Fig. 2 lasts, and its mirror symmetry",
        ROWLEY, symmetry::run),
    of("fig3-leapfrogging", 0.12, "Trajectories of two leapfrogging pairs",
        ROWLEY, leapfrogging::run),
    of("fig4-quasi-periodic", 2.8, "Poincaré sections of a quasi-periodic motion",
        ROWLEY, quasi_periodic::run),
    of("fig5-chaotic", 11.0, "Poincaré sections of a chaotic motion",
        ROWLEY, chaotic::run),
    of("momenta", 0.2, "Conserved quantities, scheme by scheme",
        ROWLEY, momenta::run),
    of("parasitic", 0.2, "Growth of the parasitic mode (beyond the paper)",
        ROWLEY, parasitic::run),
    of("oscillator", 1.8, "The harmonic oscillator, exact at any step",
        KOSMAS, oscillator::run),
    of("kepler-steps", 4.3, "One third of the steps, in each reading",
        KOSMAS, kepler_steps::run),
    of("kepler-long", 160.0, "A Kepler orbit with e = 0.95 over 10⁵ periods",
        KOSMAS, kepler_long::run),
    of("kepler-frequency", 0.14, "The frequency of a Kepler orbit, e = 0.95",
        KOSMAS, kepler_frequency::run),
    of("kepler-work", 30.0, "Work and precision on Kepler orbits",
        "", kepler_work::run),
    of("accuracy-cost", 20.0, "Accuracy and cost of methods of order 2 to 16",
        "Hairer, Lubich & Wanner 2006; Kahan & Li 1997", accuracy_cost::run),
    of("barnes", 0.11, "Barnes's phase flows, and a circle carried along",
        BARNES, barnes::run),
    of("double-pendulum", 5.0, "A chaotic double pendulum, variational against RK4",
        "", double_pendulum::run),
    of("friction", 1.0, "The decay of the energy under friction, variational against RK4",
        "Kane, Marsden, Ortiz & West 2000; Marsden & West 2001", friction::run),
    of("energy-momentum", 1.5, "Steps that keep the discrete energy, and where there are none",
        "Kane, Marsden & Ortiz 1999", energy_momentum::run),
    of("links", 25.0, "A pendulum of 50 links by constraints, beside RK4 on its accelerations",
        "Wendlandt & Marsden 1997; Leimkuhler & Skeel 1994", links::run),
    of("molecules", 10.0, "A chain of rigid molecules by RATTLE, beside molecules with stiff springs",
        "Andersen 1983; Leimkuhler & Skeel 1994", molecules::run),
    of("disc", 18.0, "A disc that rolls and a sleigh that turns: constraints of velocities",
        "Cortés & Martínez 2001; Modin & Verdier 2020", disc::run),
    of("spring-chain", 5.0, "Newmark's method on a chain of stiff and soft springs, beside RK4",
        "Kane, Marsden, Ortiz & West 2000; Hairer, Lubich & Wanner 2006", spring_chain::run),
    of("beam", 19.0, "A vibrating beam of 400 degrees of freedom, with small and with large deflections",
        "Simo, Tarnow & Wong 1992; Gonzalez & Simo 1996", beam::run),
    of("bounces", 13.0, "A particle on a curved floor: the energy over 10⁵ bounces",
        "Fetecau, Marsden, Ortiz & West 2003", bounces::run),
    of("billiard", 7.0, "Billiards in an ellipse and in a rounded square: sections by impacts",
        "Birkhoff 1927", billiard::run),
    of("top", 41.0, "The top of Lagrange against its integrals, by rotation matrices",
        "Lee, Leok & McClamroch 2007; Goldstein 1980", top::run),
    of("rigid-body", 5.0, "A free body that flips, against elliptic functions",
        "Marsden, Pekarsky & Shkoller 1999; Landau & Lifshitz 1976", rigid_body::run),
    of("spherical-pendulum", 18.0, "A spherical pendulum by unit vectors and by a constraint",
        "Lee, Leok & McClamroch 2009", spherical_pendulum::run),
    of("round-off", 150.0, "Rounding errors of long runs, with plain and with compensated sums",
        "Kahan 1965; Brouwer 1937", round_off::run),
    of("lotka-volterra", 2.0, "Predators and prey, in one step and in two",
        "", lotka_volterra::run),
    of("guiding-centre", 8.0, "A guiding centre in a tokamak, in class and out of class",
        "Littlejohn 1983; Kraus 2017", guiding_centre::run),
    of("tabulated-field", 3.0, "A guiding centre in a field that comes from a table",
        "de Boor 1978", tabulated_field::run),
    of("field-lines", 4.0, "Magnetic field lines of an ABC flow and of a perturbed tokamak",
        "Cary & Littlejohn 1983; Dombre et al. 1986", field_lines::run),
    of("phase-space", 0.2, "The pendulum in phase-space form, by one-step schemes",
        BARNES, phase_space::run),
    of("massless-particle", 4.0, "A charged particle without mass, in two gauges",
        "Kraus 2017", massless::run),
    of("breather", 11.0, "A discrete breather of a Schrödinger lattice",
        "MacKay & Aubry 1994", schroedinger::run),
    of("sphere-vortices", 9.0, "Point vortices on a sphere",
        "Polvani & Dritschel 1993", sphere_vortices::run),
    of("shear-layer", 150.0, "A shear layer of vortex blobs that rolls up",
        "Rayleigh 1880; Krasny 1986", shear_layer::run),
    of("three-species", 1.5, "Lotka–Volterra with three species",
        "", three_species::run),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_main_job_has_each_claim_of_a_paper() -> anyhow::Result<()> {
        let mut full = csv::Reader::from_reader(include_str!("../../full-run.csv").as_bytes());
        let mut claims = 0;
        for row in full.records() {
            let row = row?;
            if &row[3] == "claim" && &row[4] != crate::claim::BEYOND {
                let found = ALL.iter().find(|experiment| experiment.name == &row[0]);
                assert!(found.is_some_and(Experiment::is_of_a_paper), "{row:?}");
                claims += 1;
            }
        }
        assert!(claims >= 30, "{claims}");
        Ok(())
    }
}
