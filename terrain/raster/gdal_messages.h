// What GDAL has to say, caught instead of printed.
#pragma once

#include <string>

namespace fanbeam::terrain {

// While it lives, errors and warnings that GDAL raises in this thread are collected here, and
// whatever GDAL wants to fetch from the network in this thread is such an error. Also registers GDAL's drivers, once per process.
class GdalMessages {
 public:
  GdalMessages();
  ~GdalMessages();
  GdalMessages(const GdalMessages&) = delete;
  GdalMessages& operator=(const GdalMessages&) = delete;

  bool has_errors() const { return !first_error_.empty(); }
  // The first error, or `otherwise` when GDAL gave none.
  std::string first_error_or(const std::string& otherwise) const;
  void add_error(const char* text);

 private:
  std::string first_error_;
};

}  // namespace fanbeam::terrain
