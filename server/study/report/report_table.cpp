#include "server/study/report/report_table.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "server/diagrams/html_text.h"

namespace herr {
namespace {

constexpr int kGap = 2;         // spaces between columns
constexpr int kLeastWidth = 6;  // of a column that is cut

// Characters, for text that clean_text() has passed: all bytes but those that continue a character.
int characters(const std::string& text) {
  return static_cast<int>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

// Bytes of the first `count` characters.
std::size_t bytes_of(const std::string& text, int count) {
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    if ((static_cast<unsigned char>(text[at]) & 0xC0) != 0x80 && count-- == 0) break;
  }
  return at;
}

std::string cut_text(const std::string& text, int width) {
  if (characters(text) <= width) return text;
  return text.substr(0, bytes_of(text, width - 2)) + "..";
}

std::string padded_text(const std::string& text, int width, bool words) {
  const std::string cut = cut_text(text, width);
  const std::string padding(static_cast<std::size_t>(std::max(width - characters(cut), 0)), ' ');
  return words ? cut + padding : padding + cut;
}

std::vector<int> natural_widths(const std::vector<std::vector<std::string>>& rows) {
  std::vector<int> widths(rows.front().size(), 0);
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], characters(row[i]));
  }
  return widths;
}

// Takes from the widest column of words, then from the widest of all.
void fit_widths(std::vector<int>& widths, const std::vector<bool>& words, int most) {
  const int gaps = kGap * static_cast<int>(widths.size() - 1);
  while (std::accumulate(widths.begin(), widths.end(), gaps) > most) {
    std::size_t widest = widths.size();
    for (const bool only_words : {true, false}) {
      for (std::size_t i = 0; i < widths.size(); ++i) {
        if (widths[i] <= kLeastWidth || (only_words && !words[i])) continue;
        if (widest == widths.size() || widths[i] > widths[widest]) widest = i;
      }
      if (widest != widths.size()) break;
    }
    if (widest == widths.size()) return;
    --widths[widest];
  }
}

}  // namespace

std::string table_html(const ReportTable& table, bool caption) {
  const auto kind = [&](std::size_t column) {
    if (!table.columns[column].words) return "";
    return table.columns[column].page_only ? "class=\"w prose\"" : "class=\"w\"";
  };
  std::string head, body;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    head += html_element("th", "scope=\"col\" " + std::string(kind(i)), html_text(table.columns[i].name));
  }
  for (const std::vector<std::string>& row : table.rows) {
    std::string cells;
    for (std::size_t i = 0; i < row.size() && i < table.columns.size(); ++i)
      cells += html_element("td", kind(i), html_text(row[i]));
    body += html_element("tr", "", cells) + "\n";
  }
  const std::string name = html_text(table.title);
  return html_element("div", "class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"" + name + "\"",
                      html_element("table", "",
                                   (caption ? html_element("caption", "", name) : "") +
                                       html_element("thead", "", html_element("tr", "", head)) + "\n" +
                                       html_element("tbody", "", body))) +
         "\n" + (table.note.empty() ? "" : html_element("p", "class=\"note\"", html_text(table.note)) + "\n");
}

std::string table_text(const ReportTable& table, int most_columns) {
  std::vector<std::vector<std::string>> rows(table.rows.size() + 1);
  std::vector<bool> words;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].page_only) continue;
    words.push_back(table.columns[i].words);
    rows[0].push_back(clean_text(table.columns[i].name));
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      rows[r + 1].push_back(i < table.rows[r].size() ? clean_text(table.rows[r][i]) : "");
    }
  }
  std::string text = table.title.empty() ? "" : wrapped_text(table.title, most_columns) + "\n";
  if (words.empty()) return text;
  std::vector<int> widths = natural_widths(rows);
  fit_widths(widths, words, most_columns);
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) line += std::string(kGap, ' ');
      line += padded_text(row[i], widths[i], words[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text + (table.note.empty() ? "" : wrapped_text(table.note, most_columns) + "\n");
}

std::string wrapped_text(const std::string& text, int most_columns, int indent) {
  std::string lines, left = clean_text(text);
  int room = most_columns;
  while (characters(left) > room) {
    const std::size_t most = bytes_of(left, room);
    std::size_t end = left.rfind(' ', most);
    const bool between = end != std::string::npos && end > 0;
    if (!between) end = most;
    lines += left.substr(0, end) + "\n" + std::string(static_cast<std::size_t>(indent), ' ');
    left.erase(0, end + (between ? 1 : 0));
    room = most_columns - indent;
  }
  return lines + left;
}

}  // namespace herr
