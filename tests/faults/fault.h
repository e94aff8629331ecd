// One disturbance of a running program, done at a chosen moment from outside of it.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/faults/fault_page.h"
#include "tests/hostile/child_run.h"

namespace arthro::test {

enum class Fault {
  kKill,          // SIGKILL
  kEnd,           // SIGTERM, SIGINT, SIGHUP or SIGQUIT
  kFullDisk,      // the disk of results and of temporary files is filled
  kFileLimit,     // no file may grow further
  kCutPipe,       // the reader of standard output goes away
  kPulledDevice,  // the cable of the arm is pulled, and plugged in again after a second
  kLostDisplay,   // the X server is killed
  kClockForward,  // the wall clock jumps by hours to years
  kClockBack,     //
  kStall,         // two seconds of SIGSTOP
  kKilledChild    // a process that the program has started is killed
};
inline constexpr std::array kEveryFault = {
    Fault::kKill,      Fault::kEnd,          Fault::kFullDisk,    Fault::kFileLimit,
    Fault::kCutPipe,   Fault::kPulledDevice, Fault::kLostDisplay, Fault::kClockForward,
    Fault::kClockBack, Fault::kStall,        Fault::kKilledChild};
const char* ToString(Fault fault);

// Seconds of the clock that the page's times have.
double MonotonicSeconds();

// The page as a file of `folder`, mapped here.
class MappedFaultPage {
 public:
  explicit MappedFaultPage(const std::filesystem::path& folder);
  ~MappedFaultPage();
  MappedFaultPage(const MappedFaultPage&) = delete;
  MappedFaultPage& operator=(const MappedFaultPage&) = delete;
  void Reset() const;
  FaultPage& operator*() const { return *page_; }
  FaultPage* operator->() const { return page_; }
  // Lets the command load the library that reads the page.
  void AddTo(ChildCommand& command) const;

 private:
  std::filesystem::path file_;
  FaultPage* page_ = nullptr;
};

// A disk of its own over a folder, which can be filled; nothing is mounted without the right to.
class SmallDisk {
 public:
  static bool IsAllowed();
  explicit SmallDisk(std::vector<std::filesystem::path> folders);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  void Fill();
  void Free();

 private:
  std::vector<std::filesystem::path> folders_;
};

struct Disturbance {
  Fault fault = Fault::kKill;
  double at = 0;                 // s after the start, or after `begins` first held
  double strength = 0;           // 0 to 1: chooses signal, size of the jump, length of the limit
  std::function<bool()> begins;  // empty: the start of the program
  double end_after = 0;  // s; so long after the fault SIGTERM ends the program; 0: it ends itself
  // Places that some faults need.
  FaultPage* page = nullptr;
  SmallDisk* disk = nullptr;
  std::function<void()> lose_display;

  // Results.
  bool is_done = false, is_over = false;  // over: stalls and pulled cables have an end
  double done_at = 0, over_at = 0;        // MonotonicSeconds
  int signal = 0;                         // signal that was sent
  double ended_at = 0;                    // MonotonicSeconds of the program's end
};

// Runs the command and disturbs it. Standard output is a pipe that is read until the fault cuts it.
ChildRun RunDisturbed(ChildCommand command, Disturbance& disturbance);

}  // namespace arthro::test
