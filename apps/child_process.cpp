// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include "cslam/util/check.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#include <optional>
#include <system_error>

namespace cslam {
namespace {

constexpr int kSignalBase = 128;  // as shells count

// posix_spawn's two lists of wishes.
class SpawnWishes {
 public:
  explicit SpawnWishes(const std::filesystem::path& log) {
    posix_spawnattr_init(&attributes_);
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_setpgroup(&attributes_, 0);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    if (log.empty()) return;
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  ~SpawnWishes() {
    posix_spawnattr_destroy(&attributes_);
    posix_spawn_file_actions_destroy(&actions_);
  }
  SpawnWishes(const SpawnWishes&) = delete;
  SpawnWishes& operator=(const SpawnWishes&) = delete;

  const posix_spawnattr_t* attributes() const { return &attributes_; }
  const posix_spawn_file_actions_t* actions() const { return &actions_; }

 private:
  posix_spawnattr_t attributes_{};
  posix_spawn_file_actions_t actions_{};
};

// SIGCHLD waits to be asked for, as long as this lives.
class ChildSignal {
 public:
  ChildSignal() {
    sigemptyset(&child_);
    sigaddset(&child_, SIGCHLD);
    pthread_sigmask(SIG_BLOCK, &child_, &before_);
  }
  ~ChildSignal() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  ChildSignal(const ChildSignal&) = delete;
  ChildSignal& operator=(const ChildSignal&) = delete;

  void WaitAtMost(long milliseconds) const {
    const timespec time{.tv_sec = 0, .tv_nsec = 1'000'000 * milliseconds};
    sigtimedwait(&child_, nullptr, &time);
  }

 private:
  sigset_t child_{};
  sigset_t before_{};
};

pid_t Spawn(const std::vector<std::string>& command, const posix_spawn_file_actions_t* actions,
            const posix_spawnattr_t* attributes) {
  CSLAM_CHECK(!command.empty());
  std::vector<std::string> copies = command;  // posix_spawn wants them writable
  std::vector<char*> arguments;
  for (std::string& argument : copies)
    arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, arguments[0], actions, attributes, arguments.data(), environ);
  if (error != 0) {
    throw Error("cannot start '{}': {}", command[0], std::generic_category().message(error));
  }
  return child;
}

// How it ended; nothing if it is still at work (with WNOHANG).
std::optional<int> StatusOf(pid_t child, int flags, const std::string& name) {
  while (true) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, flags);
    if (ended > 0) return status;
    if (ended == 0) return std::nullopt;
    if (errno != EINTR)
      throw Error("lost sight of '{}': {}", name, std::generic_category().message(errno));
  }
}

int ExitCodeOf(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalBase + WTERMSIG(status);
}

}  // namespace

int RunChildProcess(const std::vector<std::string>& command) {
  return ExitCodeOf(StatusOf(Spawn(command, nullptr, nullptr), 0, command[0]).value());
}

int RunChildProcess(const std::vector<std::string>& command, const ChildOptions& options) {
  constexpr long kAskEveryMs = 200;
  const ChildSignal signal;
  const SpawnWishes wishes(options.log);
  const pid_t child = Spawn(command, wishes.actions(), wishes.attributes());
  bool was_told = false;
  while (true) {
    if (const auto status = StatusOf(child, WNOHANG, command[0])) return ExitCodeOf(*status);
    signal.WaitAtMost(kAskEveryMs);
    if (was_told || !options.is_interrupted || !options.is_interrupted()) continue;
    kill(child, SIGTERM);
    was_told = true;
  }
}

}  // namespace cslam
