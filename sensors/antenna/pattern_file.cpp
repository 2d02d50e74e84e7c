#include "sensors/antenna/pattern_file.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>

#include "core/decibel.h"
#include "core/files.h"
#include "core/text.h"
#include "core/units.h"

namespace fanbeam::sensors {
namespace {

using core::ErrorClass;

constexpr std::uint64_t kLargestFile_bytes = 4U << 20U;
constexpr std::size_t kMostRows = 36001;
constexpr double kDipoleGain_dB = 2.15;
constexpr double kPeakTolerance_dB = 0.5;

struct Range {
  double low, high;
  const char* text;
};

struct Row {
  double angle_deg, gain_dB;
};

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kShown = 40;
  return '"' + std::string(text.substr(0, kShown)) + (text.size() > kShown ? "...\"" : "\"");
}

// The file line by line, and what is wrong with the line it stands at.
class Lines {
 public:
  Lines(std::string_view text, std::string file, core::ProblemList& problems)
      : text_(text), file_(std::move(file)), problems_(problems) {}

  // The next line that is not blank and not a comment.
  std::optional<std::string_view> next() {
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      const std::string_view line = core::trimmed(text_.substr(at_, end - at_));
      at_ = end + 1;
      ++number_;
      if (!line.empty() && line.front() != '#') return line;
    }
    return std::nullopt;
  }

  void error(ErrorClass error_class, const std::string& field, std::string value,
             std::string expected) {
    failed_ = true;
    problems_.error(error_class, {file_, number_}, field, std::move(value), std::move(expected));
  }

  std::optional<double> number(std::string_view text, const std::string& field, Range range) {
    const core::ParsedNumber parsed = core::parse_number(text);
    if (parsed.error == core::NumberError::none && parsed.value >= range.low &&
        parsed.value <= range.high)
      return parsed.value;
    error(parsed.error == core::NumberError::not_a_number ? ErrorClass::parse
          : parsed.error == core::NumberError::nonfinite  ? ErrorClass::nonfinite
                                                          : ErrorClass::range,
          field, in_quotes(text), range.text);
    return std::nullopt;
  }

  bool failed() const { return failed_; }
  bool full() const { return problems_.is_full(); }

 private:
  std::string_view text_;
  std::string file_;
  core::ProblemList& problems_;
  std::size_t at_ = 0;
  int number_ = 0;
  bool failed_ = false;
};

// The first word and what follows it.
std::pair<std::string_view, std::string_view> split(std::string_view line, const char* separators) {
  const std::size_t end = std::min(line.find_first_of(separators), line.size());
  return {line.substr(0, end), core::trimmed(line.substr(std::min(end + 1, line.size())))};
}

// False where no further row is worth a look.
bool add_row(Lines& lines, std::string_view line, const char* separators, Range angles, Range gains,
             std::vector<Row>& rows) {
  if (rows.size() == kMostRows) {
    lines.error(ErrorClass::limit, "rows", "more than " + std::to_string(kMostRows),
                "at most that many in a cut");
    return false;
  }
  const auto [first, second] = split(line, separators);
  const auto angle_deg = lines.number(first, "angle", angles);
  const auto gain_dB = lines.number(second, "gain", gains);
  if (!angle_deg || !gain_dB) return !lines.full();
  if (!rows.empty() && !(*angle_deg > rows.back().angle_deg))
    lines.error(ErrorClass::range, "angle", core::number_text(*angle_deg), "angles that increase");
  rows.push_back({*angle_deg, *gain_dB});
  return !lines.full();
}

bool is_number(std::string_view text) {
  return core::parse_number(text).error != core::NumberError::not_a_number;
}

void read_gain(Lines& lines, std::string_view value, PatternCut& cut) {
  const auto [amount, unit] = split(value, " \t");
  const auto gain_dB =
      lines.number(amount, "GAIN", {-90.0, 90.0, "-90 to 90, then dBi, dBd or nothing"});
  const std::string name = upper(unit);
  if (!name.empty() && name != "DBI" && name != "DBD")
    lines.error(ErrorClass::parse, "GAIN", in_quotes(unit), "dBi, dBd or nothing for dBd");
  if (!gain_dB) return;
  const double gain = core::power_from_dB(*gain_dB + (name == "DBI" ? 0 : kDipoleGain_dB));
  if (cut.peak_gain && *cut.peak_gain != gain)
    lines.error(ErrorClass::parse, "GAIN", in_quotes(value),
                "the gain of the line before, or one line");
  cut.peak_gain = gain;
}

// The rows behind "HORIZONTAL n"; false when they are unusable.
bool read_block(Lines& lines, const std::string& keyword, std::string_view count,
                std::vector<Row>& rows) {
  const auto wanted = lines.number(count, keyword, {2.0, 36000.0, "2 to 36000 rows"});
  if (!wanted) return false;
  const auto number = static_cast<std::size_t>(*wanted);
  for (std::size_t read = 0; read < number; ++read) {
    const auto line = lines.next();
    if (!line) {
      lines.error(ErrorClass::parse, keyword, std::to_string(read) + " rows",
                  std::to_string(number) + ", as announced");
      return false;
    }
    const bool go_on = add_row(lines, *line, " \t", {0.0, 359.999999, "0 to below 360 deg"},
                               {0.0, 400.0, "an attenuation, 0 to 400 dB"}, rows);
    if (!go_on || !is_number(split(*line, " \t").first)) return false;  // perhaps the next block
  }
  for (Row& row : rows) row.gain_dB = -row.gain_dB;
  return true;
}

// From 0..360 in the file's sense to increasing angles within +-180 in the sensor's; the rows close
// the circle, so both ends get the gain at 180 deg.
std::vector<Row> unrolled(const std::vector<Row>& circle, PatternPlane plane) {
  const double sense = plane == PatternPlane::azimuth ? 1.0 : -1.0;
  std::vector<Row> rows;
  for (const Row& row : circle) {
    const double angle_deg = row.angle_deg > 180.0 ? row.angle_deg - 360.0 : row.angle_deg;
    rows.push_back({sense * angle_deg, row.gain_dB});
    if (angle_deg == 180.0) rows.push_back({-sense * angle_deg, row.gain_dB});
  }
  std::sort(rows.begin(), rows.end(),
            [](const Row& a, const Row& b) { return a.angle_deg < b.angle_deg; });
  return rows;
}

std::vector<Row> read_msi(Lines& lines, PatternPlane plane, PatternCut& cut) {
  const std::string wanted = plane == PatternPlane::azimuth ? "HORIZONTAL" : "VERTICAL";
  std::vector<Row> horizontal, vertical;
  while (const auto line = lines.next()) {
    const auto [word, value] = split(*line, " \t");
    const std::string keyword = upper(word);
    if (keyword == "GAIN") read_gain(lines, value, cut);
    if (is_number(word)) {
      lines.error(ErrorClass::parse, "row", in_quotes(*line), "as many rows as announced");
      return {};
    }
    std::vector<Row>* const rows = keyword == "HORIZONTAL" ? &horizontal
                                   : keyword == "VERTICAL" ? &vertical
                                                           : nullptr;
    if (rows == nullptr) continue;
    if (!rows->empty()) {
      lines.error(ErrorClass::parse, keyword, "given twice", "one block of rows");
      return {};
    }
    if (!read_block(lines, keyword, value, *rows)) return {};
  }
  const std::vector<Row>& found = plane == PatternPlane::azimuth ? horizontal : vertical;
  if (found.empty() && !lines.failed())
    lines.error(ErrorClass::parse, wanted, "missing", wanted + " and its number of rows");
  return unrolled(found, plane);
}

std::vector<Row> read_csv(Lines& lines) {
  std::vector<Row> rows;
  const auto header = lines.next();
  if (!header || *header != "angle_deg,gain_dB") {
    lines.error(ErrorClass::parse, "header", in_quotes(header.value_or("")), "angle_deg,gain_dB");
    return rows;
  }
  while (const auto line = lines.next())
    if (!add_row(lines, *line, ",", {-180.0, 180.0, "-180 to 180 deg"},
                 {-400.0, 0.0, "a gain relative to the peak, -400 to 0 dB"}, rows))
      return rows;
  if (rows.size() < 2 && !lines.failed())
    lines.error(ErrorClass::parse, "rows", std::to_string(rows.size()), "at least 2");
  return rows;
}

}  // namespace

PatternCut read_pattern_cut(const std::filesystem::path& file, PatternPlane plane,
                            core::ProblemList& problems) {
  PatternCut cut;
  std::string text;
  try {
    text = core::read_file(file, kLargestFile_bytes);
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return cut;
  }
  Lines lines(text, file.string(), problems);
  const std::string kind = upper(file.extension().string());
  std::vector<Row> rows;
  if (kind == ".MSI" || kind == ".PLN") {
    rows = read_msi(lines, plane, cut);
  } else if (kind == ".CSV") {
    rows = read_csv(lines);
  } else {
    lines.error(ErrorClass::unsupported, "file", in_quotes(kind), ".msi, .pln or .csv");
  }
  if (lines.failed()) return cut;
  double peak_dB = rows.front().gain_dB;
  for (const Row& row : rows) peak_dB = std::max(peak_dB, row.gain_dB);
  if (peak_dB < -kPeakTolerance_dB) {
    lines.error(ErrorClass::range, "gain", core::number_text(peak_dB) + " dB at most",
                "0 dB at the peak, within 0.5 dB");
    return cut;
  }
  for (const Row& row : rows) {
    cut.angle_rad.push_back(core::radians(row.angle_deg));
    cut.gain.push_back(core::power_from_dB(row.gain_dB - peak_dB));
  }
  return cut;
}

}  // namespace fanbeam::sensors
