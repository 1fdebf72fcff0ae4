// SPDX-License-Identifier: BSD-3-Clause
#include "report/earlier_run.hpp"

#include <nlohmann/json.hpp>
#include <set>

#include "report/run_files.hpp"
#include "summary/run_report.hpp"
#include "summary/seeds_summary.hpp"
#include "support/sequence_folders.hpp"
#include "trajectory/text_file.hpp"

namespace ardrone_vslam {
namespace {

using Json = nlohmann::ordered_json;

Json summaryOfSeed(std::uint64_t seed) {
  const RunResult run;
  return summaryOf(run, evaluate(run, {}), {"flight", "drone", seed, "thesis"});
}

void writeOneRun(const TemporaryFolder& folder) {
  RunResult run;
  run.refined.emplace();
  writeRun(folder.path(), run, evaluate(run, {}), summaryOfSeed(1));
  folder.write("truth.tum", "");
}

void writeSeeds(const TemporaryFolder& folder, const std::vector<std::uint64_t>& seeds) {
  const RunResult run;
  std::vector<Json> summaries;
  for (const std::uint64_t seed : seeds) {
    summaries.push_back(summaryOfSeed(seed));
    writeRun(seedFolder(folder.path(), seed), run, evaluate(run, {}), summaries.back());
  }
  writeText(folder.file("summary.json"), summaryOfSeeds(summaries).dump());
}

std::set<std::string> filesIn(const TemporaryFolder& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    names.insert(entry.path().lexically_relative(folder.path()).string());
  return names;
}

TEST(EarlierRun, OfOneOdometryIsRemovedAndNothingElse) {
  const TemporaryFolder folder;
  writeOneRun(folder);
  for (const char* name : kRunFiles) EXPECT_EQ(filesIn(folder).count(name), 1U) << name;
  folder.write("run.png", "");
  folder.write("notes.txt", "");
  removeEarlierRun(folder.path());
  EXPECT_EQ(filesIn(folder), (std::set<std::string>{"run.png", "notes.txt"}));
}

TEST(EarlierRun, OfSeveralSeedsIsRemovedAndNothingElse) {
  const TemporaryFolder folder;
  writeSeeds(folder, {1, 2, 12});
  folder.write("seed_2/run.png", "");
  std::filesystem::create_directory(folder.file("seed_3"));
  folder.write("seed_3/fused.tum", "");
  removeEarlierRun(folder.path());
  EXPECT_EQ(filesIn(folder),
            (std::set<std::string>{"seed_2", "seed_2/run.png", "seed_3", "seed_3/fused.tum"}));
}

TEST(EarlierRun, ARecordingAndWhatALinkLeadsToAreKept) {
  const TemporaryFolder recording;
  recording.write("fused.tum", "");
  recording.write("summary.json", R"({"sequence": "bag", "frames": 3, "fused_ate_rmse_m": 0.1})");
  removeEarlierRun(recording.path());
  EXPECT_EQ(filesIn(recording), (std::set<std::string>{"fused.tum", "summary.json"}));

  const TemporaryFolder kept;
  writeOneRun(kept);
  const std::set<std::string> before = filesIn(kept);
  const TemporaryFolder folder;
  writeSeeds(folder, {1, 2});
  std::filesystem::remove_all(folder.file("seed_2"));
  std::filesystem::create_directory_symlink(kept.path(), folder.file("seed_2"));
  removeEarlierRun(folder.path());
  EXPECT_EQ(filesIn(kept), before);
}

TEST(EarlierRun, WhatNoRunWroteIsKept) {
  const TemporaryFolder folder;
  removeEarlierRun(folder.file("none"));
  folder.write("fused.tum", "");
  removeEarlierRun(folder.path());
  for (const char* text : {"", "{", "[]", "{\"frames\": 3}", "{\"seeds\": [1]}"}) {
    folder.write("summary.json", text);
    removeEarlierRun(folder.path());
    EXPECT_EQ(filesIn(folder), (std::set<std::string>{"fused.tum", "summary.json"})) << text;
  }
}

}  // namespace
}  // namespace ardrone_vslam
