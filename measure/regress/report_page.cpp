#include <fmt/format.h>

#include <algorithm>

#include "measure/regress/markup.h"
#include "measure/regress/page_style.h"
#include "measure/regress/report.h"
#include "session/version.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;

std::string word_of(CaseState state) {
  switch (state) {
    case CaseState::unapproved:
      return "not approved yet";
    case CaseState::failed:
      return "could not be rendered";
    default:
      return std::string(name_of(state));
  }
}

std::string badge(CaseState state) {
  return fmt::format("<span class=\"badge {}\">{}</span>", name_of(state), word_of(state));
}

std::size_t not_same(const CaseResult& result) {
  return static_cast<std::size_t>(
      std::count_if(result.pictures.begin(), result.pictures.end(),
                    [](const PictureResult& p) { return p.state != PictureState::same; }));
}

std::string summary_of(const CaseResult& result) {
  if (!result.problems.empty()) return core::to_string(result.problems.front());
  for (const PictureResult& picture : result.pictures)
    if (picture.state != PictureState::same)
      return fmt::format("{} of {} pictures; {}", not_same(result), result.pictures.size(),
                         sentence_of(picture));
  return fmt::format("{} pictures within their tolerances", result.pictures.size());
}

std::string case_table(const std::vector<CaseResult>& results) {
  std::string rows;
  for (std::size_t i = 0; i < results.size(); ++i)
    rows += fmt::format("<tr><td>{}</td><td><a href=\"#case-{}\">{}</a></td><td>{}</td></tr>\n",
                        badge(results[i].state), i + 1, markup_text(results[i].name),
                        markup_text(summary_of(results[i])));
  return "<table class=\"cases\">\n<tr><th>State</th><th>Case</th><th>What</th></tr>\n" + rows +
         "</table>\n";
}

std::string approval_text(const CaseResult& result) {
  if (!result.approval)
    return result.state == CaseState::failed ? "" : "<p>Nothing is approved for this case.</p>\n";
  const Approval& approval = *result.approval;
  return fmt::format(
      "<p class=\"soft\">Approved with fanbeam {} ({}) at {}, because:</p>\n"
      "<blockquote>{}</blockquote>\n",
      markup_text(approval.version), markup_text(approval.commit), markup_text(approval.isa),
      markup_text(approval.reason));
}

std::string changes_table(const CaseResult& result) {
  if (!result.approval || result.state == CaseState::failed) return "";
  std::string rows;
  for (const SettingChange& change : changes_of(result))
    rows += fmt::format("<tr><td><code>{}</code></td><td>{}</td><td>{}</td></tr>\n",
                        markup_text(change.key),
                        change.approved.empty() ? "(absent)" : markup_text(change.approved),
                        change.now.empty() ? "(absent)" : markup_text(change.now));
  if (rows.empty()) return "<p>No setting has changed since the approval.</p>\n";
  return "<table>\n<tr><th>Setting that changed</th><th>approved</th><th>now</th></tr>\n" + rows +
         "</table>\n";
}

std::string view(const CaseResult& result, const PictureResult& picture, PageSide side,
                 const fs::path& output) {
  const std::string path = page_picture(result.folder, picture.file, side);
  if (!fs::exists(output / path)) return "";
  const bool map = side == PageSide::difference;
  std::string caption = side == PageSide::approved   ? "approved"
                        : side == PageSide::rendered ? "new"
                                                     : "where they differ";
  // The map names its layers itself.
  if (const std::string layer = shown_layer(picture); !map && picture.layers.size() > 1)
    caption += ": " + markup_text(layer);
  const std::string shown = markup_text(path);
  return fmt::format(
      "<figure class=\"{}\"><a href=\"{}\"><img src=\"{}\" alt=\"{}: {}\"></a>"
      "<figcaption>{}</figcaption></figure>\n",
      map ? "map" : "view", shown, shown, markup_text(picture.file), caption, caption);
}

std::string figure_rows(const LayerJudgement& layer) {
  const std::string name = layer.layer == "Y" ? "grey" : layer.layer;  // as readers of PNG call it
  std::string rows;
  for (const Figure& figure : layer.figures) {
    std::string value = fmt::format("{:.4g} {}", figure.value, figure.unit);
    if (figure.name == "largest")
      value += fmt::format(" (column {}, row {})", layer.largest_column, layer.largest_row);
    rows += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=\"number{}\">{}</td><td "
        "class=\"number\">{}</td></tr>\n",
        markup_text(name), markup_text(figure.name), figure.within ? "" : " beyond", value,
        figure.allowed ? fmt::format("{:.4g} {}", *figure.allowed, figure.unit) : "any");
  }
  return rows;
}

std::string figures_table(const PictureResult& picture) {
  if (picture.layers.empty()) return "";
  std::string rows;
  for (const LayerJudgement& layer : picture.layers) rows += figure_rows(layer);
  return "<table>\n<tr><th>Layer</th><th>Figure</th><th class=\"number\">is</th>"
         "<th class=\"number\">allowed</th></tr>\n" +
         rows + "</table>\n<p class=\"soft\">" +
         (picture.tolerance ? "Tolerance: " + markup_text(picture.tolerance->reason)
                            : "No tolerance is stated: every value has to be equal.") +
         "</p>\n";
}

std::string picture_text(const CaseResult& result, const PictureResult& picture,
                         const fs::path& output) {
  if (picture.state == PictureState::same)
    return fmt::format(
        "<details><summary><code>{}</code> within its tolerance</summary>{}</details>\n",
        markup_text(picture.file), figures_table(picture));
  std::string text = fmt::format("<h3>{}</h3>\n<p>{}</p>\n<div class=\"views\">\n",
                                 markup_text(picture.file), markup_text(what_of(picture)));
  for (const PageSide side : {PageSide::approved, PageSide::rendered, PageSide::difference})
    text += view(result, picture, side, output);
  return text + "</div>\n" + figures_table(picture);
}

// What passed is folded away.
std::string section(const CaseResult& result, std::size_t number, const fs::path& output) {
  std::string text = approval_text(result) + changes_table(result);
  for (const core::Problem& problem : result.problems)
    text += "<p class=\"beyond\">" + markup_text(core::to_string(problem)) + "</p>\n";
  for (const PictureResult& picture : result.pictures)
    text += picture_text(result, picture, output);
  if (result.state == CaseState::passed)
    text = "<details><summary>" + markup_text(summary_of(result)) + "</summary>\n" + text +
           "</details>\n";
  return fmt::format("<section id=\"case-{}\">\n<h2>{} {}</h2>\n{}</section>\n", number,
                     markup_text(result.name), badge(result.state), text);
}

}  // namespace

std::string report_page(const Suite& suite, const std::vector<CaseResult>& results,
                        const fs::path& output) {
  const Verdict verdict = verdict_of(results);
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}: {1}</title>\n<style>{2}</style>\n</head>\n<body>\n"
      "<h1>{0}</h1>\n<p><span class=\"badge {3}\">{1}</span></p>\n"
      "<p class=\"soft\">fanbeam {4} ({5})</p>\n",
      markup_text(suite.name), text_of(verdict), kPageStyle,
      verdict.all_passed() ? "passed" : "differs", markup_text(session::version_text()),
      markup_text(session::commit_text()));
  text += case_table(results);
  for (std::size_t i = 0; i < results.size(); ++i) text += section(results[i], i + 1, output);
  return text + "</body>\n</html>\n";
}

}  // namespace fanbeam::measure
