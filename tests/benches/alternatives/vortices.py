"""Four equal vortices: data, energy, and how times are measured."""

import time

import numpy as np

START = np.array([1.0, 0.866, -0.85, -0.5, 1.0, 0.45, -1.363636, -0.15])
END = 1000.0
PAIRS = [(j, k) for j in range(4) for k in range(j + 1, 4)]


def energy(states):
    """H of states, one in each row."""
    square = lambda j, k: (states[:, j] - states[:, k]) ** 2 + (states[:, 4 + j] - states[:, 4 + k]) ** 2
    return sum(np.log(square(j, k)) for j, k in PAIRS) / (4 * np.pi)


def error(states):
    """The largest change of H."""
    return float(np.abs(energy(np.asarray(states)) - energy(START[None, :])[0]).max())


def milliseconds(run, rounds=7):
    """The median, in time of the processor."""
    times = []
    for _ in range(rounds):
        begin = time.process_time_ns()
        run()
        times.append((time.process_time_ns() - begin) / 1e6)
    return sorted(times)[rounds // 2]


def row(problem, method, knob, time, deviation, evaluations=""):
    """One row of the table that the benchmark reads."""
    print(f"{problem},{method},{knob!r},{time!r},{deviation!r},{evaluations}")
