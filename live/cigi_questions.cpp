#include "live/cigi_questions.h"

namespace fanbeam::live {

void CigiQuestions::ask(const Question& question, std::uint32_t host_frame) {
  const auto [number, period] = std::visit(
      [](const auto& one) { return std::pair(one.request, one.update_period); }, question);
  const Key key(question.index(), number);
  if (period == 0) {
    if (periodic_.erase(key) > 0) std::erase(due_, key);
    if (once_.size() < kMost)
      once_.push_back({question, host_frame});
    else
      ++too_many_;
  } else if (periodic_.size() < kMost || periodic_.contains(key)) {
    Periodic& one = periodic_[key];
    one.question = question;
    one.period = period;
  } else {
    ++too_many_;
  }
}

void CigiQuestions::clear() {
  once_.clear();
  periodic_.clear();
  due_.clear();
}

void CigiQuestions::begin_frame(std::uint32_t ig_frame) {
  const auto let_wait = [&](auto from, auto to) {
    for (; from != to; ++from) {
      auto& [key, one] = *from;
      if (ig_frame % one.period != 0) continue;
      if (std::exchange(one.waits, true))
        ++periods_left_out_;
      else
        due_.push_back(key);
    }
  };
  // From behind the last one answered, so that those of a frame come again in their order: else low numbers
  // overtake those that were answered before them.
  const auto behind = periodic_.upper_bound(answered_);
  let_wait(behind, periodic_.end());
  let_wait(periodic_.begin(), behind);
}

std::optional<CigiQuestions::Asked> CigiQuestions::next(std::uint32_t host_frame) {
  if (once_.empty() && due_.empty()) return std::nullopt;
  once_had_its_turn_ = due_.empty() || (!once_.empty() && !once_had_its_turn_);
  if (once_had_its_turn_) {
    const Asked asked = once_.front();
    once_.pop_front();
    return asked;
  }
  answered_ = due_.front();
  due_.pop_front();
  Periodic& one = periodic_.at(answered_);
  one.waits = false;
  return Asked{one.question, host_frame};
}

}  // namespace fanbeam::live
