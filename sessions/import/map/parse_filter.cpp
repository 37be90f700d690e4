// Which rows of a map count.
#include <limits>
#include <nlohmann/json.hpp>

#include "sessions/import/map/map_parts.h"

namespace herr {
namespace {

std::vector<std::string> parse_texts(const JsonObject& entry) {
  const nlohmann::json& value = entry.value("one_of");
  std::vector<std::string> texts;
  bool good = value.is_array() && !value.empty();
  for (std::size_t i = 0; good && i < value.size(); ++i) {
    good = value[i].is_string();
    if (good) texts.push_back(value[i].get<std::string>());
  }
  if (!good)
    entry.fail("one_of", "is no list of texts", "write the fields as they stand, such as [\"2\", \"3\"]");
  return texts;
}

void parse_test(const JsonObject& entry, const char* key, RowCondition& condition) {
  switch (condition.kind) {
    case RowCondition::Kind::is:
    case RowCondition::Kind::is_not:
      if (entry.is_number(key))
        entry.fail(key, "is a number, and the whole field is compared as text",
                   "write the field as it stands, such as \"1\"");
      condition.texts = {entry.text(key)};
      break;
    case RowCondition::Kind::one_of:
      condition.texts = parse_texts(entry);
      break;
    case RowCondition::Kind::above:
    case RowCondition::Kind::below:
      condition.limit = entry.number(key, -1e300, 1e300);
      break;
    case RowCondition::Kind::has_bits:
      condition.bits =
          static_cast<std::uint64_t>(entry.integer(key, 1, std::numeric_limits<std::int64_t>::max()));
      break;
    case RowCondition::Kind::finite:
      if (!entry.boolean_or(key, true)) entry.fail(key, "is false", "write true, or leave the condition out");
      break;
  }
}

std::vector<RowCondition> parse_conditions(const JsonObject& filter, const char* key) {
  std::vector<RowCondition> conditions;
  for (const JsonObject& entry : filter.objects(key)) {
    entry.allow_only({"column", "is", "is_not", "one_of", "above", "below", "has_bits", "finite"});
    RowCondition condition;
    condition.column = parse_ref(entry, "column");
    const char* test =
        only_one_of(entry, {"is", "is_not", "one_of", "above", "below", "has_bits", "finite"}, "test");
    for (const auto& [word, kind] : kTestWords)
      if (std::string_view(test) == word) condition.kind = kind;
    parse_test(entry, test, condition);
    conditions.push_back(std::move(condition));
  }
  return conditions;
}

}  // namespace

RowFilter parse_filter(const JsonObject& parent, const char* key) {
  if (!parent.has(key)) return {};
  const JsonObject entry = parent.object(key);
  entry.allow_only({"all", "any"});
  return {parse_conditions(entry, "all"), parse_conditions(entry, "any")};
}

}  // namespace herr
