//! The systems and starts of these tests, and runs of them.

use dvi_tests::zoo::regular::*;

pub(crate) fn double_pendulum() -> (DoublePendulum, DoublePendulumState) {
    let system = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 9.81 };
    (system, DoublePendulumState { a: 1.1, b: -0.4, dot_a: 0.3, dot_b: 0.9 })
}

pub(crate) fn chain() -> (RunTimeChain, RunTimeChainState) {
    let system = RunTimeChain { mass: vec![1.0, 1.5, 0.7], coupling: 0.2 };
    let start =
        RunTimeChainState { q: vec![0.1, -0.2, 0.4], wall: 0.3, dot_q: vec![0.5, 0.0, -0.1], dot_wall: 0.2 };
    (system, start)
}
