#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "core/calibration/ChainedLines.h"
#include "core/calibration/LoadSafetyStore.h"
#include "tests/calibration/UnnotedLine.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

CalibrationDate dayIn(const char* text) { return parseDate(text).value(); }

LoadSafetyCheck checkOf(CheckVerdict verdict = CheckVerdict::Pass, const char* made = "2026-11-20") {
    LoadSafetyCheck check;
    check.serial = "P24-0815";
    check.device = "RehaMove";
    check.made = dayIn(made);
    check.verdict = verdict;
    check.area = SquareCentimetres(3);
    check.reach = {40, 0.5, 200, 500, 10'000};
    check.tolerances = {.load_pct = 5, .amplitude_pct = 2};
    check.limits = {{"paper", std::string(64, 'a')}, {"fda-pms", std::string(64, 'b')}};
    check.scriptSha256 = std::string(64, 'c');
    check.session = "load-safety.tacto";
    if (verdict != CheckVerdict::Begun) check.sessionHead = std::string(64, 'd');
    return check;
}

LoadSafetyNeed needed(const char* day = "2026-11-23") {
    return {.serial = "P24-0815",
            .day = dayIn(day),
            .scriptSha256 = std::string(64, 'c'),
            .area = SquareCentimetres(4),
            .reach = {40, 0.5, 200, 500, 10'000},
            .tolerances = {.load_pct = 5, .amplitude_pct = 2},
            .limits = {{"paper", std::string(64, 'a')}}};
}

std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

class LoadSafetyChecks : public testing::Test {
protected:
    [[nodiscard]] LoadSafetyStore store() const { return LoadSafetyStore::open(path).value(); }
    void keep(const LoadSafetyCheck& check) const {
        const auto kept = store().add(check);
        ASSERT_TRUE(kept) << kept.error().message;
    }
    /// Returns why no check is valid; empty if one is.
    [[nodiscard]] std::string why(const LoadSafetyNeed& need = needed()) const {
        const auto passed = store().passed(need);
        return passed ? "" : passed.error().message;
    }
    ScratchDir folder;
    std::filesystem::path path = folder.path() / "lab" / "load-safety.jsonl";
};

TEST_F(LoadSafetyChecks, AreReadAsTheyWereKept) {
    auto bare = checkOf(CheckVerdict::Begun);
    bare.area.reset();
    keep(bare);
    keep(checkOf());
    const auto again = store();
    ASSERT_EQ(again.all().size(), 2U);
    EXPECT_EQ(again.all()[0], bare);
    EXPECT_EQ(again.all()[1], checkOf());
}

TEST_F(LoadSafetyChecks, APassCountsForThirtyDays) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(why(),
              "stimulator P24-0815 has no load-safety check; one that passed at most 30 days ago on the real bench is "
              "expected");
    keep(checkOf());
    EXPECT_EQ(why(), "");
    EXPECT_EQ(why(needed("2026-11-20")), "");
    EXPECT_EQ(why(needed("2026-12-20")), "");
    EXPECT_EQ(why(needed("2026-12-21")),
              "the load-safety check of stimulator P24-0815 of 2026-11-20 passed 31 days ago; one that passed at most "
              "30 days ago on the real bench is expected");
    EXPECT_EQ(why(needed("2026-11-19")),
              "the load-safety check of stimulator P24-0815 of 2026-11-20 is dated after today, 2026-11-19; set the "
              "clock");
}

class NotPassed : public LoadSafetyChecks, public testing::WithParamInterface<CheckVerdict> {};

TEST_P(NotPassed, TakesThePlaceOfAPassBeforeIt) {
    RecordProperty("hazard", "H9");
    keep(checkOf());
    keep(checkOf(GetParam(), "2026-11-21"));
    EXPECT_THAT(why(), HasSubstr(GetParam() == CheckVerdict::Begun
                                     ? "of 2026-11-21 was begun and never ended"
                                     : fmt::format("of 2026-11-21 ended with the verdict \"{}\"", nameOf(GetParam()))));
    keep(checkOf(CheckVerdict::Pass, "2026-11-21"));
    EXPECT_EQ(why(), "");
}

INSTANTIATE_TEST_SUITE_P(Verdicts, NotPassed,
                         testing::Values(CheckVerdict::Begun, CheckVerdict::Fail, CheckVerdict::Indeterminate,
                                         CheckVerdict::Stopped, CheckVerdict::None),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

TEST_F(LoadSafetyChecks, ASimulatedOneCountsForNoStimulatorAndSupersedesNone) {
    RecordProperty("hazard", "H9");
    auto simulated = checkOf();
    simulated.simulated = true;
    keep(simulated);
    EXPECT_THAT(why(), HasSubstr("has no load-safety check but a simulated one"));
    keep(checkOf());
    simulated.verdict = CheckVerdict::Fail;
    keep(simulated);
    EXPECT_EQ(why(), "");
}

TEST_F(LoadSafetyChecks, AnotherUnitsDoesNotCount) {
    RecordProperty("hazard", "H4");
    auto other = checkOf();
    other.serial = "P24-0816";
    keep(other);
    EXPECT_THAT(why(), HasSubstr("stimulator P24-0815 has no load-safety check; "));
    auto need = needed();
    need.serial.clear();
    EXPECT_THAT(why(need), HasSubstr("has no serial number"));
}

TEST_F(LoadSafetyChecks, IsOfElectrodesTrainsLimitsAndAProtocolThatCoverTheSession) {
    RecordProperty("hazard", "H1");
    keep(checkOf());
    const auto without = [&](auto change) {
        auto need = needed();
        change(need);
        return why(need);
    };
    EXPECT_THAT(without([](auto& need) { need.area = SquareCentimetres(2.5); }),
                HasSubstr("is of electrodes of 3 cm², and those of the study have 2.5 cm²"));
    EXPECT_THAT(without([](auto& need) { need.reach.amplitude_v = 41; }), HasSubstr("went up to 40 V, and the"));
    EXPECT_THAT(without([](auto& need) { need.reach.interval_s = 0.25; }), HasSubstr("had trains every 0.5 s"));
    EXPECT_THAT(without([](auto& need) { need.reach.phase_us = 400; }), HasSubstr("had 200 µs of each phase"));
    EXPECT_THAT(without([](auto& need) { need.reach.highest_ohm = 20'000; }),
                HasSubstr("was judged for loads of 500 to 10000 Ω, and the session's profile permits 500 to 20000 Ω"));
    EXPECT_THAT(without([](auto& need) { need.reach.lowest_ohm = 200; }), HasSubstr("permits 200 to 10000 Ω"));
    EXPECT_THAT(without([](auto& need) { need.scriptSha256[0] = 'e'; }), HasSubstr("another version of the protocol"));
    EXPECT_THAT(without([](auto& need) { need.limits[0].sha256[0] = 'f'; }),
                HasSubstr("was not judged by the limit set paper (faaaaaaaaaaa…)"));
    auto without_area = checkOf();
    without_area.area.reset();
    keep(without_area);
    EXPECT_THAT(why(), HasSubstr("states no electrode area; one of at most 4 cm² is expected"));
}

// A check that fails at the program's own tolerances may be repeated with wider ones, but that is not a pass.
TEST_F(LoadSafetyChecks, OneThatAllowedMoreThanTheProgramDoesNotCount) {
    RecordProperty("hazard", "H9");
    auto wide = checkOf();
    wide.tolerances.amplitude_pct = 20;
    keep(wide);
    EXPECT_EQ(why(),
              "the load-safety check of stimulator P24-0815 of 2026-11-20 allows 20 % for an amplitude over the "
              "command; at most 2 % is expected");
    wide.tolerances = {.load_pct = 15, .amplitude_pct = 2};
    keep(wide);
    EXPECT_THAT(why(), HasSubstr("allows 15 % for a load's value; at most 5 % is expected"));
    wide.tolerances = {.load_pct = 1, .amplitude_pct = 0.5};
    keep(wide);
    EXPECT_EQ(why(), "");
}

TEST_F(LoadSafetyChecks, OneThatDoesNotSayWhatItAllowedOrForWhichLoadsDoesNotCount) {
    RecordProperty("hazard", "H9");
    auto unsaid = checkOf();
    unsaid.tolerances.load_pct.reset();
    keep(unsaid);
    EXPECT_THAT(why(), HasSubstr("does not say how much it allows for a load's value; a new one is expected"));
    unsaid = checkOf();
    unsaid.reach.lowest_ohm.reset();
    keep(unsaid);
    EXPECT_EQ(store().all().back(), unsaid);
    EXPECT_THAT(why(), HasSubstr("does not say for which loads its worst case was judged"));
}

TEST_F(LoadSafetyChecks, AChangedFileCannotBeReadOrAddedTo) {
    RecordProperty("hazard", "H9");
    keep(checkOf(CheckVerdict::Fail));
    auto text = bytesOf(path);
    const auto place = text.find("\"fail\"");
    ASSERT_NE(place, std::string::npos);
    text.replace(place, 6, "\"pass\"");
    std::ofstream(path) << text;
    const auto opened = LoadSafetyStore::open(path);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().code, ErrorCode::ParseError);
    EXPECT_THAT(opened.error().message, HasSubstr("load-safety.jsonl:1: its digest does not fit"));
}

TEST_F(LoadSafetyChecks, LinesTakenOffItsEndAreMissed) {
    RecordProperty("hazard", "H9");
    const auto note = path.string() + ".end";
    keep(checkOf());
    const auto older = bytesOf(path), olderNote = bytesOf(note);
    keep(checkOf(CheckVerdict::Fail));
    const auto newer = bytesOf(path), newerNote = bytesOf(note);
    const auto refusal = [&](const std::optional<std::string>& lines, const std::optional<std::string>& end) {
        std::filesystem::remove(path);
        std::filesystem::remove(note);
        if (lines) std::ofstream(path) << *lines;
        if (end) std::ofstream(note) << *end;
        const auto opened = LoadSafetyStore::open(path);
        return opened ? std::string() : opened.error().message;
    };
    EXPECT_EQ(refusal(newer, newerNote), "");
    EXPECT_EQ(refusal(older, newerNote), fmt::format("{} ends at byte {} where {} says {}: lines are missing; put it "
                                                     "back from your copy",
                                                     path.string(), older.size(), note, newer.size()));
    EXPECT_THAT(refusal("", newerNote), HasSubstr("lines are missing"));
    EXPECT_THAT(refusal(std::nullopt, newerNote), HasSubstr("lines are missing"));
    EXPECT_THAT(refusal(older, std::nullopt), HasSubstr("load-safety.jsonl.end is missing"));
    EXPECT_THAT(refusal(newer, "{}"), HasSubstr("does not say where"));
    EXPECT_THAT(refusal(newer, "bytes"), HasSubstr("load-safety.jsonl.end"));

    // The power failed when the line was on disk but the note on the file's end was not.
    EXPECT_EQ(refusal(newer, olderNote), "");
    EXPECT_THAT(why(), HasSubstr("ended with the verdict \"fail\"")) << "the line counts";
    keep(checkOf(CheckVerdict::Fail));
    EXPECT_EQ(store().all().size(), 3U);
    EXPECT_THAT(refusal(newer, bytesOf(note)), HasSubstr("lines are missing"));
}

TEST_F(LoadSafetyChecks, AFileFromBeforeEndsWereNotedIsReadAndNotedFromThenOn) {
    keep(checkOf());
    writeUnnoted(path, nlohmann::json::parse(bytesOf(path)));
    const auto text = bytesOf(path);
    EXPECT_EQ(store().all().size(), 1U);
    keep(checkOf(CheckVerdict::Fail));
    EXPECT_EQ(store().all().size(), 2U);
    std::ofstream(path) << text;
    EXPECT_FALSE(LoadSafetyStore::open(path));
}

TEST_F(LoadSafetyChecks, OneThatIsNotWholeIsNotKept) {
    RecordProperty("hazard", "H9");
    auto kept = store();
    for (const auto& [change, part] :
         {std::pair<void (*)(LoadSafetyCheck&), const char*>{[](auto& c) { c.serial.clear(); }, "a serial number"},
          {[](auto& c) { c.made = {}; }, "a day"},
          {[](auto& c) { c.scriptSha256 = "c"; }, "the digest of its protocol"},
          {[](auto& c) { c.session.clear(); }, "its session"},
          {[](auto& c) { c.sessionHead.clear(); }, "the chain head"}}) {
        auto check = checkOf();
        change(check);
        const auto added = kept.add(check);
        ASSERT_FALSE(added) << part;
        EXPECT_EQ(added.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(added.error().message, HasSubstr(part));
    }
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(ChainedLines, WhatALineBringsByTheNamesOfTheChainIsTheChains) {
    RecordProperty("hazard", "H10");
    const ScratchDir folder;
    const auto path = folder.path() / "lines.jsonl";
    for (const int number : {1, 2}) {
        ChainedLines file(path, "line");
        const auto added = file.append([&]() -> Result<nlohmann::json> {
            const auto read = file.read([](const nlohmann::json&) { return Result<void>(); });
            if (!read) return failure(read);
            return nlohmann::json{{"number", number}, {"sha256", "claimed"}, {"previous", "claimed"}};
        });
        ASSERT_TRUE(added) << added.error().message;
    }
    std::vector<int> numbers;
    const auto read = ChainedLines(path, "line").read([&](const nlohmann::json& line) {
        numbers.push_back(line.at("number"));
        return Result<void>();
    });
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(numbers, (std::vector{1, 2}));
}

}  // namespace
}  // namespace tacto::test
