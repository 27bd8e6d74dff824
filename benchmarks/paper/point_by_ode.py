#!/usr/bin/env python3
"""The law of the paper's figures 10 and 11 at a point, without the package's scheme.

Levels (3.68)-(3.70) with perfect plasticity in uniaxial stress with free sides, as the
limit of small steps: an ordinary differential equation for the elastic left Cauchy-Green
tensors B_i = diag(b_i, c_i, c_i) of the levels over the nominal strain e = x/X - 1.

  sigma_x = K (J - 1) + 2/3 mu sum w_i (b_i - c_i)      (3.5), (3.68) as printed
  0       = K (J - 1) - 1/3 mu sum w_i (b_i - c_i)      free sides, J = (1 + e) r^2
  db_i/de = 2 b_i Lx - l_i (b_i - 1),  dc_i/de = 2 c_i Lr - l_i (c_i - 1)
  Lx = 1/(1 + e),  Lr = d ln r / de

The last terms are (3.55), B = a B' + (1-a) I, for a = 1 - l de. l_i is 0 below
|b_i - c_i| = 2 (1 + nu) eps_i, else it keeps that difference, and must stay positive.
Fourth-order Runge-Kutta between the strains at which a level begins to yield, which are
found by bisection. Beside it the overlay of small strain, which has a closed form.

Writes strain, stress and small-strain stress (Pa) at even strains and where a level
begins to yield; `level` is its number there, else 0.
"""
import argparse

import numpy as np

E, NU = 100e9, 0.45
K, MU = E / (3 * (1 - 2 * NU)), E / (2 * (1 + NU))
STEP = 5e-5  # of the strain


class Levels:
    def __init__(self, limits):
        self.limit = 2 * (1 + NU) * np.array(limits)  # of |b - c|
        n = len(limits)
        self.weight = np.full(n, 1 / n)
        self.e = 0.0
        self.y = np.concatenate([[0.0], np.ones(2 * n)])  # ln r, b, c
        self.flows = np.zeros(n, bool)

    def parts(self, y):
        n = len(self.limit)
        return y[1:n + 1], y[n + 1:]

    def rates(self, e, y, flows):
        """dy/de and l."""
        b, c = self.parts(y)
        J = (1 + e) * np.exp(2 * y[0])
        Lx = 1 / (1 + e)
        w = np.where(flows, 0.0, self.weight)  # a level that flows keeps b - c
        # K J (Lx + 2 Lr) = mu/3 sum_elastic w (2 b Lx - 2 c Lr)
        Lr = Lx * (2 / 3 * MU * (w @ b) - K * J) / (2 * K * J + 2 / 3 * MU * (w @ c))
        ell = np.where(flows, 2 * (b * Lx - c * Lr) / np.where(flows, b - c, 1.0), 0.0)
        return np.concatenate([[Lr], 2 * b * Lx - ell * (b - 1), 2 * c * Lr - ell * (c - 1)]), ell

    def after(self, de):
        f = lambda e, y: self.rates(e, y, self.flows)[0]
        k1 = f(self.e, self.y)
        k2 = f(self.e + de / 2, self.y + de / 2 * k1)
        k3 = f(self.e + de / 2, self.y + de / 2 * k2)
        k4 = f(self.e + de, self.y + de * k3)
        return self.y + de / 6 * (k1 + 2 * k2 + 2 * k3 + k4)

    def excess(self, y):
        """Of the elastic levels: |b - c| over its limit."""
        b, c = self.parts(y)
        return np.where(self.flows, -1.0, np.abs(b - c) - self.limit)

    def move(self, to):
        """To a strain in one direction; yields (strain, level) where one begins to yield."""
        while self.e != to:
            de = np.clip(to - self.e, -STEP, STEP)
            last = abs(to - self.e) <= STEP
            y = self.after(de)
            if np.max(self.excess(y)) > 0:
                low, high = 0.0, de
                for _ in range(80):
                    middle = 0.5 * (low + high)
                    if np.max(self.excess(self.after(middle))) > 0:
                        high = middle
                    else:
                        low = middle
                level = int(np.argmax(self.excess(self.after(high))))
                self.y, self.e = self.after(low), self.e + low
                self.flows[level] = True
                ell = self.rates(self.e, self.y, self.flows)[1]
                assert np.all(ell[self.flows] * np.sign(de) > 0), "a level flows backwards"
                yield self.e, level + 1
                continue
            self.y, self.e = y, to if last else self.e + de

    def turn(self):
        self.flows[:] = False

    def stress(self):
        b, c = self.parts(self.y)
        J = (1 + self.e) * np.exp(2 * self.y[0])
        difference = self.weight @ (b - c)
        side = K * (J - 1) - MU / 3 * difference
        assert abs(side) < 1e-9 * E, f"the sides carry {side} Pa"
        return K * (J - 1) + 2 / 3 * MU * difference


class SmallStrain:
    """Every level follows 2 mu g within its yield, g = e_x - e_y; e_x + 2 e_y = (1-2nu) sigma/E."""

    def __init__(self, limits):
        self.yields = E * np.array(limits)
        self.s = np.zeros(len(limits))
        self.sum = 0.0  # of all changes of 2 mu g

    def move(self, e):
        strain = lambda d: (2 * (1 + NU) * (self.sum + d) + (1 - 2 * NU) * self.stress(d)) / (3 * E)
        low, high = -1e11, 1e11
        for _ in range(120):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if strain(middle) < e else (low, middle)
        self.s, self.sum = self.layers(low), self.sum + low
        return self.stress(0.0)

    def layers(self, d):
        return np.clip(self.s + d, -self.yields, self.yields)

    def stress(self, d):
        return np.mean(self.layers(d))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--limits", type=float, nargs="+", required=True, help="eps_s of the levels, of equal weight")
    parser.add_argument("--amplitude", type=float, required=True, help="largest nominal strain, both ways")
    parser.add_argument("--cycles", type=int, default=3)
    parser.add_argument("--rows", type=int, default=30, help="rows from 0 to the amplitude")
    parser.add_argument("--output", required=True, help="CSV to write")
    o = parser.parse_args()

    point, small = Levels(o.limits), SmallStrain(o.limits)
    lines = [(0.0, 0.0, 0.0, 0)]
    at = 0
    for target in [o.rows] + [-o.rows, o.rows] * o.cycles:
        point.turn()
        way = 1 if target > at else -1
        while at != target:
            at += way
            for strain, level in point.move(o.amplitude * at / o.rows):
                lines.append((strain, point.stress(), small.move(strain), level))
            lines.append((point.e, point.stress(), small.move(point.e), 0))
    words = f"--limits {' '.join(map(str, o.limits))} --amplitude {o.amplitude} --cycles {o.cycles} --rows {o.rows}"
    with open(o.output, "w") as file:
        file.write(f"# python3 benchmarks/paper/point_by_ode.py {words} --output {o.output}\n")
        file.write("strain,stress_Pa,small_strain_stress_Pa,level\n")
        for strain, stress, overlay, level in lines:
            file.write(f"{strain:.12g},{stress:.12g},{overlay:.12g},{level}\n")


if __name__ == "__main__":
    main()
