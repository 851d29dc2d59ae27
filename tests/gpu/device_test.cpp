// Finding and choosing devices.
#include "harness/gpu/device.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>

#include "harness/base/error.h"
#include "tests/support/test_device.h"

namespace ml::test {
namespace {

class Devices : public DeviceTest {};

// A device that can be used; the tests' own one is such.
gpu::DeviceInfo usable() {
  return device().info();
}

std::string error_of(const std::string& selector) {
  try {
    gpu::Device chosen({selector, false});
  } catch (const SystemError& error) {
    return error.what();
  }
  return "";
}

// Sets a variable of the environment and puts back what was there.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before, had_ = true;
    setenv(name, value, 1);
  }
  ~Variable() {
    if (had_)
      setenv(name_, before_.c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::string before_;
  bool had_ = false;
};

TEST_F(Devices, AreListedWithWhatAUserNeeds) {
  std::vector<gpu::DeviceInfo> list = gpu::list_devices();
  ASSERT_FALSE(list.empty());
  for (size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i].index, i);
    EXPECT_FALSE(list[i].name.empty());
    EXPECT_EQ(list[i].uuid.size(), 32u);
    EXPECT_EQ(list[i].uuid.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_FALSE(list[i].driver.empty());
    EXPECT_NE(std::string("cpu integrated discrete virtual other").find(list[i].type), std::string::npos)
        << list[i].type;
    EXPECT_EQ(list[i].is_software(), list[i].type == "cpu");
  }
  EXPECT_TRUE(usable().missing.empty());
  const gpu::DeviceLimits& limits = device().limits();
  EXPECT_GE(limits.storage_buffer_range, uint64_t{1} << 27);
  EXPECT_GE(limits.image_size, 4096u);
  EXPECT_GE(limits.group_count[0], 65535u);
  EXPECT_GE(limits.push_constant_bytes, 128u);
  EXPECT_TRUE(device().validation_enabled());
}

TEST_F(Devices, AreChosenByNameIndexAndUuid) {
  const gpu::DeviceInfo known = usable();
  std::string part = known.name.substr(0, known.name.size() / 2), loud, dashed;
  for (char c : part) loud += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (size_t i = 0; i < known.uuid.size(); ++i)
    dashed += (i == 8 || i == 12 || i == 16 || i == 20 ? "-" : "") + known.uuid.substr(i, 1);
  std::vector<std::string> selectors{std::to_string(known.index), known.uuid, dashed};
  if (gpu::list_devices().size() == 1) selectors.insert(selectors.end(), {part, loud, known.name});
  for (const std::string& selector : selectors) {
    gpu::Device chosen({selector, false});
    EXPECT_EQ(chosen.info().uuid, known.uuid) << selector;
    EXPECT_FALSE(chosen.validation_enabled());
  }
  Variable variable("MANYLIGHTS_DEVICE", known.uuid.c_str());
  EXPECT_EQ(gpu::Device({"", false}).info().uuid, known.uuid);
}

TEST_F(Devices, UnknownSelectorsAreErrorsThatNameTheKnownOnes) {
  for (const char* unknown : {"no such device", "99", "0123456789abcdef0123456789abcdef"}) {
    const std::string selector = unknown;
    const std::string text = error_of(selector);
    EXPECT_NE(text.find("'" + selector + "'"), text.npos) << text;
    EXPECT_NE(text.find(usable().name), text.npos) << text;
    EXPECT_EQ(text.find('\n'), text.npos) << text;
  }
  Variable variable("MANYLIGHTS_DEVICE", "also unknown");
  EXPECT_NE(error_of("").find("'also unknown'"), std::string::npos);
}

TEST_F(Devices, NoDriverAtAllIsOneLine) {
  Variable old_name("VK_ICD_FILENAMES", "/nonexistent/icd.json"),
      new_name("VK_DRIVER_FILES", "/nonexistent/icd.json");
  for (const char* selector : {"", "0"}) {
    const std::string text = error_of(selector);
    EXPECT_NE(text.find("no Vulkan device"), text.npos) << text;
    EXPECT_EQ(text.find('\n'), text.npos) << text;
  }
  EXPECT_THROW(gpu::list_devices(), SystemError);
}

}  // namespace
}  // namespace ml::test
