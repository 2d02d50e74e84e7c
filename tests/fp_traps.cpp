#include "tests/fp_traps.h"

#include <cstdlib>
#include <cstring>

#if defined(__x86_64__) && defined(__linux__)

#include <dlfcn.h>
#include <embree3/rtcore.h>
#include <execinfo.h>
#include <link.h>
#include <tbb/task_scheduler_observer.h>
#include <ucontext.h>
#include <unistd.h>
#include <xmmintrin.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <string_view>

extern "C" {
int __real_sigaction(int, const struct sigaction*, struct sigaction*);
void __real_rtcCommitScene(RTCScene);
void __real_rtcIntersect1(RTCScene, RTCIntersectContext*, RTCRayHit*);
void __real_rtcIntersect8(const int*, RTCScene, RTCIntersectContext*, RTCRayHit8*);
void __real_rtcIntersect16(const int*, RTCScene, RTCIntersectContext*, RTCRayHit16*);
void __real_rtcOccluded1(RTCScene, RTCIntersectContext*, RTCRay*);
void __real_rtcOccluded8(const int*, RTCScene, RTCIntersectContext*, RTCRay8*);
void __real_rtcOccluded16(const int*, RTCScene, RTCIntersectContext*, RTCRay16*);
}

namespace fanbeam::tests {
namespace {

constexpr unsigned kTrapped = _MM_MASK_INVALID | _MM_MASK_DIV_ZERO | _MM_MASK_OVERFLOW;
constexpr unsigned kFlags = _MM_EXCEPT_MASK;
constexpr greg_t kSingleStep = 0x100;

bool asked = false;

struct Code {
  std::uintptr_t begin = 0, end = 0, loaded_at = 0;
  bool holds(std::uintptr_t address) const { return address >= begin && address < end; }
};
Code program, libm;

// Called for the program first, then for each shared library.
int find_code(dl_phdr_info* object, std::size_t, void*) {
  const bool is_libm =
      std::string_view(object->dlpi_name).find("/libm.so") != std::string_view::npos;
  if (program.end != 0 && !is_libm) return 0;
  Code& code = is_libm ? libm : program;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_LOAD || (segment.p_flags & PF_X) == 0) continue;
    code.begin = object->dlpi_addr + segment.p_vaddr;
    code.end = code.begin + segment.p_memsz;
    code.loaded_at = object->dlpi_addr;
  }
  return 0;
}

struct Instruction {
  unsigned char operation = 0;
  bool vector = false;  // on all lanes of a register
};

// Of SSE and AVX, in legacy, VEX and EVEX encoding.
Instruction decoded(const unsigned char* at) {
  if (*at == 0xC5) return {at[2], (at[1] & 3) < 2};
  if (*at == 0xC4) return {at[3], (at[2] & 3) < 2};
  if (*at == 0x62) return {at[4], (at[2] & 3) < 2};
  bool scalar = false;
  for (; *at == 0x66 || *at == 0xF2 || *at == 0xF3 || (*at & 0xF0) == 0x40; ++at)
    scalar = scalar || *at == 0xF2 || *at == 0xF3;
  return {at[1], !scalar};
}

// comis, cmp, min, max, and the conversion between float and double, which only a signalling NaN
// makes invalid.
bool only_meets_nan(const Instruction& instruction) {
  const unsigned char operation = instruction.operation;
  return operation == 0x2F || operation == 0xC2 || operation == 0x5D || operation == 0x5F ||
         operation == 0x5A;
}

// The nearest caller outside libm is in the program.
bool called_by_program() {
  void* frames[32];
  const int count = backtrace(frames, 32);
  bool in_libm = false;
  for (int i = 0; i < count; ++i) {
    const auto address = reinterpret_cast<std::uintptr_t>(frames[i]);
    if (libm.holds(address)) {
      in_libm = true;
    } else if (in_libm) {
      return program.holds(address);
    }
  }
  return false;
}

const char* name_of(int code) {
  return code == FPE_FLTDIV ? "division by zero" : code == FPE_FLTOVF ? "overflow" : "invalid";
}

void report(int code, std::uintptr_t address) {
  std::fprintf(stderr, "floating-point trap: %s at %#zx of the program; called from:\n",
               name_of(code), static_cast<std::size_t>(address - program.loaded_at));
  void* frames[32];
  backtrace_symbols_fd(frames, backtrace(frames, 32), STDERR_FILENO);
}

struct sigaction of_catch {};

void on_trap(int signal, siginfo_t* info, void* context) {
  auto* const machine = static_cast<ucontext_t*>(context);
  const auto address = static_cast<std::uintptr_t>(machine->uc_mcontext.gregs[REG_RIP]);
  const bool ours = program.holds(address) || (libm.holds(address) && called_by_program());
  const Instruction instruction = decoded(reinterpret_cast<const unsigned char*>(address));
  const bool harmless = (program.holds(address) && instruction.vector) ||
                        (info->si_code == FPE_FLTINV && only_meets_nan(instruction));
  if (ours && !harmless) {
    static std::atomic_flag told = ATOMIC_FLAG_INIT;
    while (told.test_and_set()) pause();  // another thread's trap ends the process
    _mm_setcsr(_mm_getcsr() | kTrapped);
    report(info->si_code, address);
    if ((of_catch.sa_flags & SA_SIGINFO) == 0 && of_catch.sa_handler != SIG_DFL)
      of_catch.sa_handler(signal);  // tells which test it was
    std::_Exit(1);
  }
  machine->uc_mcontext.fpregs->mxcsr |= kTrapped;
  machine->uc_mcontext.gregs[REG_EFL] |= kSingleStep;
}

void after_step(int, siginfo_t*, void* context) {
  auto* const machine = static_cast<ucontext_t*>(context);
  machine->uc_mcontext.fpregs->mxcsr &= ~(kTrapped | kFlags);
  machine->uc_mcontext.gregs[REG_EFL] &= ~kSingleStep;
}

void trap_in_this_thread() { _mm_setcsr(_mm_getcsr() & ~(kTrapped | kFlags)); }

class TrapWorkers : public tbb::task_scheduler_observer {
 public:
  TrapWorkers() { observe(true); }
  void on_scheduler_entry(bool) override { trap_in_this_thread(); }
};

void handle(int signal, void (*handler)(int, siginfo_t*, void*)) {
  struct sigaction action {};
  action.sa_sigaction = handler;
  action.sa_flags = SA_SIGINFO;
  __real_sigaction(signal, &action, nullptr);
}

class HeldOff {
 public:
  HeldOff() : before_(_mm_getcsr()) {
    if (asked) _mm_setcsr(before_ | kTrapped);
  }
  ~HeldOff() {
    if (asked) _mm_setcsr(before_);
  }
  HeldOff(const HeldOff&) = delete;
  HeldOff& operator=(const HeldOff&) = delete;

 private:
  unsigned before_;
};

}  // namespace

void set_fp_traps_as_asked() {
  const char* const wish = std::getenv("FANBEAM_FP_TRAPS");
  if (wish == nullptr || std::strcmp(wish, "1") != 0) return;
  asked = true;
  void* frames[1];
  backtrace(frames, 1);  // loads the unwinder, which a signal handler could not
  dl_iterate_phdr(find_code, nullptr);
  handle(SIGFPE, on_trap);
  handle(SIGTRAP, after_step);
  trap_in_this_thread();
  static TrapWorkers workers;  // after it: oneTBB runs tasks as this thread is set when it starts
}

bool fp_traps_are_set() { return asked; }

}  // namespace fanbeam::tests

// The linker sends the test programs' calls here (--wrap, tests/CMakeLists.txt).
extern "C" {

// Catch2 handles SIGFPE around every test case: it is called when a trap is ours.
int __wrap_sigaction(int signal, const struct sigaction* action, struct sigaction* before) {
  using namespace fanbeam::tests;
  if (!asked || signal != SIGFPE) return __real_sigaction(signal, action, before);
  if (before != nullptr) *before = of_catch;
  if (action != nullptr) of_catch = *action;
  return 0;
}

void __wrap_rtcCommitScene(RTCScene scene) {
  const fanbeam::tests::HeldOff held_off;
  __real_rtcCommitScene(scene);
}
void __wrap_rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
  const fanbeam::tests::HeldOff held_off;
  __real_rtcIntersect1(scene, context, ray);
}
void __wrap_rtcIntersect8(const int* valid, RTCScene scene, RTCIntersectContext* context,
                          RTCRayHit8* rays) {
  const fanbeam::tests::HeldOff held_off;
  __real_rtcIntersect8(valid, scene, context, rays);
}
void __wrap_rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context,
                           RTCRayHit16* rays) {
  const fanbeam::tests::HeldOff held_off;
  __real_rtcIntersect16(valid, scene, context, rays);
}
void __wrap_rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  const fanbeam::tests::HeldOff held_off;
  __real_rtcOccluded1(scene, context, ray);
}
void __wrap_rtcOccluded8(const int* valid, RTCScene scene, RTCIntersectContext* context,
                         RTCRay8* rays) {
  const fanbeam::tests::HeldOff held_off;
  __real_rtcOccluded8(valid, scene, context, rays);
}
void __wrap_rtcOccluded16(const int* valid, RTCScene scene, RTCIntersectContext* context,
                          RTCRay16* rays) {
  const fanbeam::tests::HeldOff held_off;
  __real_rtcOccluded16(valid, scene, context, rays);
}

}  // extern "C"

#else

namespace fanbeam::tests {

void set_fp_traps_as_asked() {}
bool fp_traps_are_set() { return false; }

}  // namespace fanbeam::tests

#endif
