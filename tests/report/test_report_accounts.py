"""What was explained by what."""

from asp.language import Literal
from testbed.analysis.table import table_of
from testbed.experiment.record import At, Explained, Occurrence, TrialRecord
from testbed.report.stories import MOST, accounts_of
from tests.experiment.samples import a_record

MOVED, LOCKED = "exo_move(book1,kitchen)", "exo_lock(library)"


def test_what_happened_before_and_was_not_told_stands_beside_what_was_assumed() -> None:
    record = a_record(
        exogenous=[Occurrence(2, MOVED, False), Occurrence(3, "told", True)],
        explanations=[Explained(4, [At(1, LOCKED)], [])],
    )
    (own,) = accounts_of(table_of([record]))
    (account,) = own.common
    assert (account.happened, account.explained, account.right) == (MOVED, LOCKED, False)


def test_what_happens_later_is_not_what_was_explained() -> None:
    record = a_record(
        exogenous=[Occurrence(4, MOVED, False)],
        explanations=[Explained(4, [], [Literal.parse("locked(x)")])],
    )
    ((account,),) = (own.common for own in accounts_of(table_of([record])))
    assert (account.happened, account.explained) == ("nothing", "exception locked(x)")


def test_the_same_actions_are_right_whatever_their_order_and_steps() -> None:
    events = [Occurrence(2, MOVED, False), Occurrence(3, LOCKED, False)]
    explained = Explained(5, [At(4, LOCKED), At(1, MOVED)], [])
    once_more = Explained(5, [At(4, LOCKED)], [], distrusted=[At(3, MOVED)])
    record = a_record(exogenous=events, explanations=[explained, once_more])
    (own,) = accounts_of(table_of([record]))
    assert (own.total, own.right) == (2, 1)
    assert {a.right: a.explained for a in own.common} == {
        True: f"{LOCKED} {MOVED}",
        False: f"{LOCKED} distrusted {MOVED}",
    }


def test_the_most_frequent_come_first_and_the_others_are_counted() -> None:
    def explaining(name: str) -> TrialRecord:
        return a_record(explanations=[Explained(2, [At(1, name)], [])])

    often = [explaining("often")] * 3
    rare = [explaining(f"rare{number:02}") for number in range(MOST + 2)]
    (own,) = accounts_of(table_of([*rare, *often]))
    assert [account.explained for account in own.common[:2]] == ["often", "rare00"]
    assert (len(own.common), own.kinds, own.total) == (MOST, MOST + 3, MOST + 5)


def test_each_robot_has_its_own_and_one_that_explains_nothing_has_none() -> None:
    explained = [Explained(2, [At(1, "a")], [])]
    records = [a_record(robot="one", explanations=explained), a_record(robot="two")]
    assert [own.robot for own in accounts_of(table_of(records))] == ["one"]
