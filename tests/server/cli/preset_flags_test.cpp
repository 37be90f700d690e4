// --preset and --quality: settings by name, and flags beside them, on every command that renders.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "renderer/settings_list.h"
#include "renderer/settings_presets.h"
#include "server/cli/command_line.h"
#include "server/process/exit_code.h"

namespace herr {
namespace {

using Arguments = std::vector<std::string>;

const Arguments kCommands{"replay", "serve", "bench", "check", "study", "inspect", "look"};

RenderSettings settings_of_command(const Command& command) {
  if (const auto* replay = std::get_if<ReplayOptions>(&command)) return replay->render;
  if (const auto* serve = std::get_if<ServeOptions>(&command)) return serve->replay.render;
  if (const auto* bench = std::get_if<BenchOptions>(&command)) return bench->render;
  if (const auto* check = std::get_if<CheckOptions>(&command)) return check->run.replay.render;
  if (const auto* study = std::get_if<StudyOptions>(&command)) return study->render;
  if (const auto* inspect = std::get_if<InspectOptions>(&command)) return inspect->render;
  if (const auto* look = std::get_if<LookOptions>(&command)) return look->render;
  ADD_FAILURE() << "renders nothing";
  return {};
}

Command parsed(const std::string& command, const Arguments& flags) {
  Arguments arguments{command, "walk"};
  if (command == "check") arguments.insert(arguments.end(), {"--against", "other"});
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  return parse_command_line(arguments);
}

RenderSettings settings(const std::string& command, const Arguments& flags) {
  return settings_of_command(parsed(command, flags));
}

std::vector<std::string> texts_of(RenderSettings settings) {
  std::vector<std::string> texts;
  for (const Setting& setting : settings_of(settings)) texts.push_back(setting.name + " " + text_of(setting));
  return texts;
}

TEST(PresetFlags, EveryCommandBeginsWithThePapersFrameAndTakesEachPreset) {
  for (const std::string& command : kCommands) {
    SCOPED_TRACE(command);
    EXPECT_EQ(texts_of(settings(command, {})), texts_of(RenderSettings()));
    EXPECT_EQ(texts_of(settings(command, {"--preset", "paper"})), texts_of(RenderSettings()));
    EXPECT_EQ(texts_of(settings(command, {"--preset", "direct"})), texts_of(direct_light_settings()));
  }
}

TEST(PresetFlags, OtherFlagsOverrideAPresetWhereverTheyStand) {
  for (const std::string& command : kCommands) {
    SCOPED_TRACE(command);
    for (const Arguments& flags : {Arguments{"--preset", "direct", "--occlusion-rays", "4"},
                                   {"--occlusion-rays", "4", "--preset", "direct"}}) {
      const RenderSettings got = settings(command, flags);
      EXPECT_EQ(got.occlusion_rays, 4);
      EXPECT_FALSE(got.probes.on);
    }
    for (const Arguments& flags : {Arguments{"--quality", "soft", "--light-samples", "8"},
                                   {"--light-samples", "8", "--quality", "soft"}}) {
      EXPECT_EQ(settings(command, flags).light_samples, 8);
    }
    for (const Arguments& flags : {Arguments{"--quality", "ultra", "--preset", "paper"},
                                   {"--preset", "paper", "--quality", "ultra"}}) {
      EXPECT_EQ(settings(command, flags).light_samples, 256) << "shadows by name are less than a frame";
    }
    for (const Arguments& flags : {Arguments{"--no-probes", "--preset", "paper"}, {"--no-probes"}}) {
      const RenderSettings got = settings(command, flags);
      EXPECT_FALSE(got.probes.on);
      EXPECT_EQ(got.occlusion_rays, RenderSettings().occlusion_rays);
    }
    if (command == "inspect") continue;  // its --probes was a folder once, and is refused
    for (const Arguments& flags :
         {Arguments{"--probes", "--preset", "direct"}, {"--preset", "direct", "--probes"}}) {
      EXPECT_TRUE(settings(command, flags).probes.on);
      EXPECT_EQ(settings(command, flags).occlusion_rays, 0);
    }
  }
  EXPECT_THROW(parsed("replay", {"--preset", "paper", "--preset", "direct"}), UsageError) << "which one?";
}

TEST(PresetFlags, AnUnknownNameNamesTheNearest) {
  for (const std::string& command : kCommands) {
    for (const auto& [flag, wrong, right] :
         std::vector<std::array<std::string, 3>>{{"--preset", "papre", "paper"},
                                                 {"--preset", "driect", "direct"},
                                                 {"--quality", "sotf", "soft"}}) {
      try {
        parsed(command, {flag, wrong});
        ADD_FAILURE() << command << ' ' << wrong;
      } catch (const UsageError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find(flag + ":"), 0u) << message;
        EXPECT_NE(message.find("did you mean " + right + "?"), std::string::npos) << message;
      }
    }
  }
}

TEST(PresetFlags, HelpSaysWhatEachPresetIsAndThatFlagsOverrideIt) {
  for (const std::string& command : kCommands) {
    const std::string help = std::get<ShowText>(parse_command_line({command, "--help"})).text;
    for (const auto* presets : {&frame_presets(), &shadow_presets()}) {
      for (const SettingsPreset& preset : *presets) {
        EXPECT_NE(help.find(preset.name + ":"), std::string::npos) << command << ' ' << preset.name;
      }
    }
    EXPECT_NE(help.find("other flags override"), std::string::npos) << command;
    // Every pixel of `look` has rays of its own.
    EXPECT_EQ(help.find("foveated") == std::string::npos, command == "look") << command;
  }
}

// Another build may not know presets, or have other defaults: both are told what is measured.
TEST(PresetFlags, TheRunsOfACheckAreGivenEachFlagThatAPresetStandsFor) {
  const auto arguments = [](const Arguments& flags) {
    return std::get<CheckOptions>(parsed("check", flags)).run_arguments;
  };
  EXPECT_EQ(arguments({}), (Arguments{"--occlusion-rays", "1", "--probes", "walk"}));
  EXPECT_EQ(arguments({"--preset", "direct"}), (Arguments{"--occlusion-rays", "0", "--no-probes", "walk"}));
  EXPECT_EQ(arguments({"--no-probes", "--occlusion-rays", "3"}),
            (Arguments{"--occlusion-rays", "3", "--no-probes", "walk"}));
  EXPECT_EQ(arguments({"--preset", "direct", "--probes", "--polar", "64x32"}),
            (Arguments{"--occlusion-rays", "0", "--probes", "--polar", "64x32", "walk"}));
}

}  // namespace
}  // namespace herr
