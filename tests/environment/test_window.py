"""The render mode for people: a window where there is a screen, else text."""

import pickle
from collections.abc import Iterator

import matplotlib.pyplot as plt
import numpy as np
import pytest

from testbed import office_v0
from tests.environment import screen


@pytest.fixture
def _screen() -> Iterator[None]:
    before = plt.get_backend()
    plt.switch_backend("module://tests.environment.screen")
    yield
    plt.close("all")
    plt.switch_backend(before)
    screen.shown.clear()
    screen.drawn.clear()


def _begun() -> tuple[office_v0.AECView, np.ndarray]:
    """An environment for people, and the picture of its first situation."""
    env, pictures = (
        office_v0.raw_env(render_mode="human"),
        office_v0.raw_env(render_mode="rgb_array"),
    )
    for own in (env, pictures):
        own.reset(seed=1)
    picture = pictures.render()
    assert isinstance(picture, np.ndarray)
    return env, picture


@pytest.mark.usefixtures("_screen")
def test_a_window_shows_the_picture(capsys: pytest.CaptureFixture[str]) -> None:
    env, picture = _begun()
    assert env.render() is None
    (window,) = screen.shown
    width, height = window.canvas.get_width_height()
    assert (height, width) == picture.shape[:2]
    pixels = np.frombuffer(screen.drawn[-1], np.uint8).reshape(height, width, 4)
    assert np.array_equal(pixels[..., :3], picture)
    assert not capsys.readouterr().out


@pytest.mark.usefixtures("_screen")
def test_each_picture_is_shown_in_the_same_window_until_it_is_closed() -> None:
    env, _ = _begun()
    env.render()
    env.step(3)
    env.step(0)
    env.render()
    assert len(screen.shown) == 1
    assert screen.drawn[0] != screen.drawn[1]
    env.close()
    assert screen.shown == []
    env.close()


@pytest.mark.usefixtures("_screen")
def test_a_window_that_somebody_closed_opens_again() -> None:
    env, _ = _begun()
    env.render()
    plt.close("all")
    assert screen.shown == []
    env.render()
    assert len(screen.shown) == 1


@pytest.mark.usefixtures("_screen")
def test_a_copy_has_a_window_of_its_own() -> None:
    env, _ = _begun()
    env.render()
    copy = pickle.loads(pickle.dumps(env))
    copy.render()
    assert len(screen.shown) == 2
    copy.close()
    assert len(screen.shown) == 1


def test_without_a_screen_it_is_text(capsys: pytest.CaptureFixture[str]) -> None:
    plt.switch_backend("agg")
    env, _ = _begun()
    env.render()
    assert "library" in capsys.readouterr().out
