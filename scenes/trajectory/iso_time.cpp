#include "scenes/trajectory/iso_time.h"

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "core/text.h"

namespace fanbeam::scenes {
namespace {

// Takes a text apart from its beginning; once something was not as expected, `failed` stays.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  // A whole number of exactly that many digits.
  int digits(std::size_t count, int least, int most) {
    int value = 0;
    if (rest_.size() < count) return fail(least);
    for (std::size_t i = 0; i < count; ++i) {
      if (rest_[i] < '0' || rest_[i] > '9') return fail(least);
      value = 10 * value + (rest_[i] - '0');
    }
    rest_.remove_prefix(count);
    return value < least || value > most ? fail(least) : value;
  }

  bool take_any(std::string_view letters) {
    if (rest_.empty() || letters.find(rest_.front()) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void require(std::string_view letters) {
    if (!take_any(letters)) fail(0);
  }

  // ".25", if it comes; at most nine digits count.
  double fraction() {
    if (!take_any(".,")) return 0.0;
    double value = 0.0, place = 0.1;
    const std::size_t count = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
    if (count == 0) return fail(0);
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 9); ++i, place /= 10)
      value += place * (rest_[i] - '0');
    rest_.remove_prefix(count);
    return value;
  }

  char next() const { return rest_.empty() ? '\0' : rest_.front(); }
  void skip_blanks() { rest_ = core::trimmed(rest_); }
  bool succeeded() const { return !failed_ && rest_.empty(); }

 private:
  int fail(int value) {
    failed_ = true;
    return value;
  }

  std::string_view rest_;
  bool failed_ = false;
};

// Minutes that the zone is ahead of UTC.
int zone_min(Scanner& scanner) {
  scanner.skip_blanks();
  if (scanner.take_any("Zz") || scanner.next() == '\0') return 0;
  const int sign = scanner.next() == '-' ? -1 : 1;
  scanner.require("+-");
  const int hours = scanner.digits(2, 0, 14);
  if (scanner.next() == '\0') return sign * 60 * hours;
  scanner.take_any(":");
  return sign * (60 * hours + scanner.digits(2, 0, 59));
}

}  // namespace

std::optional<double> unix_time_s(std::string_view text) {
  text = core::trimmed(text);
  if (text.ends_with(" UTC")) text.remove_suffix(4);
  Scanner scanner(text);
  const int year = scanner.digits(4, 1900, 2200);
  scanner.require("-");
  const int month = scanner.digits(2, 1, 12);
  scanner.require("-");
  const int day = scanner.digits(2, 1, 31);
  scanner.require("Tt ");
  const int hour = scanner.digits(2, 0, 23);
  scanner.require(":");
  const int minute = scanner.digits(2, 0, 59);
  double second = 0.0;
  if (scanner.take_any(":")) {
    second = scanner.digits(2, 0, 60);
    second += scanner.fraction();
  }
  const int ahead_min = zone_min(scanner);
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!scanner.succeeded() || !date.ok()) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + 3600.0 * hour + 60.0 * (minute - ahead_min) + second;
}

}  // namespace fanbeam::scenes
