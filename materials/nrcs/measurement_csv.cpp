#include "materials/nrcs/measurement_csv.h"

#include <algorithm>
#include <optional>

#include "core/decibel.h"
#include "core/spelling.h"
#include "core/text.h"
#include "core/units.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;

constexpr const char* kColumns[] = {"grazing_deg", "sigma0_dB"};
constexpr std::size_t kColumnCount = 2;

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(core::trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

class Reader {
 public:
  Reader(const std::string& file_name, core::ProblemList& problems)
      : file_name_(file_name), problems_(problems) {}

  void line(std::string_view text, int number) {
    text = core::trimmed(text);
    if (text.empty() || text.front() == '#') return;
    number_ = number;
    const std::vector<std::string_view> cells = cells_of(text);
    if (has_header_)
      row(cells);
    else
      header(cells);
  }

  std::vector<NrcsSample> finish() {
    if (!has_header_ || (columns_found() && rows_ == 0))
      report(ErrorClass::parse, has_header_ ? "rows" : "header", "none",
             "a header with grazing_deg and sigma0_dB, and a row below it");
    return std::move(samples_);
  }

 private:
  void header(const std::vector<std::string_view>& cells) {
    has_header_ = true;
    for (std::size_t c = 0; c < kColumnCount; ++c) {
      const auto found = std::find(cells.begin(), cells.end(), kColumns[c]);
      if (found == cells.end())
        report(ErrorClass::parse, "header", "no column " + std::string(kColumns[c]),
               "grazing_deg and sigma0_dB" +
                   core::names_there_text(kColumns[c], {cells.begin(), cells.end()}));
      else
        place_[c] = static_cast<std::size_t>(found - cells.begin());
    }
  }

  bool columns_found() const { return place_[0] && place_[1]; }

  void row(const std::vector<std::string_view>& cells) {
    ++rows_;
    if (!columns_found()) return;
    const auto angle_deg = number(cells, 0, "above 0 to 90",
                                  [](double value) { return value > 0.0 && value <= 90.0; });
    const auto level_dB = number(cells, 1, "-300 to 300",
                                 [](double value) { return value >= -300.0 && value <= 300.0; });
    if (angle_deg && *angle_deg <= last_deg_) {
      report(ErrorClass::range, kColumns[0], core::number_text(*angle_deg),
             "more than the row before, " + core::number_text(last_deg_));
      return;
    }
    if (angle_deg) last_deg_ = *angle_deg;
    if (angle_deg && level_dB)
      samples_.push_back({core::radians(*angle_deg), core::power_from_dB(*level_dB)});
  }

  template <class Allowed>
  std::optional<double> number(const std::vector<std::string_view>& cells, std::size_t column,
                               const char* expected, Allowed&& allowed) {
    const std::size_t place = *place_[column];
    const std::string_view text = place < cells.size() ? cells[place] : "";
    const core::ParsedNumber parsed = core::parse_number(text);
    const std::string shown =
        text.empty() ? "missing" : "\"" + std::string(text.substr(0, 60)) + "\"";
    if (parsed.error == core::NumberError::none && allowed(parsed.value)) return parsed.value;
    const ErrorClass error_class =
        parsed.error == core::NumberError::not_a_number ? ErrorClass::parse
        : parsed.error == core::NumberError::nonfinite  ? ErrorClass::nonfinite
                                                        : ErrorClass::range;
    report(error_class, kColumns[column], shown, expected);
    return std::nullopt;
  }

  void report(ErrorClass error_class, const std::string& field, const std::string& value,
              const std::string& expected) {
    problems_.error(error_class, {file_name_, number_, 0}, field, value, expected);
  }

  const std::string& file_name_;
  core::ProblemList& problems_;
  int number_ = 1;
  int rows_ = 0;
  bool has_header_ = false;
  std::optional<std::size_t> place_[kColumnCount];
  double last_deg_ = 0.0;
  std::vector<NrcsSample> samples_;
};

}  // namespace

std::vector<NrcsSample> read_measurements(std::string_view text, const std::string& file_name,
                                          core::ProblemList& problems) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Reader reader(file_name, problems);
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    reader.line(text.substr(0, end), number);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return reader.finish();
}

}  // namespace fanbeam::materials
