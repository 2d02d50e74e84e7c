// The bash completion, run by bash.
#include <algorithm>
#include <set>

#include "renderer/plan/effect_catalogue.h"
#include "session/products/products.h"
#include "tests/apps/commands.h"

using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

class Bash {
 public:
  Bash() {
    const Result script = run_fanbeam("help --bash-completion");
    REQUIRE(script.exit_code == 0);
    folder_.write("completion", script.output);
  }

  const fs::path& folder() const { return folder_.path(); }

  // What is offered for the last of `words`, which the shell has parted as bash parts a line.
  std::set<std::string> offered(const std::string& words) const {
    folder_.write("ask",
                  "set -u\nsource ./completion\nCOMP_WORDS=(" + words +
                      ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_fanbeam fanbeam\n"
                      "if ((${#COMPREPLY[@]})); then printf '%s\\n' \"${COMPREPLY[@]}\"; fi\n");
    const Result answer =
        run_shell("cd " + quoted(folder()) +
                  " && PATH='" FANBEAM_BINARY_DIR "/bin':\"$PATH\" bash ./ask 2>&1");
    INFO(words << ": " << answer.output);
    REQUIRE(answer.exit_code == 0);
    std::set<std::string> lines;
    std::istringstream stream(answer.output);
    for (std::string line; std::getline(stream, line);) lines.insert(line);
    return lines;
  }

 private:
  TemporaryFolder folder_;
};

using Words = std::set<std::string>;

}  // namespace

TEST_CASE("bash completes every command and every option of it", "[cli][completion]") {
  const Bash bash;
  for (const ManPage& page : man_pages()) {
    Words options;
    for (const ManOption& option : page.options) {
      std::istringstream names(option.tag);  // "-o, --output FOLDER", "--html, --no-html"
      for (std::string name; names >> name;) {
        if (name.ends_with(',')) name.pop_back();
        if (name.starts_with("--")) options.insert(name);
      }
    }
    const Words offered = bash.offered("fanbeam " + page.command + " --");
    INFO(page.command);
    CHECK((offered == options));
    if (page.command.empty() || page.command.find(' ') != std::string::npos) continue;
    CHECK(bash.offered("fanbeam ''").count(page.command) == 1);
    CHECK(bash.offered("fanbeam help " + page.command).count(page.command) == 1);
  }
  CHECK((bash.offered("fanbeam re") == Words{"render"} ||
         bash.offered("fanbeam re") == Words{"regress", "render"}));
  CHECK((bash.offered("fanbeam materials ''") == Words{"plot", "fit", "objects"}));
}

TEST_CASE("bash completes values of options, also behind an equals sign and in lists",
          "[cli][completion]") {
  const Bash bash;
  CHECK((bash.offered("fanbeam render --caster ''") == Words{"rays", "profile", "auto"}));
  CHECK((bash.offered("fanbeam render --caster = p") == Words{"profile"}));
  CHECK((bash.offered("fanbeam render --caster =") == Words{"rays", "profile", "auto"}));
  CHECK((bash.offered("fanbeam render --caster rays --realisation m") == Words{"mean"}));
  Words products, wishes = {"all", "none"};
  for (const auto& product : fanbeam::session::kProducts) products.emplace(product.name);
  for (const auto& effect : fanbeam::renderer::effect_catalogue())
    for (const char* sign : {"+", "-"}) wishes.insert(sign + std::string(effect.name()));
  CHECK((bash.offered("fanbeam render --products ''") == products));
  CHECK((bash.offered("fanbeam render --products bscope,cs") ==
         Words{"bscope,cscope", "bscope,cscope_layers", "bscope,cscope_masks"}));
  CHECK((bash.offered("fanbeam plan --effects ''") == wishes));
  CHECK((bash.offered("fanbeam render --effects +rain,-gas,-dou") ==
         Words{"+rain,-gas,-double-bounce"}));
  // Of fanbeam fmcw the samples show no echo of rain: it can be left out alone.
  CHECK((bash.offered("fanbeam fmcw --effects +rai") == Words{"+rain"}));
  CHECK(
      (bash.offered("fanbeam fmcw --effects +gas,-rai") == Words{"+gas,-rain", "+gas,-rain-echo"}));
  CHECK((bash.offered("fanbeam fmcw --effects +phase") == Words{"+phase-noise"}));
  CHECK((bash.offered("fanbeam cost --parts ladder,eff") == Words{"ladder,effects"}));
  CHECK(bash.offered("fanbeam render --seed ''").empty());
  CHECK((bash.offered("fanbeam waveform tri") == Words{"triangle"}));
}

TEST_CASE("bash completes scenes, sensors and materials that ship, files and folders",
          "[cli][completion]") {
  const Bash bash;
  fs::create_directories(bash.folder() / "flat hills");
  std::ofstream(bash.folder() / "flat.json") << "{}";
  CHECK((bash.offered("fanbeam render flat") == Words{"flat-grass", "flat hills"}));
  // 0:10 is three words to bash, and none of them the scene.
  CHECK((bash.offered("fanbeam render --frames 0 : 10 flat-") == Words{"flat-grass"}));
  CHECK(bash.offered("fanbeam render flat-grass flat").empty());
  CHECK(
      (bash.offered("fanbeam render --sensor hivision-") == Words{"hivision-94", "hivision-seed"}));
  CHECK((bash.offered("fanbeam render --data flat") == Words{"flat hills"}));
  CHECK((bash.offered("fanbeam track flat") == Words{"flat-grass", "flat.json", "flat hills"}));
  CHECK((bash.offered("fanbeam materials plot short_grass asphalt_smooth ''").count("concrete") ==
         1));
  CHECK((bash.offered("fanbeam materials plot asphalt_sm") ==
         Words{"asphalt_smooth", "asphalt_smooth_wet"}));
  CHECK((bash.offered("fanbeam list s") == Words{"scenes", "sensors"}));
}
