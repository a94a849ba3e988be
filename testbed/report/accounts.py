"""What was explained by what: what others did, and what the robot took them to have done."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from testbed.experiment.record import Explained, TrialRecord
from testbed.experiment.wording import exception

MOST = 12
NOTHING = "nothing"


@dataclass(frozen=True)
class Account:
    """An explanation, and how often it was adopted.

    `happened` is what others had done by then without telling, `right` whether the explanation
    names just that, whatever the steps.
    """

    happened: str
    explained: str
    count: int
    right: bool


@dataclass(frozen=True)
class Accounts:
    """The explanations of one robot: the most frequent ones, and how many there are in all."""

    robot: str
    total: int
    right: int
    common: tuple[Account, ...]
    kinds: int


def accounts_of(records: Iterable[TrialRecord]) -> list[Accounts]:
    """What each robot explained by what, in the order in which records name the robots."""
    counts: dict[str, Counter[tuple[str, str]]] = {}
    for record in records:
        own = counts.setdefault(record.robot, Counter())
        own.update((_happened(record, e.step), _assumed(e)) for e in record.explanations)
    return [_accounts(robot, own) for robot, own in counts.items() if own]


def _accounts(robot: str, counts: Counter[tuple[str, str]]) -> Accounts:
    ordered = sorted(counts.items(), key=lambda item: (-item[1], item[0]))
    told = [
        Account(happened, explained, count, happened == explained)
        for (happened, explained), count in ordered
    ]
    right = sum(account.count for account in told if account.right)
    return Accounts(robot, counts.total(), right, tuple(told[:MOST]), len(told))


def _happened(record: TrialRecord, step: int) -> str:
    """What others had done before a step, and the robot was not told of."""
    unseen = (e.action for e in record.exogenous if e.step < step and not e.observed)
    return _said(sorted(unseen))


def _assumed(explained: Explained) -> str:
    """Exceptions first, then what others did, then what is distrusted, whatever they are called."""
    exceptions = sorted(map(exception, explained.exceptions))
    events = sorted(event.action for event in explained.unobserved)
    distrusted = sorted(f"distrusted {report.action}" for report in explained.distrusted)
    return _said([*exceptions, *events, *distrusted])


def _said(names: list[str]) -> str:
    return " ".join(names) or NOTHING
