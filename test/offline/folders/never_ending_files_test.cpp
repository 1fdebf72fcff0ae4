// SPDX-License-Identifier: BSD-3-Clause
// A pipe that nobody writes to, or a device without an end, in place of each file of an input.

#include <sys/stat.h>

#include "config_files/config_file.hpp"
#include "sequences/sequence.hpp"
#include "simulation/odometry_model.hpp"
#include "support/sequence_folders.hpp"

namespace ardrone_vslam {
namespace {

/// Puts what never ends in place of a file. @return what `use` says of it
template <class Use>
std::string saidOf(const TemporaryFolder& folder, const std::string& name, bool is_pipe,
                   const Use& use) {
  folder.remove(name);
  if (is_pipe) {
    EXPECT_EQ(mkfifo(folder.file(name).c_str(), 0600), 0);
  } else {
    std::filesystem::create_symlink("/dev/zero", folder.file(name));
  }
  try {
    use();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "nothing";
}

void expectRefusals(const std::vector<std::string>& names,
                    void (*makeFolder)(const TemporaryFolder& folder, int images)) {
  for (const std::string& name : names) {
    for (const bool is_pipe : {false, true}) {
      TemporaryFolder folder;
      makeFolder(folder, 3);
      const std::string said =
          saidOf(folder, name, is_pipe, [&] { openFolder(folder.path())->image(0); });
      EXPECT_EQ(said, folder.file(name) + ": is no file but a folder, device or pipe; name a file");
    }
  }
}

TEST(NeverEndingFiles, OfAKittiFolderAreRefused) {
  expectRefusals({"calib.txt", "times.txt", "poses.txt"}, makeKittiFolder);
}

TEST(NeverEndingFiles, OfATumFolderAreRefused) {
  expectRefusals({"camera.yaml", "times.txt", "poses_tum.txt", "range.txt"}, makeTumFolder);
  expectRefusals({"image/000000.png"}, makeTumFolder);
}

TEST(NeverEndingFiles, AsConfigurationAreRefused) {
  for (const bool is_pipe : {false, true}) {
    TemporaryFolder folder;
    const std::string path = folder.file("my.yaml");
    const std::string fault = path + ": is no file but a folder, device or pipe; name a file";
    EXPECT_NE(saidOf(folder, "my.yaml", is_pipe, [&] { loadConfig(path, {}); }).find(fault),
              std::string::npos);
    EXPECT_EQ(saidOf(folder, "my.yaml", is_pipe, [&] { loadOdometryProfile("drone", path); }),
              fault);
  }
}

}  // namespace
}  // namespace ardrone_vslam
