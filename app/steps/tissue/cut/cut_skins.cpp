#include "app/steps/tissue/cut/cut_skins.h"

#include "simulation/core/error.h"
#include "simulation/practice/cut_skin.h"

namespace arthro::app {

std::shared_ptr<const simulation::BodySkin> CutSkins::SkinOf(const authoring::Document& document,
                                                             int index) {
  const auto i = static_cast<std::size_t>(index);
  const Tissue& tissue = document.scene.tissues.at(i);
  fault_.clear();
  made_.resize(document.scene.tissues.size());
  Made& made = made_[i];
  const auto& surface = document.surfaces.at(i);
  if (!simulation::HasCutsMade(tissue) || !surface || surface->triangles.empty()) {
    made = {};
    return nullptr;
  }
  const double scale = tissue.pose.scale;
  if (made.surface != surface || made.scale != scale) made = {surface, scale, {}, {}, {}, {}, {}};
  if (made.cuts == tissue.cuts && made.fixed == tissue.fixed) {
    fault_ = made.fault;
    return made.skin;
  }
  made.cuts = tissue.cuts;
  made.fixed = tissue.fixed;
  made.skin = nullptr;
  made.fault.clear();
  try {
    if (!made.whole)
      made.whole =
          std::make_shared<const simulation::SolidField>(simulation::WholeField(tissue, *surface));
    made.skin = std::make_shared<const simulation::BodySkin>(
        simulation::CutSkin(tissue, *surface, *made.whole));
  } catch (const Error& error) {
    made.fault = error.sentence();
  }
  fault_ = made.fault;
  return made.skin;
}

}  // namespace arthro::app
