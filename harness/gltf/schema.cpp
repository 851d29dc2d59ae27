// What the importer reads of a glTF description, as a table: anything else is left behind, and what is there
// has the type, the range and the reference that glTF 2.0 demands (Khronos, "glTF 2.0 Specification", section
// 5, and the extensions that extensions.cpp knows).
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "harness/base/error.h"
#include "harness/gltf/file.h"

namespace ml::gltf {
namespace {

enum class Kind { integer, number, boolean, text, numbers, references, object, objects };

struct Field {
  const char* key;
  Kind kind;
  bool required = false;
  // Members of `extras` may have any type: what is not an object there is somebody else's, and is passed
  // over.
  bool lenient = false;
  double low = -std::numeric_limits<double>::max(), high = std::numeric_limits<double>::max();
  size_t length = 0;                    // of `numbers`
  const char* target = nullptr;         // integer, references: an index into this array of the file
  std::vector<std::string> words = {};  // text: the allowed ones, empty for any
  std::vector<double> values = {};      // integer: the allowed ones, empty for any
  std::vector<Field> fields = {};       // object, objects
};
using Fields = std::vector<Field>;

constexpr double max_integer = 2147483647;  // tinygltf keeps indices and offsets in int
constexpr double tiny = std::numeric_limits<double>::denorm_min();
const char* const lights_array = "extensions.KHR_lights_punctual.lights";

Field required(Field field) {
  field.required = true;
  return field;
}
Field lenient(Field field) {
  field.lenient = true;
  return field;
}
Field size(const char* key, double low = 0, double high = max_integer) {
  return {.key = key, .kind = Kind::integer, .low = low, .high = high};
}
Field one_of(const char* key, std::vector<double> values) {
  return {.key = key, .kind = Kind::integer, .values = std::move(values)};
}
Field reference(const char* key, const char* target) {
  return {.key = key, .kind = Kind::integer, .target = target};
}
Field references(const char* key, const char* target) {
  return {.key = key, .kind = Kind::references, .target = target};
}
Field number(const char* key, double low = -std::numeric_limits<double>::max(),
             double high = std::numeric_limits<double>::max()) {
  return {.key = key, .kind = Kind::number, .low = low, .high = high};
}
Field numbers(const char* key, size_t length) {
  return {.key = key, .kind = Kind::numbers, .length = length};
}
Field boolean(const char* key) {
  return {.key = key, .kind = Kind::boolean};
}
Field text(const char* key, std::vector<std::string> words = {}) {
  return {.key = key, .kind = Kind::text, .words = std::move(words)};
}
Field object(const char* key, Fields fields) {
  return {.key = key, .kind = Kind::object, .fields = std::move(fields)};
}
Field objects(const char* key, Fields fields) {
  return {.key = key, .kind = Kind::objects, .fields = std::move(fields)};
}
// What the bench's own exporter keeps in `extras`.
Field own_extras(Fields fields) {
  return lenient(object("extras", {lenient(object("manylights", std::move(fields)))}));
}

Fields node_fields() {
  return {text("name"),
          reference("mesh", "meshes"),
          reference("skin", "skins"),
          reference("camera", "cameras"),
          references("children", "nodes"),
          numbers("matrix", 16),
          numbers("translation", 3),
          numbers("rotation", 4),
          numbers("scale", 3),
          object("extensions", {object("KHR_lights_punctual", {required(reference("light", lights_array))}),
                                object("KHR_node_visibility", {boolean("visible")}),
                                object("EXT_mesh_gpu_instancing",
                                       {object("attributes", {reference("TRANSLATION", "accessors"),
                                                              reference("ROTATION", "accessors"),
                                                              reference("SCALE", "accessors")})})})};
}

Fields primitive_fields() {
  static const char* const names[] = {
      "POSITION",   "NORMAL",     "TANGENT",    "COLOR_0",    "TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_2",
      "TEXCOORD_3", "TEXCOORD_4", "TEXCOORD_5", "TEXCOORD_6", "TEXCOORD_7", "JOINTS_0",   "JOINTS_1",
      "JOINTS_2",   "JOINTS_3",   "JOINTS_4",   "JOINTS_5",   "JOINTS_6",   "JOINTS_7",   "WEIGHTS_0",
      "WEIGHTS_1",  "WEIGHTS_2",  "WEIGHTS_3",  "WEIGHTS_4",  "WEIGHTS_5",  "WEIGHTS_6",  "WEIGHTS_7"};
  Fields attributes;
  for (const char* name : names) attributes.push_back(reference(name, "accessors"));
  return {required(object("attributes", attributes)), reference("indices", "accessors"),
          reference("material", "materials"), size("mode", 0, 6)};
}

Fields accessor_fields() {
  return {
      reference("bufferView", "bufferViews"),
      size("byteOffset"),
      required(one_of("componentType", {5120, 5121, 5122, 5123, 5125, 5126})),
      boolean("normalized"),
      required(size("count", 1)),
      required(text("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"})),
      object(
          "sparse",
          {required(size("count", 1)),
           required(object("indices", {required(reference("bufferView", "bufferViews")), size("byteOffset"),
                                       required(one_of("componentType", {5121, 5123, 5125}))})),
           required(
               object("values", {required(reference("bufferView", "bufferViews")), size("byteOffset")}))})};
}

Field texture(const char* key) {
  Field transform = object("KHR_texture_transform", {numbers("offset", 2), number("rotation"),
                                                     numbers("scale", 2), size("texCoord", 0, 7)});
  return object(key, {required(reference("index", "textures")), size("texCoord", 0, 7), number("scale"),
                      object("extensions", {transform})});
}

Fields material_fields() {
  return {text("name"),
          object("pbrMetallicRoughness",
                 {numbers("baseColorFactor", 4), texture("baseColorTexture"), number("metallicFactor"),
                  number("roughnessFactor"), texture("metallicRoughnessTexture")}),
          texture("normalTexture"),
          texture("emissiveTexture"),
          numbers("emissiveFactor", 3),
          object("extensions", {object("KHR_materials_emissive_strength", {number("emissiveStrength", 0)})}),
          text("alphaMode", {"OPAQUE", "MASK", "BLEND"}),
          number("alphaCutoff", 0),
          boolean("doubleSided"),
          own_extras({boolean("forward")})};
}

Fields camera_fields() {
  return {text("name"), required(text("type", {"perspective", "orthographic"})),
          object("perspective", {required(number("yfov", tiny, 3.1415926)), required(number("znear", tiny)),
                                 number("zfar", tiny), number("aspectRatio", tiny)}),
          object("orthographic", {required(number("xmag")), required(number("ymag")),
                                  required(number("znear", 0)), required(number("zfar", tiny))}),
          own_extras({numbers("window", 4)})};
}

Fields animation_fields() {
  return {
      text("name"),
      required(objects("channels",
                       {required(size("sampler")),
                        required(object("target", {reference("node", "nodes"), required(text("path"))}))})),
      required(objects("samplers",
                       {required(reference("input", "accessors")), required(reference("output", "accessors")),
                        text("interpolation", {"LINEAR", "STEP", "CUBICSPLINE"})}))};
}

Fields light_fields() {
  return {text("name"),
          required(text("type", {"directional", "point", "spot"})),
          numbers("color", 3),
          number("intensity"),
          number("range"),
          object("spot", {number("innerConeAngle"), number("outerConeAngle")}),
          own_extras({numbers("cone", 2), text("shape", {"capsule", "wedge", "box"}), number("half_length"),
                      numbers("half_extents", 3), boolean("probe")})};
}

const Fields& document_fields() {
  static const Fields fields = {
      required(object("asset", {required(text("version")), text("minVersion"),
                                own_extras({text("name"), number("near", tiny, max_coordinate),
                                            number("far", tiny, max_coordinate), numbers("origin", 3),
                                            text("lights")})})),
      reference("scene", "scenes"),
      objects("scenes", {text("name"), references("nodes", "nodes")}),
      objects("nodes", node_fields()),
      objects("meshes", {text("name"), required(objects("primitives", primitive_fields()))}),
      objects("accessors", accessor_fields()),
      objects("bufferViews", {required(reference("buffer", "buffers")), size("byteOffset"),
                              required(size("byteLength", 1)), size("byteStride", 4, 252)}),
      objects("buffers", {required(size("byteLength", 1)), text("uri")}),
      objects("images",
              {text("name"), text("uri"), reference("bufferView", "bufferViews"), text("mimeType")}),
      objects("textures", {reference("source", "images"), reference("sampler", "samplers")}),
      objects("samplers", {size("magFilter"), size("minFilter"), size("wrapS"), size("wrapT")}),
      objects("skins",
              {required(references("joints", "nodes")), reference("inverseBindMatrices", "accessors")}),
      objects("materials", material_fields()),
      objects("cameras", camera_fields()),
      objects("animations", animation_fields()),
      object("extensions", {object("KHR_lights_punctual", {required(objects("lights", light_fields()))})})};
  return fields;
}

class Checker {
 public:
  Checker(const File& file, const Json& raw) : file_(file) {
    for (const Field& field : document_fields())
      if (field.kind == Kind::objects) sizes_[field.key] = array_size(raw, field.key);
    sizes_[lights_array] = 0;
    if (auto all = raw.find("extensions"); all != raw.end() && all->is_object())
      if (auto lights = all->find("KHR_lights_punctual"); lights != all->end() && lights->is_object())
        sizes_[lights_array] = array_size(*lights, "lights");
  }

  Json object(const Json& value, const Fields& fields, const std::string& where) const {
    if (!value.is_object()) file_.fail(where, "expected an object");
    Json result = Json::object();
    for (const Field& field : fields) {
      auto found = value.find(field.key);
      if (found == value.end()) {
        if (field.required)
          file_.fail(where.empty() ? "top level" : where, std::string("'") + field.key + "' is missing");
        continue;
      }
      if (field.lenient && !found->is_object()) continue;
      result[field.key] = member(*found, field, where.empty() ? field.key : where + "." + field.key);
    }
    return result;
  }

 private:
  static size_t array_size(const Json& parent, const char* key) {
    auto found = parent.find(key);
    return found != parent.end() && found->is_array() ? found->size() : 0;
  }

  Json member(const Json& value, const Field& field, const std::string& where) const {
    switch (field.kind) {
      case Kind::integer:
        return field.target ? index(value, field.target, where) : integer(value, field, where);
      case Kind::number:
        return in_range(value, field, where);
      case Kind::boolean:
        if (!value.is_boolean()) file_.fail(where, "expected true or false");
        return value.get<bool>();
      case Kind::text:
        return word(value, field, where);
      case Kind::numbers:
        return number_array(value, field, where);
      case Kind::references:
        return each(value, where, [&](const Json& item, const std::string& at_item) {
          return index(item, field.target, at_item);
        });
      case Kind::object:
        return object(value, field.fields, where);
      case Kind::objects:
        return each(value, where, [&](const Json& item, const std::string& at_item) {
          return object(item, field.fields, at_item);
        });
    }
    return {};
  }

  template <typename Read>
  Json each(const Json& value, const std::string& where, Read&& read) const {
    if (!value.is_array()) file_.fail(where, "expected an array");
    Json result = Json::array();
    for (size_t i = 0; i < value.size(); ++i)
      result.push_back(read(value[i], where + "[" + std::to_string(i) + "]"));
    return result;
  }

  double in_range(const Json& value, const Field& field, const std::string& where) const {
    if (!value.is_number()) file_.fail(where, "expected a number");
    auto found = value.get<double>();
    if (!(found >= field.low && found <= field.high)) {
      std::string expected =
          field.low == tiny ? "a number above 0" : "a number of at least " + Json(field.low).dump();
      if (field.high < std::numeric_limits<double>::max())
        expected += " and at most " + Json(field.high).dump();
      file_.fail(where, "is " + value.dump() + ", expected " + expected);
    }
    return found;
  }

  // JSON does not tell 3 from 3.0.
  int64_t integer(const Json& value, const Field& field, const std::string& where) const {
    auto found = value.is_number() ? value.get<double>() : 0.5;
    if (found != std::floor(found)) file_.fail(where, "expected an integer");
    if (!field.values.empty()) {
      if (std::find(field.values.begin(), field.values.end(), found) == field.values.end())
        file_.fail(where, "is " + value.dump() + ", which is none of the values that glTF allows");
    } else if (!(found >= field.low && found <= field.high)) {
      file_.fail(where, "is " + value.dump() + ", expected an integer from " +
                            std::to_string(static_cast<int64_t>(field.low)) + " to " +
                            std::to_string(static_cast<int64_t>(field.high)));
    }
    return static_cast<int64_t>(found);
  }

  int64_t index(const Json& value, const char* target, const std::string& where) const {
    size_t count = sizes_.at(target);
    auto found = value.is_number() ? value.get<double>() : 0.5;
    if (found != std::floor(found)) file_.fail(where, std::string("expected an index into ") + target);
    if (!(found >= 0 && found < static_cast<double>(count)))
      file_.fail(where, "is " + value.dump() + ", but the file has " + std::to_string(count) + " " + target);
    return static_cast<int64_t>(found);
  }

  std::string word(const Json& value, const Field& field, const std::string& where) const {
    if (!value.is_string()) file_.fail(where, "expected a string");
    const auto& found = value.get_ref<const std::string&>();
    if (!field.words.empty() && std::find(field.words.begin(), field.words.end(), found) == field.words.end())
      file_.fail(where, "unknown value '" + found + "'" + suggestion(found, field.words));
    return found;
  }

  Json number_array(const Json& value, const Field& field, const std::string& where) const {
    if (!value.is_array() || value.size() != field.length)
      file_.fail(where, "expected " + std::to_string(field.length) + " numbers");
    return each(value, where,
                [&](const Json& item, const std::string& at_item) { return in_range(item, field, at_item); });
  }

  const File& file_;
  std::map<std::string, size_t, std::less<>> sizes_;
};

// The bench's own shapes: what each needs, and which of glTF's lights it is for other programs.
void check_shape(const File& file, const Json& light, const std::string& where) {
  const Json own = light.value("/extras/manylights"_json_pointer, Json::object());
  const std::string shape = own.value("shape", "");
  if (shape.empty()) return;
  const char* type = shape == "wedge" ? "spot" : "point";
  const char* size = shape == "box" ? "half_extents" : "half_length";
  if (light["type"] != type)
    file.fail(where + ".type", "is '" + light["type"].get<std::string>() + "', expected '" + type +
                                   "' for the shape '" + shape + "'");
  if (!own.contains(size)) file.fail(where + ".extras.manylights", "'" + std::string(size) + "' is missing");
}

// What the table cannot say: members that others ask for. tinygltf would stop at these without naming a
// place.
void check_companions(const File& file, const Json& checked) {
  auto list = [](const Json& parent, const char* key) { return parent.value(key, Json::array()); };
  const Json accessors = list(checked, "accessors"), meshes = list(checked, "meshes"),
             views = list(checked, "bufferViews"), cameras = list(checked, "cameras"),
             lights = list(checked.value("/extensions/KHR_lights_punctual"_json_pointer, Json::object()),
                           "lights");
  for (size_t i = 0; i < views.size(); ++i)
    if (int stride = views[i].value("byteStride", 4); stride % 4 != 0)
      file.fail(at("bufferViews", i) + ".byteStride",
                "is " + std::to_string(stride) + ", expected a multiple of 4");
  for (size_t i = 0; i < cameras.size(); ++i)
    if (std::string type = cameras[i]["type"]; !cameras[i].contains(type))
      file.fail(at("cameras", i), "'" + type + "' is missing");
  for (size_t i = 0; i < lights.size(); ++i) {
    const std::string where = std::string(lights_array) + "[" + std::to_string(i) + "]";
    if (lights[i]["type"] == "spot" && !lights[i].contains("spot")) file.fail(where, "'spot' is missing");
    check_shape(file, lights[i], where);
  }
  for (size_t m = 0; m < meshes.size(); ++m)
    for (size_t p = 0; p < meshes[m]["primitives"].size(); ++p)
      if (const Json& primitive = meshes[m]["primitives"][p]; primitive.contains("indices"))
        if (auto index = primitive["indices"].get<size_t>(); !accessors[index].contains("bufferView"))
          file.fail(at("meshes", m) + "." + at("primitives", p) + ".indices",
                    at("accessors", index) + " has no buffer view, which is supported for vertices alone");
}

}  // namespace

Json checked_description(const File& file, const Json& raw) {
  if (!raw.is_object()) file.fail("JSON", "expected an object at the top");
  Json checked = Checker(file, raw).object(raw, document_fields(), "");
  check_companions(file, checked);
  return checked;
}

}  // namespace ml::gltf
