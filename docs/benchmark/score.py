#!/usr/bin/env python3
"""Scores a simulator of whale entanglement or fishing gear against the benchmark's rows.

    score.py RESULTS.csv                 prints a table of verdicts in Markdown
    score.py --rows VALIDATION LIBRARY   writes the rows: output of `endline validate --plain --json`, and a gear library
    score.py --endline VALIDATION FINDINGS...   writes Endline's own results: the same output, and findings of studies

Python 3.11 or later, without other packages. benchmark.md describes the rows and the rules.
"""

import csv
import json
import math
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).parent
ROWS = ["row", "kind", "measure", "unit", "least", "greatest", "confidence", "source", "set_up"]
RESULTS = ["row", "value", "low", "high", "n"]
# Runs below which a share agrees with nothing.
FEWEST = 10


def read(path, columns):
    """Rows of a CSV file as dictionaries. Exits with the file and the columns it lacks."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = csv.DictReader(file)
            missing = [column for column in columns if column not in (rows.fieldnames or [])]
            if missing:
                sys.exit(f"{path}: no column {', '.join(missing)}; expected {', '.join(columns)}")
            return list(rows)
    except OSError as error:
        sys.exit(f"{path}: cannot be read: {error.strerror}")


def number(text, place, needed=True):
    """A finite number; None for an empty text that is not needed. Exits with the place of anything else."""
    if not text.strip() and not needed:
        return None
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        sys.exit(f"{place}: {text!r} is not a number")
    return value


def verdict(row, result, place):
    """`agrees`, `misses` or `not settled`, for a row and a result."""
    least, greatest = number(row["least"], row["row"]), number(row["greatest"], row["row"])
    value = number(result["value"], f"{place}, value")
    within = least <= value <= greatest
    if row["kind"] != "share":
        return "agrees" if within else "misses"
    low = number(result["low"], f"{place}, low")
    high = number(result["high"], f"{place}, high")
    if not low <= value <= high:
        sys.exit(f"{place}: {value} is not between low {low} and high {high}")
    if high < least or low > greatest:
        return "misses"
    count = number(result["n"], f"{place}, n")
    return "agrees" if within and count >= FEWEST else "not settled"


def digits(text):
    """A number with four digits."""
    return f"{float(text):.4g}" if text.strip() else ""


def score(path):
    """Prints a table of all rows with their results and verdicts, and the counts."""
    rows = {row["row"]: row for row in read(HERE / "rows.csv", ROWS)}
    results = {}
    for line, result in enumerate(read(path, RESULTS), start=2):
        place = f"{path}, line {line}"
        if result["row"] not in rows:
            sys.exit(f"{place}: no row {result['row']!r}; rows.csv lists the rows")
        if result["row"] in results:
            sys.exit(f"{place}: the row {result['row']} has a result already")
        results[result["row"]] = (result, place)
    counts = {}
    print("| row | measure | expected | result | verdict |")
    print("|---|---|---|---|---|")
    for name, row in rows.items():
        shown, said = "", "no result"
        if name in results:
            result, place = results[name]
            said = verdict(row, result, place)
            shown = digits(result["value"])
            if row["kind"] == "share":
                shown += f" [{digits(result['low'])}, {digits(result['high'])}]"
        counts[(row["kind"], said)] = counts.get((row["kind"], said), 0) + 1
        expected = f"{digits(row['least'])} to {digits(row['greatest'])} {row['unit']}".strip()
        print(f"| {name} | {row['measure']} | {expected} | {shown} | {said} |")
    print()
    for kind in ["share", "measured", "computed"]:
        own = [f"{count} {said}" for (of, said), count in sorted(counts.items()) if of == kind]
        print(f"- {kind}: {', '.join(own)}")


def names(case):
    """Name of the row of each verdict of a case."""
    several = len(case["verdicts"]) > 1
    return [case["id"] + (f"/{index}" if several else "") for index in range(1, len(case["verdicts"]) + 1)]


def limits(verdict):
    """Least and greatest value that a row of a case accepts."""
    if verdict["between"]:
        return verdict["between"]
    expected, limit = verdict["expected"], verdict["limit"]
    by = abs(limit * expected) if verdict["share"] and expected else limit
    return [expected - by, expected + by]


def cases(path):
    """Cases of the output of `endline validate --plain --json`."""
    return json.loads(Path(path).read_text(encoding="utf-8"))["cases"]


def write(columns, rows):
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(columns)
    out.writerows(rows)


def share_rows(library):
    """Rows of observed shares: the observations of the library's studies, each once, by id."""
    found = {}
    for path in sorted((Path(library) / "studies").glob("*.toml")):
        study = tomllib.loads(path.read_text(encoding="utf-8"))
        for seen in study.get("observation", []):
            if "by_construction" in seen or seen["id"] in found:
                continue
            among = f" among {seen['among']}" if "among" in seen else ""
            than = seen.get("option", study["baseline"])
            fewer = f", share by which it is rarer with {seen['fewer_with']} than with {than}" if "fewer_with" in seen else ""
            measure = f"{seen['says']}; counted: {seen['of']}{among}{fewer}"
            least, greatest = seen["observed"]
            found[seen["id"]] = [
                seen["id"], "share", measure, "", least, greatest, "measured", seen["source"], f"study {path.stem}",
            ]
    return [found[name] for name in sorted(found, key=lambda name: (len(name.split("-")[0]), name))]


def write_rows(validation, library):
    rows = share_rows(library)
    for case in cases(validation):
        kind = "measured" if case["sureness"] == "measured" else "computed"
        for name, of in zip(names(case), case["verdicts"]):
            least, greatest = limits(of)
            rows.append([
                name, kind, f"{case['name']}: {of['name']}", of["unit"], f"{least:.6g}", f"{greatest:.6g}",
                case["sureness"], case["source"], f"scenario {case['scenario']}",
            ])
    write(ROWS, rows)


def write_endline(validation, findings):
    rows = []
    for path in findings:
        for seen in json.loads(Path(path).read_text(encoding="utf-8"))["observations"]:
            if seen["by_construction"] is None and seen["simulated"] is not None:
                interval = seen["interval"]
                values = [seen["simulated"], interval["low"], interval["high"]]
                hits, runs = seen["hits"], seen["runs"]
                has_weights = abs(hits / runs - seen["simulated"]) > 1e-6
                if all(value is not None for value in values):
                    count = hits if has_weights else runs
                    rows.append([seen["id"], *(f"{value:.4g}" for value in values), count])
    for case in cases(validation):
        for name, of in zip(names(case), case["verdicts"]):
            rows.append([name, f"{of['got']:.6g}", "", "", ""])
    write(RESULTS, rows)


def main(arguments):
    match arguments:
        case ["--rows", validation, library]:
            write_rows(validation, library)
        case ["--endline", validation, *findings]:
            write_endline(validation, findings)
        case [path] if not path.startswith("-"):
            score(path)
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
