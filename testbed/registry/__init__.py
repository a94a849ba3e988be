"""Find a class by name: built-in, of another distribution's entry points, or as `module:Class`.

A module of a user's own may lie in the folder of the configuration, which is searched after
everything else, so that nothing in it takes the place of another module. Processes that are started
find that folder by the environment variable `PATH_VARIABLE`.
"""

import os
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from importlib.metadata import entry_points
from inspect import signature
from pathlib import Path
from threading import RLock
from typing import Any, Generic, TypeVar

from asp.language import suggestion
from testbed.protocol import in_one_line

T = TypeVar("T")
PATH_VARIABLE = "TESTBED_PATH"
OURS = "intention-testbed"
"""The distribution that a built-in name belongs to."""
_importing = RLock()
"""Two threads, one that imports a module and one its package, which imports it, too, deadlock."""


class RegistryError(ValueError):
    """A name that leads to nothing, or to what cannot be used: one line that says why."""


@dataclass(eq=False)
class Registry(Generic[T]):
    """What configurations call by name: robots, adversaries, studies.

    Parameters
    ----------
    kind : what is found, as messages call it (`robot`).
    group : the entry point group in which other distributions register theirs.
    built_in : by name the `module:attribute` of each built-in one.
    fault : what is wrong with something that was found; None if it can be used.
    """

    kind: str
    group: str
    built_in: Mapping[str, str]
    fault: Callable[[Any], str | None]
    _found: dict[str, T] = field(default_factory=dict, init=False)

    def names(self) -> list[str]:
        """The registered names, sorted. Nothing is imported."""
        return sorted(self._claims())

    def find(self, name: str) -> T:
        """What is registered under a name, or stands at `module:attribute`.

        Raises:
            RegistryError: for an unknown name, one that two distributions claim, a module that
                cannot be imported, and what cannot be used.
        """
        if name not in self._found:
            found = _attribute(self.place(name))
            if fault := self.fault(found):
                raise RegistryError(f"'{name}' is no {self.kind}: it {fault}")
            self._found[name] = found
        return self._found[name]

    def forget(self) -> None:
        """Look for everything anew: modules may have been replaced."""
        self._found.clear()

    def usable(self) -> Iterator[tuple[str, T]]:
        """The registered ones by name, without those that cannot be used."""
        for name in self.names():
            try:
                yield name, self.find(name)
            except RegistryError:
                continue

    def place(self, name: str) -> str:
        """Where something stands, as `module:attribute`. Raises RegistryError as `find` does."""
        if ":" in name:
            return name
        claims = self._claims()
        if name not in claims:
            module, dot, attribute = name.rpartition(".")
            own = f"of a module of your own it is module:Class, such as {module}:{attribute}"
            near = suggestion(name, claims, otherwise=own if dot else None)
            raise RegistryError(f"unknown {self.kind} '{name}'; {near}")
        by_owner = claims[name]
        if len(by_owner) > 1:
            owners = " and ".join(sorted(by_owner))
            raise RegistryError(
                f"the {self.kind} '{name}' is registered by {owners}; uninstall one of them, or "
                "give module:Class"
            )
        (place,) = by_owner.values()
        return place

    def _claims(self) -> dict[str, dict[str, str]]:
        """By name, and by the distribution that registers it, where it stands."""
        claims = {name: {OURS: place} for name, place in self.built_in.items()}
        for point in entry_points(group=self.group):
            owner = point.dist.name if point.dist else "an unnamed distribution"
            claims.setdefault(point.name, {})[owner] = point.value
        return claims


def class_fault(found: object, *methods: str, arguments: int = 0) -> str | None:
    """What is wrong with a class that is made with so many arguments and is to have these methods.

    Returns None where nothing is.
    """
    if not isinstance(found, type):
        return "is not a class"
    missing = [name for name in methods if not callable(getattr(found, name, None))]
    if missing:
        return f"has no method {' and no method '.join(missing)}"
    try:
        signature(found).bind(*range(arguments))
    except TypeError as error:
        return f"cannot be made with {arguments or 'no'} arguments: {error}"
    return None


def _attribute(place: str) -> Any:
    module, _, path = place.partition(":")
    parts = path.split(".")
    if not all(part.isidentifier() for part in (*module.split("."), *parts)):
        raise RegistryError(f"'{place}' should be module:Class, as in my_package.my_module:MyClass")
    try:
        with _importing:
            found: Any = import_module(module)
    except (Exception, SystemExit) as error:  # whatever a module of a user's does
        if isinstance(error, ModuleNotFoundError) and f"{module}.".startswith(f"{error.name}."):
            where = "it can lie beside the configuration, or be installed"
            raise RegistryError(f"there is no module '{error.name}'; {where}") from None
        said = in_one_line(error)
        raise RegistryError(f"the module '{module}' cannot be imported: {said}") from error
    for part in parts:
        if not hasattr(found, part):
            public = (name for name in vars(found) if not name.startswith("_"))
            near = suggestion(part, public, otherwise="look at how it is spelled there")
            raise RegistryError(f"'{place}': {module} has no {part}; {near}")
        found = getattr(found, part)
    return found


def search_last(folder: Path) -> None:
    """Let this process, and those that it starts, import from a folder after everything else."""
    os.environ[PATH_VARIABLE] = str(folder)
    search_as_told()


def search_no_more(folder: Path) -> None:
    """Import no more from a folder that was searched last, and forget what came from there."""
    sys.path[:] = [own for own in sys.path if own != str(folder)]
    if os.environ.get(PATH_VARIABLE) == str(folder):
        del os.environ[PATH_VARIABLE]
    for name, module in list(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if file is not None and Path(file).is_relative_to(folder):
            del sys.modules[name]


def search_as_told() -> None:
    """As `search_last`, with the folder that the process that started this one has told it."""
    folder = os.environ.get(PATH_VARIABLE)
    if folder and folder not in sys.path:
        sys.path.append(folder)
