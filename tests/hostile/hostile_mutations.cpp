// Damages every kind of file that a job reads and runs the job on it: each run must end by itself
// with exit code 0 or 1, in one sentence of the program's own, within limits of time and memory,
// and leave inputs, earlier outputs and folders as they should be.
//   hostile_mutations [--count 300] [--seed 1] [--only NUMBER] [--kind WORDS] [--keep FOLDER]
// A run of one seed is the same every time; --only repeats one of its mutations.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "tests/hostile/complaints.h"
#include "tests/hostile/samples.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  int count = 300;
  std::uint64_t seed = 1;
  int only = -1;
  std::string kind, keep;
};

std::map<std::string, std::string> FilesIn(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder)] = ReadWholeFile(entry.path());
    else
      files[fs::relative(entry.path(), folder).string() + "/"] = "";
  return files;
}

void Clear(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
}

void Write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

class Mutations {
 public:
  Mutations(const Arguments& arguments, const fs::path& folder)
      : arguments_(arguments), samples_(folder) {
    for (const SampleTarget& target : samples_.targets())
      if (target.kind.find(arguments.kind) != std::string::npos) targets_.push_back(target);
  }

  int Run() {
    if (targets_.empty()) throw std::runtime_error("there is no such kind");
    inputs_ = FilesIn(samples_.in());
    RunUndamaged();
    for (int i = 0; i < arguments_.count; ++i)
      if (arguments_.only < 0 || arguments_.only == i) RunOne(i);
    fmt::print(
        "{} mutations of seed {}: {} accepted, {} refused, {} failures; {:.0f} s of processor "
        "time, most {:.2f} s ({}) and {:.0f} MB ({}); {} took over 2 s\n",
        accepted_ + refused_ + ended_, arguments_.seed, accepted_, refused_, failures_,
        total_cpu_s_, most_cpu_s_, slowest_, most_mb_, largest_, slow_);
    return failures_ == 0 ? 0 : 1;
  }

 private:
  // Runs each job on the sample as it is; the outputs stand there before later runs.
  void RunUndamaged() {
    for (const SampleTarget& target : targets_)
      for (const SampleJob& job : target.jobs) {
        Clear(samples_.out());
        const ChildRun run = RunChild(samples_.CommandOf(job.arguments));
        if (job.exit_code >= 0 && run.exit_code != job.exit_code)
          throw std::runtime_error(fmt::format("{}: exit code {} of an undamaged file: {}",
                                               fmt::join(job.arguments, " "), run.exit_code,
                                               run.err));
        earlier_[fmt::format("{}", fmt::join(job.arguments, " "))] = FilesIn(samples_.out());
        total_cpu_s_ += run.cpu_s;
      }
  }

  void RunOne(int number) {
    // Kinds in turn, so that a short run meets all of them.
    const SampleTarget& target = targets_[static_cast<std::size_t>(number) % targets_.size()];
    const std::size_t turn = static_cast<std::size_t>(number) / targets_.size();
    const SampleJob& job = target.jobs[turn % target.jobs.size()];
    const std::string line = fmt::format("{}", fmt::join(job.arguments, " "));
    const fs::path file = samples_.in() / target.file;
    const std::string before = ReadWholeFile(file);
    const Mutation mutation = Mutate(
        before, target.format, arguments_.seed * 1000003 + static_cast<std::uint64_t>(number));
    // Every other run finds the results of an earlier one.
    Clear(samples_.out());
    Clear(samples_.tmp());
    const bool has_earlier = turn % 2 == 1 && !line.starts_with("rectify");
    if (has_earlier)
      for (const auto& [name, bytes] : earlier_.at(line)) Write(samples_.out() / name, bytes);
    Write(file, mutation.bytes);
    if (!target.packs.empty()) samples_.Pack(target.packs);

    const auto in_before = FilesIn(samples_.in());
    ChildCommand command = samples_.CommandOf(job.arguments);
    const ChildRun run = RunChild(command);
    std::vector<std::string> complaints = RunComplaints(run);
    if (FilesIn(samples_.in()) != in_before) complaints.push_back("an input was changed");
    LookAtOutputs(job, line, run, has_earlier, complaints);
    for (const auto& [name, bytes] : FilesIn(samples_.tmp()))
      complaints.push_back("left behind in the temporary folder: " + name);
    Count(run, target, number);
    if (!complaints.empty()) Report(number, target, line, mutation, run, complaints);

    Write(file, before);
    for (const auto& [name, bytes] : in_before)
      if (!inputs_.contains(name)) fs::remove_all(samples_.in() / name);
    if (!target.packs.empty()) samples_.Pack(target.packs);
  }

  void LookAtOutputs(const SampleJob& job, const std::string& line, const ChildRun& run,
                     bool has_earlier, std::vector<std::string>& complaints) const {
    const auto files = FilesIn(samples_.out());
    for (const auto& [name, bytes] : files) {
      bool is_own = false;
      for (const std::string& output : job.outputs)
        is_own = is_own || name == output || (output.ends_with('/') && name.starts_with(output));
      if (!is_own)
        complaints.push_back("left behind: " + name);
      else if (const std::string fault = NotWhole(name, bytes);
               !fault.empty() && !name.ends_with('/'))
        complaints.push_back(name + " " + fault);
      else if (run.exit_code == 1 && !job.writes_on_refusal && !has_earlier &&
               name.find('/') == std::string::npos && !name.ends_with("p.json"))
        complaints.push_back("written although it was refused: " + name);
    }
    if (run.exit_code == 1 && has_earlier && !job.writes_on_refusal)
      for (const auto& [name, bytes] : earlier_.at(line))
        if (!name.ends_with("p.json") && (!files.contains(name) || files.at(name) != bytes))
          complaints.push_back("an earlier result was changed although it was refused: " + name);
    if (run.exit_code == 0)
      for (const std::string& output : job.outputs)
        if (!files.contains(output)) complaints.push_back("exit code 0 without " + output);
  }

  void Count(const ChildRun& run, const SampleTarget& target, int number) {
    (run.exit_code == 0 ? accepted_ : run.exit_code == 1 ? refused_ : ended_) += 1;
    total_cpu_s_ += run.cpu_s;
    slow_ += run.cpu_s > 2 ? 1 : 0;
    const std::string name = fmt::format("{}, {}", number, target.kind);
    if (run.cpu_s > most_cpu_s_) most_cpu_s_ = run.cpu_s, slowest_ = name;
    if (run.peak_mb > most_mb_) most_mb_ = run.peak_mb, largest_ = name;
  }

  void Report(int number, const SampleTarget& target, const std::string& line,
              const Mutation& mutation, const ChildRun& run,
              const std::vector<std::string>& complaints) {
    ++failures_;
    fmt::print("FAILURE {} of seed {}: {}: {}\n", number, arguments_.seed, target.kind,
               fmt::join(complaints, "; "));
    fmt::print(
        "  input: {}\n  job: arthroscene {}\n  exit {} signal {}, {:.2f} s, {:.0f} MB, stderr: "
        "{}\n",
        Printable(mutation.what), line, run.exit_code, run.signal, run.cpu_s, run.peak_mb,
        Printable(run.err));
    std::fflush(stdout);
    if (arguments_.keep.empty()) return;
    const fs::path kept = fs::path(arguments_.keep) / fmt::format("{}-{}", arguments_.seed, number);
    fs::create_directories(kept);
    Write(kept / fs::path(target.file).filename(), mutation.bytes);
    if (!target.packs.empty())
      fs::copy(samples_.in() / (target.packs + ".arthro"), kept,
               fs::copy_options::overwrite_existing);
  }

  Arguments arguments_;
  Samples samples_;
  std::vector<SampleTarget> targets_;
  std::map<std::string, std::string> inputs_;
  std::map<std::string, std::map<std::string, std::string>>
      earlier_;  // key: command line of the job
  int accepted_ = 0, refused_ = 0, ended_ = 0, failures_ = 0, slow_ = 0;
  double total_cpu_s_ = 0, most_cpu_s_ = 0, most_mb_ = 0;
  std::string slowest_ = "none", largest_ = "none";
};

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  arthro::test::Arguments arguments;
  CLI::App program("Damages every kind of file that a job reads and runs the job on it");
  program.add_option("--count", arguments.count, "Mutations")->capture_default_str();
  program.add_option("--seed", arguments.seed, "Start of the random sequence")
      ->capture_default_str();
  program.add_option("--only", arguments.only, "Number of the one mutation to run");
  program.add_option("--kind", arguments.kind, "Only kinds that have these words in their name");
  program.add_option("--keep", arguments.keep, "Folder for the inputs of failures");
  CLI11_PARSE(program, argc, argv);
  try {
    const arthro::test::TempFolder folder;
    return arthro::test::Mutations(arguments, folder.path()).Run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "hostile_mutations: {}\n", error.what());
    return 2;
  }
}
