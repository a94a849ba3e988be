"""Find the configurations that travel with the package, in a checkout and in an installed wheel."""

from __future__ import annotations

from pathlib import Path

from asp.language import suggestion

SUFFIX = ".yaml"


def config_folder() -> Path:
    """The folder of the packaged configurations.

    A wheel carries them inside the package; a checkout keeps them beside it.
    """
    package = Path(__file__).resolve().parent.parent
    inside = package / "configs"
    return inside if inside.is_dir() else package.parent / "configs"


def config_names() -> list[str]:
    """Names under which a packaged configuration can be asked for, sorted."""
    return sorted(path.stem for path in config_folder().glob("*" + SUFFIX))


def find_config(source: str | Path) -> Path:
    """Path of a configuration given by path or by bare name (`quickstart`).

    Raises:
        FileNotFoundError: with one line that names the nearest packaged configurations.
    """
    path = Path(source)
    if path.is_file():
        return path
    if path.is_dir():
        raise FileNotFoundError(f"{source}: is a folder; a configuration is a {SUFFIX} file")
    packaged = config_folder() / (path.name + SUFFIX)
    if path.name == str(source) and packaged.is_file():
        return packaged
    raise FileNotFoundError(f"{source}: no such file; {suggestion(path.stem, config_names())}")
