// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "cslam/assets/run_command.h"

#include "cslam/util/check.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace cslam {
namespace {

constexpr int kTickMs = 250;         // between calls of on_wait
constexpr int kNoProgramCode = 127;  // as shells say it

class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw Error("cannot start a program: {}", std::strerror(errno));
  }
  ~Pipe() {
    CloseWriter();
    close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }
  void CloseWriter() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

// Starts the program; -1 if there is none of that name.
pid_t Spawn(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
            int output) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), {"env", "LC_ALL=C"});
  std::vector<char*> argv;
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t pid = -1;
  const int error = posix_spawnp(&pid, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? pid : -1;
}

int WaitFor(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string ReadAll(int reader, const std::function<void()>& on_wait) {
  std::string output;
  std::array<char, 4096> buffer{};
  while (true) {
    pollfd waiting{reader, POLLIN, 0};
    if (poll(&waiting, 1, kTickMs) > 0) {
      const ssize_t count = read(reader, buffer.data(), buffer.size());
      if (count > 0) output.append(buffer.data(), static_cast<std::size_t>(count));
      if (count == 0 || (count < 0 && errno != EINTR)) return output;
    }
    if (on_wait) on_wait();
  }
}

}  // namespace

CommandResult RunCommand(const std::vector<std::string>& arguments,
                         const std::filesystem::path& folder,
                         const std::function<void()>& on_wait) {
  CSLAM_CHECK(!arguments.empty());
  Pipe pipe;
  const pid_t pid = Spawn(arguments, folder, pipe.writer());
  pipe.CloseWriter();
  if (pid < 0) return {kNoProgramCode, arguments.front() + ": cannot be started"};
  try {
    std::string output = ReadAll(pipe.reader(), on_wait);
    return {WaitFor(pid), std::move(output)};
  } catch (...) {
    kill(pid, SIGTERM);
    WaitFor(pid);
    throw;
  }
}

}  // namespace cslam
