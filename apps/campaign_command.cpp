#include "apps/campaign_command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>

#include "apps/campaign_plan.h"
#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "apps/progress.h"
#include "apps/stop_on_signals.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/stop.h"
#include "core/text.h"
#include "datasets/campaign.h"
#include "datasets/draw.h"
#include "datasets/ledger.h"
#include "datasets/merge.h"
#include "datasets/slurm.h"
#include "datasets/worker.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using datasets::Campaign;
using CampaignTask = CampaignOptions::Task;

CLI::App& add_task(CLI::App& campaign, CampaignOptions& options, CampaignTask task,
                   const char* name, const char* what) {
  CLI::App& command = *campaign.add_subcommand(name, what);
  add_file(command, "FILE", options.file, "Campaign (docs/campaigns.md)")->required();
  command.callback([&options, task] { options.task = task; });
  return command;
}

void add_output(CLI::App& command, CampaignOptions& options) {
  add_output_option(command, options.output,
                    "Folder of the campaign (default out/<campaign's name>)");
}

void add_runs(CLI::App& command, CampaignOptions& options) {
  command
      .add_option("--runs", options.runs,
                  "These alone, such as 3,17,40:43 (B of A:B is not meant; default: all)")
      ->type_name("RUNS");
}

void add_run(CLI::App& campaign, CampaignOptions& options) {
  CLI::App& run = add_task(campaign, options, CampaignTask::run, "run",
                           "Render the runs that are not there yet");
  add_output(run, options);
  add_runs(run, options);
  run.add_option(
         "--shard", options.shard,
         "Part K of N: every N-th of the runs. Others may work on the same folder meanwhile, "
         "on the same part too")
      ->type_name("K/N");
  run.add_flag("--replace", options.replace, "Make runs again that are there: verify tells which");
  add_data_option(run, options.data, kDataOrder);
  add_threads_option(run, options.threads);
}

void add_slurm(CLI::App& campaign, CampaignOptions& options) {
  CLI::App& slurm = add_task(campaign, options, CampaignTask::slurm, "slurm",
                             "Write a script that has Slurm do all of it");
  add_file(slurm, "-o,--output", options.output, "Script (default job.sh)");
  add_folder(slurm, "--folder", options.folder,
             "Folder of the campaign, which all nodes share (default out/<campaign's name>)");
  add_whole_number(slurm, "--tasks", options.tasks, {1, 100'000},
                   "Processes of the job array, a node each")
      ->capture_default_str();
  add_data_option(slurm, options.data, kDataOrder);
  add_whole_number(slurm, "--threads", options.threads, {0, 1024},
                   "Processors of each process (default: a node for itself)");
}

CLI::App& declare_campaign(CLI::App& program, CampaignOptions& options) {
  CLI::App& campaign = *program.add_subcommand(
      "campaign",
      "Thousands of labelled approaches: drawn conditions, on one machine or a cluster");
  campaign.require_subcommand(1);
  CLI::App& plan =
      add_task(campaign, options, CampaignTask::plan, "plan",
               "What there is to do: runs, frames, disk, hours, what would be refused");
  plan.add_flag(
      "--pilot,!--no-pilot", options.pilot,
      "Render a few runs of up to four scenes to measure time and disk (the default), or do "
      "not");
  add_data_option(plan, options.data, kDataOrder);
  add_threads_option(plan, options.threads);
  add_run(campaign, options);
  CLI::App& status =
      add_task(campaign, options, CampaignTask::status, "status", "How far it is; others may work");
  add_output(status, options);
  status.add_flag("--json", options.json, "For programs");
  CLI::App& merge =
      add_task(campaign, options, CampaignTask::merge, "merge",
               "Write index.csv, manifest.json, coco.json and lard.csv of all runs there");
  add_output(merge, options);
  CLI::App& verify = add_task(campaign, options, CampaignTask::verify, "verify",
                              "Check every file against its hash, and tell what repairs the rest");
  add_output(verify, options);
  add_runs(verify, options);
  add_folder(verify, "--data", options.data, "That of the runs, for the command that repairs them");
  add_slurm(campaign, options);
  return campaign;
}

Campaign read_checked(const CampaignOptions& options, const CommonOptions& common) {
  const bool looks = options.task == CampaignTask::status || options.task == CampaignTask::merge ||
                     options.task == CampaignTask::verify;
  core::ProblemList problems;
  Campaign campaign =
      looks ? datasets::read_campaign(options.file, problems, datasets::ReadFor::looking)
            : datasets::read_campaign(options.file, problems, datasets::ReadFor::making,
                                      shipped_folder());
  check_data_folder(options.data, problems);
  problems.throw_if_errors();
  if (!common.isa.empty() && common.isa != core::short_name_of(campaign.isa))
    core::throw_input_error(core::ErrorClass::range, "--isa", common.isa,
                            fmt::format("{}, which the campaign's file says, or none",
                                        core::short_name_of(campaign.isa)));
  if (!common.quiet) print_problems(problems.all());
  return campaign;
}

fs::path folder_of(const std::string& told, const Campaign& campaign) {
  return told.empty() ? core::default_output_folder(campaign.name) : fs::path(told);
}

std::vector<int> chosen_runs(const CampaignOptions& options, const Campaign& campaign) {
  if (!options.runs.empty()) return datasets::runs_in(options.runs, campaign.runs, "--runs");
  std::vector<int> runs(static_cast<std::size_t>(campaign.runs));
  std::iota(runs.begin(), runs.end(), 0);
  return runs;
}

void warn_of_change(const Campaign& campaign, const CommonOptions& common) {
  if (common.quiet) return;
  core::ProblemList problems;
  problems.warning("CHANGED", core::Place{campaign.file.string()}, "campaign",
                   "changed since runs were made that are there",
                   "they stay as they are, and merge takes no mixture: --replace makes them again");
  print_problems(problems.all());
}

struct Made {
  int made = 0, elsewhere = 0, there = 0;
  std::vector<int> failed;
};

Made make_runs(datasets::Worker& worker, const std::vector<int>& runs, const fs::path& output,
               const CommonOptions& common, const Campaign& campaign) {
  Made counts;
  bool tells_change = !common.quiet;  // once
  Progress progress(campaign.name, static_cast<int>(runs.size()), common.quiet, "runs");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    core::throw_if_stopped();
    const datasets::RunEnd end = worker.make(runs[i]);
    if (!common.quiet) print_problems(worker.new_warnings());
    switch (end) {
      case datasets::RunEnd::made:
        ++counts.made;
        break;
      case datasets::RunEnd::elsewhere:
        ++counts.elsewhere;
        break;
      case datasets::RunEnd::failed:
        counts.failed.push_back(runs[i]);
        spdlog::error("run {} failed: {}", runs[i],
                      datasets::failed_file(output, runs[i]).string());
        break;
      case datasets::RunEnd::there:
        ++counts.there;
        if (tells_change && datasets::was_made_by_other_file(campaign, output, runs[i])) {
          warn_of_change(campaign, common);
          tells_change = false;
        }
        break;
    }
    progress.step(static_cast<int>(i) + 1);
  }
  return counts;
}

int run(const CampaignOptions& options, const CommonOptions& common, const Campaign& campaign) {
  const core::ThreadLimit threads(options.threads);
  const fs::path output = folder_of(options.output, campaign);
  const std::vector<int> runs = datasets::by_scene(
      campaign, datasets::shard_of(chosen_runs(options, campaign), options.shard, "--shard"));
  datasets::Worker worker(campaign,
                          {output, shipped_folder(), data_folders(options.data), options.replace});
  const StopOnSignals stop_on_signals;
  const Made counts = make_runs(worker, runs, output, common, campaign);
  if (!common.quiet)
    fmt::print("{} of {} runs made, {} there before, {} made by others now, {} failed: {}\n",
               counts.made, runs.size(), counts.there, counts.elsewhere, counts.failed.size(),
               full_path(output));
  return counts.failed.empty() ? kExitDone : kExitInvalidInput;
}

int status(const CampaignOptions& options, const CommonOptions& common, const Campaign& campaign) {
  const datasets::Status found = datasets::status_of(campaign, folder_of(options.output, campaign));
  if (found.changed) warn_of_change(campaign, common);
  if (options.json) {
    const nlohmann::ordered_json json = {
        {"campaign", campaign.name},    {"runs", found.runs},     {"made", found.made},
        {"under_way", found.under_way}, {"failed", found.failed}, {"missing", found.missing()}};
    fmt::print("{}\n", json.dump(1));
  } else {
    fmt::print("{}: {} of {} runs there, {} under way, {} failed, {} missing\n", campaign.name,
               found.made, found.runs, found.under_way, found.failed, found.missing());
  }
  return kExitDone;
}

int merge(const CampaignOptions& options, const CommonOptions& common, const Campaign& campaign) {
  const fs::path output = folder_of(options.output, campaign);
  const datasets::Merged merged = datasets::merge(campaign, output);
  if (common.quiet) return kExitDone;
  fmt::print("{} of {} runs, {} frames\n", merged.runs, campaign.runs, merged.frames);
  for (const fs::path& file : merged.files) fmt::print("{}\n", full_path(file));
  const auto names_pictures = [](const fs::path& file) { return file.filename() == "coco.json"; };
  if (campaign.archives && std::any_of(merged.files.begin(), merged.files.end(), names_pictures))
    fmt::print(
        "coco.json and lard.csv name pictures as they lie when the archives are unpacked:\n"
        "for t in {}/*.tar; do mkdir -p \"${{t%.tar}}\" && tar -xf \"$t\" -C \"${{t%.tar}}\"; "
        "done\n",
        core::shell_word((output / "runs").string()));
  return kExitDone;
}

int verify(const CampaignOptions& options, const CommonOptions& common, const Campaign& campaign) {
  const std::vector<int> runs = chosen_runs(options, campaign);
  const std::vector<datasets::Damage> damages =
      datasets::verify(campaign, folder_of(options.output, campaign), runs);
  std::vector<int> wrong;
  for (const datasets::Damage& damage : damages) {
    fmt::print("run {}: {}\n", damage.run, damage.what);
    const bool again = damage.run < campaign.runs;  // those beyond cannot be made
    if (again && (wrong.empty() || wrong.back() != damage.run)) wrong.push_back(damage.run);
  }
  if (damages.empty()) {
    if (!common.quiet) fmt::print("{} runs, every file as recorded\n", runs.size());
    return kExitDone;
  }
  if (wrong.empty()) return kExitCompareFailed;
  const std::string folder =
      options.output.empty() ? "" : " -o " + core::shell_word(options.output);
  const std::string data = options.data.empty() ? "" : " --data " + core::shell_word(options.data);
  fmt::print(
      "{} of {} runs are to be made again:\nfanbeam campaign run {}{}{} --runs {} --replace\n",
      wrong.size(), runs.size(), core::shell_word(options.file), folder, data,
      datasets::runs_text(wrong));
  return kExitCompareFailed;
}

int slurm(const CampaignOptions& options, const CommonOptions& common, const Campaign& campaign) {
  Campaign placed = campaign;
  placed.file = fs::absolute(campaign.file).lexically_normal();
  const fs::path script = options.output.empty() ? fs::path("job.sh") : fs::path(options.output);
  refuse_output_among({placed.file}, script, "--output");
  core::write_file_atomically(
      script, datasets::slurm_script(
                  placed, {fs::read_symlink("/proc/self/exe"),
                           fs::absolute(folder_of(options.folder, campaign)).lexically_normal(),
                           options.data.empty() ? "" : fs::absolute(options.data).string(),
                           options.tasks, options.threads}));
  if (!common.quiet) fmt::print("bash {}\n", core::shell_word(script.string()));
  return kExitDone;
}

int campaign(const CampaignOptions& options, const CommonOptions& common) {
  const Campaign campaign = read_checked(options, common);
  using Work = int (*)(const CampaignOptions&, const CommonOptions&, const Campaign&);
  constexpr Work kWorks[] = {plan_campaign, run, status, merge, verify, slurm};  // as CampaignTask
  return kWorks[static_cast<std::size_t>(options.task)](options, common, campaign);
}

}  // namespace

void add_campaign(CommandLine& line) { line.add(declare_campaign, campaign); }

}  // namespace fanbeam::apps
