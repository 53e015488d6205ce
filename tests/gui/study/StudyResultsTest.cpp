// The results of a study in the window: tables, figures, and where they are saved.
#include <QComboBox>
#include <QFileDialog>
#include <QListWidget>

#include "app/gui/runner/ResultTables.h"
#include "app/gui/sessions/SessionPreview.h"
#include "app/gui/study/StudyResults.h"
#include "core/analysis/identification/IdentificationJson.h"
#include "core/base/Csv.h"
#include "core/base/Random.h"
#include "core/sharing/results/StudyFigures.h"
#include "tests/gui/Person.h"
#include "tests/gui/study/OpenedStudy.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kNames = {"smooth-low", "smooth-high", "rough-low", "rough-high"};

/// Three people who had both encodings on four days.
StudyRecord recordOfThree() {
    Random random(16, "a study in the window");
    StudyRecord record;
    record.settings.encodings = {"standard", "swapped"};
    for (const char* code : {"P-7K3M", "P-AAAA", "P-B2C4"}) {
        ParticipantRecord one;
        one.about.code = code;
        for (int number = 1; number <= 4; ++number) {
            SessionRecord session;
            session.about.number = number;
            auto& results = session.results;
            results.number = std::size_t(number);
            results.days = 2.0 * number - 2;
            results.encoding = (number + int(record.participants.size())) % 2 == 0 ? "swapped" : "standard";
            results.labels = kNames;
            results.felt = 3;
            results.detection = 2.8 + 0.4 * random.uniform();
            results.detectionLow = results.detection - 0.4;
            results.detectionHigh = results.detection + 0.5;
            results.tooStrong = 9;
            results.saidTooStrong = true;
            results.low = Milliamps(3.5);
            results.high = Milliamps(7);
            for (std::size_t i = 0; i < 30; ++i) {
                BidsThresholdTrial trial;
                trial.procedure = "detection";
                trial.number = i + 1;
                trial.current = Milliamps(1.5 + 0.5 * double(random.below(6)));
                trial.correct = random.uniform() < (trial.current.value() > 2.6 ? 0.95 : 0.6);
                results.thresholds.push_back(trial);
            }
            for (std::size_t i = 0; i < 80; ++i) {
                BidsTrial row;
                row.trial.number = i + 1;
                row.trial.block = i / 16 + 1;
                row.trial.condition = kNames[i % 4];
                const double skill = results.encoding == "standard" ? 0.85 : 0.6;
                row.trial.response = kNames[random.uniform() < skill ? i % 4 : random.below(4)];
                row.trial.rt_s = 0.4 + 0.8 * random.uniform() * (i % 4 == 0 ? 2 : 1);
                results.trials.push_back(row);
            }
            for (std::size_t block = 2; block <= 5; ++block)
                results.drift.push_back({block, results.detection + 0.1 * double(block), false, results.detection - 0.3,
                                         results.detection + 0.9});
            one.sessions.push_back(std::move(session));
        }
        record.participants.push_back(std::move(one));
    }
    return record;
}

class StudyResultsTest : public StudyInThePage {
protected:
    void SetUp() override {
        make();
        open();
        press("studyResultsWanted");
        ASSERT_IN_TIME(comesTrue([this] { return results().isVisible(); }));
        const auto record = recordOfThree();
        gui::StudyShown shown;
        shown.parts.push_back(toJson(studyFigures(SessionBasis::Person, record).value()));
        shown.parts.back()["basis"] = "person";
        shown.figures = pilotFigures(record).value();
        results().show(shown);
    }
    [[nodiscard]] gui::StudyResults& results() { return *page.findChild<gui::StudyResults*>(); }
    [[nodiscard]] QListWidget& list() { return *results().findChild<QListWidget*>("resultsList"); }
    /// Chooses the first entry that contains `words`.
    void chooseFigure(const QString& words) {
        for (int row = 0; row < list().count(); ++row) {
            if (list().item(row)->text().contains(words)) return list().setCurrentRow(row);
        }
        FAIL() << words.toStdString();
    }
    [[nodiscard]] std::string said() { return results().findChild<QLabel*>("resultsSaid")->text().toStdString(); }
    /// Answers the file dialog with `path`.
    void answer(const QString& path) {
        QFileDialog* asks = nullptr;
        ASSERT_IN_TIME(comesTrue([&] {
            asks = page.findChild<QFileDialog*>();
            return asks != nullptr && asks->isVisible();
        }));
        emit asks->fileSelected(path);
        asks->close();
        letLive(20);
    }
};

TEST_F(StudyResultsTest, EveryFigureIsShownAndLooksRight) {
    RecordProperty("hazard", "H9");
    page.resize(1280, 720);
    EXPECT_FALSE(results().findChild<gui::ResultTables*>()->empty());
    looksRight(page, "study-results", {QSize(1280, 720), QSize(1920, 1080)});
    ASSERT_GT(list().count(), 20);
    for (const char* words :
         {"psychometric function", "trial by trial", "P-7K3M: answers over blocks", "P-7K3M: thresholds over sessions",
          "within sessions", "P-7K3M: answers over sessions", "response times of the test",
          "P-7K3M: response times over", "People: psychometric", "People: answers over blocks", "People: detection",
          "People: answers over sessions", "swapped against standard"}) {
        chooseFigure(words);
        EXPECT_TRUE(results().findChild<gui::SheetView*>()->isVisible()) << words;
    }
    looksRight(page, "study-results-encodings", {QSize(1280, 720), QSize(1920, 1080)});
    chooseFigure("psychometric function");
    looksRight(page, "study-results-function", {QSize(1280, 720), QSize(1920, 1080)});
    auto* sheet = results().findChild<gui::SheetView*>();
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        const auto drawn = sheet->grab().toImage();
        double darkest = 255, lightest = 0, mean = 0;
        for (int y = 0; y < drawn.height(); ++y) {
            for (int x = 0; x < drawn.width(); ++x) {
                const double light = QColor(drawn.pixel(x, y)).lightness();
                darkest = std::min(darkest, light);
                lightest = std::max(lightest, light);
                mean += light / (double(drawn.width()) * drawn.height());
            }
        }
        EXPECT_EQ(mean < 80, theme == gui::Theme::Dark) << mean;
        EXPECT_GT(lightest - darkest, 150) << "and its text stands out";
    }
    gui::applyTheme(gui::Theme::Light);
    click(*results().findChild<QPushButton*>("backFromResults"));
    EXPECT_TRUE(page.list().isVisible());
}

TEST_F(StudyResultsTest, TheBetterEncodingIsProposedForAnAmendmentOrAProfileAndNothingChangesUnasked) {
    RecordProperty("hazard", "H11");
    const auto before = study.study()->settings();
    auto* use = results().findChild<QPushButton*>("useBetter");
    auto part = nlohmann::json(toJson(studyFigures(SessionBasis::Person, recordOfThree()).value()));
    const auto showWith = [&](const nlohmann::json& better, const char* basis) {
        part["better"] = better;
        part["basis"] = basis;
        gui::StudyShown shown;
        shown.parts = {part};
        results().show(shown);
    };
    showWith(nullptr, "person");
    EXPECT_FALSE(use->isEnabled()) << "it is not decided";
    showWith("swapped", "virtual");
    EXPECT_FALSE(use->isEnabled()) << "a model decides nothing for people";
    showWith("swapped", "person");
    ASSERT_TRUE(use->isEnabled());
    click(*use);
    auto* asks = dialog("useEncodingDialog");
    ASSERT_NE(asks, nullptr);
    EXPECT_THAT(asks->findChild<QLabel*>("useEncodingFound")->text().toStdString(),
                HasSubstr(part["sentences"][0].get<std::string>()));
    looksRight(*asks, "study-use-encoding", {QSize(), QSize(1000, 680)});
    auto* where = asks->findChild<QComboBox*>("useEncodingWhere");
    ASSERT_EQ(where->count(), 2);
    where->setCurrentIndex(1);
    click(*asks->findChild<QPushButton*>("useEncodingNow"));
    const auto file = scratch.path() / "better.json";
    answer(QString::fromStdString(file.string()));
    ASSERT_IN_TIME(comesTrue([&] { return std::filesystem::exists(file); }));
    const auto profile = loadProfile(file.string());
    ASSERT_TRUE(profile) << profile.error().message;
    EXPECT_EQ(profile->encoding.assignment, Assignment::Swapped);
    auto back = *profile;
    back.encoding.assignment = study.profile().encoding.assignment;
    EXPECT_EQ(toJson(back), toJson(study.profile())) << "all else is the operator's";
    EXPECT_THAT(said(), HasSubstr("amendment"));
    EXPECT_EQ(study.study()->settings(), before);
    letLive(20);
    click(*use);
    asks = dialog("useEncodingDialog");
    ASSERT_NE(asks, nullptr);
    click(*asks->findChild<QPushButton*>("useEncodingNow"));
    auto* amends = dialog("amendDialog");
    ASSERT_NE(amends, nullptr);
    EXPECT_EQ(amends->findChild<QComboBox*>("encodings")->currentData().toString(), "swapped");
    auto* act = amends->findChild<QPushButton*>("amendNow");
    EXPECT_FALSE(act->isEnabled()) << "the committee's reference is the operator's to enter";
    EXPECT_EQ(study.study()->settings(), before);
    amends->findChild<QLineEdit*>("approval.reference")->setText("EC-2026-17 A1");
    ASSERT_TRUE(act->isEnabled());
    click(*act);
    EXPECT_EQ(study.study()->settings().encodings, std::vector<std::string>{"swapped"});
    EXPECT_EQ(study.study()->amendments().back().changed, std::vector<std::string>{"encodings"});
}

TEST_F(StudyResultsTest, FiguresAreSavedOutsideTheStudyAndTheStudyNotesIt) {
    RecordProperty("hazard", "H11");
    const auto out = scratch.path() / "figures";
    click(*results().findChild<QPushButton*>("saveFigures"));
    answer(QString::fromStdString(out.string()));
    ASSERT_IN_TIME(comesTrue([&] { return std::filesystem::exists(out / "P-7K3M-session-1-function.svg"); }));
    EXPECT_THAT(said(), HasSubstr(out.string()));
    EXPECT_THAT(readTextFile(out / "people-swapped-minus-standard.svg").value_or(""), HasSubstr("<svg"));
    ASSERT_EQ(study.study()->exports().size(), 1U);
    EXPECT_EQ(study.study()->exports().front().what, "figures");
    letLive(20);
    chooseFigure("trial by trial");
    click(*results().findChild<QPushButton*>("saveFigure"));
    answer(folder() + "/inside.svg");
    ASSERT_IN_TIME(comesTrue([&] { return said().find("inside the study folder") != std::string::npos; }));
    EXPECT_FALSE(std::filesystem::exists(folder().toStdString() + "/inside.svg"));
    EXPECT_EQ(study.study()->exports().size(), 1U);
}

}  // namespace
}  // namespace tacto::test
