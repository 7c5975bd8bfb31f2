"""All public names of `import sslam`."""

from ._callbacks import EVENTS
from ._data import Dataset, evaluate, open_dataset, read_trajectory, write_trajectory
from ._errors import Error, FinishedError, SettingsError, SslamWarning
from ._image_kernels import NormalNetwork, line_segments
from ._kernels import manhattan_rotation, refine_pose, relative_pose, translation_from_rotation
from ._map import Map, load_map
from ._map_kernels import bundle_adjust, triangulate_lines, triangulate_points
from ._settings import parameters, presets
from ._sslam import (
    Camera,
    Evaluation,
    NormalStatus,
    Reason,
    RelativeError,
    Result,
    State,
    Statistics,
    Status,
    __version__,
)
from ._system import System
from ._types import (
    BundleAdjustment,
    Cloud,
    Frame,
    ImageNormals,
    Latest,
    Lines,
    LineSegments,
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
from ._viewers import Open3dScene, to_open3d, to_rerun
from ._wide_lens import WideLens

__all__ = [
    "EVENTS",
    "BundleAdjustment",
    "Camera",
    "Cloud",
    "Dataset",
    "Error",
    "Evaluation",
    "FinishedError",
    "Frame",
    "ImageNormals",
    "Latest",
    "LineSegments",
    "Lines",
    "ManhattanRotation",
    "Map",
    "NormalNetwork",
    "NormalStatus",
    "Open3dScene",
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
    "WideLens",
    "__version__",
    "bundle_adjust",
    "evaluate",
    "line_segments",
    "load_map",
    "manhattan_rotation",
    "open_dataset",
    "parameters",
    "presets",
    "read_trajectory",
    "refine_pose",
    "relative_pose",
    "to_open3d",
    "to_rerun",
    "translation_from_rotation",
    "triangulate_lines",
    "triangulate_points",
    "write_trajectory",
]
