"""What trials need of the files of this machine, so that they can be played on another one.

Domains and refinements of a user's own, and the modules of robots and adversaries, with those that
they import, are sent along. What is installed is not: it has to be the same there.
"""

import ast
import sys
import sysconfig
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from hashlib import blake2b
from importlib.machinery import ModuleSpec
from importlib.util import find_spec, resolve_name
from pathlib import Path
from typing import Self

import msgspec

from testbed.experiment.adversaries import ADVERSARIES
from testbed.experiment.fingerprint import PACKAGES
from testbed.experiment.robots import ROBOTS
from testbed.experiment.specs import TrialSpec

TEXTS, MODULES = "texts", "modules"
LIBRARY = tuple(Path(sysconfig.get_path(name)) for name in ("stdlib", "platlib", "purelib"))


@dataclass(frozen=True)
class Luggage:
    """Files by their paths in the folder that they are unpacked into.

    `paths` leads from the path of a text here to that one; `modules` are the names of those that
    are sent, and `installed` those top-level ones that are not.
    """

    files: dict[str, bytes]
    paths: dict[str, str]
    modules: dict[str, str]
    installed: tuple[str, ...]

    @classmethod
    def of(cls, specs: Iterable[TrialSpec]) -> Self:
        """What these trials need. Raises OSError for a file that cannot be read."""
        files, paths, names = {}, {}, set()
        texts: set[str] = set()
        for spec in specs:
            fine = spec.setting.fine
            texts |= {spec.setting.domain, fine.refinement or "" if fine is not None else ""}
            names.add(ROBOTS.place(spec.robot))
            if spec.setting.strategy is not None:
                names.add(ADVERSARIES.place(spec.setting.strategy))
        for path in filter(Path.is_absolute, map(Path, sorted(texts))):
            content = path.read_bytes()
            paths[str(path)] = f"{TEXTS}/{blake2b(content, digest_size=6).hexdigest()}/{path.name}"
            files[paths[str(path)]] = content
        own = [name.partition(":")[0] for name in sorted(names)]
        modules = {}
        for name, spec_of in _travelling(own):
            assert spec_of.origin is not None
            modules[name] = f"{MODULES}/{_place_of(name, spec_of)}"
            files[modules[name]] = Path(spec_of.origin).read_bytes()
        heads = {name.partition(".")[0] for name in own} - {*PACKAGES}
        sent = {name.partition(".")[0] for name in modules}
        return cls(files, paths, modules, tuple(sorted(heads - sent)))

    def unpack(self, folder: Path) -> None:
        """Write the files into a folder."""
        (folder / MODULES).mkdir(parents=True, exist_ok=True)
        for path, content in self.files.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes(content)

    def displaced(self) -> str | None:
        """In one line a module in the place of one that was sent; None where there is none."""
        for name, path in self.modules.items():
            origin = _origin(find_spec(name))
            if origin is None or origin.read_bytes() != self.files[path]:
                return f"the module '{name}' is another one there: {origin}"
        return None

    def located(self, spec: TrialSpec, folder: Path) -> TrialSpec:
        """A trial whose files are those that were unpacked into a folder."""
        setting = spec.setting
        fine = setting.fine and msgspec.structs.replace(
            setting.fine, refinement=self._there(setting.fine.refinement, folder)
        )
        domain = self._there(setting.domain, folder)
        setting = msgspec.structs.replace(setting, domain=domain, fine=fine)
        return msgspec.structs.replace(spec, setting=setting)

    def _there(self, path: str | None, folder: Path) -> str | None:
        return str(folder / self.paths[path]) if path in self.paths else path


def _travelling(names: Iterable[str]) -> Iterator[tuple[str, ModuleSpec]]:
    """The modules of a user's own among these, and those that they import, with their specs."""
    waiting, known = list(names), set[str]()
    while waiting:
        name = waiting.pop()
        if name in known or not _is_own(name.partition(".")[0]):
            continue
        known.add(name)
        spec = _spec_of(name)
        waiting += [name.rpartition(".")[0]] if "." in name else []
        if (origin := _origin(spec)) is None:
            continue
        assert spec is not None
        yield name, spec
        if origin.suffix == ".py":
            waiting += _imported(origin.read_bytes(), spec.parent or "")


def _is_own(head: str) -> bool:
    """Whether a top-level module is neither ours, nor Python's, nor installed."""
    if head in PACKAGES or head in sys.stdlib_module_names or head in sys.builtin_module_names:
        return False
    spec = _spec_of(head)
    places = [] if spec is None else [spec.origin, *(spec.submodule_search_locations or ())]
    return not any(
        Path(place).is_relative_to(library) for place in places if place for library in LIBRARY
    )


def _spec_of(name: str) -> ModuleSpec | None:
    """Where a module is found; the packages that it is in are imported."""
    try:
        return find_spec(name) if name else None
    except (ImportError, AttributeError, ValueError):
        return None


def _origin(spec: ModuleSpec | None) -> Path | None:
    known = spec is not None and spec.has_location and spec.origin is not None
    return Path(spec.origin) if known and spec is not None and spec.origin else None


def _place_of(name: str, spec: ModuleSpec) -> str:
    """The path of a module's file relative to a folder that modules are searched in."""
    assert spec.origin is not None
    package = spec.submodule_search_locations is not None
    parts = name.split(".") if package else name.split(".")[:-1]
    return "/".join([*parts, Path(spec.origin).name])


def _imported(source: bytes, package: str) -> Iterator[str]:
    """The names of modules that a source imports anywhere in it, and some that are none."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = f"{'.' * node.level}{node.module or ''}"
            try:
                base = resolve_name(module, package) if node.level else module
            except ImportError:
                continue
            yield base
            yield from (f"{base}.{alias.name}" for alias in node.names)
