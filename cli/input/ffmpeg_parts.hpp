// SPDX-License-Identifier: BSD-3-Clause
// What readers of videos and of streams share of FFmpeg's libraries. For their sources, not for headers.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace sslam::cli::ffmpeg {

template <auto kFree>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    kFree(&object);
  }
};
using FormatHandle = std::unique_ptr<AVFormatContext, Freed<avformat_close_input>>;
using CodecHandle = std::unique_ptr<AVCodecContext, Freed<avcodec_free_context>>;
using PacketHandle = std::unique_ptr<AVPacket, Freed<av_packet_free>>;
using FrameHandle = std::unique_ptr<AVFrame, Freed<av_frame_free>>;

// Where to keep what the libraries say of errors on this thread; null: nowhere.
inline thread_local std::string* heard = nullptr;

// Decoders talk of every flaw that they meet. OpenCV's writer sets FFmpeg's level of talk, but no callback.
inline void silence() {
  av_log_set_callback([](void*, int level, const char* format, va_list words) {
    constexpr std::size_t kEnough = 4096;
    if (heard == nullptr || level > AV_LOG_ERROR || heard->size() > kEnough) return;
    char line[512];
    std::vsnprintf(line, sizeof line, format, words);
    *heard += line;
  });
}

// Keeps it in `said` as long as this lives.
class Listener {
 public:
  explicit Listener(std::string& said) { heard = &said; }
  ~Listener() { heard = nullptr; }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
};

inline double container_seconds(std::int64_t stamp, const AVStream& stream) {
  return static_cast<double>(stamp) * av_q2d(stream.time_base);
}

// Frames as OpenCV has them.
class BgrConverter {
 public:
  BgrConverter() = default;
  BgrConverter(const BgrConverter&) = delete;
  BgrConverter& operator=(const BgrConverter&) = delete;
  ~BgrConverter() { sws_freeContext(scaler_); }

  // 8 bit; empty: the pixels cannot be converted.
  [[nodiscard]] cv::Mat operator()(const AVFrame& frame) {
    scaler_ = sws_getCachedContext(scaler_, frame.width, frame.height,
                                   static_cast<AVPixelFormat>(frame.format), frame.width, frame.height,
                                   AV_PIX_FMT_BGR24, SWS_BICUBIC, nullptr, nullptr, nullptr);
    if (scaler_ == nullptr) return {};
    // swscale writes whole blocks: rows with room behind them, cut off afterwards.
    constexpr int kBlock = 64;
    cv::Mat image(frame.height, (frame.width + kBlock - 1) / kBlock * kBlock, CV_8UC3);
    std::uint8_t* const rows[] = {image.data};
    const int strides[] = {static_cast<int>(image.step)};
    sws_scale(scaler_, frame.data, frame.linesize, 0, frame.height, rows, strides);
    return image.colRange(0, frame.width).clone();
  }

 private:
  SwsContext* scaler_ = nullptr;
};

}  // namespace sslam::cli::ffmpeg
