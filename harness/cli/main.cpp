// manylights: arguments in, exit code out. Every error is one line on stderr.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <new>

#include "harness/bench/interruption.h"
#include "harness/cli/commands.h"

namespace {

constexpr const char* about =
    "The test bench for many-light algorithms: every algorithm behind one interface, over the same "
    "g-buffer,\n"
    "lights and shading code, replayed along the same camera paths, with every number proven and repeatable.";

constexpr const char* examples =
    "Begin with\n"
    "  manylights doctor                          what this machine can do\n"
    "  manylights run quick                       a first result in under a minute\n"
    "  manylights verify quick                    prove it: no light lost, the same bits again\n"
    "  manylights run quick --set scene.gltf=level.glb --set lights.count=16384\n"
    "\n"
    "Exit codes: 0 done; 1 a claim failed; 2 wrong usage, configuration or scene file; 3 device, driver or\n"
    "file system; 4 interrupted, what was measured is kept.";

int fail(ml::ExitCode code, const std::string& message) {
  fmt::print(stderr, "manylights: {}\n", ml::one_line(message));
  return static_cast<int>(code);
}

void check_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (std::find(known.begin(), known.end(), word) == known.end())
    throw ml::UsageError("unknown command '" + word + "'" + ml::suggestion(word, known));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(about, "manylights");
  app.footer(examples);
  app.require_subcommand(1);
  app.set_help_all_flag("--help-all", "Print the help of all commands and exit");
  ml::Action action;
  ml::add_list(app, action);
  ml::add_run(app, action);
  ml::add_verify(app, action);
  ml::add_render(app, action);
  ml::add_scene(app, action);
  ml::add_doctor(app, action);
  try {
    if (argc > 1 && argv[1][0] != '-') check_command(app, argv[1]);
    app.parse(argc, argv);
    ml::watch_for_interruption();
    return static_cast<int>(action());
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
    return fail(ml::ExitCode::usage, error.what() + std::string(" (--help shows how)"));
  } catch (const ml::Interrupted& error) {
    if (ml::may_tell_of_interruption()) fail(error.code(), error.what());
    return static_cast<int>(error.code());
  } catch (const ml::Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ml::ExitCode::system, "out of memory");
  } catch (const std::exception& error) {
    return fail(ml::ExitCode::system, error.what());
  }
}
