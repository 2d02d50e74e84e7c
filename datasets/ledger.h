// What of a campaign is there, and whether it is whole.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/campaign.h"

namespace fanbeam::datasets {

struct Status {
  int runs = 0, made = 0, under_way = 0, failed = 0;
  int missing() const { return runs - made - under_way - failed; }
  bool changed = false;  // the campaign's file, since one of the runs there was made, or all
};
// Each run counts once: under way where somebody makes it or makes it anew, else made where it is there, else
// failed where that was told. Reads names, and records up to the first that tells of another file; others may
// work meanwhile.
Status status_of(const Campaign& campaign, const std::filesystem::path& output);

// Whether the run is there and was made before the campaign's file was changed, or by another.
bool was_made_by_other_file(const Campaign& campaign, const std::filesystem::path& output, int run);

// Numbers as ranges, "3,17,40:42": as runs_in takes them; B of A:B is not meant.
std::string runs_text(const std::vector<int>& runs);
// Throws InputError E-PARSE or E-RANGE for `field`.
std::vector<int> runs_in(const std::string& text, int runs, const std::string& field);
// Of "K/N" every N-th of the runs, beginning with the K-th; all of an empty text. Throws InputError E-RANGE
// for `field`.
std::vector<int> shard_of(const std::vector<int>& runs, const std::string& text,
                          const std::string& field);

// One line of what is wrong with a run.
struct Damage {
  int run = 0;
  std::string what;  // "missing", "bscope/00600.png: other bytes than recorded", ...
};
// Every file of every run that is there against its SHA-256; every record against its own, which those of
// earlier versions lack, and against the campaign's file, the values that it draws, level of instructions, the
// program and libraries that made most of the runs, and the files that most runs of its scene are made of. Where
// all runs are asked for, those beyond them are told too.
std::vector<Damage> verify(const Campaign& campaign, const std::filesystem::path& output,
                           const std::vector<int>& runs);

}  // namespace fanbeam::datasets
