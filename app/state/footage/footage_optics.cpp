#include "app/state/footage/footage_optics.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "simulation/core/error.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {
namespace {

constexpr const char* kLensFile = "lens.json";

// Nothing for a lens that says nothing of what it shows.
std::optional<double> FieldOf(const Lens& lens) {
  try {
    const double field = simulation::WindowFieldOfView(lens);
    return field > 0 ? std::optional(field) : std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

// A file of the lens' name that the document kept holds another lens.
void PutLens(authoring::Document& document, const std::optional<Lens>& lens) {
  ScopeSpec& scope = document.scene.scope;
  scope.lens = lens ? kLensFile : "";
  document.lens = lens;
  document.files.erase(kLensFile);
}

bool CanBeDrawn(const Lens& lens, double field_of_view) {
  try {
    simulation::FitWindowLens(lens, field_of_view);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

void TakeFootageLens(authoring::Document& document, const Lens& lens, bool is_guessed) {
  ScopeSpec& scope = document.scene.scope;
  const std::optional<double> field = FieldOf(lens);
  if (!field || (is_guessed && document.lens)) return;       // a known lens beats a guess
  scope.field_of_view = std::min(*field, std::numbers::pi);  // the most that a scene may say
  scope.lens.clear();
  document.lens.reset();
  if (!is_guessed && CanBeDrawn(lens, *field)) PutLens(document, lens);
}

void PutScopeLens(authoring::Document& document, const std::optional<Lens>& lens) {
  if (lens) {
    const double field = simulation::WindowFieldOfView(*lens);
    simulation::FitWindowLens(*lens, field);  // throws for a lens that cannot be drawn
    document.scene.scope.field_of_view = std::min(field, std::numbers::pi);
  }
  PutLens(document, lens);
}

bool PutFieldOfView(authoring::Document& document, double field_of_view) {
  if (document.lens) {
    Lens lens = *document.lens;
    lens.field_of_view = field_of_view;
    if (!CanBeDrawn(lens, field_of_view)) return false;
    PutLens(document, lens);
  }
  document.scene.scope.field_of_view = field_of_view;
  return true;
}

}  // namespace arthro::app
