#include "datasets/record_seal.h"

#include "datasets/sha256.h"

namespace fanbeam::datasets {
namespace {

constexpr std::string_view kSeal = ",\n \"record_sha256\": \"";
constexpr std::string_view kEndOfObject = "\n}";

std::string with_seal(std::string_view body) {
  return std::string(body).append(kSeal).append(sha256(body)).append("\"\n}\n");
}

}  // namespace

std::string sealed(std::string_view object) {
  return with_seal(object.substr(0, object.size() - kEndOfObject.size()));
}

bool has_seal(std::string_view record) {
  return record.rfind("\"record_sha256\"") != std::string_view::npos;
}

bool is_intact(std::string_view record) {
  if (!has_seal(record)) return true;
  const std::size_t body = record.rfind(kSeal);
  return body != std::string_view::npos && record == with_seal(record.substr(0, body));
}

}  // namespace fanbeam::datasets
