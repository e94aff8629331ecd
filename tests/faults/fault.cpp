#include "tests/faults/fault.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <sched.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "tests/support/build_paths.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

constexpr double kStall = 2.0, kPulled = 1.0;  // s
constexpr std::array kEnds = {SIGTERM, SIGINT, SIGHUP, SIGQUIT};
// Seconds: from the hour of summer time to a battery that has run empty.
constexpr std::array<double, 4> kJumps = {3600.0, 86400.0, 3e7, 3e8};
constexpr std::array<rlim_t, 3> kFileLimits = {4096, 16384, 65536};  // bytes; a sentence fits

std::vector<int> ChildrenOf(int process) {
  std::vector<int> children;
  std::error_code ignored;
  for (const auto& task :
       fs::directory_iterator("/proc/" + std::to_string(process) + "/task", ignored)) {
    std::ifstream file(task.path() / "children");
    for (int child = 0; file >> child;) children.push_back(child);
  }
  return children;
}

template <class T>
T Choose(const std::array<T, 4>& of, double share) {
  return of[std::min<std::size_t>(3, static_cast<std::size_t>(4 * share))];
}

void LimitFiles(int process, double strength) {
  const rlim_t most = kFileLimits[std::min<std::size_t>(2, static_cast<std::size_t>(3 * strength))];
  const rlimit limit{most, most};
  ::prlimit(process, RLIMIT_FSIZE, &limit, nullptr);
}

// Does it, and says whether that was possible.
bool Do(Disturbance& d, int group, int& reader) {
  switch (d.fault) {
    case Fault::kKill:
      d.signal = SIGKILL;
      return ::kill(group, d.signal) == 0;
    case Fault::kEnd:
      d.signal = Choose(kEnds, d.strength);
      return ::kill(group, d.signal) == 0;
    case Fault::kFullDisk:
      if (d.disk == nullptr) return false;
      d.disk->Fill();
      return true;
    case Fault::kFileLimit:
      LimitFiles(group, d.strength);
      for (const int child : ChildrenOf(group)) LimitFiles(child, d.strength);
      return true;
    case Fault::kCutPipe:
      ::close(reader);
      reader = -1;
      return true;
    case Fault::kPulledDevice:
      d.page->is_arm_pulled = 1;
      return true;
    case Fault::kLostDisplay:
      d.lose_display();
      return true;
    case Fault::kClockForward:
      d.page->wall_clock_offset = static_cast<std::int64_t>(1e9 * Choose(kJumps, d.strength));
      return true;
    case Fault::kClockBack:
      d.page->wall_clock_offset = -static_cast<std::int64_t>(1e9 * Choose(kJumps, d.strength));
      return true;
    case Fault::kStall:
      return ::kill(-group, SIGSTOP) == 0;
    case Fault::kKilledChild:
      for (const int child : ChildrenOf(group)) return ::kill(child, SIGKILL) == 0;
      return false;
  }
  return false;
}

// Ends what lasts for a time.
void End(Disturbance& d, int group) {
  if (d.fault == Fault::kStall) ::kill(-group, SIGCONT);
  if (d.fault == Fault::kPulledDevice) d.page->is_arm_pulled = 0;
}

}  // namespace

const char* ToString(Fault fault) {
  switch (fault) {
    case Fault::kKill:
      return "kill";
    case Fault::kEnd:
      return "end";
    case Fault::kFullDisk:
      return "full disk";
    case Fault::kFileLimit:
      return "file limit";
    case Fault::kCutPipe:
      return "cut pipe";
    case Fault::kPulledDevice:
      return "device";
    case Fault::kLostDisplay:
      return "display";
    case Fault::kClockForward:
      return "clock +";
    case Fault::kClockBack:
      return "clock -";
    case Fault::kStall:
      return "stall";
    case Fault::kKilledChild:
      return "child";
  }
  return "";
}

double MonotonicSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

MappedFaultPage::MappedFaultPage(const fs::path& folder) : file_(folder / "fault-page") {
  const int descriptor = ::open(file_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor < 0 || ::ftruncate(descriptor, sizeof(FaultPage)) != 0)
    throw std::runtime_error("the fault page could not be made");
  void* memory =
      ::mmap(nullptr, sizeof(FaultPage), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  ::close(descriptor);
  if (memory == MAP_FAILED) throw std::runtime_error("the fault page could not be mapped");
  page_ = new (memory) FaultPage;
}

MappedFaultPage::~MappedFaultPage() { ::munmap(page_, sizeof(FaultPage)); }

void MappedFaultPage::Reset() const { new (page_) FaultPage; }

void MappedFaultPage::AddTo(ChildCommand& command) const {
  command.environment.push_back(fmt::format("{}={}", kFaultPageVariable, file_.string()));
  command.environment.push_back("LD_PRELOAD=" ARTHRO_FAULT_PRELOAD);
  // A sanitizer wants to be the first library.
  command.environment.push_back("ASAN_OPTIONS=verify_asan_link_order=0");
}

bool SmallDisk::IsAllowed() {
  // Mounts are seen by this program and its children alone.
  static const bool is_allowed =
      ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, "") == 0;
  return is_allowed;
}

SmallDisk::SmallDisk(std::vector<fs::path> folders) : folders_(std::move(folders)) {
  for (const fs::path& folder : folders_)
    if (::mount("arthro_small_disk", folder.c_str(), "tmpfs", 0, "size=64m") != 0)
      throw std::runtime_error("no disk could be mounted: " +
                               std::generic_category().message(errno));
}

SmallDisk::~SmallDisk() {
  for (const fs::path& folder : folders_) ::umount2(folder.c_str(), MNT_DETACH);
}

void SmallDisk::Fill() {
  for (const fs::path& folder : folders_) {
    const int filler = ::open((folder / ".filler").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    off_t end = 0;
    for (off_t step = 1 << 24; step >= 4096;)
      if (::posix_fallocate(filler, end, step) == 0)
        end += step;
      else
        step /= 2;
    ::close(filler);
  }
}

void SmallDisk::Free() {
  for (const fs::path& folder : folders_) ::unlink((folder / ".filler").c_str());
}

ChildRun RunDisturbed(ChildCommand command, Disturbance& d) {
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  int reader = ends[0];
  ::fcntl(reader, F_SETFL, O_NONBLOCK);
  command.out_file = ends[1];
  std::string out;
  const auto take = [&] {
    char some[4096];
    ssize_t count = 0;
    while (reader >= 0 && (count = ::read(reader, some, sizeof some)) > 0)
      out.append(some, static_cast<std::size_t>(count));
  };
  double begun = d.begins ? -1 : 0;
  ChildRun run = RunChild(command, [&](int group, double seconds) {
    take();
    if (begun < 0 && d.begins()) begun = seconds;
    if (!d.is_done && begun >= 0 && seconds >= begun + d.at) {
      const double now = MonotonicSeconds();
      d.is_done = Do(d, group, reader);
      if (d.is_done) d.done_at = now;
    }
    if (d.is_done && d.end_after > 0 && d.signal == 0 &&
        MonotonicSeconds() >= d.done_at + d.end_after) {
      d.signal = SIGTERM;
      ::kill(group, d.signal);
    }
    const double lasts = d.fault == Fault::kStall ? kStall : kPulled;
    if (d.is_done && !d.is_over && MonotonicSeconds() >= d.done_at + lasts) {
      d.is_over = true;
      d.over_at = MonotonicSeconds();
      End(d, group);
    }
  });
  d.ended_at = MonotonicSeconds();
  ::close(ends[1]);
  take();
  if (reader >= 0) ::close(reader);
  run.out = out;
  return run;
}

}  // namespace arthro::test
