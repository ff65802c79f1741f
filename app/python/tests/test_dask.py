"""A study on a Dask cluster leaves the bytes of one machine, also where a worker is killed."""

import os
import signal

import pytest

import endline
import endline.dask

distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def client():
    """A scheduler and two workers, each a process of its own."""
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def alone(study, out):
    study.run(out)
    return study.merge(out).read_bytes()


@pytest.mark.parametrize("shared", [True, False], ids=["shared folder", "blocks sent back"])
def test_the_bytes_are_those_of_one_machine(small, client, tmp_path, shared):
    study, reported = endline.Study(small(10)), []
    table = endline.dask.run_study(
        study, client, out=tmp_path / "dask", encounters=3, shared=shared, progress=lambda *of: reported.append(of)
    )
    assert reported == [(1, 4), (2, 4), (3, 4), (4, 4)]
    assert table.read_bytes() == alone(study, tmp_path / "alone")


def test_what_is_there_is_not_run_again(small, client, tmp_path):
    study, out, reported = endline.Study(small(10)), tmp_path / "dask", []
    study.run(out, part=1, of=2)
    endline.dask.run_study(study, client, out=out, encounters=5, progress=lambda *of: reported.append(of))
    assert reported == [(1, 1)]


@pytest.mark.parametrize("shared", [True, False], ids=["shared folder", "blocks sent back"])
def test_a_killed_worker_costs_its_tasks_alone(small, client, tmp_path, shared):
    study, killed, reported = endline.Study(small(24, seconds=2)), [], []

    def kill(done, total):
        reported.append((done, total))
        if not killed:
            killed.append(next(iter(client.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)

    table = endline.dask.run_study(study, client, out=tmp_path / "dask", encounters=2, shared=shared, progress=kill)
    assert killed and reported[-1] == (12, 12)
    assert table.read_bytes() == alone(study, tmp_path / "alone")
    client.wait_for_workers(2, timeout=60)


def test_a_worker_with_another_study_says_so(small, client, tmp_path):
    study = endline.Study(small(4))
    small(4, seconds=1)
    with pytest.raises(endline.EndlineError, match="this worker opens a study of hash"):
        endline.dask.run_study(study, client, out=tmp_path / "dask", retries=0)
