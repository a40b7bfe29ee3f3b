// A mesh's rectangles of texels.
#include "bake/atlas/mesh_layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bake/atlas/flat_chart.h"
#include "bake/atlas/mesh_faces.h"
#include "bake/atlas/packing.h"
#include "bake/atlas/uv_check.h"
#include "base/error.h"

namespace parity::bake {
namespace {

// Texels; by its area, a chart of less is merged with a neighbour where it may be.
constexpr double kTinyChartTexels = 9;

void checkMesh(const scenes::Mesh& mesh) {
  for (const std::uint32_t index : mesh.indices)
    if (index >= mesh.positions.size())
      throw base::fileError(mesh.name, "", fmt::format("its index {} is out of range of its vertices", index));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw base::fileError(mesh.name, "",
                            fmt::format("the position of vertex {} is not finite, so it gets no lightmap", i));
  }
}

void addPiece(FlatChart chart, int padding, MeshLayout& layout) {
  const double margin = std::floor(0.5 * padding); // of an odd padding the smaller part
  for (std::size_t i = 0; i < chart.faces.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      layout.corners[3 * std::size_t{chart.faces[i]} + k] = chart.corners[i][k] + margin;
  Profile profile = makeProfile(chart, padding);
  layout.pieces.push_back({chart.size + padding, std::move(chart.faces), std::move(profile)});
}

} // namespace

MeshLayout layOutMesh(const scenes::Mesh& mesh, const LayoutOptions& options) {
  checkMesh(mesh);
  MeshLayout layout;
  const MeshFaces faces = makeMeshFaces(mesh);
  if (!(faces.area > 0)) {
    layout.note = "no lightmap (no triangle has an area)";
    return layout;
  }
  layout.corners.assign(mesh.indices.size(), glm::vec2(0));
  CheckedUvs uvs = checkLightmapUvs(mesh, faces, options);
  if (uvs.refusal.empty()) {
    layout.charts = uvs.charts;
    layout.note = "TEXCOORD_1";
    addPiece(std::move(uvs.flat), options.padding, layout);
    return layout;
  }
  const double tinyArea = kTinyChartTexels / (options.texelsPerUnit * options.texelsPerUnit);
  for (const Chart& chart : makeCharts(faces, tinyArea))
    for (FlatChart& flat :
         flattenChart(mesh, faces, chart, options.texelsPerUnit, options.padding, options.maxSide - options.padding))
      addPiece(std::move(flat), options.padding, layout);
  layout.charts = static_cast<int>(layout.pieces.size());
  layout.note =
      fmt::format("unwrapped into {} chart{} ({})", layout.charts, layout.charts == 1 ? "" : "s", uvs.refusal);
  return layout;
}

void joinPieces(const scenes::Mesh& mesh, int maxSide, MeshLayout& layout) {
  if (layout.pieces.size() < 2) return;
  std::vector<Rectangle> rectangles;
  for (const Piece& piece : layout.pieces) rectangles.push_back(piece.rectangle());
  const Packing packing = packTight(rectangles);
  const int side = std::max(packing.width, packing.height);
  if (side > maxSide)
    throw base::fileError(mesh.name, "",
                          fmt::format("needs a lightmap page of {} texels a side, but the most is {}; lower "
                                      "--texels-per-metre or split the mesh",
                                      side, maxSide));
  Piece joined{{packing.width, packing.height}, {}, {}};
  for (std::size_t i = 0; i < layout.pieces.size(); ++i) {
    movePiece(layout, i, packing.corners[i]);
    const std::vector<std::uint32_t>& triangles = layout.pieces[i].triangles;
    joined.triangles.insert(joined.triangles.end(), triangles.begin(), triangles.end());
  }
  layout.pieces = {std::move(joined)};
}

void movePiece(MeshLayout& layout, std::size_t piece, const glm::ivec2& by) {
  for (const std::uint32_t triangle : layout.pieces[piece].triangles)
    for (std::size_t k = 0; k < 3; ++k) layout.corners[3 * std::size_t{triangle} + k] += glm::vec2(by);
}

} // namespace parity::bake
