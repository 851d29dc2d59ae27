#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <limits>

#include "files.h"
#include "harness/base/error.h"
#include "harness/base/random.h"
#include "harness/output/picture.h"

namespace {

using namespace ml;

// Every kind of float: the bits are random.
Picture random_bits(uint32_t width, uint32_t height, std::vector<std::string> channels, uint64_t seed) {
  Picture picture(width, height, std::move(channels));
  Random random(seed);
  for (float& value : picture.data) {
    uint32_t bits = random.next();
    std::memcpy(&value, &bits, sizeof value);
  }
  constexpr float special[] = {0.0f, -0.0f, std::numeric_limits<float>::quiet_NaN(),
                               std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::denorm_min()};
  for (size_t i = 0; i < std::min(std::size(special), picture.data.size()); ++i) picture.data[i] = special[i];
  return picture;
}

bool same_bits(const Picture& a, const Picture& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         a.data.size() == b.data.size() &&
         std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0;
}

TEST(Exr, GivesBackTheSameBits) {
  Folder folder;
  const std::vector<std::vector<std::string>> layouts{
      {"Y"}, {"R", "G", "B"}, {"X", "Y", "Z"}, {"metallic", "roughness"}, {"R", "G", "B", "A", "z"}};
  const std::pair<uint32_t, uint32_t> sizes[] = {{1, 1}, {1, 37}, {37, 1}, {64, 36}, {33, 17}};
  uint64_t seed = 1;
  for (const auto& channels : layouts) {
    for (auto [width, height] : sizes) {
      Picture picture = random_bits(width, height, channels, ++seed);
      write_exr(picture, folder / "a.exr");
      EXPECT_TRUE(same_bits(read_exr(folder / "a.exr"), picture))
          << channels.size() << " channels, " << width << "x" << height;
    }
  }
}

TEST(Exr, ColoursComeFirstAndOtherChannelsByName) {
  Folder folder;
  Picture picture(2, 1, {"z", "B", "a", "R"});
  picture.data = {1, 2, 3, 4, 5, 6, 7, 8};
  write_exr(picture, folder / "a.exr");
  Picture back = read_exr(folder / "a.exr");
  EXPECT_EQ(back.channels, (std::vector<std::string>{"R", "B", "a", "z"}));
  EXPECT_EQ(back.data, (std::vector<float>{4, 2, 3, 1, 8, 6, 7, 5}));
}

TEST(Exr, SamePictureSameBytes) {
  Folder folder;
  Picture picture = random_bits(40, 30, {"R", "G", "B"}, 7);
  write_exr(picture, folder / "a.exr", {{"camera", "0 0 0"}});
  write_exr(picture, folder / "b.exr", {{"camera", "0 0 0"}});
  EXPECT_EQ(read_file(folder / "a.exr"), read_file(folder / "b.exr"));
}

TEST(Exr, IsFloatZipWithItsAttributes) {
  Folder folder;
  write_exr(random_bits(5, 4, {"Y"}, 3), folder / "a.exr", {{"tone", "none"}, {"unit", "lights per pixel"}});
  Imf::InputFile file((folder / "a.exr").c_str());
  EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
  ASSERT_NE(file.header().channels().findChannel("Y"), nullptr);
  EXPECT_EQ(file.header().channels().findChannel("Y")->type, Imf::FLOAT);
  EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("unit").value(), "lights per pixel");
  EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("tone").value(), "none");
}

TEST(Exr, ReadsHalfFloatsAndDataWindowsThatDoNotStartAtZero) {
  Folder folder;
  const int width = 7, height = 20;
  std::vector<half> values;
  for (int i = 0; i < width * height; ++i) values.emplace_back(static_cast<float>(i) * 0.5f);
  Imath::Box2i window({-3, 5}, {-3 + width - 1, 5 + height - 1});
  Imf::Header header(window, window);
  header.channels().insert("Y", Imf::Channel(Imf::HALF));
  Imf::FrameBuffer buffer;
  auto base = reinterpret_cast<uintptr_t>(values.data()) + 3 * sizeof(half) - 5 * width * sizeof(half);
  buffer.insert("Y",
                Imf::Slice(Imf::HALF, reinterpret_cast<char*>(base), sizeof(half), sizeof(half) * width));
  {
    Imf::OutputFile file((folder / "half.exr").c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(height);
  }
  Picture picture = read_exr(folder / "half.exr");
  ASSERT_EQ(picture.width, 7u);
  ASSERT_EQ(picture.height, 20u);
  for (size_t i = 0; i < picture.data.size(); ++i) ASSERT_EQ(picture.data[i], static_cast<float>(i) * 0.5f);
}

TEST(Exr, DamagedFilesAreUsageErrorsOrPicturesAndNothingElse) {
  Folder folder;
  write_exr(random_bits(40, 33, {"R", "G", "B"}, 9), folder / "whole.exr");
  const auto whole = read_file(folder / "whole.exr");
  int refused = 0;
  auto attempt = [&](const std::vector<std::byte>& bytes) {
    write_file(folder / "bad.exr", bytes);
    try {
      read_exr(folder / "bad.exr");
    } catch (const UsageError& error) {
      ++refused;
      EXPECT_TRUE(contains(error.what(), "bad.exr")) << error.what();
    }
  };
  for (size_t size = 0; size < whole.size(); size += 1 + size / 8)
    attempt({whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)});
  EXPECT_GT(refused, 20);
  for (size_t at = 0; at < 400; ++at) {
    auto bytes = whole;
    bytes[at] ^= std::byte{0xff};
    attempt(bytes);
  }
}

TEST(Exr, MissingFileIsAUsageError) {
  EXPECT_TRUE(contains(message_of<UsageError>([] { read_exr("/nowhere/a.exr"); }), "/nowhere/a.exr"));
}

TEST(Exr, DirectoryThatIsNotThereIsASystemError) {
  EXPECT_TRUE(contains(message_of<SystemError>([] { write_exr(Picture(1, 1, {"Y"}), "/nowhere/a.exr"); }),
                       "/nowhere/a.exr"));
}

// A full disk, acted by a limit on the size of files.
TEST(Exr, FullDiskIsASystemErrorAndTheOldFileStays) {
  Folder folder;
  write_exr(Picture(4, 4, {"Y"}), folder / "a.exr");
  const auto before = read_file(folder / "a.exr");
  auto* handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{}, small{};
  getrlimit(RLIMIT_FSIZE, &old);
  small = {4096, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_exr(random_bits(100, 100, {"Y"}, 1), folder / "a.exr"), SystemError);
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read_file(folder / "a.exr"), before);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.exr"});
}

}  // namespace
