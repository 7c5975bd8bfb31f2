// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/shell/messages.hpp"

namespace sslam::cli {
namespace {

using Json = nlohmann::ordered_json;

// Of what comes without end, nobody knows it.
Json total_json(std::size_t total) {
  return total > 0 ? Json(total) : Json(nullptr);
}

std::string counts(const TrackResult<double>& result) {
  return std::to_string(result.point_inliers) + " points, " + std::to_string(result.line_inliers) + " lines";
}

// Cut to what the terminal shows in one line, since a wrapped line cannot be written over; to 80 columns
// elsewhere.
std::string fitting(std::string line) {
  winsize size{};
  std::size_t columns = 80;
  if (ioctl(fileno(message_stream()), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) columns = size.ws_col;
  std::size_t end = std::min<std::size_t>(line.size(), columns - 1);
  while (end > 0 && end < line.size() && (static_cast<unsigned char>(line[end]) & 0xC0U) == 0x80U) --end;
  line.resize(end);
  return line;
}

// "1:02:03", "2:03"
std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::min(seconds, 1e9) + 0.5);
  char text[40];
  if (whole >= 3600)
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
  return text;
}

}  // namespace

Progress::Progress(std::size_t total, Verbosity verbosity, std::string task)
    : total_(total),
      verbosity_(verbosity),
      task_(std::move(task)),
      terminal_(isatty(fileno(message_stream())) != 0) {
  if (verbosity_ == Verbosity::kJson)
    print_json({{"event", "start"}, {"task", task_}, {"total", total_json(total_)}});
}

double Progress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Progress::show(const FrameReport& frame) {
  const std::lock_guard lock(mutex_);
  ++done_;
  const TrackResult<double>& r = frame;
  if (verbosity_ == Verbosity::kJson)
    return print_json({{"event", "frame"},
                       {"task", task_},
                       {"done", done_},
                       {"total", total_json(total_)},
                       {"index", r.index},
                       {"stamp", r.stamp},
                       {"state", name(r.state)},
                       {"reason", name(r.reason)},
                       {"point_inliers", r.point_inliers},
                       {"line_inliers", r.line_inliers},
                       {"keyframe", r.keyframe},
                       {"frame_ms", frame.frame_ms()}});
  if (verbosity_ == Verbosity::kVerbose) tell_event(frame);
  std::string detail = name(r.state);
  if (r.has_pose())
    detail += ", " + counts(r);
  else if (r.reason != Reason::kFine)
    detail += std::string(", ") + name(r.reason);
  renew_line(detail);
}

void Progress::show(const std::string& detail) {
  const std::lock_guard lock(mutex_);
  ++done_;
  if (verbosity_ == Verbosity::kJson)
    return print_json({{"event", "progress"},
                       {"task", task_},
                       {"done", done_},
                       {"total", total_json(total_)},
                       {"detail", detail}});
  renew_line(detail);
}

void Progress::tell_event(const FrameReport& frame) {
  const TrackResult<double>& r = frame;
  const bool changed = last_state_ != r.state;
  std::string text = "frame " + std::to_string(r.index) + ": ";
  if (changed && last_state_) text += std::string(name(*last_state_)) + " -> ";
  last_state_ = r.state;
  if (!changed && !r.keyframe) return;
  text += name(r.state);
  if (r.keyframe) text += ", keyframe";
  if (r.reason != Reason::kFine) text += std::string(", ") + name(r.reason);
  if (r.has_pose()) text += " (" + counts(r) + ")";
  clear_line();
  std::fprintf(message_stream(), "%s\n", text.c_str());
}

void Progress::renew_line(const std::string& detail) {
  if (verbosity_ == Verbosity::kQuiet) return;
  const auto now = Clock::now();
  const auto interval = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000);
  if (now - shown_ < interval && done_ != total_) return;
  shown_ = now;
  print_line(detail);
}

void Progress::print_line(const std::string& detail) {
  const double elapsed = seconds();
  const double rate = elapsed > 0 ? static_cast<double>(done_ - begun_) / elapsed : 0;
  std::string line = task_ + ' ' + std::to_string(done_);
  if (total_ > 0) {
    constexpr std::size_t kWidth = 12;
    const std::size_t filled = std::min(kWidth, done_ * kWidth / total_);
    line += '/' + std::to_string(total_) + " [" + std::string(filled, '#') +
            std::string(kWidth - filled, '.') + ']';
  }
  char text[40];
  std::snprintf(text, sizeof text, " %.1f/s", rate);
  line += text;
  if (total_ > done_ && rate > 0)
    line += ", " + clock_text(static_cast<double>(total_ - done_) / rate) + " left";
  line = fitting(line + "  " + detail);
  if (terminal_)
    std::fprintf(message_stream(), "\r%s\033[K", line.c_str());
  else
    std::fprintf(message_stream(), "%s\n", line.c_str());
  std::fflush(message_stream());
  open_line_ = terminal_;
}

void Progress::clear_line() {
  if (open_line_) std::fputs("\r\033[K", message_stream());
  open_line_ = false;
}

void Progress::tell_now_and_then(const std::function<Json()>& health) {
  constexpr std::chrono::seconds kInterval{10};
  if (verbosity_ != Verbosity::kJson || Clock::now() - told_ < kInterval) return;
  told_ = Clock::now();
  tell(health());
}

void Progress::tell(const Json& health) {
  if (verbosity_ != Verbosity::kJson) return;
  Json event = {{"event", "health"}, {"task", task_}};
  event.update(health);
  print_json(event);
}

void Progress::finish() {
  const std::lock_guard lock(mutex_);
  if (verbosity_ == Verbosity::kJson)
    print_json({{"event", "end"},
                {"task", task_},
                {"done", done_},
                {"total", total_json(total_)},
                {"seconds", seconds()}});
  if (open_line_) std::fputc('\n', message_stream());
  open_line_ = false;
}

}  // namespace sslam::cli
