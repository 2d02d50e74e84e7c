// Films of pictures, through the ffmpeg program.
#include "session/products/preview.h"

#include <catch2/catch.hpp>

#include "tests/needed_program.h"
#include "tests/scenes/scene_folder.h"

using namespace fanbeam;

TEST_CASE("Pictures with an odd number of rows or columns become a film of any format",
          "[preview]") {
  if (!tests::needed_program("ffmpeg")) return;
  const tests::TemporaryFolder folder;
  for (const std::string_view format : session::kPreviewFormats)
    for (const auto& [columns, rows] : {std::pair{48, 31}, std::pair{47, 32}, std::pair{48, 32}}) {
      INFO(format << ", " << columns << " x " << rows);
      const auto file = folder.path() / ("film." + std::string(format));
      session::Preview film(file, columns, rows, 10.0);
      core::Picture8 picture{columns, rows, {}};
      picture.pixels.assign(static_cast<std::size_t>(columns * rows), 200);
      film.add(picture);
      picture.pixels.assign(picture.pixels.size(), 100);
      film.add(picture);
      film.finish();
      CHECK(std::filesystem::file_size(file) > 0);
    }
}
