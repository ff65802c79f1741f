"""The command ``endline`` of this package."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ._endline import EndlineError

#: The program. Its plugins lie beside it, and the gear library above.
PROGRAM = Path(__file__).parent / "bin" / ("endline.exe" if os.name == "nt" else "endline")

_MISSING = f"{PROGRAM} is missing: this package was built without the command; `cargo xtask python` builds it with the command"

#: Options of a call by name, without dashes; None and False omit an option, True gives it without a value.
Options = dict[str, Any]


def main() -> None:
    """Replaces this process by the program, with the same arguments."""
    if not PROGRAM.is_file():
        sys.exit(f"endline: {_MISSING}")
    os.execv(PROGRAM, ["endline", *sys.argv[1:]])


def call(command: Sequence[str], options: Options, library: Any = None, *, codes: tuple[int, ...] = (0,)) -> str:
    """Calls the program and returns its standard output; other threads of Python continue.

    Ctrl+C asks the program to end with its partial results, and raises ``KeyboardInterrupt``; on Windows it ends the program at
    once. Raises ``EndlineError`` with the
    program's message for an exit code that is not one of ``codes``, and for one other than 0 without output.
    """
    if not PROGRAM.is_file():
        raise EndlineError(_MISSING)
    words = [str(PROGRAM), "--quiet", *command, *_words({**options, "library": library})]
    apart: dict[str, Any] = {"start_new_session": True}
    interrupt = signal.SIGINT
    if sys.platform == "win32":
        apart = {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP}
        interrupt = signal.CTRL_BREAK_EVENT
    pipe = subprocess.PIPE
    with subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=pipe, stderr=pipe, encoding="utf-8", **apart) as process:
        try:
            out, error = process.communicate()
        except KeyboardInterrupt:
            # The program has a group of its own, so that it receives one interrupt, from here.
            process.send_signal(interrupt)
            process.communicate()
            raise
    if process.returncode not in codes or (process.returncode != 0 and not out.strip()):
        says = "\n".join(line.removeprefix("endline: ") for line in error.strip().splitlines())
        raise EndlineError(says or f"`endline {' '.join(command)}` ended with exit code {process.returncode}")
    return out


def call_json(command: Sequence[str], options: Options, library: Any = None, *, codes: tuple[int, ...] = (0,)) -> Any:
    """``call`` with ``--json``; returns the value that the program prints."""
    return json.loads(call(command, {**options, "json": True}, library, codes=codes))


def _words(options: Options) -> list[str]:
    """Options as words of a command line; a sequence repeats its option."""
    words = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        option = f"--{name}"
        if value is True:
            words.append(option)
        elif isinstance(value, (list, tuple)):
            words += [f"{option}={os.fspath(one) if isinstance(one, os.PathLike) else one}" for one in value]
        else:
            words.append(f"{option}={os.fspath(value) if isinstance(value, os.PathLike) else value}")
    return words
