#include "authoring/project/free_tissue_name.h"

#include <algorithm>

namespace arthro::authoring {

std::string FreeTissueName(const Scene& scene, const std::string& wanted) {
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::any_of(scene.tissues,
                               [&](const Tissue& tissue) { return tissue.name == name; });
  };
  const std::string stem = wanted.empty() ? "tissue" : wanted;
  std::string name = stem;
  for (int number = 2; is_taken(name); ++number) name = stem + " " + std::to_string(number);
  return name;
}

}  // namespace arthro::authoring
