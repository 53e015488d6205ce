// Tests how the window words the outcome of a session.
#include <QRegularExpression>
#include <QTableWidget>
#include <QTest>
#include <gtest/gtest.h>

#include "app/gui/pilot/PilotResult.h"
#include "app/gui/theme/RecordColumns.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

constexpr const char* kHeadline =
    "P-7K3M told the four apart in 68 of 80 trials (85 %, 95 % interval 76 to 91 %, chance 25 %) between 4.0 and "
    "6.5 mA, 14 to 22 V at 3.4 kΩ.";

nlohmann::json someResults() {
    return {{"participant", {{"code", "P-7K3M"}, {"virtual", true}}},
            {"labels", {"rough-high", "rough-low", "smooth-high", "smooth-low"}},
            {"columns", {"rough-high", "rough-low", "smooth-high", "smooth-low", "none", "not-sure"}},
            {"confusion", {{18, 2, 0, 0, 0, 0}, {3, 16, 0, 1, 0, 0}, {0, 0, 17, 3, 0, 0}, {0, 1, 2, 17, 0, 0}}},
            {"headline", kHeadline},
            {"p_chance", 1e-12},
            {"it_corrected_bits", 1.1},
            {"it_corrected_low_bits", 0.8},
            {"it_corrected_high_bits", 1.4},
            {"catch", {{"n", 10}, {"false_alarms", 0}}},
            {"blocks", {{{"block", 1}, {"n", 16}, {"hits", 13}}, {{"block", 2}, {"n", 16}, {"hits", 14}}}},
            {"range", {{"min_ma", 4.0}, {"max_ma", 6.5}, {"min_v", 13.6}, {"max_v", 22.1}, {"impedance_ohm", 3400}}}};
}

TEST(PilotResult, SaysFirstWhatEveryResultSaysFirst) {
    EXPECT_EQ(gui::resultSentence(someResults()).toStdString(), kHeadline);
    nlohmann::json thresholds{{"kind", "pilot-thresholds"},
                              {"modality", "massager"},
                              {"participant", {{"code", "P-7K3M"}}},
                              {"detection", {{"estimate_intensity", {{"value", 0.22}, {"low", 0.2}, {"high", 0.25}}}}},
                              {"range", {{"min_intensity", 0.3}, {"max_intensity", 0.55}}}};
    auto felt = gui::resultSentence(thresholds);
    felt.replace(QChar(0x202F), ' ');
    EXPECT_EQ(felt.toStdString(),
              "P-7K3M feels a strength of 0.22 in 4 of 5 trials (95 % interval 0.20 to 0.25); conditions lie between "
              "strengths of 0.30 and 0.55.");
    thresholds["detection"]["at_edge"] = true;
    thresholds["comparison"] = {{"at_edge", true}, {"amplitude_weber", {{"value", 0.97}, {"low", 0.8}, {"high", 1}}}};
    felt = gui::resultSentence(thresholds);
    felt.replace(QChar(0x202F), ' ');
    EXPECT_EQ(
        felt.toStdString(),
        "P-7K3M feels a strength of 0.22 in 4 of 5 trials (95 % interval 0.20 to 0.25), or beyond; conditions lie "
        "between strengths of 0.30 and 0.55. The Weber fraction of strength is 0.97 (95 % interval 0.80 to 1.00), "
        "or beyond.");
    EXPECT_TRUE(gui::resultSentence(nlohmann::json::object()).isEmpty());
    EXPECT_TRUE(gui::resultSentence(nullptr).isEmpty());
}

TEST(PilotResult, SaysTheHeadlineOnceWhateverItIs) {
    for (const char* headline : {kHeadline, "P-7K3M answered no test trial."}) {
        RunResult run;
        auto results = someResults();
        results["headline"] = headline;
        run.outcome.results = results;
        run.outcome.reasons = {"No usable range: too narrow", headline};
        gui::PilotResult view;
        view.show(run, "/home/lab/rehearsal-1");
        auto said = view.findChild<QLabel*>("pilotHeadline")->text();
        EXPECT_EQ(said.replace(QChar(0x202F), ' ').toStdString(), headline);
        const auto why = view.findChild<QLabel*>("pilotReason")->text().toStdString();
        EXPECT_EQ(why.find(headline), std::string::npos) << why;
        EXPECT_NE(why.find("No usable range"), std::string::npos) << why;
    }
}

TEST(PilotResult, ShowsNothingOfATestThatWasNotReached) {
    RunResult run;
    auto results = someResults();
    results["n"] = 0;
    results["p_chance"] = 1.0;
    for (auto& row : results["confusion"])
        for (auto& count : row) count = 0;
    run.outcome.results = results;
    gui::PilotResult view;
    view.show(run, "/home/lab/rehearsal-1");
    const auto* matrix = view.findChild<QTableWidget*>("confusion");
    EXPECT_TRUE(matrix->isHidden());
    for (const auto* label : view.findChildren<QLabel*>()) {
        const auto said = label->isHidden() ? std::string() : label->text().toStdString();
        for (const char* word : {"Guessing", "Information", "Stimulus"})
            EXPECT_EQ(said.find(word), std::string::npos) << said;
    }
    run.outcome.results = someResults();
    view.show(run, "/home/lab/rehearsal-1");
    EXPECT_FALSE(matrix->isHidden());
}

TEST(PilotResult, ShowsTheMatrixAndLooksRight) {
    RunResult run;
    run.outcome.results = someResults();
    run.simulated = true;
    gui::PilotResult view;
    view.show(run, "/home/lab/rehearsal-1");
    static_cast<QWidget&>(view).show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&view));
    looksRight(view, "pilot-result", {QSize(1000, 720), QSize(1200, 900)});
    const auto* matrix = view.findChild<QTableWidget*>("confusion");
    ASSERT_EQ(matrix->rowCount(), 4);
    ASSERT_EQ(matrix->columnCount(), 7);
    EXPECT_EQ(matrix->horizontalHeaderItem(1)->text(), "rough,\nfirm");
    EXPECT_EQ(matrix->item(1, 0)->text(), "rough, light");
    EXPECT_EQ(matrix->item(1, 1)->text(), "3");
    EXPECT_EQ(matrix->item(1, 2)->text(), "16");
}

TEST(PilotResult, AnEarlyEndSaysWhyAndOffersToGoOn) {
    RunResult run;
    run.outcome.error = Error{ErrorCode::Stopped, "the operator stopped"};
    gui::PilotResult view;
    view.show(run, "/home/lab/rehearsal-1");
    static_cast<QWidget&>(view).show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&view));
    const auto* goOn = view.findChild<QPushButton*>("goOnWithSession");
    EXPECT_FALSE(goOn->isVisible()) << "it would begin another one";
    view.setMayGoOn(true);
    EXPECT_TRUE(goOn->isVisible());
    EXPECT_FALSE(view.findChild<QTableWidget*>("confusion")->isVisible());
}

RunResult withResults(nlohmann::json results) {
    RunResult run;
    run.outcome.results = std::move(results);
    return run;
}

RunResult endedBy(ErrorCode code, const char* why, nlohmann::json results = nullptr) {
    auto run = withResults(std::move(results));
    run.outcome.error = Error{code, why};
    return run;
}

/// All pages: for each kind of result and each way to end.
std::vector<std::pair<const char*, RunResult>> allPages() {
    auto massager = someResults();
    massager["modality"] = "massager";
    massager["range"] = {{"min_intensity", 0.3}, {"max_intensity", 0.55}};
    massager["vibration"] = {{"reasons", {"the motor moved in 70 of 70 presentations"}}};
    auto two = someResults();
    two["labels"] = {"rough-high", "smooth-low"};
    two["columns"] = {"rough-high", "smooth-low", "none", "not-sure"};
    two["confusion"] = {{18, 2, 0, 0}, {3, 16, 0, 1}};
    auto odd = someResults();
    odd["confusion"] = {{18, 2}, nullptr, "x", {nullptr, 1, 2, 3, 4, 5, 6, 7}};
    const nlohmann::json thresholds{{"kind", "pilot-thresholds"},
                                    {"participant", {{"code", "P-7K3M"}}},
                                    {"detection", {{"estimate_ma", {{"value", 4.1}, {"low", 3.9}, {"high", 4.4}}}}},
                                    {"range", {{"min_ma", 4.0}, {"max_ma", 6.5}}}};
    auto none = thresholds;
    none["range"] = {{"usable", false}, {"reason", "too narrow"}};
    return {{"identification", withResults(someResults())},
            {"identification with a massager", withResults(massager)},
            {"two labels", withResults(two)},
            {"rows that are none", withResults(odd)},
            {"thresholds", withResults(thresholds)},
            {"no usable range", withResults(none)},
            {"nothing", withResults(nullptr)},
            {"the operator's STOP", endedBy(ErrorCode::Stopped, "the operator stopped")},
            {"a fault", endedBy(ErrorCode::Device, "the stimulator does not answer")},
            {"a fault with results", endedBy(ErrorCode::Device, "the stimulator is gone", someResults())}};
}

// Regression: the operator's STOP ended the program if a session with a matrix had been shown before.
TEST(PilotResult, EveryPageIsShownAfterEveryOther) {
    RecordProperty("hazard", "H2");
    const auto pages = allPages();
    gui::PilotResult view;
    static_cast<QWidget&>(view).show();
    ASSERT_IN_TIME(QTest::qWaitForWindowExposed(&view));
    const auto* matrix = view.findChild<QTableWidget*>("confusion");
    int width = 900;
    const auto look = [&](const std::pair<const char*, RunResult>& page, bool ofStudy) {
        view.show(page.second, "/home/lab/study-1", ofStudy);
        view.resize(width = width == 900 ? 700 : 900, 700);  // another size, so that the page is laid out again
        QCoreApplication::sendPostedEvents();
        view.grab();
        const auto& labels = memberAt(page.second.outcome.results, "labels");
        EXPECT_EQ(matrix->isVisible(), labels.is_array()) << page.first;
        EXPECT_EQ(std::size_t(matrix->rowCount()), labels.is_array() ? labels.size() : 0U) << page.first;
        EXPECT_FALSE(view.findChild<QLabel*>("pilotHeadline")->text().isEmpty()) << page.first;
    };
    for (const auto& first : pages) {
        for (const auto& then : pages) {
            SCOPED_TRACE(std::string(first.first) + ", then " + then.first);
            look(first, false);
            look(then, true);
        }
    }
}

}  // namespace
}  // namespace tacto::test
