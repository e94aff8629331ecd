// How long a surface takes to check and to fill, by size, with the error of the volume against the
// surface's own and the worst angle of the elements beside it.
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "authoring/tissue/self_intersection.h"
#include "authoring/tissue/surface_check.h"
#include "authoring/tissue/tetrahedralize.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/shapes.h"

namespace arthro {
namespace {

std::string ErrorOf(const authoring::TetrahedralizeReport& report) {
  constexpr double kDegree = std::numbers::pi / 180;
  return fmt::format("{} elements, volume off by {:.0e}, worst angles {:.1f} and {:.1f} deg",
                     report.elements, report.volume_error, report.quality.min_dihedral / kDegree,
                     report.quality.max_dihedral / kDegree);
}

void Run(test::BenchReport& bench) {
  const int largest = bench.quick() ? 2 : 6;
  for (int level = 2; level <= largest; ++level) {
    const SurfaceMesh sphere = test::Sphere({0, 0, 0}, 0.015, level);
    std::size_t pairs = 0;
    const std::string size = fmt::format("{} triangles", sphere.triangles.size());
    pairs = authoring::FindSelfIntersections(sphere).size();
    bench.Measure(
        "self-intersections, " + size, 1,
        [&] { test::KeepAlive(authoring::FindSelfIntersections(sphere)); },
        fmt::format("{} pairs found of 0", pairs), 20);
    bench.Measure(
        "all checks, " + size, 1, [&] { test::KeepAlive(authoring::CheckSurface(sphere)); }, "",
        20);
  }
  for (const int order : {1, 2})
    for (const double max_edge : {0.0, 0.006, 0.003, 0.0015}) {
      if (bench.quick() && max_edge != 0.006) continue;
      authoring::TetrahedralizeOptions options;
      options.order = order;
      options.max_edge = max_edge;
      const SurfaceMesh ring = test::Torus(0.015, 0.004, 48, 16);
      const auto fill = [&] {
        authoring::TetrahedralizeReport report;
        authoring::Tetrahedralize(ring, {}, options, &report, {}, ARTHRO_PROGRAM);
        return report;
      };
      bench.Measure(fmt::format("fill a ring, order {}, edges of {:g} mm", order, max_edge * 1e3),
                    1, fill, ErrorOf(fill()), 5);
    }
}

}  // namespace
}  // namespace arthro

int main(int argc, char** argv) {
  arthro::test::BenchReport bench("tetrahedra", argc, argv);
  arthro::Run(bench);
  return 0;
}
