"""The runs that a page is made from, and the commands that make them and it again."""

import shlex
from dataclasses import dataclass

from papers.commands import arguments
from papers.table1.runs import PROTOCOL, Run, told_order


@dataclass(frozen=True)
class Sources:
    """The runs of a page: the main one; others, where there are any, for single questions."""

    main: Run
    unaided: Run | None = None
    later: Run | None = None
    heeding: Run | None = None
    told: tuple[Run, ...] = ()
    variants: tuple[Run, ...] = ()


def played(sources: Sources) -> list[Run]:
    """The runs that are made by `testbed run`."""
    single = (sources.main, sources.unaided, sources.later, sources.heeding)
    return [*(run for run in single if run is not None), *sources.variants]


def commands(sources: Sources) -> str:
    """The runs, each as it is to be made, and the page."""
    main = f"runs/{sources.main.config.name}"
    own = [shlex.join(arguments(run.config, PROTOCOL)) for run in played(sources)]
    lines = [f"$ testbed run {given} --workers 2" for given in own]
    for run in sources.told:
        order = " ".join(["", "--order", *told_order(run)]) if told_order(run) else ""
        lines.append(f"$ python -m benchmarks.told {main} runs/{run.config.name}{order}")
    options = [
        f"--{option} runs/{run.config.name}"
        for option in ("unaided", "later", "heeding")
        if (run := getattr(sources, option)) is not None
    ]
    for option, several in (("variant", sources.variants), ("told", sources.told)):
        if several:
            options.append(" ".join([f"--{option}", *(f"runs/{r.config.name}" for r in several)]))
    page = " ".join([main, *options])
    lines.append(f"$ python -m papers.table1 {page} > docs/published-and-measured.md")
    return "\n".join(lines)
