#include <functional>
#include <gmock/gmock.h>

#include "core/pilot/EarlierThresholds.h"
#include "core/pilot/PilotRecord.h"

namespace tacto {
namespace {

using testing::HasSubstr;

SessionRow eventOf(const char* kind, const char* name, nlohmann::json body) {
    SessionRow event;
    event.name = kind;
    event.body = std::move(body);
    event.body["name"] = name;
    return event;
}

std::vector<SessionRow> measured() {
    return {eventOf(row::kAnswer, "ascending 4", {{"series", 1}, {"current_ma", 9}, {"response", "too-strong"}}),
            eventOf(row::kAnswer, "ascending 9", {{"series", 2}, {"current_ma", 8}, {"response", "strong"}}),
            eventOf(row::kAnswer, "ascending 10", {{"series", 2}, {"current_ma", 0}, {"response", "too-strong"}}),
            eventOf(row::kEstimate, "detection", {{"estimate", {{"value", 2.1}, {"low", 1.9}, {"high", 2.4}}}}),
            eventOf(row::kRange, "range",
                    {{"usable", true}, {"min_ma", 3}, {"max_ma", 6}, {"impedance_ohm", 3400}, {"reason", nullptr}}),
            eventOf(row::kSessionEnd, "end", {{"state", "complete"}, {"why", ""}})};
}

TEST(EarlierThresholds, AreThoseOfTheRows) {
    RecordProperty("hazard", "H6");
    const auto found = earlierThresholds(measured(), LevelUnit::Current);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->detection, 2.1);
    EXPECT_EQ(found->min, 3);
    EXPECT_EQ(found->max, 6);
    EXPECT_EQ(found->tooStrong, 8);
    EXPECT_EQ(found->impedance_ohm, 3400);
}

TEST(EarlierThresholds, AreNoneWhereARowIsMissingOrNotWhole) {
    RecordProperty("hazard", "H6");
    for (std::size_t i = 3; i < measured().size(); ++i) {
        auto rows = measured();
        rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(i));
        const auto none = earlierThresholds(rows, LevelUnit::Current);
        ASSERT_FALSE(none) << i;
        EXPECT_EQ(none.error().code, ErrorCode::NotFound);
    }
    const auto with = [](std::size_t at, const char* key, nlohmann::json value) {
        auto rows = measured();
        rows[at].body[key] = std::move(value);
        return earlierThresholds(rows, LevelUnit::Current).has_value();
    };
    EXPECT_TRUE(with(4, "jnd", 7));
    EXPECT_FALSE(with(4, "usable", false));
    EXPECT_FALSE(with(4, "max_ma", nullptr));
    EXPECT_FALSE(with(4, "max_ma", 3));
    EXPECT_FALSE(with(4, "max_ma", 8)) << "as high as what was too strong";
    EXPECT_FALSE(with(4, "impedance_ohm", nullptr));
    EXPECT_FALSE(with(3, "estimate", nullptr));
    EXPECT_FALSE(with(5, "state", "stopped"));
    EXPECT_FALSE(earlierThresholds(measured(), LevelUnit::Intensity)) << "currents are no intensities";
}

TEST(EarlierThresholds, HoldForHalfAnHourOnUntouchedElectrodesAlone) {
    RecordProperty("hazard", "H6");
    auto found = earlierThresholds(measured(), LevelUnit::Current).value();
    found.endedAt = std::chrono::sys_days(std::chrono::year(2026) / 11 / 23) + std::chrono::hours(12);
    found.device = "P24";
    found.serial = "17";
    const ThresholdsNow good{found.endedAt + kThresholdsHold, "P24", "17", LevelUnit::Current, true, 4420};
    EXPECT_TRUE(stillHold(found, good));
    const auto refusal = [&](const std::function<void(ThresholdsNow&)>& change) {
        auto now = good;
        change(now);
        const auto holds = stillHold(found, now);
        if (holds) return std::string();
        EXPECT_EQ(holds.error().code, kGateRefused);
        return holds.error().message;
    };
    EXPECT_THAT(refusal([](ThresholdsNow& now) { now.at += std::chrono::seconds(60); }),
                HasSubstr("measured 31 min ago; at most 30 min are accepted"));
    EXPECT_THAT(refusal([&](ThresholdsNow& now) { now.at = found.endedAt - std::chrono::seconds(1); }),
                HasSubstr("at most 30 min"))
        << "the clock was set back";
    EXPECT_THAT(refusal([](ThresholdsNow& now) { now.serial = "18"; }),
                HasSubstr("measured with P24 17 and P24 18 is connected"));
    EXPECT_THAT(refusal([](ThresholdsNow& now) { now.untouched = false; }), HasSubstr("electrodes were touched"));
    EXPECT_THAT(refusal([](ThresholdsNow& now) { now.impedance_ohm = 4421; }),
                HasSubstr("the electrodes measure 4421 ohm after 3400 ohm; a change of at most 30 %"));
    EXPECT_THAT(refusal([](ThresholdsNow& now) { now.impedance_ohm = 2300; }), HasSubstr("30 %"));
    EXPECT_THAT(refusal([](ThresholdsNow& now) { now.impedance_ohm = kNaN; }), HasSubstr("30 %"));
    EXPECT_THAT(refusal([](ThresholdsNow& now) { now.unit = LevelUnit::Intensity; }), HasSubstr("measured again"));
}

TEST(EarlierThresholds, WithAMassagerNoImpedanceIsAsked) {
    RecordProperty("hazard", "H6");
    auto rows = measured();
    rows.erase(rows.begin(), rows.begin() + 3);
    rows[1].body = {{"name", "range"}, {"usable", true}, {"min_intensity", 0.3}, {"max_intensity", 0.6}};
    const auto found = earlierThresholds(rows, LevelUnit::Intensity);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_FALSE(found->tooStrong);
    ThresholdsNow now;
    now.unit = LevelUnit::Intensity;
    EXPECT_FALSE(stillHold(*found, now));
    now.untouched = true;
    EXPECT_TRUE(stillHold(*found, now));
}

TEST(EarlierThresholds, AreOfTheLastSessionAlone) {
    RecordProperty("hazard", "H6");
    const auto sessionOf = [](const char* who, const char* protocol, StudySessionState state) {
        StudySession session;
        session.id = protocol;
        session.participant = who;
        session.protocol = protocol;
        session.state = state;
        return session;
    };
    const auto thresholds = sessionOf("a", "pilot-thresholds", StudySessionState::Complete);
    EXPECT_FALSE(thresholdsSession({}, "a"));
    EXPECT_FALSE(thresholdsSession({thresholds}, "b"));
    EXPECT_EQ(thresholdsSession({thresholds}, "a")->id, "pilot-thresholds");
    EXPECT_FALSE(thresholdsSession({sessionOf("a", "pilot-thresholds", StudySessionState::Stopped)}, "a"));
    auto later = sessionOf("a", "pilot-identification", StudySessionState::Complete);
    EXPECT_FALSE(thresholdsSession({thresholds, later}, "a")) << "its electrodes were others";
    later.opened = false;
    EXPECT_TRUE(thresholdsSession({thresholds, later}, "a")) << "its bench could not be opened";
    later.opened = true;
    later.participant = "b";
    EXPECT_TRUE(thresholdsSession({thresholds, later}, "a"));
}

}  // namespace
}  // namespace tacto
