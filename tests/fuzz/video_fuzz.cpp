// SPDX-License-Identifier: BSD-3-Clause
// Videos: their containers, the times of their frames, and a few decoded images. The search begins at small
// whole videos.
#include <opencv2/videoio.hpp>

#include "cli/input/video_reader.hpp"
#include "fuzz/made_folder.hpp"
#include "fuzz/seeds.hpp"
#include "sslam/io/files/video_content.hpp"
#include "support/scratch_folder.hpp"

namespace video_fuzz {

using namespace sslam;

inline std::string small_video(const std::filesystem::path& file, const char* codec) {
  constexpr int kFrames = 3;
  cv::VideoWriter writer(file.string(), cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]), 10,
                         {32, 16});
  for (int i = 0; i < kFrames; ++i) {
    cv::Mat image(16, 32, CV_8UC3, cv::Scalar(40 * i, 90, 200));
    image.colRange(8 * i, 8 * i + 8) = cv::Scalar(255, 255, 255);
    writer.write(image);
  }
  writer.release();
  return testing::text_of(file);
}

inline const std::vector<std::string>& seeds() {
  static const std::vector<std::string> kSeeds = [] {
    const testing::ScratchFolder scratch;
    std::vector<std::string> made{"YUV4MPEG2 W4 H2 F10:1 C420\nFRAME\nabcdefghijklFRAME\nabcdefghijkl",
                                  "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\na.ts\n",
                                  "ffconcat version 1.0\nfile a.mp4\n"};
    for (const auto& [name, codec] :
         {std::pair{"a.avi", "MJPG"}, {"a.mp4", "mp4v"}, {"a.mkv", "mp4v"}, {"b.avi", "XVID"}})
      if (std::string video = small_video(scratch.path() / name, codec); !video.empty())
        made.push_back(std::move(video));
    return made;
  }();
  return kSeeds;
}

}  // namespace video_fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return sslam::fuzzing::mutate_or_begin(video_fuzz::seeds(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace video_fuzz;
  constexpr int kFrames = 4, kLargest = 512;
  return fuzzing::read_as_file(data, size, [&](const std::filesystem::path& path) {
    (void)io::is_video_file(path);
    const cli::VideoTimes times = cli::read_video_times(path, kFrames);
    if (times.frames > kFrames || times.times.size() > kFrames) std::abort();
    if (!std::is_sorted(times.times.begin(), times.times.end())) std::abort();
    cli::VideoReader reader(path);
    if (reader.info().turn < 1 || reader.info().turn > 8) std::abort();
    const cv::Size claimed = reader.info().size;
    if (claimed.width > kLargest || claimed.height > kLargest) return;  // takes long, and is right
    for (int i = 0; i < kFrames && reader.advance(); ++i) (void)reader.image();
  });
}
