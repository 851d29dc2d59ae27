// Devices that lack something that manylights needs, as a layer makes them (tests/layer/lacking.cpp): refused
// by name, and listed with what they lack.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "tests/end_to_end/program.h"

namespace ml::test {
namespace {

// What the layer takes away, and what is said of it.
const std::map<std::string, std::string> lacks{
    {"version", "Vulkan 1.3"},
    {"scalarBlockLayout", "scalarBlockLayout"},
    {"synchronization2", "synchronization2"},
    {"dynamicRendering", "dynamicRendering"},
    {"shuffle", "votes, ballots, shuffles and arithmetic across subgroups"},
    {"stage", "votes, ballots, shuffles and arithmetic across subgroups in compute shaders"}};

class Lacking : public testing::TestWithParam<const char*> {
 protected:
  ProcessOptions options() const {
    ProcessOptions options;
    options.folder = folder_.path();  // `run` writes into the folder it stands in, one at a time
    options.environment = {{"VK_ADD_LAYER_PATH", ML_LAYER_FOLDER},
                           {"VK_INSTANCE_LAYERS", "VK_LAYER_ML_lacking"},
                           {"ML_LACKS", GetParam()}};
    return options;
  }
  std::string said() const { return "lacks " + lacks.at(GetParam()); }

 private:
  Folder folder_;
};

TEST_P(Lacking, IsSaidOfTheDevice) {
  const Outcome listed = manylights({"list", "devices"}, options());
  EXPECT_EQ(listed.code, 0) << listed.error;
  EXPECT_NE(listed.out.find(said()), std::string::npos) << listed.out;
}

TEST_P(Lacking, IsRefusedInOneLine) {
  for (std::vector<std::string> arguments : {std::vector<std::string>{"run", "quick"},
                                             std::vector<std::string>{"run", "quick", "--device", "0"}}) {
    const Outcome refused = manylights(arguments, options());
    EXPECT_EQ(refused.code, 3) << refused.error;
    EXPECT_NE(refused.error.find(said()), std::string::npos) << refused.error;
    EXPECT_EQ(std::count(refused.error.begin(), refused.error.end(), '\n'), 1) << refused.error;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Lacking,
                         testing::Values("version", "scalarBlockLayout", "synchronization2",
                                         "dynamicRendering", "shuffle", "stage"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace ml::test
