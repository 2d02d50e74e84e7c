// What of a campaign is there: each run once, and whose it is.
#include "datasets/ledger.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

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
  void make(int run, const std::string& hash) const {
    const std::string name = "runs/00000" + std::to_string(run);
    fs::create_directories(output() / name);
    folder_.write("out/" + name + "/run.json", R"({"run":)" + std::to_string(run) +
                                                   R"(,"campaign_sha256":")" + hash +
                                                   R"(","files":{},"frames":[{}]})");
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
