// SPDX-License-Identifier: BSD-3-Clause
// An engine made from any pipeline: one of sslam's, or your own.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "sslam/system/engine.hpp"
#include "sslam/system/wall_timer.hpp"
#include "sslam/track/parameters.hpp"

namespace sslam {

template <class Pipeline>
class PipelineEngine final : public Engine {
 public:
  [[nodiscard]] NormalNeed normal_need(const Frame<double>& frame) override {
    return pipeline_.normal_need(frame);
  }
  TrackResult<double> track(Frame<double>& frame) override { return pipeline_.track(frame); }
  bool finish() override { return pipeline_.finish(); }
  void resume(Map<double> map) override { pipeline_.resume(std::move(map)); }
  [[nodiscard]] std::vector<const World<double>*> worlds() const override { return pipeline_.worlds(); }
  [[nodiscard]] int last_number() const override { return pipeline_.last_number(); }
  void go_on(std::vector<World<double>> known, int begun_last) override {
    pipeline_.go_on(std::move(known), begun_last);
  }
  void localise_only(bool on) override { pipeline_.localise_only = on; }
  void keep_frames(bool on) override { pipeline_.keep_frames = on; }

  [[nodiscard]] const Map<double>& map() const override { return pipeline_.map(); }
  [[nodiscard]] const TrajectoryLog<double>& trajectory() const override { return pipeline_.trajectory(); }
  [[nodiscard]] const TrackedFrame<double>& last_frame() const override { return pipeline_.last_frame(); }
  [[nodiscard]] int world() const override { return pipeline_.world(); }

  [[nodiscard]] MapsApart apart() const override {
    MapsApart apart;
    for (const auto& world : pipeline_.atlas.worlds()) {
      ++apart.maps;
      apart.frames += world.log.entries().size();
    }
    return apart;
  }

  [[nodiscard]] int keyframes_not_made() const override {
    if constexpr (requires { pipeline_.upkeep.refused(); }) return pipeline_.upkeep.refused();
    return 0;
  }
  [[nodiscard]] double read_out() const override { return pipeline_.final_pass.read_out(); }

  [[nodiscard]] float tracking_ms() const override {
    if constexpr (requires { pipeline_.timer.total(); }) return pipeline_.timer.total();
    return 0;
  }
  [[nodiscard]] const std::array<float, kStageCount>& stage_ms() const override {
    if constexpr (requires { pipeline_.timer.milliseconds; }) return pipeline_.timer.milliseconds;
    static constexpr std::array<float, kStageCount> kUntimed{};
    return kUntimed;
  }

  void seed(std::uint64_t seed) override {
    if constexpr (requires { pipeline_.rotation.seed; }) pipeline_.rotation.seed = seed;
    if constexpr (requires { pipeline_.initialisation.seed; }) pipeline_.initialisation.seed = seed;
  }
  void create_points(bool on) override {
    if constexpr (requires { pipeline_.mapping.creation.options.use_points; })
      pipeline_.mapping.creation.options.use_points = on;
  }
  void collect(ParameterTable& table) const override { collect_parameters(pipeline_, table); }
  void write(const ParameterTable& table) override { write_parameters(table, pipeline_); }

 private:
  Pipeline pipeline_;
};

template <class Pipeline>
[[nodiscard]] std::unique_ptr<Engine> make_engine() {
  return std::make_unique<PipelineEngine<Pipeline>>();
}

}  // namespace sslam
