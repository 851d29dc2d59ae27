#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/gltf/glb_writer.h"
#include "harness/gltf/gltf.h"
#include "harness/gltf/parts.h"
#include "harness/lights/set.h"

namespace ml {
namespace {

using gltf::GlbWriter;
using gltf::OrderedJson;

constexpr size_t max_gltf_lights = 4096;
constexpr double samples_per_second = 60;  // of a moving camera
constexpr uint32_t max_samples = 14400;
constexpr double half_pi = 1.5707963267948966;  // the widest half-angle of a glTF spot

OrderedJson vector_json(const glm::dvec3& v) {
  return OrderedJson::array({v.x, v.y, v.z});
}
OrderedJson quaternion_json(const glm::dvec4& q) {
  return OrderedJson::array({q.x, q.y, q.z, q.w});
}

// A file name as a URI: what has a meaning there, or is no ASCII, is written in percent (RFC 3986, section
// 2).
std::string uri_of(const std::string& name) {
  static const std::string_view plain = "-._~!$&'()*+,;=@ ";
  static const char digits[] = "0123456789ABCDEF";
  std::string uri;
  for (char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && (std::isalnum(byte) || plain.find(c) != std::string_view::npos))
      uri += c;
    else
      uri += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  return uri;
}

// The rotation that takes -z to `direction`; square roots alone, so that every machine makes the same bits.
glm::dvec4 rotation_to(const glm::dvec3& direction) {
  glm::dvec3 d = glm::normalize(direction);
  // For the far hemisphere: half a turn about y first, which takes -z to +z.
  if (d.z > 0) return glm::normalize(glm::dvec4(0, 1 + d.z, -d.y, -d.x));
  return glm::normalize(glm::dvec4(d.y, -d.x, 0, 1 - d.z));
}

// The rotation whose columns are these.
glm::dvec4 rotation_of(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z) {
  glm::dvec4 q;
  double trace = x.x + y.y + z.z;
  if (trace > 0)
    q = {y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace};
  else if (x.x >= y.y && x.x >= z.z)
    q = {1 + x.x - y.y - z.z, x.y + y.x, z.x + x.z, y.z - z.y};
  else if (y.y >= z.z)
    q = {x.y + y.x, 1 + y.y - x.x - z.z, y.z + z.y, z.x - x.z};
  else
    q = {z.x + x.z, y.z + z.y, 1 + z.z - x.x - y.y, x.y - y.x};
  return glm::normalize(q);
}

glm::dvec4 rotation_of(const Camera& camera) {
  return rotation_of(glm::dvec3(camera.right), glm::dvec3(camera.up), -glm::dvec3(camera.forward));
}

// The rotation that takes x to the light's side and -z to its direction, where it has one.
glm::dvec4 rotation_of(const Light& light) {
  if (light.shape == LightShape::spot) return rotation_to(glm::dvec3(light.direction));
  glm::dvec3 x = glm::normalize(glm::dvec3(light.side)), z = -glm::dvec3(light.direction);
  if (light.shape == LightShape::capsule)
    z = glm::cross(x, std::abs(x.y) < 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0));
  z = glm::normalize(z);
  x = glm::normalize(x - glm::dot(x, z) * z);
  return rotation_of(x, glm::cross(z, x), z);
}

class Exporter {
 public:
  Exporter(const Scene& scene, const std::vector<Light>& lights) : scene_(scene), lights_(lights) {}

  std::vector<std::byte> write(const std::string& side_file) {
    OrderedJson own = {{"name", scene_.name},
                       {"near", scene_.near},
                       {"far", scene_.far},
                       {"origin", vector_json(scene_.origin)}};
    if (!side_file.empty()) own["lights"] = side_file;
    OrderedJson& json = out_.json();
    json["asset"] = {{"version", "2.0"}, {"generator", "manylights"}, {"extras", {{"manylights", own}}}};
    bool punctual = side_file.empty() && !lights_.empty();
    if (punctual) json["extensionsUsed"] = OrderedJson::array({"KHR_lights_punctual"});
    json["scene"] = 0;
    add_mesh();
    if (!scene_.paths.empty()) add_camera(scene_.paths[0]);
    if (punctual) add_lights();
    OrderedJson roots = OrderedJson::array();
    for (size_t i = 0; i < json["nodes"].size(); ++i) roots.push_back(i);
    json["scenes"] = OrderedJson::array({{{"name", scene_.name}, {"nodes", roots}}});
    return out_.finish();
  }

 private:
  void add_mesh() {
    std::vector<float> positions, normals, uvs;
    // Texture coordinates that no texture uses would be dead weight in every file.
    bool textured = false;
    for (const Draw& draw : scene_.draws)
      textured =
          textured || (draw.index_count > 0 && scene_.materials[draw.material].base_color_texture >= 0);
    for (const Vertex& vertex : scene_.vertices) {
      for (int c = 0; c < 3; ++c)
        positions.push_back(vertex.position[c]), normals.push_back(vertex.normal[c]);
      for (int c = 0; c < 2; ++c) uvs.push_back(vertex.uv[c]);
    }
    OrderedJson attributes;
    attributes["POSITION"] = out_.add_floats(positions, 3, GlbWriter::Target::vertices, true);
    attributes["NORMAL"] = out_.add_floats(normals, 3, GlbWriter::Target::vertices, false);
    if (textured) attributes["TEXCOORD_0"] = out_.add_floats(uvs, 2, GlbWriter::Target::vertices, false);

    std::span<const uint32_t> indices(scene_.indices);
    size_t view = out_.add_view(std::as_bytes(indices), GlbWriter::Target::indices);
    OrderedJson primitives = OrderedJson::array();
    for (const Draw& draw : scene_.draws) {
      if (draw.index_count == 0) continue;
      size_t accessor =
          out_.add_indices(indices.subspan(draw.first_index, draw.index_count), view, draw.first_index);
      primitives.push_back(
          {{"attributes", attributes}, {"indices", accessor}, {"material", material(draw.material)}});
    }
    out_.json()["meshes"] = OrderedJson::array({{{"name", scene_.name}, {"primitives", primitives}}});
    out_.json()["nodes"] = OrderedJson::array({{{"name", scene_.name}, {"mesh", 0}}});
  }

  // The index in the file; materials and textures that nothing draws are left out.
  size_t material(uint32_t index) {
    auto [known, inserted] = materials_.emplace(index, materials_.size());
    if (!inserted) return known->second;
    const Material& source = scene_.materials[index];
    OrderedJson surface = {{"baseColorFactor", quaternion_json(glm::dvec4(source.base_color))},
                           {"metallicFactor", source.metallic},
                           {"roughnessFactor", source.roughness}};
    if (source.base_color_texture >= 0)
      surface["baseColorTexture"] = {{"index", texture(source.base_color_texture)}};
    OrderedJson json = {{"name", source.name}, {"pbrMetallicRoughness", surface}};
    if (source.alpha_mode == AlphaMode::mask)
      json["alphaMode"] = "MASK", json["alphaCutoff"] = source.alpha_cutoff;
    if (source.double_sided) json["doubleSided"] = true;
    if (source.forward) json["extras"]["manylights"] = {{"forward", true}};
    out_.json()["materials"].push_back(std::move(json));
    return known->second;
  }

  size_t texture(int index) {
    auto [known, inserted] = textures_.emplace(index, textures_.size());
    if (!inserted) return known->second;
    const Texture& source = scene_.textures[static_cast<size_t>(index)];
    size_t view = out_.add_view(gltf::encode_png(source));
    out_.json()["images"].push_back({{"name", source.name}, {"mimeType", "image/png"}, {"bufferView", view}});
    out_.json()["textures"].push_back({{"source", known->second}});
    return known->second;
  }

  void add_camera(const CameraPath& path) {
    out_.json()["cameras"] = OrderedJson::array({lens(path)});
    bool moves = path.keys.size() > 1 && path.duration() > 0;
    uint32_t samples = 1;
    if (moves)
      samples = static_cast<uint32_t>(
          std::clamp(std::ceil(path.duration() * samples_per_second) + 1, 2.0, double{max_samples}));
    // glTF's time begins at 0.
    double start = std::max(path.keys.front().time, 0.0);
    std::vector<float> times, translations, rotations;
    glm::dvec4 before(0, 0, 0, 1);
    for (uint32_t i = 0; i < samples; ++i) {
      Camera camera = path.sample(i, samples, 16, 9, scene_.near, scene_.far);
      glm::dvec4 rotation = rotation_of(camera);
      if (glm::dot(rotation, before) < 0)
        rotation = -rotation;  // q and -q turn alike; near ones interpolate the short way
      before = rotation;
      times.push_back(static_cast<float>(moves ? start + path.duration() * i / (samples - 1) : 0));
      for (int c = 0; c < 3; ++c) translations.push_back(camera.position[c]);
      for (int c = 0; c < 4; ++c) rotations.push_back(static_cast<float>(rotation[c]));
    }
    size_t node = out_.json()["nodes"].size();
    out_.json()["nodes"].push_back(
        {{"name", path.name},
         {"camera", 0},
         {"translation", OrderedJson::array({translations[0], translations[1], translations[2]})},
         {"rotation", OrderedJson::array({rotations[0], rotations[1], rotations[2], rotations[3]})}});
    if (!moves) return;
    size_t input = out_.add_floats(times, 1, GlbWriter::Target::none, true);
    size_t position_output = out_.add_floats(translations, 3, GlbWriter::Target::none, false);
    size_t rotation_output = out_.add_floats(rotations, 4, GlbWriter::Target::none, false);
    auto channel = [&](int sampler, const char* what) {
      return OrderedJson{{"sampler", sampler}, {"target", {{"node", node}, {"path", what}}}};
    };
    auto sampler = [&](size_t output) {
      return OrderedJson{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}};
    };
    OrderedJson animation = {{"name", path.name}};
    animation["channels"] = OrderedJson::array({channel(0, "translation"), channel(1, "rotation")});
    animation["samplers"] = OrderedJson::array({sampler(position_output), sampler(rotation_output)});
    out_.json()["animations"] = OrderedJson::array({animation});
  }

  OrderedJson lens(const CameraPath& path) const {
    OrderedJson camera = {{"name", path.name}};
    const Projection& window = path.projection;
    bool orthographic = path.has_projection && window.kind == ProjectionKind::orthographic;
    bool symmetric = window.left == -window.right && window.bottom == -window.top;
    if (orthographic) {
      camera["type"] = "orthographic";
      camera["orthographic"] = {{"xmag", 0.5 * (double{window.right} - double{window.left})},
                                {"ymag", 0.5 * (double{window.top} - double{window.bottom})},
                                {"znear", window.near},
                                {"zfar", window.far}};
    } else {
      camera["type"] = "perspective";
      camera["perspective"] = {{"yfov", path.vertical_fov}, {"znear", near_of(path)}};
      if (path.has_projection || path.clips_far)
        camera["perspective"]["zfar"] = path.has_projection ? window.far : path.own_far;
    }
    if (path.has_projection && !(orthographic && symmetric))
      camera["extras"]["manylights"]["window"] = {window.left, window.right, window.bottom, window.top};
    return camera;
  }

  float near_of(const CameraPath& path) const {
    if (path.has_projection) return path.projection.near;
    return path.own_near > 0 ? path.own_near : scene_.near;
  }

  void add_lights() {
    OrderedJson lights = OrderedJson::array();
    for (const Light& light : lights_) {
      OrderedJson node = {{"translation", vector_json(light.position)}};
      if (light.shape != LightShape::omni) node["rotation"] = quaternion_json(rotation_of(light));
      node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
      out_.json()["nodes"].push_back(std::move(node));
      lights.push_back(light_json(light));
    }
    out_.json()["extensions"]["KHR_lights_punctual"]["lights"] = std::move(lights);
  }

  static OrderedJson light_json(const Light& light) {
    glm::dvec3 intensity(light.intensity);
    double peak = std::max({intensity.x, intensity.y, intensity.z});
    OrderedJson json = {{"type", has_cone(light.shape) ? "spot" : "point"},
                        {"color", vector_json(peak > 0 ? intensity / peak : glm::dvec3(1))},
                        {"intensity", peak},
                        {"range", light.radius}};
    OrderedJson own;
    if (has_segment(light.shape) || light.shape == LightShape::box)
      own["shape"] = light_shape_names()[static_cast<size_t>(light.shape)];
    if (has_segment(light.shape)) own["half_length"] = light.half_length;
    if (light.shape == LightShape::box) own["half_extents"] = vector_json(glm::dvec3(light.half_extents));
    if (has_cone(light.shape)) add_cone(light, json, own);
    if (light.probe) own["probe"] = true;
    if (!own.is_null()) json["extras"]["manylights"] = own;
    return json;
  }

  static void add_cone(const Light& light, OrderedJson& json, OrderedJson& own) {
    // glTF's cones end at 90 degrees and never have a sharp edge; ours are kept beside them.
    double outer = std::min(double{light.outer_angle}, half_pi);
    double inner = std::min(double{light.inner_angle}, outer * (1 - 1e-6));
    json["spot"] = {{"innerConeAngle", inner}, {"outerConeAngle", outer}};
    if (inner != double{light.inner_angle} || outer != double{light.outer_angle})
      own["cone"] = {light.inner_angle, light.outer_angle};
  }

  const Scene& scene_;
  const std::vector<Light>& lights_;
  GlbWriter out_;
  std::map<uint32_t, size_t> materials_;
  std::map<int, size_t> textures_;
};

}  // namespace

void export_glb(const Scene& scene, const std::vector<Light>& lights, const std::filesystem::path& file) {
  if (scene.indices.empty()) throw UsageError(file.string() + ": the scene has no triangles to export");
  if (lights.size() > gltf::max_file_lights)
    throw UsageError(file.string() + ": " + std::to_string(lights.size()) + " lights, more than " +
                     std::to_string(gltf::max_file_lights));
  for (size_t i = 0; i < lights.size(); ++i)
    if (const char* reason = rejection_reason(lights[i]))
      throw UsageError(file.string() + ": cannot export light " + std::to_string(i) + ": " + reason);

  std::filesystem::path side_file;
  if (lights.size() > max_gltf_lights) side_file = file.string() + ".lights.bin";
  std::vector<std::byte> glb = Exporter(scene, lights).write(uri_of(side_file.filename().string()));
  if (!side_file.empty()) write_file(side_file, gltf::encode_lights(lights));
  write_file(file, glb);
}

}  // namespace ml
