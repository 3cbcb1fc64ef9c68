//! The figure and the table.

use std::f64::consts::TAU;

use anyhow::Result;

use super::{BODY, DRAWN, H, Measured, OMEGA, Series, length};
use crate::deviation::Deviation;
use crate::experiments::drifts::Drifts;
use crate::figure::{
    Anchor, Axis, BLUE, Colour, Figure, GREEN, PURPLE, Panel, SLATE, Stroke, VERMILLION, scientific,
};
use crate::models::RigidBodyState;
use crate::output::{Table, number};

/// From where the sphere is seen: the angle about the third axis, and that above the plane of the others.
const VIEW: [f64; 2] = [1.05, 0.42];

pub(super) fn figure(measured: &Measured) -> Figure {
    let [a, b, c] = BODY.inertia;
    Figure::new(
        "A free body that flips",
        format!(
            "Moments of inertia {a}, {b} and {c}; rotation matrices along geodesics of SO(3), trapezoidal rule, *h* = {H}. It begins with \
             *ω* = ({}, {}, {}).",
            OMEGA[0], OMEGA[1], OMEGA[2]
        ),
    )
    .row(400.0, vec![sphere(measured), middle(measured)])
    .row(
        300.0,
        vec![
            long(measured, ["Energy", "largest |*E* − *E*(0)|"], [1e-10, 1e-1], |series| &series.energy),
            long(measured, ["Angular momentum in space", "|*M* − *M*(0)| / |*M*|"], [1e-17, 10.0], |series| {
                &series.space
            })
            .without_legend(),
            long(measured, ["Orthogonality", "max |*R*ᵀ*R* − 1|"], [1e-17, 10.0], |series| &series.defect).without_legend(),
        ],
    )
    .footer(format!(
        "The sphere shows directions of the angular momentum in the body, with the curve that flips in red. Below: {} steps.",
        scientific(measured.steps as f64)
    ))
}

/// Right and up in the picture, and towards the eye.
fn seen([x, y, z]: [f64; 3]) -> [f64; 3] {
    let [turn, tilt] = VIEW;
    let (right, ahead) = (y * turn.cos() - x * turn.sin(), x * turn.cos() + y * turn.sin());
    [right, z * tilt.cos() - ahead * tilt.sin(), ahead * tilt.cos() + z * tilt.sin()]
}

/// The directions of the angular momentum in the body, as far as they are in front.
fn front(states: &[RigidBodyState]) -> Vec<[f64; 2]> {
    let visible = |[x, y, towards]: [f64; 3]| if towards > 0.0 { [x, y] } else { [f64::NAN; 2] };
    let direction = |momentum: [f64; 3]| momentum.map(|x| x / length(momentum));
    states.iter().map(|state| visible(seen(direction(BODY.momentum_at(state))))).collect()
}

fn sphere(measured: &Measured) -> Panel {
    let circle = (0..=200).map(|k| TAU * f64::from(k) / 200.0).map(|phi| [phi.cos(), phi.sin()]).collect();
    let axis = || Axis::linear("").within(-1.15, 1.15);
    let panel = Panel::new("Angular momentum in the body", axis(), axis())
        .equal()
        .line(circle, Stroke::solid(SLATE).width(1.0));
    let panel = measured.polhodes.iter().enumerate().fold(panel, |panel, (i, path)| {
        let colour = if i < measured.polhodes.len() / 2 { BLUE } else { GREEN };
        panel.line(front(path), Stroke::solid(colour).width(1.2))
    });
    let names = ["1", "2", "3"].into_iter().enumerate();
    names.fold(panel.line(front(&measured.flipping), Stroke::solid(VERMILLION)), |panel, (k, name)| {
        let mut end = [0.0; 3];
        end[k] = 1.0;
        let [x, y, _] = seen(end);
        panel.dots(vec![[x, y]], 3.0, SLATE).note([x + 0.05, y - 0.1], Anchor::Start, SLATE, name)
    })
}

fn middle(measured: &Measured) -> Panel {
    let exact =
        (0..=1600).map(|k| DRAWN * f64::from(k) / 1600.0).map(|t| [t, measured.wave.at(t)]).collect();
    let all = measured.flipping.iter().enumerate().step_by(20);
    let steps = all.map(|(k, state)| [k as f64 * H, state.omega_R[1]]).collect();
    Panel::new(
        "The middle component of the angular velocity",
        Axis::linear("time *t*").within(0.0, DRAWN),
        Axis::linear("*ω*₂").within(-1.2, 1.5),
    )
    .line(exact, Stroke::solid(SLATE).width(1.2))
    .labelled("elliptic function")
    .dots(steps, 2.4, PURPLE)
    .labelled("every 20th step")
    .weight(1.7)
}

fn all(measured: &Measured) -> [(&Series, Colour); 2] {
    [(&measured.rk4, VERMILLION), (&measured.geodesic, BLUE)]
}

fn long(
    measured: &Measured,
    [title, label]: [&str; 2],
    range: [f64; 2],
    of: fn(&Series) -> &Deviation,
) -> Panel {
    let drifts = Drifts { title, label, range, end: measured.steps as f64 * H };
    drifts.panel(all(measured).map(|(series, colour)| (series.name, colour, of(series))))
}

pub(super) fn table(measured: &Measured) -> Result<Table> {
    let columns = ["method", "t", "largest_energy_error", "largest_change_of_momentum", "largest_defect"];
    let mut table = Table::new(&columns)?;
    for (series, _) in all(measured) {
        let [energy, space, defect] =
            [&series.energy, &series.space, &series.defect].map(|of| of.envelope.magnitude());
        for ((energy, space), defect) in energy.into_iter().zip(space).zip(defect) {
            let numbers = [energy[0], energy[1], space[1], defect[1]].map(number);
            table.row([series.name.to_owned()].into_iter().chain(numbers))?;
        }
    }
    Ok(table)
}
