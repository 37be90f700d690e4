// What the line of a mistake says: the flag or command that was meant, the help to read, the range to keep.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "server/cli/command_line.h"
#include "server/process/exit_code.h"

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
      {{"help"}, "'help' is no command; 'herr --help' lists the commands, 'herr COMMAND --help' its flags"},
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

}  // namespace
}  // namespace herr
