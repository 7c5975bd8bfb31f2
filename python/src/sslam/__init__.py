"""Low-drift monocular SLAM for indoor places with little texture.

    import sslam

    dataset = sslam.open_dataset("room")
    system = sslam.System(dataset.camera)
    for frame in dataset:
        result = system.track(frame.image, frame.stamp)
    system.finish()
    print(system.trajectory().positions)

Poses are 4x4 matrices, camera to world; the camera looks along z, x is right and y down. Stamps are seconds, lengths
metres up to the scale that one camera leaves open.
"""

from ._data import Dataset, evaluate, open_dataset, read_trajectory, write_trajectory
from ._errors import Error, FinishedError, SettingsError, SslamWarning
from ._kernels import (
    bundle_adjust,
    manhattan_rotation,
    refine_pose,
    relative_pose,
    translation_from_rotation,
    triangulate_lines,
    triangulate_points,
)
from ._map import Map, load_map
from ._sslam import Camera, Evaluation, Reason, RelativeError, Result, State, Statistics, Status, __version__
from ._system import EVENTS, System, parameters, presets
from ._types import (
    BundleAdjustment,
    Frame,
    Latest,
    Lines,
    ManhattanRotation,
    Parameter,
    Planes,
    Points,
    Preset,
    RefinedPose,
    RelativePose,
    Trajectory,
    Translation,
    TriangulatedLines,
)

__all__ = [
    "EVENTS",
    "BundleAdjustment",
    "Camera",
    "Dataset",
    "Error",
    "Evaluation",
    "FinishedError",
    "Frame",
    "Latest",
    "Lines",
    "ManhattanRotation",
    "Map",
    "Parameter",
    "Planes",
    "Points",
    "Preset",
    "Reason",
    "RefinedPose",
    "RelativeError",
    "RelativePose",
    "Result",
    "SettingsError",
    "SslamWarning",
    "State",
    "Statistics",
    "Status",
    "System",
    "Trajectory",
    "Translation",
    "TriangulatedLines",
    "__version__",
    "bundle_adjust",
    "evaluate",
    "load_map",
    "manhattan_rotation",
    "open_dataset",
    "parameters",
    "presets",
    "read_trajectory",
    "refine_pose",
    "relative_pose",
    "translation_from_rotation",
    "triangulate_lines",
    "triangulate_points",
    "write_trajectory",
]
