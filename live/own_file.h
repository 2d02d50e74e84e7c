// A file that a flight is going to write, opened before it is known whether it flies: until begin() not a
// byte of it has changed, and no other process that opens it so can have it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace fanbeam::live {

class OwnFile {
 public:
  // `field` and `expected` are what errors say. Throws InputError E-IO, also where the file is open so already, and
  // for a pipe or a socket, named or not. A device is taken.
  OwnFile(std::filesystem::path file, std::string field, std::string expected);
  ~OwnFile();  // a file that was made and never begun goes again
  OwnFile(const OwnFile&) = delete;
  OwnFile& operator=(const OwnFile&) = delete;

  // What was in it is gone. Once.
  void begin();
  int descriptor() const { return descriptor_; }
  // Throw InputError E-IO. Of bytes that are refused a file keeps none; what a device took is gone.
  void write(std::string_view bytes);
  void close();

 private:
  [[noreturn]] void refuse(int reason) const;
  [[noreturn]] void refuse(const std::string& value) const;

  std::filesystem::path file_;
  std::string field_, expected_;
  int descriptor_ = -1;
  bool regular_ = false, made_ = false, begun_ = false;
};

}  // namespace fanbeam::live
