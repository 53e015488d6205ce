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

TEST(NamedRows, FindColumnsByNameAndKeepTheirLine) {
    NamedRows rows("t,x,note\n# remark\n0,1,\n1\n", "f.csv", "columns t and x were expected", "a row per sample");
    EXPECT_EQ(rows.column({"time", "t"}), 0U);
    EXPECT_EQ(rows.column({"x"}), 1U);
    EXPECT_EQ(rows.find({"y", "z"}), std::nullopt);
    EXPECT_EQ(rows.column({"y", "z"}).error().message, "f.csv:1: no column 'y'; columns t and x were expected");
    EXPECT_EQ(rows.next(), true);
    EXPECT_EQ(rows[1], "1");
    EXPECT_EQ(rows.refuse("{} is wrong", rows[0]).value().message, "f.csv:3: 0 is wrong");
    EXPECT_EQ(rows.next().error().message, "f.csv:4: 1 fields; at least 2 were expected, as in the header");
}

TEST(NamedRows, ATableOfNothingIsRefused) {
    RecordProperty("hazard", "H10");
    NamedRows none("# remark\n", "f.csv", "column t was expected", "a row per sample");
    EXPECT_EQ(none.column({"t"}).error().message, "f.csv: the file is empty; column t was expected");
    NamedRows header("t\n", "f.csv", "column t was expected", "a row per sample");
    EXPECT_EQ(header.column({"t"}), 0U);
    EXPECT_EQ(header.next().error().message, "f.csv: nothing after the header line; a row per sample was expected");
    NamedRows rubbish(std::string_view("\0\x01\x02", 3), "f.csv", "column t was expected", "a row per sample");
    EXPECT_LT(rubbish.column({"t"}).error().message.size(), 200U);
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
