// SPDX-License-Identifier: BSD-3-Clause
#include "cli/dense/missing_pictures.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "cli/input/frame_reader.hpp"
#include "cli/input/masked_image.hpp"
#include "sslam/opencv/camera/working_size.hpp"

namespace sslam::cli {

void read_missing_pictures(const Map<double>& map, std::size_t first, const PictureSource& source,
                           KeyframePictures& pictures) {
  std::map<std::pair<std::int64_t, double>, const Frame<double>*> missing;
  for (std::size_t k = first; k < map.keyframes.size(); ++k)
    if (const auto& keyframe = map.keyframes[k]; keyframe.alive() && pictures.of(keyframe.frame) == nullptr)
      missing[{keyframe.frame.index, keyframe.frame.stamp}] = &keyframe.frame;
  if (missing.empty()) return;
  FrameReader reader(source.dataset, {source.given.width, source.given.height});
  for (const io::FrameEntry& entry : source.dataset.frames) {
    const auto found = missing.find({entry.index, entry.stamp});
    if (found == missing.end()) continue;
    ImageInput input;
    std::string why;  // was told when the frame was tracked
    input.name = reader.stem(entry);
    input.image = reader.read(entry, why);
    if (input.image.empty()) continue;
    mask_and_straighten(source.masks, source.view, input, why);
    if (input.image.cols != source.working.width || input.image.rows != source.working.height)
      input = shrunk_input(input, source.working);
    pictures.note(*found->second, input.image, input.mask);
    missing.erase(found);
    if (missing.empty()) return;
  }
}

}  // namespace sslam::cli
