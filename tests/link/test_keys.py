"""The zenoh keys, written out: other people's programs rely on them."""

import pytest
import zenoh

from testbed.link import SpawnedRobot, keys
from testbed.protocol import Decision, Question, decode, encode
from testbed.testing.plugin import Peer
from tests.link.scripted import COMMAND, PATIENCE_S, percept, task

pytestmark = pytest.mark.load


def test_the_keys_are_the_published_ones() -> None:
    asked = keys.act("demo", "3f2a")
    assert asked == "testbed/v1/demo/3f2a/robot_0/act"
    assert keys.alive(asked) == "testbed/v1/demo/3f2a/robot_0/alive"
    assert keys.trace(asked) == "testbed/v1/demo/3f2a/robot_0/trace"
    assert keys.robot("arm") == "testbed/v1/robots/arm"


def test_a_name_of_any_characters_is_one_part_of_a_key() -> None:
    assert keys.act("a/b", "c*d?e#") == "testbed/v1/a%2Fb/c%2Ad%3Fe%23/robot_0/act"
    with pytest.raises(ValueError, match="need a name"):
        keys.act("", "t")


def test_a_program_of_its_own_asks_and_listens_at_the_written_keys(zenoh_peer: Peer) -> None:
    session = zenoh_peer.session
    robot = SpawnedRobot(session, "demo", PATIENCE_S, COMMAND)
    traces = session.declare_subscriber("testbed/v1/demo/3f2a/robot_0/trace")
    try:
        robot.begin(task("sound", "3f2a"))
        assert _live(session, "testbed/v1/robots/*") == ["testbed/v1/robots/spawned-1"]
        assert _live(session, "testbed/v1/demo/**") == []
        question = Question(percept=percept(1, "3f2a"), task=task("sound", "3f2a"))
        (reply,) = session.get(
            "testbed/v1/demo/3f2a/robot_0/act", payload=encode(question), timeout=PATIENCE_S
        )
        assert reply.ok is not None
        given = decode(bytes(reply.ok.payload), Decision)
        assert (given.trial, given.step) == ("3f2a", 1)
        assert decode(bytes(traces.recv().payload), Decision) == given
        assert _live(session, "testbed/v1/demo/**") == ["testbed/v1/demo/3f2a/robot_0/alive"]
    finally:
        traces.undeclare()
        robot.close()


def _live(session: zenoh.Session, pattern: str) -> list[str]:
    replies = session.liveliness().get(pattern)
    return sorted(str(reply.ok.key_expr) for reply in replies if reply.ok is not None)
