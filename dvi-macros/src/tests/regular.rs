//! The same for regular systems.

use expect_test::expect;
use proc_macro2::TokenStream;
use quote::quote;

use super::check_expansion;
use crate::expand::lagrangian;

fn kepler() -> TokenStream {
    lagrangian(
        quote! {
            coordinates(x, y),
            lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / (x * x + y * y).sqrt(),
        },
        quote! { struct Kepler { mu: f64 } },
    )
}

#[test]
fn kepler_linearized() {
    check_expansion(
        kepler(),
        "linearize",
        &expect![[r#"
            fn linearize() {
                let (__q0, __rest) = q_.split_at(1usize);
                let (__q1, __rest) = __rest.split_at(1usize);
                let _ = __rest;
                let (__v0, __rest) = v_.split_at(1usize);
                let (__v1, __rest) = __rest.split_at(1usize);
                let _ = __rest;
                l_q_.fill(T::lift(-0.0));
                let (__l_q0, __rest) = l_q_.split_at_mut(1usize);
                let (__l_q1, __rest) = __rest.split_at_mut(1usize);
                let _ = __rest;
                l_v_.fill(T::lift(-0.0));
                let (__l_v0, __rest) = l_v_.split_at_mut(1usize);
                let (__l_v1, __rest) = __rest.split_at_mut(1usize);
                let _ = __rest;
                let __offset0: usize = 0usize;
                let __offset1: usize = 1usize;
                let __r0 = __q0[0usize];
                let __r2 = __r0 * __r0;
                let __r3 = __q1[0usize];
                let __r4 = __r3 * __r3;
                let __r7 = T::lift(1f64)
                    / (T::sqrt((__r2 + __r4)));
                let __r9 = __r7 * __r7;
                let __r11 = __r7
                    * (T::lift(
                        __private::Number::number(self.mu),
                    ) * __r9);
                let __r17 = T::lift(3f64) * __r9;
                let __r21 = w_.qq * __r11;
                let __r25 = ((__r0 * __r3) * __r17) * __r21;
                let __r26 = w_.vv;
                __l_q0[0usize] -= (__r0 * __r11);
                __l_v0[0usize] += __v0[0usize];
                __l_q1[0usize] -= (__r3 * __r11);
                __l_v1[0usize] += __v1[0usize];
                Sink::add(
                    sink_,
                    __offset0 + 0usize,
                    __offset0 + 0usize,
                    (((__r17 * __r2) - T::lift(1f64)) * __r21),
                );
                Sink::add(sink_, __offset0 + 0usize, __offset1 + 0usize, __r25);
                Sink::add(sink_, __offset1 + 0usize, __offset0 + 0usize, __r25);
                Sink::add(sink_, __offset0 + 0usize, __offset0 + 0usize, __r26);
                Sink::add(
                    sink_,
                    __offset1 + 0usize,
                    __offset1 + 0usize,
                    (((__r17 * __r4) - T::lift(1f64)) * __r21),
                );
                Sink::add(sink_, __offset1 + 0usize, __offset1 + 0usize, __r26);
            }
        "#]],
    );
}

#[test]
fn energy_of_kepler() {
    check_expansion(
        kepler(),
        "energy",
        &expect![[r#"
            fn energy() {
                let (__q0, __rest) = q_.split_at(1usize);
                let (__q1, __rest) = __rest.split_at(1usize);
                let _ = __rest;
                let (__v0, __rest) = v_.split_at(1usize);
                let (__v1, __rest) = __rest.split_at(1usize);
                let _ = __rest;
                let __r1 = __v0[0usize];
                let __r3 = __v1[0usize];
                let __r9 = __q0[0usize];
                let __r11 = __q1[0usize];
                (T::lift(0.5f64)
                    * (((__r1 * __r1) + (__r3 * __r3))
                        - ((T::lift(2f64)
                            * T::lift(
                                __private::Number::number(self.mu),
                            ))
                            / (T::sqrt(((__r9 * __r9) + (__r11 * __r11)))))))
            }
        "#]],
    );
}

/// A separable system reads no velocity.
#[test]
fn force_of_kepler() {
    check_expansion(
        kepler(),
        "force",
        &expect![[r#"
            fn force() {
                let (__q0, __rest) = q_.split_at(1usize);
                let (__q1, __rest) = __rest.split_at(1usize);
                let _ = __rest;
                out_.fill(T::lift(-0.0));
                let (__vector0, __rest) = out_.split_at_mut(1usize);
                let (__vector1, __rest) = __rest.split_at_mut(1usize);
                let _ = __rest;
                let __r0 = __q0[0usize];
                let __r4 = __q1[0usize];
                let __r8 = T::lift(1f64)
                    / (T::sqrt(((__r0 * __r0) + (__r4 * __r4))));
                let __r11 = (T::lift(
                    __private::Number::number(self.mu),
                ) * __r8) * (__r8 * __r8);
                __vector0[0usize] -= (__r0 * __r11);
                __vector1[0usize] -= (__r4 * __r11);
            }
        "#]],
    );
}

/// One loop holds both T and V.
#[test]
fn energy_of_a_chain() {
    let chain = lagrangian(
        quote! {
            coordinates(q[N]),
            lagrangian = sum(0..N, |j| mass[j] * dot(q[j]).powi(2) / 2.0 - (1.0 - (q[(j + 1) % N] - q[j]).cos())),
        },
        quote! { struct Chain<const N: usize> { mass: [f64; N] } },
    );
    check_expansion(
        chain,
        "energy",
        &expect![[r#"
            fn energy() {
                let (__q0, __rest) = q_.split_at(N);
                let _ = __rest;
                let (__v0, __rest) = v_.split_at(N);
                let _ = __rest;
                let mut __r14 = T::lift(-0.0);
                for __i0 in (0usize)..(N) {
                    let __r2 = __v0[__i0];
                    let __r13 = ((T::lift(
                        __private::Number::number(self.mass[__i0]),
                    ) * __r2) * __r2)
                        + (T::lift(2f64)
                            * (T::lift(1f64)
                                - (T::cos(
                                    (__q0[__private::wrap(
                                        (1i64 + 1i64 * (__i0 as i64)),
                                        (0i64 + 1i64 * (N as i64)),
                                    )] - __q0[__i0]),
                                ))));
                    __r14 += __r13;
                }
                (T::lift(0.5f64) * __r14)
            }
        "#]],
    );
}

#[test]
fn state_of_kepler() {
    check_expansion(
        kepler(),
        "write",
        &expect![[r#"
            fn write() {
                let mut __at = 0usize;
                q_[__at] = self.x;
                __at += 1usize;
                q_[__at] = self.y;
                __at += 1usize;
                let mut __at = 0usize;
                v_[__at] = self.dot_x;
                __at += 1usize;
                v_[__at] = self.dot_y;
                __at += 1usize;
                ::core::result::Result::Ok(())
            }
        "#]],
    );
}

fn hanging_chain() -> TokenStream {
    lagrangian(
        quote! {
            coordinates(x[n], y[n]),
            lagrangian = sum(0..n, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0,
            constraint(i in 0..n - 1) = (x[i + 1] - x[i]) * (y[i] - t) - rods[i],
            constraint = sum(0..n, |j| x[j] * x[j]),
        },
        quote! { struct Chain { n: usize, rods: Vec<f64> } },
    )
}

#[test]
fn constraints_of_a_chain_with_their_jacobian() {
    check_expansion(
        hanging_chain(),
        "constraint_jacobian",
        &expect![[r#"
            fn constraint_jacobian() {
                let (__q0, __rest) = q_.split_at(self.n);
                let (__q1, __rest) = __rest.split_at(self.n);
                let _ = __rest;
                out_.fill(T::lift(-0.0));
                let (__g0, __rest) = out_.split_at_mut((self.n).saturating_sub(1usize));
                let (__g1, __rest) = __rest.split_at_mut(1usize);
                let _ = __rest;
                let __row0: usize = 0usize;
                let __row1: usize = __row0 + (self.n).saturating_sub(1usize);
                let __offset0: usize = 0usize;
                let __offset1: usize = self.n;
                let __r4 = t_;
                let mut __r10 = T::lift(-0.0);
                for __i0 in (0usize)..(self.n) {
                    let __r0 = __q0[__i0];
                    let __r9 = __r0 * __r0;
                    Sink::add(
                        sink_,
                        __row1 + 0usize,
                        __offset0 + __i0,
                        (T::lift(2f64) * __r0),
                    );
                    __r10 += __r9;
                }
                for __i0 in (0usize)..((self.n).saturating_sub(1usize)) {
                    let __r0 = __q0[__i0];
                    let __r2 = __q0[__i0 + 1usize] - __r0;
                    let __r5 = __q1[__i0] - __r4;
                    __g0[__i0]
                        += ((__r2 * __r5)
                            - T::lift(
                                __private::Number::number(self.rods[__i0]),
                            ));
                    Sink::add(sink_, __row0 + __i0, __offset0 + __i0, (-__r5));
                    Sink::add(sink_, __row0 + __i0, __offset1 + __i0, __r2);
                    Sink::add(sink_, __row0 + __i0, __offset0 + __i0 + 1usize, __r5);
                }
                __g1[0usize] += __r10;
            }
        "#]],
    );
}

#[test]
fn constraints_of_a_chain_along_a_motion() {
    check_expansion(
        hanging_chain(),
        "constraint_curvature",
        &expect![[r#"
            fn constraint_curvature() {
                let (__v0, __rest) = v_.split_at(self.n);
                let (__v1, __rest) = __rest.split_at(self.n);
                let _ = __rest;
                out_.fill(T::lift(-0.0));
                let (__g0, __rest) = out_.split_at_mut((self.n).saturating_sub(1usize));
                let (__g1, __rest) = __rest.split_at_mut(1usize);
                let _ = __rest;
                let mut __r12 = T::lift(-0.0);
                __private::widest::<
                    T,
                    _,
                >(
                    q_.len(),
                    #[cfg_attr(not(debug_assertions), inline(always))]
                    || {
                        let __whole = __private::whole(0usize, self.n);
                        {
                            let mut __sum12 = __private::Sums::<T>::empty();
                            for __i0 in __private::packs::<T>(0usize, __whole) {
                                let __r0 = __private::load(__v0, __i0);
                                let __r11 = __r0 * __r0;
                                __sum12.add_terms(__r11);
                            }
                            __r12 += __sum12.total();
                        }
                        for __i0 in __whole..self.n {
                            let __r0 = __v0[__i0];
                            let __r11 = __r0 * __r0;
                            __r12 += __r11;
                        }
                    },
                );
                for __i0 in (0usize)..((self.n).saturating_sub(1usize)) {
                    let __r0 = __v0[__i0];
                    let __r1 = __v0[__i0 + 1usize];
                    let __r2 = __r0 - __r1;
                    let __r4 = __v1[__i0];
                    let __r5 = __r4 - T::lift(1f64);
                    __g0[__i0] += (__r2 + (__r1 * __r5) - (__r0 * __r5) - (__r4 * __r2));
                }
                __g1[0usize] += (T::lift(2f64) * __r12);
            }
        "#]],
    );
}

#[test]
fn the_rods_of_a_chain_are_checked() {
    check_expansion(
        hanging_chain(),
        "check",
        &expect![[r#"
            fn check() {
                __private::check_sizes(self)?;
                __private::check_indices(
                    "x",
                    (0i128),
                    (-1i128 + 1i128 * (self.n as i128)),
                    self.n,
                )?;
                __private::check_indices(
                    "x",
                    (1i128),
                    (0i128 + 1i128 * (self.n as i128)),
                    self.n,
                )?;
                __private::check_indices(
                    "y",
                    (0i128),
                    (-1i128 + 1i128 * (self.n as i128)),
                    self.n,
                )?;
                __private::check_indices(
                    "rods",
                    (0i128),
                    (-1i128 + 1i128 * (self.n as i128)),
                    self.rods.len(),
                )?;
                ::core::result::Result::Ok(())
            }
        "#]],
    );
}

#[test]
fn the_spaces_of_a_chain_are_known_at_run_time() {
    check_expansion(
        hanging_chain(),
        "augmented",
        &expect![[r#"
        fn augmented() {
            RunTime {
                dimension: 2usize * self.n + 1usize + (self.n).saturating_sub(1usize),
            }
        }
    "#]],
    );
}

fn train() -> TokenStream {
    lagrangian(
        quote! {
            coordinates(x[n], y[n]),
            lagrangian = sum(0..n, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0,
            nonholonomic(i in 0..n) = dot(x[i]) * y[i] - slope * t,
            nonholonomic = dot(x[0]) - sum(0..n, |j| x[j] * dot(y[j])),
        },
        quote! { struct Train { n: usize, slope: f64 } },
    )
}

#[test]
fn constraints_of_velocities_with_their_weighted_derivatives() {
    check_expansion(
        train(),
        "velocity_constraint_jacobian",
        &expect![[r#"
            fn velocity_constraint_jacobian() {
                let (__q0, __rest) = q_.split_at(self.n);
                let (__q1, __rest) = __rest.split_at(self.n);
                let _ = __rest;
                let (__v0, __rest) = v_.split_at(self.n);
                let (__v1, __rest) = __rest.split_at(self.n);
                let _ = __rest;
                out_.fill(T::lift(-0.0));
                let (__g0, __rest) = out_.split_at_mut(self.n);
                let (__g1, __rest) = __rest.split_at_mut(1usize);
                let _ = __rest;
                let __row0: usize = 0usize;
                let __row1: usize = __row0 + self.n;
                let __offset0: usize = 0usize;
                let __offset1: usize = self.n;
                let __r5 = T::lift(
                    __private::Number::number(self.slope),
                ) * t_;
                let __r13 = w_[1usize];
                let __r15 = w_[0usize];
                let mut __r11 = T::lift(-0.0);
                for __i0 in (0usize)..(self.n) {
                    let __r0 = __v0[__i0];
                    let __r1 = __q1[__i0];
                    let __r8 = __q0[__i0];
                    let __r9 = __v1[__i0];
                    let __r10 = __r8 * __r9;
                    __g0[__i0] += ((__r0 * __r1) - __r5);
                    Sink::add(sink_, __row0 + __i0, __offset0 + __i0, (__r13 * __r1));
                    Sink::add(sink_, __row0 + __i0, __offset1 + __i0, (__r15 * __r0));
                    Sink::add(
                        sink_,
                        __row1 + 0usize,
                        __offset0 + __i0,
                        (-(__r15 * __r9)),
                    );
                    Sink::add(
                        sink_,
                        __row1 + 0usize,
                        __offset1 + __i0,
                        (-(__r13 * __r8)),
                    );
                    __r11 += __r10;
                }
                __g1[0usize] += (__v0[0usize] - __r11);
                Sink::add(sink_, __row1 + 0usize, __offset0 + 0usize, __r13);
            }
        "#]],
    );
}

#[test]
fn constraints_of_velocities_along_a_motion() {
    check_expansion(
        train(),
        "velocity_constraint_rate",
        &expect![[r#"
            fn velocity_constraint_rate() {
                let (__v0, __rest) = v_.split_at(self.n);
                let (__v1, __rest) = __rest.split_at(self.n);
                let _ = __rest;
                out_.fill(T::lift(-0.0));
                let (__g0, __rest) = out_.split_at_mut(self.n);
                let (__g1, __rest) = __rest.split_at_mut(1usize);
                let _ = __rest;
                let __r0 = T::lift(
                    __private::Number::number(self.slope),
                );
                let mut __r5 = T::lift(-0.0);
                for __i0 in (0usize)..(self.n) {
                    let __r3 = __v0[__i0] * __v1[__i0];
                    __g0[__i0] -= (__r0 - __r3);
                    __r5 += __r3;
                }
                __g1[0usize] -= __r5;
            }
        "#]],
    );
}

/// Whether the report of seven bodies in the plane with this potential speaks of close encounters.
fn speaks_of_encounters(potential: &str) -> bool {
    let potential: TokenStream = potential.parse().expect("tokens");
    let attribute = quote!(
        coordinates(x[7], y[7]),
        lagrangian = sum(0..7, |j| m[j] * (dot(x[j]).powi(2) + dot(y[j]).powi(2)) / 2.0) - (#potential),
    );
    let output = lagrangian(
        attribute,
        quote!(
            struct Bodies {
                m: [f64; 7],
                a: f64,
            }
        ),
    )
    .to_string();
    assert!(output.contains("Begin with `Variational::trapezoid()`."), "{output:.300}");
    output.contains("`Reversible`") && output.contains("`ErrorControl`")
}

#[test]
fn a_pole_where_bodies_meet_is_seen() {
    for pole in [
        // Pleiades
        "-sum_pairs(0..7, |j, k| m[j] * m[k] / ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).sqrt())",
        "-sum_pairs(0..7, |j, k| m[j] * m[k] / (x[j] - x[k]).hypot(y[j] - y[k]))",
        "-sum_ordered_pairs(0..7, |j, k| m[j] * (x[j] - x[k]).hypot(y[k] - y[j]).powf(-0.7))",
        "sum_pairs(0..7, |j, k| (x[j] - x[k]).hypot(y[j] - y[k]).ln())",
        "sum(0..6, |j| (a / (x[j + 1] - x[j])).powi(12) - (a / (x[j + 1] - x[j])).powi(6))",
    ] {
        assert!(speaks_of_encounters(pole), "{pole}");
    }
    for smooth in [
        // Softened, around a fixed centre, springs, and a lattice whose bodies may pass.
        "-sum_pairs(0..7, |j, k| m[j] * m[k] / ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) + a * \
         a).sqrt())",
        "-sum(0..7, |j| m[j] / x[j].hypot(y[j]))",
        "sum_pairs(0..7, |j, k| (x[j] - x[k]).powi(2) / a + (y[j] - y[k]).cosh().ln())",
        "sum(0..6, |j| (x[j + 1] - x[j]).exp() / m[j])",
    ] {
        assert!(!speaks_of_encounters(smooth), "{smooth}");
    }
}
