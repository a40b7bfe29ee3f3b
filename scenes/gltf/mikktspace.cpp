// MikkTSpace: welding, groups of corners at each vertex, and their weighted sums.
#include "scenes/gltf/mikktspace.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/parallel.h"
#include "scenes/gltf/corner_lists.h"

namespace parity::scenes {
namespace {

using Index = std::uint32_t;

// The sign of a triangle's area in uv, or why it has none.
enum class Facing : std::int8_t { negative = -1, any = 0, positive = 1, degenerate = 2 };
bool isOriented(Facing facing) { return facing == Facing::positive || facing == Facing::negative; }

std::size_t nextCorner(std::size_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
std::size_t previousCorner(std::size_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

// Twice the area in uv, and dP/du times it (eq. 18), seen from corner c. Differences and products of 32-bit numbers are
// all but exact in 64 bits.
struct Gradient {
  double area;
  glm::dvec3 along;
};
Gradient gradientAt(const TangentInput& mesh, std::size_t c) {
  const Index i = mesh.indices[c], j = mesh.indices[nextCorner(c)], k = mesh.indices[previousCorner(c)];
  const glm::dvec3 p = mesh.positions[i], e1 = glm::dvec3(mesh.positions[j]) - p;
  const glm::dvec3 e2 = glm::dvec3(mesh.positions[k]) - p;
  const glm::dvec2 w = mesh.uv[i], d1 = glm::dvec2(mesh.uv[j]) - w, d2 = glm::dvec2(mesh.uv[k]) - w;
  return {d1.x * d2.y - d1.y * d2.x, e1 * d2.y - e2 * d1.y};
}

Facing facingOf(const TangentInput& mesh, std::size_t triangle) {
  const Index* i = &mesh.indices[3 * triangle];
  const glm::vec3 &a = mesh.positions[i[0]], &b = mesh.positions[i[1]], &c = mesh.positions[i[2]];
  if (a == b || b == c || c == a) return Facing::degenerate;
  const Gradient gradient = gradientAt(mesh, 3 * triangle);
  constexpr double kLeast = std::numeric_limits<float>::min(); // the public code's
  if (!(std::abs(gradient.area) > kLeast) || !(glm::length(gradient.along) > kLeast)) return Facing::any;
  return gradient.area > 0 ? Facing::positive : Facing::negative;
}

// For each vertex the number of its class: same position, normal and uv. An open-addressing hash table.
std::vector<Index> weldVertices(const TangentInput& mesh) {
  struct Key {
    std::array<std::uint32_t, 8> words;
  };
  const auto keyOf = [&](std::size_t v) {
    const glm::vec3 &p = mesh.positions[v], &n = mesh.normals[v];
    const std::array<float, 8> values = {p.x, p.y, p.z, n.x, n.y, n.z, mesh.uv[v].x, mesh.uv[v].y};
    Key key;
    for (std::size_t i = 0; i < 8; ++i) key.words[i] = std::bit_cast<std::uint32_t>(values[i] + 0.f); // -0 is 0
    return key;
  };
  const auto hashOf = [](const Key& key) {
    std::uint64_t hash = 0;
    for (const std::uint32_t word : key.words) { // splitmix64's mixing (Steele et al. 2014) of each word in turn
      hash = (hash ^ word) * 0xBF58476D1CE4E5B9u;
      hash ^= hash >> 29;
    }
    hash *= 0x94D049BB133111EBu;
    return hash ^ hash >> 32;
  };
  constexpr Index kEmpty = ~Index{0};
  const std::size_t count = mesh.positions.size(), mask = std::bit_ceil(2 * count + 1) - 1;
  std::vector<Index> table(mask + 1, kEmpty), welded(count);
  for (std::size_t v = 0; v < count; ++v) {
    const Key key = keyOf(v);
    std::size_t slot = hashOf(key) & mask;
    while (table[slot] != kEmpty && keyOf(table[slot]).words != key.words) slot = (slot + 1) & mask;
    if (table[slot] == kEmpty) table[slot] = static_cast<Index>(v);
    welded[v] = table[slot];
  }
  return welded;
}

// An edge of a triangle as it runs through it.
struct Edge {
  Index from, to, triangle;
  bool operator<(const Edge& other) const {
    return std::tie(from, to, triangle) < std::tie(other.from, other.to, other.triangle);
  }
};

// Gives the triangles of Facing::any the orientation of their neighbours over edges, ring by ring outwards from those
// that have one. What touches none keeps Facing::any.
void orientUndirected(std::span<const Index> vertexAt, std::vector<Facing>& facings) {
  std::vector<Edge> edges; // of the undirected ones
  const auto edgeOf = [&](std::size_t c) { return Edge{vertexAt[c], vertexAt[nextCorner(c)], Index(c / 3)}; };
  for (std::size_t c = 0; c < vertexAt.size(); ++c)
    if (facings[c / 3] == Facing::any) edges.push_back(edgeOf(c));
  if (edges.empty()) return;
  std::sort(edges.begin(), edges.end());

  // Every edge of a ring is summed before the other side is looked at, and each side is looked at once: linear but for
  // sorting, however many triangles share an edge.
  struct Vote {
    Index from, to;
    std::int64_t sum;
  };
  std::vector<std::int64_t> votes(facings.size(), 0);
  std::vector<bool> isDone(edges.size()); // by the first of a side
  std::vector<Vote> sides;
  std::vector<Index> ring, touched;
  for (std::size_t t = 0; t < facings.size(); ++t)
    if (isOriented(facings[t])) ring.push_back(static_cast<Index>(t));
  while (!ring.empty()) {
    touched.clear();
    sides.clear();
    for (const Index t : ring)
      for (std::size_t c = 3 * std::size_t{t}; c < 3 * std::size_t{t} + 3; ++c) {
        const Edge edge = edgeOf(c);
        sides.push_back({edge.to, edge.from, static_cast<int>(facings[t])}); // as the other side runs
      }
    std::sort(sides.begin(), sides.end(),
              [](const Vote& a, const Vote& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
    for (std::size_t i = 0; i < sides.size();) {
      const Vote& side = sides[i];
      std::int64_t sum = 0;
      for (; i < sides.size() && sides[i].from == side.from && sides[i].to == side.to; ++i) sum += sides[i].sum;
      auto found = std::lower_bound(edges.begin(), edges.end(), Edge{side.from, side.to, 0});
      const auto place = static_cast<std::size_t>(found - edges.begin());
      if (found == edges.end() || isDone[place]) continue;
      bool isOurs = false;
      for (; found != edges.end() && found->from == side.from && found->to == side.to; ++found) {
        isOurs = true;
        if (facings[found->triangle] != Facing::any) continue;
        votes[found->triangle] += sum;
        touched.push_back(found->triangle);
      }
      if (isOurs) isDone[place] = true; // all of them are oriented after this ring
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const Index t : touched) facings[t] = votes[t] < 0 ? Facing::negative : Facing::positive;
    std::swap(ring, touched);
  }
}

// What one corner adds to its group: a direction in the vertex's plane times an angle; 0 where there is none.
struct Contribution {
  glm::dvec3 direction{0}; // unit
  double angle = 0;
};
Contribution contributionOf(const TangentInput& mesh, std::size_t c) {
  const Index at = mesh.indices[c];
  const glm::dvec3 normal = mesh.normals[at], p = mesh.positions[at];
  const auto inPlane = [&](const glm::dvec3& v) { return v - normal * glm::dot(normal, v); };
  const Gradient gradient = gradientAt(mesh, c);
  const glm::dvec3 along = inPlane(gradient.along) * (gradient.area > 0 ? 1.0 : -1.0);
  const double length = glm::length(along);
  if (!(length > 1e-9 * glm::length(gradient.along))) return {};
  const glm::dvec3 a = inPlane(glm::dvec3(mesh.positions[mesh.indices[nextCorner(c)]]) - p);
  const glm::dvec3 b = inPlane(glm::dvec3(mesh.positions[mesh.indices[previousCorner(c)]]) - p);
  const bool hasAngle = glm::dot(a, a) > 0 && glm::dot(b, b) > 0;
  return {along / length, hasAngle ? std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) : M_PI_2};
}

// A sum that is the same in any order: in units of 2^-38.
struct Sum {
  std::array<std::uint64_t, 4> parts{};    // x, y, z, angle
  static constexpr double kUnit = 0x1p-38; // 2^25 right angles and more

  void add(const Contribution& c) {
    const glm::dvec4 values = glm::dvec4(c.direction, 1.0) * (c.angle / kUnit);
    for (int i = 0; i < 4; ++i)
      parts[static_cast<std::size_t>(i)] += static_cast<std::uint64_t>(std::llround(values[i]));
  }
  double part(std::size_t i) const { return static_cast<double>(static_cast<std::int64_t>(parts[i])) * kUnit; }
  glm::dvec3 direction() const { return {part(0), part(1), part(2)}; }
};

// The work at one vertex; the vectors keep their memory from vertex to vertex.
class VertexGroups {
public:
  VertexGroups(const TangentInput& mesh, std::span<const Index> vertexAt, std::span<const Facing> own,
               std::span<const Facing> facings)
      : m_mesh(mesh), m_vertexAt(vertexAt), m_own(own), m_facings(facings) {}

  // Writes the tangents of `corners`, which are all that lie at one vertex.
  void settle(std::span<const Index> corners, std::span<glm::vec4> tangents) {
    group(corners);
    sum(corners);
    const glm::vec4 best = findBest();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const glm::vec4 own = m_tangents[root(static_cast<Index>(i))];
      tangents[corners[i]] = own.w != 0 ? own : best;
      if (own.w == 0 && m_contributions[i].direction != glm::dvec3(0))
        tangents[corners[i]] = signedTangent(m_contributions[i].direction, facing(corners[i]));
    }
  }

private:
  // One end of an edge at the vertex, as a corner sees it.
  struct Link {
    Index neighbour;
    Facing facing;
    bool leaves; // the triangle runs from the vertex to the neighbour
    Index corner;
    bool operator<(const Link& other) const {
      return std::tie(neighbour, facing) < std::tie(other.neighbour, other.facing);
    }
  };

  Facing facing(std::size_t corner) const { return m_facings[corner / 3]; }
  Index root(Index i) {
    while (m_parents[i] != i) i = m_parents[i] = m_parents[m_parents[i]];
    return i;
  }
  static glm::vec4 signedTangent(const glm::dvec3& direction, Facing facing) {
    return {glm::vec3(direction), facing == Facing::positive ? -1.f : 1.f};
  }

  // Joins the corners that share an edge, seen from both of its sides, and a facing.
  void group(std::span<const Index> corners) {
    m_parents.resize(corners.size());
    std::iota(m_parents.begin(), m_parents.end(), Index{0});
    m_links.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t c = corners[i];
      if (!isOriented(facing(c))) continue;
      m_links.push_back({m_vertexAt[nextCorner(c)], facing(c), true, static_cast<Index>(i)});
      m_links.push_back({m_vertexAt[previousCorner(c)], facing(c), false, static_cast<Index>(i)});
    }
    std::sort(m_links.begin(), m_links.end());
    for (auto first = m_links.begin(); first != m_links.end();) {
      const auto last = std::find_if(first, m_links.end(), [&](const Link& link) { return *first < link; });
      if (std::any_of(first, last, [&](const Link& link) { return link.leaves != first->leaves; }))
        for (auto link = first + 1; link != last; ++link) m_parents[root(link->corner)] = root(first->corner);
      first = last;
    }
  }

  void sum(std::span<const Index> corners) {
    m_sums.assign(corners.size(), {});
    m_contributions.assign(corners.size(), {});
    m_tangents.assign(corners.size(), glm::vec4(0));
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (isOriented(m_own[corners[i] / 3])) {
        m_contributions[i] = contributionOf(m_mesh, corners[i]);
        m_sums[root(static_cast<Index>(i))].add(m_contributions[i]);
      }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const glm::dvec3 direction = m_sums[i].direction();
      const double length = glm::length(direction);
      if (length > 1e-9) m_tangents[i] = signedTangent(direction / length, facing(corners[i]));
    }
  }

  // The tangent of the group with the largest sum of angles; by value where two have the same.
  glm::vec4 findBest() const {
    std::size_t best = m_tangents.size();
    const auto rank = [&](std::size_t i) {
      const glm::vec4& t = m_tangents[i];
      return std::tuple(m_sums[i].parts[3], t.w, t.x, t.y, t.z);
    };
    for (std::size_t i = 0; i < m_tangents.size(); ++i)
      if (m_tangents[i].w != 0 && (best == m_tangents.size() || rank(i) > rank(best))) best = i;
    return best < m_tangents.size() ? m_tangents[best] : glm::vec4(0);
  }

  const TangentInput& m_mesh;
  std::span<const Index> m_vertexAt;
  std::span<const Facing> m_own; // before and after orientUndirected
  std::span<const Facing> m_facings;
  std::vector<Index> m_parents;
  std::vector<Link> m_links;
  std::vector<Sum> m_sums;
  std::vector<Contribution> m_contributions;
  std::vector<glm::vec4> m_tangents;
};

} // namespace

std::vector<glm::vec4> makeCornerTangents(const TangentInput& mesh) {
  std::vector<Index> vertexAt(mesh.indices.size());
  {
    const std::vector<Index> welded = weldVertices(mesh);
    for (std::size_t c = 0; c < vertexAt.size(); ++c) vertexAt[c] = welded[mesh.indices[c]];
  }
  std::vector<Facing> facings(mesh.indices.size() / 3);
  constexpr std::size_t kGrain = 16384;
  base::parallelFor(facings.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) facings[t] = facingOf(mesh, t);
  });
  const std::vector<Facing> own = facings;
  orientUndirected(vertexAt, facings);

  const CornerLists lists(vertexAt, mesh.positions.size());
  std::vector<glm::vec4> tangents(mesh.indices.size(), glm::vec4(0));
  base::parallelFor(lists.vertexCount(), kGrain, [&](std::size_t begin, std::size_t end) {
    VertexGroups groups(mesh, vertexAt, own, facings);
    for (std::size_t v = begin; v < end; ++v)
      if (!lists.at(v).empty()) groups.settle(lists.at(v), tangents);
  });
  return tangents;
}

} // namespace parity::scenes
