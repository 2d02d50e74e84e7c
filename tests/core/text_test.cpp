#include "core/text.h"

#include <catch2/catch.hpp>
#include <clocale>
#include <string>

using namespace fanbeam::core;

TEST_CASE("A number is the whole text, with blanks around it", "[text]") {
  CHECK(parse_number("12.5").value == 12.5);
  CHECK(parse_number(" \t-3e-2\r\n").value == -0.03);
  CHECK(parse_number("+7").value == 7.0);
  CHECK(parse_number("-0").value == 0.0);
  CHECK(parse_number("0.1").value == 0.1);
  for (const char* good : {"12.5", " 1 ", "+7", ".5", "5.", "1e308", "4.9e-324"})
    CHECK(parse_number(good).error == NumberError::none);
}

TEST_CASE("What is not a number says why, and its value is zero", "[text]") {
  for (const char* bad :
       {"", "   ", "abc", "1,5", "1.5m", "1 2", "--1", "+-1", "++1", "1e", "0x10", "1.2.3", "."}) {
    INFO("text: " << bad);
    CHECK(parse_number(bad).error == NumberError::not_a_number);
    CHECK(parse_number(bad).value == 0.0);
  }
  for (const char* bad : {"nan", "NaN", "inf", "-inf", "Infinity"}) {
    INFO("text: " << bad);
    CHECK(parse_number(bad).error == NumberError::nonfinite);
    CHECK(parse_number(bad).value == 0.0);
  }
  for (const char* bad : {"1e400", "-1e400"}) {
    INFO("text: " << bad);
    CHECK(parse_number(bad).error == NumberError::out_of_range);
  }
}

TEST_CASE("A zero byte inside a number is not its end", "[text]") {
  CHECK(parse_number(std::string_view("1\0"
                                      "2",
                                      3))
            .error == NumberError::not_a_number);
}

TEST_CASE("F18 a locale with a decimal comma changes nothing", "[text][F18]") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, locale) != nullptr) break;
  CHECK(parse_number("1.5").value == 1.5);
  CHECK(parse_number("1,5").error == NumberError::not_a_number);
  std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("trimmed removes blanks at both ends only", "[text]") {
  CHECK(trimmed("  a b\t\r\n") == "a b");
  CHECK(trimmed(" \t ").empty());
  CHECK(trimmed("").empty());
}
