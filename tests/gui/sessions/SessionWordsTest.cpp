// Tests sessions in sentences (what happened, and what differs between two) and the picture of a session.
#include <QLabel>
#include <QRegularExpression>
#include <gmock/gmock.h>

#include "app/gui/sessions/Differences.h"
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
    [[nodiscard]] static std::vector<std::string> between(const gui::ReadSession& a, const gui::ReadSession& b) {
        std::vector<std::string> all;
        for (const auto& difference : gui::differencesOf(a, b)) all.push_back(difference.sentence.toStdString());
        return all;
    }
    WrittenSessions sessions;
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

TEST_F(Words, OfWhatDiffersAreSentencesWithNumbers) {
    const auto first = read({.name = "a"});
    auto second = read({.name = "b", .verdict = "fail", .amplitude_v = 40.2});
    second.about.devices[0].uri = "sim:stimulator?gain=1.05";
    second.about.profileJson = R"({"encoding": {"A_max_v": 38}})";
    second.about.parameters = {{"repeats", 40}};
    const auto all = between(first, second);
    EXPECT_THAT(all, Contains("The second ended with fail where the first ended with pass."));
    EXPECT_THAT(all,
                Contains("Rough-high: the second delivered 40.20\u202fV where the first delivered 39.80\u202fV (means "
                         "of 25 and 25 trials)."));
    EXPECT_THAT(all, Not(Contains(HasSubstr("Smooth-low")))) << "what is the same is not said";
    EXPECT_THAT(all, Contains(HasSubstr("gain=1.05")));
    EXPECT_THAT(all, Contains(HasSubstr("40 in the second, 25 in the first")));
    EXPECT_THAT(all, Contains(HasSubstr("38.00\u202fV in the second where the first has 40.00\u202fV")));
    EXPECT_THAT(all, Contains(HasSubstr("Accuracy: 0.71")));
    EXPECT_TRUE(between(first, first).empty());
}

TEST_F(Words, OfConditionsThatOnlyOneHasAreNamedWhileTheyAreFew) {
    const auto first = read({.name = "a"});
    auto second = read({.name = "b", .protocol = "load-safety", .verdict = ""});
    second.trials = {
        {1, 1, Instant(1), "10 kohm", {}}, {2, 2, Instant(2), "1 kohm", {}}, {3, 3, Instant(3), "1 kohm", {}}};
    auto all = between(first, second);
    EXPECT_THAT(all, Contains("10 kΩ: 1 trial in the second, none in the first."));
    EXPECT_THAT(all, Contains("1 kΩ: 2 trials in the second, none in the first."));
    EXPECT_THAT(all, Contains("Rough-high: 25 trials in the first, none in the second."));
    for (int load = 1; load < 20; ++load) second.trials.push_back({3, 3, Instant(3), fmt::format("{} ohm", load), {}});
    all = between(first, second);
    EXPECT_THAT(all, Contains("21 conditions of the second are not in the first."));
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
    live.course = {{0, 1, 2}, {0.1, 0.2, 0.3}, {0.5, 0.5, 0.5}, {0.5, 1.5}, {10, 20}, "V"};
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
