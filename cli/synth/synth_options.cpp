// SPDX-License-Identifier: BSD-3-Clause
#include "cli/synth/synth_options.hpp"

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "cli/shell/choice_option.hpp"
#include "cli/shell/number_checks.hpp"
#include "cli/shell/progress_options.hpp"
#include "cli/synth/camera_look.hpp"
#include "cli/synth/synth_names.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

bool parse_size(const std::string& text, int& width, int& height) {
  int end = 0;
  return std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &end) == 2 &&
         end == static_cast<int>(text.size()) && width >= 32 && height >= 32 && width <= 8192 &&
         height <= 8192;
}

// A number between two bounds; CLI::Range lets nan through.
CLI::Validator between(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) {
        const std::optional<double> value = io::parse_number<double>(text);
        if (value && *value >= low && *value <= high) return std::string();
        char reason[128];
        std::snprintf(reason, sizeof reason, "expected a number between %g and %g, found ", low, high);
        return reason + ("'" + text + "'");
      },
      "");
}

void add_scene_options(CLI::App& synth, SynthSettings& s) {
  synth.add_option("--seed", s.house.seed, "seed of layout, materials, light, path and noise; default 1")
      ->check(number_from_zero());
  add_choice(synth, "--texture", s.house.richness, kRichnessNames,
             "rich, mixed or poor (plain paint); default rich");
  add_choice(
      synth, "--world", s.house.world, kWorldNames,
      "manhattan, turned (furniture at other headings), oblique (one such wall) or free (no right angle "
      "between walls); the last two for a single room; default manhattan");
  synth.add_option("--rooms", s.house.rooms, "1 to 50, several of them along corridors; default 1")
      ->check(CLI::Range(1, synth::kMostRooms).description(""));
  synth
      .add_option(
          "--off-square", s.house.off_square,
          "standard deviation in degrees by which each wall and piece of furniture is off square; for "
          "a single manhattan room; default 0")
      ->check(between(0.0, synth::kMostOffSquare));
  synth.add_flag("--doors-ajar", s.house.doors_ajar,
                 "doors stand open by 5 to 70 degrees; for one room or three");
  synth
      .add_option("--clutter", s.house.clutter,
                  "number of small objects on the floor along walls and on tables, 0 to 200; for one room or "
                  "three; default 0")
      ->check(CLI::Range(0, synth::kMostClutter).description(""));
  add_choice(synth, "--path", s.house.path, kPathNames,
             "loop, sweep (to and fro before a wall) or pivot (turns on the spot, then loops); several rooms "
             "are always toured; default loop");
  synth.add_option("--speed", s.house.motion.speed, "metres per second; default 0.5")
      ->check(between(0.01, 5.0));
  synth.add_option("--tremor", s.house.motion.tremor, "motion of the hand; 0: none, default 1")
      ->check(between(0.0, 10.0));
  synth
      .add_option("--shake", s.house.motion.shake,
                  "motion of the hand, faster and smaller than the tremor; 0: none, default 0")
      ->check(between(0.0, 10.0));
  synth.add_option("--stand", s.house.motion.stand, "seconds of standing before the first step; default 0")
      ->check(between(0.0, 600.0));
}

void add_image_options(CLI::App& synth, SynthSettings& s) {
  synth.add_option("--frames", s.frames, "number of frames; default one lap of the path")
      ->check(CLI::Range(1, 1000000).description(""));
  synth.add_option("--fps", s.rate, "frames per second; default 30")->check(between(0.1, 1000.0));
  synth
      .add_option_function<std::string>(
          "--size", [&s](const std::string& text) { (void)parse_size(text, s.width, s.height); },
          "WIDTHxHEIGHT in pixels; default 640x480")
      ->check([](const std::string& text) {
        int width = 0, height = 0;
        return parse_size(text, width, height)
                   ? std::string()
                   : "'" + text + "' is not a size such as 640x480 (32 to 8192 pixels)";
      });
  synth.add_option("--focal", s.focal, "focal length in pixels; default three quarters of the width")
      ->check(between(10.0, 1e5));
  synth.add_option("--noise", s.sensor.noise, "standard deviation in grey levels; default 1.5")
      ->check(between(0.0, 100.0));
  synth.add_option("--vignetting", s.sensor.vignetting, "darkening of the corners as a share; default 0.12")
      ->check(between(0.0, 1.0));
  synth.add_option("--blur", s.blur, "share of the frame time that the shutter is open; default 0")
      ->check(between(0.0, 1.0));
  synth
      .add_option("--exposure", s.sensor.exposure_swing,
                  "largest change of brightness, as a share; default 0")
      ->check(between(0.0, 0.9));
  synth
      .add_option("--exposure-drift", s.sensor.exposure_drift,
                  "slow change of brightness, as a share; default 0")
      ->check(between(0.0, 0.9));
  synth
      .add_option("--white-balance-drift", s.sensor.white_balance_drift,
                  "slow change of red against blue, as a share; default 0")
      ->check(between(0.0, 0.9));
}

// What a camera that can be bought has and a pinhole has not.
void add_lens_options(CLI::App& synth, SynthSettings& s) {
  synth
      .add_option("--read-out", s.read_out,
                  "seconds from the first row to the last: a rolling shutter; default 0, all at once")
      ->check(between(0.0, 1.0));
  synth
      .add_option_function<std::string>(
          "--lens", [&s](const std::string& text) { (void)parse_lens(text, s.lens); },
          "distortion k1,k2 or k1,k2,p1,p2; default none")
      ->type_name("K1,K2")
      ->check([](const std::string& text) {
        RadTan<double> lens;
        return parse_lens(text, lens);
      });
  synth
      .add_option_function<std::string>(
          "--camera-error", [&s](const std::string& text) { (void)parse_camera_error(text, s.camera_error); },
          "error of camera.yaml, such as focal=0.05,k1=0.1: focal as a share, cx and cy in pixels, k1, k2, "
          "p1, p2; default nothing")
      ->type_name("NAME=VALUE,...")
      ->check([](const std::string& text) {
        CameraError error;
        return parse_camera_error(text, error);
      });
  add_choice(
      synth, "--image-fixed", s.image_fixed, kImageFixedNames,
      "what is fixed to the image: text (burnt in), bar (a part of the vehicle along the lower edge), dots "
      "(of an infrared projector) or none; default none");
}

void add_file_options(CLI::App& synth, SynthSettings& s) {
  synth.add_option("--image-format", s.image_format, "jpg or png; default jpg")
      ->check(CLI::IsMember({"jpg", "png"}));
  synth
      .add_option_function<int>(
          "--jpeg-quality",
          [&s](int quality) {
            if (s.image_format != "jpg")
              throw CLI::ValidationError("--jpeg-quality", "needs --image-format jpg");
            s.jpeg_quality = quality;
          },
          "1 to 100; default 95")
      ->check(CLI::Range(1, 100).description(""));
  synth.add_flag_callback(
      "--no-depth", [&s] { s.depth = false; }, "leave the depth images out");
  synth.add_flag_callback(
      "--no-normals", [&s] { s.normals = false; }, "leave the normal images out");
  synth.add_option("--threads", s.threads, "default one for each processor; the result is the same")
      ->check(CLI::Range(1, 1024).description(""));
}

}  // namespace

void add_synth_options(CLI::App& synth, SynthSettings& s) {
  // First of all: options are read in the order in which they were added, so that the others override it.
  add_choice_function(
      synth, "--camera-like", [&s](const CameraLook& look) { apply_look(look, s); }, kCameraLooks,
      "sets size, rate, focal length, lens, read-out, blur, noise, drifts, format and the hand's tremor and "
      "shake as such a camera has them; each can be overridden");
  add_scene_options(synth, s);
  add_image_options(synth, s);
  add_lens_options(synth, s);
  add_file_options(synth, s);
  add_progress_options(synth, s.verbosity, false);
}

}  // namespace sslam::cli
