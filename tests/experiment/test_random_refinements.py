"""Whatever is refined of whatever small domain: refused with its place, or it can be acted by."""

from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.own_trials import random_trial
from benchmarks.refinements import FINE, REFUSED, verdict


@given(st.randoms(use_true_random=False))
@settings(max_examples=80, derandomize=True)
def test_a_refinement_is_refused_with_its_place_or_its_trial_achieves_the_goal(
    random: Random,
) -> None:
    trial = random_trial(random)
    with TemporaryDirectory() as folder:
        end = verdict(trial, Path(folder))
    assert end in FINE
    assert not (trial.is_whole and end == REFUSED)
