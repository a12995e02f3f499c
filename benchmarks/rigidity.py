#!/usr/bin/env python3
"""Rigidity of the whole eye from runs of data/scenes/rigidity.yaml, and the fit of a constant to it.

    benchmarks/rigidity.py DIR ...                                                     K of finished runs
    benchmarks/rigidity.py --program build/bulbus [--set KEY=VALUE ...]                runs the scene first
    benchmarks/rigidity.py --program build/bulbus --fit regions.sclera.fibres.k1       changes a constant until K is .0126 per uL

K = ln(P2/P1) / (V2 - V1) between P1 = 10 and P2 = 35 mmHg is Friedenwald's coefficient with the natural logarithm. Pallikaris et al.,
IOVS 46, 409, 2005, measured it in 79 living eyes: .0126 per uL. Beside it stands how it falls with the pressure, K(10 mmHg) / K(35 mmHg);
the cube-root law of van der Werff, Am. J. Ophthalmology 92, 391, 1981, which holds over a wide range, has (35/10)^(1/3) = 1.52.

A fit starts from the constants that the program has (app/eye/tissues.cpp) with what --set changes of them.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import tempfile

import yaml

target, low, high = .0126, 10, 35  # per uL, mmHg
here = pathlib.Path(__file__).resolve().parent.parent


def curve(folder):
    """Injected volume in uL and pressure in mmHg, from the pressure at which injection begins."""
    with open(pathlib.Path(folder) / 'history.csv') as file:
        rows = list(csv.DictReader(file))
    names = {name.split(' ')[0]: name for name in rows[0]}
    points = [(float(row[names['injected']]), float(row[names['IOP']])) for row in rows if float(row['time']) >= 1]
    if points[0][1] > low * (1 + 1e-9) or points[-1][1] < .7 * high:
        raise SystemExit(f'{folder}: the pressure goes from {points[0][1]:.3g} to {points[-1][1]:.3g} mmHg, not from {low} to {high}')
    return points


def volume_at(points, pressure):
    """Linear in ln P between two points, and on from the last two."""
    for (v0, p0), (v1, p1) in zip(points, points[1:]):
        if p1 >= pressure:
            break
    return v0 + (v1 - v0) * math.log(pressure / p0) / math.log(p1 / p0)


def rigidity(points):
    """K between low and high, and K at either, per uL."""
    def between(a, b):
        return math.log(b / a) / (volume_at(points, b) - volume_at(points, a))
    return between(low, high), between(low, 1.15 * low), between(high / 1.15, high)


def report(points):
    mean, first, last = rigidity(points)
    print(f'K = {mean:.5f} per uL between {low} and {high} mmHg; {first:.4f} at the lower end, {last:.4f} at the upper: ratio {first / last:.2f}')
    return mean


def run(bulbus, folder, overrides):
    command = [bulbus, 'run', str(here / 'data/scenes/rigidity.yaml'), '-o', folder, '--set', 'output.vtk=false']
    for o in overrides:
        command += ['--set', o]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stdout[-2000:] + done.stderr)
    return curve(folder)


def with_constant(regions, key, value):
    """The override that gives a region's law with one constant changed."""
    _, region, *path = key.split('.')
    law = yaml.safe_load(yaml.safe_dump(regions[region]))
    inner = law
    for name in path[:-1]:
        inner = inner[name]
    inner[path[-1]] = float(f'{value:.4g}')
    return f'regions.{region}={yaml.safe_dump(law, default_flow_style=True, width=10**6).strip()}'


def fit(program, key, overrides, folder):
    mean = report(run(program, folder + '/0', overrides))
    with open(folder + '/0/resolved.yaml') as file:
        regions = yaml.safe_load(file)['regions']
    value = regions
    for name in key.split('.')[1:]:
        value = value[name]
    power = 1.5  # of K in the constant, as far as is known
    for i in range(1, 9):
        if abs(mean / target - 1) < 2e-3:
            break
        before, last = value, mean
        value *= (target / mean) ** power
        mean = report(run(program, f'{folder}/{i}', overrides + [with_constant(regions, key, value)]))
        power = min(max(math.log(value / before) / math.log(mean / last), .5), 5)
    print(f'{key} = {value:.4g}')


if __name__ == '__main__':
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('folders', nargs='*')
    parser.add_argument('--program')
    parser.add_argument('--fit', metavar='KEY')
    parser.add_argument('--set', action='append', default=[])
    given = parser.parse_args()
    for name in given.folders:
        report(curve(name))
    with tempfile.TemporaryDirectory() as scratch:
        if given.program and given.fit:
            fit(given.program, given.fit, given.set, scratch)
        elif given.program:
            report(run(given.program, scratch + '/0', given.set))
