#include "apps/atmosphere_command.h"
#include "apps/campaign_command.h"
#include "apps/command_line.h"
#include "apps/compare_command.h"
#include "apps/cost_command.h"
#include "apps/doctor_command.h"
#include "apps/fmcw_command.h"
#include "apps/help_command.h"
#include "apps/init_command.h"
#include "apps/list_command.h"
#include "apps/live_command.h"
#include "apps/materials_command.h"
#include "apps/plan_command.h"
#include "apps/regress_command.h"
#include "apps/render_command.h"
#include "apps/track_command.h"
#include "apps/validate_command.h"
#include "apps/waveform_command.h"

using namespace fanbeam::apps;

int main(int argc, char** argv) {
  CommandLine line;
  line.heading("Pictures of a scene");
  line.add(add_render_command, render);
  line.add(add_plan_command, explain_plan);
  line.add(add_cost_command, cost);

  line.heading("Data sets");
  line.add(add_campaign_command, campaign);

  line.heading("Flying");
  line.add(add_live_command, fly);

  line.heading("Scenes and their checks");
  line.add(add_init_command, init_scene);
  line.add(add_validate_command, validate);
  line.add(add_doctor_command, examine_scene);

  line.heading("Comparing pictures");
  line.add(add_compare_command, compare);
  line.add(add_regress_command, regression);

  line.heading("Signals and tracks");
  line.add(add_fmcw_command, fmcw);
  line.add(add_waveform_command, waveform);
  line.add(add_track_command, track);

  line.heading("Look-ups");
  line.add(add_materials_command, materials);
  line.add(add_atmosphere_command, atmosphere);
  line.add(add_list_command, list);

  line.heading("Help");
  line.add(add_help_command, [&line](const HelpOptions& options, const CommonOptions&) {
    return help(line.program(), options);
  });
  return line.run(argc, argv);
}
