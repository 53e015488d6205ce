#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/Statistics.h"
#include "core/calibration/CalibrationStore.h"
#include "tests/calibration/UnnotedLine.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

CalibrationDate on(const char* text) { return parseDate(text).value(); }

StoredCalibration sample(const std::string& serial, double gain = 1.02) {
    StoredCalibration c;
    c.serial = serial;
    c.device = "P24";
    c.unit = "V";
    c.amplitude = {{gain, 0.1, 10, 40}, 0.6};
    c.interval = {{1.0001, 1e-6, 0.5, 2}, 0.01};
    c.phaseWidth = {{0.999, 0.2e-6, 100e-6, 400e-6}, 0.2};
    c.gap = {{1.002, -0.3e-6, 100e-6, 400e-6}, 0.3};
    c.made = on("2026-11-21");
    c.validUntil = on("2027-11-20");
    c.session = "run.tacto";
    c.sessionHead = std::string(64, 'a');
    c.readings = 440;
    c.instruments = {{"DS2072A", "DS2D1", on("2027-03-01"), 0.03, "the instrument"}, {"shunt", "R7", std::nullopt}};
    return c;
}

std::string textOf(const std::filesystem::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

class CalibrationStoreFile : public testing::Test {
protected:
    [[nodiscard]] CalibrationStore store() const { return CalibrationStore::open(path).value(); }
    ScratchDir folder;
    std::filesystem::path path = folder.path() / "lab" / "calibrations.jsonl";
};

TEST_F(CalibrationStoreFile, KeepsEveryCalibrationAndTheNewestCounts) {
    RecordProperty("hazard", "H8");
    auto first = store();
    ASSERT_TRUE(first.add(sample("A1", 1.02)));
    const auto before = textOf(path);
    ASSERT_TRUE(first.add(sample("B2", 0.97)));
    ASSERT_TRUE(first.add(sample("A1", 1.03)));
    EXPECT_TRUE(textOf(path).starts_with(before));  // kept although superseded
    const auto again = store();
    ASSERT_EQ(again.all().size(), 3U);
    EXPECT_DOUBLE_EQ(again.latest("A1", "V")->amplitude.gain, 1.03);
    EXPECT_DOUBLE_EQ(again.latest("B2", "V")->amplitude.gain, 0.97);
    EXPECT_EQ(again.latest("A1", "mA"), nullptr);
    EXPECT_EQ(again.all()[0].instruments.size(), 2U);
    EXPECT_EQ(again.all()[0].instruments[0].due, on("2027-03-01"));
    EXPECT_FALSE(again.all()[0].instruments[1].due);
}

TEST_F(CalibrationStoreFile, CountsForItsSerialAndItsTimeOnly) {
    RecordProperty("hazard", "H1");
    auto kept = store();
    const auto why = [&](const char* serial, const char* day, bool simulated = false) {
        const auto found = kept.valid(serial, "V", on(day), simulated);
        return found ? std::string("valid") : found.error().message;
    };
    EXPECT_THAT(why("A1", "2026-12-01"), HasSubstr("A1 is not calibrated"));
    ASSERT_TRUE(kept.add(sample("A1")));
    EXPECT_EQ(why("A1", "2026-11-21"), "valid");
    EXPECT_EQ(why("A1", "2027-11-20"), "valid");
    EXPECT_THAT(why("A1", "2027-11-21"), HasSubstr("2027-11-20"));
    EXPECT_THAT(why("A1", "2026-11-20"), HasSubstr("today is 2026-11-20"));
    EXPECT_THAT(why("A2", "2026-12-01"), HasSubstr("A2 is not calibrated"));
    EXPECT_THAT(why("", "2026-12-01"), HasSubstr("without a serial"));
    auto twin = sample("A1");
    twin.simulated = true;
    ASSERT_TRUE(kept.add(twin));
    EXPECT_THAT(why("A1", "2026-12-01"), HasSubstr("simulated bench"));
    EXPECT_EQ(why("A1", "2026-12-01", true), "valid");
}

TEST_F(CalibrationStoreFile, FindsALineThatWasChangedTakenOutOrMoved) {
    RecordProperty("hazard", "H8");
    auto kept = store();
    for (const double gain : {1.01, 1.02, 1.03}) ASSERT_TRUE(kept.add(sample("A1", gain)));
    const auto text = textOf(path);
    const auto refusal = [&](const std::string& changed) {
        write(path, changed);
        const auto opened = CalibrationStore::open(path);
        return opened ? std::string("accepted") : opened.error().message;
    };
    EXPECT_EQ(refusal(text), "accepted");
    auto edited = text;
    edited.replace(edited.find("1.02"), 4, "1.12");
    EXPECT_THAT(refusal(edited), HasSubstr(":2: its digest"));
    const auto second = text.find('\n') + 1;
    const auto third = text.find('\n', second) + 1;
    EXPECT_THAT(refusal(text.substr(0, second) + text.substr(third)), HasSubstr(":2: the line before"));
    EXPECT_THAT(refusal(text.substr(second)), HasSubstr(":1: the line before"));
    EXPECT_THAT(refusal("{}\n"), HasSubstr(":1: this is not a calibration"));
    EXPECT_THAT(refusal(text + "nonsense\n"), HasSubstr(":4:"));
}

TEST_F(CalibrationStoreFile, ALineCutShortByACrashIsLeftOutAndReplaced) {
    auto kept = store();
    ASSERT_TRUE(kept.add(sample("A1", 1.01)));
    const auto whole = textOf(path), end = textOf(path.string() + ".end");
    ASSERT_TRUE(kept.add(sample("A1", 1.02)));
    write(path, textOf(path).substr(0, whole.size() + 40));
    write(path.string() + ".end", end);
    auto opened = store();
    EXPECT_TRUE(opened.lastLineCut());
    EXPECT_DOUBLE_EQ(opened.latest("A1", "V")->amplitude.gain, 1.01);
    ASSERT_TRUE(opened.add(sample("A1", 1.04)));
    EXPECT_EQ(store().all().size(), 2U);
    EXPECT_DOUBLE_EQ(store().latest("A1", "V")->amplitude.gain, 1.04);
}

TEST_F(CalibrationStoreFile, TwoProgramsLoseNothing) {
    auto one = store(), other = store();
    ASSERT_TRUE(one.add(sample("A1")));
    ASSERT_TRUE(other.add(sample("B2")));
    ASSERT_TRUE(one.add(sample("C3")));
    EXPECT_EQ(store().all().size(), 3U);
}

TEST_F(CalibrationStoreFile, KeepsTheLineOfEachQuantity) {
    RecordProperty("hazard", "H8");
    ASSERT_TRUE(store().add(sample("A1")));
    const auto again = store();
    const auto lines = linesOf(*again.latest("A1", "V"));
    EXPECT_EQ(lines, linesOf(sample("A1")));
    EXPECT_TRUE(lines.complete());
    EXPECT_DOUBLE_EQ(lines.gap->offset, -0.3e-6);
    EXPECT_DOUBLE_EQ(again.latest("A1", "V")->phaseWidth->uncertainty_pct, 0.2);
}

TEST_F(CalibrationStoreFile, TheGateLearnsOfUncertaintyAndResidual) {
    RecordProperty("hazard", "H1");
    auto made = sample("A1", 0.9);
    made.amplitude.offset = 0;
    made.amplitude.residual = 0.05;
    made.phaseWidth->uncertainty_pct = 8;
    ASSERT_TRUE(store().add(made));
    const auto lines = linesOf(*store().latest("A1", "V"));
    // 0.6 % of the command is 0.667 % of the output, which is nine tenths of the command.
    ASSERT_TRUE(lines.amplitude.spread);
    EXPECT_NEAR(lines.amplitude.spread->relative, 0.006 / 0.9, 1e-12);
    EXPECT_DOUBLE_EQ(lines.amplitude.spread->absolute, 0.05);
    // Earlier files give no residual: then 5 %, or U if U is larger.
    ASSERT_TRUE(lines.gap->spread);
    EXPECT_DOUBLE_EQ(lines.gap->spread->relative, 0.05);
    EXPECT_NEAR(lines.phaseWidth->spread->relative, 0.08, 1e-3);
    for (const double wrong : {-1.0, kNaN}) {
        made.amplitude.residual = wrong;
        const auto added = store().add(made);
        ASSERT_FALSE(added) << wrong;
        EXPECT_THAT(added.error().message, HasSubstr("largest residual"));
    }
}

TEST_F(CalibrationStoreFile, OneWithoutItsTimesIsReadAndHoldsForNothing) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(store().add(sample("A1")));
    // The line as written by a version of the store that knew only amplitudes.
    auto line = nlohmann::json::parse(textOf(path));
    for (const char* time : {"interval", "width", "gap"}) line["calibration"].erase(time);
    writeUnnoted(path, std::move(line));
    auto old = store();
    ASSERT_NE(old.latest("A1", "V"), nullptr);
    EXPECT_DOUBLE_EQ(old.latest("A1", "V")->amplitude.gain, 1.02);
    const auto valid = old.valid("A1", "V", on("2026-12-01"), false);
    ASSERT_FALSE(valid);
    EXPECT_THAT(valid.error().message, HasSubstr("is without its interval"));
    // A complete calibration supersedes it.
    ASSERT_TRUE(old.add(sample("A1")));
    EXPECT_TRUE(store().valid("A1", "V", on("2026-12-01"), false));
}

TEST_F(CalibrationStoreFile, OneWithoutItsProvenanceIsReadAndNotApplied) {
    RecordProperty("hazard", "H1");
    const auto forged = [&](auto change) {
        std::filesystem::remove(path);
        std::filesystem::remove(path.string() + ".end");
        auto kept = store();
        EXPECT_TRUE(kept.add(sample("A1", 0.9)));
        auto line = nlohmann::json::parse(textOf(path));
        change(line["calibration"]);
        writeUnnoted(path, std::move(line));
        const auto opened = store();
        EXPECT_NE(opened.latest("A1", "V"), nullptr);
        const auto valid = opened.valid("A1", "V", on("2026-12-01"), false);
        EXPECT_EQ(opened.proven("A1", "V", true) != nullptr, valid.has_value()) << "nor are the limits judged by it";
        return valid ? std::string("applied") : valid.error().message;
    };
    EXPECT_EQ(forged([](auto&) {}), "applied");
    EXPECT_THAT(forged([](auto& c) { c.erase("session_head"); }), HasSubstr("from which readings"));
    EXPECT_THAT(forged([](auto& c) { c["session_head"] = "42"; }), HasSubstr("from which readings"));
    EXPECT_THAT(forged([](auto& c) { c["readings"] = 0; }), HasSubstr("from which readings"));
    EXPECT_THAT(forged([](auto& c) { c["session"] = ""; }), HasSubstr("from which readings"));
    EXPECT_THAT(forged([](auto& c) { c["instruments"][0]["gain_tolerance"] = nullptr; }),
                HasSubstr("no instrument whose accuracy is stated"));
    EXPECT_THAT(forged([](auto& c) { c["valid_until"] = "2036-11-18"; }), HasSubstr("hold for 3650 days"));
}

TEST_F(CalibrationStoreFile, IsAddedWithItsProvenanceOnlyAndForAYear) {
    RecordProperty("hazard", "H1");
    auto kept = store();
    auto nameless = sample("A1");
    nameless.sessionHead.clear();
    EXPECT_FALSE(kept.add(nameless));
    auto silent = sample("A1");
    silent.instruments[0].gainTolerance.reset();
    EXPECT_FALSE(kept.add(silent));
    auto eternal = sample("A1");
    eternal.validUntil = on("2027-11-23");
    EXPECT_FALSE(kept.add(eternal));
    EXPECT_TRUE(store().all().empty());
}

TEST_F(CalibrationStoreFile, TheLimitsOfARealOutputAreNotJudgedByOneOfASimulatedBench) {
    RecordProperty("hazard", "H1");
    auto kept = store();
    auto twin = sample("A1", 0.9);
    ASSERT_TRUE(kept.add(sample("A1", 1.02)));
    twin.simulated = true;
    ASSERT_TRUE(kept.add(twin));
    EXPECT_DOUBLE_EQ(kept.proven("A1", "V", false)->amplitude.gain, 1.02);
    EXPECT_DOUBLE_EQ(kept.proven("A1", "V", true)->amplitude.gain, 0.9);
}

TEST_F(CalibrationStoreFile, RefusesWhatIsNoCalibration) {
    RecordProperty("hazard", "H9");
    auto kept = store();
    const auto refused = [&](auto change) {
        auto c = sample("A1");
        change(c);
        return !kept.add(c);
    };
    EXPECT_TRUE(refused([](auto& c) { c.serial.clear(); }));
    EXPECT_TRUE(refused([](auto& c) { c.unit = "A"; }));
    for (const double gain : {0.0, -1.0, kNaN}) EXPECT_TRUE(refused([&](auto& c) { c.amplitude.gain = gain; })) << gain;
    EXPECT_TRUE(refused([](auto& c) { c.amplitude.offset = kNaN; }));
    EXPECT_TRUE(refused([](auto& c) { c.amplitude.uncertainty_pct = 0; }));
    EXPECT_TRUE(refused([](auto& c) { c.amplitude.highest = c.amplitude.lowest; }));
    EXPECT_TRUE(refused([](auto& c) { c.interval.reset(); }));
    EXPECT_TRUE(refused([](auto& c) { c.phaseWidth->gain = kNaN; }));
    EXPECT_TRUE(refused([](auto& c) { c.gap->lowest = 0; }));
    EXPECT_TRUE(refused([](auto& c) { c.gap->uncertainty_pct = kNaN; }));
    EXPECT_TRUE(refused([](auto& c) { c.validUntil = on("2026-11-20"); }));
    EXPECT_TRUE(refused([](auto& c) { c.instruments[0].due = on("2026-11-20"); }));  // overdue when it was used
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(CalibrationDateText, ReadsDaysThatExist) {
    EXPECT_EQ(dateText(on("2028-02-29")), "2028-02-29");
    for (const char* text : {"2027-02-29", "2027-13-01", "27-01-01", "2027/01/01", "2027-1-01", "2027-01-0x", ""}) {
        EXPECT_FALSE(parseDate(text)) << text;
    }
}

}  // namespace
}  // namespace tacto::test
