// Tests what happened in a session, in sentences, and the picture of a session.
#include <QLabel>
#include <QRegularExpression>
#include <gmock/gmock.h>
#include <random>

#include "app/gui/sessions/SessionDetails.h"
#include "app/gui/sessions/SessionPreview.h"
#include "app/gui/sessions/SessionWords.h"
#include "app/gui/theme/Text.h"
#include "tests/gui/Person.h"
#include "tests/gui/sessions/WrittenSessions.h"

namespace tacto::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class Words : public testing::Test {
protected:
    [[nodiscard]] gui::ReadSession read(const WrittenSession& wanted) const {
        return gui::readSession(sessions.write(wanted)).value();
    }
    [[nodiscard]] static std::vector<std::string> sentences(const gui::ReadSession& session) {
        std::vector<std::string> all;
        for (const auto& moment : gui::whatHappened(session)) all.push_back(moment.text.toStdString());
        return all;
    }
    WrittenSessions sessions;
    const ShippedLimits limits_{};
};

TEST_F(Words, OfWhatHappenedAreSentencesWithoutIdsOrJson) {
    const auto session = read({.name = "a"});
    const auto all = sentences(session);
    EXPECT_EQ(all.front(), "Separability began, by A. Weber, on sample S-014, with simulated stimulator.");
    EXPECT_THAT(all, Contains("Mark: “table bumped”"));
    EXPECT_THAT(all, Contains("Armed."));
    EXPECT_THAT(all, Contains("A train was refused: RMS current, 5 s, would be 11.2 mA of 10 mA."));
    EXPECT_THAT(all, Contains("The encoding profile was changed. Encoding: A max."));
    EXPECT_THAT(all, Contains("A device reports: packets were lost (lost packets 3)."));
    EXPECT_THAT(all, Contains("100 trials done."));
    EXPECT_THAT(all, Contains("Verdict pass: 98 of 100 told apart."));
    EXPECT_EQ(all.back(), "Ended in order: 100 trials.");
    static const QRegularExpression machine("[{}_\\[\\]]");
    for (const auto& sentence : all) EXPECT_FALSE(gui::qtext(sentence).contains(machine)) << sentence;
    const auto moments = gui::whatHappened(session);
    const auto mark = std::ranges::find_if(moments, [](const auto& moment) { return moment.mark; });
    ASSERT_NE(mark, moments.end());
    EXPECT_EQ(mark->when, "0:12.3") << "at the moment of the key";
}

TEST_F(Words, OfAChangedProfileNameEachPartOfItOnce) {
    SessionRow event;
    event.name = "settings";
    event.body = {{"changed", {"encoding.ratio_per_train", "encoding.A_max_v", "roughness.surfaces"}}};
    EXPECT_EQ(gui::eventSentence(event),
              "The encoding profile was changed. Encoding: ratio per train, A max; roughness: surfaces.");
}

TEST_F(Words, OfAnEventThatIsUnknownAreItsValuesWithUnits) {
    SessionRow event;
    event.name = "something_new";
    event.body = {{"load_ohm", 1000.5}, {"peak_v", 12.25}, {"nested", {{"x", 1}}}};
    const auto sentence = gui::eventSentence(event).toStdString();
    EXPECT_THAT(sentence, HasSubstr("Something new: "));
    EXPECT_THAT(sentence, HasSubstr("12.25\u202fV"));
    EXPECT_THAT(sentence, Not(HasSubstr("{")));
}

TEST_F(Words, OfARepeatedEventStandOnceWithTheirCount) {
    auto session = read({.name = "a"});
    const auto refused =
        *std::ranges::find_if(session.events, [](const auto& event) { return event.name == "refused"; });
    session.events.assign(3, refused);
    const auto all = sentences(session);
    EXPECT_THAT(all, Contains("A train was refused: RMS current, 5 s, would be 11.2 mA of 10 mA. (3 times)"));
}

TEST_F(Words, OfEachCaptureAreItsLoadAndItsCommand) {
    RecordProperty("hazard", "H9");
    std::mt19937 random(4911);
    const auto whole = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    for (int round = 0; round < 6; ++round) {
        const auto path = sessions.folder() / fmt::format("captures-{}.tacto", round);
        VirtualClock clock;
        SessionAbout about;
        about.protocol = round % 2 == 0 ? "load-safety" : "live";
        about.mode = "bench load";
        about.wallStart = "2026-11-20T10:02:05Z";
        auto made = SessionWriter::create(path, about, clock);
        ASSERT_TRUE(made) << made.error().message;
        auto& session = **made;
        Capture capture;
        capture.rate_hz = 1e6;
        capture.channels = {{.name = "voltage", .unit = "V", .samples = std::vector<float>(8, 1.0F)}};
        std::vector<std::pair<std::string, std::string>> expected;  // load, command
        const auto delivers = [&](int volts, int ohms) {
            clock.advanceTo(clock.now() + toInstant(1));
            ASSERT_TRUE(session.command(clock.now(), "train", {{"amplitude_v", 99}}));  // asked for, not delivered
            ASSERT_TRUE(session.command(clock.now(), "delivered",
                                        {{"amplitude_v", volts}, {"interval_s", 0.5}, {"impedance_ohm", ohms}}));
        };
        for (int k = 0; k < 8; ++k) {
            const int volts = whole(1, 40), ohms = 100 * whole(1, 9);
            for (int train = whole(1, 3); train > 0; --train) delivers(volts, ohms);
            std::optional<int> trial;
            auto load = fmt::format("{}\u202fΩ, measured", ohms);
            if (about.protocol == "load-safety") {
                const auto number = session.trial(clock.now(), fmt::format("{} ohm, {:.1f} V", ohms, double(volts)),
                                                  {{"command_v", volts}});
                ASSERT_TRUE(number);
                trial = *number;
                load = fmt::format("{}\u00a0Ω", ohms);
            }
            const auto command = fmt::format("{}\u202fV every 500\u202fms", volts);
            for (int each = trial ? whole(1, 3) : 1; each > 0; --each) {
                ASSERT_TRUE(session.capture(clock.now(), capture, trial));
                expected.emplace_back(load, command);
            }
        }
        ASSERT_TRUE(session.close());
        const auto read = gui::readSession(path);
        ASSERT_TRUE(read) << read.error().message;
        ASSERT_EQ(read->captures.size(), expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k) {
            EXPECT_EQ(read->captures[k].load.toStdString(), expected[k].first) << about.protocol << ' ' << k;
            EXPECT_EQ(read->captures[k].command.toStdString(), expected[k].second) << about.protocol << ' ' << k;
        }
    }
}

TEST_F(Words, APageWithoutRowsSaysWhy) {
    gui::SessionDetails details{limits_};
    details.resize(700, 500);
    details.QWidget::show();
    const auto said = [&](int page) {
        details.setCurrentIndex(page);
        letLive(20);
        QStringList all;
        for (const auto* note : details.currentWidget()->findChildren<QLabel*>("whyEmpty"))
            if (note->isVisible()) all << note->text();
        return all.join(' ').toStdString();
    };
    constexpr int kTrials = 1, kStreams = 2, kCaptures = 3;
    for (const int page : {kTrials, kStreams, kCaptures}) EXPECT_THAT(said(page), HasSubstr("Choose a session"));
    details.show(std::make_shared<gui::ReadSession>(read({.name = "a"})));
    EXPECT_EQ(said(kTrials), "") << "it has trials";
    EXPECT_THAT(said(kStreams), HasSubstr("No stream: no fingertip was connected"));
    EXPECT_THAT(said(kCaptures), HasSubstr("No capture: no oscilloscope was connected"));
    auto live = read({.name = "b", .protocol = "", .verdict = ""});
    live.about.devices = {{"sim:oscilloscope", "oscilloscope", "simulated oscilloscope", "SIM-1", "1", true}};
    details.show(std::make_shared<gui::ReadSession>(live));
    EXPECT_THAT(said(kTrials), HasSubstr("No trial: it was driven live"));
    EXPECT_THAT(said(kCaptures), HasSubstr("was not triggered"));
    shot(details, "session-without-captures");
}

TEST_F(Words, APreviewIsTheMainPlot) {
    gui::SessionPreview preview;
    preview.resize(500, 320);
    preview.show(read({.name = "a"}));
    EXPECT_EQ(preview.title(), "Trials in the plane, 100 of 100");
    preview.show(read({.name = "b", .protocol = "", .verdict = ""}));
    EXPECT_EQ(preview.title(), "");
    EXPECT_NE(preview.findChild<QLabel*>("nothingToDraw"), nullptr);
    gui::ReadSession live;
    live.course = {{0, 1, 2}, {0.1, 0.2, 0.3}, {0.5, 0.5, 0.5}, {0.5, 1.5}, {10, 20}, "V", 1, 1};
    live.length = toInstant(2.0);
    live.events.push_back({1, toInstant(0.7), kOperatorMarkEvent, {{"text", "table bumped"}}});
    live.events.push_back({2, toInstant(0.8), "refused", {{"text", "no mark"}}});
    live.events.push_back({3, toInstant(1.2), kOperatorMarkEvent, {{"text", "lead off"}}});
    preview.QWidget::show();
    preview.show(live);
    EXPECT_EQ(preview.title(), "What was felt, and the trains that were delivered");
    EXPECT_EQ(preview.marks().words(), (QStringList{"table bumped", "lead off"}));
    shot(preview, "preview-live");
    preview.findChild<QCustomPlot*>("course")->xAxis->setRange(1, 2);
    EXPECT_EQ(preview.marks().words(), QStringList{"lead off"}) << "of the time that is shown";
    live.events.clear();
    preview.show(live);
    EXPECT_EQ(preview.marks().words(), QStringList());
}

}  // namespace
}  // namespace tacto::test
