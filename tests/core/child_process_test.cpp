// Another program beside ours: what strikes it and what it can read.
#include "core/child_process.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "core/stop.h"

using fanbeam::core::ChildProcess;

namespace {

std::string printed_by(const std::vector<std::string>& words) {
  ChildProcess program(words, ChildProcess::Pipe::from_its_output);
  REQUIRE(program.started());
  std::string text;
  for (std::string part; !(part = program.receive()).empty();) text += part;
  CHECK(program.succeeded());
  return text;
}

}  // namespace

TEST_CASE("A program beside ours has a process group of its own and no terminal to read",
          "[child_process]") {
  const std::string group = printed_by({"cut", "-d ", "-f5", "/proc/self/stat"});
  REQUIRE_FALSE(group.empty());
  CHECK(std::stoi(group) != getpgrp());
  CHECK(printed_by({"readlink", "/proc/self/fd/0"}) == "/dev/null\n");
  // A terminal with tostop does not hold it for ever when it prints.
  const std::string blocked = printed_by({"grep", "SigBlk", "/proc/self/status"});
  CHECK((std::stoull(blocked.substr(blocked.find('\t')), nullptr, 16) >> (SIGTTOU - 1) & 1U) == 1);
}

TEST_CASE("A program beside ours that fails when the user wants to stop was stopped",
          "[child_process]") {
  fanbeam::core::StopSource source;
  const fanbeam::core::StopToken token = source.token();
  const fanbeam::core::StopScope scope(token);
  ChildProcess shell({"sh", "-c", "exec <&-; exit 3"}, ChildProcess::Pipe::to_its_input);
  REQUIRE(shell.started());
  const std::string much(1U << 20U, 'x');
  CHECK_FALSE(shell.send(much));  // nobody reads it
  source.request();
  CHECK_THROWS_AS(shell.send(much), fanbeam::core::Stopped);
}

TEST_CASE("A program beside ours that reads nothing does not hold who wants to stop",
          "[child_process]") {
  fanbeam::core::StopSource source;
  const fanbeam::core::StopToken token = source.token();
  const fanbeam::core::StopScope scope(token);
  ChildProcess sleeper({"sleep", "60"}, ChildProcess::Pipe::to_its_input);
  REQUIRE(sleeper.started());
  source.request();
  CHECK_THROWS_AS(sleeper.send(std::string(1U << 20U, 'x')), fanbeam::core::Stopped);
}
