#include "harness/scene/mesh_builder.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <utility>

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
  // Adding +0 turns -0 into +0: one place has one bit pattern.
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
  smooth_triangle(vertex(qa, normal), vertex(qb, normal), vertex(qc, normal), material);
}

void MeshBuilder::quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
                       uint32_t material) {
  triangle(a, b, c, material);
  triangle(a, c, d, material);
}

void MeshBuilder::box(const glm::dvec3& lo, const glm::dvec3& hi, uint32_t material, unsigned faces) {
  assert(lo.x < hi.x && lo.y < hi.y && lo.z < hi.z);
  auto corner = [&](int x, int y, int z) {
    return glm::dvec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  if (faces & west) quad(corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0), material);
  if (faces & east) quad(corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), material);
  if (faces & bottom) quad(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1), material);
  if (faces & top) quad(corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0), material);
  if (faces & north) quad(corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), material);
  if (faces & south) quad(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1), material);
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
