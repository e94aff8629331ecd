// Check of a scene before a trainee gets it: contents, errors, warnings and missing parts. Each
// line is a sentence for a person.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulation/scene/backdrop/relief_shares.h"
#include "simulation/scene/files/scene_io.h"

namespace arthro {

struct SceneFindings {
  std::vector<std::string> found;      // title, sizes, projection, tissues…
  std::vector<std::string> errors;     // it cannot be practised on; all of them
  std::vector<std::string> warnings;   // it can, but probably not as meant
  std::vector<std::string> hints;      // parts that it lacks and could have
  std::optional<ReliefShares> relief;  // none where the scene names neither
};

// Does a tissue without tetrahedra give way as a thin layer? That is for its preset to say.
using IsThinLayer = std::function<bool(const Tissue& tissue)>;

// Loads everything that the scene names, tetrahedra included. `loaded`, if given, gets the scene.
// With no `is_layer` no tissue is one.
SceneFindings CheckScene(const std::filesystem::path& scene, LoadedScene* loaded = nullptr,
                         const IsThinLayer& is_layer = {});

// The same for a scene in memory, as an editor shows it while the author works.
SceneFindings CheckScene(const LoadedScene& loaded, const IsThinLayer& is_layer = {});

// Lacks of a scene that is to be shared: title, author, and the source, licence and consent of each
// asset. One line each.
std::vector<std::string> MissingForSharing(const Scene& scene);

}  // namespace arthro
