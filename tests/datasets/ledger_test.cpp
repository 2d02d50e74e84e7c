// What of a campaign is there: each run once, and whose it is.
#include "datasets/ledger.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "core/errors.h"
#include "datasets/merge.h"
#include "datasets/run_lock.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;
namespace fs = std::filesystem;

namespace {

// Of eight runs, with a folder of its own.
class Ledger {
 public:
  Ledger() {
    fs::create_directories(output() / "runs");
    fs::create_directories(output() / "failed");
    core::ProblemList problems;
    campaign_ = datasets::read_campaign(
        folder_.write("campaign.toml",
                      "[campaign]\nname = \"x\"\nscenes = [\"flat-grass\"]\nruns = 8\n"),
        problems);
    problems.throw_if_errors();
  }
  fs::path output() const { return folder_.path() / "out"; }
  fs::path lock(int run) const {
    return output() / "runs" / (".00000" + std::to_string(run) + ".lock");
  }
  const datasets::Campaign& campaign() const { return campaign_; }

  void write(const std::string& name) const { folder_.write("out/" + name, ""); }
  void make(int run, const std::string& hash, const std::string& frames = "[{}]") const {
    const std::string name = "runs/00000" + std::to_string(run);
    fs::create_directories(output() / name);
    folder_.write("out/" + name + "/run.json", R"({"run":)" + std::to_string(run) +
                                                   R"(,"campaign_sha256":")" + hash +
                                                   R"(","files":{},"frames":)" + frames + "}");
  }
  datasets::Status status() const { return datasets::status_of(campaign_, output()); }

 private:
  tests::TemporaryFolder folder_;
  datasets::Campaign campaign_;
};

}  // namespace

TEST_CASE("Each run counts once: under way, made, failed or missing", "[ledger]") {
  const Ledger ledger;
  for (const int run : {0, 1, 2}) ledger.make(run, ledger.campaign().text_hash);
  ledger.write("runs/000000.txt");     // a note beside it
  ledger.write("runs/000001.tar");     // left of the other form
  ledger.write("runs/000099.tar");     // of no run of the campaign
  ledger.write("failed/000002.json");  // of an earlier try
  ledger.write("failed/000003.json");
  ledger.write("failed/000004.json");
  ledger.write("runs/.000005.lock");  // of one that was killed
  const datasets::RunLock anew(ledger.lock(2)), again(ledger.lock(4)), first(ledger.lock(6));
  const datasets::Status status = ledger.status();
  CHECK(status.runs == 8);
  CHECK(status.made == 2);       // 0, 1
  CHECK(status.under_way == 3);  // 2, 4, 6
  CHECK(status.failed == 1);     // 3
  CHECK(status.missing() == 2);  // 5, 7
  CHECK_FALSE(status.changed);
}

// The lowest run alone was looked at.
TEST_CASE("One run of another file is told, whichever it is", "[ledger]") {
  const Ledger ledger;
  for (const int run : {0, 1, 3}) ledger.make(run, ledger.campaign().text_hash);
  CHECK_FALSE(ledger.status().changed);
  ledger.make(3, "another");
  CHECK(ledger.status().changed);
}

// Runs whose records lack something were left out of their number: "3 of 1 runs".
TEST_CASE("Merging tells of how many runs some are of another file", "[ledger]") {
  const Ledger ledger;
  for (const int run : {0, 1, 3}) ledger.make(run, "another");
  ledger.make(4, ledger.campaign().text_hash);
  CHECK_THROWS_WITH(datasets::merge(ledger.campaign(), ledger.output()),
                    Catch::Contains("changed since 3 of 4 runs were made"));
}

TEST_CASE("Labels of an earlier merge go where the runs have none", "[ledger]") {
  const Ledger ledger;
  ledger.make(0, ledger.campaign().text_hash, "[]");
  for (const char* name : {"coco.json", "lard.csv"}) ledger.write(name);
  const datasets::Merged merged = datasets::merge(ledger.campaign(), ledger.output());
  CHECK(merged.runs == 1);
  for (const char* name : {"coco.json", "lard.csv"})
    CHECK_FALSE(fs::exists(ledger.output() / name));
  for (const char* name : {"index.csv", "manifest.json"}) CHECK(fs::exists(ledger.output() / name));
}

// One more than the largest int is undefined: told under the sanitizers.
TEST_CASE("Runs beyond the campaign's are refused up to the largest number", "[ledger]") {
  CHECK(datasets::runs_in("7", 8, "--runs") == std::vector<int>{7});
  CHECK(datasets::runs_in("6:8,0", 8, "--runs") == std::vector<int>{0, 6, 7});
  for (const char* text : {"8", "2147483647", "2147483646:2147483647", "7:2147483647", "3:3"}) {
    INFO(text);
    CHECK_THROWS_WITH(datasets::runs_in(text, 8, "--runs"), Catch::Contains("E-RANGE --runs"));
  }
}
