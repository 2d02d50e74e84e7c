// Another program beside ours, with one pipe to it or from it: ffmpeg, gnuplot.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::core {

class ChildProcess {
 public:
  enum class Pipe { to_its_input, from_its_output };

  // Looks for the program in PATH. It is in a process group of its own, which a terminal's Ctrl-C
  // does not strike: whoever stops this program gets its answer, and the other one ends with its
  // pipe. Without a pipe to its input it reads nothing. Signals that this program ignores strike it.
  ChildProcess(const std::vector<std::string>& words, Pipe pipe);
  // What was not waited for is killed: nobody wants what it has.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Whether it could be started; nothing else may be asked where it could not.
  bool started() const { return process_ > 0; }
  // False when it stopped reading. Throws core::Stopped.
  bool send(std::string_view bytes);
  // What it printed since the last call, empty at its end. Throws core::Stopped.
  std::string receive();
  // Closes the pipe and waits; whether it ended in good order. Throws core::Stopped.
  bool succeeded();

 private:
  void close_pipe();
  // Throws core::Stopped.
  void wait_for_pipe(short events) const;

  int pipe_ = -1;
  int process_ = 0;  // its pid
};

}  // namespace fanbeam::core
