#include "harness/bench/render.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/bench/bookkeeping.h"
#include "harness/bench/case_pictures.h"
#include "harness/bench/workload.h"
#include "harness/output/lights_csv.h"

namespace ml {
namespace {

void set_extra(LightShape shape, const gpu_data::LightExtra& extra, LightRow& row) {
  for (int axis = 0; axis < 3; ++axis) {
    row.direction[axis] = extra.direction[axis];
    row.side[axis] = extra.side[axis];
  }
  if (shape == LightShape::box) {
    for (int axis = 0; axis < 3; ++axis) row.half_extents[axis] = gpu_data::box_half_extents(extra)[axis];
    return;
  }
  row.half_length = extra.half_length;
  row.cone_scale = extra.cone_scale;
  row.cone_limit = extra.cone_limit;
  row.cos_outer = extra.cos_outer;
}

std::vector<LightRow> light_rows(const FrameInput& input) {
  std::vector<LightRow> rows;
  for (const gpu_data::LightCore& core : input.lights.core) {
    LightRow row;
    row.radius = core.radius;
    const auto shape = static_cast<LightShape>(core.id_shape >> 24);
    row.probe = (core.id_shape & ML_LIGHT_PROBE) != 0;
    row.shape = light_shape_names().at(core.id_shape >> 24);
    for (int axis = 0; axis < 3; ++axis) {
      row.position[axis] = core.position[axis];
      row.intensity[axis] = core.intensity[axis];
    }
    if (shape != LightShape::omni) set_extra(shape, input.lights.extra[rows.size()], row);
    rows.push_back(row);
  }
  return rows;
}

// Channels `first`.. of pictures with four floats a pixel.
Picture picked(const std::vector<float>& rgba, uint32_t width, uint32_t height,
               std::vector<std::string> names, size_t first) {
  const size_t channels = names.size();
  Picture picture(width, height, std::move(names));
  for (size_t i = 0; i < rgba.size() / 4; ++i)
    for (size_t channel = 0; channel < channels; ++channel)
      picture.data[channels * i + channel] = rgba[4 * i + first + channel];
  return picture;
}

Picture aov_picture(const std::string& name, DeviceFrame& frame, const PixelCounts& counts,
                    const std::vector<uint8_t>& lit) {
  const uint32_t width = frame.targets().width(), height = frame.targets().height();
  using Aov = DeviceFrame::Aov;
  if (name == "position") return picked(frame.read_aov(Aov::position), width, height, {"X", "Y", "Z"}, 0);
  if (name == "normal") return picked(frame.read_aov(Aov::normal), width, height, {"X", "Y", "Z"}, 0);
  if (name == "albedo") return picked(frame.read_aov(Aov::albedo), width, height, {"R", "G", "B"}, 0);
  if (name == "material")
    return picked(frame.read_aov(Aov::material), width, height, {"roughness", "metallic"}, 0);
  if (name == "emission") {
    if (!frame.options().effects.emission) return Picture(width, height, {"R", "G", "B"});
    return picked(frame.read_aov(Aov::emission), width, height, {"R", "G", "B"}, 0);
  }
  if (name == "depth") return picked(frame.read_aov(Aov::position), width, height, {"Y"}, 3);
  return count_picture(name == "listed" ? counts.listed : counts.contributing, lit, width, height);
}

const AlgorithmSpec& chosen_algorithm(const Setup& setup, const std::string& name) {
  if (name.empty()) return setup.algorithms.front();
  std::vector<std::string> known;
  for (const AlgorithmSpec& spec : setup.algorithms) {
    if (spec.name == name) return spec;
    known.push_back(spec.name);
  }
  throw UsageError("--algorithm '" + name + "' is not in the configuration" + suggestion(name, known));
}

}  // namespace

const std::vector<std::string>& aov_names() {
  static const std::vector<std::string> names{"position", "normal",   "depth",        "albedo",
                                              "material", "emission", "contributing", "listed"};
  return names;
}

std::vector<std::filesystem::path> render_frame(const Config& config, const RenderOptions& options) {
  const Setup& setup = config.setups.front();
  if (options.frame >= setup.camera.frames)
    throw UsageError(fmt::format("--frame {}: the configuration has frames 0 to {}", options.frame,
                                 setup.camera.frames - 1));
  std::string ending = options.out.extension().string();
  if (ending != ".exr" && ending != ".png")
    throw UsageError(fmt::format("--out '{}': the name must end in .exr or .png", options.out.string()));
  std::vector<std::string> aovs = options.aovs;
  if (std::find(aovs.begin(), aovs.end(), "all") != aovs.end()) aovs = aov_names();
  for (const std::string& name : aovs)
    if (std::find(aov_names().begin(), aov_names().end(), name) == aov_names().end())
      throw UsageError("--aov '" + name + "': unknown" + suggestion(name, aov_names()));
  const AlgorithmSpec& spec = chosen_algorithm(setup, options.algorithm);
  if (!options.out.parent_path().empty()) make_output_directory(options.out.parent_path());

  Workload workload(setup, config.measure.threads);
  gpu::Device device({options.device, options.validation});
  fmt::print("device: {} ({}, {})\n", device.info().name, device.info().type, device.info().driver);
  DeviceFrame frame(device, *workload.scene(), workload.options(), setup.width, setup.height);
  const AlgorithmEntry& entry = find_algorithm(spec.name, "render");
  ShadedAlgorithm algorithm(device, entry, spec.parameters, workload.options());
  const FrameInput& input = workload.frames().at(options.frame);
  frame.load(input);
  require_surface(setup, frame.occupied_blocks().positions().empty(), 1);
  tell_books(setup, workload, 0, 1);
  if (entry.info.needs_contributing_lists) frame.find_contributing(input, algorithm.wanted_lists());
  Spans spans;
  algorithm.prepare(input, spans, frame.occupied_blocks().positions());
  algorithm.count(frame, input);

  std::vector<std::filesystem::path> files{options.out};
  Picture picture = result_picture(frame);
  if (ending == ".exr")
    write_exr(picture, options.out);
  else
    write_preview_png(picture, options.out);
  if (!aovs.empty()) {
    PixelCounts counts = read_counts(frame);
    std::vector<uint8_t> lit = lit_pixels(frame);
    for (const std::string& name : aovs) {
      std::filesystem::path file = options.out;
      file.replace_extension("." + name + ".exr");
      write_exr(aov_picture(name, frame, counts, lit), file);
      files.push_back(file);
    }
  }
  if (!options.lights.empty()) {
    write_lights_csv(light_rows(input), options.lights);
    files.push_back(options.lights);
  }
  for (const std::string& message : device.validation_messages())
    throw std::runtime_error("validation layer: " + one_line(message));
  return files;
}

}  // namespace ml
