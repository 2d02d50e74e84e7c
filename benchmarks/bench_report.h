// The measured figures as Markdown: what docs/performance.md holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/bound_check.h"
#include "benchmarks/campaign_cost.h"
#include "benchmarks/default_settings.h"
#include "benchmarks/estimate_check.h"
#include "benchmarks/layer_cost.h"
#include "benchmarks/measure.h"
#include "benchmarks/plan_cost.h"
#include "benchmarks/scaling.h"
#include "benchmarks/verdict.h"
#include "benchmarks/written_sequence.h"

namespace fanbeam::benchmarks {

struct SceneFigures {
  const BenchScene* scene = nullptr;
  std::vector<SequenceFigures> sequences;
  std::vector<ViewFigures> views;
  std::vector<ScalingStep> scaling;
  std::optional<PlanFigures> plan;
};

struct Report {
  int threads = 0;
  bool quick = false;
  double other_cores = 0.0;  // MachineLoad over the whole run
  std::vector<SceneFigures> scenes;
  std::vector<AgreementFigures> agreement;  // in scenes without figures of their own
  std::optional<DefaultFigures> rain;
  std::vector<LayerCost> layers;
  std::vector<BoundCase> bounds;
  std::vector<EstimateCase> estimates;
  std::optional<CampaignFigures> campaigns;
  std::vector<std::string> skipped;  // scenes without their data
  std::vector<std::string> plots;    // files, as links of the report
  std::string notes;                 // prose to end with
};

std::string markdown(const Report& report);

// The design's targets beside the figures.
TargetRows target_rows(const Report& report);
// That of layers.
TargetRow layers_row(const std::vector<LayerCost>& costs);
TargetRow unasked_layers_row(const std::vector<LayerCost>& costs);
// Their section; `skipped`: as in Report.
std::string targets_markdown(const TargetRows& rows, const std::vector<std::string>& skipped);

// The first screen: what sixteen and ninety pictures a second cost, and which of `targets` were
// missed, and why.
std::string summary_markdown(const Report& report, const TargetRows& targets);

// Below the table of agreement: why cells of slices are apart from the reference.
std::string off_cells_markdown(const std::vector<AgreementFigures>& lines);

// A view's own section.
std::string view_markdown(const ViewFigures& figures, int threads);

// "with noise / noise-free".
std::string pair_text(double with_noise, double noise_free);

}  // namespace fanbeam::benchmarks
