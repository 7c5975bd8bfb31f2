// SPDX-License-Identifier: BSD-3-Clause
#include "cli/stream/av_stream.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "cli/input/ffmpeg_parts.hpp"
#include "cli/input/image_limit.hpp"
#include "cli/stream/stream_trouble.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {
namespace {

// Their packets are image files, and are decoded as those are.
bool is_image_codec(AVCodecID codec) {
  switch (codec) {
    case AV_CODEC_ID_MJPEG:
    case AV_CODEC_ID_PNG:
    case AV_CODEC_ID_BMP:
    case AV_CODEC_ID_WEBP:
    case AV_CODEC_ID_PPM:
    case AV_CODEC_ID_PGM:
      return true;
    default:
      return false;
  }
}

// Images one after the other: the times that FFmpeg gives them are made up.
bool makes_times_up(std::string_view format) {
  return format == "mjpeg" || format == "mpjpeg" || format.ends_with("pipe") || format.starts_with("image2");
}

// Whether packets are taken as the files that they are. A container's pictures are decoded as those of a
// video's file, so that they are the same to the bit.
bool comes_as_images(const AVFormatContext& format, const AVStream& stream) {
  const std::string_view name = format.iformat->name;
  return is_image_codec(stream.codecpar->codec_id) && (makes_times_up(name) || name == "rtsp");
}

}  // namespace

struct AvStream::Parts {
  Patience& patience;
  std::string name;  // for people
  BytePipe* pipe = nullptr;
  std::vector<std::uint8_t> first;  // of the pipe, read already
  AVIOContext* bytes = nullptr;
  ffmpeg::FormatHandle format;
  const AVStream* stream = nullptr;
  ffmpeg::CodecHandle codec;
  ffmpeg::PacketHandle packet{av_packet_alloc()};
  ffmpeg::FrameHandle frame{av_frame_alloc()};
  ffmpeg::BgrConverter to_bgr;
  bool drained = false;
  bool given = false;  // a packet
  int ended = 0;       // why there is no further one

  Parts(Patience& p, std::string n) : patience(p), name(std::move(n)) {}
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() {
    format.reset();
    if (bytes == nullptr) return;
    av_freep(&bytes->buffer);
    avio_context_free(&bytes);
  }

  void read_pipe();
  void open(const std::string& url, AVDictionary* options);
  void open_codec(const AVCodec* decoder);
  [[nodiscard]] bool next_packet();
  [[nodiscard]] std::optional<double> time_of(std::int64_t stamp) const;
};

void AvStream::Parts::read_pipe() {
  const auto more = [](void* parts, std::uint8_t* out, int size) {
    Parts& p = *static_cast<Parts*>(parts);
    std::size_t got = std::min(p.first.size(), static_cast<std::size_t>(size));
    if (got > 0) {
      std::memcpy(out, p.first.data(), got);
      p.first.erase(p.first.begin(), p.first.begin() + static_cast<std::ptrdiff_t>(got));
    } else {
      got = p.pipe->read(out, static_cast<std::size_t>(size));
    }
    return got == 0 ? AVERROR_EOF : static_cast<int>(got);
  };
  constexpr int kBuffer = 1 << 15;
  bytes = avio_alloc_context(static_cast<std::uint8_t*>(av_malloc(kBuffer)), kBuffer, 0, this, more, nullptr,
                             nullptr);
}

void AvStream::Parts::open(const std::string& url, AVDictionary* options) {
  ffmpeg::silence();
  AVFormatContext* opened = avformat_alloc_context();
  opened->interrupt_callback = {[](void* p) { return static_cast<Patience*>(p)->over() ? 1 : 0; }, &patience};
  opened->fps_probe_size = 0;  // nobody asks, and it would take the first second
  if (bytes != nullptr) {
    opened->pb = bytes;
    opened->flags |= AVFMT_FLAG_CUSTOM_IO;
  }
  if (bytes == nullptr && url.starts_with("file:"))
    throw Error(name + ": is a file on this machine; give its path without file://");
  std::string said;
  const ffmpeg::Listener listener(said);
  const auto fail = [&](int why) {
    throw Error(name + ": " + trouble_at_opening(why, bytes != nullptr ? "" : url, said, patience));
  };
  int code = avformat_open_input(&opened, bytes != nullptr ? nullptr : url.c_str(), nullptr, &options);
  av_dict_free(&options);
  format.reset(opened);
  if (code < 0) fail(code);
  const bool images = format->nb_streams == 1 && comes_as_images(*format, *format->streams[0]);
  if (!images && (code = avformat_find_stream_info(format.get(), nullptr)) < 0) fail(code);
  const AVCodec* decoder = nullptr;
  const int best = av_find_best_stream(format.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
  if (best == AVERROR_DECODER_NOT_FOUND)
    throw Error(name + ": there is no decoder for this video here; send H.264 or MJPEG");
  if (best < 0) throw Error(name + ": sends sound or data, but no pictures");
  stream = format->streams[best];
  for (unsigned i = 0; i < format->nb_streams; ++i)
    if (format->streams[i] != stream) format->streams[i]->discard = AVDISCARD_ALL;
  if (!comes_as_images(*format, *stream)) open_codec(decoder);
}

void AvStream::Parts::open_codec(const AVCodec* decoder) {
  codec.reset(avcodec_alloc_context3(decoder));
  if (!codec || avcodec_parameters_to_context(codec.get(), stream->codecpar) < 0)
    throw Error(name + ": there is no decoder for this video here");
  codec->thread_type = FF_THREAD_SLICE;  // threads by frames would come so many frames late
  codec->max_pixels = kMostPixels;
  codec->pkt_timebase = stream->time_base;
  if (avcodec_open2(codec.get(), decoder, nullptr) < 0)
    throw Error(name + ": the decoder refuses this video");
}

bool AvStream::Parts::next_packet() {
  while (!patience.over() && (ended = av_read_frame(format.get(), packet.get())) >= 0) {
    if (packet->stream_index == stream->index && packet->size > 0) {
      patience.heard();
      return given = true;
    }
    av_packet_unref(packet.get());
  }
  if (ended == AVERROR_EOF && format->pb != nullptr && format->pb->error < 0) ended = format->pb->error;
  if (!given && !patience.over() &&
      std::string_view(format->iformat->name).find("mp4") != std::string_view::npos)
    throw Error(name +
                ": this MP4 has its index after the pictures, so it cannot be streamed; write it with ffmpeg "
                "-movflags +faststart");
  return false;
}

std::optional<double> AvStream::Parts::time_of(std::int64_t stamp) const {
  if (stamp == AV_NOPTS_VALUE || makes_times_up(format->iformat->name)) return std::nullopt;
  return ffmpeg::container_seconds(stamp, *stream);
}

AvStream::AvStream(const StreamName& name, Patience& patience)
    : parts_(std::make_unique<Parts>(patience, shown_name(name))) {
  AVDictionary* options = nullptr;
  // A playlist must not lead to the files of this machine.
  av_dict_set(&options, "protocol_whitelist",
              "http,https,httpproxy,tcp,tls,udp,rtp,srtp,rtsp,rtsps,rtmp,rtmps,crypto,srt", 0);
  av_dict_set(&options, "rtsp_flags", "prefer_tcp", 0);
  (void)avformat_network_init();
  parts_->open(name.text, options);
}

AvStream::AvStream(const std::string& name, BytePipe& pipe, std::vector<std::uint8_t> first,
                   Patience& patience)
    : parts_(std::make_unique<Parts>(patience, name)) {
  parts_->pipe = &pipe;
  parts_->first = std::move(first);
  parts_->read_pipe();
  parts_->open({}, nullptr);
}

AvStream::~AvStream() = default;

StreamFlow AvStream::flow() const {
  if (parts_->pipe != nullptr) return StreamFlow::kWaits;
  // Multipart images may have a length, too, that some camera has made up.
  const AVFormatContext& format = *parts_->format;
  if (makes_times_up(format.iformat->name)) return StreamFlow::kRuns;
  const bool ends = format.duration > 0 || parts_->stream->duration > 0 || parts_->stream->nb_frames > 0 ||
                    (format.pb != nullptr && avio_size(format.pb) > 0);
  return ends ? StreamFlow::kFile : StreamFlow::kRuns;
}

std::string AvStream::trouble() const {
  // Of a video whose length nobody has said, the end looks like a broken connection.
  const AVIOContext* const io = parts_->format->pb;
  const bool open_end = flow() == StreamFlow::kFile && (io == nullptr || avio_size(parts_->format->pb) <= 0);
  return trouble_while_reading(open_end ? 0 : parts_->ended, parts_->patience.over());
}

bool AvStream::read(StreamFrame& out) {
  Parts& p = *parts_;
  out = {};
  if (!p.codec) {
    if (!p.next_packet()) return false;
    out.file.assign(p.packet->data, p.packet->data + p.packet->size);
    out.time = p.time_of(p.packet->pts);
    av_packet_unref(p.packet.get());
    return true;
  }
  for (;;) {
    const int got = avcodec_receive_frame(p.codec.get(), p.frame.get());
    if (got >= 0) {
      out.image = p.to_bgr(*p.frame);
      out.time = p.time_of(p.frame->best_effort_timestamp);
      return true;
    }
    if (got == AVERROR_EOF || p.drained || p.patience.over()) return false;
    if (p.next_packet()) {
      (void)avcodec_send_packet(p.codec.get(), p.packet.get());  // one that it refuses is passed over
      av_packet_unref(p.packet.get());
    } else {
      p.drained = avcodec_send_packet(p.codec.get(), nullptr) < 0;
    }
  }
}

}  // namespace sslam::cli
