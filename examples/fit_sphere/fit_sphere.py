#!/usr/bin/env python3
"""Recovers the Mooney-Rivlin constants of a thick ball from the pressures at four volumes.

    PYTHONPATH=python python3 examples/fit_sphere/fit_sphere.py [FOLDER]

The pressures "measured" are those of the closed form, so that the constants come back but for the error of the mesh.
Needs Debian's python3-numpy and python3-scipy.
"""
import pathlib
import sys

import numpy
from scipy.integrate import quad

import bulbus

INNER, OUTER = 10, 14  # mm
TRUTH = {"regions.wall.c10": 0.05, "regions.wall.c01": 0.01}  # MPa
ADDED = {"half": 0.5, "one": 1, "two": 2, "four": 4}  # liquid added by the end of each step, over the volume at rest


def pressure(added, c10, c01):
    """kPa: the integral of 2 (σ_θ − σ_r) / r over the wall, with σ_θ − σ_r = 2 (c10 + c01 λ²) (λ² − λ⁻⁴) and λ = r / R."""

    def integrand(reference):
        current = numpy.cbrt(reference**3 + added * INNER**3)
        stretch = current / reference
        difference = 2 * (c10 + c01 * stretch**2) * (stretch**2 - stretch**-4)
        return 2 * difference / current * stretch**-2  # dr = λ⁻² dR

    return 1000 * quad(integrand, INNER, OUTER)[0]


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else "results/fit_sphere"
    measured = {("P", step): pressure(added, *TRUTH.values()) for step, added in ADDED.items()}
    found = bulbus.fit(pathlib.Path(__file__).parent / "sphere.yaml", parameters={key: (0.03, 0, 0.2) for key in TRUTH},
                       targets=measured, out=folder, tolerance=1e-4)
    print(found)
    for key, true in TRUTH.items():
        print(f"{key}: {found.values[key]:.5f} MPa, {found.values[key] / true - 1:+.2%} of {true} MPa")
    return found


if __name__ == "__main__":
    main()
