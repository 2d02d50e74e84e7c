#include "datasets/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include "core/errors.h"

namespace fanbeam::datasets {
namespace {

class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1)
      throw core::InternalError("SHA-256 is not there");
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string text() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned length = 0;
    EVP_DigestFinal_ex(context_.get(), bytes.data(), &length);
    constexpr const char* kDigits = "0123456789abcdef";
    std::string text;
    for (unsigned i = 0; i < length; ++i) {
      text += kDigits[bytes[i] >> 4U];
      text += kDigits[bytes[i] & 15U];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.text();
}

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "file",
                            std::strerror(errno), "a file that can be read");
  Digest digest;
  std::array<char, 1U << 16U> chunk{};
  while (stream.read(chunk.data(), chunk.size()) || stream.gcount() > 0)
    digest.add({chunk.data(), static_cast<std::size_t>(stream.gcount())});
  if (stream.bad())
    core::throw_input_error(core::ErrorClass::io, core::Place{file.string()}, "file",
                            std::strerror(errno), "a file that can be read to its end");
  return digest.text();
}

}  // namespace fanbeam::datasets
