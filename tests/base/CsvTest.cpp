#include <cmath>
#include <gtest/gtest.h>

#include "core/base/Csv.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using Fields = std::vector<std::string_view>;

TEST(Csv, CutsTrimsAndCountsLines) {
    CsvReader reader("\xEF\xBB\xBF# comment\r\n\r\n a , b,c \r\n\"x, y\",2,\r\n");
    ASSERT_TRUE(reader.next());
    EXPECT_EQ(reader.line(), 3U);
    EXPECT_EQ(reader.fields(), (Fields{"a", "b", "c"}));
    ASSERT_TRUE(reader.next());
    EXPECT_EQ(reader.line(), 4U);
    EXPECT_EQ(reader.fields(), (Fields{"x, y", "2", ""}));
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.next());
}

TEST(Csv, FindsItsSeparator) {
    CsvReader semicolons("a;b\n1;2\n");
    ASSERT_TRUE(semicolons.next());
    EXPECT_EQ(semicolons.fields(), (Fields{"a", "b"}));
    CsvReader tabs("a\tb b\n1\t2");
    ASSERT_TRUE(tabs.next());
    EXPECT_EQ(tabs.fields(), (Fields{"a", "b b"}));
    ASSERT_TRUE(tabs.next());
    EXPECT_EQ(tabs.fields(), (Fields{"1", "2"}));
}

TEST(Csv, NumbersKeepTheirLine) {
    const auto table = parseNumericCsv("t,x,\n# note\n0,1,\n1,-nan\n2,,\n", "f.csv").value();
    EXPECT_EQ(table.names, (std::vector<std::string>{"t", "x"}));
    ASSERT_EQ(table.rows(), 3U);
    EXPECT_EQ(table.lines, (std::vector<std::size_t>{3, 4, 5}));
    EXPECT_EQ(table.columns[0], (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(table.columns[1][0], 1);
    EXPECT_TRUE(std::isnan(table.columns[1][1]));
    EXPECT_TRUE(std::isnan(table.columns[1][2]));
}

TEST(Csv, ADecimalCommaIsNotGuessedAt) {
    RecordProperty("hazard", "H10");
    const auto table = parseNumericCsv("t;x\n0;1,5\n", "f.csv");
    ASSERT_FALSE(table);
    EXPECT_EQ(table.error().message, "f.csv:2: '1,5' in column 'x'; a number was expected");
}

TEST(Csv, BinaryRubbishIsRefusedAndNotQuotedWhole) {
    RecordProperty("hazard", "H10");
    const std::string rubbish = "a,b\n" + std::string(5000, '\x01') + ",2\n";
    const auto table = parseNumericCsv(rubbish, "f.csv");
    ASSERT_FALSE(table);
    EXPECT_LT(table.error().message.size(), 200U);
    EXPECT_FALSE(parseNumericCsv(std::string(100, '\0'), "f.csv"));
}

TEST(Csv, AFileIsReadWholeOrNamed) {
    const ScratchDir scratch;
    const std::string content(200'000, 'x');
    EXPECT_EQ(readTextFile(scratch.write("a.txt", content)).value(), content);
    EXPECT_EQ(readTextFile(scratch.path() / "none").error().code, ErrorCode::NotFound);
    EXPECT_EQ(readTextFile(scratch.path()).error().code, ErrorCode::Io);
}

}  // namespace
}  // namespace tacto::test
