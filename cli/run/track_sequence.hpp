// SPDX-License-Identifier: BSD-3-Clause
// The loop of a run: frames from the stream through the system.
#pragma once

#include <functional>

#include "cli/input/frame_stream.hpp"
#include "cli/run/run_recorder.hpp"
#include "sslam/system/system.hpp"

namespace sslam::cli {

// Tracks all frames of the stream, or those until Ctrl-C, and fills the recorder's outcome in. Keyframes
// below `known_keyframes` are of the map that the system goes on in. `passed` is called behind each frame,
// and once more when Ctrl-C has come.
void track_sequence(System& system, FrameStream& stream, RunRecorder& recorder, std::size_t known_keyframes,
                    const std::function<void()>& passed);

}  // namespace sslam::cli
