// SPDX-License-Identifier: BSD-3-Clause
// track_deviation: how far tracks are from what the true motion allows, on whole pixels and
// aligned, and whether the tracker claims as much, as markdown.

#include <CLI/CLI.hpp>

#include "program/tool_main.hpp"
#include "track_measurement.hpp"
#include "track_sequences.hpp"
#include "track_tables.hpp"

namespace {

using namespace ardrone_vslam::bench;

MeasuredSequence measure(const SequenceChoice& choice) {
  constexpr bool kAlignTracks = true;
  const TrueSequence sequence = choice.load();
  return {choice.name, sequence.images.size(), measureTracks(sequence, !kAlignTracks),
          measureTracks(sequence, kAlignTracks)};
}

int run(bool is_quick) {
  std::vector<MeasuredSequence> measured;
  for (const SequenceChoice& choice : trackSequences(is_quick)) measured.push_back(measure(choice));
  printTracks(measured);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Measures the deviation of tracks against true poses.", "track_deviation"};
  bool is_quick = false;
  app.add_flag("--quick", is_quick, "a second of one rendered flight");
  return ardrone_vslam::runTool(app, argc, argv, [&is_quick] { return run(is_quick); });
}
