// Choices on the instructor's page, kept between runs beside the records that they belong to.
#pragma once

#include <filesystem>
#include <string>

#include "simulation/core/options.h"

namespace arthro::app {

struct InstructorChoice {
  std::string cohort;  // name; empty: every one
  std::string group;   // name of the reference group whose band is drawn; empty: the first
  bool has_band = true;
  template <class V>
  void Visit(V&& v) {
    v("cohort", cohort, Any{}, "", "Cohort that is shown; empty for all of them.");
    v("group", group, Any{}, "", "Reference group whose band is drawn; empty for the first one.");
    v("band", has_band, Any{}, "", "A band is drawn.");
  }
  friend bool operator==(const InstructorChoice&, const InstructorChoice&) = default;
};

// `folder`: that of the records. Defaults where the file cannot be read; not being able to write is
// not worth a word.
InstructorChoice ReadInstructorChoice(const std::filesystem::path& folder);
void WriteInstructorChoice(const std::filesystem::path& folder, const InstructorChoice& choice);

}  // namespace arthro::app
