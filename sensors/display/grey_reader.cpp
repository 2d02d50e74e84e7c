#include "sensors/display/grey_reader.h"

namespace fanbeam::sensors {

using core::ErrorClass;
using core::number_text;

void read_grey_mapping(core::ConfigTable& table, const RangeGate& range, Display& display) {
  using Mapping = Display::Mapping;
  constexpr core::NumberRange kLevel_dB{-400.0, 400.0};
  const bool was_power = display.mapping == Mapping::log;
  display.mapping = static_cast<Mapping>(
      table.choice("mapping", Display::kMappings, static_cast<std::size_t>(display.mapping)));
  const bool is_power = display.mapping == Mapping::log;
  const bool own_window = display.mapping != Mapping::seed && is_power != was_power;
  const auto level_dB = [&](const char* key, double usual_dB) {
    return own_window ? table.required_number(key, kLevel_dB)
                      : table.number(key, kLevel_dB, usual_dB);
  };
  display.low_dB = level_dB("low_dB", display.low_dB);
  display.high_dB = level_dB("high_dB", display.high_dB);
  const bool complete = !own_window || (table.has("low_dB") && table.has("high_dB"));
  if (complete && !(display.high_dB > display.low_dB))
    table.error(ErrorClass::range, "high_dB", number_text(display.high_dB),
                "above low_dB = " + number_text(display.low_dB));
  const auto unused = [&](const char* key, double given_dB) {
    if (display.mapping == Mapping::seed && table.has(key))
      table.warning("UNUSED", key, number_text(given_dB),
                    "ignored: mapping \"seed\" has a window of its own");
  };
  unused("low_dB", display.low_dB);
  unused("high_dB", display.high_dB);
  if (table.has("mapping") && display.mapping == Mapping::seed && !(range.minimum_m > 0.0))
    table.error(ErrorClass::range, "mapping", "\"seed\"",
                "range.minimum_m of the sensor above 0, which its strongest signal needs");
}

}  // namespace fanbeam::sensors
