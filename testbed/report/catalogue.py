"""The trials of runs by what they are chosen by, page by page, for who asks over the network."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import polars as pl

from testbed.analysis import Run
from testbed.experiment.record import TrialRecord
from testbed.report.explorer import Teller, study_of
from testbed.report.sample import PLACE, pairs_of
from testbed.report.scenes import Scenes
from testbed.report.telling import Told, outline

KEYS = {
    "study": "study",
    "condition": "cell",
    "scenario": "scenario",
    "level": "level",
    "robot": "robot",
    "outcome": "outcome",
}
"""What trials are chosen by, with the columns of the table."""
TRIAL = ("study", "trial")
"""Columns that tell trials of runs apart."""
MOST_PAIRS, MOST_OFFSET = 200, 10**9


class QueryError(ValueError):
    """A query that has no answer; one line says why."""


@dataclass(frozen=True)
class Query:
    """Which pairs: `limit` of them after the first `offset`, of trials with these values."""

    offset: int = 0
    limit: int = 24
    chosen: Mapping[str, str] = field(default_factory=dict)

    @staticmethod
    def of(parameters: Mapping[str, list[str]]) -> "Query":
        """The query of these parameters. Raises QueryError; an empty value chooses nothing."""
        given = dict[str, str]()
        for key, values in parameters.items():
            if key not in ("offset", "limit", *KEYS):
                raise QueryError(
                    f"{key[:40]}: no parameter; there are offset, limit, {', '.join(KEYS)}"
                )
            if len(values) > 1:
                raise QueryError(f"{key}: given {len(values)} times")
            given[key] = values[0]
        offset = _number("offset", given.pop("offset", "0"), 0, MOST_OFFSET)
        limit = _number("limit", given.pop("limit", "24"), 1, MOST_PAIRS)
        return Query(offset, limit, {key: value for key, value in given.items() if value})


def _number(key: str, text: str, least: int, most: int) -> int:
    if (
        text.isascii()
        and text.isdecimal()
        and len(text) <= len(str(most))
        and least <= int(text) <= most
    ):
        return int(text)
    raise QueryError(f"{key}: a number from {least} to {most}")


def studies_of(runs: Sequence[Run]) -> list[str]:
    """What each run is for; runs for the same are told apart by their folders."""
    names = [study_of(run) for run in runs]
    return [
        name if names.count(name) == 1 else f"{name} ({run.folder})"
        for name, run in zip(names, runs, strict=True)
    ]


class Catalogue:
    """All trials of runs, as they were when they were read.

    Runs of the same configuration have trials of the same ids, which their studies tell apart.
    """

    def __init__(self, runs: Sequence[Run]) -> None:
        named = list(zip(studies_of(runs), runs, strict=True))
        self._tellers = {study: Teller(run, study) for study, run in named}
        known = ("trial", "pair", "achieved", "correct", "robot", "outcome", *PLACE)
        listed = [run.table.select(known).with_columns(study=pl.lit(study)) for study, run in named]
        trials = pl.concat(listed).unique(TRIAL, keep="first", maintain_order=True).collect()
        place = ("study", *PLACE)
        order = pairs_of(trials, place).with_row_index("place").select("place", *place, "pair")
        self._trials = trials.join(order, on=[*place, "pair"], maintain_order="left").sort(
            "place", maintain_order=True
        )

    def found(self, query: Query) -> Told:
        """A page of pairs, each trial with what its record has, and the numbers of all."""
        found = self._trials.filter(*self._conditions(query))
        places = found["place"].unique().sort()
        page = places.slice(query.offset, query.limit)
        listed = found.filter(pl.col("place").is_in(page.implode()))
        return {
            "total": len(found),
            "pairs": len(places),
            "offset": query.offset,
            "limit": query.limit,
            "facets": {key: self._facet(query, key) for key in KEYS},
            "trials": [
                teller.about(record) | {"story": list(outline(record))}
                for teller, record in self._records(listed)
            ],
        }

    def pair(self, trial: str, query: Query) -> Told | None:
        """The pair of a trial, with all that there is to see; None where there is no such trial.

        Of several runs that have the trial it is the first one which the query chooses.
        """
        places = self._trials.filter(pl.col("trial") == trial, *self._conditions(query))["place"]
        if not len(places):
            return None
        scenes = Scenes()
        found = self._records(self._trials.filter(place=places[0]))
        told = [own for teller, record in found for own in teller.tell([record], scenes)]
        return {"scenes": scenes.drawn, "trials": told}

    def _records(self, trials: pl.DataFrame) -> list[tuple[Teller, TrialRecord]]:
        """The records of these trials in their order, each with who tells it."""
        found: dict[tuple[str, str], tuple[Teller, TrialRecord]] = {}
        for study in trials["study"].unique():
            teller = self._tellers[study]
            records = teller.records(trials.filter(study=study)["trial"])
            found |= {(study, trial): (teller, record) for trial, record in records.items()}
        return [found[own] for own in trials.select(TRIAL).iter_rows()]

    def _facet(self, query: Query, key: str) -> dict[str, int]:
        """How many trials there are of each value, under the other choices."""
        found = self._trials.filter(*self._conditions(query, without=key))
        return dict(found[KEYS[key]].value_counts().sort(KEYS[key]).iter_rows())

    @staticmethod
    def _conditions(query: Query, without: str = "") -> list[pl.Expr]:
        return [pl.col(KEYS[key]) == value for key, value in query.chosen.items() if key != without]
