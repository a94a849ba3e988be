"""What explains a difference from Tables 2 and 3: the pairs of a level, and the published means."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean, median

from papers.levels.pairing import MEETINGS, Meeting, Pair
from testbed.experiment.seeds import playing_order
from testbed.studies.levels.published import ZOOM, Paper
from testbed.studies.levels.tables import Row


@dataclass(frozen=True)
class Met:
    """Of how many pairs the start, the goal and what others did were the same for both robots."""

    pairs: int
    starts: int
    goals: int
    meetings: Mapping[Meeting, int]
    alike: int

    @property
    def same_events(self) -> int:
        """Pairs in which all that others did was the same, if anything."""
        return self.meetings["nothing"] + self.meetings["same"]


def met(pairs: Iterable[Pair]) -> Met:
    """Count them."""
    own = list(pairs)
    kinds = Counter(pair.meeting for pair in own)
    return Met(
        pairs=len(own),
        starts=sum(pair.zoom.initial == pair.no_zoom.initial for pair in own),
        goals=sum(pair.zoom.goal == pair.no_zoom.goal for pair in own),
        meetings={kind: kinds[kind] for kind in MEETINGS},
        alike=sum(pair.alike for pair in own),
    )


@dataclass(frozen=True)
class Scatter:
    """A ratio of times in which both robots do the same: what comparing two clocks comes to.

    Means and the median of no zoom / zoom; `inverse` is the mean of zoom / no zoom; the last two
    are medians, by which robot of the pair played first.
    """

    pairs: int
    mean: float
    inverse: float
    median: float
    zoom_first: float | None
    no_zoom_first: float | None


def scatter(pairs: Iterable[Pair], robots: Sequence[str], part: str = "coarse") -> Scatter | None:
    """Of the pairs in which both did the same and achieved the goal; None without such a pair."""
    own = [pair for pair in pairs if pair.alike and pair.achieved and _ratio(pair, part)]
    if not own:
        return None
    ratios = [_ratio(pair, part) for pair in own]
    first: dict[bool, list[float]] = {True: [], False: []}
    for pair, ratio in zip(own, ratios, strict=True):
        first[_zoom_first(pair, robots)].append(ratio)
    return Scatter(
        pairs=len(own),
        mean=fmean(ratios),
        inverse=fmean(1 / ratio for ratio in ratios),
        median=median(ratios),
        zoom_first=median(first[True]) if first[True] else None,
        no_zoom_first=median(first[False]) if first[False] else None,
    )


def _ratio(pair: Pair, part: str) -> float:
    """No zoom / zoom; 0 where one of them is missing."""
    below, above = pair.zoom.seconds.get(part), pair.no_zoom.seconds.get(part)
    return above / below if above and below else 0.0


def _zoom_first(pair: Pair, robots: Sequence[str]) -> bool:
    order = playing_order(pair.seed, robots)
    return order.index(pair.zoom.robot) < order.index(pair.no_zoom.robot)


@dataclass(frozen=True)
class Work:
    """What a trial with zooming consists of on average, and what the paper's means imply of it.

    `implied` is the published time at the fine resolution divided by that of one refined plan: so
    many plans would fill it.
    """

    abstract: float
    plans: float
    seconds: float
    implied: float | None
    published: float | None


def work(pairs: Sequence[Pair], level: str, paper: Paper) -> Work:
    """Of the trials with zooming that made refined plans; `pairs` are not empty."""
    trials = [pair.zoom for pair in pairs]
    fine = paper.seconds(level, ZOOM, "fine")
    one = paper.seconds(level, ZOOM, "refined_plan")
    times = [t.seconds["refined_plan"] for t in trials if "refined_plan" in t.seconds]
    return Work(
        abstract=fmean(len(trial.did) for trial in trials),
        plans=fmean(trial.plans for trial in trials),
        seconds=fmean(times) if times else 0.0,
        implied=None if fine is None or one is None else fine[0] / one[0],
        published=None if one is None else one[0],
    )


@dataclass(frozen=True)
class Surprise:
    """Coarse reasoning of trials with zooming, by whether something had to be explained.

    `calm` trials explained nothing; `seconds` is their mean, `others` that of the rest. `events`
    are the exogenous actions of a trial, the mean of all.
    """

    trials: int
    events: float
    calm: int
    seconds: float | None
    others: float | None


def surprise(pairs: Sequence[Pair]) -> Surprise:
    """Count and average; `pairs` are not empty."""
    trials = [pair.zoom for pair in pairs]
    calm = [trial.seconds["coarse"] for trial in trials if not trial.explained]
    others = [trial.seconds["coarse"] for trial in trials if trial.explained]
    return Surprise(
        trials=len(trials),
        events=fmean(len(trial.events) for trial in trials),
        calm=len(calm),
        seconds=fmean(calm) if calm else None,
        others=fmean(others) if others else None,
    )


@dataclass(frozen=True)
class Inside:
    """How many published values lie in our intervals, of how many that have one."""

    inside: int
    values: int


def inside(rows: Iterable[Row]) -> Inside:
    """Over the cells of some rows."""
    known = [cell.inside for row in rows for cell in row.cells if cell.inside is not None]
    return Inside(sum(known), len(known))
