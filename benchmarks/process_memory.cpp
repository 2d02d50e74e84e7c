#include "benchmarks/process_memory.h"

#include <fstream>

namespace fanbeam::benchmarks {

double process_memory_bytes(const std::string& field, pid_t process) {
  std::ifstream stream("/proc/" + (process == 0 ? "self" : std::to_string(process)) + "/status");
  for (std::string word; stream >> word;) {
    double kibibytes = 0.0;
    if (word == field + ":" && stream >> kibibytes) return kibibytes * 1024.0;
  }
  return 0.0;
}

}  // namespace fanbeam::benchmarks
