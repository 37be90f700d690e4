// What the line of a mistake says: the flag or command that was meant, the help to read, the range to keep.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "server/cli/command_line.h"
#include "server/process/exit_code.h"
#include "server/settings/option_checks.h"

namespace herr {
namespace {

using Arguments = std::vector<std::string>;

std::string complaint(const Arguments& arguments) {
  try {
    parse_command_line(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

TEST(MistakenLines, AMistakeNamesTheHelpOfItsCommand) {
  const std::vector<std::pair<Arguments, std::string>> lines{
      {{"replay"}, "SESSION is required; 'herr replay --help' shows the usage"},
      {{"serve"}, "SESSION is required; 'herr serve --help' shows the usage"},
      {{"look"}, "MODEL is required; 'herr look --help' shows the usage"},
      {{"replay", "s", "--frames"},
       "--frames: its value (N) is missing; 'herr replay --help' shows the usage"},
      {{"help", "replya"},
       "help: 'replya' is not one of replay, serve, bench, check, study, inspect, look, synth, convert; did "
       "you mean replay?"},
      {{"--scene", "x", "replay"},
       "--scene: flags go after the command: 'herr replay --scene ...'; 'herr replay --help' lists all"},
      {{"--scene=x"},
       "--scene: flags go after a command, and there is none; 'herr --help' lists the commands"},
      {{"frobnicate"},
       "command: 'frobnicate' is not one of replay, serve, bench, check, study, inspect, look, synth, "
       "convert"},
  };
  for (const auto& [arguments, message] : lines) EXPECT_EQ(complaint(arguments), message);
}

TEST(MistakenLines, AFlagThatIsNoneNamesWhatIsMeantOrNothing) {
  EXPECT_NE(complaint({"replay", "s", "--density"}).find("did you mean --density-overlay?"),
            std::string::npos);
  EXPECT_NE(complaint({"convert", "a", "b", "--vergence", "2"}).find("write \"vergence_m\" there"),
            std::string::npos);
  EXPECT_EQ(complaint({"replay", "s", "--zzzzzz"}),
            "--zzzzzz: unknown flag ('herr replay --help' lists all)");
  EXPECT_EQ(
      complaint({"replay", "s", "--quality-target", "20"}),
      "--quality-target: unknown flag; did you mean --target-ms (with --policy deadline)? ('herr replay "
      "--help' lists all)");
  // `inspect` has no target.
  EXPECT_EQ(complaint({"inspect", "s", "--quality-target", "20"}).find("--target-ms"), std::string::npos);
  // `hard` differs in two letters of four: it is listed, not proposed.
  const std::string quality = complaint({"replay", "s", "--quality", "high"});
  EXPECT_NE(quality.find("'high' is not one of "), std::string::npos) << quality;
  EXPECT_NE(quality.find("hard"), std::string::npos) << quality;
  EXPECT_EQ(quality.find("did you mean"), std::string::npos) << quality;
}

TEST(MistakenLines, ANumberOutOfRangeSaysItsRange) {
  const std::vector<std::pair<Arguments, std::string>> lines{
      {{"replay", "s", "--frames", "0"}, "--frames: '0' is out of range: 1 to "},
      {{"replay", "s", "--threads", "0"}, "--threads: '0' is out of range: 1 to 512"},
      {{"serve", "s", "--port", "99999"}, "--port: '99999' is out of range: 0 to 65535"},
      {{"replay", "s", "--exposure=-20"}, "--exposure: '-20' is out of range: -15 to 15"},
      {{"synth", "s", "--origin", "0,-2000000,0"},
       "--origin: '-2000000' is out of range: -1000000 to 1000000"},
  };
  for (const auto& [arguments, message] : lines) EXPECT_EQ(complaint(arguments).find(message), 0u) << message;
}

TEST(MistakenLines, AFlagIsGivenOnce) {
  EXPECT_EQ(complaint({"replay", "s", "--light-samples", "4", "--light-samples=8"}),
            "--light-samples: is given twice, as '4' and '8'; give it once");
  EXPECT_EQ(complaint({"replay", "s", "--scene", "a", "--frames", "2", "--scene", "b"}),
            "--scene: is given twice, as 'a' and 'b'; give it once");
  EXPECT_EQ(complaint({"look", "m.glb", "--preset", "paper", "--preset", "direct"}),
            "--preset: is given twice, as 'paper' and 'direct'; give it once");
  EXPECT_EQ(complaint({"replay", "s", "--probes", "--no-probes"}),
            "--no-probes: conflicts with --probes; give one of them");
  // The same once more says nothing else.
  const auto same = std::get<ReplayOptions>(
      parse_command_line({"replay", "s", "--light-samples", "8", "--light-samples", "8", "--overwrite",
                          "--overwrite", "--scene", "[a]", "--scene", "[a]"}));
  EXPECT_EQ(same.render.light_samples, 8);
  EXPECT_EQ(same.scene, "[a]");
  const auto two =
      std::get<ReplayOptions>(parse_command_line({"replay", "s", "--asset-root", "a", "--asset-root", "b"}));
  EXPECT_EQ(two.asset_roots.size(), 2u);
}

TEST(MistakenLines, AValueThatIsNoneNamesOneToGive) {
  const std::vector<std::pair<Arguments, std::string>> lines{
      {{"replay", "s", "--light-samples", "+1"},
       "--light-samples: '+1' is not a whole number from 1 to 4096; write 1"},
      {{"replay", "s", "--exposure", "+1,5"}, "--exposure: '+1,5' is not a number from -15 to 15; write 1.5"},
      {{"replay", "s", "--duration", "2s"},
       "--duration: '2s' is not a number from 0 to 10000000; write the number alone, without a unit: it is "
       "in "
       "seconds"},
      {{"synth", "s", "--duration", "2s"},
       "--duration: '2s' is not a number from 0.1 to 86400; write the number alone, without a unit: seconds"},
      {{"replay", "s", "--policy", "motion", "--polar-floor", "801"},
       "--polar-floor: '801' is not a multiple of 2; give 800 or 802"},
      {{"replay", "s", "--polar-floor", "800"},
       "--polar-floor: the policy fixed never goes below --polar; give --policy motion, deadline or "
       "motion+deadline"},
      {{"look", "m.glb", "--size", "640"}, "--size: '640' is not a size; write WIDTHxHEIGHT: 640x640"},
      {{"look", "m.glb", "--size", "640x"}, "--size: '640x' is not a size; write WIDTHxHEIGHT: 640x640"},
      {{"look", "m.glb", "--size", "640*480"},
       "--size: '640*480' is not a size; write WIDTHxHEIGHT: 640x480"},
      {{"look", "m.glb", "--size", "big"}, "--size: 'big' is not a size; write WIDTHxHEIGHT: 800x600"},
      {{"look", "m.glb", "--size", "16384x16384"},
       "--size: has more than 67108864 pixels; give at most 8192x8192"},
  };
  for (const auto& [arguments, message] : lines) EXPECT_EQ(complaint(arguments), message);
}

TEST(MistakenLines, MoreThreadsThanCoresAreTold) {
  EXPECT_EQ(too_many_threads(0, 2), "");
  EXPECT_EQ(too_many_threads(2, 2), "");
  EXPECT_EQ(
      too_many_threads(64, 2),
      "--threads 64: this process may use 2 cores, and threads that share one wait for each other; give "
      "--threads 2, or leave it out");
}

}  // namespace
}  // namespace herr
