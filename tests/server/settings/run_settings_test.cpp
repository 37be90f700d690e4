// The list of a run's settings: what it has beyond those of its render.
#include "server/settings/run_settings.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace herr {
namespace {

TEST(RunSettings, EachRowHasADefaultInRangeAndReadsBack) {
  ReplayOptions defaults;
  const std::size_t count = settings_of(defaults).size();
  std::set<std::string> names, flags;
  for (std::size_t i = 0; i < count; ++i) {
    ReplayOptions first, second;
    const std::vector<Setting> written = settings_of(first), read = settings_of(second);
    SCOPED_TRACE(written[i].name);
    EXPECT_TRUE(names.insert(written[i].name).second);
    EXPECT_TRUE(written[i].flag.empty() || flags.insert(written[i].flag).second);
    EXPECT_FALSE(written[i].sentence.empty());
    EXPECT_NO_THROW(check_range(written[i]));
    EXPECT_NE(text_of(written[i]).empty(), written[i].otherwise.empty());
    const std::string other = other_text(written[i]);
    EXPECT_NE(other, text_of(written[i]));
    set_text(written[i], other);
    EXPECT_EQ(text_of(written[i]), other);
    set_value(read[i], value_of(written[i]));
    for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(text_of(read[k]), text_of(written[k])) << read[k].name;
  }
}

TEST(RunSettings, AnOptionalNumberCanBeTakenBack) {
  ReplayOptions options;
  const std::vector<Setting> rows = settings_of(options);
  for (const char* name : {"polar_floor", "target_ms", "duration_s", "frames", "threads"}) {
    const Setting& setting = setting_named(rows, name);
    set_text(setting, other_text(setting));
    EXPECT_NE(text_of(setting), "") << name;
    set_value(setting, std::monostate());
    EXPECT_EQ(text_of(setting), "") << name;
  }
  EXPECT_THROW(set_value(setting_named(rows, "light_samples"), std::monostate()), std::invalid_argument);
}

TEST(RunSettings, TheFloorIsOfBothEyesAndEven) {
  ReplayOptions options;
  const std::vector<Setting> rows = settings_of(options);
  const Setting& floor = setting_named(rows, "polar_floor");
  set_text(floor, "64");
  EXPECT_EQ(options.narrowest_width, 32);
  EXPECT_EQ(text_of(floor), "64");
  EXPECT_THROW(set_text(floor, "63"), std::invalid_argument);
  EXPECT_THROW(set_text(floor, "0"), std::invalid_argument);
}

TEST(RunSettings, AContactSheetIsAWordOrAFrame) {
  ReplayOptions options;
  const std::vector<Setting> rows = settings_of(options);
  const Setting& sheet = setting_named(rows, "contact_sheet");
  set_text(sheet, "7");
  EXPECT_EQ(options.sheet, SheetChoice::one);
  EXPECT_EQ(options.sheet_frame, 7);
  EXPECT_EQ(text_of(sheet), "7");
  set_text(sheet, "none");
  EXPECT_EQ(options.sheet, SheetChoice::none);
  for (const char* wrong : {"", "-1", "first", "007"}) {
    EXPECT_THROW(set_text(sheet, wrong), std::invalid_argument) << wrong;
  }
}

}  // namespace
}  // namespace herr
