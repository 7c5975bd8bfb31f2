"""Low-drift monocular SLAM for indoor places with little texture.

    import sslam

    dataset = sslam.open_dataset("room")
    system = sslam.System(dataset.camera)
    for frame in dataset:
        result = system.track(frame.image, frame.stamp)
    system.finish()
    print(system.trajectory().positions)

Poses are 4x4 matrices, camera to world; the camera looks along z, x is right and y down. Stamps are seconds; lengths
have the unknown scale of a single camera.
"""

import importlib
from typing import TYPE_CHECKING, Any, List

if TYPE_CHECKING:
    from ._public import *  # noqa: F403
    from ._public import __all__ as __all__


def __getattr__(name: str) -> Any:
    """Called for names that are not loaded yet. OpenCV's libraries take a while to load, so they are loaded at first use."""
    here = globals()
    if name in ("__all__", "__version__") or not name.startswith("_"):
        public = importlib.import_module("._public", __name__)
        here["__all__"] = public.__all__
        here.update({offered: getattr(public, offered) for offered in public.__all__})
    if name not in here:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return here[name]


def __dir__() -> List[str]:
    return sorted({*globals(), *__getattr__("__all__")})
