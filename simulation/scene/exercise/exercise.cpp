#include "simulation/scene/exercise/exercise.h"

namespace arthro {

Exercise::Exercise() = default;
Exercise::Exercise(const Exercise&) = default;
Exercise::Exercise(Exercise&&) noexcept = default;
Exercise& Exercise::operator=(const Exercise&) = default;
Exercise& Exercise::operator=(Exercise&&) noexcept = default;
Exercise::~Exercise() = default;
bool operator==(const Exercise&, const Exercise&) = default;

}  // namespace arthro
