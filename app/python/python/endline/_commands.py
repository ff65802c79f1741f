"""Commands that answer one question: rules, hauls, laws of strength, sheets, searches, tables, films.

Each function calls the command of the same name and returns its JSON as dataclasses, or the path of the file that it wrote.
"""

from __future__ import annotations

import datetime
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Union

from ._command import call, call_json
from ._encounter_forms import Stories
from ._gear_forms import HaulSheet, HaulSweep, MeansLaws, RuleList, RuleSheet, StrengthLaw
from ._units import PathLike, Quantity, si

#: A day, as a date or as a text such as ``"2024-06-01"``.
Day = Union[str, datetime.date]


def _with_unit(value: Quantity | None, argument: str, unit: str) -> str | None:
    """A quantity as an option of the command line."""
    return None if value is None else f"{si(value, argument, unit)!r} {unit}"


def _fished(
    area: str, on: Day, depth_m: Quantity | None, distance_m: Quantity | None, traps: int | None, packs: Sequence[PathLike]
) -> dict[str, Any]:
    return {
        "area": area,
        "on": on,
        "depth": _with_unit(depth_m, "depth_m", "m"),
        "distance": _with_unit(distance_m, "distance_m", "m"),
        "traps": traps,
        "pack": list(packs),
    }


def check_rules(
    assembly: PathLike,
    area: str,
    on: Day,
    library: PathLike | None = None,
    *,
    depth_m: Quantity | None = None,
    distance_m: Quantity | None = None,
    traps: int | None = None,
    packs: Sequence[PathLike] = (),
) -> RuleSheet:
    """Checks an assembly (id or file) against every rule that applies in an area on a day: ``endline rules check``.

    ``area``: one of ``list_rules``. ``depth_m``: depth of the water; without it 25 m, and depth counts as not known.
    ``distance_m``: distance from shore. ``traps``: traps on one set, in place of those of the assembly. ``packs``: files of rules
    besides those of the library. A rule that the gear fails is no exception: see ``rules`` and ``counts``.
    """
    options = _fished(area, on, depth_m, distance_m, traps, packs)
    # Exit code 1 also reports that a binding rule fails; a failed command prints no JSON.
    return RuleSheet.of(call_json(["rules", "check", os.fspath(assembly)], options, library, codes=(0, 1)))


def list_rules(library: PathLike | None = None, *, packs: Sequence[PathLike] = ()) -> RuleList:
    """Lists the packs of rules, with their areas, rules, citations and dates: ``endline rules list``."""
    return RuleList.of(call_json(["rules", "list"], {"pack": list(packs)}, library))


def haul(
    assembly: PathLike,
    library: PathLike | None = None,
    *,
    site: str = "cape-cod-bay",
    depth_m: Quantity | None = None,
    traps: int | None = None,
    tide_m_s: Quantity | None = None,
    speed_m_s: Quantity = 1.2,
    block_m: Quantity = 2.0,
    sea_m: Quantity = 1.0,
    period_s: Quantity | None = None,
    lead_rad: Quantity | None = "15 deg",
    drift_m_s: Quantity = 0.0,
    break_out: float = 1.0,
    buoy: str | None = None,
    aboard: int = 10,
    segment_m: Quantity | None = None,
    step_s: Quantity = 0.02,
    seed: int = 1,
) -> HaulSheet:
    """Hauls an assembly (id or file) from a boat: loads, and the probability that a part parts: ``endline haul``.

    ``site``: id in the library, whose depth and tide hold where ``depth_m`` and ``tide_m_s`` are None. ``speed_m_s``: rope taken
    in by the hauler. ``block_m``: height of the block over the sea surface. ``sea_m`` and ``period_s``: significant height and
    peak period of the waves. ``lead_rad``: angle of the line at the block from the vertical at which the boat keeps pace with the
    hauler; None for a boat that does not follow the line. ``drift_m_s``: drift of the boat with the tide, against it below zero.
    ``break_out``: break-out of traps as a multiple of that of their entries. ``aboard``: traps aboard at which the haul ends; 0
    for all.
    """
    hauling = _hauling(site, speed_m_s, block_m, sea_m, period_s, lead_rad, drift_m_s, break_out, buoy, aboard, segment_m, step_s, seed)
    at = {
        "depth": _with_unit(depth_m, "depth_m", "m"),
        "traps": traps,
        "tide": _with_unit(tide_m_s, "tide_m_s", "m/s"),
    }
    return HaulSheet.of(call_json(["haul", os.fspath(assembly)], {**hauling, **at}, library))


def haul_sweep(
    assembly: PathLike,
    library: PathLike | None = None,
    *,
    depths_m: Sequence[Quantity] = (),
    traps: Sequence[int] = (),
    tides_m_s: Sequence[Quantity] = (),
    site: str = "cape-cod-bay",
    speed_m_s: Quantity = 1.2,
    block_m: Quantity = 2.0,
    sea_m: Quantity = 1.0,
    period_s: Quantity | None = None,
    lead_rad: Quantity | None = "15 deg",
    drift_m_s: Quantity = 0.0,
    break_out: float = 1.0,
    buoy: str | None = None,
    aboard: int = 10,
    segment_m: Quantity | None = None,
    step_s: Quantity = 0.02,
    seed: int = 1,
) -> list[HaulSweep]:
    """One haul for each depth, number of traps and tide: ``endline haul --table``. ``haul`` describes the other arguments."""
    hauling = _hauling(site, speed_m_s, block_m, sea_m, period_s, lead_rad, drift_m_s, break_out, buoy, aboard, segment_m, step_s, seed)
    at = {
        "depth": [_with_unit(depth, "depths_m", "m") for depth in depths_m],
        "traps": list(traps),
        "tide": [_with_unit(tide, "tides_m_s", "m/s") for tide in tides_m_s],
        "table": True,
    }
    return [HaulSweep.of(row) for row in call_json(["haul", os.fspath(assembly)], {**hauling, **at}, library)]


def _hauling(
    site: str,
    speed_m_s: Quantity,
    block_m: Quantity,
    sea_m: Quantity,
    period_s: Quantity | None,
    lead_rad: Quantity | None,
    drift_m_s: Quantity,
    break_out: float,
    buoy: str | None,
    aboard: int,
    segment_m: Quantity | None,
    step_s: Quantity,
    seed: int,
) -> dict[str, Any]:
    return {
        "site": site,
        "speed": _with_unit(speed_m_s, "speed_m_s", "m/s"),
        "height": _with_unit(block_m, "block_m", "m"),
        "sea": _with_unit(sea_m, "sea_m", "m"),
        "period": _with_unit(period_s, "period_s", "s"),
        "lead": _with_unit(lead_rad, "lead_rad", "rad"),
        "stay": lead_rad is None,
        "drift": _with_unit(drift_m_s, "drift_m_s", "m/s"),
        "break-out": break_out,
        "buoy": buoy,
        "aboard": aboard,
        "segment": _with_unit(segment_m, "segment_m", "m"),
        "dt": _with_unit(step_s, "step_s", "s"),
        "seed": seed,
    }


def mill(
    breaks: PathLike | Sequence[Quantity] | None = None,
    *,
    mean_N: Quantity | None = None,
    count: int | None = None,
    deviation_N: Quantity | None = None,
    limits_N: Sequence[Quantity] = (),
    out: PathLike | None = None,
    name: str | None = None,
) -> StrengthLaw | MeansLaws:
    """Estimates the law of strength of a product, and the probability that it is approved: ``endline mill``.

    Either ``breaks``, a CSV file of breaks or of means, or a sequence of breaks [N]; or ``mean_N`` of ``count`` breaks, with
    ``deviation_N`` if it is known. ``limits_N``: greatest strengths that are allowed, in place of NOAA's criteria for 1,700 lbf.
    ``out`` and ``name``: file and name of a weak link that is written for the gear library. A file of several means gives
    ``MeansLaws``, anything else ``StrengthLaw``.
    """
    file = [os.fspath(breaks)] if isinstance(breaks, (str, os.PathLike)) else []
    singles = [] if breaks is None or isinstance(breaks, (str, os.PathLike)) else list(breaks)
    options = {
        "break": [_with_unit(one, "breaks", "N") for one in singles],
        "mean": _with_unit(mean_N, "mean_N", "N"),
        "count": count,
        "deviation": _with_unit(deviation_N, "deviation_N", "N"),
        "limit": [_with_unit(one, "limits_N", "N") for one in limits_N],
        "out": out,
        "name": name,
    }
    law = call_json(["mill", *file], options)
    return MeansLaws.of(law) if "samples" in law else StrengthLaw.of(law)


def sheet(
    assembly: PathLike,
    area: str,
    on: Day,
    library: PathLike | None = None,
    *,
    to: PathLike,
    depth_m: Quantity | None = None,
    distance_m: Quantity | None = None,
    traps: int | None = None,
    packs: Sequence[PathLike] = (),
    tide_m_s: Quantity | None = None,
    threat: PathLike | None = None,
    others: Sequence[PathLike] = (),
    pdf: PathLike | None = None,
) -> Path:
    """Writes one page on a gear for a hearing, as HTML to ``to``; returns its path: ``endline sheet``.

    ``check_rules`` describes the arguments up to ``packs``. ``tide_m_s``: speed of the running tide at the surface, 0.25 m/s if
    None. ``threat``: a table with bands, as ``Study.threat(to=…)`` writes it. ``others``: further assemblies, compared on one
    page. ``pdf``: the page as PDF too, by an installed browser.
    """
    options = {
        **_fished(area, on, depth_m, distance_m, traps, packs),
        "tide": _with_unit(tide_m_s, "tide_m_s", "m/s"),
        "threat": threat,
        "with": list(others),
        "to": to,
        "pdf": pdf,
    }
    call(["sheet", os.fspath(assembly)], options, library)
    return Path(to)


def search(
    observation: PathLike,
    library: PathLike | None = None,
    *,
    encounters: PathLike | None = None,
    out: PathLike | None = None,
    trials: int = 1000,
    neighbours: int = 12,
    keep: int = 0,
    net: int | None = None,
    threads: int | None = None,
) -> Stories:
    """Searches encounters that end like an observation (id or file) of a real whale: ``endline search``.

    ``encounters``: study with one option whose encounters are searched; that of the observation if None. ``out``: folder of the
    search, ``results/search-<id>`` if None; another call continues from it. ``trials``: number of runs wanted. ``neighbours``:
    runs around every story that ends alike. ``keep``: best stories that are written as scenario, recording and picture. ``net``:
    draws from the priors before the first local search. ``threads``: one for each core if None.
    """
    options = {
        "encounters": encounters,
        "out": out,
        "trials": trials,
        "neighbours": neighbours,
        "keep": keep,
        "net": net,
        "threads": threads,
        "eager": True,
    }
    return Stories.of(call_json(["search", os.fspath(observation)], options, library))


def hindcast(library: PathLike | None = None, *, out: PathLike | None = None, encounters: int | None = None) -> str:
    """Compares every study and case that has observations of real whales with them: ``endline study hindcast``.

    Returns the page as Markdown. Missing encounters are run, which takes hours; ``encounters`` limits them for each study.
    ``out``: the folder of the studies' folders, ``results`` if None. ``Study.hindcast`` is for one study.
    """
    return call(["study", "hindcast"], {"out": out, "encounters": encounters, "eager": True}, library)


def export(
    source: PathLike,
    folder: PathLike,
    library: PathLike | None = None,
    *,
    format: str = "parquet",
    rate_hz: int = 10,
    from_s: Quantity | None = None,
    to_s: Quantity | None = None,
    other_plugins: bool = False,
) -> list[Path]:
    """Runs a recording or a scenario and writes its moments as tables; returns their files: ``endline export``.

    ``format``: ``"parquet"``, ``"arrow"`` or ``"csv"``. ``rate_hz``: moments a second, from 1 to 1000. ``from_s`` and ``to_s``:
    first and last moment, those of the run if None. ``docs/recording.md`` describes the tables.
    """
    options = {
        "out": folder,
        "format": format,
        "rate": rate_hz,
        "from": _with_unit(from_s, "from_s", "s"),
        "to": _with_unit(to_s, "to_s", "s"),
        "other-plugins": other_plugins,
    }
    printed = call(["export", os.fspath(source)], options, library)
    names = [line.split()[0] for line in printed.splitlines()[1:] if line.strip()]
    return [Path(folder, f"{name}.{format}") for name in names]


def film(
    source: PathLike,
    to: PathLike,
    library: PathLike | None = None,
    *,
    from_s: Quantity | None = None,
    to_s: Quantity | None = None,
    fps: int = 20,
    view: str = "orbit",
    look: str = "measured",
    size: tuple[int, int] = (1280, 800),
    other_plugins: bool = False,
) -> Path:
    """Runs a recording or a scenario and writes it as a film or an animated 3-D model; returns its path: ``endline render``.

    ``to``: a file that ends with ``.gif``, ``.mp4``, ``.webm`` (the latter two need the program ffmpeg) or ``.glb``. ``from_s``
    and ``to_s``: the stretch of the run, all of it if None. ``fps``: pictures a second, from 1 to 50. ``view``: one view, or
    views with the time of the camera, such as ``"side@0s,whale@10s"``. ``look``: ``"measured"`` or ``"film"``. Films need EGL.
    """
    endings = (".gif", ".mp4", ".webm", ".glb")
    if Path(to).suffix.lower() not in endings:
        raise ValueError(f"to={os.fspath(to)!r}: expected a file that ends with one of {', '.join(endings)}")
    width, height = size
    options = {
        "out": to,
        "from": _with_unit(from_s, "from_s", "s"),
        "to": _with_unit(to_s, "to_s", "s"),
        "fps": fps,
        "view": view,
        "look": look,
        "size": f"{width}x{height}",
        "other-plugins": other_plugins,
    }
    call(["render", os.fspath(source)], options, library)
    return Path(to)
