#include "tests/hostile/samples.h"

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <zlib.h>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/device/log/log_format.h"
#include "simulation/scene/json/lens_io.h"
#include "tests/authoring/panorama/tiny_clip.h"
#include "tests/hostile/tet_block.h"
#include "tests/support/build_paths.h"
#include "tests/support/small_scene.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

// The octahedron of the small scene, of four tetrahedra about its axis.
TetMesh OctahedronTets(double r) {
  TetMesh mesh;
  mesh.rest_positions = Octahedron(r).vertices;
  mesh.elements = {4, 5, 0, 2, 4, 5, 2, 1, 4, 5, 1, 3, 4, 5, 3, 0};
  for (std::size_t e = 0; e < mesh.elements.size(); e += 4) {
    const auto x = [&](int i) { return mesh.rest_positions[mesh.elements[e + i]]; };
    if (glm::dot(glm::cross(x(1) - x(0), x(2) - x(0)), x(3) - x(0)) < 0)
      std::swap(mesh.elements[e], mesh.elements[e + 1]);
  }
  return mesh;
}

void Append32(std::string& to, std::uint32_t value, int bytes = 4) {
  for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i));
}

constexpr const char* kTraceHead = "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n";
constexpr int kTraceRows = 20;

}  // namespace

Samples::Samples(fs::path folder) : folder_(std::move(folder)) {
  for (const char* name : {"in", "out", "tmp", "home", "bin", "share/arthroscene"})
    fs::create_directories(folder_ / name);
  fs::copy_file(ARTHRO_PROGRAM, folder_ / "bin/arthroscene", fs::copy_options::overwrite_existing);
  // Beside the copy, the program's own files, so that presets can be damaged too.
  fs::copy(ARTHRO_SOURCE_DIR "/resources", folder_ / "share/arthroscene",
           fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  MakeScenes();
  MakePictures();
  MakeSurfaces();
  MakeTables();
  MakeFilms();
  ListTargets();
}

ChildCommand Samples::CommandOf(const std::vector<std::string>& arguments) const {
  ChildCommand command;
  command.arguments = {folder_ / "bin/arthroscene"};
  command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
  command.folder = in();
  command.scratch = folder_;
  command.environment = {"TMPDIR=" + tmp().string(), "HOME=" + (folder_ / "home").string(),
                         "LANG=C.UTF-8", "OPENBLAS_NUM_THREADS=1"};
  return command;
}

void Samples::Run(const std::vector<std::string>& arguments) const {
  const ChildRun run = RunChild(CommandOf(arguments));
  if (run.exit_code != 0)
    throw std::runtime_error(fmt::format("{} of an undamaged file ends with {}, signal {}: {}",
                                         arguments.at(0), run.exit_code, run.signal, run.err));
}

void Samples::MakeScenes() {
  for (const char* name : {"knee", "packed"}) {
    const fs::path scene = WriteSmallScene(in() / name);
    Lens lens;
    lens.width = lens.height = 128;
    lens.focal_px = 70;
    lens.cx = lens.cy = 63.5;
    lens.circle = {63.5, 63.5, 60};
    lens.field_of_view = *FieldOfViewOf(lens);
    WriteLens(scene / "lens.json", lens);
    WriteTetMesh(scene / "octahedron.vtu", OctahedronTets(0.006));
    Scene value = ReadScene(scene / "scene.json");
    value.scope.lens = "lens.json";
    value.tissues[0].mesh = "octahedron.vtu";
    value.tissues[0].material = "meniscus-probe";
    value.tissues[0].fixed.push_back({{0, 0, -0.006}, 0.002});
    WriteScene(scene / "scene.json", value);
  }
  Pack("packed");
  fs::copy_file(in() / "packed.arthro", in() / "raw.arthro");
}

void Samples::MakePictures() {
  const ColourImage picture = KneePicture(160, 120);
  for (const char* name : {"pano.png", "pano.tiff"}) WriteColourImage(in() / name, picture);
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(120, 160, CV_8UC3, const_cast<std::uint8_t*>(picture.rgb.data())), bgr,
               cv::COLOR_RGB2BGR);
  cv::imwrite(in() / "pano.jpg", bgr);
  // A line grid, seen straight on and at an angle.
  cv::Mat grid(240, 320, CV_8UC3, cv::Scalar(235, 235, 235));
  for (int x = 10; x < 320; x += 20)
    cv::line(grid, {x, 0}, {x + 6, 239}, {20, 20, 20}, 2, cv::LINE_AA);
  for (int y = 10; y < 240; y += 20)
    cv::line(grid, {0, y}, {319, y + 3}, {20, 20, 20}, 2, cv::LINE_AA);
  cv::imwrite(in() / "grid.png", grid);
  TinyClip().WriteAll(in() / "frames", TinyClip::Arc(3));
  std::ofstream(in() / "options.json") << R"({"estimator": "shading"})";
}

void Samples::MakeSurfaces() {
  const SurfaceMesh body = Octahedron(0.01);
  for (const char* name : {"body.ply", "body.obj", "body.stl"}) WriteSurface(in() / name, body);
  std::ofstream off(in() / "body.off"), text(in() / "text.stl"), ply(in() / "text.ply");
  std::ofstream vtp(in() / "body.vtp");
  off << "OFF\n" << body.vertices.size() << ' ' << body.triangles.size() << " 0\n";
  ply << "ply\nformat ascii 1.0\nelement vertex " << body.vertices.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
      << body.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  std::string points, faces, corners, offsets;
  for (const glm::dvec3& x : body.vertices) points += fmt::format("{} {} {}\n", x.x, x.y, x.z);
  text << "solid body\n";
  int end = 0;
  for (const auto& t : body.triangles) {
    faces += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    corners += fmt::format("{} {} {}\n", t[0], t[1], t[2]);
    offsets += fmt::format("{} ", end += 3);
    text << "facet normal 0 0 0\nouter loop\n";
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3& x = body.vertices[t[i]];
      text << fmt::format("vertex {} {} {}\n", x.x, x.y, x.z);
    }
    text << "endloop\nendfacet\n";
  }
  text << "endsolid body\n";
  off << points << faces;
  ply << points << faces;
  vtp << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
         "byte_order=\"LittleEndian\">\n<PolyData>\n"
      << fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n", body.vertices.size(),
                     body.triangles.size())
      << "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
      << points << "</DataArray></Points>\n<Polys>\n"
      << "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n"
      << corners << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n"
      << offsets << "\n</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  fs::create_directories(in() / "block");
  WriteTetMesh(in() / "block/block.vtu", TetBlock(2));
  for (const auto& [name, mode] : {std::pair{"case.json", R"("mode": "static")"},
                                   {"moving.json", R"("mode": "dynamic", "dt": 0.01, "steps": 3)"}})
    std::ofstream(in() / "block" / name) << R"({"mesh": "block.vtu", "order": 1,
 "material": {"model": "stable_neo_hookean", "young_modulus": 1e6, "poisson_ratio": 0.3,
              "density": 1000},
 "fixed": [{"set": "fixed", "axes": "xyz"}], "loads": [{"set": "end", "total_force": [0, 0, -0.05]}],
 "body_force": [0, 0, -10000], "tolerance": 1e-8, )"
                                         << mode << "}";
}

void Samples::MakeTables() {
  std::ofstream trace(in() / "trace.csv"), swing(in() / "swing.csv"), poses(in() / "poses.csv");
  trace << kTraceHead;
  swing << kTraceHead;
  std::string payload;
  simulation::LogRecord record;
  std::uint32_t count = 0;
  for (int i = 0; i < kTraceRows; ++i) {
    const double turn = 0.1 * std::sin(0.4 * i);
    for (const char* hand : {"scope", "instrument"})
      trace << fmt::format("{:.3f},{},{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},0,0,0\n", 0.01 * i, hand,
                           0.0, 0.17 * std::sin(2 * turn), -0.17 * std::cos(2 * turn),
                           std::cos(turn), std::sin(turn));
    record.t_ns = 10'000'000ll * i;
    record.number = count++;
    record.sample.t = 0.01 * i;
    record.sample.hip_in_device = {0, 0, -0.17};
    record.sample.valid = true;
    simulation::Append(record, payload);
  }
  for (int i = 0; i < 200; ++i) {  // a rod of 150 mm that swings through the origin
    const double a = 0.5 * std::sin(0.1 * i), b = 0.5 * std::cos(0.07 * i);
    const glm::dquat turn =
        glm::angleAxis(a, glm::dvec3(1, 0, 0)) * glm::angleAxis(b, glm::dvec3(0, 1, 0));
    const glm::dvec3 hip = turn * glm::dvec3(0, 0, -0.1);
    swing << fmt::format("{:.3f},scope,{},{},{},{},{},{},{},0\n", 0.01 * i, hip.x, hip.y, hip.z,
                         turn.w, turn.x, turn.y, turn.z);
  }
  poses << "hip_x,hip_y,hip_z,tip_x,tip_y,tip_z\n";
  for (const auto& [x, y] : {std::pair{0.05, 0.0}, {-0.05, 0.01}, {0.0, 0.06}, {0.02, -0.05}})
    poses << fmt::format("{},{},-0.1,{},{},0.1\n", x, y, -x, -y);
  const simulation::LogSource source{"", "", "1", {simulation::DeviceRole::kInstrument, {}}};
  WriteAtomically(in() / "session.bin", simulation::LogHead({&source, 1}) +
                                            simulation::LogBlock(payload, count) +
                                            simulation::LogEnd(count));
  fs::copy_file(ARTHRO_SOURCE_DIR "/resources/presets/rigs/woodenhaptics_instrument.json",
                in() / "rig.json");
}

void Samples::MakeFilms() {
  for (const char* name : {"film.mp4", "film.mkv", "film.avi"})
    Run({"replay", "knee", "trace.csv", "-o", "../out/f.csv", "--video", name, "--video-size",
         "128", "--fps", "25"});
  fs::remove(out() / "f.csv");
}

void Samples::Pack(const std::string& scene) const {
  std::string archive, directory;
  std::uint32_t count = 0;
  for (const auto& entry : fs::directory_iterator(in() / scene)) {
    const std::string name = entry.path().filename(), bytes = ReadWholeFile(entry.path());
    const auto size = static_cast<std::uint32_t>(bytes.size());
    const auto crc =
        static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), size));
    const auto begin = static_cast<std::uint32_t>(archive.size());
    std::string head;  // fields that both entries share, from the version on
    for (const std::uint32_t field : {20u, 0u, 0u, 0u, 0x21u}) Append32(head, field, 2);
    for (const std::uint32_t field : {crc, size, size}) Append32(head, field);
    Append32(head, static_cast<std::uint32_t>(name.size()), 2);
    Append32(head, 0, 2);
    archive += "PK\3\4" + head + name + bytes;
    directory += "PK\1\2";
    Append32(directory, 20, 2);
    directory += head;
    Append32(directory, 0, 4);
    Append32(directory, 0, 2);
    Append32(directory, 0, 4);
    Append32(directory, begin);
    directory += name;
    ++count;
  }
  const auto begin = static_cast<std::uint32_t>(archive.size());
  archive += directory + "PK\5\6";
  Append32(archive, 0, 4);
  Append32(archive, count, 2);
  Append32(archive, count, 2);
  Append32(archive, static_cast<std::uint32_t>(directory.size()));
  Append32(archive, begin);
  Append32(archive, 0, 2);
  std::ofstream(in() / (scene + ".arthro"), std::ios::binary) << archive;
}

void Samples::ListTargets() {
  const auto view = [](const std::string& scene) {
    return SampleJob{{"view", scene, "--size", "64", "-o", "../out/v.png"}, {"v.png"}};
  };
  const auto check = [](const std::string& scene) { return SampleJob{{"check", scene}, {}}; };
  const auto replay = [](const std::string& scene, const std::string& trace) {
    return SampleJob{{"replay", scene, trace, "-o", "../out/f.csv", "--report", "../out/r.json"},
                     {"f.csv", "r.json"}};
  };
  const SampleJob centres{{"centres", "knee", "--roll-steps", "12", "-o", "../out/c.csv"},
                          {"c.csv"}};
  const auto depth = [](const std::string& picture) {
    return SampleJob{{"depth", picture, "-o", "../out/d.tiff"}, {"d.tiff"}};
  };
  const auto tets = [](const std::string& surface) {
    return SampleJob{{"tetrahedralize", surface, "--unit", "m", "--elements", "100", "-o",
                      "../out/t.vtu", "--report", "../out/t.json"},
                     {"t.vtu", "t.json"}};
  };
  const auto solve = [](const std::string& name) {
    return SampleJob{{"solve", name, "-o", "../out/s.json"}, {"s.json"}, 0, true};
  };
  const auto rectify = [](const std::string& footage) {
    return SampleJob{{"rectify", footage, "--lens", "knee/lens.json", "-o", "../out/flat"},
                     {"flat/"}};
  };
  const auto panorama = [](const std::string& footage) {
    return SampleJob{{"panorama", footage, "-o", "../out/p.png", "--report", "../out/p.json"},
                     {"p.png", "p.json"}};
  };
  const SampleJob pivot{{"pivot", "poses.csv", "-o", "../out/pivot.json"}, {"pivot.json"}, 0, true};
  const SampleJob swing{{"pivot", "swing.csv", "--swing", "scope", "-o", "../out/pivot.json"},
                        {"pivot.json"},
                        0,
                        true};
  SampleJob lens{
      {"lens", "grid.png", "--spacing-mm", "1", "-o", "../out/lens.json"}, {"lens.json"}, -1};
  SampleJob flat_frames = panorama("frames");
  SampleJob with_lens = rectify("film.avi");
  const SampleJob rig{{"practise", "knee", "--rig", "rig.json"}, {}, 1};
  SampleJob with_options = depth("pano.png");
  with_options.arguments.insert(with_options.arguments.end(), {"--options", "options.json"});
  using enum FileFormat;
  targets_ = {
      {"scene.json",
       "knee/scene.json",
       kJson,
       {check("knee"), view("knee"), replay("knee", "trace.csv"), centres},
       ""},
      {"panorama of a scene", "knee/panorama.png", kPng, {check("knee"), view("knee")}, ""},
      {"depth map of a scene", "knee/depth.tiff", kBinary, {check("knee"), view("knee")}, ""},
      {"surface of a scene", "knee/octahedron.ply", kBinary, {check("knee"), view("knee")}, ""},
      {"volume of a scene",
       "knee/octahedron.vtu",
       kXml,
       {check("knee"), replay("knee", "trace.csv")},
       ""},
      {"lens of a scene", "knee/lens.json", kJson, {check("knee"), view("knee"), with_lens}, ""},
      {"archive", "raw.arthro", kBinary, {check("raw.arthro"), view("raw.arthro")}, ""},
      {"scene.json in an archive",
       "packed/scene.json",
       kJson,
       {check("packed.arthro"), view("packed.arthro")},
       "packed"},
      {"picture in an archive", "packed/panorama.png", kPng, {check("packed.arthro")}, "packed"},
      {"picture, PNG", "pano.png", kPng, {depth("pano.png")}, ""},
      {"picture, JPEG", "pano.jpg", kBinary, {depth("pano.jpg")}, ""},
      {"picture, TIFF", "pano.tiff", kBinary, {depth("pano.tiff")}, ""},
      {"surface, PLY", "body.ply", kBinary, {tets("body.ply")}, ""},
      {"surface, PLY as text", "text.ply", kText, {tets("text.ply")}, ""},
      {"surface, STL", "body.stl", kBinary, {tets("body.stl")}, ""},
      {"surface, STL as text", "text.stl", kText, {tets("text.stl")}, ""},
      {"surface, OBJ", "body.obj", kText, {tets("body.obj")}, ""},
      {"surface, OFF", "body.off", kText, {tets("body.off")}, ""},
      {"surface, VTP", "body.vtp", kXml, {tets("body.vtp")}, ""},
      {"volume, VTU", "block/block.vtu", kXml, {solve("block/case.json")}, ""},
      {"tissue case", "block/case.json", kJson, {solve("block/case.json")}, ""},
      {"tissue case, dynamic", "block/moving.json", kJson, {solve("block/moving.json")}, ""},
      {"trace", "trace.csv", kText, {replay("knee", "trace.csv")}, ""},
      {"trace of a swing", "swing.csv", kText, {swing}, ""},
      {"device log", "session.bin", kBinary, {replay("knee", "session.bin")}, ""},
      {"poses", "poses.csv", kText, {pivot}, ""},
      {"options", "options.json", kJson, {with_options}, ""},
      {"rig", "rig.json", kJson, {rig}, ""},
      {"tissue preset",
       "../share/arthroscene/presets/tissues/meniscus-probe.json",
       kJson,
       {check("knee"), replay("knee", "trace.csv")},
       ""},
      {"grid picture", "grid.png", kPng, {lens}, ""},
      {"film, MP4", "film.mp4", kBinary, {rectify("film.mp4")}, ""},
      {"film, MKV", "film.mkv", kBinary, {rectify("film.mkv")}, ""},
      {"film, AVI", "film.avi", kBinary, {rectify("film.avi")}, ""},
      {"frame of footage", "frames/000.png", kPng, {flat_frames}, ""},
  };
}

}  // namespace arthro::test
