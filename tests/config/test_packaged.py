"""Packaged configurations are found in a checkout and inside an installed package."""

from pathlib import Path

import pytest

import testbed.config.loading
from testbed.config import config_names, find_config


def test_every_packaged_name_leads_to_its_file() -> None:
    assert {"quickstart", "office"} <= set(config_names())
    for name in config_names():
        assert find_config(name).stem == name


def test_a_path_is_taken_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "quickstart.yaml"
    path.write_text("name: mine\n", encoding="utf-8")
    assert find_config(path) == path


def test_an_installed_package_carries_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "site-packages" / "testbed"
    (package / "configs").mkdir(parents=True)
    (package / "configs" / "only.yaml").write_text("name: only\n", encoding="utf-8")
    monkeypatch.setattr(testbed.config.loading, "__file__", str(package / "config" / "loading.py"))
    assert config_names() == ["only"]
    assert find_config("only").read_text(encoding="utf-8") == "name: only\n"
    with pytest.raises(FileNotFoundError, match="did you mean 'only'"):
        find_config("onli")


def test_a_folder_is_not_a_configuration(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="is a folder"):
        find_config(tmp_path)
