// The output of a described record, and its columns.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/base/Words.h"
#include "core/results/ResultRecord.h"

namespace tacto {
namespace {

enum class Colour { Red, Green };
constexpr Word<Colour> kColours[] = {{"red", Colour::Red}, {"green", Colour::Green}};
std::string_view nameOf(Colour colour) { return wordFor<Colour>(kColours, colour); }

struct Part {
    std::string name;
    double value = 0;
};
struct Whole {
    std::vector<Part> parts;
    std::optional<Part> best;
    std::optional<std::size_t> rank;
    std::vector<std::vector<std::size_t>> counts;
    std::string note;
    double low = 0, high = 0;
    Colour colour = Colour::Red;
};

ResultRecord<Part> describePart() {
    ResultRecord<Part> all;
    all.shown(describe::text("Name", "name"), &Part::name);
    all.shown(describe::number("Value", "value", "V"), &Part::value);
    return all;
}

ResultRecord<Whole> describeWhole() {
    ResultRecord<Whole> all;
    all.shown(describe::number("Rank", "rank"), &Whole::rank);
    all.facts("Found");
    all.rows("Parts", "parts", &Whole::parts, describePart()).note = "Two at most.";
    all.kept("best", &Whole::best, describePart());
    all.kept("counts", &Whole::counts);
    all.kept("note", nullIfEmpty(&Whole::note));
    all.keptBounds("value", [](const Whole& whole) -> const Whole& { return whole; });
    all.kept("seen.colour", &Whole::colour);
    all.kept("seen.parts", [](const Whole& whole) { return whole.parts.size(); });
    return all;
}

TEST(ResultRecords, WriteEachMemberUnderItsKey) {
    Whole whole;
    whole.parts = {{"a", 1.5}, {"b", std::numeric_limits<double>::quiet_NaN()}};
    whole.rank = 3;
    whole.counts = {{1, 2}, {}};
    whole.low = -1;
    whole.high = std::numeric_limits<double>::infinity();
    whole.colour = Colour::Green;
    const auto expected = nlohmann::json::parse(R"({
        "rank": 3, "parts": [{"name": "a", "value": 1.5}, {"name": "b", "value": null}], "best": null,
        "counts": [[1, 2], []], "note": null, "value_low": -1.0, "value_high": null,
        "seen": {"colour": "green", "parts": 2}})");
    EXPECT_EQ(describeWhole().write(whole), expected);
    EXPECT_THAT(describeWhole().keys(), testing::ElementsAre("rank", "parts", "best", "counts", "note", "value_low",
                                                             "value_high", "seen.colour", "seen.parts"));
    whole.best = whole.parts.front();
    whole.rank.reset();
    whole.note = "few";
    const auto written = describeWhole().write(whole);
    EXPECT_EQ(written["best"]["name"], "a");
    EXPECT_TRUE(written["rank"].is_null());
    EXPECT_EQ(written["note"], "few");
}

TEST(ResultRecords, ShowInTheirTablesWhatTheyHold) {
    const auto whole = describeWhole();
    ASSERT_EQ(whole.tables().size(), 2U);
    const auto& [facts, parts] = std::tie(whole.tables()[0], whole.tables()[1]);
    EXPECT_EQ(facts.shape, ResultTable::Shape::Facts);
    EXPECT_EQ(facts.columns.at(0).at, "rank");
    EXPECT_EQ(parts.at, "parts");
    EXPECT_EQ(parts.note, "Two at most.");
    EXPECT_EQ(parts.columns.at(1).unit, "V");
    EXPECT_EQ(describePart().column("value", "Voltage").title, "Voltage");
    const auto placed = describe::under("found", parts);
    EXPECT_EQ(placed.at, "found.parts");
    EXPECT_EQ(describe::under("found", facts).columns.at(0).at, "found.rank");
}

TEST(ResultRecords, HoldWhatAnotherHoldsAndReplaceIt) {
    struct Named {
        Part part;
        double twice = 0;
    };
    ResultRecord<Named> all;
    all.merge(&Named::part, describePart());
    all.kept("value", &Named::twice);
    EXPECT_EQ(all.write({{"a", 1}, 2}), (nlohmann::json{{"name", "a"}, {"value", 2.0}}));
}

TEST(ResultRecords, LeaveOutWhatIsAbsentWhereTheySayThatItMayBe) {
    ResultRecord<Whole> all;
    all.keptIfAny("rank", &Whole::rank);
    all.merge(&Whole::best, describePart());
    EXPECT_EQ(all.write({}), nlohmann::json::object());
    Whole whole;
    whole.best = Part{"a", 2};
    whole.rank = 0;
    EXPECT_EQ(all.write(whole), (nlohmann::json{{"rank", 0}, {"name", "a"}, {"value", 2.0}}));
    EXPECT_THAT(all.keys(), testing::ElementsAre("rank", "name", "value"));
    EXPECT_EQ(all.only({"value"}).write(whole), (nlohmann::json{{"value", 2.0}}));
}

}  // namespace
}  // namespace tacto
