#include "app/cli/job_files.h"

#include <regex>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/output_check.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/leftovers.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Returns the given value, or else the option's default.
std::vector<fs::path> PathsOf(const CLI::Option& option) {
  std::vector<fs::path> paths;
  for (const std::string& text : option.results()) paths.emplace_back(text);
  if (std::string text = option.get_default_str(); paths.empty() && !text.empty()) {
    if (text.front() == '"') text = text.substr(1, text.size() - 2);  // a streamed path is quoted
    paths.emplace_back(text);
  }
  std::erase_if(paths, [](const fs::path& path) { return path.empty() || path == "-"; });
  return paths;
}

// Returns the folder in which a file or a folder lies; "out" and "out/" give the same.
fs::path FolderOf(const fs::path& path) {
  const fs::path plain = path.filename().empty() ? path.parent_path() : path;
  return plain.has_parent_path() ? plain.parent_path() : fs::path(".");
}

// "name-2.png" and on for "name.png", as a regular expression.
std::string PieceNames(const fs::path& file) {
  const auto plain = [](const std::string& text) {
    return std::regex_replace(text, std::regex(R"([^A-Za-z0-9_-])"), R"(\$&)");
  };
  return plain(file.stem().string()) + "-[0-9]+" + plain(file.extension().string());
}

[[noreturn]] void RefuseToReplace(const fs::path& file, const std::string& why) {
  throw Error(Code::kFile,
              fmt::format("{}; name another file, or replace it with --overwrite", why), file);
}

}  // namespace

std::shared_ptr<JobFiles> JobFiles::Of(CLI::App& job, bool has_overwrite) {
  std::shared_ptr<JobFiles> files(new JobFiles(job));
  if (has_overwrite)
    job.add_flag(
        "--overwrite", files->overwrites_,
        "Replace files that exist, even those that are no earlier result of this job. Files "
        "that the job reads are never replaced.");
  return files;
}

CLI::Option* JobFiles::Input(CLI::Option* option, const InputKind& kind) {
  inputs_.push_back({option, kind});
  return option->type_name("INPUT");
}

CLI::Option* JobFiles::Output(CLI::Option* option, const FileKind& kind) {
  outputs_.push_back({option, OutputForm::kFile, kind, {}});
  return option->type_name("OUTPUT");
}

CLI::Option* JobFiles::OutputPieces(CLI::Option* option, const FileKind& kind) {
  outputs_.push_back({option, OutputForm::kPieces, kind, {}});
  return option->type_name("OUTPUT");
}

CLI::Option* JobFiles::OutputFilm(CLI::Option* option) {
  outputs_.push_back({option, OutputForm::kFilm, kFilmFile, {}});
  return option->type_name("OUTPUT");
}

CLI::Option* JobFiles::OutputFolder(CLI::Option* option, NamedKinds names) {
  outputs_.push_back({option, OutputForm::kFolder, {}, std::move(names)});
  return option->type_name("OUTPUT");
}

CLI::Option* JobFiles::OutputScene(CLI::Option* option, FileOfScene file_of) {
  scene_file_of_ = file_of;
  outputs_.push_back({option, OutputForm::kScene, {}, {}});
  return option->type_name("OUTPUT");
}

void JobFiles::Run(std::function<void()> run) {
  job_.callback([files = shared_from_this(), run = std::move(run)] {
    files->Check();
    run();
  });
}

JobFiles::Inputs JobFiles::AllInputs() const {
  Inputs all;
  const auto add = [&](const std::vector<fs::path>& files) {
    all.files.insert(all.files.end(), files.begin(), files.end());
  };
  // --options, which every job may have, is read by the flag itself.
  for (const CLI::Option* option : job_.get_options())
    if (option->check_lname("options")) add(PathsOf(*option));
  std::error_code ignored;
  for (const NamedInput& input : inputs_)
    for (const fs::path& path : PathsOf(*input.option)) {
      add(input.kind.files_of != nullptr ? input.kind.files_of(path) : std::vector{path});
      if (input.kind.takes != nullptr && fs::is_directory(path, ignored))
        all.folders.push_back({path, input.kind.takes});
    }
  return all;
}

void JobFiles::EmptyLog(const fs::path& log) const {
  std::error_code fault;
  if (log.empty() || !overwrites_ || !fs::is_regular_file(log, fault)) return;
  fs::resize_file(log, 0, fault);
  if (fault) throw Error(Code::kFile, "could not be written: " + WhyNotWritten(fault.value()), log);
}

std::vector<fs::path> JobFiles::OutputFiles() const {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const NamedOutput& output : outputs_) {
    if (output.form == OutputForm::kFolder || output.form == OutputForm::kScene) continue;
    for (const fs::path& path : PathsOf(*output.option)) {
      const std::string name = path.filename().string();
      const bool is_pictures =
          name.empty() || name.find('%') != std::string::npos || fs::is_directory(path, ignored);
      if (output.form != OutputForm::kFilm || !is_pictures) files.push_back(path);
    }
  }
  return files;
}

void JobFiles::RefuseToOverwrite(const std::vector<fs::path>& inputs) const {
  CheckOutputs(OutputFiles(), inputs);
}

void JobFiles::Check() const {
  const Inputs inputs = AllInputs();
  const std::vector<fs::path> files = OutputFiles();
  CheckOutputs(files, inputs.files);
  for (const NamedOutput& output : outputs_)
    for (const fs::path& path : PathsOf(*output.option)) {
      if (output.form == OutputForm::kScene && path.extension() == ".arthro" &&
          scene_file_of_(path) == path) {  // an archive, which is its own file
        CheckOutputs({path}, inputs.files);
        CheckScene(path);
      } else if (output.form == OutputForm::kFolder || output.form == OutputForm::kScene) {
        CheckOutputFolder(path, files);
        if (output.form == OutputForm::kScene) CheckScene(path);
        CheckFolder(path, output.names, inputs);
        RemoveLeftovers(path);
      } else {
        CheckFile(path, output.kind, inputs);
        if (output.form == OutputForm::kPieces)
          CheckFolder(FolderOf(path), {{PieceNames(path), output.kind}}, inputs);
      }
      RemoveLeftovers(FolderOf(path));
    }
}

// Checks a file that is not an input.
void JobFiles::CheckFile(const fs::path& file, const FileKind& kind, const Inputs& inputs) const {
  std::error_code ignored;
  if (kind.form == FileForm::kPicture)
    for (const auto& [folder, takes] : inputs.folders)
      if (fs::equivalent(FolderOf(file), folder, ignored) && takes(file))
        throw Error(Code::kBadArgument,
                    "a picture in the folder of the footage would be taken for a frame; name "
                    "another folder",
                    file);
  if (overwrites_ || !fs::is_regular_file(file, ignored)) return;
  if (kind.form == FileForm::kUnique)
    RefuseToReplace(file,
                    fmt::format("this file exists, and {} is not written over it", kind.words));
  if (!IsOfKind(file, kind))
    RefuseToReplace(file, fmt::format("this file exists and is not {} of this job", kind.words));
}

void JobFiles::CheckFolder(const fs::path& folder, const NamedKinds& all,
                           const Inputs& inputs) const {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    for (const auto& [names, kind] : all)
      if (std::regex_match(entry.path().filename().string(), std::regex(names))) {
        CheckOutputs({entry.path()}, inputs.files);
        CheckFile(entry.path(), kind, inputs);
      }
}

void JobFiles::CheckScene(const fs::path& scene) const {
  std::error_code ignored;
  const fs::path file = scene_file_of_(scene);
  if (!overwrites_ && fs::exists(file, ignored)) RefuseToReplace(file, "this scene exists");
}

}  // namespace arthro::app
