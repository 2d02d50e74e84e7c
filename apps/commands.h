// The commands: each adds itself, with the options that it takes and what it runs.
#pragma once

namespace fanbeam::apps {

class CommandLine;

void add_atmosphere(CommandLine& line);
void add_campaign(CommandLine& line);
void add_compare(CommandLine& line);
void add_cost(CommandLine& line);
void add_doctor(CommandLine& line);
void add_fmcw(CommandLine& line);
void add_help(CommandLine& line);
void add_init(CommandLine& line);
void add_list(CommandLine& line);
void add_live(CommandLine& line);
void add_materials(CommandLine& line);
void add_plan(CommandLine& line);
void add_regress(CommandLine& line);
void add_render(CommandLine& line);
void add_track(CommandLine& line);
void add_validate(CommandLine& line);
void add_waveform(CommandLine& line);

}  // namespace fanbeam::apps
