"""Tables 2 and 3 for other programs: an addition to `summary.json`."""

from collections.abc import Iterable
from typing import Any

import msgspec

from testbed.studies.levels.measures import Levels
from testbed.studies.levels.published import PARTS, Paper
from testbed.studies.levels.tables import Row, growth, ratios, shares
from testbed.studies.study import Numbers
from testbed.studies.tables import Cell


def numbers(found: Levels) -> Numbers:
    """The columns of each level; `published` values, and whether they lie in our intervals.

    These are `completed` by robot, `ratios` by part of the time, and `growth` by both: `published`
    and `inside`; `seconds` by both: `mean` and `sd`. What was not published is absent.
    """
    return {
        "levels": {
            name: msgspec.to_builtins(level) | _without_nothing({"published": _beside(name, found)})
            for name, level in found.levels.items()
        }
    }


def _beside(level: str, found: Levels) -> dict[str, Any]:
    def own(rows: Iterable[Row]) -> dict[str, list[dict[str, Any]]]:
        return {r.robot: list(map(_number, r.cells)) for r in rows if r.level == level}

    def by_part(numbers: Iterable[dict[str, Any]]) -> dict[str, Any]:
        return dict(zip(PARTS, numbers, strict=False))

    robots = found.levels[level].reasoning
    return {
        "completed": {robot: number for robot, (number,) in own(shares(found)).items()},
        "ratios": by_part(own(ratios(found)).get("", ())),
        "growth": {robot: by_part(parts) for robot, parts in own(growth(found)).items()},
        "seconds": {robot: _seconds(level, robot, found.paper) for robot in robots},
    }


def _number(cell: Cell) -> dict[str, Any]:
    if cell.published is None:
        return {}
    return {"published": cell.published.value, "inside": cell.inside}


def _seconds(level: str, robot: str, paper: Paper) -> dict[str, Any]:
    known = {part: paper.seconds(level, robot, part) for part in PARTS}
    return {p: {"mean": own[0], "sd": own[1]} for p, own in known.items() if own is not None}


def _without_nothing(values: dict[str, Any]) -> dict[str, Any]:
    """The same without empty parts, also inside of parts."""
    inner = {k: _without_nothing(v) if isinstance(v, dict) else v for k, v in values.items()}
    return {key: value for key, value in inner.items() if value != {}}
