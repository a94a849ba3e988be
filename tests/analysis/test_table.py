"""A run as one table, in Python, Parquet and CSV: nothing is lost, whatever a run holds."""

import json
import re
from pathlib import Path
from typing import Any

import msgspec
import polars as pl
import pytest

import testbed
from testbed.analysis import columns
from testbed.analysis.columns import PARTS
from testbed.analysis.export import export
from testbed.analysis.table import records_of
from testbed.config import ConfigError
from testbed.experiment import StoreError
from testbed.experiment.record import TrialRecord
from testbed.experiment.run_folder import read_config, write_config
from testbed.experiment.runner import play_missing
from testbed.experiment.store import TrialWriter, read_records
from tests.experiment.samples import Configure, a_record

pytestmark = pytest.mark.versions


@pytest.fixture
def run(tmp_path: Path, configure: Configure) -> Path:
    """A run with explanations and events in some trials and none in others."""
    config = configure("scenarios=[1,4]")
    write_config(tmp_path, config)
    play_missing(config, tmp_path, 1, lambda _: None)
    return tmp_path


def _columns(row: dict[str, Any]) -> dict[str, Any]:
    """A record as it is written, what it was played under key by key."""
    told = {key: row.pop(key) or {} for key in PARTS}
    own = ((f"{key}.{name}", value) for key in PARTS for name, value in told[key].items())
    return row | dict(own)


def test_parquet_gives_the_records_back(run: Path) -> None:
    stored = list(read_records(run))
    assert list(records_of(pl.read_parquet(export(run)[0]))) == stored
    assert any(record.explanations for record in stored)


def test_the_table_has_a_row_per_record_and_a_column_per_key(run: Path) -> None:
    loaded, stored = testbed.load_run(run), list(read_records(run))
    assert list(loaded.records()) == stored
    assert loaded.trials.columns == list(columns.schema())
    assert list(loaded.records(pl.col("scenario") == "4")) == stored[len(stored) // 2 :]
    assert loaded.config == read_config(run)


def test_a_run_that_has_not_begun_has_a_table_without_rows(
    tmp_path: Path, configure: Configure
) -> None:
    write_config(tmp_path, configure())
    assert testbed.load_run(str(tmp_path)).trials.shape == (0, len(columns.schema()))


def test_each_column_is_documented() -> None:
    page = (Path(__file__).parents[2] / "docs" / "results.md").read_text(encoding="utf-8")
    rows = [" ".join(line.split("|")[1:3]) for line in page.splitlines() if line.startswith("| `")]
    told = {name for row in rows for name in re.findall(r"`([\w.]+)`", row)}
    nested = {
        field.name
        for kind in columns.schema().values()
        for part in [kind.inner if isinstance(kind, pl.List) else kind]
        if isinstance(part, pl.Struct)
        for field in part.fields
    }
    assert {*columns.schema(), *nested} <= told


def test_csv_gives_the_records_back(run: Path) -> None:
    told = pl.read_csv(export(run)[1], infer_schema=False).to_dicts()
    for row, record in zip(told, read_records(run), strict=True):
        for name, value in _columns(json.loads(msgspec.json.encode(record, enc_hook=str))).items():
            if isinstance(value, list | dict):
                assert json.loads(row[name]) == value
            elif isinstance(value, bool):
                assert row[name] == str(value).lower()
            elif value is None:
                assert row[name] is None
            else:
                assert type(value)(row[name]) == value


def test_columns_keep_their_types_where_all_are_empty(tmp_path: Path, configure: Configure) -> None:
    write_config(tmp_path, configure())
    with TrialWriter(tmp_path) as writer:
        writer.append(a_record("a"))
    parquet, csv = export(tmp_path)
    found = pl.read_parquet(parquet)
    assert found.schema["exogenous"] == pl.List(
        pl.Struct({"step": pl.Int64, "action": pl.String, "observed": pl.Boolean})
    )
    keys = [key for key in TrialRecord.__struct_fields__ if key not in PARTS]
    assert found.columns[: len(keys)] == keys
    added = [name.partition(".")[0] for name in found.columns[len(keys) :]]
    assert list(dict.fromkeys(added)) == [*PARTS, "quality"]
    assert pl.read_csv(csv)["exogenous"].to_list() == ["[]"]


def test_what_cannot_be_exported_is_said(tmp_path: Path, configure: Configure) -> None:
    with pytest.raises(StoreError, match="not a run folder"):
        export(tmp_path)
    write_config(tmp_path, configure())
    with pytest.raises(StoreError, match="no trials to export yet"):
        export(tmp_path)
    (tmp_path / "config.yaml").write_text("name: x\n", encoding="utf-8")
    with pytest.raises(ConfigError):
        export(tmp_path)
