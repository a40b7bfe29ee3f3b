// Loading of scenes: build/bench_scenes [scene files...]. Generated ones first: tangents of a million triangles, a .glb
// of a million indexed triangles, a hundred thousand nodes in a chain.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "scenes/builtin/shapes.h"
#include "scenes/gltf/tangents.h"
#include "scenes/load.h"

namespace parity {
namespace {

namespace fs = std::filesystem;

const scenes::Mesh& millionTriangles() {
  static const scenes::Mesh sphere = scenes::makeSphere(1, 1000, 501);
  return sphere;
}

void writeGlb(const fs::path& file, std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::ofstream out(file, std::ios::binary);
  const auto number = [&](std::size_t value) {
    const auto small = static_cast<std::uint32_t>(value);
    out.write(reinterpret_cast<const char*>(&small), 4);
  };
  out << "glTF";
  number(2), number(28 + json.size() + binary.size());
  number(json.size()), number(0x4E4F534A);
  out << json;
  number(binary.size()), number(0x004E4942);
  out << binary;
}

void writeMillionTriangles(const fs::path& file) {
  const scenes::Mesh& mesh = millionTriangles();
  std::string binary, views, accessors;
  const auto add = [&](const auto& values, int componentType, const char* type) {
    const std::size_t bytes = values.size() * sizeof(values[0]);
    views += fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}}})", views.empty() ? "" : ",", binary.size(),
                         bytes);
    accessors +=
        fmt::format(R"({}{{"bufferView":{},"componentType":{},"count":{},"type":"{}"}})", accessors.empty() ? "" : ",",
                    std::count(views.begin(), views.end(), '{') - 1, componentType, values.size(), type);
    binary.append(reinterpret_cast<const char*>(values.data()), bytes);
  };
  add(mesh.positions, 5126, "VEC3");
  add(mesh.normals, 5126, "VEC3");
  add(mesh.uv0, 5126, "VEC2");
  add(mesh.indices, 5125, "SCALAR");
  writeGlb(file,
           fmt::format(R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
                       R"("meshes":[{{"primitives":)"
                       R"([{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"indices":3}}]}}],)"
                       R"("buffers":[{{"byteLength":{}}}],)"
                       R"("bufferViews":[{}],"accessors":[{}]}})",
                       binary.size(), views, accessors),
           binary);
}

void writeChain(const fs::path& file) {
  std::string nodes;
  for (int i = 0; i < 100000; ++i)
    nodes += fmt::format(R"({{"name":"link","translation":[0,0,1],"children":[{}]}},)", i + 1);
  const std::array<float, 9> triangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  writeGlb(file,
           fmt::format(
               R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{}{{"mesh":0}}],)"
               R"("meshes":[{{"primitives":)"
               R"([{{"attributes":{{"POSITION":0}}}}]}}],"buffers":[{{"byteLength":36}}],"bufferViews":[{{"buffer":0,)"
               R"("byteLength":36}}],"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}]}})",
               nodes),
           std::string(reinterpret_cast<const char*>(triangle.data()), sizeof(triangle)));
}

void loadFile(benchmark::State& state, const std::string& file) {
  std::size_t triangles = 0;
  for (auto _ : state) triangles = scenes::loadScene(file).triangleCount();
  state.counters["triangles"] = static_cast<double>(triangles);
}

void makeTangents(benchmark::State& state) {
  for (auto _ : state) {
    scenes::Mesh mesh = millionTriangles();
    benchmark::DoNotOptimize(scenes::makeTangents(mesh, 0));
  }
}

} // namespace
} // namespace parity

int main(int argc, char** argv) {
  using namespace parity;
  benchmark::Initialize(&argc, argv);
  const fs::path folder = fs::temp_directory_path() / fmt::format("bench-scenes-{}", ::getpid());
  fs::create_directories(folder);
  writeMillionTriangles(folder / "million.glb");
  writeChain(folder / "chain.glb");
  std::vector<std::string> files = {(folder / "million.glb").string(), (folder / "chain.glb").string()};
  files.insert(files.end(), argv + 1, argv + argc);
  benchmark::RegisterBenchmark("tangents of a million triangles", makeTangents)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
  for (const std::string& file : files)
    benchmark::RegisterBenchmark(fs::path(file).filename().c_str(),
                                 [file](benchmark::State& state) { loadFile(state, file); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  benchmark::RunSpecifiedBenchmarks();
  fs::remove_all(folder);
}
