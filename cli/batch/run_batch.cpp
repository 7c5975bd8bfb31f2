// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/run_batch.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <deque>
#include <thread>
#include <vector>

#include "cli/batch/child.hpp"
#include "cli/batch/cores.hpp"
#include "cli/batch/run_mark.hpp"
#include "cli/shell/interrupt.hpp"
#include "cli/shell/messages.hpp"
#include "sslam/core/error.hpp"

namespace sslam::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct ActiveRun {
  const PlannedRun* run;
  std::optional<CoreClaim> core;
  Child child;
  Clock::time_point start;
};

class Batch {
 public:
  Batch(const Plan& plan, const BatchSettings& settings) : settings_(settings) {
    for (std::size_t i = 0; i < plan.runs.size(); ++i)
      if (settings.shard.holds(i)) sort_in(plan.runs[i]);
    total_ = waiting_.size();
    if (rebuilt_ > 0)
      print_note(std::to_string(rebuilt_) + " runs were made by another build of sslam and are repeated");
    jobs_ = static_cast<std::size_t>(settings.jobs > 0 ? settings.jobs
                                                       : static_cast<int>(allowed_cores().size()));
  }

  [[nodiscard]] BatchOutcome run() {
    const Interrupt interrupt;
    while (!waiting_.empty() || !active_.empty()) {
      if (Interrupt::asked()) {
        stop_all();
        break;
      }
      while (!waiting_.empty() && active_.size() < jobs_) start_next();
      std::this_thread::sleep_for(kPause);
      collect();
    }
    outcome_.interrupted = Interrupt::asked();
    return outcome_;
  }

 private:
  static constexpr auto kPause = std::chrono::milliseconds(10);

  [[nodiscard]] fs::path folder_of(const PlannedRun& run) const { return settings_.folder / run.folder; }

  void sort_in(const PlannedRun& run) {
    const auto mark = read_mark(folder_of(run));
    const bool same = mark && mark->end != RunEnd::kBroken && mark->arguments == run.arguments;
    if (same && mark->program == program_fingerprint()) {
      ++outcome_.kept;
      return;
    }
    if (same) ++rebuilt_;
    waiting_.push_back(&run);
  }

  void start_next() {
    const PlannedRun& run = *waiting_.front();
    waiting_.pop_front();
    const fs::path folder = folder_of(run);
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::vector<std::string> arguments = run.arguments;
    arguments.insert(arguments.end(), {"--out", folder.string(), "--quiet"});
    std::optional<CoreClaim> core = CoreClaim::take();
    const KeepToCore keep(core);
    Child child(arguments, folder / kLogFile);
    active_.push_back({&run, std::move(core), child, Clock::now()});
  }

  void collect() {
    for (std::size_t i = 0; i < active_.size();) {
      const auto end = active_[i].child.poll();
      if (!end) {
        ++i;
        continue;
      }
      finish(active_[i], *end);
      active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  void finish(const ActiveRun& active, const ChildEnd& end) {
    const PlannedRun& run = *active.run;
    RunMark mark = judge_run(folder_of(run), end.exit_code, end.signal);
    mark.seconds = std::chrono::duration<double>(Clock::now() - active.start).count();
    mark.program = program_fingerprint();
    mark.arguments = run.arguments;
    write_mark(folder_of(run), mark);
    ++outcome_.done;
    if (mark.end == RunEnd::kBroken) ++outcome_.broken;
    if (settings_.verbosity == Verbosity::kQuiet) return;
    const std::string how =
        mark.end == RunEnd::kTracked ? "" : (mark.end == RunEnd::kLost ? "lost: " : "failed: ");
    std::fprintf(stderr, "[%zu/%zu] %s: %s%s (%.1f s)\n", outcome_.done, total_, run.title.c_str(),
                 how.c_str(), how.empty() ? "done" : mark.reason.c_str(), mark.seconds);
  }

  // What the children have written is of no use: their runs start anew the next time.
  void stop_all() {
    constexpr auto kPatience = std::chrono::seconds(5);
    for (const ActiveRun& active : active_) active.child.send(SIGTERM);
    const auto deadline = Clock::now() + kPatience;
    bool killed = false;
    while (!active_.empty()) {
      std::erase_if(active_, [](ActiveRun& active) { return active.child.poll().has_value(); });
      if (!killed && Clock::now() > deadline) {
        for (const ActiveRun& active : active_) active.child.send(SIGKILL);
        killed = true;
      }
      std::this_thread::sleep_for(kPause);
    }
  }

  BatchSettings settings_;
  std::size_t jobs_ = 1;
  std::size_t total_ = 0;
  std::size_t rebuilt_ = 0;
  std::deque<const PlannedRun*> waiting_;
  std::vector<ActiveRun> active_;
  BatchOutcome outcome_;
};

}  // namespace

BatchOutcome run_batch(const Plan& plan, const BatchSettings& settings) {
  return Batch(plan, settings).run();
}

}  // namespace sslam::cli
