#include "apps/render_command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <optional>

#include "apps/option_lists.h"
#include "apps/progress.h"
#include "apps/render_summary.h"
#include "apps/stop_on_signals.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "session/sequence.h"
#include "session/session.h"

namespace fanbeam::apps {
namespace {

scenes::BuildOptions build_options(const RenderOptions& options,
                                   const session::ProductSet& products) {
  scenes::BuildOptions build;
  build.accuracy_grey = options.accuracy_grey;
  session::plan_for(products, build);
  if (!options.effects.empty()) build.wishes = renderer::parse_effect_wishes(options.effects);
  if (options.reference) {
    build.caster = renderer::CasterWish::rays;
  } else if (!options.caster.empty()) {
    build.caster = renderer::caster_wish(options.caster);
  }
  return build;
}

session::SequenceSettings sequence_of(const RenderOptions& options,
                                      const session::ProductSet& products) {
  session::SequenceSettings settings{.output = options.output,
                                     .frames = options.frames,
                                     .products = products,
                                     .sampling = options,
                                     .range_unit = options.range_unit,
                                     .plan_per_frame = options.plan_per_frame,
                                     .resume = options.resume,
                                     .overwrite = options.overwrite};
  if (!options.preview_format.empty()) settings.preview_format = options.preview_format;
  return settings;
}

// Of products that nobody asked for they would be ignored in silence.
void refuse_options_without_product(const RenderOptions& options,
                                    const session::ProductSet& products) {
  core::ProblemList problems;
  if (!options.range_unit.empty() && !products.contains("figure") &&
      !products.contains("ppi_figure"))
    problems.error(core::ErrorClass::ref, {}, "--range-unit", options.range_unit,
                   "figure or ppi_figure among --products");
  if (!options.preview_format.empty() && !products.contains("preview"))
    problems.error(core::ErrorClass::ref, {}, "--preview-format", options.preview_format,
                   "preview among --products");
  problems.throw_if_errors();
}

}  // namespace

int render(const RenderOptions& asked, const CommonOptions& common) {
  const session::ProductSet products = products_in(asked.products, session::kProducts);
  refuse_options_without_product(asked, products);
  const core::ThreadLimit threads(asked.threads);
  core::ProblemList problems;
  const scenes::SceneDescription description = read_chosen_scene(asked, problems);
  RenderOptions options = asked;
  static_cast<session::SamplingRequest&>(options) = session::with_accuracy_of(description, asked);
  std::optional<bool> sample;
  if (!options.realisation.empty()) sample = options.realisation == "sample";
  session::Session session(
      description,
      {.build = build_options(options, products), .sample = sample, .seed = options.seed},
      problems);
  const std::shared_ptr<const scenes::Scene> scene = session.scene();
  if (!common.quiet) print_problems(problems.all());
  if (scene->trajectory && scene->trajectory->attitude_derived)
    spdlog::info("the trajectory has no full attitude: missing angles are derived from its path");
  const StopOnSignals stop_on_signals;
  try {
    std::optional<Progress> bar;
    const auto progress = frames_progress(bar, scene->description.name, common.quiet);
    const session::Sequence sequence =
        session::render_sequence(session, sequence_of(options, products), progress);
    bar.reset();
    if (!common.quiet) print_render_summary(sequence, *scene, options.accuracy_grey);
  } catch (const core::Stopped&) {
    if (!common.quiet)
      fmt::print(stderr, "stopped: frames on disk are whole, --resume goes on from there\n");
    return end_by_stop_signal();
  }
  return kExitDone;
}

}  // namespace fanbeam::apps
