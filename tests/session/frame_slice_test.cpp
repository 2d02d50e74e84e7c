// --frames counts like a Python slice with a step above 0.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "core/errors.h"
#include "session/frame_choice.h"

using namespace fanbeam;
using session::parse_frames;

namespace {

using Frames = std::vector<int>;

std::string code_of(const std::string& text, int count) {
  try {
    parse_frames(text, count);
  } catch (const core::InputError& error) {
    CHECK(error.problems().at(0).field == "--frames");
    return error.problems().at(0).code;
  }
  return "accepted";
}

}  // namespace

TEST_CASE("Slices of ten frames are those of Python's range(10)", "[frames]") {
  CHECK(parse_frames("", 10) == Frames{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(parse_frames(":", 10).size() == 10);
  CHECK(parse_frames("::", 10).size() == 10);
  CHECK(parse_frames("2:5", 10) == Frames{2, 3, 4});
  CHECK(parse_frames("7:", 10) == Frames{7, 8, 9});
  CHECK(parse_frames(":2", 10) == Frames{0, 1});
  CHECK(parse_frames("::4", 10) == Frames{0, 4, 8});
  CHECK(parse_frames("1:9:3", 10) == Frames{1, 4, 7});
  CHECK(parse_frames("-3:", 10) == Frames{7, 8, 9});
  CHECK(parse_frames(":-8", 10) == Frames{0, 1});
  CHECK(parse_frames("-100:100", 10).size() == 10);
  CHECK(parse_frames("8:100:5", 10) == Frames{8});
}

TEST_CASE("A single number is that frame, counted from the end when negative", "[frames]") {
  CHECK(parse_frames("0", 10) == Frames{0});
  CHECK(parse_frames("9", 10) == Frames{9});
  CHECK(parse_frames("-1", 10) == Frames{9});
  CHECK(code_of("10", 10) == "E-RANGE");
  CHECK(code_of("-11", 10) == "E-RANGE");
}

TEST_CASE("Slices that select nothing, or are none, are refused", "[frames]") {
  CHECK(code_of("5:5", 10) == "E-RANGE");
  CHECK(code_of("5:2", 10) == "E-RANGE");
  CHECK(code_of("10:", 10) == "E-RANGE");
  CHECK(code_of("::0", 10) == "E-RANGE");
  CHECK(code_of("::-1", 10) == "E-RANGE");
  for (const char* text :
       {"a", "1:b", "1,2", "1.5", "1:2:3:4", " 1", "1 ", "0x1", "99999999999999999999"})
    CHECK(code_of(text, 10) == "E-PARSE");
  // However many there are.
  CHECK_THROWS_AS(session::check_frames("1:b"), core::InputError);
  CHECK_THROWS_AS(session::check_frames("::0"), core::InputError);
  for (const char* text : {"", "5:2", "10:", "7000"}) CHECK_NOTHROW(session::check_frames(text));
}

TEST_CASE("The largest numbers do not overflow", "[frames]") {
  CHECK(parse_frames("1:9223372036854775807:9223372036854775807", 10) == Frames{1});
  CHECK(parse_frames("-9223372036854775808:", 3) == Frames{0, 1, 2});
  CHECK(code_of("9223372036854775807", 10) == "E-RANGE");
}
