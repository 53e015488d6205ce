// What the window takes from the store of calibrations: what counts, what does not, and why.
#include <fstream>
#include <gmock/gmock.h>

#include "app/gui/calibrate/CalibrationBook.h"
#include "app/gui/calibrate/CalibrationCard.h"
#include "app/gui/calibrate/CalibrationHistory.h"
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
    gui::BenchDesk desk{simulatedRegistry};
    gui::CalibrationBook book{desk};
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
