// Where configurations lie on the disk.
#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "harness/base/error.h"
#include "harness/base/file.h"
#include "harness/base/json_text.h"
#include "harness/config/config.h"
#include "scenes/scene_registry.h"

namespace ml {

namespace {

namespace fs = std::filesystem;

constexpr size_t largest_config = size_t{4} << 20;  // bytes

// Empty when there is none.
fs::path configs_folder() {
  std::error_code failed;
  if (const char* named = std::getenv("MANYLIGHTS_CONFIGS"); named && *named) return named;
  fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (!failed) {
    fs::path installed = program.parent_path() / "../share/manylights/configs";
    if (fs::is_directory(installed, failed)) return installed.lexically_normal();
  }
  fs::path source_tree = fs::path(ML_SOURCE_DIR) / "configs";
  return fs::is_directory(source_tree, failed) ? source_tree : fs::path();
}

// Names ("regression/smoke") of the .json files of the folder, sorted.
std::vector<std::string> config_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  if (folder.empty()) return names;
  fs::recursive_directory_iterator file(folder, fs::directory_options::skip_permission_denied, failed), end;
  for (; !failed && file != end; file.increment(failed)) {
    std::error_code unreadable;
    if (file->path().extension() != ".json" || !file->is_regular_file(unreadable)) continue;
    names.push_back(file->path().lexically_relative(folder).replace_extension().generic_string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Config load_file(const fs::path& file, const std::vector<std::string>& overrides) {
  std::string text = read_text_file(file, largest_config);
  return parse_config_text(text, file.string(), fs::absolute(file).parent_path(), overrides);
}

}  // namespace

std::vector<ConfigInfo> known_configs() {
  std::vector<ConfigInfo> infos;
  fs::path folder = configs_folder();
  for (const std::string& name : config_names(folder)) {
    fs::path file = folder / (name + ".json");
    ConfigInfo info{name, ""};
    try {
      nlohmann::json document = parse_json_text(read_text_file(file, largest_config), file.string());
      if (document.is_object() && document.contains("description") && document["description"].is_string()) {
        info.summary = one_line(document["description"].get<std::string>());
      }
    } catch (const Error& broken) {
      info.summary = std::string("cannot be read: ") + broken.what();
    }
    infos.push_back(std::move(info));
  }
  return infos;
}

Config load_config(const std::string& file_or_name, const std::vector<std::string>& overrides) {
  std::error_code failed;
  if (file_or_name.find('\0') != file_or_name.npos)
    throw UsageError("the configuration's name has a zero byte in it");
  if (fs::is_regular_file(file_or_name, failed)) return load_file(file_or_name, overrides);
  fs::path folder = configs_folder();
  std::vector<std::string> names = config_names(folder);
  if (std::find(names.begin(), names.end(), file_or_name) != names.end()) {
    return load_file(folder / (file_or_name + ".json"), overrides);
  }
  // Pipes and the like; a folder gets read_text_file's own complaint.
  if (!file_or_name.empty() && fs::exists(file_or_name, failed)) return load_file(file_or_name, overrides);
  std::string name =
      file_or_name.ends_with(".json") ? file_or_name.substr(0, file_or_name.size() - 5) : file_or_name;
  const std::vector<std::string> scenes = scene_names();
  if (std::find(scenes.begin(), scenes.end(), file_or_name) != scenes.end())
    throw UsageError(
        file_or_name +
        ": a scene and no configuration; name one of these too, such as quick --set scene=" + file_or_name);
  throw UsageError(file_or_name + ": neither a file nor the name of a configuration" +
                   suggestion(name, names));
}

}  // namespace ml
