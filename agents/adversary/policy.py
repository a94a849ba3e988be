"""Policy files: a network of plain arrays, read without running anything that is in the file.

A file in NumPy's format `.npz` holds `inputs` and `actions`, arrays of text that name the entries
of the observation and the actions, `weights_0`, `bias_0`, `weights_1` and so on, and `made`, a line
that says how it was made. The output of a layer is x W + b; all but the last are followed by tanh.
The last one has a preference per action.
"""

import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

MOST_BYTES = 50_000_000
MOST_LAYERS = 16
LARGEST = 1e6
"""The largest weight: sums of so many inputs as a file can have remain finite in float32."""

Array = NDArray[np.float32]


class PolicyError(ValueError):
    """A file that is no policy: one line that names it, and says what is wrong."""


@dataclass(frozen=True)
class Policy:
    """A network: `layers` are weights, (n, m), with biases, (m,), of float32."""

    inputs: tuple[str, ...]
    actions: tuple[str, ...]
    layers: tuple[tuple[Array, Array], ...]
    made: str

    def preferences(self, observation: Array) -> Array:
        """A number per action, (A,), for the values of the inputs, (n,)."""
        *hidden, (weights, bias) = self.layers
        for own, offset in hidden:
            observation = np.tanh(observation @ own + offset)
        return observation @ weights + bias

    def save(self, path: Path) -> None:
        """Write the file. Raises OSError."""
        arrays = {"inputs": np.array(self.inputs), "actions": np.array(self.actions)}
        for number, (weights, bias) in enumerate(self.layers):
            arrays |= {f"weights_{number}": weights, f"bias_{number}": bias}
        np.savez_compressed(path, allow_pickle=False, made=np.array(self.made), **arrays)


def load_policy(path: Path) -> Policy:
    """The policy in a file.

    Raises:
        PolicyError: where there is none, or one that does not fit together.
    """
    try:
        with path.open("rb") as file, zipfile.ZipFile(file) as archive:
            size = sum(member.file_size for member in archive.infolist())
        if size > MOST_BYTES:
            raise PolicyError(f"{path}: has {size:,} bytes, and {MOST_BYTES:,} are allowed")
        with np.load(path, allow_pickle=False) as found:
            arrays = {name: found[name] for name in found.files}
    except OSError as error:
        raise PolicyError(f"{path}: {error.strerror or error}") from None
    except PolicyError:
        raise
    except Exception as error:  # whatever a damaged archive makes NumPy say
        why = str(error).partition("\n")[0]
        raise PolicyError(f"{path}: is no file of plain arrays (.npz): {why}") from None
    return _policy(path, arrays)


def _policy(path: Path, arrays: dict[str, NDArray[np.generic]]) -> Policy:
    names = {}
    for key in ("inputs", "actions"):
        own = arrays.pop(key, None)
        if own is None or own.dtype.kind != "U" or own.ndim != 1 or not 0 < own.size == len({*own}):
            raise PolicyError(f"{path}: {key} should be an array of different names")
        names[key] = tuple(map(str, own))
    made = str(arrays.pop("made", ""))
    width, layers = len(names["inputs"]), list[tuple[Array, Array]]()
    while arrays and len(layers) < MOST_LAYERS:
        number = len(layers)
        given = {own: arrays.pop(own, None) for own in (f"weights_{number}", f"bias_{number}")}
        (name, own), (offset, bias) = given.items()
        weights = _numbers(path, name, own, (width, None))
        width = weights.shape[1]
        layers.append((weights, _numbers(path, offset, bias, (width,))))
    if arrays or width != len(names["actions"]) or not layers:
        what = (
            f"{sorted(arrays)[0]} is unknown" if arrays else "the last layer does not fit actions"
        )
        raise PolicyError(f"{path}: {what}")
    return Policy(names["inputs"], names["actions"], tuple(layers), made)


def _numbers(
    path: Path, name: str, own: NDArray[np.generic] | None, shape: Sequence[int | None]
) -> Array:
    """An array of this shape as float32. Raises PolicyError for another one, and large numbers."""
    if (
        own is not None
        and own.dtype.kind == "f"
        and own.ndim == len(shape)
        and all(n in (None, m) for n, m in zip(shape, own.shape, strict=True))
    ):
        with np.errstate(over="ignore"):
            cast = own.astype(np.float32)
        if bool((np.abs(cast) <= LARGEST).all()):  # which nan is not
            return cast
    wanted = ", ".join("any" if n is None else str(n) for n in shape)
    least = f"numbers from -{LARGEST:,.0f} to {LARGEST:,.0f}"
    raise PolicyError(f"{path}: {name} should be of shape ({wanted}), with {least}")
