// Whether a mesh's TEXCOORD_1 serves as the uvs of a lightmap.
#pragma once

#include <string>

#include "bake/atlas/flat_chart.h"
#include "bake/atlas/mesh_faces.h"
#include "bake/atlas/mesh_layout.h"
#include "scenes/scene.h"

namespace parity::bake {

struct CheckedUvs {
  std::string refusal; // why they are not taken; empty: they are
  FlatChart flat;      // all faces with area, where they are taken: one rectangle of texels
  int charts = 0;
};

// The uvs are scaled, alike in u and v, so that the mesh has options.texelsPerUnit by mean over its area. Refused:
// absent or not finite; a face of almost no area in uv for what it has in space (below 1/1000 of the mean); a chart of
// less than 1/4 of the density asked for, or charts closer than the padding; faces over each other, seen at the
// sub-texels of kSubTexels; larger than a page. Charts are faces that share uvs at shared places; mirrored ones are
// fine.
CheckedUvs checkLightmapUvs(const scenes::Mesh& mesh, const MeshFaces& faces, const LayoutOptions& options);

} // namespace parity::bake
