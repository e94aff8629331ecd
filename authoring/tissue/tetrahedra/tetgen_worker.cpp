#include "authoring/tissue/tetrahedra/tetgen_worker.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <sys/resource.h>
#include <unistd.h>

#define TETLIBRARY
#include <tetgen.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

// The two files of a folder. Reader and writer are this same program, so values are stored in their
// memory layout.
constexpr const char* kJobFile = "job.bin";
constexpr const char* kMeshFile = "mesh.bin";

// TetGen's nodes 4 to 9 are the middles of 23, 03, 01, 12, 13, 02; VTK's of 01, 12, 20, 03, 13, 23.
constexpr std::array<int, 10> kTetgenNodeOfVtk = {0, 1, 2, 3, 6, 7, 9, 5, 8, 4};

class Writer {
 public:
  template <class T>
  void Put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void PutAll(const std::vector<T>& values) {
    Put(static_cast<std::uint64_t>(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// Plain, not atomic: a folder is used once, by one parent and one child, and then removed.
void WriteBytes(const fs::path& file, const std::string& bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream)
    throw Error(Code::kFile, "could not be written; is the disk of the temporary folder full?",
                file);
}

class Reader {
 public:
  Reader(std::string bytes, fs::path file) : bytes_(std::move(bytes)), file_(std::move(file)) {}
  template <class T>
  void Get(T& value) {
    Take(&value, sizeof value);
  }
  template <class T>
  void GetAll(std::vector<T>& values) {
    std::uint64_t size = 0;
    Get(size);
    if (size > (bytes_.size() - at_) / sizeof(T)) Refuse();
    values.resize(size);
    Take(values.data(), size * sizeof(T));
  }

 private:
  void Take(void* to, std::size_t size) {
    if (size > bytes_.size() - at_) Refuse();
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  [[noreturn]] void Refuse() const {
    throw Error(Code::kFile, "is cut off; is the disk of the temporary folder full?", file_);
  }
  std::string bytes_;
  fs::path file_;
  std::size_t at_ = 0;
};

TetgenJob ReadJob(const fs::path& folder) {
  Reader reader(ReadWholeFile(folder / kJobFile), folder / kJobFile);
  TetgenJob job;
  std::vector<char> switches;
  reader.GetAll(switches);
  job.switches.assign(switches.begin(), switches.end());
  reader.Get(job.flat_angle);
  reader.Get(job.max_dihedral);
  reader.Get(job.max_edge);
  reader.Get(job.memory_limit);
  reader.Get(job.time_limit);
  reader.GetAll(job.fine);
  reader.GetAll(job.points);
  reader.GetAll(job.triangles);
  return job;
}

// Returns the present address space of this process, bytes.
[[maybe_unused]] double AddressSpace() {
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

void Limit(int resource, double most) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  const double hard = limit.rlim_max == RLIM_INFINITY ? most : static_cast<double>(limit.rlim_max);
  limit.rlim_cur = static_cast<rlim_t>(std::min(most, hard));
  ::setrlimit(resource, &limit);
}

void LimitThisProcess(const TetgenJob& job) {
  Limit(RLIMIT_CORE, 0);
  if (job.time_limit > 0) Limit(RLIMIT_CPU, job.time_limit + 2);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // sanitizers reserve terabytes
  if (job.memory_limit > 0) Limit(RLIMIT_AS, AddressSpace() + job.memory_limit);
#endif
}

// TetGen calls this for each tetrahedron with its corners only, so the limits are globals.
double longest_edge = 0;  // 0: none
std::vector<FinePlace> fine_places;

bool IsTooLong(double* a, double* b, double* c, double* d, double*, double) {
  std::array<glm::dvec3, 4> corners;
  glm::dvec3 low(INFINITY), high(-INFINITY);
  for (std::size_t i = 0; const double* x : {a, b, c, d}) {
    corners[i] = {x[0], x[1], x[2]};
    low = glm::min(low, corners[i]), high = glm::max(high, corners[i++]);
  }
  double longest = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      longest = std::max(longest, glm::distance(corners[i], corners[j]));
  if (longest_edge > 0 && longest > longest_edge) return true;
  return std::any_of(fine_places.begin(), fine_places.end(), [&](const FinePlace& place) {
    return longest > place.max_edge &&
           glm::distance(place.centre, glm::clamp(place.centre, low, high)) < place.radius;
  });
}

// One facet per triangle; tetgenio frees its lists.
void Fill(tetgenio& in, const TetgenJob& job) {
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(job.points.size());
  in.pointlist = new REAL[3 * job.points.size()];
  std::memcpy(in.pointlist, job.points.data(), job.points.size() * sizeof(glm::dvec3));
  in.numberoffacets = static_cast<int>(job.triangles.size());
  in.facetlist = new tetgenio::facet[job.triangles.size()];
  for (int i = 0; i < in.numberoffacets; ++i) tetgenio::init(&in.facetlist[i]);
  for (int i = 0; i < in.numberoffacets; ++i) {
    tetgenio::facet& facet = in.facetlist[i];
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    std::copy(job.triangles[i].begin(), job.triangles[i].end(), facet.polygonlist[0].vertexlist);
  }
}

int Work(const fs::path& folder) {
  TetgenJob job = ReadJob(folder);
  LimitThisProcess(job);
  tetgenio in, out;
  Fill(in, job);
  if (job.max_edge > 0 || !job.fine.empty()) {
    longest_edge = job.max_edge;
    fine_places = job.fine;
    in.tetunsuitable = IsTooLong;
  }
  tetgenbehavior behavior;
  if (!behavior.parse_commandline(job.switches.data())) return kWorkerBadJob;
  behavior.facet_ang_tol = job.flat_angle;
  behavior.optmaxdihedral = job.max_dihedral;
  try {
    tetrahedralize(&behavior, &in, &out);
  } catch (int code) {
    return code == 1 ? kWorkerOutOfMemory : kWorkerTetgen + code;
  }
  const int nodes = out.numberofcorners;
  if (nodes != 4 && nodes != 10) return kWorkerBadJob;
  std::vector<glm::dvec3> points(static_cast<std::size_t>(out.numberofpoints));
  std::memcpy(points.data(), out.pointlist, points.size() * sizeof(glm::dvec3));
  std::vector<int> elements;
  elements.reserve(static_cast<std::size_t>(nodes) * out.numberoftetrahedra);
  for (int i = 0; i < out.numberoftetrahedra; ++i)
    for (int k = 0; k < nodes; ++k)
      elements.push_back(out.tetrahedronlist[i * nodes + kTetgenNodeOfVtk[k]]);
  Writer writer;
  writer.Put(std::int32_t{nodes == 10 ? 2 : 1});
  writer.PutAll(points);
  writer.PutAll(elements);
  WriteBytes(folder / kMeshFile, writer.bytes());
  return kWorkerDone;
}

}  // namespace

void WriteTetgenJob(const fs::path& folder, const TetgenJob& job) {
  Writer writer;
  writer.PutAll(std::vector<char>(job.switches.begin(), job.switches.end()));
  writer.Put(job.flat_angle);
  writer.Put(job.max_dihedral);
  writer.Put(job.max_edge);
  writer.Put(job.memory_limit);
  writer.Put(job.time_limit);
  writer.PutAll(job.fine);
  writer.PutAll(job.points);
  writer.PutAll(job.triangles);
  WriteBytes(folder / kJobFile, writer.bytes());
}

int RunTetgenWorker(const fs::path& folder) noexcept {
  try {
    return Work(folder);
  } catch (const std::bad_alloc&) {
    return kWorkerOutOfMemory;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return kWorkerBadJob;
  }
}

TetMesh ReadTetgenMesh(const fs::path& folder) {
  Reader reader(ReadWholeFile(folder / kMeshFile), folder / kMeshFile);
  TetMesh mesh;
  std::int32_t order = 0;
  reader.Get(order);
  mesh.order = order;
  reader.GetAll(mesh.rest_positions);
  reader.GetAll(mesh.elements);
  return mesh;
}

}  // namespace arthro::authoring
