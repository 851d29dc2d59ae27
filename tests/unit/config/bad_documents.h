// Configurations that must be refused, where the message must point, and whether the JSON schema can refuse them too.
#pragma once

#include <vector>

namespace ml {

struct BadDocument {
  const char* text;
  const char* path;  // what the message must name
  const char* why;   // a part of the message
  // false: a schema cannot say it (names and ranges that live in the registry, comparisons between values)
  bool schema_refuses = true;
};

inline const std::vector<BadDocument>& bad_documents() {
  static const std::vector<BadDocument> documents{
      // wrong types
      {R"([])", "$", "expected an object"},
      {R"(null)", "$", "expected an object"},
      {R"({"name": 5})", "$.name", "expected a text"},
      {R"({"lights": []})", "$.lights", "expected an object"},
      {R"({"lights": {"count": "8192"}})", "$.lights.count", "expected an integer"},
      {R"({"lights": {"count": true}})", "$.lights.count", "expected an integer"},
      {R"({"lights": {"count": null}})", "$.lights.count", "expected an integer"},
      {R"({"resolution": 960})", "$.resolution", "expected a list of 2"},
      {R"({"resolution": [960]})", "$.resolution", "expected a list of 2, found a list of 1"},
      {R"({"resolution": [960, 540, 1]})", "$.resolution", "expected a list of 2"},
      {R"({"resolution": {"width": 960, "height": 540}})", "$.resolution", "found an object"},
      {R"({"scene": 5})", "$.scene", "expected the name of a scene"},
      {R"({"scene": {}})", "$.scene", "'name' or 'gltf' is missing"},
      {R"({"algorithms": "clustered"})", "$.algorithms", "\"all\""},
      {R"({"algorithms": []})", "$.algorithms", "expected a list of 1"},
      {R"({"algorithms": [5]})", "$.algorithms[0]", "expected the name of an algorithm"},
      {R"({"algorithms": [{}]})", "$.algorithms[0]", "'name' is missing"},
      {R"({"algorithms": [{"name": 3}]})", "$.algorithms[0].name", "expected a text"},
      {R"({"algorithms": [{"name": "clustered", "tile": []}]})", "$.algorithms[0].tile", "expected a list of 1"},
      {R"({"algorithms": [{"name": "clustered", "tile": {}}]})", "$.algorithms[0].tile", "expected a number"},
      {R"({"algorithms": [{"name": "clustered", "tile": null}]})", "$.algorithms[0].tile", "expected a number"},
      {R"({"algorithms": [{"name": "clustered", "tile": [[16]]}]})", "$.algorithms[0].tile[0]", "expected a number"},
      {R"({"outputs": {"trace": 1}})", "$.outputs.trace", "expected true or false"},
      {R"({"outputs": {"images": 0}})", "$.outputs.images", "expected a list"},
      {R"({"effects": {"spots": true}})", "$.effects.spots", "one of 'auto', 'off'"},
      {R"({"effects": {"spots": "on"}})", "$.effects.spots", "one of 'auto', 'off'"},
      // impossible numbers
      {R"({"lights": {"count": -1}})", "$.lights.count", "from 0 to 1048576, found -1"},
      {R"({"lights": {"count": 1048577}})", "$.lights.count", "found 1048577"},
      {R"({"lights": {"count": 1.5}})", "$.lights.count", "found 1.5"},
      {R"({"lights": {"count": 18446744073709551615}})", "$.lights.count", "found 18446744073709551615"},
      {R"({"lights": {"count": 1e300}})", "$.lights.count", "found 1e+300"},
      {R"({"lights": {"radius": -1}})", "$.lights.radius", "found -1"},
      {R"({"lights": {"radius": 1e-60}})", "$.lights.radius", "expected 0 or"},
      {R"({"lights": {"radius": 1e7}})", "$.lights.radius", "found"},
      {R"({"lights": {"base_size": -0.5}})", "$.lights.base_size", "found -0.5"},
      {R"({"lights": {"height": -2}})", "$.lights.height", "found -2"},
      {R"({"lights": {"radius_ratio": 0.5}})", "$.lights.radius_ratio", "from 1 to 1000"},
      {R"({"lights": {"spot_fraction": 1.01}})", "$.lights.spot_fraction", "from 0 to 1"},
      {R"({"lights": {"intensity": 0}})", "$.lights.intensity", "found 0"},
      {R"({"lights": {"seed": 4294967296}})", "$.lights.seed", "found 4294967296"},
      {R"({"lights": {"placement": "everywhere"}})", "$.lights.placement", "'volume'"},
      {R"({"lights": {"animate": "drifft"}})", "$.lights.animate", "did you mean 'drift'"},
      {R"({"camera": {"frames": 0}})", "$.camera.frames", "from 1"},
      {R"({"camera": {"frames": 100001}})", "$.camera.frames", "to 100000"},
      {R"({"camera": {"path": ""}})", "$.camera.path", "letters"},
      {R"({"resolution": [0, 540]})", "$.resolution[0]", "from 1 to 16384"},
      {R"({"resolution": [960, 16385]})", "$.resolution[1]", "from 1 to 16384"},
      {R"({"resolution": [960.5, 540]})", "$.resolution[0]", "found 960.5"},
      {R"({"measure": {"repeats": 0}})", "$.measure.repeats", "from 1"},
      {R"({"measure": {"warmup": -1}})", "$.measure.warmup", "from 0"},
      {R"({"measure": {"threads": 0}})", "$.measure.threads", "from 1 to 256"},
      {R"({"measure": {"threads": 257}})", "$.measure.threads", "from 1 to 256"},
      {R"({"measure": {"mode": "stage"}})", "$.measure.mode", "did you mean 'stages'"},
      {R"({"scene": {"name": "canyon", "offset": [1e10, 0, 0]}})", "$.scene.offset[0]", "found 1e+10"},
      {R"({"scene": {"name": "canyon", "offset": [0, 0]}})", "$.scene.offset", "a list of 3"},
      {R"({"scene": {"name": "canyon", "seed": -1}})", "$.scene.seed", "found -1"},
      {R"({"scene": {"gltf": ""}})", "$.scene.gltf", "letters"},
      {R"({"scene": {"gltf": "a.glb", "scene": -2}})", "$.scene.scene", "found -2"},
      {R"({"outputs": {"images": [-1]}})", "$.outputs.images[0]", "from 0"},
      {R"({"outputs": {"images": [0, 1, 0]}})", "$.outputs.images", "frame 0 is there twice"},
      // keys
      {R"({"lights": {"cuont": 1}})", "$.lights.cuont", "unknown key, did you mean 'count'?"},
      {R"({"light": {}})", "$.light", "unknown key, did you mean 'lights'?"},
      {R"({"lights.count": 5})", "$.lights.count", "unknown key"},
      {R"({"swep": {}})", "$.swep", "did you mean 'sweep'?"},
      {R"({"camera": {"farmes": 2}})", "$.camera.farmes", "did you mean 'frames'?"},
      {R"({"scene": {"nme": "canyon"}})", "$.scene.nme", "did you mean 'name'?"},
      {R"({"scene": {"name": "canyon", "gltf": "a.glb"}})", "$.scene", "exclude each other"},
      {R"({"scene": {"name": "canyon", "scene": 0}})", "$.scene.scene", "only a glTF file"},
      {R"({"camera": {"path": "default", "keyframes": [{"time": 0, "position": [0, 0, 0], "target": [1, 0, 0]}]}})", "$.camera",
       "exclude each other"},
      {R"({"measure": {"": 1}})", "$.measure['']", "unknown key"},
      {R"({"name": ""})", "$.name", "letters"},
      {R"({"name": "a/b"})", "$.name", "letters, digits"},
      {R"({"name": "..hidden"})", "$.name", "letters, digits"},
      {R"({"description": "two\nlines"})", "$.description", "control characters"},
      {R"({"camera": {"path": "a\u0000b"}})", "$.camera.path", "control characters", false},
      // camera keys
      {R"({"camera": {"keyframes": []}})", "$.camera.keyframes", "a list of 1"},
      {R"({"camera": {"keyframes": [{"time": 0, "position": [0, 0, 0]}]}})", "$.camera.keyframes[0]", "'target' is missing"},
      {R"({"camera": {"keyframes": [{"time": 0, "position": [0, 0, 0], "target": [1, 0, 0], "up": 1}]}})",
       "$.camera.keyframes[0].up", "unknown key"},
      {R"({"camera": {"keyframes": [{"time": 1, "position": [0, 0, 0], "target": [1, 0, 0]},
                                    {"time": 1, "position": [0, 0, 0], "target": [1, 0, 0]}]}})",
       "$.camera.keyframes[1].time", "after the one before", false},
      // sweeps
      {R"({"sweep": []})", "$.sweep", "expected an object"},
      {R"({"sweep": {"lights.count": 5}})", "$.sweep.lights.count", "expected a list"},
      {R"({"sweep": {"lights.count": []}})", "$.sweep.lights.count", "expected a list of 1"},
      {R"({"sweep": {"lights.count": [1, -1]}})", "$.sweep.lights.count[1]", "found -1"},
      {R"({"sweep": {"lights.count": [1, 2, 1]}})", "$.sweep.lights.count", "a value is there twice"},
      {R"({"sweep": {"lights.cuont": [1]}})", "$.sweep.lights.cuont", "did you mean 'count'?"},
      {R"({"sweep": {"count": [1]}})", "$.sweep.count", "did you mean 'lights.count'?"},
      {R"({"sweep": {"measure.repeats": [1, 2]}})", "$.sweep.measure.repeats", "cannot be swept"},
      {R"({"sweep": {"resolution": [[960, 540], [0, 0]]}})", "$.sweep.resolution[1][0]", "from 1"},
      {R"({"sweep": {"sweep": [1]}})", "$.sweep.sweep", "unknown key"},
      {R"({"sweep": {"algorithms.tile": [0]}})", "$.sweep.algorithms.tile[0]", "expected an integer from 4", false},
      {R"({"sweep": {"algorithms.tiel": [8]}})", "$.sweep.algorithms.tiel", "did you mean 'tile'?", false},
      {R"({"sweep": {"algorithms.ideal.tile": [8]}})", "$.sweep.algorithms.ideal.tile", "no algorithm", false},
      {R"({"sweep": {"scene": ["nowhere"]}})", "$.sweep.scene[0]", "unknown scene", false},
      {R"({"zip": {"lights.count": [1, 2], "lights.seed": [1, 2, 3]}})", "$.zip.lights.seed", "a list of 2", false},
      {R"({"sweep": {"lights.count": [1]}, "zip": {"lights.count": [2]}})", "$.zip.lights.count", "swept and zipped", false},
      {R"({"sweep": {"lights.count": [1], "lights": [{"count": 2}]}})", "$.sweep.lights.count", "'lights' is swept too", false},
      {R"({"sweep": {"algorithms.tile": [8], "algorithms[0].tile": [16]}})", "$.sweep", "is swept too", false},
      {R"({"sweep": {"camera.path": ["default"], "camera.keyframes": [[{"time": 0, "position": [0,0,0], "target": [1,0,0]}]]}})",
       "$.sweep.camera", "is swept too", false},
      // what only the registry knows
      {R"({"scene": "canyn"})", "$.scene", "unknown scene 'canyn', did you mean 'canyon'?", false},
      {R"({"algorithms": ["clusterd"]})", "$.algorithms[0]", "did you mean 'clustered'?", false},
      {R"({"algorithms": [{"name": "clusterd"}]})", "$.algorithms[0].name", "did you mean 'clustered'?", false},
      {R"({"algorithms": [{"name": "clustered", "tiel": 16}]})", "$.algorithms[0].tiel", "did you mean 'tile'?", false},
      {R"({"algorithms": [{"name": "ideal", "tile": 16}]})", "$.algorithms[0].tile", "no parameters", false},
      {R"({"algorithms": [{"name": "clustered", "tile": 0}]})", "$.algorithms[0].tile", "from 4 to 1024, found 0", false},
      {R"({"algorithms": [{"name": "clustered", "tile": 16.5}]})", "$.algorithms[0].tile", "found 16.5", false},
      {R"({"algorithms": [{"name": "clustered", "tile": 1e300}]})", "$.algorithms[0].tile", "found 1e+300", false},
      {R"({"algorithms": [{"name": "clustered", "tile": 18446744073709551615}]})", "$.algorithms[0].tile", "expected an integer", false},
      {R"({"algorithms": [{"name": "clustered", "tile": "16"}]})", "$.algorithms[0].tile", "found '16'", false},
      {R"({"algorithms": [{"name": "clustered", "tile": [16, 0]}]})", "$.algorithms[0].tile[1]", "found 0", false},
      {R"({"algorithms": [{"name": "clustered", "slices": 0}]})", "$.algorithms[0].slices", "from 1 to 256", false},
      {R"({"algorithms": [{"name": "clustered", "refinement": 1}]})", "$.algorithms[0].refinement", "true or false", false},
      {R"({"algorithms": [{"name": "clustered", "light_data": "indexd"}]})", "$.algorithms[0].light_data", "did you mean 'indexed'", false},
      // comparisons between values
      {R"({"camera": {"frames": 4}, "outputs": {"images": [0, 4]}})", "$.outputs.images[1]", "not among the 4 frames", false},
      {R"({"outputs": {"heatmaps": [16]}})", "$.outputs.heatmaps[0]", "not among the 16 frames", false},
      {R"({"outputs": {"images": [3]}, "sweep": {"camera.frames": [8, 2]}})", "$.outputs.images[0]", "camera.frames=2", false},
  };
  return documents;
}

}  // namespace ml
