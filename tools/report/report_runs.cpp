// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_runs.hpp"

#include <iostream>
#include <nlohmann/json.hpp>

#include "report/run_files.hpp"
#include "report/run_print.hpp"
#include "report/run_verdict.hpp"
#include "summary/run_words.hpp"
#include "summary/seeds_summary.hpp"
#include "trajectory/text_file.hpp"

namespace ardrone_vslam {

std::vector<std::string> reportRuns(const Sequence& sequence,
                                    const std::vector<RunOdometry>& odometries,
                                    const std::vector<RunResult>& results,
                                    const ReportOptions& options) {
  std::vector<nlohmann::ordered_json> summaries;
  std::vector<RunEvaluation> evaluations;
  std::vector<std::string> faults;
  for (std::size_t i = 0; i < results.size(); ++i) {
    bool truth_moved = false;
    // In a loaded map the odometry begins anywhere: there the truth is that map's.
    const Trajectory truth =
        results[i].is_in_loaded_map
            ? sequence.truth()
            : truthFromOdometryStart(sequence.truth(), odometries[i], truth_moved);
    evaluations.push_back(evaluate(results[i], truth));
    if (results[i].is_finished) {
      const RunVerdict verdict =
          judgeRun(sequence.name(), results[i], evaluations.back(), truth_moved);
      for (const std::string& text : verdict.warnings) options.warn(text);
      faults.insert(faults.end(), verdict.faults.begin(), verdict.faults.end());
    }
    const RunLabel label{sequence.name(), odometries[i].profile, odometries[i].seed,
                         options.estimator};
    summaries.push_back(summaryOf(results[i], evaluations.back(), label));
    summaries.back()["is_finished"] = results[i].is_finished;
  }
  nlohmann::ordered_json all;
  if (options.is_of_seeds) {
    all = summaryOfSeeds(summaries);
    all["is_finished"] = results.front().is_finished;
    // First: it tells a later run which folders are this one's.
    writeText(options.folder + "/summary.json", all.dump(2) + "\n");
  }
  for (std::size_t i = 0; i < results.size(); ++i) {
    writeRun(options.is_of_seeds ? seedFolder(options.folder, *odometries[i].seed) : options.folder,
             results[i], evaluations[i], summaries[i]);
  }
  if (!results.front().is_finished) return faults;
  const nlohmann::ordered_json& first = summaries.front();
  if (options.is_of_seeds) {
    printSeeds(all, std::cout);
  } else {
    std::cout << inLines(first) << first["verdict"].get<std::string>() << '\n';
  }
  return faults;
}

}  // namespace ardrone_vslam
