#include "apps/command_line.h"
#include "apps/commands.h"

using namespace fanbeam::apps;

int main(int argc, char** argv) {
  CommandLine line;
  line.heading("Pictures of a scene");
  add_render(line);
  add_plan(line);
  add_cost(line);

  line.heading("Data sets");
  add_campaign(line);

  line.heading("Flying");
  add_live(line);

  line.heading("Scenes and their checks");
  add_init(line);
  add_validate(line);
  add_doctor(line);

  line.heading("Comparing pictures");
  add_compare(line);
  add_regress(line);

  line.heading("Signals and tracks");
  add_fmcw(line);
  add_waveform(line);
  add_track(line);

  line.heading("Look-ups");
  add_materials(line);
  add_atmosphere(line);
  add_list(line);

  line.heading("Help");
  add_help(line);
  return line.run(argc, argv);
}
