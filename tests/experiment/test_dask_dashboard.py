"""A run on Dask says where Dask shows what its workers do."""

import sys
from pathlib import Path
from urllib.request import urlopen

import pytest

from benchmarks.clusters import started
from testbed.registry import PATH_VARIABLE
from tests.pots import CARRIED, HOLDING, write_pots

pytestmark = pytest.mark.load


def test_the_address_of_the_dashboard_is_said_and_has_a_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(PATH_VARIABLE, "")
    monkeypatch.setattr(sys, "path", list(sys.path))
    (tmp_path / "hold").touch()
    holding = HOLDING.format(hold=str(tmp_path / "hold"))
    pots = write_pots(tmp_path / "beside", holding_carriers=holding, helping_carriers=CARRIED)
    run = ("-m", "testbed", "run", str(pots), "robots=[holding_carriers:Held]", "runner=dask")
    with started(*run, "--workers", "1", cwd=tmp_path) as driver:
        assert driver.stderr is not None
        said = next(line for line in driver.stderr if "dashboard" in line)
        with urlopen(said.split()[-1]) as page:
            assert b"bokeh.min.js" in page.read()
