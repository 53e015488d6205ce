// Tests which calibrations from the store the window accepts, which it rejects, and why.
#include <fstream>
#include <gmock/gmock.h>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/calibrate/CalibrationCard.h"
#include "app/gui/calibrate/CalibrationHistory.h"
#include "app/gui/calibrate/CalibrationTrendView.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/calibrate/CalibrationLab.h"

namespace tacto::test {
namespace {

using gui::CalibrationState;
using testing::HasSubstr;

class Book : public testing::Test {
protected:
    [[nodiscard]] gui::CalibrationStanding standing(bool simulated = true) {
        book.read();
        return book.standing({"SIM-1", "simulated stimulator", "V", simulated});
    }
    static std::string says(const gui::CalibrationStanding& of) { return gui::standingText(of).toStdString(); }
    OwnDataHome home;
    gui::BenchController controller{simulatedRegistry};
    gui::CalibrationBook book{controller};
};

TEST_F(Book, NeverCalibratedSaysSoAndWhatToDo) {
    RecordProperty("hazard", "H1");
    const auto found = standing();
    EXPECT_EQ(found.state, CalibrationState::Never);
    EXPECT_EQ(says(found), "not calibrated");
    EXPECT_THAT(gui::standingTip(found).toStdString(), HasSubstr("bench loads only"));
}

TEST_F(Book, AgeAndLastDayAreTold) {
    store(calibration(12, 100));
    const auto found = standing();
    EXPECT_EQ(found.state, CalibrationState::Valid);
    EXPECT_EQ(says(found), "calibrated 12 d ago, until " + dateText(daysFromNow(88)));
    store(calibration(0, 1));
    EXPECT_EQ(says(standing()), "calibrated today, until " + dateText(daysFromNow(1)));
}

TEST_F(Book, TheLastDayCountsAndTheNextDoesNot) {
    RecordProperty("hazard", "H1");
    store(calibration(30, 30));
    EXPECT_EQ(standing().state, CalibrationState::Valid);
    store(calibration(30, 29));
    const auto found = standing();
    EXPECT_EQ(found.state, CalibrationState::Expired);
    EXPECT_EQ(says(found), "calibration expired 1 d ago");
    EXPECT_THAT(found.why.toStdString(), HasSubstr("a newer one is expected"));
}

TEST_F(Book, ASimulatedOneDoesNotCountForHardware) {
    RecordProperty("hazard", "H9");
    store(calibration(1, 100));
    const auto found = standing(false);
    EXPECT_EQ(found.state, CalibrationState::OfSimulation);
    EXPECT_EQ(says(found), "not calibrated");
    EXPECT_THAT(found.why.toStdString(), HasSubstr("simulated bench only"));
}

TEST_F(Book, ADamagedStoreIsNotCalibrated) {
    RecordProperty("hazard", "H9");
    store(calibration(1, 100));
    std::fstream file(calibrationFile());
    file.seekp(30);
    file << "x";
    file.close();
    const auto found = standing();
    EXPECT_EQ(found.state, CalibrationState::Unreadable);
    EXPECT_EQ(says(found), "calibration not readable");
    EXPECT_THAT(found.why.toStdString(), HasSubstr("calibrations.jsonl"));
}

TEST_F(Book, AnotherUnitIsAnotherCalibration) {
    RecordProperty("hazard", "H1");
    store(calibration(1, 100));
    book.read();
    EXPECT_EQ(book.standing({"SIM-1", "", "mA", true}).state, CalibrationState::Never);
    EXPECT_EQ(book.standing({"", "", "V", true}).state, CalibrationState::NoSerial);
    EXPECT_EQ(book.standing({"SIM-1", "", "", true}).state, CalibrationState::Valid);
}

TEST_F(Book, TheListKeepsWhatWasSuperseded) {
    store(calibration(400, 365));
    store(calibration(12, 365));
    book.read();
    gui::CalibrationHistory history;
    history.resize(900, 200);
    history.list(book, gui::StimulatorId{"SIM-1", "", "V", true});
    history.show();
    auto* table = history.findChild<QTableWidget*>("calibrationHistory");
    ASSERT_EQ(table->rowCount(), 2);
    EXPECT_THAT(table->item(0, 0)->text().toStdString(), HasSubstr("counts"));
    EXPECT_THAT(table->item(1, 0)->text().toStdString(), HasSubstr("superseded"));
    EXPECT_EQ(table->item(1, 1)->text().toStdString(), dateText(daysFromNow(-400)));
    shot(history, "calibrate_history");
    history.list(book, gui::StimulatorId{"other", "", "V", true});
    EXPECT_TRUE(table->isHidden());
    EXPECT_THAT(history.findChild<QLabel*>("historyEmpty")->text().toStdString(), HasSubstr("never calibrated"));
}

class Trend : public Book {
protected:
    void keep(int daysAgo, double gain, double offset, double u_pct, int validFor = 365) {
        auto one = calibration(daysAgo, validFor);
        one.amplitude = {{gain, offset, 10, 40}, u_pct};
        store(one);
    }
    void list() {
        book.read();
        history.resize(1000, 560);
        history.list(book, gui::StimulatorId{"SIM-1", "", "V", true});
        history.show();
        QCoreApplication::processEvents();
    }
    [[nodiscard]] std::string words(const char* label) {
        return history.findChild<QLabel*>(label)->text().replace(QChar(0x202f), ' ').toStdString();
    }
    gui::CalibrationHistory history;
};

TEST_F(Trend, SaysWhatMovedAndWhenTheNextIsDue) {
    RecordProperty("hazard", "H1");
    keep(700, 1.0010, -0.02, 0.8);
    keep(360, 1.0030, -0.03, 0.7);
    list();
    EXPECT_THAT(words("trendWarns"), HasSubstr("No change from one to the next is larger"));
    EXPECT_THAT(words("trendSays"), HasSubstr("due on " + dateText(daysFromNow(5)) + ", in 5 day"));
    keep(12, 1.0420, -0.05, 0.8);
    list();
    EXPECT_THAT(words("trendWarns"), HasSubstr("the gain moved by +3.9 %; both U together explain 1.1 %"));
    EXPECT_THAT(words("trendWarns"), HasSubstr(dateText(daysFromNow(-12))));
    EXPECT_THAT(words("trendWarns"), HasSubstr("Find the cause"));
    auto* trend = history.findChild<gui::CalibrationTrendView*>();
    EXPECT_EQ(trend->points().size(), 3U);
    auto* quantity = history.findChild<QComboBox*>("trendQuantity");
    EXPECT_EQ(quantity->count(), 4);
    quantity->setCurrentIndex(2);
    EXPECT_THAT(words("trendWarns"), HasSubstr("No change")) << "the widths did not move";
    quantity->setCurrentIndex(0);
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        QCoreApplication::processEvents();
        shot(history, theme == gui::Theme::Dark ? "trend-dark" : "trend-light");
        EXPECT_EQ(cutTexts(history).join(", ").toStdString(), "");
    }
    history.resize(1600, 800);
    QCoreApplication::processEvents();
    shot(history, "trend-wide");
}

TEST_F(Trend, OneIsNoTrendAndWhatIsOverdueSaysSo) {
    RecordProperty("hazard", "H1");
    keep(40, 1.001, -0.02, 0.8, 37);
    list();
    EXPECT_THAT(words("trendSays"), HasSubstr("was due on " + dateText(daysFromNow(-3)) + ", 3 day"));
    EXPECT_THAT(words("trendWarns"), HasSubstr("One calibration so far"));
    shot(history, "trend-overdue");
}

TEST_F(Book, TheCardTellsWhatItRestsOn) {
    store(calibration(12, 365));
    gui::CalibrationCard card(book);
    card.setReady(true);
    card.resize(760, card.sizeHint().height());
    card.show();
    EXPECT_THAT(card.findChild<QLabel*>("calibrationState")->text().toStdString(), HasSubstr("✔ calibrated 12 d ago"));
    const auto facts = card.findChild<QLabel*>("calibrationFacts")->text().toStdString();
    for (const char* part : {"1.0123", "oscilloscope X O-7", "its own calibration due", "simulated"})
        EXPECT_THAT(facts, HasSubstr(part));
    EXPECT_TRUE(card.findChild<QPushButton*>("checkButton")->isEnabled());
    store(calibration(40, 30));
    book.read();
    EXPECT_THAT(card.findChild<QLabel*>("calibrationState")->text().toStdString(), HasSubstr("⚠ calibration expired"));
    EXPECT_FALSE(card.findChild<QPushButton*>("checkButton")->isEnabled());
}

}  // namespace
}  // namespace tacto::test
