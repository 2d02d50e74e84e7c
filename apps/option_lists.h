// What --products and --effects say and offer, the same for every command that has them.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "apps/value_words.h"
#include "core/effect_plan.h"
#include "core/errors.h"
#include "renderer/plan/effect_catalogue.h"
#include "session/products/products.h"

namespace fanbeam::apps {

template <class Products>
std::vector<std::string> names_of(const Products& products) {
  std::vector<std::string> names;
  for (const session::Product& product : products) names.emplace_back(product.name);
  return names;
}

// The names in a list with commas. Throws InputError E-REF for one that is none of `known`.
template <class Products>
std::set<std::string> products_in(const std::string& text, const Products& known) {
  const std::vector<std::string> names = names_of(known);
  std::set<std::string> products;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string name = text.substr(from, comma - from);
    from = comma + 1;
    if (std::find(names.begin(), names.end(), name) == names.end())
      core::throw_input_error(core::ErrorClass::ref, "--products", "\"" + name + "\"",
                              fmt::format("a list of {}", fmt::join(names, ", ")));
    products.insert(name);
  }
  return products;
}

// "A list of bscope (range over azimuth, PNG), ..."
template <class Products>
std::string products_help(const Products& products) {
  std::string text;
  for (const session::Product& product : products)
    text.append(text.empty() ? "A list of " : ", ")
        .append(product.name)
        .append(" (")
        .append(product.what)
        .append(")");
  return text;
}

// "ground-clutter, rain, gas".
inline std::string effect_names(renderer::Touches touched) {
  std::string names;
  for (const core::EffectId effect : renderer::effects_shown_in(touched))
    names.append(names.empty() ? "" : ", ").append(core::name_of(effect));
  return names;
}

// "all", "none", "+gas", "-gas" and so on.
inline std::vector<std::string> effect_wishes(renderer::Touches touched) {
  std::vector<std::string> wishes = {"all", "none"};
  const std::vector<core::EffectId> shown = renderer::effects_shown_in(touched);
  const auto add = [&](renderer::Touches kind) {
    for (const renderer::Effect& effect : renderer::effect_catalogue(kind)) {
      const bool shows = std::find(shown.begin(), shown.end(), effect.id) != shown.end();
      if (shows) wishes.push_back("+" + std::string(effect.name()));
      wishes.push_back("-" + std::string(effect.name()));
    }
  };
  add(renderer::Touches::pictures);
  if (touched == renderer::Touches::samples) add(touched);
  return wishes;
}

// --effects, alike wherever it is asked for.
inline void add_effects_option(CLI::App& command, std::string& wishes, renderer::Touches touched) {
  const bool samples = touched == renderer::Touches::samples;
  command
      .add_option(
          "--effects", wishes,
          fmt::format("all, none, or a list such as {} of the effects {} (default: what {})",
                      samples ? "+phase-noise,-gas" : "+rain,-gas", effect_names(touched),
                      samples ? "the scene and its samples call for" : "the scene calls for"))
      ->type_name("EFFECT")
      ->check(offers(effect_wishes(touched)));
}

}  // namespace fanbeam::apps
