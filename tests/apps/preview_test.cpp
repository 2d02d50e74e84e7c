// The film of a run, played by ffmpeg as anybody would.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/image.h"
#include "tests/apps/program.h"
#include "tests/needed_program.h"

using namespace fanbeam;
using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kScopeColumns = 164, kScopeRows = 524,
                      kGap = 8;  // of hivision's scopes, and between the two
constexpr std::size_t kFilmColumns = 4 * kScopeColumns + kGap;  // each column twice

// The pictures of a film as 8-bit grey, one after the other.
std::string played(const fs::path& film, const fs::path& scratch) {
  const Result result = run_shell("ffmpeg -loglevel error -y -i " + quoted(film) +
                                  " -vsync passthrough -f rawvideo -pix_fmt gray " +
                                  quoted(scratch) + " 2>&1 </dev/null");
  INFO(result.output);
  REQUIRE(result.exit_code == 0);
  return bytes_of(scratch);
}

// B-scope and C-scope of a frame, as a film shows them.
std::vector<double> shown(const fs::path& out, const std::string& number) {
  std::vector<double> both(kFilmColumns * kScopeRows, 0.0);
  for (const auto& [product, left] :
       {std::pair{"bscope", std::size_t{0}}, {"cscope", 2 * kScopeColumns + kGap}}) {
    const core::Image picture = core::read_image(out / product / (number + ".png"));
    REQUIRE((picture.columns == kScopeColumns && picture.rows == kScopeRows));
    for (std::size_t row = 0; row < kScopeRows; ++row)
      for (std::size_t column = 0; column < 2 * kScopeColumns; ++column)
        both[row * kFilmColumns + left + column] =
            picture.layers[0].values[row * kScopeColumns + column / 2];
  }
  return both;
}

double rms_grey(const std::string& film, std::size_t picture, const std::vector<double>& expected) {
  double sum = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto grey = static_cast<unsigned char>(film[picture * expected.size() + i]);
    sum += std::pow(grey - expected[i], 2);
  }
  return std::sqrt(sum / static_cast<double>(expected.size()));
}

}  // namespace

TEST_CASE("A preview is a video of all frames, both scopes side by side, in their order",
          "[render]") {
  if (!needed_program("ffmpeg")) return;
  const TemporaryFolder folder;
  for (const std::string format : {"mp4", "gif", "apng"}) {
    INFO(format);
    const fs::path out = folder.path() / format;
    render("obstacle-field", out,
           "--frames 100:160:20 --rays-per-cell 1 -q --products bscope,cscope,preview "
           "--preview-format " +
               format);
    // Two folders of three pictures, the film and two records: no leftovers.
    CHECK(contents(out).size() == 2 + 6 + 3);
    const std::string film = played(out / ("preview." + format), folder.path() / "raw");
    REQUIRE(film.size() == 3 * kFilmColumns * kScopeRows);
    const std::vector<std::vector<double>> frames = {shown(out, "00100"), shown(out, "00120"),
                                                     shown(out, "00140")};
    for (std::size_t picture = 0; picture < frames.size(); ++picture)
      for (std::size_t frame = 0; frame < frames.size(); ++frame) {
        INFO("picture " << picture << ", frame " << frame);
        const double grey = rms_grey(film, picture, frames[frame]);
        // 0.7 of H.264; the frames are 6 and more from each other.
        if (picture == frame)
          CHECK(grey <= (format == "mp4" ? 1.5 : 0.0));
        else
          CHECK(grey > 4.0);
      }
  }
}
