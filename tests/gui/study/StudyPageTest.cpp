// A study in the window: enrolled, consented, left, withdrawn, reported and exported, as a person does it.
#include <QComboBox>
#include <QFileDialog>
#include <QSpinBox>

#include "app/gui/theme/ConfirmButton.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/study/OpenedStudy.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class StudyPageTest : public StudyInThePage {
protected:
    void SetUp() override {
        make();
        open();
    }
    /// Returns the code as the dialog shows it.
    QString enrol(bool isVirtual, int seed = 1) {
        press("enrol");
        auto* asks = dialog("enrolDialog");
        if (asks == nullptr) return {};
        asks->findChild<QComboBox*>("enrolWho")->setCurrentIndex(isVirtual ? 1 : 0);
        asks->findChild<QSpinBox*>("enrolSeed")->setValue(seed);
        click(*asks->findChild<QPushButton*>("enrolNow"));
        const auto code = asks->findChild<QLabel*>("enrolledCode")->text();
        shot(*asks, "study-enrolled");
        EXPECT_EQ(faultsOf(*asks), "");
        asks->close();
        return code;
    }
    void consent(const QString& by) {
        press("consentOne");
        auto* asks = dialog("consentDialog");
        ASSERT_NE(asks, nullptr);
        asks->findChild<QLineEdit*>("by")->setText(by);
        shot(*asks, "study-consent");
        EXPECT_EQ(faultsOf(*asks), "");
        click(*asks->findChild<QPushButton*>("noteConsent"));
    }
    void pressWhenHeard(QPushButton& button) {
        ASSERT_IN_TIME(comesTrue([&] { return static_cast<gui::ConfirmButton&>(button).listens(); }));
        click(button);
    }
};

TEST_F(StudyPageTest, EnrolsConsentsAndSaysHowEachStands) {
    RecordProperty("hazard", "H11");
    const auto code = enrol(false);
    EXPECT_TRUE(checkedCode(code.toStdString())) << code.toStdString();
    ASSERT_EQ(page.findChild<QTableWidget*>("participants")->rowCount(), 1);
    EXPECT_EQ(cell("participants", 0, 0), code.toStdString());
    EXPECT_EQ(cell("participants", 0, 3), "takes part");
    EXPECT_EQ(cell("participants", 0, 5), "none yet");
    consent("");
    auto* asks = dialog("consentDialog");
    ASSERT_NE(asks, nullptr) << "without initials it is refused in place";
    EXPECT_THAT(asks->findChild<QLabel*>("consentTrouble")->text().toStdString(), HasSubstr("initials"));
    asks->close();
    QTest::qWait(20);
    consent("KL");
    EXPECT_THAT(cell("participants", 0, 5), HasSubstr("version 2, 20"));
    enrol(true, 7);
    EXPECT_EQ(cell("participants", 1, 1), "virtual, seed 7");
    EXPECT_THAT(page.findChild<QLabel*>("studyFacts")->text().toStdString(), HasSubstr("2 of 5 participants"));
    for (const int percent : {100, 200}) {
        gui::applyTextSize(percent);
        for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
            gui::applyTheme(theme);
            page.resize(percent == 100 ? QSize(1100, 560) : QSize(1160, 640));
            QTest::qWait(40);
            shot(page, QString("study-list-%1-%2").arg(theme == gui::Theme::Dark ? "dark" : "light").arg(percent));
            EXPECT_EQ(faultsOf(page), "") << percent;
            const auto* people = page.findChild<QTableWidget*>("participants");
            EXPECT_GE(people->columnWidth(0), people->fontMetrics().horizontalAdvance(code) + 8) << "a whole code";
        }
    }
    gui::applyTextSize(100);
    gui::applyTheme(gui::Theme::Light);
}

TEST_F(StudyPageTest, LeavingKeepsTheDataAndEndsThePart) {
    RecordProperty("hazard", "H11");
    const auto code = enrol(false);
    choose("leaveOne");
    auto* asks = dialog("leaveDialog");
    ASSERT_NE(asks, nullptr);
    shot(*asks, "study-leave");
    pressWhenHeard(*asks->findChild<QPushButton*>("endPart"));
    EXPECT_EQ(cell("participants", 0, 3), "has left; data kept");
    EXPECT_EQ(study.study()->find(code.toStdString())->state, ParticipantState::Left);
}

TEST_F(StudyPageTest, WithdrawingTakesTheCodeTypedAndSaysWhatItDoesNotReach) {
    RecordProperty("hazard", "H11");
    const auto code = enrol(false);
    const auto place = scratch.path() / "shared";
    study.exportBids(QString::fromStdString(place.string()));
    ASSERT_IN_TIME(comesTrue([this] { return study.study() != nullptr; }));
    choose("withdrawOne");
    auto* asks = dialog("withdrawDialog");
    ASSERT_NE(asks, nullptr);
    const auto says = [&](const char* name) { return asks->findChild<QLabel*>(name)->text().toStdString(); };
    EXPECT_THAT(says("withdrawCopies"), HasSubstr("copies of the key file, backups, and spare blocks"));
    EXPECT_THAT(says("withdrawExports"), HasSubstr(place.string()));
    auto* end = asks->findChild<QPushButton*>("endPart");
    EXPECT_FALSE(end->isEnabled());
    auto* typed = asks->findChild<QLineEdit*>("withdrawCode");
    QTest::keyClicks(typed, "P-7K3D");
    EXPECT_FALSE(end->isEnabled()) << "another's code";
    typed->clear();
    QTest::keyClicks(typed, code.toLower());
    shot(*asks, "study-withdraw");
    EXPECT_EQ(faultsOf(*asks), "");
    pressWhenHeard(*end);
    EXPECT_FALSE(study.study()->find(code.toStdString())) << "nothing knows the code any more";
    EXPECT_FALSE(page.findChild<QTableWidget*>("participants")->isVisible());
}

class StudyOfThisUser : public StudyInThePage {
protected:
    StudyOfThisUser() : StudyInThePage(false) {}
};

TEST_F(StudyOfThisUser, GetsAReportFromTheCommandLinesProgram) {
    RecordProperty("hazard", "H8");
    make();
    open();
    choose("committeeReport");
    QFileDialog* asks = nullptr;
    ASSERT_IN_TIME(comesTrue([&] {
        asks = page.findChild<QFileDialog*>();
        return asks != nullptr && asks->isVisible();
    }));
    const auto out = QString::fromStdString((scratch.path() / "committee.html").string());
    emit asks->fileSelected(out);
    asks->close();
    const auto* said = page.findChild<QLabel*>("studyTrouble");
    ASSERT_IN_TIME(
        comesTrue([&] { return said->text().contains("committee.html") || said->text().startsWith("⚠"); }, 30'000));
    EXPECT_TRUE(QFileInfo::exists(out)) << said->text().toStdString();
}

TEST_F(StudyPageTest, AnExportInsideTheStudyIsRefused) {
    RecordProperty("hazard", "H11");
    enrol(true);
    study.exportBids(folder() + "/shared");
    const auto* said = page.findChild<QLabel*>("studyTrouble");
    ASSERT_IN_TIME(comesTrue([&] { return said->text().startsWith("⚠"); }));
    EXPECT_THAT(said->text().toStdString(), HasSubstr("inside the study folder"));
    EXPECT_TRUE(study.study()->exports().empty());
}

}  // namespace
}  // namespace tacto::test
