// Tables of text: what is read from them, what is passed over and counted, what is refused and how it is
// said. The expected fields are those that one reads in the few lines that each test writes.
#include <gtest/gtest.h>

#include <array>

#include <string>
#include <vector>

#include "tests/sessions/import/tables/table_rows.h"

namespace herr::test {
namespace {

TableFormat separated_by(char separator, bool header = true) {
  TableFormat format;
  format.separator = separator;
  format.header = header;
  return format;
}

class DelimitedRows : public ::testing::Test {
 protected:
  TableText read(const std::string& content, const TableFormat& format, const std::vector<ColumnRef>& wanted,
                 bool numbers = false) {
    folder_.write("t.csv", content);
    return read_table(folder_ / "t.csv", format, wanted, numbers);
  }
  // Of a file that is refused as a whole, or of its first row with a fault.
  std::string fault(const std::string& content, const TableFormat& format,
                    const std::vector<ColumnRef>& wanted) {
    std::string first;
    const std::string whole = error_of([&] {
      const TableText table = read(content, format, wanted, true);
      if (!table.faults.empty()) first = table.faults[0];
    });
    return first.empty() ? whole.substr(std::min(whole.find("t.csv"), whole.size()))
                         : first.substr(first.find("t.csv"));
  }
  RecordedFolder folder_;
};

TEST_F(DelimitedRows, AreReadByNameOrNumberInAnyOrder) {
  const std::string file = "\xef\xbb\xbft,x,y,z\r\n1, 2 ,\"3,5\",4\r\n\r\n5,6,\"7 \"\"a\"\"\",8\r\n";
  const TableText table = read(file, separated_by(','), {{"z", 0}, {"", 1}, {"y", 0}});
  EXPECT_EQ(table.rows, "4|1|3,5;8|5|7 \"\"a\"\"");
  EXPECT_EQ(table.lines, (std::vector<std::int64_t>{2, 4}));
  EXPECT_EQ(table.counts.blank_lines, 1);
  EXPECT_EQ(read("1 \t 2   3 \n4 5 6\n", separated_by(' ', false), numbered({3, 1})).rows, "3|1;6|4");
  EXPECT_EQ(read("a\tb\tc\n\t2\t3\n1\t\t3\n", separated_by('\t'), named({"a", "b", "c"})).rows, "|2|3;1||3");
}

// HoloLens 2's *_pv.txt: intrinsics of the camera above rows of another width. Numbers as wide as the rows
// are a row where the map expects names.
TEST_F(DelimitedRows, MayStandBelowALineOfOtherNumbers) {
  TableFormat format = separated_by(',');
  format.ragged = true;
  EXPECT_EQ(read("960.5,540.2,1920,1080\n11,1400.5,0,0,1\n12,1400.5,0,0,1\n", format, numbered({1})).rows,
            "11;12");
  EXPECT_EQ(read("1.5,2,3\n4.5,5,6\n", format, numbered({1})).rows, "1.5;4.5");
}

TEST_F(DelimitedRows, MayEndWithSeparatorsInHeaderOrRows) {
  for (const char* header : {"a,b", "a,b,", "a,b,,"})
    for (const char* row : {"1,2", "1,2,", "1,2, ,"})
      EXPECT_EQ(read(header + std::string("\n") + row + "\n", separated_by(','), named({"a", "b"})).rows,
                "1|2")
          << header << " " << row;
  EXPECT_EQ(read("a, b, c, d\n1, 2, , \n", separated_by(','), named({"a", "d"})).rows, "1|");
  EXPECT_EQ(read("1,2,3,,\n4,5,6\n", separated_by(',', false), numbered({1, 5})).rows, "1|;4|");
}

TEST_F(DelimitedRows, PassOverWordsThatAreNoRow) {
  TableText table = read("t x\n[s] [m]\n1 2\nt x\n3 4\n", separated_by(' '), named({"t", "x"}));
  EXPECT_EQ(table.rows, "1|2;3|4");
  EXPECT_EQ(table.counts.repeated_headers, 2);
  table = read("timestamp tx\n1 2\ntimestamp tx\n3 4\n", separated_by(' ', false), numbered({1, 2}));
  EXPECT_EQ(table.rows, "1|2;3|4");
  EXPECT_EQ(table.counts.repeated_headers, 2);
  table = read("nan nan\n1 2\n", separated_by(' ', false), numbered({1, 2}));
  EXPECT_EQ(table.rows, "nan|nan;1|2") << "a lost row is a row";
}

TEST_F(DelimitedRows, KeepTheFirstRowWhereTheHeaderIsMissing) {
  EXPECT_EQ(read("1.5,2\n3,4\n", separated_by(','), numbered({1, 2})).rows, "1.5|2;3|4");
  EXPECT_PRED2(holds, fault("1.5,2\n3,4\n", separated_by(','), named({"t"})),
               "t.csv:1: has no header line that names column 't': its first line holds numbers");
}

TEST_F(DelimitedRows, FindNamesInACommentOrALaterLine) {
  TableFormat format = separated_by(',');
  format.comment = "#";
  EXPECT_EQ(read("# made by x\n# t, x\n1,2\n# end\n", format, named({"t", "x"})).rows, "1|2");
  EXPECT_EQ(read("#t,x\n1,2\n", separated_by(','), named({"t", "x"})).rows, "1|2");
  EXPECT_EQ(read("t,x\n# made by x\n1,2\n", format, named({"t", "x"})).rows, "1|2");
  EXPECT_PRED2(holds, fault("Lab 7\n\nt,x\n1,2\n", separated_by(','), named({"t", "x"})),
               "\"names_line\": 3");
  format.header_lines = 4;
  format.names_line = 3;
  EXPECT_EQ(read("Lab 7\n\nt,x\ns,m\n1,2\n", format, named({"t", "x"})).rows, "1|2");
}

// Which separator, which decimal sign: the numbers are the same in every file.
TEST_F(DelimitedRows, AreReadWithTheSeparatorThatFits) {
  TableFormat format = separated_by(0, false);
  format.decimal = 0;
  const std::string numbers = "1.500000|-2.250000|3.000000";
  for (const char* line : {"1.5;-2.25;3.0", "1,5;-2,25;3,0", "1.5\t-2.25\t3.0", "1,5\t-2,25\t3,0",
                           "1.5,-2.25,3.0", "1.5, -2.25, 3.0", "1.5  -2.25 3", "1,5 -2,25 3", "1,5; -2,25; 3",
                           "1.5,-2.25,3,,", "\"1,5\",\"-2,25\",\"3\"", "1.5 \t -2.25   3.0"})
    EXPECT_EQ(read(line + std::string("\n"), format, numbered({1, 2, 3}), true).rows, numbers) << line;
  format.header = true;
  for (const char* lines : {"a;b;c\n1,5;-2,25;3", "a,b,c\n1.5,-2.25,3.0", "a, b, c\n1.5, -2.25, 3",
                            "a b c\n1,5 -2,25 3", "a\tb\tc\n1.5\t-2.25\t3"})
    EXPECT_EQ(read(lines + std::string("\n"), format, named({"a", "b", "c"}), true).rows, numbers) << lines;
  const TableText vector = read("t;p\n1,5;(0,1, 1,6, 0,2)\n", format, named({"t", "p"}));
  EXPECT_EQ(vector.rows, "1,5|(0,1, 1,6, 0,2)");
  EXPECT_EQ(vector.decimal, ',');
}

TEST_F(DelimitedRows, FindTheDecimalSignAfterManyWholeNumbers) {
  TableFormat format = separated_by(';');
  format.decimal = 0;
  std::string file = "t;x\n";
  for (int row = 0; row < 500; ++row) file += "1;0\n";
  EXPECT_EQ(read(file + "2;0,5\n", format, named({"t", "x"})).decimal, ',');
  EXPECT_EQ(read(file + "2;0.5\n", format, named({"t", "x"})).decimal, '.');
}

TEST_F(DelimitedRows, WithDecimalCommasBetweenCommasAreRefused) {
  // Three columns; 1,5 is one and a half. Read as six whole numbers, all would be shifted.
  const std::string expected = "decimal commas in fields that commas separate";
  TableFormat format = separated_by(0, false);
  format.decimal = 0;
  for (const char* line : {"1,5,0,05,3,000\n", "1,5, 0,2, 3,0\n"})
    EXPECT_PRED2(holds, fault(line, format, numbered({1, 2, 3})), expected) << line;
  format = separated_by(',');
  for (const bool ragged : {false, true}) {
    format.ragged = ragged;
    EXPECT_PRED2(holds, fault("a,b,c\n1,5,0,05,3,000\n", format, named({"a", "b", "c"})), expected);
  }
  EXPECT_PRED2(holds, fault("a,b,c\n1,5,2,5,3,5\n", separated_by(','), named({"a"})), expected);
  EXPECT_EQ(read("000001,2,30\n000002,2,30\n", separated_by(',', false), numbered({1})).rows,
            "000001;000002");
}

TEST_F(DelimitedRows, OfAnotherLengthAreRefusedOrCounted) {
  TableFormat format = separated_by(',');
  const std::string file = "a,b,c,d\n1,2,3\n4,5,6,7\n1\n8,9,1,2,3\n";
  TableText table = read(file, format, named({"a", "b"}));
  EXPECT_EQ(table.rows, "4|5");
  ASSERT_EQ(table.faults.size(), 3u);
  EXPECT_PRED2(holds, table.faults[0],
               "t.csv:2: the line has 3 fields where the header line names 4; set \"ragged\": true");
  EXPECT_PRED2(holds, table.faults[1],
               "t.csv:4: the line has 1 field where the header line names 4; correct or remove");
  format.ragged = true;
  table = read(file, format, named({"a", "b"}));
  EXPECT_EQ(table.rows, "1|2;4|5;8|9");
  EXPECT_EQ(table.counts.ragged_rows, 2);
  ASSERT_EQ(table.faults.size(), 1u);
  EXPECT_PRED2(holds, table.faults[0], "the map needs 2 fields");
  EXPECT_PRED2(holds, fault("1 2 3\n1 2\n", separated_by(' ', false), numbered({1})),
               "t.csv:2: the line has 2 fields where the first row has 3");
}

TEST_F(DelimitedRows, NameTheLikelyCauseOfAFault) {
  const auto numbers = numbered({1, 2, 3});
  const auto names = named({"a", "b", "c"});
  EXPECT_PRED2(
      holds, fault("1.5,2.5,3\n", separated_by(' ', false), numbers),
      "has no column 2: the fields are separated by commas, not by blanks; set \"separator\": \",\"");
  EXPECT_PRED2(holds, fault("a;b;c\n1;2;3\n", separated_by(','), names),
               "t.csv:1: has no column 'a': the fields are separated by semicolons, not by commas");
  EXPECT_PRED2(holds, fault("a,b,c\n1 2 3\n", separated_by(','), names),
               "it is separated by blanks, not by commas");
  EXPECT_PRED2(holds, fault("a;b;c\n1,5;2;3\n", separated_by(';'), names),
               "t.csv:2: column 'a' is '1,5', not a finite number; its decimal sign is a comma: set "
               "\"decimal\": \",\"");
  EXPECT_PRED2(
      holds, fault("a;b;c\n1;2;3\ntime;x;y\n", separated_by(';'), names),
      "t.csv:3: column 'a' is 'time', not a finite number; if this is a header line, put # before it");
  EXPECT_PRED2(holds, fault("a,b,c\n1,2,3\nt,u\n", separated_by(','), names),
               "another header line begins with 't'");
  EXPECT_PRED2(holds, fault("a,b,time\n1,2,3\n", separated_by(','), named({"a", "tim"})),
               "has no column 'tim' (is it 'time'?)");
  EXPECT_PRED2(holds, fault("a,b,c,c\n1,2,3,4\n", separated_by(','), names), "names column 'c' twice");
  EXPECT_PRED2(holds, fault("1,2\n", separated_by(',', false), numbers),
               "has 2 columns, and the map asks for column 3");
  EXPECT_PRED2(holds, fault("a,b,c\n", separated_by(','), names), "holds a header line and no rows");
  EXPECT_PRED2(holds, fault("a b c\n", separated_by(' ', false), numbers), "holds a header line and no rows");
  EXPECT_PRED2(holds, fault("a,b,c\n1,2", separated_by(','), names), "t.csv:2: holds no whole row");
  EXPECT_PRED2(holds, fault("", separated_by(','), names), "is empty");
  EXPECT_PRED2(holds, fault("\n \n", separated_by(','), names), "has no rows");
  EXPECT_PRED2(holds,
               fault("\xff\xfe"
                     "a",
                     separated_by(','), names),
               "is UTF-16");
  EXPECT_PRED2(holds, fault(std::string("a\0,\0b\0\n\0", 8), separated_by(','), names), "is UTF-16 without");
  EXPECT_PRED2(holds, fault("a,b,c\r1,2,3\r", separated_by(','), names), "ends its lines with CR alone");
  EXPECT_PRED2(holds, fault("<?xml version=\"1.0\"?>\n<a/>\n", separated_by(','), names), "is XML");
}

TEST_F(DelimitedRows, GoOnAfterALineThatIsNoText) {
  std::string nul = "a,b\n1,2\n3,_\n5,6\n";
  nul[nul.find('_')] = '\0';
  TableText table = read(nul, separated_by(','), named({"a", "b"}));
  EXPECT_EQ(table.rows, "1|2;5|6");
  ASSERT_EQ(table.faults.size(), 1u);
  EXPECT_PRED2(holds, table.faults[0], "t.csv:3: the line holds NUL bytes");
  table = read("a,b\n1,2\n" + std::string(70'000, '3') + ",4\n5,6\n", separated_by(','), named({"a", "b"}));
  EXPECT_EQ(table.rows, "1|2;5|6");
  ASSERT_EQ(table.faults.size(), 1u);
  EXPECT_PRED2(holds, table.faults[0], "t.csv:3: the line is longer than 65536 bytes");
}

TEST_F(DelimitedRows, EndBeforeALineThatIsCutOff) {
  TableText table = read("a,b\n1,2\n3,4", separated_by(','), named({"a", "b"}));
  EXPECT_EQ(table.rows, "1|2");
  EXPECT_EQ(table.cut_off, "3,4");
  EXPECT_EQ(read("a,b\n1,2\n  ", separated_by(','), named({"a"})).cut_off, "") << "blanks are no row";
}

TEST_F(DelimitedRows, TellWhereNumbersAreAbsent) {
  const TableText table =
      read("a,b\n1,-nan(ind)\n2,\n3,NULL\n4,5\n", separated_by(','), named({"a", "b"}), true);
  EXPECT_EQ(table.rows, "1.000000|nan;2.000000|nan;3.000000|nan;4.000000|5.000000");
  folder_.write("t.csv", "a,v\nNaN,(1 2)\n");
  const auto rows = open_rows(folder_ / "t.csv", separated_by(','), named({"a", "v"}));
  const std::size_t a = rows->place({"a", 0}), v = rows->place({"v", 0});
  ASSERT_TRUE(rows->next());
  EXPECT_INPUT_ERROR((void)rows->number(a), "t.csv:2: column 'a' holds no number ('NaN')");
  std::array<double, 2> two{};
  rows->numbers(v, two);
  EXPECT_EQ(two, (std::array<double, 2>{1, 2}));
  std::array<double, 3> three{};
  EXPECT_INPUT_ERROR(rows->numbers(v, three), "column 'v' is '(1 2)', not 3 numbers");
}

}  // namespace
}  // namespace herr::test
