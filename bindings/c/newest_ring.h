// The newest of what one writer makes, for any number of readers that neither lock nor wait and
// never see it half written.
//
// A few slots, each with a count of the readers that hold it. The writer fills a slot that nobody
// holds and that is not the newest one, then names it the newest. A reader counts itself into the
// newest slot, copies what it wants and counts itself out. The writer may have taken that slot in
// between, or filled it with a newer frame that is not named yet; it then was no longer the newest.
// So the reader, counted in, asks again which is the newest and lets go where that is another one:
// what it would hold might be ahead of its turn, and the next one then older. That takes a frame
// within three instructions of the reader, and after kAttempts of it the reader goes home with
// nothing: a bounded number of steps, whatever others do.
//
// Contents need not be atomic: whoever counts itself in sees all that the writer did before it took
// its mark away (release, acquire), and the writer takes a slot only after the last reader's release.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>

namespace fanbeam::bindings {

template <class Content>
class NewestRing {
  struct Slot {
    std::atomic<std::uint32_t> holders{0};  // readers, and kWriting
    Content content{};
  };

 public:
  static constexpr std::uint64_t kSlots = 8;

  // A reader's hold: its content stays as it is.
  class Hold {
   public:
    Hold() = default;
    explicit Hold(Slot& slot) : slot_(&slot) {}
    Hold(Hold&& other) noexcept : slot_(std::exchange(other.slot_, nullptr)) {}
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    Hold& operator=(Hold&&) = delete;
    ~Hold() {
      if (slot_ != nullptr) slot_->holders.fetch_sub(1, std::memory_order_release);
    }
    explicit operator bool() const { return slot_ != nullptr; }
    const Content& operator*() const { return slot_->content; }
    const Content* operator->() const { return &slot_->content; }

   private:
    Slot* slot_ = nullptr;
  };

  // Every slot begins as a copy of `blank`, so that the writer need not allocate.
  explicit NewestRing(const Content& blank = {}) {
    for (Slot& slot : slots_) slot.content = blank;
  }

  // The newest, unless there is none or it has the number `have`.
  Hold other_than(std::uint64_t have) noexcept {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::uint64_t newest = newest_.load(std::memory_order_acquire);
      if (newest == 0 || newest / kSlots == have) return Hold();
      Slot& slot = slots_[newest % kSlots];
      const bool writing = (slot.holders.fetch_add(1, std::memory_order_acquire) & kWriting) != 0;
      Hold hold(slot);
      if (!writing && newest_.load(std::memory_order_relaxed) == newest) return hold;
    }
    return Hold();
  }

  // For the writer, one thread: a slot to fill; nullptr while readers hold all of them.
  Content* claim() noexcept {
    const std::uint64_t newest = newest_.load(std::memory_order_relaxed);
    for (std::uint64_t step = 1; step < kSlots; ++step) {
      const std::uint64_t index = (newest + step) % kSlots;
      std::uint32_t nobody = 0;
      if (!slots_[index].holders.compare_exchange_strong(
              nobody, kWriting, std::memory_order_acquire, std::memory_order_relaxed))
        continue;
      claimed_ = index;
      return &slots_[index].content;
    }
    return nullptr;
  }
  // What was claimed is whole. Numbers begin at 1 and rise.
  void publish(std::uint64_t number) noexcept {
    slots_[claimed_].holders.fetch_sub(kWriting, std::memory_order_release);
    newest_.store(number * kSlots + claimed_, std::memory_order_release);
  }

 private:
  static constexpr std::uint32_t kWriting = 0x80000000U;
  static constexpr int kAttempts = 16;
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free &&
                std::atomic<std::uint64_t>::is_always_lock_free);

  std::array<Slot, kSlots> slots_;
  std::atomic<std::uint64_t> newest_{0};  // its number x kSlots + its slot
  std::uint64_t claimed_ = 0;             // the writer's own
};

}  // namespace fanbeam::bindings
