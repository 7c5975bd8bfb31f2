// SPDX-License-Identifier: BSD-3-Clause
#include "cli/input/video_reader.hpp"

extern "C" {
#include <libavutil/display.h>
}

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>

#include "cli/input/ffmpeg_parts.hpp"
#include "cli/input/image_limit.hpp"
#include "sslam/core/error.hpp"
#include "sslam/core/types.hpp"
#include "sslam/io/files/video_content.hpp"

namespace sslam::cli {

// Members of the reader: not in an unnamed namespace.
namespace ffmpeg {

// A container and the one stream in it that is looked at.
struct VideoContainer {
  FormatHandle format;
  AVStream* stream = nullptr;
  const AVCodec* decoder = nullptr;
};

}  // namespace ffmpeg

namespace {

ffmpeg::VideoContainer open_container(const std::filesystem::path& file) {
  if (io::starts_as_playlist(io::first_bytes(file)))
    throw Error(file.string() +
                ": is a list of videos, not one; `ffmpeg -i LIST -c copy OUT.mp4` makes one of them");
  ffmpeg::silence();
  ffmpeg::VideoContainer opened;
  AVFormatContext* format = nullptr;
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);  // a playlist must not lead into the network
  const int code = avformat_open_input(&format, ("file:" + file.string()).c_str(), nullptr, &options);
  av_dict_free(&options);
  opened.format.reset(format);
  if (code < 0 || avformat_find_stream_info(format, nullptr) < 0)
    throw Error(file.string() + ": cannot open this video; expected mp4, avi, mkv, webm or the like, whole");
  const int best = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, &opened.decoder, 0);
  if (best == AVERROR_DECODER_NOT_FOUND)
    throw Error(file.string() + ": there is no decoder for this video here; convert it to H.264");
  if (best < 0)
    throw Error(file.string() + ": cannot open this video: it holds sound or data, but no pictures");
  opened.stream = format->streams[best];
  for (unsigned i = 0; i < format->nb_streams; ++i)
    if (format->streams[i] != opened.stream) format->streams[i]->discard = AVDISCARD_ALL;
  return opened;
}

// The next packet with pictures; false at the end. VP8 hides pictures that only serve others.
bool next_packet(const ffmpeg::VideoContainer& container, AVPacket& packet) {
  while (av_read_frame(container.format.get(), &packet) >= 0) {
    if (packet.stream_index == container.stream->index && packet.size > 0) return true;
    av_packet_unref(&packet);
  }
  return false;
}

bool is_shown(const ffmpeg::VideoContainer& container, const AVPacket& packet) {
  constexpr std::uint8_t kShownVp8 = 0x10;
  if ((packet.flags & AV_PKT_FLAG_DISCARD) != 0) return false;
  return container.stream->codecpar->codec_id != AV_CODEC_ID_VP8 || (packet.data[0] & kShownVp8) != 0;
}

// The matrix takes stored pixels (x right, y down) to displayed ones; its signs say which of eight it is, as
// long as it turns by a right angle, to a degree.
void read_turn(const AVStream& stream, VideoInfo& info) {
  const auto* matrix = reinterpret_cast<const std::int32_t*>(
      av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
  if (matrix == nullptr) return;
  const double a = matrix[0], b = matrix[1], c = matrix[3], d = matrix[4];
  const double most = std::max({std::abs(a), std::abs(b), std::abs(c), std::abs(d)});
  if (!(most > 0)) return;
  const double little = 0.0175 * most;  // a degree
  const auto none = [little](double x, double y) { return std::abs(x) < little && std::abs(y) < little; };
  if (none(b, c)) {
    info.turn = a > 0 ? (d > 0 ? 1 : 4) : (d > 0 ? 2 : 3);
  } else if (none(a, d)) {
    info.turn = b > 0 ? (c > 0 ? 5 : 6) : (c > 0 ? 8 : 7);
  } else {
    info.odd_turn = degrees(std::atan2(b, a));
  }
}

}  // namespace

struct VideoReader::Parts {
  ffmpeg::VideoContainer container;
  ffmpeg::CodecHandle codec;
  ffmpeg::PacketHandle packet{av_packet_alloc()};
  ffmpeg::FrameHandle frame{av_frame_alloc()};
  ffmpeg::BgrConverter to_bgr;
  bool drained = false;
  VideoInfo info;
};

VideoReader::VideoReader(const std::filesystem::path& file) : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.container = open_container(file);
  AVStream& stream = *p.container.stream;
  p.codec.reset(avcodec_alloc_context3(p.container.decoder));
  if (!p.codec || avcodec_parameters_to_context(p.codec.get(), stream.codecpar) < 0)
    throw Error(file.string() + ": cannot open this video");
  constexpr int kMostThreads = 8;  // each keeps frames of its own
  p.codec->thread_count = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
  p.codec->max_pixels = kMostPixels;
  p.codec->pkt_timebase = stream.time_base;
  if (avcodec_open2(p.codec.get(), p.container.decoder, nullptr) < 0)
    throw Error(file.string() + ": cannot open this video: its decoder refuses it");
  p.info.size = {stream.codecpar->width, stream.codecpar->height};
  read_turn(stream, p.info);
  p.info.claimed = stream.nb_frames;
  const AVRational aspect = av_guess_sample_aspect_ratio(p.container.format.get(), &stream, nullptr);
  if (aspect.num > 0 && aspect.den > 0) p.info.pixel_aspect = av_q2d(aspect);
  const AVFieldOrder order = stream.codecpar->field_order;
  p.info.interlaced = order != AV_FIELD_UNKNOWN && order != AV_FIELD_PROGRESSIVE;
  const AVRational rate = av_guess_frame_rate(p.container.format.get(), &stream, nullptr);
  if (rate.num > 0 && rate.den > 0) p.info.frame_rate = av_q2d(rate);
}

VideoReader::~VideoReader() = default;

const VideoInfo& VideoReader::info() const noexcept {
  return parts_->info;
}

bool VideoReader::advance() {
  Parts& p = *parts_;
  for (;;) {
    const int got = avcodec_receive_frame(p.codec.get(), p.frame.get());
    if (got >= 0) return true;
    if (got == AVERROR_EOF || p.drained) return false;
    if (next_packet(p.container, *p.packet)) {
      (void)avcodec_send_packet(p.codec.get(), p.packet.get());  // one that it refuses is passed over
      av_packet_unref(p.packet.get());
    } else {
      p.drained = avcodec_send_packet(p.codec.get(), nullptr) < 0;
    }
  }
}

std::optional<double> VideoReader::time() const {
  const std::int64_t stamp = parts_->frame->best_effort_timestamp;
  if (stamp == AV_NOPTS_VALUE) return std::nullopt;
  return ffmpeg::container_seconds(stamp, *parts_->container.stream);
}

cv::Mat VideoReader::image() {
  return parts_->to_bgr(*parts_->frame);
}

VideoTimes read_video_times(const std::filesystem::path& file, std::int64_t at_most) {
  const ffmpeg::VideoContainer container = open_container(file);
  const AVStream& stream = *container.stream;
  constexpr std::int64_t kReordered =
      32;  // packets come in order of decoding: more than any codec puts aside
  const ffmpeg::PacketHandle packet(av_packet_alloc());
  VideoTimes found;
  bool timed = true;
  while (found.whole && next_packet(container, *packet)) {
    if (is_shown(container, *packet)) {
      ++found.frames;
      timed = timed && packet->pts != AV_NOPTS_VALUE;
      if (timed) found.times.push_back(ffmpeg::container_seconds(packet->pts, stream));
      found.whole = at_most < 0 || found.frames < at_most + kReordered;
    }
    av_packet_unref(packet.get());
  }
  if (!timed) found.times.clear();
  std::sort(found.times.begin(), found.times.end());
  if (at_most >= 0 && found.frames > at_most) {
    found.frames = at_most;
    found.whole = false;
    found.times.resize(std::min(found.times.size(), static_cast<std::size_t>(at_most)));
  }
  return found;
}

}  // namespace sslam::cli
