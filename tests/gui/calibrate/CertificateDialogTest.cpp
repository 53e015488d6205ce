// Tests the dialog for oscilloscope certificates: entering, refusing in place, marking expired ones, withdrawing.
#include <QAbstractItemView>
#include <QCalendarWidget>
#include <QFileDialog>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QScrollBar>
#include <QTableWidget>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <gmock/gmock.h>

#include "app/gui/calibrate/CertificateDialog.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Theme.h"
#include "tests/exchange/dcc/DccText.h"
#include "tests/gui/Looks.h"
#include "tests/gui/Person.h"
#include "tests/gui/calibrate/CalibrationLab.h"
#include "tests/support/InTime.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class CertificateWindow : public testing::Test {
protected:
    void showDialog() {
        dialog = std::make_unique<gui::CertificateDialog>(controller, nullptr);
        dialog->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(dialog.get()));
    }
    void write(const char* field, const QString& text) {
        auto* edit = dialog->findChild<QLineEdit*>(field);
        ASSERT_NE(edit, nullptr) << field;
        edit->setText(text);
    }
    void writeAll(const char* number, int date, int due) {
        write("instrument", "Rigol DS1054Z");
        write("serial", "DS1ZA1");
        write("number", number);
        write("by", "DAkkS Lab");
        write("date", QString::fromStdString(dateText(daysFromNow(date))));
        write("due", QString::fromStdString(dateText(daysFromNow(due))));
        write("gain-u", "0.5");
    }
    /// Reads a digital certificate by the file chooser.
    void read(const DccText& dcc) {
        const ScratchDir folder;
        const auto file = folder.write("certificate.xml", dcc.text());
        click(*dialog->findChild<QPushButton*>("readCertificate"));
        auto* chooser = dialog->findChild<QFileDialog*>("fileChooser");
        ASSERT_NE(chooser, nullptr);
        chooser->selectFile(QString::fromStdString(file.string()));
        QMetaObject::invokeMethod(chooser, "accept");
        delete chooser;
    }
    [[nodiscard]] QPushButton& enter() { return *dialog->findChild<QPushButton*>("enterCertificate"); }
    [[nodiscard]] QTableWidget& table() { return *dialog->findChild<QTableWidget*>("certificates"); }
    [[nodiscard]] std::string says() { return dialog->findChild<QLabel*>("certificateSays")->text().toStdString(); }
    [[nodiscard]] static CertificateStore kept() { return CertificateStore::open(certificateFile()).value(); }

    OwnDataHome home;
    gui::BenchController controller{simulatedRegistry};
    std::unique_ptr<gui::CertificateDialog> dialog;
};

TEST_F(CertificateWindow, EntersWhatIsComplete) {
    showDialog();
    EXPECT_FALSE(enter().isEnabled());
    writeAll("4711", -10, 355);
    ASSERT_TRUE(enter().isEnabled()) << says();
    write("probe-u", "1");
    click(enter());
    ASSERT_EQ(kept().all().size(), 1U);
    const auto one = kept().all()[0].certificate;  // a copy: kept() is gone after it
    EXPECT_EQ(one.number, "4711");
    EXPECT_EQ(one.gain_pct, 0.5);
    EXPECT_EQ(one.probe_pct, 1.0);
    EXPECT_FALSE(one.shunt_pct || one.timeBase_ppm);  // empty fields: not stated
    ASSERT_EQ(table().rowCount(), 1);
    EXPECT_THAT(table().item(0, 0)->text().toStdString(), HasSubstr("in use"));
    EXPECT_FALSE(enter().isEnabled());  // the next certificate needs another number
}

TEST_F(CertificateWindow, TakesItsDaysFromACalendar) {
    showDialog();
    writeAll("4711", -10, 355);
    for (const auto* field : {"date", "due"}) {
        auto* button = dialog->findChild<QToolButton*>(QString("calendar-%1").arg(field));
        ASSERT_NE(button, nullptr) << field;
        emit button->menu()->aboutToShow();
        auto* calendar = button->menu()->findChild<QCalendarWidget*>();
        ASSERT_NE(calendar, nullptr);
        auto* line = dialog->findChild<QLineEdit*>(field);
        EXPECT_EQ(calendar->selectedDate(), QDate::fromString(line->text(), Qt::ISODate))
            << "begins at what stands there";
        emit calendar->clicked(calendar->selectedDate().addDays(-1));
    }
    ASSERT_TRUE(enter().isEnabled()) << says();
    click(enter());
    EXPECT_EQ(kept().all().at(0).certificate.date, daysFromNow(-11));
    EXPECT_EQ(kept().all().at(0).certificate.due, daysFromNow(354));
}

TEST_F(CertificateWindow, AltDownInADayOpensItsCalendarAndReturnTakesTheDay) {
    showDialog();
    writeAll("4711", -10, 355);
    auto* due = dialog->findChild<QLineEdit*>("due");
    due->setFocus();
    QTest::keyClick(due, Qt::Key_Down, Qt::AltModifier);
    auto* menu = dialog->findChild<QToolButton*>("calendar-due")->menu();
    QTimer::singleShot(500, menu, [menu] {
        EXPECT_TRUE(menu->isVisible());
        auto* view = menu->findChild<QAbstractItemView*>();
        QTest::keyClick(view, Qt::Key_Right);
        QTest::keyClick(view, Qt::Key_Return);
    });
    EXPECT_IN_TIME(comesTrue([&] { return due->text() == QString::fromStdString(dateText(daysFromNow(356))); }))
        << due->text().toStdString();
    EXPECT_FALSE(menu->isVisible());
}

TEST_F(CertificateWindow, FitsASmallScreenWithLargeTextByScrolling) {
    auto store = kept();
    ASSERT_TRUE(store.add(
        {"Rigol DS1054Z", "DS1ZA1", "K-2026-18", "DAkkS Lab", daysFromNow(-10), daysFromNow(355), 0.5, 2.0, 0.1, 1.0},
        daysFromNow(0)));
    for (const int percent : {100, 200}) {
        gui::applyTextSize(percent);
        showDialog();
        writeAll("K-2026-19", -1, 364);
        dialog->resize(QSize(1270, percent == 200 ? 500 : 580).boundedTo(dialog->size()));  // the room below the bar
        letLive(50);
        EXPECT_LE(dialog->width(), 1270) << percent;
        EXPECT_LE(dialog->height(), percent == 200 ? 500 : 580) << percent;
        auto* page = dialog->findChild<gui::ScrollingPage*>();
        EXPECT_EQ(page->horizontalScrollBar()->maximum(), 0) << percent << ": from top to bottom only";
        shot(*dialog, QString("certificates-1280-%1").arg(percent));
        for (auto* edit : dialog->findChildren<QLineEdit*>()) {
            if (edit->window() != dialog.get()) continue;  // belongs to a calendar
            edit->setFocus(Qt::TabFocusReason);
            page->ensureWidgetVisible(edit);
            EXPECT_EQ(edit->visibleRegion().boundingRect().size(), edit->size()) << edit->objectName().toStdString();
        }
        EXPECT_EQ(faultsOf(*dialog), "") << percent;
        EXPECT_TRUE(enter().isVisible() &&
                    dialog->rect().contains(enter().mapTo(dialog.get(), enter().rect().center())));
    }
}

TEST_F(CertificateWindow, RefusesInPlace) {
    RecordProperty("hazard", "H9");
    showDialog();
    writeAll("4711", -10, 355);
    for (const auto* u : {"0", "-1", "nan", "51", "1,000", ""}) {
        write("gain-u", u);
        EXPECT_FALSE(enter().isEnabled()) << u;
        EXPECT_THAT(says(), HasSubstr("above 0 to 50 %")) << u;
    }
    write("gain-u", "0.5");
    write("due", "2027-13-01");
    EXPECT_THAT(says(), HasSubstr("2027-13-01"));
    write("due", QString::fromStdString(dateText(daysFromNow(-11))));
    EXPECT_THAT(says(), HasSubstr("before its date"));
    write("serial", " ");
    EXPECT_THAT(says(), HasSubstr("serial number is missing"));
    EXPECT_TRUE(kept().all().empty());
}

TEST_F(CertificateWindow, AnExpiredOneIsGreyAndSaysSo) {
    RecordProperty("hazard", "H9");
    showDialog();
    writeAll("4711", -400, -1);
    EXPECT_TRUE(enter().isEnabled());
    EXPECT_THAT(says(), HasSubstr("expired"));
    click(enter());
    ASSERT_EQ(table().rowCount(), 1);
    EXPECT_THAT(table().item(0, 0)->text().toStdString(), HasSubstr("expired"));
    const auto grey = [this] { return dialog->palette().color(QPalette::PlaceholderText); };
    EXPECT_EQ(table().item(0, 0)->foreground().color(), grey());
    gui::applyTheme(gui::Theme::Dark);
    QCoreApplication::processEvents();
    EXPECT_EQ(table().item(0, 0)->foreground().color(), grey());
}

TEST_F(CertificateWindow, WithdrawsAfterASecondPress) {
    auto store = kept();
    ASSERT_TRUE(store.add({"X", "S", "4711", "L", daysFromNow(0), daysFromNow(9), 1.0, {}, {}, {}}, daysFromNow(0)));
    showDialog();
    auto* withdraw = dialog->findChild<QPushButton*>("withdrawCertificate");
    EXPECT_FALSE(withdraw->isEnabled());
    table().selectRow(0);
    click(*withdraw);
    EXPECT_EQ(kept().state(0, daysFromNow(0)), CertificateState::Counts);
    EXPECT_THAT(withdraw->text().toStdString(), HasSubstr("4711"));
    letLive(gui::ConfirmButton::kDebounce_ms + 100);
    click(*withdraw);
    EXPECT_EQ(kept().state(0, daysFromNow(0)), CertificateState::Withdrawn);
    EXPECT_THAT(table().item(0, 0)->text().toStdString(), HasSubstr("withdrawn"));
    EXPECT_FALSE(withdraw->isEnabled());
}

TEST_F(CertificateWindow, FillsItselfFromADigitalOne) {
    RecordProperty("hazard", "H9");
    showDialog();
    DccText dcc;
    dcc.due = "";
    dcc.ended = dateText(daysFromNow(-10));
    dcc.results = dccResult("DC", dccReal("", "Gain error", "0.1", "\\percent", "0.5", "2"));
    read(dcc);
    EXPECT_THAT(says(), HasSubstr("no day on which it is due"));
    EXPECT_FALSE(enter().isEnabled());
    write("due", QString::fromStdString(dateText(daysFromNow(300))));
    read(dcc);
    EXPECT_THAT(says(), HasSubstr("ertificate K-17 is unsigned."));
    EXPECT_THAT(says(), HasSubstr("readings are not corrected"));
    ASSERT_TRUE(enter().isEnabled()) << says();
    click(enter());
    ASSERT_EQ(kept().all().size(), 1U);
    const auto one = kept().all()[0].certificate;  // a copy: kept() is gone after it
    EXPECT_EQ(one.instrument, "Rigol DS1054Z");
    EXPECT_EQ(one.number, "K-17");
    EXPECT_EQ(one.gain_pct, 0.6);
    EXPECT_FALSE(one.timeBase_ppm || one.shunt_pct || one.probe_pct);
}

TEST_F(CertificateWindow, AddsAShuntAndBeginsAnewWithAnotherOscilloscope) {
    const auto shown = [&](const char* field) { return dialog->findChild<QLineEdit*>(field)->text().toStdString(); };
    showDialog();
    DccText scope, shunt, other;
    scope.due = dateText(daysFromNow(300));
    scope.ended = shunt.ended = other.ended = dateText(daysFromNow(-10));
    scope.results = dccResult("DC", dccReal("", "Gain error", "0", "\\percent", "0.5", "2") +
                                        dccReal("", "Time base error", "0", "\\ppm", "7", "2"));
    shunt.number = "S-4";
    shunt.model = "Shunt";
    shunt.serial = "R1";
    shunt.due = dateText(daysFromNow(200));
    shunt.results = dccResult("Shunt", dccReal("", "Value", "0.1", "\\ohm", "0.0002", "2"));
    other.number = "K-99";
    other.serial = "";
    other.due = dateText(daysFromNow(400));
    other.results = dccResult("DC", dccReal("", "Gain error", "0", "\\percent", "0.8", "2"));
    read(scope);
    read(shunt);
    EXPECT_EQ(shown("serial"), "DS1ZA1") << says();
    EXPECT_EQ(shown("number"), "K-17 + S-4");
    EXPECT_EQ(shown("due"), shunt.due);
    EXPECT_EQ(shown("gain-u") + " " + shown("timebase-u-ppm") + " " + shown("shunt-u"), "0.5 7 0.2");
    // The serial number of the first is not the second's.
    read(other);
    EXPECT_THAT(says(), HasSubstr("no serial number"));
    write("serial", "OWN");
    read(other);
    EXPECT_EQ(shown("serial") + " " + shown("number"), "OWN K-99") << says();
    EXPECT_EQ(shown("due"), other.due);
    EXPECT_EQ(shown("gain-u") + shown("timebase-u-ppm") + shown("shunt-u"), "0.8");
    click(enter());
    ASSERT_EQ(kept().all().size(), 1U) << says();
    // What was entered is done with: a shunt alone is no oscilloscope.
    read(shunt);
    EXPECT_THAT(says(), HasSubstr("states no voltage gain"));
}

TEST_F(CertificateWindow, LooksRightInBothThemes) {
    auto store = kept();
    const auto today = daysFromNow(0);
    ASSERT_TRUE(store.add(
        {"Rigol DS1054Z", "DS1ZA1", "K-2025-17", "DAkkS Lab", daysFromNow(-400), daysFromNow(-35), 1.0, {}, {}, {}},
        today));
    ASSERT_TRUE(store.add({"Siglent SDS1104X-E",
                           "SDSM1",
                           "K-2025-99",
                           "DAkkS Lab",
                           daysFromNow(-380),
                           daysFromNow(-15),
                           0.8,
                           5.0,
                           {},
                           {}},
                          today));
    ASSERT_TRUE(store.add(
        {"Rigol DS1054Z", "DS1ZA1", "K-2026-18", "DAkkS Lab", daysFromNow(-10), daysFromNow(355), 0.5, 2.0, 0.1, 1.0},
        today));
    for (const auto theme : {gui::Theme::Light, gui::Theme::Dark}) {
        gui::applyTheme(theme);
        showDialog();
        writeAll("K-2026-19", -1, 364);
        shot(*dialog, theme == gui::Theme::Dark ? "certificates-dark" : "certificates-light");
        EXPECT_LE(dialog->width(), 1024);
        EXPECT_EQ(table().horizontalScrollBar()->maximum(), 0) << "every column is seen";
        EXPECT_GE(table().horizontalHeader()->height(), 2 * table().horizontalHeader()->fontMetrics().lineSpacing());
        EXPECT_EQ(faultsOf(*dialog), "");
    }
}

}  // namespace
}  // namespace tacto::test
