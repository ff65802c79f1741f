"""Studies: options of gear compared on the same encounters."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from . import _endline
from ._command import call, call_json
from ._encounter_forms import StrengthThreats, Threats
from ._units import PathLike, Quantity, si


class Study:
    """A study, opened and checked.

    ``name``: its id in the library, or its file. ``library``: folder of the gear library. A folder of results, ``out``, is
    ``results/<id>`` by default, as on the command line; both may work on the same folder.
    """

    def __init__(self, name: PathLike, library: PathLike | None = None) -> None:
        self.name = os.fspath(name)
        self.library = None if library is None else os.fspath(library)
        self._inner = _endline.Study(self.name, self.library)

    @property
    def id(self) -> str:
        """Its id."""
        return self._inner.id

    @property
    def hash(self) -> str:
        """BLAKE3 of all that defines its runs, hexadecimal."""
        return self._inner.hash

    @property
    def encounters(self) -> int:
        """Number of encounters of each option."""
        return self._inner.encounters

    @property
    def options(self) -> list[str]:
        """Ids of its options."""
        return self._inner.options

    def plan(self) -> dict[str, Any]:
        """Its plan, under the keys of ``endline.study_plan/1``."""
        return json.loads(self._inner.plan())

    def out(self, out: PathLike | None = None) -> Path:
        """The folder of results."""
        return Path("results", self.id) if out is None else Path(out)

    def run(
        self,
        out: PathLike | None = None,
        *,
        part: int = 1,
        of: int = 1,
        threads: int | None = None,
        progress: Callable[[int, int], object] | None = None,
    ) -> tuple[int, int]:
        """Runs the missing encounters, and returns the number of done ones and of all.

        ``part`` (from 1) of ``of`` parts: only each ``of``-th block, as with ``--shard part/of``. ``threads``: one for each core
        if None. ``progress`` is called in this thread with the encounters done and in all, at the start and when they change; an
        exception that it raises ends the study as Ctrl+C does. Other threads of Python continue. Ctrl+C ends it after the
        encounters in progress; written blocks remain, and another call continues from them.
        """
        return self._inner.run(self.out(out), part, of, threads or os.cpu_count() or 1, progress)

    def merge(self, out: PathLike | None = None) -> Path:
        """Joins the blocks of encounters to ``table.parquet`` and ``table.csv``; returns the first."""
        return Path(self._inner.merge(self.out(out)))

    def report(self, out: PathLike | None = None) -> tuple[Path, dict[str, Any]]:
        """Writes the report of a merged study; returns its page and the findings under the keys of ``endline study report --json``."""
        page, findings = self._inner.report(self.out(out))
        return Path(page), json.loads(findings)

    def threat(
        self,
        out: PathLike | None = None,
        *,
        event: str | None = None,
        curve: str | None = None,
        model: PathLike | None = None,
        strengths: PathLike | None = None,
        cap_N: Quantity | None = None,
        poll: PathLike | None = None,
        to: PathLike | None = None,
    ) -> Threats | StrengthThreats:
        """The threats of a merged study beside those of NOAA's decision support tool: ``endline study threat``.

        ``event``: event whose rate is the threat, the study's if None. ``curve``, ``model``, ``strengths`` and ``cap_N`` are for
        the threat by breaking strength: curve of options, NOAA's tables of threats and of strengths, and a greatest strength of
        lines. ``poll``: table of experts' opinion of 2019, for options that name its rows. ``to``: CSV file to write for the
        tool; a file with ``-bands`` in its name is written beside it. Returns ``Threats`` for the table of 2019, and
        ``StrengthThreats`` for the threat by breaking strength.
        """
        options = {
            "out": self.out(out),
            "event": event,
            "curve": curve,
            "model": model,
            "strengths": strengths,
            "cap": None if cap_N is None else f"{si(cap_N, 'cap_N', 'N')!r} N",
            "poll": poll,
            "to": to,
        }
        threats = call_json(["study", "threat", self.name], options, self.library)
        return StrengthThreats.of(threats) if "strengths" in threats else Threats.of(threats)

    def hindcast(self, out: PathLike | None = None, *, kept: bool = False) -> str:
        """Compares a merged study with its observations of real whales; returns Markdown: ``endline study hindcast``.

        ``kept``: compare results that another version of the program, or another library, computed.
        """
        return call(["study", "hindcast", self.name], {"out": self.out(out), "kept": kept}, self.library)

    def read(self, out: PathLike | None = None, *, to: str = "pyarrow") -> Any:
        """The merged table, a row for each run of an option on an encounter; names of columns carry their units.

        ``to``: ``"pyarrow"``, ``"polars"`` or ``"pandas"``, which must be installed.
        """
        file = self.out(out) / "table.parquet"
        if not file.is_file():
            raise FileNotFoundError(f"{file} does not exist: call merge() after the study has run")
        if to == "pyarrow":
            import pyarrow.parquet

            return pyarrow.parquet.read_table(file)
        if to == "polars":
            import polars

            return polars.read_parquet(file)
        if to == "pandas":
            import pandas

            return pandas.read_parquet(file)
        raise ValueError(f"to={to!r}: expected 'pyarrow', 'polars' or 'pandas'")

    def __repr__(self) -> str:
        return f"Study({self.id!r}, {len(self.options)} options, {self.encounters} encounters)"
