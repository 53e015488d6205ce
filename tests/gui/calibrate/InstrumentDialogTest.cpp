// Tests instruments stored by name: saved once, chosen in place; an expired one is marked and not used.
#include <QCalendarWidget>
#include <QLineEdit>
#include <QMenu>
#include <QTest>
#include <QToolButton>
#include <gmock/gmock.h>

#include "app/gui/calibrate/InstrumentDialog.h"
#include "app/gui/theme/Theme.h"
#include "tests/gui/Looks.h"
#include "tests/gui/calibrate/CalibrationLab.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class InstrumentWindow : public testing::Test {
protected:
    void showDialog() {
        dialog = std::make_unique<gui::InstrumentDialog>(nullptr);
        QObject::connect(dialog.get(), &gui::InstrumentDialog::chosen,
                         [this](const QString& address) { used = address; });
        dialog->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(dialog.get()));
    }
    template <class T>
    [[nodiscard]] T& the(const char* name) {
        return *dialog->findChild<T*>(name);
    }
    void write(const char* field, const QString& text) { the<QLineEdit>(field).setText(text); }
    [[nodiscard]] std::string says(const char* label) { return the<QLabel>(label).text().toStdString(); }
    static void keep(const InstrumentPreset& preset) {
        ASSERT_TRUE(InstrumentPresets::open(instrumentFile()).value().save(preset));
    }
    static InstrumentPreset scope() {
        return {InstrumentKind::Oscilloscope, "bench DS2072A", "DS2D1", "sigrok:rigol-ds:conn=x", {}, 2.0, 50.0, {}};
    }
    static InstrumentPreset shunt(int dueIn) {
        return {InstrumentKind::Shunt, "R100", "R7", "", 100.0, 0.1, {}, daysFromNow(dueIn)};
    }
    OwnDataHome home;
    QString used;
    std::unique_ptr<gui::InstrumentDialog> dialog;
};

TEST_F(InstrumentWindow, SavesOnceAndChoosesInPlace) {
    showDialog();
    EXPECT_FALSE(the<QPushButton>("useInstruments").isEnabled());
    write("presetName", "bench DS2072A");
    write("presetAddress", "sigrok:rigol-ds:conn=x");
    write("presetAccuracy", "2");
    ASSERT_TRUE(the<QPushButton>("savePreset").isEnabled()) << says("presetTrouble");
    click(the<QPushButton>("savePreset"));
    EXPECT_THAT(says("presetTrouble"), HasSubstr("is saved and chosen"));
    EXPECT_EQ(says("instrumentAddress"), "sigrok:rigol-ds:conn=x?gain_pct=2");
    EXPECT_THAT(says("instrumentSays"), HasSubstr("currents have no uncertainty"));
    showDialog();  // as on another day
    the<QComboBox>("oscilloscope").setCurrentIndex(1);
    click(the<QPushButton>("useInstruments"));
    EXPECT_EQ(used, "sigrok:rigol-ds:conn=x?gain_pct=2");
}

TEST_F(InstrumentWindow, AProbeSavedHereStatesTheVoltagesUncertainty) {
    keep(scope());
    keep(shunt(10));
    showDialog();
    the<QComboBox>("oscilloscope").setCurrentIndex(1);
    the<QComboBox>("shunt").setCurrentIndex(1);
    EXPECT_THAT(says("instrumentSays"), HasSubstr("voltages have no uncertainty"));
    the<QComboBox>("presetKind").setCurrentIndex(2);
    for (const char* field : {"presetAddress", "presetOhms", "presetTimeBase"})
        EXPECT_FALSE(the<QLineEdit>(field).isVisible()) << field;
    write("presetName", "TPP0250");
    write("presetAccuracy", "60");
    EXPECT_THAT(says("presetTrouble"), HasSubstr("60"));
    EXPECT_FALSE(the<QPushButton>("savePreset").isEnabled());
    write("presetAccuracy", "1.5");
    click(the<QPushButton>("savePreset"));
    EXPECT_THAT(says("presetTrouble"), HasSubstr("TPP0250 is saved and chosen")) << "for what follows";
    EXPECT_EQ(the<QComboBox>("probe").currentText(), "TPP0250 (data sheet)");
    EXPECT_THAT(says("instrumentAddress"), HasSubstr("probe_pct=1.5"));
    EXPECT_EQ(says("instrumentSays"), "Everything that an uncertainty needs is stated.");
    click(the<QPushButton>("useInstruments"));
    EXPECT_EQ(used.toStdString(), says("instrumentAddress"));
}

TEST_F(InstrumentWindow, TakesTheDayOfItsCertificateFromACalendar) {
    showDialog();
    the<QComboBox>("presetKind").setCurrentIndex(1);
    write("presetName", "R50");
    write("presetOhms", "50");
    auto* menu = the<QToolButton>("calendar-presetDue").menu();
    emit menu->aboutToShow();
    emit menu->findChild<QCalendarWidget*>()->clicked(QDate::currentDate().addDays(30));
    EXPECT_EQ(the<QLineEdit>("presetDue").text(), QDate::currentDate().addDays(30).toString(Qt::ISODate));
    click(the<QPushButton>("savePreset"));
    const auto all = InstrumentPresets::open(instrumentFile()).value().all();
    ASSERT_EQ(all.size(), 1U) << says("presetTrouble");
    EXPECT_EQ(dateText(*all[0].due), QDate::currentDate().addDays(30).toString(Qt::ISODate).toStdString());
}

TEST_F(InstrumentWindow, AnExpiredOneSaysSoAndIsNotUsed) {
    RecordProperty("hazard", "H9");
    keep(scope());
    keep(shunt(-1));
    showDialog();
    the<QComboBox>("oscilloscope").setCurrentIndex(1);
    the<QComboBox>("shunt").setCurrentIndex(1);
    EXPECT_THAT(the<QComboBox>("shunt").currentText().toStdString(), HasSubstr("⚠ R100 (certificate expired"));
    EXPECT_THAT(says("instrumentSays"),
                HasSubstr("expired on " + dateText(daysFromNow(-1)) + ": its tolerance is not used"));
    EXPECT_THAT(says("instrumentAddress"), testing::Not(HasSubstr("shunt_pct")));
    keep(shunt(0));
    showDialog();
    the<QComboBox>("oscilloscope").setCurrentIndex(1);
    the<QComboBox>("shunt").setCurrentIndex(1);
    EXPECT_THAT(says("instrumentAddress"), HasSubstr("shunt_pct=0.1"));
}

TEST_F(InstrumentWindow, RefusesInPlaceAndRemoves) {
    keep(shunt(10));
    showDialog();
    the<QComboBox>("presetKind").setCurrentIndex(1);
    EXPECT_FALSE(the<QLineEdit>("presetAddress").isVisible());
    write("presetName", "R50");
    write("presetOhms", "zero");
    EXPECT_THAT(says("presetTrouble"), HasSubstr("\"zero\""));
    EXPECT_FALSE(the<QPushButton>("savePreset").isEnabled());
    write("presetOhms", "50");
    write("presetDue", "2027-02-30");
    EXPECT_THAT(says("presetTrouble"), HasSubstr("2027-02-30"));
    EXPECT_FALSE(the<QPushButton>("removePreset").isEnabled());
    write("presetName", "R100");
    click(the<QPushButton>("removePreset"));
    EXPECT_TRUE(InstrumentPresets::open(instrumentFile()).value().all().empty());
}

TEST_F(InstrumentWindow, LooksRightInBothThemes) {
    keep(scope());
    keep(shunt(-40));
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        showDialog();
        the<QComboBox>("oscilloscope").setCurrentIndex(1);
        the<QComboBox>("shunt").setCurrentIndex(1);
        QCoreApplication::processEvents();
        dialog->adjustSize();
        shot(*dialog, theme == gui::Theme::Dark ? "instruments-dark" : "instruments-light");
        EXPECT_EQ(faultsOf(*dialog), "");
    }
}

}  // namespace
}  // namespace tacto::test
