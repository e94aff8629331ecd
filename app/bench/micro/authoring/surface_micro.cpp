// Checks of a surface and its filling with tetrahedra, by size.
#include <filesystem>

#include <fmt/format.h>

#include "app/bench/micro/micro_bench.h"
#include "authoring/tissue/surface/self_intersection.h"
#include "authoring/tissue/surface/surface_check.h"
#include "authoring/tissue/tetrahedra/tetrahedralize.h"
#include "simulation/core/units.h"
#include "tests/support/shapes.h"

namespace arthro::app {
namespace {

// The program that fills a surface in a process of its own: the sibling of this one.
std::filesystem::path FillingProgram() {
  return std::filesystem::read_symlink("/proc/self/exe").replace_filename("arthroscene");
}

}  // namespace

MicroGroup SurfaceMicro(bool quick) {
  MicroGroup group{"surface", "", "closed surface without intersections; its own volume", {}};
  for (int level = 2; level <= (quick ? 2 : 6); ++level) {
    const SurfaceMesh sphere = test::Sphere({0, 0, 0}, 0.015, level);
    const std::string size = fmt::format("{} triangles", sphere.triangles.size());
    group.functions.push_back(
        {"self-intersections, " + size,
         [=] { KeepAlive(authoring::FindSelfIntersections(sphere)); },
         [=] {
           return MicroError{.text = fmt::format("{} pairs found of 0",
                                                 authoring::FindSelfIntersections(sphere).size())};
         }});
    group.functions.push_back(
        {"all checks, " + size, [=] { KeepAlive(authoring::CheckSurface(sphere)); }, {}});
  }
  for (const int order : {1, 2})
    for (const double max_edge : {0.0, 0.006, 0.003, 0.0015}) {
      if (quick && max_edge != 0.006) continue;
      const auto fill = [=] {
        authoring::TetrahedralizeOptions options;
        options.order = order;
        options.max_edge = max_edge;
        authoring::TetrahedralizeReport report;
        authoring::Tetrahedralize(test::Torus(0.015, 0.004, 48, 16), {}, options, &report, {},
                                  FillingProgram());
        return report;
      };
      group.functions.push_back(
          {fmt::format("fill a ring, order {}, edges of {:g} mm", order, max_edge * 1e3),
           [=] { KeepAlive(fill()); },
           [=] {
             const authoring::TetrahedralizeReport report = fill();
             return MicroError{
                 .text = fmt::format("{} elements, volume off by {:.0e}, angles {:.1f} to {:.1f}°",
                                     report.elements, report.volume_error,
                                     DegreesFromRadians(report.quality.min_dihedral),
                                     DegreesFromRadians(report.quality.max_dihedral))};
           }});
    }
  return group;
}

}  // namespace arthro::app
