// Flights in anybody's own table: what is guessed of their columns, units and heights.
#include <cmath>

#include "core/text.h"
#include "core/units.h"
#include "scenes/new_scene/track_guess.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::scratch_file("flight.csv", fuzz::text_of(data, size));
  scenes::TrackReference reference;
  reference.threshold = {core::radians(52.0), core::radians(10.0), 80.0};
  reference.runway_length_m = 2000.0;
  reference.geoid_m = 45.0;
  reference.ground_m = [](const core::Geodetic&) { return std::optional(80.0); };
  fuzz::expect_answer([&](core::ProblemList& problems) {
    scenes::Notes notes;
    const auto guess = scenes::guess_track(file, reference, notes, problems);
    fuzz::must(guess || problems.has_errors(), "a guess or an error");
    if (!guess) return;
    fuzz::must(guess->columns.from_time_s <= guess->columns.to_time_s, "a window of time");
    fuzz::must(std::isfinite(guess->columns.height_offset_m), "a finite offset");
    for (const scenes::Note& note : notes)
      fuzz::must(core::is_printable_text(note.text), "notes are printable");
  });
  return 0;
}
