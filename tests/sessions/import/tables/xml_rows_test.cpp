// XML recordings: values by their paths, files that end early, and what is refused.
// The expected values are those that one reads in the few lines that each test writes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/sessions/import/tables/table_rows.h"

namespace herr::test {
namespace {

class XmlElements : public ::testing::Test {
 protected:
  TableText read(const std::string& content, const std::vector<std::string>& wanted,
                 const std::string& row = "R", char decimal = '.') {
    folder_.write("t.xml", content);
    TableFormat format;
    format.xml_row = row;
    format.decimal = decimal;
    return read_table(folder_ / "t.xml", format, named(wanted));
  }
  std::string fault(const std::string& content, const std::vector<std::string>& wanted = {"@t"}) {
    return error_of([&] {
      const TableText table = read(content, wanted);
      if (!table.faults.empty()) throw InputError("row", 0, table.faults[0], "none");
    });
  }
  RecordedFolder folder_;
};

TEST_F(XmlElements, AreRowsOfAttributesAndTexts) {
  const TableText table = read(
      "<?xml version=\"1.0\"?>\n<Data xmlns:x=\"u\">\n"
      "<Other t=\"9\"/>\n"
      "<x:R t=\"1\"><Pose Position=\"(1, 2, 3)\"/><Left><Dir x:Value=\"a &amp; b\"/><Pupil> 3.5 "
      "</Pupil></Left></x:R>\n"
      "<R\n t=\"2\"><Left><Pupil>4<!-- mm --><![CDATA[.5]]></Pupil></Left>\n</R><R t=\"3\"/>\n</Data>\n",
      {"@t", "Pose@Position", "Left/Dir@Value", "Left/Pupil"});
  EXPECT_EQ(table.rows, "1|(1, 2, 3)|a & b|3.5;2|||4.5;3|||");
  EXPECT_EQ(table.lines, (std::vector<std::int64_t>{4, 5, 7}));
  EXPECT_EQ(table.cut_off, "");
}

TEST_F(XmlElements, AreReadAcrossBlocksOfTheFile) {
  // Some 5000 rows of 60 bytes: the file is read in blocks of 64 kiB.
  std::string file = "<D>", expected;
  for (int row = 0; row < 5000; ++row) {
    const std::string number = std::to_string(row);
    file += "<R t=\"" + number + "\"><Left><Pupil>" + number + "</Pupil></Left></R>\r\n";
    expected += (row > 0 ? ";" : "") + number + "|" + number;
  }
  const TableText table = read(file + "</D>", {"@t", "Left/Pupil"});
  EXPECT_EQ(table.rows, expected);
  EXPECT_EQ(table.lines.back(), 5000);
}

TEST_F(XmlElements, ThatEndEarlyLoseTheLastRowAndTellIt) {
  const std::string whole = "<D>\n<R t=\"1\"><A b=\"2\"/></R>\n<R t=\"3\"><A b=\"4\"/></R>\n</D>\n";
  // Wherever the file ends behind the first row, that row is read; the second as soon as its end is there.
  const std::size_t first = whole.find("</R>") + 4, second = whole.rfind("</R>") + 4;
  for (std::size_t size = first; size < whole.size(); ++size) {
    const TableText table = read(whole.substr(0, size), {"@t", "A@b"});
    EXPECT_EQ(table.rows, size < second ? "1|2" : "1|2;3|4") << size;
    EXPECT_EQ(table.faults.size(), 0u) << size;
    if (size > first + 1 && size < second) {
      EXPECT_EQ(table.cut_off, whole.substr(first + 1, size - first - 1));
    }
  }
  EXPECT_PRED2(holds, fault("<D>\n<R t=\"1\"><A"), "ends before its first element <R> does");
}

TEST_F(XmlElements, OfDecimalCommasAreFound) {
  EXPECT_EQ(read("<D><R t=\"1,5\"/></D>", {"@t"}, "R", 0).decimal, ',');
  EXPECT_EQ(read("<D><R t=\"1.5\"/></D>", {"@t"}, "R", 0).decimal, '.');
}

TEST_F(XmlElements, WithAValueTwiceAreFaultsOfTheirRow) {
  const TableText table =
      read("<D><R t=\"1\"><A>1</A></R>\n<R t=\"2\"><A>1</A><A>2</A></R>\n<R t=\"3\"><A>3</A></R></D>",
           {"@t", "A"});
  EXPECT_EQ(table.rows, "1|1;3|3");
  ASSERT_EQ(table.faults.size(), 1u);
  EXPECT_PRED2(holds, table.faults[0], "t.xml:2: element <R> holds 'A' more than once");
}

TEST_F(XmlElements, RefuseEntitiesAndDocumentTypes) {
  const std::string rows = "<D><R t=\"&lol;\"/></D>";
  EXPECT_PRED2(holds, fault("<!DOCTYPE D [<!ENTITY lol \"ha\">]>\n" + rows),
               "t.xml:1: declares a document type (<!DOCTYPE ...>), which could define entities");
  EXPECT_PRED2(holds, fault("<?xml version=\"1.0\"?>\n<!DOCTYPE D SYSTEM \"file:///etc/passwd\">\n" + rows),
               "t.xml:2: declares a document type");
  EXPECT_PRED2(holds, fault(rows), "is no well-formed XML: undefined entity");
}

TEST_F(XmlElements, AreBounded) {
  std::string deep = "<D><R t=\"1\">";
  for (int i = 0; i < 70; ++i) deep += "<A>";
  EXPECT_PRED2(holds, fault(deep), "more than 64 deep");
  EXPECT_PRED2(holds, fault("<D><R t=\"" + std::string(70'000, '1') + "\"/></D>"), "longer than 65536 bytes");
  EXPECT_PRED2(holds, fault("<D><R t=\"" + std::string(3 << 20, '1') + "\"/></D>"),
               "tag or comment of more than");
  std::string wide = "<D><R";
  for (int i = 0; i < 1100; ++i) wide += " a" + std::to_string(i) + "=\"\"";
  EXPECT_PRED2(holds, fault(wide + "/></D>"), "more than 1024 attributes");
}

TEST_F(XmlElements, ThatDoNotFitAreNamed) {
  EXPECT_PRED2(holds, error_of([&] { read("<D><Row t=\"1\"/></D>", {"@t"}, "Rows"); }),
               "has no element <Rows> (is it <Row>?)");
  EXPECT_PRED2(holds, fault("<D><R T=\"1\"/></D>"), "has no '@t' in its elements <R> (is it '@T'?)");
  EXPECT_PRED2(holds, fault(""), "is empty");
  EXPECT_PRED2(holds, fault("t,x\n1,2\n"), "t.xml:1: is no well-formed XML");
  EXPECT_PRED2(holds, fault("<D><R t=\"1\"/></D>\n<D><R t=\"2\"/></D>"), "the file holds two documents");
  const TableText broken = read("<D><R t=\"1\"/>\n</E><R t=\"2\"/></D>", {"@t"});
  EXPECT_EQ(broken.rows, "1");
  ASSERT_EQ(broken.faults.size(), 1u);
  EXPECT_PRED2(holds, broken.faults[0], "t.xml:2: is no well-formed XML: mismatched tag; correct the file");
}

}  // namespace
}  // namespace herr::test
