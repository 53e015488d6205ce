#include <gtest/gtest.h>
#include <limits>

#include "core/safety/FixedText.h"
#include "core/safety/LimitSet.h"
#include "tests/safety/GateFixtures.h"
#include "tests/support/Refused.h"

namespace tacto::test {

namespace {
const char* kGood = R"({"id": "lab", "title": "Our own", "limits": [
  {"quantity": "peak_current", "max": 20, "unit": "mA", "compare": "<=", "judged": "load_range", "action": "refuse",
   "source": "lab rule 3", "confidence": "high"}]})";

std::string with(const std::string& from, const std::string& to) {
    std::string text = kGood;
    text.replace(text.find(from), from.size(), to);
    return text;
}

void expectRefused(const std::string& text, const std::string& words) {
    const auto set = parseLimitSet(text, "lab.json");
    ASSERT_FALSE(set) << text;
    EXPECT_EQ(set.error().code, ErrorCode::ParseError);
    EXPECT_NE(set.error().message.find(words), std::string::npos) << set.error().message;
    EXPECT_EQ(set.error().message.rfind("lab.json: ", 0), 0U) << set.error().message;
}

const LimitRow* find(const LimitSet& set, Quantity q, LimitAction action, double max) {
    for (const auto& row : set.rows) {
        if (row.quantity == q && row.action == action && row.max == max) return &row;
    }
    return nullptr;
}
}  // namespace

TEST(LimitSet, ShippedSetsHoldTheFiguresOfSafetyMd) {
    RecordProperty("hazard", "H1");
    const auto& sets = limitSets();
    ASSERT_EQ(sets.size(), 3U);
    const LimitSet &fda = sets[0], &iec = sets[1], &paper = sets[2];
    EXPECT_EQ(fda.id, "fda-pms");
    EXPECT_EQ(iec.id, "iec-60601-2-10");
    EXPECT_EQ(paper.id, "paper");

    const auto* command = find(paper, Quantity::CommandVoltage, LimitAction::Refuse, 40);
    ASSERT_NE(command, nullptr);
    EXPECT_FALSE(command->strict);
    const auto* rms = find(paper, Quantity::RmsCurrent5s, LimitAction::Refuse, 10);
    ASSERT_NE(rms, nullptr);
    EXPECT_TRUE(rms->strict) << "the paper says less than 10 mA";
    EXPECT_NE(find(paper, Quantity::PeakVoltage, LimitAction::Refuse, 500), nullptr);

    EXPECT_NE(find(iec, Quantity::PeakVoltage, LimitAction::Refuse, 500), nullptr);
    for (const auto& [max, hz] : {std::pair{50.0, 400.0}, {80.0, 1500.0}, {100.0, 1e5}}) {
        const auto* row = find(iec, Quantity::RmsCurrent5s, LimitAction::Refuse, max);
        ASSERT_NE(row, nullptr) << max;
        EXPECT_EQ(row->judged, JudgedAt::Ohm500);
        EXPECT_TRUE(row->holdsAt(hz));
    }
    EXPECT_FALSE(find(iec, Quantity::RmsCurrent5s, LimitAction::Refuse, 50)->holdsAt(400.1));
    EXPECT_FALSE(find(iec, Quantity::RmsCurrent5s, LimitAction::Refuse, 80)->holdsAt(400));
    EXPECT_FALSE(find(iec, Quantity::RmsCurrent5s, LimitAction::Refuse, 100)->holdsAt(1500));
    EXPECT_NE(find(iec, Quantity::DcCurrent, LimitAction::Refuse, 80), nullptr);
    EXPECT_NE(find(iec, Quantity::PulseEnergy, LimitAction::Refuse, 300), nullptr);
    EXPECT_NE(find(iec, Quantity::CurrentDensity, LimitAction::Warn, 2), nullptr);
    EXPECT_NE(find(iec, Quantity::RmsCurrent5s, LimitAction::Disclose, 10), nullptr);
    EXPECT_NE(find(iec, Quantity::RmsVoltage5s, LimitAction::Disclose, 10), nullptr);
    EXPECT_EQ(iec.accuracy.size(), 3U);

    const auto* power = find(fda, Quantity::PowerDensity, LimitAction::Refuse, 0.25);
    ASSERT_NE(power, nullptr);
    EXPECT_TRUE(power->strict);
    EXPECT_EQ(fda.disclosures.size(), 7U);
    for (const auto& set : sets) {
        for (const auto& row : set.rows) EXPECT_FALSE(row.source.empty());
    }
}

TEST(LimitSet, ReadsAnotherLabsSet) {
    const auto set = accepted(parseLimitSet(kGood, "lab.json"));
    ASSERT_EQ(set.rows.size(), 1U);
    EXPECT_EQ(set.rows[0].quantity, Quantity::PeakCurrent);
    EXPECT_EQ(set.rows[0].confidence, Confidence::High);
}

TEST(LimitSet, RefusesWhatItCannotMeanWithOneSentence) {
    RecordProperty("hazard", "H10");
    expectRefused("", "line 1 is not JSON");
    expectRefused("{\n\"id\": \"x\",\n!}", "line 3 is not JSON");
    expectRefused("[]", "an object is expected");
    expectRefused(with("\"max\": 20", "\"max\": 0"), "a number above 0");
    expectRefused(with("\"max\": 20", "\"max\": -1"), "\"max\" is -1; a number above 0");
    expectRefused(with("\"max\": 20", "\"max\": \"20\""), "\"max\" is \"20\"; a number above 0");
    expectRefused(with("\"max\": 20", "\"max\": 1e999"), "");
    expectRefused(with("\"max\": 20", "\"max\": NaN"), "is not JSON");
    expectRefused(with("\"max\": 20,", ""), "a number above 0");
    expectRefused(with("\"mA\"", "\"A\""), "\"unit\" is \"A\"; \"mA\" of peak_current was expected");
    expectRefused(with("peak_current", "peak_amps"), "\"peak_amps\"; a known quantity");
    expectRefused(with("\"<=\"", "\"<<\""), "<= or < was expected");
    expectRefused(with("\"load_range\"", "\"here\""), "load_range or 500_ohm");
    expectRefused(with("\"refuse\"", "\"ignore\""), "refuse, warn or disclose");
    expectRefused(with("\"high\"", "\"sure\""), "high, medium, medium-low or low");
    expectRefused(with("\"source\": \"lab rule 3\", ", ""), "\"source\" is missing; a text");
    expectRefused(with("\"max\": 20", "\"maxx\": 1, \"max\": 20"), "\"maxx\" is not a known key");
    expectRefused(with("\"max\": 20", "\"max\": 20, \"max\": 2000"), "\"max\" of one object is given twice");
    expectRefused(with("\"max\": 20", "\"max\": 20, \"window_s\": 2"), "\"window_s\" is 2");
    expectRefused(with("\"max\": 20", "\"max\": 20, \"above_hz\": 9, \"up_to_hz\": 9"), "is empty");
    expectRefused(with("\"lab\"", "\"profile\""), "not accepted");
    expectRefused(with("\"lab\"", "\"../lab\""), "not accepted");
    expectRefused(R"({"id": "lab", "title": "t", "limits": []})", "a list of 1 to 1000 entries");
    expectRefused(R"({"id": "lab", "title": "t", "limits": 3})", "\"limits\" is 3; a list of 1 to 1000 entries");
}

TEST(LimitSet, RefusesDeepAndHugeText) {
    RecordProperty("hazard", "H10");
    EXPECT_FALSE(parseLimitSet(std::string(200'000, '['), "deep.json"));
    EXPECT_FALSE(parseLimitSet(std::string(1'000'001, ' '), "huge.json"));
    EXPECT_FALSE(parseLimitSet("{\"id\": \"\xff\xfe\"}", "bytes.json"));
}

TEST(LimitRow, NanNeverKeepsALimit) {
    RecordProperty("hazard", "H1");
    LimitRow row = rowFor(Quantity::PeakCurrent, 10);
    EXPECT_TRUE(row.keeps(10));
    EXPECT_FALSE(row.keeps(std::nextafter(10.0, 11.0)));
    EXPECT_FALSE(row.keeps(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(row.keeps(std::numeric_limits<double>::infinity()));
    row.strict = true;
    EXPECT_FALSE(row.keeps(10));
    EXPECT_FALSE(row.keeps(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace tacto::test

namespace tacto {

TEST(Quantity, KeysAreReadBack) {
    for (std::size_t k = 0; k < kQuantityCount; ++k) {
        const auto q = static_cast<Quantity>(k);
        EXPECT_EQ(quantityOf(keyOf(q)), q);
        EXPECT_FALSE(titleOf(q).empty());
        EXPECT_FALSE(unitOf(q).empty());
    }
    EXPECT_EQ(quantityOf("rms"), std::nullopt);
}

TEST(Quantity, MilliampsRmsAreOverFiveSeconds) {
    EXPECT_EQ(windowOf(Quantity::RmsCurrent5s), 5);
    EXPECT_EQ(windowOf(Quantity::PowerDensity), 1);
    EXPECT_TRUE(needsArea(Quantity::CurrentDensity));
    EXPECT_FALSE(needsArea(Quantity::RmsCurrent5s));
}

TEST(FixedText, CutsAtAWholeCharacter) {
    EXPECT_EQ(FixedText<4>("abcdef").view(), "abcd");
    EXPECT_EQ(FixedText<4>("abcµ").view(), "abc");  // µ is two bytes
    EXPECT_EQ(FixedText<5>("abcµ").view(), "abcµ");
    EXPECT_TRUE(FixedText<4>(static_cast<const char*>(nullptr)).empty());
    EXPECT_EQ(std::string(FixedText<4>("abcdef").c_str()), "abcd");
}

}  // namespace tacto
