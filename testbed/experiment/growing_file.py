"""Files of lines that another process writes."""

import os
from collections.abc import Iterator
from pathlib import Path


class GrowingFile:
    """A file of lines to which another process appends, or which it replaces by another one."""

    def __init__(self, path: Path) -> None:
        self._path, self._at, self._inode = path, 0, 0

    def new_lines(self) -> Iterator[tuple[int, bytes]]:
        """Whole lines that were not read before, with their places; all of a file that is new."""
        try:
            file = self._path.open("rb")
        except FileNotFoundError:
            return
        with file:
            found = os.fstat(file.fileno())
            if found.st_ino != self._inode or found.st_size < self._at:
                self._at, self._inode = 0, found.st_ino
            file.seek(self._at)
            for line in file:
                if not line.endswith(b"\n"):
                    return
                place, self._at = self._at, self._at + len(line)
                yield place, line
