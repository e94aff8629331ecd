// The files that a job of the command line reads and writes, declared beside its flags, and the one
// rule for all jobs: no output is an input, and an existing file is replaced only where it is the
// job's own kind of result or where --overwrite is given.
//
//   const auto files = JobFiles::Of(*job);
//   files->Input(job->add_option("PANORAMA", …));
//   files->Output(job->add_option("-o,--output", …), kDepthMapFile);
//   files->Run([own] { … });
//
// The help shows INPUT and OUTPUT in place of a type, and a test holds every flag of every job
// against that.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/file_kind.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace arthro::app {

// Files that an input stands for beside itself; input_files.h has the kinds.
struct InputKind {
  std::vector<std::filesystem::path> (*files_of)(const std::filesystem::path&) = nullptr;
  // True where a new picture of this name in the input's folder would become part of the input.
  bool (*takes)(const std::filesystem::path&) = nullptr;
};

inline constexpr FileKind kPictureFile{"a picture", FileForm::kPicture};
inline constexpr FileKind kDepthMapFile{"a depth map", FileForm::kDepthMap};
inline constexpr FileKind kVolumeFile{"a mesh of tetrahedra", FileForm::kVolume};
inline constexpr FileKind kPlotFile{"a plot", FileForm::kPlot};
inline constexpr FileKind kForcesFile{"a table of forces", FileForm::kTable, "t,device,tip_x,"};
inline constexpr FileKind kReplayReportFile{"a report", FileForm::kJson, "arthroscene.replay/"};
inline constexpr FileKind kLogFile{"a log", FileForm::kUnique};
inline constexpr FileKind kFilmFile{"a film", FileForm::kUnique};

class JobFiles : public std::enable_shared_from_this<JobFiles> {
 public:
  // Adds --overwrite to `job`, which outlives this; but not to a job that has a rule of its own for
  // each of its outputs.
  static std::shared_ptr<JobFiles> Of(CLI::App& job, bool has_overwrite = true);

  CLI::Option* Input(CLI::Option* option, const InputKind& kind = {});
  // One file. "-" is standard output and never checked.
  CLI::Option* Output(CLI::Option* option, const FileKind& kind);
  // The same, with "name-2.png" and on beside "name.png".
  CLI::Option* OutputPieces(CLI::Option* option, const FileKind& kind);
  // A film; a folder or pattern for its pictures is checked by CheckFilm.
  CLI::Option* OutputFilm(CLI::Option* option);
  // A folder that the job makes or fills: the names of files in it, as regular expressions, and
  // their kinds. Without any, the job has a rule of its own for a folder that exists.
  using NamedKinds = std::vector<std::pair<std::string, FileKind>>;
  CLI::Option* OutputFolder(CLI::Option* option, NamedKinds names = {});
  // A scene, as a folder or an archive. `file_of` gives its file, as SceneFile.
  using FileOfScene = std::filesystem::path (*)(const std::filesystem::path&);
  CLI::Option* OutputScene(CLI::Option* option, FileOfScene file_of);

  // Sets the job's callback: the check, then `run`.
  void Run(std::function<void()> run);

  bool overwrites() const { return overwrites_; }
  // A device log never replaces what is in a file, so one that is to be overwritten is emptied.
  void EmptyLog(const std::filesystem::path& log) const;
  // Throws Error where an output would destroy one of `inputs`, which a job came to know by reading
  // others.
  void RefuseToOverwrite(const std::vector<std::filesystem::path>& inputs) const;

 private:
  enum class OutputForm { kFile, kPieces, kFilm, kFolder, kScene };
  struct NamedInput {
    CLI::Option* option;
    InputKind kind;
  };
  struct NamedOutput {
    CLI::Option* option;
    OutputForm form;
    FileKind kind;
    NamedKinds names;
  };
  struct Inputs {
    std::vector<std::filesystem::path> files;
    std::vector<std::pair<std::filesystem::path, bool (*)(const std::filesystem::path&)>> folders;
  };

  explicit JobFiles(CLI::App& job) : job_(job) {}
  void Check() const;
  Inputs AllInputs() const;
  std::vector<std::filesystem::path> OutputFiles() const;
  void CheckFile(const std::filesystem::path& file, const FileKind& kind,
                 const Inputs& inputs) const;
  void CheckFolder(const std::filesystem::path& folder, const NamedKinds& names,
                   const Inputs& inputs) const;
  void CheckScene(const std::filesystem::path& scene) const;

  CLI::App& job_;
  std::vector<NamedInput> inputs_;
  std::vector<NamedOutput> outputs_;
  FileOfScene scene_file_of_ = nullptr;
  bool overwrites_ = false;
};

}  // namespace arthro::app
