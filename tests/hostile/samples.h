// Small valid files of every kind that a job reads, made in code, and the jobs that read them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/hostile/child_run.h"
#include "tests/hostile/mutation.h"

namespace arthro::test {

// A job as a user types it in the samples' folder; outputs lie in ../out.
struct SampleJob {
  std::vector<std::string> arguments;
  std::vector<std::string> outputs;  // names in ../out: files, or folders that end with /
  int exit_code = 0;                 // exit code of the undamaged input
  bool writes_on_refusal = false;    // a result that says why
};

// A file to damage. `packs` is a scene's folder that goes into an archive of the same name after
// that.
struct SampleTarget {
  std::string kind, file;
  FileFormat format;
  std::vector<SampleJob> jobs;
  std::string packs;
};

class Samples {
 public:
  // Makes in/, out/, tmp/, home/, bin/ and share/ in `folder`. Throws where a sample cannot be
  // made.
  explicit Samples(std::filesystem::path folder);

  const std::vector<SampleTarget>& targets() const { return targets_; }
  std::filesystem::path in() const { return folder_ / "in"; }
  std::filesystem::path out() const { return folder_ / "out"; }
  std::filesystem::path tmp() const { return folder_ / "tmp"; }

  // The program and the environment that belong to a job.
  ChildCommand CommandOf(const std::vector<std::string>& arguments) const;
  // Stored, not compressed, so that nothing but the scene's files is at fault.
  void Pack(const std::string& scene) const;

 private:
  void MakeScenes();
  void MakePictures();
  void MakeSurfaces();
  void MakeTables();
  void MakeFilms();
  void ListTargets();
  void Run(const std::vector<std::string>& arguments) const;

  std::filesystem::path folder_;
  std::vector<SampleTarget> targets_;
};

}  // namespace arthro::test
