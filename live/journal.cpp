#include "live/journal.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace fanbeam::live {
namespace {

using nlohmann::json;

std::string hex(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

json head_of(const FlownBy& flown_by) {
  json head{{"fanbeam_live", 1},
            {"scene", flown_by.scene},
            {"from", flown_by.from.size() == 1 ? json(flown_by.from.front()) : json(flown_by.from)},
            {"rate_Hz", flown_by.rate_Hz},
            {"lockstep", flown_by.lockstep}};
  if (flown_by.sensor) head["sensor"] = *flown_by.sensor;
  if (flown_by.effects) head["effects"] = *flown_by.effects;
  return head;
}

}  // namespace

Journal::Journal(const std::filesystem::path& file, const FlownBy& flown_by)
    : file_(file, "--record", "a file that can be written, with room, and that nobody else writes"),
      head_(head_of(flown_by).dump() + "\n") {}

void Journal::begin() {
  const std::lock_guard<std::mutex> lock(writing_);
  put("");
  fault_.throw_if_errors();
}

void Journal::packet(double arrived_s, std::span<const std::uint8_t> bytes, std::size_t source) {
  json line{{"packet", hex(bytes)}, {"s", arrived_s}};
  if (source > 0) line["from"] = source;
  write(line.dump());
  throw_if_failed();
}

void Journal::frame(const Tick& tick, double samples) {
  const json line{
      {"frame", tick.number}, {"now_s", tick.now_s}, {"at_s", tick.at_s}, {"samples", samples}};
  const std::lock_guard<std::mutex> lock(writing_);
  frame_ = line.dump() + "\n";
}

void Journal::made(bool shown) {
  const std::lock_guard<std::mutex> lock(writing_);
  const std::string lines = (shown ? frame_ : "") + behind_;
  frame_.clear();
  behind_.clear();
  put(lines);
  fault_.throw_if_errors();
}

void Journal::control(const std::string& path, const std::string& body) {
  write(
      json{{"control", path}, {"body", body}}.dump(-1, ' ', true, json::error_handler_t::replace));
}

void Journal::throw_if_failed() {
  const std::lock_guard<std::mutex> lock(writing_);
  fault_.throw_if_errors();
}

void Journal::close() {
  const std::lock_guard<std::mutex> lock(writing_);
  fault_.throw_if_errors();
  file_.close();
}

// Each line at once, so that a channel that is killed leaves all that it did.
void Journal::write(const std::string& line) {
  const std::lock_guard<std::mutex> lock(writing_);
  if (frame_.empty())
    put(line + "\n");
  else
    behind_ += line + "\n";
}

void Journal::put(const std::string& text) {
  const bool closed = file_.descriptor() < 0;
  if (closed || fault_.has_errors()) return;
  try {
    if (!head_.empty()) {
      file_.begin();
      file_.write(std::exchange(head_, ""));
    }
    file_.write(text);
  } catch (const core::InputError& error) {
    fault_.append(error.problems());
  }
}

}  // namespace fanbeam::live
