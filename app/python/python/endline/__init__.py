"""Endline: fishing gear designed so that entangled whales get out alive.

>>> import endline
>>> result = endline.run("hello-endline")
>>> result.figures["lines"][0]["peak_tension_N"]

Numbers are SI, and names carry their units: ``_m``, ``_s``, ``_N``. The x axis points east, y north, z up; z = 0 is the mean
sea surface.
"""

from __future__ import annotations

import warnings as _warnings

from . import _endline
from ._command import PROGRAM as _PROGRAM
from ._endline import EndlineError

_endline.stands_for(_PROGRAM)
for _place in ("file", "line", "field", "help"):
    setattr(EndlineError, _place, None)
EndlineError.problems = []

from ._commands import (  # noqa: E402
    check_rules,
    export,
    film,
    haul,
    haul_sweep,
    hindcast,
    list_rules,
    mill,
    search,
    sheet,
)
from ._encounter_forms import Stories, StrengthThreats, Threats  # noqa: E402
from ._gear_forms import HaulSheet, HaulSweep, MeansLaws, RuleList, RuleSheet, StrengthLaw  # noqa: E402
from ._labels import Contacts, Event, Line, Lines, Outcome, OutcomeKind, Parting  # noqa: E402
from ._library import Assembly, Library  # noqa: E402
from ._result import Replayed, Result  # noqa: E402
from ._scenario import Scenario, replay, run, settle  # noqa: E402
from ._stepping import Controls, Moment, Run, RunState, Whale  # noqa: E402
from ._study import Study  # noqa: E402

#: Version of Endline and the mark of the code that decides a run.
__version__: str = _endline.version()

__all__ = [
    "Assembly",
    "Contacts",
    "Controls",
    "EndlineError",
    "Event",
    "HaulSheet",
    "HaulSweep",
    "Library",
    "Line",
    "Lines",
    "MeansLaws",
    "Moment",
    "Outcome",
    "OutcomeKind",
    "Parting",
    "Replayed",
    "Result",
    "RuleList",
    "RuleSheet",
    "Run",
    "RunState",
    "Scenario",
    "Stories",
    "StrengthLaw",
    "StrengthThreats",
    "Study",
    "Threats",
    "Whale",
    "check_rules",
    "export",
    "film",
    "haul",
    "haul_sweep",
    "hindcast",
    "list_rules",
    "mill",
    "plugin_problems",
    "replay",
    "run",
    "search",
    "settle",
    "sheet",
]


def plugin_problems(*, warn: bool = False) -> list[str]:
    """Problems of omitted plugins, as the command line reports them; ``warn`` also issues warnings."""
    problems = _endline.problems()
    if warn:
        for problem in problems:
            _warnings.warn(problem, stacklevel=2)
    return problems
