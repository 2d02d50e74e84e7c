#include "core/text.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "tests/comma_locale.h"

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
  const fanbeam::tests::CommaLocale comma;
  if (!comma.made()) return;
  const fanbeam::tests::HeldCommaLocale held(comma);
  CHECK(std::strtod("1,5", nullptr) == 1.5);  // what a C function makes of it
  CHECK(parse_number("1.5").value == 1.5);
  CHECK(parse_number("1,5").error == NumberError::not_a_number);
}

TEST_CASE("trimmed removes blanks at both ends only", "[text]") {
  CHECK(trimmed("  a b\t\r\n") == "a b");
  CHECK(trimmed(" \t ").empty());
  CHECK(trimmed("").empty());
}

TEST_CASE("What a terminal would obey is shown as an escape, everything else as it is", "[text]") {
  for (const char* plain :
       {"", "tower 3", "Innsbruck, Flughäfen, Köln/Bonn", "日本 ✈", "~!\"'\\"}) {
    CHECK(printable_text(plain) == plain);
    CHECK(is_printable_text(plain));
  }
  using namespace std::string_literals;
  const std::pair<std::string, std::string> kEscaped[] = {
      {"\x1b[2J", "\\x1b[2J"},
      {"a\nb\r", "a\\x0ab\\x0d"},
      {"\0"s, "\\x00"},
      {"\x7f", "\\x7f"},
      {"\xc2\x9b"
       "31m",
       "\\x9b31m"},
      {"\u202egnp.exe", "\\u202egnp.exe"},
      {"\u2028", "\\u2028"},
      {"\u2066", "\\u2066"},
      {"\xff", "\\xff"},
      {"\xc0\xaf", "\\xc0\\xaf"},           // an overlong "/"
      {"\xed\xa0\x80", "\\xed\\xa0\\x80"},  // a surrogate
      {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},
      {"\xe2\x82", "\\xe2\\x82"}};
  for (const auto& [text, shown] : kEscaped) {
    INFO(shown);
    CHECK(printable_text(text) == shown);
    CHECK_FALSE(is_printable_text(text));
    CHECK(is_printable_text(printable_text(text)));
  }
}

TEST_CASE("A shell takes back any text as one word", "[text]") {
  const std::pair<const char*, const char*> cases[] = {{"", "''"},
                                                       {"out/edny-24_b.toml", "out/edny-24_b.toml"},
                                                       {"da ta", "'da ta'"},
                                                       {"it's", "'it'\\''s'"},
                                                       {"'", "''\\'''"},
                                                       {"$HOME", "'$HOME'"},
                                                       {"~", "'~'"},
                                                       {"a\nb", "'a\nb'"},
                                                       {"\xC3\xA9", "'\xC3\xA9'"}};
  for (const auto& [text, word] : cases) {
    INFO(text);
    CHECK(shell_word(text) == word);
  }
}

TEST_CASE("A safe word names one file in one folder, and any text becomes one", "[text]") {
  for (const char* word : {"a", "innsbruck-26", "v1.2_b", "0", "A..b"}) {
    CHECK(is_safe_word(word));
    CHECK(safe_word(word) == word);
  }
  for (const char* text : {"", ".", "..", "../../owned", "/etc", "a/b", "a\\b", "-o", ".hidden",
                           "a b", "a\n", "ä", "C:"}) {
    INFO(text);
    CHECK_FALSE(is_safe_word(text));
    CHECK(is_safe_word(safe_word(text)));
  }
  CHECK(safe_word("../../owned") == "owned");
  CHECK(safe_word("My scene") == "My-scene");
  CHECK_FALSE(is_safe_word(std::string(65, 'a')));
  CHECK(safe_word(std::string(1000, 'a')).size() == 64);
}
