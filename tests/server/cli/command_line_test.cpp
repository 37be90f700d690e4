#include "server/cli/command_line.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/process/exit_code.h"
#include "tests/server/cli/refused_line.h"

namespace herr {
namespace {

using test::Arguments;
using test::complaint;

ReplayOptions replay(Arguments arguments) {
  arguments.insert(arguments.begin(), {"replay", "walk"});
  return std::get<ReplayOptions>(parse_command_line(arguments));
}

TEST(CommandLine, ServeLeavesLoopbackOnlyWithAToken) {
  EXPECT_NE(complaint({"serve", "s", "--host", "0.0.0.0"}).find("give --auth-token-file"), std::string::npos);
  EXPECT_EQ(complaint({"serve", "s", "--host", "0.0.0.0", "--auth-token-file", "t"}), "");
  EXPECT_NE(complaint({"serve", "s", "--allowed-host", "http://x"}).find("no name of a host"),
            std::string::npos);
  const auto named = std::get<ServeOptions>(
      parse_command_line({"serve", "s", "--allowed-host", "A.example", "--allowed-host", "[fe80::1]"}));
  EXPECT_EQ(named.allowed_hosts, (std::vector<std::string>{"a.example", "[fe80::1]"}));
}

TEST(CommandLine, APathFromAVariableThatWasNotSetIsNamed) {
  EXPECT_NE(complaint({"replay", ""}).find("SESSION: the path is empty"), std::string::npos);
  EXPECT_NE(complaint({"serve", ""}).find("SESSION: the path is empty"), std::string::npos);
  EXPECT_NE(complaint({"replay", "walk", "--profile", ""}).find("--profile: the path is empty"),
            std::string::npos);
  EXPECT_NE(complaint({"study", "walk", "--only", "place,"}).find("--only: a name is empty"),
            std::string::npos);
  EXPECT_NE(complaint({"bench", "--profile", ""}).find("--profile: the path is empty"), std::string::npos);
}

TEST(CommandLine, ReplayHasTheDefaultsOfThePaper) {
  const ReplayOptions options = replay({});
  EXPECT_EQ(options.sessions, std::vector<std::filesystem::path>{"walk"});
  EXPECT_EQ(options.render.polar_width, 788);
  EXPECT_EQ(options.render.polar_height, 768);
  EXPECT_EQ(options.render.light_samples, 1);
  EXPECT_TRUE(options.render.reflections);
  EXPECT_TRUE(options.render.refraction);
  EXPECT_TRUE(options.render.probes.on);
  EXPECT_EQ(options.render.occlusion_rays, 1);
  EXPECT_EQ(options.formats, PictureFormat::png);
  EXPECT_EQ(options.sheet, SheetChoice::middle);
}

TEST(CommandLine, ReplayUnderstandsEveryFlagItOffers) {
  const ReplayOptions options = replay({"run",
                                        "--scene",
                                        "a.scene.json",
                                        "--out",
                                        "o",
                                        "--format",
                                        "exr",
                                        "--profile",
                                        "xr1-half",
                                        "--polar",
                                        "2048x1024",
                                        "--light-samples",
                                        "64",
                                        "--no-reflections",
                                        "--no-camera",
                                        "--foveation",
                                        "off",
                                        "--gaze-marker",
                                        "--feed-distance",
                                        "1.5",
                                        "--debug-tiles",
                                        "--policy",
                                        "fixed",
                                        "--clock",
                                        "max",
                                        "--frames",
                                        "10",
                                        "--duration",
                                        "1.5",
                                        "--start",
                                        "0.25",
                                        "--threads",
                                        "2",
                                        "--isa",
                                        "avx2",
                                        "--sampling",
                                        "predict",
                                        "--contact-sheet",
                                        "7",
                                        "--overwrite",
                                        "--keep-going",
                                        "--strict",
                                        "--json"});
  EXPECT_EQ(options.sessions.size(), 2u);
  EXPECT_EQ(options.scene, "a.scene.json");
  EXPECT_EQ(options.out, "o");
  EXPECT_EQ(options.formats, PictureFormat::exr);
  EXPECT_EQ(options.profile, "xr1-half");
  EXPECT_EQ(options.render.polar_width, 1024);  // per eye: half of both eyes
  EXPECT_EQ(options.render.polar_height, 1024);
  EXPECT_EQ(options.render.light_samples, 64);
  EXPECT_FALSE(options.render.reflections);
  EXPECT_FALSE(options.render.camera);
  EXPECT_EQ(options.render.foveation, Foveation::off);
  EXPECT_TRUE(options.render.gaze_marker);
  EXPECT_EQ(options.render.feed_distance_m, 1.5);
  EXPECT_TRUE(options.render.debug_tiles);
  EXPECT_EQ(options.clock, ReplayClock::max);
  EXPECT_EQ(options.frames, 10);
  EXPECT_EQ(options.duration_s, 1.5);
  EXPECT_EQ(options.start_s, 0.25);
  EXPECT_EQ(options.render.threads, 2);
  EXPECT_EQ(options.render.isa, Isa::avx2);
  EXPECT_EQ(options.session.sampling, SamplingMode::predict);
  EXPECT_EQ(options.sheet, SheetChoice::one);
  EXPECT_EQ(options.sheet_frame, 7);
  EXPECT_TRUE(options.overwrite && options.session.keep_going && options.session.strict && options.json);
}

TEST(CommandLine, WrongValuesAreRefusedWithTheNameOfTheirFlag) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> table{
      {"--frames",
       {"0", "-5", "+5", "010", "1e3", "1.0", "nan", "inf", "", " 5", "5 ", "0x10", "99999999999999999999"}},
      {"--threads", {"0", "-1", "513", "10000", "two"}},
      {"--light-samples", {"0", "4097", "1e3", "010"}},
      {"--start", {"-1", "nan", "inf", "1e3", "01", ".5", "5.", "1,5", "", "1e999"}},
      {"--duration", {"-0.1", "nan", "infinity", "1.5.2"}},
      {"--polar",
       {"1576", "1576x", "x768", "1576x768x2", "0x768", "1575x768", "1576x767", "99999x768", "-2x2", "010x8",
        "1576X768", "16384x16384"}},
      {"--format", {"jpg", "PNG", ""}},
      {"--isa", {"avx", "sse", ""}},
      {"--foveation", {"on", "logpolar"}},
      {"--policy", {"best", "motion,deadline", "deadline+motion", ""}},
      {"--feed-distance", {"0", "0.0000000001", "-1", "nan", "2m", ""}},
      {"--exposure", {"15.1", "-16", "--1", "+1", "1e1", "auto", ""}},
      {"--profile", {""}},
      {"--profile-scale", {"0", "0.09", "1.1", "2", "-0.5", "nan", "half", ""}},
      {"--polar-floor", {"0", "1", "99", "-2", "16386", "1e2"}},
      {"--polar-floor-height", {"0", "1", "97", "-2", "8194", "1e2"}},
      {"--clock", {"wall", "real"}},
      {"--sampling", {"newest"}},
      {"--contact-sheet", {"-1", "first", "007", ""}},
      {"--scene", {""}},
      {"--out", {""}},
  };
  for (const auto& [flag, values] : table) {
    for (const std::string& value : values) {
      const std::string message = complaint({"replay", "walk", flag, value});
      EXPECT_EQ(message.find(flag + ":"), 0u) << flag << " '" << value << "' gave '" << message << "'";
    }
  }
}

TEST(CommandLine, ChoicesThatDoNotGoTogetherSaySo) {
  EXPECT_EQ(
      complaint({"replay", "walk", "--clock", "realtime"}),
      "--clock realtime: measures times and writes no pictures; give --format none --contact-sheet none");
  EXPECT_EQ(
      complaint({"replay", "walk", "--target-ms", "20"}),
      "--target-ms: only the policy deadline and the clock realtime have one; give --policy deadline for "
      "frames of that time, or --clock realtime for ticks of that period");
  EXPECT_EQ(complaint({"replay", "walk", "--policy", "motion", "--foveation", "off"}),
            "--policy motion: changes the width of polar buffers, and --foveation off has none; give one of "
            "the two");
  EXPECT_EQ(complaint({"replay", "walk", "--policy", "deadline", "--resume"}),
            "--resume: frames of the policy deadline depend on how long each took, and cannot be taken up "
            "again; give --overwrite to start again");
  EXPECT_EQ(complaint({"replay", "walk", "--polar-floor", "100"}),
            "--polar-floor: the policy fixed never goes below --polar; give --policy motion, deadline or "
            "motion+deadline");
  EXPECT_EQ(complaint({"replay", "walk", "--policy", "motion", "--polar", "100x64", "--polar-floor", "102"}),
            "--polar-floor: is wider than --polar; give at most 100");
  EXPECT_EQ(complaint({"replay", "walk", "--policy", "motion", "--polar-floor-height", "96"}),
            "--polar-floor-height: only the policy deadline lowers polar buffers; give --policy deadline");
  EXPECT_EQ(complaint({"replay", "walk", "--policy", "deadline", "--polar", "100x64", "--polar-floor-height",
                       "66"}),
            "--polar-floor-height: is higher than --polar; give at most 64");
}

TEST(CommandLine, EveryCommandThatLoadsASceneTakesAssetRoots) {
  const std::vector<std::filesystem::path> roots{"models", "more"};
  const auto parsed = [](std::vector<std::string> line) {
    for (const char* word : {"--asset-root", "models", "--asset-root", "more"}) line.emplace_back(word);
    return parse_command_line(line);
  };
  EXPECT_EQ(std::get<ReplayOptions>(parsed({"replay", "walk"})).asset_roots, roots);
  EXPECT_EQ(std::get<ServeOptions>(parsed({"serve", "walk"})).replay.asset_roots, roots);
  EXPECT_EQ(std::get<BenchOptions>(parsed({"bench"})).asset_roots, roots);
  EXPECT_EQ(std::get<StudyOptions>(parsed({"study", "walk"})).asset_roots, roots);
  EXPECT_EQ(std::get<InspectOptions>(parsed({"inspect", "walk"})).asset_roots, roots);
  EXPECT_EQ(std::get<LookOptions>(parsed({"look", "a.scene.json"})).asset_roots, roots);
  EXPECT_EQ(std::get<SynthOptions>(parsed({"synth", "out"})).asset_roots, roots);
  const auto check = std::get<CheckOptions>(parsed({"check", "walk", "--save", "a.json"}));
  EXPECT_EQ(check.run.replay.asset_roots, roots);
  // The processes that measure are given both.
  std::string line;
  for (const std::string& word : check.run_arguments) line += word + " ";
  EXPECT_NE(line.find("--asset-root models --asset-root more "), std::string::npos) << line;
  EXPECT_EQ(complaint({"replay", "walk", "--asset-root", ""}).find("--asset-root:"), 0u);
}

TEST(CommandLine, LookTakesFormatsAndAnEndingThatFitsThem) {
  const auto look = std::get<LookOptions>(parse_command_line({"look", "a.glb", "--format", "png,exr"}));
  EXPECT_EQ(look.formats, (PictureFormats{PictureFormat::png, PictureFormat::exr}));
  EXPECT_EQ(complaint({"look", "a.glb", "--format", "jpg"}).find("--format: 'jpg'"), 0u);
}

TEST(CommandLine, PoliciesAreOneOrBoth) {
  const auto policy = [](const std::string& name) {
    return std::get<ReplayOptions>(parse_command_line({"replay", "walk", "--policy", name})).policy;
  };
  EXPECT_EQ(policy("fixed"), (QualityPolicy{false, false}));
  EXPECT_EQ(policy("motion"), (QualityPolicy{true, false}));
  EXPECT_EQ(policy("deadline"), (QualityPolicy{false, true}));
  EXPECT_EQ(policy("motion+deadline"), (QualityPolicy{true, true}));
  const auto options = std::get<ReplayOptions>(parse_command_line(
      {"replay", "walk", "--policy", "deadline", "--target-ms", "20", "--polar-floor", "64"}));
  EXPECT_EQ(options.target_ms, 20);
  EXPECT_EQ(options.narrowest_width, 32);
}

TEST(CommandLine, SynthTakesPointsAndKindsAndStatesItsDefaults) {
  const auto options =
      std::get<SynthOptions>(parse_command_line({"synth", "out", "--origin", "-1,2.5,-1000000", "--gaze",
                                                 "jumping", "--motion=walking", "--hz", "30"}));
  EXPECT_EQ(options.origin, glm::dvec3(-1, 2.5, -1000000));
  EXPECT_EQ(options.gaze, GazeKind::jumping);
  EXPECT_EQ(options.motion, MotionKind::walking);
  EXPECT_EQ(options.pose_hz, 30);
  EXPECT_FALSE(options.has_camera()) << "no room to see";
  const std::string help = std::get<ShowText>(parse_command_line({"synth", "--help"})).text;
  for (const std::string part : {"(default 15)", "(default 90)", "(default desk)", "--start-ns", "metres"})
    EXPECT_NE(help.find(part), std::string::npos) << part;
}

TEST(CommandLine, SynthRefusesWhatReplayWouldRefuse) {
  const std::vector<std::pair<Arguments, std::string>> lines{
      {{"--camera", "4x4"}, "--camera: there is nothing to see"},
      {{"--scene", "r.json", "--camera", "1x1", "--camera-hfov", "150"}, "--camera: 1x1"},
      {{"--scene", "r.json", "--camera", "4096x4096"}, "--camera: 4096x4096 has too many pixels"},
      {{"--replay-scene", "/tmp/x.json"}, "--replay-scene: is an absolute path"},
      {{"--replay-scene", "x.json", "--origin", "1,0,0"}, "--replay-scene: --origin moves"},
      {{"--motion", "walk"}, "--motion: 'walk'"},
      {{"--gaze", "stil"}, "did you mean still?"},
      {{"--origin", "1,2"}, "--origin: '1,2' is not a point"},
      {{"--origin", "0,-1000000.5,0"}, "--origin: '-1000000.5'"},
      {{"--origin", "0,--1,0"}, "--origin: '--1'"},
      {{"--at", "0,1,"}, "--at: ''"},
      {{"--at", "0, 1, x"}, "--at: 'x'"},  // blanks after commas are none of the values
      {{"--stamp-jitter-ms", "9"}, "--stamp-jitter-ms: rows would change places"},
      {{"--start-ns", "4000000000000000000"}, "--start-ns: the session would end after"}};
  for (const auto& [flags, message] : lines) {
    Arguments arguments{"synth", "s"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    EXPECT_NE(complaint(arguments).find(message), std::string::npos) << complaint(arguments);
  }
}

TEST(CommandLine, AnUnknownFlagNamesTheNearestOne) {
  EXPECT_NE(complaint({"replay", "walk", "--sceen", "x"}).find("did you mean --scene?"), std::string::npos);
  EXPECT_NE(complaint({"replay", "walk", "--light-sample=4"}).find("did you mean --light-samples?"),
            std::string::npos);
  EXPECT_NE(complaint({"bench", "--fames", "3"}).find("did you mean --frames?"), std::string::npos);
  EXPECT_NE(complaint({"replay", "walk", "-j"}).find("-j: unknown flag"), std::string::npos);
}

TEST(CommandLine, OtherMistakesAreOneLineOfUsageToo) {
  for (const Arguments& arguments : {Arguments{},
                                     {"repaly", "walk"},
                                     {"replay"},
                                     {"replay", "walk", "--frames"},
                                     {"--frames", "3"},
                                     {"replay", "walk", "--json=maybe"},
                                     {"replay", "walk", "--overwrite", "--out"},
                                     {"bench", "a", "b"},
                                     {"synth"},
                                     {"synth", "a", "b"},
                                     {"replay", "walk", "bench"}}) {
    const std::string message = complaint(arguments);
    if (arguments == Arguments{"replay", "walk", "bench"}) continue;  // two sessions: fine
    EXPECT_FALSE(message.empty()) << (arguments.empty() ? "(nothing)" : arguments.front());
  }
  EXPECT_NE(complaint({"repaly", "walk"}).find("did you mean replay?"), std::string::npos);
}

TEST(CommandLine, TheTableOfBenchHasColumnsOfItsOwn) {
  for (const Arguments& arguments : {Arguments{"bench", "--table", "--light-samples", "4"},
                                     {"bench", "--table", "--quality", "soft"},
                                     {"bench", "--table", "--repeats", "3"},
                                     {"bench", "--table", "--left-out"},
                                     {"bench", "--left-out", "--seconds", "3"},
                                     {"bench", "--seconds", "3"},
                                     {"bench", "--table", "--seconds", "0"}}) {
    EXPECT_NE(complaint(arguments), "") << arguments.back();
  }
  const auto bench = [](const Arguments& arguments) {
    return std::get<BenchOptions>(parse_command_line(arguments));
  };
  EXPECT_FALSE(bench({"bench", "--polar", "64x32"}).table);
  EXPECT_FALSE(bench({"bench", "--table"}).polar_given);
  EXPECT_TRUE(bench({"bench", "--table", "--polar", "64x32"}).polar_given);
  EXPECT_EQ(bench({"bench", "--table", "--seconds", "2.5"}).seconds, 2.5);
}

TEST(CommandLine, HelpAndVersionNeverFail) {
  for (const Arguments& arguments : {Arguments{"--help"},
                                     {"replay", "--help"},
                                     {"replay", "--frames", "nan", "--help"},
                                     {"--help", "--sceen"},
                                     {"-h"},
                                     {"bench", "-h"},
                                     {"nonsense", "--help"}}) {
    const Command command = parse_command_line(arguments);
    ASSERT_TRUE(std::holds_alternative<ShowText>(command));
    EXPECT_FALSE(std::get<ShowText>(command).text.empty());
  }
  EXPECT_EQ(std::get<ShowText>(parse_command_line({"help", "replay"})).text,
            std::get<ShowText>(parse_command_line({"replay", "--help"})).text);
  EXPECT_EQ(std::get<ShowText>(parse_command_line({"help"})).text,
            std::get<ShowText>(parse_command_line({"--help"})).text);
  EXPECT_NE(std::get<ShowText>(parse_command_line({"replay", "--help"})).text.find("--light-samples"),
            std::string::npos);
  EXPECT_EQ(std::get<ShowText>(parse_command_line({"--version", "--bad"})).text.find("herr "), 0u);
}

TEST(CommandLine, ASessionWhoseNameLooksLikeAFlagFollowsTwoDashes) {
  const Command command = parse_command_line({"replay", "--", "--help"});
  ASSERT_TRUE(std::holds_alternative<ReplayOptions>(command));
  EXPECT_EQ(std::get<ReplayOptions>(command).sessions.front(), "--help");
}

TEST(ExitCodes, TheWorstOneWins) {
  EXPECT_EQ(worse_exit_code(kExitDone, kExitPartial), kExitPartial);
  EXPECT_EQ(worse_exit_code(kExitBadInput, kExitPartial), kExitBadInput);
  EXPECT_EQ(worse_exit_code(kExitTemporary, kExitBadInput), kExitTemporary);
  EXPECT_EQ(worse_exit_code(kExitInternal, kExitTemporary), kExitInternal);
  EXPECT_EQ(worse_exit_code(130, kExitInternal), 130);
  EXPECT_EQ(worse_exit_code(kExitDone, kExitDone), kExitDone);
}

TEST(ExitCodes, RunningOutOfMemoryIsTemporaryAndOtherFaultsAreInternal) {
  const auto code_of = [](const auto& thrower) {
    try {
      thrower();
    } catch (...) {
      std::string message;
      const int code = exit_code_of_current_exception(message);
      EXPECT_FALSE(message.empty());
      return code;
    }
    return kExitDone;
  };
  EXPECT_EQ(code_of([] { throw std::bad_alloc(); }), kExitTemporary);
  EXPECT_EQ(code_of([] { throw std::system_error(ENOSPC, std::generic_category()); }), kExitTemporary);
  EXPECT_EQ(code_of([] { throw std::system_error(EINVAL, std::generic_category()); }), kExitInternal);
  EXPECT_EQ(code_of([] { throw std::logic_error("x"); }), kExitInternal);
  EXPECT_EQ(code_of([] { throw 5; }), kExitInternal);
  EXPECT_EQ(code_of([] { throw UsageError("x"); }), kExitUsage);
}

}  // namespace
}  // namespace herr
