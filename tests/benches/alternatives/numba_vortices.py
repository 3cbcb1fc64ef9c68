"""RK4 and the implicit midpoint rule by fixed point, as loops that numba compiles."""

import numba
import numpy as np

from vortices import END, START, error, milliseconds, row

STRENGTH = 1.0 / (2.0 * np.pi)


@numba.njit(fastmath=False)
def velocity(z, v):
    v[:] = 0.0
    for j in range(4):
        for k in range(j + 1, 4):
            dx, dy = z[j] - z[k], z[4 + j] - z[4 + k]
            inverse = STRENGTH / (dx * dx + dy * dy)
            v[j] -= inverse * dy
            v[4 + j] += inverse * dx
            v[k] += inverse * dy
            v[4 + k] -= inverse * dx


@numba.njit
def rk4(start, h, steps, states):
    """The end; of `states`, the first rows are set to the ends of the steps, as many as there are."""
    z, k1, k2, k3, k4, at = start.copy(), np.empty(8), np.empty(8), np.empty(8), np.empty(8), np.empty(8)
    for step in range(steps):
        velocity(z, k1)
        for i in range(8):
            at[i] = z[i] + 0.5 * h * k1[i]
        velocity(at, k2)
        for i in range(8):
            at[i] = z[i] + 0.5 * h * k2[i]
        velocity(at, k3)
        for i in range(8):
            at[i] = z[i] + h * k3[i]
        velocity(at, k4)
        for i in range(8):
            z[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])
        if step < states.shape[0]:
            states[step] = z
    return z, 4 * steps


@numba.njit
def midpoint(start, h, steps, states):
    """The same for the implicit midpoint rule, from the last velocity, down to changes of 1e-13."""
    z, v, at, new = start.copy(), np.empty(8), np.empty(8), np.empty(8)
    velocity(z, v)
    count = 1
    for step in range(steps):
        for _ in range(50):
            for i in range(8):
                at[i] = z[i] + 0.5 * h * v[i]
            velocity(at, new)
            count += 1
            change = 0.0
            for i in range(8):
                change = max(change, abs(h * (new[i] - v[i])))
                v[i] = new[i]
            if change < 1e-13:
                break
        for i in range(8):
            z[i] += h * v[i]
        if step < states.shape[0]:
            states[step] = z
    return z, count


for name, method, counts in [
    ("numba RK4", rk4, [12_500 * 2**k for k in range(6)]),
    ("numba midpoint rule", midpoint, [12_500 * 2**k for k in range(6)]),
]:
    nothing = np.empty((0, 8))
    for steps in counts:
        states = np.empty((steps, 8))
        _, evaluations = method(START, END / steps, steps, states)
        time = milliseconds(lambda: method(START, END / steps, steps, nothing))
        row("vortices", name, float(steps), time, error(states), evaluations)
