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
  REQUIRE(file("%zz.txt") == root / "sub" / "%zz.txt");
  for (const char* uri : {"../../b.txt", "%2e%2e/../b.txt", "/etc/passwd", "file:///etc/passwd",
                          "http://x.org/b.txt", "%2fetc/passwd", "a%00b"}) {
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

}  // namespace
}  // namespace fanbeam::core
