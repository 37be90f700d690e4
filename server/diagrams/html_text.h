// Text of a record made safe for what it is printed into: names come from users' files. Before: any string of
// a StudyRecord. After: page, JSON and terminal.
#pragma once

#include <string>

namespace herr {

// Valid UTF-8 without control characters: every other byte as \xNN. The same again for its own result.
std::string clean_text(const std::string& text);

// clean_text() with the five characters escaped that mean something in HTML, in attributes too.
std::string html_text(const std::string& text);

// <NAME ATTRIBUTES>CONTENT</NAME>; attributes and content are HTML already.
std::string html_element(const std::string& name, const std::string& attributes, const std::string& content);

}  // namespace herr
