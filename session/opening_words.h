// What a program says in words when it opens a session, as the bindings take it.
#pragma once

#include <string>

#include "core/errors.h"
#include "session/session.h"

namespace fanbeam::session {

// Wishes about effects (renderer::parse_effect_wishes) and caster (of kCasterWishes), each empty for the
// scene's, into `setup`, whose realisation was told before. What is wrong goes to `problems`, as of the
// fields `prefix` + "effects" and `prefix` + "caster".
void take_words(const std::string& effects, const std::string& caster, const std::string& prefix,
                Setup& setup, core::ProblemList& problems);

}  // namespace fanbeam::session
