// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/map_colours.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "sslam/io/files/output_file.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

constexpr std::string_view kColourMagic = "SSLAMCO1";
constexpr int kSamplesOfLine = 9;

// The mean of the pixel and its eight neighbours; empty outside of the picture.
LandmarkColour sample(const cv::Mat& picture, const Vec2<double>& pixel) {
  if (!pixel.allFinite() || pixel.cwiseAbs().maxCoeff() > 1e6) return std::nullopt;
  const cv::Point at(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  const cv::Rect patch = cv::Rect(at.x - 1, at.y - 1, 3, 3) & cv::Rect({}, picture.size());
  if (patch.empty()) return std::nullopt;
  const cv::Scalar mean = cv::mean(picture(patch));
  const auto byte = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  if (picture.channels() < 3) return io::Colour{byte(mean[0]), byte(mean[0]), byte(mean[0])};
  return io::Colour{byte(mean[2]), byte(mean[1]), byte(mean[0])};
}

LandmarkColour median_colour(std::vector<io::Colour>& seen) {
  if (seen.empty()) return std::nullopt;
  io::Colour middle{};
  std::vector<std::uint8_t> values(seen.size());
  for (std::size_t channel = 0; channel < middle.size(); ++channel) {
    for (std::size_t i = 0; i < seen.size(); ++i) values[i] = seen[i][channel];
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), at, values.end());
    middle[channel] = *at;
  }
  return middle;
}

void put(io::ByteWriter& out, const std::vector<LandmarkColour>& colours) {
  out(static_cast<std::uint32_t>(colours.size()));
  for (const LandmarkColour& colour : colours) {
    out(static_cast<std::uint8_t>(colour.has_value()));
    for (const std::uint8_t channel : colour.value_or(io::Colour{})) out(channel);
  }
}

std::vector<LandmarkColour> take_list(io::ByteReader& in) {
  std::uint32_t count = 0;
  in(count);
  if (count > in.left().size()) throw Error("ends too early");
  std::vector<LandmarkColour> colours(count);
  for (LandmarkColour& colour : colours) {
    std::uint8_t known = 0;
    io::Colour rgb{};
    in(known, {"whether a colour is known", 0, 1});
    for (std::uint8_t& channel : rgb) in(channel);
    if (known != 0) colour = rgb;
  }
  return colours;
}

std::vector<LandmarkColour> take(io::ByteReader& in, std::size_t wanted) {
  std::vector<LandmarkColour> colours = take_list(in);
  if (colours.size() != wanted) throw Error("belongs to another map");
  return colours;
}

}  // namespace

bool MapColours::any() const {
  const auto known = [](const LandmarkColour& colour) { return colour.has_value(); };
  return std::any_of(points.begin(), points.end(), known) || std::any_of(lines.begin(), lines.end(), known);
}

void FeatureColours::note(const Frame<double>& frame, const cv::Mat& picture, const Camera<double>& camera) {
  if (picture.empty() || picture.depth() != CV_8U) return;
  Features seen;
  for (const auto& point : frame.points)
    seen.points.push_back(sample(picture, camera.distort_pixel(point.pixel)));
  for (const auto& line : frame.lines) {
    std::vector<io::Colour> along;
    for (int i = 0; i < kSamplesOfLine; ++i) {
      const double share = (i + 0.5) / kSamplesOfLine;
      const Vec2<double> at = (1 - share) * line.segment.start + share * line.segment.end;
      if (const auto colour = sample(picture, camera.distort_pixel(at))) along.push_back(*colour);
    }
    seen.lines.push_back(median_colour(along));
  }
  frames_[{frame.index, frame.stamp}] = std::move(seen);
}

void FeatureColours::note(const Map<double>& map, const MapColours& colours) {
  const auto copy = [](const MapList<LandmarkId>& landmarks, const std::vector<LandmarkColour>& known) {
    std::vector<LandmarkColour> features;
    for (const LandmarkId id : landmarks)
      features.push_back(id == kNone ? std::nullopt : colour_at(known, Map<double>::index(id)));
    return features;
  };
  for (const auto& keyframe : map.keyframes)
    if (keyframe.alive())
      frames_[{keyframe.frame.index, keyframe.frame.stamp}] = {copy(keyframe.point_landmarks, colours.points),
                                                               copy(keyframe.line_landmarks, colours.lines)};
}

void FeatureColours::put(io::ByteWriter& out) const {
  out(static_cast<std::uint64_t>(frames_.size()));
  for (const auto& [key, features] : frames_) {
    out(key.first);
    out(key.second);
    cli::put(out, features.points);
    cli::put(out, features.lines);
  }
}

void FeatureColours::take(io::ByteReader& in) {
  std::uint64_t frames = 0;
  in(frames, {"the count of frames with colours", 0, in.left().size()});
  for (std::uint64_t i = 0; i < frames; ++i) {
    Key key;
    in(key.first);
    in(key.second, {"a stamp", -1e15, 1e15});
    Features& features = frames_[key];
    features.points = take_list(in);
    features.lines = take_list(in);
  }
}

MapColours FeatureColours::of(const Map<double>& map) const {
  std::vector<const Features*> features;  // by keyframe; null: none are known
  for (const auto& keyframe : map.keyframes) {
    const auto found = frames_.find({keyframe.frame.index, keyframe.frame.stamp});
    const bool fits = keyframe.alive() && found != frames_.end() &&
                      found->second.points.size() == keyframe.frame.points.size() &&
                      found->second.lines.size() == keyframe.frame.lines.size();
    features.push_back(fits ? &found->second : nullptr);
  }
  std::vector<io::Colour> seen;
  const auto medians = [&](const auto& landmarks, std::vector<LandmarkColour> Features::*of_frame) {
    std::vector<LandmarkColour> colours;
    for (const auto& landmark : landmarks) {
      seen.clear();
      for (const Observation& o : landmark.observations)
        if (const Features* const from = features[Map<double>::index(o.keyframe)])
          if (const auto& colour = (from->*of_frame)[Map<double>::index(o.feature)]) seen.push_back(*colour);
      colours.push_back(landmark.alive ? median_colour(seen) : std::nullopt);
    }
    return colours;
  };
  return {medians(map.points, &Features::points), medians(map.lines, &Features::lines)};
}

void write_colours(const std::filesystem::path& path, const MapColours& colours) {
  io::ByteWriter out;
  put(out, colours.points);
  put(out, colours.lines);
  io::OutputFile file(path);
  file.stream() << kColourMagic << out.bytes;
  file.commit();
}

MapColours read_colours(const std::filesystem::path& path, const Map<double>& map) {
  const std::string text = io::read_text(path);
  if (!text.starts_with(kColourMagic)) throw Error(path.string() + ": holds no colours of a map");
  try {
    io::ByteReader in{std::string_view(text).substr(kColourMagic.size())};
    MapColours colours;
    colours.points = take(in, map.points.size());
    colours.lines = take(in, map.lines.size());
    if (!in.left().empty()) throw Error("is longer than its map asks for");
    return colours;
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  }
}

}  // namespace sslam::cli
