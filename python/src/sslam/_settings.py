"""The settings of a system: presets, parameters, a camera, the shipped network."""

from __future__ import annotations

import importlib.resources
import os
from typing import Dict, List, Mapping, Optional, Union

from . import _check, _sslam
from ._sslam import Camera
from ._types import Parameter, Preset
from ._wide_lens import WideLens

Path = Union[str, "os.PathLike[str]"]


def shipped_network() -> Optional[str]:
    """The normal network that comes with sslam; None where it is not installed."""
    models = importlib.resources.files("sslam") / "models"
    manifest, model = models / "planar_normals.json", models / "planar_normals.onnx"
    return str(manifest) if manifest.is_file() and model.is_file() else None


def presets() -> List[Preset]:
    return [Preset(*values) for values in _sslam.presets()]


def parameters(preset: str = "structure") -> List[Parameter]:
    """Every parameter of a preset, with its default."""
    return [Parameter(*values) for values in _sslam.preset_parameters(_check.text("preset", preset))]


def as_camera(name: str, camera: object) -> Camera:
    if isinstance(camera, Camera):
        return camera
    if not isinstance(camera, (str, bytes, os.PathLike)):
        raise TypeError(f"{name}: expected an sslam.Camera or the path of a camera file, not {type(camera).__name__}")
    return Camera.from_file(_check.path(name, camera))


def wide_lens(camera: Union[Camera, WideLens, Path]) -> Optional[WideLens]:
    """None: a pinhole sees what the camera sees."""
    if isinstance(camera, (str, bytes, os.PathLike)) and _sslam.is_wide(_check.path("camera", camera)):
        return WideLens(camera)
    return camera if isinstance(camera, WideLens) else None


def parameter_values(call: str, given: Optional[Mapping[str, float]], words: Dict[str, float]) -> Dict[str, float]:
    for name in words:
        if "__" not in name:
            raise TypeError(f"{call}: no argument {name}; parameters of stages have '__' for each dot of their names")
    if given is not None and not isinstance(given, Mapping):
        raise TypeError(f"parameters: expected a dict of numbers, not {type(given).__name__}")
    values = dict(given or {})
    values.update({name.replace("__", "."): value for name, value in words.items()})
    return {_check.text("parameters", name): _check.real(str(name), value) for name, value in values.items()}
