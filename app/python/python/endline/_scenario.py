"""Scenarios: statics, runs, steps, replays of recordings."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from . import _endline
from ._result import FRAMES_HZ, Replayed, Result
from ._stepping import Moment, Pilot, Run
from ._units import PathLike, Quantity, si, si_or_none


class Scenario:
    """A scenario with its gear library, assembled and ready to run.

    ``name``: its id in the library, or its file. ``library``: folder of the gear library. The other arguments override the
    scenario: ``seed``; ``step_s``, the step between inputs; ``weak_links``, on or off; ``rating_N``, the rating of every
    weak link; ``kinetic``, whether forces affect the whale's motion; ``set``, values of further fields by their dotted
    paths, as in the options of a study: ``{"current.speed": "0.5 m/s", "ropes/sink-3-8.strength": "2000 lbf"}``.

    ``step_s`` and ``rating_N`` take a number in SI or a text with its unit: ``rating_N=7562`` or ``rating_N="1700 lbf"``.

    Raises ``EndlineError`` with file, line and field where the files have errors.
    """

    def __init__(
        self,
        name: PathLike,
        library: PathLike | None = None,
        *,
        seed: int | None = None,
        step_s: Quantity | None = None,
        weak_links: bool | None = None,
        rating_N: Quantity | None = None,
        kinetic: bool | None = None,
        set: Mapping[str, bool | float | str | Sequence[str]] | None = None,
    ) -> None:
        over = {
            "seed": seed,
            "step_s": si_or_none(step_s, "step_s", "s"),
            "weak_links": weak_links,
            "rating_n": si_or_none(rating_N, "rating_N", "N"),
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

    def run(self, *, frames_hz: Quantity = FRAMES_HZ, unsettled: bool = False) -> Result:
        """Settles the gear and runs to the end of the scenario.

        ``frames_hz``: stored moments per simulated second [Hz]; 0 for none. ``unsettled``: start even if statics do not
        settle. Other threads of Python continue; Ctrl+C stops the run with ``KeyboardInterrupt``. A run that could
        not continue is no exception: ``outcome.stopped`` says why.
        """
        return Result(self._inner.run(si(frames_hz, "frames_hz", "Hz"), unsettled))

    def start(self, *, frames_hz: Quantity = FRAMES_HZ, unsettled: bool = False) -> Run:
        """Settles the gear; returns a run before its first step, to be taken step by step.

        ``frames_hz`` and ``unsettled`` are those of ``run``; stored moments belong to ``Run.result()``.
        """
        return Run(self._inner.start(si(frames_hz, "frames_hz", "Hz"), unsettled))

    def steps(
        self,
        every_s: Quantity = 0.1,
        *,
        pilot: Pilot | None = None,
        frames_hz: Quantity = FRAMES_HZ,
        unsettled: bool = False,
    ) -> Iterator[Moment]:
        """Settles the gear, and yields a moment after each ``every_s`` of simulated time: ``start(…).steps(every_s, pilot=pilot)``.

        The simulation advances when the loop asks for the next moment. ``moment.run`` is the run, for its result or its state.
        """
        return self.start(frames_hz=frames_hz, unsettled=unsettled).steps(every_s, pilot=pilot)

    def __repr__(self) -> str:
        return f"Scenario({self.name!r})"


def run(
    name: PathLike,
    library: PathLike | None = None,
    *,
    frames_hz: Quantity = FRAMES_HZ,
    unsettled: bool = False,
    seed: int | None = None,
    step_s: Quantity | None = None,
    weak_links: bool | None = None,
    rating_N: Quantity | None = None,
    kinetic: bool | None = None,
    set: Mapping[str, bool | float | str | Sequence[str]] | None = None,
) -> Result:
    """Runs a scenario by id or file. ``Scenario`` describes its overrides, ``Scenario.run`` the other arguments."""
    scenario = Scenario(
        name, library, seed=seed, step_s=step_s, weak_links=weak_links, rating_N=rating_N, kinetic=kinetic, set=set
    )
    return scenario.run(frames_hz=frames_hz, unsettled=unsettled)


def settle(
    name: PathLike,
    library: PathLike | None = None,
    *,
    seed: int | None = None,
    step_s: Quantity | None = None,
    weak_links: bool | None = None,
    rating_N: Quantity | None = None,
    kinetic: bool | None = None,
    set: Mapping[str, bool | float | str | Sequence[str]] | None = None,
) -> dict[str, Any]:
    """The gear of a scenario at rest, as ``Scenario.settle`` returns it. ``Scenario`` describes the overrides."""
    scenario = Scenario(
        name, library, seed=seed, step_s=step_s, weak_links=weak_links, rating_N=rating_N, kinetic=kinetic, set=set
    )
    return scenario.settle()


def replay(recording: PathLike, *, frames_hz: Quantity = FRAMES_HZ, other_plugins: bool = False) -> Replayed:
    """Replays a recording and compares the steps up to the first that differs.

    ``frames_hz``: stored moments per simulated second [Hz]. ``other_plugins``: allow plugins of another version or file
    than recorded.
    """
    result, differs = _endline.replay(recording, si(frames_hz, "frames_hz", "Hz"), other_plugins)
    return Replayed(Result(result), differs)
