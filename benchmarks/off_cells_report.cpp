#include <fmt/core.h>

#include "benchmarks/bench_report.h"

namespace fanbeam::benchmarks {
namespace {

std::string counts_row(const AgreementFigures& line, const char* picture,
                       const std::vector<OffCell>& cells) {
  std::string out =
      fmt::format("| {}, {:.0f} m | {} | {} |", line.scene, line.distance_m, picture, cells.size());
  for (std::size_t cause = 0; cause < kOffCauses; ++cause)
    out += fmt::format(" {} |", count_of(cells, static_cast<OffCause>(cause)));
  return out + "\n";
}

std::string unexplained_lines(const AgreementFigures& line, const char* picture,
                              const std::vector<OffCell>& cells) {
  std::string out;
  for (const OffCell& cell : cells)
    if (cell.cause == OffCause::unexplained)
      out += fmt::format(
          "- {}, {:.0f} m, {}, row {}, column {}: slices {:.1f}, reference {:.1f}, second "
          "reference {:.1f}\n",
          line.scene, line.distance_m, picture, cell.row, cell.column, cell.grey,
          cell.reference_grey, cell.second_reference_grey);
  return out;
}

}  // namespace

std::string off_cells_markdown(const std::vector<AgreementFigures>& lines) {
  std::string out = fmt::format(
      "Why cells of slices are more than {0:.0f} grey levels from the reference, noise-free; the "
      "first\ncause that a further picture shows. *Reference*: a reference with another seed is "
      "more\nthan half as far from it, or within {0:.0f} levels of the cell. *Slices*: with four "
      "times the\nslices the cell comes within {0:.0f} levels of one of the two references. *Left "
      "to rays*: it does\nwhen, beside that, the azimuths that slices leave to rays are cast like "
      "the "
      "reference.\n*Border*: the two powers differ by less than {1:.0f} % of that of the brightest "
      "neighbour.\nWhat is left is listed, rows from the nearest range or the highest "
      "elevation.\n\n"
      "| view | picture | cells |",
      kClearlyOff_grey, 100.0 * kSliver);
  std::string rule = "| --- | --- | --- |";
  for (const char* name : kOffCauseNames) {
    out += fmt::format(" {} |", name);
    rule += " --- |";
  }
  out += "\n" + rule + "\n";
  std::string listed;
  for (const AgreementFigures& line : lines) {
    out +=
        counts_row(line, "B-scope", line.off.bscope) + counts_row(line, "C-scope", line.off.cscope);
    listed += unexplained_lines(line, "B-scope", line.off.bscope) +
              unexplained_lines(line, "C-scope", line.off.cscope);
  }
  return out + "\n" + (listed.empty() ? "" : listed + "\n");
}

}  // namespace fanbeam::benchmarks
