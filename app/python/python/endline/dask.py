"""A study on a Dask cluster: parts of its blocks of encounters as tasks."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

from ._endline import EndlineError
from ._study import Study

#: Default encounters of a task: many enough for a small overhead, few enough to repeat.
ENCOUNTERS = 8


def run_study(
    study: Study | str | os.PathLike[str],
    client: Any,
    *,
    out: str | os.PathLike[str] | None = None,
    library: str | os.PathLike[str] | None = None,
    encounters: int = ENCOUNTERS,
    retries: int = 3,
    shared: bool = True,
    progress: Any = None,
) -> Path:
    """Runs a study on the workers of ``client`` (``distributed.Client``), merges it, and returns the file of the table.

    The table has the same bytes as that of one machine. A worker that dies costs its tasks alone: they run again elsewhere, and
    completed blocks remain in ``out``. Blocks that exist in ``out`` are not run again.

    ``out``: folder of results, ``results/<id>`` where None. ``encounters``: how many of a task. ``retries``: how often a task that
    fails is tried again; a task whose worker dies is moved by Dask itself. ``shared``: workers see ``out`` and write there;
    otherwise they send their blocks back. ``progress``: called with tasks done and in all.

    Every worker needs this version of Endline and, by the same path or id, the study and its library: a worker that opens
    another study says so. Ctrl+C cancels the tasks that have not begun.
    """
    from distributed import as_completed

    if not isinstance(study, Study):
        study = Study(study, library)
    folder = study.out(out).absolute()
    opens = (_absolute(study.name), _absolute(study.library), study.hash, folder if shared else None)
    parts = _parts(study, folder, encounters)
    tasks = [client.submit(_run_part, *opens, part, of, retries=retries, pure=False) for part, of in parts]
    try:
        for done, task in enumerate(as_completed(tasks), start=1):
            for name, block in task.result().items():
                _write(folder / name, block)
            task.release()
            if progress is not None:
                progress(done, len(tasks))
    except BaseException:
        client.cancel(tasks)
        raise
    return study.merge(folder)


def _absolute(name: str | None) -> str | None:
    """A file by its whole path, as workers have folders of their own; an id as it is."""
    return os.path.abspath(name) if name is not None and os.path.exists(name) else name


def _parts(study: Study, folder: Path, encounters: int) -> list[tuple[int, int]]:
    """The parts with a missing block, from 1."""
    if encounters < 1:
        raise ValueError(f"encounters={encounters}: expected at least one for a task")
    of = -(-study.encounters // encounters)
    missing = [part for part in range(1, of + 1) if any(not file.is_file() for file in study._inner.blocks(folder, part, of))]
    return [(part, of) for part in missing]


#: Open studies of this worker, by their arguments.
_OPEN: dict[tuple[str, str | None, str], Study] = {}


def _run_part(name: str, library: str | None, hash: str, out: Path | None, part: int, of: int) -> dict[str, bytes]:
    """Runs a part on a worker; returns its blocks if the worker cannot access the folder of results."""
    study = _opened(name, library, hash)
    if out is not None:
        study.run(out, part=part, of=of, threads=1)
        return {}
    with tempfile.TemporaryDirectory(prefix="endline-") as folder:
        study.run(folder, part=part, of=of, threads=1)
        files = [Path(file) for file in study._inner.blocks(Path(folder), part, of)]
        return {file.name: file.read_bytes() for file in files if file.is_file()}


def _opened(name: str, library: str | None, hash: str) -> Study:
    """The study, opened once for each worker."""
    known = (name, library, hash)
    if known not in _OPEN:
        study = Study(name, library)
        if study.hash != hash:
            raise EndlineError(
                f"{name}: this worker opens a study of hash {study.hash[:16]}, not {hash[:16]}: its study, scenario, library, "
                "plugins or version of Endline are others"
            )
        _OPEN[known] = study
    return _OPEN[known]


def _write(file: Path, block: bytes) -> None:
    """Writes a block whole or not at all."""
    beside = file.with_suffix(".new")
    beside.write_bytes(block)
    os.replace(beside, file)
