"""A window that shows the pictures of a game, where there is a screen."""

from typing import Any

from testbed.environment.rendering.picture import Image

INCHES = 100
"""Pixels of a picture per inch of the window."""


class Window:
    """A window of matplotlib, which chooses the toolkit; it opens with the first picture."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._figure: Any = None

    def show(self, picture: Image) -> bool:
        """Show a picture (height, width, 3) of uint8; False where there is no screen."""
        import matplotlib.pyplot as plt  # noqa: PLC0415  # slow, and few look at a window
        from matplotlib.backends.registry import BackendFilter, backend_registry  # noqa: PLC0415

        files: list[str] = backend_registry.list_builtin(  # type: ignore[no-untyped-call]
            BackendFilter.NON_INTERACTIVE
        )
        if plt.get_backend().lower() in files:  # which write pictures, and show none
            return False
        if self._figure is None or not plt.fignum_exists(self._figure.number):  # or was closed
            height, width, _ = picture.shape
            self._figure = plt.figure(self._title, figsize=(width / INCHES, height / INCHES))
            self._figure.show()
        self._figure.clear()
        self._figure.figimage(picture)
        self._figure.canvas.draw_idle()
        self._figure.canvas.flush_events()
        return True

    def close(self) -> None:
        """Close the window, if it is open."""
        if self._figure is not None:
            import matplotlib.pyplot as plt  # noqa: PLC0415

            plt.close(self._figure)
            self._figure = None
