#!/usr/bin/python3
"""Holds the sources to the project's architecture; prints FILE:LINE: what is wrong.

    scripts/check_architecture.py [ROOT]       check the tree (default: the one this script lies in)
    scripts/check_architecture.py --self-test  check that every rule can fail

Rules
- Includes follow the arrows of ARROWS; only a registry.cpp, tests and benchmarks name an algorithm's or a scene's folder from outside.
- Vulkan is named in harness/gpu alone (and in tests/layer, which stands in for a driver).
- A C++ file has at most 450 lines, a shader 250; a line of GLSL has at most 120 columns (clang-format holds C++ to its own).
- Folders of algorithms/ that several algorithms are made of (SHARED) have README.md; froxels knows nothing of trees.
- An algorithm's folder has README.md and light_cursor.glsl, a scene's README.md and scene.json, and registry.cpp includes its header.
- No path of somebody's machine, no note of work left to do.

Exit code 0: nothing found; 1: something found.
"""

import pathlib
import re
import sys
import tempfile

# room -> rooms whose headers it may include, besides its own. `algorithms` and `scenes` are the files directly in those folders.
ARROWS = {
    "base": [],
    "measure": ["base"],
    "scene": ["base"],
    "lights": ["base", "scene"],
    "camera": ["base", "scene"],
    "gltf": ["base", "scene", "lights", "camera"],
    "scenes": ["base", "scene", "lights", "gltf"],
    "gpu": ["base"],
    "output": ["base", "measure"],
    "accuracy": ["base", "measure", "output"],
    "algorithms": ["base", "scene", "gpu", "shaders"],
    "frame": ["base", "scene", "lights", "gpu", "algorithms", "shaders"],
    "config": ["base", "scene", "lights", "scenes", "algorithms"],
    "bench": ["base", "scene", "lights", "scenes", "gpu", "algorithms", "shaders", "measure", "output", "accuracy", "frame", "config"],
    # gpu and frame for the lists of devices and effects
    "cli": ["base", "scene", "gltf", "scenes", "gpu", "frame", "config", "bench"],
}
SHADERS = ["shaders"]  # what GLSL may include besides its own folder
# Their folders are rooms that only their registry.cpp names; each has these files.
FOLDERS = {"algorithms": ("README.md", "light_cursor.glsl"), "scenes": ("README.md", "scene.json")}
SHARED = {"froxels", "trees"}  # folders in algorithms/ that several algorithms are made of; trees stand on froxels
OUTSIDE = {"tests", "benchmarks", "examples"}  # may use every room but cli

MAX_LINES = {".cpp": 450, ".h": 450, ".glsl": 250, ".comp": 250, ".vert": 250, ".frag": 250}
MAX_COLUMNS = 120  # of GLSL
GLSL = {".glsl", ".comp", ".vert", ".frag"}
TEXT = set(MAX_LINES) | {".md", ".py", ".sh", ".json", ".txt", ".cmake", ".yml", ".mjs", ""}
SKIPPED = {".git", "build", "out", "node_modules", ".cache", "__pycache__"}

INCLUDE = re.compile(r'\s*#\s*include\s*([<"])([^>"]+)[>"]')
VULKAN = re.compile(r"\bvk::|\bVk[A-Z]\w+|\bvk[A-Z][a-z]\w+\(")
# Written so that the patterns do not find themselves.
MACHINE_PATH = re.compile(r"(?<![\w.\]])/(?:hom[e]|roo[t]|wor[k]|User[s])/\w|\b[A-Z]:\\\\?User[s]")
LEFT_TO_DO = re.compile(r"\b(?:TO[D]O|FIX[M]E|XX[X]|HAC[K])\b")


def room_of(path):
    """The room of a file or an included header: 'gpu', 'algorithms/clustered', 'algorithms', 'tests', ... or None."""
    parts = pathlib.PurePosixPath(path).parts
    if len(parts) >= 3 and parts[0] == "harness":
        return parts[1]
    if len(parts) >= 3 and parts[0] in FOLDERS:
        return f"{parts[0]}/{parts[1]}"
    if len(parts) >= 2 and (parts[0] in FOLDERS or parts[0] == "shaders") or parts[0] in OUTSIDE:
        return parts[0]
    return None


def include_fault(file, room, header):
    """What is wrong with `file` of `room` including `header`, or None."""
    target = room_of(header)
    if target is None or target == room:
        return None
    if target in OUTSIDE and (room, target) != ("tests", "examples"):
        return f"{target} must not be included by anything outside it"
    if target == "cli":
        return "nothing may include cli"
    if room in OUTSIDE:
        return None
    if "/" in target:
        if file == f"{target.split('/')[0]}/registry.cpp":
            return None
        if target.split("/")[1] in SHARED and room.startswith("algorithms/") and (room, target) != ("algorithms/froxels", "algorithms/trees"):
            return None
        return f"only registry.cpp, tests and benchmarks may name {target}"
    if pathlib.PurePosixPath(file).suffix in GLSL or room == "shaders":
        return None if target in SHADERS else f"shaders may include {', '.join(SHADERS)} and their own folder, not {target}"
    allowed = ARROWS.get(room.split("/")[0])
    if allowed is None:
        return f"harness/{room} is not a room that this check knows"
    if target in allowed or target == room.split("/")[0]:
        return None
    return f"{room} may include {', '.join(allowed) or 'nothing but itself'}, not {target}"


def check_file(path, text):
    """Yields (line, fault) for the file `path` (relative, with slashes)."""
    suffix = pathlib.PurePosixPath(path).suffix
    room = room_of(path)
    knows_vulkan = room == "gpu" or path.startswith("tests/layer/")
    code = suffix in MAX_LINES
    lines = text.splitlines()
    if code and len(lines) > MAX_LINES[suffix]:
        yield len(lines), f"{len(lines)} lines; at most {MAX_LINES[suffix]}: it is two things"
    for number, line in enumerate(lines, 1):
        if LEFT_TO_DO.search(line):
            yield number, "a note of work left to do; do it or open an issue"
        if MACHINE_PATH.search(line):
            yield number, "a path of somebody's machine"
        if suffix in GLSL and len(line) > MAX_COLUMNS:
            yield number, f"{len(line)} columns; at most {MAX_COLUMNS}"
        if not code or room is None:
            continue
        include = INCLUDE.match(line)
        if include:
            bracket, header = include.groups()
            if bracket == '"' and (fault := include_fault(path, room, header)):
                yield number, fault
            if bracket == "<" and header.startswith("vulkan/") and not knows_vulkan:
                yield number, "Vulkan headers are included in harness/gpu alone"
        elif suffix in (".cpp", ".h") and not knows_vulkan and VULKAN.search(line.split("//")[0]):
            yield number, "Vulkan is named in harness/gpu alone"


def check_registry(root, kind):
    """What the folders of `kind`, algorithms or scenes, lack."""
    folder = root / kind
    if not folder.is_dir():
        return
    registry = folder / "registry.cpp"
    registered = registry.read_text() if registry.exists() else ""
    for entry in sorted(entry for entry in folder.iterdir() if entry.is_dir()):
        name = entry.name
        shared = kind == "algorithms" and name in SHARED
        for needed in ("README.md",) if shared else FOLDERS[kind]:
            if not (entry / needed).exists():
                yield f"{kind}/{name}", 1, f"{needed} is missing"
        if not shared and f'"{kind}/{name}/' not in registered:
            yield f"{kind}/{name}", 1, "registry.cpp does not include it"


def check_tree(root):
    """All faults as (file, line, what)."""
    faults = [fault for kind in FOLDERS for fault in check_registry(root, kind)]
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if SKIPPED & set(relative.parts) or path.is_symlink() or not path.is_file() or path.suffix not in TEXT:
            continue
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            if path.suffix in MAX_LINES:
                faults.append((relative.as_posix(), 1, "not UTF-8"))
            continue
        faults += [(relative.as_posix(), line, what) for line, what in check_file(relative.as_posix(), text)]
    return faults


def self_test():
    """A good tree has no fault; each bad file, put into it alone, has exactly the fault it was made for."""
    good = {
        "algorithms/registry.cpp": '#include "algorithms/near/near.h"\n',
        "algorithms/near/near.h": '#include "algorithms/algorithm.h"\n#include "harness/base/error.h"\n',
        "algorithms/near/README.md": "# near\n",
        "algorithms/near/light_cursor.glsl": '#include "shaders/shared/light.h"\n',
        "algorithms/near/bounds.cpp": '#include "algorithms/near/near.h"\n#include "shaders/shared/view.h"\n',
        "scenes/registry.cpp": '#include "scenes/hill/hill.h"\n',
        "scenes/hill/hill.h": '#include "scenes/scene_registry.h"\n#include "harness/scene/scene.h"\n',
        "scenes/hill/README.md": "# hill\n",
        "scenes/hill/scene.json": "{}\n",
        "harness/gpu/device.cpp": "#include <vulkan/vulkan_raii.hpp>\nvk::raii::Context context;\n",
        "harness/frame/level.cpp": '#include "harness/gpu/device.h"\n#include "algorithms/algorithm.h"\n',
        "harness/cli/run.cpp": '#include "harness/bench/runner.h"\n',
        "tests/unit/near_test.cpp": '#include "algorithms/near/near.h"\n#include "examples/far/far.h"\n#include "near_helper.h"\n',
    }
    bad = [
        ("harness/base/file.cpp", '#include "harness/scene/scene.h"\n', 1, "base may include"),
        ("harness/scene/x.cpp", '#include "harness/gpu/device.h"\n', 1, "scene may include"),
        ("harness/scene/x.cpp", '#include "harness/lights/set.h"\n', 1, "scene may include"),
        ("harness/lights/x.cpp", '#include "harness/camera/orbit_path.h"\n', 1, "lights may include"),
        ("harness/camera/x.cpp", '#include "harness/lights/set.h"\n', 1, "camera may include"),
        ("harness/gltf/x.cpp", '#include "scenes/load_scene.h"\n', 1, "gltf may include"),
        ("scenes/x.cpp", '#include "algorithms/algorithm.h"\n', 1, "scenes may include"),
        ("scenes/hill/x.cpp", '#include "harness/gpu/device.h"\n', 1, "scenes/hill may include"),
        ("scenes/hill/x.cpp", '#include "scenes/dale/dale.h"\n', 1, "only registry.cpp"),
        ("algorithms/x.cpp", '#include "scenes/hill/hill.h"\n', 1, "only registry.cpp"),
        ("harness/config/x.cpp", '#include "scenes/hill/hill.h"\n', 1, "only registry.cpp"),
        ("harness/gpu/x.cpp", '\n#include "harness/frame/level.h"\n', 2, "gpu may include"),
        ("harness/measure/x.cpp", '#include "harness/gpu/device.h"\n', 1, "measure may include"),
        ("harness/accuracy/x.cpp", '#include "harness/frame/level.h"\n', 1, "accuracy may include"),
        ("harness/output/x.cpp", '#include "harness/gpu/device.h"\n', 1, "output may include"),
        ("harness/config/x.cpp", '#include "harness/frame/level.h"\n', 1, "config may include"),
        ("harness/bench/x.cpp", '#include "harness/cli/commands.h"\n', 1, "nothing may include cli"),
        ("tests/unit/x.cpp", '#include "harness/cli/commands.h"\n', 1, "nothing may include cli"),
        ("harness/bench/x.cpp", '#include "tests/unit/x.h"\n', 1, "tests must not be included"),
        ("harness/frame/x.cpp", '#include "algorithms/near/near.h"\n', 1, "only registry.cpp"),
        ("algorithms/parameters.cpp", '#include "algorithms/near/near.h"\n', 1, "only registry.cpp"),
        ("algorithms/near/x.cpp", '#include "harness/frame/level.h"\n', 1, "algorithms/near may include"),
        ("algorithms/near/x.glsl", '#include "algorithms/far/far.glsl"\n', 1, "only registry.cpp"),
        ("shaders/x.comp", '#include "harness/base/error.h"\n', 1, "shaders may include"),
        ("harness/news/x.cpp", '#include "harness/base/error.h"\n', 1, "not a room"),
        ("harness/frame/x.cpp", "#include <vulkan/vulkan.h>\n", 1, "Vulkan headers"),
        ("harness/frame/x.h", "void f(VkDevice);\n", 1, "Vulkan is named"),
        ("harness/frame/x.h", "int i;\n" * 451, 451, "451 lines"),
        ("shaders/x.glsl", "int i;\n" * 251, 251, "251 lines"),
        ("harness/base/x.h", "// TO" + "DO: later\n", 1, "left to do"),
        ("shaders/x.glsl", "// " + "wide " * 24 + "\n", 1, "columns"),
        ("README.md", "cd /ho" + "me/somebody/bench\n", 1, "somebody's machine"),
        ("algorithms/lost/light_cursor.glsl", "", 1, None),
        ("scenes/lost/scene.json", "{}", 1, None),
    ]

    def faults_of(files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return check_tree(pathlib.Path(folder))

    wrong = [f"the good tree: {fault}" for fault in faults_of(good)]
    for name, text, line, words in bad:
        faults = faults_of({**good, name: text})
        if words is None:  # a folder without README.md and without a line in registry.cpp
            if sorted(what for _, _, what in faults) != ["README.md is missing", "registry.cpp does not include it"]:
                wrong.append(f"{name}: {faults}")
        elif len(faults) != 1 or faults[0][:2] != (name, line) or words not in faults[0][2]:
            wrong.append(f"{name}: expected one fault at line {line} with '{words}', found {faults}")
    print("\n".join(wrong) or f"self-test: {len(bad)} faults found where they were put")
    return 1 if wrong else 0


def main():
    arguments = sys.argv[1:]
    if arguments == ["--self-test"]:
        return self_test()
    if len(arguments) > 1 or any(argument.startswith("-") for argument in arguments):
        print("usage: check_architecture.py [ROOT | --self-test]", file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parent.parent
    faults = check_tree(root)
    for file, line, what in faults:
        print(f"{file}:{line}: {what}")
    if not faults:
        print("architecture: nothing found")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
