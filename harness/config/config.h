// A configuration: what is run, on what, how often. Read from JSON, every key checked; written back with
// every default filled in.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algorithms/algorithm.h"
#include "harness/lights/set.h"
#include "harness/scene/effects.h"
#include "harness/scene/scene.h"
#include "scenes/load_scene.h"

namespace ml {

struct CameraSpec {
  std::string path = "default";      // a path of the scene
  uint32_t frames = 16;              // [1, 100000]
  std::vector<CameraKey> keyframes;  // when not empty: the path itself ({"time","position","target"} in
                                     // metres of the file's world)
};

enum class TimingMode { stages, whole };  // isolated spans | two stamps a frame

struct MeasureSpec {
  uint32_t warmup = 1;   // laps, [0, 1000]
  uint32_t repeats = 3;  // laps, [1, 10000]
  uint32_t threads = 1;  // CPU threads of prepare(), [1, 256]
  uint32_t seed = 1;     // of the interleaving
  TimingMode mode = TimingMode::stages;
};

struct OutputSpec {
  std::vector<uint32_t> heatmaps;  // frame numbers
  std::vector<uint32_t> images;    // frame numbers
  bool trace = true;               // Chrome/Perfetto trace of the spans
};

// Where the shading pass writes: the finished light, or diffuse and specular light apart, to be put together
// by a composite pass that folds in the albedo.
enum class ShadingTargets { one, split };

// Where lists that the GPU builds are built: with everything else, or on the device's second queue, beside
// the shadow maps.
enum class ListQueue { graphics, compute };

// How shaders read light data and trees: as is known to be faster on the kind of device, word by word from
// storage buffers, or four words at a time from texel buffers.
enum class LightFetch { automatic, storage, texel };

struct ShadingSpec {
  ShadingTargets targets = ShadingTargets::one;
  uint32_t shadow_maps = 0;         // drawn in a frame, [0, 16]; they light nothing yet
  uint32_t shadow_map_size = 1024;  // px a side, [16, 8192]
  ListQueue list_queue = ListQueue::graphics;
  LightFetch light_fetch = LightFetch::automatic;
  // Subgroups that walk together test on until a light contributes before they enter the loop that shades.
  bool test_ahead = false;
};

struct AlgorithmSpec {
  std::string name;
  Parameters parameters;
};

// One point of the sweep: everything that stays the same while its algorithms are interleaved.
struct Setup {
  SceneSpec scene;
  std::string scene_label;  // "canyon" or the file's stem
  LightSpec lights;
  CameraSpec camera;
  uint32_t width = 960, height = 540;  // px, [1, 16384] each
  Effects effects = all_effects();     // those that are allowed: auto, and not off
  ShadingSpec shading;
  std::vector<AlgorithmSpec> algorithms;
};

struct Config {
  std::string name;
  MeasureSpec measure;
  OutputSpec outputs;
  std::vector<Setup> setups;  // sweep and zip expanded, at least one
  // The configuration with every default filled in and sweeps kept; reading it again gives the same Config.
  // Only `lights.placement` and `lights.radius_ratio` are left out where none is given and the swept scenes
  // have different ones; the setups name them.
  nlohmann::json resolved;
};

// Reads a file, or a configuration by its name in the installed configs/ folder (`quick`,
// `regression/smoke`). `overrides` are --set "a.b=value" pairs, value as JSON or else as a string; they are
// applied in order, an object sets the keys that it has, a swept key that is set is no longer swept, and
// "sweep.KEY=[...]" sweeps it. "algorithms.tile=32" goes to every algorithm that has it,
// "algorithms.0.tile=32" and "algorithms.clustered.tile=32" to one. Relative glTF paths are relative to the
// configuration file, or to the working directory for an override. Throws UsageError "FILE: $.lights.cuont:
// unknown key, did you mean 'count'?", with "--set" in place of the file for an override.
Config load_config(const std::string& file_or_name, const std::vector<std::string>& overrides);
// The same from parsed JSON; `source` stands for the file in messages.
Config parse_config(const nlohmann::json& json, const std::string& source,
                    const std::filesystem::path& relative_to);
// The same from text, as a file holds it; syntax errors name line and column, and no key may be there twice.
Config parse_config_text(std::string_view text, const std::string& source,
                         const std::filesystem::path& relative_to,
                         const std::vector<std::string>& overrides = {});

// Identity of a case: setup (with what else the sweep changes) and algorithm with the parameters that differ
// from the defaults, in letters that a file name can hold: "canyon-8192-960x540-clustered-tile32",
// "canyon-8192-960x540-lights.seed3-ideal". Unique within a configuration (a suffix -2, -3 is added where
// needed), [a-zA-Z0-9._-] only, at most 120 letters.
struct Case {
  std::string id;
  size_t setup = 0, algorithm = 0;  // indices into Config::setups and Setup::algorithms
};
std::vector<Case> expand_cases(const Config& config);

// Names and one-line summaries (their descriptions) of the configurations in configs/: the folder that the
// environment variable MANYLIGHTS_CONFIGS names, else ../share/manylights/configs beside the program's
// folder, else the source tree's.
struct ConfigInfo {
  std::string name, summary;
};
std::vector<ConfigInfo> known_configs();

// The JSON schema of a configuration (results/schema/config.schema.json), built into the program.
const nlohmann::json& config_schema();

}  // namespace ml
