// A joint made in code, for `bench view` and for tests of the view: colours like tissue that vary
// slowly, a relief to be met along every ray, a ring of tissue and instruments before it. Portal
// frame, m.
#pragma once

#include "app/view/arthroscopic_view.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::test {

// So slow that a picture of it has no more than a rounding's room.
ColourImage SlowColours(int width, int height);

// A ring about z through the origin: 2 · around · across triangles.
SurfaceMesh Ring(double radius, double thickness, int around = 80, int across = 40);

// The same in another frame.
SurfaceMesh Moved(SurfaceMesh mesh, const Pose& target_from_mesh);

// A probe before the ring.
app::InstrumentView ProbeInFront();

// Half as high as wide. Its relief has a bulge of 8 mm, waves of 3 mm and a step of 4 mm, and is
// the same at each width.
LoadedScene WavyJoint(int width);

// A view across the step and the waves: 30 degrees, 90 degrees wide.
app::Picture ViewOfWavyJoint();

}  // namespace arthro::test
