"""The folder of a run: where it is, how its files are replaced, and the configuration in it."""

import os
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import count, takewhile, zip_longest
from pathlib import Path

from testbed.config import SCENARIO_KEYS, ExperimentConfig, load_config, write_yaml
from testbed.experiment.errors import StoreError
from testbed.experiment.texts import check_texts

TRIALS, CONFIG, PROVENANCE = "trials.jsonl", "config.yaml", "provenance.json"
STORIES = "stories.jsonl"
SUMMARY, REPORT, ERRORS = "summary.json", "report.html", "errors"
# Keys on which no logical result depends.
ANY_RESULT = (
    *("link", "limits.answer_s", "runner", "scheduler", "tls.ca", "tls.cert", "tls.key"),
    *("infos", "illegal", "padded"),  # of environments, in which no trial is played
    "stress.minutes",
)
MOST_CHANGES = 8
OWN_FILES = ("domain", "refinement")
"""Keys that may lead to a file which is not packaged."""
AS_BEFORE = {"relevance": "published"}
"""How runs were played that are older than a key with another default."""
TEXT = " text"
"""After the key of such a file: its text, which is no key of a configuration."""


def choose_folder(out: Path | None, name: str, resume: bool) -> Path:
    """The folder of a run: `out`, or a new one, `runs/NAME`, numbered where that one is taken.

    With `resume` it is the newest of the numbered ones.

    Raises:
        StoreError: when `out` holds a run already and is not to be resumed.
    """
    if out is None:
        return _newest(name) if resume else _new(name)
    if out.exists() and not out.is_dir():
        raise StoreError(f"{out}: is not a folder")
    _refuse_second_run(out, resume)
    return out


def begin_or_resume(folder: Path, config: ExperimentConfig, resume: bool) -> None:
    """Store the configuration of a new run, or check that it is that of the run to be resumed.

    Raises:
        StoreError: where a run is not to be resumed, or has another configuration.
        ConfigError: where its configuration is not valid any more.
    """
    _refuse_second_run(folder, resume)  # another may have begun, and ended, since it was chosen
    if holds_run(folder):
        check_unchanged(folder, config)
    else:
        write_config(folder, config)


def _refuse_second_run(folder: Path, resume: bool) -> None:
    if holds_run(folder) and not resume:
        raise StoreError(f"{folder}: holds a run already; --resume goes on with it")


def holds_run(folder: Path) -> bool:
    """Whether a run was started in this folder."""
    return (folder / CONFIG).is_file() or (folder / TRIALS).is_file()


def _numbered(name: str) -> Iterator[Path]:
    yield Path("runs") / name
    yield from (Path("runs") / f"{name}-{number}" for number in count(2))


def _newest(name: str) -> Path:
    *_, newest = Path("runs") / name, *takewhile(Path.exists, _numbered(name))
    return newest


def _new(name: str) -> Path:
    """A folder that is made here, so that no other run can choose it as well."""
    for folder in _numbered(name):
        folder.parent.mkdir(parents=True, exist_ok=True)
        with suppress(FileExistsError):
            folder.mkdir()
            return folder
    raise AssertionError("numbers do not end")


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Let errors of writing say the file, which those of a full disk do not."""
    try:
        yield
    except OSError as error:
        if error.filename is not None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error


def replace_text(path: Path, text: str) -> None:
    """Write a file so that a reader finds the old one or the new one, never a part."""
    replace_lines(path, [text.encode()])


def replace_lines(path: Path, lines: Iterable[bytes]) -> None:
    """As `replace_text`; the new lines reach the disk before the old ones leave it."""
    # A draft per process: two of them may write the same file at once.
    draft = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        with naming(path), draft.open("wb") as file:
            file.writelines(lines)
            file.flush()
            os.fsync(file.fileno())
        os.replace(draft, path)
    finally:
        draft.unlink(missing_ok=True)


def read_config(folder: Path) -> ExperimentConfig:
    """The configuration stored in a run folder, in whose texts its trials were played.

    Raises StoreError, also for another text, or ConfigError.
    """
    if not (folder / CONFIG).is_file():
        raise StoreError(f"{folder}: is not a run folder (it has no {CONFIG})")
    config = as_played(load_config(folder / CONFIG))
    check_texts(folder / TRIALS, _own_files(config))
    return config


def is_stored(path: Path) -> bool:
    """Whether a configuration is that of a run folder."""
    return path.name == CONFIG and (path.parent / PROVENANCE).is_file()


def as_played(config: ExperimentConfig) -> ExperimentConfig:
    """A stored configuration; what it does not say is as runs were played without the key."""
    older = {key: own for key, own in AS_BEFORE.items() if key not in config.model_fields_set}
    return config.model_copy(update=older)


def write_config(folder: Path, config: ExperimentConfig) -> None:
    """Write the resolved configuration, and beside it a domain or map that is not packaged."""
    folder.mkdir(parents=True, exist_ok=True)
    _copy_own_files(config, folder)
    replace_text(folder / CONFIG, stored_text(config))


def portable_text(config: ExperimentConfig, folder: Path) -> str:
    """The configuration as a file in `folder` has it, by its keys that are not as by default.

    A domain or map that is not packaged is copied there. Raises OSError.
    """
    _copy_own_files(config, folder)
    return write_yaml(_beside(config).model_dump(mode="json", exclude_defaults=True))


def _copy_own_files(config: ExperimentConfig, folder: Path) -> None:
    for source in _own_files(config).values():
        if source.parent != folder.resolve():
            with naming(folder / source.name):
                shutil.copyfile(source, folder / source.name)


def stored_text(config: ExperimentConfig) -> str:
    """The configuration as a run folder has it: its own files lie beside it."""
    return config_text(_beside(config))


def _beside(config: ExperimentConfig) -> ExperimentConfig:
    own = {key: source.name for key, source in _own_files(config).items()}
    return config.model_copy(update=own)


def _own_files(config: ExperimentConfig) -> dict[str, Path]:
    """The files that a configuration leads to, by its key."""
    files = {"domain": Path(config.domain)} if config.domain.endswith(".al") else {}
    refinement = Path(config.refinement or "")
    return files | {"refinement": refinement} if refinement.is_absolute() else files


def config_text(config: ExperimentConfig) -> str:
    """The configuration as YAML: every key with its value or default, of scenarios what is set.

    Keys of scenarios are left out where there are levels.
    """
    if config.is_fine:
        return write_yaml(config.model_dump(mode="json", exclude=set(SCENARIO_KEYS)))
    own = config.model_dump(mode="json", include={"scenario_settings"}, exclude_none=True)
    return write_yaml(config.model_dump(mode="json") | own)


def check_unchanged(folder: Path, config: ExperimentConfig) -> None:
    """Raise StoreError, showing the difference, unless `config` is the one stored in `folder`.

    Of a long difference the beginning is shown: the keys that were given, then defaults. Raises
    ConfigError where the stored configuration is not valid any more.
    """
    changed = differences(read_config(folder), config)
    if changed:
        lines = [
            f"{folder}: its configuration is another one; resume it unchanged or choose --out",
            *(f"  {change}" for change in changed),
        ]
        if len(changed) > MOST_CHANGES:
            lines[MOST_CHANGES + 1 :] = [f"  and {len(changed) - MOST_CHANGES} more"]
        raise StoreError("\n".join(lines))


def differences(stored: ExperimentConfig, given: ExperimentConfig) -> list[str]:
    """What results depend on and is not the same in both: the keys that were given come first."""
    old, new = flat_config(stored), flat_config(given)
    changed = [
        key
        for key in dict.fromkeys((*old, *new))
        if old.get(key) != new.get(key) and key not in ANY_RESULT
    ]
    changed.sort(key=lambda key: key.partition(".")[0] not in given.model_fields_set)
    return [_change(key, old.get(key, "absent"), new.get(key, "absent")) for key in changed]


def _change(key: str, old: object, new: object) -> str:
    """One line; of texts the first line that differs."""
    if not key.endswith(TEXT):
        return f"{key}: {old} -> {new}"
    pairs = enumerate(zip_longest(str(old).split("\n"), str(new).split("\n"), fillvalue=""), 1)
    number, (before, after) = next(own for own in pairs if own[1][0] != own[1][1])
    return f"{key}, line {number}: {before.strip()} -> {after.strip()}"


def flat_config(config: ExperimentConfig) -> dict[str, object]:
    """The keys that are set, nested ones with dots, and the texts of its own files."""
    flat = dict(_flat("", config.model_dump(mode="json", exclude_none=True)))
    for key, file in _own_files(config).items():
        flat |= {key: file.name, key + TEXT: file.read_text(encoding="utf-8")}
    return flat


def _flat(prefix: str, value: object) -> Iterator[tuple[str, object]]:
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _flat(f"{prefix}{key}.", item)
    else:
        yield prefix.removesuffix("."), value
