#include "harness/scene/mesh_builder.h"

#include <bit>
#include <cmath>
#include <utility>

#include "harness/base/check.h"
#include "harness/base/random.h"
#include "harness/scene/turn.h"

namespace ml {

double quantised(double value) {
  return std::floor(value * 1024 + 0.5) / 1024;
}

glm::dvec3 quantised(const glm::dvec3& value) {
  return {quantised(value.x), quantised(value.y), quantised(value.z)};
}

size_t MeshBuilder::KeyHash::operator()(const Key& key) const {
  uint32_t hash = 0;
  for (float value : key.values) hash = hash_u32(hash, std::bit_cast<uint32_t>(value));
  return hash;
}

uint32_t MeshBuilder::add_material(const Material& material) {
  materials_.push_back(material);
  indices_.emplace_back();
  return static_cast<uint32_t>(materials_.size() - 1);
}

uint32_t MeshBuilder::vertex(const glm::dvec3& position, const glm::dvec3& normal) {
  // Adding +0 turns -0 into +0: one position has one bit pattern.
  glm::vec3 p = glm::vec3(quantised(position)) + glm::vec3(0);
  glm::vec3 n = glm::vec3(normal / std::sqrt(glm::dot(normal, normal))) + glm::vec3(0);
  auto [found, is_new] =
      known_.try_emplace(Key{{p.x, p.y, p.z, n.x, n.y, n.z}}, static_cast<uint32_t>(vertices_.size()));
  if (is_new) vertices_.push_back({p, n, glm::vec2(0)});
  return found->second;
}

void MeshBuilder::smooth_triangle(uint32_t a, uint32_t b, uint32_t c, uint32_t material) {
  glm::dvec3 pa(vertices_[a].position), pb(vertices_[b].position), pc(vertices_[c].position);
  glm::dvec3 normal = glm::cross(pb - pa, pc - pa);
  if (glm::dot(normal, normal) == 0) return;
  for (uint32_t index : {a, b, c}) indices_[material].push_back(index);
}

void MeshBuilder::triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, uint32_t material) {
  glm::dvec3 qa = quantised(a), qb = quantised(b), qc = quantised(c);
  glm::dvec3 normal = glm::cross(qb - qa, qc - qa);
  if (glm::dot(normal, normal) == 0) return;
  // In statements: the order in which arguments are evaluated is the compiler's, and it would number
  // vertices.
  uint32_t ia = vertex(qa, normal), ib = vertex(qb, normal), ic = vertex(qc, normal);
  smooth_triangle(ia, ib, ic, material);
}

void MeshBuilder::quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
                       uint32_t material) {
  triangle(a, b, c, material);
  triangle(a, c, d, material);
}

void MeshBuilder::box(const glm::dvec3& lo, const glm::dvec3& hi, uint32_t material, unsigned faces) {
  ML_CHECK(lo.x < hi.x && lo.y < hi.y && lo.z < hi.z);
  std::array<glm::dvec3, 8> corners;
  for (size_t i = 0; i < 8; ++i) corners[i] = {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z};
  block(corners, material, faces);
}

void MeshBuilder::block(const std::array<glm::dvec3, 8>& c, uint32_t material, unsigned faces) {
  if (faces & west) quad(c[0], c[4], c[6], c[2], material);
  if (faces & east) quad(c[5], c[1], c[3], c[7], material);
  if (faces & bottom) quad(c[0], c[1], c[5], c[4], material);
  if (faces & top) quad(c[6], c[7], c[3], c[2], material);
  if (faces & north) quad(c[1], c[0], c[2], c[3], material);
  if (faces & south) quad(c[4], c[5], c[7], c[6], material);
}

void MeshBuilder::prism(const glm::dvec3& foot, double height, double foot_radius, double top_radius,
                        int sides, uint32_t material) {
  auto rim = [&](int i, double radius, double y) {
    double turns = (i + 0.5) / sides;
    return foot + glm::dvec3(radius * cosine_of_turns(turns), y, -radius * sine_of_turns(turns));
  };
  for (int i = 0; i < sides; ++i) {
    quad(rim(i, foot_radius, 0), rim(i + 1, foot_radius, 0), rim(i + 1, top_radius, height),
         rim(i, top_radius, height), material);
    triangle(foot + glm::dvec3(0, height, 0), rim(i, top_radius, height), rim(i + 1, top_radius, height),
             material);
  }
}

void MeshBuilder::cone(const glm::dvec3& foot, double height, double radius, int sides, uint32_t material) {
  prism(foot, height, radius, 0, sides, material);
  auto rim = [&](int i) {
    double turns = (i + 0.5) / sides;
    return foot + glm::dvec3(radius * cosine_of_turns(turns), 0, -radius * sine_of_turns(turns));
  };
  for (int i = 1; i + 1 < sides; ++i) triangle(rim(0), rim(i + 1), rim(i), material);
}

Scene MeshBuilder::finish() {
  Scene scene;
  scene.vertices = std::exchange(vertices_, {});
  scene.materials = std::exchange(materials_, {});
  known_.clear();
  for (uint32_t material = 0; material < indices_.size(); ++material) {
    const std::vector<uint32_t>& run = indices_[material];
    if (run.empty()) continue;
    scene.draws.push_back(
        {static_cast<uint32_t>(scene.indices.size()), static_cast<uint32_t>(run.size()), material});
    scene.indices.insert(scene.indices.end(), run.begin(), run.end());
  }
  indices_.clear();
  if (!scene.vertices.empty()) {
    scene.bounds = {scene.vertices[0].position, scene.vertices[0].position};
    for (const Vertex& v : scene.vertices) {
      scene.bounds.min = glm::min(scene.bounds.min, v.position);
      scene.bounds.max = glm::max(scene.bounds.max, v.position);
    }
  }
  return scene;
}

}  // namespace ml
