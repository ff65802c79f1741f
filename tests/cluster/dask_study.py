"""A study of 256 encounters on a Dask scheduler with two workers, compared byte by byte with one process; once undisturbed, and
once with a worker killed half-way. Prints times; ends with 1 where a table differs.

usage: python dask_study.py FOLDER [SECONDS [ENCOUNTERS]]    FOLDER is made anew; SECONDS is how long each encounter lasts (120),
                                                             ENCOUNTERS how many are in a task (16); needs endline[dask]
"""

import os
import shutil
import signal
import sys
import time
from pathlib import Path

import distributed

import endline
import endline.dask

WORKERS = 2


def make_study(folder, seconds):
    """The study of slurm.sh beside its gear, which has no whale."""
    gear = (endline.Library().path / "scenarios/study-endline-held.toml").read_text().split("[whale]")[0]
    head, rest = gear.split("[resolution]")
    gear = f"{head}[site]{rest.split('[site]')[1]}".replace('duration = "660 s"', f'duration = "{seconds} s"')
    (folder / "slurm-scenario.toml").write_text(gear.replace("rope_nodes = 500", "rope_nodes = 60"))
    return endline.Study(shutil.copy(Path(__file__).with_name("study.toml"), folder))


def timed(work):
    began = time.monotonic()
    table = work()
    return time.monotonic() - began, table.read_bytes()


def alone(study, out):
    study.run(out, threads=WORKERS)
    return study.merge(out)


def killing(client):
    """Kills a worker once half the tasks are done; Dask begins another."""

    def progress(done, total):
        if done == total // 2:
            victim = next(iter(client.run(os.getpid).values()))
            os.kill(victim, signal.SIGKILL)
            print(f"killed worker {victim} at {done} of {total} tasks")

    return progress


def main():
    folder = Path(sys.argv[1])
    seconds = int(sys.argv[2]) if len(sys.argv) > 2 else 120
    encounters = int(sys.argv[3]) if len(sys.argv) > 3 else 16
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    study = make_study(folder, seconds)
    one, expected = timed(lambda: alone(study, folder / "alone"))
    print(f"one process, {WORKERS} threads: {one:.1f} s")
    with (
        distributed.LocalCluster(n_workers=WORKERS, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        client.run(lambda: __import__("endline.dask"))
        differ = 0
        for name, progress in (("undisturbed", None), ("with a worker killed", killing(client))):
            work = lambda: endline.dask.run_study(study, client, out=folder / name, encounters=encounters, progress=progress)
            took, table = timed(work)
            same = "same bytes" if table == expected else "OTHER BYTES"
            differ += table != expected
            tasks = -(-study.encounters // encounters)
            print(f"{name}: {took:.1f} s ({took / one - 1:+.1%}), {tasks} tasks of {WORKERS * one / tasks:.1f} s, {same}")
    sys.exit(min(differ, 1))


if __name__ == "__main__":
    main()
