"""Scenarios: statics, runs, replays of recordings."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any

from . import _endline
from ._result import Replayed, Result

#: Stored moments per simulated second, as with ``endline run --out`` [Hz].
FRAMES_HZ = 10.0


class Scenario:
    """A scenario with its gear library, assembled and ready to run.

    ``name``: its id in the library, or its file. ``library``: folder of the gear library. The other arguments override the
    scenario: ``seed``; ``step_s``, the step between inputs [s]; ``weak_links``, on or off; ``rating_N``, the rating of every
    weak link [N]; ``kinetic``, whether forces affect the whale's motion; ``set``, values of further fields by their dotted
    paths, as in the options of a study: ``{"current.speed": "0.5 m/s", "ropes/sink-3-8.strength": "2000 lbf"}``.

    Raises ``EndlineError`` with file, line and field where the files have errors.
    """

    def __init__(
        self,
        name: str | os.PathLike[str],
        library: str | os.PathLike[str] | None = None,
        *,
        seed: int | None = None,
        step_s: float | None = None,
        weak_links: bool | None = None,
        rating_N: float | None = None,
        kinetic: bool | None = None,
        set: Mapping[str, bool | float | str | Sequence[str]] | None = None,
    ) -> None:
        over = {
            "seed": seed,
            "step_s": step_s,
            "weak_links": weak_links,
            "rating_n": rating_N,
            "kinetic": kinetic,
            "set": list((set or {}).items()),
        }
        self._inner = _endline.Scenario(os.fspath(name), library, over)

    @property
    def name(self) -> str:
        """Its file."""
        return self._inner.name

    @property
    def text(self) -> str:
        """Text of its file."""
        return self._inner.text

    @property
    def model_hash(self) -> str:
        """BLAKE3 of the scenario, the gear library and the options, hexadecimal."""
        return self._inner.model_hash

    @property
    def duration_s(self) -> float:
        """Simulated time of a whole run [s]."""
        return self._inner.duration_s

    def settle(self) -> dict[str, Any]:
        """The gear at rest, under the keys of ``endline.settle/1``: shape [m], tensions [N], residual [N]."""
        return json.loads(self._inner.settle())

    def run(self, *, frames_hz: float = FRAMES_HZ, unsettled: bool = False) -> Result:
        """Settles the gear and runs to the end of the scenario.

        ``frames_hz``: stored moments per simulated second [Hz]; 0 for none. ``unsettled``: start even if statics do not
        settle. Other threads of Python continue; Ctrl+C stops the run with ``KeyboardInterrupt``. A run that could
        not go on is no exception: ``figures["stopped"]`` says why.
        """
        return Result(self._inner.run(frames_hz, unsettled))

    def __repr__(self) -> str:
        return f"Scenario({self.name!r})"


def run(
    name: str | os.PathLike[str],
    library: str | os.PathLike[str] | None = None,
    *,
    frames_hz: float = FRAMES_HZ,
    unsettled: bool = False,
    **over: Any,
) -> Result:
    """Runs a scenario by id or file: ``Scenario(name, library, **over).run(frames_hz=…, unsettled=…)``."""
    return Scenario(name, library, **over).run(frames_hz=frames_hz, unsettled=unsettled)


def settle(name: str | os.PathLike[str], library: str | os.PathLike[str] | None = None, **over: Any) -> dict[str, Any]:
    """The gear of a scenario at rest: ``Scenario(name, library, **over).settle()``."""
    return Scenario(name, library, **over).settle()


def replay(
    recording: str | os.PathLike[str], *, frames_hz: float = FRAMES_HZ, other_plugins: bool = False
) -> Replayed:
    """Replays a recording and compares the steps up to the first that differs.

    ``frames_hz``: stored moments per simulated second [Hz]. ``other_plugins``: allow plugins of another version or file
    than recorded.
    """
    result, differs = _endline.replay(recording, frames_hz, other_plugins)
    return Replayed(Result(result), differs)
