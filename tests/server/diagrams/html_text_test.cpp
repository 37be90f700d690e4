// Text that is safe to print, and to put into a page.
#include "server/diagrams/html_text.h"

#include <gtest/gtest.h>

#include <string>

namespace herr {
namespace {

TEST(CleanText, KeepsTextAndShowsBrokenBytes) {
  EXPECT_EQ(clean_text("a\u00e9\u2013\U0001F600"), "a\u00e9\u2013\U0001F600");
  EXPECT_EQ(clean_text("\x1b[0m\n"), "\\x1b[0m\\x0a");
  EXPECT_EQ(clean_text("\xc3"), "\\xc3");                             // cut off
  EXPECT_EQ(clean_text("\xc0\xaf"), "\\xc0\\xaf");                    // '/' in two bytes
  EXPECT_EQ(clean_text("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // a surrogate
  EXPECT_EQ(clean_text("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");  // past U+10FFFF
  EXPECT_EQ(clean_text("\xc2\x9b"), "\\xc2\\x9b");                    // CSI of terminals
  EXPECT_EQ(clean_text(std::string("\0", 1)), "\\x00");
  EXPECT_EQ(clean_text(clean_text("\xff")), "\\xff");
}

TEST(HtmlText, EscapesWhatMeansSomethingInHtml) {
  EXPECT_EQ(html_text("<a b=\"c\" d='e'>&"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;");
  EXPECT_EQ(html_element("b", "", "x"), "<b>x</b>");
  EXPECT_EQ(html_element("b", "id=\"i\"", ""), "<b id=\"i\"></b>");
}

}  // namespace
}  // namespace herr
