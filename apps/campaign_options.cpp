#include <CLI/CLI.hpp>

#include "apps/campaign_command.h"
#include "apps/command_line.h"
#include "apps/number_check.h"
#include "apps/value_words.h"

namespace fanbeam::apps {
namespace {

using Task = CampaignOptions::Task;

CLI::App& add_task(CLI::App& campaign, CampaignOptions& options, Task task, const char* name,
                   const char* what) {
  CLI::App& command = *campaign.add_subcommand(name, what);
  command.add_option("FILE", options.file, "Campaign (docs/campaigns.md)")
      ->type_name(kFileValue)
      ->required();
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
  CLI::App& run =
      add_task(campaign, options, Task::run, "run", "Render the runs that are not there yet");
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
  CLI::App& slurm = add_task(campaign, options, Task::slurm, "slurm",
                             "Write a script that has Slurm do all of it");
  slurm.add_option("-o,--output", options.output, "Script (default job.sh)")->type_name(kFileValue);
  slurm
      .add_option("--folder", options.folder,
                  "Folder of the campaign, which all nodes share (default out/<campaign's name>)")
      ->type_name(kFolderValue);
  slurm.add_option("--tasks", options.tasks, "Processes of the job array, a node each")
      ->check(whole_number_from(1, 100'000))
      ->capture_default_str();
  add_data_option(slurm, options.data, kDataOrder);
  slurm
      .add_option("--threads", options.threads,
                  "Processors of each process (default: a node for itself)")
      ->check(whole_number_from(0, 1024));
}

}  // namespace

CLI::App& add_campaign_command(CLI::App& program, CampaignOptions& options) {
  CLI::App& campaign = *program.add_subcommand(
      "campaign",
      "Thousands of labelled approaches: drawn conditions, on one machine or a cluster");
  campaign.require_subcommand(1);
  CLI::App& plan =
      add_task(campaign, options, Task::plan, "plan",
               "What there is to do: runs, frames, disk, hours, what would be refused");
  plan.add_flag(
      "--pilot,!--no-pilot", options.pilot,
      "Render a few runs of up to four scenes to measure time and disk (the default), or do "
      "not");
  add_data_option(plan, options.data, kDataOrder);
  add_threads_option(plan, options.threads);
  add_run(campaign, options);
  CLI::App& status =
      add_task(campaign, options, Task::status, "status", "How far it is; others may work");
  add_output(status, options);
  status.add_flag("--json", options.json, "For programs");
  CLI::App& merge =
      add_task(campaign, options, Task::merge, "merge",
               "Write index.csv, manifest.json, coco.json and lard.csv of all runs there");
  add_output(merge, options);
  CLI::App& verify = add_task(campaign, options, Task::verify, "verify",
                              "Check every file against its hash, and tell what repairs the rest");
  add_output(verify, options);
  add_runs(verify, options);
  verify.add_option("--data", options.data, "That of the runs, for the command that repairs them")
      ->type_name(kFolderValue);
  add_slurm(campaign, options);
  return campaign;
}

}  // namespace fanbeam::apps
