// A WoodenHaptics arm that the kernel believes in: virtual_arm SERIAL LOG [inside the guest]. It is
// made with uhid, sends a report each millisecond while somebody has it open, sets its counters
// when it is told to, and writes down what passes (arm_record.h). Its parent commands it by lines:
//   plug | unplug | move COUNTS | place COUNTS | freeze REPORTS
// `move`: counts of the base's encoder a report. `freeze`: stops the parent until so many
// more were sent. Each line that is done is answered by an empty one. It ends when its input does.
#include <csignal>
#include <cstddef>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <linux/uhid.h>
#include <poll.h>
#include <sched.h>
#include <span>
#include <sstream>
#include <string>
#include <sys/timerfd.h>
#include <unistd.h>

#include "simulation/device/codec/report_bytes.h"
#include "tests/device_vm/arm_record.h"

namespace {

using namespace arthro;
using simulation::PutSigned;
using simulation::SignedAt;
using test::ArmEvent;
using test::ArmRecord;

constexpr std::size_t kReport = 14;
constexpr int kPriority = 90;  // above what is tested: the arm is a machine of its own
constexpr std::int16_t kSetCounters = 1;
// Usage 1 of the first vendor page: an array of 14 bytes in, one out.
constexpr std::uint8_t kDescriptor[] = {0x06, 0x00, 0xff, 0x09, 0x01, 0xa1, 0x01, 0x15, 0x00,
                                        0x26, 0xff, 0x00, 0x75, 0x08, 0x95, 0x0e, 0x09, 0x01,
                                        0x81, 0x02, 0x95, 0x0e, 0x09, 0x01, 0x91, 0x02, 0xc0};

std::int64_t Nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000ll + now.tv_nsec;
}

class Arm {
 public:
  Arm(const char* serial, int log) : serial_(serial), log_(log) {}

  int uhid() const { return uhid_; }
  bool is_frozen() const { return waits_for_ > 0; }

  void Do(const std::string& line) {
    std::istringstream words(line);
    std::string verb;
    int number = 0;
    words >> verb >> number;
    if (verb == "plug")
      Plug();
    else if (verb == "unplug")
      Unplug();
    else if (verb == "move")
      step_ = number;
    else if (verb == "place")
      counters_[0] = static_cast<std::int16_t>(number);
    else if (verb == "freeze")
      Freeze(number);
    if (write(STDOUT_FILENO, "\n", 1) != 1) _exit(6);
  }

  void Take() {
    uhid_event event{};
    if (read(uhid_, &event, sizeof event) <= 0) return;
    if (event.type == UHID_OPEN) is_open_ = true;
    if (event.type == UHID_CLOSE) is_open_ = false;
    if (event.type != UHID_OUTPUT) return;
    ArmRecord record;
    record.size = event.u.output.size;
    // The number of the report, 0, comes first; a gadget would not see it.
    const simulation::ReportBytes bytes(&event.u.output.data[0], event.u.output.size);
    if (bytes.size() == 1 + kReport) {
      for (std::size_t i = 0; i < 3; ++i) record.currents[i] = SignedAt(bytes, 1 + 2 * i);
      record.command = SignedAt(bytes, 7);
      if (record.command == kSetCounters)
        for (std::size_t i = 0; i < 3; ++i) {
          counters_[i] = SignedAt(bytes, 9 + 2 * i);
          counters_[3 + i] = SignedAt(bytes, 1 + 2 * i);
        }
    }
    Write(ArmEvent::kTold, record);
  }

  void Tick() {
    if (uhid_ < 0 || !is_open_) return;
    counters_[0] = static_cast<std::int16_t>(counters_[0] + step_);
    uhid_event event{};
    event.type = UHID_INPUT2;
    event.u.input2.size = kReport;
    const std::span<std::uint8_t> report(&event.u.input2.data[0], kReport);
    for (std::size_t i = 0; i < 6; ++i) PutSigned(report, 2 * i, counters_[i]);
    if (write(uhid_, &event, offsetof(uhid_event, u.input2.data) + kReport) <= 0) return;
    Note(ArmEvent::kSent);
    if (!is_frozen() || --waits_for_ > 0) return;
    Note(ArmEvent::kThawed);
    kill(getppid(), SIGCONT);
  }

 private:
  void Write(ArmEvent event, ArmRecord record) {
    record.t_ns = Nanoseconds();
    record.event = event;
    record.counter = counters_[0];
    if (write(log_, &record, sizeof record) != sizeof record) _exit(3);
  }
  void Note(ArmEvent event) { Write(event, {}); }

  void Plug() {
    uhid_ = open("/dev/uhid", O_RDWR | O_CLOEXEC);
    uhid_event event{};
    event.type = UHID_CREATE2;
    auto& create = event.u.create2;
    std::strcpy(reinterpret_cast<char*>(create.name), "WoodenHaptics");
    std::strncpy(reinterpret_cast<char*>(create.uniq), serial_, sizeof create.uniq - 1);
    create.bus = BUS_USB;
    create.vendor = 0x1234;
    create.product = 0x0006;
    create.rd_size = sizeof kDescriptor;
    std::memcpy(create.rd_data, kDescriptor, sizeof kDescriptor);
    if (uhid_ < 0 || write(uhid_, &event, sizeof event) < 0) _exit(4);
    is_open_ = false;
    Note(ArmEvent::kPlugged);
  }

  void Unplug() {
    Note(ArmEvent::kUnplugged);
    uhid_event event{};
    event.type = UHID_DESTROY;
    if (write(uhid_, &event, sizeof event) < 0) _exit(5);
    close(uhid_);
    uhid_ = -1;
  }

  void Freeze(int reports) {
    kill(getppid(), SIGSTOP);
    waits_for_ = reports;
    Note(ArmEvent::kFrozen);
  }

  const char* serial_;
  int log_, uhid_ = -1, step_ = 0, waits_for_ = 0;
  bool is_open_ = false;
  std::int16_t counters_[6] = {};
};

}  // namespace

int main(int count, char** words) {
  if (count != 3) return 2;
  const int log = open(words[2], O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
  const int clock = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC);
  const itimerspec each_millisecond{{0, 1'000'000}, {0, 1'000'000}};
  if (log < 0 || timerfd_settime(clock, 0, &each_millisecond, nullptr) != 0) return 2;
  sched_param priority{};
  priority.sched_priority = kPriority;
  sched_setscheduler(0, SCHED_FIFO, &priority);

  Arm arm(words[1], log);
  std::string line;
  for (;;) {
    pollfd ready[] = {
        {clock, POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}, {arm.uhid(), POLLIN, 0}};  // −1 is left out
    if (poll(ready, 3, -1) < 0) continue;
    if (ready[2].revents & POLLIN) arm.Take();
    if (ready[0].revents & POLLIN) {
      // Ticks that were missed are left out: a board does not catch up either.
      std::uint64_t ticks = 0;
      if (read(clock, &ticks, sizeof ticks) > 0) arm.Tick();
    }
    if (ready[1].revents && !arm.is_frozen()) {
      char letter = 0;
      if (read(STDIN_FILENO, &letter, 1) <= 0) return 0;
      if (letter != '\n') {
        line += letter;
      } else {
        arm.Do(line);
        line.clear();
      }
    }
  }
}
