// Ends jobs that write at random moments and looks at what they leave: every output must be the
// earlier one or the new one, whole, and after the next run nothing of the ended process may
// remain.
//   hostile_kills [--count 15] [--seed 1] [--job WORDS]
// With a display (DISPLAY) the editor is among the jobs: it saves a scene again and again.
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <random>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/videoio.hpp>

#include "simulation/core/atomic_file.h"
#include "tests/hostile/complaints.h"
#include "tests/hostile/samples.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;  // name -> bytes

constexpr std::array<int, 5> kSignals = {SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGQUIT};

struct WritingJob {
  std::string name;
  std::vector<std::string> arguments, earlier_arguments;  // the second makes the earlier results
  std::vector<std::string> outputs;                       // names in ../out; folders end with /
  bool is_film = false;   // the next run saves what was filmed under a name of its own
  bool is_scene = false;  // the output is a scene that is edited in place
};

Files FilesIn(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder)] = ReadWholeFile(entry.path());
  return files;
}

void Clear(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
}

void Restore(const fs::path& folder, const Files& files) {
  Clear(folder);
  for (const auto& [name, bytes] : files) {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
}

// Reports and results hold times, so that no two are alike: what they hold instead is compared.
bool IsSame(const std::string& name, const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (!name.ends_with(".json") && !name.ends_with(".mkv")) return false;
  if (name.ends_with(".mkv")) return a.size() == b.size();  // random numbers of the container
  const auto x = nlohmann::json::parse(a, nullptr, false),
             y = nlohmann::json::parse(b, nullptr, false);
  if (x.is_discarded() || y.is_discarded() || !x.is_object() || !y.is_object()) return false;
  if (x.size() != y.size()) return false;
  for (const auto& [key, value] : x.items())
    if (!y.contains(key)) return false;
  return true;
}

class Kills {
 public:
  Kills(const fs::path& folder, std::uint64_t seed) : samples_(folder), random_(seed) {
    ListJobs();
  }

  int Run(int count, const std::string& words) {
    std::vector<WritingJob> jobs;
    for (const WritingJob& job : jobs_)
      if (job.name.find(words) != std::string::npos) jobs.push_back(job);
    if (jobs.empty()) throw std::runtime_error("there is no such job");
    for (int i = 0; i < count; ++i) RunOne(i, jobs[static_cast<std::size_t>(i) % jobs.size()]);
    fmt::print(
        "{} kills: {} ended by the signal, {} stopped with a sentence, {} were done; {} "
        "failures\n",
        count, ended_, stopped_, done_, failures_);
    return failures_ == 0 ? 0 : 1;
  }

 private:
  struct Known {
    Files earlier, now;
    double wall_s = 0;
  };

  void ListJobs() {
    const auto to = [](const char* name) { return std::string("../out/") + name; };
    const auto twice = [&](const char* name, std::vector<std::string> arguments,
                           const std::vector<std::string>& more,
                           const std::vector<std::string>& outputs) -> WritingJob& {
      WritingJob job{name, arguments, arguments, outputs};
      job.arguments.insert(job.arguments.end(), more.begin(), more.end());
      return jobs_.emplace_back(job);
    };
    twice("depth", {"depth", "pano.png", "-o", to("d.tiff")}, {"--estimator", "shading"},
          {"d.tiff"});
    twice("panorama", {"panorama", "frames", "-o", to("p.png"), "--report", to("p.json")},
          {"--leave-out", "2"}, {"p.png", "p.json"});
    twice(
        "tetrahedralize",
        {"tetrahedralize", "body.ply", "--unit", "m", "-o", to("t.vtu"), "--report", to("t.json")},
        {"--max-edge-mm", "2"}, {"t.vtu", "t.json"});
    twice("replay", {"replay", "knee", "trace.csv", "-o", to("f.csv"), "--report", to("r.json")},
          {"--static-friction", "0"}, {"f.csv", "r.json"})
        .arguments[2] = "session.bin";
    jobs_.back().arguments.resize(7);
    for (const char* film : {"film.avi", "film.mp4", "film.mkv"}) {
      twice("replay --video",
            {"replay", "knee", "trace.csv", "-o", to("f.csv"), "--video", to(film), "--video-size",
             "256", "--fps", "25"},
            {}, {"f.csv", film});
      jobs_.back().earlier_arguments.clear();  // a film that exists is never replaced
      jobs_.back().is_film = true;
    }
    twice("view", {"view", "knee", "-o", to("v.png")}, {"--roll-deg", "30"}, {"v.png"});
    twice("solve", {"solve", "block/case.json", "-o", to("s.json"), "--vtu", to("s.vtu")}, {},
          {"s.json", "s.vtu"})
        .arguments[1] = "block/moving.json";
    twice("centres", {"centres", "knee", "-o", to("c.csv"), "--picture", to("c.png")},
          {"--roll-steps", "30"}, {"c.csv", "c.png"});
    twice("rectify", {"rectify", "film.avi", "--lens", "knee/lens.json", "-o", to("flat")}, {},
          {"flat/"})
        .earlier_arguments.clear();
    twice("phantom", {"phantom", "--size", "S", "--footage-frames", "2", "-o", to("knee")},
          {"--seed", "2"}, {"knee/"});
    if (std::getenv("DISPLAY") != nullptr) {
      std::ofstream script(samples_.in() / "save.script");
      script << "wait job\nclick Portals\n";
      for (int i = 0; i < 20; ++i)
        script << "set \"Incision spacing\" " << 10 + i << "\nkey ctrl+s\nwait job\n";
      WritingJob job{"edit", {"edit", "../out/scene", "--script", "save.script"}, {}, {"scene/"}};
      job.is_scene = true;
      jobs_.push_back(job);
    }
  }

  ChildCommand CommandOf(const WritingJob& job, const std::vector<std::string>& arguments) const {
    ChildCommand command = samples_.CommandOf(arguments);
    if (job.is_scene) {
      for (const char* name : {"DISPLAY", "XAUTHORITY"})
        if (const char* value = std::getenv(name))
          command.environment.push_back(fmt::format("{}={}", name, value));
      command.environment.push_back("LIBGL_ALWAYS_SOFTWARE=1");
      command.environment.push_back("LP_NUM_THREADS=1");
      command.address_bytes = 0;  // a driver reserves at will
    }
    return command;
  }

  ChildRun Whole(const WritingJob& job, const std::vector<std::string>& arguments) const {
    const ChildRun run = RunChild(CommandOf(job, arguments));
    if (run.exit_code != 0)
      throw std::runtime_error(fmt::format("{} ends with {}, signal {}: {}",
                                           fmt::join(arguments, " "), run.exit_code, run.signal,
                                           run.err));
    return run;
  }

  // Results of the undisturbed job, before and after.
  const Known& KnownOf(const WritingJob& job) {
    const std::string line = fmt::format("{}", fmt::join(job.arguments, " "));
    if (known_.contains(line)) return known_.at(line);
    Known& known = known_[line];
    Clear(samples_.out());
    if (job.is_scene) {
      fs::copy(samples_.in() / "knee", samples_.out() / "scene", fs::copy_options::recursive);
      known.earlier = FilesIn(samples_.out());
      known.wall_s = Whole(job, job.arguments).wall_s;
      return known;
    }
    if (!job.earlier_arguments.empty()) Whole(job, job.earlier_arguments);
    known.earlier = FilesIn(samples_.out());
    Clear(samples_.out());
    known.wall_s = Whole(job, job.arguments).wall_s;
    known.now = FilesIn(samples_.out());
    return known;
  }

  void RunOne(int number, const WritingJob& job) {
    const Known& known = KnownOf(job);
    Restore(samples_.out(), known.earlier);
    Clear(samples_.tmp());
    const int signal = kSignals[random_() % kSignals.size()];
    const double at = 1.05 * known.wall_s * static_cast<double>(random_() % 10000) / 10000;
    // Every other one falls while something is being written, which takes a moment only.
    const bool waits_for_file = random_() % 2 == 0;
    bool is_sent = false;
    const ChildRun run = RunChild(CommandOf(job, job.arguments), [&](int group, double seconds) {
      if (is_sent || (waits_for_file ? !IsWriting(known.earlier) : seconds < at)) return;
      is_sent = true;
      ::kill(group, signal);
    });
    (run.signal != 0 ? ended_ : run.exit_code == 1 ? stopped_ : done_) += 1;
    std::vector<std::string> complaints;
    if (run.signal != 0 && run.signal != signal)
      complaints.push_back(fmt::format("ended by signal {}", run.signal));
    if (run.exit_code > 1) complaints.push_back(fmt::format("exit code {}", run.exit_code));
    for (const std::string& said : MessageComplaints(run.err, run.exit_code == 1))
      complaints.push_back(said);
    LookAtOutputs(job, known, run, complaints);
    // A job that was told to stop tidies up itself; one that was ended leaves that to the next.
    const bool was_told = signal != SIGKILL && signal != SIGQUIT;
    if (was_told && run.signal == 0) LookForLeftovers(job, "left behind", complaints);
    const bool is_tidy = !HasLeftovers(job);
    if (!is_tidy) {
      MakeOld(samples_.out());
      MakeOld(samples_.tmp());
      // A film that was finished would be refused its name.
      if (job.is_film) fs::remove(samples_.out() / job.outputs.back());
      const ChildRun next = RunChild(CommandOf(job, job.arguments));
      if (next.exit_code != 0 && !(job.name == "rectify" && next.exit_code == 1))
        complaints.push_back("the next run fails: " + next.err);
      for (const std::string& said : MessageComplaints(next.err, next.exit_code == 1))
        complaints.push_back("in the next run " + said);
      LookForLeftovers(job, "left behind after the next run", complaints);
      for (const auto& [name, bytes] : FilesIn(samples_.out()))
        if (name.find("recovered") != std::string::npos && !IsPlayable(samples_.out() / name))
          complaints.push_back(name + " cannot be played");
    }
    if (complaints.empty()) return;
    ++failures_;
    fmt::print(
        "FAILURE {}: {}, signal {} after {:.3f} of {:.3f} s: {}\n  exit {} signal {} stderr: {}\n",
        number, job.name, signal, at, known.wall_s,
        Printable(fmt::format("{}", fmt::join(complaints, "; "))), run.exit_code, run.signal,
        Printable(run.err));
    std::fflush(stdout);
  }

  // A file that was not there before has appeared.
  bool IsWriting(const Files& earlier) const {
    std::error_code ignored;  // names come and go
    for (const auto& entry : fs::directory_iterator(samples_.out(), ignored)) {
      const std::string name = entry.path().filename();
      const auto known = earlier.lower_bound(name);
      if (known == earlier.end() || !known->first.starts_with(name)) return true;
    }
    return !fs::is_empty(samples_.tmp(), ignored);
  }

  static bool IsOutput(const WritingJob& job, const std::string& name) {
    const std::string file_name = fs::path(name).filename().string();
    if (job.is_scene && file_name.starts_with(".scene.backup-")) return true;  // earlier saves
    if (file_name.starts_with(".")) return false;
    if (name.find("partial") != std::string::npos) return false;
    for (const std::string& output : job.outputs)
      if (name == output || (output.ends_with('/') && name.starts_with(output))) return true;
    // The film until then.
    return job.is_film && name.starts_with("film-recovered");
  }

  void LookAtOutputs(const WritingJob& job, const Known& known, const ChildRun& run,
                     std::vector<std::string>& complaints) const {
    Files files = FilesIn(samples_.out());
    std::erase_if(files, [&](const auto& file) { return !IsOutput(job, file.first); });
    if (job.is_scene) {
      const ChildRun check = RunChild(samples_.CommandOf({"check", "../out/scene"}));
      if (check.exit_code != 0) complaints.push_back("the scene is not whole: " + check.err);
      return;
    }
    if (run.exit_code == 0)
      for (const auto& [name, bytes] : known.now)
        if (!files.contains(name)) complaints.push_back("exit code 0 without " + name);
    // A folder is exchanged as a whole.
    for (const std::string& output : job.outputs) {
      bool is_earlier = true, is_now = true;
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
      if (!is_earlier && !is_now)
        complaints.push_back(output + " is neither the earlier result nor the new one");
    }
  }

  static bool IsPlayable(const fs::path& film) {
    cv::VideoCapture capture(film.string());
    return capture.isOpened() && capture.grab();
  }

  bool HasLeftovers(const WritingJob& job) const {
    for (const auto& [name, bytes] : FilesIn(samples_.out()))
      if (!IsOutput(job, name)) return true;
    return !fs::is_empty(samples_.tmp());
  }

  // Sets the time back by some hours: a young file may belong to a process of another machine.
  static void MakeOld(const fs::path& folder) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(3));
  }

  void LookForLeftovers(const WritingJob& job, const std::string& words,
                        std::vector<std::string>& complaints) const {
    for (const auto& [name, bytes] : FilesIn(samples_.out()))
      if (!IsOutput(job, name)) complaints.push_back(words + ": " + name);
    for (const auto& entry : fs::directory_iterator(samples_.tmp()))
      if (entry.path().filename().string().starts_with("arthroscene"))
        complaints.push_back(words +
                             " in the temporary folder: " + entry.path().filename().string());
  }

  Samples samples_;
  std::mt19937_64 random_;
  std::vector<WritingJob> jobs_;
  std::map<std::string, Known> known_;  // key: command line of the job
  int ended_ = 0, stopped_ = 0, done_ = 0, failures_ = 0;
};

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  int count = 15;
  std::uint64_t seed = 1;
  std::string words;
  CLI::App program("Ends jobs that write at random moments and looks at what they leave");
  program.add_option("--count", count, "Kills")->capture_default_str();
  program.add_option("--seed", seed, "Start of the random sequence")->capture_default_str();
  program.add_option("--job", words, "Only jobs that have these words in their name");
  CLI11_PARSE(program, argc, argv);
  try {
    const arthro::test::TempFolder folder;
    return arthro::test::Kills(folder.path(), seed).Run(count, words);
  } catch (const std::exception& error) {
    fmt::print(stderr, "hostile_kills: {}\n", error.what());
    return 2;
  }
}
