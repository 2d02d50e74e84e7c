#include "datasets/slurm.h"

#include <fmt/format.h>

#include "core/text.h"

namespace fanbeam::datasets {

std::string slurm_script(const Campaign& campaign, const SlurmSettings& settings) {
  const std::string command =
      fmt::format("{} campaign", core::shell_word(settings.program.string()));
  const std::string rest = fmt::format("{} -o {}", core::shell_word(campaign.file.string()),
                                       core::shell_word(settings.output.string()));
  const std::string data =
      settings.data.empty() ? "" : " --data " + core::shell_word(settings.data);
  const std::string processors =
      settings.threads > 0 ? fmt::format(" --cpus-per-task={}", settings.threads) : " --exclusive";
  return fmt::format(R"(#!/bin/bash
# fanbeam campaign {name}: {runs} runs in {tasks} shards. Call it (bash, not sbatch) where sbatch is.
# Further options of sbatch may follow: bash job.sh --partition=all --time=4:00:00
set -euo pipefail
log={log}
mkdir -p "$log"

array=$(sbatch --parsable --job-name={name} --array=1-{tasks} --ntasks=1 --requeue --open-mode=append \
  --output="$log/shard-%a.txt"{processors} "$@" <<'JOB'
#!/bin/bash
exec {command} run {rest}{data} --shard "$SLURM_ARRAY_TASK_ID/{tasks}" --threads "${{SLURM_CPUS_PER_TASK:-0}}" -q
JOB
)
merge=$(sbatch --parsable --job-name={name}-merge --dependency=afterany:$array --ntasks=1 --requeue \
  --output="$log/merge.txt" "$@" <<'JOB'
#!/bin/bash
exec {command} merge {rest}
JOB
)
verify=$(sbatch --parsable --job-name={name}-verify --dependency=afterany:$merge --ntasks=1 --requeue \
  --output="$log/verify.txt" "$@" <<'JOB'
#!/bin/bash
exec {command} verify {rest}{data}
JOB
)
echo "$array $merge $verify"
)",
                     fmt::arg("name", campaign.name), fmt::arg("runs", campaign.runs),
                     fmt::arg("tasks", settings.tasks),
                     fmt::arg("log", core::shell_word((settings.output / "slurm").string())),
                     fmt::arg("processors", processors), fmt::arg("command", command),
                     fmt::arg("rest", rest), fmt::arg("data", data));
}

}  // namespace fanbeam::datasets
