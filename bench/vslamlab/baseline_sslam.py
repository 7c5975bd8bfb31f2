# SPDX-License-Identifier: BSD-3-Clause
"""sslam as a baseline of VSLAM-LAB: for its folder Baselines/baseline_files."""
from Baselines.BaselineVSLAMLAB import BaselineVSLAMLAB


class SSLAM_baseline(BaselineVSLAMLAB):
    def __init__(self, baseline_name="sslam", baseline_folder="sslam"):
        super().__init__(baseline_name, baseline_folder, {"verbose": 1, "mode": "mono", "sslam_options": ""})
        self.color = "teal"
        self.modes = ["mono"]
        self.cam_models = ["pinhole", "radtan4", "radtan5"]
        self.command_style = "python"

    def program(self):
        return self.baseline_path / "build" / "cli" / "sslam"

    def is_installed(self):
        return (True, "is installed") if self.program().is_file() else (False, "not installed (auto install available)")
