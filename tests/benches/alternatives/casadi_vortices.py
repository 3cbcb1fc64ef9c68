"""Residual p + D1 L_d(q1, q2) and Jacobian D2 D1 L_d(q1, q2) of a step of the midpoint rule, generated as C by CasADi, and called in a
loop of another file, so that nothing is left out."""

import subprocess

import casadi as ca

from vortices import PAIRS, row

H, COUNT, ROUNDS = 0.1, 200_000, 15

LOOP = """
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#define casadi_int long long int
int step(const double **in, double **out, casadi_int *iw, double *w, int memory);
static int order(const void *a, const void *b) { double d = *(double *)a - *(double *)b; return (d > 0) - (d < 0); }
int main(void) {
    double q[3][8], residual[8], *matrix = calloc(64, sizeof(double)), times[ROUNDS];
    for (int k = 0; k < 3; k++) for (int i = 0; i < 8; i++) q[k][i] = (i * i * 37 % 17) / 8.0 + 0.01 * k;
    const double *in[3] = {q[0], q[1], q[2]};
    double *out[2] = {residual, matrix}, w[SZ_W + 1];
    casadi_int iw[SZ_IW + 1];
    for (int round = 0; round < ROUNDS; round++) {
        struct timespec a, b;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &a);
        for (int i = 0; i < COUNT; i++) {
            step(in, out, iw, w, 0);
            q[2][0] += 1e-12 * residual[0];
            __asm__ volatile("" ::: "memory");
        }
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &b);
        times[round] = ((b.tv_sec - a.tv_sec) * 1e9 + (b.tv_nsec - a.tv_nsec)) / COUNT;
    }
    qsort(times, ROUNDS, sizeof(double), order);
    printf("%.17g", times[ROUNDS / 2]);
}
"""


def discrete_lagrangian(q0, q1):
    middle, change = (q0 + q1) / 2, q1 - q0
    action = 0
    for j in range(4):
        action += (middle[j] * change[4 + j] - middle[4 + j] * change[j]) / 2
    for j, k in PAIRS:
        square = (middle[j] - middle[k]) ** 2 + (middle[4 + j] - middle[4 + k]) ** 2
        action -= H * ca.log(square) / (4 * ca.pi)
    return action


for name, symbols in [("CasADi SX", ca.SX), ("CasADi MX", ca.MX)]:
    p, q1, q2 = (symbols.sym(name, 8) for name in ["p", "q1", "q2"])
    residual = p + ca.gradient(discrete_lagrangian(q1, q2), q1)
    expressions = [residual, ca.jacobian(residual, q2)]
    if symbols is ca.SX:
        expressions = ca.cse(expressions)
    step = ca.Function("step", [p, q1, q2], expressions)
    step.generate("step.c")
    with open("loop.c", "w") as file:
        file.write(LOOP)
    sizes = [f"-DCOUNT={COUNT}", f"-DROUNDS={ROUNDS}", f"-DSZ_W={step.sz_w()}", f"-DSZ_IW={step.sz_iw()}"]
    for target, option in [("", []), (" for this processor", ["-march=native"])]:
        subprocess.run(["cc", "-O3", *option, *sizes, "loop.c", "step.c", "-o", "loop", "-lm"], check=True)
        nanoseconds = float(subprocess.run(["./loop"], check=True, capture_output=True, text=True).stdout)
        row("derivatives", f"{name} as C{target}", 0.0, nanoseconds / 1e6, 0.0)
