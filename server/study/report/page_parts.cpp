#include "server/study/report/page_parts.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "server/diagrams/html_text.h"
#include "server/study/report/page_style.h"
#include "server/text/base64.h"

namespace herr {

std::string page_section(const std::string& id, const std::string& title, const std::string& content) {
  if (content.empty()) return {};
  return html_element("section", "id=\"" + id + "\"", html_element("h2", "", title) + "\n" + content) + "\n";
}

std::string page_table(const ReportTable& table, bool caption) {
  return table.rows.empty() ? "" : table_html(table, caption);
}

std::string page_list(const std::vector<std::string>& lines) {
  std::string items;
  for (const std::string& line : lines) items += html_element("li", "", html_text(line)) + "\n";
  return items.empty() ? "" : html_element("ul", "class=\"lines\"", items) + "\n";
}

std::string page_code(const std::string& text) {
  std::string words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    words += (at > 0 ? " " : "") + html_element("span", "", html_text(text.substr(at, end - at)));
    at = end + 1;
  }
  return html_element("code", "", words);
}

std::string page_pictures(const std::vector<StudyPicture>& pictures, int enlarged_px) {
  std::string figures;
  for (const StudyPicture& picture : pictures) {
    if (picture.png.empty()) continue;
    const std::string title = html_text(picture.title);
    const int times = std::max(1, enlarged_px / std::max(1, picture.width_px));
    figures += html_element("figure", times > 1 ? "class=\"pixels\"" : "",
                            "<img width=\"" + std::to_string(times * picture.width_px) + "\" height=\"" +
                                std::to_string(times * picture.height_px) + "\" alt=\"" + title +
                                "\" src=\"data:image/png;base64," +
                                base64_text(std::as_bytes(std::span(picture.png))) + "\">\n" +
                                html_element("figcaption", "",
                                             html_element("p", "",
                                                          html_element("b", "", title) + ". " +
                                                              html_text(picture.caption)))) +
               "\n";
  }
  return figures;
}

std::string page_document(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         html_element("title", "", html_text(title)) + "\n" + html_element("style", "", kPageStyle) +
         "\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

}  // namespace herr
