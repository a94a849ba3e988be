"""One trial as a file of its own: its record, from which it is played again without a run folder.

The texts that the record names by their hashes come with it, or lie beside it, or are packaged.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import msgspec

from asp.language import packaged_domains, read_domain
from asp.refinement import read_refinement
from testbed.experiment.errors import StoreError
from testbed.experiment.origin import Origin, here
from testbed.experiment.record import TrialRecord
from testbed.experiment.recorder import NAMED
from testbed.experiment.row_rules import check_row
from testbed.experiment.specs import Setting, TrialSpec
from testbed.experiment.store import sealed
from testbed.experiment.texts import refuse_another, sha256
from testbed.experiment.trial_setup import setup_of

ENDINGS = {"domain": ".al", "refinement": ".fine"}
"""Of the files of texts, by what a text is."""
READ = {"domain": read_domain, "refinement": read_refinement}
Texts = Mapping[str, str]
"""By what they are: `domain`, `refinement`."""


def row_of(spec: TrialSpec, record: TrialRecord) -> bytes:
    """A record and the texts of its trial as one line of JSON, the latter under `texts`.

    Raises StoreError where a text is another one than the trial was played in.
    """
    texts, hashes = {}, _hashes(record)
    for key, place in _places(spec.setting).items():
        _, texts[key] = READ[key](place)
        refuse_another(key, place, texts[key], hashes[key], f"trial {spec.trial}")
    whole = msgspec.to_builtins(record, enc_hook=str) | {"texts": texts}
    return sealed(msgspec.json.encode(whole))


def _places(setting: Setting) -> dict[str, str]:
    """Names or files of the texts of a setting; there are none where a level is made."""
    fine = setting.fine
    if fine is None:
        return {"domain": setting.domain}
    return {"domain": setting.domain, "refinement": fine.refinement} if fine.refinement else {}


def _hashes(record: TrialRecord) -> dict[str, str | None]:
    origin = record.origin
    if origin is None:
        return dict.fromkeys(ENDINGS)
    return {"domain": origin.domain_sha256, "refinement": origin.refinement_sha256}


@contextmanager
def trial_of(file: Path, record: TrialRecord, texts: Texts) -> Iterator[TrialSpec]:
    """The trial of a row, which can be played within this block; `file` is where the row lies.

    Raises:
        StoreError: where the record does not say what it was played under, or a text is missing or
            another than it was.
        ConfigError: for what no configuration would allow in it, such as a robot that there is not.
    """
    setting = record.condition
    if setting is None:
        older = "has no `condition`, which older testbeds did not record"
        raise StoreError(f"{file}: {older}; replay the trial from its run folder")
    named, hashes = {key: getattr(record, key) for key in NAMED}, _hashes(record)
    with TemporaryDirectory(prefix="testbed-") as folder:
        finder = _Finder(file, Path(folder), texts)
        names = _places(setting)
        found = {key: finder.find(key, name, hashes[key]) for key, name in names.items()}
        setting = _placed(setting, found)
        check_row(file, record, setting)
        _check_level(file, record, setting)
        yield TrialSpec(**named, initial=tuple(record.initial), setting=setting)


def _placed(setting: Setting, found: Mapping[str, str]) -> Setting:
    fine = setting.fine
    if fine is not None and "refinement" in found:
        fine = msgspec.structs.replace(fine, refinement=found["refinement"])
    return msgspec.structs.replace(setting, domain=found.get("domain", setting.domain), fine=fine)


def _check_level(file: Path, record: TrialRecord, setting: Setting) -> None:
    """Raise StoreError for another level than was made then."""
    hashes = tuple(_hashes(record).values())
    if any(hashes) and setup_of(setting).hashes != hashes:
        raise StoreError(f"{file}: the level that is made of its size is another one here")


class _Finder:
    """Finds texts: those that came with a row, which are put into `folder`, and other ones."""

    def __init__(self, file: Path, folder: Path, texts: Texts) -> None:
        self._file, self._folder, self._texts = file, folder, texts

    def find(self, key: str, name: str, wanted: str | None) -> str:
        """The place of the text with this hash, or where none is known the first one."""
        if Path(name).name != name or not name.isprintable():
            raise StoreError(f"{self._file}: '{name}' is not the name of a {key}")
        places = list(self._candidates(key, name))
        for place in places:
            if wanted in (None, sha256(READ[key](place)[1])):
                return place
        own = name + ENDINGS[key]
        if places:
            other = f"{key} {own} has the SHA-256 {wanted}, and what was found has not"
            raise StoreError(f"{self._file}: its {other}; put that file beside it")
        beside = f"put {own} beside it, or write it by 'testbed replay DIR --trial ID --row'"
        raise StoreError(f"{self._file}: its {key} '{name}' is not to be found; {beside}")

    def _candidates(self, key: str, name: str) -> Iterator[str]:
        own = name + ENDINGS[key]
        if key in self._texts:
            (self._folder / own).write_text(self._texts[key], encoding="utf-8")
            yield str(self._folder / own)
        if (beside := self._file.resolve().parent / own).is_file():
            yield str(beside)
        if name in packaged_domains(ENDINGS[key]):
            yield name if key == "domain" else own


def other_versions(origin: Origin | None) -> str | None:
    """In what the versions of a record differ from those of this process; None in nothing."""
    if origin is None:
        return None
    before, now = _versions(origin), _versions(here())
    unlike = [
        f"{name} {was} (here {now[name]})"
        for name, was in before.items()
        if name in now and was != now[name]
    ]
    return f"recorded with other versions: {', '.join(unlike)}" if unlike else None


def _versions(origin: Origin) -> dict[str, str]:
    changed = " with changes" * bool(origin.dirty)
    return origin.versions | ({"revision": origin.revision + changed} if origin.revision else {})
