"""Draws the pictures of docs/whale.md: the outline beside the side view, and a sheet of postures from the scenarios that show them.

python docs/pictures/whale_views.py target/debug/endline

Needs matplotlib. The outline is the section table of gear-library/whales/right-whale.toml: back and belly of Daoust et al. (2018).
"""

import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import matplotlib.pyplot as plt

ROOT = Path(__file__).resolve().parents[2]
LENGTH_M = 13.7
# A portrait is this many body lengths wide, with mid-body in its middle (app/workbench/src/scene/camera.rs).
ACROSS = 1.2
# How far the file's widths and heights are drawn in, so that the body displaces its mass (docs/whale.md).
BREADTH = 0.84
# Scenario, moment, view and title.
VIEWS = [
    ("portrait", 0, "whale-top", "from above"),
    ("portrait", 0, "whale-front", "from ahead"),
    ("skim-feeding", 18, "whale-front", "mouth open, from ahead"),
    ("skim-feeding", 18, "whale-side", "mouth open"),
    ("skim-feeding", 18, "first-person", "over its own rostrum"),
    ("flippers", 3.2, "whale-side", "flukes on the way down"),
    ("flippers", 6.8, "whale-side", "flukes on the way up"),
    ("flippers", 10, "whale-front", "flippers abducted"),
    ("flippers", 16, "whale-front", "adducted"),
    ("flippers", 22, "whale-side", "pronated"),
    ("flippers", 28, "whale-side", "supinated"),
    ("flippers", 34, "whale-top", "swept forward"),
    ("surface-active", 18, "whale-side", "belly up"),
    ("dead-whale-wraps", 0.5, "whale-top", "a carcass wound in gear"),
    ("humpback-endline", 0, "whale-side", "a humpback"),
]


def render(endline, scenario, at, view, size, out):
    file = ROOT / "gear-library/scenarios" / f"{scenario}.toml"
    subprocess.run([endline, "render", file, "--at", f"{at}s", "--view", view, "--size", size, "--out", out], check=True)
    return plt.imread(out)


def outline(picture):
    rows = tomllib.loads((ROOT / "gear-library/whales/right-whale.toml").read_text())["sections"]["rows"]
    along = [(0.5 - row["at"]) * LENGTH_M for row in rows]
    back, belly = ([row[side] * LENGTH_M for row in rows] for side in ("dorsal", "ventral"))
    high, wide = picture.shape[:2]
    half = ACROSS * LENGTH_M / 2
    figure, (drawn, shown) = plt.subplots(2, 1, figsize=(9, 5.8), sharex=True)
    drawn.fill_between(along, belly, back, color="#d8dde0")
    for height in (back, belly):
        drawn.plot(along, height, ".-", color="#26323a", linewidth=1)
        shown.plot(along, [BREADTH * value for value in height], color="#ffd34d", linewidth=0.8)
    drawn.set_title("Outline of Daoust et al. 2018, as in the whale's file", fontsize=10, loc="left")
    shown.imshow(picture, extent=(-half, half, -half * high / wide, half * high / wide))
    shown.set_title("The mesh, side view; in yellow the outline drawn in by 0.84, as its mass asks", fontsize=10, loc="left")
    for axes in (drawn, shown):
        axes.set_aspect("equal")
        axes.set_xlim(-half, half)
        axes.set_ylim(-2.2, 2.2)
        axes.set_ylabel("above the snout's tip (m)", fontsize=9)
    shown.set_xlabel("ahead of mid-body (m)", fontsize=9)
    return figure


def sheet(pictures):
    figure, places = plt.subplots(5, 3, figsize=(12, 11.6))
    for axes, (picture, title) in zip(places.flat, pictures):
        axes.imshow(picture)
        axes.set_title(title, fontsize=9, loc="left")
        axes.axis("off")
    return figure


def save(figure, name):
    figure.tight_layout(pad=0.4)
    figure.savefig(ROOT / "docs/pictures" / name, dpi=90)


def main(endline):
    with tempfile.TemporaryDirectory() as scratch:
        out = f"{scratch}/view.png"
        save(outline(render(endline, "portrait", 0, "whale-side", "1400x560", out)), "whale-outline.png")
        save(sheet([(render(endline, *view, "640x360", out), title) for *view, title in VIEWS]), "whale-views.png")


main(*sys.argv[1:])
