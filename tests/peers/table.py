"""Endline beside MoorDyn on the reference problems: who gets how far in a second of one core, at what error.

    pip install moordyn numpy scipy
    python tests/peers/table.py

Builds Endline's example `peers` in release, runs each problem with both codes turn by turn on the same machine, takes the
processor's time of the fastest of each, and prints a table with the ratios. A code's row is its fastest setting whose error is within the
tolerance of the problem (place and tension at once); steps that blow up or miss it are passed over. MoorDyn is explicit:
its step is bounded by the axial wave over a segment, so that its fastest stable setting is more exact than asked.
"""

import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.optimize import fsolve

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
LENGTH, EA, BA, MASS, DIAMETER, GRAVITY = 60.0, 1e5, 5.0, 0.06, 0.010, 9.81
WEIGHT = MASS * GRAVITY

# Problem: ends of the rope, times of the samples, allowed errors (cm, %), and for each number of segments the steps
# tried: Endline's, and MoorDyn's by scheme.
PROBLEMS = {
    "a": dict(
        end=(30.04414861, -52.03799186), guess=(92.4, -178.2), every=1.0, count=10, allowed=(0.3, 0.6),
        steps={
            20: ([0.02, 0.01], {"rk4": [3.2e-3, 1.6e-3]}),
            100: ([0.02, 0.01], {"rk4": [6.4e-4, 5e-4], "rk2": [2.5e-4]}),
            500: ([0.02, 0.01], {"rk2": [9e-5, 7e-5], "rk4": [1.1e-4]}),
        },
    ),
    "c2": dict(
        end=(59.0, 0.0), guess=(53.7, -17.7), every=0.05, count=30, allowed=(0.3, 1.0),
        steps={
            100: ([1e-3, 5e-4, 2.5e-4], {"rk4": [5e-4]}),
            500: ([1e-3, 5e-4, 2.5e-4], {"rk4": [1.1e-4]}),
        },
    ),
}


def main():
    binary = build()
    print("| problem | segments | Endline: step, times real time, errors | MoorDyn: scheme, step, times real time, errors | ratio |")
    print("|---|---|---|---|---|")
    for name, problem in PROBLEMS.items():
        for segments, (ours, theirs) in problem["steps"].items():
            endline = fastest(problem, [endline_run(binary, name, segments, step) for step in ours])
            tries = [(scheme, step) for scheme, steps in theirs.items() for step in steps]
            moordyn = fastest(problem, [moordyn_run(name, problem, segments, scheme, step) for scheme, step in tries])
            print(row(name, segments, endline, moordyn), flush=True)


def build():
    command = ["cargo", "build", "--release", "-p", "endline-sim", "--example", "peers", "--message-format=json"]
    out = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    found = [json.loads(line).get("executable") for line in out.splitlines() if '"executable":"' in line]
    return found[-1]


def fastest(problem, tries):
    """The fastest try within the problem's tolerance, or None."""
    fit = [one for one in tries if one and one["cm"] <= problem["allowed"][0] and one["percent"] <= problem["allowed"][1]]
    return max(fit, key=lambda one: one["times"], default=None)


def endline_run(binary, name, segments, step):
    out = subprocess.run([binary, name, str(segments), str(step)], check=True, stdout=subprocess.PIPE, text=True).stdout
    times, place, tension, _ = [float(word) for word in out.split()[3:]]
    return dict(setting=f"{1e3 * step:g} ms", times=times, cm=place, percent=tension)


def moordyn_run(name, problem, segments, scheme, step):
    """Best of three runs of MoorDyn in its own process: one that blows up takes only that with it."""
    best = None
    for _ in range(3):
        command = [sys.executable, os.path.abspath(__file__), "--moordyn", name, str(segments), scheme, str(step)]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        found = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("row ")]
        if done.returncode != 0 or not found:
            return None
        times, place, tension = [float(word) for word in found[0]]
        if best is None or times > best["times"]:
            best = dict(setting=f"{scheme} {1e3 * step:g} ms", times=times, cm=place, percent=tension)
    return best


def row(name, segments, endline, moordyn):
    cell = lambda one: f"{one['setting']}, {one['times']:.4g}, {one['cm']:.3f} cm {one['percent']:.2f} %" if one else "none within the tolerance"
    ratio = f"{endline['times'] / moordyn['times']:.0f}" if endline and moordyn else "-"
    return f"| {name} | {segments} | {cell(endline)} | {cell(moordyn)} | {ratio} |"


def catenary(horizontal, vertical, s):
    """Elastic catenary from (0, 0): places at unstretched lengths `s`."""
    force = lambda s: np.hypot(horizontal, vertical + WEIGHT * s)
    x = horizontal * s / EA + horizontal / WEIGHT * (np.arcsinh((vertical + WEIGHT * s) / horizontal) - np.arcsinh(vertical / horizontal))
    z = (vertical * s + WEIGHT * s * s / 2) / EA + (force(s) - force(0.0)) / WEIGHT
    return x, z


def start(problem, segments):
    end = np.array(problem["end"])
    solve = lambda force: np.array(catenary(force[0], force[1], LENGTH)) - end
    force = fsolve(solve, problem["guess"], xtol=1e-13)
    x, z = catenary(force[0], force[1], np.linspace(0.0, LENGTH, segments + 1))
    return np.column_stack([x, 0.0 * x, z])


def moordyn_child(name, segments, scheme, step):
    """Runs MoorDyn once and prints times real time and errors."""
    import moordyn

    problem = PROBLEMS[name]
    place = start(problem, segments)
    os.chdir(tempfile.mkdtemp())
    with open("rope.txt", "w") as file:
        file.write(moordyn_input(name, place, segments, scheme, step))
    system = moordyn.Create("rope.txt")
    moordyn.SetVerbosity(system, moordyn.LEVEL_NONE)
    hand = np.array(place[-1]) if name == "c2" else np.array([])
    moordyn.Init_NoIC(system, list(hand), [2.0, 0.0, 0.0] if name == "c2" else [])
    rope = moordyn.GetLine(system, 1)
    far, pin = (0, segments) if name == "a" else (segments, 0)
    rows, now, begin = [], 0.0, time.process_time()
    for _ in range(problem["count"]):
        velocity = ([2.0, 0.0, 0.0] if now < 1.0 - 1e-9 else [0.0] * 3) if name == "c2" else []
        moordyn.Step(system, list(hand), velocity, now, problem["every"])
        now += problem["every"]
        hand = hand + problem["every"] * np.array(velocity) if name == "c2" else hand
        end, middle = moordyn.GetLineNodePos(rope, far), moordyn.GetLineNodePos(rope, segments // 2)
        rows.append([end[0], end[2], middle[0], middle[2], np.linalg.norm(moordyn.GetLineNodeTen(rope, pin))])
    seconds = time.process_time() - begin
    place_cm, tension = errors(np.array(rows), np.loadtxt(os.path.join(HERE, "data", f"ref_{name}.txt")))
    if np.isfinite([place_cm, tension]).all():
        print("row", now / seconds, place_cm, tension)


def errors(rows, reference):
    off = rows - reference[:, 1:6]
    place = 100.0 * np.sqrt((off[:, :4] ** 2).sum() / (2 * len(rows)))
    return place, 100.0 * np.sqrt((off[:, 4] ** 2).sum() / (reference[:, 5] ** 2).sum())


def moordyn_input(name, place, segments, scheme, step):
    """MoorDyn's input file: the rope in a vacuum between two points; the first point is the line's end A."""
    points = [("Free", place[-1], 20.0), ("Fixed", place[0], 0.0)] if name == "a" else [("Fixed", place[0], 0.0), ("Coupled", place[-1], 0.0)]
    point = lambda k, kind, at, mass: f"{k} {kind} {at[0]:.15g} {at[1]:.15g} {at[2]:.15g} {mass} 0 0 0\n"
    return (
        "--- MoorDyn Input File\nrope\n--- LINE TYPES\nTypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx\n"
        "(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)\n"
        f"rope {DIAMETER} {MASS} {EA} {BA} 0.0 1.2 1.0 0.02 0.0\n"
        "--- POINTS\nID Attachment X Y Z Mass Volume CdA Ca\n(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)\n"
        + "".join(point(k + 1, *one) for k, one in enumerate(points))
        + "--- LINES\nID LineType AttachA AttachB UnstrLen NumSegs Outputs\n(#) (name) (#) (#) (m) (-) (-)\n"
        f"1 rope 1 2 {LENGTH} {segments} -\n"
        f"--- OPTIONS\n0 writeLog\n{step} dtM\n{scheme} tScheme\n{GRAVITY} g\n1e-6 rho\n500 WtrDpth\n1 disableOutput\n"
        "1e6 kBot\n1e3 cBot\n--- OUTPUTS\nFairTen1\n--- end\n"
    )


if __name__ == "__main__":
    if sys.argv[1:2] == ["--moordyn"]:
        moordyn_child(sys.argv[2], int(sys.argv[3]), sys.argv[4], float(sys.argv[5]))
    else:
        main()
