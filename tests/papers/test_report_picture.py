"""The figures of a run as a file of their own."""

from pathlib import Path
from xml.etree import ElementTree

import pytest

from papers.__main__ import main
from testbed.config import load_config
from testbed.experiment.run_folder import write_config
from testbed.experiment.runner import play_missing
from testbed.experiment.status import RunStatus

SVG = "{http://www.w3.org/2000/svg}"
RUNS = {
    "table1": (["limit=1", "scenarios=[1,random]"], 7),
    "levels": (["levels=[L1]", "limit=1"], 4),
}


def _ignore(tally: RunStatus) -> None:
    del tally


def _run(folder: Path, name: str, *overrides: str) -> None:
    config = load_config(name, overrides)
    write_config(folder, config)
    play_missing(config, folder, 1, _ignore)


@pytest.mark.parametrize("name", RUNS)
def test_a_picture_has_every_figure_on_a_card_within_its_frame(tmp_path: Path, name: str) -> None:
    overrides, number = RUNS[name]
    _run(tmp_path, name, *overrides)
    file = tmp_path / "figures.svg"
    assert main([str(tmp_path), str(file)]) == 0
    picture = ElementTree.parse(file).getroot()
    _, _, width, height = map(float, picture.attrib["viewBox"].split())
    frame, *cards = picture.findall(f".//{SVG}rect")
    assert (float(frame.attrib["width"]), float(frame.attrib["height"])) == (width, height)
    assert len(cards) == len(picture.findall(f".//{SVG}svg[@role='img']")) == number
    for group in picture.findall(f"{SVG}g[{SVG}rect]"):
        x, y = map(float, group.attrib["transform"][len("translate(") : -1].split())
        card, figure = group.find(f"{SVG}rect"), group.find(f"{SVG}svg")
        assert card is not None
        assert figure is not None
        assert x + float(card.attrib["width"]) <= width
        assert y + float(card.attrib["height"]) <= height
        assert float(figure.attrib["x"]) + float(figure.attrib["width"]) <= float(
            card.attrib["width"]
        )


def test_it_has_its_colours_with_it_in_light_and_dark(tmp_path: Path) -> None:
    _run(tmp_path, "levels", "levels=[L1]", "limit=1")
    file = tmp_path / "figures.svg"
    main([str(tmp_path), str(file)])
    text = file.read_text(encoding="utf-8")
    light, dark = text.split("prefers-color-scheme: dark")
    assert light.count("--first:") == dark.count("--first:") == 1


@pytest.mark.parametrize("played", [True, False])
def test_what_has_no_figures_is_refused_in_a_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], played: bool
) -> None:
    if played:
        _run(tmp_path, "quickstart", "scenarios=[1]", "link=inprocess")
    assert main([str(tmp_path), str(tmp_path / "x.svg")]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert ("no figures" if played else "not a run folder") in told
    assert not (tmp_path / "x.svg").exists()
