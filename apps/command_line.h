// What each command takes from the command line: its options, which of them go together, its help.
// An option that would do nothing beside the others given is refused, with exit code 2.
#pragma once

namespace CLI {
class App;
}

namespace fanbeam::apps {

struct AtmosphereOptions;
struct CommonOptions;
struct CostOptions;
struct DoctorOptions;
struct FmcwOptions;
struct MaterialsFitOptions;
struct MaterialsOptions;
struct MaterialsPlotOptions;
struct PlanOptions;
struct RenderOptions;
struct TrackOptions;
struct WaveformOptions;

// --version, --quiet and --log-level, which every command and subcommand has (--help is CLI11's).
void add_common_options(CLI::App& command, CommonOptions& common);

// Each adds its command to `app`. What is given may be read once the command line was parsed.
void add_render_command(CLI::App& app, RenderOptions& options, CommonOptions& common);
void add_plan_command(CLI::App& app, PlanOptions& options, CommonOptions& common);
void add_atmosphere_command(CLI::App& app, AtmosphereOptions& options, CommonOptions& common);
void add_cost_command(CLI::App& app, CostOptions& options, CommonOptions& common);
void add_doctor_command(CLI::App& app, DoctorOptions& options, CommonOptions& common);
void add_fmcw_command(CLI::App& app, FmcwOptions& options, CommonOptions& common);
void add_track_command(CLI::App& app, TrackOptions& options, CommonOptions& common);
void add_waveform_command(CLI::App& app, WaveformOptions& options, CommonOptions& common);
// Its own subcommands are plot, fit and objects.
void add_materials_command(CLI::App& app, MaterialsOptions& options, MaterialsPlotOptions& plot,
                           MaterialsFitOptions& fit, CommonOptions& common);

}  // namespace fanbeam::apps
