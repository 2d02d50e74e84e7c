#include <CLI/CLI.hpp>

#include "apps/campaign_command.h"
#include "apps/command_line.h"
#include "apps/number_check.h"
#include "apps/value_words.h"

namespace fanbeam::apps {
namespace {

using Task = CampaignOptions::Task;

CLI::App& add_task(CLI::App& campaign, CampaignOptions& options, CommonOptions& common, Task task,
                   const char* name, const char* what) {
  CLI::App& command = *campaign.add_subcommand(name, what);
  command.add_option("FILE", options.file, "Campaign (docs/campaigns.md)")
      ->type_name(kFileValue)
      ->required();
  command.callback([&options, task] { options.task = task; });
  add_common_options(command, common);
  return command;
}

void add_output(CLI::App& command, CampaignOptions& options) {
  command
      .add_option("-o,--output", options.output,
                  "Folder of the campaign (default out/<campaign's name>)")
      ->type_name(kFolderValue);
}

void add_runs(CLI::App& command, CampaignOptions& options) {
  command
      .add_option("--runs", options.runs,
                  "These alone, such as 3,17,40:43 (B of A:B is not meant; default: all)")
      ->type_name("RUNS");
}

void add_data(CLI::App& command, CampaignOptions& options,
              const char* what =
                  "Folder with terrain and flight data, looked at before the one that FANBEAM_DATA "
                  "names") {
  command.add_option("--data", options.data, what)->type_name(kFolderValue);
}

void add_threads(CLI::App& command, CampaignOptions& options) {
  command.add_option("--threads", options.threads, "Threads to use (default: all cores)")
      ->check(whole_number_from(0, 1024));
}

void add_run(CLI::App& campaign, CampaignOptions& options, CommonOptions& common) {
  CLI::App& run = add_task(campaign, options, common, Task::run, "run",
                           "Render the runs that are not there yet");
  add_output(run, options);
  add_runs(run, options);
  run.add_option(
         "--shard", options.shard,
         "Part K of N: every N-th of the runs. Others may work on the same folder meanwhile, "
         "on the same part too")
      ->type_name("K/N");
  run.add_flag("--replace", options.replace, "Make runs again that are there: verify tells which");
  add_data(run, options);
  add_threads(run, options);
}

void add_slurm(CLI::App& campaign, CampaignOptions& options, CommonOptions& common) {
  CLI::App& slurm = add_task(campaign, options, common, Task::slurm, "slurm",
                             "Write a script that has Slurm do all of it");
  slurm.add_option("-o,--output", options.output, "Script (default job.sh)")->type_name(kFileValue);
  slurm
      .add_option("--folder", options.folder,
                  "Folder of the campaign, which all nodes share (default out/<campaign's name>)")
      ->type_name(kFolderValue);
  slurm.add_option("--tasks", options.tasks, "Processes of the job array, a node each")
      ->check(whole_number_from(1, 100'000))
      ->capture_default_str();
  add_data(slurm, options);
  slurm
      .add_option("--threads", options.threads,
                  "Processors of each process (default: a node for itself)")
      ->check(whole_number_from(0, 1024));
}

}  // namespace

CLI::App& add_campaign_command(CLI::App& program, CampaignOptions& options, CommonOptions& common) {
  CLI::App& campaign = *program.add_subcommand(
      "campaign",
      "Thousands of labelled approaches: drawn conditions, on one machine or a cluster");
  campaign.require_subcommand(1);
  CLI::App& plan =
      add_task(campaign, options, common, Task::plan, "plan",
               "What there is to do: runs, frames, disk, hours, what would be refused");
  plan.add_flag(
      "--pilot,!--no-pilot", options.pilot,
      "Render a few runs of up to four scenes to measure time and disk (the default), or do "
      "not");
  add_data(plan, options);
  add_threads(plan, options);
  add_run(campaign, options, common);
  CLI::App& status =
      add_task(campaign, options, common, Task::status, "status", "How far it is; others may work");
  add_output(status, options);
  status.add_flag("--json", options.json, "For programs");
  CLI::App& merge =
      add_task(campaign, options, common, Task::merge, "merge",
               "Write index.csv, manifest.json, coco.json and lard.csv of all runs there");
  add_output(merge, options);
  CLI::App& verify = add_task(campaign, options, common, Task::verify, "verify",
                              "Check every file against its hash, and tell what repairs the rest");
  add_output(verify, options);
  add_runs(verify, options);
  add_data(verify, options, "That of the runs, for the command that repairs them");
  add_slurm(campaign, options, common);
  add_common_options(campaign, common);
  return campaign;
}

}  // namespace fanbeam::apps
