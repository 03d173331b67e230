// SPDX-FileCopyrightText: 2026 The Changing-SLAM authors
// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include "cslam/util/check.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace cslam {
namespace {

constexpr int kSignalBase = 128;  // as shells count

}  // namespace

int RunChildProcess(const std::vector<std::string>& command) {
  CSLAM_CHECK(!command.empty());
  std::vector<std::string> copies = command;  // posix_spawn wants them writable
  std::vector<char*> arguments;
  for (std::string& argument : copies)
    arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ);
  if (error != 0) {
    throw Error("cannot start '{}': {}", command[0], std::generic_category().message(error));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR)
      throw Error("lost sight of '{}': {}", command[0], std::generic_category().message(errno));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalBase + WTERMSIG(status);
}

}  // namespace cslam
