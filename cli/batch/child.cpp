// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch/child.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "sslam/core/error.hpp"
#include "sslam/io/files/text.hpp"

namespace sslam::cli {
namespace {

constexpr const char* kParentVariable = "SSLAM_PARENT";

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> own_environment() {
  std::vector<std::string> variables;
  const std::string own = std::string(kParentVariable) + "=";
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (!std::string_view(*variable).starts_with(own)) variables.emplace_back(*variable);
  variables.push_back(own + std::to_string(getpid()));
  return variables;
}

// What posix_spawn sets up between fork and exec.
struct SpawnSetup {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;

  explicit SpawnSetup(const std::string& log) {
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_init(&attributes);
    // A process group of its own: Ctrl-C in a terminal reaches the parent, which stops its children in order.
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes, 0);
    sigset_t by_default;
    sigemptyset(&by_default);
    for (const int signal : {SIGINT, SIGTERM}) sigaddset(&by_default, signal);
    posix_spawnattr_setsigdefault(&attributes, &by_default);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;
  ~SpawnSetup() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
};

}  // namespace

Child::Child(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<std::string> words{"sslam"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = own_environment();
  const SpawnSetup setup(log.string());
  const int error = posix_spawn(&pid_, "/proc/self/exe", &setup.files, &setup.attributes,
                                pointers_to(words).data(), pointers_to(variables).data());
  if (error != 0)
    throw Error(log.string() + ": cannot start a run that writes there: " + std::strerror(error));
}

std::optional<ChildEnd> Child::poll() {
  int status = 0;
  const pid_t ended = waitpid(pid_, &status, WNOHANG);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return std::nullopt;
  ChildEnd end;
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

void Child::send(int signal) const noexcept {
  kill(pid_, signal);
}

void end_with_parent() {
  const char* const parent = std::getenv(kParentVariable);
  if (parent == nullptr) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // It may have ended before the line above.
  if (io::parse_number<pid_t>(parent) != getppid()) _exit(static_cast<int>(128 + SIGKILL));
}

}  // namespace sslam::cli
