#pragma once

#include <sys/wait.h>
#include <unistd.h>

namespace lanescape::testing {

// Runs a check in a process of its own, where traps kill: 0 if it holds.
template <class Check>
int status_of(Check check) {
  const pid_t child = fork();
  if (child == 0) _exit(check() ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

}  // namespace lanescape::testing
