// Effects of a receiver in the plan of its samples: bounds against closed forms, and decisions.
#include "renderer/plan/signal_effects.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.h"
#include "renderer/plan/plan.h"
#include "tests/renderer/test_worlds.h"

using namespace fanbeam;

namespace {

renderer::SceneFacts samples() {
  renderer::SceneFacts facts;
  facts.sensor = tests::hivision();
  facts.noise_shown = true;
  facts.signal = renderer::SignalFacts{.noise_sample_W = 2.0, .phase_noise_peak = 0.0};
  return facts;
}

const core::EffectDecision& row(const core::EffectPlan& plan, core::EffectId effect) {
  for (const core::EffectDecision& each : plan.decisions)
    if (each.effect == effect) return each;
  throw core::InternalError("no such row");
}

}  // namespace

TEST_CASE("Phase noise lifts the noise by its pedestal or takes exp(-v) of an echo", "[effects]") {
  renderer::SceneFacts facts = samples();
  facts.signal->echo_W = 1e3;
  facts.signal->phase_noise_rad = 1e-3;
  // The sum of exp(-|k| / 20) over all lags k.
  double density = 1.0;
  for (int lag = 1; lag < 2000; ++lag) density += 2.0 * std::exp(-lag / 20.0);
  facts.signal->phase_noise_peak = 1e-6 * density;
  const double lifted = 1e3 * -std::expm1(-1e-6) * density / 2.0;
  CHECK(renderer::phase_noise_bound_dB(facts) ==
        Approx(10.0 * std::log10(1.0 + lifted)).epsilon(1e-9));
  facts.signal->echo_W = 0.0;
  facts.signal->phase_noise_rad = 0.1;
  CHECK(renderer::phase_noise_bound_dB(facts) == Approx(10.0 * 0.01 / std::log(10.0)));
}

TEST_CASE("Steps that noise hides add a twelfth of their square", "[effects]") {
  renderer::SceneFacts facts = samples();  // standard deviation 1 per part
  facts.signal->adc_bits = 9;
  facts.signal->largest_sample_sqrtW = 128.0 - 6.77;  // steps of 0.5
  CHECK(renderer::quantiser_bound_dB(facts) == Approx(10.0 * std::log10(1.0 + 0.25 / 12.0)));
  facts.signal->adc_bits = 7;  // of 2
  CHECK(renderer::quantiser_bound_dB(facts) == 60.0);
  facts.signal->adc_bits = 9;
  facts.signal->full_scale_sqrtW = 256.0;  // steps of 1
  CHECK(renderer::quantiser_bound_dB(facts) == Approx(10.0 * std::log10(1.0 + 1.0 / 12.0)));
  facts.signal->full_scale_sqrtW = 127.0;  // the largest part may clip
  CHECK(renderer::quantiser_bound_dB(facts) == 60.0);
}

// A chirp of one radar may be a tone, a burst or noise in the cells: of unit weights over n samples a tone
// of amplitude a gives (n a)^2 over noise n N1, which is its energy n a^2 over N1.
TEST_CASE("Other radars lift no cell by more than the energy of their samples", "[effects]") {
  renderer::SceneFacts facts = samples();
  CHECK_FALSE(renderer::has_interference(facts));
  constexpr double kAmplitude = 0.01;
  constexpr int kSamples = 400;
  facts.signal->interference_W = kSamples * kAmplitude * kAmplitude;
  CHECK(renderer::has_interference(facts));
  const double tone = std::pow(kSamples * kAmplitude, 2) / (kSamples * 2.0);
  CHECK(renderer::interference_bound_dB(facts) == Approx(10.0 * std::log10(1.0 + tone)));
  facts.signal->beams = 12;
  CHECK(renderer::interference_bound_dB(facts) == Approx(10.0 * std::log10(1.0 + 12.0 * tone)));
  facts.signal->complex_baseband = false;
  CHECK(renderer::interference_bound_dB(facts) == Approx(10.0 * std::log10(1.0 + 24.0 * tone)));
  facts.noise_shown = false;
  CHECK(renderer::interference_bound_dB(facts) == 60.0);
}

TEST_CASE("The plan of samples decides by noise, budget and wishes", "[effects]") {
  renderer::SceneFacts facts = samples();
  core::EffectPlan plan = renderer::signal_plan({}, facts, 0.5, {});
  CHECK(plan.runs(core::EffectId::receiver_noise));
  CHECK(row(plan, core::EffectId::quantiser).reason == "no number of bits was given (--adc-bits)");
  CHECK(row(plan, core::EffectId::phase_noise).reason.find("no line width") == 0);
  CHECK(row(plan, core::EffectId::interference).reason.find("no [[interferer]]") == 0);
  facts.signal->interference_W = 0.02;  // 0.04 dB
  CHECK_FALSE(renderer::signal_plan({}, facts, 0.5, {}).runs(core::EffectId::interference));
  facts.signal->interference_W = 0.2;  // 0.4 dB
  CHECK(renderer::signal_plan({}, facts, 0.5, {}).runs(core::EffectId::interference));
  facts.signal->interference_W = 0.0;
  facts.signal->largest_sample_sqrtW = 128.0 - 6.77;
  facts.signal->adc_bits = 9;
  CHECK(renderer::signal_plan({}, facts, 0.5, {}).runs(core::EffectId::quantiser));  // 0.09 dB
  facts.signal->adc_bits = 12;
  CHECK_FALSE(renderer::signal_plan({}, facts, 0.5, {}).runs(core::EffectId::quantiser));
  // What the sequence leaves out comes first; samples that are asked for show every step.
  const core::EffectPlan spent{{{core::EffectId::gas, false, "", 0.25, 0.0}}};
  CHECK(renderer::signal_plan(spent, facts, 0.5, {}).runs(core::EffectId::quantiser));
  facts.signal->samples_asked = true;
  CHECK(renderer::signal_plan({}, facts, 0.5, {}).runs(core::EffectId::quantiser));
  facts.signal->samples_asked = false;
  const auto wished = [&](const char* text) {
    return renderer::signal_plan({}, facts, 0.5,
                                 renderer::parse_effect_wishes(text, renderer::Touches::samples));
  };
  CHECK(wished("+quantiser").runs(core::EffectId::quantiser));
  plan = wished("-receiver-noise");  // nothing hides the steps
  CHECK_FALSE(plan.runs(core::EffectId::receiver_noise));
  CHECK(plan.runs(core::EffectId::quantiser));
  CHECK_THROWS_AS(renderer::parse_effect_wishes("+quantiser"), core::InputError);
}
