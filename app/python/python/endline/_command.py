"""The command ``endline`` of this package."""

from __future__ import annotations

import os
import sys
from pathlib import Path

#: The program. Its plugins lie beside it, and the gear library above.
PROGRAM = Path(__file__).parent / "bin" / ("endline.exe" if os.name == "nt" else "endline")


def main() -> None:
    """Replaces this process by the program, with the same arguments."""
    if not PROGRAM.is_file():
        sys.exit(f"endline: {PROGRAM} is missing; this package was built without the command (`cargo xtask python` builds it)")
    os.execv(PROGRAM, ["endline", *sys.argv[1:]])
