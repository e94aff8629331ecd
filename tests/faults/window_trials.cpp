#include "tests/faults/window_trials.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/videoio.hpp>

#include "app/files/recovery_copy.h"
#include "authoring/project/document_io.h"
#include "simulation/core/error.h"
#include "simulation/device/log/log_format.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/faults/folder_contents.h"
#include "tests/support/own_display.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

constexpr int kEdits = 190;
constexpr double kSpacing = 0.01, kStep = 1e-4;  // m; edit k sets the incision spacing to these
constexpr double kSession = 6;                   // s from the first edit or force to the last fault
constexpr double kGoesOn = 3;                    // s after a fault that does not end the program
constexpr double kJustAfter = 0.025;             // s after a stall
constexpr const char* kScene = "scene";

bool EndsTheProgram(Fault fault) {
  return fault == Fault::kKill || fault == Fault::kEnd || fault == Fault::kLostDisplay;
}

std::string ShotName(int edit) { return fmt::format("{:04}.png", edit); }

void WriteEdits(const fs::path& script, const fs::path& shots) {
  std::ofstream out(script);
  out << "wait job\nclick Portals\n";
  for (int k = 1; k <= kEdits; ++k) {
    // A picture of the window is how the trial knows when the edit was made.
    out << fmt::format("set \"Incision spacing\" {:.1f}\nshot {}\n", 1e3 * (kSpacing + kStep * k),
                       (shots / ShotName(k)).string());
    if (k % 12 == 0) out << "key ctrl+s\nwait job\n";
  }
  // The end of a script is an end that was asked for, which keeps no copy of unsaved edits.
  out << "wait frames 1000000\n";
}

// The newest edit that a scene holds.
int EditOf(const fs::path& scene) {
  const double spacing = authoring::OpenDocument(scene).scene.portals.incision_spacing;
  return std::max(0, static_cast<int>(std::lround((spacing - kSpacing) / kStep)));
}

// A rig whose arm, at home, has the tip of the scope beyond the wall, so that it is pushed.
void WriteRig(const fs::path& rig, double radius) {
  constexpr double kRod = 0.3, kUpperArm = 0.205, kBeyond = 0.02;
  std::ofstream(rig) << fmt::format(R"({{
 "schema": "arthroscene.rig/1",
 "title": "Arm of the trials",
 "scope": {{ "device": {{ "family": "wooden_haptics", "serial": "A", "model": "woodenhaptics_2015" }},
   "rod_length": {}, "pivot": [0.025, 0, {}] }} }})",
                                    kRod, kUpperArm + kRod - radius - kBeyond);
}

}  // namespace

bool WindowTrials::IsPossible() {
  static const bool is_possible = std::system("command -v Xvfb > /dev/null 2>&1") == 0;
  return is_possible;
}

std::vector<Fault> WindowTrials::FaultsOf(const std::string& window) {
  std::vector<Fault> faults = {Fault::kKill,         Fault::kEnd,       Fault::kFullDisk,
                               Fault::kFileLimit,    Fault::kCutPipe,   Fault::kLostDisplay,
                               Fault::kClockForward, Fault::kClockBack, Fault::kStall};
  if (window == kPractise) faults.push_back(Fault::kPulledDevice);
  return faults;
}

WindowTrials::WindowTrials(const Samples& samples, const MappedFaultPage& page,
                           const WindowLimits& limits)
    : samples_(samples),
      page_(page),
      limits_(limits),
      shots_(samples.in() / "shots"),
      state_(samples.in() / "state") {
  WriteEdits(samples.in() / "edits.script", shots_);
  // The dead-man arms a device that has seen it released.
  std::ofstream(samples.in() / "hold.script") << "wait frames 20\nhold V 100000\n";
  std::ofstream(samples.in() / "look.script") << "wait job\nwait frames 5\nquit\n";
  WriteRig(samples.in() / "arm.json", ReadScene(samples.in() / "knee/scene.json").backdrop.radius);
}

ChildCommand WindowTrials::CommandOf(const std::vector<std::string>& arguments,
                                     const std::string& display) const {
  ChildCommand command = samples_.CommandOf(arguments);
  page_.AddTo(command);
  command.address_bytes = 0;  // a driver reserves at will
  for (const std::string& entry :
       {"DISPLAY=" + display, "XDG_STATE_HOME=" + state_.string(),
        "XDG_RUNTIME_DIR=" + state_.string(), std::string("LIBGL_ALWAYS_SOFTWARE=1"),
        std::string("LP_NUM_THREADS=1"), std::string("MESA_SHADER_CACHE_DISABLE=1")})
    command.environment.push_back(entry);
  return command;
}

ChildRun WindowTrials::Disturb(const Window& window, Disturbance& disturbance, Trial& trial) const {
  XServer server(samples_.in() / "xvfb.log");
  if (server.name().empty()) throw std::runtime_error("Xvfb could not be started");
  page_->has_arm = window.has_arm;
  disturbance.page = &*page_;
  disturbance.lose_display = [&] { server.Kill(); };
  disturbance.begins = window.begins;
  if (!EndsTheProgram(disturbance.fault)) disturbance.end_after = kGoesOn;
  const ChildRun run = RunDisturbed(CommandOf(window.arguments, server.name()), disturbance);

  LookAtRun(run, disturbance, trial);
  if (!disturbance.is_done)
    trial.complaints.push_back(fmt::format("ended by itself, exit code {}", run.exit_code));
  else if (disturbance.signal == 0 && run.exit_code == 0)
    trial.complaints.push_back("ended as if nothing had happened, before the trial was over");
  page_->wall_clock_offset = 0;
  page_->is_arm_pulled = 0;
  return run;
}

Trial WindowTrials::Edit(Fault fault, double moment, double strength) {
  Trial trial{kEdit, fault};
  std::optional<SmallDisk> disk;
  if (fault == Fault::kFullDisk) disk.emplace(std::vector{samples_.out(), samples_.tmp()});
  for (const fs::path& folder : {samples_.out(), samples_.tmp()}) Clear(folder);
  for (const fs::path& folder : {shots_, state_}) {
    fs::remove_all(folder);
    fs::create_directory(folder);
  }
  fs::copy(samples_.in() / "knee", samples_.out() / kScene, fs::copy_options::recursive);

  Disturbance disturbance;
  disturbance.fault = fault;
  disturbance.strength = strength;
  disturbance.disk = disk ? &*disk : nullptr;
  // A script has no recovery copy unless its place is named.
  Window window{
      {"edit", "../out/scene", "--script", "edits.script", "--recovery", Copies().string()},
      {},
      false};
  // A fifth of the moments falls into the start of the window.
  const bool is_at_start = moment < 0.2;
  trial.at = disturbance.at = is_at_start ? 10 * moment : kSession * moment;
  if (!is_at_start) window.begins = [this] { return fs::exists(shots_ / ShotName(1)); };
  Disturb(window, disturbance, trial);
  if (disk) disk->Free();
  LookAtEdits(disturbance, trial);
  LookAtNextStart({"edit", "../out/scene", "--script", "look.script"}, trial);
  return trial;
}

void WindowTrials::LookAtEdits(const Disturbance& disturbance, Trial& trial) const {
  int found = 0;
  const auto look = [&](const fs::path& scene, const char* words) {
    try {
      found = std::max(found, EditOf(scene));
    } catch (const std::exception& fault) {
      trial.complaints.push_back(std::string(words) + fault.what());
    }
  };
  look(samples_.out() / kScene, "the saved scene: ");
  for (app::RecoverySession& session : app::RecoverySession::Left(Copies())) {
    if (const auto note = session.ReadNote(); !note.problem.empty())
      trial.complaints.push_back("the recovery copy: " + note.problem);
    look(session.copy(), "the recovery copy: ");
  }
  // Edits made after the program may write no file any more cannot be kept.
  const bool counts_to_fault =
      EndsTheProgram(trial.fault) || trial.fault == Fault::kFileLimit || !disturbance.is_done;
  const double end = counts_to_fault ? disturbance.done_at : disturbance.ended_at;
  const fs::path lost = shots_ / ShotName(found + 1);
  if (!fs::exists(lost)) return;
  const std::chrono::duration<double> age =
      fs::file_time_type::clock::now() - fs::last_write_time(lost);
  trial.lost_s = std::max(0.0, end - (MonotonicSeconds() - age.count()));
  if (trial.lost_s > limits_.most_lost)
    trial.complaints.push_back(fmt::format("{:.2f} s of edits are lost", trial.lost_s));
}

Trial WindowTrials::Practise(Fault fault, double moment, double strength) {
  Trial trial{kPractise, fault};
  std::optional<SmallDisk> disk;
  if (fault == Fault::kFullDisk) disk.emplace(std::vector{samples_.out(), samples_.tmp()});
  for (const fs::path& folder : {samples_.out(), samples_.tmp()}) Clear(folder);
  fs::remove_all(state_);
  fs::create_directory(state_);
  page_.Reset();
  page_->is_hand_moving = 1;
  page_->seed = static_cast<std::uint32_t>(1000 * strength);

  Disturbance disturbance;
  disturbance.fault = fault;
  disturbance.strength = strength;
  disturbance.disk = disk ? &*disk : nullptr;
  Window window{{"practise", "knee", "--rig", "arm.json", "--log", "../out/hands.bin", "--record",
                 "../out/film.mkv", "--script", "hold.script"},
                {},
                true};
  const bool is_at_start = moment < 0.2;
  trial.at = disturbance.at = is_at_start ? 10 * moment : kSession * moment;
  // Until the arm is pushed.
  if (!is_at_start)
    window.begins = [this] {
      const std::uint32_t count = page_->writes;
      if (count == 0) return false;
      const ArmWrite& newest = page_->write[(count - 1) % kArmWrites];
      return newest.command == 0 && newest.current != std::array<std::int16_t, 3>{};
    };
  Disturb(window, disturbance, trial);
  if (disk) disk->Free();
  LookAtForces(disturbance, trial);
  if (const fs::path log = samples_.out() / "hands.bin"; fs::exists(log) && fs::file_size(log) > 0)
    try {
      simulation::ReadDeviceLog(log);
    } catch (const Error& complaint) {
      trial.complaints.push_back("the log: " + complaint.sentence());
    }
  LookAtNextStart({"practise", "knee", "--script", "look.script"}, trial);
  const fs::path film = samples_.out() / "film.mkv";
  if (fs::exists(film)) {
    cv::VideoCapture capture(film.string());
    if (!capture.isOpened() || !capture.grab())
      trial.complaints.push_back("the film has no picture");
  }
  return trial;
}

void WindowTrials::LookAtForces(const Disturbance& d, Trial& trial) const {
  const std::uint32_t count = page_->writes;
  if (count == 0 || !d.is_done) return;
  const std::uint32_t first = count > kArmWrites ? count - kArmWrites : 0;
  const auto is_force = [](const ArmWrite& write) {
    return write.command == 0 && write.current != std::array<std::int16_t, 3>{};
  };
  // Faults after which nobody may be pushed, until when.
  double until = 0;
  if (EndsTheProgram(trial.fault)) until = d.ended_at;
  if (trial.fault == Fault::kPulledDevice) until = d.ended_at;
  double last = 0;
  for (std::uint32_t i = first; i < count; ++i) {
    const ArmWrite& write = page_->write[i % kArmWrites];
    const double t = 1e-9 * static_cast<double>(write.t);
    if (is_force(write) && t <= until) last = t;
  }
  trial.force_ms = std::max(0.0, 1e3 * (last - d.done_at));
  if (trial.force_ms > limits_.longest_force_ms)
    trial.complaints.push_back(fmt::format("a force {:.0f} ms after the fault", trial.force_ms));
  // After a stall: the newest sample is old, and then there is a ramp.
  if (trial.fault == Fault::kStall && d.is_over) {
    int before = 0, after = 0;
    for (std::uint32_t i = first; i < count; ++i) {
      const ArmWrite& write = page_->write[i % kArmWrites];
      const double t = 1e-9 * static_cast<double>(write.t) - d.over_at;
      const int current = std::max(
          {std::abs(write.current[0]), std::abs(write.current[1]), std::abs(write.current[2])});
      if (write.command != 0) continue;
      if (t < -1.9) before = std::max(before, current);
      if (t > 0.002 && t < kJustAfter) after = std::max(after, current);
    }
    if (before > 0 && after > before / 4)
      trial.complaints.push_back(fmt::format("after the stall {} mA of {} mA", after, before));
  }
  const ArmWrite& newest = page_->write[(count - 1) % kArmWrites];
  if (d.signal != SIGKILL && is_force(newest))
    trial.complaints.push_back("the last report is a force");
}

void WindowTrials::LookAtNextStart(const std::vector<std::string>& arguments, Trial& trial) const {
  MakeOld(samples_.out());
  MakeOld(samples_.tmp());
  XServer server(samples_.in() / "xvfb.log");
  page_->has_arm = 0;
  const ChildRun next = RunChild(CommandOf(arguments, server.name()));
  if (next.exit_code != 0)
    trial.complaints.push_back(fmt::format("the next start ends with {}, signal {}: {}",
                                           next.exit_code, next.signal, next.err));
  for (const auto& entry : fs::recursive_directory_iterator(samples_.out())) {
    const std::string name = entry.path().filename();
    if (name.find("partial") != std::string::npos || name == ".filler" ||
        (name.starts_with(".") && !name.starts_with(".scene.backup-")))
      trial.complaints.push_back("left behind after the next start: " + name);
  }
  for (const auto& entry : fs::directory_iterator(samples_.tmp()))
    if (entry.path().filename().string().starts_with("arthroscene"))
      trial.complaints.push_back("left behind in the temporary folder: " +
                                 entry.path().filename().string());
}

}  // namespace arthro::test
