// VTK's XML files against VTK's own writer, in every mode that it has, and hostile ones.
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

std::string QuietSentenceOf(const std::function<void()>& action) {
  testing::internal::CaptureStderr();
  std::string sentence;
  try {
    action();
  } catch (const Error& error) {
    sentence = error.sentence();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  return sentence;
}

constexpr int kSide = 8;  // nodes a side, so that several blocks are compressed

glm::dvec3 NodeAt(int i) {
  return 0.001 * glm::dvec3(i % kSide, i / kSide % kSide, i / kSide / kSide);
}

// A column of tetrahedra with a set, and what is to be passed over.
vtkSmartPointer<vtkUnstructuredGrid> Block() {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const int count = kSide * kSide * kSide;
  vtkNew<vtkUnsignedCharArray> set;
  set->SetName("fixed (held)");
  vtkNew<vtkFloatArray> weight, field;
  weight->SetName("weight");
  field->SetName("field");
  field->SetNumberOfComponents(3);
  vtkNew<vtkStringArray> words;
  words->SetName("words");
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 at = NodeAt(i);
    points->InsertNextPoint(at.x, at.y, at.z);
    set->InsertNextValue(i % 3 == 0);
    weight->InsertNextValue(0.5f * static_cast<float>(i));
    field->InsertNextTuple3(i, 0, 1);
    words->InsertNextValue("word");
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(set);
  grid->GetPointData()->AddArray(weight);
  grid->GetPointData()->AddArray(field);
  grid->GetPointData()->AddArray(words);
  for (int z = 0; z + 1 < kSide; ++z)
    for (int y = 0; y + 1 < kSide; ++y)
      for (int x = 0; x + 1 < kSide; ++x) {
        const auto node = [&](int dx, int dy, int dz) {
          return vtkIdType{(z + dz) * kSide * kSide + (y + dy) * kSide + x + dx};
        };
        // The five tetrahedra of a cube.
        const vtkIdType tets[5][4] = {{node(0, 0, 0), node(1, 0, 0), node(0, 1, 0), node(0, 0, 1)},
                                      {node(1, 1, 0), node(0, 1, 0), node(1, 0, 0), node(1, 1, 1)},
                                      {node(1, 0, 1), node(0, 0, 1), node(1, 1, 1), node(1, 0, 0)},
                                      {node(0, 1, 1), node(1, 1, 1), node(0, 0, 1), node(0, 1, 0)},
                                      {node(1, 0, 0), node(0, 1, 0), node(0, 0, 1), node(1, 1, 1)}};
        for (const auto& tet : tets) grid->InsertNextCell(VTK_TETRA, 4, tet);
      }
  return grid;
}

struct Mode {
  int data = vtkXMLWriter::Ascii, compressor = vtkXMLWriter::NONE;
  bool is_raw = false, is_big_endian = false, is_64_bit = false;
};

std::vector<Mode> Modes() {
  std::vector<Mode> modes = {{vtkXMLWriter::Ascii}};
  for (const int data : {vtkXMLWriter::Binary, vtkXMLWriter::Appended})
    for (const int compressor :
         {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA})
      for (int bits = 0; bits < 8; ++bits)
        if (data == vtkXMLWriter::Appended || !(bits & 1))
          modes.push_back({data, compressor, (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0});
  return modes;
}

std::string Written(vtkXMLWriter* writer, vtkDataObject* data, const Mode& mode) {
  writer->SetInputDataObject(data);
  writer->SetDataMode(mode.data);
  writer->SetCompressorType(mode.compressor);
  writer->SetBlockSize(4096);
  writer->SetEncodeAppendedData(!mode.is_raw);
  mode.is_big_endian ? writer->SetByteOrderToBigEndian() : writer->SetByteOrderToLittleEndian();
  mode.is_64_bit ? writer->SetHeaderTypeToUInt64() : writer->SetHeaderTypeToUInt32();
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

std::string Written(const Mode& mode) {
  static const vtkSmartPointer<vtkUnstructuredGrid> block = Block();
  return Written(vtkNew<vtkXMLUnstructuredGridWriter>(), block, mode);
}

TEST(VtkXml, EveryModeOfVtksWriterIsReadWithTheSameNumbers) {
  test::TempFolder folder;
  for (const Mode& mode : Modes()) {
    SCOPED_TRACE(fmt::format("data {} compressor {} raw {} big-endian {} 64 bit {}", mode.data,
                             mode.compressor, mode.is_raw, mode.is_big_endian, mode.is_64_bit));
    std::ofstream(folder / "a.vtu", std::ios::binary) << Written(mode);
    TetMesh mesh;
    ASSERT_EQ(QuietSentenceOf([&] { mesh = ReadTetMesh(folder / "a.vtu"); }), "");
    ASSERT_EQ(mesh.rest_positions.size(), std::size_t{kSide * kSide * kSide});
    for (int i = 0; i < kSide * kSide * kSide; ++i)
      ASSERT_EQ(mesh.rest_positions[static_cast<std::size_t>(i)], NodeAt(i)) << i;
    EXPECT_EQ(mesh.ElementCount(), 5 * (kSide - 1) * (kSide - 1) * (kSide - 1));
    ASSERT_EQ(mesh.sets.size(), 1u);
    const auto& [name, flags] = *mesh.sets.begin();
    EXPECT_EQ(name, "fixed (held)");
    for (std::size_t i = 0; i < flags.size(); ++i) ASSERT_EQ(flags[i], i % 3 == 0) << i;
  }
}

TEST(VtkXml, SurfacesInEveryModeAreReadWithPolygonsAndStrips) {
  vtkNew<vtkPoints> points;  // two rows of a strip, and a square behind it
  for (int i = 0; i < 8; ++i) points->InsertNextPoint(i / 2, i % 2, 0);
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
    points->InsertNextPoint(x, y, 5);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  vtkNew<vtkCellArray> polygons, strips;
  const vtkIdType square[] = {8, 9, 10, 11}, strip[] = {0, 1, 2, 3, 4, 5, 6, 7};
  polygons->InsertNextCell(4, square);
  strips->InsertNextCell(8, strip);
  data->SetPolys(polygons);
  data->SetStrips(strips);
  test::TempFolder folder;
  for (const Mode& mode : Modes()) {
    WriteAtomically(folder / "a.vtp", Written(vtkNew<vtkXMLPolyDataWriter>(), data, mode));
    SurfaceMesh surface;
    ASSERT_EQ(QuietSentenceOf([&] { surface = ReadSurface(folder / "a.vtp", 1.0); }), "");
    EXPECT_EQ(surface.vertices.size(), 12u);
    EXPECT_EQ(surface.triangles.size(), 2u + 6u);
  }
}

// One tetrahedron with everything in its place; parts are replaced by hostile ones.
std::string Tetrahedron(const std::string& from = "", const std::string& to = "") {
  std::string text =
      R"(<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<PointData><DataArray type="UInt8" Name="fixed" format="ascii">1 0 0 0</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)";
  if (from.empty()) return text;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

std::string FaultOf(const std::string& bytes) {
  test::TempFolder folder;
  std::ofstream(folder / "a.vtu", std::ios::binary) << bytes;  // not flushed to disk, so faster
  return QuietSentenceOf([&] { ReadTetMesh(folder / "a.vtu"); });
}

TEST(VtkXml, HeadersThatCannotBeAreRefusedByName) {
  ASSERT_EQ(FaultOf(Tetrahedron()), "");
  for (const char* count :
       {"-1", "10000000000", "1e308", "+1", "", "1 ", "0x1", "99999999999999999999999", "nan"}) {
    for (const char* name : {"NumberOfCells=\"1\"", "NumberOfPoints=\"4\""}) {
      const std::string key(name, std::strchr(name, '='));
      const std::string fault = FaultOf(Tetrahedron(name, key + "=\"" + count + "\""));
      EXPECT_NE(fault.find(key + " is \""), std::string::npos) << count << ": " << fault;
    }
    const std::string fault = FaultOf(Tetrahedron(
        "NumberOfComponents=\"3\"", std::string("NumberOfComponents=\"") + count + "\""));
    EXPECT_NE(fault.find("NumberOfComponents is"), std::string::npos) << count << ": " << fault;
  }
  EXPECT_NE(FaultOf(Tetrahedron("\"UInt8\" Name=\"types\"", "\"Bit\" Name=\"types\"")).find("Bit"),
            std::string::npos);
}

TEST(VtkXml, NamesOfSetsMayHoldWhatXmlEscapes) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.vtu",
                  Tetrahedron("\"fixed\"", "\"a &amp; &lt;b&gt; &quot;c&apos;\""));
  EXPECT_TRUE(ReadTetMesh(folder / "a.vtu").sets.contains("a & <b> \"c'"));
  EXPECT_NE(FaultOf(Tetrahedron("\"fixed\"", "\"&bomb;\"")).find("VTU file"), std::string::npos);
}

TEST(VtkXml, CountsThatTheFileIsTooShortForAreRefused) {
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"NumberOfCells=\"1\"", "NumberOfCells=\"9999999\""},
           {"NumberOfPoints=\"4\"", "NumberOfPoints=\"9999999\""},
           {"NumberOfPoints=\"4\"", "NumberOfPoints=\"5\""},
           {"NumberOfCells=\"1\"", "NumberOfCells=\"2\""},
           {"\"offsets\" format=\"ascii\">4", "\"offsets\" format=\"ascii\">4000000000000"},
           {"\"offsets\" format=\"ascii\">4", "\"offsets\" format=\"ascii\">-4"},
           {"\"offsets\" format=\"ascii\">4", "\"offsets\" format=\"ascii\">3"},
           {"0 1 2 3<", "0 1 2 99999999999999999999<"},
           {"format=\"ascii\">10<", "format=\"ascii\">266<"},
           {"format=\"ascii\">10<", "format=\"appended\" offset=\"0\">10<"},
           {"format=\"ascii\">10<", "format=\"appended\" offset=\"-1\">10<"},
           {"format=\"ascii\">10<", "format=\"binary\">10<"},
           // 2^63 bytes, then none.
           {"format=\"ascii\">10<", "format=\"binary\">AAAAAAAAAIA=<"},
           {"UInt64\"", "UInt64\" compressor=\"vtkOtherCompressor\""}}) {
    const std::string fault = FaultOf(Tetrahedron(from, to));
    EXPECT_NE(fault.find("VTU file"), std::string::npos) << to << ": " << fault;
  }
}

// Compressed blocks say their own sizes, which are held against the array's and the file's.
TEST(VtkXml, BlockSizesThatCannotBeAreRefused) {
  const auto base64 = [](const std::vector<std::uint64_t>& words) {
    static const char* const kLetters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes(words.size() * 8, '\0'), text;
    std::memcpy(bytes.data(), words.data(), bytes.size());
    while (bytes.size() % 3 != 0) bytes += '\0';
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      unsigned bits = 0;
      for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (bytes[i + k] & 0xffu);
      for (int shift = 18; shift >= 0; shift -= 6) text += kLetters[bits >> shift & 63];
    }
    return text;
  };
  const std::uint64_t kHuge = ~std::uint64_t{0};
  for (const auto& head : std::vector<std::vector<std::uint64_t>>{{kHuge, 1, 0},
                                                                  {kHuge, 0, 1},
                                                                  {1, kHuge, 0},
                                                                  {1, 1, kHuge},
                                                                  {kHuge / 8, 8, 0},
                                                                  {0, 0, 0},
                                                                  {1, 1, 0, kHuge},
                                                                  {1, 1, 0, 0},
                                                                  {1, 1, 1, 5, 0},
                                                                  {2, 1, 0, 1, 1},
                                                                  {1, 1 << 29, 0, 8, 0}}) {
    std::string text = Tetrahedron("UInt64\"", "UInt64\" compressor=\"vtkZLibDataCompressor\"");
    const std::string from = "format=\"ascii\">10<";
    text.replace(text.find(from), from.size(), "format=\"binary\">" + base64(head) + "<");
    EXPECT_NE(FaultOf(text).find("VTU file"), std::string::npos) << FaultOf(text);
  }
}

TEST(VtkXml, DeepNestingAndForeignXmlAreRefused) {
  std::string open, close;
  for (int i = 0; i < 300'000; ++i) open += "<a>", close += "</a>";
  EXPECT_NE(FaultOf(Tetrahedron("<PointData>", open + close + "<PointData>")).find("nested more"),
            std::string::npos);
  EXPECT_NE(FaultOf(open).find("VTU file"), std::string::npos);
  // Entities that grow to gigabytes.
  EXPECT_NE(FaultOf(Tetrahedron("<VTKFile", "<!DOCTYPE v [<!ENTITY a \"aaaa\">]><VTKFile"))
                .find("VTU file"),
            std::string::npos);
  EXPECT_EQ(FaultOf(Tetrahedron("<Points>", "<!-- a <comment> --><Points>")), "");
  EXPECT_EQ(FaultOf(Tetrahedron("<Points>", "<CellData Scalars='x'/><Points>")), "");
}

TEST(VtkXml, RandomDamageOfEveryModeIsReadOrRefused) {
  std::mt19937 random(5);
  std::vector<Mode> modes = Modes();
  for (std::size_t i = 0; i < modes.size(); i += 3) {
    const std::string whole = Written(modes[i]);
    for (int k = 0; k < 24; ++k) {
      std::string bytes = whole;
      // Heads are small and full of sizes, so half of the damage is done there.
      const std::size_t reach = k % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 3000);
      for (int n = 0; n < 1 + k % 3; ++n)
        bytes[random() % reach] = static_cast<char>(k % 4 ? random() : '0' + random() % 10);
      FaultOf(bytes);
    }
  }
}

TEST(VtkXml, FilesThatAreCutOffAreRefused) {
  const std::vector<Mode> modes = Modes();
  for (std::size_t i = 0; i < modes.size(); i += 5) {
    const std::string whole = Written(modes[i]);
    const std::size_t end = whole.rfind('>');
    for (const double share : {0.0, 0.1, 0.3, 0.6, 0.9, 0.999})
      EXPECT_NE(
          FaultOf(whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(end)))), "");
  }
}

}  // namespace
}  // namespace arthro
