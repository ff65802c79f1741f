"""A gear library and its assemblies."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from . import _endline
from ._units import Quantity, length_text, si_or_none


class Library:
    """A folder of ropes, traps, whales, sites, scenarios and studies as text files.

    ``path``: the folder. Default: the library of the command line: ``ENDLINE_LIBRARY``, else the one of
    this package, else ``gear-library`` in the working folder.
    """

    def __init__(self, path: str | os.PathLike[str] | None = None) -> None:
        self._inner = _endline.Library(path)

    @property
    def path(self) -> Path:
        """The folder."""
        return Path(self._inner.path)

    def ids(self, folder: str) -> list[str]:
        """Ids of the items of one of its folders, such as ``ropes`` or ``whales``, in order."""
        return self._inner.ids(folder)

    @property
    def scenarios(self) -> list[str]:
        """Ids of its scenarios."""
        return self.ids("scenarios")

    @property
    def studies(self) -> list[str]:
        """Ids of its studies."""
        return self.ids("studies")

    @property
    def assemblies(self) -> list[str]:
        """Ids of its assemblies of gear."""
        return self.ids("assemblies")

    def check(self) -> list[dict[str, Any]]:
        """The problems of its files, as from ``endline check``: file, line, column, field, message, help, is_error."""
        return self._inner.check()

    def __repr__(self) -> str:
        return f"Library({str(self.path)!r})"


class Assembly:
    """One assembly of gear, alone.

    ``name``: its id in the library, or its file. ``library``: folder of the gear library.
    """

    def __init__(self, name: str | os.PathLike[str], library: str | os.PathLike[str] | None = None) -> None:
        self._inner = _endline.Assembly(os.fspath(name), library)

    @property
    def id(self) -> str:
        """Its id."""
        return self._inner.id

    @property
    def text(self) -> str:
        """Text of its file."""
        return self._inner.text

    def settle(
        self,
        scenario: str | os.PathLike[str],
        *,
        depth_m: Quantity | None = None,
        current_m_s: Quantity | None = None,
    ) -> dict[str, Any]:
        """The assembly at rest in the sea of a scenario (id or file), under the keys of ``endline.settle/1``.

        ``depth_m``, the depth of the water, and ``current_m_s``, the speed at the surface, override the scenario's. Each is a
        number in SI or a text with its unit, such as ``"20 fathom"`` or ``"0.5 kn"``.
        """
        depth, current = length_text(depth_m, "depth_m"), si_or_none(current_m_s, "current_m_s", "m/s")
        return json.loads(self._inner.settle(os.fspath(scenario), depth, current))

    def __repr__(self) -> str:
        return f"Assembly({self.id!r})"
