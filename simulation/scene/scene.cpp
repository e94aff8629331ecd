#include "simulation/scene/scene.h"

namespace arthro {

Tissue::Tissue() = default;
Tissue::Tissue(const Tissue&) = default;
Tissue::Tissue(Tissue&&) noexcept = default;
Tissue& Tissue::operator=(const Tissue&) = default;
Tissue& Tissue::operator=(Tissue&&) noexcept = default;
Tissue::~Tissue() = default;
bool operator==(const Tissue&, const Tissue&) = default;

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;
bool operator==(const Scene&, const Scene&) = default;

}  // namespace arthro
