"""Arguments as arrays, without a copy if possible. An invalid argument is refused with its name."""

from __future__ import annotations

import os
from typing import Any, Tuple

import numpy as np
from numpy.typing import NDArray


def _array(name: str, value: Any) -> NDArray[Any]:
    if isinstance(value, np.ndarray):
        return value
    if hasattr(value, "__array__") or hasattr(value, "__array_interface__") or hasattr(value, "__dlpack__"):
        return np.asarray(value)
    raise TypeError(f"{name}: expected a numpy array, not {type(value).__name__}")


def pixels(name: str, value: Any, dtypes: Tuple[type, ...], channels: Tuple[int, ...]) -> NDArray[Any]:
    """An image, (H, W) or (H, W, C). The caller's own memory where its pixels stand one after the other in each row
    (a crop does, a mirrored or strided view does not); else a copy."""
    array = _array(name, value)
    expected = " or ".join(np.dtype(t).name for t in dtypes)
    if array.dtype not in [np.dtype(t) for t in dtypes]:
        raise TypeError(f"{name}: has dtype {array.dtype}; expected {expected}")
    shapes = " or ".join("(H, W)" if c == 1 else f"(H, W, {c})" for c in channels)
    if array.ndim == 3 and array.shape[2] == 1 and 1 in channels:
        array = array[:, :, 0]
    found = 1 if array.ndim == 2 else array.shape[2] if array.ndim == 3 else 0
    if found not in channels:
        raise ValueError(f"{name}: has shape {array.shape}; expected {shapes}")
    if array.size == 0:
        raise ValueError(f"{name}: is empty, shape {array.shape}")
    step = array.itemsize
    rows, columns = array.shape[:2]
    inner = (array.ndim == 2 or array.strides[2] == step) and array.strides[1] == step * found
    if not inner or array.strides[0] < columns * step * found or array.strides[0] % step or not array.flags.aligned:
        array = np.ascontiguousarray(array)
    return array


def numbers(name: str, value: Any, shape: Tuple[Any, ...], dtype: type = np.float64) -> NDArray[Any]:
    """Numbers in rows without gaps. `shape` has numbers, and letters for sizes that may be any."""
    try:
        array = np.asarray(value)
    except (TypeError, ValueError) as error:  # rows of different lengths
        raise TypeError(f"{name}: is no array of numbers: {error}") from None
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{name}: has dtype {array.dtype}; expected numbers")
    fits = array.ndim == len(shape) and all(
        isinstance(want, str) or want == has for want, has in zip(shape, array.shape)
    )
    if not fits:
        raise ValueError(f"{name}: has shape {array.shape}; expected ({', '.join(str(s) for s in shape)})")
    return np.ascontiguousarray(array, dtype=dtype)


def real(name: str, value: Any) -> float:
    """A number; it may be NaN."""
    if isinstance(value, (str, bytes)) or not hasattr(value, "__float__") and not hasattr(value, "__index__"):
        raise TypeError(f"{name}: expected a number, not {type(value).__name__}")
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name}: expected one number that a float can hold, not {type(value).__name__}") from None


def positive(name: str, value: Any) -> float:
    number = real(name, value)
    if not (0 < number < float("inf")):
        raise ValueError(f"{name}: {number:g} is not a finite number above 0")
    return number


def whole(name: str, value: Any, least: int, most: int = 2**31 - 1) -> int:
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError(f"{name}: expected a whole number, not {type(value).__name__}")
    number = int(value.__index__())
    if not least <= number <= most:
        raise ValueError(f"{name}: {number} is out of range: {least} to {most}")
    return number


def text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name}: expected a str, not {type(value).__name__}")
    if "\0" in value or not value.isprintable():
        raise ValueError(f"{name}: {value!r} has characters that are not printable")
    return str(value)


def flag(name: str, value: Any) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: expected True or False, not {type(value).__name__}")
    return bool(value)


def is_rgb(colours: Any) -> bool:
    if not isinstance(colours, str) or colours not in ("bgr", "rgb"):
        raise ValueError(f"colours: {colours!r} is not known; use 'bgr' or 'rgb'")
    return colours == "rgb"


def size(name: str, image: NDArray[Any], width: int, height: int) -> None:
    if image.shape[:2] != (height, width):
        found = f"{image.shape[1]}x{image.shape[0]}"
        raise ValueError(f"{name}: has {found} pixels; the camera's images have {width}x{height}")


def path(name: str, value: Any) -> str:
    try:
        found = os.fspath(value)
    except TypeError:
        raise TypeError(f"{name}: expected a path, not {type(value).__name__}") from None
    found = os.fsdecode(found)
    if "\0" in found or not found:
        raise ValueError(f"{name}: {found!r} is no path")
    return found
