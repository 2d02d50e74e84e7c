#include "core/relative_uri.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/terrain/ascii_grid.h"

namespace fanbeam::core {
namespace {

TEST_CASE("A URI is relative to the file that holds it and stays in the folder", "[relative_uri]") {
  const tests::TemporaryFolder temporary;
  const std::filesystem::path root = std::filesystem::weakly_canonical(temporary.path());
  std::filesystem::create_directories(root / "sub");
  const std::filesystem::path from = root / "sub" / "a.xomp";
  const auto file = [&](const std::string& uri) {
    return file_of_uri(root, from, uri, {from.string()}, "/uri");
  };
  REQUIRE(file("b.txt") == root / "sub" / "b.txt");
  REQUIRE(file("./c/b.txt") == root / "sub" / "c" / "b.txt");
  REQUIRE(file("../b.txt") == root / "b.txt");
  REQUIRE(file("with%20space.txt") == root / "sub" / "with space.txt");
  REQUIRE(file("100%.txt") == root / "sub" / "100%.txt");
  REQUIRE(file("08:30.txt") == root / "sub" / "08:30.txt");
  REQUIRE(file("%zz.txt") == root / "sub" / "%zz.txt");
  for (const char* uri :
       {"../../b.txt", "%2e%2e/../b.txt", "/etc/passwd", "file:///etc/passwd", "http://x.org/b.txt",
        "FTP:b.txt", "file%3A/etc/passwd", "%2fetc/passwd", "a%00b"}) {
    INFO(uri);
    try {
      file(uri);
      FAIL("not refused");
    } catch (const InputError& error) {
      REQUIRE(error.has(ErrorClass::path));
      REQUIRE(error.problems().front().field == "/uri");
    }
  }
}

TEST_CASE("Bytes of percent signs are decoded, and told where they are none", "[relative_uri]") {
  const PercentDecoded good = percent_decoded("a%20b%2Fc%fF");
  CHECK(good.bytes == "a b/c\xff");
  CHECK(good.wrong == std::string::npos);
  const PercentDecoded bad = percent_decoded("%41%4%-1");
  CHECK(bad.bytes == "A%4%-1");
  CHECK(bad.wrong == 3);
}

TEST_CASE("A name with a colon is no URI, a scheme is", "[relative_uri]") {
  for (const char* name : {"flight_08:30.csv", "2024:01.csv", "dem:tile.tif", "a/b:c", "1http://x",
                           ":x", "x:", "mailto:x", "", "a b://c"}) {
    INFO(name);
    CHECK_FALSE(has_uri_scheme(name));
  }
  for (const char* uri :
       {"http:x", "HTTPS:x", "ftp:x", "File:/x", "data:,x", "s3://x", "git+ssh://x"}) {
    INFO(uri);
    CHECK(has_uri_scheme(uri));
  }
}

}  // namespace
}  // namespace fanbeam::core
