// A mesh's block of texels: its charts, packed.
#include "bake/mesh_layout.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "bake/flat_chart.h"
#include "bake/mesh_faces.h"
#include "bake/packing.h"
#include "bake/uv_check.h"
#include "base/error.h"

namespace parity::bake {
namespace {

// Texels; by its area, a chart of less is merged with a neighbour where it may be.
constexpr double kTinyChartTexels = 9;

void checkMesh(const scenes::Mesh& mesh) {
  for (const std::uint32_t index : mesh.indices)
    if (index >= mesh.positions.size())
      throw base::fileError(mesh.name, "", fmt::format("has an index, {}, beyond its vertices", index));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw base::fileError(mesh.name, "", fmt::format("the position of vertex {} is not finite: no lightmap", i));
  }
}

// Puts charts into the block, each with its padding around it.
void packCharts(const scenes::Mesh& mesh, const std::vector<FlatChart>& charts, const LayoutOptions& options,
                MeshLayout& layout) {
  std::vector<glm::ivec2> sizes;
  sizes.reserve(charts.size());
  for (const FlatChart& chart : charts) sizes.push_back(chart.size + options.padding);
  const Packing packing = packTight(sizes);
  layout.size = {packing.width, packing.height};
  const int side = std::max(packing.width, packing.height);
  if (side > options.maxSide)
    throw base::fileError(mesh.name, "",
                          fmt::format("needs a lightmap page of {} texels a side, and one has at most {}: lower "
                                      "--texels-per-metre, or divide the mesh",
                                      side, options.maxSide));
  layout.corners.assign(mesh.indices.size(), glm::vec2(0));
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const glm::dvec2 corner = packing.corners[i] + options.padding / 2;
    for (std::size_t f = 0; f < charts[i].faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        layout.corners[3 * std::size_t{charts[i].faces[f]} + k] = corner + charts[i].corners[f][k];
  }
}

} // namespace

MeshLayout layOutMesh(const scenes::Mesh& mesh, const LayoutOptions& options) {
  checkMesh(mesh);
  MeshLayout layout;
  const MeshFaces faces = makeMeshFaces(mesh);
  if (!(faces.area > 0)) {
    layout.note = "no lightmap (all its triangles are without area)";
    return layout;
  }
  CheckedUvs uvs = checkLightmapUvs(mesh, faces, options);
  if (uvs.refusal.empty()) {
    layout.charts = uvs.charts;
    layout.fromFile = true;
    layout.note = "TEXCOORD_1";
    packCharts(mesh, {std::move(uvs.flat)}, options, layout);
    return layout;
  }
  std::vector<FlatChart> charts;
  const double tinyArea = kTinyChartTexels / (options.texelsPerUnit * options.texelsPerUnit);
  for (const Chart& chart : makeCharts(faces, tinyArea)) {
    std::vector<FlatChart> parts =
        flattenChart(mesh, faces, chart, options.texelsPerUnit, options.padding, options.maxSide - options.padding);
    std::move(parts.begin(), parts.end(), std::back_inserter(charts));
  }
  packCharts(mesh, charts, options, layout);
  layout.charts = static_cast<int>(charts.size());
  layout.note =
      fmt::format("unwrapped into {} chart{} ({})", charts.size(), charts.size() == 1 ? "" : "s", uvs.refusal);
  return layout;
}

} // namespace parity::bake
