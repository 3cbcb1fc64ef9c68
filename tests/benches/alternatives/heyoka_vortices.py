"""Taylor's method of heyoka, compiled for this processor, with and without fast_math."""

import heyoka as hy
import numpy as np

from vortices import END, PAIRS, START, error, milliseconds, row

names = [f"x{j}" for j in range(4)] + [f"y{j}" for j in range(4)]
variables = hy.make_vars(*names)
x, y = variables[:4], variables[4:]
slope = [hy.expression(0.0)] * 8
for j, k in PAIRS:
    dx, dy = x[j] - x[k], y[j] - y[k]
    inverse = 1.0 / (2.0 * np.pi) / (dx * dx + dy * dy)
    slope[j] = slope[j] - inverse * dy
    slope[4 + j] = slope[4 + j] + inverse * dx
    slope[k] = slope[k] + inverse * dy
    slope[4 + k] = slope[4 + k] - inverse * dx
system = list(zip(variables, slope))

for name, options in [("heyoka", {}), ("heyoka fast_math", {"fast_math": True})]:
    for tolerance in [10.0**-k for k in range(6, 17)]:
        run = hy.taylor_adaptive(system, START.copy(), tol=tolerance, **options)

        def alone():
            run.time = 0.0
            run.state[:] = START
            run.propagate_until(END)

        # The ends of all steps, in a run that is not timed.
        run.time = 0.0
        run.state[:] = START
        states = []
        while run.time < END:
            run.step(END - run.time)
            states.append(run.state.copy())
        row("vortices", name, tolerance, milliseconds(alone), error(states))
