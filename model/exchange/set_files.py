"""Sets of parameter values as files: OpenSCAD's customizer JSON, and CSV with a row for each set."""

from __future__ import annotations

import csv
import io
import json
import math
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any, BinaryIO

from ..document.document import ParameterSet
from ..document.errors import Refusal
from ..document.expression import Number, number
from ..operations.parameter_sets import as_text
from ..project.disk import one_line, read_whole, replace_file

MAX_BYTES = 20_000_000
ENDINGS = (".json", ".csv")


def read_sets(path: str | os.PathLike[str]) -> tuple[ParameterSet, ...]:
    """The sets in a file. Raises Refusal.

    JSON is that of OpenSCAD's customizer (`parameterSets`, `fileFormatVersion` 1), in which every value is text; `true`
    and `false` are 1 and 0. CSV has the set's name in its first column and a parameter in each other one; an empty cell
    leaves a parameter as it is. Texts and vectors, which no parameter here can be, are left out.
    """
    data = read_whole(path, MAX_BYTES)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise Refusal("the file is no text in UTF-8") from None
    return sets_of_csv(text) if _ending(path) == ".csv" else sets_of_json(text)


def write_sets(path: str | os.PathLike[str], sets: Iterable[ParameterSet]) -> None:
    """Write sets as JSON or CSV, by the file's ending. Raises Refusal."""
    text = csv_of_sets(sets) if _ending(path) == ".csv" else json_of_sets(sets)

    def write(stream: BinaryIO) -> None:
        stream.write(text.encode("utf-8"))

    replace_file(path, write)


def _ending(path: str | os.PathLike[str]) -> str:
    ending = Path(path).suffix.lower()
    if ending not in ENDINGS:
        raise Refusal(f"sets of parameters are files with the ending .json or .csv, not {ending or 'none'}")
    return ending


def json_of_sets(sets: Iterable[ParameterSet]) -> str:
    """The text that OpenSCAD reads and writes with `-p`."""
    table = {one.name: {name: as_text(value) for name, value in one.values} for one in sets}
    return json.dumps({"parameterSets": table, "fileFormatVersion": "1"}, indent=4, ensure_ascii=False) + "\n"


def sets_of_json(text: str) -> tuple[ParameterSet, ...]:
    try:
        table = json.loads(text)
    except json.JSONDecodeError as error:
        raise Refusal(f"line {error.lineno}: this is no JSON: {error.msg}") from None
    except RecursionError:
        raise Refusal("the JSON is nested too deeply") from None
    except ValueError as error:
        raise Refusal(f"this is no JSON: {error}") from None
    if not isinstance(table, dict) or not isinstance(table.get("parameterSets"), dict):
        raise Refusal("the file has no “parameterSets”, which a file of a customizer begins with")
    version = str(table.get("fileFormatVersion", "1"))
    if version != "1":
        raise Refusal(f"the file says format {version:.20}; only format 1 can be read")
    found = []
    for name, values in table["parameterSets"].items():
        if not isinstance(values, dict):
            raise Refusal(f"the set “{one_line(name)}” must be an object of names and values")
        pairs = ((parameter, _value(value)) for parameter, value in values.items())
        found.append(ParameterSet(name, tuple((p, v) for p, v in pairs if v is not None)))
    return tuple(found)


def csv_of_sets(sets: Iterable[ParameterSet]) -> str:
    sets = tuple(sets)
    columns = list(dict.fromkeys(name for one in sets for name, _ in one.values))
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["set", *columns])
    for one in sets:
        values = {name: as_text(value) for name, value in one.values}
        writer.writerow([one.name, *(values.get(column, "") for column in columns)])
    return out.getvalue()


def sets_of_csv(text: str) -> tuple[ParameterSet, ...]:
    first = text.partition("\n")[0]
    delimiter = max(",;\t", key=first.count)  # spreadsheets write what their country is used to
    try:
        rows = [row for row in csv.reader(io.StringIO(text), delimiter=delimiter) if any(cell.strip() for cell in row)]
    except csv.Error as error:
        raise Refusal(f"this is no CSV: {error}") from None
    if not rows or len(rows[0]) < 2:
        raise Refusal("the first line must name the columns: set, and then the parameters")
    columns = [cell.strip() for cell in rows[0][1:]]
    found: dict[str, ParameterSet] = {}
    for place, row in enumerate(rows[1:], 2):
        if len(row) > len(columns) + 1:
            raise Refusal(f"row {place} has {len(row)} cells, {len(columns) + 1} are named in the first line")
        pairs = ((column, _value(cell.strip())) for column, cell in zip(columns, row[1:], strict=False) if column)
        one = ParameterSet(row[0].strip(), tuple((p, v) for p, v in pairs if v is not None))
        if one.name in found:
            raise Refusal(f"row {place}: there is a set called “{one_line(one.name)}” already")
        found[one.name] = one
    return tuple(found.values())


def _value(value: Any) -> Number | None:
    """A number or an expression; None for an empty cell, texts and vectors."""
    if isinstance(value, bool):
        return float(value)
    if isinstance(value, str):
        plain = {"true": "1", "false": "0"}.get(value.strip().lower(), value.strip())
        try:
            return number(plain, "a value") if plain else None
        except Refusal:
            return None
    if isinstance(value, int | float):
        try:
            plain_number = float(value)
        except OverflowError:
            return None
        return plain_number if math.isfinite(plain_number) else None
    return None
