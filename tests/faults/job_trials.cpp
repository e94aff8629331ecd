#include "tests/faults/job_trials.h"

#include <algorithm>
#include <csignal>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/videoio.hpp>

#include "simulation/core/error.h"
#include "simulation/device/log/log_format.h"
#include "tests/hostile/complaints.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

bool IsOutput(const FaultedJob& job, const std::string& name) {
  const std::string file_name = fs::path(name).filename().string();
  // Earlier saves, and the journal of a database that was killed.
  if (!job.in_place.empty() && file_name.starts_with(".scene.backup-")) return true;
  if (!job.in_place.empty() && name == job.in_place + "-journal") return true;
  if (file_name.starts_with(".")) return false;
  if (name.find("partial") != std::string::npos) return false;
  for (const std::string& output : job.outputs)
    if (name == output || (output.ends_with('/') && name.starts_with(output))) return true;
  return job.is_film && name.starts_with("film-recovered");  // the film until then
}

bool IsPlayable(const fs::path& film) {
  cv::VideoCapture capture(film.string());
  return capture.isOpened() && capture.grab();
}

// An effect on the result that is none of the program's fault: what was written is not to be had.
bool HidesOutput(Fault fault) { return fault == Fault::kKilledChild; }

bool MustBeDone(Fault fault) {
  return fault == Fault::kClockForward || fault == Fault::kClockBack || fault == Fault::kStall ||
         fault == Fault::kPulledDevice;
}

}  // namespace

ChildCommand JobTrials::CommandOf(const FaultedJob& job,
                                  const std::vector<std::string>& arguments) const {
  ChildCommand command = samples_.CommandOf(arguments);
  page_.AddTo(command);
  page_->has_arm = job.has_arm;
  // A window's driver reserves at will.
  if (!job.in_place.empty()) {
    command.address_bytes = 0;
    for (const char* const entry :
         {"LIBGL_ALWAYS_SOFTWARE=1", "LP_NUM_THREADS=1", "MESA_SHADER_CACHE_DISABLE=1"})
      command.environment.push_back(entry);
  }
  return command;
}

ChildRun JobTrials::Whole(const FaultedJob& job, const std::vector<std::string>& arguments) const {
  const ChildRun run = RunChild(CommandOf(job, arguments));
  if (run.exit_code != job.exit_code && !(job.is_log && run.exit_code == 1))
    throw std::runtime_error(fmt::format("{} ends with {}, signal {}: {}",
                                         fmt::join(arguments, " "), run.exit_code, run.signal,
                                         run.err));
  return run;
}

const JobTrials::Known& JobTrials::KnownOf(const FaultedJob& job,
                                           const std::vector<std::string>& arguments) {
  const std::string line = fmt::format("{}", fmt::join(arguments, " "));
  if (known_.contains(line)) return known_.at(line);
  Known known;
  page_->wall_clock_offset = 0;
  const auto begin = [&] {
    Clear(samples_.out());
    if (!job.in_place.empty())
      fs::copy(samples_.in() / job.in_place, samples_.out() / job.in_place,
               fs::copy_options::recursive);
  };
  begin();
  if (!job.earlier.empty()) Whole(job, job.earlier);
  known.earlier = FilesIn(samples_.out());
  begin();
  known.wall_s = Whole(job, arguments).wall_s;
  known.now = FilesIn(samples_.out());
  return known_[line] = std::move(known);
}

Trial JobTrials::Run(const FaultedJob& job, Fault fault, double moment, double strength) {
  const bool is_piped = fault == Fault::kCutPipe && !job.piped.empty();
  const auto& arguments = is_piped ? job.piped : job.arguments;
  const Known& known = KnownOf(job, arguments);
  Trial trial{job.name, fault};
  page_->wall_clock_offset = 0;
  page_->is_arm_pulled = 0;
  page_->writes = 0;
  std::optional<SmallDisk> disk;
  if (fault == Fault::kFullDisk) disk.emplace(std::vector{samples_.out(), samples_.tmp()});
  Restore(samples_.out(), known.earlier);
  Clear(samples_.tmp());

  // Every other one falls while something is being written, which takes a moment only.
  Disturbance disturbance;
  disturbance.fault = fault;
  disturbance.page = &*page_;
  disturbance.disk = disk ? &*disk : nullptr;
  disturbance.strength = strength;
  const bool waits_for_file = static_cast<int>(1000 * moment) % 2 == 0;
  trial.at = disturbance.at = (waits_for_file ? 0.05 : 1.05) * moment * known.wall_s;
  if (waits_for_file) disturbance.begins = [&] { return IsWriting(known.earlier); };
  if (fault == Fault::kKilledChild) disturbance.at = 0;
  const ChildRun run = RunDisturbed(CommandOf(job, arguments), disturbance);

  if (disk) disk->Free();
  LookAtEnd(job, run, disturbance, trial);
  LookAtOutputs(job, known, run, trial);
  // A job that was told to stop tidies up itself; one that was ended leaves that to the next.
  const bool was_ended = run.signal != 0;
  if (!was_ended && !job.is_film)
    for (const std::string& name : Leftovers(job))
      trial.complaints.push_back("left behind: " + name);
  page_->wall_clock_offset = 0;
  page_->is_arm_pulled = 0;
  if (!Leftovers(job).empty() || !fs::is_empty(samples_.tmp())) LookAtNextRun(job, trial);
  return trial;
}

void JobTrials::LookAtEnd(const FaultedJob& job, const ChildRun& run,
                          const Disturbance& disturbance, Trial& trial) const {
  LookAtRun(run, disturbance, trial);
  if ((!disturbance.is_done || MustBeDone(disturbance.fault)) && !job.is_log &&
      run.exit_code != job.exit_code)
    trial.complaints.push_back(
        fmt::format("exit code {} in place of {}", run.exit_code, job.exit_code));
}

void JobTrials::LookAtOutputs(const FaultedJob& job, const Known& known, const ChildRun& run,
                              Trial& trial) const {
  if (!job.check.empty()) {
    ChildCommand command = CommandOf(job, job.check);
    page_->wall_clock_offset = 0;
    const ChildRun check = RunChild(command);
    if (check.exit_code != 0)
      trial.complaints.push_back(job.in_place + " is not whole: " + check.out + check.err);
    return;
  }
  Files files = FilesIn(samples_.out());
  std::erase_if(files, [&](const auto& file) { return !IsOutput(job, file.first); });
  if (run.exit_code == 0)
    for (const auto& [name, bytes] : known.now)
      if (!files.contains(name)) trial.complaints.push_back("exit code 0 without " + name);
  if (job.is_log) {
    for (const auto& [name, bytes] : files) {
      try {
        simulation::ReadDeviceLog(samples_.out() / name);
      } catch (const Error& fault) {
        if (!bytes.empty()) trial.complaints.push_back(fault.sentence());
      }
    }
    return;
  }
  // A folder is exchanged as a whole.
  for (const std::string& output : job.outputs) {
    bool is_earlier = true, is_now = true, is_whole = true;
    const auto in_output = [&](const std::string& name) {
      return output.ends_with('/') ? name.starts_with(output) : name == output;
    };
    const auto compare = [&](const Files& expected, bool& is_it) {
      for (const auto& [name, bytes] : expected)
        if (in_output(name))
          is_it = is_it && files.contains(name) && IsSame(name, files.at(name), bytes);
      for (const auto& [name, bytes] : files)
        if (in_output(name)) is_it = is_it && expected.contains(name);
    };
    compare(known.earlier, is_earlier);
    compare(known.now, is_now);
    for (const auto& [name, bytes] : files)
      if (in_output(name)) is_whole = is_whole && NotWhole(name, bytes).empty();
    if (!is_earlier && !is_now && !(HidesOutput(trial.fault) && is_whole))
      trial.complaints.push_back(output + " is neither the earlier result nor the new one");
    // One that this way of calling the job writes elsewhere stays as it was.
    const bool is_written =
        std::ranges::any_of(known.now, [&](const auto& file) { return in_output(file.first); });
    if (run.exit_code == 0 && (is_written ? !is_now : !is_earlier) && !HidesOutput(trial.fault))
      trial.complaints.push_back(output + " is not the new result, and the exit code is 0");
  }
}

void JobTrials::LookAtNextRun(const FaultedJob& job, Trial& trial) const {
  MakeOld(samples_.out());
  MakeOld(samples_.tmp());
  // A film that was finished would be refused its name.
  if (job.is_film) fs::remove(samples_.out() / job.outputs.back());
  const ChildRun next = RunChild(CommandOf(job, job.arguments));
  if (next.exit_code != job.exit_code &&
      !((job.earlier.empty() || job.is_log) && next.exit_code == 1))
    trial.complaints.push_back("the next run fails: " + next.err);
  for (const std::string& said : MessageComplaints(next.err, next.exit_code == 1))
    trial.complaints.push_back("in the next run " + said);
  for (const std::string& name : Leftovers(job))
    trial.complaints.push_back("left behind after the next run: " + name);
  for (const auto& entry : fs::directory_iterator(samples_.out()))
    if (entry.path().filename().string().find("recovered") != std::string::npos &&
        !IsPlayable(entry.path()))
      trial.complaints.push_back(entry.path().filename().string() + " cannot be played");
}

std::vector<std::string> JobTrials::Leftovers(const FaultedJob& job) const {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : FilesIn(samples_.out()))
    if (!IsOutput(job, name)) names.push_back(name);
  for (const auto& entry : fs::directory_iterator(samples_.tmp())) {
    // Locks stay: a file that is removed could be locked twice.
    if (entry.path().extension() == ".lock") continue;
    if (entry.path().filename().string().starts_with("arthroscene"))
      names.push_back("in the temporary folder: " + entry.path().filename().string());
  }
  return names;
}

bool JobTrials::IsWriting(const Files& earlier) const {
  std::error_code ignored;  // names come and go
  for (const auto& entry : fs::directory_iterator(samples_.out(), ignored)) {
    const std::string name = entry.path().filename();
    const auto known = earlier.lower_bound(name);
    if (known == earlier.end() || !known->first.starts_with(name)) return true;
  }
  return !fs::is_empty(samples_.tmp(), ignored);
}

}  // namespace arthro::test
